//! The modified Hamiltonian as a series: where it stops being asymptotic.

use shadowstep::problems::Problem;

use super::pendulum::SCHEME;
use crate::drawing::{additional, digits_held};
use crate::estimator::bilinear;
use crate::figure::Figure;
use crate::fit::Line;
use crate::interval::Interval;
use crate::numbers::power;
use crate::results::Results;
use crate::run::Run;
use crate::series::GRADES;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

pub(super) const FIGURE: Figure = Figure {
    name: "modified-hamiltonian",
    title: "The modified Hamiltonian as a series: where it ends",
    of_paper: "",
    draw,
};

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
    Run::of(Problem::Pendulum, SCHEME, step)
}

fn draw(results: &Results) -> Finding {
    let mut finding = additional(
        "max − min over [0, 100] of the modified Hamiltonian of Störmer–Verlet on the pendulum, as the series H + h² \
         H_3 + h⁴ H_5 + … up to h^g, whose terms are formulas in q and p, and of E_24, which uses 25 states and no \
         formula.",
    );
    let at = |&step: &&'static str| {
        let series = results.series(&run(step))?;
        let h = shadowstep::Number::from_rational(run(step).h().exact(), &());
        Some(AtStep { step, h, series, estimate: results.log10_drift(&run(step), &bilinear(24)) })
    };
    let all: Vec<AtStep> = results.grid(&STEPS, &FEW_STEPS).iter().filter_map(at).collect();
    against_grade(&mut finding, &all);
    against_step(&mut finding, &all);
    powers(&mut finding, &all);
    end_of_series(&mut finding, &all, results);
    digits_held(&mut finding, "max − min of E_24 at h = 1/16", results.digits_held(&run("1/16"), &bilinear(24), 200));
    finding
}

fn y() -> Axis {
    Axis::log10("max − min over [0, 100]")
}

/// What is left after each power of h, and the factor by which it changes that.
fn against_grade(finding: &mut Finding, all: &[AtStep]) {
    let curves = |of: &dyn Fn(&AtStep, usize) -> Option<f64>| {
        let curve = |(colour, step): (usize, &&str)| {
            let at = all.iter().find(|at| at.step == *step)?;
            let points = GRADES.iter().enumerate().filter_map(|(i, (grade, _))| Some((f64::from(*grade), of(at, i)?)));
            Some(Curve::marked(format!("h = {step}"), points.collect(), colour))
        };
        SHOWN.iter().enumerate().filter_map(curve).collect()
    };
    let x = || Axis::linear("g, the highest power of h");
    finding.chart(
        Chart::new("The series up to h^g: Störmer–Verlet, pendulum", x(), y(), curves(&|at, i| Some(at.series[i]))),
        "g = 0 is H. Where a curve no longer falls, the series has ended.",
    );
    finding.chart(
        Chart::new(
            "What each power of h gains",
            x(),
            Axis::log10("max − min up to h^g / up to h^(g−2)"),
            curves(&AtStep::factor),
        ),
        "Störmer–Verlet, pendulum. Below 1 a term helps, above 1 it does harm.",
    );
}

fn against_step(finding: &mut Finding, all: &[AtStep]) {
    let of = |label: String, colour: usize, y: &dyn Fn(&AtStep) -> f64| {
        Curve::line(label, all.iter().map(|at| (at.h.log10(), y(at))).collect(), colour)
    };
    let label = |grade: u32| if grade == 0 { "H".to_owned() } else { format!("g = {grade}") };
    let mut curves: Vec<_> =
        GRADES.iter().enumerate().map(|(i, (grade, _))| of(label(*grade), i, &|at| at.series[i])).collect();
    let estimate = of("E_24".to_owned(), GRADES.len(), &|at| at.estimate);
    curves.push(Curve::thick(estimate.label, estimate.points, estimate.colour));
    let chart = Chart::new("The series up to h^g, and E_24: Störmer–Verlet, pendulum", Axis::log10("h"), y(), curves);
    finding.chart(Chart { listed: true, ..chart }, "The curves of the series meet where it ends.");
}

/// Up to h^g what is left falls like h^(g + 2), as the scheme is symmetric.
fn powers(finding: &mut Finding, all: &[AtStep]) {
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
    finding.check(
        "The series up to h^g varies like h^(g+2).",
        format!("slopes over h ≤ 1/8: {}; a power is one to half of 1", slopes.join(", ")),
        Verdict::of_all(found.iter().map(within)),
    );
}

/// The best grade of each step, and what E_24 has there.
fn end_of_series(finding: &mut Finding, all: &[AtStep], results: &Results) {
    let best: Vec<usize> = all.iter().map(AtStep::best).collect();
    let last = GRADES.len() - 1;
    let ended: Vec<_> = all.iter().zip(&best).filter(|(_, best)| **best < last).collect();
    let texts: Vec<_> = ended.iter().map(|(at, best)| format!("g = {} at h = {}", GRADES[**best].0, at.step)).collect();
    finding.check(
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
        results.coverage().any(!ended.is_empty() && best.is_sorted_by(|a, b| a >= b)),
    );
    let rises = |at: &AtStep| (2..=last).all(|i| at.factor(i) > at.factor(i - 1));
    let rising = all.iter().filter(|at| rises(at)).count();
    finding.check(
        "Each power of h gains less than the one before.",
        format!("at {rising} of {} steps", all.len()),
        results.coverage().every(!all.is_empty() && rising == all.len()),
    );
    let below = all.iter().zip(&best).filter(|(at, best)| at.estimate < at.series[**best]).count();
    finding.found(format!("E_24 varies less than the best of these series at {below} of {} steps.", all.len()));
    let row = |(at, best): (&AtStep, &usize)| {
        let of = |y: f64| power(y);
        vec![
            at.step.to_owned(),
            of(at.series[0]),
            of(at.series[1]),
            of(at.series[last]),
            GRADES[*best].0.to_string(),
            of(at.series[*best]),
            of(at.estimate),
        ]
    };
    let header = ["h", "H", "g = 2", "g = 10", "best g", "there", "E_24"];
    finding.table("max − min", &header, all.iter().zip(&best).map(row).collect());
}
