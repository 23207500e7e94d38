//! The distance of a body as a name in its formula.

use std::collections::HashMap;

use shadowstep_schemes::symbolic::{Graph, Node, Rational};

/// The formula with the coordinate after the first `dimensions`, which is the distance, replaced by the length of
/// these.
pub(super) fn without_distance(graph: &mut Graph, node: Node, dimensions: usize) -> Node {
    let whole = |n: i64| Rational::from_integer(n.into());
    let distance = graph.coordinate(dimensions);
    let squares: Vec<_> = (0..dimensions)
        .map(|axis| {
            let coordinate = graph.coordinate(axis);
            (graph.power(coordinate, &whole(2)), whole(1))
        })
        .collect();
    let squared = graph.sum(&squares);
    let length = graph.power(squared, &(whole(1) / whole(2)));
    graph.replaced(&[node], HashMap::from([(distance, length)]))[0]
}
