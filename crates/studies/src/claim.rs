//! Claims as data: texts of TOML → values, and charts by their texts.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Number, Value};
use toml::de::{DeTable, DeValue};

use crate::chart::{Axis, Chart, Curve, Mark};

/// What a text of TOML that is a part of this program has.
///
/// # Panics
/// If it is not TOML, has dates, or is of another form.
pub(crate) fn read<T: DeserializeOwned>(text: &str) -> T {
    let table = DeTable::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    serde_json::from_value(of_table(table.get_ref())).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn of_table(table: &DeTable<'_>) -> Value {
    let members = table.iter().map(|(key, value)| (key.get_ref().to_string(), of_value(value.get_ref())));
    Value::Object(members.collect::<Map<_, _>>())
}

fn of_value(value: &DeValue<'_>) -> Value {
    let number = |text: &str| text.replace('_', "").parse::<f64>().ok().and_then(Number::from_f64);
    match value {
        DeValue::String(text) => Value::String(text.to_string()),
        DeValue::Integer(number) => {
            Value::Number(number.as_str().replace('_', "").parse::<i64>().expect("whole numbers are decimal").into())
        }
        DeValue::Float(text) => Value::Number(number(text.as_str()).expect("numbers are finite")),
        DeValue::Boolean(flag) => Value::Bool(*flag),
        DeValue::Array(values) => values.iter().map(|value| of_value(value.get_ref())).collect(),
        DeValue::Table(table) => of_table(table),
        DeValue::Datetime(_) => panic!("claims have no dates"),
    }
}

/// A chart without its curves.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ChartTexts {
    /// Above it.
    pub(crate) title: String,
    /// The horizontal axis.
    pub(crate) x: AxisTexts,
    /// The vertical axis.
    pub(crate) y: AxisTexts,
    /// Below it.
    pub(crate) caption: String,
    /// As [`Chart::listed`].
    #[serde(default)]
    pub(crate) listed: bool,
    /// Values of x that matter, with their labels.
    #[serde(default)]
    pub(crate) marks: Vec<(f64, String)>,
}

/// An axis by one of the keys for its scale: `x.linear = "t"`.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub(crate) enum AxisTexts {
    /// With the values themselves.
    Linear(String),
    /// With decades.
    Log(String),
    /// With the values from one to another.
    Over(String, f64, f64),
}

impl AxisTexts {
    /// The axis.
    pub(crate) fn axis(&self) -> Axis {
        match self {
            AxisTexts::Linear(label) => Axis::linear(label),
            AxisTexts::Log(label) => Axis::log10(label),
            AxisTexts::Over(label, least, most) => Axis::linear(label).over(*least, *most),
        }
    }
}

impl ChartTexts {
    /// The chart of these curves.
    pub(crate) fn chart(&self, curves: Vec<Curve>) -> Chart {
        let marks = self.marks.iter().map(|(x, label)| Mark::at(*x, label)).collect();
        Chart { listed: self.listed, marks, ..Chart::new(&self.title, self.x.axis(), self.y.axis(), curves) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chart_is_read_with_its_axes() {
        let text = "title = \"Energy\"\nx.over = [\"t\", 0.0, 1_0]\ny.log = \"error\"\ncaption = \"\"\n";
        let chart = read::<ChartTexts>(text).chart(Vec::new());
        assert_eq!((chart.title.as_str(), chart.x.range, chart.y.range), ("Energy", Some((0.0, 10.0)), None));
    }
}
