//! Printed decimals to weights of many digits: the table, and a report on how far the printed ones were off.

use std::io::Write;

use num_traits::Signed;
use shadowstep_schemes::Kinetic;
use shadowstep_schemes::polish::{self, NotPolished, Polished, PolishedWeight, Request, Role, power_of_ten};
use shadowstep_symbolic::decimal::to_significant;

use crate::arguments::PolishArguments;
use crate::complaint::{Complaint, Ending, no, remark, report};
use crate::figures::table;
use crate::library;
use crate::output::Output;
use crate::schemes::{near_integrable, near_integrable_text};

/// The polished table to stdout or a file, the report to stderr.
pub(crate) fn polish(arguments: &PolishArguments) -> Result<Ending, Complaint> {
    let source = library::source(&arguments.file)?;
    let wanted = Request { digits: arguments.digits, free: &arguments.free, split_kicks: arguments.split_kicks };
    let polished = match polish::polish(&source, &library::beside_or_shipped, &wanted) {
        Ok(polished) => polished,
        Err(NotPolished::Request { sentence, help }) => return Err(Complaint::usage(sentence, help)),
        Err(NotPolished::Faults(faults)) => {
            Complaint::Faults(faults).tell();
            return Ok(Ending::AnswerIsNo);
        }
        Err(NotPolished::Unsolved { sentence, help }) => return Ok(no(sentence, help)),
    };
    let mut output = Output::open(arguments.output.as_deref(), "--output")?;
    write!(output, "{}", polished.text)?;
    output.finish()?;
    report(told(&polished));
    for weight in misprints(&polished.weights) {
        let PolishedWeight { name, right, printed_digits, .. } = weight;
        remark(format_args!("{name} seems to be misprinted: {right} of its {printed_digits} digits are right"));
    }
    Ok(Ending::Done)
}

fn told(polished: &Polished) -> String {
    let proved = &polished.proved;
    let class = match proved.scheme.table.kinetic {
        Kinetic::Any => "every T(p)",
        Kinetic::Quadratic => "quadratic T",
    };
    let kind = if polished.in_gamma { " in the γ's" } else { "" };
    let symmetric = if proved.proof.symmetric { ", symmetric" } else { "" };
    let near = match near_integrable_text(&near_integrable(&proved.proof)) {
        orders if orders.is_empty() => orders,
        orders => format!(", {orders} for A + εB"),
    };
    let header = ["decimal", "printed digits", "right", "off by", "now"];
    let rows: Vec<_> = polished.weights.iter().map(row).collect();
    format!(
        "{}\norder {} for {class}{near}{symmetric}: {} conditions{kind}, off by {} as printed, by {} now\ncondition number {}{}",
        table(header, rows, 1..4),
        proved.order().order,
        polished.conditions,
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
    let solved = matches!(weight.role, Role::Solved | Role::Formula);
    let right = if solved { weight.right.to_string() } else { String::new() };
    let off = if solved { off.trim_start_matches('-').to_owned() } else { String::new() };
    [name, weight.printed_digits.to_string(), right, off, now.to_owned()]
}

/// How many of the printed digits were wrong; a small residual may have hidden it.
fn judgement(polished: &Polished) -> String {
    let solved = || polished.weights.iter().filter(|w| matches!(w.role, Role::Solved | Role::Formula));
    let lost = solved().map(|w| w.printed_digits.saturating_sub(w.right)).max().unwrap_or(0);
    let off = solved().map(|w| (&w.printed - &w.polished).abs()).max().unwrap_or_default();
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

/// Decimals that are so much worse than the best ones that no rounding explains it.
fn misprints(weights: &[PolishedWeight]) -> impl Iterator<Item = &PolishedWeight> {
    let best = weights.iter().map(|w| w.right).max().unwrap_or(0);
    weights.iter().filter(move |w| w.right < w.printed_digits && 2 * w.right <= best)
}

fn number(condition: f64) -> String {
    if condition < 1e4 { format!("{condition:.0}") } else { format!("{condition:.1e}") }
}
