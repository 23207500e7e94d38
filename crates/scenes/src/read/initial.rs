//! [initial]: positions and momenta at t = 0.

use std::ops::Range;

use shadowstep_schemes::symbolic::Exact;
use shadowstep_schemes::symbolic::decimal::to_significant;

use super::bodies::Bodies;
use super::numbers::Numbers;
use super::reader::Reader;
use crate::document::schema::Table;
use crate::run::arithmetic::ANY_SIZE;
use crate::scene::{InitialValueProblem, KineticEnergy};

/// The initial state in the form in which the scene gives it.
pub(super) struct State {
    q: Option<Numbers>,
    p: Option<Numbers>,
    /// The place of `v`: then `p` is of velocities.
    velocities: Option<Range<usize>>,
}

impl State {
    /// Of bodies, or of coordinates.
    pub(super) fn read(reader: &mut Reader<'_>, initial: &Table<'_, '_>, of_bodies: bool) -> State {
        let [q, p, v] =
            ["q", "p", "v"].map(|key| initial.get(key).and_then(|value| Numbers::read(reader, value, of_bodies)));
        State { q, p: v.or(p), velocities: initial.get("v").map(|value| value.span()) }
    }

    /// Whether velocities are given in place of momenta.
    pub(super) fn has_velocities(&self) -> bool {
        self.velocities.is_some()
    }

    /// Refuses velocities: T(p) is not given by masses, but by this key, or is not given.
    pub(super) fn refuse_velocities(&self, reader: &mut Reader<'_>, given: &str) {
        if let Some(at) = &self.velocities {
            reader.toml.fault(
                at,
                format!("velocities `v` require masses, but {given}"),
                "give the momenta `p` instead of `v`",
            );
        }
    }

    /// q and p, where they are given; `read` makes values of numbers, and there is a mass for each value.
    pub(super) fn values(
        &self,
        reader: &mut Reader<'_>,
        read: impl Fn(&mut Reader<'_>, &Numbers) -> Option<Vec<Exact>>,
        masses: Option<&[Exact]>,
    ) -> (Option<Vec<Exact>>, Option<Vec<Exact>>) {
        let q = self.q.as_ref().and_then(|numbers| read(reader, numbers));
        if let (Some(numbers), Some(q)) = (&self.q, &q) {
            refuse_overflow(reader, numbers, q);
        }
        let mut p = self.p.as_ref().and_then(|numbers| read(reader, numbers));
        if let (Some(_), Some(p), Some(masses)) = (&self.velocities, &mut p, masses) {
            for (p, mass) in p.iter_mut().zip(masses) {
                p.value *= &mass.value;
                p.rounded |= mass.rounded;
            }
        }
        (q, p)
    }
}

/// The state of a problem whose other values are read: that of the problem where the section gives none.
pub(super) fn state_of(
    reader: &mut Reader<'_>,
    initial: &Table<'_, '_>,
    problem: &InitialValueProblem,
) -> (Vec<Exact>, Vec<Exact>) {
    let bodies = problem.potential.pairs().map(|pairs| {
        let bodies = Bodies { count: pairs.bodies, properties: pairs.properties.clone() };
        (bodies, pairs.dimensions)
    });
    let values = |reader: &mut Reader<'_>, numbers: &Numbers| match &bodies {
        Some((bodies, dimensions)) => bodies.values_in_space(reader, numbers, *dimensions),
        // lists are as long as that with which the problem was read
        None => {
            let copied = numbers.count().is_some_and(|count| 2 * count == problem.coordinates_of_columns());
            numbers.values_of_all(reader, problem.coordinates.len(), (copied, problem.explicit_time))
        }
    };
    let masses = match &problem.kinetic {
        KineticEnergy::Masses(masses) => masses.as_deref(),
        KineticEnergy::Formula(_) => None,
    };
    let (q, p) = State::read(reader, initial, bodies.is_some()).values(reader, values, masses);
    (q.unwrap_or_else(|| problem.q.clone()), p.unwrap_or_else(|| problem.p.clone()))
}

/// Refuses a position whose square overflows: a potential of distances would be 0 there.
fn refuse_overflow(reader: &mut Reader<'_>, numbers: &Numbers, q: &[Exact]) {
    if let Some(index) = q.iter().position(|position| !reader.arithmetic.has_square_of(&position.value)) {
        let position = to_significant(&q[index].value, 6);
        let message = format!("the square of the position {position} overflows in {}", reader.arithmetic.described());
        reader.toml.fault(numbers.place(index), message, ANY_SIZE);
    }
}
