//! Oscillators that drifts solve exactly, with a quadratic perturbation in the kicks: where its resonances are, and how
//! fast states grow there.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};
use shadowstep::Number;
use shadowstep::systems::QUADRATIC_FLOW_DIGITS;
use shadowstep::tables::TableScheme;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::start::Begin;
use shadowstep_scenes::{Error, Linear, Parts, System};
use shadowstep_schemes::MapKind;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::growth::{TOLERANCE, growth, steps_to_see};
use crate::integrator::{start_in, step_size, steps_of};
use crate::suite::{Examined, Suite};
use crate::systems::{of_formula, rational};

/// The case.
pub(super) struct LinearPartCase;

/// A scheme at a step size.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    at: At,
    /// Exact.
    h: f64,
    /// The most steps.
    steps: u64,
}

/// Where the step size is.
#[derive(Clone, Copy, PartialEq, Serialize)]
enum At {
    /// On no resonance, beyond the limit of T(p) and U(q) for most schemes.
    Beyond,
    /// 2ω₁h = 2π
    First,
    /// 2ω₂h = 2π
    Second,
    /// (ω₁ + ω₂)h = 2π
    Sum,
    /// (ω₂ − ω₁)h = 2π
    Difference,
}

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
const SCHEMES: [&str; 6] = ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b", "saba4", "abah864", "kahan-li8"];

impl At {
    const ALL: [At; 5] = [At::Beyond, At::First, At::Second, At::Sum, At::Difference];

    /// The step size at which the resonance is without B.
    fn step_size(self) -> f64 {
        let [first, second] = OMEGAS;
        match self {
            At::Beyond => 2.8,
            At::First => PI / first,
            At::Second => PI / second,
            At::Sum => TAU / (first + second),
            At::Difference => TAU / (second - first),
        }
    }

    fn named(self) -> &'static str {
        match self {
            At::Beyond => "hω₂ = 4.5",
            At::First => "2ω₁",
            At::Second => "2ω₂",
            At::Sum => "ω₁ + ω₂",
            At::Difference => "ω₂ − ω₁",
        }
    }
}

impl Case for LinearPartCase {
    const NAME: &'static str = "linear-part";
    const TITLE: &'static str = "Oscillations solved exactly, with a perturbation in the kicks";
    const THEORY: &'static str = "H = A + B with two oscillators, ω₁ = 1 and ω₂ = 1.6, as A, which drifts solve, and \
        B = δ(q₁ + q₂)²/2, δ = 0.01, in the kicks. There is no limit of hω. A step is a symplectic matrix; its \
        eigenvalues leave the unit circle in narrow bands about 2ω_i h = 2πm and (ω₁ + ω₂)h = 2πm, and |(q, p)| grows \
        like exp(λn) there, with the largest log of their moduli as λ. Of Störmer–Verlet λ is nearly hδ/2ω_i or \
        hδ/2√(ω₁ω₂); kicks at several places within a step act against each other there. At (ω₂ − ω₁)h = 2πm both \
        have the same sign, and nothing grows.";
    const REVISION: u32 = 1;

    type Trial = Trial;
    type Measured = StepsResult;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let steps = suite.full_or_quick(400_000, 20_000);
        let trials = |examined: &&Examined| {
            let scheme = &examined.scheme.quadratic();
            let trial = |at: At| Trial { scheme: examined.identity.clone(), at, h: strongest(scheme, at), steps };
            At::ALL.map(trial)
        };
        // gradient kicks are for T(p) and U(q)
        let schemes = suite.schemes_or(&SCHEMES).into_iter();
        schemes
            .filter(|examined| !examined.scheme.scheme.proved().scheme.has_gradient_kicks())
            .collect::<Vec<_>>()
            .iter()
            .flat_map(trials)
            .collect()
    }

    /// Flows of quadratic forms have no more digits.
    fn arithmetic(suite: &Suite) -> Arithmetic {
        match suite.arithmetic.digits() > QUADRATIC_FLOW_DIGITS {
            true => Arithmetic::with_digits(QUADRATIC_FLOW_DIGITS).expect("numbers of limbs have them"),
            false => suite.arithmetic,
        }
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        trial.steps as f64 * suite.scheme(&trial.scheme).scheme.proved().plan.evaluations as f64 * 60e-9
    }

    fn measure(suite: &Suite, trial: &Trial, arithmetic: Arithmetic, _: Continues<'_>) -> Result<StepsResult, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let predicted = Matrix::of_step(&scheme.quadratic(), trial.h).growth();
        let mut run = start_in(arithmetic, &system(), steps_of(scheme, &step_size(trial.h), Begin::Step));
        if predicted > 0.0 {
            let count = steps_to_see(predicted);
            let too_slow = 2 * count > trial.steps;
            let found = if too_slow { 0.0 } else { growth(&mut *run, (predicted, count)) };
            return Ok(StepsResult { predicted, found, too_slow });
        }
        let mut half = || {
            (0..trial.steps / 20).fold(0.0, |largest: f64, _| {
                run.step();
                largest.max(run.size())
            })
        };
        let (first, second) = (half(), half());
        Ok(StepsResult { predicted, found: (second / first).ln(), too_slow: false })
    }

    fn judge(suite: &Suite, measured: &[(Trial, StepsResult)]) -> Finding {
        let (mut finding, mut curves) = (Finding::default(), Vec::new());
        for all in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let named = suite.scheme(&all[0].0.scheme);
            let parts: Vec<_> = all.iter().map(|(trial, found)| found.described(trial.at)).collect();
            let verdict = Verdict::of_all(all.iter().map(|(trial, found)| found.verdict(trial.at)));
            finding.check(&named.name, parts.join("; "), verdict);
            curves.push(Curve::line(named.name.clone(), scan(&named.quadratic()), curves.len()));
        }
        let (x, y) = (Axis::linear("h"), Axis::log10("growth per step, from the eigenvalues"));
        finding.chart(
            Chart::new("Where a step with an exact linear part is unstable", x, y, curves),
            "The bands are at 2ω₂h = 2π, (ω₁ + ω₂)h = 2π and 2ω₁h = 2π; schemes without a mark have none at these \
                step sizes.",
        );
        finding
    }
}

impl StepsResult {
    fn described(&self, at: At) -> String {
        let at = at.named();
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

    fn verdict(&self, at: At) -> Verdict {
        match self {
            // the oscillators of a difference do not grow, nor does a step off the resonances
            StepsResult { predicted, .. } if *predicted > 0.0 && matches!(at, At::Difference | At::Beyond) => {
                Verdict::Differs
            }
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
fn strongest(scheme: &TableScheme, at: At) -> f64 {
    let h = at.step_size();
    if at == At::Beyond {
        return h;
    }
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
    use super::*;
    use shadowstep_scenes::library::scheme;

    #[test]
    fn more_digits_than_flows_of_quadratic_forms_have_are_cut_to_these() {
        let digits = |digits| {
            let arithmetic = Arithmetic::with_digits(digits).unwrap();
            LinearPartCase::arithmetic(&Suite::new(Vec::new(), arithmetic, true)).digits()
        };
        assert_eq!([30, 288, 300].map(digits), [30, 288, 288]);
    }

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
        let rate = |at: At, omega: f64| {
            (Matrix::of_step(&verlet, strongest(&verlet, at)).growth(), at.step_size() * DELTA / 2.0 / omega)
        };
        let [first, second] = OMEGAS;
        for (found, expected) in
            [rate(At::First, first), rate(At::Second, second), rate(At::Sum, (first * second).sqrt())]
        {
            assert!((found / expected - 1.0).abs() < 0.03, "{found} {expected}");
        }
        assert_eq!(rate(At::Difference, 1.0).0, 0.0);
    }

    #[test]
    fn what_differs_from_the_eigenvalues_differs() {
        let found = |predicted: f64, found: f64| StepsResult { predicted, found, too_slow: false };
        assert_eq!(found(1e-2, 1.0001e-2).verdict(At::Sum), Verdict::Agrees);
        assert_eq!(found(1e-2, 1.01e-2).verdict(At::Sum), Verdict::Differs);
        assert_eq!(found(0.0, 0.5).verdict(At::Beyond), Verdict::Differs);
        assert_eq!(found(1e-3, 1e-3).verdict(At::Difference), Verdict::Differs);
    }
}
