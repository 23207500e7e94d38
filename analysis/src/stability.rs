//! Where the harmonic oscillator is stable: |tr| ≤ 2, decided exactly for the given weights.
//!
//! The trace leaves [−2, 2] and returns where tr − 2 or tr + 2 changes its sign; where it only touches ±2 neither
//! does. The search starts at x = 0, where the step is the identity and tr decreases, and follows the sign changes.

use num_bigint::BigInt;
use num_traits::{One, ToPrimitive};
use shadowstep_schemes::Proved;
use shadowstep_symbolic::Rational;
use shadowstep_symbolic::decimal::to_significant;

use crate::period::repeated_part;
use crate::prime::PRIME;
use crate::roots::{InDoubt, Isolated, Scaled, SignChanges};
use crate::squarefree::is_surely_squarefree;
use crate::trace::{Trace, residues, scaled};
use shadowstep_schemes::map::Map;

/// The most maps of a step, or of the part that it repeats, for which the polynomial is solved: the time grows with the
/// third power of the number.
pub const MOST_MAPS: usize = 400;

/// Digits of limits and ends of gaps.
const DIGITS: usize = 30;

/// Bits of the first attempt. A third of them is the depth to which the roots in x are bisected at least: 2^−170 of the
/// range is beyond 40 digits.
const BITS: u64 = 512;

/// Where the harmonic oscillator is stable.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// The least hω beyond which the trace leaves [−2, 2], to 30 digits.
    pub limit: String,
    /// The intervals of instability between the limit and hω = 2·(evaluations), which no limit exceeds. Two between which
    /// all 30 digits agree are one.
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
    /// The stability of a proved scheme; `None` for a step of more than [`MOST_MAPS`].
    pub fn of_scheme(proved: &Proved) -> Option<Stability> {
        Stability::of(&proved.scheme.maps(), proved.plan.evaluations)
    }

    /// The stability of the step that these maps make with this number of force evaluations.
    pub(crate) fn of(maps: &[Map], evaluations: usize) -> Option<Stability> {
        let part = repeated_part(maps);
        if part.len() > MOST_MAPS {
            return None;
        }
        let last = 4 * (evaluations as u64).pow(2);
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
    /// With its squares divided out, exactly.
    Exact(SignChanges),
}

impl Passing<'_> {
    fn of(maps: &[Map], level: i32) -> Passing<'_> {
        let below = usize::from(level == 2);
        let is_simple = residues(maps).is_some_and(|mut residues| {
            residues[0] = (residues[0] + PRIME).checked_add_signed(-i64::from(level)).expect("it is positive") % PRIME;
            is_surely_squarefree(&residues[below..])
        });
        if is_simple {
            return Passing::Simple { maps, level };
        }
        let mut trace = Trace::of(maps);
        trace.integers[0] -= level;
        Passing::Exact(SignChanges::of(&trace.integers[below..], &trace.denominator))
    }

    /// It on the x from 0 to `range`.
    fn scaled(&self, range: u64, bits: u64) -> Scaled {
        match self {
            Passing::Exact(polynomial) => polynomial.scaled(range, bits),
            Passing::Simple { maps, level } => {
                let mut coefficients = scaled(maps, range, bits);
                coefficients[0] -= BigInt::from(*level) << bits;
                Scaled::new(coefficients.split_off(usize::from(*level == 2)), bits)
            }
        }
    }
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
            // some bits beyond the places where neighbours part; far beyond the limit the trace may pass from −2 to 2 within
            // any number of digits
            let depth = (root.depth + 64).max(bits / 3);
            scaled.refine(&mut root, depth)?;
            all.push(Crossing::of(&root, range)?);
        }
    }
    all.sort_by(|a, b| a.lower.cmp(&b.lower));
    let parted = all.windows(2).all(|pair| pair[0].upper <= pair[1].lower);
    if parted { Ok(all) } else { Err(InDoubt) }
}
