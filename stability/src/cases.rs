//! All cases: a file for each, and the list of them.

mod argon;
mod figure_eight;
mod frames;
mod kepler;
mod oscillator;
mod outer_planets;
mod precision;
mod resonances;
mod reversal;

use crate::case::Entry;

/// In the order of the report.
pub(crate) const CASES: &[Entry] = &[
    Entry::of::<oscillator::Oscillator>(),
    Entry::of::<kepler::Kepler>(),
    Entry::of::<resonances::Resonances>(),
    Entry::of::<figure_eight::FigureEight>(),
    Entry::of::<outer_planets::OuterPlanets>(),
    Entry::of::<argon::Argon>(),
    Entry::of::<frames::Frames>(),
    Entry::of::<reversal::Reversal>(),
    Entry::of::<precision::Precision>(),
];
