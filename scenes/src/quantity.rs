//! Quantities as expressions have them: the kinetic energy and the virial of a system, distances of its bodies, and elements of their orbits.

use std::ops::Range;

use shadowstep_symbolic::{Expression as Syntax, ExpressionKind};

/// The function of a distance.
const DISTANCE: &str = "distance";

/// The names of sums over all bodies.
pub(crate) const KINETIC: &str = "kinetic";
pub(crate) const VIRIAL: &str = "virial";

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

/// A name or a function call in an expression, as written: `kinetic`, `distance(earth, moon)`, `e(earth)`, `a(earth, jacobi)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Quantity {
    pub(crate) function: Function,
    pub(crate) arguments: Vec<String>,
    /// Its bytes in the formula.
    pub(crate) range: Range<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    /// T(p)
    Kinetic,
    /// −qᵀU_q; in a periodic box of the nearest images.
    Virial,
    Distance,
    Element(Element),
}

/// Computes a quantity from positions and momenta.
pub(crate) type Compute<N> = Box<dyn FnMut(&[N], &[N]) -> N>;

impl Quantity {
    /// Whether bytes of the formula are within its arguments.
    pub(crate) fn has_arguments_at(&self, range: &Range<usize>) -> bool {
        !self.arguments.is_empty() && self.range.start < range.start && range.end <= self.range.end
    }

    /// The quantities in a formula, in the order of the text.
    pub(crate) fn all(formula: &str, syntax: &Syntax) -> Vec<Quantity> {
        let mut found: Vec<Quantity> = Vec::new();
        syntax.visit(&mut |part| {
            // the name of a body
            if found.last().is_some_and(|call| part.range.start < call.range.end) {
                return;
            }
            let (function, arguments) = match &part.kind {
                ExpressionKind::Call { function, arguments } => (function, &arguments[..]),
                ExpressionKind::Name(name) => {
                    let function = match name.as_str() {
                        KINETIC => Function::Kinetic,
                        VIRIAL => Function::Virial,
                        _ => return,
                    };
                    found.push(Quantity { function, arguments: Vec::new(), range: part.range.clone() });
                    return;
                }
                _ => return,
            };
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
