//! The variables of a system by formulas: coordinates and momenta, their second copies, t and its momentum.

use num_traits::Zero;
use shadowstep_schemes::document::{Placed, Text};
use shadowstep_schemes::symbolic::Exact;

use super::explicit_time::{MOMENTUM, TIME};
use super::given::Given;
use super::names::check_name;
use super::reader::Reader;
use crate::columns::fixed_names;
use crate::scene::{InitialValueProblem, KineticEnergy, PotentialEnergy};

/// What the names of second copies end with.
pub(super) const SECOND: &str = "_2";

/// The variables of a system.
pub(super) struct Variables {
    pub(super) coordinates: Vec<String>,
    pub(super) momenta: Vec<String>,
    /// How many coordinates the text names: second copies and t come after them.
    pub(super) count: usize,
    is_copied: bool,
    explicit_time: bool,
    /// Whether all names are valid.
    pub(super) are_valid: bool,
}

/// Positions and momenta, where they can be read.
type State = (Option<Vec<Exact>>, Option<Vec<Exact>>);

impl Variables {
    /// Those that the text names, perhaps each a second time, and perhaps t.
    pub(super) fn read(
        reader: &mut Reader<'_>,
        given: &Given<'_, '_>,
        is_copied: bool,
        explicit_time: bool,
    ) -> Option<Variables> {
        let before = reader.toml.faults.len();
        check_names(reader, given, &given.problem.list("coordinates")?);
        let (mut coordinates, mut momenta) = names(given)?;
        let count = coordinates.len();
        for names in [&mut coordinates, &mut momenta].into_iter().filter(|_| is_copied) {
            let own = names.len();
            names.extend_from_within(..);
            names[own..].iter_mut().for_each(|name| name.push_str(SECOND));
        }
        if explicit_time {
            let parameters = given.parameters.iter().map(|(name, _)| &name.value);
            if parameters.chain(&coordinates).chain(&momenta).any(|name| name == MOMENTUM) {
                let message = format!("`{MOMENTUM}` is the name of the momentum of t, on which H depends");
                let help = "give the coordinate, momentum or parameter of this name another one";
                reader.toml.fault(&given.problem.place("coordinates"), message, help);
            }
            coordinates.push(TIME.to_owned());
            momenta.push(MOMENTUM.to_owned());
        }
        let are_valid = reader.toml.faults.len() == before;
        Some(Variables { coordinates, momenta, count, is_copied, explicit_time, are_valid })
    }

    /// The state at t = 0; with masses, if `v` gives velocities.
    pub(super) fn state(&self, reader: &mut Reader<'_>, given: &Given<'_, '_>, masses: Option<&[Exact]>) -> State {
        let left_out = (self.is_copied, self.explicit_time);
        let (q, p) = given.state.values(
            reader,
            |reader, numbers| numbers.values_of_all(reader, self.coordinates.len(), left_out),
            masses,
        );
        // another t would not be that of the rows
        if self.explicit_time && q.as_ref().and_then(|q| q.last()).is_some_and(|t| !t.value.is_zero()) {
            let help = "write the phase in the formula: cos(w*t + 1)";
            reader.toml.fault(&given.initial.at, "t must be 0 at the start", help);
        }
        (q, p)
    }

    /// The problem with these energies and this state.
    pub(super) fn problem(
        self,
        (potential, kinetic): (PotentialEnergy, KineticEnergy),
        parameters: Vec<(String, Exact)>,
        (q, p): State,
    ) -> Option<InitialValueProblem> {
        let Variables { coordinates, momenta, explicit_time, .. } = self;
        let (q, p) = (q?, p?);
        Some(InitialValueProblem { potential, kinetic, parameters, coordinates, momenta, q, p, explicit_time })
    }
}

/// The names of the coordinates and momenta as they are given, valid or not: by default, momenta are named after the
/// coordinates.
pub(super) fn names(given: &Given<'_, '_>) -> Option<(Vec<String>, Vec<String>)> {
    let names = |key| Some(given.problem.list(key)?.value.into_iter().map(|name| name.value).collect::<Vec<_>>());
    let coordinates = names("coordinates")?;
    let momenta = names("momenta").unwrap_or_else(|| coordinates.iter().map(|name| format!("p{name}")).collect());
    Some((coordinates, momenta))
}

/// Checks the names of the coordinates and of their momenta: each is different from all other names.
fn check_names(reader: &mut Reader<'_>, given: &Given<'_, '_>, list: &Placed<Vec<Text>>) {
    let mut taken: Vec<(String, String)> =
        fixed_names().map(|name| (name.to_owned(), "of a column of the output".to_owned())).collect();
    taken.extend(reader.names.iter().map(|(name, _)| (name.clone(), "of an axis or a column".to_owned())));
    taken.extend(given.parameters.iter().map(|(name, _)| (name.value.clone(), "of a parameter".to_owned())));
    for name in &list.value {
        check_name(reader, name);
        // by default, momenta are named after the coordinates
        let momentum = given.place("momenta").is_none().then(|| format!("p{}", name.value));
        let is_its = |other: &String| *other == name.value || momentum.as_ref() == Some(other);
        if let Some((other, whose)) = taken.iter().find(|(other, _)| is_its(other)) {
            let message = match *other == name.value {
                true if whose == COORDINATE => format!("the coordinate `{other}` is named twice"),
                true => format!("the coordinate `{other}` has the name {whose}"),
                false => format!("the momentum `{other}` of `{}` has the name {whose}", name.value),
            };
            reader.toml.fault(&name.at, message, "give it another name");
        }
        taken.push((name.value.clone(), COORDINATE.to_owned()));
        taken.extend(momentum.map(|momentum| (momentum, format!("of the momentum of `{}`", name.value))));
    }
    if let Some(momenta) = given.problem.list("momenta") {
        check_momenta(reader, &momenta, list.value.len(), taken);
    }
}

const COORDINATE: &str = "of a coordinate";

/// Checks the names of the momenta: one for each coordinate, and each different from all other names.
fn check_momenta(
    reader: &mut Reader<'_>,
    list: &Placed<Vec<Text>>,
    coordinates: usize,
    mut taken: Vec<(String, String)>,
) {
    for name in &list.value {
        check_name(reader, name);
        if let Some((other, whose)) = taken.iter().find(|(other, _)| *other == name.value) {
            reader.toml.fault(&name.at, format!("the momentum `{other}` has the name {whose}"), "give it another name");
        }
        taken.push((name.value.clone(), "of another momentum".to_owned()));
    }
    if list.value.len() != coordinates {
        let message = "this list needs a name for each coordinate";
        reader.wrong_count::<()>(&list.at, message, (list.value.len(), coordinates));
    }
}
