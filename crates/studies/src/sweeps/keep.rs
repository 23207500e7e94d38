//! \[keep\]: what is kept of each run.

use shadowstep_scenes::evaluator::{Evaluator, NotOfSystem, Test};
use shadowstep_scenes::expression::{Condition, Expression, named};
use shadowstep_scenes::extremum::Extremum;
use shadowstep_scenes::schema::Table;
use shadowstep_schemes::document::{Reader, Text};
use toml::de::DeTable;

use crate::sweeps::keys;
use crate::sweeps::values::{Need, RunValue, VALUES};

/// What is kept of each run.
#[derive(Clone, Debug)]
pub(crate) struct Keep {
    /// Values in the order of the text.
    pub(crate) values: Vec<&'static RunValue>,
    /// Conditions and expressions with their names, in the order of their columns.
    pub(crate) formulas: Vec<(Text, Formula)>,
    /// Whether q and p of the last state are kept.
    pub(crate) state: bool,
    /// Whether the rows of the scene's \[output\] are kept.
    pub(crate) rows: bool,
}

/// A formula of which something is kept.
#[derive(Clone, Debug)]
pub(crate) enum Formula {
    /// The time of the first state that meets the condition, and whether this ends the run.
    FirstTime(Condition, bool),
    /// The least or greatest value over the run; without an extremum, the one at the last state.
    Value(Expression, Option<Extremum>),
}

/// A formula in the numbers of a run, with what it has given up to now: a time or a value.
pub(crate) enum Kept<N, T, V> {
    FirstTime(Test<N>, bool, T),
    Value(Evaluator<N>, Option<Extremum>, V),
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
        let conditions = named(reader, &section, "first_time").unwrap_or_default();
        let stop = stop(reader, &section, &conditions);
        let mut formulas = Vec::new();
        for (name, text) in conditions {
            let stops = stop.contains(&name.value);
            formulas.extend(Condition::read(reader, &text).map(|read| (name, Formula::FirstTime(read, stops))));
        }
        for (key, extremum) in [("at_end", None), ("min", Some(Extremum::Least)), ("max", Some(Extremum::Greatest))] {
            let of_key = named(reader, &section, key).unwrap_or_default().into_iter();
            formulas.extend(of_key.map(|(name, text)| (name, Formula::Value(Expression::new(text), extremum))));
        }
        let [state, rows] = ["state", "rows"].map(|key| section.truth(key) == Some(true));
        let keep = Keep { values, formulas, state, rows };
        if keep.columns(&[]).is_empty() && !keep.state && !keep.rows && reader.faults.len() == before {
            reader.fault(&section.at, "nothing is kept", "write values = [\"verdict\", \"energy_error\"], for example");
        }
        (reader.faults.len() == before).then_some(keep)
    }

    /// The columns, for a state with these coordinates and momenta.
    pub(crate) fn columns(&self, state: &[String]) -> Vec<Column> {
        let column = |name: &str, is_number, is_exact| Column { name: name.to_owned(), is_number, is_exact };
        let values = self.values.iter().map(|value| column(value.name, value.is_number, false));
        let is_exact = |formula: &Formula| matches!(formula, Formula::FirstTime(..));
        let formulas = self.formulas.iter().map(|(name, formula)| column(&name.value, true, is_exact(formula)));
        let states = state.iter().filter(|_| self.state).map(|name| column(name, true, false));
        values.chain(formulas).chain(states).collect()
    }

    /// All formulas, those of conditions included.
    pub(crate) fn expressions(&self) -> impl Iterator<Item = &Expression> {
        self.formulas.iter().map(|(_, formula)| match formula {
            Formula::FirstTime(condition, _) => condition.difference(),
            Formula::Value(expression, _) => expression,
        })
    }

    /// All formulas in the numbers of a run.
    pub(crate) fn begin<N, T: Default, V: Default>(
        &self,
        test: impl Fn(&Condition) -> Result<Test<N>, NotOfSystem>,
        evaluator: impl Fn(&Expression) -> Result<Evaluator<N>, NotOfSystem>,
    ) -> Vec<Kept<N, T, V>> {
        const CHECKED: &str = "the formulas were checked with the sweep";
        let begun = |(_, formula): &(Text, Formula)| match formula {
            Formula::FirstTime(of, stops) => Kept::FirstTime(test(of).expect(CHECKED), *stops, T::default()),
            Formula::Value(of, extremum) => Kept::Value(evaluator(of).expect(CHECKED), *extremum, V::default()),
        };
        self.formulas.iter().map(begun).collect()
    }

    /// Whether more than the last state is of interest for formulas.
    pub(crate) fn follows_all(&self) -> bool {
        self.formulas.iter().any(|(_, formula)| !matches!(formula, Formula::Value(_, None)))
    }

    /// How many tangent vectors a run has.
    pub(crate) fn vectors(&self) -> usize {
        let vectors = |value: &&RunValue| if let Need::Tangents(count) = value.need { count } else { 0 };
        self.values.iter().map(vectors).max().unwrap_or(0)
    }

    pub(crate) fn needs(&self, need: Need) -> bool {
        self.values.iter().any(|value| value.need == need)
    }
}

fn values(reader: &mut Reader<'_>, section: &Table<'_, '_>) -> Vec<&'static RunValue> {
    let mut kept: Vec<&RunValue> = Vec::new();
    for text in section.list("values").into_iter().flat_map(|list| list.value) {
        if kept.iter().any(|value| value.name == text.value) {
            reader.fault(&text.at, format!("`{}` is there twice", text.value), "keep one of the two");
        }
        kept.extend(VALUES.iter().find(|value| value.name == text.value));
    }
    kept
}

/// The names of conditions that end the run.
fn stop(reader: &mut Reader<'_>, section: &Table<'_, '_>, conditions: &[(Text, Text)]) -> Vec<String> {
    let names: Vec<Text> = section.list("stop").into_iter().flat_map(|list| list.value).collect();
    for name in names.iter().filter(|name| conditions.iter().all(|(known, _)| known.value != name.value)) {
        let hint = "write first_time = { escape = \"x^2 + y^2 > 100\" } and stop = [\"escape\"]";
        reader.fault(&name.at, format!("first_time has no `{}`", name.value), hint);
    }
    names.into_iter().map(|name| name.value).collect()
}
