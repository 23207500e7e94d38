//! Facts about schemes, as records and people have them.

use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{Kinetic, Proof};

/// How many digits of the weights are right; `None` for all.
pub(super) fn digits(held: Held) -> Option<u32> {
    match held {
        Held::Exactly => None,
        Held::Digits(digits) => Some(digits),
    }
}

/// As people read it.
pub(super) fn digits_text(digits: Option<u32>) -> String {
    digits.map_or_else(|| "exact".to_owned(), |digits| digits.to_string())
}

/// Other names under which the scheme is known.
pub(super) fn aliases(table: &Table) -> Vec<String> {
    table.aliases.iter().map(|alias| alias.value.clone()).collect()
}

/// The orders for H = A + εB, of the terms of ε, ε², ….
pub(super) fn near_integrable(proof: &Proof) -> Vec<u32> {
    proof.near_integrable.iter().map(|order| order.order).collect()
}

/// The effective orders of a processed scheme for H = A + εB; of another scheme none.
pub(super) fn effective_near_integrable(proof: &Proof) -> Vec<u32> {
    proof.effective.iter().flat_map(|effective| &effective.near_integrable).map(|order| order.order).collect()
}

/// As papers write them: (8,6,4).
pub(super) fn near_integrable_text(orders: &[u32]) -> String {
    if orders.is_empty() {
        return String::new();
    }
    format!("({})", orders.iter().map(u32::to_string).collect::<Vec<_>>().join(","))
}

/// What the orders of a near-integrable scheme are worth, and what they need.
pub(super) const NEAR_INTEGRABLE: &str = "\
A + εB: orders such as (8,4) mean errors of ε h^8 and ε² h^4. They pay only if the drift solves A exactly and εB is small, as where \
drifts are Kepler orbits and kicks the attractions of planets: scenes with parts = \"wisdom-holman\". With T and U as parts nothing is \
small, and they gain nothing.";

/// As tables write it.
pub(super) fn kinetic(kinetic: Kinetic) -> &'static str {
    match kinetic {
        Kinetic::Any => "any",
        Kinetic::Quadratic => "quadratic",
    }
}
