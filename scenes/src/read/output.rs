//! [output]: what is written, where, and how often.

use std::time::Duration;

use shadowstep::Rational;
use shadowstep::shadow::{
    EstimatorOptions, EstimatorSettings, HIGHEST_ORDER, SelectionRule, StoppingRule, Verdict, check_accuracy,
};
use toml::de::DeValue;

use super::modified_hamiltonian;
use super::period::every;
use super::plot;
use super::reader::Reader;
use super::run::Steps;
use super::values;
use crate::estimator::{ACCURACY_HINT, conflict};
use crate::reserved_names::LISTS;
use crate::run::Run;
use crate::scene::{CheckpointInterval, Direction, Format, Outputs, Surface, System};
use crate::steps::MOST_STEPS;
use shadowstep_schemes::document::{Section, Value};

/// What is to be written, and where.
pub(super) fn read(
    reader: &mut Reader<'_>,
    output: &Section<'_, '_>,
    system: Option<&System>,
    steps: Option<&Steps>,
) -> Option<Outputs> {
    let before = reader.toml.faults.len();
    let file = output.get("file").and_then(|value| reader.toml.text(value));
    let format = output
        .get("format")
        .map(|value| reader.word(value, &[("csv", Format::Csv), ("jsonl", Format::JsonLines), ("npy", Format::Numpy)]));
    let energy = every(reader, output, "energy", "output.energy").map(|(every, _)| every);
    let modified_energy = modified_energy(reader, output);
    let (trajectory, section) = trajectory(reader, output, system);
    let values = values::columns(reader, output, system, steps);
    let extremes = values::extremes(reader, output, system);
    let chaos = every(reader, output, "chaos", "output.chaos").map(|(every, _)| every);
    let summary = output.get("summary").and_then(|value| reader.toml.truth(value)).is_none_or(|truth| truth.value);
    let windows = output
        .get("windows")
        .map_or(Some(Run::WINDOWS), |value| reader.whole(value, Verdict::LEAST_WINDOWS..=MOST_STEPS));
    let checkpoint = output.get("checkpoint").map(|value| (value.span(), interval(reader, value)));
    if let (Some((at, _)), None) = (&checkpoint, output.get("file")) {
        reader.toml.fault(at, "a checkpoint requires a file", "add `file = \"out.csv\"`");
    }
    if let Some(name) = file.as_ref().filter(|name| name.value.ends_with(['/', '\\'])) {
        reader.toml.fault(&name.at, format!("`{}` is a folder", name.value), "give the name of a file");
    }
    let format = match (format, &file) {
        (Some(format), _) => format,
        (None, None) => Some(Format::Csv),
        (None, Some(name)) => Format::of(&name.value).or_else(|| {
            let message = format!("the name `{}` does not give the format", name.value);
            reader.toml.wrong(&name.at, message, "use the ending .csv, .jsonl or .npy, or add `format = \"csv\"`")
        }),
    };
    let file = file.and_then(|name| Some((reader.path(&name)?, name.at)));
    let checkpoint = checkpoint.and_then(|(_, interval)| interval);
    let format = format?;
    if format == Format::Numpy {
        check_numpy(reader, output);
    }
    let mut outputs = Outputs {
        file,
        format,
        energy,
        modified_energy,
        trajectory,
        section,
        values,
        extremes,
        chaos,
        checkpoint,
        summary,
        windows: windows.unwrap_or(Run::WINDOWS),
        plot: None,
    };
    // those of a system or a scheme that is left out
    let has_others = reader.is_cursory && output.get(modified_hamiltonian::KEY).is_some();
    if !outputs.has_rows()
        && !has_others
        && outputs.extremes.is_empty()
        && reader.toml.faults.len() == before
        && output.is_there()
    {
        let help = "add `energy = true`, `modified_energy = true` or `trajectory = true`";
        reader.toml.fault(&output.at, "no output is selected", help);
    }
    for key in ["extremes", "windows"] {
        if let (false, Some(value)) = (summary, output.get(key)) {
            let message = format!("{key} are in the summary, and `summary = false`");
            reader.toml.fault(&value.span(), message, "remove one of the two");
        }
    }
    refuse_names_of_lists(reader, &outputs);
    outputs.plot = plot::read(reader, output, system, &outputs);
    Some(outputs)
}

/// Refuses columns of values with the names that q and p have, where rows have these as lists.
fn refuse_names_of_lists(reader: &mut Reader<'_>, outputs: &Outputs) {
    if outputs.format == Format::Csv || !outputs.has_states() {
        return;
    }
    for column in outputs.named_values().filter(|column| LISTS.contains(&column.name.as_str())) {
        let message = format!("`{}` is the name of the list of positions or momenta in these rows", column.name);
        reader.toml.fault(&column.at, message, "give this column another name");
    }
}

/// Refuses records of NumPy where they would lose digits, or cannot be written.
fn check_numpy(reader: &mut Reader<'_>, output: &Section<'_, '_>) {
    let at =
        ["format", "file"].into_iter().find_map(|key| output.get(key)).map_or(output.at.clone(), |value| value.span());
    if output.get("file").is_none() {
        reader.toml.fault(&at, "records of NumPy require a file", "add `file = \"out.npy\"`");
    }
    if reader.arithmetic.is_longer_than_double() {
        let message = format!("records of NumPy have double precision, not {}", reader.arithmetic.described());
        reader.toml.fault(&at, message, "write a file of .csv or .jsonl");
    }
}

/// The period of states, or the surface at whose crossings they are.
fn trajectory(
    reader: &mut Reader<'_>,
    output: &Section<'_, '_>,
    system: Option<&System>,
) -> (Option<u64>, Option<Surface>) {
    let Some((every, table)) = every(reader, output, "trajectory", "output.trajectory") else { return (None, None) };
    let direction = table.as_ref().and_then(|table| table.get("direction"));
    let direction = direction.map(|value| (value.span(), reader.word(value, &Direction::NAMES)));
    let Some((table, value)) = table.as_ref().and_then(|table| Some((table, table.get("section")?))) else {
        if let Some((at, Some(_))) = direction {
            reader.toml.fault(&at, "a direction requires a section", "add `section = \"x\"`");
        }
        return (Some(every), None);
    };
    if table.get("every").is_some() {
        reader.toml.fault(&value.span(), "every and section are both given", "keep one of the two");
    }
    if let Some(value) = output.get("modified_energy") {
        let help = "remove it, and run the scene again without `section` for modified energies";
        reader.toml.fault(&value.span(), "rows of a section have no modified energy", help);
    }
    let direction = direction.map_or(Some(Direction::Up), |(_, direction)| direction);
    (None, direction.and_then(|direction| surface(reader, value, direction, system)))
}

fn surface(
    reader: &mut Reader<'_>,
    value: &Value<'_>,
    direction: Direction,
    system: Option<&System>,
) -> Option<Surface> {
    let text = reader.toml.text(value)?;
    system?.surface(text, direction, &mut reader.toml)
}

fn modified_energy(reader: &mut Reader<'_>, output: &Section<'_, '_>) -> Option<(EstimatorSettings, u64)> {
    let (every, table) = every(reader, output, "modified_energy", "output.modified_energy")?;
    let mut options = EstimatorOptions::default();
    let mut name = EstimatorSettings::NAMES[0];
    if let Some(table) = &table {
        let before = reader.toml.faults.len();
        if let Some(value) = table.get("estimator") {
            name = reader.word(value, &words(EstimatorSettings::NAMES))?;
        }
        options.order = table.get("order").and_then(|value| order(reader, value, name));
        options.max_order = table.get("max_order").and_then(|value| up_to(reader, value, 2, name));
        let stop = table.get("stop").and_then(|value| reader.word(value, &words(StoppingRule::NAMES)));
        options.stop = stop.and_then(|word| word.parse().ok());
        let rule = table.get("rule").and_then(|value| reader.word(value, &words(SelectionRule::NAMES)));
        options.rule = rule.and_then(|word| word.parse().ok());
        options.accuracy = table.get("accuracy").and_then(|value| accuracy(reader, value));
        if reader.toml.faults.len() > before {
            return None;
        }
    }
    match EstimatorSettings::from_options(name, options) {
        Ok(settings) => settings.map(|settings| (settings, every)),
        Err(error) => {
            let assigned = |name: &str, value: &str| match value.parse::<u32>() {
                Ok(number) => format!("{name} = {number}"),
                Err(_) => format!("{name} = \"{value}\""),
            };
            let (message, help) = conflict(&error, error.option, assigned);
            let table = table?;
            let at = table.get(error.option).map_or(table.at.clone(), |value| value.span());
            reader.toml.wrong(&at, message, help)
        }
    }
}

/// Words that stand for themselves.
fn words(names: &[&'static str]) -> Vec<(&'static str, &'static str)> {
    names.iter().map(|name| (*name, *name)).collect()
}

/// A fixed order; none for "auto".
fn order(reader: &mut Reader<'_>, value: &Value<'_>, estimator: &str) -> Option<u32> {
    if !matches!(value.get_ref(), DeValue::Integer(_)) {
        reader.word(value, &[("auto", ())]);
        return None;
    }
    let order = up_to(reader, value, 1, estimator)?;
    let options = EstimatorOptions { order: Some(order), ..Default::default() };
    let settings = EstimatorSettings::from_options(estimator, options).ok().flatten();
    if settings.is_some_and(|settings| settings.is_between()) {
        let message = "with estimator = \"bilinear\" and an odd order the values are at times between the states";
        return reader.toml.wrong(&value.span(), message, "write an even order");
    }
    Some(order)
}

/// The m of a central difference, or the k of E_k.
fn up_to(reader: &mut Reader<'_>, value: &Value<'_>, least: u64, estimator: &str) -> Option<u32> {
    let highest = EstimatorSettings::highest_order(estimator).unwrap_or(HIGHEST_ORDER);
    reader.whole(value, least..=highest.into()).and_then(|m| u32::try_from(m).ok())
}

fn accuracy(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Rational> {
    let text = reader.number(value)?;
    let accuracy = reader.evaluate(&text)?.value;
    match check_accuracy(&accuracy) {
        Ok(()) => Some(accuracy),
        Err(error) => reader.toml.wrong(&text.at, format!("accuracy {} {error}", text.value), ACCURACY_HINT),
    }
}

/// A number of steps, or a time such as `1 min`.
fn interval(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<CheckpointInterval> {
    if matches!(value.get_ref(), DeValue::Integer(_)) {
        return reader.whole(value, 1..=MOST_STEPS).map(CheckpointInterval::Steps);
    }
    if !matches!(value.get_ref(), DeValue::String(_)) {
        return reader.toml.wrong_kind(value, "a time such as \"1 min\", or a number of steps");
    }
    let text = reader.toml.text(value)?;
    let found = duration(text.value.trim());
    if found.is_none() {
        let message = format!("`{}` is not a valid time between checkpoints", text.value);
        reader.toml.fault(&text.at, message, "write a time in s, min or h such as \"1 min\", or a number of steps");
    }
    found.map(CheckpointInterval::Time)
}

fn duration(text: &str) -> Option<Duration> {
    let (number, unit) = text.split_at(text.find(|c: char| c.is_ascii_alphabetic())?);
    let seconds = match unit {
        "s" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        _ => return None,
    };
    let number: f64 = number.trim().parse().ok()?;
    Duration::try_from_secs_f64(number * seconds).ok().filter(|time| !time.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use shadowstep::tables::{Faults, Source};

    fn with(output: &str) -> Result<Scene, Faults> {
        let text = format!(
            "problem.name = \"pendulum\"\nrun = {{ scheme = \"yoshida4\", step = \"1/10\", steps = 9000 }}\n[output]\nenergy = {{ every = 100 }}\n{output}\n"
        );
        Scene::read(Source { path: "test.toml".to_owned(), text })
    }

    #[test]
    fn a_summary_has_the_windows_that_are_wanted() {
        // each 35, 562 and 3 steps; the last 8 states end no window of 17
        for (output, expected) in [("", 257), ("windows = 16", 16), ("windows = 3000", 2992)] {
            struct Windows(u64);
            impl crate::Observer for Windows {
                fn summarises(&self) -> bool {
                    true
                }
                fn summary(&mut self, summary: &crate::Summary) {
                    self.0 = summary.modified_energy().map_or(0, |found| found.windows);
                }
            }
            let mut windows = Windows(0);
            with(output).unwrap().run_into(&mut Vec::new(), &mut windows).unwrap();
            assert_eq!(windows.0, expected, "{output}");
        }
        let message = |output: &str| with(output).unwrap_err().0[0].message.clone();
        assert_eq!(message("windows = 15"), "15 is out of range");
        assert_eq!(message("windows = 100\nsummary = false"), "windows are in the summary, and `summary = false`");
    }

    #[test]
    fn durations() {
        for (text, seconds) in [("1 min", 60.0), ("30 s", 30.0), ("2h", 7200.0), ("0.5 min", 30.0)] {
            assert_eq!(duration(text), Some(Duration::from_secs_f64(seconds)), "{text}");
        }
        for wrong in ["", "1", "min", "1 m", "0 s", "-1 s", "1e99 h", "1 min 3"] {
            assert_eq!(duration(wrong), None, "{wrong}");
        }
    }
}
