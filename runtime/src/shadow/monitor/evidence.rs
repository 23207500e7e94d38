//! The numbers that a verdict on windows is based on, and what follows from them.

use super::change::Change;
use super::thresholds::{
    ANGLE_LIMIT, DISTANCE_LIMIT, INCONSISTENT_MOVE, IRREGULARITY_LIMIT, KICKS_IN_AN_ESTIMATE, LARGEST_DISTANCE,
    LARGEST_MOVE, LARGEST_ORDER, LAST_TERM_LIMIT, LEAST_TURNS, LINEAR_MOVE, OFFSET_LIMIT, OFFSET_PER_TURNING,
    PERMANENT_LIMIT, PERMANENT_MOVE, RESOLVED_ACTION, RESONANCE_ERROR, RESONANCE_WIDTH, RESONANCES, ROUND_OFF_FACTOR,
    ROUND_OFF_PART, SMALL_ANGLE,
};
use super::trend::Trend;
use super::turning::Turning;
use super::verdict::{Advice, Verdict};
use crate::shadow::rules::{ERROR_FACTOR, KINETIC_LIMIT};

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
    /// Whether the energy is the same in all windows: the error is 0, or 0 of 0 at rest.
    pub(super) fn is_still(&self) -> bool {
        self.of_kinetic == 0.0 || self.of_kinetic.is_nan() && !self.moves
    }

    /// Whether there are too few windows for a verdict.
    pub(super) fn has_few_windows(&self) -> bool {
        self.windows < Verdict::LEAST_WINDOWS
    }

    /// Whether H̄ moves in a straight line by more than round-off.
    pub(super) fn drifts(&self) -> bool {
        self.straight && self.has_errors && self.moved_beyond_round_off() >= LINEAR_MOVE
    }

    /// Whether the step size can be the cause of a permanent change that is resolved.
    pub(super) fn grows(&self) -> bool {
        self.turns_fast() && self.permanent_move().is_some_and(|moved| moved >= PERMANENT_MOVE)
    }

    /// What a net change of the energy is excluded above.
    pub(super) fn bound(&self) -> Option<f64> {
        if self.has_few_windows() {
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
    pub(super) fn excludes_a_change(&self) -> bool {
        self.bound().is_some_and(|bound| bound < PERMANENT_LIMIT)
            && self.permanent_move().is_none_or(|moved| moved < PERMANENT_LIMIT)
    }

    /// What would decide an undecided verdict, for estimates of an order k or m.
    pub(super) fn advice(&self, order: u32) -> Advice {
        let bound = self.energy_change.map_or(f64::NAN, Change::bound) / PERMANENT_LIMIT;
        // standard errors fall like 1/√length; a fifth more to be below the limit
        let length = (1.2 * bound.max(1.1).powi(2)).ceil() as u64;
        Advice { length, order: self.sufficient_order(order) }
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

    fn moved_beyond_round_off(&self) -> f64 {
        self.beyond_round_off(self.moved)
    }

    pub(super) fn is_round_off(&self) -> bool {
        let estimated =
            self.moved.max(if self.beyond_round_off(self.worst_error) == 0.0 { self.worst_error } else { 0.0 });
        self.moved_beyond_round_off() == 0.0 && estimated.max(self.round_off) >= ROUND_OFF_PART
    }

    /// Moves of which no errors are known may all be errors.
    pub(super) fn moves_as_no_scheme_does(&self) -> bool {
        self.is_resolved() && self.has_errors && self.moved_beyond_round_off() > INCONSISTENT_MOVE
    }

    /// Whether H − H̄ is too large beside the energy error.
    pub(super) fn is_far_from_the_energy(&self) -> bool {
        let of_turning = self.offset_of_turning();
        let most = of_turning.max(OFFSET_LIMIT).max(f64::from(ERROR_FACTOR) * self.resolution);
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
    pub(super) fn follows_the_energy(&self) -> bool {
        let varies = self.rough && self.beyond_round_off(self.error_rms) >= LINEAR_MOVE;
        varies && self.distance <= DISTANCE_LIMIT && self.last_term <= LAST_TERM_LIMIT && self.turns_little()
    }

    /// The resonance of low order that moves H̄, if the fastest motion is near one.
    pub(super) fn resonance(&self) -> Option<Verdict> {
        let turning = self.turning.filter(|turning| turning.irregular <= IRREGULARITY_LIMIT)?;
        let moved = self.moved_beyond_round_off();
        let moves = (PERMANENT_LIMIT..=LARGEST_MOVE).contains(&moved) && self.worst_error <= RESONANCE_ERROR;
        let harms = self.of_kinetic >= KINETIC_LIMIT || self.bound().is_none_or(|bound| bound >= PERMANENT_LIMIT);
        let off = |(turns, steps): (u32, u32)| (1.0 / turning.steps() - f64::from(turns) / f64::from(steps)).abs();
        let found = RESONANCES.into_iter().find(|&resonance| moves && harms && off(resonance) <= RESONANCE_WIDTH);
        found.map(|(turns, steps)| Verdict::NearResonance { turns, steps })
    }
}
