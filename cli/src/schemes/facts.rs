//! What the list says of kinds of schemes.

/// What the orders of a near-integrable scheme are worth, and what they need.
pub(super) const NEAR_INTEGRABLE: &str = "\
A + εB: orders such as (8,4) mean errors of ε h^8 and ε² h^4. They pay only if the drift solves A exactly and εB is \
small, as where drifts are Kepler orbits and kicks the attractions of planets: scenes with parts = \"wisdom-holman\". \
With T and U as parts nothing is small, and they gain nothing.";

/// What the numbers of schemes with multiple time steps are of.
pub(super) fn nested_text(names: &[&str]) -> String {
    format!(
        "{}: multiple time steps, for slow forces, fast forces and T. The numbers are those of the outer scheme, \
         whose forces are the slow ones; `schemes show` has the others.",
        names.join(", ")
    )
}
