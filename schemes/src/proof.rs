//! What is true of a scheme, and which claims of its table that refuses.
//!
//! Where the weights are exact, a condition *holds* if it is met exactly. Where they are rounded to some digits, it
//! holds if it is met as closely as one unit of 10^(1−digits) in each weight can account for (a bound to first order,
//! with the rounding of the arithmetic itself included), and if that is close enough to decide: at most a thousandth of
//! the value needed. The number of digits to which the conditions really hold is reported.

use crate::symbolic::Rational;

use crate::claims::{HIGHEST_ORDER, Kinetic, NearIntegrable};
use crate::conditions::{Evaluated, Family, evaluated, evaluated_of_parts};
use crate::digits::digits_of;
use crate::document::Placed;
use crate::map::Map;
use crate::map_kind::MapKind;
use crate::near_integrable::Power;
use crate::order::{Condition, Functional};
use crate::rounding::{Linearised, Unexplained};
use crate::scheme::{ExactInner, ExactScheme, Held};
use crate::table::Weights;

/// Digits that sums of products of good weights lose without a note, where the decimals themselves are not examined;
/// the worst of the shipped tables loses 3.
const MOST_DIGITS_LOST: u32 = 5;

/// Digits that products of the weights of an outer and an inner scheme may lose.
const DIGITS_LOST: u32 = 1;

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
    /// For every T(p), of the outer scheme where there is an [inner one](crate::inner). With gradient kicks: for all A
    /// and B, where a gradient kick is the flow of `[B,[A,B]]`, which for A = T(p) is so for quadratic T only; see
    /// [`Proved::order_for_every_kinetic`](crate::Proved::order_for_every_kinetic).
    pub general: Order,
    /// For T = ½pᵀM⁻¹p.
    pub quadratic: Order,
    /// For the terms of ε, ε², … of a near-integrable H = A + εB: one for each order that the table claims, the last
    /// one for all higher powers too.
    pub near_integrable: Vec<Order>,
    /// The step is a palindrome, exactly.
    pub symmetric: bool,
    /// The effective orders of a processed scheme; the others are the kernel's.
    pub effective: Option<Effective>,
    /// Of the step with an [inner scheme](crate::inner), for slow forces, fast forces and T, by the words on three
    /// letters.
    pub nested: Option<Order>,
    /// For H of three parts and more, by the words on three letters; only [where it is asked for](crate::many_parts).
    pub many_parts: Option<Order>,
}

/// The effective orders of a processed scheme: the orders of χ⁻¹ ∘ kernel ∘ χ, and so of χ⁻¹ ∘ kernelⁿ ∘ χ after any
/// number n of steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Effective {
    /// For every T(p).
    pub general: Order,
    /// For T = ½pᵀM⁻¹p.
    pub quadratic: Order,
    /// For the terms of ε, ε², … that the processor claims.
    pub near_integrable: Vec<Order>,
}

impl Effective {
    /// The order for a class of kinetic energies.
    pub fn for_kinetic(&self, kinetic: Kinetic) -> &Order {
        match kinetic {
            Kinetic::Any => &self.general,
            Kinetic::Quadratic => &self.quadratic,
        }
    }
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
    let table = &scheme.table;
    let [general, quadratic] = kinetic_orders(&scheme.maps(), scheme.held, table.order.value);
    Proof {
        general,
        quadratic,
        near_integrable: near_integrable_orders(&scheme.maps(), scheme.held, table.near_integrable.as_ref()),
        symmetric: scheme.is_symmetric(),
        effective: effective(scheme),
        nested: scheme.inner.as_ref().map(|inner| nested_order(scheme, inner)),
        many_parts: None,
    }
}

/// The order of the step of three parts, whose words of one order are about three times those of the order before.
fn nested_order(scheme: &ExactScheme, inner: &ExactInner) -> Order {
    let (maps, fast) = inner.step(&scheme.maps());
    let orders = (scheme.table.order.value + 1..=HIGHEST_ORDER + 1)
        .map(|highest| order_of_parts((&maps, &fast), scheme.held.losing(DIGITS_LOST), 3, highest.min(HIGHEST_ORDER)));
    let mut decided = orders.filter(|order| order.failed.is_some() || order.order == HIGHEST_ORDER);
    decided.next().expect("the last one is of the highest order")
}

fn effective(scheme: &ExactScheme) -> Option<Effective> {
    let (claim, processor) = (scheme.table.processor.as_ref()?, scheme.processor.as_ref()?);
    let maps = scheme.processed_maps()?;
    let [general, quadratic] = kinetic_orders(&maps, processor.held, claim.order.value);
    let near_integrable = near_integrable_orders(&maps, processor.held, claim.near_integrable.as_ref());
    Some(Effective { general, quadratic, near_integrable })
}

/// For every T(p), and for quadratic T.
fn kinetic_orders(maps: &[Map], held: Held, claimed: u32) -> [Order; 2] {
    let for_kinetic = |kinetic| highest_order(maps, held, Family::Kinetic(kinetic), claimed, HIGHEST_ORDER);
    [Kinetic::Any, Kinetic::Quadratic].map(for_kinetic)
}

fn near_integrable_orders(maps: &[Map], held: Held, claim: Option<&NearIntegrable>) -> Vec<Order> {
    let for_power = |(claim, power): (&Placed<u32>, Power)| {
        highest_order(maps, held, Family::Power(power), claim.value, power.highest_order())
    };
    claim.into_iter().flat_map(NearIntegrable::powers).map(for_power).collect()
}

/// The highest order that holds. Most schemes fail at the order above the claimed one, so that is tried first.
fn highest_order(maps: &[Map], held: Held, family: Family, claimed: u32, highest: u32) -> Order {
    let first_try = order_up_to(maps, held, family, (claimed + 1).min(highest));
    match first_try.failed {
        Some(_) => first_try,
        None => order_up_to(maps, held, family, highest),
    }
}

fn order_up_to(maps: &[Map], held: Held, family: Family, highest: u32) -> Order {
    order_by(evaluated(maps, held, family, highest), highest)
}

/// The order of a step for this number of parts, with the weights of their middle maps.
pub(crate) fn order_of_parts(step: (&[Map], &[Rational]), held: Held, parts: usize, highest: u32) -> Order {
    order_by(evaluated_of_parts(step, held, parts, highest), highest)
}

/// The order that conditions up to the highest one prove.
fn order_by(mut conditions: Vec<Evaluated>, highest: u32) -> Order {
    let failed = conditions.iter().position(|c| !c.holds());
    let order = failed.map_or(highest, |first| conditions[first].condition.order - 1);
    let holding = conditions.iter().filter(|c| c.condition.order <= order);
    let digits = holding.filter_map(|c| digits_of(&c.uncertainty())).min();
    let failed = failed.map(|first| conditions.swap_remove(first));
    let undecided = failed.as_ref().is_some_and(Evaluated::is_met);
    Order { order, digits, failed: failed.map(|c| (c.condition, c.found.reduced())), undecided }
}

/// What an order is claimed of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    /// The step as it stands: of a processed scheme, the kernel.
    Step,
    /// The step of three parts with an inner scheme.
    NestedStep,
    /// The processed step.
    ProcessedStep,
}

/// A claim that differs from what is true.
#[derive(Debug)]
pub(crate) enum Finding<'a> {
    /// The weights of the maps of one kind do not sum to 1.
    Sum { kind: MapKind, found: Rational, needed: Rational },
    /// The order that holds, in `proved`, is lower than the claimed one.
    LowerOrder { of: Of, family: Family, claimed: &'a Placed<u32>, proved: &'a Order },
    /// A higher order holds than the claimed one.
    HigherOrder { of: Of, family: Family, claimed: &'a Placed<u32>, holds: u32 },
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
    /// Whether the claim is refused; the other claims are true, but below what is proved.
    pub(crate) fn is_refused(&self) -> bool {
        let refused = matches!(self, Finding::Sum { .. } | Finding::LowerOrder { .. } | Finding::NotSymmetric { .. });
        refused || matches!(self, Finding::Unexplained { refused: true, .. })
    }
}

/// The claims of the scheme's table that differ from the proof.
pub(crate) fn findings<'a>(scheme: &'a ExactScheme, proof: &'a Proof) -> Vec<Finding<'a>> {
    let mut findings = order_finding(scheme, proof);
    if proof.general.order > 0 {
        let claim = scheme.table.near_integrable.as_ref();
        findings.extend(near_integrable_findings(Of::Step, claim, &proof.near_integrable));
        findings.extend(effective_findings(scheme, proof));
    }
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
    let family = Family::Kinetic(kinetic);
    let (of, proved) = match &proof.nested {
        Some(nested) => (Of::NestedStep, nested),
        None => (Of::Step, proof.for_kinetic(kinetic)),
    };
    match proved.order {
        holds if holds > claimed.value => vec![Finding::HigherOrder { of, family, claimed, holds }],
        holds if holds == claimed.value => Vec::new(),
        0 if of == Of::Step && !(proved.undecided && scheme.table.digits.is_some()) => sum_findings(scheme),
        _ => vec![Finding::LowerOrder { of, family, claimed, proved }],
    }
}

/// The conditions of order 1 that fail: of a composition, whose kicks and drifts have the sum of gamma, one.
fn sum_findings(scheme: &ExactScheme) -> Vec<Finding<'_>> {
    let sums = evaluated(&scheme.maps(), scheme.held, Family::Kinetic(Kinetic::Any), 1);
    let finding = |sum: Evaluated| match sum.condition.functional {
        Functional::Word(word) => {
            Finding::Sum { kind: word[0], found: sum.found.reduced(), needed: sum.condition.needed }
        }
        Functional::Named(_) => unreachable!("the conditions for every T(p) are words"),
    };
    let most = if matches!(scheme.table.weights, Some(Weights::Composition { .. })) { 1 } else { sums.len() };
    sums.into_iter().filter(|sum| !sum.is_met()).map(finding).take(most).collect()
}

/// The claims of the processor.
fn effective_findings<'a>(scheme: &'a ExactScheme, proof: &'a Proof) -> Vec<Finding<'a>> {
    let (Some(processor), Some(effective)) = (&scheme.table.processor, &proof.effective) else { return Vec::new() };
    let (of, claimed, kinetic) = (Of::ProcessedStep, &processor.order, scheme.table.kinetic);
    let (family, proved) = (Family::Kinetic(kinetic), effective.for_kinetic(kinetic));
    let mut findings = match proved.order {
        holds if holds > claimed.value => vec![Finding::HigherOrder { of, family, claimed, holds }],
        holds if holds == claimed.value => Vec::new(),
        _ => vec![Finding::LowerOrder { of, family, claimed, proved }],
    };
    findings.extend(near_integrable_findings(of, processor.near_integrable.as_ref(), &effective.near_integrable));
    findings
}

fn near_integrable_findings<'a>(of: Of, claim: Option<&'a NearIntegrable>, proved: &'a [Order]) -> Vec<Finding<'a>> {
    let mut findings = Vec::new();
    // an order cannot be claimed higher than the orders of lower powers of ε
    let mut least = u32::MAX;
    for ((claimed, power), proved) in claim.into_iter().flat_map(NearIntegrable::powers).zip(proved) {
        let family = Family::Power(power);
        least = least.min(proved.order);
        if least > claimed.value {
            findings.push(Finding::HigherOrder { of, family, claimed, holds: least });
        }
        if proved.order < claimed.value {
            findings.push(Finding::LowerOrder { of, family, claimed, proved });
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

#[cfg(test)]
mod tests {
    use crate::shipped_proved;

    #[test]
    fn processed_schemes_have_the_effective_orders_that_they_claim_and_no_higher_ones() {
        for corrector in [3, 5, 7, 11, 17] {
            let proof = &shipped_proved(&format!("wisdom-corrector-{corrector}")).unwrap().proof;
            let effective = proof.effective.as_ref().unwrap();
            let orders: Vec<_> = effective.near_integrable.iter().map(|order| order.order).collect();
            assert_eq!((proof.general.order, effective.general.order), (2, 2));
            assert_eq!(orders, [corrector + 1, 2]);
            let (failed, _) = effective.near_integrable[0].failed.as_ref().unwrap();
            assert_eq!(failed.order, corrector + 2);
        }
    }
}
