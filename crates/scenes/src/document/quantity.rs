//! Quantities as expressions have them: the kinetic energy and the virial of a system, distances of its bodies, and
//! elements of their orbits.

use std::ops::Range;

use shadowstep_schemes::symbolic::{Expression as Syntax, ExpressionKind};

/// A quantity: how formulas write it, and what it is.
pub(crate) struct Described {
    function: Function,
    /// The name alone, where it may stand without arguments, and what messages call it.
    pub(crate) name: Option<(&'static str, &'static str)>,
    /// The names of functions with arguments.
    calls: &'static [&'static str],
    pub(crate) written: &'static str,
    pub(crate) meaning: &'static str,
}

/// The quantities; elements have a table of their own.
pub(crate) const QUANTITIES: [Described; 5] = [
    Described {
        function: Function::Kinetic,
        name: Some((KINETIC, "the kinetic energy")),
        calls: &[],
        written: "kinetic",
        meaning: "The kinetic energy T(p).",
    },
    Described {
        function: Function::Virial,
        name: Some((VIRIAL, "the virial")),
        calls: &[],
        written: "virial",
        meaning: "Clausius' virial -q U_q; in a periodic box of the nearest images.",
    },
    Described {
        function: Function::OfBodies(DISTANCE),
        name: None,
        calls: &[DISTANCE],
        written: "distance(sun, earth)",
        meaning: "The distance of two bodies, which have the names of [[body]] or numbers.",
    },
    Described {
        function: Function::OfBodies(ANGULAR_MOMENTUM),
        name: Some((ANGULAR_MOMENTUM, "the angular momentum")),
        calls: &[ANGULAR_MOMENTUM],
        written: "angular_momentum, angular_momentum(z)",
        meaning: "The angular momentum of all bodies about the origin: x py - y px in a plane, its length in space, \
            and there its component along an axis.",
    },
    Described {
        function: Function::Element(Element::SemiMajorAxis),
        name: None,
        calls: &[],
        written: "a(earth), e, i, node, pericentre, M, lambda",
        meaning: "An element of a body's osculating orbit, angles in degrees: about the first body, e(earth); another \
            one, a(moon, earth); the bodies before, i(earth, jacobi); or all, M(earth, barycentre).",
    },
];

pub(crate) const DISTANCE: &str = "distance";
pub(crate) const ANGULAR_MOMENTUM: &str = "angular_momentum";

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

/// A name or a function call in an expression, as written: `kinetic`, `distance(earth, moon)`, `e(earth)`,
/// `a(earth, jacobi)`.
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
    /// What has a formula in the coordinates and momenta of bodies.
    OfBodies(&'static str),
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
            let of =
                |is_own: &dyn Fn(&Described) -> bool| QUANTITIES.iter().find(|own| is_own(own)).map(|own| own.function);
            let (function, arguments) = match &part.kind {
                ExpressionKind::Call { function: name, arguments } => {
                    let element = ELEMENTS.iter().find(|(own, _)| own == name).map(|(_, own)| Function::Element(*own));
                    (element.or_else(|| of(&|own| own.calls.contains(&&**name))), &arguments[..])
                }
                ExpressionKind::Name(name) => (of(&|own| own.name.is_some_and(|(own, _)| own == name)), &[][..]),
                _ => return,
            };
            let Some(function) = function else { return };
            let arguments = arguments.iter().map(|argument| formula[argument.range.clone()].to_owned()).collect();
            found.push(Quantity { function, arguments, range: part.range.clone() });
        });
        found
    }
}
