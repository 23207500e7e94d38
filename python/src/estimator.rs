//! The estimator of the modified energy, from its options.

use std::str::FromStr;

use pyo3::prelude::*;
use shadowstep::shadow::{EstimatorOptions, EstimatorSettings, SelectionRule, StoppingRule, check_accuracy};
use shadowstep_scenes::estimator::{ACCURACY_HINT, conflict};

use crate::errors::{Fallible, usage};
use crate::given::number;

/// The options of an estimator; what is not given has its default.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    name: String,
    order: Option<u32>,
    max_order: Option<u32>,
    stop: Option<String>,
    rule: Option<String>,
    accuracy: Option<String>,
}

impl Options {
    pub(crate) fn settings(&self) -> Fallible<EstimatorSettings> {
        let Options { name, order, max_order, stop, rule, accuracy } = self;
        let (order, max_order) = (*order, *max_order);
        for (option, value) in [("order", order), ("max_order", max_order)] {
            let highest = EstimatorSettings::highest_order(name);
            if let Some((value, highest)) = value.zip(highest).filter(|(value, highest)| value > highest) {
                let message = format!("{option} = {value} is above {highest}, the largest order of {name}");
                return Err(usage(message, format!("give {highest} or less")));
            }
        }
        let stop = word::<StoppingRule>("stop", stop.as_ref(), StoppingRule::NAMES)?;
        let rule = word::<SelectionRule>("rule", rule.as_ref(), SelectionRule::NAMES)?;
        let accuracy = accuracy.as_ref().map(|text| -> Fallible<_> {
            let accuracy = number("accuracy", text)?;
            check_accuracy(&accuracy).map_err(|error| usage(format!("accuracy = {text} {error}"), ACCURACY_HINT))?;
            Ok(accuracy)
        });
        let options = EstimatorOptions { order, max_order, stop, rule, accuracy: accuracy.transpose()? };
        match EstimatorSettings::from_options(name, options) {
            Ok(Some(settings)) => Ok(settings),
            Ok(None) => {
                let names = EstimatorSettings::NAMES.join(", ");
                Err(usage(format!("there is no estimator `{name}`"), format!("it is one of {names}")))
            }
            Err(error) => {
                let (message, hint) = conflict(&error, error.option, |name, value| format!("{name} = {value}"));
                Err(usage(message, hint))
            }
        }
    }
}

fn word<T: FromStr>(option: &str, text: Option<&String>, names: &[&str]) -> Fallible<Option<T>> {
    let unknown = |text| usage(format!("{option} = {text} is not known"), format!("it is one of {}", names.join(", ")));
    text.map(|text| text.parse().map_err(|_| unknown(text))).transpose()
}
