//! `shadowstep modified`: the Hamiltonian that a scheme solves, as a series and as a formula.

use std::io::Write;

use clap::{Args, ValueEnum};
use serde::Serialize;
use shadowstep_analysis::bracket::Letter;
use shadowstep_analysis::modified::{HIGHEST_GRADE, ModifiedHamiltonian};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::{self, NamedScheme};
use shadowstep_scenes::{Error, Refusal, SymbolicHamiltonian, SymbolicTerm};
use shadowstep_schemes::{Kinetic, Proved};
use shadowstep_symbolic::decimal::to_significant;
use shadowstep_symbolic::{Notation, Rational};

use crate::output::{Output, OutputArguments};
use crate::quantity::whole;
use crate::report::{self, Status};
use crate::run_arguments::SystemArguments;
use crate::system::Described;

const EXAMPLE: &str = "\
Examples:
  shadowstep modified yoshida4
  shadowstep modified stormer-verlet kepler
  shadowstep modified blanes-moan-s6 --grade 6 --potential \"x^4/4\" --q x=1 --p 0 --to numpy
  shadowstep modified yoshida4 --parts 3

A step of size h is the flow over h of H + h H_2 + h^2 H_3 + …, an asymptotic series: smaller terms follow larger ones up to a power that h sets. In brackets K
stands for U and D for T, or A, B, C, … for parts, and [F,G] = F_p·G_q - F_q·G_p, so that [K,D] = -U_q·T_p.";

/// Short fractions have numerators and denominators of at most this number of digits.
const SHORT: usize = 15;

/// The most words of the series of many parts.
const MOST_WORDS: u64 = 20_000;

/// The modified Hamiltonian of a scheme: its coefficients, and with a system its formula.
#[derive(Debug, Args)]
// no system is required: a scheme is always there
#[command(after_help = EXAMPLE, mut_arg("name", |name| name.required_unless_present("scheme")))]
pub(crate) struct Arguments {
    /// A shipped scheme, such as yoshida4, or the file of a table
    scheme: String,
    #[command(flatten)]
    system: Option<SystemArguments>,
    /// The highest power of h
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = |text: &str| whole(text, 1..=HIGHEST_GRADE))]
    grade: u32,
    /// For H of this number of parts, 3 to 9, in place of T + U
    #[arg(long, value_name = "N", conflicts_with_all = ["name", "problem", "potential"], value_parser = |text: &str| whole(text, 3..=9))]
    parts: Option<u32>,
    /// Leaves out the brackets that are 0 for every T quadratic in p
    #[arg(long, conflicts_with_all = ["parts", "name", "problem", "potential"])]
    quadratic: bool,
    /// Significant digits of coefficients that are not short fractions
    #[arg(long, value_name = "N", default_value_t = 17, value_parser = |text: &str| whole(text, 1..=300))]
    digits: u32,
    /// The notation of the formula, or a function of it
    #[arg(long, value_name = "NOTATION", value_enum, default_value_t = To::Text)]
    to: To,
    /// One JSON object
    #[arg(long, conflicts_with = "to")]
    json: bool,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum To {
    /// As scenes have it
    Text,
    Latex,
    Rust,
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
    let mut output = Output::of(&arguments.output)?;
    write!(output, "{text}")?;
    output.finish()?;
    Ok(Status::Success)
}

/// A term of the series.
#[derive(Serialize)]
struct Term {
    power: u32,
    bracket: String,
    coefficient: String,
}

#[derive(Serialize)]
struct Series<'a> {
    scheme: &'a str,
    /// `null` for many parts.
    kinetic: Option<&'static str>,
    parts: u32,
    exact: bool,
    terms: Vec<Term>,
}

fn of_brackets(arguments: &Arguments, proved: &Proved) -> Result<String, Error> {
    let name = &proved.scheme.table.name.value;
    if arguments.to != To::Text {
        let help = "name a problem or a scene, or give --potential";
        return Err(Error::usage("this notation is that of a formula, and there is no system", help));
    }
    let grade = arguments.grade;
    let Some(parts) = arguments.parts else {
        if proved.scheme.inner.is_some() {
            let message = format!("{name} has multiple time steps, for slow forces, fast forces and T");
            return Err(Error::usage(message, "add --parts 3: A for the slow forces, B for the fast ones, C for T"));
        }
        let is_quadratic = arguments.quadratic || proved.scheme.has_gradient_kicks();
        let (kinetic, word) = match is_quadratic {
            true => (Kinetic::Quadratic, "quadratic"),
            false => (Kinetic::Any, "any"),
        };
        return written(arguments, (name, Some(word), 2), &ModifiedHamiltonian::of(proved, kinetic, grade));
    };
    if u64::from(parts).pow(grade + 1) > MOST_WORDS {
        let message = format!("the series of {parts} parts up to h^{grade} has too many terms");
        return Err(Error::usage(message, "ask for fewer parts, or a lower --grade"));
    }
    let series = ModifiedHamiltonian::of_parts(proved, parts as usize, grade)
        .map_err(|not| Error::usage(not.to_string(), "use a scheme such as yoshida4"))?;
    written(arguments, (name, None, parts), &series)
}

fn written<L: Letter>(
    arguments: &Arguments,
    (scheme, kinetic, parts): (&str, Option<&'static str>, u32),
    series: &ModifiedHamiltonian<L>,
) -> Result<String, Error> {
    let coefficient = |c: &Rational| coefficient(c, arguments.digits as usize);
    let terms: Vec<_> = series
        .all()
        .map(|(power, bracket, c)| Term { power, bracket: bracket.to_string(), coefficient: coefficient(c) })
        .collect();
    if arguments.json {
        let record = Series { scheme, kinetic, parts, exact: series.digits.is_none(), terms };
        return Ok(serde_json::to_string(&record)? + "\n");
    }
    let powers: Vec<u32> = (1..=arguments.grade).filter(|n| terms.iter().any(|term| term.power == *n)).collect();
    let of = match kinetic {
        Some("quadratic") => "T + U with quadratic T".to_owned(),
        Some(_) => "T + U".to_owned(),
        None => format!("a sum of {parts} parts"),
    };
    let mut text = format!("{scheme}: H = {of} becomes {}\n", sum_of(&powers, arguments.grade));
    let width = terms.iter().map(|term| term.coefficient.len()).max().unwrap_or(0);
    for power in powers {
        text += &format!("\nH_{}\n", power + 1);
        for Term { coefficient, bracket, .. } in terms.iter().filter(|term| term.power == power) {
            text += &format!("  {coefficient:>width$}  {bracket}\n");
        }
    }
    Ok(text)
}

/// A short fraction, or a decimal.
fn coefficient(c: &Rational, digits: usize) -> String {
    let fraction = c.to_string();
    let is_short = fraction.trim_start_matches('-').split('/').all(|part| part.len() <= SHORT);
    if is_short { fraction } else { to_significant(c, digits) }
}

/// H + h^2 H_3 + …
fn sum_of(powers: &[u32], grade: u32) -> String {
    let terms = powers.iter().map(|n| match n {
        1 => " + h H_2".to_owned(),
        _ => format!(" + h^{n} H_{}", n + 1),
    });
    format!("H{} + O(h^{})", terms.collect::<String>(), grade + 1)
}

/// The formulas of a system.
#[derive(Serialize)]
struct Formulas<'a> {
    scheme: &'a str,
    system: &'a str,
    hamiltonian: String,
    terms: Vec<FormulaOfTerm>,
}

#[derive(Serialize)]
struct FormulaOfTerm {
    power: u32,
    formula: String,
}

fn of_system(arguments: &Arguments, named: &NamedScheme, described: &Described) -> Result<String, Error> {
    let system = &described.system;
    let scheme = system.needs().scheme(named.clone(), &Default::default())?;
    let mut symbolic = SymbolicHamiltonian::of(system)?;
    let terms = symbolic.modified(scheme.scheme.proved(), arguments.grade)?;
    let write =
        |symbolic: &SymbolicHamiltonian, node| symbolic.text(node, arguments.to.notation(), arguments.digits as usize);
    let whole = symbolic.hamiltonian();
    let hamiltonian = write(&symbolic, whole)?;
    let formulas: Vec<_> = terms
        .iter()
        .map(|SymbolicTerm { power, formula }| {
            Ok(FormulaOfTerm { power: *power, formula: write(&symbolic, *formula)? })
        })
        .collect::<Result<_, Refusal>>()?;
    let scheme = &*scheme.scheme.proved().scheme.table.name.value;
    if arguments.json {
        let record = Formulas { scheme, system: &described.name, hamiltonian, terms: formulas };
        return Ok(serde_json::to_string(&record)? + "\n");
    }
    let powers: Vec<u32> = terms.iter().map(|term| term.power).collect();
    let title = format!("{scheme}, {}: {}", described.name, sum_of(&powers, arguments.grade));
    let nodes: Vec<_> = terms.iter().map(|term| term.formula).chain([whole]).collect();
    let names = symbolic.names_in(&nodes);
    Ok(match arguments.to {
        To::Text => {
            let lines = formulas.iter().map(|term| format!("\nH_{} = {}\n", term.power + 1, term.formula));
            format!("{title}\n\nH = {hamiltonian}\n{}", lines.collect::<String>())
        }
        To::Latex => {
            let lines = formulas.iter().map(|term| format!(" \\\\\nH_{{{}}} &= {}", term.power + 1, term.formula));
            format!(
                "% {title}\n\\begin{{aligned}}\nH &= {hamiltonian}{}\n\\end{{aligned}}\n",
                lines.collect::<String>()
            )
        }
        To::Numpy => {
            let names = names.join(", ");
            let mut text = format!(
                "import numpy as np\n\n\ndef modified_hamiltonian(h, {names}):\n    \"\"\"{title}\"\"\"\n    total = {hamiltonian}\n"
            );
            for FormulaOfTerm { power, formula } in formulas {
                text += &format!("    total += h**{power}*({formula})\n");
            }
            text + "    return total\n"
        }
        To::Rust => {
            let names = names.iter().map(|name| format!("{name}: f64")).collect::<Vec<_>>().join(", ");
            let mut text = format!(
                "/// {title}\npub fn modified_hamiltonian(h: f64, {names}) -> f64 {{\n    let mut total = {hamiltonian};\n"
            );
            for FormulaOfTerm { power, formula } in formulas {
                text += &format!("    total += h.powi({power})*({formula});\n");
            }
            text + "    total\n}\n"
        }
    })
}
