//! Names in formulas.

use std::collections::BTreeMap;

use shadowstep_schemes::symbolic::{Expression, ExpressionKind, evaluate, parse};

use super::reader::Reader;
use shadowstep_schemes::document::Text;

/// Refuses a name that formulas cannot contain.
pub(super) fn check_name(reader: &mut Reader<'_>, name: &Text) {
    let is_name =
        |expression: &Expression| matches!(&expression.kind, ExpressionKind::Name(whole) if *whole == name.value);
    match parse(&name.value) {
        // `_1` may stand for a part of a formula, and `_` is a name in no language of emitted code
        Ok(expression) if is_name(&expression) && !name.value.starts_with('_') => {
            // a name that has a value by itself is a constant
            if evaluate(&expression, &BTreeMap::new(), 1).is_ok() {
                reader.toml.fault(&name.at, format!("`{}` is a constant", name.value), "give it another name");
            }
        }
        _ => {
            let help = "a name consists of letters, digits and _, and begins with a letter";
            reader.toml.fault(&name.at, format!("`{}` is not a valid name", name.value), help);
        }
    }
}
