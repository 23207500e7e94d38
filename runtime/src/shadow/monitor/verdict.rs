//! The verdict on the step size, and its thresholds.

use std::fmt;

use super::recent::Turning;

/// The conclusion about the step size of a run.
///
/// A verdict depends on how far the modified energy H̄ [moved beyond its errors](super::Report::moved), on these errors, and on the
/// expected effect of round-off, all as parts of the energy error, max − min of H; and on the energy error as a part of the mean
/// kinetic energy T. The first that applies is given:
///
/// | verdict | if |
/// | --- | --- |
/// | too large: not finite | a state or an energy is not finite, or the sums overflow |
/// | undecided | there are fewer than 16 windows |
/// | inconsistent | the states of a window differ from [their increments](super::Report::mismatches); or, beyond errors and round-off, the range of H − H̄ is as far from 0 as θ²T/6 and half of the energy error, θ the angle of the fastest motion in a step; or H̄ moved by twice the energy error |
/// | round-off | moves or errors are half of the energy error, and no more than 10 times what round-off makes |
/// | near a resonance | H̄ moved by 0.001 or more, beyond that, and the fastest motion is one oscillation that turns once in 3, 4, 5, 6 or 5/2 steps, to 0.006 turns a step |
/// | drifts | H̄ moved by 1e-6 or more, beyond that, in a straight line |
/// | too large: moves | H̄ moved by 0.05 or more, beyond that |
/// | too large: not resolved | in some 1/32 to 1/64 of the run no window knows H̄ to 0.05 |
/// | too large: energy error | the energy error is half of T or more; or T is 0 in all windows, and q changes |
/// | fine | none of these |
///
/// The thresholds come from measurements of all shipped problems at step sizes from fine to unstable: `docs/monitor.md`.
///
/// **What it cannot detect:**
/// - linear trends below 1e-6 of the energy error: the slow oscillation of the outer planets' H̄ at 200 days looks like one, and
///   makes 2e-7; the report then states that H̄ changes linearly, and not that it is bounded;
/// - moves of H̄ below three times the errors of its estimates: of the resonance 1/6 of the pendulum at h = 1.015 E_8 detects
///   nothing, and E_16 a move of 0.004;
/// - resonances of slow motions, and of oscillations with a small part of the momentum: the angle θ is that of the second
///   differences of p, over all coordinates at once;
/// - what happens between windows without a lasting effect, and what happens before the first one if it is small beside T;
/// - without errors ([`Bilinear::new`](crate::shadow::Bilinear::new)), which changes of the estimates are their errors: all of
///   them count as moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The modified energy is conserved: the energy error is the method's, and stays bounded.
    Fine,
    /// The modified energy changes, and the fastest oscillation turns nearly `turns` times in `steps` steps.
    NearResonance {
        /// m of m/n: 1 or 2.
        turns: u32,
        /// n of m/n: 3 to 6.
        steps: u32,
    },
    /// The modified energy changes linearly in time, by more than round-off: something other than the scheme and its forces acts.
    Drifts,
    /// The states do not belong to the increments: plain steps were made where augmented ones were needed, or the state was changed
    /// between the steps.
    Inconsistent,
    /// No modified energy is conserved well enough, or it says nothing about the energy.
    TooLarge(Criterion),
    /// The energy error is round-off, not the method's: a larger step size is sufficient, or more digits are needed.
    RoundOff,
    /// There are too few windows.
    Undecided,
}

/// The criterion by which a step size is too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// The modified energy moves.
    Moved,
    /// The modified energy is not resolved by its estimates.
    NotResolved,
    /// The energy error is as large as the kinetic energy.
    EnergyError,
    /// A state or an energy is not finite.
    NotFinite,
}

/// Windows that a verdict needs.
pub(super) const LEAST_WINDOWS: u64 = 16;
/// A move of H̄, or an error of its estimates, is too large from this part of the energy error on.
const CONSERVATION_LIMIT: f64 = 0.05;
/// A resonance is reported if H̄ moves by this part of the energy error or more.
const RESONANCE_MOVE: f64 = 1e-3;
/// A linear trend is reported if H̄ moves by this part of the energy error or more.
const LINEAR_MOVE: f64 = 1e-6;
/// The range of H − H̄ may be off 0 by this part of θ²T (up to 1/12 was measured), or of the energy error.
const OFFSET_PER_TURNING: f64 = 1.0 / 6.0;
const OFFSET_LIMIT: f64 = 0.5;
/// Steps with their increments move H̄ by less than this part of the energy error: without a modified energy by 1.0.
const INCONSISTENT_MOVE: f64 = 2.0;
/// An estimate may be wrong by this many times its error.
const ERROR_FACTOR: f64 = 3.0;
/// The verdict is round-off if that makes this part of the energy error or more.
const ROUND_OFF_PART: f64 = 0.5;
/// The energy error is too large from this part of the mean kinetic energy on.
const KINETIC_LIMIT: f64 = 0.5;
/// Round-off may be this many times what is expected.
const ROUND_OFF_FACTOR: f64 = 10.0;
/// The error that round-off makes in an estimate, in kicks of one step: 3 to 8 were measured.
const KICKS_IN_AN_ESTIMATE: f64 = 10.0;
/// The distance of a frequency from a resonance, in turns a step, at which it is taken for it.
const RESONANCE_WIDTH: f64 = 0.006;
/// Turns and steps of the resonances of low order, which are the strong ones.
const RESONANCES: [(u32, u32); 5] = [(1, 3), (1, 4), (1, 5), (1, 6), (2, 5)];
/// A motion up to this irregularity is taken for one oscillation: the chaotic pendulum's is 0.17 or more.
const IRREGULARITY_LIMIT: f64 = 0.1;

/// The numbers that a verdict is based on; all up to `offset` as parts of the energy error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evidence {
    /// How far H̄ moved beyond its errors.
    pub(super) moved: f64,
    /// The largest error of the most accurate estimate of a block.
    pub(super) worst_error: f64,
    /// The expected effect of round-off on H̄, in one step and in all.
    pub(super) kick: f64,
    pub(super) round_off: f64,
    /// The distance of the range of H − H̄ from 0.
    pub(super) offset: f64,
    /// The energy error as a part of the mean kinetic energy.
    pub(super) of_kinetic: f64,
    pub(super) turning: Option<Turning>,
    /// Whether H̄ is a linear function of time.
    pub(super) straight: bool,
    /// Whether errors are known.
    pub(super) has_errors: bool,
    /// Whether q changes.
    pub(super) moves: bool,
    /// Whether a state differs from its increments.
    pub(super) mismatches: bool,
    /// Whether all states and energies are finite.
    pub(super) finite: bool,
    pub(super) windows: u64,
}

impl Evidence {
    /// The first verdict whose condition holds; an energy error of 0 has no parts.
    pub(super) fn verdict(&self) -> Verdict {
        let (moved, worst_error) = (self.moved_beyond_round_off(), self.beyond_round_off(self.worst_error));
        let round_off = self.moved.max(self.worst_error).max(self.round_off);
        if !self.finite {
            Verdict::TooLarge(Criterion::NotFinite)
        } else if self.windows < LEAST_WINDOWS {
            Verdict::Undecided
        } else if self.is_inconsistent() {
            Verdict::Inconsistent
        } else if self.of_kinetic == 0.0 {
            Verdict::Fine
        } else if self.of_kinetic.is_nan() {
            // 0 of 0: at rest, or from one turning point to the next
            if self.moves { Verdict::TooLarge(Criterion::EnergyError) } else { Verdict::Fine }
        } else if moved == 0.0 && worst_error == 0.0 && round_off >= ROUND_OFF_PART {
            Verdict::RoundOff
        } else if let Some((turns, steps)) = self.resonance().filter(|_| moved >= RESONANCE_MOVE) {
            Verdict::NearResonance { turns, steps }
        } else if self.straight && moved >= LINEAR_MOVE {
            Verdict::Drifts
        } else if moved >= CONSERVATION_LIMIT {
            Verdict::TooLarge(Criterion::Moved)
        } else if worst_error >= CONSERVATION_LIMIT {
            Verdict::TooLarge(Criterion::NotResolved)
        } else if self.of_kinetic >= KINETIC_LIMIT {
            Verdict::TooLarge(Criterion::EnergyError)
        } else {
            Verdict::Fine
        }
    }

    /// A part of the energy error, or 0 if it may be round-off.
    fn beyond_round_off(&self, part: f64) -> f64 {
        let expected = ROUND_OFF_FACTOR * self.round_off.max(KICKS_IN_AN_ESTIMATE * self.kick);
        if part > expected { part } else { 0.0 }
    }

    pub(super) fn moved_beyond_round_off(&self) -> f64 {
        self.beyond_round_off(self.moved)
    }

    /// θ is taken for 1 where it is not known.
    fn is_inconsistent(&self) -> bool {
        let angle = self.turning.map_or(1.0, |turning| turning.angle);
        let most = (OFFSET_PER_TURNING * angle * angle / self.of_kinetic)
            .max(OFFSET_LIMIT)
            .max(ERROR_FACTOR * self.worst_error);
        // moves of which no errors are known may all be errors
        let moves_too_much = self.has_errors && self.moved_beyond_round_off() > INCONSISTENT_MOVE;
        self.mismatches || moves_too_much || self.beyond_round_off(self.offset) > most
    }

    fn resonance(&self) -> Option<(u32, u32)> {
        let turning = self.turning.filter(|turning| turning.irregular <= IRREGULARITY_LIMIT)?;
        let off = |(turns, steps): (u32, u32)| (1.0 / turning.steps() - f64::from(turns) / f64::from(steps)).abs();
        RESONANCES.into_iter().find(|&resonance| off(resonance) <= RESONANCE_WIDTH)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Fine => f.write_str("the step size is fine"),
            Verdict::NearResonance { turns, steps } => {
                write!(f, "the step size is near the resonance {turns}/{steps}")
            }
            Verdict::Drifts => f.write_str("the modified energy drifts"),
            Verdict::Inconsistent => f.write_str("the states do not belong to the increments"),
            Verdict::TooLarge(_) => f.write_str("the step size is too large"),
            Verdict::RoundOff => f.write_str("the energy error is round-off"),
            Verdict::Undecided => f.write_str("undecided"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FINE: Evidence = Evidence {
        moved: 1e-9,
        worst_error: 1e-9,
        kick: 1e-14,
        round_off: 1e-12,
        offset: 0.0,
        of_kinetic: 1e-2,
        turning: None,
        straight: false,
        has_errors: true,
        moves: true,
        mismatches: false,
        finite: true,
        windows: LEAST_WINDOWS,
    };

    fn turning(steps: f64, irregular: f64) -> Option<Turning> {
        Some(Turning { angle: std::f64::consts::TAU / steps, irregular })
    }

    #[test]
    fn each_threshold_decides() {
        let moved = |moved| Evidence { moved, ..FINE }.verdict();
        assert_eq!(FINE.verdict(), Verdict::Fine);
        assert_eq!(Evidence { windows: 15, ..FINE }.verdict(), Verdict::Undecided);
        assert_eq!((moved(0.049), moved(0.05)), (Verdict::Fine, Verdict::TooLarge(Criterion::Moved)));
        assert_eq!(Evidence { worst_error: 0.05, ..FINE }.verdict(), Verdict::TooLarge(Criterion::NotResolved));
        assert_eq!(Evidence { of_kinetic: 0.5, ..FINE }.verdict(), Verdict::TooLarge(Criterion::EnergyError));
    }

    #[test]
    fn a_move_that_round_off_explains_is_round_off() {
        let of = |moved, round_off| Evidence { moved, round_off, ..FINE }.verdict();
        assert_eq!(of(0.6, 0.1), Verdict::RoundOff);
        assert_eq!(of(0.3, 0.1), Verdict::Fine, "the energy error is the method's, mostly");
        assert_eq!(of(0.6, 0.05), Verdict::TooLarge(Criterion::Moved));
        // a short run: estimates are off by several kicks, while few have moved the energy
        let short = Evidence { worst_error: 0.6, kick: 0.1, round_off: 0.3, ..FINE };
        assert_eq!(short.verdict(), Verdict::RoundOff);
    }

    #[test]
    fn a_resonance_is_a_move_and_a_regular_turn() {
        let of = |moved, turning| Evidence { moved, turning, ..FINE }.verdict();
        assert_eq!(of(0.002, turning(4.05, 0.0)), Verdict::NearResonance { turns: 1, steps: 4 });
        assert_eq!(of(0.2, turning(2.52, 0.0)), Verdict::NearResonance { turns: 2, steps: 5 });
        assert_eq!(of(1e-9, turning(4.05, 0.0)), Verdict::Fine);
        assert_eq!(of(0.2, turning(4.05, 0.3)), Verdict::TooLarge(Criterion::Moved));
        assert_eq!(of(0.2, turning(4.5, 0.0)), Verdict::TooLarge(Criterion::Moved));
    }

    #[test]
    fn what_the_scheme_cannot_have_done() {
        assert_eq!(Evidence { finite: false, windows: 3, ..FINE }.verdict(), Verdict::TooLarge(Criterion::NotFinite));
        assert_eq!(Evidence { mismatches: true, ..FINE }.verdict(), Verdict::Inconsistent);
        assert_eq!(Evidence { moved: 2.1, ..FINE }.verdict(), Verdict::Inconsistent);
        // of a circle in 20 steps θ²T/12 is some 0.8 of this energy error
        let off = |offset, worst_error| Evidence { offset, worst_error, turning: turning(20.0, 0.0), ..FINE }.verdict();
        assert_eq!(
            [off(1.6, 0.0), off(1.7, 0.0), off(1.7, 0.6)],
            [FINE.verdict(), Verdict::Inconsistent, Verdict::TooLarge(Criterion::NotResolved)]
        );
        let drift = |moved| Evidence { moved, straight: true, ..FINE }.verdict();
        assert_eq!([drift(1e-7), drift(1e-5), drift(0.2)], [Verdict::Fine, Verdict::Drifts, Verdict::Drifts]);
    }

    #[test]
    fn no_energy_error_at_all_is_fine() {
        let infinite = f64::INFINITY;
        let free = Evidence { moved: infinite, kick: infinite, round_off: infinite, of_kinetic: 0.0, ..FINE };
        assert_eq!(free.verdict(), Verdict::Fine);
        // at rest: 0 of 0
        let nothing = f64::NAN;
        let rest =
            Evidence { moved: nothing, kick: nothing, round_off: nothing, of_kinetic: nothing, moves: false, ..FINE };
        assert_eq!(rest.verdict(), Verdict::Fine);
        assert_eq!(Evidence { moves: true, ..rest }.verdict(), Verdict::TooLarge(Criterion::EnergyError));
    }
}
