//! `shadowstep modified`: the Hamiltonian that a scheme solves, as a series and as a formula.

use clap::{Args, ValueEnum};
use serde::Serialize;
use shadowstep_analysis::modified::HIGHEST_GRADE;
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::{self, NamedScheme};
use shadowstep_scenes::modified_hamiltonian::record::{
    FormulaRecord, Formulas, SeriesOptions, SeriesRecord, SeriesTerm, remainder, sum_of,
};
use shadowstep_schemes::Proved;
use shadowstep_schemes::symbolic::Notation;

use crate::headings::OUTPUT;
use crate::output::{Output, OutputArguments};
use crate::quantity::whole;
use crate::report::{self, Status};
use crate::run_arguments::SystemArguments;
use crate::system::Described;

const EXAMPLES: &str = "\
Examples:
  shadowstep modified yoshida4
  shadowstep modified stormer-verlet kepler
  shadowstep modified yoshida4 --parts 3";

const MORE: &str = "  \
  shadowstep modified blanes-moan-s6 --grade 6 --potential \"x^4/4\" \\
      --q x=1 --p 0 --to numpy

A step of size h is the flow over h of H + h H_2 + h^2 H_3 + …. The series is asymptotic: its terms become smaller up \
to a power that h sets. In brackets K \
stands for U and D for T, or A, B, C, … for parts. [F,G] = F_p·G_q - F_q·G_p, so that [K,D] = -U_q·T_p.";

/// What is expanded, and how far.
const SERIES: &str = "Scheme and series";

/// The modified Hamiltonian of a scheme: its series, or a formula.
///
/// Without a system the coefficients of its series are written, with one its formula.
#[derive(Debug, Args)]
// no system is required: a scheme is always there
#[command(
    after_help = EXAMPLES,
    after_long_help = format!("{EXAMPLES}\n{MORE}"),
    mut_arg("name", |name| name.required_unless_present("scheme")),
)]
pub(crate) struct Arguments {
    /// A shipped scheme, such as yoshida4, or the file of a table
    #[arg(display_order = 0, help_heading = SERIES)]
    scheme: String,
    #[command(flatten)]
    system: Option<SystemArguments>,
    /// The highest power of h
    #[arg(long, value_name = "N", default_value_t = 4, help_heading = SERIES, value_parser = |text: &str| whole(text, 1..=HIGHEST_GRADE))]
    grade: u32,
    /// For H of this number of parts, 3 to 9, in place of T + U
    #[arg(
        long,
        value_name = "N",
        help_heading = SERIES,
        conflicts_with_all = ["name", "problem", "potential"],
        value_parser = |text: &str| whole(text, 3..=9),
    )]
    parts: Option<u32>,
    /// Leaves out brackets that are 0 for T quadratic in p
    #[arg(long, help_heading = SERIES, conflicts_with_all = ["parts", "name", "problem", "potential"])]
    quadratic: bool,
    /// Significant digits of coefficients
    ///
    /// Coefficients that are short fractions are exact.
    #[arg(long, value_name = "N", default_value_t = 17, help_heading = SERIES, value_parser = |text: &str| whole(text, 1..=300))]
    digits: u32,
    /// The notation of the formula, or a function of it
    #[arg(long, value_name = "NOTATION", value_enum, default_value_t = To::Text, help_heading = OUTPUT)]
    to: To,
    /// One JSON object
    #[arg(long, conflicts_with = "to", help_heading = OUTPUT)]
    json: bool,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum To {
    /// As scenes have it
    Text,
    /// Lines of an `aligned` environment
    Latex,
    /// A function
    Rust,
    /// A function of Python
    Numpy,
}

impl To {
    fn notation(self) -> Notation {
        match self {
            To::Text => Notation::Formula,
            To::Latex => Notation::Latex,
            To::Rust => Notation::Rust,
            To::Numpy => Notation::NumPy,
        }
    }
}

pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let named = library::scheme(&arguments.scheme)?;
    named.note().iter().for_each(report::note);
    let text = match &arguments.system {
        Some(system) => of_system(arguments, &named, &Described::read(system, Arithmetic::DOUBLE)?)?,
        None => of_brackets(arguments, named.scheme.proved())?,
    };
    Output::of(&arguments.output)?.text(text)?;
    Ok(Status::Success)
}

fn of_brackets(arguments: &Arguments, proved: &Proved) -> Result<String, Error> {
    let Arguments { grade, parts, quadratic, digits, .. } = *arguments;
    if arguments.to != To::Text {
        let help = "name a problem or a scene, or give --potential";
        return Err(Error::usage("this notation is that of a formula, and there is no system", help));
    }
    if parts.is_none() && proved.scheme.inner.is_some() {
        let message = format!("{} has multiple time steps, for slow forces, fast forces and T", arguments.scheme);
        return Err(Error::usage(message, "add --parts 3: A for the slow forces, B for the fast ones, C for T"));
    }
    let series = SeriesRecord::of(proved, SeriesOptions { grade, parts, quadratic, digits: digits as usize })?;
    if arguments.json {
        return Ok(serde_json::to_string(&series)? + "\n");
    }
    let terms = &series.terms;
    let powers: Vec<u32> = (1..=grade).filter(|n| terms.iter().any(|term| term.power == *n)).collect();
    let of = match series.kinetic {
        Some("quadratic") => "T + U with quadratic T".to_owned(),
        Some(_) => "T + U".to_owned(),
        None => format!("a sum of {} parts", series.parts),
    };
    let sum = sum_of(powers.iter().copied(), remainder(proved, grade));
    let mut text = format!("{}: H = {of} becomes {sum}\n", series.scheme);
    let width = terms.iter().map(|term| term.coefficient.len()).max().unwrap_or(0);
    for power in powers {
        text += &format!("\nH_{}\n", power + 1);
        for SeriesTerm { coefficient, bracket, .. } in terms.iter().filter(|term| term.power == power) {
            text += &format!("  {coefficient:>width$}  {bracket}\n");
        }
    }
    Ok(text)
}

/// The formulas with the system's name.
#[derive(Serialize)]
struct OfSystem<'a> {
    system: &'a str,
    #[serde(flatten)]
    formulas: &'a FormulaRecord,
}

fn of_system(arguments: &Arguments, named: &NamedScheme, described: &Described) -> Result<String, Error> {
    let notation = arguments.to.notation();
    let formulas = Formulas::of(&described.system, named, arguments.grade)?;
    let formulas = formulas.written(notation, arguments.digits as usize)?;
    if arguments.json {
        return Ok(serde_json::to_string(&OfSystem { system: &described.name, formulas: &formulas })? + "\n");
    }
    if matches!(arguments.to, To::Text | To::Latex) {
        let of_series = |name: &str| name == "h" || name == "H" || name.starts_with("H_");
        for (name, _) in formulas.names.iter().filter(|(name, _)| of_series(name)) {
            report::note(format!("`{name}` in the formulas is of the problem, and elsewhere of the series"));
        }
    }
    let title = format!("{}, {}: {}", formulas.scheme, described.name, formulas.title());
    let FormulaRecord { hamiltonian, terms, .. } = &formulas;
    Ok(match arguments.to {
        To::Text => {
            let lines = terms.iter().map(|term| format!("\nH_{} = {}\n", term.power + 1, term.formula));
            format!("{title}\n\nH = {hamiltonian}\n{}", lines.collect::<String>())
        }
        To::Latex => {
            let lines = terms.iter().map(|term| format!(" \\\\\nH_{{{}}} &= {}", term.power + 1, term.formula));
            let lines: String = lines.collect();
            format!("% {title}\n\\begin{{aligned}}\nH &= {hamiltonian}{lines}\n\\end{{aligned}}\n")
        }
        To::Numpy | To::Rust => formulas.function(&title, notation),
    })
}
