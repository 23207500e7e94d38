//! The modified Hamiltonian as a series: where it stops being asymptotic.

use crate::figures::prelude::*;
use crate::figures::series::GRADES;

const STEPS: [&str; 13] = ["1/16", "1/12", "1/10", "1/8", "1/6", "1/5", "1/4", "1/3", "1/2", "3/4", "1", "6/5", "7/5"];

const FEW_STEPS: [&str; 8] = ["1/16", "1/12", "1/8", "1/4", "1/2", "1", "6/5", "7/5"];

/// Those with a curve of their own.
const SHOWN: [&str; 7] = ["7/5", "6/5", "1", "1/2", "1/4", "1/8", "1/16"];

/// Powers of h are fitted up to this step.
const ASYMPTOTIC: f64 = 0.126;

/// At a step: log₁₀ of max − min of the series up to each grade, and of E_24.
struct AtStep {
    step: &'static str,
    h: f64,
    series: Vec<f64>,
    estimate: f64,
}

impl AtStep {
    /// The place of the grade at which the series varies least.
    fn best(&self) -> usize {
        (0..self.series.len()).min_by(|&a, &b| self.series[a].total_cmp(&self.series[b])).expect("there are grades")
    }

    /// log₁₀ of the factor by which the terms of a grade change what the series varies by.
    fn factor(&self, grade: usize) -> Option<f64> {
        Some(self.series[grade] - self.series[grade.checked_sub(1)?])
    }
}

fn run(step: &str) -> Run {
    Run::of(Problem::Pendulum, "stormer-verlet", step)
}

pub(super) fn draw(d: &mut Drawing<'_>) {
    let at = |&step: &&'static str| {
        let series = d.results.series(&run(step))?;
        let h = shadowstep::Number::from_rational(run(step).h().exact(), &());
        Some(AtStep { step, h, series, estimate: d.results.log10_drift(&run(step), &bilinear(24)) })
    };
    let all: Vec<AtStep> = d.results.grid(&STEPS, &FEW_STEPS).iter().filter_map(at).collect();
    against_grade(d, &all);
    against_step(d, &all);
    powers(d, &all);
    end_of_series(d, &all);
}

/// What is left after each power of h, and the factor by which it changes that.
fn against_grade(d: &mut Drawing<'_>, all: &[AtStep]) {
    let curves = |of: &dyn Fn(&AtStep, usize) -> Option<f64>| {
        let curve = |(colour, step): (usize, &&str)| {
            let at = all.iter().find(|at| at.step == *step)?;
            let points = GRADES.iter().enumerate().filter_map(|(i, (grade, _))| Some((f64::from(*grade), of(at, i)?)));
            Some(Curve::marked(format!("h = {step}"), points.collect(), colour))
        };
        SHOWN.iter().enumerate().filter_map(curve).collect()
    };
    d.chart("series", curves(&|at, i| Some(at.series[i])));
    d.chart("gains", curves(&AtStep::factor));
}

fn against_step(d: &mut Drawing<'_>, all: &[AtStep]) {
    let of = |y: &dyn Fn(&AtStep) -> f64| all.iter().map(|at| (at.h.log10(), y(at))).collect();
    let label = |grade: u32| if grade == 0 { "H".to_owned() } else { format!("g = {grade}") };
    let grades = GRADES.iter().enumerate();
    let mut curves: Vec<_> =
        grades.map(|(i, (grade, _))| Curve::line(label(*grade), of(&|at| at.series[i]), i)).collect();
    curves.push(Curve::thick("E_24", of(&|at| at.estimate), GRADES.len()));
    d.chart("steps", curves);
}

/// Up to h^g what is left falls like h^(g + 2), as the scheme is symmetric.
fn powers(d: &mut Drawing<'_>, all: &[AtStep]) {
    let of = |i: usize| {
        let small = all.iter().filter(|at| at.h < ASYMPTOTIC).map(|at| (at.h.log10(), at.series[i]));
        let line = Line::through(&small.collect::<Vec<_>>())?;
        Some(Interval::about(line.slope, line.slope_error, line.points, line.points - 2))
    };
    let found: Vec<_> = GRADES.iter().enumerate().filter_map(|(i, (grade, _))| Some((*grade, of(i)?))).collect();
    let within = |(grade, slope): &(u32, Interval)| {
        let power = f64::from(grade + 2);
        slope.within(power - 0.5, power + 0.5)
    };
    let slopes: Vec<_> = found.iter().map(|(grade, slope)| format!("{slope} up to h^{grade}")).collect();
    d.check(
        "The series up to h^g varies like h^(g+2).",
        format!("slopes over h ≤ 1/8: {}; a power is one to half of 1", slopes.join(", ")),
        Verdict::of_all(found.iter().map(within)),
    );
}

/// The best grade of each step, and what E_24 has there.
fn end_of_series(d: &mut Drawing<'_>, all: &[AtStep]) {
    let best: Vec<usize> = all.iter().map(AtStep::best).collect();
    let last = GRADES.len() - 1;
    let ended: Vec<_> = all.iter().zip(&best).filter(|(_, best)| **best < last).collect();
    let texts: Vec<_> = ended.iter().map(|(at, best)| format!("g = {} at h = {}", GRADES[**best].0, at.step)).collect();
    d.check(
        "At large steps the series is best at a power of h, which falls as h grows, and gets worse beyond it.",
        match texts.is_empty() {
            true => format!("up to h^{} it gets better at every step", GRADES[last].0),
            false => format!(
                "best at {}; at the {} smaller steps at h^{} or beyond",
                texts.join(", "),
                all.len() - ended.len(),
                GRADES[last].0
            ),
        },
        d.coverage().any(!ended.is_empty() && best.is_sorted_by(|a, b| a >= b)),
    );
    let rises = |at: &AtStep| (2..=last).all(|i| at.factor(i) > at.factor(i - 1));
    let rising = all.iter().filter(|at| rises(at)).count();
    d.check(
        "Each power of h gains less than the one before.",
        format!("at {rising} of {} steps", all.len()),
        d.coverage().every(!all.is_empty() && rising == all.len()),
    );
    let below = all.iter().zip(&best).filter(|(at, best)| at.estimate < at.series[**best]).count();
    d.found(format!("E_24 varies less than the best of these series at {below} of {} steps.", all.len()));
    let row = |(at, best): (&AtStep, &usize)| {
        let [h, second, tenth, there] = [0, 1, last, *best].map(|grade| power(at.series[grade]));
        vec![at.step.to_owned(), h, second, tenth, GRADES[*best].0.to_string(), there, power(at.estimate)]
    };
    let header = ["h", "H", "g = 2", "g = 10", "best g", "there", "E_24"];
    d.finding.table("max − min", &header, all.iter().zip(&best).map(row).collect());
}
