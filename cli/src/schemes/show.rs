//! `shadowstep schemes show`: everything that is known about a scheme.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use sha2::{Digest, Sha256};
use shadowstep::Rational;
use shadowstep::tables::TableScheme;
use shadowstep_analysis::Analysis;
use shadowstep_analysis::stability::MOST_MAPS;
use shadowstep_analysis::trace::Trace;
use shadowstep_schemes::claims::HIGHEST_ORDER;
use shadowstep_schemes::map::Stages;
use shadowstep_schemes::proof::Order;
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{ExactScheme, First, Kinetic, Plan, Proved, to_significant, to_text};

use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::readable::{shortened, table, wrapped};
use crate::report::{self, Status};
use crate::schemes::analysis;
use crate::schemes::analysis::{ErrorRecord, Gap, Phase, Sizes};
use crate::schemes::facts::{
    aliases, digits, effective_near_integrable, kinetic, near_integrable, near_integrable_text,
};
use crate::schemes::plot;
use shadowstep_scenes::library;
use shadowstep_scenes::readable::digits as in_digits;
use shadowstep_scenes::{Error, WholeFile};

/// Everything that is known about a scheme.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// A shipped scheme, such as yoshida4, or a table's file, such as mine.toml
    #[arg(value_name = "NAME|FILE")]
    name: String,
    /// One JSON object with every digit of the weights
    #[arg(long)]
    json: bool,
    /// Draws the stages along the step, its stability and the error of its phase over hω into a new file, such as yoshida4.svg
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Replaces the file of --plot if it exists
    #[arg(long, requires = "plot")]
    force: bool,
}

/// Digits of a weight that a person reads.
const SHOWN: usize = 30;

/// In place of an order for every T(p).
const NO_GENERAL: &str = "none: gradient kicks contain M⁻¹ of a quadratic T";

/// The column of the facts.
const MARGIN: usize = 17;

/// Digits of what a condition of rounded weights was found to be.
const CONDITION_DIGITS: usize = 30;

#[derive(Serialize)]
struct Record {
    name: String,
    aliases: Vec<String>,
    title: Option<String>,
    /// For every T(p), as the three after it; `None` with gradient kicks, which there are for quadratic T only.
    order: Option<u32>,
    order_digits: Option<u32>,
    fails: Option<Failed>,
    order_quadratic: u32,
    order_quadratic_digits: Option<u32>,
    fails_quadratic: Option<Failed>,
    near_integrable: Vec<u32>,
    /// The map that moves by A of A + εB.
    dominant: Option<String>,
    free: Vec<String>,
    digits: Option<u32>,
    evaluations: usize,
    /// One for each gradient kick.
    hessian_products: usize,
    products_per_dimension: usize,
    products_for_beta: usize,
    /// Rows of the table of weights, those with a 0 included.
    stages: usize,
    symmetric: bool,
    first: &'static str,
    kinetic: &'static str,
    effective_error: f64,
    effective_error_quadratic: f64,
    leading_error: ErrorRecord,
    leading_error_quadratic: ErrorRecord,
    /// `None`, like the gaps and the trace, for steps of very many maps.
    stability_limit: Option<String>,
    unstable_gaps: Option<Vec<Gap>>,
    phase_error: Phase,
    /// The largest expected error of the energy over 0 < hω < evaluations; `None` where it is not known, or not bounded.
    sampling_error: Option<f64>,
    trace: Option<Vec<String>>,
    kick_sizes: Sizes,
    drift_sizes: Sizes,
    kick: Vec<String>,
    /// Empty where there are none.
    gradient_kick: Vec<String>,
    drift: Vec<String>,
    maps: Vec<Map>,
    reference: Option<String>,
    doi: Option<String>,
    table_hash: String,
    notes: Vec<String>,
    /// `None` for a scheme that is not processed.
    processor: Option<Processor>,
}

/// The post-map of a processed scheme, and what is proved of the processed step.
#[derive(Serialize)]
struct Processor {
    order: u32,
    order_digits: Option<u32>,
    fails: Option<Failed>,
    order_quadratic: u32,
    order_quadratic_digits: Option<u32>,
    fails_quadratic: Option<Failed>,
    near_integrable: Vec<u32>,
    /// Evaluations of the forces for an output, and for the pre-map.
    evaluations: usize,
    post: Vec<Map>,
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

pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let named = library::scheme(&arguments.name)?;
    named.note().iter().for_each(report::note);
    let scheme = named.scheme;
    let analysis = Analysis::of(scheme.proved());
    if let Some(path) = &arguments.plot {
        draw(path, arguments.force, &scheme, &analysis)?;
    }
    let mut output = Output::stdout();
    if arguments.json {
        output.json(&record(&scheme, &analysis))?;
    } else {
        write!(output, "{}", readable(&scheme, &analysis))?;
    }
    output.finish()?;
    Ok(Status::Success)
}

/// Draws into a file, which gets its name when it is complete.
fn draw(path: &Path, force: bool, scheme: &TableScheme, analysis: &Analysis) -> Result<(), Error> {
    let proved = scheme.proved();
    let picture = plot::picture(&proved.scheme.table.name.value, proved, analysis)?;
    let _interrupt = Interrupt::listen("schemes show", "run the command again");
    let mut file = if force { WholeFile::create(path, "--plot")? } else { WholeFile::create_new(path, "--plot")? };
    writeln!(file, "{picture}")?;
    file.finish()
}

fn record(scheme: &TableScheme, analysis: &Analysis) -> Record {
    let proved = scheme.proved();
    let (proof, weights, table) = (&proved.proof, &proved.scheme, &proved.scheme.table);
    let fractions = |weights: &[Rational]| weights.iter().map(Rational::to_string).collect::<Vec<_>>();
    let maps = weights.maps().into_iter();
    // the value of a condition of rounded weights is known to this number of digits only
    let exact = |value: &Rational| match weights.held {
        Held::Digits(_) if to_text(value).len() > CONDITION_DIGITS => to_significant(value, CONDITION_DIGITS),
        _ => to_text(value),
    };
    let cost = scheme.plan().cost();
    let general = proved.order_for_every_kinetic();
    Record {
        name: table.name.value.clone(),
        aliases: aliases(table),
        title: table.title.clone(),
        order: general.map(|order| order.order),
        order_digits: general.and_then(|order| order.digits),
        fails: general.and_then(|order| failed(order, exact)),
        order_quadratic: proof.quadratic.order,
        order_quadratic_digits: proof.quadratic.digits,
        fails_quadratic: failed(&proof.quadratic, exact),
        near_integrable: near_integrable(proof),
        dominant: table.near_integrable.as_ref().map(|claim| claim.dominant.to_string()),
        free: table.free.iter().map(|name| name.value.clone()).collect(),
        digits: digits(weights.held),
        evaluations: scheme.plan().evaluations,
        hessian_products: scheme.plan().hessian_products,
        products_per_dimension: cost.products_per_dimension,
        products_for_beta: cost.products_for_beta,
        stages: weights.stages.kick.len(),
        symmetric: proof.symmetric,
        first: first(weights.first()),
        kinetic: kinetic(table.kinetic),
        effective_error: analysis.effective_error(Kinetic::Any),
        effective_error_quadratic: analysis.effective_error(Kinetic::Quadratic),
        leading_error: ErrorRecord::of(&analysis.general),
        leading_error_quadratic: ErrorRecord::of(&analysis.quadratic),
        trace: trace(weights),
        kick_sizes: Sizes::of(&analysis.kicks),
        drift_sizes: Sizes::of(&analysis.drifts),
        phase_error: Phase::of(analysis.phase),
        sampling_error: analysis.sampling.and_then(|sampling| sampling.largest),
        unstable_gaps: analysis.stability.as_ref().map(|stability| stability.gaps.iter().map(Gap::of).collect()),
        stability_limit: analysis.stability.as_ref().map(|stability| stability.limit.clone()),
        kick: fractions(&weights.stages.kick),
        gradient_kick: fractions(&weights.stages.gradient_kick),
        drift: fractions(&weights.stages.drift),
        maps: maps.map(|map| Map { map: map.kind.to_string(), weight: to_text(&map.weight) }).collect(),
        reference: table.reference.clone(),
        doi: table.doi.clone(),
        table_hash: Sha256::digest(&table.source.text).iter().map(|byte| format!("{byte:02x}")).collect(),
        notes: proved.notes.iter().map(ToString::to_string).collect(),
        processor: processor(proved, exact),
    }
}

fn processor(proved: &Proved, text: impl Fn(&Rational) -> String) -> Option<Processor> {
    let (processor, effective) = (proved.scheme.processor.as_ref()?, proved.proof.effective.as_ref()?);
    let post = processor.post.iter().map(|map| Map { map: map.kind.to_string(), weight: to_text(&map.weight) });
    Some(Processor {
        order: effective.general.order,
        order_digits: effective.general.digits,
        fails: failed(&effective.general, &text),
        order_quadratic: effective.quadratic.order,
        order_quadratic_digits: effective.quadratic.digits,
        fails_quadratic: failed(&effective.quadratic, &text),
        near_integrable: effective_near_integrable(&proved.proof),
        evaluations: processor.evaluations(),
        post: post.collect(),
    })
}

/// The coefficients of the trace polynomial: exact where the weights are, which else are hundreds of digits long; 30
/// digits of the others.
fn trace(scheme: &ExactScheme) -> Option<Vec<String>> {
    let maps = scheme.maps();
    if maps.len() > MOST_MAPS {
        return None;
    }
    let trace = Trace::of(&maps);
    let text = |k| match scheme.held {
        Held::Exactly => to_text(&trace.coefficient(k)),
        Held::Digits(_) => to_significant(&trace.unreduced_coefficient(k), 30),
    };
    Some((0..=trace.degree()).map(text).collect())
}

fn failed(order: &Order, text: impl Fn(&Rational) -> String) -> Option<Failed> {
    order.failed.as_ref().map(|(condition, found)| Failed {
        condition: condition.functional.to_string(),
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

fn readable(scheme: &TableScheme, analysis: &Analysis) -> String {
    let proved = scheme.proved();
    let table = &proved.scheme.table;
    let facts = facts(scheme).into_iter().chain(analysis::facts(analysis)).chain(source(table));
    let title = table.title.as_ref().map_or_else(String::new, |title| format!(": {title}"));
    let mut text = format!("{}{title}\n", table.name.value);
    for (what, fact) in facts {
        let lines = wrapped(&fact, &" ".repeat(MARGIN));
        text += &format!("{:1$}", format!("{what}:"), MARGIN);
        text += lines.get(MARGIN..).unwrap_or("\n");
    }
    text += &format!("{}\n", weights_table(scheme));
    text.extend(proved.notes.iter().map(|note| format!("note: {note}\n")));
    text
}

/// The facts about the scheme itself, each with its name.
fn facts(scheme: &TableScheme) -> Vec<(String, String)> {
    let proved = scheme.proved();
    let (proof, table, plan) = (&proved.proof, &proved.scheme.table, scheme.plan());
    let cost = plan.cost();
    let mut facts = vec![
        ("also named".to_owned(), aliases(table).join(", ")),
        ("every T(p)".to_owned(), proved.order_for_every_kinetic().map_or_else(|| NO_GENERAL.to_owned(), order_text)),
        ("quadratic T".to_owned(), order_text(&proof.quadratic)),
        ("H = A + εB".to_owned(), near_integrable_fact(proved)),
        ("meant for".to_owned(), meant_for(table.kinetic).to_owned()),
        ("weights".to_owned(), weights_text(digits(proved.scheme.held))),
        ("symmetric".to_owned(), if proof.symmetric { "yes" } else { "no" }.to_owned()),
        (
            "a step".to_owned(),
            format!(
                "{} force evaluations{}, {} kicks and drifts; it begins with a {}",
                plan.evaluations,
                hessian_products(plan),
                proved.scheme.maps().len(),
                first(proved.scheme.first())
            ),
        ),
        (
            "beside forces".to_owned(),
            format!(
                "{} products and additions per dimension, {} more for the modified energy",
                cost.products_per_dimension, cost.products_for_beta
            ),
        ),
        ("maps".to_owned(), maps_text(scheme)),
    ];
    facts.extend(processor_facts(proved));
    facts.retain(|(_, fact)| !fact.is_empty());
    facts
}

/// The Hessian–vector products U_qq M⁻¹U_q of a step, if there are any: their cost is stated apart.
fn hessian_products(plan: &Plan) -> String {
    match plan.hessian_products {
        0 => String::new(),
        1 => " and 1 Hessian–vector product".to_owned(),
        count => format!(" and {count} Hessian–vector products"),
    }
}

/// What is proved of a processed scheme: the other orders are those of its kernel.
fn processor_facts(proved: &Proved) -> Vec<(String, String)> {
    let (Some(processor), Some(effective)) = (&proved.scheme.processor, &proved.proof.effective) else {
        return Vec::new();
    };
    let near = match effective_near_integrable(&proved.proof) {
        orders if orders.is_empty() => String::new(),
        orders => format!("orders {} in the powers of ε", near_integrable_text(&orders)),
    };
    let cost = format!(
        "{} force evaluations, {} kicks and drifts for an output, and as many once at the beginning; the orders above and \
         the cost of a step are those of the kernel",
        processor.evaluations(),
        processor.post.len()
    );
    let general = match proved.scheme.has_gradient_kicks() {
        true => NO_GENERAL.to_owned(),
        false => order_text(&effective.general),
    };
    vec![
        ("processor".to_owned(), cost),
        ("effective".to_owned(), format!("for every T(p), {general}")),
        ("quadratic T".to_owned(), format!("effective {}", order_text(&effective.quadratic))),
        ("A + εB".to_owned(), near.replacen("orders", "effective orders", 1)),
    ]
}

fn source(table: &Table) -> [(String, String); 2] {
    let or_none = |text: &Option<String>| text.as_deref().unwrap_or("none").to_owned();
    [("reference".to_owned(), or_none(&table.reference)), ("doi".to_owned(), or_none(&table.doi))]
}

fn near_integrable_fact(proved: &Proved) -> String {
    let orders = near_integrable(&proved.proof);
    let claim = proved.scheme.table.near_integrable.as_ref().map(|claim| claim.dominant);
    claim.map_or_else(String::new, |dominant| {
        let orders = near_integrable_text(&orders);
        format!(
            "orders {orders} in the powers of ε, where the {dominant}s move by A; this pays only if they solve A exactly and εB \
             is small, and with H = T + U it gains nothing"
        )
    })
}

fn meant_for(kinetic: Kinetic) -> &'static str {
    match kinetic {
        Kinetic::Any => "every T(p)",
        Kinetic::Quadratic => "quadratic T only",
    }
}

fn weights_text(digits: Option<u32>) -> String {
    digits.map_or_else(|| "exact".to_owned(), in_digits)
}

fn order_text(order: &Order) -> String {
    let holds = match order.digits {
        None => format!("order {}, exactly", order.order),
        Some(digits) => format!("order {}, to {}", order.order, in_digits(digits)),
    };
    match failed(order, |value| shortened(value, 16)) {
        None => format!("{holds}; more than order {HIGHEST_ORDER} is not looked for"),
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
    let Stages { kick, gradient_kick, drift } = &weights.stages;
    let columns = [("kick a_s", kick), ("gradient kick c_s", gradient_kick), ("drift b_s", drift)];
    let columns: Vec<_> = columns.into_iter().filter(|(_, weights)| !weights.is_empty()).collect();
    let row = |s: usize| {
        let weights = columns.iter().map(|(_, weights)| shortened(&weights[s], SHOWN));
        std::iter::once((s + 1).to_string()).chain(weights).collect::<Vec<_>>()
    };
    let header = std::iter::once("s").chain(columns.iter().map(|(name, _)| *name));
    table(header, (0..kick.len()).map(row).collect(), 0..1)
}
