//! What an estimator declares of itself, so that it can be selected by name.

use crate::shadow::options::EstimatorOptions;

/// A family of estimators, with the settings that it is built from.
pub(super) trait Family: Sized {
    /// Its name in flags, scenes and JSON.
    const NAME: &'static str;
    /// What it computes, in a line of help.
    const SUMMARY: &'static str;
    /// The letter of its order: m or k.
    const LETTER: &'static str;
    /// The highest order in flags and scenes.
    const HIGHEST_ORDER: u32;
    /// The options that it has besides the order, where the order is `auto`.
    const AUTO_OPTIONS: &'static [&'static str];

    /// The settings, from options that do not conflict.
    fn from_options(options: EstimatorOptions) -> Self;

    /// The options that give these settings.
    fn options(&self) -> EstimatorOptions;

    /// Sets whether the error is estimated as well, where that is optional.
    fn set_errors(&mut self, wanted: bool);

    /// Whether the values belong to the times between the states.
    fn is_between(&self) -> bool;

    /// What it is, for people: `central differences, m = 4`.
    fn description(&self) -> String;
}
