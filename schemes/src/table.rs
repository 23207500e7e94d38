//! TOML text → the cells of a table with their places.
//!
#![doc = include_str!("../tables/README.md")]

use std::ops::Range;

use shadowstep_symbolic::nearest;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::fault::{Fault, Source};
use crate::near_integrable::{self, NearIntegrable};
use crate::reader::Reader;
use crate::scheme::MapKind;
use crate::shipped::spelling;

/// A value and its byte range in the table's text.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed<T> {
    /// The value.
    pub value: T,
    /// Where it stands.
    pub at: Range<usize>,
}

/// A cell: the text of an exact expression.
pub type Cell = Placed<String>;

/// The kinetic energies for which a scheme is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kinetic {
    /// Every T(p).
    Any,
    /// T = ½ pᵀM⁻¹p only (Runge–Kutta–Nyström schemes).
    Quadratic,
}

/// A table as written, before any cell is evaluated.
#[derive(Clone, Debug)]
pub struct Table {
    /// The text it was read from.
    pub source: Source,
    /// Short name, kebab-case.
    pub name: Placed<String>,
    /// A line for people.
    pub title: Option<String>,
    /// Other names of the scheme, as people write them.
    pub aliases: Vec<Placed<String>>,
    /// The order claimed for the kinetic energy `kinetic`.
    pub order: Placed<u32>,
    /// The kinetic energies the scheme is meant for.
    pub kinetic: Kinetic,
    /// The orders claimed for H = A + εB.
    pub near_integrable: Option<NearIntegrable>,
    /// Whether the scheme is claimed to be a palindrome.
    pub symmetric: Option<Placed<bool>>,
    /// How many digits of the cells are right, where they were rounded.
    pub digits: Option<Placed<u32>>,
    /// Who published it where.
    pub reference: String,
    /// Digital object identifier, without the resolver.
    pub doi: Option<String>,
    /// Named constants in the order of the text.
    pub constants: Vec<(Placed<String>, Cell)>,
    /// The constants that are free parameters of a family, exactly as published; all others follow from them.
    pub free: Vec<Placed<String>>,
    /// The weights; `None` where they cannot be read.
    pub weights: Option<Weights>,
}

/// The weights as written.
#[derive(Clone, Debug)]
pub enum Weights {
    /// a_s and b_s of the stages s = 1..S.
    Stages {
        /// Kicks a_s.
        kick: Placed<Vec<Cell>>,
        /// Drifts b_s.
        drift: Placed<Vec<Cell>>,
    },
    /// A base scheme with the steps γ_1 h, γ_2 h, ….
    Composition {
        /// Name or file of the base scheme's table.
        base: Placed<String>,
        /// The γ's.
        gamma: Placed<Vec<Cell>>,
    },
}

const KEYS: [&str; 15] = [
    "name",
    "title",
    "aliases",
    "order",
    "kinetic",
    "near_integrable",
    "dominant",
    "symmetric",
    "digits",
    "reference",
    "doi",
    "constants",
    "free",
    "composition",
    "stages",
];

/// Reads a table's text and all its faults: of the TOML, unknown or missing or repeated keys, values of the wrong kind.
///
/// If the text is TOML at all, the table is there too, with claims that nothing can fail where some are missing, so that
/// its cells can be looked at as well.
pub fn parse(source: &Source) -> (Option<Table>, Vec<Fault>) {
    let (document, errors) = DeTable::parse_recoverable(&source.text);
    // what follows a broken line may be a fault of that line only; a repeated key breaks nothing
    if let Some(first) = errors.iter().find(|e| !is_repeated_key(e)) {
        return (None, vec![toml_fault(source, first)]);
    }
    let faults = errors.iter().map(|e| toml_fault(source, e)).collect();
    let mut reader = Reader { source, faults };
    let table = reader.table(&document);
    (Some(table), reader.faults)
}

fn is_repeated_key(error: &toml::de::Error) -> bool {
    error.message().contains("duplicate key")
}

/// What keeps a text from being TOML, as a fault at its place.
pub fn toml_fault(source: &Source, error: &toml::de::Error) -> Fault {
    let at = error.span().unwrap_or(0..0);
    match error.message() {
        // what the parser says of any bare word
        message if message.starts_with("invalid boolean") => {
            source.fault(&at, "a bare word is no value").help("write numbers in digits and texts in quotes")
        }
        message if is_repeated_key(error) => source.fault(&at, message).help("keep one of the two"),
        message => source.fault(&at, message.replace('\n', ", ")),
    }
}

impl Reader<'_> {
    fn table(&mut self, document: &Spanned<DeTable<'_>>) -> Table {
        let root = document.get_ref();
        self.refuse_unknown(root, &KEYS, "a table");
        let name = self.required(root, "name", "the scheme's short name, such as \"yoshida4\"");
        let order = self.required(root, "order", "the order claimed, such as 4");
        let kinetic = self.required(root, "kinetic", "\"any\" or \"quadratic\"");
        let reference = self.required(root, "reference", "who published the scheme where");
        let name = name.and_then(|v| self.text(v)).filter(|n| self.is_name(n));
        let order = order.and_then(|v| self.whole(v, 1..=10, "orders from 1 to 10 can be proved"));
        let kinetic = kinetic.and_then(|v| self.kinetic(v));
        let reference = reference.and_then(|v| self.text(v));
        let title = root.get("title").and_then(|v| self.text(v)).map(|t| t.value);
        let aliases = self.aliases(root, name.as_ref());
        let near_integrable = self.near_integrable(root);
        let doi = root.get("doi").and_then(|v| self.text(v)).filter(|d| self.is_doi(d));
        let symmetric = root.get("symmetric").and_then(|v| self.truth(v));
        let digits =
            root.get("digits").and_then(|v| self.whole(v, 1..=300, "digits from 1 to 300 make sense in a table"));
        let constants = self.constants(root);
        let free = self.free(root, &constants);
        let weights = self.weights(root);
        Table {
            source: self.source.clone(),
            name: name.unwrap_or(Placed { value: "unnamed".to_owned(), at: 0..0 }),
            title,
            aliases,
            order: order.unwrap_or(Placed { value: 1, at: 0..0 }),
            kinetic: kinetic.unwrap_or(Kinetic::Quadratic),
            near_integrable,
            symmetric,
            digits,
            reference: reference.map_or(String::new(), |r| r.value),
            doi: doi.map(|d| d.value),
            constants,
            free,
            weights,
        }
    }

    fn required<'t, 'i>(&mut self, table: &'t DeTable<'i>, key: &str, what: &str) -> Option<&'t Spanned<DeValue<'i>>> {
        let value = table.get(key);
        let misspelt = |word: &str| !KEYS.contains(&word) && nearest(word, KEYS) == Some(key);
        if value.is_none() && !table.keys().any(|word| misspelt(word.get_ref())) {
            self.fault(&(0..0), format!("the key `{key}` is missing"), format!("add `{key} = …`: {what}"));
        }
        value
    }

    fn kinetic(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Kinetic> {
        let word = self.text(value)?;
        match word.value.as_str() {
            "any" => Some(Kinetic::Any),
            "quadratic" => Some(Kinetic::Quadratic),
            other => self.wrong(
                value,
                format!("`{other}` is no kind of kinetic energy"),
                "write \"any\" for every T(p), \"quadratic\" for T = ½pᵀM⁻¹p only",
            ),
        }
    }

    fn aliases(&mut self, root: &DeTable<'_>, name: Option<&Placed<String>>) -> Vec<Placed<String>> {
        let Some(value) = root.get("aliases") else { return Vec::new() };
        let aliases = self.list(value, "a list of names, such as [\"PEFRL\"]", |reader, v| reader.text(v));
        let mut known: Vec<_> = name.map(|name| spelling(&name.value)).into_iter().collect();
        for alias in &aliases {
            let spelt = spelling(&alias.value);
            if spelt.is_empty() {
                self.fault(&alias.at, format!("`{}` is no name", alias.value), "a name has letters or digits");
            } else if known.contains(&spelt) {
                let help = "small and capital letters, hyphens, blanks and the like make no difference: leave it out";
                self.fault(&alias.at, format!("`{}` is a name of this table already", alias.value), help);
            }
            known.push(spelt);
        }
        aliases
    }

    fn near_integrable(&mut self, root: &DeTable<'_>) -> Option<NearIntegrable> {
        let dominant = root.get("dominant").and_then(|v| self.dominant(v));
        let Some(value) = root.get("near_integrable") else {
            if let Some(value) = root.get("dominant") {
                let help = "add `near_integrable = [8, 2]`, the orders claimed, or leave it out";
                self.fault(&value.span(), "`dominant` says nothing without near-integrable orders", help);
            }
            return None;
        };
        let range = 1..=near_integrable::HIGHEST_ORDER;
        let help = format!("orders from 1 to {} can be proved", range.end());
        let orders =
            self.list(value, "a list of orders, such as [8, 2]", |reader, v| reader.whole(v, range.clone(), &help));
        for pair in orders.windows(2).filter(|pair| pair[0].value < pair[1].value) {
            let message =
                format!("order {} is claimed for a higher power of ε than order {}", pair[1].value, pair[0].value);
            self.fault(&pair[1].at, message, "the orders for ε, ε², … do not increase");
        }
        Some(NearIntegrable { orders, dominant: dominant.unwrap_or(MapKind::Drift) })
    }

    fn dominant(&mut self, value: &Spanned<DeValue<'_>>) -> Option<MapKind> {
        let word = self.text(value)?;
        match word.value.as_str() {
            "drift" => Some(MapKind::Drift),
            "kick" => Some(MapKind::Kick),
            other => self.wrong(
                value,
                format!("`{other}` is neither kick nor drift"),
                "write \"drift\" if the drifts move by the dominant part A of H = A + εB, \"kick\" if the kicks do",
            ),
        }
    }

    fn is_name(&mut self, name: &Placed<String>) -> bool {
        let good = name.value.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
        if !good {
            self.fault(
                &name.at,
                format!("`{}` is no name for a scheme", name.value),
                "use small letters, digits and hyphens, as in \"blanes-moan-s6\"",
            );
        }
        good
    }

    fn is_doi(&mut self, doi: &Placed<String>) -> bool {
        let good = doi.value.starts_with("10.") && doi.value.contains('/');
        if !good {
            let help = "a DOI looks like \"10.1016/0375-9601(90)90092-3\", without https://doi.org/";
            self.fault(&doi.at, format!("`{}` is no DOI", doi.value), help);
        }
        good
    }

    fn constants(&mut self, root: &DeTable<'_>) -> Vec<(Placed<String>, Cell)> {
        let Some(value) = root.get("constants") else { return Vec::new() };
        let DeValue::Table(table) = value.get_ref() else {
            self.wrong_kind::<()>(value, "a table of constants: [constants]");
            return Vec::new();
        };
        let mut constants = Vec::new();
        for (key, value) in table {
            let name = Placed { value: key.get_ref().to_string(), at: key.span() };
            if !is_constant_name(&name.value) {
                let help = "a constant's name starts with a letter and goes on with letters, digits and _";
                self.fault(&name.at, format!("`{}` is no name for a constant", name.value), help);
            } else if let Some(cell) = self.cell(value) {
                constants.push((name, cell));
            }
        }
        constants.sort_by_key(|(name, _)| name.at.start);
        constants
    }

    fn free(&mut self, root: &DeTable<'_>, constants: &[(Placed<String>, Cell)]) -> Vec<Placed<String>> {
        let Some(value) = root.get("free") else { return Vec::new() };
        let free = self.list(value, "a list of constants, such as [\"g1\"]", |reader, v| reader.text(v));
        let names = || constants.iter().map(|(name, _)| name.value.as_str());
        for name in free.iter().filter(|name| !names().any(|known| known == name.value)) {
            let help = match nearest(&name.value, names()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "free parameters are names of [constants]".to_owned(),
            };
            self.fault(&name.at, format!("there is no constant `{}`", name.value), help);
        }
        free
    }

    fn weights(&mut self, root: &DeTable<'_>) -> Option<Weights> {
        match (root.get("stages"), root.get("composition")) {
            (Some(stages), None) => self.stages(stages),
            (None, Some(composition)) => self.composition(composition),
            (Some(_), Some(both)) => self.wrong(both, "stages and a composition are both given", "keep one of the two"),
            (None, None) => {
                let help = "add [stages] with kick and drift, or [composition] with base and gamma";
                self.fault(&(0..0), "the weights are missing", help);
                None
            }
        }
    }

    fn stages(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Weights> {
        let DeValue::Table(table) = value.get_ref() else {
            return self.wrong_kind(value, "a table: [stages] with kick and drift");
        };
        self.refuse_unknown(table, &["kick", "drift"], "[stages]");
        let kick = self.member(table, value, "kick").and_then(|v| self.cells(v));
        let drift = self.member(table, value, "drift").and_then(|v| self.cells(v));
        let (kick, drift) = (kick?, drift?);
        if kick.value.len() != drift.value.len() {
            let help = "each stage is a kick and then a drift; write 0 where there is none";
            self.faults.push(
                self.source
                    .fault(&drift.at, "kick and drift must have as many weights as there are stages")
                    .values(
                        format!("{} for the kicks, {} for the drifts", kick.value.len(), drift.value.len()),
                        "as many of both",
                    )
                    .help(help),
            );
            return None;
        }
        Some(Weights::Stages { kick, drift })
    }

    fn composition(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Weights> {
        let DeValue::Table(table) = value.get_ref() else {
            return self.wrong_kind(value, "a table: [composition] with base and gamma");
        };
        self.refuse_unknown(table, &["base", "gamma"], "[composition]");
        let base = self.member(table, value, "base").and_then(|v| self.text(v));
        let gamma = self.member(table, value, "gamma").and_then(|v| self.cells(v));
        Some(Weights::Composition { base: base?, gamma: gamma? })
    }
}

fn is_constant_name(name: &str) -> bool {
    let mut letters = name.chars();
    letters.next().is_some_and(|c| c.is_ascii_alphabetic()) && letters.all(|c| c.is_ascii_alphanumeric() || c == '_')
}
