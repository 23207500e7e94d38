//! The weights of the estimators, exact rationals: of central differences, and of the bilinear estimator.
//!
//! # Central differences
//!
//! $$D_m y(0) = \frac1h \sum_{j=1}^m d_{m,j} \thinspace \bigl( y(jh) - y(-jh) \bigr), \qquad
//! d_{m,j} = \frac{(-1)^{j+1} (m!)^2}{j \thinspace (m-j)! \thinspace (m+j)!}$$
//!
//! (Moan & Niesen, eq. 4; they are the diagonal of the Richardson table, eq. 5.) The same $D_m$ is the sum of the first
//! $m$ terms of Stirling's series: $D_m y = \frac1h \sum_{k=1}^m c_k \thinspace \mu\delta^{2k-1} y$ with $c_1 = 1$ and
//! $c_{k+1} = -c_k \thinspace k^2 / (2k (2k+1))$.
//!
//! **Proof.** Let $D_m y(0)$ be the derivative at 0 of the polynomial of degree $2m$ that interpolates $y$ at $-mh,
//! \ldots, mh$. Its weights are $\ell_j'(0)$, with $\ell_j$ the Lagrange polynomials of the nodes $-m, \ldots, m$. For
//! $j \neq 0$ only the derivative of the factor $x - 0$ remains at 0:
//!
//! $$\ell_j'(0) = \frac1j \prod_{i \neq 0, j} \frac{-i}{j-i}, \qquad
//! \prod_{i \neq 0, j} (-i) = \frac{(-1)^m (m!)^2}{-j}, \qquad
//! \prod_{i \neq 0, j} (j-i) = \frac{(-1)^{m-j} (m+j)! \thinspace (m-j)!}{j},$$
//!
//! whose quotient is $d_{m,j}$; and $\ell_0'(0) = 0$, as the nodes are symmetric. Each entry $T_{m,m}$ of the
//! Richardson table is a combination of the same values that is exact for the same polynomials, and there is one only.
//! ∎
//!
//! # The bilinear estimator
//!
//! With states counted back from the newest, $i = 0, \ldots, k$,
//!
//! $$E_k = \frac1{2h} \sum_{i>j} P_{ij} \thinspace \bigl( q_i \cdot p_j - p_i \cdot q_j + \beta_j - \beta_i \bigr),
//! \qquad P_{ij} = \frac{2 \thinspace (-1)^{i-j} \thinspace C(k,i) \thinspace C(k,j)}{(i-j) \thinspace C(2k,k)}$$
//!
//! with binomial coefficients $C$. This is the estimator of Skeel & Hardy (SIAM J. Sci. Comput. 23 (2001) 1172) and
//! Engle, Skeel & Drees (J. Comput. Phys. 206 (2005) 432), whose weights were printed as tables for $k = 2, 4, \ldots,
//! 12$, in closed formula.
//!
//! **Proof.** Let $X = e^{-x}$ and $Y = e^{-y}$ shift the first and the second factor of a product back by a step, $x$
//! and $y$ being $h \thinspace d/dt$ on each. $P$ is antisymmetric, so that the sum over $i > j$ of $P_{ij} (q_i \cdot
//! p_j - p_i \cdot q_j)$ is that over all $i \neq j$ of $P_{ij} \thinspace q_i \cdot p_j$, which is $2F/C(2k,k)$ on $q
//! \cdot p$ with
//!
//! $$F(X, Y) = \sum_{i \neq j} \frac{(-1)^{i-j} \thinspace C(k,i) \thinspace C(k,j)}{i-j} \thinspace X^i \thinspace Y^j
//! .$$
//!
//! Then, with $G(z) = \sum_i C(k,i)^2 \thinspace z^i$,
//!
//! $$(X \partial_X - Y \partial_Y) \thinspace F = \sum_{i \neq j} (-1)^{i-j} \thinspace C(k,i) \thinspace C(k,j)
//! \thinspace X^i \thinspace Y^j = (1-X)^k \thinspace (1-Y)^k - G(XY) .$$
//!
//! In $s = x + y$ and $d = x - y$ the operator is $-2 \partial_d$, and $F$ is odd in $d$, so
//!
//! $$F = \tfrac12 \thinspace d \thinspace G(e^{-s}) - \tfrac12 \int_0^d (1-X)^k \thinspace (1-Y)^k \thinspace dd' .$$
//!
//! The second term is of degree $2k + 1$ in $h$. The first is the mean of $\frac12 (x - y)$, the derivative in
//! $\frac12 h (q' \cdot p - q \cdot p')$, at the states $i$ with the weights $C(k,i)^2$. So, as $G(1) = C(2k,k)$, and
//! in the same way for $\beta$, whose weights are $\sum_j P_{ij}$,
//!
//! $$E_k = \sum_i \frac{C(k,i)^2}{C(2k,k)} \cdot \tfrac12 \bigl( q' \cdot p - q \cdot p' - \beta' \bigr)(\text{state }
//! i) + O(h^{2k}) :$$
//!
//! a mean of the modified energy over the window, about its middle, $k/2$ steps back. ∎ Nothing is assumed of the
//! scheme but that it has a modified Hamiltonian: it need not be a palindrome.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex};

use num_bigint::BigInt;
use num_integer::IterBinomial;

use crate::Rational;

/// d_{m,1}, …, d_{m,m}; computed once for each m and shared.
///
/// ```
/// use shadowstep::{exact, shadow::weights::central};
/// assert_eq!(central(2)[..], [exact("2/3").unwrap(), exact("-1/12").unwrap()]);
/// ```
pub fn central(m: u32) -> Arc<[Rational]> {
    static KNOWN: LazyLock<Mutex<BTreeMap<u32, Arc<[Rational]>>>> = LazyLock::new(Mutex::default);
    // a panic elsewhere cannot leave a wrong entry: an entry is inserted whole
    let mut known = KNOWN.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    known.entry(m).or_insert_with(|| computed(m)).clone()
}

/// Each weight from the one before: r_j = (m!)²/((m−j)!(m+j)!) has r_j = r_{j−1} (m−j+1)/(m+j).
fn computed(m: u32) -> Arc<[Rational]> {
    let mut ratio = Rational::from_integer(1.into());
    (1..=m)
        .map(|j| {
            ratio *= Rational::new(BigInt::from(m - j + 1), BigInt::from(m + j));
            let sign = if j % 2 == 1 { 1 } else { -1 };
            &ratio * Rational::new(BigInt::from(sign), BigInt::from(j))
        })
        .collect()
}

/// c_1, …, c_m of Stirling's series.
pub(crate) fn stirling(m: u32) -> Vec<Rational> {
    let mut coefficient = Rational::from_integer(1.into());
    (1..=u64::from(m))
        .map(|k| {
            let this = coefficient.clone();
            coefficient *= Rational::new(-BigInt::from(k * k), BigInt::from(2 * k * (2 * k + 1)));
            this
        })
        .collect()
}

/// P_ij of [`crate::shadow::Bilinear`], states counted back from the newest, i > j ≥ 0: row ℓ − 1, ℓ = i − j = 1..k,
/// has P_{j+ℓ,j} for j = 0..=k−ℓ, which reads the same backwards.
///
/// P_ij = 2 (−1)^{i−j} C(k,i) C(k,j) / ((i−j) C(2k,k)), and P_ji = −P_ij.
///
/// ```
/// use shadowstep::{exact, shadow::weights::bilinear};
/// // k = 1: one pair
/// assert_eq!(bilinear(1), [[exact("-1").unwrap()]]);
/// ```
pub fn bilinear(k: u32) -> Vec<Vec<Rational>> {
    let weights = BilinearWeights::new(k);
    let weight = |lag: usize, j: usize| Rational::new(weights.numerator(lag, j), weights.denominator(lag));
    (1..=k as usize).map(|lag| (0..=k as usize - lag).map(|j| weight(lag, j)).collect()).collect()
}

/// P_{j+ℓ,j} as numerators and denominators, which need not be in lowest terms.
pub(super) struct BilinearWeights {
    /// C(k,0), …, C(k,k)
    binomials: Vec<BigInt>,
    /// C(2k,k)
    of_2k: BigInt,
}

impl BilinearWeights {
    pub(super) fn new(k: u32) -> Self {
        let binomials: Vec<BigInt> = IterBinomial::new(BigInt::from(k)).collect();
        let of_2k = binomials.iter().map(|c| c * c).sum();
        BilinearWeights { binomials, of_2k }
    }

    /// 2 (−1)^ℓ C(k,j+ℓ) C(k,j), which is 0 beyond the last state.
    pub(super) fn numerator(&self, lag: usize, j: usize) -> BigInt {
        self.product(lag, j) * if lag.is_multiple_of(2) { 2 } else { -2 }
    }

    /// C(k,j+ℓ) C(k,j), which is 0 beyond the last state.
    pub(super) fn product(&self, lag: usize, j: usize) -> BigInt {
        self.binomials.get(j + lag).map_or_else(BigInt::default, |later| later * &self.binomials[j])
    }

    /// C(2k,k)
    pub(super) fn of_2k(&self) -> &BigInt {
        &self.of_2k
    }

    /// ℓ C(2k,k)
    pub(super) fn denominator(&self, lag: usize) -> BigInt {
        BigInt::from(lag) * &self.of_2k
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::Zero;

    /// 1 … 60 and the two large ones of the paper's range.
    fn orders() -> impl Iterator<Item = u32> {
        (1..=60).chain([100, 200])
    }

    #[test]
    fn closed_formula() {
        let factorial = |n: u32| (1..=n).map(BigInt::from).product::<BigInt>();
        for m in orders() {
            for (j, weight) in (1..).zip(central(m).iter()) {
                let sign = BigInt::from(if j % 2 == 1 { 1 } else { -1 });
                let below = BigInt::from(j) * factorial(m - j) * factorial(m + j);
                assert_eq!(*weight, Rational::new(sign * factorial(m) * factorial(m), below), "d_{{{m},{j}}}");
            }
        }
    }

    /// The definition: T_{j,1} = δ_j/(2j) with δ_j = y_j − y_{−j}, h = 1, and
    /// T_{j,k+1} = T_{j,k} + (T_{j,k} − T_{j−1,k})/((1−k/j)² − 1). Returns T_{1,1}, …, T_{M,M}.
    fn richardson_diagonal(differences: &[Rational]) -> Vec<Rational> {
        let one = Rational::from_integer(1.into());
        let mut column: Vec<_> =
            (1..).zip(differences).map(|(j, d)| d / Rational::from_integer((2 * j).into())).collect();
        let mut diagonal = vec![column[0].clone()];
        for k in 1..differences.len() {
            for row in (1..column.len()).rev() {
                let ratio = Rational::new(row.into(), (row + k).into()); // 1 − k/j with j = row + k
                let step = (&column[row] - &column[row - 1]) / (&ratio * &ratio - &one);
                column[row] += step;
            }
            column.remove(0);
            diagonal.push(column[0].clone());
        }
        diagonal
    }

    #[test]
    fn richardson_triangle_up_to_60() {
        for i in 0..60 {
            // the weight of δ_i in every T_{m,m}
            let mut unit = vec![Rational::zero(); 60];
            unit[i] = Rational::from_integer(1.into());
            for (m, value) in (1..).zip(richardson_diagonal(&unit)) {
                assert_eq!(value, central(m).get(i).cloned().unwrap_or_else(Rational::zero), "d_{{{m},{}}}", i + 1);
            }
        }
    }

    /// Two linear forms in 200 variables that agree at random integers are equal, but for a chance below 2⁻⁶⁰.
    #[test]
    fn richardson_triangle_at_100_and_200() {
        let mut random = 0x9E37_79B9_7F4A_7C15_u64;
        for _ in 0..4 {
            let differences: Vec<_> = (0..200)
                .map(|_| {
                    random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    Rational::from_integer((random >> 40).into())
                })
                .collect();
            let diagonal = richardson_diagonal(&differences);
            for m in [100, 200] {
                let value: Rational = central(m).iter().zip(&differences).map(|(w, d)| w * d).sum();
                assert_eq!(value, diagonal[m as usize - 1], "m = {m}");
            }
        }
    }

    /// μδ^{2k−1} y = ½ Σ_i (−1)^i C(2k−1, i) (y_{k−i} + y_{k−1−i})
    #[test]
    fn stirling_series() {
        for m in orders() {
            let size = m as usize;
            let mut weights = vec![Rational::zero(); size + 1]; // of y_i; odd in i
            for (k, coefficient) in (1..).zip(stirling(m)) {
                let mut binomial = BigInt::from(1);
                for i in 0..2 * k {
                    let half = Rational::new(if i % 2 == 0 { binomial.clone() } else { -binomial.clone() }, 2.into());
                    for place in [k as i64 - i as i64, k as i64 - 1 - i as i64] {
                        if place > 0 {
                            weights[place as usize] += &half * &coefficient;
                        }
                    }
                    binomial = binomial * BigInt::from(2 * k - 1 - i) / BigInt::from(i + 1);
                }
            }
            assert_eq!(weights[1..], central(m)[..], "m = {m}");
        }
    }
}
