//! `modified_hamiltonian` in [output]: the modified Hamiltonian of the scheme as a formula, whose values are columns.

use shadowstep_analysis::modified::HIGHEST_GRADE;
use shadowstep_schemes::document::{Section, Text, Value};
use toml::de::DeValue;

use super::reader::Reader;
use super::run::Steps;
use crate::expression::Expression;
use crate::modified_hamiltonian::SymbolicHamiltonian;
use crate::refusal::Refusal;
use crate::scene::{NamedExpression, System, ValueColumns};
use crate::steps::MOST_STEPS;

/// The name of the key, with which those of the columns begin.
pub(super) const KEY: &str = "modified_hamiltonian";

/// The columns: that of one grade, or those of a list.
pub(super) fn columns(
    reader: &mut Reader<'_>,
    output: &Section<'_, '_>,
    system: Option<&System>,
    steps: Option<&Steps>,
) -> Option<ValueColumns> {
    let value = output.get(KEY)?;
    let (every, grades) = match value.get_ref() {
        DeValue::Table(table) => {
            let table = reader.table(table, value, "output.modified_hamiltonian");
            let every = table.get("every").map_or(Some(1), |value| reader.whole(value, 1..=MOST_STEPS));
            let Some(grades) = table.get("grade") else {
                reader.toml.missing(&table, &["grade"]);
                return None;
            };
            (every?, grades)
        }
        _ => (1, value),
    };
    let grades = self::grades(reader, grades)?;
    let (system, Steps { scheme, displaced, h, .. }) = (system?, steps?);
    if *displaced {
        let help = "write gradient_kicks = \"exact\", or `modified_energy` for its values";
        return reader.toml.wrong(&value.span(), "displaced forces have another modified Hamiltonian", help);
    }
    let highest = *grades.iter().max()?;
    let derived = SymbolicHamiltonian::of(system).and_then(|mut symbolic| match reader.is_cursory {
        true => Ok(None),
        false => Ok(Some((symbolic.modified(scheme.scheme.proved(), highest)?, symbolic))),
    });
    let derived = match derived {
        Ok(derived) => derived,
        Err(Refusal { message, hint }) => return reader.toml.wrong(&value.span(), message, hint),
    };
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
fn grades(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Vec<u32>> {
    let grade = |reader: &mut Reader<'_>, value: &Value<'_>| {
        reader.whole(value, 1..=HIGHEST_GRADE.into()).and_then(|grade| u32::try_from(grade).ok())
    };
    match value.get_ref() {
        DeValue::Array(grades) if !grades.is_empty() => {
            grades.iter().map(|value| grade(reader, value)).collect::<Vec<_>>().into_iter().collect()
        }
        DeValue::Integer(_) => Some(vec![grade(reader, value)?]),
        _ => reader
            .toml
            .wrong_kind(value, "the highest power of h, a list of such, or a table: { grade = 4, every = 10 }"),
    }
}
