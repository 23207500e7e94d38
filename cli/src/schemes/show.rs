//! `shadowstep schemes show`: everything that is known about a scheme.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use shadowstep::Rational;
use shadowstep::tables::TableScheme;
use shadowstep_analysis::Analysis;
use shadowstep_analysis::certificate::{Certificate, Kind};
use shadowstep_analysis::resonance::{REPORTED, resonances};
use shadowstep_schemes::claims::HIGHEST_ORDER;
use shadowstep_schemes::map::Stages;
use shadowstep_schemes::proof::Order;
use shadowstep_schemes::scheme::ExactInner;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{Kinetic, MapKind, Proof, Proved, StepPlan, to_significant};

use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::plot::check_ending;
use crate::readable::{shortened, table, wrapped};
use crate::report::{self, Status};
use crate::schemes::analysis;
use crate::schemes::facts::near_integrable_text;
use crate::schemes::plot;
use shadowstep_scenes::library;
use shadowstep_scenes::readable::digits as in_digits;
use shadowstep_scenes::scheme_record::{
    SchemeRecord, aliases, digits, effective_near_integrable, first, near_integrable,
};
use shadowstep_scenes::{Error, WholeFile};

/// Everything that is known about a scheme.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// A shipped scheme, such as yoshida4, or the file of a table
    #[arg(value_name = "NAME|FILE")]
    name: String,
    /// One JSON object with every digit of the weights
    #[arg(long)]
    json: bool,
    /// Draws stages, stability and phase error into a new file
    ///
    /// The stages are drawn along the step, its stability and the error of its phase over hω. The file has a name such
    /// as yoshida4.svg.
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

pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let named = library::scheme(&arguments.name)?;
    named.note().iter().for_each(report::note);
    let scheme = named.quadratic();
    let analysis = Analysis::of(scheme.proved());
    if let Some(path) = &arguments.plot {
        draw(path, arguments.force, &scheme, &analysis)?;
    }
    let mut output = Output::stdout();
    if arguments.json {
        output.json(&SchemeRecord::of(&scheme, &analysis))?;
    } else {
        write!(output, "{}", readable(&scheme, &analysis))?;
    }
    output.finish()?;
    Ok(Status::Success)
}

/// Draws into a file, which gets its name when it is complete.
fn draw(path: &Path, force: bool, scheme: &TableScheme, analysis: &Analysis) -> Result<(), Error> {
    check_ending(path, "scheme.svg")?;
    let proved = scheme.proved();
    let picture = plot::picture(&proved.scheme.table.name.value, proved, analysis);
    let _interrupt = Interrupt::listen("schemes show", "run the command again");
    let mut file = if force { WholeFile::create(path, "--plot")? } else { WholeFile::create_new(path, "--plot")? };
    writeln!(file, "{picture}")?;
    file.finish()
}

fn readable(scheme: &TableScheme, analysis: &Analysis) -> String {
    let proved = scheme.proved();
    let table = &proved.scheme.table;
    let facts: Vec<_> = match &proved.scheme.inner {
        Some(inner) => nested_facts(proved, inner).into_iter().chain(source(table)).collect(),
        None => facts(scheme).into_iter().chain(analysis::facts(analysis)).chain(source(table)).collect(),
    };
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
    let of_kernel = if proof.effective.is_some() { "of the kernel, " } else { "" };
    let mut facts = vec![
        ("also named".to_owned(), aliases(table).join(", ")),
        (
            "every T(p)".to_owned(),
            format!(
                "{of_kernel}{}",
                proved.order_for_every_kinetic().map_or_else(|| NO_GENERAL.to_owned(), order_text)
            ),
        ),
        ("quadratic T".to_owned(), format!("{of_kernel}{}", order_text(&proof.quadratic))),
        ("H = A + εB".to_owned(), near_integrable_fact(proved)),
        ("meant for".to_owned(), meant_for(table.kinetic).to_owned()),
        ("weights".to_owned(), weights_text(digits(proved.scheme.held))),
        ("proof".to_owned(), proof_text(proved)),
        ("symmetric".to_owned(), symmetry(proof).to_owned()),
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

/// The facts about a scheme of multiple time steps.
fn nested_facts(proved: &Proved, inner: &ExactInner) -> Vec<(String, String)> {
    let (proof, table) = (&proved.proof, &proved.scheme.table);
    let nested = proved.for_many_parts().expect("a scheme with an inner scheme has steps of three parts");
    let (slow, fast) = (nested.plan.evaluations, nested.plan.count(MapKind::Drift));
    let counted = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let mut facts = vec![
        ("also named", aliases(table).join(", ")),
        ("meant for", "H of three parts: slow forces, fast forces and T, for multiple time steps".to_owned()),
        ("order", order_text(proved.order())),
        ("outer scheme", format!("for two parts {}; below are its weights", order_text(&proof.general))),
        (
            "inner scheme",
            format!(
                "{} of {} in each drift of the outer scheme",
                counted(inner.substeps as usize, "step"),
                inner.scheme.table.name.value
            ),
        ),
        ("weights", weights_text(digits(proved.scheme.held))),
        ("symmetric", symmetry(proof).to_owned()),
        (
            "a step",
            format!(
                "{} of the slow forces, {fast} of the fast ones where these depend on q only; it begins with a slow kick",
                counted(slow, "evaluation")
            ),
        ),
    ];
    facts.extend(resonance_facts(proved, fast).into_iter().map(|fact| ("resonance", fact)));
    facts.into_iter().filter(|(_, fact)| !fact.is_empty()).map(|(what, fact)| (what.to_owned(), fact)).collect()
}

/// The first resonance of an oscillation for each of the ratios, and how many there are up to hω = 2·(drifts of a
/// step).
fn resonance_facts(proved: &Proved, substeps: usize) -> Vec<String> {
    let fact = |parts: i64| {
        let found = resonances(proved, &Rational::new(1.into(), parts.into()))?;
        let first = found.gaps.first()?;
        let to = first.to.as_ref().map_or_else(|| "on".to_owned(), |to| format!("to {}", shortened_text(to)));
        let others = match found.gaps.len() - 1 {
            0 => String::new(),
            1 => format!(", and in another interval up to {}", 2 * substeps),
            more => format!(", and in {more} other intervals up to {}", 2 * substeps),
        };
        Some(format!(
            "an oscillation whose slow forces have 1/{parts} of the stiffness of its fast ones is unstable for hω \
                from {} {to}, {:.3e} wide{others}",
            shortened_text(&first.from),
            first.width
        ))
    };
    REPORTED.into_iter().filter_map(fact).collect()
}

/// The first digits of a number in a text.
fn shortened_text(number: &str) -> &str {
    number.get(..7).unwrap_or(number)
}

fn symmetry(proof: &Proof) -> &'static str {
    if proof.symmetric { "yes" } else { "no" }
}

/// The Hessian–vector products U_qq M⁻¹U_q of a step, if there are any: their cost is stated apart.
fn hessian_products(plan: &StepPlan) -> String {
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
        "{} force evaluations, {} kicks and drifts for an output, and as many once at the beginning; the cost of \
         a step is that of the kernel",
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
            "orders {orders} in the powers of ε, where the {dominant}s move by A; this pays only if they solve A \
             exactly and εB is small, and with H = T + U it gains nothing"
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

/// What kind of proof the order for every T(p) has.
fn proof_text(proved: &Proved) -> String {
    let Some(certificate) = Certificate::of(proved) else { return String::new() };
    match (&certificate.kind, &certificate.enclosure) {
        (Kind::Exact, _) => "exact: rational weights".to_owned(),
        (Kind::Algebraic(roots), _) if roots.len() == 1 => {
            "algebraic: exact in the weights as polynomials in a root".to_owned()
        }
        (Kind::Algebraic(roots), _) => {
            format!("algebraic: exact in the weights as polynomials in {} roots", roots.len())
        }
        (Kind::Decimal(_), Some(enclosure)) => {
            let held = match enclosure.held() {
                0 => String::new(),
                held => format!(", {held} of {} held", enclosure.weights.len()),
            };
            let radius = to_significant(&enclosure.radius, 2);
            format!(
                "certified enclosure: one solution of the conditions for every T(p) within {radius} of the \
                    weights{held}"
            )
        }
        (Kind::Decimal(_), None) => "decimal: the conditions hold to the digits of the weights".to_owned(),
    }
}

fn order_text(order: &Order) -> String {
    let holds = match order.digits {
        None => format!("order {}, exactly", order.order),
        Some(digits) => format!("order {}, to {}", order.order, in_digits(digits)),
    };
    match &order.failed {
        None => format!("{holds}; more than order {HIGHEST_ORDER} is not looked for"),
        Some((condition, found)) => {
            let [found, needed] = [found, &condition.needed].map(|value| shortened(value, 16));
            let (order, functional) = (condition.order, &condition.functional);
            format!("{holds}; of order {order}, the condition of {functional} fails: found {found}, needed {needed}")
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
