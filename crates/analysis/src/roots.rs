//! The roots of odd multiplicity of an integer polynomial on an interval: where it changes its sign. None is missed.
//!
//! Squares are divided out first, exactly. What is left has simple roots only, which Descartes' rule of signs for
//! Bernstein coefficients isolates by bisection (Vincent, Collins & Akritas; Rouillier & Zimmermann, J. Comput. Appl.
//! Math. 162 (2004) 33). The coefficients are in fixed point with a bound of their error, and only signs that the bound
//! leaves no doubt of are used; where there is doubt, all is done again with more bits.

use num_bigint::{BigInt, Sign};
use num_integer::{Integer, IterBinomial};
use num_traits::{One, Zero};

use crate::squarefree::odd_part;

/// A polynomial without multiple roots, c_0 + c_1 (x/N) + c_2 (x/N)² + …, with the signs of the one it was made of.
pub(crate) struct SignChanges {
    integers: Vec<BigInt>,
    denominator: BigInt,
}

/// The polynomial on [0, range], in u = x/range with coefficients in units of 2^−bits, each off by less than two units.
pub(crate) struct Scaled {
    coefficients: Vec<BigInt>,
    bits: u64,
}

/// A root lies strictly between u = place·2^−depth and (place + 1)·2^−depth, no other one does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Isolated {
    pub(crate) place: BigInt,
    pub(crate) depth: u64,
}

/// A sign could not be decided: more bits are needed, or other places to bisect at.
#[derive(Debug)]
pub(crate) struct InDoubt;

impl SignChanges {
    pub(crate) fn of(integers: &[BigInt], denominator: &BigInt) -> SignChanges {
        SignChanges { integers: odd_part(integers.to_vec()), denominator: denominator.clone() }
    }

    /// The polynomial on the x from 0 to `range`.
    pub(crate) fn scaled(&self, range: u64, bits: u64) -> Scaled {
        let (mut power, mut divisor) = (BigInt::one() << bits, BigInt::one());
        let mut coefficients = Vec::new();
        for integer in &self.integers {
            coefficients.push((integer * &power).div_floor(&divisor));
            power *= range;
            divisor *= &self.denominator;
        }
        Scaled { coefficients, bits }
    }
}

impl Scaled {
    /// A polynomial without multiple roots from its coefficients, each off by less than two units.
    pub(crate) fn new(coefficients: Vec<BigInt>, bits: u64) -> Scaled {
        Scaled { coefficients, bits }
    }

    /// All roots in 0 < u < 1, in their order.
    pub(crate) fn roots(&self) -> Result<Vec<Isolated>, InDoubt> {
        let whole = Piece { bernstein: self.bernstein(), error: self.rounding(), place: BigInt::zero(), depth: 0 };
        let (mut left_over, mut roots) = (vec![whole], Vec::new());
        while let Some(piece) = left_over.pop() {
            match piece.sign_changes() {
                Some(0) => {}
                Some(1) => roots.push(Isolated { place: piece.place, depth: piece.depth }),
                // a piece so short that the signs have no bits left
                _ if piece.depth >= self.bits / 2 => return Err(InDoubt),
                _ => {
                    let (left, right) = piece.halves();
                    left_over.extend([right, left]);
                }
            }
        }
        Ok(roots)
    }

    /// Narrows the piece of a root to the width 2^−depth: the secant says in which of 2^k parts of the piece the root
    /// should be. If it is there, k doubles, and so do the digits at each step; if not, the piece is halved (J. Abbott,
    /// *Quadratic interval refinement for real roots*, ACM Commun. Comput. Algebra 48 (2014) 3).
    pub(crate) fn refine(&self, root: &mut Isolated, depth: u64) -> Result<(), InDoubt> {
        let mut left = self.value(&root.place, root.depth)?;
        let mut right = self.value(&(&root.place + 1), root.depth)?;
        let mut parts = 1;
        while root.depth < depth {
            let more = parts.min(depth - root.depth);
            let (place, at) = (&root.place << more, root.depth + more);
            let part = ((&left << more) / (&left - &right)).clamp(BigInt::zero(), (BigInt::one() << more) - 1);
            let middle = place + if more == 1 { BigInt::one() } else { part };
            let value = self.value(&middle, at)?;
            if more == 1 {
                let is_right = value.sign() == left.sign();
                (left, right) = if is_right { (value, right) } else { (left, value) };
                (root.place, root.depth) = (if is_right { middle } else { middle - 1 }, at);
                parts = 2;
                continue;
            }
            let next = self.value(&(&middle + 1), at)?;
            if value.sign() == left.sign() && next.sign() != left.sign() {
                (left, right, root.place, root.depth) = (value, next, middle, at);
                parts = 2 * more;
            } else {
                parts = 1;
            }
        }
        Ok(())
    }

    /// The value at u = place·2^−depth ≤ 1, in units; its sign is certain.
    fn value(&self, place: &BigInt, depth: u64) -> Result<BigInt, InDoubt> {
        let horner = |sum: BigInt, coefficient: &BigInt| ((sum * place) >> depth) + coefficient;
        let value = self.coefficients.iter().rev().fold(BigInt::zero(), horner);
        decided(&value, &self.rounding()).map(|_| value).ok_or(InDoubt)
    }

    /// b_j = Σ_k C(j, k)/C(n, k) c_k
    fn bernstein(&self) -> Vec<BigInt> {
        let degree = self.coefficients.len() - 1;
        let binomials = |n: usize| IterBinomial::new(BigInt::from(n));
        let of_degree: Vec<BigInt> = binomials(degree).collect();
        let term = |((c_jk, c_nk), c_k): ((BigInt, &BigInt), &BigInt)| (c_jk * c_k).div_floor(c_nk);
        (0..=degree).map(|j| binomials(j).zip(&of_degree).zip(&self.coefficients).map(term).sum()).collect()
    }

    /// A bound of the error of a sum of all terms, each off by less than two units and rounded by less than another
    /// one.
    fn rounding(&self) -> BigInt {
        BigInt::from(3 * self.coefficients.len())
    }
}

/// The polynomial on one piece of the interval.
struct Piece {
    bernstein: Vec<BigInt>,
    /// Bound of the error of each coefficient.
    error: BigInt,
    place: BigInt,
    depth: u64,
}

impl Piece {
    /// How often the coefficients change their sign: an upper bound of the number of roots, off by an even number.
    /// `None` if a sign is in doubt.
    fn sign_changes(&self) -> Option<usize> {
        let signs: Option<Vec<_>> = self.bernstein.iter().map(|value| decided(value, &self.error)).collect();
        Some(signs?.windows(2).filter(|pair| pair[0] != pair[1]).count())
    }

    /// The pieces left and right of the middle (de Casteljau). Sums stand in for means; each is halved at the end, as
    /// often as means have been taken.
    fn halves(self) -> (Piece, Piece) {
        let (mut row, error): (_, BigInt) = (self.bernstein, self.error + 1);
        let last = row.len() - 1;
        let mut left = vec![row[0].clone()];
        for means in 1..=last {
            for i in 0..=last - means {
                let (before, after) = row.split_at_mut(i + 1);
                before[i] += &after[0];
            }
            left.push(&row[0] >> means);
        }
        row.iter_mut().enumerate().for_each(|(i, value)| *value >>= last - i);
        let (place, depth) = (self.place * 2, self.depth + 1);
        let right = Piece { bernstein: row, error: error.clone(), place: &place + 1, depth };
        (Piece { bernstein: left, error, place, depth }, right)
    }
}

/// The sign of a value that is off by at most `error`.
fn decided(value: &BigInt, error: &BigInt) -> Option<Sign> {
    (value.magnitude() > error.magnitude()).then(|| value.sign())
}

#[cfg(test)]
mod tests {
    use num_traits::ToPrimitive;

    use super::*;

    fn roots(integers: &[BigInt], range: u64, bits: u64) -> Result<Vec<Isolated>, InDoubt> {
        SignChanges::of(integers, &BigInt::one()).scaled(range, bits).roots()
    }

    #[test]
    fn close_roots_are_told_apart() {
        // (10^12 x − 10^12) (10^12 x − 10^12 − 1) (x − 3)
        let big = BigInt::from(10_i64.pow(12));
        let factors = [vec![-&big, big.clone()], vec![-&big - 1, big], vec![BigInt::from(-3), BigInt::one()]];
        let mut product = vec![BigInt::one()];
        for factor in factors {
            let low = product.iter().map(|value| value * &factor[0]).chain([BigInt::zero()]);
            let high = std::iter::once(BigInt::zero()).chain(product.iter().map(|value| value * &factor[1]));
            product = low.zip(high).map(|(low, high)| low + high).collect();
        }
        let found = roots(&product, 5, 256).unwrap();
        let place = |root: &Isolated| 5.0 * root.place.to_f64().unwrap() / 2_f64.powi(root.depth as i32);
        let places: Vec<f64> = found.iter().map(place).collect();
        assert_eq!(found.len(), 3);
        assert!(places[0] <= 1.0 && places[1] >= 1.0 && places[1] < 1.1 && places[2] > 1.1, "{places:?}");
        // too few bits are noticed
        assert!(roots(&product, 5, 32).is_err());
    }

    #[test]
    fn a_root_at_a_place_of_bisection_is_in_doubt() {
        // (4x − 1) (x − 1) (4x − 7)
        let integers = [-7, 39, -48, 16].map(BigInt::from);
        assert!(roots(&integers, 2, 128).is_err());
        assert_eq!(roots(&integers, 3, 128).unwrap().len(), 3);
    }
}
