//! Quantities of bodies as expressions have them: distances, and elements of orbits.

use std::ops::Range;

use shadowstep_symbolic::{Expression as Syntax, ExpressionKind};

/// The function of a distance.
const DISTANCE: &str = "distance";

/// An element of an orbit; angles are in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Element {
    SemiMajorAxis,
    Eccentricity,
    Inclination,
    Node,
    Pericentre,
    MeanAnomaly,
    MeanLongitude,
}

/// The elements with their names, which are those of [[body]].
pub(crate) const ELEMENTS: [(&str, Element); 7] = [
    ("a", Element::SemiMajorAxis),
    ("e", Element::Eccentricity),
    ("i", Element::Inclination),
    ("node", Element::Node),
    ("pericentre", Element::Pericentre),
    ("M", Element::MeanAnomaly),
    ("lambda", Element::MeanLongitude),
];

/// A function call in an expression, as written: `distance(earth, moon)`, `e(earth)`, `a(earth, jacobi)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Quantity {
    pub(crate) function: Function,
    pub(crate) arguments: Vec<String>,
    /// Its bytes in the formula.
    pub(crate) range: Range<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    Distance,
    Element(Element),
}

impl Quantity {
    /// The quantities in a formula, in the order of the text.
    pub(crate) fn all(formula: &str, syntax: &Syntax) -> Vec<Quantity> {
        let mut found = Vec::new();
        syntax.visit(&mut |part| {
            let ExpressionKind::Call { function, arguments } = &part.kind else { return };
            let element = ELEMENTS.iter().find(|(name, _)| name == function).map(|(_, element)| *element);
            let function = match element {
                Some(element) => Function::Element(element),
                None if function == DISTANCE => Function::Distance,
                None => return,
            };
            let arguments = arguments.iter().map(|argument| formula[argument.range.clone()].to_owned()).collect();
            found.push(Quantity { function, arguments, range: part.range.clone() });
        });
        found
    }
}
