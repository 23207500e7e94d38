//! Parameters that nothing contains.

use std::collections::BTreeSet;

use shadowstep_schemes::symbolic::nearest;
use toml::de::{DeTable, DeValue};

use super::reader::Reader;
use crate::document::keys::PROBLEM;
use crate::document::schema::{Table, each_text, words_of};
use shadowstep_schemes::document::Text;

/// Refuses parameters of a problem's own formulas that are in no text of the scene: `masss = 2` changes nothing. Those
/// of shipped problems are known.
pub(super) fn refuse_unused_parameters(reader: &mut Reader<'_>, root: &DeTable<'_>) {
    let problem = Table::of(reader.toml.source, root, &PROBLEM);
    let Some(DeValue::Table(parameters)) = problem.get("parameters").map(|value| value.get_ref()) else { return };
    // after other faults: a name that is unknown in a formula may be meant for it
    if problem.get("name").is_some() || !reader.toml.faults.is_empty() {
        return;
    }
    // of [[body]]
    let of_gravity = |name: &str| name == "g" && root.contains_key("body");
    let mut written = BTreeSet::new();
    root.values().for_each(|value| each_text(value, &mut |text, _| written.extend(words_of(text).map(str::to_owned))));
    for (key, _) in parameters {
        let name = Text::of_key(key);
        if of_gravity(&name.value) || written.contains(&name.value) {
            continue;
        }
        let known = PROBLEM.keys.iter().map(|key| key.name).filter(|key| *key != "parameters");
        let others = parameters.keys().map(|key| key.get_ref().as_ref()).filter(|other| *other != name.value);
        let near = nearest(&name.value, known.chain(others))
            .map_or("remove".to_owned(), |near| format!("did you mean `{near}`? Remove"));
        let message = format!("the parameter `{}` is in no formula", name.value);
        reader.toml.fault(&name.at, message, format!("{near} it, or write it where it is meant"));
    }
}
