//! Newton's iteration on the printed decimals, and the choice of those that stay as printed.
//!
//! Where there are more decimals than conditions, some stay as printed: those that a pivoted QR decomposition of the
//! derivatives does not need, decimals with few digits (chosen, not computed) before the others. Where there
//! are more conditions than decimals, as for Nyström trees and for weights with more structure than their conditions
//! use, the steps solve least-squares problems (Gauss–Newton), and all conditions must be met at the end.

use shadowstep_schemes::MapKind;
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::order::{Condition, Functional};
use shadowstep_schemes::symbolic::Rational;

use crate::closed_gaps::beside_diagonal;
use crate::polish::dual::{Dual, Duals};
use crate::polish::equations::{Equations, Row, maps};
use crate::polish::least_squares::{Factors, length, log10};
use crate::polish::unknowns::Model;

/// Digits beyond those needed, for rounding in the conditions and in the linear algebra.
const GUARD_DIGITS: u32 = 60;

/// Newton's iteration doubles the digits each time: it needs about ten steps from one digit to 300.
const MOST_STEPS: u32 = 60;

/// Derivatives below this multiple of the residual (a power of ten) do not count for the rank.
const RANK_MARGIN: f64 = 4.0;

/// Slopes that are shorter than the longest ones by this number of bits vanish at the solution.
const VANISHING: u64 = 40;

/// A moved weight: farther away than this it is another scheme's (as a power of ten).
const FARTHEST: f64 = -0.7;

/// Values that meet the conditions.
pub(super) struct Solution {
    /// The values of all unknowns.
    pub(super) x: Vec<Rational>,
    /// The unknowns that were solved for.
    pub(super) moving: Vec<usize>,
    /// The condition number of the derivatives at the solution.
    pub(super) condition_number: f64,
}

/// An iteration that did not end.
#[derive(Clone, Debug)]
pub(super) struct Failure {
    /// log10 of the least residual.
    pub(super) residual: f64,
    /// The condition number of the derivatives where the iteration ended.
    pub(super) condition_number: f64,
    /// How many unknowns were solved for.
    pub(super) moving: usize,
    /// What happened.
    pub(super) what: What,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum What {
    /// The residual does not become smaller.
    Stuck,
    /// It does, but not as Newton's iteration should: the derivatives are singular where it ends.
    Slow,
    /// The values leave their neighbourhood.
    Leaves,
    /// A formula has no value, or the derivatives are singular.
    Singular,
}

/// Conditions as functions of the unknowns.
pub(super) struct Problem<'a> {
    pub(super) model: &'a Model,
    pub(super) equations: &'a Equations,
    /// Where about closed intervals of instability are: their hω are unknowns after those of the model.
    pub(super) closed_gaps: &'a [f64],
}

/// The conditions and their derivatives at a point, rows scaled to derivatives of length 1.
struct Linear {
    bits: u32,
    off: Vec<num_bigint::BigInt>,
    columns: Vec<Vec<num_bigint::BigInt>>,
    residual: f64,
}

impl Problem<'_> {
    /// Where the iteration begins.
    pub(super) fn printed(&self) -> Vec<Rational> {
        let gaps = self.closed_gaps.iter().map(|gap| Rational::from_float(*gap).expect("a finite number"));
        self.model.printed().into_iter().chain(gaps).collect()
    }

    /// Solves for the unknowns that need it, with the unknowns in `held` as printed.
    pub(super) fn solve(&self, held: &[usize], digits: u32) -> Result<Solution, Failure> {
        let printed = self.printed();
        let most_digits = self.model.unknowns.iter().map(|u| u.decimal.significant).max().unwrap_or(1);
        let first_digits = 2 * most_digits + GUARD_DIGITS;
        let failure = |what| Failure { residual: f64::INFINITY, condition_number: f64::NAN, moving: 0, what };
        let linear = self.linear(&printed, first_digits).ok_or(failure(What::Singular))?;
        let free: Vec<usize> = (0..printed.len()).filter(|unknown| !held.contains(unknown)).collect();
        let factors = linear.factors(&free);
        let size = |d: &&f64| d.log10() > linear.residual + RANK_MARGIN;
        // without any there is nothing to solve, where formulas meet the conditions
        let surely = factors.diagonal.iter().filter(size).count().max(factors.order.len().min(1));
        // the fewest that may suffice are tried first: with more of them than the solution's derivatives determine,
        // the iteration would wander along a family of solutions
        let mut failed = failure(What::Singular);
        for rank in surely..=factors.order.len() {
            let moving = self.choose(&linear, &free, &factors, rank);
            match self.iterate(&printed, moving, first_digits, digits) {
                Ok(solution) => return Ok(solution),
                Err(failure) => failed = failure,
            }
        }
        Err(failed)
    }

    /// How far the conditions are from what is needed, as log10 of the largest distance.
    pub(super) fn residual(&self, x: &[Rational], digits: u32) -> f64 {
        self.linear(x, digits + GUARD_DIGITS).map_or(f64::INFINITY, |linear| linear.residual)
    }

    /// The rows of all conditions, and the number of bits they have.
    pub(super) fn rows(&self, x: &[Rational], digits: u32) -> Option<(Vec<Row>, u32)> {
        let arithmetic = Duals::digits(digits);
        let weights = self.model.duals(x, arithmetic).ok()?;
        let mut rows = self.equations.rows(self.model, &weights, x.len(), arithmetic);
        if !self.closed_gaps.is_empty() {
            rows.extend(self.rows_of_gaps(&maps(self.model, &weights, &arithmetic), x, arithmetic));
        }
        Some((rows, arithmetic.bits))
    }

    /// What must be 0 where intervals of instability are closed.
    fn rows_of_gaps(&self, maps: &[(MapKind, Dual)], x: &[Rational], arithmetic: Duals) -> Vec<Row> {
        let of_gap = |unknown: usize| {
            let name =
                format!("the trace near hω = {:.3}", self.closed_gaps[unknown + self.closed_gaps.len() - x.len()]);
            let condition =
                Condition { order: 1, functional: Functional::Named(name), needed: Rational::from_integer(0.into()) };
            let mut gap = arithmetic.weight(&x[unknown]);
            gap.slopes = vec![0.into(); x.len()];
            gap.slopes[unknown] = arithmetic.one().value;
            let row = move |dual: Dual| Row { condition: condition.clone(), off: dual.value, slopes: dual.slopes };
            beside_diagonal(maps, &gap, &arithmetic).map(row)
        };
        (x.len() - self.closed_gaps.len()..x.len()).flat_map(of_gap).collect()
    }

    fn linear(&self, x: &[Rational], digits: u32) -> Option<Linear> {
        let (rows, bits) = self.rows(x, digits)?;
        let residual = rows.iter().map(|row| log10(&row.off, bits)).fold(f64::NEG_INFINITY, f64::max);
        let mut linear = Linear { bits, off: Vec::new(), columns: vec![Vec::new(); x.len()], residual };
        let lengths: Vec<_> = rows.iter().map(|row| length(&row.slopes)).collect();
        let longest = lengths.iter().map(|length| length.bits()).max().unwrap_or(0);
        // slopes that are shorter vanish, but for rounding
        let shortest = (u64::from(bits) / 2).max(longest.saturating_sub(VANISHING));
        for (row, length) in rows.into_iter().zip(lengths) {
            // a condition that does not depend on the decimals is not scaled, nor one that the others imply so that its
            // slopes vanish with theirs
            let scaled = |x| if length.bits() > shortest { (x << bits) / &length } else { x };
            linear.off.push(scaled(row.off));
            linear.columns.iter_mut().zip(row.slopes).for_each(|(column, slope)| column.push(scaled(slope)));
        }
        Some(linear)
    }

    /// The `rank` unknowns to solve for.
    fn choose(&self, linear: &Linear, free: &[usize], factors: &Factors, rank: usize) -> Vec<usize> {
        let digits = |unknown: usize| self.model.unknowns.get(unknown).map_or(u32::MAX / 2, |u| u.decimal.significant);
        let most = free.iter().map(|&u| digits(u)).max().unwrap_or(1);
        let mut few_digits: Vec<usize> = free.iter().copied().filter(|&u| 2 * digits(u) <= most).collect();
        few_digits.sort_by_key(|&u| digits(u));
        let (mut free, mut order) = (free.to_vec(), factors.order.clone());
        for unknown in few_digits {
            if free.len() == rank {
                break;
            }
            let without: Vec<usize> = free.iter().copied().filter(|&u| u != unknown).collect();
            let tried = linear.factors(&without);
            // a hundredth of the best choice is still well determined
            if tried.order.len() >= rank && tried.diagonal[rank - 1] >= 0.01 * factors.diagonal[rank - 1] {
                (free, order) = (without, tried.order);
            }
        }
        let mut moving: Vec<usize> = order[..rank].iter().map(|&place| free[place]).collect();
        moving.sort_unstable();
        moving
    }

    fn iterate(
        &self,
        printed: &[Rational],
        moving: Vec<usize>,
        first_digits: u32,
        digits: u32,
    ) -> Result<Solution, Failure> {
        let full = digits + GUARD_DIGITS;
        let (mut x, mut precision) = (printed.to_vec(), first_digits.min(full));
        let (mut least, mut condition_number, mut stuck) = (f64::INFINITY, f64::NAN, 0);
        for _ in 0..MOST_STEPS {
            let failure = |residual, what| Failure { residual, condition_number, moving: moving.len(), what };
            let linear = self.linear(&x, precision).ok_or(failure(least, What::Singular))?;
            let factors = linear.factors(&moving);
            if factors.order.len() < moving.len() {
                return Err(failure(least.min(linear.residual), What::Singular));
            }
            condition_number = factors.condition_number();
            let failure = |residual, what| Failure { residual, condition_number, moving: moving.len(), what };
            // the residual must fall to half; at the first step it may rise
            stuck = if linear.residual > least - 0.3 { stuck + 1 } else { 0 };
            least = least.min(linear.residual);
            let done = linear.residual < -f64::from(digits + GUARD_DIGITS / 3);
            if done && precision == full {
                return Ok(Solution { x, moving, condition_number });
            }
            if stuck > 2 && !done {
                return Err(failure(least, What::Stuck));
            }
            let size = linear.step(&factors, &moving, &mut x);
            let away = x.iter().zip(printed).any(|(x, printed)| log10_of(&(x - printed)) > FARTHEST);
            if away {
                return Err(failure(least, What::Leaves));
            }
            // the next step is about as large as the square of this one, and is needed to as many digits again
            precision = if size.is_finite() { (precision as f64).max(-4.0 * size) as u32 + GUARD_DIGITS } else { full };
            precision = precision.min(full);
        }
        Err(Failure { residual: least, condition_number, moving: moving.len(), what: What::Slow })
    }
}

impl Linear {
    fn factors(&self, moving: &[usize]) -> Factors {
        Factors::of(moving.iter().map(|&unknown| self.columns[unknown].clone()).collect(), self.bits)
    }

    /// x −= the step; returns log10 of its largest entry.
    fn step(&self, factors: &Factors, moving: &[usize], x: &mut [Rational]) -> f64 {
        let arithmetic = Duals { bits: self.bits };
        let mut largest = f64::NEG_INFINITY;
        for (place, step) in factors.order.iter().zip(factors.solve(&self.off)) {
            largest = largest.max(log10(&step, self.bits));
            x[moving[*place]] -= arithmetic.rational(step);
        }
        largest
    }
}

/// log10 |x|; −∞ for 0.
pub(super) fn log10_of(x: &Rational) -> f64 {
    log10(x.numer(), 0) - log10(x.denom(), 0)
}
