//! All cases: a file for each, and the list of them.

mod argon;
mod chains;
mod figure_eight;
mod fput;
mod frames;
mod henon_heiles;
mod kepler;
mod oscillator;
mod outer_planets;
mod pendulum;
mod precision;
mod pythagorean;
mod resonances;
mod reversal;
mod round_off;
mod stiff_springs;

use crate::case::Entry;

/// In the order of the report.
pub(crate) const CASES: &[Entry] = &[
    Entry::of::<oscillator::Oscillator>(),
    Entry::of::<kepler::Kepler>(),
    Entry::of::<pendulum::Pendulum>(),
    Entry::of::<henon_heiles::HenonHeiles>(),
    Entry::of::<stiff_springs::StiffSprings>(),
    Entry::of::<resonances::Resonances>(),
    Entry::of::<pythagorean::Pythagorean>(),
    Entry::of::<figure_eight::FigureEight>(),
    Entry::of::<outer_planets::OuterPlanets>(),
    Entry::of::<argon::Argon>(),
    Entry::of::<fput::Fput>(),
    Entry::of::<frames::Frames>(),
    Entry::of::<chains::Chains>(),
    Entry::of::<round_off::RoundOff>(),
    Entry::of::<reversal::Reversal>(),
    Entry::of::<precision::Precision>(),
];
