//! What the formulas of a table's cells consist of: constants by name, and decimals that nothing moves.

use std::collections::BTreeSet;

use shadowstep_schemes::symbolic::{ExpressionKind, parse};

use shadowstep_schemes::document::Placed;
use shadowstep_schemes::table::{Cell, Table, Weights};

/// The constants on which no weight depends.
pub(super) fn unused_constants(table: &Table) -> Vec<&str> {
    let mut used = BTreeSet::new();
    let use_names = |cell: &Cell, used: &mut BTreeSet<String>| {
        if let Ok(expression) = parse(&cell.value) {
            expression.visit(&mut |part| {
                if let ExpressionKind::Name(name) = &part.kind {
                    used.insert(name.clone());
                }
            });
        }
    };
    weights(table).iter().for_each(|(_, cell)| use_names(cell, &mut used));
    let mut unused = Vec::new();
    // a constant uses those above it only
    for (name, cell) in table.constants.iter().rev() {
        if used.contains(&name.value) {
            use_names(cell, &mut used);
        } else {
            unused.push(name.value.as_str());
        }
    }
    unused.reverse();
    unused
}

/// Shorter decimals within formulas are meant exactly, as in `0.25*a`.
const SHORTEST_ROUNDED: usize = 4;

/// The cells whose formulas have long decimals in them, such as `1 - 2*1.351207192`.
pub(super) fn cells_with_decimals(table: &Table) -> Vec<String> {
    let constants = table.constants.iter().map(|(name, cell)| (name.value.clone(), cell));
    let has_decimal = |cell: &Cell| {
        let mut found = false;
        if let Ok(expression) = parse(&cell.value) {
            let stands_alone = matches!(&expression.kind, ExpressionKind::Number(_))
                || matches!(&expression.kind, ExpressionKind::Negate(inner) if matches!(inner.kind, ExpressionKind::Number(_)));
            expression.visit(&mut |part| {
                let digits = |text: &str| text.bytes().filter(u8::is_ascii_digit).skip_while(|&c| c == b'0').count();
                let text = &cell.value[part.range.clone()];
                let is_long = text.contains('.') && digits(text) >= SHORTEST_ROUNDED;
                found |= !stands_alone && is_long && matches!(part.kind, ExpressionKind::Number(_));
            });
        }
        found
    };
    let unused = unused_constants(table);
    let used = constants.filter(|(name, _)| !unused.contains(&name.as_str()));
    used.chain(weights(table)).filter(|(_, cell)| has_decimal(cell)).map(|(name, _)| name).collect()
}

/// A list of weights and its name.
type List<'t> = (String, &'t Placed<Vec<Cell>>);

/// The lists of weights by their names: those of the scheme, or of the kernel; and those of its processor.
pub(super) fn lists(table: &Table) -> [Vec<List<'_>>; 2] {
    fn named<'t>(weights: Option<&'t Weights>, of: &str) -> Vec<List<'t>> {
        let lists = match weights {
            Some(Weights::Stages { kick, gradient_kick, drift }) => {
                let gradient_kick = gradient_kick.as_ref().map(|cells| ("gradient_kick", cells));
                [Some(("kick", kick)), Some(("drift", drift)), gradient_kick].into_iter().flatten().collect()
            }
            Some(Weights::Composition { gamma, .. }) => vec![("gamma", gamma)],
            None => Vec::new(),
        };
        lists.into_iter().map(|(name, cells)| (format!("{of}{name}"), cells)).collect()
    }
    let post = table.processor.as_ref().and_then(|processor| processor.post.as_ref());
    [named(table.weights.as_ref(), ""), named(post, "processor.")]
}

/// The cells of the weights, with their places such as `kick[2]`.
fn weights(table: &Table) -> Vec<(String, &Cell)> {
    let lists = lists(table).into_iter().flatten();
    lists
        .flat_map(|(list, cells)| {
            cells.value.iter().enumerate().map(move |(i, cell)| (format!("{list}[{}]", i + 1), cell))
        })
        .collect()
}
