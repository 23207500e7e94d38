//! Everything that is known about a scheme.

use std::io::Write;

use serde::Serialize;
use sha2::{Digest, Sha256};
use shadowstep::Rational;
use shadowstep::tables::TableScheme;
use shadowstep_schemes::proof::Order;
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::{Analysis, First, Kinetic, to_significant, to_text};

use crate::complaint::{Complaint, Ending};
use crate::figures::{shortened, table};
use crate::library;
use crate::output::Output;
use crate::schemes::analysis::{Error, Gap, Phase, Sizes};
use crate::schemes::{aliases, analysis, digits, digits_text, near_integrable};

/// Digits of a weight that a person reads.
const SHOWN: usize = 40;

#[derive(Serialize)]
struct Record {
    name: String,
    aliases: Vec<String>,
    title: Option<String>,
    order: u32,
    order_digits: Option<u32>,
    fails: Option<Failed>,
    order_quadratic: u32,
    order_quadratic_digits: Option<u32>,
    fails_quadratic: Option<Failed>,
    near_integrable: Vec<u32>,
    digits: Option<u32>,
    evaluations: usize,
    products_per_dimension: usize,
    products_for_beta: usize,
    stages: usize,
    symmetric: bool,
    first: &'static str,
    kinetic: &'static str,
    effective_error: f64,
    effective_error_quadratic: f64,
    leading_error: Error,
    leading_error_quadratic: Error,
    stability_limit: String,
    unstable_gaps: Vec<Gap>,
    phase_error: Phase,
    trace: Vec<String>,
    kick_sizes: Sizes,
    drift_sizes: Sizes,
    kick: Vec<String>,
    drift: Vec<String>,
    maps: Vec<Map>,
    reference: String,
    doi: Option<String>,
    table_hash: String,
    remarks: Vec<String>,
}

/// The first condition of the order that fails.
#[derive(Serialize)]
struct Failed {
    condition: String,
    order: u32,
    found: String,
    needed: String,
}

#[derive(Serialize)]
struct Map {
    map: String,
    weight: String,
}

pub(crate) fn show(word: &str, json: bool) -> Result<Ending, Complaint> {
    let scheme = library::scheme(word)?.scheme;
    let analysis = Analysis::of(scheme.proved());
    let mut output = Output::open(None, "")?;
    if json {
        output.json(&record(&scheme, &analysis))?;
    } else {
        write!(output, "{}", readable(&scheme, &analysis))?;
    }
    output.finish()?;
    Ok(Ending::Done)
}

fn record(scheme: &TableScheme, analysis: &Analysis) -> Record {
    let proved = scheme.proved();
    let (proof, weights, table) = (&proved.proof, &proved.scheme, &proved.scheme.table);
    let texts = |weights: &[Rational]| weights.iter().map(to_text).collect();
    let maps = weights.maps().into_iter();
    let cost = scheme.plan().cost();
    Record {
        name: table.name.value.clone(),
        aliases: aliases(table),
        title: table.title.clone(),
        order: proof.general.order,
        order_digits: proof.general.digits,
        fails: failed(&proof.general, to_text),
        order_quadratic: proof.quadratic.order,
        order_quadratic_digits: proof.quadratic.digits,
        fails_quadratic: failed(&proof.quadratic, to_text),
        near_integrable: near_integrable(table),
        digits: digits(weights.held),
        evaluations: scheme.plan().evaluations,
        products_per_dimension: cost.products_per_dimension,
        products_for_beta: cost.products_for_beta,
        stages: weights.kick.len(),
        symmetric: proof.symmetric,
        first: first(weights.first()),
        kinetic: kinetic(table.kinetic),
        effective_error: analysis.effective_error(Kinetic::Any),
        effective_error_quadratic: analysis.effective_error(Kinetic::Quadratic),
        leading_error: Error::of(&analysis.general),
        leading_error_quadratic: Error::of(&analysis.quadratic),
        trace: trace(analysis, weights.held),
        kick_sizes: Sizes::of(&analysis.kicks),
        drift_sizes: Sizes::of(&analysis.drifts),
        phase_error: Phase::of(analysis.phase),
        unstable_gaps: analysis.stability.gaps.iter().map(Gap::of).collect(),
        stability_limit: analysis.stability.limit.clone(),
        kick: texts(&weights.kick),
        drift: texts(&weights.drift),
        maps: maps.map(|map| Map { map: map.kind.to_string(), weight: to_text(&map.weight) }).collect(),
        reference: table.reference.clone(),
        doi: table.doi.clone(),
        table_hash: Sha256::digest(&table.source.text).iter().map(|byte| format!("{byte:02x}")).collect(),
        remarks: proved.remarks.iter().map(ToString::to_string).collect(),
    }
}

/// The coefficients of the trace polynomial: exact where the weights are, which else are hundreds of digits long; 30
/// digits of the others.
fn trace(analysis: &Analysis, held: Held) -> Vec<String> {
    let trace = &analysis.trace;
    let text = |k| match held {
        Held::Exactly => to_text(&trace.coefficient(k)),
        Held::Digits(_) => to_significant(&trace.unreduced_coefficient(k), 30),
    };
    (0..=trace.degree()).map(text).collect()
}

fn failed(order: &Order, text: impl Fn(&Rational) -> String) -> Option<Failed> {
    order.failed.as_ref().map(|(condition, found)| Failed {
        condition: condition.name.clone(),
        order: condition.order,
        found: text(found),
        needed: text(&condition.needed),
    })
}

fn first(first: First) -> &'static str {
    match first {
        First::Kick => "kick",
        First::Drift => "drift",
    }
}

fn kinetic(kinetic: Kinetic) -> &'static str {
    match kinetic {
        Kinetic::Any => "any",
        Kinetic::Quadratic => "quadratic",
    }
}

fn readable(scheme: &TableScheme, analysis: &Analysis) -> String {
    let proved = scheme.proved();
    let Record { name, title, evaluations, stages, symmetric, first, reference, doi, remarks, .. } =
        record(scheme, analysis);
    let cost = scheme.plan().cost();
    let lines = [
        format!("{name}{}", title.map_or_else(String::new, |title| format!(": {title}"))),
        format!("for every T(p):  {}", order_text(&proved.proof.general)),
        format!("for quadratic T: {}", order_text(&proved.proof.quadratic)),
        format!("meant for:       {}", meant_for(proved.scheme.table.kinetic)),
        format!("weights:         {}", weights_text(digits(proved.scheme.held))),
        format!("symmetric:       {}", if symmetric { "yes" } else { "no" }),
        format!("a step:          stages {stages}, force evaluations {evaluations}; it begins with a {first}"),
        format!(
            "beside forces:   {} products and additions per dimension, {} more for the modified energy",
            cost.products_per_dimension, cost.products_for_beta
        ),
        format!("maps:            {}", maps_text(scheme)),
        analysis::lines(analysis).join("\n"),
        format!("reference:       {reference}"),
        format!("doi:             {}", doi.as_deref().unwrap_or("none")),
    ];
    let remarks: String = remarks.iter().map(|remark| format!("remark: {remark}\n")).collect();
    format!("{}\n{}\n{remarks}", lines.join("\n"), weights_table(scheme))
}

fn meant_for(kinetic: Kinetic) -> &'static str {
    match kinetic {
        Kinetic::Any => "every T(p)",
        Kinetic::Quadratic => "quadratic T only",
    }
}

fn weights_text(digits: Option<u32>) -> String {
    digits.map_or_else(|| "exact".to_owned(), |digits| format!("{digits} digits"))
}

fn order_text(order: &Order) -> String {
    let holds = match order.digits {
        None => format!("order {}, exactly", order.order),
        Some(digits) => format!("order {}, to {} digits", order.order, digits_text(Some(digits))),
    };
    match failed(order, |value| shortened(value, 16)) {
        None => holds,
        Some(Failed { condition, order, found, needed }) => {
            format!("{holds}; of order {order}, the condition of {condition} fails: found {found}, needed {needed}")
        }
    }
}

fn maps_text(scheme: &TableScheme) -> String {
    let maps = scheme.proved().scheme.maps().into_iter();
    maps.map(|map| format!("{} {}", map.kind, shortened(&map.weight, 6))).collect::<Vec<_>>().join(", ")
}

fn weights_table(scheme: &TableScheme) -> String {
    let weights = &scheme.proved().scheme;
    let rows = weights.kick.iter().zip(&weights.drift).enumerate();
    let rows = rows.map(|(i, (kick, drift))| [(i + 1).to_string(), shortened(kick, SHOWN), shortened(drift, SHOWN)]);
    table(["s", "kick a_s", "drift b_s"], rows.collect(), 0..1)
}
