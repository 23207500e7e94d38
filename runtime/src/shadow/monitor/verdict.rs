//! The verdict on the step size.

use std::fmt;

/// The conclusion about the step size of a run.
///
/// It follows from what is resolved: how far the modified energy H̄ [moved beyond its errors](super::Report::moved),
/// what permanent change of the energy is [excluded](super::Report::permanent_bound), and the expected effect of
/// round-off, all as parts of the energy error, max − min of H; and the energy error as a part of the mean kinetic
/// energy T. The first that applies is given:
///
/// 1. **too large: not finite**: a state or an energy is not finite, or the sums overflow.
/// 1. **undecided: windows**: there are fewer than 16 windows.
/// 1. **inconsistent**: the states of a window differ from [their increments](super::Report::mismatches); or
///    [the rate](super::Report::wrong_rates) is not qᵀU_q − 2U; or, beyond errors and round-off, H̄ moved by 1000 times
///    the energy error; or, from one turn of the fastest motion on, the range of H − H̄ is as far from 0 as θ²T/6 and
///    half of the energy error, θ the angle of that motion in a step; or, where forces are not smooth, H − H̄ is θ²T/6
///    and 3 times the energy error, rms: the last three only where the steps resolve all coordinates.
/// 1. **round-off**: moves or errors are half of the energy error, and no more than 10 times what round-off makes.
/// 1. **near a resonance**: H̄ moved by a quarter or more, and the fastest motion is one oscillation that turns once in
///    3, 4, 5, 6 or 5/2 steps, to 0.006 turns a step.
/// 1. **too large: energy error**: the energy error is 0.4 of T or more; or T is 0 in all windows, and q changes.
/// 1. **drifts**: H̄ moved by 1e-3 or more in a straight line.
/// 1. **not the gradient**: a permanent change of a quarter is excluded, but H̄ changes from state to state as H does:
///    they differ by 0.3 of what H̄ changes in a window, whose last terms are 0.004 of that, and the fastest motion
///    turns once in 10 steps or more.
/// 1. **bounded**: a permanent change of a quarter is excluded, H̄ did not move by a quarter between any two windows as
///    far as that is resolved, and the one above does not apply.
/// 1. **not smooth**: forces are [not smooth](super::Report::rough) in a quarter of the windows.
/// 1. **not conserved**: H̄ moved permanently by half or more, its errors are a quarter or less, and the fastest motion
///    turns once in 18 steps or less; but the energy error is below 0.05 of T.
/// 1. **too large: moves**: the same, and the energy error is 0.05 of T or more.
/// 1. **too large: lost**: in place of bounded and round-off: a coordinate turned once in 6 steps or fewer in the first
///    five states, ten times as fast as the fastest motion that the energy shows, and turns at most a third as fast in
///    the windows.
/// 1. **undecided: resolution**: none of these: the [advice](super::Report::advice) is what would decide.
///
/// The thresholds, with their reasons, are in `thresholds.rs` beside this file, the rules in `rules.rs`. They come from a
/// matrix of runs, and were tested with others: `docs/monitor.md`.
///
/// **What it cannot detect:**
/// - linear trends below 1e-3 of the energy error: slow oscillations of the outer planets' H̄ look like one, and make
///   up to 1e-4;
/// - what happens later: a slow instability, or an encounter that has not come yet;
/// - resonances of slow motions, and of oscillations with a small part of the momentum: the angle θ is computed from
///   the second differences of p, over all coordinates at once;
/// - what happens between windows without a lasting effect, and what happens before the first windows whose estimates
///   are accurate, such as a body that is thrown out by the first steps;
/// - whether a light body is resolved, unless it turned fast in the first five states and no longer does: its energy is
///   a negligible part of the whole. The report names
///   [the coordinate that turns fastest](super::Report::fastest_coordinate) where the steps hardly resolve it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The energy error is the method's, and a permanent change is excluded: see
    /// [`relative_error`](super::Report::relative_error) and [`permanent_bound`](super::Report::permanent_bound).
    Bounded,
    /// The modified energy changes, and the fastest oscillation turns nearly `turns` times in `steps` steps.
    NearResonance {
        /// m of m/n: 1 or 2.
        turns: u32,
        /// n of m/n: 3 to 6.
        steps: u32,
    },
    /// The modified energy changes linearly in time, by more than round-off: something other than the scheme and its
    /// forces acts.
    Drifts,
    /// The modified energy changes as a smooth function of time: the forces are not the gradient of the energy, the
    /// rate is not qᵀU_q − 2U, or something other than the scheme acts. [`check_potential`](crate::check_potential)
    /// compares them.
    NotTheGradient,
    /// The forces are not smooth, and most of the change of the energy comes from that: a smaller step helps as a low
    /// power of its size only, whatever the order of the scheme.
    NotSmooth,
    /// No modified energy is conserved, but the energy error is small so far: it grows with the length of the run. The
    /// cause is encounters that the steps do not resolve, forces that are not smooth, or something other than the
    /// scheme.
    NotConserved,
    /// The states do not belong to the increments: plain steps were made where augmented ones were needed, or the state
    /// was changed between the steps.
    Inconsistent,
    /// No modified energy is conserved well enough, or it shows nothing about the energy.
    TooLarge(Criterion),
    /// The energy error is round-off, not the method's: a larger step size is sufficient, or more digits are needed.
    RoundOff,
    /// Not decided by this run.
    Undecided(Missing),
}

impl Verdict {
    /// Windows that a verdict needs.
    pub const LEAST_WINDOWS: u64 = 16;

    /// Whether the energy error is bounded, as far as the run shows: [`Bounded`](Verdict::Bounded) or
    /// [`RoundOff`](Verdict::RoundOff). Whether its [size](super::Report::relative_error) is small enough is for the
    /// user to decide.
    pub fn is_bounded(self) -> bool {
        matches!(self, Verdict::Bounded | Verdict::RoundOff)
    }

    /// Whether the energy is lost: the error is as large as T, or not finite. The modified energy then bounds nothing.
    pub fn loses_the_energy(self) -> bool {
        matches!(self, Verdict::TooLarge(Criterion::EnergyError | Criterion::NotFinite))
    }

    /// Its name, for other programs: `bounded`, `near-resonance`, `drifts`, `not-the-gradient`, `not-smooth`,
    /// `not-conserved`, `inconsistent`, `too-large`, `round-off` or `undecided`.
    pub fn name(self) -> &'static str {
        self.words().0
    }

    /// Its name, and what it says.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Verdict::Bounded => ("bounded", "bounded"),
            Verdict::NearResonance { .. } => ("near-resonance", "the step size is near the resonance"),
            Verdict::Drifts => ("drifts", "the modified energy drifts"),
            Verdict::NotTheGradient => ("not-the-gradient", "the forces are not the gradient of the energy"),
            Verdict::NotSmooth => ("not-smooth", "the forces are not smooth"),
            Verdict::NotConserved => ("not-conserved", "the modified energy is not conserved"),
            Verdict::Inconsistent => ("inconsistent", "the states do not belong to the increments"),
            Verdict::TooLarge(_) => ("too-large", "the step size is too large"),
            Verdict::RoundOff => ("round-off", "the energy error is round-off"),
            Verdict::Undecided(_) => ("undecided", "undecided"),
        }
    }
}

/// The criterion by which a step size is too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// The modified energy moves.
    Moved,
    /// The energy error is as large as the kinetic energy.
    EnergyError,
    /// A coordinate turned at the start, and no longer does: the steps did not resolve it, however little of the energy
    /// it has.
    Lost,
    /// A state or an energy is not finite.
    NotFinite,
}

/// What a verdict needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// At least 16 windows.
    Windows,
    /// A better resolution of the modified energy, or a longer run.
    Resolution,
}

/// What would decide an undecided verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Advice {
    /// How many times as long a run may decide: its means of H exclude smaller changes, as those of independent numbers
    /// do.
    pub length: u64,
    /// An estimator of this order k or m: from the fall of its errors with the order where the second harmonic of the
    /// fastest motion dominates. `None` where no order up to 64 would do.
    pub order: Option<u32>,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words().1)?;
        match self {
            Verdict::NearResonance { turns, steps } => write!(f, " {turns}/{steps}"),
            _ => Ok(()),
        }
    }
}
