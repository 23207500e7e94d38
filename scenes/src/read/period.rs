//! How often something is written: `true`, or `{ every = 10 }`.

use shadowstep_schemes::document::Section;
use toml::de::DeValue;

use super::reader::Reader;
use crate::steps::MOST_STEPS;

/// The value of a key that is `true`, `false` or a table: the period, and the table.
pub(super) fn every<'t, 'i>(
    reader: &mut Reader<'_>,
    output: &Section<'t, 'i>,
    key: &'static str,
    section: &'static str,
) -> Option<(u64, Option<Section<'t, 'i>>)> {
    let value = output.get(key)?;
    match value.get_ref() {
        DeValue::Boolean(true) => Some((1, None)),
        DeValue::Boolean(false) => None,
        DeValue::Table(table) => {
            let table = reader.table(table, value, section);
            let every = match table.get("every") {
                Some(value) => reader.whole(value, 1..=MOST_STEPS)?,
                None => 1,
            };
            Some((every, Some(table)))
        }
        _ => reader.toml.wrong_kind(value, "true, or a table: { every = 10 }"),
    }
}
