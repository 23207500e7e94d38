//! Systems of cases that are not shipped problems.

use num_traits::FromPrimitive;
use shadowstep::problems::{Setup, problem};
use shadowstep::{Rational, exact};
use shadowstep_scenes::{Formula, InitialValueProblem, KineticEnergy, PotentialEnergy, System};
use shadowstep_schemes::symbolic::Exact;

/// A problem with some of its values set.
pub(crate) fn setup(name: &str, set: &[(&str, String)]) -> Setup {
    let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    problem(name).and_then(|problem| problem.setup(&set, 140)).expect("cases use valid problems")
}

/// The system of such a problem.
pub(crate) fn shipped(name: &str, set: &[(&str, String)]) -> System {
    System::of_setup(setup(name, set))
}

/// T(p) + U(q) with masses of 1, by the formula of U, the values of its parameters, and the state at t = 0.
pub(crate) fn of_formula(
    formula: &str,
    parameters: &[(&str, Rational)],
    coordinates: &[&str],
    (q, p): (Vec<Rational>, Vec<Rational>),
) -> System {
    let parameters: Vec<_> =
        parameters.iter().map(|(name, value)| ((*name).to_owned(), known(value.clone()))).collect();
    let coordinates = names(coordinates);
    let potential = Formula::potential(formula, &coordinates, &parameters).expect("it is a formula");
    System::from(InitialValueProblem {
        potential: PotentialEnergy::Formula(potential),
        kinetic: KineticEnergy::Masses(None),
        parameters,
        momenta: coordinates.iter().map(|name| format!("p_{name}")).collect(),
        coordinates,
        q: known_values(q),
        p: known_values(p),
        explicit_time: false,
    })
}

pub(crate) fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// A value without round-off.
fn known(value: Rational) -> Exact {
    Exact { value, rounded: false }
}

pub(crate) fn known_values(values: impl IntoIterator<Item = Rational>) -> Vec<Exact> {
    values.into_iter().map(known).collect()
}

/// The rational that a double is.
pub(crate) fn rational(x: f64) -> Rational {
    Rational::from_f64(x).expect("it is finite")
}

/// Numbers by their exact texts.
pub(crate) fn rationals<const D: usize>(texts: [&str; D]) -> Vec<Rational> {
    texts.iter().map(|text| exact(text).expect("it is a number")).collect()
}
