//! The values as they are written: rounded once, and one of each list the remainder of 1, so that sums are exact.

use num_traits::{One, Zero};
use shadowstep_schemes::symbolic::Rational;
use shadowstep_schemes::symbolic::decimal::{round_significant, to_significant};

use crate::polish::newton::Solution;
use crate::polish::unknowns::Model;
use crate::polish::write::{self, Written};
use shadowstep_schemes::exact::DIGITS;

/// Digits written beyond the requested ones, so that the conditions, sums of many products, hold to the requested ones.
const WRITTEN_BEYOND: u32 = 10;

/// The most bits of the denominator of what fractions and formulas add to a sum: longer ones are closed forms, which
/// are no exact part of a formula.
const LONGEST_REST: u64 = 64;

/// The values as they are written, rounded once, and how.
pub(super) fn rounded(
    model: &Model,
    names: &[String],
    solution: &Solution,
    digits: u32,
) -> (Vec<Rational>, Vec<Written>) {
    let mut x = solution.x.clone();
    let mut written = vec![Written::AsPrinted; x.len()];
    for &unknown in &solution.moving {
        let digits = digits + WRITTEN_BEYOND;
        x[unknown] = round_significant(&x[unknown], digits);
        written[unknown] = Written::Decimal(to_significant(&x[unknown], digits as usize));
    }
    for list in 0..model.lists_of_weights() {
        if let Some((unknown, value, formula)) = remainder(model, names, &x, list, &solution.moving) {
            x[unknown] = value;
            written[unknown] = Written::Formula(formula);
        }
    }
    (x, written)
}

/// A decimal that can be what the others of a list leave of 1: it, its value and its formula.
fn remainder(
    model: &Model,
    names: &[String],
    x: &[Rational],
    list: usize,
    moving: &[usize],
) -> Option<(usize, Rational, String)> {
    let sums = |x: &[Rational]| -> Option<Vec<Rational>> {
        let lists = model.weights(x, 2 * DIGITS).ok()?;
        Some(lists.iter().map(|list| list.iter().sum()).collect())
    };
    let at_x = sums(x)?;
    if at_x[list].is_one() {
        return None;
    }
    let slopes = |unknown: usize| {
        let mut moved = x.to_vec();
        moved[unknown] += Rational::one();
        Some(sums(&moved)?.iter().zip(&at_x).map(|(moved, fixed)| moved - fixed).collect::<Vec<_>>())
    };
    let slopes: Vec<_> = (0..x.len()).map(slopes).collect::<Option<_>>()?;
    let alone = |u: &usize| slopes[*u].iter().enumerate().all(|(l, slope)| slope.is_zero() == (l != list));
    let (unknown, others) = moving.iter().rev().copied().filter(alone).find_map(|unknown| {
        let others: Vec<_> = (0..x.len()).filter(|&u| u != unknown && !slopes[u][list].is_zero()).collect();
        // a formula uses what stands above it; new constants are written below all others
        let below = |u: usize| {
            let (this, other) = (&model.unknowns[unknown], &model.unknowns[u]);
            this.is_constant && !(other.is_constant && other.at.start < this.at.start)
        };
        (!others.iter().any(|&u| below(u))).then_some((unknown, others))
    })?;
    let linear: Rational = others.iter().map(|&u| &slopes[u][list] * &x[u]).sum();
    let divisor = &slopes[unknown][list];
    let rest = &at_x[list] - &linear - divisor * &x[unknown];
    if rest.denom().bits() > LONGEST_REST {
        return None;
    }
    let value = (Rational::one() - &rest - linear) / divisor;
    let mut exact = x.to_vec();
    exact[unknown] = value.clone();
    // except where a sum is not a linear function of the decimals
    sums(&exact).filter(|sums| sums[list].is_one())?;
    let terms: Vec<_> = others.iter().map(|&u| (slopes[u][list].clone(), names[u].as_str())).collect();
    Some((unknown, value, write::remainder(divisor, &rest, &terms)))
}
