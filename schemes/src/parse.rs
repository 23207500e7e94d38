//! TOML text → the cells and claims of a table, with their places.

use toml::de::{DeTable, DeValue};

use crate::claims::{HIGHEST_LINEAR_ORDER, HIGHEST_NEAR_INTEGRABLE_ORDER, HIGHEST_ORDER, Kinetic, NearIntegrable};
use crate::document::{Fault, Key, Keys, Placed, Reader, Section, Source, Text, Value, document};
use crate::map_kind::MapKind;
use crate::spelling::spelling;
use crate::symbolic::nearest;
use crate::table::{Cell, Inner, MOST_STAGES, Processor, Table, Weights};

const TABLE: [Key; 17] = [
    Key::new("name", "\"my-scheme\""),
    Key::new("title", "\"Yoshida's triple jump of order 4\""),
    Key::new("aliases", "[\"Forest-Ruth\"]"),
    Key::new("order", "4"),
    Key::new("kinetic", "\"any\""),
    Key::new("near_integrable", "[8, 2]"),
    Key::new("dominant", "\"drift\""),
    Key::new("symmetric", "true"),
    Key::new("digits", "15"),
    Key::new("reference", "\"H. Yoshida, Phys. Lett. A 150 (1990) 262-268\""),
    Key::new("doi", "\"10.1016/0375-9601(90)90092-3\""),
    Key::new("constants", "{ g1 = \"1/(2 - 2^(1/3))\" }"),
    Key::new("free", "[\"g1\"]"),
    Key::new("composition", "{ base = \"stormer-verlet\", gamma = [\"g1\", \"1 - 2*g1\", \"g1\"] }"),
    Key::new("stages", "{ kick = [\"1/2\", \"1/2\"], drift = [1, 0] }"),
    Key::new("processor", "{ order = 4, kick = [\"1/24\", \"-1/24\"], drift = [\"1/2\", \"-1/2\"] }"),
    Key::new("inner", "{ base = \"stormer-verlet\", substeps = 8 }"),
];

const INNER: [Key; 2] = [Key::new("base", "\"stormer-verlet\""), Key::new("substeps", "8")];

const PROCESSOR: [Key; 6] = [
    Key::new("order", "4"),
    Key::new("near_integrable", "[4, 2]"),
    Key::new("dominant", "\"drift\""),
    Key::new("kick", "[\"1/24\", \"-1/24\"]"),
    Key::new("drift", "[\"1/2\", \"-1/2\"]"),
    Key::new("gamma", "[\"g1\", \"-g1\"]"),
];

const STAGES: [Key; 3] = [
    Key::new("kick", "[\"1/2\", \"1/2\"]"),
    Key::new("gradient_kick", "[0, \"1/72\", 0]"),
    Key::new("drift", "[1, 0]"),
];

const COMPOSITION: [Key; 2] =
    [Key::new("base", "\"stormer-verlet\""), Key::new("gamma", "[\"g1\", \"1 - 2*g1\", \"g1\"]")];

const CELL_EXAMPLES: &str = "1, 0.25 or an expression in quotes, \"1/(2 - 2^(1/3))\"";

/// The most names in a list.
const MOST_NAMES: usize = 200;

/// Reads a table's text and all its faults: of the TOML, unknown or missing or repeated keys, values of the wrong kind.
///
/// If the text is TOML at all, the table is there too, so that its cells can be evaluated as well; in place of missing
/// claims it has claims that every scheme meets.
pub fn table(source: &Source) -> (Option<Table>, Vec<Fault>) {
    let (document, faults) = document(source);
    let Some(document) = document else { return (None, faults) };
    let mut reader = Reader::new(source, faults);
    let table = read(&mut reader, &document);
    (Some(table), reader.faults)
}

fn read(reader: &mut Reader<'_>, document: &DeTable<'_>) -> Table {
    let root = &reader.table(document, 0..0, Keys::new("a table", TABLE));
    let name = reader.required(root, "name").and_then(|v| name(reader, v));
    let order = reader.required(root, "order").and_then(|v| reader.whole(v, 1..=HIGHEST_ORDER, "an order"));
    let kinetic = reader.required(root, "kinetic").and_then(|v| {
        reader.word(v, &[("any", Kinetic::Any), ("quadratic", Kinetic::Quadratic)]).map(|kinetic| kinetic.value)
    });
    let reference = root.get("reference").and_then(|v| trimmed(reader, v));
    let title = root.get("title").and_then(|v| trimmed(reader, v));
    let aliases = aliases(reader, root, name.as_ref());
    let near_integrable = near_integrable(reader, root);
    let doi = root.get("doi").and_then(|v| doi(reader, v));
    let symmetric = root.get("symmetric").and_then(|v| reader.truth(v));
    let digits = root.get("digits").and_then(|v| reader.whole(v, 1..=300, "a number of digits"));
    let constants = constants(reader, root);
    let free = free(reader, root, &constants);
    let weights = weights(reader, root, document);
    let kinetic = kinetic.unwrap_or(Kinetic::Quadratic);
    let kinetic = refuse_beside_gradient_kicks(reader, root, weights.as_ref(), kinetic);
    let processor = root.get("processor").and_then(|_| processor(reader, document, weights.as_ref()));
    let inner = root.get("inner").and_then(|_| inner(reader, root, document, kinetic));
    Table {
        source: reader.source.clone(),
        name: name.unwrap_or(Placed { value: "unnamed".to_owned(), at: 0..0 }),
        title: title.map(|t| t.value),
        aliases,
        order: order.unwrap_or(Placed { value: 1, at: 0..0 }),
        kinetic,
        near_integrable: near_integrable.filter(|_| inner.is_none()),
        symmetric,
        digits,
        reference: reference.map(|r| r.value),
        doi: doi.map(|d| d.value),
        constants,
        free,
        weights,
        processor,
        inner,
    }
}

/// The inner scheme, and claims that there are beside none.
fn inner(reader: &mut Reader<'_>, root: &Section<'_, '_>, document: &DeTable<'_>, kinetic: Kinetic) -> Option<Inner> {
    let of_two = ["near_integrable", "processor"].map(|key| (key, "is claimed of two parts, which there are not"));
    let quadratic = (kinetic == Kinetic::Quadratic).then_some(("kinetic", "must be \"any\""));
    for (key, wrong) in of_two.into_iter().chain(quadratic) {
        if let Some(value) = root.get(key) {
            let hint = "with [inner], H = slow + fast + T has three parts: leave it out, or leave [inner] out";
            let hint = if key == "kinetic" { "the order of three parts is that for every T(p)" } else { hint };
            reader.fault(&value.span(), format!("`{key}` {wrong} beside an inner scheme"), hint);
        }
    }
    let section = reader.section(document, "inner", Keys::new("[inner]", INNER));
    let base = reader.required(&section, "base").and_then(|v| trimmed(reader, v));
    let substeps = reader.required(&section, "substeps");
    let substeps = substeps.and_then(|v| reader.whole(v, 1..=MOST_STAGES as u32, "a number of substeps"));
    Some(Inner { base: base?, substeps: substeps?.value })
}

/// A text without blanks at its ends.
fn trimmed(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Placed<String>> {
    let text = reader.text(value)?;
    Some(Placed { value: text.value.trim().to_owned(), at: text.at })
}

fn name(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Placed<String>> {
    let name = trimmed(reader, value)?;
    if name.value.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-') {
        return Some(name);
    }
    let hint = "use small letters, digits and hyphens, as in \"blanes-moan-s6\"";
    reader.wrong(&name.at, format!("`{}` is not a valid name of a scheme", name.value), hint)
}

fn aliases(reader: &mut Reader<'_>, root: &Section<'_, '_>, name: Option<&Placed<String>>) -> Vec<Placed<String>> {
    let aliases = list(reader, root, "aliases", "a list of names, such as [\"PEFRL\"]", trimmed);
    let mut known: Vec<_> = name.map(|name| spelling(&name.value)).into_iter().collect();
    for alias in &aliases {
        let spelt = spelling(&alias.value);
        if spelt.is_empty() {
            let message = format!("`{}` is not a valid name", alias.value);
            reader.fault(&alias.at, message, "a name has letters or digits");
        } else if known.contains(&spelt) {
            let hint = "small and capital letters, hyphens, blanks and the like make no difference: leave it out";
            reader.fault(&alias.at, format!("`{}` is a name of this table already", alias.value), hint);
        }
        known.push(spelt);
    }
    aliases
}

/// The readable members of the list of a key; none where the key is left out.
fn list<T>(
    reader: &mut Reader<'_>,
    root: &Section<'_, '_>,
    key: &str,
    what: &str,
    read: impl FnMut(&mut Reader<'_>, &Value<'_>) -> Option<T>,
) -> Vec<T> {
    let value = root.get(key).filter(|value| reader.has_at_most(value, MOST_NAMES, "names"));
    value.map_or_else(Vec::new, |value| reader.readable_members(value, what, read))
}

fn near_integrable(reader: &mut Reader<'_>, root: &Section<'_, '_>) -> Option<NearIntegrable> {
    let kinds = [("drift", MapKind::Drift), ("kick", MapKind::Kick)];
    let dominant = root.get("dominant").and_then(|v| reader.word(v, &kinds));
    let Some(value) = root.get("near_integrable") else {
        if let Some(value) = root.get("dominant") {
            let hint = "add `near_integrable = [8, 2]`, the orders claimed, or leave it out";
            reader.fault(&value.span(), "`dominant` needs near-integrable orders", hint);
        }
        return None;
    };
    // words of n letters have at most n B's
    if !reader.has_at_most(value, HIGHEST_NEAR_INTEGRABLE_ORDER as usize, "orders") {
        return None;
    }
    // of the powers of ε, the first one alone has its own words, unless it stands for all
    let several = matches!(value.get_ref(), DeValue::Array(orders) if orders.len() > 1);
    let mut highest = if several { HIGHEST_LINEAR_ORDER } else { HIGHEST_NEAR_INTEGRABLE_ORDER };
    let order = |reader: &mut Reader<'_>, v: &Value<'_>| {
        reader.whole(v, 1..=std::mem::replace(&mut highest, HIGHEST_NEAR_INTEGRABLE_ORDER), "an order")
    };
    let orders = reader.readable_members(value, "a list of orders, such as [8, 2]", order);
    for pair in orders.windows(2).filter(|pair| pair[0].value < pair[1].value) {
        let message =
            format!("order {} is claimed for a higher power of ε than order {}", pair[1].value, pair[0].value);
        reader.fault(&pair[1].at, message, "the orders for ε, ε², … do not increase");
    }
    Some(NearIntegrable { orders, dominant: dominant.map_or(MapKind::Drift, |kind| kind.value) })
}

fn doi(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Placed<String>> {
    let doi = trimmed(reader, value)?;
    if doi.value.starts_with("10.") && doi.value.contains('/') {
        return Some(doi);
    }
    let hint = "a DOI looks like \"10.1016/0375-9601(90)90092-3\", without https://doi.org/";
    reader.wrong(&doi.at, format!("`{}` is not a valid DOI", doi.value), hint)
}

fn constants(reader: &mut Reader<'_>, root: &Section<'_, '_>) -> Vec<(Placed<String>, Cell)> {
    let Some(value) = root.get("constants") else { return Vec::new() };
    let DeValue::Table(table) = value.get_ref() else {
        reader.wrong_kind::<()>(value, "a table of constants: [constants]");
        return Vec::new();
    };
    let mut constants = Vec::new();
    if !reader.has_at_most(value, MOST_STAGES, "constants") {
        return constants;
    }
    for (key, value) in table {
        let name = Placed { value: key.get_ref().to_string(), at: key.span() };
        if !is_constant_name(&name.value) {
            let hint = "the name of a constant is a letter, then letters, digits and _";
            reader.fault(&name.at, format!("`{}` is not a valid name of a constant", name.value), hint);
        } else if let Some(cell) = cell(reader, value) {
            constants.push((name, cell));
        }
    }
    constants.sort_by_key(|(name, _)| name.at.start);
    constants
}

fn is_constant_name(name: &str) -> bool {
    let mut letters = name.chars();
    letters.next().is_some_and(|c| c.is_ascii_alphabetic()) && letters.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

fn free(reader: &mut Reader<'_>, root: &Section<'_, '_>, constants: &[(Placed<String>, Cell)]) -> Vec<Placed<String>> {
    let free = list(reader, root, "free", "a list of constants, such as [\"g1\"]", trimmed);
    let names = || constants.iter().map(|(name, _)| name.value.as_str());
    for name in free.iter().filter(|name| !names().any(|known| known == name.value)) {
        let hint = match nearest(&name.value, names()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "free parameters are names of [constants]".to_owned(),
        };
        reader.fault(&name.at, format!("there is no constant `{}`", name.value), hint);
    }
    free
}

fn weights(reader: &mut Reader<'_>, root: &Section<'_, '_>, document: &DeTable<'_>) -> Option<Weights> {
    match (root.get("stages"), root.get("composition")) {
        (Some(_), None) => {
            let section = reader.section(document, "stages", Keys::new("[stages]", STAGES));
            stages(reader, &section, section.get("gradient_kick"))
        }
        (None, Some(_)) => {
            let section = reader.section(document, "composition", Keys::new("[composition]", COMPOSITION));
            let base = reader.required(&section, "base").and_then(|v| trimmed(reader, v));
            let gamma = reader.required(&section, "gamma").and_then(|v| cells(reader, v));
            Some(Weights::Composition { base: base?, gamma: gamma? })
        }
        (Some(_), Some(both)) => {
            reader.wrong(&both.span(), "stages and a composition are both given", "keep one of the two")
        }
        (None, None) => {
            let hint = "add [stages] with kick and drift, or [composition] with base and gamma";
            reader.wrong(&(0..0), "the weights are missing", hint)
        }
    }
}

/// The processor of a kernel with these weights: like them, it has stages, or is a composition of the same base.
fn processor(reader: &mut Reader<'_>, document: &DeTable<'_>, kernel: Option<&Weights>) -> Option<Processor> {
    let of_kernels = |word: &str| (word == "gradient_kick").then_some("[stages]: only kernels have gradient kicks");
    let section = reader.section(document, "processor", Keys::new("[processor]", PROCESSOR).with_elsewhere(of_kernels));
    let order = reader.required(&section, "order").and_then(|v| reader.whole(v, 1..=HIGHEST_ORDER, "an order"));
    let near_integrable = near_integrable(reader, &section);
    let post = match kernel {
        Some(Weights::Composition { base, .. }) => {
            refuse_weights(reader, &section, &["kick", "drift"], "the kernel is a composition: write `gamma`");
            let gamma = reader.required(&section, "gamma").and_then(|v| cells(reader, v));
            gamma.map(|gamma| Weights::Composition { base: base.clone(), gamma })
        }
        _ => {
            refuse_weights(reader, &section, &["gamma"], "the kernel has stages: write `kick` and `drift`");
            stages(reader, &section, None)
        }
    };
    Some(Processor { order: order?, near_integrable, post })
}

fn refuse_weights(reader: &mut Reader<'_>, section: &Section<'_, '_>, keys: &[&str], hint: &str) {
    for (key, value) in keys.iter().filter_map(|key| Some((key, section.get(key)?))) {
        reader.fault(&value.span(), format!("`{key}` is not for this processor"), hint);
    }
}

fn stages(reader: &mut Reader<'_>, section: &Section<'_, '_>, gradient_kick: Option<&Value<'_>>) -> Option<Weights> {
    let kick = reader.required(section, "kick").and_then(|v| cells(reader, v));
    let gradient_kick = gradient_kick.map(|v| cells(reader, v));
    let drift = reader.required(section, "drift").and_then(|v| cells(reader, v));
    let (kick, drift) = (kick?, drift?);
    // without its gradient kicks it would be another scheme
    let gradient_kick = match gradient_kick {
        Some(cells) => Some(cells?),
        None => None,
    };
    let stages = kick.value.len();
    let others = [("drift", Some(&drift)), ("gradient_kick", gradient_kick.as_ref())];
    for (name, cells) in others {
        let Some(cells) = cells.filter(|cells| cells.value.len() != stages) else { continue };
        let found = format!("{stages} for the kicks, {} for the {}s", cells.value.len(), name.replace('_', " "));
        let message = format!("kick and {name} must have as many weights as there are stages");
        let hint = "each stage is a kick and then a drift; write 0 where there is none";
        let fault = reader.source.fault(&cells.at, message).values(found, "the same number of both");
        reader.faults.push(fault.hint(hint));
        return None;
    }
    Some(Weights::Stages { kick, gradient_kick, drift })
}

/// Refuses claims that a scheme with gradient kicks cannot make: these are p += 2h³ c U_qq M⁻¹U_q. Returns the kinetic
/// energies that it is for.
fn refuse_beside_gradient_kicks(
    reader: &mut Reader<'_>,
    root: &Section<'_, '_>,
    weights: Option<&Weights>,
    kinetic: Kinetic,
) -> Kinetic {
    let Some(Weights::Stages { gradient_kick: Some(_), .. }) = weights else { return kinetic };
    if let Some(value) = root.get("kinetic").filter(|_| kinetic == Kinetic::Any) {
        let hint = "they contain M⁻¹ of T = ½pᵀM⁻¹p: write `kinetic = \"quadratic\"`";
        reader.fault(&value.span(), "gradient kicks are for quadratic T only", hint);
    }
    Kinetic::Quadratic
}

fn cells(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Placed<Vec<Cell>>> {
    if !reader.has_at_most(value, MOST_STAGES, "weights") {
        return None;
    }
    reader.list(value, "a list of weights, such as [\"1/2\", \"1/2\"]", cell)
}

/// The place of an expression is inside the quotes.
fn cell(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Cell> {
    reader.number(value, CELL_EXAMPLES).map(Text::inside_quotes)
}
