//! `shadowstep problems`: the problems, with their parameters and initial states.

use clap::Args;
use shadowstep::problems::{Description, Initial, PROBLEMS, problem};

use crate::output::Output;
use crate::quantity::problem_error;
use crate::readable::wrapped;
use crate::report::Status;
use shadowstep_scenes::Error;
use shadowstep_scenes::object::Object;

/// Lists the problems with their parameters and initial states.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// One problem only, such as kepler
    name: Option<String>,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
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
    let problems = || chosen.iter().map(|problem| problem.description());
    let text = || problems().map(|problem| readable(problem, most_values)).collect::<Vec<_>>().join("\n");
    Output::stdout().records_or_text(*json, problems().map(record), text)?;
    Ok(Status::Success)
}

fn record(problem: &Description) -> Object {
    let Initial { positions, momenta, masses } = (problem.initial)();
    let value = |(name, default): (String, String)| Object(vec![("name", name.into()), ("default", default.into())]);
    let values = |list: Vec<(String, String)>| list.into_iter().map(value).collect::<Vec<_>>();
    let parameters = problem.parameters.iter().map(|parameter| {
        let facts = [
            ("name", parameter.name),
            ("default", parameter.default),
            ("meaning", parameter.meaning),
            ("range", parameter.range),
        ];
        Object(facts.map(|(key, text)| (key, text.into())).into())
    });
    Object(vec![
        ("name", problem.name.into()),
        ("title", problem.title.into()),
        ("hamiltonian", problem.hamiltonian.into()),
        ("parameters", parameters.collect::<Vec<_>>().into()),
        ("positions", values(positions).into()),
        ("momenta", values(momenta).into()),
        ("masses", masses.into()),
        ("step", problem.step.into()),
        ("until", problem.until.into()),
        ("source", problem.source.into()),
    ])
}

/// A problem as text, with a part of a long list of values.
fn readable(problem: &Description, most_values: usize) -> String {
    // lines after the first of a paragraph are indented more
    let lines = lines(problem, most_values);
    lines
        .lines()
        .map(|line| {
            let margin = if line.starts_with(' ') { "  " } else { "" };
            format!("{margin}{}\n", wrapped(line, "      ").trim())
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
