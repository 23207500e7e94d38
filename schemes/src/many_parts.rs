//! Steps for H = H_1 + … + H_n of a scheme for two parts.
//!
//! A scheme a_1, b_1, a_2, … for two parts whose weights have equal sums is a composition χ_(α_1) χ*_(β_1) χ_(α_2) … of
//! the basic map χ_h = φ_n(h) ∘ … ∘ φ_1(h) and its adjoint χ*_h = φ_1(h) ∘ … ∘ φ_n(h), with α_1 = a_1, β_1 = b_1 − α_1,
//! α_2 = a_2 − β_1, …: then φ_1 is made with the weights a and φ_n with b, and between them stand the *middle* parts,
//! φ_2(α) … φ_(n−1)(α) after a kick, φ_(n−1)(β) … φ_2(β) after a drift. Its order for any number of parts is that for
//! every A + B.
//!
//! Sources: R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151; E. Hairer, C. Lubich & G. Wanner, Geometric Numerical
//! Integration, II.5 and III.3.

use num_traits::Zero;
use thiserror::Error;

use crate::map::Map;
use crate::map_kind::MapKind;
use crate::pipeline::Proved;
use crate::plan::StepPlan;
use crate::proof::{Order, order_of_parts};
use crate::scheme::ExactScheme;
use crate::symbolic::Rational;

/// The number of parts for which the order is proved; for more it follows from the theorem.
const PARTS: usize = 3;

/// Digits that the weights of middle parts may lose: they are sums of up to a hundred weights.
const DIGITS_LOST: u32 = 2;

/// Why a scheme has no steps for three parts and more.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum NotForManyParts {
    /// Its gradient kicks are made of T(p) and U(q).
    #[error("{0} has gradient kicks, which are for T(p) and U(q) only")]
    GradientKicks(String),
    /// Its order is claimed for quadratic T only.
    #[error(
        "{name} has order {quadratic} for T(p) and U(q) with quadratic T only, for three parts and more order {order}"
    )]
    QuadraticOnly {
        /// Its name.
        name: String,
        /// The order for every A + B, thus for many parts.
        order: u32,
        /// The order for quadratic T.
        quadratic: u32,
    },
    /// Its processor is made of two parts.
    #[error("{0} is a processed scheme, whose effective order is proved for two parts only")]
    Processed(String),
    /// A condition fails.
    #[error("{name} has order {order} for three parts, as the condition of {failed} fails")]
    Fails {
        /// Its name.
        name: String,
        /// The order that holds.
        order: u32,
        /// The functional of the condition.
        failed: String,
    },
}

crate::debug_as_text!(NotForManyParts);

impl Proved {
    /// The scheme with the plan of its steps for three parts and more, whose order is proved by the words on three
    /// letters.
    ///
    /// Near-integrable orders are of two parts: what holds for more is the order in h.
    ///
    /// ```
    /// use shadowstep_schemes::shipped_proved;
    ///
    /// let proved = shipped_proved("yoshida4").unwrap().for_many_parts().unwrap();
    /// assert_eq!(proved.proof.many_parts.unwrap().order, 4);
    /// assert_eq!(proved.plan.middle.len(), proved.plan.maps.len() - 1);
    /// ```
    ///
    /// # Errors
    /// A scheme with gradient kicks, with a processor, or whose order is for quadratic T only.
    pub fn for_many_parts(&self) -> Result<Proved, NotForManyParts> {
        if self.proof.many_parts.is_some() {
            return Ok(self.clone());
        }
        let Proved { scheme, proof, .. } = self;
        let name = scheme.table.name.value.clone();
        if scheme.has_gradient_kicks() {
            return Err(NotForManyParts::GradientKicks(name));
        }
        if !self.holds_for_every_kinetic() {
            let (order, quadratic) = (proof.general.order, proof.quadratic.order);
            return Err(NotForManyParts::QuadraticOnly { name, order, quadratic });
        }
        if scheme.processor.is_some() {
            return Err(NotForManyParts::Processed(name));
        }
        let order = match &proof.nested {
            Some(nested) => nested.clone(),
            None => many_parts_order(scheme, PARTS, proof.general.order),
        };
        if let Some((failed, _)) = order.failed.as_ref().filter(|_| scheme.inner.is_none()) {
            let failed = failed.functional.to_string();
            return Err(NotForManyParts::Fails { name, order: order.order, failed });
        }
        let mut proved = self.clone();
        let (maps, middle) = scheme.step_of_parts();
        proved.plan = StepPlan::of_many_parts(&maps, &middle);
        if scheme.inner.is_some() {
            [&mut proved.proof.general, &mut proved.proof.quadratic]
                .into_iter()
                .for_each(|of_two| *of_two = order.clone());
        }
        proved.proof.many_parts = Some(order);
        Ok(proved)
    }
}

impl ExactScheme {
    /// The maps of a step of three parts and more, with the weights of the middle parts between each and the next.
    ///
    /// # Panics
    /// With gradient kicks.
    pub fn step_of_parts(&self) -> (Vec<Map>, Vec<Rational>) {
        let maps = self.maps();
        match &self.inner {
            Some(inner) => inner.step(&maps),
            None => {
                let middle = middle_weights(&maps);
                (maps, middle)
            }
        }
    }
}

/// The order of a scheme's steps for this number of parts, up to `highest`, by the words on as many letters.
///
/// # Panics
/// With gradient kicks, and for fewer than two parts.
pub(crate) fn many_parts_order(scheme: &ExactScheme, parts: usize, highest: u32) -> Order {
    assert!(parts >= 2, "H has two parts at least");
    let maps = scheme.maps();
    order_of_parts((&maps, &middle_weights(&maps)), scheme.held.losing(DIGITS_LOST), parts, highest)
}

/// The weights of the middle parts between each map and the next: α after a kick, β after a drift.
///
/// After the last map would be Σa − Σb, which is 0 but for the rounding of the weights.
pub(crate) fn middle_weights(maps: &[Map]) -> Vec<Rational> {
    let mut rest = Rational::zero();
    let between = maps.iter().take(maps.len().saturating_sub(1));
    between
        .map(|map| {
            assert!(map.kind != MapKind::GradientKick, "gradient kicks are for two parts");
            rest = &map.weight - &rest;
            rest.clone()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Source, read, shipped, shipped_proved};

    fn half(count: i64) -> Rational {
        Rational::new(count.into(), 2.into())
    }

    #[test]
    fn the_leapfrog_of_three_parts() {
        let plan = shipped_proved("stormer-verlet").unwrap().for_many_parts().unwrap().plan;
        assert_eq!(plan.maps, [(MapKind::Kick, 0), (MapKind::Drift, 0), (MapKind::Kick, 0)]);
        assert_eq!(plan.middle, [0, 0]);
        assert_eq!((plan.kicks, plan.drifts, plan.middle_weights), (vec![half(1)], vec![half(2)], vec![half(1)]));
        assert_eq!(plan.evaluations, 1);
    }

    /// Orders for two, three and four parts are the orders for every A + B.
    #[test]
    fn orders_are_those_for_two_parts() {
        for name in ["symplectic-euler", "ruth3", "suzuki4", "yoshida4", "pefrl", "blanes-moan-s6", "saba2"] {
            let Some(proved) = shipped_proved(name) else { panic!("{name} is shipped") };
            let expected = proved.proof.general.order;
            for parts in [2, 3, 4] {
                let found = many_parts_order(&proved.scheme, parts, expected + 1);
                assert_eq!(found.order, expected, "{name}, {parts} parts: {found:?}");
            }
        }
    }

    /// 27/20 in place of 1.3512…; the value is from an independent program (exact fractions in Python).
    #[test]
    fn a_wrong_weight_fails_at_a_named_word() {
        let text =
            shipped("yoshida4").unwrap().text.replace("1/(2 - 2^(1/3))", "27/20").replace("order = 4", "order = 2");
        let source = Source { path: "mine.toml".to_owned(), text };
        let proved = read(&source, &|base, _| shipped(base)).unwrap();
        let found = many_parts_order(&proved.scheme, 3, 4);
        let (failed, value) = found.failed.expect("a condition fails");
        assert_eq!((found.order, failed.functional.to_string().as_str()), (2, "the word AAB"));
        assert_eq!(
            (value, failed.needed),
            (Rational::new(5323.into(), 32000.into()), Rational::new(1.into(), 6.into()))
        );
    }

    #[test]
    fn schemes_of_two_parts_only_are_refused() {
        let refused = |name: &str| shipped_proved(name).unwrap().for_many_parts().unwrap_err().to_string();
        assert_eq!(refused("chin-4a"), "chin-4a has gradient kicks, which are for T(p) and U(q) only");
        assert_eq!(
            refused("mclachlan-atela5"),
            "mclachlan-atela5 has order 5 for T(p) and U(q) with quadratic T only, for three parts and more order 3"
        );
        assert_eq!(
            refused("wisdom-corrector-5"),
            "wisdom-corrector-5 is a processed scheme, whose effective order is proved for two parts only"
        );
    }
}
