//! What is true of a list that was recognised, and what is wrong with it.

use num_traits::ToPrimitive;
use shadowstep_schemes::document::Source;
use shadowstep_schemes::{Fault, Faults, First, Kinetic, Proved, exact, read_first, shipped, to_significant};

use crate::known::{Likeness, Slip};
use crate::sources::claims::Context;
use crate::sources::recognised::Recognised;
use crate::sources::roles::Steps;

/// A list that is a scheme, or should be one.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The name of the list, or of the two lists.
    pub name: String,
    /// Its line, from 1.
    pub line: usize,
    /// What it was read as.
    pub role: String,
    /// The order for every T(p), and for quadratic T; 0 where the weights do not sum to 1.
    pub orders: [u32; 2],
    /// To how many digits; `None` for exactly, as far as closed forms are computed.
    pub digits: Option<u32>,
    /// Which map comes first, where the order for quadratic T depends on it.
    pub first: Option<First>,
    /// Whether it is a palindrome.
    pub symmetric: bool,
    /// The shipped scheme that it is.
    pub likeness: Option<Likeness>,
    /// What is wrong with it, a sentence each.
    pub faults: Vec<String>,
    /// What should be known and is not wrong.
    pub notes: Vec<String>,
}

/// Digits to which conditions hold beyond those of the weights, where not exactly.
const MORE: u32 = 5;

/// The longest text of a number in a message.
const LONGEST: usize = 60;

impl Verdict {
    pub(super) fn of(recognised: &Recognised<'_>) -> Verdict {
        let context = recognised.context();
        let mut verdict = Verdict {
            name: recognised.name(),
            line: recognised.line(),
            role: recognised.reading.role.to_string(),
            orders: [0, 0],
            digits: None,
            first: None,
            symmetric: recognised.reading.is_palindrome(),
            likeness: None,
            faults: Vec::new(),
            notes: Vec::new(),
        };
        match proved(recognised, Claims::ANY) {
            Some(found) => verdict.judge(recognised, &found),
            None => verdict.faults.push(wrong_sums(recognised)),
        }
        verdict.claims(recognised, &context);
        verdict
    }

    /// The orders and the digits.
    fn judge(&mut self, recognised: &Recognised<'_>, found: &Proved) {
        self.likeness = Likeness::of(&found.scheme.maps());
        self.symmetric = found.proof.symmetric;
        let tries = self.tries(recognised);
        let quadratic =
            |first| tries.iter().filter(|found| found.claims.first == first).map(|found| found.orders[1]).max();
        if let Some((kick, drift)) = quadratic(None).zip(quadratic(Some(First::Drift)))
            && kick != drift
        {
            self.first = Some(if kick > drift { First::Kick } else { First::Drift });
        }
        let Some(best) = tries.iter().rev().max_by_key(|found| found.rank()) else { return };
        self.orders = best.orders;
        let is_quadratic = best.orders[1] > best.orders[0];
        let order = if is_quadratic { &best.proved.proof.quadratic } else { &best.proved.proof.general };
        // sums that are met exactly have any number of digits
        let most = recognised.digits().map_or(exact::DIGITS, |printed| printed + MORE);
        self.digits = order.digits.filter(|digits| *digits <= most);
        let kinetic = if is_quadratic { "quadratic" } else { "any" };
        self.judge_digits(recognised, Claims { order: order.order, kinetic, first: best.claims.first });
    }

    /// Proofs with a kick and a drift first, and with the claims of the shipped scheme: with a wrong digit it is that
    /// scheme to fewer digits.
    fn tries(&self, recognised: &Recognised<'_>) -> Vec<Try> {
        let firsts: &[_] =
            if recognised.reading.role.steps == Steps::Composition { &[None] } else { &[None, Some(First::Drift)] };
        let claims =
            firsts.iter().flat_map(|first| [Claims { first: *first, ..Claims::ANY }, self.shipped_claims(*first)]);
        let tried = |claims| {
            let proved = proved(recognised, claims)?;
            Some(Try { claims, orders: [proved.proof.general.order, proved.proof.quadratic.order], proved })
        };
        claims.filter_map(tried).collect()
    }

    /// What the shipped scheme claims that it is.
    fn shipped_claims(&self, first: Option<First>) -> Claims {
        self.likeness.as_ref().map_or(Claims { first, ..Claims::ANY }, |likeness| {
            let table = likeness.known.table();
            let kinetic = if table.kinetic == Kinetic::Any { "any" } else { "quadratic" };
            Claims { order: table.order.value, kinetic, first }
        })
    }

    /// Whether rounding explains the digits, where what holds is claimed; a last digit that is not right is only noted.
    fn judge_digits(&mut self, recognised: &Recognised<'_>, claims: Claims) {
        let Some(digits) = recognised.digits() else { return };
        let claimed = |digits: u32| with_claims(recognised, claims, Some(digits));
        let has_its_digits = |found: &Result<Proved, Faults>| found.as_ref().is_ok_and(|found| found.has_its_digits);
        let found = claimed(digits);
        if has_its_digits(&found) {
            return;
        }
        if has_its_digits(&claimed(digits.saturating_sub(1).max(1))) {
            self.notes.push(format!("of {digits} digits the last is not right everywhere"));
            return;
        }
        let notes = match found {
            Ok(found) => found.notes,
            Err(Faults(faults)) => faults,
        };
        let of_rounding: Vec<_> = notes.iter().filter(|note| note.message.starts_with("rounding does not")).collect();
        if of_rounding.is_empty()
            && let Some(found) = proved(recognised, claims)
        {
            let hold = found.scheme.table.digits.as_ref().map_or(digits, |hold| hold.value);
            let farthest = self.farthest(recognised, &found);
            self.faults.push(format!("{digits} digits are printed, the conditions hold to {hold}{farthest}"));
        }
        self.faults.extend(of_rounding.into_iter().map(|note| worded(note, recognised)));
    }

    /// The entry that is farthest from the shipped scheme, and what it should be.
    fn farthest(&self, recognised: &Recognised<'_>, found: &Proved) -> String {
        let maps = found.scheme.maps();
        let Some((likeness, (map, right))) =
            self.likeness.as_ref().and_then(|likeness| Some((likeness, likeness.farthest(&maps)?)))
        else {
            return String::new();
        };
        let place = if recognised.reading.role.steps == Steps::Composition { map / 2 } else { map };
        let (entry, text) = recognised.entry(place);
        let text = text.map_or_else(String::new, |text| {
            format!(" `{text}`, which should be {}", to_significant(right, text.len().min(LONGEST)))
        });
        format!("; farthest from {} is {entry}{text}", likeness.known.name)
    }

    /// What names and comments claim, and a shipped scheme that it was copied from.
    fn claims(&mut self, recognised: &Recognised<'_>, context: &Context) {
        let holds = self.orders[0].max(self.orders[1]);
        let slip = recognised.slip().filter(|(known, _)| known.table().order.value > holds);
        if let Some((known, slip)) = slip {
            self.faults.push(slipped(recognised, known.name, &slip));
        }
        if let Some(claim) = context.order().filter(|claim| claim.order > holds) {
            let failed = self.failed(recognised);
            self.faults.push(format!("order {} is claimed by {}, order {holds} holds{failed}", claim.order, claim.by));
        } else if let Some((author, least)) = context.author().filter(|(_, least)| *least > holds) {
            let failed = self.failed(recognised);
            let named = format!("it is named after {}, whose schemes have order {least} and more", capital(author));
            match &self.likeness {
                Some(likeness) if likeness.known.mentions(author) => {}
                Some(likeness) => {
                    self.faults.push(format!("{named}; it is {}, of order {holds}{failed}", likeness.known.name))
                }
                // others have published schemes of order 2 that are not shipped
                None if ["suzuki", "yoshida"].contains(&author) && holds > 0 => {
                    self.faults.push(format!("{named}; it has order {holds}{failed}"))
                }
                None => {}
            }
        }
    }

    /// The condition that fails.
    fn failed(&self, recognised: &Recognised<'_>) -> String {
        let found = proved(recognised, Claims::ANY);
        found.and_then(|found| found.proof.general.failed).map_or_else(String::new, |(condition, value)| {
            let value = to_significant(&value, 6);
            format!(": the condition of {} fails, found {value}…, needed {}", condition.functional, condition.needed)
        })
    }
}

/// What is claimed of a list, so that it is proved or refused.
#[derive(Clone, Copy)]
struct Claims {
    order: u32,
    kinetic: &'static str,
    first: Option<First>,
}

impl Claims {
    /// Nothing but that the weights sum to 1.
    const ANY: Claims = Claims { order: 1, kinetic: "any", first: None };
}

/// A list with claims that hold.
struct Try {
    claims: Claims,
    /// For every T(p), and for quadratic T.
    orders: [u32; 2],
    proved: Proved,
}

impl Try {
    /// The higher orders, of equal ones those with more digits, and a kick first.
    fn rank(&self) -> (u32, u32, bool, bool) {
        (self.orders[1], self.orders[0], self.claims.order == 1, self.claims.first.is_none())
    }
}

/// Fewer digits than these decide no order beyond that of the sums.
const FEW: u32 = 10;

/// The scheme with as many digits as the claims allow; `None` where they do not hold. Decimals of few digits are also
/// taken as exact numbers.
fn proved(recognised: &Recognised<'_>, claims: Claims) -> Option<Proved> {
    let with = |digits| with_claims(recognised, claims, digits).ok();
    let Some(digits) = recognised.digits() else { return with(None) };
    let rounded = (digits / 2 + 1..=digits).rev().find_map(|digits| with(Some(digits)));
    let exact = if digits < FEW { with(None) } else { None };
    let order = |found: &Proved| found.proof.general.order.max(found.proof.quadratic.order);
    // of equal orders the last one
    exact.into_iter().chain(rounded).max_by_key(order)
}

/// The table of a list with these claims, proved.
fn with_claims(recognised: &Recognised<'_>, claims: Claims, digits: Option<u32>) -> Result<Proved, Faults> {
    let digits = digits.map_or_else(String::new, |digits| format!("digits = {digits}\n"));
    let Claims { order, kinetic, first } = claims;
    let claims = format!("order = {order}\nkinetic = \"{kinetic}\"\n{digits}");
    let text = recognised.reading.table(&recognised.constants(), &claims);
    let source = Source { path: "list.toml".to_owned(), text };
    read_first(&source, &|base, _| shipped(base), first)
}

fn wrong_sums(recognised: &Recognised<'_>) -> String {
    let maps = recognised.reading.maps();
    let sum = |kind: usize| maps.iter().skip(kind).step_by(2).sum::<f64>();
    let [first, second] = [sum(0), sum(1)].map(|sum| format!("{}", (sum * 1e9).round() / 1e9));
    match recognised.reading.role.steps {
        Steps::Composition | Steps::Adjoints => format!("the weights sum to {second}, not to 1"),
        Steps::Maps => {
            format!("the weights of the first map sum to {first}, those of the second to {second}, not to 1 both")
        }
    }
}

fn slipped(recognised: &Recognised<'_>, name: &str, slip: &Slip) -> String {
    let entry = |place: usize| {
        let (entry, text) = recognised.entry(place);
        let text = text.map_or_else(String::new, |text| format!(" `{text}`"));
        format!("{entry}{text}")
    };
    match slip {
        Slip::Wrong(wrong) => {
            let each = wrong.iter().map(|(place, right)| {
                let found = recognised.reading.cells.get(*place).map_or(0.0, |cell| cell.value);
                format!("{} should be {}{}", entry(*place), short(*right), explained(found, *right))
            });
            format!("it is {name} but for these entries: {}", each.collect::<Vec<_>>().join("; "))
        }
        Slip::Twice(place) => {
            format!("it is {name} with one entry too many: {} is there once too often", entry(place.saturating_sub(1)))
        }
        Slip::Missing(place, right) => {
            format!("it is {name} without {}, which is missing before {}", short(*right), entry(*place))
        }
    }
}

/// How a wrong entry may have come about.
fn explained(found: f64, right: f64) -> String {
    let ratio = right / found;
    let power = ratio.abs().log10();
    if (ratio + 1.0).abs() < 1e-6 {
        return ", with the other sign".to_owned();
    }
    if power.round() != 0.0 && (power - power.round()).abs() < 1e-6 {
        return format!(": its exponent e{} is missing", power.round());
    }
    String::new()
}

fn short(value: f64) -> String {
    format!("{value}")
}

/// A note of the proof in the words of the source: numbers are quoted as they stand there.
fn worded(note: &Fault, recognised: &Recognised<'_>) -> String {
    let mut text = note.message.clone();
    if let Some((found, needed)) = &note.values {
        text += &format!(", found {found}, needed {needed}");
    }
    if let Some(hint) = note.hint.as_ref().filter(|hint| hint.contains("transposed")) {
        text += &format!(" ({hint})");
    }
    let parts: Vec<_> = text.split('`').collect();
    let mut worded = String::new();
    for (i, part) in parts.iter().enumerate() {
        let number = part.strip_prefix('n').and_then(|id| id.parse().ok()).and_then(|id| recognised.text_of(id));
        let part = number.unwrap_or(part);
        worded += if i == 0 { "" } else { "`" };
        worded.extend(part.chars().take(if i % 2 == 1 { LONGEST } else { usize::MAX }));
    }
    worded
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

impl Likeness {
    /// `blanes-moan-s6 to 15 digits, kicks and drifts exchanged`.
    pub fn text(&self) -> String {
        let kernel = if self.known.table().processor.is_some() { "the kernel of " } else { "" };
        let digits = match self.digits() {
            Some(digits) if self.distance.to_f64().unwrap_or(0.0) > 0.0 => format!(" to {digits} digits"),
            _ => " exactly".to_owned(),
        };
        let exchanged = if self.exchanged && !self.known.table().symmetric.as_ref().is_some_and(|claim| claim.value) {
            ", kicks and drifts exchanged"
        } else {
            ""
        };
        let reversed = if self.reversed { ", in the opposite order" } else { "" };
        format!("{kernel}{}{digits}{exchanged}{reversed}", self.known.name)
    }
}
