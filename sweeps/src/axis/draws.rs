//! Random numbers: each draw is made from the seed, the name of the axis and its number alone, with the same bits everywhere.

use std::collections::BTreeMap;

use num_traits::Signed;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::RngCore;
use sha2::{Digest, Sha256};
use shadowstep::Rational;
use shadowstep_schemes::document::{Key, Keys, Reader, Text, Value};
use shadowstep_symbolic::decimal::{round_significant, to_text};
use shadowstep_symbolic::{evaluate, parse};
use toml::de::DeTable;

use super::number::{NUMBERS, number};

/// Draws are rounded to this many digits, and are exact from there on.
const DIGITS: u32 = 17;

/// The most draws.
const MOST: u64 = 1_000_000_000_000;

/// Independent random numbers.
#[derive(Clone, Debug)]
pub(super) struct Draws {
    count: u64,
    seed: u64,
    /// From the name of the axis: axes with the same seed are independent.
    stream: u128,
    distribution: Distribution,
}

#[derive(Clone, Debug)]
enum Distribution {
    /// Between two numbers.
    Uniform(Rational, Rational),
    /// Whose logarithm is uniform.
    Logarithmic(Rational, Rational),
    /// With this mean and standard deviation.
    Normal(Rational, Rational),
}

impl Draws {
    pub(super) fn read(reader: &mut Reader<'_>, name: &str, table: &DeTable<'_>, value: &Value<'_>) -> Option<Draws> {
        let keys = [
            Key::new("draws", "100"),
            Key::new("seed", "1"),
            Key::new("uniform", "[0, \"2*pi\"]"),
            Key::new("log", "[\"1e-6\", \"1e-3\"]"),
            Key::new("normal", "[0, \"1/10\"]"),
        ];
        let section = reader.table(table, value.span(), Keys::new("draws", keys));
        let count =
            reader.required(&section, "draws").and_then(|value| reader.whole(value, 1..=MOST, "a number of draws"));
        let seed = reader.required(&section, "seed").and_then(|value| reader.whole(value, 0..=u64::MAX, "a seed"));
        let given: Vec<_> = ["uniform", "log", "normal"].into_iter().filter(|key| section.get(key).is_some()).collect();
        let [kind] = given[..] else {
            match given[..] {
                [] => reader.missing(&section, &["uniform", "log", "normal"]),
                _ => reader.fault(
                    &section.at,
                    format!("{} and {} are both given", given[0], given[1]),
                    "keep one of the two",
                ),
            }
            return None;
        };
        let (a, b, at) = pair(reader, section.get(kind)?)?;
        let wrong = match kind {
            "uniform" if a >= b => Some(("the first number must be less than the second", "uniform = [0, 1]")),
            "log" if !a.is_positive() || a >= b => {
                Some(("the numbers must be positive, the first one less than the second", "log = [\"1e-6\", \"1e-3\"]"))
            }
            "normal" if !b.is_positive() => Some(("the standard deviation must be positive", "normal = [0, \"1/10\"]")),
            _ => None,
        };
        if let Some((message, hint)) = wrong {
            return reader.wrong(&at, message, format!("write {hint}"));
        }
        let distribution = match kind {
            "uniform" => Distribution::Uniform(a, b),
            "log" => Distribution::Logarithmic(a, b),
            _ => Distribution::Normal(a, b),
        };
        let hash = Sha256::digest(name.as_bytes());
        let stream = hash.iter().take(16).fold(0, |stream, byte| (stream << 8) | u128::from(*byte));
        Some(Draws { count: count?.value, seed: seed?.value, stream, distribution })
    }

    pub(super) fn count(&self) -> u64 {
        self.count
    }

    /// The k-th draw.
    pub(super) fn value(&self, k: u64) -> Rational {
        let mut random = Pcg64::new(self.seed.into(), self.stream);
        random.advance(2 * u128::from(k));
        let [u, v] = [(); 2].map(|()| uniform(&mut random));
        let exact = match &self.distribution {
            Distribution::Uniform(from, to) => from + &(&(to - from) * &u),
            Distribution::Logarithmic(from, to) => {
                value(&format!("exp(log({}) + log({}) * ({u}))", to_text(from), to_text(&(to / from))))
            }
            // Box and Muller
            Distribution::Normal(mean, deviation) => {
                let normal = value(&format!("sqrt(-2*log({u})) * cos(2*pi*({v}))"));
                mean + &(deviation * &normal)
            }
        };
        round_significant(&exact, DIGITS)
    }
}

/// An odd multiple of 2⁻⁵⁴ between 0 and 1.
fn uniform(random: &mut Pcg64) -> Rational {
    let odd = ((random.next_u64() >> 11) << 1) | 1;
    Rational::new(odd.into(), (1_u64 << 54).into())
}

/// To more digits than a draw has; in exact arithmetic, so that every machine has the same.
fn value(formula: &str) -> Rational {
    let expression = parse(formula).expect("the formula is well formed");
    evaluate(&expression, &BTreeMap::new(), DIGITS + 10).expect("its arguments are in the domain").value
}

/// Two numbers and their place.
fn pair(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<(Rational, Rational, std::ops::Range<usize>)> {
    let texts = reader.list(value, "a list of two numbers: [0, 1]", |reader, value| reader.number(value, NUMBERS))?;
    let numbers: Vec<Option<Rational>> = texts.value.iter().map(|text: &Text| number(reader, text)).collect();
    match <[Option<Rational>; 2]>::try_from(numbers) {
        Ok([a, b]) => Some((a?, b?, texts.at)),
        Err(numbers) => {
            let fault = reader.source.fault(&texts.at, "this list needs two numbers");
            reader.faults.push(fault.values(numbers.len().to_string(), "2"));
            None
        }
    }
}
