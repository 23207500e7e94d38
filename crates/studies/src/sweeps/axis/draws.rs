//! Random numbers: each draw is made from the seed, the name of the axis and its number alone, with the same bits
//! everywhere.

use num_traits::Signed;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;
use sha2::{Digest, Sha256};
use shadowstep::Rational;
use shadowstep_scenes::schema::Table;
use shadowstep_schemes::document::{Placed, Reader, Text};
use shadowstep_schemes::symbolic::decimal::round_significant;

use super::number::{formula, geometric, number};

/// Draws are rounded to this many digits, and are exact from there on.
const DIGITS: u32 = 17;

/// Formulas are computed to more digits, in exact arithmetic, so that every machine has the same.
const WORKING_DIGITS: u32 = DIGITS + 10;

/// Independent random numbers.
#[derive(Clone, Debug)]
pub(super) struct Draws {
    seed: u64,
    /// From the name of the axis: axes with the same seed are independent.
    stream: u128,
    distribution: Distribution,
    /// The numbers of the distribution.
    a: Rational,
    b: Rational,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Distribution {
    /// Between two numbers.
    Uniform,
    /// Whose logarithm is uniform.
    Logarithmic,
    /// With this mean and standard deviation.
    Normal,
}

impl Draws {
    pub(super) fn read(reader: &mut Reader<'_>, name: &str, draws: &Table<'_, '_>) -> Option<Draws> {
        let seed = draws.whole("seed")?;
        let kind = ["uniform", "log", "normal"].into_iter().find(|key| draws.get(key).is_some())?;
        let (a, b, at) = pair(reader, &draws.list(kind)?)?;
        let (distribution, is_right, needed, example) = match kind {
            "uniform" => {
                let needed = "the first number must be less than the second";
                (Distribution::Uniform, a < b, needed, "uniform = [0, 1]")
            }
            "log" => {
                let needed = "the numbers must be positive, the first one less than the second";
                (Distribution::Logarithmic, a.is_positive() && a < b, needed, "log = [\"1e-6\", \"1e-3\"]")
            }
            _ => {
                let needed = "the standard deviation must be positive";
                (Distribution::Normal, b.is_positive(), needed, "normal = [0, \"1/10\"]")
            }
        };
        let is_too_wide = || {
            let edges = [Rational::new(1.into(), (1_u64 << 54).into()), Rational::new(1.into(), 2.into())];
            edges.iter().any(|u| geometric(&a, &b, u, WORKING_DIGITS).is_none())
        };
        if !is_right || (distribution == Distribution::Logarithmic && is_too_wide()) {
            let too_wide = "these numbers are too large or too small for logarithms";
            return reader.wrong(&at, if is_right { too_wide } else { needed }, format!("write {example}"));
        }
        let hash = Sha256::digest(name.as_bytes());
        let stream = hash.iter().take(16).fold(0, |stream, byte| (stream << 8) | u128::from(*byte));
        Some(Draws { seed, stream, distribution, a, b })
    }

    /// The k-th draw.
    pub(super) fn value(&self, k: u64) -> Rational {
        let mut random = Pcg64::new(self.seed.into(), self.stream);
        random.advance(2 * u128::from(k));
        let [u, v] = [(); 2].map(|()| uniform(&mut random));
        let Draws { a, b, .. } = self;
        let exact = match self.distribution {
            Distribution::Uniform => a + &(&(b - a) * &u),
            Distribution::Logarithmic => geometric(a, b, &u, WORKING_DIGITS).expect("the ends were checked"),
            // Box and Muller
            Distribution::Normal => {
                let normal = formula("sqrt(-2*log(u)) * cos(2*pi*v)", &[("u", &u), ("v", &v)], WORKING_DIGITS);
                a + &(b * &normal.expect("0 < u < 1"))
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

/// Two numbers and their place.
fn pair(reader: &mut Reader<'_>, texts: &Placed<Vec<Text>>) -> Option<(Rational, Rational, std::ops::Range<usize>)> {
    let numbers: Vec<Option<Rational>> = texts.value.iter().map(|text: &Text| number(reader, text)).collect();
    match <[Option<Rational>; 2]>::try_from(numbers) {
        Ok([a, b]) => Some((a?, b?, texts.at.clone())),
        Err(numbers) => {
            let fault = reader.source.fault(&texts.at, "this list needs two numbers");
            reader.faults.push(fault.values(numbers.len().to_string(), "2"));
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep_schemes::document::{Source, document};

    fn draws(name: &str, text: &str) -> Draws {
        let source = Source { path: "test.toml".to_owned(), text: format!("a = {text}") };
        let (document, _) = document(&source);
        let document = document.unwrap();
        let value = document.get("a").unwrap();
        let mut reader = Reader::new(&source, Vec::new());
        let table = Table::of_value(&source, value, &crate::sweeps::keys::DRAWS).unwrap();
        Draws::read(&mut reader, name, &table).unwrap_or_else(|| panic!("{:?}", reader.faults))
    }

    fn doubles(draws: &Draws, count: u64) -> Vec<f64> {
        (0..count).map(|k| shadowstep::Number::from_rational(&draws.value(k), &())).collect()
    }

    /// The wanted values are those of a program in Python with its own PCG64 and decimal arithmetic of 60 digits.
    #[test]
    fn draws_are_the_same_everywhere() {
        for (text, wanted) in [
            ("uniform = [-1, 3]", ["1.5017557569066267", "1.8347565662320722", "1.2001317644866216"]),
            ("log = [1e-6, 1e-3]", ["7.5217140271330364e-5", "1.3368030405117185e-4", "4.4678524621335379e-5"]),
            ("normal = [1, 0.1]", ["1.0583900279972772", "1.0075682787341739", "1.0901456032773212"]),
        ] {
            // draw k does not depend on how many there are
            for count in [3, 1_000_000_000_000_u64] {
                let draws = draws("a", &format!("{{ draws = {count}, seed = 7, {text} }}"));
                for (k, wanted) in wanted.into_iter().enumerate() {
                    assert_eq!(draws.value(k as u64), shadowstep::exact(wanted).unwrap(), "{text}, draw {k}");
                }
            }
        }
        let draws = draws("a", "{ draws = 1000000000000, seed = 7, uniform = [-1, 3] }");
        assert_eq!(draws.value(999_999_999_999), shadowstep::exact("2.2671393288781101").unwrap());
    }

    #[test]
    fn other_seeds_and_axes_have_other_draws() {
        let first = |name, seed| draws(name, &format!("{{ draws = 1, seed = {seed}, uniform = [0, 1] }}")).value(0);
        assert_eq!(first("a", 8), shadowstep::exact("0.83490753621396713").unwrap());
        assert_eq!(first("b", 7), shadowstep::exact("0.60776989488985872").unwrap());
    }

    /// Of n independent numbers with variance v, the mean has the standard deviation √(v/n), and the variance that they
    /// show √((m₄ − v²)/n), with the fourth central moment m₄: 1/80 and v = 1/12 if uniform on [0, 1], 3 and v = 1 if
    /// normal. Five of these are exceeded with a probability below 10⁻⁶; for this seed it is certain whether they are.
    #[test]
    fn mean_and_variance_are_those_of_the_distribution() {
        const N: f64 = 4000.0;
        for (text, mean, variance, fourth) in
            [("uniform = [0, 1]", 0.5, 1.0 / 12.0, 1.0 / 80.0), ("normal = [0, 1]", 0.0, 1.0, 3.0)]
        {
            let draws = doubles(&draws("a", &format!("{{ draws = {N}, seed = 1, {text} }}")), N as u64);
            let found = draws.iter().sum::<f64>() / N;
            assert!((found - mean).abs() < 5.0 * f64::sqrt(variance / N), "{text}: mean {found}");
            let found = draws.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / N;
            let deviation = f64::sqrt((fourth - variance * variance) / N);
            assert!((found - variance).abs() < 5.0 * deviation, "{text}: variance {found}");
        }
    }

    /// The logarithm is uniform; and all values are between the bounds.
    #[test]
    fn logarithms_are_uniform() {
        let draws = doubles(&draws("a", "{ draws = 1000, seed = 1, log = [1e-6, 1e-2] }"), 1000);
        assert!(draws.iter().all(|x| (1e-6..1e-2).contains(x)));
        let mean = draws.iter().map(|x| x.log10()).sum::<f64>() / 1000.0;
        assert!((mean + 4.0).abs() < 5.0 * 4.0 / f64::sqrt(12.0 * 1000.0), "{mean}");
    }

    /// The correlation of n independent pairs has the standard deviation 1/√n.
    #[test]
    fn axes_and_neighbours_are_independent() {
        const N: usize = 4000;
        let of = |name, seed| {
            doubles(&draws(name, &format!("{{ draws = {N}, seed = {seed}, uniform = [0, 1] }}")), N as u64)
        };
        let (a, b, other) = (of("a", 1), of("b", 1), of("a", 2));
        let shifted = [&a[1..], &a[..1]].concat();
        for (name, second) in [("axes", b), ("seeds", other), ("neighbours", shifted)] {
            let correlation = a.iter().zip(&second).map(|(x, y)| 12.0 * (x - 0.5) * (y - 0.5)).sum::<f64>() / N as f64;
            assert!(correlation.abs() < 5.0 / f64::sqrt(N as f64), "{name}: {correlation}");
        }
    }
}
