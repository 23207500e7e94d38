//! How the energy of a pair falls to 0 between two distances.

use super::cutoff::MOST_DERIVATIVES;
use crate::Rational;
use crate::number::Number;

/// S(t) = tⁿ⁺¹ Σ C(n + k, k) (1 − t)ᵏ, k = 0, …, n: from 0 at t = 0 to 1 at t = 1, with S′(t) = (2n + 1)!/(n!)² tⁿ (1 −
/// t)ⁿ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polynomial {
    /// n
    pub(super) derivatives: u32,
}

/// How many numbers [`Polynomial::coefficients`] are at most.
pub(super) const COEFFICIENTS: usize = MOST_DERIVATIVES as usize + 2;

impl Polynomial {
    /// C(n + k, k) for k = 0, …, n, then (2n + 1)!/(n!)².
    pub(super) fn coefficients(self) -> impl Iterator<Item = Rational> {
        let n = i64::from(self.derivatives);
        // C(n + k, k) = C(n + k − 1, k − 1)·(n + k)/k
        let binomials = (1..=n + 1).scan(1, move |binomial, k| {
            let this = *binomial;
            *binomial = *binomial * (n + k) / k;
            Some(this)
        });
        // (2n + 1)!/(n!)² = (n + 1) C(2n + 1, n)
        let slope = (1..=n).fold(1, |binomial, k| binomial * (n + 1 + k) / k) * (n + 1);
        binomials.chain([slope]).map(|integer| Rational::from_integer(integer.into()))
    }

    /// values ← S(t), slopes ← S′(t); 1 and 0 exactly for t ≥ 1.
    #[inline(always)]
    pub(super) fn assign<N: Number, const W: usize>(
        self,
        coefficients: &[N; COEFFICIENTS],
        t: &[N; W],
        values: &mut [N; W],
        slopes: &mut [N; W],
    ) {
        let [one, ..] = coefficients;
        let n = self.derivatives as usize;
        let mut t = t.clone();
        let mut rest = t.clone();
        for l in 0..W {
            t[l].make_at_most(one);
            rest[l].assign_difference(one, &t[l]);
            values[l].assign(&coefficients[n]);
            slopes[l].assign(&coefficients[n + 1]);
        }
        for k in (0..n).rev() {
            for l in 0..W {
                values[l].multiply(&rest[l]);
                values[l].add(&coefficients[k]);
            }
        }
        for l in 0..W {
            rest[l].multiply(&t[l]);
            values[l].multiply(&t[l]);
        }
        for _ in 0..n {
            for l in 0..W {
                slopes[l].multiply(&rest[l]);
                values[l].multiply(&t[l]);
            }
        }
    }

    /// S″(t) = n (2n + 1)!/(n!)² tⁿ⁻¹ (1 − t)ⁿ⁻¹ (1 − 2t); 0 for t > 1 and n > 1.
    pub(super) fn second_derivative<N: Number>(self, coefficients: &[N; COEFFICIENTS], t: &N) -> N {
        let [one, ..] = coefficients;
        let n = self.derivatives as i32;
        let mut t = t.clone();
        t.make_at_most(one);
        let [mut found, mut rest] = [one.clone(), one.clone()];
        rest.subtract(&t);
        found.subtract(&t);
        found.subtract(&t);
        rest.multiply(&t);
        for _ in 1..n {
            found.multiply(&rest);
        }
        found.multiply(&coefficients[n as usize + 1]);
        found.multiply_integer(n);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::{COEFFICIENTS, Polynomial};
    use crate::number::Number;
    use crate::systems::pairs::MOST_DERIVATIVES;

    #[test]
    fn it_rises_from_0_to_1_with_its_derivative() {
        for derivatives in 1..=MOST_DERIVATIVES {
            let polynomial = Polynomial { derivatives };
            let mut coefficients = [0.0; COEFFICIENTS];
            for (own, exact) in coefficients.iter_mut().zip(polynomial.coefficients()) {
                *own = f64::from_rational(&exact, &());
            }
            let at = |t: f64| {
                let ([mut value], [mut slope]) = ([0.0], [0.0]);
                polynomial.assign(
                    &coefficients,
                    &[t],
                    std::array::from_mut(&mut value),
                    std::array::from_mut(&mut slope),
                );
                (value, slope)
            };
            assert_eq!([at(0.0), at(1.0), at(7.0)], [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0)]);
            assert!((at(0.5).0 - 0.5).abs() < 1e-14);
            for t in [0.1, 0.3, 0.5, 0.9] {
                let h = 1e-4;
                // the error of the difference is h²/6 of the third derivative, which is below 1e3
                let difference = (at(t + h).0 - at(t - h).0) / (2.0 * h);
                assert!(
                    (difference - at(t).1).abs() < 1e-5,
                    "n = {derivatives}, t = {t}: {difference} and {}",
                    at(t).1
                );
                let difference = (at(t + h).1 - at(t - h).1) / (2.0 * h);
                let second = polynomial.second_derivative(&coefficients, &t);
                assert!((difference - second).abs() < 1e-3, "n = {derivatives}, t = {t}: {difference} and {second}");
            }
        }
    }
}
