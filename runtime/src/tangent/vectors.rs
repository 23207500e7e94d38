//! Tangent vectors as lists of numbers (δq, δp): read from a state of dual numbers, changed, and set again.

use std::f64::consts::LN_2;

use crate::number::{Dual, Number, scaled};
use crate::systems::coordinates::Coordinates;
use crate::systems::state::State;
use crate::systems::summation::Summation;

/// q or p, and of each of K vectors (δq, δp) its half, as dual numbers: a state with K tangent vectors begins so.
///
/// ```
/// use shadowstep::tangent::with_derivatives;
///
/// let q = with_derivatives(&[0.4, 0.0], [&[1.0, 0.0]]);
/// assert_eq!((q[0].value, q[0].derivatives), (0.4, [1.0]));
/// ```
///
/// # Panics
/// Vectors that have fewer components than there are numbers.
pub fn with_derivatives<N: Number, const K: usize>(numbers: &[N], vectors: [&[N]; K]) -> Vec<Dual<N, K>> {
    let dual = |(i, x): (usize, &N)| Dual::new(x.clone(), vectors.map(|vector| vector[i].clone()));
    numbers.iter().enumerate().map(dual).collect()
}

/// The vector k of a state: (δq, δp).
pub fn vector<N, V, S, const K: usize>(state: &State<Dual<N, K>, V, S>, k: usize) -> Vec<N>
where
    N: Number,
    V: Coordinates<Dual<N, K>>,
    S: Summation<Dual<N, K>>,
{
    state.q().iter().chain(state.p()).map(|x| x.derivatives[k].clone()).collect()
}

/// The vector k of a state ← (δq, δp); q and p stay, with the remainders of their sums.
pub(super) fn set_vector<N, V, S, const K: usize>(state: &mut State<Dual<N, K>, V, S>, k: usize, vector: &[N])
where
    N: Number,
    V: Coordinates<Dual<N, K>>,
    S: Summation<Dual<N, K>>,
{
    let mut remainders = state.remainders();
    let (of_q, of_p) = vector.split_at(state.q().len());
    state.q_mut().iter_mut().zip(of_q).for_each(|(x, own)| x.derivatives[k].assign(own));
    state.p_mut().iter_mut().zip(of_p).for_each(|(x, own)| x.derivatives[k].assign(own));
    state.settle();
    remainders.q.iter_mut().chain(&mut remainders.p).for_each(|x| x.derivatives[k].assign_zero());
    state.set_remainders(&remainders);
}

/// log |δ| of the numbers in a lane, |δ|² = |δq|² + |δp|²: −∞ of the vector 0, and NaN where a component is NaN.
pub(super) fn log_norm<'a, N: Number + 'a>(vector: impl Iterator<Item = &'a N> + Clone, lane: usize) -> f64 {
    // as m 2ⁿ, of which f64 has all n = 0
    let unit = vector.clone().map(|x| x.lane(lane).1).max().unwrap_or(0);
    let square = |x: &N| {
        let (m, n) = x.lane(lane);
        scaled(m, n - unit).powi(2)
    };
    vector.map(square).sum::<f64>().ln() / 2.0 + unit as f64 * LN_2
}

/// A column of R in V = QR.
pub(super) struct Column<N> {
    /// R_1j, …
    pub(super) above: Vec<N>,
    /// log R_jj in each lane.
    pub(super) logarithms: Vec<f64>,
}

/// The vectors ← orthonormal ones that span the same spaces, V = QR, and R. Beside a vector that depends on those
/// before it, with R_jj = 0, Q has another one.
///
/// By the modified Gram–Schmidt process, twice, as once leaves vectors that are nearly parallel not orthogonal: L.
/// Giraud, J. Langou, M. Rozložník, J. van den Eshof, Numer. Math. 101 (2005) 87.
pub(super) fn orthonormalise<N: Number>(vectors: &mut [Vec<N>]) -> Vec<Column<N>> {
    let mut columns = Vec::with_capacity(vectors.len());
    for j in 0..vectors.len() {
        let (before, own) = vectors.split_at_mut(j);
        let own = &mut own[0];
        let mut above: Vec<N> = before.iter().map(|earlier| subtract_projection(own, earlier)).collect();
        for (earlier, above) in before.iter().zip(&mut above) {
            above.add(&subtract_projection(own, earlier));
        }
        let logarithms: Vec<f64> = (0..N::LANES).map(|lane| log_norm(own.iter(), lane)).collect();
        for lane in (0..N::LANES).filter(|lane| logarithms[*lane] == f64::NEG_INFINITY) {
            let component = j % own.len();
            own[component].set_lane(lane, 1.0, 0);
        }
        normalise(own);
        columns.push(Column { above, logarithms });
    }
    columns
}

/// x ← x − (x·e) e, and x·e
fn subtract_projection<N: Number>(x: &mut [N], e: &[N]) -> N {
    let mut product = N::zero(&e[0].context());
    x.iter().zip(e).for_each(|(x, e)| product.add_product(x, e));
    x.iter_mut().zip(e).for_each(|(x, e)| x.subtract_product(&product, e));
    product
}

/// x ← x/|x|
fn normalise<N: Number>(x: &mut [N]) {
    let mut square = N::zero(&x[0].context());
    x.iter().for_each(|x| square.add_product(x, x));
    let mut norm = square.clone();
    norm.assign_sqrt(&square);
    x.iter_mut().for_each(|x| x.divide(&norm));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{AnyLimbs, LimbCount};

    #[test]
    fn norms_do_not_overflow() {
        let count = LimbCount::of_bits(128).unwrap();
        let mut large = AnyLimbs::from_f64(3.0, count);
        (0..400).for_each(|_| large.multiply_integer(1 << 10));
        let mut larger = large;
        larger.multiply_integer(4);
        larger.divide_integer(3);
        let found = log_norm([&large, &larger].into_iter(), 0);
        assert!((found - 5_f64.ln() - 4000.0 * LN_2).abs() < 1e-12 * found);
        assert_eq!(log_norm([0.0, 0.0].iter(), 0), f64::NEG_INFINITY);
    }

    /// Of nearly parallel vectors, too.
    #[test]
    fn vectors_become_orthonormal() {
        let mut vectors = vec![vec![1.0, 1.0, 1.0], vec![1.0, 1.0, 1.0 + 1e-9], vec![0.0, 3.0, -4.0]];
        let volume = orthonormalise(&mut vectors).iter().map(|found| found.logarithms[0]).sum::<f64>();
        for (i, a) in vectors.iter().enumerate() {
            for (j, b) in vectors.iter().enumerate() {
                let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                assert!((product - f64::from(i == j)).abs() < 4.0 * f64::EPSILON, "{i} {j} {product}");
            }
        }
        // the determinant is −3·10⁻⁹, of a difference that is known to 10⁻⁷
        assert!((volume - 3e-9_f64.ln()).abs() < 1e-6);
    }
}
