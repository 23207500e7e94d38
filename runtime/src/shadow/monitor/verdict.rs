//! What a report comes to: the thresholds, and what they were taken from.

use std::fmt;

use super::recent::Turning;

/// How the step size does for a run.
///
/// A verdict looks at how far the modified energy H̄ [surely moved](super::Report::moved), at its errors, and at what round-off
/// is expected to move it by, all as parts of the energy error, max − min of H; and at the energy error as a part of the mean
/// kinetic energy T. The first that holds is given:
///
/// | verdict | if |
/// | --- | --- |
/// | too large: not finite | a state or an energy is not finite, or the sums overflow |
/// | undecided | there are fewer than 16 windows |
/// | inconsistent | the steps of a window do not add what [they say](super::Report::misfits); or, beyond errors and round-off, the range of H − H̄ is as far from 0 as θ²T/6 and half of the energy error, θ the angle of the fastest motion in a step; or H̄ moved by twice the energy error |
/// | round-off | moves or errors are half of the energy error, and no more than 10 times what round-off makes |
/// | near a resonance | H̄ moved by 0.001 or more, beyond that, and the fastest motion is one oscillation that turns once in 3, 4, 5, 6 or 5/2 steps, to 0.006 turns a step |
/// | drifts | H̄ moved by 1e-6 or more, beyond that, in a straight line |
/// | too large: moves | H̄ moved by 0.05 or more, beyond that |
/// | too large: not resolved | in some 1/32 to 1/64 of the run no window knows H̄ to 0.05 |
/// | too large: energy error | the energy error is half of T or more; or T is 0 in all windows, and q changes |
/// | fine | none of these |
///
/// **The thresholds come from measurement**: 50 000 steps of each shipped problem with a window in 20 of them, E_8 with its error,
/// and Störmer–Verlet where nothing else is said.
///
/// | | H̄ moved by | errors | of T | steps a turn | verdict |
/// | --- | --- | --- | --- | --- | --- |
/// | oscillator, hω = 0.5 | 0 | 2e-8 | 0.13 | 12.4 | fine |
/// | hω = 1.17557 = 2 sin(π/5) | 0 | 4e-4 | 0.89 | 5.000 | too large: energy error |
/// | hω = 1.99 | 0 | 3e-3 | 200 | 2.14 | too large: energy error |
/// | pendulum, p = 0.3, h = 0.8 | 0 | 5e-5 | 0.38 | 7.69 | fine |
/// | h = 1.01 | 0.011 | 1e-3 | 0.66 | 5.985 | near a resonance, 1/6 |
/// | h = 1.03 | 0 | 2e-3 | 0.71 | 5.86 | too large: energy error |
/// | h = 1.42 | 0.55 | 0.02 | 2.4 | 4.048 | near a resonance, 1/4 |
/// | h = 1.5 | 0 | 0.05 | 2.6 | 3.77 | too large: not resolved |
/// | p = 1, h = 1.5: chaos | 0.91 | 8e-3 | 6.9 | 4.27, irregular | too large: moves |
/// | p = 2, h = 0.1: the separatrix | 3e-9 | 3e-12 | 0.009 | 36 | fine |
/// | Kepler, e = 0.6, h = 1/100 | 1e-10 | 9e-13 | 7e-4 | 84 | fine |
/// | h = 1/20 | 7e-12 | 3e-14 | 0.019 | 17 | fine |
/// | h = 1/10 | 2e-5 | 7e-15 | 0.086 | 8.8 | fine |
/// | h = 1/7 | 3e-3 | 3e-15 | 0.21 | 6.8 | fine |
/// | h = 1/7, Yoshida 4 | 0.035 | 3e-14 | 0.026 | 6.8 | fine |
/// | h = 1/5 | 0.72 | 3e-16 | 7.5 | 5.6, irregular | too large: moves |
/// | h = 1/200, Blanes–Moan S6 | 1e-4 | 1e-6 | 5e-10 | 167 | fine |
/// | e = 0, h = 1/2000 | 0.80 | 0.012 | 5e-14 | 12567 | round-off |
/// | e = 0.9, h = 1/200 | 2e-12 | 9e-15 | 0.067 | 18 | fine |
/// | e = 0.9, 0.99, h = 1/20: escape | 3e-14, 5e-13 | 1e-15 | 1.0 | | too large: energy error |
/// | Hénon–Heiles, p = (0.1, 0), h = 1/2 | 0 | 1e-7 | 0.14 | 12.2 | fine |
/// | p = (0.5, 0.2): chaos, h = 0.7 | 0.015 | 6e-4 | 0.45 | 6.1, irregular | fine |
/// | p = (0.3, 0.3), h = 0.9 | 0.18 | 8e-3 | 0.89 | 5.5, irregular | too large: moves |
/// | Pythagorean, h = 1/10000 | 5e-5 | 9e-15 | 0.14 | 9.0 | fine |
/// | h = 1/1000, 1/100 | 1.0 | 5e-16 | 1.0 | | too large: moves |
/// | stiff chain, h = 0.001 | 1e-10 | 2e-12 | 5e-4 | 126 | fine |
/// | h = 0.0235 | 0 | 4e-4 | 0.41 | 5.000 | fine |
/// | h = 0.03 | 0 | 5e-3 | 0.88 | 3.70 | too large: energy error |
/// | argon crystal, h = 4e-5 | 2e-5 | 2e-9 | 0.040 | 14.8 | fine |
/// | h = 6e-5 | 0.018 | 5e-7 | 0.097 | 10.2 | fine |
/// | h = 8e-5 | 0.31 | 4e-5 | 0.23 | 7.9, irregular | too large: moves |
/// | outer solar system, h = 100, 200 days | 1e-10, 2e-7 | 2e-12, 5e-10 | 8e-4, 2e-3 | 42, 22 | fine |
/// | h = 600 days | 0 | 1e-3 | 0.060 | 7.7 | fine |
/// | h = 800, 1000, 1200 days | 0.89, 0.41, 0.31 | 1e-6 | 2.3 … 4.0 | | too large: moves |
///
/// Where no trouble is near, H̄ moves by 0.035 of the energy error or less, and in trouble by 0.11 or more. For the harmonic
/// oscillator the energy error is 2x²/(1 − x²) of T, x = hω/2: half of it at hω = 0.89, or 6.8 steps a turn, whatever becomes
/// of H̄, which is conserved up to hω = 2.
///
/// The range of H − H̄ mostly has 0 in it, and is off it where nothing swings: by θ²T/12 at most, which the circular orbit has, and
/// the outer planets nearly, and Kepler at e = 0.1 by 0.031 θ²T. With β forgotten, Kepler at e = 0.6, h = 1/20 is off by
/// 7.6 θ²T; with the monitor told 1/19, by 0.37 θ²T, and told 1/22, by 0.62 θ²T.
///
/// **What it cannot see:**
/// - steady drifts below 1e-6 of the energy error: the slow oscillation of the outer planets' H̄ at 200 days looks like one, and
///   makes 2e-7; the report then says that H̄ moves like t, and not that it is bounded;
/// - a step size that is told wrong by less than θ²/6 or so;
/// - moves of H̄ below three times the errors of its estimates: of the resonance 1/6 of the pendulum at h = 1.015 E_8 sees
///   nothing, and E_16 a move of 0.004;
/// - resonances of slow motions, and of oscillations that have little of the momentum: the turning is that of the second
///   differences of p, over all coordinates at once;
/// - what happens between windows and leaves no trace, and what happens before the first one if it is small beside T;
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
    /// The modified energy changes steadily, by what is no round-off: something other than the scheme and its forces is at work.
    Drifts,
    /// The states do not come from steps of this h that carry β.
    Inconsistent,
    /// No modified energy is conserved well enough to speak of, or it says nothing of the energy.
    TooLarge(Sign),
    /// The energy error is round-off, not the method's: a larger step would do, or more digits are needed.
    RoundOff,
    /// There are too few windows.
    Undecided,
}

/// By what a step is seen to be too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// The modified energy moves.
    Moved,
    /// The modified energy cannot be told.
    NotResolved,
    /// The energy error is as large as the energy that moves.
    EnergyError,
    /// A state or an energy is not finite.
    NotFinite,
}

/// Windows that a verdict needs.
pub(super) const LEAST_WINDOWS: u64 = 16;
/// What of the energy error is too much for H̄ to move, or not to be known.
const MUCH: f64 = 0.05;
/// What of it is enough to look for a resonance.
const SOME: f64 = 1e-3;
/// What of it is enough for a steady drift.
const LITTLE: f64 = 1e-6;
/// What of θ²T, and of the energy error, H − H̄ may be off 0: up to 1/12 of θ²T was measured.
const OFFSET_OF_TURNING: f64 = 1.0 / 6.0;
const OFFSET: f64 = 0.5;
/// What of the energy error H̄ may move by: without a modified energy it was 1.0.
const MORE_THAN_ALL: f64 = 2.0;
/// How many times its error an estimate may be off.
const OF_ERROR: f64 = 3.0;
/// What of it has to be round-off for the verdict to be that.
const MOST: f64 = 0.5;
/// What of the mean kinetic energy is too much for the energy error.
const LARGE_ERROR: f64 = 0.5;
/// How many times what is expected of round-off may be round-off.
const OF_ROUND_OFF: f64 = 10.0;
/// The error that round-off makes in an estimate, in kicks of one step: 3 to 8 were measured.
const KICKS_IN_AN_ESTIMATE: f64 = 10.0;
/// How many turns a step a frequency may be off a resonance.
const OFF_RESONANCE: f64 = 0.006;
/// Turns and steps of the resonances of low order, which are the strong ones.
const RESONANCES: [(u32, u32); 5] = [(1, 3), (1, 4), (1, 5), (1, 6), (2, 5)];
/// How irregular a motion may be that is taken for one oscillation: the chaotic pendulum's is 0.17 or more.
const IRREGULAR: f64 = 0.1;

/// What a verdict looks at; all up to `offset` as parts of the energy error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evidence {
    /// How far H̄ surely moved.
    pub(super) moved: f64,
    /// The largest error of the quietest estimate of a block.
    pub(super) worst_error: f64,
    /// What round-off is expected to move H̄ by, in one step and in all.
    pub(super) kick: f64,
    pub(super) round_off: f64,
    /// How far the range of H − H̄ is from 0.
    pub(super) offset: f64,
    /// The energy error as a part of the mean kinetic energy.
    pub(super) of_kinetic: f64,
    pub(super) turning: Option<Turning>,
    /// Whether H̄ goes in a straight line.
    pub(super) straight: bool,
    /// Whether errors are known.
    pub(super) has_errors: bool,
    /// Whether q changes.
    pub(super) moves: bool,
    /// Whether a step added something else than it says.
    pub(super) misfits: bool,
    /// Whether all states and energies are finite.
    pub(super) finite: bool,
    pub(super) windows: u64,
}

impl Evidence {
    /// Of an energy error of 0 nothing is a part.
    pub(super) fn verdict(&self) -> Verdict {
        let (moved, worst_error) = (self.moved_beyond_round_off(), self.beyond_round_off(self.worst_error));
        let round_off = self.moved.max(self.worst_error).max(self.round_off);
        if !self.finite {
            Verdict::TooLarge(Sign::NotFinite)
        } else if self.windows < LEAST_WINDOWS {
            Verdict::Undecided
        } else if self.is_inconsistent() {
            Verdict::Inconsistent
        } else if self.of_kinetic == 0.0 {
            Verdict::Fine
        } else if self.of_kinetic.is_nan() {
            // 0 of 0: at rest, or from one turning point to the next
            if self.moves { Verdict::TooLarge(Sign::EnergyError) } else { Verdict::Fine }
        } else if moved == 0.0 && worst_error == 0.0 && round_off >= MOST {
            Verdict::RoundOff
        } else if let Some((turns, steps)) = self.resonance().filter(|_| moved >= SOME) {
            Verdict::NearResonance { turns, steps }
        } else if self.straight && moved >= LITTLE {
            Verdict::Drifts
        } else if moved >= MUCH {
            Verdict::TooLarge(Sign::Moved)
        } else if worst_error >= MUCH {
            Verdict::TooLarge(Sign::NotResolved)
        } else if self.of_kinetic >= LARGE_ERROR {
            Verdict::TooLarge(Sign::EnergyError)
        } else {
            Verdict::Fine
        }
    }

    /// A part of the energy error, or 0 if it may be round-off.
    fn beyond_round_off(&self, part: f64) -> f64 {
        let expected = OF_ROUND_OFF * self.round_off.max(KICKS_IN_AN_ESTIMATE * self.kick);
        if part > expected { part } else { 0.0 }
    }

    pub(super) fn moved_beyond_round_off(&self) -> f64 {
        self.beyond_round_off(self.moved)
    }

    /// θ is taken for 1 where it is not known.
    fn is_inconsistent(&self) -> bool {
        let angle = self.turning.map_or(1.0, |turning| turning.angle);
        let most = (OFFSET_OF_TURNING * angle * angle / self.of_kinetic).max(OFFSET).max(OF_ERROR * self.worst_error);
        // moves of which no errors are known may all be errors
        let moves_too_much = self.has_errors && self.moved_beyond_round_off() > MORE_THAN_ALL;
        self.misfits || moves_too_much || self.beyond_round_off(self.offset) > most
    }

    fn resonance(&self) -> Option<(u32, u32)> {
        let turning = self.turning.filter(|turning| turning.irregular <= IRREGULAR)?;
        let off = |(turns, steps): (u32, u32)| (1.0 / turning.steps() - f64::from(turns) / f64::from(steps)).abs();
        RESONANCES.into_iter().find(|&resonance| off(resonance) <= OFF_RESONANCE)
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
            Verdict::Inconsistent => f.write_str("the steps are not those that the monitor was told of"),
            Verdict::TooLarge(_) => f.write_str("the step size is too large here"),
            Verdict::RoundOff => f.write_str("the energy error is round-off"),
            Verdict::Undecided => f.write_str("no verdict yet"),
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
        misfits: false,
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
        assert_eq!((moved(0.049), moved(0.05)), (Verdict::Fine, Verdict::TooLarge(Sign::Moved)));
        assert_eq!(Evidence { worst_error: 0.05, ..FINE }.verdict(), Verdict::TooLarge(Sign::NotResolved));
        assert_eq!(Evidence { of_kinetic: 0.5, ..FINE }.verdict(), Verdict::TooLarge(Sign::EnergyError));
    }

    #[test]
    fn a_move_that_round_off_explains_is_round_off() {
        let of = |moved, round_off| Evidence { moved, round_off, ..FINE }.verdict();
        assert_eq!(of(0.6, 0.1), Verdict::RoundOff);
        assert_eq!(of(0.3, 0.1), Verdict::Fine, "the energy error is the method's, mostly");
        assert_eq!(of(0.6, 0.05), Verdict::TooLarge(Sign::Moved));
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
        assert_eq!(of(0.2, turning(4.05, 0.3)), Verdict::TooLarge(Sign::Moved));
        assert_eq!(of(0.2, turning(4.5, 0.0)), Verdict::TooLarge(Sign::Moved));
    }

    #[test]
    fn what_the_scheme_cannot_have_done() {
        assert_eq!(Evidence { finite: false, windows: 3, ..FINE }.verdict(), Verdict::TooLarge(Sign::NotFinite));
        assert_eq!(Evidence { misfits: true, ..FINE }.verdict(), Verdict::Inconsistent);
        assert_eq!(Evidence { moved: 2.1, ..FINE }.verdict(), Verdict::Inconsistent);
        // of a circle in 20 steps θ²T/12 is some 0.8 of this energy error
        let off = |offset, worst_error| Evidence { offset, worst_error, turning: turning(20.0, 0.0), ..FINE }.verdict();
        assert_eq!(
            [off(1.6, 0.0), off(1.7, 0.0), off(1.7, 0.6)],
            [FINE.verdict(), Verdict::Inconsistent, Verdict::TooLarge(Sign::NotResolved)]
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
        assert_eq!(Evidence { moves: true, ..rest }.verdict(), Verdict::TooLarge(Sign::EnergyError));
    }
}
