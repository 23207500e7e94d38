//! The proved orders, seen in the errors of nonlinear problems at 100 digits.

use serde_json::json;
use shadowstep::number::{AnyLimbs, LimbCount};
use shadowstep::steps::integrator::at_output;
use shadowstep::systems::kepler_drift::KeplerDrift;
use shadowstep::tables::TableScheme;
use shadowstep::{Real, exact};
use shadowstep_scenes::arithmetic::{Digits, Numbers};
use shadowstep_scenes::{Formulas, Parts, PotentialEnergy};
use shadowstep_schemes::MapKind;
use shadowstep_schemes::proof::Order;

use crate::chart::{Axis, Chart, Curve, Marker};
use crate::stability::prelude::*;
use crate::stability::systems::names;

/// The case.
pub(super) struct Orders;

/// What has an order.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
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

/// Of the trials.
const DIGITS: u32 = 100;
/// How far a measured order may be from the proved one: the next term of the error is smaller by h, and h is 2⁻⁸ or so.
const TOLERANCE: f64 = 0.15;
/// Errors within this number of digits of the errors of the weights decide nothing.
const MARGIN: f64 = 4.0;
const TOO_FEW_DIGITS: &str = "The weights have too few digits for these errors; weights with more would decide.";
/// Errors of the terms of ε are at their round-off for smaller steps.
const HALVINGS_OF_EPSILON: [u32; 3] = [2, 3, 4];
/// ε of A + εB: its square does not show.
const EPSILON: &str = "1e-40";

impl Case for Orders {
    type Measured = Errors;

    fn complete(scheme: &Examined, mut values: Values) -> Option<Values> {
        let scheme = scheme.scheme.quadratic();
        let has_it = match serde_json::from_value(values["of"].clone()).expect("it has an order") {
            Of::Steps => true,
            Of::Processed => scheme.proved().proof.effective.is_some(),
            Of::ThreeParts => scheme.for_many_parts().is_ok(),
            Of::Epsilon => {
                values.insert("halvings".to_owned(), json!(HALVINGS_OF_EPSILON));
                of_epsilon(&scheme).is_some()
            }
        };
        has_it.then_some(values)
    }

    fn measure(trial: &Trial<'_>, _: Continues<'_>) -> Result<Errors, Error> {
        // one number type has the digits, and no other is compiled
        let Numbers::Digits(_, Digits::Limbs(limbs)) = trial.arithmetic.numbers() else {
            unreachable!("the digits are those of limbs")
        };
        let (scheme, of) = (trial.scheme(), trial.get("of"));
        Ok(Errors(trial.get::<[u32; 3]>("halvings").map(|halvings| {
            let (h, steps) = (&step_size(Rational::new(1.into(), (1_i64 << halvings).into())), 1 << halvings);
            match of {
                Of::Epsilon => energy_error((scheme, h), steps, limbs),
                Of::ThreeParts => distance(&in_parts(), (&for_many_parts(scheme), h), steps, Begin::Step, limbs),
                Of::Processed => distance(&orbit(), (scheme, h), steps, Begin::InitialState, limbs),
                Of::Steps => distance(&orbit(), (scheme, h), steps, Begin::Step, limbs),
            }
        })))
    }

    fn judge(all: &[&Done<'_, Errors>]) -> Vec<Row> {
        let scheme = all[0].trial.scheme().quadratic();
        let of = |one: &Done<'_, Errors>| claimed(&scheme, one.trial.get("of"));
        let found = joined(all, "; ", |one| {
            let (what, order) = of(one);
            format!("{what}{:.2}, proved {}", one.found.order(), order.order)
        });
        vec![Row::of(&all[0].trial, found, Verdict::of_all(all.iter().map(|one| one.found.verdict(of(one).1))))]
    }

    fn finish(finding: &mut Finding, all: &[Done<'_, Errors>]) {
        let point = |one: &Done<'_, Errors>| {
            let order = claimed(&one.trial.scheme().quadratic(), one.trial.get("of")).1.order;
            (f64::from(order), one.found.order())
        };
        let curve = Curve::dots("schemes", all.iter().map(point).collect(), 0, Marker::Circle);
        let (x, y) = (Axis::linear("proved order"), Axis::linear("measured order"));
        finding.chart(
            Chart::new("Measured and proved orders", x, y, vec![curve]),
            "Of the two smallest of three step sizes; each mark is an order of a scheme.",
        );
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
            return Verdict::NotDecided(TOO_FEW_DIGITS);
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

/// An orbit of Kepler's problem with e = 0.2 or so.
const Q: [&str; 2] = ["1", "1/5"];
const P: [&str; 2] = ["-1/10", "9/10"];

/// Kepler's problem on this orbit.
fn orbit() -> System {
    let mut system = shipped("kepler", &[]);
    [system.problem.q, system.problem.p] = [Q, P].map(|texts| known_values(rationals(texts)));
    system
}

/// The same with H as a sum of three parts.
fn in_parts() -> System {
    let formulas = ["px^2/2 + x*py/3", "py^2/2 - x*py/3", "-1/sqrt(x^2 + y^2)"];
    let (coordinates, momenta) = (names(&["x", "y"]), names(&["px", "py"]));
    let parts = Formulas::new(&formulas, (&coordinates, &momenta), &[]).expect("their flows have formulas");
    let mut system = orbit();
    system.problem.potential = PotentialEnergy::OfParts;
    system.parts = Parts::Formulas(parts);
    system
}

fn for_many_parts(named: &NamedScheme) -> NamedScheme {
    let scheme = named.scheme.clone().for_many_parts().expect("it was when the trial was made");
    NamedScheme { name: named.name.clone(), scheme: scheme.at_run_time() }
}

/// log₁₀ of the distance from the exact position at t = 1. Steps that begin with the pre-map of a processed scheme end
/// with its post-map.
fn distance(
    system: &System,
    (scheme, h): (&NamedScheme, &StepSize),
    steps: u64,
    begin: Begin,
    limbs: LimbCount,
) -> f64 {
    let mut integrator = start::<AnyLimbs>(system, steps_of(scheme, h, begin), &limbs);
    integrator.steps(steps);
    if begin == Begin::InitialState {
        integrator.postprocess();
    }
    let numbers = |texts: [&str; 2]| texts.map(|text| number(text, limbs));
    let (mut exact, mut v, one) = (numbers(Q), numbers(P), number("1", limbs));
    KeplerDrift::new(&limbs).advance(&one, &one, &mut exact, &mut v);
    let difference = |(found, exact): (&AnyLimbs, &AnyLimbs)| {
        let mut difference = *found;
        Number::subtract(&mut difference, exact);
        difference.log10_abs()
    };
    integrator.state().q().iter().zip(&exact).map(difference).fold(f64::NEG_INFINITY, f64::max)
}

/// log₁₀ of the largest |H − H(0)| at t = 1, 2, 3, 4, for H = p²/2 − ε cos q.
fn energy_error((scheme, h): (&NamedScheme, &StepSize), steps_a_unit: u64, limbs: LimbCount) -> f64 {
    let epsilon = exact(EPSILON).expect("it is a number");
    let system =
        of_formula("-epsilon*cos(q)", &[("epsilon", epsilon)], &["q"], (rationals(["7/10"]), rationals(["13/10"])));
    let begin = |begin: Begin| start::<AnyLimbs>(&system, steps_of(scheme, h, begin), &limbs);
    let initial = begin(Begin::Step).system().energy();
    let mut integrator = begin(Begin::InitialState);
    let error = |_| {
        integrator.steps(steps_a_unit);
        let mut energy = at_output(&mut *integrator, |integrator| integrator.system().energy());
        Number::subtract(&mut energy, &initial);
        energy.log10_abs()
    };
    (0..4).map(error).fold(f64::NEG_INFINITY, f64::max)
}

fn number(text: &str, limbs: LimbCount) -> AnyLimbs {
    AnyLimbs::from_rational(&exact(text).expect("it is a number"), &limbs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim;
    use shadowstep_scenes::arithmetic::Arithmetic;
    use shadowstep_scenes::library::scheme;

    fn errors(name: &str, of: Of) -> Errors {
        let suite = Suite::new(vec![scheme(name).unwrap()], Arithmetic::DOUBLE, true);
        let table = claim::read::<Table>(include_str!("orders.toml"));
        let trial = Orders::trials(&suite, &table).into_iter().find(|trial| trial.get::<Of>("of") == of).unwrap();
        Orders::measure(&trial, &|_| true).unwrap()
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
        assert_eq!(errors(2.0).verdict(&few), Verdict::NotDecided(TOO_FEW_DIGITS));
    }
}
