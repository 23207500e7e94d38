//! The thresholds of the verdicts on a monitor's windows and on runs.
//!
//! Where a row names no other measurement, its value was chosen with the first matrix of `docs/monitor.md`, 1632 runs, so
//! that the fewest verdicts are wrong, and tested with the second one, 648 others: `cargo bench -p shadowstep-tests
//! --bench verdicts`, a part of it in `tests/tests/monitor/matrix.rs`.

#![warn(clippy::missing_docs_in_private_items, reason = "no threshold without its reason")]

// ---- what H̄ does, as parts of the energy error ----

/// The verdict is bounded if a permanent change of this part is excluded: half of what counts as one. H̄ must be known to
/// it to conclude anything of a move.
pub(super) const PERMANENT_LIMIT: f64 = 0.25;
/// The error grows if a permanent change of this part is resolved; between this and the limit nothing is decided.
pub(super) const PERMANENT_MOVE: f64 = 0.5;
/// H̄ moves with H, so by no more than this: larger moves are errors of its estimates.
pub(super) const LARGEST_MOVE: f64 = 1.5;
/// A linear trend is reported from this part on: slow oscillations of the outer planets' H̄ look like one, and make up to
/// 1e-4.
pub(super) const LINEAR_MOVE: f64 = 1e-3;
/// Steps with their increments move H̄ by less than this part.
pub(super) const INCONSISTENT_MOVE: f64 = 1000.0;

// ---- H − H̄ ----

/// The range of H − H̄ may be off 0 by this part of θ²T: up to 1/12 was measured, on circular orbits.
pub(super) const OFFSET_PER_TURNING: f64 = 1.0 / 6.0;
/// Or by this part of the energy error, where that is more.
pub(super) const OFFSET_LIMIT: f64 = 0.5;
/// H − H̄ is compared with the energy error after at least this number of turns of the fastest motion: on a short arc H
/// hardly varies. In correct loops H − H̄ was too large for that up to 0.64 turns, with symplectic Euler.
pub(super) const LEAST_TURNS: f64 = 1.0;
/// Where forces are not smooth H̄ differs from H by less than this many times the energy error.
pub(super) const LARGEST_DISTANCE: f64 = 3.0;
/// H̄ changes with H if they differ by this part of its errors or less: where H̄ is constant they differ by more, or by
/// these errors.
pub(super) const DISTANCE_LIMIT: f64 = 0.3;
/// H̄ changes as a smooth function of time if its last terms are this part of its errors or less: 0.0012 and 0.0025 for
/// wrong forces and rates, 0.0065 and more at jumps.
pub(super) const LAST_TERM_LIMIT: f64 = 0.004;

// ---- whether the steps resolve the motion ----

/// A motion is resolved by the steps if pᵀΔq is this part of 2hT or more: of an oscillation that turns by φ a step it is
/// sin φ/φ, so a third of a turn.
pub(super) const RESOLVED_ACTION: f64 = 0.4;
/// A motion that turns by less than this angle a step, once in 18 steps, is resolved by every scheme with a stable step,
/// so that the step size is not the cause.
pub(super) const SMALL_ANGLE: f64 = 0.35;
/// Motions that turn by more than this angle a step, once in 10 steps, are not resolved well enough to judge the forces.
pub(super) const ANGLE_LIMIT: f64 = 0.6;
/// A coordinate that turns once in fewer steps is hardly resolved: about the angle above.
pub(super) const FEW_STEPS: f64 = 10.0;
/// What the energy shows is slower by this factor than a coordinate that has no part in it. A coordinate that has energy,
/// and turns so much faster at a pericentre, is taken for one in two runs of the matrix.
pub(super) const SLOWER: f64 = 10.0;

// ---- the size of the energy error ----

/// An energy error below this part of the mean kinetic energy is small: it may grow, and the step size is not yet too
/// large. It is an eighth of the limit.
pub(super) const SMALL_ERROR: f64 = 0.05;
/// The verdict is round-off if that makes this part of the energy error, most of it.
pub(super) const ROUND_OFF_PART: f64 = 0.5;
/// Round-off may be this many times what is expected: where nothing else moved H̄ its range was 0.5 to 6.5 times that in
/// `f64`.
pub(super) const ROUND_OFF_FACTOR: f64 = 10.0;
/// The error that round-off makes in an estimate, in kicks of one step: 3 to 8 were measured.
pub(super) const KICKS_IN_AN_ESTIMATE: f64 = 10.0;

// ---- resonances ----

/// Turns and steps of the resonances of low order, which are the strong ones.
pub(super) const RESONANCES: [(u32, u32); 5] = [(1, 3), (1, 4), (1, 5), (1, 6), (2, 5)];
/// The distance of a frequency from a resonance, in turns a step, at which it is taken for it: a fifth of the distance
/// between 1/5 and 1/6, the nearest two.
pub(super) const RESONANCE_WIDTH: f64 = 0.006;
/// H̄ must be known to this part of the energy error to conclude that a resonance moves it, by a quarter or more.
pub(super) const RESONANCE_ERROR: f64 = 0.1;
/// A motion up to this irregularity is taken for one oscillation: the chaotic pendulum's is 0.17 or more.
pub(super) const IRREGULARITY_LIMIT: f64 = 0.1;

// ---- advice ----

/// The largest order that is advised: up to it estimators choose, if nothing else is said.
pub(super) const LARGEST_ORDER: f64 = 64.0;
