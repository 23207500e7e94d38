//! The report on the states so far: its numbers, and the verdict that follows from them.

use std::f64::consts::TAU;

use num_traits::Signed;

use super::Monitor;
use super::arithmetic::{difference, integer, quotient, root};
use super::change::Change;
use super::estimated::Estimated;
use super::evidence::Evidence;
use super::report::Report;
use super::rules::{OF_RUN, OF_WINDOWS};
use super::statistics::Range;
use super::thresholds::SLOWER;
use super::trend::{TrendRatio, trend_ratio};
use super::turning::Turning;
use super::verdict::{Criterion, Missing, Verdict};
use super::whole_run::{OfRun, WholeRun};
use crate::Rational;
use crate::number::Real;
use crate::shadow::Estimator;
use crate::shadow::rules::{ERROR_FACTOR, Rule};

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
            sentence: "",
            run: None,
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
        let evidence = self.evidence(report, turning, trend_ratio);
        (report.verdict, report.sentence) = Rule::first(&OF_WINDOWS, &evidence).expect("the last row always holds");
        report.permanent_bound = evidence.bound().map(|part| report.of_energy_error(part));
        report.permanent_change = evidence.permanent_move().map(|part| report.of_energy_error(part));
        if matches!(report.verdict, Verdict::NotTheGradient | Verdict::Inconsistent) {
            report.rough = None;
        }
        if report.verdict == Verdict::Undecided(Missing::Resolution) {
            report.advice = Some(evidence.advice(self.newest.order));
        }
    }

    fn evidence(&self, report: &Report<N>, turning: Option<Turning>, trend_ratio: Option<TrendRatio>) -> Evidence {
        let [energy_change, modified_change] =
            self.blocks.means(&report.energy_error).map(|means| Change::of(&means, self.blocks.size()));
        let known = |error: &Option<N>| error.as_ref().map_or(0.0, |error| report.part(error));
        let numbers = [&report.energy_error, &report.kinetic, &report.method_rms, &report.kick];
        let error_rms = self.statistics.error_rms();
        Evidence {
            moved: report.part(&report.moved),
            resolution: known(&report.resolution),
            excluded: report.part(&self.excluded()),
            worst_error: known(&report.worst_error),
            energy_change,
            modified_change,
            kick: report.part(&report.kick),
            round_off: report.part(&report.round_off),
            offset: report.part(&report.offset()),
            error_rms: report.part(&error_rms),
            distance: self.statistics.distance_of_error(),
            last_term: quotient(&self.newest_states.last_term(), &error_rms).to_f64(),
            of_kinetic: report.relative_error(),
            action: self.newest_states.action(self.h.exact()),
            turning,
            turns: report.steps_per_turn.map_or(0.0, |turn| report.steps as f64 / turn),
            fastest_angle: report.fastest_coordinate.map(|(_, steps)| TAU / steps),
            lost: report.lost_coordinate.is_some(),
            trend: report.trend,
            straight: trend_ratio.is_some_and(TrendRatio::is_straight),
            rough: report.rough.is_some(),
            has_errors: report.worst_error.is_some(),
            moves: self.newest_states.moves(),
            mismatches: report.mismatches > 0,
            wrong_rate: report.wrong_rates > 0,
            finite: report.not_finite.is_none() && numbers.into_iter().all(N::is_finite),
            windows: report.windows,
        }
    }
}

impl<N: Real> Report<N> {
    /// The report on a whole run, in which H of more states than those of the windows is known.
    ///
    /// In place of *undecided*, *bounded* and *round-off*, the verdict is *too large* where H at some of these states, or
    /// at the last one, is too far from H(0). Where H has a larger range than in the windows, that is the energy error;
    /// what windows show as round-off, or as a permanent change, is then little of it: *bounded*, *undecided*.
    #[must_use]
    pub fn of_run(mut self, run: WholeRun) -> Report<N> {
        let wider = run.range.filter(|range| range.is_finite() && *range > self.energy_error.to_f64());
        let permanent = self.permanent_change.as_ref().map_or(0.0, N::to_f64);
        let round_off = self.round_off.to_f64();
        let mut evidence = OfRun { found: self.verdict, run, wider, of_kinetic: 0.0, round_off, permanent };
        let is_of_windows =
            matches!(self.verdict, Verdict::Bounded | Verdict::TooLarge(Criterion::EnergyError | Criterion::Lost));
        if let Some(range) = wider.and_then(Rational::from_float)
            && (is_of_windows || evidence.is_no_round_off())
        {
            self.energy_error = N::from_rational(&range, &self.energy_error.context());
        }
        evidence.of_kinetic = self.relative_error();
        if let Some(decision) = Rule::first(&OF_RUN, &evidence) {
            (self.verdict, self.sentence) = decision;
        }
        self.run = Some(run);
        self
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
