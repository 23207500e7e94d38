//! `schemes show NAME --plot`: the stages of a step, its stability and its phase as charts.

use num_traits::ToPrimitive;
use shadowstep_analysis::Analysis;
use shadowstep_analysis::oscillator::Oscillator;
use shadowstep_analysis::stability::Stability;
use shadowstep_analysis::trace::PhaseError;
use shadowstep_schemes::MapKind;
use shadowstep_schemes::symbolic::decimal::significant;
use shadowstep_schemes::{Proved, Rational};
use shadowstep_studies::chart::{Axis, Chart, Curve, Mark, log10_of, stacked};

/// Points of a curve over hω.
const POINTS: usize = 1200;

/// A gap that is narrower has one mark, and an interval of stability that is narrower does not extend the axis.
const NARROW: f64 = 0.02;

/// More labels than these cannot be read.
const MOST_LABELS: usize = 8;

/// Where the axis of hω ends for a step whose stability is not analysed.
const NOT_ANALYSED: f64 = 4.0;

/// How far beyond the last end the axis goes.
const BEYOND: f64 = 1.1;

/// A relative error of the phase times (hω)², per map, that may come from rounding alone.
const ROUNDING: f64 = 1e-15;

/// The charts below each other, as SVG.
pub(super) fn picture(name: &str, proved: &Proved, analysis: &Analysis) -> String {
    let weight = |weight: &Rational| weight.to_f64().unwrap_or(f64::NAN);
    let oscillator = Oscillator::of(&proved.scheme.maps(), weight);
    let gaps = Gaps::of(analysis.stability.as_ref(), 2 * (analysis.evaluations + analysis.hessian_products));
    let charts =
        [stages(name, proved), trace(name, &oscillator, &gaps), phase(name, &oscillator, &gaps, analysis.phase)];
    stacked(&format!("{name}: stages, stability and phase of a step"), &charts)
}

/// The times that drifts and kicks have reached after each map.
fn stages(name: &str, proved: &Proved) -> Chart {
    let maps = proved.scheme.maps();
    let reached = |kind: MapKind| {
        let mut time = 0.0;
        let after = maps.iter().enumerate().map(|(n, map)| {
            time += if map.kind == kind { map.weight.to_f64().unwrap_or(f64::NAN) } else { 0.0 };
            (n as f64 + 1.0, time)
        });
        std::iter::once((0.0, 0.0)).chain(after).collect::<Vec<_>>()
    };
    let curves = vec![
        Curve::marked("q: drifts", reached(MapKind::Drift), 0),
        Curve::marked("p: kicks", reached(MapKind::Kick), 1),
    ];
    let x = Axis::linear("maps of the step done").over(0.0, maps.len() as f64);
    Chart::new(format!("{name}: the times that q and p have reached"), x, Axis::linear("time in steps h"), curves)
}

fn trace(name: &str, oscillator: &Oscillator, gaps: &Gaps) -> Chart {
    let at = |n: usize| gaps.end * n as f64 / POINTS as f64;
    let curve = |value: &dyn Fn(f64) -> f64| (0..=POINTS).map(|n| (at(n), value(at(n)))).collect::<Vec<_>>();
    let curves = vec![
        Curve::thick("the step", curve(&|h_omega| oscillator.trace(h_omega)), 0),
        Curve::dashed("2 cos hω", curve(&|h_omega| 2.0 * h_omega.cos()), 1),
    ];
    let mut chart = Chart::new(
        format!("{name}: the trace of a step of the oscillator, stable within ±2"),
        Axis::linear("hω").over(0.0, gaps.end),
        Axis::linear("trace").over(-3.0, 3.0),
        curves,
    );
    chart.marks = gaps.marks();
    if !gaps.is_analysed {
        chart.notes.push("The limits are not analysed: the step has too many maps.".to_owned());
    }
    chart
}

fn phase(name: &str, oscillator: &Oscillator, gaps: &Gaps, leading: PhaseError) -> Chart {
    // evenly on the logarithmic axis
    let at = |n: usize| gaps.first_end() * 100_f64.powf(n as f64 / POINTS as f64 - 1.0);
    let rounding = |h_omega: f64| ROUNDING * (1.0 + oscillator.maps() as f64) / (h_omega * h_omega);
    let mut last = 0.0;
    let mut error = |h_omega: f64| {
        last = oscillator.phase_error(h_omega, last)?;
        Some(last).filter(|error| error.abs() > 10.0 * rounding(h_omega))
    };
    let errors: Vec<_> = (0..=POINTS).map(|n| (at(n), error(at(n)).unwrap_or(f64::NAN))).collect();
    let of_sign = |sign: f64| {
        let points: Vec<_> = errors.iter().map(|(h_omega, error)| (*h_omega, sign * error)).collect();
        log10_of(&points, (true, true))
    };
    let leading_at = |h_omega: f64| leading.coefficient.abs() * h_omega.powi(leading.power as i32);
    let ends: Vec<_> = (0..=POINTS).map(|n| (at(n), leading_at(at(n)))).collect();
    let curves = [("too fast", of_sign(1.0), 0), ("too slow", of_sign(-1.0), 4)];
    let visible = curves.into_iter().filter(|(_, points, _)| points.iter().any(|(_, error)| error.is_finite()));
    let mut curves: Vec<_> = visible.map(|(label, points, colour)| Curve::thick(label, points, colour)).collect();
    curves.push(Curve::dashed(
        format!("{:.3e} (hω){}", leading.coefficient, raised(leading.power)),
        log10_of(&ends, (true, true)),
        1,
    ));
    let (x, y) = (Axis::log10("hω"), Axis::log10("|φ − hω| / hω"));
    let mut chart = Chart::new(format!("{name}: the error of the phase φ of a step"), x, y, curves);
    chart.notes = vec!["Where f64 does not resolve the error, only its leading term is drawn.".to_owned()];
    chart
}

/// An exponent in raised digits.
fn raised(power: u32) -> String {
    let digit = |digit: char| digit.to_digit(10).and_then(|digit| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize));
    power.to_string().chars().filter_map(digit).collect()
}

/// The intervals of hω in which the step is unstable, and the end of the axis.
struct Gaps {
    /// From, to; without an end where the step stays unstable.
    gaps: Vec<(f64, Option<f64>)>,
    end: f64,
    is_analysed: bool,
}

impl Gaps {
    fn of(stability: Option<&Stability>, most: usize) -> Gaps {
        let Some(stability) = stability else {
            return Gaps { gaps: Vec::new(), end: NOT_ANALYSED, is_analysed: false };
        };
        let number = |text: &String| text.parse::<f64>().unwrap_or(f64::NAN);
        let gaps: Vec<_> = stability.gaps.iter().map(|gap| (number(&gap.from), gap.to.as_ref().map(number))).collect();
        // the last interval of stability that can be seen
        let starts = std::iter::once(Some(0.0)).chain(gaps.iter().map(|gap| gap.1));
        let ends = gaps.iter().map(|gap| gap.0);
        let visible = starts.zip(ends).filter(|(from, to)| from.is_some_and(|from| to - from > NARROW));
        let last = visible.map(|(_, to)| to).fold(0.0, f64::max);
        let end = if last > 0.0 { BEYOND * last } else { most as f64 };
        Gaps { gaps, end, is_analysed: true }
    }

    /// Up to there the phase is that of the motion which begins at hω = 0.
    fn first_end(&self) -> f64 {
        self.wide().next().map_or(self.end, |gap| gap.0)
    }

    fn visible(&self) -> impl Iterator<Item = &(f64, Option<f64>)> {
        self.gaps.iter().filter(|gap| gap.0 < self.end)
    }

    fn wide(&self) -> impl Iterator<Item = &(f64, Option<f64>)> {
        self.visible().filter(|(from, to)| to.is_none_or(|to| to - from > NARROW))
    }

    /// Where stability ends and begins again, and the narrow gaps, which the trace does not show; from the ninth on
    /// without labels.
    fn marks(&self) -> Vec<Mark> {
        let (mut marks, mut stable) = (Vec::new(), "stable to");
        for (from, to) in self.visible() {
            if let Some(to) = to.filter(|to| to - from <= NARROW) {
                marks.push(Mark::at(*from, format!("gap at {}, {:.0e} wide", significant(*from, 5), to - from)));
                stable = "but for gaps stable to";
                continue;
            }
            marks.push(Mark::at(*from, format!("{stable} {}", significant(*from, 5))));
            marks.extend(
                to.filter(|to| *to < self.end).map(|to| Mark::at(to, format!("again from {}", significant(to, 5)))),
            );
            stable = "stable to";
        }
        marks.iter_mut().skip(MOST_LABELS).for_each(|mark| mark.label.clear());
        marks
    }
}
