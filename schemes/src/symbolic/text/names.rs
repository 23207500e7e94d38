//! The names in a formula: functions, roots and π, and the faults of unknown names.

use crate::symbolic::number::function::Function;
use crate::symbolic::text::error::SemanticFault;
use crate::symbolic::text::near_names::hint;
use crate::symbolic::text::syntax::{Expression, ExpressionKind};

/// The name of π, unless a coordinate or parameter has that name.
pub(crate) const PI: &str = "pi";

/// The names of functions that are powers.
const ROOTS: [(&str, u32); 2] = [("sqrt", 2), ("cbrt", 3)];

impl Expression {
    /// Whether it contains this name of a number.
    pub fn mentions(&self, name: &str) -> bool {
        let mut found = false;
        self.visit(&mut |part| found |= matches!(&part.kind, ExpressionKind::Name(own) if own == name));
        found
    }

    /// Whether it calls a function that is not a root: exp, sin and the like.
    pub fn has_functions(&self) -> bool {
        let mut found = false;
        self.visit(&mut |part| {
            found |= matches!(&part.kind, ExpressionKind::Call { function, .. } if ROOTS.iter().all(|(root, _)| root != function));
        });
        found
    }
}

/// The names of functions with a kink or a jump.
pub(crate) const NOT_SMOOTH: [&str; 10] = ["abs", "sign", "sgn", "min", "max", "floor", "ceil", "round", "mod", "step"];

/// A function of a formula.
pub(crate) enum Callee {
    /// The root of this order.
    Root(u32),
    Function(Function),
}

/// The function with this name, and its only argument.
pub(crate) fn callee<'a>(name: &str, arguments: &'a [Expression]) -> Result<(Callee, &'a Expression), SemanticFault> {
    let root = ROOTS.into_iter().find(|(root, _)| *root == name).map(|(_, order)| Callee::Root(order));
    let Some(callee) = root.or_else(|| Function::named(name).map(Callee::Function)) else {
        return Err(SemanticFault::UnknownFunction { name: name.to_string(), hint: hint_at_functions(name) });
    };
    match arguments {
        [argument] => Ok((callee, argument)),
        _ => Err(SemanticFault::ArgumentCount { function: name.to_string(), found: arguments.len() }),
    }
}

/// The fault of a name that is neither known nor `pi`. Known names that begin with `__` stand for parts of a formula,
/// and are not offered.
pub(crate) fn unknown_name(name: &str, known: &[&str]) -> SemanticFault {
    let known: Vec<&str> = known.iter().copied().filter(|known| !known.starts_with("__")).collect();
    let hint = hint(name, &known, &[PI], "known names", "the only known name is `pi`");
    SemanticFault::UnknownName { name: name.to_string(), hint }
}

/// The known functions, and the nearest of them.
fn hint_at_functions(name: &str) -> String {
    let known: Vec<&str> = ROOTS.map(|(root, _)| root).into_iter().chain(Function::ALL.map(Function::name)).collect();
    let misspelt = match name {
        // names of other programs
        "ln" => "log",
        "arcsin" => "asin",
        "arccos" => "acos",
        "arctan" => "atan",
        // `min` is not a misspelt `sin`
        _ if NOT_SMOOTH.contains(&name) => "",
        _ => name,
    };
    hint(misspelt, &known, &[], "known functions", "")
}
