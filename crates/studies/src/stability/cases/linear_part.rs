//! Oscillators that drifts solve exactly, with a quadratic perturbation in the kicks: where its resonances are, and how
//! fast states grow there.

use shadowstep::tables::TableScheme;
use shadowstep_scenes::{Linear, Parts};
use shadowstep_schemes::MapKind;

use crate::stability::growth::{TOLERANCE, growth, steps_to_see};
use crate::stability::prelude::*;

/// The case.
pub(super) struct LinearPartCase;

/// What the steps have shown.
#[derive(Serialize, Deserialize)]
pub(super) struct StepsResult {
    /// log of the largest modulus of an eigenvalue of a step.
    predicted: f64,
    /// How fast log|(q, p)| grows a step; or, where no growth is predicted, log of the largest |(q, p)| in the second
    /// half of the steps beside that of the first.
    found: f64,
    /// The growth is too slow to be seen in this number of steps.
    too_slow: bool,
}

const OMEGAS: [f64; 2] = [1.0, 1.6];
/// B = δ(q₁ + q₂)²/2
const DELTA: f64 = 0.01;
/// A growth below this is round-off of the eigenvalues.
const NO_GROWTH: f64 = 1e-6;
/// A state that does not grow: its largest size in the halves of a run differs by beats only.
const SAME: f64 = 0.02;

impl Case for LinearPartCase {
    type Measured = StepsResult;

    fn complete(scheme: &Examined, mut values: Values) -> Option<Values> {
        // gradient kicks are for T(p) and U(q)
        if scheme.has_gradient_kicks() {
            return None;
        }
        let about = values["aside"]["about"].as_f64()?;
        let h = if values["at"] == "Beyond" { about } else { strongest(&scheme.scheme.quadratic(), about) };
        values.insert("h".to_owned(), h.into());
        Some(values)
    }

    fn measure(trial: &Trial<'_>, _: Continues<'_>) -> Result<StepsResult, Error> {
        let (h, steps) = (trial.get::<f64>("h"), trial.steps());
        let predicted = Matrix::of_step(&trial.scheme().quadratic(), h).growth();
        let mut run = trial.start(&system(), &step_size(h));
        if predicted > 0.0 {
            let count = steps_to_see(predicted);
            let too_slow = 2 * count > steps;
            let found = if too_slow { 0.0 } else { growth(&mut *run, (predicted, count)) };
            return Ok(StepsResult { predicted, found, too_slow });
        }
        let mut half = || {
            (0..steps / 20).fold(0.0, |largest: f64, _| {
                run.step();
                largest.max(run.size())
            })
        };
        let (first, second) = (half(), half());
        Ok(StepsResult { predicted, found: (second / first).ln(), too_slow: false })
    }

    fn judge(all: &[&Done<'_, StepsResult>]) -> Vec<Row> {
        let found = joined(all, "; ", |one| one.found.described(&one.trial.get::<String>("named")));
        let verdict = Verdict::of_all(all.iter().map(|one| one.found.verdict(one.trial.get("grows"))));
        let trial = &all[0].trial;
        vec![Row::of(trial, found, verdict).with(scan(&trial.scheme().quadratic()))]
    }
}

impl StepsResult {
    fn described(&self, at: &str) -> String {
        match self {
            StepsResult { predicted, .. } if *predicted == 0.0 => format!("{at}: bounded"),
            StepsResult { too_slow: true, predicted, .. } => {
                format!("{at}: {predicted:.1e} a step, too slow to be seen")
            }
            StepsResult { predicted, found, .. } => {
                format!("{at}: {predicted:.2e} a step, off by {:.0e} of it", (found / predicted - 1.0).abs())
            }
        }
    }

    /// Where states may grow, or may not.
    fn verdict(&self, grows: bool) -> Verdict {
        match self {
            // the oscillators of a difference do not grow, nor does a step off the resonances
            StepsResult { predicted, .. } if *predicted > 0.0 && !grows => Verdict::Differs,
            StepsResult { predicted, found, .. } if *predicted == 0.0 => Verdict::from(*found <= SAME),
            // the others of the row decide
            StepsResult { too_slow: true, .. } => Verdict::Agrees,
            StepsResult { predicted, found, .. } => Verdict::from((found / predicted - 1.0).abs() <= TOLERANCE),
        }
    }
}

/// The two oscillators at q = (1, 1/2), p = 0, with B in the kicks.
fn system() -> System {
    let [first, second] = OMEGAS.map(|omega| &rational(omega) * rational(omega));
    let parameters = [("a", first.clone()), ("b", second.clone()), ("delta", rational(DELTA))];
    let state = ([1.0, 0.5].map(rational).to_vec(), [0.0, 0.0].map(rational).to_vec());
    let mut system = of_formula("(a*x^2 + b*y^2 + delta*(x + y)^2)/2", &parameters, &["x", "y"], state);
    let zero = rational(0.0);
    system.parts = Parts::Linear(Linear::new(vec![vec![first, zero.clone()], vec![zero, second]]));
    system
}

/// The step size near a resonance at which states grow fastest; at one without growth, the resonance itself.
fn strongest(scheme: &TableScheme, h: f64) -> f64 {
    let growth = |h: f64| Matrix::of_step(scheme, h).growth();
    // B shifts the frequencies by δ/2ω
    let near = |width: f64, about: f64| {
        let sizes = (-200..=200).map(|i| about * (1.0 + width * f64::from(i) / 200.0));
        sizes.max_by(|a, b| growth(*a).total_cmp(&growth(*b))).expect("there are some")
    };
    let coarse = near(WINDOW, h);
    if growth(coarse) > 0.0 { near(WINDOW / 100.0, coarse) } else { h }
}

/// About a resonance.
const WINDOW: f64 = 0.015;

/// The growth at step sizes from well below the resonances to above.
fn scan(scheme: &TableScheme) -> Vec<(f64, f64)> {
    let sizes = (0..4000).map(|i| 1.8 + f64::from(i) * (3.3 - 1.8) / 4000.0);
    sizes
        .map(|h| (h, Matrix::of_step(scheme, h).growth()))
        .map(|(h, growth)| (h, if growth > 0.0 { growth.log10() } else { f64::NAN }))
        .collect()
}

/// A step as a matrix of q₁, q₂, p₁, p₂.
struct Matrix([[f64; 4]; 4]);

impl Matrix {
    fn of_step(scheme: &TableScheme, h: f64) -> Matrix {
        let mut step = Matrix::identity();
        for map in scheme.proved().scheme.maps() {
            let weight = h * <f64 as Number>::from_rational(&map.weight, &());
            let map = match map.kind {
                MapKind::Drift => Matrix::drift(weight),
                MapKind::Kick => Matrix::kick(weight),
                MapKind::GradientKick => unreachable!("schemes with gradient kicks are left out"),
            };
            step = map.after(&step);
        }
        step
    }

    fn identity() -> Matrix {
        Matrix(std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j)))))
    }

    fn drift(t: f64) -> Matrix {
        let mut drift = Matrix::identity();
        for (i, omega) in OMEGAS.into_iter().enumerate() {
            let (sin, cos) = (omega * t).sin_cos();
            (drift.0[i][i], drift.0[i][i + 2]) = (cos, sin / omega);
            (drift.0[i + 2][i], drift.0[i + 2][i + 2]) = (-omega * sin, cos);
        }
        drift
    }

    fn kick(weight: f64) -> Matrix {
        let mut kick = Matrix::identity();
        for i in 2..4 {
            (kick.0[i][0], kick.0[i][1]) = (-weight * DELTA, -weight * DELTA);
        }
        kick
    }

    fn after(&self, first: &Matrix) -> Matrix {
        let entry = |i: usize, j: usize| (0..4).map(|k| self.0[i][k] * first.0[k][j]).sum();
        Matrix(std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))))
    }

    fn trace(&self) -> f64 {
        (0..4).map(|i| self.0[i][i]).sum()
    }

    /// log of the largest modulus of an eigenvalue μ, 0 if all are on the unit circle.
    ///
    /// With μ also 1/μ is one. z = μ + 1/μ has z² − tr M z + (tr² M − tr M²)/2 − 2 = 0, and log|μ| = arcosh((|z/2 −
    /// 1| + |z/2 + 1|)/2).
    fn growth(&self) -> f64 {
        let (trace, trace_of_square) = (self.trace(), self.after(self).trace());
        let discriminant = trace * trace - 2.0 * (trace * trace - trace_of_square) + 8.0;
        let root = discriminant.abs().sqrt();
        let roots = match discriminant >= 0.0 {
            true => [((trace + root) / 4.0, 0.0), ((trace - root) / 4.0, 0.0)],
            false => [(trace / 4.0, root / 4.0); 2],
        };
        let growth = |(re, im): (f64, f64)| ((re - 1.0).hypot(im) + (re + 1.0).hypot(im)).max(2.0) / 2.0;
        let growth = roots.map(growth).into_iter().fold(1.0, f64::max).acosh();
        if growth > NO_GROWTH { growth } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use shadowstep_scenes::arithmetic::Arithmetic;
    use shadowstep_scenes::library::scheme;

    #[test]
    fn the_matrix_is_that_of_a_step() {
        for name in ["stormer-verlet", "abah864"] {
            let scheme = scheme(name).unwrap();
            let h = step_size(2.3);
            let mut run = start_in(Arithmetic::DOUBLE, &system(), steps_of(&scheme, &h, Begin::Step));
            let before = [run.q(0), run.q(1), run.p(0), run.p(1)];
            run.step();
            let matrix = Matrix::of_step(&scheme.quadratic(), 2.3);
            let after = matrix.0.map(|row| row.iter().zip(&before).map(|(a, x)| a * x).sum::<f64>());
            for (found, expected) in [run.q(0), run.q(1), run.p(0), run.p(1)].into_iter().zip(after) {
                assert!((found - expected).abs() < 1e-14, "{name}: {found} {expected}");
            }
        }
    }

    /// Of Störmer–Verlet, in first order of δ: hδ/2ω at 2ωh = 2π, hδ/2√(ω₁ω₂) at the sum.
    #[test]
    fn growth_at_the_resonances_of_verlet() {
        let verlet = scheme("stormer-verlet").unwrap().quadratic();
        let rate =
            |at: f64, omega: f64| (Matrix::of_step(&verlet, strongest(&verlet, at)).growth(), at * DELTA / 2.0 / omega);
        let [first, second] = OMEGAS;
        let sum = rate(TAU / (first + second), (first * second).sqrt());
        for (found, expected) in [rate(PI / first, first), rate(PI / second, second), sum] {
            assert!((found / expected - 1.0).abs() < 0.03, "{found} {expected}");
        }
        assert_eq!(rate(TAU / (second - first), 1.0).0, 0.0);
    }

    #[test]
    fn what_differs_from_the_eigenvalues_differs() {
        let found = |predicted: f64, found: f64| StepsResult { predicted, found, too_slow: false };
        assert_eq!(found(1e-2, 1.0001e-2).verdict(true), Verdict::Agrees);
        assert_eq!(found(1e-2, 1.01e-2).verdict(true), Verdict::Differs);
        assert_eq!(found(0.0, 0.5).verdict(false), Verdict::Differs);
        assert_eq!(found(1e-3, 1e-3).verdict(false), Verdict::Differs);
    }
}
