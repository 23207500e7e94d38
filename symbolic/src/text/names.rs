//! What the names in a formula stand for, and what to say about those that stand for nothing.

use crate::number::function::Function;
use crate::text::error::SemanticFault;
use crate::text::near_names::hint;
use crate::text::syntax::Expression;

/// The name of the circle's number, unless something else has that name.
pub(crate) const PI: &str = "pi";

/// The names of functions that are powers.
const ROOTS: [(&str, u32); 2] = [("sqrt", 2), ("cbrt", 3)];

/// The names of functions with a kink or a jump.
pub(crate) const NOT_SMOOTH: [&str; 10] = ["abs", "sign", "sgn", "min", "max", "floor", "ceil", "round", "mod", "step"];

/// What a name with arguments stands for.
pub(crate) enum Callee {
    /// The root of this order.
    Root(u32),
    Function(Function),
}

/// What is called, and its argument.
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

/// The fault that a name is none of the known ones, nor `pi`.
pub(crate) fn unknown_name(name: &str, known: &[&str]) -> SemanticFault {
    let hint = hint(name, known, &[PI], "known names", "no names are known here but `pi`");
    SemanticFault::UnknownName { name: name.to_string(), hint }
}

/// The known functions, and the one that was probably meant by an unknown name.
fn hint_at_functions(name: &str) -> String {
    let known: Vec<&str> = ROOTS.map(|(root, _)| root).into_iter().chain(Function::ALL.map(Function::name)).collect();
    // Who writes `min` does not mean `sin`.
    let meant = if NOT_SMOOTH.contains(&name) { "" } else { name };
    hint(meant, &known, &[], "known functions", "")
}
