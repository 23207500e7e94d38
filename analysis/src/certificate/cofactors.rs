//! Why a condition holds modulo the equations of roots: as a sum of these, each with a factor.

use num_traits::One;
use shadowstep_schemes::Rational;
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::order::Condition;

use super::ring::{Polynomial, Ring, Root, add, sum};
use super::{Certificate, Class, Kind};

impl Certificate {
    /// The conditions for every T(p), each with the polynomials q₁, q₂, … in the roots x₁, x₂, … for which
    /// `value − needed = Σ q_i (x_i^k_i − r_i)`, by division with remainder 0; `None` for decimals, which meet no
    /// equation.
    ///
    /// ```
    /// use shadowstep_analysis::certificate::Certificate;
    /// use shadowstep_schemes::shipped_proved;
    ///
    /// let cofactors = |name: &str| Certificate::of(shipped_proved(name).unwrap()).unwrap().cofactors();
    /// assert!(cofactors("ruth3").unwrap().iter().all(|(_, factors)| factors.is_empty()));
    /// assert!(cofactors("yoshida4").unwrap().iter().any(|(_, factors)| !factors[0].is_empty()));
    /// assert!(cofactors("pefrl").is_none());
    /// ```
    pub fn cofactors(&self) -> Option<Vec<(Condition, Vec<Polynomial>)>> {
        let roots = match &self.kind {
            Kind::Exact => &[][..],
            Kind::Algebraic(roots) => roots,
            Kind::Decimal(_) => return None,
        };
        // without equations no power is reduced
        let free = Ring::default();
        let conditions = Class::EveryKinetic(self.order).conditions(&self.maps, &free);
        let of_condition = |(condition, value): (Condition, Polynomial)| {
            let off = Ring::sum(&value, &free.weight(&condition.needed), &-Rational::one());
            let (factors, remainder) = divided(off, roots);
            remainder.is_empty().then_some((condition, factors))
        };
        conditions.into_iter().map(of_condition).collect()
    }
}

/// The factors of the equations, and the remainder, in which no power of a root reaches that of its equation.
fn divided(mut left: Polynomial, roots: &[Root]) -> (Vec<Polynomial>, Polynomial) {
    let mut factors = vec![Polynomial::new(); roots.len()];
    // the last root first: its equation has all others
    for (place, root) in roots.iter().enumerate().rev() {
        let is_high = |exponents: &Vec<u32>| exponents.get(place).is_some_and(|e| *e >= root.power);
        while let Some(high) = left.keys().find(|exponents| is_high(exponents)).cloned() {
            let value = left.remove(&high).expect("it is a term");
            let mut lower = high;
            lower[place] -= root.power;
            root.of.iter().for_each(|(other, factor)| add(&mut left, sum(&lower, other), &value * factor));
            add(&mut factors[place], lower, value);
        }
    }
    (factors, left)
}
