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

/// At least as many states as its estimates with errors need before 0, and after the last one. Building the estimator
/// would give the number itself, but takes seconds for a large k.
pub(crate) fn most_reach(settings: &EstimatorSettings) -> usize {
    (states(settings) / 2.0 + largest_order(settings).sqrt()).ceil() as usize + 4
}

/// About how many microseconds one estimate takes with 120 digits.
pub(crate) fn cost(settings: &EstimatorSettings, dimension: usize) -> f64 {
    let (order, numbers) = (largest_order(settings), 2.0 * dimension as f64 + 1.0);
    match settings.order() {
        _ if is_bilinear(settings) => 0.06 * order * (numbers + order / 2.0),
        Some(_) => 0.1 * order * numbers,
        None => 0.19 * order * numbers,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::StepSize;
    use shadowstep::shadow::{BuildEstimator, Estimator};

    #[test]
    fn no_estimator_needs_more_states() {
        let h = StepSize::try_from("1/10").unwrap();
        let all = [1, 2, 3, 8, 50, 100].map(bilinear).into_iter().chain([2, 40, 200].map(central)).chain([BEST]);
        for settings in all.map(|settings| settings.with_errors(true)) {
            let built = BuildEstimator::<f64>::build(&settings, &h, 1, &()).unwrap();
            assert!((built.states() - 1) / 2 <= most_reach(&settings), "{settings}");
        }
    }
}
