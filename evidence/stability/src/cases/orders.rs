//! The proved orders, seen in the errors of nonlinear problems at 100 digits.

use serde::{Deserialize, Serialize};
use shadowstep::number::{AnyLimbs, LimbCount};
use shadowstep::steps::integrator::at_output;
use shadowstep::systems::kepler_drift::KeplerDrift;
use shadowstep::tables::TableScheme;
use shadowstep::{Number, Rational, Real, StepSize, exact};
use shadowstep_scenes::arithmetic::{Arithmetic, Digits, Numbers};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::Begin;
use shadowstep_scenes::{Error, Formulas, Parts, PotentialEnergy, System};
use shadowstep_schemes::MapKind;
use shadowstep_schemes::proof::Order;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve, Marker};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::integrator::{start, step_size, steps_of};
use crate::suite::{Examined, Suite};
use crate::systems::{known_values, names, of_formula, rationals, shipped};

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
const TOO_FEW_DIGITS: &str = "The weights have too few digits for these errors; weights with more would decide.";
/// ε of A + εB: its square does not show.
const EPSILON: &str = "1e-40";

impl Case for Orders {
    const NAME: &'static str = "orders";
    const TITLE: &'static str = "Orders on nonlinear problems, at 100 digits";
    const THEORY: &'static str = "Where order r is proved, the error of the state after a fixed time is proportional \
        to h^r for small h: measured against Kepler's equation on an orbit with e = 0.2. Gradient kicks have their \
        order for quadratic T; a processor raises the order of the kernel to the effective one. A composition has its \
        order for three parts too: the same orbit with H split into p_x²/2 + κ x p_y, p_y²/2 − κ x p_y and −1/r, no \
        two of which commute. For H = A + εB with A = p²/2, B = −cos q and ε = 1e-40 the error of H is ε times a \
        power of h, which is the order of the terms of ε.";
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

    fn measure(suite: &Suite, trial: &Trial, arithmetic: Arithmetic, _: Continues<'_>) -> Result<Errors, Error> {
        // one number type has the digits, and no other is compiled
        let Numbers::Digits(_, Digits::Limbs(limbs)) = arithmetic.numbers() else {
            unreachable!("the digits are those of limbs")
        };
        let scheme = suite.scheme(&trial.scheme);
        Ok(Errors(trial.halvings.map(|halvings| {
            let h = &step_size(Rational::new(1.into(), (1_i64 << halvings).into()));
            match trial.of {
                Of::Epsilon => energy_error((scheme, h), 1 << halvings, limbs),
                Of::ThreeParts => {
                    distance(&in_parts(), (&for_many_parts(scheme), h), 1 << halvings, Begin::Step, limbs)
                }
                Of::Processed => distance(&orbit(), (scheme, h), 1 << halvings, Begin::InitialState, limbs),
                Of::Steps => distance(&orbit(), (scheme, h), 1 << halvings, Begin::Step, limbs),
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
    use shadowstep_scenes::library::scheme;

    fn errors(name: &str, of: Of) -> Errors {
        let suite = Suite::new(vec![scheme(name).unwrap()], Arithmetic::DOUBLE, true);
        let trial = Orders::trials(&suite).into_iter().find(|trial| trial.of == of).unwrap();
        Orders::measure(&suite, &trial, Orders::arithmetic(&suite), &|_| true).unwrap()
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
