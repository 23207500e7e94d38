//! What is true of a scheme, and which claims of its table that refuses.
//!
//! Where the weights are exact, a condition *holds* if it is met exactly. Where they are rounded to some digits, it
//! holds if it is met as closely as one unit of 10^(1−digits) in each weight can account for (a bound to first order,
//! with the rounding of the arithmetic itself included), and if that is close enough to decide: at most a thousandth of
//! the value needed. The number of digits to which the conditions really hold is reported.

use shadowstep_symbolic::Rational;

use crate::claims::{HIGHEST_NEAR_INTEGRABLE_ORDER, HIGHEST_ORDER, Kinetic};
use crate::conditions::{Evaluated, Family, evaluated};
use crate::digits::digits_of;
use crate::document::Placed;
use crate::map::MapKind;
use crate::order::{Condition, Functional};
use crate::rounding::{Linearised, Unexplained};
use crate::scheme::{ExactScheme, Held};

/// Digits that sums of products of good weights lose without a note, where the decimals themselves are not looked at; the
/// worst of the shipped tables loses 3.
const MOST_DIGITS_LOST: u32 = 5;

/// The order that was proved for one class of kinetic energies, or for one power of ε.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Order {
    /// All conditions up to this order hold.
    pub order: u32,
    /// To how many digits they hold: `None` for exactly.
    pub digits: Option<u32>,
    /// The first condition that fails, and the value found; `None` if none does up to the highest order that is proved.
    pub failed: Option<(Condition, Rational)>,
    /// Whether the failed condition is met within the digits of the weights, which are too few to decide it.
    pub undecided: bool,
}

/// What is true of a scheme.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// For every T(p). With gradient kicks: for all A and B, where a gradient kick is the flow of [B,[A,B]], which for A = T(p) is so
    /// for quadratic T only; see [`Proved::order_for_every_kinetic`](crate::Proved::order_for_every_kinetic).
    pub general: Order,
    /// For T = ½pᵀM⁻¹p.
    pub quadratic: Order,
    /// For the terms of ε, ε², … of a near-integrable H = A + εB: one for each order that the table claims, the last one
    /// for all higher powers too.
    pub near_integrable: Vec<Order>,
    /// The step is a palindrome, exactly.
    pub symmetric: bool,
}

impl Proof {
    /// The order for a class of kinetic energies.
    pub fn for_kinetic(&self, kinetic: Kinetic) -> &Order {
        match kinetic {
            Kinetic::Any => &self.general,
            Kinetic::Quadratic => &self.quadratic,
        }
    }
}

/// Proves the orders of a scheme, whatever its table claims.
pub fn prove(scheme: &ExactScheme) -> Proof {
    let for_kinetic =
        |kinetic| highest_order(scheme, Family::Kinetic(kinetic), scheme.table.order.value, HIGHEST_ORDER);
    let powers = scheme.table.near_integrable.iter().flat_map(|claim| claim.powers());
    let for_power = |(claim, power): (&Placed<u32>, _)| {
        highest_order(scheme, Family::Power(power), claim.value, HIGHEST_NEAR_INTEGRABLE_ORDER)
    };
    Proof {
        general: for_kinetic(Kinetic::Any),
        quadratic: for_kinetic(Kinetic::Quadratic),
        near_integrable: powers.map(for_power).collect(),
        symmetric: scheme.is_symmetric(),
    }
}

/// The highest order that holds. Most schemes fail at the order above the claimed one, so that is tried first.
fn highest_order(scheme: &ExactScheme, family: Family, claimed: u32, highest: u32) -> Order {
    let first_try = order_up_to(scheme, family, (claimed + 1).min(highest));
    match first_try.failed {
        Some(_) => first_try,
        None => order_up_to(scheme, family, highest),
    }
}

fn order_up_to(scheme: &ExactScheme, family: Family, highest: u32) -> Order {
    let mut conditions = evaluated(&scheme.maps(), scheme.held, family, highest);
    let failed = conditions.iter().position(|c| !c.holds());
    let order = failed.map_or(highest, |first| conditions[first].condition.order - 1);
    let holding = conditions.iter().filter(|c| c.condition.order <= order);
    let digits = holding.filter_map(|c| digits_of(&c.uncertainty())).min();
    let failed = failed.map(|first| conditions.swap_remove(first));
    let undecided = failed.as_ref().is_some_and(Evaluated::is_met);
    Order { order, digits, failed: failed.map(|c| (c.condition, c.found.reduced())), undecided }
}

/// A claim that differs from what is true.
#[derive(Debug)]
pub(crate) enum Finding<'a> {
    /// The weights of the maps of one kind do not sum to 1.
    Sum { kind: MapKind, found: Rational, needed: Rational },
    /// The order that holds, in `proved`, is lower than the claimed one.
    LowerOrder { family: Family, claimed: &'a Placed<u32>, proved: &'a Order },
    /// A higher order holds than the claimed one.
    HigherOrder { family: Family, claimed: &'a Placed<u32>, holds: u32 },
    /// The step is not the palindrome that it is claimed to be.
    NotSymmetric { claim: &'a Placed<bool> },
    /// The step is a palindrome, and is claimed not to be.
    Symmetric { claim: &'a Placed<bool> },
    /// The conditions hold to far fewer digits than the weights have, though as closely as their sensitivity allows.
    FewerDigits { claimed: &'a Placed<u32>, hold: u32 },
    /// The conditions are farther from what is needed than the rounding of the printed decimals explains.
    Unexplained { claimed: u32, unexplained: Unexplained, refused: bool },
}

impl Finding<'_> {
    /// Whether the claim is refused; the other claims are true, and say less than the truth.
    pub(crate) fn is_refused(&self) -> bool {
        let refused = matches!(self, Finding::Sum { .. } | Finding::LowerOrder { .. } | Finding::NotSymmetric { .. });
        refused || matches!(self, Finding::Unexplained { refused: true, .. })
    }
}

/// The claims of the scheme's table that differ from the proof.
pub(crate) fn findings<'a>(scheme: &'a ExactScheme, proof: &'a Proof) -> Vec<Finding<'a>> {
    let mut findings = order_finding(scheme, proof);
    findings.extend(near_integrable_findings(scheme, proof));
    findings.extend(scheme.table.symmetric.as_ref().filter(|claim| claim.value != proof.symmetric).map(|claim| {
        match claim.value {
            true => Finding::NotSymmetric { claim },
            false => Finding::Symmetric { claim },
        }
    }));
    let refused = findings.iter().any(Finding::is_refused);
    findings.extend(digits_finding(scheme, proof, refused));
    findings
}

fn order_finding<'a>(scheme: &'a ExactScheme, proof: &'a Proof) -> Vec<Finding<'a>> {
    let (kinetic, claimed) = (scheme.table.kinetic, &scheme.table.order);
    let (family, proved) = (Family::Kinetic(kinetic), proof.for_kinetic(kinetic));
    match proved.order {
        holds if holds > claimed.value => vec![Finding::HigherOrder { family, claimed, holds }],
        holds if holds == claimed.value => Vec::new(),
        0 if !(proved.undecided && scheme.table.digits.is_some()) => sum_findings(scheme),
        _ => vec![Finding::LowerOrder { family, claimed, proved }],
    }
}

/// The conditions of order 1 that fail.
fn sum_findings(scheme: &ExactScheme) -> Vec<Finding<'_>> {
    let sums = evaluated(&scheme.maps(), scheme.held, Family::Kinetic(Kinetic::Any), 1);
    let finding = |sum: Evaluated| match sum.condition.functional {
        Functional::Word(word) => {
            Finding::Sum { kind: word[0], found: sum.found.reduced(), needed: sum.condition.needed }
        }
        Functional::Named(_) => unreachable!("the conditions for every T(p) are words"),
    };
    sums.into_iter().filter(|sum| !sum.is_met()).map(finding).collect()
}

fn near_integrable_findings<'a>(scheme: &'a ExactScheme, proof: &'a Proof) -> Vec<Finding<'a>> {
    let claim = scheme.table.near_integrable.as_ref().filter(|_| proof.general.order > 0);
    let mut findings = Vec::new();
    // an order cannot be claimed higher than those of lower powers of ε
    let mut least = u32::MAX;
    for ((claimed, power), proved) in claim.into_iter().flat_map(|claim| claim.powers()).zip(&proof.near_integrable) {
        let family = Family::Power(power);
        least = least.min(proved.order);
        if least > claimed.value {
            findings.push(Finding::HigherOrder { family, claimed, holds: least });
        }
        if proved.order < claimed.value {
            findings.push(Finding::LowerOrder { family, claimed, proved });
        }
    }
    findings
}

fn digits_finding<'a>(scheme: &'a ExactScheme, proof: &Proof, refused: bool) -> Option<Finding<'a>> {
    match (Linearised::of(scheme), scheme.held) {
        (Some(linearised), Held::Digits(claimed)) => {
            let unexplained = linearised.unexplained(scheme)?;
            // of a table that is refused, only what would mend it is of use
            let is_of_use = !refused || matches!(unexplained, Unexplained::OneOf(_));
            is_of_use.then_some(Finding::Unexplained { claimed, unexplained, refused })
        }
        _ => {
            let claimed = scheme.table.digits.as_ref()?;
            let hold = proof.for_kinetic(scheme.table.kinetic).digits?;
            (hold + MOST_DIGITS_LOST < claimed.value).then_some(Finding::FewerDigits { claimed, hold })
        }
    }
}
