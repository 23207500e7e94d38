//! The proof of an order for every T(p) in a form that other programs can check: `shadowstep schemes prove`.
//!
//! | module | what it does |
//! | --- | --- |
//! | `class` | classes of Hamiltonians, their conditions |
//! | `ring` | polynomials in roots, with exact arithmetic |
//! | `closed` | cells with roots → weights as such polynomials |
//! | `enclosure` | decimals → a box in which there is one solution |
//! | `whole_numbers` | conditions of rational weights in whole numbers |
//!
//! The conditions are those of [`order`](shadowstep_schemes::order): in the product of the exponentials of kicks and
//! drifts, every Lyndon word of n letters up to the order has the coefficient 1/n!. A certificate has the weights;
//! whoever checks it computes the coefficients.

mod class;
mod closed;
mod enclosure;
mod ring;
mod whole_numbers;

use num_traits::{Signed, Zero};
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::order::weighed;
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::{Map, MapKind, Proved, Rational};

pub use class::Class;
pub use enclosure::{Enclosure, Form};
pub use ring::{Polynomial, Root};
use ring::{Ring, constant};
use whole_numbers::WholeNumbers;

/// What kind of proof an order has.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// The weights are rational, and all conditions hold exactly.
    Exact,
    /// The weights are polynomials in these roots, and all conditions hold modulo their equations, which is exactly.
    Algebraic(Vec<Root>),
    /// The weights are decimals, and all conditions hold to within this bound.
    Decimal(Rational),
}

/// A proof that a step has an order.
#[derive(Clone, Debug)]
pub struct Certificate {
    /// The order for every T(p).
    pub order: u32,
    /// How the weights are given, and how far the conditions may be off.
    pub kind: Kind,
    /// The maps in their order with their weights.
    pub maps: Vec<(MapKind, Polynomial)>,
    /// Orders for smaller classes that do not follow from the one for every T(p), and how far their conditions may be
    /// off.
    pub also: Vec<(Class, Rational)>,
    /// Of decimals, the box about them in which there is one solution, where it is known how to prove that.
    pub enclosure: Option<Enclosure>,
}

impl Certificate {
    /// The certificate of the order for every T(p); of a processed scheme, that of its kernel. `None` with gradient
    /// kicks and inner schemes, whose conditions are not those of words in kicks and drifts.
    ///
    /// ```
    /// use shadowstep_analysis::certificate::{Certificate, Kind};
    /// use shadowstep_schemes::shipped_proved;
    ///
    /// let kind = |name: &str| Certificate::of(shipped_proved(name).unwrap()).unwrap().kind;
    /// assert_eq!(kind("ruth3"), Kind::Exact);
    /// assert!(matches!(kind("yoshida4"), Kind::Algebraic(roots) if roots[0].power == 3));
    /// assert!(matches!(kind("pefrl"), Kind::Decimal(_)));
    /// ```
    pub fn of(proved: &Proved) -> Option<Certificate> {
        let scheme = &proved.scheme;
        let order = proved.order_for_every_kinetic()?.order;
        if scheme.inner.is_some() {
            return None;
        }
        let beside = Class::beside(order, proved);
        let as_polynomials = || scheme.maps().into_iter().map(|map| (map.kind, constant(map.weight))).collect();
        if scheme.held == Held::Exactly {
            let also = exactly(beside);
            return Some(Certificate { order, kind: Kind::Exact, maps: as_polynomials(), also, enclosure: None });
        }
        Some(algebraic(proved, order, &beside).unwrap_or_else(|| {
            let maps = scheme.maps();
            let kind = Kind::Decimal(distance(&maps, &Class::EveryKinetic(order)));
            let also = beside.into_iter().map(|class| (class.clone(), distance(&maps, &class))).collect();
            Certificate { order, kind, maps: as_polynomials(), also, enclosure: Enclosure::of(scheme, order) }
        }))
    }
}

fn exactly(classes: Vec<Class>) -> Vec<(Class, Rational)> {
    classes.into_iter().map(|class| (class, Rational::zero())).collect()
}

/// How far the farthest condition of a class is from what is needed.
fn distance(maps: &[Map], class: &Class) -> Rational {
    let whole = WholeNumbers::new(maps.iter().map(|map| &map.weight), class.highest());
    let conditions = class.conditions(&weighed(maps, &whole), &whole);
    conditions
        .into_iter()
        .map(|(condition, value)| (whole.value(value, condition.order) - condition.needed).abs())
        .max()
        .unwrap_or_else(Rational::zero)
}

/// The certificate of a scheme of closed forms.
fn algebraic(proved: &Proved, order: u32, beside: &[Class]) -> Option<Certificate> {
    let is_closed = proved.scheme.table.digits.is_none()
        && proved.scheme.base.as_ref().is_none_or(|base| base.table.digits.is_none());
    let ring = Ring::default();
    let maps = closed::maps(&proved.scheme, &ring).filter(|_| is_closed)?;
    let hold = |class: &Class| {
        let conditions = class.conditions(&maps, &ring);
        conditions.into_iter().all(|(condition, value)| value == ring.weight(&condition.needed))
    };
    if !hold(&Class::EveryKinetic(order)) {
        return None;
    }
    let also = exactly(beside.iter().filter(|class| hold(class)).cloned().collect());
    let kind = Kind::Algebraic(ring.roots.into_inner());
    Some(Certificate { order, kind, maps, also, enclosure: None })
}
