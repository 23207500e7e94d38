//! The verdict on the step size, and its thresholds.

use std::fmt;

use super::change::Change;
use super::trend::Trend;
use super::turning::Turning;

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
/// The thresholds come from a matrix of runs, and were tested with others: `docs/monitor.md`.
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
        match self {
            Verdict::Bounded => "bounded",
            Verdict::NearResonance { .. } => "near-resonance",
            Verdict::Drifts => "drifts",
            Verdict::NotTheGradient => "not-the-gradient",
            Verdict::NotSmooth => "not-smooth",
            Verdict::NotConserved => "not-conserved",
            Verdict::Inconsistent => "inconsistent",
            Verdict::TooLarge(_) => "too-large",
            Verdict::RoundOff => "round-off",
            Verdict::Undecided(_) => "undecided",
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

/// The verdict is bounded if a permanent change is excluded from this part of the energy error on.
pub(super) const PERMANENT_LIMIT: f64 = 0.25;
/// It is too large if a permanent change of this part or more is resolved.
const PERMANENT_MOVE: f64 = 0.5;
/// H̄ moves with H, so by no more than this: larger moves are errors of its estimates.
const LARGEST_MOVE: f64 = 1.5;
/// A linear trend is reported if H̄ moves by this part of the energy error or more.
const LINEAR_MOVE: f64 = 1e-3;
/// The range of H − H̄ may be off 0 by this part of θ²T (up to 1/12 was measured), or of the energy error.
const OFFSET_PER_TURNING: f64 = 1.0 / 6.0;
const OFFSET_LIMIT: f64 = 0.5;
/// H − H̄ is compared with the energy error after at least this number of turns of the fastest motion: on a short arc H
/// hardly varies. In correct loops H − H̄ was too large for that up to 0.64 turns, with symplectic Euler.
const LEAST_TURNS: f64 = 1.0;
/// Steps with their increments move H̄ by less than this part of the energy error.
const INCONSISTENT_MOVE: f64 = 1000.0;
/// A motion is resolved by the steps if pᵀΔq is this part of 2hT or more; for an oscillation that turns by φ a step it
/// is sin φ/φ.
const RESOLVED_ACTION: f64 = 0.4;
/// H̄ changes with H if they differ by this part of its errors or less. Where H̄ is constant they differ by more, or by
/// these errors.
const DISTANCE_LIMIT: f64 = 0.3;
/// H̄ changes as a smooth function of time if its last terms are this part of its errors or less: 0.0012 and 0.0025 for
/// wrong forces and rates, 0.0065 and more at jumps.
const LAST_TERM_LIMIT: f64 = 0.004;
/// Where forces are not smooth H̄ differs from H by less than this many times the energy error.
const LARGEST_DISTANCE: f64 = 3.0;
/// A motion that turns by less than this angle a step is resolved by every scheme with a stable step.
const SMALL_ANGLE: f64 = 0.35;
/// Motions that turn by more than this angle a step are not resolved well enough to judge the forces.
const ANGLE_LIMIT: f64 = 0.6;
/// An estimate may be wrong by this many times its error.
const ERROR_FACTOR: f64 = 3.0;
/// The verdict is round-off if that makes this part of the energy error or more.
const ROUND_OFF_PART: f64 = 0.5;
/// An energy error below this part of the mean kinetic energy is small: it may grow, and the step size is not yet too
/// large.
const SMALL_ERROR: f64 = 0.05;
/// The energy error is too large from this part of the mean kinetic energy on.
pub const KINETIC_LIMIT: f64 = 0.4;
/// Round-off may be this many times what is expected.
const ROUND_OFF_FACTOR: f64 = 10.0;
/// The error that round-off makes in an estimate, in kicks of one step: 3 to 8 were measured.
const KICKS_IN_AN_ESTIMATE: f64 = 10.0;
/// The distance of a frequency from a resonance, in turns a step, at which it is taken for it.
const RESONANCE_WIDTH: f64 = 0.006;
/// H̄ must be known to this part of the energy error to conclude that a resonance moves it.
const RESONANCE_ERROR: f64 = 0.1;
/// Turns and steps of the resonances of low order, which are the strong ones.
const RESONANCES: [(u32, u32); 5] = [(1, 3), (1, 4), (1, 5), (1, 6), (2, 5)];
/// A motion up to this irregularity is taken for one oscillation: the chaotic pendulum's is 0.17 or more.
const IRREGULARITY_LIMIT: f64 = 0.1;
/// The largest order that is advised.
const LARGEST_ORDER: f64 = 64.0;

/// The numbers that a verdict is based on; all up to `error_rms` as parts of the energy error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evidence {
    /// How far H̄ moved beyond its errors.
    pub(super) moved: f64,
    /// The largest error of the accurate H̄.
    pub(super) resolution: f64,
    /// What a net change is excluded above by estimates, those of both ends of the run included.
    pub(super) excluded: f64,
    /// The largest error of the most accurate estimate of a block.
    pub(super) worst_error: f64,
    /// The linear change of the means of H, and of all H̄.
    pub(super) energy_change: Option<Change>,
    pub(super) modified_change: Option<Change>,
    /// The expected effect of round-off on H̄, in one step and in all.
    pub(super) kick: f64,
    pub(super) round_off: f64,
    /// The distance of the range of H − H̄ from 0.
    pub(super) offset: f64,
    /// The root mean square of the errors.
    pub(super) error_rms: f64,
    /// The root mean square of H − H̄ with the H̄ of the same window, as a part of this.
    pub(super) distance: f64,
    /// The root mean square of the last terms, as a part of this.
    pub(super) last_term: f64,
    /// The energy error as a part of the mean kinetic energy.
    pub(super) of_kinetic: f64,
    /// pᵀΔq as a part of 2hT.
    pub(super) action: f64,
    pub(super) turning: Option<Turning>,
    /// How often that has turned in the run.
    pub(super) turns: f64,
    /// The angle by which the coordinate that turns fastest turns in a step, however little of the energy it has.
    pub(super) fastest_angle: Option<f64>,
    /// Whether a coordinate that turned fast at the start, much faster than what the energy shows, no longer does.
    pub(super) lost: bool,
    pub(super) trend: Option<Trend>,
    /// Whether H̄ is a linear function of time.
    pub(super) straight: bool,
    /// Whether the forces are not smooth.
    pub(super) rough: bool,
    /// Whether errors are known.
    pub(super) has_errors: bool,
    /// Whether q changes.
    pub(super) moves: bool,
    /// Whether a state differs from its increments.
    pub(super) mismatches: bool,
    /// Whether the rate is not qᵀU_q − 2U.
    pub(super) wrong_rate: bool,
    /// Whether all states and energies are finite.
    pub(super) finite: bool,
    pub(super) windows: u64,
}

impl Evidence {
    /// The verdict on the energy, unless that is bounded or round-off and a coordinate is lost that has no visible part
    /// in it.
    pub(super) fn verdict(&self) -> Verdict {
        match self.of_energy() {
            // where the energy grows without limit, its round-off does
            Verdict::RoundOff if self.lost && self.of_kinetic >= KINETIC_LIMIT => {
                Verdict::TooLarge(Criterion::EnergyError)
            }
            verdict if verdict.is_bounded() && self.lost => Verdict::TooLarge(Criterion::Lost),
            verdict => verdict,
        }
    }

    /// The first verdict whose condition holds; an energy error of 0 has no parts.
    fn of_energy(&self) -> Verdict {
        if !self.finite {
            Verdict::TooLarge(Criterion::NotFinite)
        } else if self.windows < Verdict::LEAST_WINDOWS {
            Verdict::Undecided(Missing::Windows)
        } else if self.is_inconsistent() {
            Verdict::Inconsistent
        } else if self.of_kinetic == 0.0 {
            Verdict::Bounded
        } else if self.of_kinetic.is_nan() {
            // 0 of 0: at rest, or from one turning point to the next
            if self.moves { Verdict::TooLarge(Criterion::EnergyError) } else { Verdict::Bounded }
        } else if self.is_round_off() {
            Verdict::RoundOff
        } else if let Some((turns, steps)) = self.resonance() {
            Verdict::NearResonance { turns, steps }
        } else if self.of_kinetic >= KINETIC_LIMIT {
            Verdict::TooLarge(Criterion::EnergyError)
        } else if self.straight && self.has_errors && self.moved_beyond_round_off() >= LINEAR_MOVE {
            Verdict::Drifts
        } else if self.excludes_a_permanent_change() {
            if self.follows_the_energy() { Verdict::NotTheGradient } else { Verdict::Bounded }
        } else if self.rough {
            Verdict::NotSmooth
        } else if self.turns_fast() && self.permanent_move().is_some_and(|moved| moved >= PERMANENT_MOVE) {
            if self.of_kinetic < SMALL_ERROR { Verdict::NotConserved } else { Verdict::TooLarge(Criterion::Moved) }
        } else {
            Verdict::Undecided(Missing::Resolution)
        }
    }

    /// What a net change of the energy is excluded above.
    pub(super) fn bound(&self) -> Option<f64> {
        if self.windows < Verdict::LEAST_WINDOWS {
            return None;
        }
        let of_means = [self.energy_change, self.modified_change].into_iter().flatten().map(Change::bound);
        // means are parts of the energy error in double precision, whatever the digits of the run are
        let of_means = of_means.map(|bound| bound.max(f64::EPSILON));
        let least = of_means.chain([self.excluded]).filter(|bound| bound.is_finite()).reduce(f64::min);
        least.map(|bound| bound.max(self.round_off))
    }

    /// How far H̄ moved permanently, where that is resolved.
    pub(super) fn permanent_move(&self) -> Option<f64> {
        let moved = self.moved_beyond_round_off();
        let resolved = self.has_errors && self.worst_error <= PERMANENT_LIMIT && moved > 0.0 && moved <= LARGEST_MOVE;
        (resolved && self.trend.is_some_and(|trend| trend != Trend::Steady)).then_some(moved)
    }

    /// Whether a permanent change of a quarter is excluded, and none is resolved between the windows.
    fn excludes_a_permanent_change(&self) -> bool {
        self.bound().is_some_and(|bound| bound < PERMANENT_LIMIT)
            && self.permanent_move().is_none_or(|moved| moved < PERMANENT_LIMIT)
    }

    /// What would decide, for estimates of an order k or m.
    pub(super) fn advice(&self, order: u32) -> Option<Advice> {
        if self.verdict() != Verdict::Undecided(Missing::Resolution) {
            return None;
        }
        let bound = self.energy_change.map_or(f64::NAN, Change::bound) / PERMANENT_LIMIT;
        // standard errors fall like 1/√length; a fifth more to be below the limit
        let length = (1.2 * bound.max(1.1).powi(2)).ceil() as u64;
        Some(Advice { length, order: self.sufficient_order(order) })
    }

    /// Errors fall by sin²(φ/2) from order to order, φ the angle of a harmonic.
    fn sufficient_order(&self, order: u32) -> Option<u32> {
        let second = 2.0 * self.turning?.angle;
        let factor = (second / 2.0).sin().powi(2);
        let more = (self.worst_error / (PERMANENT_LIMIT / 5.0)).ln().max(1.0) / -factor.ln();
        // an even one, whose estimates belong to the states
        let sufficient = 2.0 * ((f64::from(order) + more) / 2.0).ceil();
        (self.worst_error > PERMANENT_LIMIT / 5.0 && second < std::f64::consts::PI && sufficient <= LARGEST_ORDER)
            .then_some(sufficient as u32)
    }

    /// A part of the energy error, or 0 if it may be round-off.
    fn beyond_round_off(&self, part: f64) -> f64 {
        let expected = ROUND_OFF_FACTOR * self.round_off.max(KICKS_IN_AN_ESTIMATE * self.kick);
        if part > expected { part } else { 0.0 }
    }

    pub(super) fn moved_beyond_round_off(&self) -> f64 {
        self.beyond_round_off(self.moved)
    }

    fn is_round_off(&self) -> bool {
        let estimated =
            self.moved.max(if self.beyond_round_off(self.worst_error) == 0.0 { self.worst_error } else { 0.0 });
        self.moved_beyond_round_off() == 0.0 && estimated.max(self.round_off) >= ROUND_OFF_PART
    }

    fn is_inconsistent(&self) -> bool {
        self.mismatches || self.wrong_rate || self.moves_as_no_scheme_does() || self.is_far_from_the_energy()
    }

    /// Moves of which no errors are known may all be errors.
    fn moves_as_no_scheme_does(&self) -> bool {
        self.is_resolved() && self.has_errors && self.moved_beyond_round_off() > INCONSISTENT_MOVE
    }

    /// Whether H − H̄ is too large beside the energy error.
    fn is_far_from_the_energy(&self) -> bool {
        let of_turning = self.offset_of_turning();
        let most = of_turning.max(OFFSET_LIMIT).max(ERROR_FACTOR * self.resolution);
        let is_off = self.is_resolved() && self.beyond_round_off(self.offset) > most;
        let distance = self.beyond_round_off(self.distance * self.error_rms);
        let is_rough_and_far = self.resolves_all() && self.rough && distance > of_turning.max(LARGEST_DISTANCE);
        self.turns >= LEAST_TURNS && (is_off || is_rough_and_far)
    }

    /// θ²T/6 as a part of the energy error, where round-off may have made θ² too small.
    fn offset_of_turning(&self) -> f64 {
        let square = self.turning.map_or(0.0, |turning| turning.angle * turning.angle + turning.round_off);
        OFFSET_PER_TURNING * square / self.of_kinetic
    }

    /// Whether the steps resolve the motion; where they do not, H̄ may be anything.
    fn is_resolved(&self) -> bool {
        self.turns_little() && self.resolves_all() && (self.action.is_nan() || self.action >= RESOLVED_ACTION)
    }

    fn resolves_all(&self) -> bool {
        self.fastest_angle.is_none_or(|angle| angle <= ANGLE_LIMIT)
    }

    /// Whether the step size can be the cause of a change.
    fn turns_fast(&self) -> bool {
        self.turning.is_none_or(|turning| turning.angle > SMALL_ANGLE)
    }

    fn turns_little(&self) -> bool {
        self.turning.is_some_and(|turning| turning.angle <= ANGLE_LIMIT)
    }

    /// Whether the estimates vary from state to state as H does, by more than round-off. Where forces are not smooth
    /// they may, too, but H does not come back.
    fn follows_the_energy(&self) -> bool {
        let varies = self.rough && self.beyond_round_off(self.error_rms) >= LINEAR_MOVE;
        varies && self.distance <= DISTANCE_LIMIT && self.last_term <= LAST_TERM_LIMIT && self.turns_little()
    }

    fn resonance(&self) -> Option<(u32, u32)> {
        let turning = self.turning.filter(|turning| turning.irregular <= IRREGULARITY_LIMIT)?;
        let moved = self.moved_beyond_round_off();
        let moves = (PERMANENT_LIMIT..=LARGEST_MOVE).contains(&moved) && self.worst_error <= RESONANCE_ERROR;
        let harms = self.of_kinetic >= KINETIC_LIMIT || self.bound().is_none_or(|bound| bound >= PERMANENT_LIMIT);
        let off = |(turns, steps): (u32, u32)| (1.0 / turning.steps() - f64::from(turns) / f64::from(steps)).abs();
        RESONANCES.into_iter().find(|&resonance| moves && harms && off(resonance) <= RESONANCE_WIDTH)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Bounded => f.write_str("bounded"),
            Verdict::NearResonance { turns, steps } => {
                write!(f, "the step size is near the resonance {turns}/{steps}")
            }
            Verdict::Drifts => f.write_str("the modified energy drifts"),
            Verdict::NotTheGradient => f.write_str("the forces are not the gradient of the energy"),
            Verdict::NotSmooth => f.write_str("the forces are not smooth"),
            Verdict::NotConserved => f.write_str("the modified energy is not conserved"),
            Verdict::Inconsistent => f.write_str("the states do not belong to the increments"),
            Verdict::TooLarge(_) => f.write_str("the step size is too large"),
            Verdict::RoundOff => f.write_str("the energy error is round-off"),
            Verdict::Undecided(_) => f.write_str("undecided"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDED: Evidence = Evidence {
        moved: 1e-9,
        resolution: 1e-9,
        excluded: 4e-9,
        worst_error: 1e-9,
        energy_change: None,
        modified_change: None,
        kick: 1e-14,
        round_off: 1e-12,
        offset: 0.0,
        error_rms: 1e-9,
        distance: 1.0,
        last_term: 1.0,
        of_kinetic: 0.1,
        action: 1.0,
        turning: None,
        turns: 100.0,
        fastest_angle: None,
        lost: false,
        trend: Some(Trend::RandomWalk),
        straight: false,
        rough: false,
        has_errors: true,
        moves: true,
        mismatches: false,
        wrong_rate: false,
        finite: true,
        windows: Verdict::LEAST_WINDOWS,
    };

    const MOVES: Verdict = Verdict::TooLarge(Criterion::Moved);
    const UNRESOLVED: Verdict = Verdict::Undecided(Missing::Resolution);

    fn turning(steps: f64, irregular: f64) -> Option<Turning> {
        Some(Turning { angle: std::f64::consts::TAU / steps, irregular, round_off: 0.0 })
    }

    #[test]
    fn each_threshold_decides() {
        let moved = |moved| Evidence { moved, excluded: moved + 3e-9, ..BOUNDED }.verdict();
        assert_eq!(BOUNDED.verdict(), Verdict::Bounded);
        assert_eq!(Evidence { windows: 15, ..BOUNDED }.verdict(), Verdict::Undecided(Missing::Windows));
        assert_eq!(
            [0.24, 0.26, 0.49, 0.5, 1.6].map(moved),
            [Verdict::Bounded, UNRESOLVED, UNRESOLVED, MOVES, UNRESOLVED]
        );
        assert_eq!(Evidence { of_kinetic: 0.4, ..BOUNDED }.verdict(), Verdict::TooLarge(Criterion::EnergyError));
        let small = Evidence { moved: 0.5, excluded: 0.5, of_kinetic: 0.04, ..BOUNDED };
        assert_eq!(small.verdict(), Verdict::NotConserved);
        let moves = Evidence { moved: 0.6, excluded: 0.6, ..BOUNDED };
        let others = [
            Evidence { worst_error: 0.3, ..moves },
            Evidence { has_errors: false, ..moves },
            Evidence { trend: Some(Trend::Steady), ..moves },
        ];
        assert_eq!(others.map(|other| other.verdict()), [UNRESOLVED; 3]);
        assert_eq!(Evidence { rough: true, ..moves }.verdict(), Verdict::NotSmooth);
        assert_eq!(Evidence { turning: turning(20.0, 0.0), ..moves }.verdict(), UNRESOLVED, "not by the step size");
        assert_eq!(
            Evidence {
                distance: 0.05,
                last_term: 1e-3,
                error_rms: 0.1,
                rough: true,
                turning: turning(20.0, 0.0),
                ..BOUNDED
            }
            .verdict(),
            Verdict::NotTheGradient
        );
    }

    /// What no estimate resolves the means of H may exclude, whichever estimator there is.
    #[test]
    fn the_means_of_the_energy_decide_what_estimates_do_not() {
        let blind = Evidence { moved: 0.0, resolution: 500.0, excluded: 1900.0, worst_error: 500.0, ..BOUNDED };
        let by = |value, error| Evidence { energy_change: Some(Change { value, error, of_ends: 0.0 }), ..blind };
        assert_eq!([by(0.02, 0.05).verdict(), by(0.02, 0.09).verdict()], [Verdict::Bounded, UNRESOLVED]);
        assert_eq!(by(0.02, 0.05).bound(), Some(0.02 + 3.0 * 0.05));
        let advice = Evidence { turning: turning(20.0, 0.0), ..by(0.0, 0.1) }.advice(8).unwrap();
        // 1.2 (0.3/0.25)² is 1.7; sin²(π/10) = 1/10.5, and ln(500 · 20)/ln 10.5 is 3.9
        assert_eq!(advice, Advice { length: 2, order: Some(12) });
        assert_eq!(Evidence { turning: turning(3.9, 0.0), ..by(0.0, 0.1) }.advice(8).unwrap().order, None);
        assert_eq!(by(0.02, 0.05).advice(8), None);
    }

    #[test]
    fn a_move_that_round_off_explains_is_round_off() {
        let of = |moved, round_off| Evidence { moved, excluded: moved + 3e-9, round_off, ..BOUNDED }.verdict();
        assert_eq!(of(0.6, 0.1), Verdict::RoundOff);
        assert_eq!(of(0.2, 0.1), Verdict::Bounded, "the energy error is the method's, mostly");
        assert_eq!(of(0.6, 0.05), MOVES);
        // a short run: estimates are off by several kicks, while few have moved the energy
        let short = Evidence { worst_error: 0.6, kick: 0.1, round_off: 0.3, ..BOUNDED };
        assert_eq!(short.verdict(), Verdict::RoundOff);
        let lost = |of_kinetic| Evidence { lost: true, of_kinetic, ..short }.verdict();
        assert_eq!(lost(0.39), Verdict::TooLarge(Criterion::Lost));
        assert_eq!(lost(0.4), Verdict::TooLarge(Criterion::EnergyError), "the energy grows, and its round-off with it");
    }

    #[test]
    fn a_resonance_is_a_move_and_a_regular_turn() {
        let of = |moved, turning| Evidence { moved, excluded: moved + 3e-9, turning, ..BOUNDED }.verdict();
        assert_eq!(of(0.3, turning(4.05, 0.0)), Verdict::NearResonance { turns: 1, steps: 4 });
        assert_eq!(of(0.3, turning(2.52, 0.0)), Verdict::NearResonance { turns: 2, steps: 5 });
        assert_eq!(of(1e-9, turning(4.05, 0.0)), Verdict::Bounded);
        assert_eq!(of(0.6, turning(4.05, 0.3)), MOVES);
        assert_eq!(of(0.6, turning(4.5, 0.0)), MOVES);
    }

    #[test]
    fn what_the_scheme_cannot_have_done() {
        assert_eq!(
            Evidence { finite: false, windows: 3, ..BOUNDED }.verdict(),
            Verdict::TooLarge(Criterion::NotFinite)
        );
        assert_eq!(Evidence { mismatches: true, ..BOUNDED }.verdict(), Verdict::Inconsistent);
        assert_eq!(Evidence { moved: 1001.0, turning: turning(20.0, 0.0), ..BOUNDED }.verdict(), Verdict::Inconsistent);
        // of a circle in 20 steps θ²T/12 is some 0.8 of this energy error
        let off = |offset| Evidence { offset, of_kinetic: 1e-2, turning: turning(20.0, 0.0), ..BOUNDED };
        assert_eq!([off(1.6).verdict(), off(1.7).verdict()], [BOUNDED.verdict(), Verdict::Inconsistent]);
        assert_eq!(Evidence { turns: 0.9, ..off(1.7) }.verdict(), BOUNDED.verdict(), "H has not come back yet");
        // round-off of p may have made θ² smaller by as much as it is
        let unsure = off(1.7).turning.map(|turning| Turning { round_off: turning.angle.powi(2), ..turning });
        let unsure = |offset| Evidence { turning: unsure, ..off(offset) };
        assert_eq!([unsure(3.2).verdict(), unsure(3.4).verdict()], [BOUNDED.verdict(), Verdict::Inconsistent]);
        // H − H̄ of forces that are not smooth; θ²T/6 is 16 of an energy error of 1e-3
        let rough = |distance, of_kinetic| Evidence { rough: true, distance, error_rms: 1.0, of_kinetic, ..off(0.0) };
        assert_eq!(
            [rough(2.9, 1e-2).verdict(), rough(3.1, 1e-2).verdict()],
            [BOUNDED.verdict(), Verdict::Inconsistent]
        );
        assert_eq!(
            [rough(16.0, 1e-3).verdict(), rough(17.0, 1e-3).verdict()],
            [BOUNDED.verdict(), Verdict::Inconsistent]
        );
        assert_eq!(Evidence { turns: 0.9, ..rough(17.0, 1e-3) }.verdict(), BOUNDED.verdict());
        assert_eq!(Evidence { resolution: 0.6, excluded: 1.8, ..off(1.7) }.verdict(), UNRESOLVED);
        assert_eq!(
            Evidence { action: 0.3, ..off(1.7) }.verdict(),
            BOUNDED.verdict(),
            "more than a third of a turn a step"
        );
        let drift = |moved| Evidence { moved, straight: true, ..BOUNDED }.verdict();
        assert_eq!([drift(1e-4), drift(1e-2), drift(0.2)], [Verdict::Bounded, Verdict::Drifts, Verdict::Drifts]);
    }

    #[test]
    fn no_energy_error_at_all_is_bounded() {
        let infinite = f64::INFINITY;
        let free = Evidence { moved: infinite, kick: infinite, round_off: infinite, of_kinetic: 0.0, ..BOUNDED };
        assert_eq!(free.verdict(), Verdict::Bounded);
        // at rest: 0 of 0
        let nothing = f64::NAN;
        let rest = Evidence {
            moved: nothing,
            kick: nothing,
            round_off: nothing,
            of_kinetic: nothing,
            moves: false,
            ..BOUNDED
        };
        assert_eq!(rest.verdict(), Verdict::Bounded);
        assert_eq!(Evidence { moves: true, ..rest }.verdict(), Verdict::TooLarge(Criterion::EnergyError));
    }
}
