//! What is proved of a scheme, as its documentation, listings and pages say it.

use std::fmt::{self, Display, Formatter};

use crate::claims::HIGHEST_ORDER;
use crate::pipeline::Proved;
use crate::proof::Order;

/// The orders of a step, or of a processed step.
#[derive(Clone, Copy, Debug)]
pub struct Orders<'a> {
    /// For every T(p); `None` with gradient kicks, which there are for quadratic T only.
    pub general: Option<&'a Order>,
    /// For T = ½pᵀM⁻¹p.
    pub quadratic: &'a Order,
    /// For the terms of ε, ε², … of H = A + εB, as far as they are claimed.
    pub near_integrable: &'a [Order],
}

impl Proved {
    /// The orders of the steps: of a processed scheme those of its kernel.
    pub fn orders_of_steps(&self) -> Orders<'_> {
        let proof = &self.proof;
        let general = self.order_for_every_kinetic();
        Orders { general, quadratic: &proof.quadratic, near_integrable: &proof.near_integrable }
    }

    /// The orders of what is written: of a processed scheme the effective ones.
    pub fn orders(&self) -> Orders<'_> {
        let Some(effective) = &self.proof.effective else { return self.orders_of_steps() };
        let general = (!self.scheme.has_gradient_kicks()).then_some(&effective.general);
        Orders { general, quadratic: &effective.quadratic, near_integrable: &effective.near_integrable }
    }
}

impl Orders<'_> {
    /// The orders in the powers of ε as papers write them, `(8,6,4)`; nothing where none are claimed.
    pub fn in_epsilon(&self) -> String {
        let orders: Vec<_> = self.near_integrable.iter().map(|order| order.order.to_string()).collect();
        if orders.is_empty() { String::new() } else { format!("({})", orders.join(",")) }
    }

    /// The same as a part of a sentence: `, (8,6,4) for A + εB`.
    pub fn and_in_epsilon(&self) -> String {
        if self.near_integrable.is_empty() { String::new() } else { format!(", {} for A + εB", self.in_epsilon()) }
    }
}

/// `4 (exactly)`, `10 or more (to 248 digits)`
impl Display for Order {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let least = if self.failed.is_none() && self.order == HIGHEST_ORDER { " or more" } else { "" };
        write!(f, "{}{least} ({})", self.order, self.held())
    }
}

impl Order {
    /// How closely its conditions hold: `exactly`, `to 248 digits`.
    pub fn held(&self) -> String {
        held(self.digits)
    }
}

/// How closely something holds: `exactly`, `to 248 digits`.
pub fn held(digits: Option<u32>) -> String {
    digits.map_or_else(|| "exactly".to_owned(), |digits| format!("to {}", counted(digits, "digit")))
}

/// `1 kick`, `2 kicks`
pub fn counted<N: Copy + Display + PartialEq + From<u8>>(count: N, what: &str) -> String {
    format!("{count} {what}{}", if count == N::from(1) { "" } else { "s" })
}
