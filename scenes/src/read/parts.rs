//! How H is split: the words of the key `parts`, one for each kind of split that needs no more than its name.

use shadowstep::systems::wisdom_holman::Bodies;
use shadowstep_schemes::document::{Section, Value};
use toml::de::DeValue;

use super::given::Given;
use super::reader::Reader;
use crate::arithmetic::Arithmetic;
use crate::refusal::Refusal;
use crate::scene::split::{CanonicalCoordinates, KineticAndPotential, LINEAR, Linear, Planets};
use crate::scene::{InitialValueProblem, Parts, System};

/// The parts of a problem, or why it has none of this kind; with the bodies that attract each other and their dimensions, if it is a problem of these.
pub(super) type Split = fn(&InitialValueProblem, Arithmetic, Option<(Bodies, usize)>) -> Result<Parts, Refusal>;

const KINETIC_AND_POTENTIAL: Split = |_, _, _| Ok(Parts::KineticAndPotential(KineticAndPotential));

/// The values of `parts`.
const WORDS: [(&str, Split); 4] = [
    (CanonicalCoordinates::Jacobi.name(), |problem, _, bodies| {
        Planets::of(CanonicalCoordinates::Jacobi, problem, bodies).map(Parts::WisdomHolman)
    }),
    (CanonicalCoordinates::DemocraticHeliocentric.name(), |problem, _, bodies| {
        Planets::of(CanonicalCoordinates::DemocraticHeliocentric, problem, bodies).map(Parts::WisdomHolman)
    }),
    (LINEAR, |problem, arithmetic, bodies| Linear::of(problem, arithmetic, bodies.is_some()).map(Parts::Linear)),
    ("kinetic-potential", KINETIC_AND_POTENTIAL),
];

/// Whether the value of `parts` is a list of formulas.
pub(super) fn is_list(value: &Value<'_>) -> bool {
    matches!(value.get_ref(), DeValue::Array(_))
}

/// The kind of split that a word asks for: by default T(p) and U(q).
pub(super) fn of_word(reader: &mut Reader<'_>, problem: &Section<'_, '_>) -> Option<Split> {
    let word = problem.get("parts").filter(|value| !is_list(value));
    word.map_or(Some(KINETIC_AND_POTENTIAL), |value| reader.word(value, &WORDS))
}

/// The problem in the parts that its steps have.
pub(super) fn split(
    reader: &mut Reader<'_>,
    given: &Given,
    problem: InitialValueProblem,
    split: Split,
    bodies: Option<(Bodies, usize)>,
) -> Option<System> {
    match split(&problem, reader.arithmetic, bodies) {
        Ok(parts) => Some(System { problem, parts }),
        Err(Refusal { message, hint }) => {
            reader.toml.wrong(given.place("parts").unwrap_or(&given.problem), message, hint)
        }
    }
}
