//! Linear least squares in fixed point: the columns that a matrix can be solved for, the solution, and how well it is
//! determined.

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};

/// The factors A·P = Q·R of a matrix of full or lower rank, by modified Gram–Schmidt with column pivoting.
pub(super) struct Factors {
    bits: u32,
    /// Orthonormal columns of Q.
    q: Vec<Vec<BigInt>>,
    /// For each of them the row of R, along the columns in the order of `order`.
    r: Vec<Vec<BigInt>>,
    /// The columns of A: those that were chosen, best first.
    pub(super) order: Vec<usize>,
    /// The diagonal of R.
    pub(super) diagonal: Vec<f64>,
}

impl Factors {
    /// Factors the columns, as long as what remains of one is longer than 2^−(bits/2).
    pub(super) fn of(mut columns: Vec<Vec<BigInt>>, bits: u32) -> Factors {
        let count = columns.len();
        let mut factors = Factors { bits, q: Vec::new(), r: Vec::new(), order: Vec::new(), diagonal: Vec::new() };
        let mut r = vec![vec![BigInt::zero(); count]; count];
        let mut rest: Vec<usize> = (0..count).collect();
        let smallest = BigInt::from(1) << (bits - bits / 2);
        while let Some(place) = (0..rest.len()).max_by_key(|&i| dot(&columns[rest[i]], &columns[rest[i]], bits)) {
            let pivot = rest.remove(place);
            let length = length(&columns[pivot]);
            if length < smallest {
                break;
            }
            let unit: Vec<BigInt> = columns[pivot].iter().map(|x| (x << bits) / &length).collect();
            let k = factors.order.len();
            for &other in &rest {
                let along = dot(&unit, &columns[other], bits);
                for (x, u) in columns[other].iter_mut().zip(&unit) {
                    *x -= (&along * u) >> bits;
                }
                r[k][other] = along;
            }
            factors.diagonal.push(float(&length, bits));
            r[k][pivot] = length;
            factors.q.push(unit);
            factors.order.push(pivot);
        }
        factors.r = r
            .iter()
            .take(factors.order.len())
            .map(|row| factors.order.iter().map(|&j| row[j].clone()).collect())
            .collect();
        factors
    }

    /// The x with least |A x − b|, one value for each column of `order`.
    pub(super) fn solve(&self, b: &[BigInt]) -> Vec<BigInt> {
        let mut rest = b.to_vec();
        let mut x: Vec<BigInt> = self
            .q
            .iter()
            .map(|unit| {
                let along = dot(unit, &rest, self.bits);
                rest.iter_mut().zip(unit).for_each(|(x, u)| *x -= (&along * u) >> self.bits);
                along
            })
            .collect();
        for k in (0..x.len()).rev() {
            let known: BigInt = (k + 1..x.len()).map(|j| &self.r[k][j] * &x[j]).sum();
            x[k] = ((&x[k] << self.bits) - known) / &self.r[k][k];
        }
        x
    }

    /// The condition number: the largest singular value over the smallest, up to about 10^15.
    pub(super) fn condition_number(&self) -> f64 {
        let mut columns: Vec<Vec<f64>> =
            (0..self.order.len()).map(|j| self.r.iter().map(|row| float(&row[j], self.bits)).collect()).collect();
        while rotate(&mut columns) {}
        let lengths = columns.iter().map(|c| c.iter().map(|x| x * x).sum::<f64>().sqrt());
        let (least, most) = lengths.fold((f64::MAX, 0.0_f64), |(least, most), l| (least.min(l), most.max(l)));
        if columns.is_empty() { 1.0 } else { most / least }
    }
}

/// One sweep of one-sided Jacobi rotations; whether any pair of columns was not yet orthogonal.
fn rotate(columns: &mut [Vec<f64>]) -> bool {
    let mut any = false;
    for i in 0..columns.len() {
        for j in i + 1..columns.len() {
            let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
            let (a, b) = (product(&columns[i], &columns[i]), product(&columns[j], &columns[j]));
            let c = product(&columns[i], &columns[j]);
            // 100 times the rounding of f64: what is left below it is rounding itself
            if c.abs() <= 2e-14 * (a * b).sqrt() {
                continue;
            }
            any = true;
            let zeta = (b - a) / (2.0 * c);
            let tangent = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
            let cosine = 1.0 / tangent.hypot(1.0);
            let (left, right) = columns.split_at_mut(j);
            for (x, y) in left[i].iter_mut().zip(&mut right[0]) {
                (*x, *y) = (cosine * (*x - tangent * *y), cosine * (tangent * *x + *y));
            }
        }
    }
    any
}

fn dot(a: &[BigInt], b: &[BigInt], bits: u32) -> BigInt {
    a.iter().zip(b).map(|(x, y)| x * y).sum::<BigInt>() >> bits
}

/// √(Σ x²): the squares have twice the bits, their root has them once.
pub(super) fn length(x: &[BigInt]) -> BigInt {
    x.iter().map(|x| x * x).sum::<BigInt>().sqrt()
}

/// Units as f64, 0 below its range.
pub(super) fn float(units: &BigInt, bits: u32) -> f64 {
    let excess = (units.bits() as i64 - 64).max(0);
    let leading = (units >> excess).to_f64().unwrap_or(f64::MAX);
    leading * 2_f64.powi((excess - i64::from(bits)) as i32)
}

/// log10 |x|; −∞ for 0.
pub(super) fn log10(units: &BigInt, bits: u32) -> f64 {
    if units.is_zero() {
        return f64::NEG_INFINITY;
    }
    // bit lengths first: f64 has no room for 1e-400
    let excess = units.bits() as i64 - 64;
    let leading = if excess > 0 { units.abs() >> excess } else { units.abs() };
    let scale = (excess.max(0) - i64::from(bits)) as f64;
    leading.to_f64().unwrap_or(1.0).log10() + scale * std::f64::consts::LOG10_2
}

#[cfg(test)]
mod tests {
    use super::*;

    const BITS: u32 = 200;

    fn column(entries: &[i64]) -> Vec<BigInt> {
        entries.iter().map(|&x| BigInt::from(x) << BITS).collect()
    }

    fn floats(x: &[BigInt]) -> Vec<f64> {
        x.iter().map(|x| float(x, BITS)).collect()
    }

    #[test]
    fn a_square_system_is_solved() {
        let factors = Factors::of(vec![column(&[2, 1]), column(&[1, 3])], BITS);
        let x = floats(&factors.solve(&column(&[5, 10])));
        let at = |j: usize| x[factors.order.iter().position(|&k| k == j).unwrap()];
        // fixed point of 200 bits, read as f64
        assert!((at(0) - 1.0).abs() < 1e-15 && (at(1) - 3.0).abs() < 1e-15);
        // singular values of [[2, 1], [1, 3]]: its eigenvalues (5 ± √5)/2
        let root = 5_f64.sqrt();
        assert!((factors.condition_number() - (5.0 + root) / (5.0 - root)).abs() < 1e-13);
    }

    #[test]
    fn dependent_columns_are_left_out() {
        let factors = Factors::of(vec![column(&[1, 2, 3]), column(&[2, 4, 6]), column(&[0, 1, 0])], BITS);
        assert_eq!(factors.order.len(), 2);
        assert!(factors.order.contains(&1) && factors.order.contains(&2), "the longer of the two parallel ones");
    }

    #[test]
    fn an_overdetermined_system_gets_its_least_squares() {
        let factors = Factors::of(vec![column(&[1, 1, 1])], BITS);
        let x = floats(&factors.solve(&column(&[1, 2, 6])));
        assert!((x[0] - 3.0).abs() < 1e-15, "the mean");
    }
}
