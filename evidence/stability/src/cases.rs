//! All cases: a file for each, and the list of them.

mod argon;
mod chains;
mod close_planets;
mod figure_eight;
mod fput;
mod frames;
mod henon_heiles;
mod kepler;
mod linear_part;
mod orders;
mod oscillator;
mod outer_planets;
mod pendulum;
mod pericentres;
mod precision;
mod processing;
mod pythagorean;
mod resonances;
mod reversal;
mod round_off;
mod stiff_springs;
mod tangent_maps;
mod transformed_time;

use crate::case::Entry;

/// In the order of the report.
pub(crate) const CASES: &[Entry] = &[
    Entry::of::<oscillator::Oscillator>(),
    Entry::of::<orders::Orders>(),
    Entry::of::<processing::Processing>(),
    Entry::of::<kepler::Kepler>(),
    Entry::of::<pendulum::Pendulum>(),
    Entry::of::<henon_heiles::HenonHeiles>(),
    Entry::of::<stiff_springs::StiffSprings>(),
    Entry::of::<resonances::Resonances>(),
    Entry::of::<linear_part::LinearPartCase>(),
    Entry::of::<transformed_time::TransformedTime>(),
    Entry::of::<pythagorean::Pythagorean>(),
    Entry::of::<figure_eight::FigureEight>(),
    Entry::of::<outer_planets::OuterPlanets>(),
    Entry::of::<pericentres::Pericentres>(),
    Entry::of::<close_planets::ClosePlanets>(),
    Entry::of::<argon::Argon>(),
    Entry::of::<fput::Fput>(),
    Entry::of::<frames::Frames>(),
    Entry::of::<chains::Chains>(),
    Entry::of::<round_off::RoundOff>(),
    Entry::of::<reversal::Reversal>(),
    Entry::of::<tangent_maps::TangentMaps>(),
    Entry::of::<precision::Precision>(),
];
