//! `values`, `elements` and `extremes` in [output]: expressions as columns, and their least and greatest values.

use shadowstep_schemes::document::Text;

use super::modified_hamiltonian;
use super::names::check_name;
use super::reader::Reader;
use super::run::Steps;
use crate::columns::fixed_names;
use crate::columns::quantity_of_bodies::{BARYCENTRE, JACOBI, elements_of};
use crate::document::expression::{Expression, named};
use crate::document::schema::Table;
use crate::scene::{NamedExpression, System, ValueColumns};

/// The key that gives the period of values.
const EVERY: &str = "every";

/// The columns of `values`, `elements` and `modified_hamiltonian`.
pub(super) fn columns(
    reader: &mut Reader<'_>,
    output: &Table<'_, '_>,
    system: Option<&System>,
    steps: Option<&Steps>,
) -> Vec<ValueColumns> {
    let before = reader.toml.faults.len();
    let mut found: Vec<ValueColumns> = Vec::new();
    found.extend(values(reader, output, system));
    found.extend(elements(reader, output, system));
    found.extend(modified_hamiltonian::columns(reader, output, system, steps));
    let Some(system) = system else { return found };
    let mut taken: Vec<&str> = fixed_names().collect();
    taken.extend(system.columns().map(String::as_str));
    for NamedExpression { name, at, .. } in found.iter().flat_map(|columns| &columns.expressions) {
        if taken.contains(&name.as_str()) {
            reader.toml.fault(at, format!("there is another column `{name}`"), "give this one another name");
        }
        taken.push(name);
    }
    if reader.toml.faults.len() > before { Vec::new() } else { found }
}

/// `values = { r = "sqrt(x^2 + y^2)", every = 10 }`
fn values(reader: &mut Reader<'_>, output: &Table<'_, '_>, system: Option<&System>) -> Option<ValueColumns> {
    let every = output.table("values")?.whole(EVERY).unwrap_or(1);
    Some(ValueColumns { every, expressions: expressions(reader, output, "values", system)? })
}

/// `extremes = { r = "sqrt(x^2 + y^2)" }`
pub(super) fn extremes(
    reader: &mut Reader<'_>,
    output: &Table<'_, '_>,
    system: Option<&System>,
) -> Vec<NamedExpression> {
    output.get("extremes").and_then(|_| expressions(reader, output, "extremes", system)).unwrap_or_default()
}

/// The formulas of a table, the period excepted.
fn expressions(
    reader: &mut Reader<'_>,
    output: &Table<'_, '_>,
    key: &str,
    system: Option<&System>,
) -> Option<Vec<NamedExpression>> {
    let before = reader.toml.faults.len();
    let mut found = Vec::new();
    for (name, text) in named(&mut reader.toml, output, key)?.into_iter().filter(|(name, _)| name.value != EVERY) {
        check_name(reader, &name);
        let expression = Expression::new(text);
        if let Some(system) = system {
            system.check(&expression, &mut reader.toml);
        }
        found.push(NamedExpression { name: name.value, at: name.at, expression });
    }
    if found.is_empty() && reader.toml.faults.len() == before {
        reader.toml.fault(&output.place(key), "there is no formula", "write { r = \"sqrt(x^2 + y^2)\" }, for example");
    }
    (reader.toml.faults.len() == before).then_some(found)
}

/// `elements = true`, or `{ every = 10, centre = "jacobi" }`: those of all bodies but the first.
fn elements(reader: &mut Reader<'_>, output: &Table<'_, '_>, system: Option<&System>) -> Option<ValueColumns> {
    let (every, table) = output.every("elements")?;
    let words = [("jacobi", JACOBI), ("barycentric", BARYCENTRE)];
    let centre = table.and_then(|table| table.word("centre", &words));
    let (system, at) = (system?, output.place("elements"));
    let mut expressions = Vec::new();
    for (name, formula) in elements_of(system, centre) {
        let expression = Expression::new(Text::at(&formula, at.clone()));
        expressions.push(NamedExpression { name, at: at.clone(), expression });
    }
    let Some(NamedExpression { expression, .. }) = expressions.first() else {
        let help = "write `values` with formulas in its coordinates and momenta";
        return reader.toml.wrong(&at, "this system has no bodies with orbits", help);
    };
    system.check(expression, &mut reader.toml).map(|()| ValueColumns { every, expressions })
}
