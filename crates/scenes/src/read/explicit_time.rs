//! t in the formulas of a scene: H depends on time. Then t is a coordinate, after all others, and `pt` its momentum.
//!
//! Where only U depends on t, the parts are T(p) + p_t and U(q, t), with all schemes for T and U. Where T does, too,
//! they are formulas of parts.

use shadowstep_schemes::document::Text;
use shadowstep_schemes::symbolic::parse;

use super::given::Given;
use super::reader::Reader;

/// The name of the coordinate, which is that of the column of the time.
pub(super) const TIME: &str = "t";
/// The name of its momentum.
pub(super) const MOMENTUM: &str = "pt";

/// Whether t occurs in a formula; not where it is a parameter or an axis.
pub(super) fn is_in(reader: &Reader<'_>, given: &Given<'_, '_>, formula: &str) -> bool {
    let axes = reader.names.iter().map(|(name, _)| name);
    if given.parameters.iter().map(|(name, _)| &name.value).chain(axes).any(|name| name == TIME) {
        return false;
    }
    parse(formula).is_ok_and(|syntax| syntax.mentions(TIME))
}

/// Whether t occurs in T.
pub(super) fn is_in_kinetic(reader: &Reader<'_>, given: &Given<'_, '_>) -> bool {
    given.problem.str("kinetic").is_some_and(|formula| is_in(reader, given, formula))
}

/// Refuses t in formulas of bodies; `what` does not depend on it.
pub(super) fn refuse<'a>(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    formulas: impl IntoIterator<Item = Option<&'a Text>>,
    what: &str,
) -> Option<()> {
    let Some(formula) = formulas.into_iter().flatten().find(|formula| is_in(reader, given, &formula.value)) else {
        return Some(());
    };
    let help = "write all of U as `potential`, in which t is the time";
    reader.toml.wrong(&formula.at, format!("{what} does not depend on t"), help)
}

/// Adds p_t to the first part in which t has no place, or as a part of its own.
pub(super) fn add_momentum(reader: &Reader<'_>, given: &Given<'_, '_>, formulas: &mut Vec<Text>) {
    match formulas.iter_mut().find(|formula| !is_in(reader, given, &formula.value)) {
        Some(formula) => formula.value += &format!(" + {MOMENTUM}"),
        None => {
            let mut alone = formulas[0].clone();
            MOMENTUM.clone_into(&mut alone.value);
            formulas.push(alone);
        }
    }
}
