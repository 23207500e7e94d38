//! `modified_hamiltonian` in [output]: the modified Hamiltonian of the scheme as a formula, whose values are columns.

use shadowstep_schemes::document::{Text, Value, whole_number};
use toml::de::DeValue;

use super::reader::Reader;
use super::run::Steps;
use crate::document::expression::Expression;
use crate::document::schema::Table;
use crate::motion::modified_hamiltonian::SymbolicHamiltonian;
use crate::scene::{NamedExpression, System, ValueColumns};

/// The name of the key, with which those of the columns begin.
pub(super) const KEY: &str = "modified_hamiltonian";

/// The columns: that of one grade, or those of a list.
pub(super) fn columns(
    reader: &mut Reader<'_>,
    output: &Table<'_, '_>,
    system: Option<&System>,
    steps: Option<&Steps>,
) -> Option<ValueColumns> {
    let value = output.get(KEY)?;
    let table = output.table(KEY);
    let every = table.as_ref().and_then(|table| table.whole("every")).unwrap_or(1);
    let grades = grades(table.map_or(Some(value), |table| table.get("grade"))?);
    let (system, Steps { scheme, displaced, h, .. }) = (system?, steps?);
    if *displaced {
        let help = "write gradient_kicks = \"exact\", or `modified_energy` for its values";
        return reader.toml.wrong(&value.span(), "displaced forces have another modified Hamiltonian", help);
    }
    let highest = *grades.iter().max()?;
    // a system with faults may have no formula, as one with a mass of 0
    if !reader.toml.faults.is_empty() {
        return None;
    }
    let derived = SymbolicHamiltonian::of(system).and_then(|mut symbolic| match reader.is_cursory {
        true => Ok(None),
        false => Ok(Some((symbolic.modified(scheme.scheme.proved(), highest)?, symbolic))),
    });
    let derived = reader.found(&value.span(), derived)?;
    let column = |grade: u32| {
        let expression = match &derived {
            Some((terms, symbolic)) => {
                Expression::derived(symbolic.up_to(terms, grade, h), Text::at(KEY, value.span()))
            }
            None => Expression::new(Text::at("0", value.span())),
        };
        NamedExpression { name: format!("{KEY}_{grade}"), at: value.span(), expression }
    };
    Some(ValueColumns { every, expressions: grades.into_iter().map(column).collect() })
}

/// A power of h, or several.
fn grades(value: &Value<'_>) -> Vec<u32> {
    let members = match value.get_ref() {
        DeValue::Array(members) => &members[..],
        _ => std::slice::from_ref(value),
    };
    members.iter().filter_map(whole_number).filter_map(|grade| u32::try_from(grade).ok()).collect()
}
