//! The estimators of figures, with what they cost.

use shadowstep::shadow::{Bilinear, Central, EstimatorSettings, SelectionRule, StoppingRule};

/// The estimator of the paper's figures: the best m of each state, up to 200.
pub(crate) const BEST: EstimatorSettings = EstimatorSettings::Central(Central::Best {
    largest: 200,
    stop: StoppingRule::Full,
    rule: SelectionRule::Least,
    with_error: false,
});

/// D_m
pub(crate) fn central(m: u32) -> EstimatorSettings {
    Central::fixed(m).into()
}

/// D_m with the m of each state that has the smallest last term, as in the paper.
pub(crate) fn best(largest: u32, stop: StoppingRule) -> EstimatorSettings {
    Central::best(largest, stop).into()
}

/// E_k
pub(crate) fn bilinear(k: u32) -> EstimatorSettings {
    Bilinear::new(k).into()
}

/// Whether it is the bilinear estimator, whose drifts come with the permanent change and thus with estimated errors.
pub(crate) fn is_bilinear(settings: &EstimatorSettings) -> bool {
    matches!(settings, EstimatorSettings::Bilinear(_))
}

/// The order, or the largest order that is tried.
fn largest_order(settings: &EstimatorSettings) -> f64 {
    f64::from(settings.order().or(settings.max_order()).unwrap_or(1))
}

/// About how many states one estimate uses.
pub(crate) fn states(settings: &EstimatorSettings) -> f64 {
    let order = largest_order(settings);
    if is_bilinear(settings) { order + 1.0 } else { 2.0 * order + 1.0 }
}

/// About how many multiplications of numbers it makes per step and coordinate.
pub(crate) fn cost(settings: &EstimatorSettings) -> f64 {
    let order = largest_order(settings);
    match settings.order() {
        _ if is_bilinear(settings) => 4.0 * order + order * order / 2.0,
        Some(_) => 6.0 * order,
        None => 12.0 * order,
    }
}
