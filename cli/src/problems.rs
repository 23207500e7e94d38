//! `shadowstep problems`: the problems, with their parameters and initial states.

use std::io::Write;

use clap::Args;
use serde::Serialize;
use shadowstep::problems::{Description, Initial, PROBLEMS, problem};

use crate::output::Output;
use crate::quantity::problem_error;
use crate::readable::wrapped_to;
use crate::report::Status;
use shadowstep_scenes::Error;

/// Lists the problems with their parameters and initial states.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// One problem only, such as kepler
    name: Option<String>,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Record {
    name: &'static str,
    title: &'static str,
    hamiltonian: &'static str,
    parameters: Vec<Parameter>,
    positions: Vec<Value>,
    momenta: Vec<Value>,
    masses: Option<Vec<String>>,
    step: &'static str,
    until: &'static str,
    source: &'static str,
}

#[derive(Serialize)]
struct Parameter {
    name: &'static str,
    default: &'static str,
    meaning: &'static str,
    range: &'static str,
}

#[derive(Serialize)]
struct Value {
    name: String,
    default: String,
}

/// The list of all problems shows a part only of more initial values.
const SHORT: usize = 12;

/// One problem, or all.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let Arguments { name, json } = arguments;
    let chosen = match name {
        Some(name) => vec![problem(name).map_err(problem_error)?],
        None => PROBLEMS.to_vec(),
    };
    let most_values = if name.is_some() { usize::MAX } else { SHORT };
    let mut output = Output::stdout();
    for (i, problem) in chosen.into_iter().enumerate() {
        if *json {
            output.json(&record(problem.description()))?;
        } else {
            write!(output, "{}{}", if i == 0 { "" } else { "\n" }, readable(problem.description(), most_values))?;
        }
    }
    output.finish()?;
    Ok(Status::Success)
}

fn record(problem: &Description) -> Record {
    let parameters = problem.parameters.iter();
    let Initial { positions, momenta, masses } = (problem.initial)();
    let values =
        |list: Vec<(String, String)>| list.into_iter().map(|(name, default)| Value { name, default }).collect();
    Record {
        name: problem.name,
        title: problem.title,
        hamiltonian: problem.hamiltonian,
        parameters: parameters
            .map(|p| Parameter { name: p.name, default: p.default, meaning: p.meaning, range: p.range })
            .collect(),
        positions: values(positions),
        momenta: values(momenta),
        masses,
        step: problem.step,
        until: problem.until,
        source: problem.source,
    }
}

/// A problem as text, with a part of a long list of values.
fn readable(problem: &Description, most_values: usize) -> String {
    // lines after the first of a paragraph are indented more
    let lines = lines(problem, most_values);
    lines
        .lines()
        .map(|line| {
            let margin = if line.starts_with(' ') { "  " } else { "" };
            format!("{margin}{}\n", wrapped_to(line, "      ", 80).trim())
        })
        .collect()
}

fn lines(problem: &Description, most_values: usize) -> String {
    let mut text = format!("{}: {}\n  H = {}\n", problem.name, problem.title, problem.hamiltonian);
    for p in problem.parameters {
        text += &format!("  {} = {}: {}; {}\n", p.name, p.default, p.meaning, p.range);
    }
    let Initial { positions, momenta, masses } = (problem.initial)();
    let mut state: Vec<_> = positions.iter().chain(&momenta).map(|(name, value)| format!("{name} = {value}")).collect();
    if state.len() > most_values {
        state.truncate(most_values / 4);
        state.push(format!("… ({} coordinates; `shadowstep problems {}` lists all)", positions.len(), problem.name));
    }
    text += &format!("  at t = 0: {}\n", state.join(", "));
    if let Some(masses) = masses.filter(|masses| masses.len() <= most_values) {
        text += &format!("  masses of the coordinates: {}\n", masses.join(", "));
    }
    text += &format!(
        "  for example step size {} until t = {}\n  source: {}\n",
        problem.step, problem.until, problem.source
    );
    text
}
