//! The report of a monitor in numbers.

use std::f64::consts::TAU;

use num_traits::Signed;

use super::Monitor;
use super::arithmetic::{difference, integer, quotient, root};
use super::change::Change;
use super::estimated::Estimated;
use super::roughness::Rough;
use super::statistics::{ERROR_FACTOR, Range};
use super::trend::{Trend, TrendRatio, trend_ratio};
use super::turning::Turning;
use super::verdict::{Advice, Evidence, Missing, Verdict};
use crate::Rational;
use crate::number::Real;
use crate::shadow::Estimator;

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
}

/// What the energy shows is slower by this factor than a coordinate that has no part in it.
const SLOWER: f64 = 10.0;

impl<N: Real, E: Estimator<N>> Monitor<N, E> {
    /// The report on the run so far.
    pub fn report(&self) -> Report<N> {
        let (statistics, context) = (&self.statistics, self.method.context());
        let (all, accurate) = (self.blocks.best(), self.blocks.accurate());
        let newest = &self.newest.modified.value;
        let (first, last) =
            (accurate.first().map_or(newest, |first| &first.value), accurate.last().map_or(newest, |last| &last.value));
        let mut values = Range::of(first);
        accurate.iter().for_each(|accurate| values.include(&accurate.value));
        let known = |error: N| self.newest.has_error.then_some(error);
        let range = values.width();
        let kick = root(&self.newest_states.mean_square_kick());
        let mut round_off: N = root(&integer(self.n, &context));
        round_off.multiply(&kick);
        let mut time: N = integer(self.n, &context);
        time.multiply(&N::from_rational(&self.h.exact().abs(), &context));
        let turning = self.newest_states.turning();
        let trend_ratio = trend_ratio(&accurate, &range);
        let [method_rms, method_resolution] = statistics.method_rms();
        let mut report = Report {
            steps: self.n,
            time,
            windows: statistics.windows,
            energy_error: statistics.energy.width(),
            kinetic: self.kinetic.mean(),
            method_least: statistics.method.least.clone(),
            method_largest: statistics.method.largest.clone(),
            method_rms,
            method_resolution,
            modified: last.clone(),
            change: difference(last, first),
            trend: trend_ratio.map(TrendRatio::trend),
            range,
            moved: statistics.moved(),
            permanent_bound: None,
            permanent_change: None,
            rough: self.newest_states.rough(),
            advice: None,
            resolution: known(largest_error(accurate.iter().copied(), &context)),
            worst_error: known(largest_error(all, &context)),
            kick,
            round_off,
            steps_per_turn: turning.map(Turning::steps),
            coordinate_names: Vec::new(),
            fastest_coordinate: self.fastest.found().map(|(i, turning)| (i, turning.steps())),
            lost_coordinate: self.lost(turning),
            irregular: turning.map(|turning| turning.irregular),
            mismatches: self.newest_states.mismatches(),
            wrong_rates: self.rate.wrong,
            not_finite: self.not_finite,
            verdict: Verdict::Undecided(Missing::Windows),
        };
        self.judge(&mut report, turning, trend_ratio);
        report
    }

    /// A coordinate that is lost, if the energy shows much slower motions only.
    fn lost(&self, turning: Option<Turning>) -> Option<(usize, f64)> {
        let shown = turning.map_or(f64::INFINITY, Turning::steps);
        self.fastest.lost().map(|(i, angle)| (i, TAU / angle)).filter(|(_, steps)| SLOWER * steps <= shown)
    }

    /// What a net change is excluded above by estimates: the range of the accurate ones and of those of the first and
    /// the last part of the run, and three times the largest error of these.
    fn excluded(&self) -> N {
        let (mut best, mut accurate) = (self.blocks.best(), self.blocks.accurate());
        accurate.extend(best.next().into_iter().chain(best.last()));
        let mut values = Range::of(accurate.first().map_or(&self.newest.modified.value, |first| &first.value));
        accurate.iter().for_each(|estimate| values.include(&estimate.value));
        let mut error = largest_error(accurate.iter().copied(), &self.method.context());
        error.multiply_integer(ERROR_FACTOR);
        error.add(&values.width());
        error
    }

    fn judge(&self, report: &mut Report<N>, turning: Option<Turning>, trend_ratio: Option<TrendRatio>) {
        let [energy_change, modified_change] =
            self.blocks.means(&report.energy_error).map(|means| Change::of(&means, self.blocks.size()));
        let evidence = Evidence {
            straight: trend_ratio.is_some_and(TrendRatio::is_straight),
            turning,
            moves: self.newest_states.moves(),
            energy_change,
            modified_change,
            action: self.newest_states.action(self.h.exact()),
            distance: self.statistics.distance_of_error(),
            last_term: quotient(&self.newest_states.last_term(), &self.statistics.error_rms()).to_f64(),
            error_rms: report.part(&self.statistics.error_rms()),
            excluded: report.part(&self.excluded()),
            ..report.evidence()
        };
        report.verdict = evidence.verdict();
        report.permanent_bound = evidence.bound().map(|part| report.of_energy_error(part));
        report.permanent_change = evidence.permanent_move().map(|part| report.of_energy_error(part));
        if matches!(report.verdict, Verdict::NotTheGradient | Verdict::Inconsistent) {
            report.rough = None;
        }
        report.advice = evidence.advice(self.newest.order);
    }
}

fn largest_error<'a, N: Real + 'a>(estimates: impl Iterator<Item = &'a Estimated<N>>, context: &N::Context) -> N {
    let mut largest = N::zero(context);
    for Estimated { error, .. } in estimates {
        if *error > largest {
            largest.assign(error);
        }
    }
    largest
}

impl<N: Real> Report<N> {
    pub(super) fn evidence(&self) -> Evidence {
        let numbers = [&self.energy_error, &self.kinetic, &self.method_rms, &self.kick];
        Evidence {
            moved: self.part(&self.moved),
            worst_error: self.worst_error.as_ref().map_or(0.0, |error| self.part(error)),
            kick: self.part(&self.kick),
            round_off: self.part(&self.round_off),
            offset: self.part(&self.offset()),
            of_kinetic: self.relative_error(),
            turning: None,
            turns: self.steps_per_turn.map_or(0.0, |turn| self.steps as f64 / turn),
            fastest_angle: self.fastest_coordinate.map(|(_, steps)| TAU / steps),
            lost: self.lost_coordinate.is_some(),
            straight: false,
            resolution: self.resolution.as_ref().map_or(0.0, |resolution| self.part(resolution)),
            excluded: f64::NAN,
            trend: self.trend,
            energy_change: None,
            modified_change: None,
            action: f64::NAN,
            distance: f64::NAN,
            last_term: f64::NAN,
            error_rms: f64::NAN,
            rough: self.rough.is_some(),
            has_errors: self.worst_error.is_some(),
            moves: true,
            mismatches: self.mismatches > 0,
            wrong_rate: self.wrong_rates > 0,
            finite: self.not_finite.is_none() && numbers.into_iter().all(N::is_finite),
            windows: self.windows,
        }
    }

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

    fn of_energy_error(&self, part: f64) -> N {
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
