//! [output]: what is written, where, and how often.

use std::time::Duration;

use shadowstep::Rational;
use shadowstep::shadow::{EstimatorOptions, EstimatorSettings, HIGHEST_ORDER, check_accuracy};
use shadowstep_schemes::document::Text;
use shadowstep_schemes::symbolic::Exact;

use super::modified_hamiltonian;
use super::plot;
use super::reader::Reader;
use super::run::Steps;
use super::values;
use crate::document::reserved_names::LISTS;
use crate::document::schema::Table;
use crate::run::Run;
use crate::run::estimator::{ACCURACY_HINT, conflict};
use crate::scene::{CheckpointInterval, Direction, Format, Outputs, Surface, System};

/// What is to be written, and where.
pub(super) fn read(
    reader: &mut Reader<'_>,
    output: &Table<'_, '_>,
    system: Option<&System>,
    steps: Option<&Steps>,
) -> Option<Outputs> {
    let before = reader.toml.faults.len();
    let file = output.text("file");
    let period = |key| output.every(key).map(|(every, _)| every);
    let modified_energy = modified_energy(reader, output);
    let (trajectory, section) = trajectory(reader, output, system);
    let values = values::columns(reader, output, system, steps);
    let extremes = values::extremes(reader, output, system);
    let summary = output.truth("summary").unwrap_or(true);
    let checkpoint = interval(reader, output);
    let format = format(reader, output, file.as_ref());
    let file = file.and_then(|name| Some((reader.path(&name)?, name.at)));
    let format = format?;
    let mut outputs = Outputs {
        file,
        format,
        energy: period("energy"),
        modified_energy,
        trajectory,
        section,
        values,
        extremes,
        chaos: period("chaos"),
        checkpoint,
        summary,
        windows: output.whole("windows").unwrap_or(Run::WINDOWS),
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

/// The format, by its key or by the name of the file.
fn format(reader: &mut Reader<'_>, output: &Table<'_, '_>, file: Option<&Text>) -> Option<Format> {
    if let Some(name) = file.filter(|name| name.value.ends_with(['/', '\\'])) {
        reader.toml.fault(&name.at, format!("`{}` is a folder", name.value), "give the name of a file");
    }
    let format = match (output.word("format", &Format::NAMES), file) {
        (Some(format), _) => Some(format),
        (None, None) => Some(Format::Csv),
        (None, Some(name)) => Format::of(&name.value).or_else(|| {
            let message = format!("the name `{}` does not give the format", name.value);
            reader.toml.wrong(&name.at, message, "use the ending .csv, .jsonl or .npy, or add `format = \"csv\"`")
        }),
    };
    if format == Some(Format::Numpy) {
        check_numpy(reader, output);
    }
    format
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
fn check_numpy(reader: &mut Reader<'_>, output: &Table<'_, '_>) {
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
    output: &Table<'_, '_>,
    system: Option<&System>,
) -> (Option<u64>, Option<Surface>) {
    let Some((every, table)) = output.every("trajectory") else { return (None, None) };
    let section = table.and_then(|table| Some((table.text("section")?, table)));
    let Some((text, table)) = section else { return (Some(every), None) };
    let direction = table.word("direction", &Direction::NAMES).unwrap_or(Direction::Up);
    (None, system.and_then(|system| system.surface(text, direction, &mut reader.toml)))
}

fn modified_energy(reader: &mut Reader<'_>, output: &Table<'_, '_>) -> Option<(EstimatorSettings, u64)> {
    let (every, table) = output.every("modified_energy")?;
    let mut options = EstimatorOptions::default();
    let mut name = EstimatorSettings::NAMES[0];
    if let Some(table) = &table {
        let before = reader.toml.faults.len();
        let estimator = table.str("estimator");
        name = EstimatorSettings::NAMES.iter().find(|name| Some(**name) == estimator).unwrap_or(&name);
        options.order = order(reader, table, name);
        options.max_order = up_to(reader, table, "max_order", 2, name);
        options.stop = table.str("stop").and_then(|word| word.parse().ok());
        options.rule = table.str("rule").and_then(|word| word.parse().ok());
        options.accuracy = accuracy(reader, table);
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
            reader.toml.wrong(&table?.place(error.option), message, help)
        }
    }
}

/// A fixed order; none for "auto".
fn order(reader: &mut Reader<'_>, table: &Table<'_, '_>, estimator: &str) -> Option<u32> {
    let order = up_to(reader, table, "order", 1, estimator)?;
    let options = EstimatorOptions { order: Some(order), ..Default::default() };
    let settings = EstimatorSettings::from_options(estimator, options).ok().flatten();
    if settings.is_some_and(|settings| settings.is_between()) {
        let message = "with estimator = \"bilinear\" and an odd order the values are at times between the states";
        return reader.toml.wrong(&table.place("order"), message, "write an even order");
    }
    Some(order)
}

/// The m of a central difference, or the k of E_k.
fn up_to(reader: &mut Reader<'_>, table: &Table<'_, '_>, key: &str, least: u32, estimator: &str) -> Option<u32> {
    table.whole(key)?;
    let highest = EstimatorSettings::highest_order(estimator).unwrap_or(HIGHEST_ORDER);
    reader.toml.whole(table.get(key)?, least..=highest, "a whole number").map(|m| m.value)
}

fn accuracy(reader: &mut Reader<'_>, table: &Table<'_, '_>) -> Option<Rational> {
    let (text, Exact { value: accuracy, .. }) = reader.value(table, "accuracy")?;
    match check_accuracy(&accuracy) {
        Ok(()) => Some(accuracy),
        Err(error) => reader.toml.wrong(&text.at, format!("accuracy {} {error}", text.value), ACCURACY_HINT),
    }
}

/// A number of steps, or a time such as `1 min`.
fn interval(reader: &mut Reader<'_>, output: &Table<'_, '_>) -> Option<CheckpointInterval> {
    if let Some(steps) = output.whole("checkpoint") {
        return Some(CheckpointInterval::Steps(steps));
    }
    let text = output.text("checkpoint")?;
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
            "problem.name = \"pendulum\"\nrun = {{ scheme = \"yoshida4\", step = \"1/10\", steps = 9000 \
                }}\n[output]\nenergy = {{ every = 100 }}\n{output}\n"
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
