//! Expressions in q, p, the time and the energy of a state, and conditions on them.

use std::cmp::Ordering;
use std::sync::Arc;

use shadowstep_schemes::document::{Reader, Text};
use shadowstep_schemes::symbolic::{Expression as Syntax, ExpressionKind, Graph, Node, parse};

use crate::document::quantity::Quantity;
use crate::document::schema::Table;

/// The time and the energy.
pub(crate) const TIME: &str = "t";
pub(crate) const ENERGY: &str = "E";

/// A formula in the coordinates, momenta and parameters of a system, the names of the axes, t and E, and quantities of
/// its bodies.
#[derive(Clone, Debug)]
pub struct Expression {
    /// With names in the places of quantities.
    pub(crate) formula: String,
    /// The quantities, of which the i-th has the name that [`name_of_quantity`] gives.
    pub(crate) quantities: Vec<Quantity>,
    /// What is written.
    pub(crate) text: Text,
    /// The names in its text, without those of bodies in calls of quantities.
    pub(crate) names: Vec<String>,
    pub(crate) has_time: bool,
    pub(crate) has_energy: bool,
    has_functions: bool,
    /// A formula that was not read.
    pub(crate) derived: Option<Arc<Derived>>,
}

/// A formula in the coordinates, the momenta, t and E of a system, in this order, and its parameters.
#[derive(Debug)]
pub(crate) struct Derived {
    pub(crate) graph: Graph,
    pub(crate) node: Node,
    /// Whether it has p_t of transformed time, too, after E.
    pub(crate) has_momentum_of_time: bool,
}

/// One expression is less or greater than another.
#[derive(Clone, Debug)]
pub struct Condition {
    /// The left side less the right side.
    difference: Expression,
    pub(crate) met: Comparison,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Comparison {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Expression {
    /// The formula of a text.
    pub fn new(text: Text) -> Expression {
        Expression::with(&text.value.clone(), text)
    }

    fn with(formula: &str, text: Text) -> Expression {
        let written = parse(formula).ok();
        let quantities = written.as_ref().map_or(Vec::new(), |syntax| Quantity::all(formula, syntax));
        let names = written.map_or(Vec::new(), |syntax| names(&syntax, &quantities));
        let formula = with_names(formula, &quantities);
        let has_functions = parse(&formula).ok().as_ref().is_none_or(Syntax::has_functions);
        let has = |name: &str| names.iter().any(|own| own == name);
        Expression {
            has_time: has(TIME),
            has_energy: has(ENERGY),
            names,
            has_functions,
            quantities,
            formula,
            text,
            derived: None,
        }
    }

    /// A formula that was not read, with E in it; the text is what it is derived from.
    pub(crate) fn derived(derived: Derived, text: Text) -> Expression {
        Expression {
            formula: text.value.clone(),
            quantities: Vec::new(),
            names: Vec::new(),
            text,
            has_time: false,
            has_energy: true,
            has_functions: true,
            derived: Some(Arc::new(derived)),
        }
    }

    /// Whether it has functions such as exp and sin.
    pub fn has_functions(&self) -> bool {
        self.has_functions
    }
}

/// The most formulas of a table.
const MOST_FORMULAS: usize = 1000;

/// The names with formulas of a key, in the order of the text.
pub fn named(reader: &mut Reader<'_>, table: &Table<'_, '_>, key: &str) -> Option<Vec<(Text, Text)>> {
    reader.has_at_most(table.get(key)?, MOST_FORMULAS, "formulas").then(|| table.named(key))
}

/// The name that stands for a quantity in a formula: that of no coordinate.
pub(crate) fn name_of_quantity(number: usize) -> String {
    format!("__{number}")
}

/// The names of a formula that are no arguments of its quantities.
fn names(syntax: &Syntax, quantities: &[Quantity]) -> Vec<String> {
    let is_argument = |part: &Syntax| quantities.iter().any(|own| own.has_arguments_at(&part.range));
    let mut found = Vec::new();
    syntax.visit(&mut |part| match &part.kind {
        ExpressionKind::Name(name) if !is_argument(part) => found.push(name.clone()),
        _ => {}
    });
    found
}

/// The formula with a name in the place of each quantity, as long as the quantity, so that all others stay in their
/// places.
fn with_names(formula: &str, quantities: &[Quantity]) -> String {
    let mut text = formula.to_owned();
    for (number, Quantity { range, .. }) in quantities.iter().enumerate().rev() {
        text.replace_range(range.clone(), &format!("{:<1$}", name_of_quantity(number), range.len()));
    }
    text
}

impl Condition {
    /// The condition of a text; a fault has its place.
    pub fn read(reader: &mut Reader<'_>, text: &Text) -> Option<Condition> {
        let comparisons = [
            ("<=", Comparison::LessOrEqual),
            (">=", Comparison::GreaterOrEqual),
            ("<", Comparison::Less),
            (">", Comparison::Greater),
        ];
        let found = comparisons.iter().find_map(|(sign, met)| Some((text.value.split_once(sign)?, *met)));
        let Some(((left, right), met)) = found.filter(|((_, right), _)| !right.contains(['<', '>'])) else {
            return reader.wrong(&text.at, "this text is not a condition", "write one comparison: \"x^2 + y^2 > 100\"");
        };
        for side in [left, right] {
            if let Err(error) = parse(side) {
                let begin = side.as_ptr() as usize - text.value.as_ptr() as usize;
                let range = &error.range;
                let at = text.place(&(begin + range.start..begin + range.end));
                return reader.wrong(&at, error.to_string(), "write one comparison: \"x^2 + y^2 > 100\"");
            }
        }
        // one subtraction and no rounding of the sides alone
        let difference = format!("({left}) - ({right})");
        Some(Condition { difference: Expression::with(&difference, text.clone()), met })
    }

    /// The left side less the right side.
    pub fn difference(&self) -> &Expression {
        &self.difference
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.difference.text.value
    }
}

impl Comparison {
    /// Whether it is that of a difference with 0; NaN has none.
    pub(crate) fn is_of(self, ordering: Option<Ordering>) -> bool {
        match self {
            Comparison::Less => ordering == Some(Ordering::Less),
            Comparison::LessOrEqual => matches!(ordering, Some(Ordering::Less | Ordering::Equal)),
            Comparison::Greater => ordering == Some(Ordering::Greater),
            Comparison::GreaterOrEqual => matches!(ordering, Some(Ordering::Greater | Ordering::Equal)),
        }
    }
}
