//! `shadowstep schemes polish`: printed decimals to weights of many digits: the table, and a report on how far the
//! printed ones were off.

use clap::Args;
use num_traits::Signed;
use shadowstep_analysis::polish::{self, NotPolished, Polished, PolishedWeight, Request, Role, power_of_ten};
use shadowstep_schemes::symbolic::decimal::to_significant;
use shadowstep_schemes::{Rational, counted};

use crate::interrupt::Interrupt;
use crate::output::{Output, OutputArguments};
use crate::quantity::whole;
use crate::readable::table;
use crate::report::{self, Status};
use shadowstep_scenes::Error;
use shadowstep_scenes::library;

const EXAMPLE: &str = "\
Example:
  shadowstep schemes polish printed.toml --digits 300 --output polished.toml";

const MORE: &str = "\
Decimals that stand alone are changed, as constants or in the lists of weights; fractions and formulas stay as they \
are. If the conditions leave some decimals free, these stay as printed, and the report on stderr names them.

The \
exit code is 1 if the conditions cannot be solved.";

/// Solves a table's order conditions from its printed decimals.
///
/// The weights get many digits.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE, after_long_help = format!("{EXAMPLE}\n\n{MORE}"))]
pub(crate) struct Arguments {
    /// The table
    #[arg(value_name = "FILE")]
    file: String,
    /// Decimal digits of the weights [default: up to 300]
    ///
    /// The order conditions hold to these digits. The default is as many as can be, at most 300.
    #[arg(long, value_name = "DIGITS", value_parser = |text: &str| whole(text, 1..=polish::MOST_POLISHED_DIGITS))]
    digits: Option<u32>,
    /// Decimals that stay as printed, such as kick[2]
    ///
    /// They are constants, or places such as kick[2], drift[3], gamma[1].
    #[arg(long, value_name = "NAME", num_args = 1.., value_delimiter = ',')]
    free: Vec<String>,
    /// The cubes of the kicks must sum to 0 too
    ///
    /// It is for kicks that are themselves split, as in heliocentric coordinates.
    #[arg(long)]
    split_kicks: bool,
    /// Where the harmonic oscillator must be stable, such as 2.98
    ///
    /// They are about the hω at which a step turns by a multiple of π.
    #[arg(long, value_name = "HΩ,…", value_delimiter = ',', value_parser = positive)]
    closed_gaps: Vec<f64>,
    #[command(flatten)]
    output: OutputArguments,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("write a positive number, such as 2.98".to_owned()),
    }
}

/// The polished table to stdout or a file, the report to stderr.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let source = library::source(&arguments.file)?;
    let _interrupt = Interrupt::listen("schemes polish", "run the command again");
    let output = Output::of(&arguments.output)?;
    let request = Request {
        digits: arguments.digits,
        free: &arguments.free,
        split_kicks: arguments.split_kicks,
        closed_gaps: &arguments.closed_gaps,
    };
    let polished = match polish::polish(&source, &library::beside_or_shipped, &request) {
        Ok(polished) => polished,
        Err(NotPolished::Request { message, hint }) => return Err(Error::usage(message, hint)),
        Err(NotPolished::Faults(faults)) => {
            report::error(&Error::Faults(faults));
            return Ok(Status::NegativeAnswer);
        }
        Err(NotPolished::Unsolved { message, hint }) => return Ok(report::negative_answer(message, hint)),
    };
    output.text(&polished.text)?;
    report::write(summary(&polished));
    polished.notes.iter().for_each(report::note);
    for weight in misprints(&polished.weights) {
        let PolishedWeight { name, right, printed_digits, .. } = weight;
        let are = if *right == 1 { "is" } else { "are" };
        report::note(format_args!("{name} seems to be misprinted: {right} of its {printed_digits} digits {are} right"));
    }
    Ok(Status::Success)
}

fn summary(polished: &Polished) -> String {
    let proved = &polished.proved;
    let (class, near) = (proved.scheme.table.kinetic, proved.orders_of_steps().and_in_epsilon());
    let kind = if polished.in_gamma { " in the γ's" } else { "" };
    let symmetric = if proved.proof.symmetric { ", symmetric" } else { "" };
    let header = ["decimal", "printed digits", "right", "off by", "now"];
    let rows: Vec<_> = polished.weights.iter().map(row).collect();
    format!(
        "{}\norder {} for {class}{near}{symmetric}: {}{kind}, off by {} as printed, by {} now\ncondition number {}{}",
        table(header, rows, 1..4),
        proved.order().order,
        counted(polished.conditions, "condition"),
        power_of_ten(polished.residual_printed),
        power_of_ten(polished.residual),
        number(polished.condition_number),
        judgement(polished)
    )
}

fn row(weight: &PolishedWeight) -> [String; 5] {
    let off = to_significant(&(&weight.printed - &weight.polished), 2);
    let now = match weight.role {
        Role::Solved => "solved for",
        Role::Formula => "solved for, written as what is left of 1",
        Role::Held => "as printed, as asked",
        Role::Free => "as printed: the conditions leave it free",
    };
    let name = if weight.constant == weight.name {
        weight.name.clone()
    } else {
        format!("{} = {}", weight.name, weight.constant)
    };
    let solved = is_solved(weight);
    let right = if solved { weight.right.to_string() } else { String::new() };
    let off = if solved { off.trim_start_matches('-').to_owned() } else { String::new() };
    [name, weight.printed_digits.to_string(), right, off, now.to_owned()]
}

/// How many of the printed digits were wrong; a small residual may have hidden it.
fn judgement(polished: &Polished) -> String {
    let misprinted: Vec<_> = misprints(&polished.weights).map(|w| (w.name.as_str(), wrong(w))).collect();
    let solved = || polished.weights.iter().filter(|w| is_solved(w));
    let others = solved().filter(|w| misprinted.iter().all(|(name, _)| *name != w.name));
    let lost = others.map(wrong).max().unwrap_or(0);
    if let Some(most) = misprinted.iter().map(|(_, wrong)| wrong).max() {
        let names = misprinted.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
        let have = if misprinted.len() == 1 { "has" } else { "have up to" };
        return match lost {
            0 => format!(": {names} alone {have} {most} wrong digits"),
            _ => format!(": {names} {have} {most} wrong digits, the others up to {lost}"),
        };
    }
    let Some(off) = solved().map(|w| (&w.printed - &w.polished).abs()).max() else {
        return ": formulas meet the conditions, whatever the decimals are".to_owned();
    };
    match lost {
        0 => ": every printed digit is right".to_owned(),
        1 => ": the printed digits are right but for the last".to_owned(),
        lost => format!(
            ": up to {lost} of the printed digits are wrong; conditions off by {} stood for weights off by {}",
            power_of_ten(polished.residual_printed),
            to_significant(&off, 2)
        ),
    }
}

fn is_solved(weight: &PolishedWeight) -> bool {
    matches!(weight.role, Role::Solved | Role::Formula)
}

fn wrong(weight: &PolishedWeight) -> u32 {
    weight.printed_digits - weight.right
}

/// Decimals that are so much worse than the others that neither rounding nor their conditions explain it: with three
/// wrong digits more than the others typically have, and off by a hundred times as much (a small weight has more wrong
/// digits than a large one where both are as far off).
fn misprints(weights: &[PolishedWeight]) -> impl Iterator<Item = &PolishedWeight> {
    let solved: Vec<_> = weights.iter().filter(|w| is_solved(w)).collect();
    let off = |w: &PolishedWeight| (&w.printed - &w.polished).abs();
    solved.clone().into_iter().filter(move |this| {
        let others = || solved.iter().filter(|other| other.name != this.name);
        let typical = median(others().map(|w| wrong(w))).zip(median(others().map(|w| off(w))));
        typical.is_some_and(|(digits, distance)| {
            wrong(this) >= digits + 3 && off(this) > distance * Rational::from_integer(100.into())
        })
    })
}

/// The middle of the values, of two the larger one.
fn median<T: Ord>(values: impl Iterator<Item = T>) -> Option<T> {
    let mut values: Vec<_> = values.collect();
    values.sort();
    let middle = values.len() / 2;
    values.into_iter().nth(middle)
}

fn number(condition: f64) -> String {
    if condition < 1e4 { format!("{condition:.0}") } else { format!("{condition:.1e}") }
}
