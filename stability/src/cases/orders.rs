//! The proved orders, seen in the errors of nonlinear problems at 100 digits.

use serde::{Deserialize, Serialize};
use shadowstep::number::CorrectlyRounded;
use shadowstep::problems::Kepler;
use shadowstep::systems::formula::FormulaPotential;
use shadowstep::systems::kepler_drift::KeplerDrift;
use shadowstep::systems::many_parts::{SystemOfParts, parts};
use shadowstep::tables::TableScheme;
use shadowstep::{Motion, Rational, Stepper, System, UnitMasses, exact};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::RunNumber;
use shadowstep_schemes::MapKind;
use shadowstep_schemes::proof::Order;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve, Marker};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::suite::{Examined, Suite};

/// The case.
pub(super) struct Orders;

/// A scheme, and what of it is measured.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    of: Of,
    /// The step sizes are 2^−k of the problem's unit.
    halvings: [i32; 3],
}

/// What has an order.
#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
enum Of {
    /// The steps as they stand; of a processed scheme, those of the kernel.
    Steps,
    /// The steps between pre-map and post-map.
    Processed,
    /// The steps for H of three parts.
    ThreeParts,
    /// The terms of ε of H = A + εB, with the processor if there is one.
    Epsilon,
}

/// log₁₀ of the errors at the step sizes.
#[derive(Serialize, Deserialize)]
pub(super) struct Errors([f64; 3]);

/// The digits of the trials: the smallest errors are about 1e-40.
const DIGITS: u32 = 100;
/// How far a measured order may be from the proved one: the next term of the error is smaller by h, and h is 2⁻⁸ or so.
const TOLERANCE: f64 = 0.15;
/// Errors within this number of digits of the errors of the weights decide nothing.
const MARGIN: f64 = 4.0;
/// ε of A + εB: its square does not show.
const EPSILON: &str = "1e-40";

impl Case for Orders {
    const NAME: &'static str = "orders";
    const TITLE: &'static str = "Orders on nonlinear problems, at 100 digits";
    const THEORY: &'static str = "Where order r is proved, the error of the state after a fixed time is proportional to h^r for small h: measured against \
        Kepler's equation on an orbit with e = 0.2. Gradient kicks have their order for quadratic T; a processor raises the order of the kernel to the \
        effective one. A composition has its order for three parts too: the same orbit with H split into p_x²/2 + κ x p_y, p_y²/2 − κ x p_y and −1/r, no two of which \
        commute. For H = A + εB with A = p²/2, B = −cos q and ε = 1e-40 the error of H is ε times a power of h, which is the order of the terms of ε.";
    const REVISION: u32 = 2;

    type Trial = Trial;
    type Measured = Errors;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let steps = suite.full_or_quick([6, 7, 8], [5, 6, 7]);
        let of = |examined: &&Examined| {
            let proved = examined.scheme.scheme.proved();
            let all = [
                Some((Of::Steps, steps)),
                proved.proof.effective.as_ref().map(|_| (Of::Processed, steps)),
                examined.scheme.quadratic().for_many_parts().is_ok().then_some((Of::ThreeParts, steps)),
                of_epsilon(&examined.scheme.quadratic()).map(|_| (Of::Epsilon, [2, 3, 4])),
            ];
            let trial = |(of, halvings)| Trial { scheme: examined.identity.clone(), of, halvings };
            all.into_iter().flatten().map(trial).collect::<Vec<_>>()
        };
        suite.schemes_or_all().iter().flat_map(of).collect()
    }

    fn arithmetic(_: &Suite) -> Arithmetic {
        Arithmetic::with_digits(DIGITS).expect("numbers of limbs have them")
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        let evaluations = suite.scheme(&trial.scheme).scheme.proved().plan.evaluations;
        2_f64.powi(trial.halvings[2] + 1) * evaluations as f64 * 30e-9
    }

    fn measure<N: RunNumber>(
        suite: &Suite,
        trial: &Trial,
        context: &N::Context,
        _: Continues<'_>,
    ) -> Result<Errors, Error> {
        let scheme = &suite.scheme(&trial.scheme).quadratic();
        Ok(Errors(trial.halvings.map(|halvings| {
            let h = Rational::new(1.into(), (1_i64 << halvings).into());
            let stepper = Stepper::with_context(scheme.clone(), &h, context).expect("it is positive");
            match trial.of {
                Of::Epsilon => energy_error::<N>(&stepper, 1 << halvings, context),
                Of::ThreeParts => distance_in_parts::<N>(scheme, (&h, 1 << halvings), context),
                of => distance::<N>(&stepper, 1 << halvings, of == Of::Processed, context),
            }
        })))
    }

    fn judge(suite: &Suite, measured: &[(Trial, Errors)]) -> Finding {
        let mut finding = Finding::default();
        let mut points = Vec::new();
        for all in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let named = suite.scheme(&all[0].0.scheme);
            let (mut found, mut verdicts) = (Vec::new(), Vec::new());
            for (trial, errors) in all {
                let scheme = named.quadratic();
                let (what, order) = claimed(&scheme, trial.of);
                let slope = errors.order();
                found.push(format!("{what}{slope:.2}, proved {}", order.order));
                verdicts.push(errors.verdict(order));
                points.push((f64::from(order.order), slope));
            }
            finding.check(&named.name, found.join("; "), Verdict::of_all(verdicts));
        }
        let (x, y) = (Axis::linear("proved order"), Axis::linear("measured order"));
        finding.chart(
            Chart::new("Measured and proved orders", x, y, vec![Curve::dots("schemes", points, 0, Marker::Circle)]),
            "Of the two smallest of three step sizes; each mark is an order of a scheme.",
        );
        finding
    }
}

impl Errors {
    /// The slope between the two smallest step sizes.
    fn order(&self) -> f64 {
        (self.0[1] - self.0[2]) / 2_f64.log10()
    }

    fn verdict(&self, order: &Order) -> Verdict {
        let digits = order.digits.map_or(f64::from(DIGITS), |held| f64::from(held.min(DIGITS)));
        if self.0[2] < MARGIN - digits {
            return Verdict::NotDecided;
        }
        Verdict::from((self.order() - f64::from(order.order)).abs() <= TOLERANCE)
    }
}

/// What is measured, and its proved order.
fn claimed(scheme: &TableScheme, of: Of) -> (&'static str, &Order) {
    let proof = &scheme.proved().proof;
    let effective = proof.effective.as_ref();
    match of {
        Of::Steps if effective.is_some() => ("kernel ", &proof.quadratic),
        Of::Steps => ("", &proof.quadratic),
        // by the words on two letters; that it holds for three was proved when the trial was made
        Of::ThreeParts => ("of three parts ", &proof.general),
        Of::Processed => ("with its processor ", &effective.expect("it has one").quadratic),
        Of::Epsilon => ("terms of ε ", of_epsilon(scheme).expect("it has one")),
    }
}

/// The order of the terms of ε, of a scheme whose drifts move by A.
fn of_epsilon(scheme: &TableScheme) -> Option<&Order> {
    let proved = scheme.proved();
    let table = &proved.scheme.table;
    let claim = match &table.processor {
        Some(processor) => processor.near_integrable.as_ref(),
        None => table.near_integrable.as_ref(),
    };
    let drifts_dominate = claim?.dominant == MapKind::Drift;
    let orders = match &proved.proof.effective {
        Some(effective) => &effective.near_integrable,
        None => &proved.proof.near_integrable,
    };
    orders.first().filter(|_| drifts_dominate)
}

fn numbers<N: CorrectlyRounded, const D: usize>(texts: [&str; D], context: &N::Context) -> [N; D] {
    texts.map(|text| N::from_rational(&exact(text).expect("it is a number"), context))
}

/// An orbit of Kepler's problem with e = 0.2 or so.
const Q: [&str; 2] = ["1", "1/5"];
const P: [&str; 2] = ["-1/10", "9/10"];

/// log₁₀ of the distance from the exact position at t = 1.
fn distance<N: RunNumber>(stepper: &Stepper<TableScheme, N>, steps: u64, processed: bool, context: &N::Context) -> f64 {
    let (q, p) = (numbers::<N, 2>(Q, context), numbers::<N, 2>(P, context));
    let mut motion = Motion::new(Kepler, UnitMasses, q, p).expect("two coordinates");
    if processed {
        stepper.preprocess(&mut motion);
    }
    (0..steps).for_each(|_| stepper.step(&mut motion));
    if processed {
        stepper.postprocess(&mut motion);
    }
    off_the_orbit(motion.q(), context)
}

/// The same with Kepler's H as a sum of three parts.
fn distance_in_parts<N: RunNumber>(scheme: &TableScheme, (h, steps): (&Rational, u64), context: &N::Context) -> f64 {
    let formulas = ["px^2/2 + x*py/3", "py^2/2 - x*py/3", "-1/sqrt(x^2 + y^2)"];
    let parts = parts::<N>(&formulas, (&["x", "y"], &["px", "py"]), &[], context).expect("their flows have formulas");
    let mut system = SystemOfParts::new(parts, &numbers(Q, context), &numbers(P, context)).expect("two coordinates");
    let scheme = scheme.clone().for_many_parts().expect("it was when the trial was made");
    let stepper = Stepper::with_context(scheme, h, context).expect("it is positive");
    (0..steps).for_each(|_| stepper.step(&mut system));
    off_the_orbit(system.q(), context)
}

/// log₁₀ of the distance of q from the exact position at t = 1.
fn off_the_orbit<N: RunNumber>(q: &[N], context: &N::Context) -> f64 {
    let (mut exact, mut v) = (numbers::<N, 2>(Q, context), numbers::<N, 2>(P, context));
    let [one] = numbers::<N, 1>(["1"], context);
    KeplerDrift::new(context).advance(&one, &one, &mut exact, &mut v);
    let difference = |(found, exact): (&N, &N)| {
        let mut difference = found.clone();
        difference.subtract(exact);
        difference.log10_abs()
    };
    q.iter().zip(&exact).map(difference).fold(f64::NEG_INFINITY, f64::max)
}

/// log₁₀ of the largest |H − H(0)| at t = 1, 2, 3, 4, for H = p²/2 − ε cos q.
fn energy_error<N: RunNumber>(stepper: &Stepper<TableScheme, N>, steps_a_unit: u64, context: &N::Context) -> f64 {
    let [epsilon, q, p] = numbers::<N, 3>([EPSILON, "7/10", "13/10"], context);
    let potential = FormulaPotential::<N>::new("-epsilon*cos(q)", &["q"], &[("epsilon", epsilon)]);
    let mut motion = Motion::new(potential.expect("it is a formula"), UnitMasses, [q], [p]).expect("one coordinate");
    let initial = motion.energy();
    stepper.preprocess(&mut motion);
    let error = |_| {
        (0..steps_a_unit).for_each(|_| stepper.step(&mut motion));
        let mut energy = stepper.at_output(&mut motion, Motion::energy);
        energy.subtract(&initial);
        energy.log10_abs()
    };
    (0..4).map(error).fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::number::{AnyLimbs, LimbCount};
    use shadowstep_scenes::library::scheme;

    fn errors(name: &str, of: Of) -> Errors {
        let suite = Suite::new(vec![scheme(name).unwrap()], Arithmetic::DOUBLE, true);
        let trial = Orders::trials(&suite).into_iter().find(|trial| trial.of == of).unwrap();
        let six = LimbCount::of_bits(6 * 64).unwrap();
        Orders::measure::<AnyLimbs>(&suite, &trial, &six, &|_| true).unwrap()
    }

    #[test]
    fn orders_are_measured() {
        for (name, of, order) in [
            ("symplectic-euler", Of::Steps, 1.0),
            ("chin-4a", Of::Steps, 4.0),
            ("suzuki4", Of::ThreeParts, 4.0),
            ("blanes-moan-s6", Of::ThreeParts, 4.0),
            ("blanes6-7", Of::Steps, 4.0),
            ("blanes6-7", Of::Processed, 6.0),
            ("saba4", Of::Epsilon, 8.0),
            ("wisdom-corrector-11", Of::Epsilon, 12.0),
        ] {
            let found = errors(name, of).order();
            assert!((found - order).abs() < 0.3, "{name}: {found}");
        }
    }

    #[test]
    fn another_order_differs_and_too_few_digits_decide_nothing() {
        let scheme = scheme("yoshida4").unwrap().quadratic();
        let (_, order) = claimed(&scheme, Of::Steps);
        let errors = |slope: f64| Errors([2.0, 1.0, 0.0].map(|k| -10.0 + k * slope * 2_f64.log10()));
        assert_eq!(errors(4.05).verdict(order), Verdict::Agrees);
        assert_eq!(errors(2.0).verdict(order), Verdict::Differs);
        assert_eq!(errors(5.0).verdict(order), Verdict::Differs);
        let few = Order { digits: Some(12), ..order.clone() };
        assert_eq!(errors(2.0).verdict(&few), Verdict::NotDecided);
    }
}
