//! Formulas of a pair of bodies: the degree of their variable, and whether they are symmetric.

use crate::symbolic::graph::Graph;
use crate::symbolic::separation::Separation;
use crate::symbolic::text::syntax::Expression;

impl Separation {
    /// Its degree in the coordinates of the bodies.
    pub(crate) fn degree(self) -> u32 {
        match self {
            Separation::Difference => 1,
            Separation::SquaredDistance => 2,
        }
    }
}

/// Whether the formula of a pair in r² is symmetric in the bodies i and j, as far as its simplified form shows; `None`
/// for an invalid formula, and for one in d, which has a direction.
pub fn is_symmetric(
    expression: &Expression,
    separation: Separation,
    properties: &[String],
    parameters: &[String],
) -> Option<bool> {
    let exchanged = |name: &String| match (name.strip_suffix("_i"), name.strip_suffix("_j")) {
        (Some(stem), _) => format!("{stem}_j"),
        (_, Some(stem)) => format!("{stem}_i"),
        _ => name.clone(),
    };
    // a property without a counterpart in the list gets a separate index
    let mut all = properties.to_vec();
    for name in properties.iter().map(exchanged) {
        if !all.contains(&name) {
            all.push(name);
        }
    }
    let mut graph = Graph::new();
    let one = graph.build_pair(expression, separation.name(), &all, parameters).ok()?;
    let others: Vec<String> = all.iter().map(exchanged).collect();
    let other = graph.build_pair(expression, separation.name(), &others, parameters).ok()?;
    (separation == Separation::SquaredDistance).then_some(one == other)
}
