//! How H is split: the words of the key `parts`, one for each kind of split that needs no more than its name.

use shadowstep::systems::wisdom_holman::Bodies;

use super::given::Given;
use super::reader::Reader;
use crate::document::schema::Table;
use crate::run::arithmetic::Arithmetic;
use crate::scene::split::{CanonicalCoordinates, KineticAndPotential, LINEAR, Linear, Planets};
use crate::scene::{InitialValueProblem, Parts, System};
use crate::texts::refusal::Refusal;

/// The parts of a problem, or why it has none of this kind; with the bodies that attract each other and their
/// dimensions, if it is a problem of these.
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

/// The kind of split that a word asks for: by default T(p) and U(q).
pub(super) fn of_word(problem: &Table<'_, '_>) -> Split {
    problem.word("parts", &WORDS).unwrap_or(KINETIC_AND_POTENTIAL)
}

/// The problem in the parts that its steps have.
pub(super) fn split(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    problem: InitialValueProblem,
    split: Split,
    bodies: Option<(Bodies, usize)>,
) -> Option<System> {
    let parts = reader.found(&given.problem.place("parts"), split(&problem, reader.arithmetic, bodies))?;
    Some(System { problem, parts })
}
