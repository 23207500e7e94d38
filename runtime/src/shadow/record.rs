//! Estimator settings as a record for JSON and similar formats: the names and values of flags and scenes.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use shadowstep_schemes::symbolic::decimal::to_text;
use thiserror::Error;

use crate::exact;
use crate::shadow::options::{AccuracyError, EstimatorOptions, OptionConflict, UnknownWord, check_accuracy};
use crate::shadow::settings::EstimatorSettings;

/// The settings as written: `{"estimator": "bilinear", "order": "auto", "max_order": 64, "accuracy": "1/100000"}`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    estimator: String,
    order: Order,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    max_order: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    stop: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rule: Option<String>,
    /// An exact number as text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    accuracy: Option<String>,
}

/// A number, or `auto`.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(untagged)]
enum Order {
    Fixed(u32),
    Best(Auto),
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Auto {
    Auto,
}

/// Why a record is not valid.
#[derive(Debug, Error)]
enum RecordError {
    #[error("unknown estimator `{name}`; expected {}", EstimatorSettings::NAMES.join(" or "))]
    Name { name: String },
    #[error(transparent)]
    Conflict(#[from] OptionConflict),
    #[error("stop or rule: {0}")]
    Word(#[from] UnknownWord),
    #[error("accuracy: {0}")]
    Number(#[from] shadowstep_schemes::symbolic::Error),
    #[error("accuracy {0}")]
    Accuracy(#[from] AccuracyError),
}

impl Serialize for EstimatorSettings {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Record::from(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for EstimatorSettings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Record::deserialize(deserializer)?.settings().map_err(D::Error::custom)
    }
}

impl From<&EstimatorSettings> for Record {
    fn from(settings: &EstimatorSettings) -> Self {
        let options = settings.options();
        Record {
            estimator: settings.name().to_owned(),
            order: options.order.map_or(Order::Best(Auto::Auto), Order::Fixed),
            max_order: options.max_order,
            stop: options.stop.map(|stop| stop.to_string()),
            rule: options.rule.map(|rule| rule.to_string()),
            accuracy: options.accuracy.as_ref().map(to_text),
        }
    }
}

impl Record {
    fn settings(self) -> Result<EstimatorSettings, RecordError> {
        let accuracy = self.accuracy.as_deref().map(exact).transpose()?;
        accuracy.as_ref().map(check_accuracy).transpose()?;
        let options = EstimatorOptions {
            order: match self.order {
                Order::Fixed(order) => Some(order),
                Order::Best(Auto::Auto) => None,
            },
            max_order: self.max_order,
            stop: self.stop.as_deref().map(str::parse).transpose()?,
            rule: self.rule.as_deref().map(str::parse).transpose()?,
            accuracy,
        };
        EstimatorSettings::from_options(&self.estimator, options)?.ok_or(RecordError::Name { name: self.estimator })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_read_from_json_and_written_to_it() {
        for text in [
            r#"{"estimator":"central","order":4}"#,
            r#"{"estimator":"central","order":"auto","max_order":40,"stop":"early","rule":"robust"}"#,
            r#"{"estimator":"bilinear","order":"auto","max_order":64,"accuracy":"0.00001"}"#,
        ] {
            let settings: EstimatorSettings = serde_json::from_str(text).unwrap();
            assert_eq!(serde_json::to_string(&settings).unwrap(), text);
        }
    }

    #[test]
    fn records_that_are_not_valid_are_refused() {
        for (text, message) in [
            (r#"{"estimator":"hermite","order":4}"#, "unknown estimator `hermite`; expected bilinear or central"),
            (r#"{"estimator":"bilinear","order":4,"rule":"least"}"#, "rule requires order = auto, not order = 4"),
            (
                r#"{"estimator":"central","order":"auto","stop":"late"}"#,
                "stop or rule: expected full, early or printed",
            ),
            (
                r#"{"estimator":"bilinear","order":"auto","accuracy":"-1"}"#,
                "accuracy is not a valid target error: it must be positive",
            ),
            (r#"{"estimator":"central","order":4,"m":4}"#, "unknown field `m`"),
        ] {
            let error = serde_json::from_str::<EstimatorSettings>(text).unwrap_err().to_string();
            assert!(error.starts_with(message), "{error}");
        }
    }
}
