//! The problems, with their parameters and initial states.

use std::io::Write;

use serde::Serialize;
use shadowstep::problems::{PROBLEMS, Problem, problem};

use crate::complaint::{Complaint, Ending};
use crate::output::Output;

#[derive(Serialize)]
struct Record {
    name: &'static str,
    title: &'static str,
    hamiltonian: &'static str,
    parameters: Vec<Parameter>,
    positions: Vec<Initial>,
    momenta: Vec<Initial>,
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
struct Initial {
    name: &'static str,
    default: &'static str,
}

/// One problem, or all.
pub(crate) fn problems(name: Option<&str>, json: bool) -> Result<Ending, Complaint> {
    let chosen = match name {
        Some(name) => vec![problem(name)?],
        None => PROBLEMS.iter().collect(),
    };
    let mut output = Output::open(None)?;
    for (i, problem) in chosen.into_iter().enumerate() {
        if json {
            output.json(&record(problem))?;
        } else {
            write!(output, "{}{}", if i == 0 { "" } else { "\n" }, readable(problem))?;
        }
    }
    output.finish()?;
    Ok(Ending::Done)
}

fn record(problem: &Problem) -> Record {
    let parameters = problem.parameters.iter();
    let initial = |values: &[(&'static str, &'static str)]| {
        values.iter().map(|&(name, default)| Initial { name, default }).collect()
    };
    Record {
        name: problem.name,
        title: problem.title,
        hamiltonian: problem.hamiltonian,
        parameters: parameters
            .map(|p| Parameter { name: p.name, default: p.default, meaning: p.meaning, range: p.range })
            .collect(),
        positions: initial(problem.positions),
        momenta: initial(problem.momenta),
        source: problem.source,
    }
}

fn readable(problem: &Problem) -> String {
    let mut text = format!("{}: {}\n  H = {}\n", problem.name, problem.title, problem.hamiltonian);
    for p in problem.parameters {
        text += &format!("  {} = {}    {}; {}\n", p.name, p.default, p.meaning, p.range);
    }
    let state = problem.positions.iter().chain(problem.momenta).map(|(name, value)| format!("{name} = {value}"));
    text += &format!("  at t = 0: {}\n  source: {}\n", state.collect::<Vec<_>>().join(", "), problem.source);
    text
}
