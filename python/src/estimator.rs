//! The estimator of the modified energy, from its options.

use pyo3::prelude::*;
use shadowstep::shadow::{EstimatorOptions, EstimatorSettings, SelectionRule, StoppingRule, check_accuracy};
use shadowstep_scenes::Error;
use shadowstep_scenes::estimator::{ACCURACY_HINT, conflict};

use crate::errors::{exception, usage};
use crate::given::number;

/// The options of an estimator; what is not given has its default.
#[derive(FromPyObject)]
pub(crate) struct Options {
    #[pyo3(item)]
    name: String,
    #[pyo3(item)]
    order: Option<u32>,
    #[pyo3(item)]
    max_order: Option<u32>,
    #[pyo3(item)]
    stop: Option<String>,
    #[pyo3(item)]
    rule: Option<String>,
    #[pyo3(item)]
    accuracy: Option<String>,
}

impl Options {
    pub(crate) fn settings(self, py: Python<'_>) -> PyResult<EstimatorSettings> {
        let Options { name, order, max_order, .. } = self;
        for (option, value) in [("order", order), ("max_order", max_order)] {
            let highest = EstimatorSettings::highest_order(&name);
            if let Some((value, highest)) = value.zip(highest).filter(|(value, highest)| value > highest) {
                let message = format!("{option} = {value} is above {highest}, the largest order of {name}");
                return Err(usage(py, message, format!("give {highest} or less")));
            }
        }
        let stop = word::<StoppingRule>(py, "stop", self.stop, StoppingRule::NAMES)?;
        let rule = word::<SelectionRule>(py, "rule", self.rule, SelectionRule::NAMES)?;
        let accuracy = self.accuracy.map(|text| accuracy(py, &text)).transpose()?;
        let options = EstimatorOptions { order, max_order, stop, rule, accuracy };
        match EstimatorSettings::from_options(&name, options) {
            Ok(Some(settings)) => Ok(settings),
            Ok(None) => {
                let names = EstimatorSettings::NAMES.join(", ");
                Err(usage(py, format!("there is no estimator `{name}`"), format!("it is one of {names}")))
            }
            Err(error) => {
                let (message, hint) = conflict(&error, error.option, |name, value| format!("{name} = {value}"));
                Err(exception(py, Error::usage(message, hint)))
            }
        }
    }
}

fn word<T: std::str::FromStr>(
    py: Python<'_>,
    option: &str,
    text: Option<String>,
    names: &[&str],
) -> PyResult<Option<T>> {
    let Some(text) = text else { return Ok(None) };
    match text.parse() {
        Ok(found) => Ok(Some(found)),
        Err(_) => {
            Err(usage(py, format!("{option} = {text} is not known"), format!("it is one of {}", names.join(", "))))
        }
    }
}

fn accuracy(py: Python<'_>, text: &str) -> PyResult<shadowstep::Rational> {
    let accuracy = number(py, "accuracy", text)?;
    check_accuracy(&accuracy).map_err(|error| usage(py, format!("accuracy = {text} {error}"), ACCURACY_HINT))?;
    Ok(accuracy)
}
