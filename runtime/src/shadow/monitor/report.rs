//! The report of a monitor in numbers.

use super::arithmetic::quotient;
use super::roughness::Rough;
use super::trend::Trend;
use super::verdict::{Advice, Verdict};
use super::whole_run::WholeRun;
use crate::Rational;
use crate::number::Real;
use crate::shadow::rules::ERROR_FACTOR;

/// The energies of a run.
///
/// The energy error is split: H − H̄ is the method's part, and bounded; H̄ itself moves only by round-off and by what
/// the method does not conserve.
///
/// Near a close encounter the errors of the estimates of H̄ can exceed all its changes. So H̄ is followed by the most
/// accurate estimate of each of 32 to 64 equal parts of the run, that with the smallest error, and by the half of these
/// with the smaller errors.
///
/// It is printed as some lines with the numbers and [a sentence](Report::reason).
#[derive(Clone, Debug)]
pub struct Report<N> {
    /// How many steps have been made.
    pub steps: u64,
    /// The time that they took: steps times |h|.
    pub time: N,
    /// In how many windows the modified energy was estimated.
    pub windows: u64,
    /// The energy error: max − min of H, over the first state and the middles of the windows.
    pub energy_error: N,
    /// The mean kinetic energy, over four states in the distance of windows, at irregular places, or all states.
    pub kinetic: N,
    /// The least H − H̄, with the most accurate H̄ so far of the same part of the run.
    pub method_least: N,
    /// The largest H − H̄.
    pub method_largest: N,
    /// The root mean square of H − H̄.
    pub method_rms: N,
    /// The root mean square of the errors of these H̄; 0 where the estimator gives no errors.
    pub method_resolution: N,
    /// The newest accurate H̄.
    pub modified: N,
    /// The permanent change of H̄: max − min of the accurate estimates. Where H̄ oscillates with the estimates' errors,
    /// as near a resonance, these may all be of the same phase; `moved` includes all windows.
    pub range: N,
    /// The net change of H̄: the newest accurate estimate less the first one.
    pub change: N,
    /// How far H̄ moved beyond its errors: max (H̄ − 3e) − min (H̄ + 3e) over all windows with their errors e, or 0.
    pub moved: N,
    /// How H̄ depends on time, from 16 accurate estimates on.
    pub trend: Option<Trend>,
    /// A net change of the energy, from the beginning to the end of these steps, is excluded above this; `None` for
    /// fewer than 16 windows or parts of a run.
    ///
    /// It is the least of three: the range of the accurate H̄ and of those of the first and the last part of the run,
    /// and three times their errors; and |a| + 3 s of the linear change a and its standard error s, or the last mean
    /// less the first one where that is more, for the means of H and for those of all H̄, in 32 to 63 parts of the run.
    /// The means of H do not depend on the estimator. It is not below the effect of round-off.
    pub permanent_bound: Option<N>,
    /// How far H̄ moved where that is a permanent change: beyond errors and round-off, and not back and forth.
    pub permanent_change: Option<N>,
    /// The forces, where they are not smooth.
    pub rough: Option<Rough>,
    /// What would decide a verdict that is undecided.
    pub advice: Option<Advice>,
    /// The resolution: the largest error of the accurate estimates; `None` where the estimator gives no errors.
    pub resolution: Option<N>,
    /// The largest error of the most accurate estimate of a part of the run.
    pub worst_error: Option<N>,
    /// The effect of round-off on the energy in one step, rms.
    ///
    /// δH = U_qᵀδq + T_pᵀδp with δq and δp a rounding of each coordinate, 0.2123 ε|q_i| and 0.2123 ε|p_i| rms, once for
    /// each evaluation of the gradient that a step needs; U_q and T_p are taken from the last step of each window.
    pub kick: N,
    /// The expected effect of round-off on H̄: √steps times the kick (Brouwer's law).
    ///
    /// Where nothing else moves H̄, the range was 0.5 to 6.5 times this in `f64`; the range of a random walk is 1.6
    /// times its √n in the mean.
    pub round_off: N,
    /// In how many steps the fastest motion turns once; `None` where nothing turns, or windows have fewer than 5
    /// states.
    ///
    /// From second and fourth differences of p at the last states of each window, which an oscillation by θ a step
    /// makes so that δ⁴p = −4 sin²(θ/2) δ²p; by least squares over all coordinates and windows. Steps so short that a
    /// fourth difference is a few last places of p leave the angle uncertain.
    pub steps_per_turn: Option<f64>,
    /// The names of the coordinates in texts; without them they are numbered from 1.
    pub coordinate_names: Vec<String>,
    /// The coordinate that turns fastest, counted from 0, and in how many steps it turns once: each coordinate by
    /// itself, in the first five states and in the windows. A light body may turn faster than all that has energy.
    pub fastest_coordinate: Option<(usize, f64)>,
    /// A coordinate that turned once in this many steps, 6 or fewer, in the first five states, and no longer does in
    /// the windows, while all that the energy shows is ten times slower: the steps did not resolve it.
    pub lost_coordinate: Option<(usize, f64)>,
    /// The relative residual of that equation: 0 for one oscillation, 1 for noise.
    pub irregular: Option<f64>,
    /// In how many windows a state differs from the increments: there was a plain step where an augmented one was
    /// needed, or q or p were changed from outside, by more than 1/1000 of what a step adds. Detected in `f64` only,
    /// where augmented steps [keep the increments](crate::Increments) of q and p.
    pub mismatches: u64,
    /// In how many of the windows where they were compared, some of all, U and ½(qᵀU_q − rate) differ.
    pub wrong_rates: u64,
    /// The first state that was not finite, or whose energy was not.
    pub not_finite: Option<u64>,
    /// The conclusion about the step size.
    pub verdict: Verdict,
    /// Its sentence, with names for numbers.
    pub(super) sentence: &'static str,
    /// What H of all states shows, if a run was followed.
    pub(super) run: Option<WholeRun>,
}

impl<N: Real> Report<N> {
    /// The root mean square of H − H̄, and its least and largest value; `None` where they are no more than the errors
    /// of H̄: where H̄ is known less well than H − H̄, or less well than H changes while H − H̄ is not three times its
    /// error.
    pub fn method(&self) -> Option<[&N; 3]> {
        let mut error = self.method_resolution.clone();
        if error > self.energy_error {
            error.multiply_integer(ERROR_FACTOR);
        }
        let of_best = self.resolution.as_ref().is_none_or(|error| self.method_rms >= *error);
        (of_best && self.method_rms >= error).then_some([&self.method_rms, &self.method_least, &self.method_largest])
    }

    /// How far the range of H − H̄ is from 0.
    pub(super) fn offset(&self) -> N {
        let mut offset = self.method_least.clone();
        if self.method_largest.is_below_zero() {
            offset.assign(&self.method_largest);
            offset.negate();
        } else if offset.is_below_zero() {
            offset.assign_zero();
        }
        offset
    }

    /// An energy as a part of the energy error.
    pub(super) fn part(&self, energy: &N) -> f64 {
        quotient(energy, &self.energy_error).to_f64()
    }

    pub(super) fn of_energy_error(&self, part: f64) -> N {
        let context = self.kinetic.context();
        let mut energy =
            Rational::from_float(part).map_or_else(|| N::zero(&context), |part| N::from_rational(&part, &context));
        energy.multiply(&self.energy_error);
        energy
    }

    /// The energy error as a part of the mean kinetic energy. NaN where both are 0.
    pub fn relative_error(&self) -> f64 {
        quotient(&self.energy_error, &self.kinetic).to_f64()
    }

    pub(super) fn has_no_energy_error(&self) -> bool {
        self.energy_error.log10_abs() == f64::NEG_INFINITY
    }
}
