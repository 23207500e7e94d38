//! What the drawings of several figures need.

use shadowstep_studies::chart::Axis;
use shadowstep_studies::finding::Finding;

/// The axis of drifts over [0, 100].
pub(crate) fn drift_axis() -> Axis {
    Axis::log10("drift of the modified energy over [0, 100]")
}

/// An additional figure, which the paper does not have.
pub(crate) fn additional(what: &str) -> Finding {
    Finding { found: vec![what.to_owned()], ..Finding::default() }
}

/// By how much a result changes when it is computed with 200 digits.
pub(crate) fn digits_held(finding: &mut Finding, what: &str, held: Option<f64>) {
    if let Some(held) = held {
        let change =
            if held.is_finite() { format!("changes by about 1e-{held:.0}") } else { "does not change".to_owned() };
        finding.found(format!("Recomputed with 200 digits, {what} {change}."));
    }
}
