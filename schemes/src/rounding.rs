//! Whether the rounding of printed decimals explains how far the order conditions are from what is needed.
//!
//! If the decimals are a scheme's weights, rounded, then their errors δ_j are at most a unit u_j of the last place:
//! half a unit where they were rounded, a whole one where they were cut off. To first order J δ = needed − found, where
//! J has the derivatives of the conditions. So among all solutions δ the least max |δ_j|/u_j must not exceed 1. For
//! every λ it is at least λᵀ(needed − found) / Σ_j |(Jᵀλ)_j| u_j: a single λ with a value above 1 proves that rounding
//! does not explain the table. Unit vectors λ would judge each condition by itself.
//!
//! A decimal is to blame if the others need to move by no more than a unit where it may have any value. Several
//! decimals may do: then the conditions do not show which of them is wrong.

use crate::arithmetic::Arithmetic;
use crate::conditions::{Family, evaluated, values_at};
use crate::least_change::LeastChange;
use crate::printed::{Decimal, Printed, Sloped};
use crate::scheme::ExactScheme;
use crate::symbolic::{Fraction, Ratio, Rational};

/// The largest error of a decimal, in units of its last place, that counts as rounding: tables are cut off, too.
const ROUNDING: f64 = 1.0;

/// Conditions that are farther from what is needed are not linear functions of what has to move.
const NEAR: f64 = 1e-3;

/// What has to move for the conditions of a table to hold, beyond rounding.
#[derive(Clone, Debug)]
pub(crate) enum Unexplained {
    /// One of these decimals, each of which suffices; one at least.
    OneOf(Vec<Off>),
    /// Several: of the nearest weights that meet the conditions, the one that is off by most.
    Several(Off),
}

/// A decimal and by how many units of its last printed place it has to move.
#[derive(Clone, Debug)]
pub(crate) struct Off {
    pub(crate) decimal: Decimal,
    pub(crate) units: f64,
}

/// The conditions that a table claims as linear functions of the errors of its printed decimals.
pub(crate) struct Linearised {
    decimals: Vec<Decimal>,
    families: Vec<(Family, u32)>,
    /// Places behind the point to which distances are scaled.
    places: i64,
    /// The derivatives in units of the decimals' last places: a row for each condition.
    rows: Vec<Vec<f64>>,
}

impl Linearised {
    /// The derivatives of a scheme whose table prints decimals; `None` where it prints none, or too many.
    pub(crate) fn of(scheme: &ExactScheme) -> Option<Linearised> {
        scheme.claimed_digits()?;
        let Printed { decimals, maps } = Printed::of(scheme)?;
        let table = &scheme.table;
        let powers = table.near_integrable.iter().flat_map(|claim| claim.powers());
        let powers = powers.map(|(order, power)| (Family::Power(power), order.value));
        let families: Vec<_> =
            std::iter::once((Family::Kinetic(table.kinetic), table.order.value)).chain(powers).collect();
        let places = decimals.iter().map(|decimal| decimal.rounded).max()?;
        let units: Vec<_> = decimals.iter().map(|decimal| 10_f64.powi((places - decimal.rounded) as i32)).collect();
        let arithmetic = Gradients { decimals: decimals.len() };
        let row = |value: Sloped| value.slopes.iter().zip(&units).map(|(slope, unit)| slope * unit).collect();
        let values = families.iter().flat_map(|(family, order)| values_at(&maps, *family, *order, &arithmetic));
        let rows = values.map(|(_, value)| row(value)).collect();
        Some(Linearised { decimals, families, places, rows })
    }

    /// What has to move so that the conditions of the scheme hold; `None` if rounding explains them.
    pub(crate) fn unexplained(&self, scheme: &ExactScheme) -> Option<Unexplained> {
        let (farthest, change) = self.least_change(scheme);
        if farthest > NEAR * 10_f64.powi(self.places as i32) || !change.exceeds(ROUNDING) {
            return None;
        }
        let off = |(place, units): (usize, f64)| {
            let decimal = self.decimals[place].clone();
            let units = units * 10_f64.powi((decimal.places - decimal.rounded) as i32);
            Off { decimal, units }
        };
        match change.sufficient(ROUNDING) {
            none if none.is_empty() => change.farthest().map(|farthest| Unexplained::Several(off(farthest))),
            sufficient => Some(Unexplained::OneOf(sufficient.into_iter().map(off).collect())),
        }
    }

    /// How far the farthest condition is from what is needed, and the least change that mends all.
    fn least_change(&self, scheme: &ExactScheme) -> (f64, LeastChange) {
        let maps = scheme.maps();
        let values = self.families.iter().flat_map(|(family, order)| evaluated(&maps, scheme.held, *family, *order));
        let needed: Vec<_> = values.map(|value| -scaled(&value.distance(), self.places)).collect();
        let farthest = needed.iter().fold(0.0_f64, |farthest, needed| farthest.max(needed.abs()));
        (farthest, LeastChange::of(&self.rows, &needed))
    }
}

/// A distance in units of the last of some decimal places.
fn scaled(distance: &Fraction, places: i64) -> f64 {
    let power = num_bigint::BigInt::from(10).pow(places.unsigned_abs() as u32);
    let (numer, denom) = (distance.numer(), distance.denom());
    let scaled = if places < 0 { (numer.clone(), denom * power) } else { (numer * power, denom.clone()) };
    Fraction::new(scaled.0, scaled.1).to_f64()
}

/// Values in f64 with their derivatives.
struct Gradients {
    decimals: usize,
}

impl Arithmetic for Gradients {
    type Value = Sloped;
    fn zero(&self) -> Sloped {
        Sloped { value: 0.0, slopes: vec![0.0; self.decimals] }
    }
    fn one(&self) -> Sloped {
        Sloped { value: 1.0, ..self.zero() }
    }
    fn weight(&self, weight: &Rational) -> Sloped {
        Sloped { value: num_traits::ToPrimitive::to_f64(weight).unwrap_or(f64::NAN), ..self.zero() }
    }
    fn add_product(&self, target: &mut Sloped, a: &Sloped, b: &Sloped) {
        target.value += a.value * b.value;
        for ((target, a_slope), b_slope) in target.slopes.iter_mut().zip(&a.slopes).zip(&b.slopes) {
            *target += a_slope * b.value + a.value * b_slope;
        }
    }
    fn divide(&self, a: &Sloped, n: u32) -> Sloped {
        let n = f64::from(n);
        Sloped { value: a.value / n, slopes: a.slopes.iter().map(|slope| slope / n).collect() }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::document::Source;
    use crate::{exact, shipped};

    /// A published table that claims as many digits as its shortest decimal has, those apart that were chosen.
    fn claiming(text: &str) -> (String, u32) {
        let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
        let decimals: Vec<_> = words.filter(|word| word.len() > 4 && word.contains('.')).collect();
        let significant = |word: &str| word.replace('.', "").trim_start_matches('0').len() as u32;
        let most = decimals.iter().map(|word| significant(word)).max().unwrap();
        let rounded = decimals.iter().filter(|word| 2 * significant(word) > most);
        let places = |word: &str| word.split('.').nth(1).map_or(0, str::len) as u32;
        let digits = rounded.map(|word| significant(word).max(places(word))).min().unwrap();
        let at = text.find("kinetic").unwrap();
        (format!("{}digits = {digits}\n{}", &text[..at], &text[at..]), digits)
    }

    /// The changes, in units of the claimed digits, that come of exchanging neighbouring digits from the 8th decimal
    /// on.
    fn exchanges(decimal: &Decimal, digits: u32) -> Vec<f64> {
        let (point, bytes) = (decimal.text.find('.').unwrap(), decimal.text.as_bytes());
        let change = |i: usize| {
            let digits = f64::from(bytes[i + 1]) - f64::from(bytes[i]);
            9.0 * digits * 10_f64.powi(point as i32 - i as i32 - 1)
        };
        let changes = (point + 8..bytes.len() - 1).map(change);
        let large = changes.filter(|change| change.abs() >= 1.5 * 10_f64.powi(1 - digits as i32));
        large.map(|change| change * 10_f64.powi(decimal.rounded as i32)).collect()
    }

    /// The full set, to first order; `tests/tests/transposed_digits.rs` reads such tables.
    #[test]
    fn rounding_explains_no_exchange_of_digits_in_a_published_table() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/analysis/tests/published");
        let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let mut count = 0;
        for path in files.filter(|path| path.extension().is_some_and(|extension| extension == "toml")) {
            let (text, digits) = claiming(&fs::read_to_string(&path).unwrap());
            let source = Source { path: path.display().to_string(), text };
            let scheme = exact::scheme(&source, &|base, _| shipped(base)).0.unwrap();
            let linearised = Linearised::of(&scheme).unwrap();
            let honest = linearised.least_change(&scheme).1;
            for (place, decimal) in linearised.decimals.iter().enumerate() {
                for by in exchanges(decimal, digits) {
                    let exchanged = honest.after(place, by);
                    count += 1;
                    assert!(exchanged.exceeds(ROUNDING), "{}: {} by {by} units", source.path, decimal.name);
                }
            }
        }
        assert_eq!(count, 6040);
    }
}
