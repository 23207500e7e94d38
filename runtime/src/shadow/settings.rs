//! Which estimator with which settings, as one value: the list of all estimators.

use std::fmt;

use crate::number::Real;
use crate::shadow::bilinear::Bilinear;
use crate::shadow::central::Central;
use crate::shadow::estimator::{BuildEstimator, Estimator, EstimatorError};
use crate::shadow::family::Family;
use crate::shadow::options::{EstimatorOptions, OptionConflict};
use crate::steps::step_size::StepSize;

/// Defines [`EstimatorSettings`] with one variant for each family of estimators.
macro_rules! estimators {
    ($($(#[$doc:meta])* $family:ident),* $(,)?) => {
        /// Which estimator of the modified energy, with which settings.
        ///
        /// ```
        /// use shadowstep::shadow::{EstimatorOptions, EstimatorSettings};
        ///
        /// let options = EstimatorOptions { order: Some(24), ..Default::default() };
        /// let settings = EstimatorSettings::from_options("bilinear", options)?.unwrap();
        /// assert_eq!(settings.to_string(), "products of 25 states, k = 24");
        ///
        /// let options = EstimatorOptions { max_order: Some(64), order: Some(24), ..Default::default() };
        /// let conflict = EstimatorSettings::from_options("bilinear", options).unwrap_err();
        /// assert_eq!(conflict.to_string(), "max_order requires order = auto, not order = 24");
        /// # Ok::<(), shadowstep::shadow::OptionConflict>(())
        /// ```
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub enum EstimatorSettings {
            $($(#[$doc])* $family($family),)*
        }

        impl EstimatorSettings {
            /// The names of all estimators; the first is the default.
            pub const NAMES: &'static [&'static str] = &[$($family::NAME),*];

            /// What each estimator computes, in the order of the names.
            pub const SUMMARIES: &'static [&'static str] = &[$($family::SUMMARY),*];

            /// The estimator of a name with these options; `None` if there is no such name.
            ///
            /// # Errors
            /// Options that exclude each other.
            pub fn from_options(name: &str, options: EstimatorOptions) -> Result<Option<Self>, OptionConflict> {
                match name {
                    $($family::NAME => {
                        check::<$family>(&options)?;
                        Ok(Some(EstimatorSettings::$family($family::from_options(options))))
                    })*
                    _ => Ok(None),
                }
            }

            /// The highest m or k of an estimator in flags and scenes; `None` if there is no such name.
            pub fn highest_order(name: &str) -> Option<u32> {
                match name {
                    $($family::NAME => Some($family::HIGHEST_ORDER),)*
                    _ => None,
                }
            }

            /// Names with the options that each has where its order is `auto`.
            const AUTO_OPTIONS: &'static [(&'static str, &'static [&'static str])] =
                &[$(($family::NAME, $family::AUTO_OPTIONS)),*];

            /// Its name.
            pub fn name(&self) -> &'static str {
                match self { $(EstimatorSettings::$family(_) => $family::NAME,)* }
            }

            /// The letter of its order: m or k.
            pub fn letter(&self) -> &'static str {
                match self { $(EstimatorSettings::$family(_) => $family::LETTER,)* }
            }

            /// The options that give these settings.
            pub fn options(&self) -> EstimatorOptions {
                match self { $(EstimatorSettings::$family(family) => family.options(),)* }
            }

            /// The same estimator, which estimates its error only if that is wanted, or if it selects its order by it.
            #[must_use]
            pub fn with_errors(mut self, wanted: bool) -> Self {
                match &mut self { $(EstimatorSettings::$family(family) => family.set_errors(wanted),)* }
                self
            }

            /// Whether the values belong to the times between the states.
            pub fn is_between(&self) -> bool {
                match self { $(EstimatorSettings::$family(family) => family.is_between(),)* }
            }
        }

        impl fmt::Display for EstimatorSettings {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&match self { $(EstimatorSettings::$family(family) => family.description(),)* })
            }
        }

        impl<N: Real + 'static> BuildEstimator<N> for EstimatorSettings {
            type Estimator = Box<dyn Estimator<N>>;

            fn build(
                &self,
                h: &StepSize,
                dimension: usize,
                context: &N::Context,
            ) -> Result<Self::Estimator, EstimatorError> {
                Ok(match self {
                    $(EstimatorSettings::$family(family) => Box::new(family.build(h, dimension, context)?),)*
                })
            }
        }

        $(impl From<$family> for EstimatorSettings {
            fn from(family: $family) -> Self {
                EstimatorSettings::$family(family)
            }
        })*
    };
}

estimators! {
    /// The bilinear estimator E_k.
    Bilinear,
    /// Central differences D_m.
    Central,
}

impl EstimatorSettings {
    /// Its m or k, if this is fixed.
    pub fn order(&self) -> Option<u32> {
        self.options().order
    }

    /// The largest order that is tried, if the order is not fixed.
    pub fn max_order(&self) -> Option<u32> {
        self.options().max_order
    }

    /// Whether it can estimate its error; a series of one term cannot.
    pub fn gives_errors(&self) -> bool {
        self.order() != Some(1)
    }
}

/// The first option that a family does not have with this order.
fn check<F: Family>(options: &EstimatorOptions) -> Result<(), OptionConflict> {
    let others = || options.names().into_iter().filter(|name| *name != "order");
    if let Some(order) = options.order {
        return match others().next() {
            Some(option) => {
                Err(OptionConflict { option, setting: "order", required: "auto", found: order.to_string() })
            }
            None => Ok(()),
        };
    }
    match others().find(|name| !F::AUTO_OPTIONS.contains(name)) {
        Some(option) => {
            Err(OptionConflict { option, setting: "estimator", required: having(option), found: F::NAME.to_owned() })
        }
        None => Ok(()),
    }
}

/// The first estimator that has an option.
fn having(option: &str) -> &'static str {
    let mut families = EstimatorSettings::AUTO_OPTIONS.iter();
    families.find(|(_, options)| options.contains(&option)).map_or(EstimatorSettings::NAMES[0], |(name, _)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact;
    use crate::shadow::differences::{SelectionRule, StoppingRule};

    #[test]
    fn options_give_the_settings_that_gave_them() {
        let all: [EstimatorSettings; 5] = [
            Central::fixed(4).into(),
            Central::best(40, StoppingRule::Early).into(),
            Bilinear::new(24).into(),
            Bilinear::best(64).into(),
            Bilinear::best_to(32, exact("1e-20").unwrap()).into(),
        ];
        for settings in all {
            assert_eq!(EstimatorSettings::from_options(settings.name(), settings.options()), Ok(Some(settings)));
        }
        assert_eq!(EstimatorSettings::from_options("hermite", EstimatorOptions::default()), Ok(None));
    }

    #[test]
    fn options_that_an_estimator_does_not_have_conflict() {
        let rule = EstimatorOptions { rule: Some(SelectionRule::Robust), ..Default::default() };
        let accuracy = EstimatorOptions { accuracy: exact("1e-9").ok(), ..Default::default() };
        let sentence = |name, options: &EstimatorOptions| {
            EstimatorSettings::from_options(name, options.clone()).unwrap_err().to_string()
        };
        assert_eq!(sentence("bilinear", &rule), "rule requires estimator = central, not estimator = bilinear");
        assert_eq!(sentence("central", &accuracy), "accuracy requires estimator = bilinear, not estimator = central");
        let fixed = EstimatorOptions { order: Some(4), ..accuracy };
        assert_eq!(sentence("bilinear", &fixed), "accuracy requires order = auto, not order = 4");
    }
}
