//! Claims against conditions → a proved scheme, or faults.
//!
//! Where the weights are exact, a condition *holds* if it is met exactly. Where they are rounded to so many digits, it
//! holds if it is met as closely as one unit of 10^(1−digits) in each weight can account for (a bound to first order,
//! with the rounding of the arithmetic itself included), and if that is close enough to tell: at most a thousandth of the
//! value needed. How many digits really hold is reported.

use num_bigint::BigInt;
use num_traits::{FromPrimitive, Signed, Zero};
use shadowstep_symbolic::decimal::{to_significant, to_text};
use shadowstep_symbolic::{Fraction, Ratio, Rational};

use crate::arithmetic::{Arithmetic, ExactArithmetic, FixedPoint, Sensitivity};
use crate::claims::{HIGHEST_NEAR_INTEGRABLE_ORDER, HIGHEST_ORDER, Kinetic};
use crate::digits::digits_of;
use crate::document::Placed;
use crate::document::{Fault, Faults, Source};
use crate::exact::{self, Library};
use crate::map::{First, Map};
use crate::near_integrable::{self, Power};
use crate::order::Condition;
use crate::scheme::{Held, Scheme};
use crate::stage::Plan;
use crate::table::{Table, Weights};
use crate::{nystrom, order};

/// Digits that sums of products of good weights lose without a remark; the worst of the shipped tables loses 3.
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
    /// Whether that condition is met as far as the digits of the weights go, which is not far enough to tell.
    pub undecided: bool,
}

/// What is true of a scheme.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// For every T(p).
    pub general: Order,
    /// For T = ½pᵀM⁻¹p.
    pub quadratic: Order,
    /// For the terms of ε, ε², … of a near-integrable H = A + εB: as many as the table claims orders for, the last one
    /// for all higher powers too.
    pub near_integrable: Vec<Order>,
    /// The step is a palindrome, exactly.
    pub symmetric: bool,
}

/// Conditions that are judged together.
#[derive(Clone, Copy)]
enum Family {
    /// Those of a class of kinetic energies.
    Kinetic(Kinetic),
    /// Those of a power of ε.
    Power(Power),
}

/// A scheme, what was proved of it, and remarks on claims that say less than the truth.
#[derive(Clone, Debug)]
pub struct Proved {
    /// The scheme.
    pub scheme: Scheme,
    /// What is true of it.
    pub proof: Proof,
    /// Sentences with places.
    pub remarks: Vec<Fault>,
}

impl Proved {
    /// The plan of a step.
    pub fn plan(&self) -> Plan {
        Plan::of(&self.scheme)
    }

    /// The order proved for the kinetic energies that the table is meant for.
    pub fn order(&self) -> &Order {
        self.proof.for_kinetic(self.scheme.table.kinetic)
    }

    /// Whether the order claimed holds for every T(p), whatever kinetic energies the table is meant for.
    pub fn holds_for_every_kinetic(&self) -> bool {
        self.proof.general.order >= self.scheme.table.order.value
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

/// Reads a table and proves what it claims.
///
/// # Errors
/// All faults of the text, of the cells and of the claims; claims are looked at once the cells have values.
pub fn read(source: &Source, library: Library<'_>) -> Result<Proved, Faults> {
    judge(exact::scheme(source, library))
}

/// Like [`read`], with the roles of kick and drift exchanged where `first` asks for it.
///
/// # Errors
/// As [`read`]; also where the order claimed does not survive the exchange.
pub fn read_first(source: &Source, library: Library<'_>, first: First) -> Result<Proved, Faults> {
    let (scheme, faults) = exact::scheme(source, library);
    judge((scheme.map(|scheme| scheme.starting_with(first)), faults))
}

/// Proves the orders of a scheme, whatever its table claims.
pub fn prove(scheme: &Scheme) -> Proof {
    let maps = scheme.maps();
    let proved = |family, claimed: u32, highest: u32| {
        let first_try = prove_up_to(&maps, scheme.held, family, (claimed + 1).min(highest));
        match first_try.failed {
            Some(_) => first_try,
            None => prove_up_to(&maps, scheme.held, family, highest),
        }
    };
    let for_kinetic = |kinetic| proved(Family::Kinetic(kinetic), scheme.table.order.value, HIGHEST_ORDER);
    let powers = scheme.table.near_integrable.iter().flat_map(|claim| claim.powers());
    let for_power =
        |(claim, power): (&Placed<u32>, _)| proved(Family::Power(power), claim.value, HIGHEST_NEAR_INTEGRABLE_ORDER);
    Proof {
        general: for_kinetic(Kinetic::Any),
        quadratic: for_kinetic(Kinetic::Quadratic),
        near_integrable: powers.map(for_power).collect(),
        symmetric: scheme.is_symmetric(),
    }
}

fn prove_up_to(maps: &[Map], held: Held, family: Family, highest: u32) -> Order {
    let mut judged = judged_conditions(maps, held, family, highest);
    let failed = judged.iter().position(|c| !c.holds());
    let order = failed.map_or(highest, |first| judged[first].condition.order - 1);
    let holding = judged.iter().filter(|c| c.condition.order <= order);
    let digits = holding.filter_map(|c| digits_of(&c.uncertainty())).min();
    let failed = failed.map(|first| judged.swap_remove(first));
    let undecided = failed.as_ref().is_some_and(Judged::is_met);
    Order { order, digits, failed: failed.map(|c| (c.condition, c.found.reduced())), undecided }
}

/// A condition with its value and what the digits of the weights allow.
struct Judged {
    condition: Condition,
    found: Fraction,
    /// Bound of the error of `found`.
    error: Fraction,
    /// How far the value may be off.
    tolerance: Fraction,
}

impl Judged {
    fn uncertainty(&self) -> Fraction {
        let (found, needed, error) = (&self.found, &self.condition.needed, &self.error);
        debug_assert!(error.numer().is_zero() || found.denom() == error.denom());
        let distance = (found.numer() * needed.denom() - needed.numer() * found.denom()).abs();
        Fraction::new(distance + error.numer() * needed.denom(), found.denom() * needed.denom())
    }

    fn holds(&self) -> bool {
        self.is_met() && self.is_decided()
    }

    fn is_met(&self) -> bool {
        self.uncertainty() <= self.tolerance
    }

    /// Whether the weights have digits enough to tell a condition that is met from one that is not.
    fn is_decided(&self) -> bool {
        let thousandfold = Fraction::new(self.tolerance.numer() * 1000, self.tolerance.denom().clone());
        thousandfold <= self.condition.needed
    }
}

fn judged_conditions(maps: &[Map], held: Held, family: Family, highest: u32) -> Vec<Judged> {
    match held {
        Held::Exactly => {
            let zero = || Fraction::from(Rational::zero());
            conditions(maps, family, worth_exactness(maps, family, highest), &ExactArithmetic)
                .into_iter()
                .map(|(condition, found)| Judged { condition, found: found.into(), error: zero(), tolerance: zero() })
                .collect()
        }
        Held::Digits(digits) => {
            let arithmetic = FixedPoint::new(digits);
            let unit = BigInt::from(10).pow(digits - 1);
            let slopes = conditions(maps, family, highest, &Sensitivity);
            conditions(maps, family, highest, &arithmetic)
                .into_iter()
                .zip(slopes)
                .map(|((condition, value), (_, sensitive))| {
                    let (found, error) = arithmetic.read(&value);
                    let slope = Rational::from_f64(sensitive.slope).unwrap_or_else(Rational::zero);
                    let tolerance = Fraction::new(slope.numer().clone(), slope.denom() * &unit);
                    Judged { condition, found, error, tolerance }
                })
                .collect()
        }
    }
}

/// The first order that certainly fails, or the highest: exact arithmetic beyond would be long and tell nothing.
fn worth_exactness(maps: &[Map], family: Family, highest: u32) -> u32 {
    let arithmetic = FixedPoint::new(60);
    let fails = |(condition, value): &(Condition, _)| {
        let (found, error) = arithmetic.read(value);
        let judged = Judged { condition: condition.clone(), found, error: Rational::zero().into(), tolerance: error };
        !judged.is_met()
    };
    conditions(maps, family, highest, &arithmetic).iter().find(|c| fails(c)).map_or(highest, |(c, _)| c.order)
}

fn conditions<A: Arithmetic>(maps: &[Map], family: Family, highest: u32, arithmetic: &A) -> Vec<(Condition, A::Value)> {
    match family {
        Family::Kinetic(Kinetic::Any) => order::conditions(maps, highest, arithmetic),
        Family::Kinetic(Kinetic::Quadratic) => nystrom::conditions(maps, highest, arithmetic),
        Family::Power(power) => near_integrable::conditions(maps, power, highest, arithmetic),
    }
}

fn judge((scheme, mut faults): (Option<Scheme>, Vec<Fault>)) -> Result<Proved, Faults> {
    let Some(scheme) = scheme else { return Err(Faults::of(faults).expect("what is no scheme has a fault")) };
    let proof = prove(&scheme);
    let mut remarks = Vec::new();
    judge_order(&scheme, &proof, &mut faults, &mut remarks);
    judge_near_integrable(&scheme, &proof, &mut faults, &mut remarks);
    judge_symmetry(&scheme, &proof, &mut faults, &mut remarks);
    judge_digits(&scheme, &proof, &mut remarks);
    match Faults::of(faults) {
        Some(faults) => Err(faults),
        None => Ok(Proved { scheme, proof, remarks }),
    }
}

fn judge_order(scheme: &Scheme, proof: &Proof, faults: &mut Vec<Fault>, remarks: &mut Vec<Fault>) {
    let table = &scheme.table;
    let claimed = table.order.value;
    let order = proof.for_kinetic(table.kinetic);
    let class = match table.kinetic {
        Kinetic::Any => "for every T(p)",
        Kinetic::Quadratic => "for quadratic T",
    };
    let at = &table.order.at;
    if order.order > claimed {
        let message = format!("order {claimed} is claimed, order {} holds {class}", order.order);
        remarks.push(table.source.fault(at, message).hint(format!("write `order = {}`", order.order)));
    }
    if order.order >= claimed {
        return;
    }
    let Some((failed, found)) = &order.failed else { return };
    if let Some(fault) = too_few_digits(table, order, failed, class) {
        return faults.push(fault);
    }
    if order.order == 0 {
        return judge_sums(scheme, faults);
    }
    let message = format!(
        "order {claimed} is claimed, order {} holds {class}: the condition of {} fails",
        order.order, failed.name
    );
    let fault = table.source.fault(at, message).values(beside(found, &failed.needed), short(&failed.needed));
    faults.push(match table.kinetic {
        Kinetic::Any if proof.quadratic.order >= claimed => fault
            .hint(format!("order {} holds for quadratic T: write `kinetic = \"quadratic\"`", proof.quadratic.order)),
        _ => with_rounding_help(fault, table, &(found - &failed.needed)),
    });
}

/// Where a condition is met, but the weights have too few digits to tell.
fn too_few_digits(table: &Table, order: &Order, failed: &Condition, class: &str) -> Option<Fault> {
    let digits = table.digits.as_ref().filter(|_| order.undecided)?;
    let message = format!("{} digits are too few to tell whether order {} holds {class}", digits.value, failed.order);
    Some(table.source.fault(&digits.at, message).hint("take the weights from a source with more digits"))
}

fn judge_near_integrable(scheme: &Scheme, proof: &Proof, faults: &mut Vec<Fault>, remarks: &mut Vec<Fault>) {
    let table = &scheme.table;
    let Some(claim) = table.near_integrable.as_ref().filter(|_| proof.general.order > 0) else { return };
    // a term may be claimed to no higher order than those of lower powers of ε
    let mut least = u32::MAX;
    for ((claimed, power), order) in claim.powers().zip(&proof.near_integrable) {
        let class = format!("for the terms of {}", power.name());
        least = least.min(order.order);
        if least > claimed.value {
            let message = format!("order {} is claimed, order {least} holds {class}", claimed.value);
            remarks.push(table.source.fault(&claimed.at, message).hint(format!("write {least}")));
        }
        let Some((failed, found)) = order.failed.as_ref().filter(|_| order.order < claimed.value) else { continue };
        faults.push(too_few_digits(table, order, failed, &class).unwrap_or_else(|| {
            let message = format!(
                "order {} is claimed, order {} holds {class}: the condition of {} fails",
                claimed.value, order.order, failed.name
            );
            let fault =
                table.source.fault(&claimed.at, message).values(beside(found, &failed.needed), short(&failed.needed));
            with_rounding_help(fault, table, &(found - &failed.needed))
        }));
    }
}

/// The conditions of order 1, each at the weights that it is about.
fn judge_sums(scheme: &Scheme, faults: &mut Vec<Fault>) {
    let table = &scheme.table;
    for sum in
        judged_conditions(&scheme.maps(), scheme.held, Family::Kinetic(Kinetic::Any), 1).iter().filter(|c| !c.is_met())
    {
        let kicks = sum.condition.name.ends_with('K');
        let (weights, at) = match &table.weights {
            Some(Weights::Stages { kick, .. }) if kicks => ("kicks", &kick.at),
            Some(Weights::Stages { drift, .. }) => ("drifts", &drift.at),
            Some(Weights::Composition { gamma, .. }) => (if kicks { "kicks" } else { "drifts" }, &gamma.at),
            None => continue,
        };
        let message = format!("the {weights} do not sum to 1, so not even order 1 holds");
        let (found, needed) = (sum.found.clone().reduced(), &sum.condition.needed);
        let fault = table.source.fault(at, message).values(beside(&found, needed), "1");
        faults.push(with_rounding_help(fault, table, &(found - needed)));
    }
}

/// Where a condition is off by so little that rounded weights may be the reason.
fn with_rounding_help(fault: Fault, table: &Table, distance: &Rational) -> Fault {
    if digits_of(&distance.abs()).is_none_or(|digits| digits < 6) {
        return fault;
    }
    let off = format!("the condition is off by {}", to_significant(&distance.abs(), 2));
    fault.hint(match &table.digits {
        None => format!("{off}: if the weights are rounded, say so with `digits = …`"),
        Some(digits) => format!("{off}, more than {} digits of the weights can account for", digits.value),
    })
}

fn judge_symmetry(scheme: &Scheme, proof: &Proof, faults: &mut Vec<Fault>, remarks: &mut Vec<Fault>) {
    let table = &scheme.table;
    match &table.symmetric {
        Some(claim) if claim.value && !proof.symmetric => faults.push(not_a_palindrome(scheme, &claim.at)),
        Some(claim) if !claim.value && proof.symmetric => {
            remarks.push(table.source.fault(&claim.at, "the scheme is a palindrome").hint("write `symmetric = true`"))
        }
        _ => {}
    }
}

/// Conditions that hold to far fewer digits than the weights have, though as closely as their sensitivity allows.
fn judge_digits(scheme: &Scheme, proof: &Proof, remarks: &mut Vec<Fault>) {
    let table = &scheme.table;
    let (Some(digits), Some(held)) = (&table.digits, proof.for_kinetic(table.kinetic).digits) else { return };
    if held + MOST_DIGITS_LOST < digits.value {
        let message = format!("{} digits are claimed, the order conditions hold to {held}", digits.value);
        let help =
            format!("some digits of the weights may be wrong: write `digits = {held}`, or look for a better source");
        remarks.push(table.source.fault(&digits.at, message).hint(help));
    }
}

fn not_a_palindrome(scheme: &Scheme, at: &std::ops::Range<usize>) -> Fault {
    let maps = scheme.maps();
    let fault = scheme.table.source.fault(at, "a palindrome is claimed, the maps do not read the same backwards");
    let pair = maps.iter().zip(maps.iter().rev()).enumerate().find(|(_, (a, b))| a != b);
    match pair {
        Some((i, (from_start, from_end))) => fault
            .values(
                format!("{} {} as map {} from the start", from_start.kind, short(&from_start.weight), i + 1),
                format!("{} {}, the map {} from the end", from_end.kind, short(&from_end.weight), i + 1),
            )
            .hint("correct the weights, or leave `symmetric` out"),
        None => fault,
    }
}

/// A value as people write it, where its digits do not tell it from the one needed as that and what it is off by.
fn beside(found: &Rational, needed: &Rational) -> String {
    let off = found - needed;
    if to_text(found).len() <= 20 || to_significant(found, 16) != to_significant(needed, 16) {
        return short(found);
    }
    let sign = if off.is_negative() { '-' } else { '+' };
    format!("{} {sign} {}", short(needed), to_significant(&off.abs(), 2))
}

/// A value as people write it: exact if short, else rounded.
fn short(value: &Rational) -> String {
    let exact = to_text(value);
    if exact.len() <= 20 { exact } else { format!("{}…", to_significant(value, 16)) }
}
