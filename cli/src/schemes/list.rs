//! The shipped schemes, a line each.

use std::io::Write;

use serde::Serialize;
use shadowstep::tables::{TableScheme, shipped, shipped_names};

use crate::complaint::{Complaint, Ending};
use crate::figures::table;
use crate::output::Output;
use crate::schemes::{digits, digits_text};

#[derive(Serialize)]
struct Record {
    name: &'static str,
    order: u32,
    order_quadratic: u32,
    stages: usize,
    evaluations: usize,
    symmetric: bool,
    digits: Option<u32>,
    title: Option<String>,
}

const COLUMNS: [&str; 7] = ["order", "quadratic T", "stages", "forces a step", "symmetric", "digits", "name"];

/// All shipped schemes, the lowest orders and the cheapest first.
pub(crate) fn list(json: bool) -> Result<Ending, Complaint> {
    let named = |name| shipped(name).map(|scheme| record(name, &scheme));
    let mut records: Vec<Record> = shipped_names().into_iter().filter_map(named).collect();
    records.sort_by_key(|record| (record.order, record.order_quadratic, record.evaluations));
    let mut output = Output::open(None, "")?;
    if json {
        records.iter().try_for_each(|record| output.json(record))?;
    } else {
        writeln!(output, "{}", table(COLUMNS, records.iter().map(row).collect(), 0..6))?;
    }
    output.finish()?;
    Ok(Ending::Done)
}

fn record(name: &'static str, scheme: &TableScheme) -> Record {
    let proved = scheme.proved();
    Record {
        name,
        order: proved.proof.general.order,
        order_quadratic: proved.proof.quadratic.order,
        stages: proved.scheme.kick.len(),
        evaluations: scheme.plan().evaluations,
        symmetric: proved.proof.symmetric,
        digits: digits(proved.scheme.held),
        title: proved.scheme.table.title.clone(),
    }
}

fn row(record: &Record) -> [String; 7] {
    [
        record.order.to_string(),
        record.order_quadratic.to_string(),
        record.stages.to_string(),
        record.evaluations.to_string(),
        if record.symmetric { "yes" } else { "no" }.to_owned(),
        digits_text(record.digits),
        record.name.to_owned(),
    ]
}
