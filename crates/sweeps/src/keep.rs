//! \[keep\]: what is kept of each run.

use shadowstep_scenes::expression::{Condition, Expression, named};
use shadowstep_scenes::extremum::Extremum;
use shadowstep_scenes::schema::Table;
use shadowstep_schemes::document::{Reader, Text};
use toml::de::DeTable;

use crate::keys;
use crate::values::{Description, Need, RunValue, VALUES};

/// What is kept of each run.
#[derive(Clone, Debug)]
pub(crate) struct Keep {
    /// Values in the order of the text.
    pub(crate) values: Vec<RunValue>,
    /// Whether q and p of the last state are kept.
    pub(crate) state: bool,
    /// Expressions at the last state.
    pub(crate) at_end: Vec<(Text, Expression)>,
    /// Expressions whose least or greatest value over the run is kept.
    pub(crate) extremes: Vec<(Text, Expression, Extremum)>,
    /// Conditions, of which the time of the first state that meets them is kept.
    pub(crate) first_time: Vec<(Text, Condition)>,
    /// Those of them that end the run, by their places.
    pub(crate) stop: Vec<usize>,
    /// Whether the rows of the scene's \[output\] are kept.
    pub(crate) rows: bool,
}

/// A column of the results.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Whether its values are numbers.
    pub is_number: bool,
    /// Whether these are exact, such as 7/24.
    pub is_exact: bool,
}

impl Keep {
    pub(crate) fn read(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<Keep> {
        let section = Table::of(reader.source, root, &keys::KEEP);
        if !section.is_there() {
            let hint = "add [keep] with values = [\"verdict\", \"energy_error\"], for example";
            return reader.wrong(&(0..0), "the section [keep] is missing", hint);
        }
        let before = reader.faults.len();
        let values = values(reader, &section);
        let mut formulas = |key| named(reader, &section, key).unwrap_or_default();
        let at_end = formulas("at_end").into_iter().map(|(name, text)| (name, Expression::new(text))).collect();
        let mut extremes = Vec::new();
        for (key, extremum) in [("min", Extremum::Least), ("max", Extremum::Greatest)] {
            extremes.extend(formulas(key).into_iter().map(|(name, text)| (name, Expression::new(text), extremum)));
        }
        let conditions = formulas("first_time");
        let stop = stop(reader, &section, &conditions);
        let condition = |(name, text)| Some((name, Condition::read(reader, &text)?));
        let first_time = conditions.into_iter().filter_map(condition).collect();
        let [state, rows] = ["state", "rows"].map(|key| section.truth(key) == Some(true));
        let keep = Keep { values, state, at_end, extremes, first_time, stop, rows };
        refuse_repeated(reader, &keep);
        if keep.columns(&[]).is_empty() && !keep.state && !keep.rows && reader.faults.len() == before {
            reader.fault(&section.at, "nothing is kept", "write values = [\"verdict\", \"energy_error\"], for example");
        }
        (reader.faults.len() == before).then_some(keep)
    }

    /// The columns, for a state with these coordinates and momenta.
    pub(crate) fn columns(&self, state: &[String]) -> Vec<Column> {
        let column = |name: &str, is_number, is_exact| Column { name: name.to_owned(), is_number, is_exact };
        let values = self.values.iter().map(|kept| {
            let Description { name, is_number, .. } = kept.description();
            column(name, *is_number, false)
        });
        let times = self.first_time.iter().map(|(name, _)| column(&name.value, true, true));
        let ends = self.at_end.iter().map(|(name, _)| column(&name.value, true, false));
        let extremes = self.extremes.iter().map(|(name, ..)| column(&name.value, true, false));
        let states = state.iter().filter(|_| self.state).map(|name| column(name, true, false));
        values.chain(times).chain(ends).chain(extremes).chain(states).collect()
    }

    /// The names of formulas and conditions.
    pub(crate) fn named(&self) -> impl Iterator<Item = &Text> {
        let times = self.first_time.iter().map(|(name, _)| name);
        let ends = self.at_end.iter().map(|(name, _)| name);
        times.chain(ends).chain(self.extremes.iter().map(|(name, ..)| name))
    }

    /// All formulas, those of conditions included.
    pub(crate) fn formulas(&self) -> impl Iterator<Item = &Expression> {
        let conditions = self.first_time.iter().map(|(_, condition)| condition.difference());
        let ends = self.at_end.iter().map(|(_, end)| end);
        conditions.chain(ends).chain(self.extremes.iter().map(|(_, expression, _)| expression))
    }

    /// How many tangent vectors a run has.
    pub(crate) fn vectors(&self) -> usize {
        usize::from(self.needs(Need::Tangents)) + usize::from(self.values.contains(&RunValue::Sali))
    }

    pub(crate) fn needs(&self, need: Need) -> bool {
        self.values.iter().any(|kept| kept.description().need == need)
    }
}

fn values(reader: &mut Reader<'_>, section: &Table<'_, '_>) -> Vec<RunValue> {
    let mut kept = Vec::new();
    for text in section.list("values").into_iter().flat_map(|list| list.value) {
        match VALUES.iter().find(|value| value.name == text.value) {
            Some(Description { kept: known, .. }) if kept.contains(known) => {
                reader.fault(&text.at, format!("`{}` is there twice", text.value), "keep one of the two");
            }
            known => kept.extend(known.map(|known| known.kept)),
        }
    }
    kept
}

/// Places of conditions of these names.
fn stop(reader: &mut Reader<'_>, section: &Table<'_, '_>, conditions: &[(Text, Text)]) -> Vec<usize> {
    let mut found = Vec::new();
    for name in section.list("stop").into_iter().flat_map(|list| list.value) {
        match conditions.iter().position(|(known, _)| known.value == name.value) {
            Some(place) => found.push(place),
            None => {
                let hint = "first_time = { escape = \"x^2 + y^2 > 100\" } and stop = [\"escape\"]";
                reader.fault(&name.at, format!("first_time has no `{}`", name.value), format!("write {hint}"));
            }
        }
    }
    found
}

fn refuse_repeated(reader: &mut Reader<'_>, keep: &Keep) {
    let mut seen: Vec<&str> = keep.values.iter().map(|kept| kept.description().name).collect();
    seen.extend(["run", "failure"]);
    for name in keep.named() {
        if seen.contains(&name.value.as_str()) {
            reader.fault(&name.at, format!("a column is named `{}` already", name.value), "give it another name");
        }
        seen.push(&name.value);
    }
}
