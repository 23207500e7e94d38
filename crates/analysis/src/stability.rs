//! Where the harmonic oscillator is stable: |tr| ≤ 2, decided exactly for the given weights.
//!
//! The trace leaves [−2, 2] and returns where tr − 2 or tr + 2 changes its sign; where it only touches ±2 neither
//! does. The search starts at x = 0, where the step is the identity and tr decreases, and follows the sign changes.

use num_bigint::BigInt;
use num_traits::{One, ToPrimitive};
use shadowstep_schemes::Proved;
use shadowstep_schemes::symbolic::Rational;
use shadowstep_schemes::symbolic::decimal::to_significant;

use crate::period::repeated_part;
use crate::powers::{Powers, quotient, repeats_exchanged};
use crate::prime::{PRIME, Residues};
use crate::roots::{InDoubt, Isolated, Scaled, SignChanges};
use crate::squarefree::is_surely_squarefree;
use crate::trace::{Trace, residues, scaled};
use shadowstep_schemes::arithmetic::{Fixed, FixedPoint};
use shadowstep_schemes::map::Map;
use shadowstep_schemes::scheme::Held;

/// The most maps of a step, or of the part that it repeats, for which the polynomial is solved: the time grows with the
/// third power of the number.
pub const MOST_MAPS: usize = 400;

/// Digits of limits and ends of gaps.
const DIGITS: usize = 30;

/// Digits of the weights by which a gap may be wider than their rounding.
const DIGITS_LOST: i32 = 4;

/// Bits of the first attempt. A third of them is the depth to which the roots in x are bisected at least: 2^−170 of the
/// range is beyond 40 digits.
const BITS: u64 = 512;

/// Where the harmonic oscillator is stable.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// The least hω beyond which the trace leaves [−2, 2], to 30 digits.
    pub limit: String,
    /// The intervals of instability between the limit and hω = 2·(evaluations), which no limit exceeds. Two between
    /// which all 30 digits agree are one.
    pub gaps: Vec<Gap>,
}

/// An interval of hω in which |tr| > 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Where it begins, to 30 digits.
    pub from: String,
    /// Where it ends, to 30 digits; `None` if it continues beyond 2·(evaluations).
    pub to: Option<String>,
    /// Its width, up to 2·(evaluations) if it continues.
    pub width: f64,
}

impl Stability {
    /// The stability of a proved scheme; gaps that the rounding of its weights explains are left out. `None` for a step
    /// of more than [`MOST_MAPS`].
    pub fn of_scheme(proved: &Proved) -> Option<Stability> {
        Some(Stability::of(&proved.scheme.maps(), proved.plan.degree())?.resolved(proved.scheme.held))
    }

    /// Without the gaps that rounding of the weights may have opened where the trace only touches ±2.
    pub(crate) fn resolved(self, held: Held) -> Stability {
        let Held::Digits(digits) = held else { return self };
        let rounding = 10_f64.powi(DIGITS_LOST - digits as i32);
        let gaps: Vec<_> = self.gaps.into_iter().filter(|gap| gap.width > rounding).collect();
        Stability { limit: gaps.first().map_or(self.limit, |gap| gap.from.clone()), gaps }
    }

    /// The stability of the step that these maps make, whose trace has at most this degree in (hω)².
    pub(crate) fn of(maps: &[Map], degree: usize) -> Option<Stability> {
        let part = repeated_part(maps);
        if part.len() > MOST_MAPS {
            return None;
        }
        let last = 4 * (degree as u64).pow(2);
        let crossings = parted(crossings(&part, last));
        let limit = crossings.first().expect("a consistent scheme is unstable beyond 2·(evaluations)").text();
        let gaps = crossings.chunks(2).filter(|ends| ends[0].is_below(last)).map(|ends| {
            let to = ends.get(1).filter(|to| to.is_below(last));
            let width = match to {
                Some(to) => ends[0].distance(&to.lower),
                None => ends[0].distance(&Rational::from_integer(last.into())),
            };
            Gap { from: ends[0].text(), to: to.map(Crossing::text), width }
        });
        Some(Stability { gaps: gaps.collect(), limit })
    }
}

/// The crossings without the ends of windows of stability that are too narrow for their digits.
fn parted(crossings: Vec<Crossing>) -> Vec<Crossing> {
    let mut parted: Vec<Crossing> = Vec::new();
    for crossing in crossings {
        let begins = parted.len().is_multiple_of(2);
        match parted.last() {
            Some(end) if begins && end.text == crossing.text => drop(parted.pop()),
            _ => parted.push(crossing),
        }
    }
    parted
}

/// An x at which the trace passes 2 or −2.
struct Crossing {
    lower: Rational,
    upper: Rational,
    text: String,
}

impl Crossing {
    fn of(root: &Isolated, range: u64) -> Result<Crossing, InDoubt> {
        let unit = BigInt::one() << root.depth;
        let at = |place: BigInt| Rational::new(place * range, unit.clone());
        let (lower, upper) = (at(root.place.clone()), at(&root.place + 1));
        let text = root_text(&lower);
        if text == root_text(&upper) { Ok(Crossing { lower, upper, text }) } else { Err(InDoubt) }
    }

    fn text(&self) -> String {
        self.text.clone()
    }

    fn is_below(&self, x: u64) -> bool {
        self.upper <= Rational::from_integer(x.into())
    }

    /// √x − √(this)
    fn distance(&self, x: &Rational) -> f64 {
        let root = |x: &Rational| x.to_f64().unwrap_or(f64::NAN).sqrt();
        (x - &self.lower).to_f64().unwrap_or(f64::NAN) / (root(x) + root(&self.lower))
    }
}

/// √x to [`DIGITS`] digits.
fn root_text(x: &Rational) -> String {
    // hω is at least 1e-5 or so, so that the digits end before these places
    let scale = BigInt::from(10).pow(DIGITS as u32 + 30);
    let root = (x.numer() * &scale * &scale / x.denom()).sqrt();
    to_significant(&Rational::new(root, scale), DIGITS)
}

/// tr − 2 without its root at 0, or tr + 2: where it changes its sign, the trace passes ±2.
enum Passing<'a> {
    /// Without multiple roots; the coefficients are computed as precisely as they are needed.
    Simple { maps: &'a [Map], level: i32 },
    /// With no simple root, except at 0.
    Never,
    /// With double roots that the powers in the step explain.
    OfPowers { maps: &'a [Map], level: i32, powers: Powers },
    /// With its squares divided out, exactly, which takes long for many digits.
    Exact(SignChanges),
}

impl Passing<'_> {
    fn of(maps: &[Map], level: i32) -> Passing<'_> {
        let below = usize::from(level == 2);
        if let Some(mut residues) = residues(maps) {
            residues[0] = (residues[0] + PRIME).checked_add_signed(-i64::from(level)).expect("it is positive") % PRIME;
            if is_surely_squarefree(&residues[below..]) {
                return Passing::Simple { maps, level };
            }
            if level == 2 && repeats_exchanged(maps) {
                return Passing::Never;
            }
            let explains = |powers: &Powers| is_squarefree_without(powers, &residues[below..], level);
            if let Some(powers) = Powers::all_of(maps).into_iter().find(explains) {
                return Passing::OfPowers { maps, level, powers };
            }
        }
        let mut trace = Trace::of(maps);
        trace.integers[0] -= level;
        Passing::Exact(SignChanges::of(&trace.integers[below..], &trace.denominator))
    }

    /// It on the x from 0 to `range`.
    fn scaled(&self, range: u64, bits: u64) -> Scaled {
        match self {
            Passing::Exact(polynomial) => polynomial.scaled(range, bits),
            Passing::Never => Scaled::new(vec![-BigInt::one() << bits], bits),
            Passing::Simple { maps, level } => Scaled::new(less_level(maps, *level, range, bits), bits),
            Passing::OfPowers { maps, level, powers } => (1..)
                .find_map(|attempt| without_squares(maps, *level, powers, range, bits, attempt))
                .expect("more bits do"),
        }
    }
}

/// tr − level on the x from 0 to `range`, for the level 2 without the root at 0.
fn less_level(maps: &[Map], level: i32, range: u64, bits: u64) -> Vec<BigInt> {
    let mut coefficients = scaled(maps, range, bits);
    coefficients[0] -= BigInt::from(level) << bits;
    coefficients.split_off(usize::from(level == 2))
}

/// Whether tr − level has no multiple root but those that the powers explain.
fn is_squarefree_without(powers: &Powers, residues: &[u64], level: i32) -> bool {
    let Some(trace) = crate::trace::residues(&powers.part) else { return false };
    powers.square(&Residues, &trace, level).is_some_and(|(square, constant)| {
        square.len() <= residues.len() && is_surely_squarefree(&quotient(&Residues, residues, &square, constant))
    })
}

/// tr − level without the double roots that the powers explain; `None` if the bits of this attempt are too few.
fn without_squares(maps: &[Map], level: i32, powers: &Powers, range: u64, bits: u64, attempt: u64) -> Option<Scaled> {
    // divided for 0 ≤ x ≤ 1, where no coefficient is large, so that errors do not grow
    let more = maps.len() as u64 / 2 * u64::from(range.ilog2() + 1) + 64 * attempt;
    let arithmetic = FixedPoint::with_bits((bits + more) as u32);
    let (all, more) = (u64::from(arithmetic.bits()), u64::from(arithmetic.bits()) - bits);
    let fixed = |values: Vec<BigInt>| values.iter().map(|units| Fixed::within(units, 2.0)).collect::<Vec<_>>();
    let trace = fixed(scaled(&powers.part, 1, all));
    let (square, constant) = powers.square(&arithmetic, &trace, level).expect("it has double roots");
    let quotient = quotient(&arithmetic, &fixed(less_level(maps, level, 1, all)), &square, constant);
    let mut coefficients = Vec::new();
    for (power, value) in quotient.iter().enumerate() {
        let grown = value.error().log2() + power as f64 * (range as f64).log2();
        if grown >= more as f64 - 1.0 {
            return None;
        }
        coefficients.push((value.units() * BigInt::from(range).pow(power as u32)) >> more);
    }
    Some(Scaled::new(coefficients, bits))
}

/// All x in 0 < x ≤ 1.01·`last` at which the trace passes ±2, in their order. A scheme whose weights sum to 1 up to
/// their digits only, which is to a thousandth at least, may have its limit a little beyond `last`.
fn crossings(maps: &[Map], last: u64) -> Vec<Crossing> {
    let functions = [2, -2].map(|level| Passing::of(maps, level));
    // another range bisects at other places, in case one of them is a root
    (1..)
        .find_map(|attempt| {
            crossings_within(&functions, last + last / 100 + attempt, BITS << (attempt - 1).min(20)).ok()
        })
        .expect("simple roots are separated with enough bits")
}

fn crossings_within(functions: &[Passing<'_>], range: u64, bits: u64) -> Result<Vec<Crossing>, InDoubt> {
    let mut all = Vec::new();
    for function in functions {
        let scaled = function.scaled(range, bits);
        for mut root in scaled.roots()? {
            // some bits beyond the places where neighbours part; far beyond the limit the trace may pass from −2 to 2
            // within any number of digits
            let depth = (root.depth + 64).max(bits / 3);
            scaled.refine(&mut root, depth)?;
            all.push(Crossing::of(&root, range)?);
        }
    }
    all.sort_by(|a, b| a.lower.cmp(&b.lower));
    let parted = all.windows(2).all(|pair| pair[0].upper <= pair[1].lower);
    if parted { Ok(all) } else { Err(InDoubt) }
}

#[cfg(test)]
mod tests {
    use shadowstep_schemes::MapKind::{self, Drift, Kick};

    use super::*;

    fn maps(weights: &[(MapKind, i64)]) -> Vec<Map> {
        weights.iter().map(|&(kind, n)| Map { kind, weight: Rational::new(n.into(), 60.into()) }).collect()
    }

    fn merged(parts: &[&[Map]]) -> Vec<Map> {
        let mut all: Vec<Map> = Vec::new();
        for map in parts.concat() {
            match all.last_mut() {
                Some(last) if last.kind == map.kind => last.weight += map.weight,
                _ => all.push(map),
            }
        }
        repeated_part(&all)
    }

    /// The step as powers must give the roots that Euclid's algorithm gives.
    fn assert_powers_explain(maps: &[Map], levels: &[i32]) {
        for level in [2, -2] {
            let passing = Passing::of(maps, level);
            assert!(!matches!(passing, Passing::Exact(_)), "Euclid's algorithm for {level} of {maps:?}");
            assert_eq!(matches!(passing, Passing::OfPowers { .. }), levels.contains(&level), "{level} of {maps:?}");
            let mut trace = Trace::of(maps);
            trace.integers[0] -= level;
            let exact = SignChanges::of(&trace.integers[usize::from(level == 2)..], &trace.denominator);
            let range = 4 * (maps.len() as u64).pow(2) + 1;
            let roots = |scaled: Scaled| {
                let mut roots = scaled.roots().unwrap();
                roots.iter_mut().for_each(|root| scaled.refine(root, 150).unwrap());
                roots
            };
            assert_eq!(roots(passing.scaled(range, 1024)), roots(exact.scaled(range, 1024)), "{level} of {maps:?}");
        }
    }

    #[test]
    fn repeated_parts_need_no_greatest_common_divisor() {
        let part = maps(&[(Kick, 4), (Drift, 9), (Kick, 11), (Drift, 6)]);
        let adjoint: Vec<Map> = part.iter().rev().cloned().collect();
        let rotated = [&part[1..], &part[..1]].concat();
        let (a, b, c) = (&part[..], &adjoint[..], &rotated[..]);
        // an even number of powers has all its double roots where the trace is 2
        assert_powers_explain(&merged(&[a, a, b, b]), &[2]);
        assert_powers_explain(&merged(&[a, a, a, b, b, b]), &[2]);
        assert_powers_explain(&merged(&[a, a, b, b, b, b, b, b]), &[2]);
        assert_powers_explain(&merged(&[a, a, c, c, b, b, c, c]), &[2]);
        // an odd number of squares has them at −2, of other powers at both, unless there are too few
        assert_powers_explain(&merged(&[a, a, c, c, b, b]), &[-2]);
        assert_powers_explain(&merged(&[a, a, a, a, b, b]), &[-2]);
        assert_powers_explain(&merged(&[a, a, a, c, c, c, b, b, b]), &[2, -2]);
        assert_powers_explain(&merged(&[a, a, a, a, c, c, c, c, b, b, b, b]), &[2, -2]);
    }

    #[test]
    fn parts_of_different_traces_have_simple_roots() {
        let (a, b) = (maps(&[(Kick, 4), (Drift, 9), (Kick, 4)]), maps(&[(Kick, 5), (Drift, 7), (Kick, 5)]));
        assert_powers_explain(&merged(&[&a, &a, &b, &b]), &[]);
    }

    #[test]
    fn a_step_followed_by_itself_with_kicks_and_drifts_exchanged_passes_minus_two_only() {
        let step = maps(&[(Kick, 5), (Drift, 11), (Kick, 7), (Drift, 2), (Kick, 1)]);
        let exchanged: Vec<Map> =
            step.iter().map(|map| Map { kind: map.kind.other(), weight: map.weight.clone() }).collect();
        for maps in [merged(&[&step, &exchanged]), merged(&[&step, &step, &exchanged, &exchanged])] {
            assert!(matches!(Passing::of(&maps, 2), Passing::Never));
            let mut trace = Trace::of(&maps);
            trace.integers[0] -= 2;
            let exact = SignChanges::of(&trace.integers[1..], &trace.denominator);
            assert_eq!(exact.scaled(10_000, 1024).roots().unwrap(), []);
            assert!(!matches!(Passing::of(&maps, -2), Passing::Exact(_)));
        }
    }
}
