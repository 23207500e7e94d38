//! The harmonic oscillator from well inside the stability limit to beyond it, and in the gaps.

use num_traits::One;
use shadowstep::exact;
use shadowstep_analysis::stability::Stability;
use shadowstep_scenes::arithmetic::Arithmetic;

use crate::stability::growth::{TOLERANCE as GROWTH_TOLERANCE, growth, steps_to_see};
use crate::stability::linear_step::LinearStep;
use crate::stability::prelude::*;

/// The case.
pub(super) struct Oscillator;

/// What one step size has shown.
#[derive(Serialize, Deserialize)]
pub(super) struct Point {
    h_omega: f64,
    /// log(|tr| + √(tr² − 4))/2) where |tr| > 2, else 0.
    predicted: f64,
    /// How fast log|(q, p)| grows, per step; or, where it is bounded, largest |q| beside the predicted one, less 1.
    found: f64,
    /// The growth is too slow to be seen in this number of steps.
    too_slow: bool,
}

/// From well inside to just beyond the limit, as parts of it.
const PARTS: [&str; 8] = ["1/2", "9/10", "99/100", "999/1000", "1001/1000", "101/100", "11/10", "6/5"];
/// Where a step is stable, its matrix differs from a rotation by a factor of 1/√(1 − (tr/2)²), 22 at a thousandth
/// inside a simple limit, and round-off of 1e5 steps grows to 1e-9 or so.
const BOUND_TOLERANCE: f64 = 1e-6;
/// Gaps below this width are narrower than the rounding of the weights to double precision.
const NARROW: f64 = 1e-9;

impl Case for Oscillator {
    type Measured = Vec<Point>;

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Vec<Point>, Error> {
        let sizes = step_sizes(trial.scheme());
        let continued = sizes.iter().enumerate().take_while(|(i, _)| continues(*i as f64 / sizes.len() as f64));
        Ok(continued.map(|(_, h)| point(trial.scheme(), h, trial.steps(), trial.arithmetic)).collect())
    }

    fn judge(all: &[&Done<'_, Vec<Point>>]) -> Vec<Row> {
        let Done { trial, found: points } = all[0];
        let (found, verdict) = compared(points);
        let growing = points.iter().filter(|point| point.grows());
        let deviations = growing.map(|point| (point.predicted.log10(), point.deviation().log10()));
        vec![Row::of(trial, found, verdict).with(deviations)]
    }
}

impl Point {
    fn grows(&self) -> bool {
        self.predicted > 0.0 && !self.too_slow
    }

    /// Of the growth from the predicted one, relatively.
    fn deviation(&self) -> f64 {
        (self.found / self.predicted - 1.0).abs()
    }
}

/// The step sizes for ω = 1: parts of the limit, and the middle of each gap beyond.
fn step_sizes(scheme: &NamedScheme) -> Vec<Rational> {
    let Some(stability) = Stability::of_scheme(scheme.scheme.proved()) else { return Vec::new() };
    let number = |text: &str| exact(text).expect("limits are decimals");
    let limit = number(&stability.limit);
    let mut sizes: Vec<Rational> = PARTS.iter().map(|part| number(part) * &limit).collect();
    let two = Rational::one() + Rational::one();
    for gap in &stability.gaps {
        if let Some(to) = gap.to.as_ref().filter(|_| gap.width > NARROW) {
            sizes.push((number(&gap.from) + number(to)) / &two);
        }
    }
    sizes.sort();
    sizes
}

fn point(scheme: &NamedScheme, h: &Rational, steps: u64, arithmetic: Arithmetic) -> Point {
    let matrix = LinearStep::of(&scheme.quadratic(), h);
    // ω = 1, from q = 1 and p = 0
    let system = shipped("harmonic-oscillator", &[]);
    let run = &mut *start_in(arithmetic, &system, steps_of(scheme, &step_size(h), Begin::Step));
    let h_omega = <f64 as Number>::from_rational(h, &());
    let predicted = matrix.growth();
    if predicted > 0.0 {
        let count = steps_to_see(predicted);
        let too_slow = 2 * count > steps;
        let found = if too_slow { 0.0 } else { growth(run, (predicted, count)) };
        Point { h_omega, predicted, found, too_slow }
    } else {
        let found = largest_coordinate(run, steps / 10) / matrix.largest() - 1.0;
        Point { h_omega, predicted, found, too_slow: false }
    }
}

/// The largest |q| of a run.
fn largest_coordinate(run: &mut dyn AnyIntegrator, steps: u64) -> f64 {
    (0..steps).fold(1.0, |largest: f64, _| {
        run.step();
        largest.max(run.q(0).abs())
    })
}

/// The numbers of a scheme in a sentence, and whether they are as predicted.
fn compared(points: &[Point]) -> (String, Verdict) {
    let growing: Vec<_> = points.iter().filter(|point| point.grows()).collect();
    let bounded: Vec<_> = points.iter().filter(|point| point.predicted == 0.0).collect();
    let slow = points.iter().filter(|point| point.too_slow).count();
    let off = largest(growing.iter().map(|point| point.deviation()));
    let beyond = bounded.iter().map(|point| point.found).fold(f64::NEG_INFINITY, f64::max);
    let mut parts = vec![
        match beyond {
            beyond if beyond > 0.0 => {
                format!("{} step sizes bounded, beyond the ellipse by {beyond:.0e} at most", bounded.len())
            }
            _ => format!("{} step sizes bounded by the ellipse", bounded.len()),
        },
        format!("{} grow, rates off by {off:.0e} at most", growing.len()),
    ];
    if slow > 0 {
        parts.push(format!("{slow} grow too slowly to be seen"));
    }
    let verdict = match () {
        () if points.is_empty() => Verdict::of_all([]),
        () => Verdict::from(off <= GROWTH_TOLERANCE && beyond <= BOUND_TOLERANCE),
    };
    (parts.join("; "), verdict)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep_scenes::library::scheme;

    fn point(predicted: f64, found: f64) -> Point {
        Point { h_omega: 2.0, predicted, found, too_slow: false }
    }

    #[test]
    fn what_differs_from_the_trace_differs() {
        let right = [point(0.0, 1e-9), point(0.3, 0.300_01)];
        assert_eq!(compared(&right).1, Verdict::Agrees);
        assert_eq!(compared(&[point(0.0, 1e-3)]).1, Verdict::Differs, "beyond the ellipse");
        assert_eq!(compared(&[point(0.3, 0.301)]).1, Verdict::Differs, "another rate");
        assert!(compared(&[]).1.reason().is_some());
    }

    /// The matrix of Störmer–Verlet is known: its trace is 2 − h².
    #[test]
    fn growth_begins_at_the_limit() {
        let verlet = scheme("stormer-verlet").unwrap();
        let growth = |h: &str| LinearStep::of(&verlet.quadratic(), &exact(h).unwrap()).growth();
        assert_eq!(growth("1.999"), 0.0);
        // 2 arsinh √((h² − 4)/4)
        let expected = 2.0 * ((2.1_f64 * 2.1 - 4.0) / 4.0).sqrt().asinh();
        assert!((growth("2.1") - expected).abs() < 1e-14);
        let point = point_of(&verlet, "2.1");
        assert!((point.found - expected).abs() < 1e-9, "{} {expected}", point.found);
        assert!(point_of(&verlet, "1.9").found.abs() < 1e-2);
    }

    /// Takahashi and Imada's kicks are by 1 − h²/12 of the force, so that the trace is 2 − h² + h⁴/12, at least −1, and
    /// 2 again at h² = 12.
    #[test]
    fn gradient_kicks_are_a_part_of_the_trace() {
        let scheme = scheme("takahashi-imada").unwrap();
        let cosine = |h: &str| LinearStep::of(&scheme.quadratic(), &exact(h).unwrap()).cosine();
        for h in [0.5_f64, 2.0, 3.0] {
            let expected = 1.0 - h * h / 2.0 + h.powi(4) / 24.0;
            assert!((cosine(&h.to_string()) - expected).abs() < 1e-14, "{h}");
        }
        let stability = Stability::of_scheme(scheme.scheme.proved()).unwrap();
        assert_eq!(stability.limit, "3.46410161513775458705489268301");
        // cosh λ = 1 − h²/2 + h⁴/24
        let expected = 2.0 * ((3.5_f64.powi(4) / 24.0 - 3.5 * 3.5 / 2.0) / 2.0).sqrt().asinh();
        let found = point_of(&scheme, "3.5").found;
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }

    fn point_of(scheme: &NamedScheme, h: &str) -> Point {
        super::point(scheme, &exact(h).unwrap(), 10_000, Arithmetic::DOUBLE)
    }
}
