//! `shadowstep schemes show`: everything that is known about a scheme.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use shadowstep::Rational;
use shadowstep_analysis::Analysis;
use shadowstep_analysis::certificate::{Certificate, Kind};
use shadowstep_analysis::resonance::{REPORTED, resonances};
use shadowstep_schemes::claims::HIGHEST_ORDER;
use shadowstep_schemes::map::Stages;
use shadowstep_schemes::proof::Order;
use shadowstep_schemes::scheme::{ExactInner, ExactScheme, Held};
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{Kinetic, MapKind, Proved, StepPlan, counted, to_significant};

use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::plot::check_ending;
use crate::readable::{shortened, table, wrapped};
use crate::report::{self, Status};
use crate::schemes::analysis::{self, Fact};
use crate::schemes::columns::yes_or_no;
use crate::schemes::plot;
use shadowstep_scenes::library;
use shadowstep_scenes::scheme_record::SchemeFacts;
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
    let proved = named.scheme.proved();
    if let Some(path) = &arguments.plot {
        draw(path, arguments.force, proved)?;
    }
    let facts = SchemeFacts::of(proved);
    let record = std::iter::once_with(|| facts.record());
    Output::stdout().records_or_text(arguments.json, record, || readable(&facts))?;
    Ok(Status::Success)
}

/// Draws into a file, which gets its name when it is complete.
fn draw(path: &Path, force: bool, proved: &Proved) -> Result<(), Error> {
    check_ending(path, "scheme.svg")?;
    let picture = plot::picture(&proved.scheme.table.name.value, proved, &Analysis::of(proved));
    let _interrupt = Interrupt::listen("schemes show", "run the command again");
    let mut file = if force { WholeFile::create(path, "--plot")? } else { WholeFile::create_new(path, "--plot")? };
    writeln!(file, "{picture}")?;
    file.finish()
}

fn readable(scheme: &SchemeFacts<'_>) -> String {
    let (proved, table) = (scheme.proved, scheme.table());
    let mut all = vec![("also named", scheme.aliases().join(", "))];
    match &proved.scheme.inner {
        Some(inner) => all.extend(nested_facts(proved, inner)),
        None => all.extend(facts(proved).into_iter().chain(processor_facts(proved)).chain(analysis::facts(scheme))),
    }
    all.extend(source(table));
    let title = table.title.as_ref().map_or_else(String::new, |title| format!(": {title}"));
    let mut text = format!("{}{title}\n", table.name.value);
    for (what, fact) in all.into_iter().filter(|(_, fact)| !fact.is_empty()) {
        let lines = wrapped(&fact, &" ".repeat(MARGIN));
        text += &format!("{:1$}", format!("{what}:"), MARGIN);
        text += lines.get(MARGIN..).unwrap_or("\n");
    }
    text += &format!("{}\n", weights_table(&proved.scheme.stages));
    text.extend(proved.notes.iter().map(|note| format!("note: {note}\n")));
    text
}

/// The facts about the scheme itself.
fn facts(proved: &Proved) -> Vec<Fact> {
    let Proved { scheme, plan, .. } = proved;
    let (orders, cost) = (proved.orders_of_steps(), plan.cost());
    let of_kernel = if scheme.processor.is_some() { "of the kernel, " } else { "" };
    let only = if scheme.table.kinetic == Kinetic::Any { "" } else { " only" };
    let step = format!(
        "{} force evaluations{}, {} kicks and drifts; it begins with a {}",
        plan.evaluations,
        hessian_products(plan),
        scheme.maps().len(),
        scheme.first()
    );
    let beside_forces = format!(
        "{} products and additions per dimension, {} more for the modified energy",
        cost.products_per_dimension, cost.products_for_beta
    );
    vec![
        ("every T(p)", format!("{of_kernel}{}", general_text(orders.general))),
        ("quadratic T", format!("{of_kernel}{}", order_text(orders.quadratic))),
        ("H = A + εB", near_integrable_fact(proved)),
        ("meant for", format!("{}{only}", scheme.table.kinetic)),
        ("weights", weights_text(scheme.held)),
        ("proof", proof_text(proved)),
        ("symmetric", yes_or_no(proved.proof.symmetric).to_owned()),
        ("a step", step),
        ("beside forces", beside_forces),
        ("maps", maps_text(scheme)),
    ]
}

/// The facts about a scheme of multiple time steps.
fn nested_facts(proved: &Proved, inner: &ExactInner) -> Vec<Fact> {
    let nested = proved.for_many_parts().expect("a scheme with an inner scheme has steps of three parts");
    let (slow, fast) = (nested.plan.evaluations, nested.plan.count(MapKind::Drift));
    let (steps, name) = (counted(inner.substeps, "step"), &inner.scheme.table.name.value);
    let step = format!(
        "{} of the slow forces, {fast} of the fast ones where these depend on q only; it begins with a slow kick",
        counted(slow, "evaluation")
    );
    let mut facts = vec![
        ("meant for", "H of three parts: slow forces, fast forces and T, for multiple time steps".to_owned()),
        ("order", order_text(proved.order())),
        ("outer scheme", format!("for two parts {}; below are its weights", order_text(&proved.proof.general))),
        ("inner scheme", format!("{steps} of {name} in each drift of the outer scheme")),
        ("weights", weights_text(proved.scheme.held)),
        ("symmetric", yes_or_no(proved.proof.symmetric).to_owned()),
        ("a step", step),
    ];
    facts.extend(resonance_facts(proved, fast).into_iter().map(|fact| ("resonance", fact)));
    facts
}

/// The first resonance of an oscillation for each of the ratios, and how many there are up to hω = 2·(drifts of a
/// step).
fn resonance_facts(proved: &Proved, substeps: usize) -> Vec<String> {
    let fact = |parts: i64| {
        let resonances = resonances(proved, &Rational::new(1.into(), parts.into()))?;
        let first = resonances.gaps.first()?;
        let to = first.to.as_ref().map_or_else(|| "on".to_owned(), |to| format!("to {}", shortened_text(to)));
        let others = match resonances.gaps.len() - 1 {
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

/// The Hessian–vector products U_qq M⁻¹U_q of a step, if there are any: their cost is stated apart.
fn hessian_products(plan: &StepPlan) -> String {
    match plan.hessian_products {
        0 => String::new(),
        count => format!(" and {}", counted(count, "Hessian–vector product")),
    }
}

/// What is proved of a processed scheme: the other orders are those of its kernel.
fn processor_facts(proved: &Proved) -> Vec<Fact> {
    let Some(processor) = &proved.scheme.processor else { return Vec::new() };
    let effective = proved.orders();
    let near = match effective.in_epsilon() {
        orders if orders.is_empty() => orders,
        orders => format!("effective orders {orders} in the powers of ε"),
    };
    let cost = format!(
        "{} force evaluations, {} kicks and drifts for an output, and as many once at the beginning; the cost of \
         a step is that of the kernel",
        processor.evaluations(),
        processor.post.len()
    );
    vec![
        ("processor", cost),
        ("effective", format!("for every T(p), {}", general_text(effective.general))),
        ("quadratic T", format!("effective {}", order_text(effective.quadratic))),
        ("A + εB", near),
    ]
}

fn source(table: &Table) -> [Fact; 2] {
    let or_none = |text: &Option<String>| text.as_deref().unwrap_or("none").to_owned();
    [("reference", or_none(&table.reference)), ("doi", or_none(&table.doi))]
}

fn near_integrable_fact(proved: &Proved) -> String {
    let claim = proved.scheme.table.near_integrable.as_ref().map(|claim| claim.dominant);
    claim.map_or_else(String::new, |dominant| {
        let orders = proved.orders_of_steps().in_epsilon();
        format!(
            "orders {orders} in the powers of ε, where the {dominant}s move by A; this pays only if they solve A \
             exactly and εB is small, and with H = T + U it gains nothing"
        )
    })
}

fn weights_text(held: Held) -> String {
    held.digits().map_or_else(|| "exact".to_owned(), |digits| counted(digits, "digit"))
}

/// What kind of proof the order for every T(p) has.
fn proof_text(proved: &Proved) -> String {
    let Some(certificate) = Certificate::of(proved) else { return String::new() };
    match (&certificate.kind, &certificate.enclosure) {
        (Kind::Exact, _) => "exact: rational weights".to_owned(),
        (Kind::Algebraic(roots), _) => {
            let roots = if roots.len() == 1 { "a root".to_owned() } else { format!("{} roots", roots.len()) };
            format!("algebraic: exact in the weights as polynomials in {roots}")
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

fn general_text(order: Option<&Order>) -> String {
    order.map_or_else(|| NO_GENERAL.to_owned(), order_text)
}

fn order_text(order: &Order) -> String {
    let holds = format!("order {}, {}", order.order, order.held());
    match &order.failed {
        None => format!("{holds}; more than order {HIGHEST_ORDER} is not looked for"),
        Some((condition, value)) => {
            let [value, needed] = [value, &condition.needed].map(|value| shortened(value, 16));
            let (order, functional) = (condition.order, &condition.functional);
            format!("{holds}; of order {order}, the condition of {functional} fails: found {value}, needed {needed}")
        }
    }
}

fn maps_text(scheme: &ExactScheme) -> String {
    let maps = scheme.maps().into_iter();
    maps.map(|map| format!("{} {}", map.kind, shortened(&map.weight, 6))).collect::<Vec<_>>().join(", ")
}

fn weights_table(Stages { kick, gradient_kick, drift }: &Stages) -> String {
    let columns = [("kick a_s", kick), ("gradient kick c_s", gradient_kick), ("drift b_s", drift)];
    let columns: Vec<_> = columns.into_iter().filter(|(_, weights)| !weights.is_empty()).collect();
    let row = |s: usize| {
        let weights = columns.iter().map(|(_, weights)| shortened(&weights[s], SHOWN));
        std::iter::once((s + 1).to_string()).chain(weights).collect::<Vec<_>>()
    };
    let header = std::iter::once("s").chain(columns.iter().map(|(name, _)| *name));
    table(header, (0..kick.len()).map(row).collect(), 0..1)
}
