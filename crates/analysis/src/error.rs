//! The leading error of a scheme: the terms of lowest order in the logarithm of its step.
//!
//! A step of order p is exp(h a_1 K) exp(h b_1 D) exp(h a_2 K) … = exp(h (K + D) + h^{p+1} E + …), where E is a Lie
//! polynomial of degree p + 1 in K and D. Its coordinates in the basis of [`super::bracket`] are the error
//! coefficients. For quadratic T, E is what is left modulo the ideal of the brackets that vanish; the terms of the
//! logarithm between the order for every T(p) and the order for quadratic T lie in that ideal.

use shadowstep_schemes::symbolic::{Fraction, Rational};

use crate::bracket::{Bracket, coordinates};
use crate::logarithm::Logarithm;
use shadowstep_schemes::Proved;
use shadowstep_schemes::arithmetic::FixedPoint;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::map::Map;
use shadowstep_schemes::order::weighed;

/// Digits behind the point of the words' coefficients. They are about 1e-8 or larger before the coefficients of the
/// exact flow are subtracted, and the difference is needed to the 16 digits of f64.
const DIGITS: u32 = 60;

/// Coefficients below this are not distinguished from 0: some digits above the words' coefficients' last.
const RESOLVED: f64 = 1e-50;

/// The leading error for one class of kinetic energies.
#[derive(Clone, Debug, PartialEq)]
pub struct LeadingError {
    /// The power of h in the logarithm of the step: the order + 1.
    pub power: u32,
    /// The brackets of the basis with their coefficients, those with more kicks first.
    pub terms: Vec<(Bracket, f64)>,
}

impl LeadingError {
    /// The leading errors of a scheme for every T(p) and for quadratic T; of a processed scheme those of its kernel.
    pub fn of(proved: &Proved) -> [LeadingError; 2] {
        LeadingError::of_maps(
            &proved.scheme.maps(),
            [Kinetic::Any, Kinetic::Quadratic].map(|of| proved.proof.for_kinetic(of).order),
        )
    }

    /// The same of the processed step χ⁻¹ ∘ kernel ∘ χ; `None` for a scheme that is not processed.
    pub fn processed(proved: &Proved) -> Option<[LeadingError; 2]> {
        let (maps, effective) = (proved.scheme.processed_maps()?, proved.proof.effective.as_ref()?);
        Some(LeadingError::of_maps(&maps, [Kinetic::Any, Kinetic::Quadratic].map(|of| effective.for_kinetic(of).order)))
    }

    /// Of a step of these orders for every T(p) and for quadratic T.
    fn of_maps(maps: &[Map], orders: [u32; 2]) -> [LeadingError; 2] {
        let arithmetic = FixedPoint::new(DIGITS);
        let unit = arithmetic.unit();
        // not reduced, which would take as long as all the rest
        let value = |units: Rational| resolved(Fraction::new(units.numer().clone(), units.denom() * &unit).to_f64());
        let maps = weighed(maps, &arithmetic);
        let mut lyndon = (0, Vec::new());
        [(Kinetic::Any, orders[0]), (Kinetic::Quadratic, orders[1])].map(|(kinetic, order)| {
            let power = order + 1;
            if lyndon.0 != power {
                let logarithm = Logarithm::of_length(power as usize, orders[0] as usize);
                let values = logarithm.of(&maps, &arithmetic).into_iter().map(|value| value.units());
                lyndon = (power, logarithm.words().iter().cloned().zip(values).collect());
            }
            let terms = coordinates(&lyndon.1, kinetic).into_iter().map(|(bracket, units)| (bracket, value(units)));
            LeadingError { power, terms: terms.collect() }
        })
    }

    /// The Euclidean norm of the coefficients.
    pub fn norm(&self) -> f64 {
        self.terms.iter().map(|(_, c)| c * c).sum::<f64>().sqrt()
    }

    /// The effective error s·‖E‖^{1/p} of a scheme of order p with s evaluations of the gradient a step.
    ///
    /// At a given cost a scheme with half of another's effective error and the same order makes 2^p times smaller
    /// errors, as far as the leading term goes (McLachlan, SIAM J. Sci. Comput. 16 (1995) 151).
    pub fn effective(&self, evaluations: usize) -> f64 {
        evaluations as f64 * self.norm().powf(1.0 / f64::from(self.power - 1))
    }
}

/// A coefficient that the digits do not distinguish from 0 is 0.
fn resolved(coefficient: f64) -> f64 {
    if coefficient.abs() < RESOLVED { 0.0 } else { coefficient }
}
