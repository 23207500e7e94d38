//! The thresholds that tell apart what moves the energy of a recorded trajectory.
//!
//! Where a row names no other measurement, its value was chosen on 25882 verdicts on trajectories like those of
//! `tests/tests/recorded/verdicts.rs`, drawn with seeds that its tests have not, so that the fewest are wrong: 7. Of 3374
//! others one is wrong (`docs/recorded-trajectories.md`, which has the values that theory gives and that were measured).

#![warn(clippy::missing_docs_in_private_items, reason = "no threshold without its reason")]

use super::window::Window;

/// Estimates that a statement needs: of fewer, medians and ratios of squares are chance.
pub(super) const LEAST_ESTIMATES: usize = 32;

// ---- differences of the states from the steps ----

/// Logged states differ from the steps by more than this part of the increments,
pub(super) const LARGEST_MISFIT: f64 = 1e-3;
/// and by more than this part of themselves, a few last places of an `f32`, and are not rounded each by itself:
pub(super) const SINGLE: f64 = 2.4e-7;
/// the correlation of rounded ones, −1/2 in theory, is below this, or, where they change by less than their last digit in
/// a step, below the second,
pub(super) const ROUNDED: [f64; 2] = [-0.2, 0.3];
/// and these wander by less than this part of independent ones.
pub(super) const WANDERING: f64 = 0.5;
/// Of differences whose work is what H̄ ranges over, these are below this: a thermostat's do not wander as far as
/// independent ones.
pub(super) const AT_HOME: f64 = 0.3;
/// Numbers that differ by more than this part of themselves are not rounded ones.
pub(super) const COARSE: f64 = 1e-2;
/// States that are rounded make errors of H̄ that are smaller than the work of the differences in a step; this many times
/// that is none.
pub(super) const OF_ROUNDING: f64 = 5.0;
/// The work of the differences from steps is what moves H̄, if it is this part of its range or more, up to the inverse: a
/// factor of three, as both are ranges.
pub(super) const OF_WORK: f64 = 0.3;

// ---- what H̄ does ----

/// H̄ moved if its range is this part of the energy error or more, beyond errors on both sides.
pub(super) const MOVED: f64 = 0.1;
/// It is at rest if it is known to that part, and ranges over less than this one with its errors.
pub(super) const RANGE: f64 = 0.25;
/// From this part on that is certain only where the steps resolve the motion and H̄ does not go to and fro: estimates are
/// means over nine states, in which what U jumps by, or forces that are not −U_q, may cancel.
pub(super) const CANCELS: f64 = 0.02;
/// H̄ moves by more than the forces' differences explain where the excess is above this: it is 1 for noise of the forces,
/// 6.8e4 and more where U of argon jumps,
pub(super) const MUCH: f64 = 8.0;
/// and by much less below this.
pub(super) const LITTLE: f64 = 0.03;
/// Noise of the forces makes an excess of 1, and above this: 0.64 in argon;
pub(super) const NOISE_EXCESS: f64 = 0.5;
/// motion that the steps do not resolve makes one below this: 0.029 in argon with steps of 50 fs.
pub(super) const MOTION_EXCESS: f64 = 0.05;
/// H̄ changes at few states only where the isolation is above this: it is 1 for noise, up to 1.5 in argon;
pub(super) const ISOLATED: f64 = 3.0;
/// what grows unevenly has one up to this: 1.1e4 for jumps in argon.
pub(super) const JUMPS_ISOLATED: f64 = 5.0;
/// What H̄ changes by in one step and in another is alike where the isolation is below this.
pub(super) const ALIKE: f64 = 2.0;

// ---- how smooth U and the forces are ----

/// U is too smooth for the changes of H̄ where its differences are below this part of them,
pub(super) const SMOOTH_ENERGY: f64 = 0.15;
/// and may be noisy where they are above this.
pub(super) const NOISY_ENERGY: f64 = 2.2;
/// Exponents of a U that is noise are below this: 0 in theory, and 1 where it jumps;
pub(super) const NOISE: f64 = 0.5;
/// of forces that are noise, below this;
pub(super) const NOISE_OF_FORCES: f64 = 0.25;
/// between that and this they may have kinks: 1 in theory where U′ jumps.
pub(super) const LEAST_OF_KINKS: f64 = 0.75;
/// Exponents of numbers that jump are below this: 1 in theory;
pub(super) const JUMPS: f64 = 2.0;
/// of those whose derivative jumps, below this: 3 in theory.
pub(super) const KINKS: f64 = 4.0;

/// Thresholds that depend on the windows: those of nine states know less.
pub(super) struct OfWindow {
    /// Forces that jump, or whose derivatives do, make an excess below this: from it on, noise beside the motion may have
    /// their exponent.
    pub(super) of_kinks: f64,
    /// What H̄ changes by in one step and in another is independent where the growth, 1 in theory, is between these.
    pub(super) independent: [f64; 2],
    /// H̄ changes slowly, also where the steps do not resolve the motion, from this growth on.
    pub(super) very_slow: f64,
    /// The steps do not resolve the motion where differences of smooth forces are this part of the forces or more: both
    /// are six steps a turn.
    pub(super) unresolved: f64,
    /// They are too large for it where these are this part, about four steps a turn; or the second, where H̄ does not go
    /// to and fro.
    pub(super) too_large: [f64; 2],
}

impl Window {
    /// The thresholds for windows of this length.
    pub(super) const fn thresholds(self) -> OfWindow {
        match self {
            Window::Nine => OfWindow {
                of_kinks: 0.5,
                independent: [0.4, 4.0],
                very_slow: 4.5,
                unresolved: 0.05,
                too_large: [0.15, 0.25],
            },
            Window::Seventeen => OfWindow {
                of_kinks: 0.6,
                independent: [0.7, 1.6],
                very_slow: 2.1,
                unresolved: 0.01,
                too_large: [0.1, 0.15],
            },
        }
    }
}
