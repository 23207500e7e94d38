//! Everything that is known about a scheme, as a record.

use serde::Serialize;
use sha2::{Digest, Sha256};
use shadowstep::Rational;
use shadowstep::tables::TableScheme;
use shadowstep_analysis::bracket::Bracket;
use shadowstep_analysis::error::LeadingError;
use shadowstep_analysis::resonance::{REPORTED, resonances};
use shadowstep_analysis::stability::MOST_MAPS;
use shadowstep_analysis::trace::Trace;
use shadowstep_analysis::{self as analysis, Analysis, stability, trace};
use shadowstep_schemes::proof::Order;
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{ExactScheme, First, Kinetic, MapKind, Proof, Proved, to_significant, to_text};

/// Digits of what a condition of rounded weights was found to be.
const CONDITION_DIGITS: usize = 30;

/// Everything that is known about a scheme; exact numbers are texts, with every digit of the weights.
#[derive(Debug, Serialize)]
pub struct SchemeRecord {
    name: String,
    aliases: Vec<String>,
    title: Option<String>,
    /// Of a processed scheme the effective ones.
    #[serde(flatten)]
    orders: Orders,
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
    /// `None`, like the gaps and the trace, for steps of very many maps.
    stability_limit: Option<String>,
    unstable_gaps: Option<Vec<Gap>>,
    phase_error: Phase,
    /// The largest expected error of the energy over 0 < hω < evaluations; `None` where it is not known, or not
    /// bounded.
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
    /// `None` for a scheme without an inner one; the other values are of the outer scheme for two parts.
    inner: Option<Inner>,
    /// The orders and errors of the kernel of a processed scheme, whose steps are made.
    kernel: Option<Orders>,
}

/// Orders and leading errors.
#[derive(Debug, Serialize)]
struct Orders {
    /// For every T(p), as the three after it; `None` with gradient kicks, which there are for quadratic T only.
    order: Option<u32>,
    order_digits: Option<u32>,
    fails: Option<Failed>,
    order_quadratic: u32,
    order_quadratic_digits: Option<u32>,
    fails_quadratic: Option<Failed>,
    near_integrable: Vec<u32>,
    effective_error: f64,
    effective_error_quadratic: f64,
    leading_error: ErrorRecord,
    leading_error_quadratic: ErrorRecord,
}

/// The inner scheme of multiple time steps, and what is proved of the step of slow forces, fast forces and T.
#[derive(Debug, Serialize)]
struct Inner {
    base: String,
    substeps: u32,
    order: u32,
    /// Evaluations of the fast forces, where these depend on q only.
    fast_evaluations: usize,
    resonances: Vec<Resonances>,
}

/// Where an oscillation is unstable whose slow forces have a part of the stiffness of the fast ones.
#[derive(Debug, Serialize)]
struct Resonances {
    /// That part.
    ratio: String,
    gaps: Vec<Gap>,
}

/// The post-map of a processed scheme.
#[derive(Debug, Serialize)]
struct Processor {
    /// Evaluations of the forces for an output, and for the pre-map.
    evaluations: usize,
    post: Vec<Map>,
}

/// The first condition of the order that fails.
#[derive(Debug, Serialize)]
struct Failed {
    condition: String,
    order: u32,
    found: String,
    needed: String,
}

#[derive(Debug, Serialize)]
struct Map {
    map: String,
    weight: String,
}

/// The leading error of log(step) for one class of kinetic energies.
#[derive(Debug, Serialize)]
struct ErrorRecord {
    power: u32,
    norm: f64,
    terms: Vec<Term>,
}

#[derive(Debug, Serialize)]
struct Term {
    bracket: String,
    coefficient: f64,
}

#[derive(Debug, Serialize)]
struct Gap {
    from: String,
    /// `None` beyond 2·(evaluations).
    to: Option<String>,
    width: f64,
}

/// (φ − hω)/hω = coefficient·(hω)^power + …
#[derive(Debug, Serialize)]
struct Phase {
    coefficient: f64,
    power: u32,
}

#[derive(Debug, Serialize)]
struct Sizes {
    sum_of_sizes: String,
    smallest: String,
    largest: String,
}

impl ErrorRecord {
    fn of(error: &LeadingError) -> ErrorRecord {
        let term = |(bracket, c): &(Bracket, f64)| Term { bracket: bracket.to_string(), coefficient: *c };
        ErrorRecord { power: error.power, norm: error.norm(), terms: error.terms.iter().map(term).collect() }
    }
}

impl Gap {
    fn of(gap: &stability::Gap) -> Gap {
        Gap { from: gap.from.clone(), to: gap.to.clone(), width: gap.width }
    }
}

impl Phase {
    fn of(phase: trace::PhaseError) -> Phase {
        Phase { coefficient: phase.coefficient, power: phase.power }
    }
}

impl Sizes {
    fn of(sizes: &analysis::Sizes) -> Sizes {
        Sizes {
            sum_of_sizes: to_text(&sizes.sum_of_sizes),
            smallest: to_text(&sizes.smallest),
            largest: to_text(&sizes.largest),
        }
    }
}

impl SchemeRecord {
    /// The record of a scheme; its analysis takes some milliseconds.
    pub fn of(scheme: &TableScheme, analysis: &Analysis) -> SchemeRecord {
        let proved = scheme.proved();
        let (proof, weights, table) = (&proved.proof, &proved.scheme, &proved.scheme.table);
        let fractions = |weights: &[Rational]| weights.iter().map(Rational::to_string).collect::<Vec<_>>();
        let maps = weights.maps().into_iter();
        let cost = scheme.plan().cost();
        let (orders, kernel) = orders(proved, analysis);
        SchemeRecord {
            name: table.name.value.clone(),
            aliases: aliases(table),
            title: table.title.clone(),
            orders,
            kernel,
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
            processor: processor(proved),
            inner: inner(proved),
        }
    }
}

/// The orders; of a processed scheme those after processing, and those of the steps alone.
fn orders(proved: &Proved, analysis: &Analysis) -> (Orders, Option<Orders>) {
    let (proof, scheme) = (&proved.proof, &proved.scheme);
    // the value of a condition of rounded weights is known to this number of digits only
    let exact = |value: &Rational| match scheme.held {
        Held::Digits(_) if to_text(value).len() > CONDITION_DIGITS => to_significant(value, CONDITION_DIGITS),
        _ => to_text(value),
    };
    let effective = |kinetic| analysis.processed_effective_error(kinetic);
    let processed = proof.effective.as_ref().zip(analysis.processed.as_ref()).map(|(proved_effective, errors)| {
        let general = (!scheme.has_gradient_kicks()).then_some(&proved_effective.general);
        let orders = (general, &proved_effective.quadratic, effective_near_integrable(proof));
        Orders::of(orders, [&errors[0], &errors[1]], effective, exact)
    });
    let orders = (proved.order_for_every_kinetic(), &proof.quadratic, near_integrable(proof));
    let errors = [&analysis.general, &analysis.quadratic];
    let of_steps = Orders::of(orders, errors, |kinetic| analysis.effective_error(kinetic), exact);
    match processed {
        Some(processed) => (processed, Some(of_steps)),
        None => (of_steps, None),
    }
}

impl Orders {
    fn of(
        (general, quadratic, near_integrable): (Option<&Order>, &Order, Vec<u32>),
        [error, error_quadratic]: [&LeadingError; 2],
        effective: impl Fn(Kinetic) -> f64,
        text: impl Fn(&Rational) -> String,
    ) -> Orders {
        Orders {
            order: general.map(|order| order.order),
            order_digits: general.and_then(|order| order.digits),
            fails: general.and_then(|order| failed(order, &text)),
            order_quadratic: quadratic.order,
            order_quadratic_digits: quadratic.digits,
            fails_quadratic: failed(quadratic, &text),
            near_integrable,
            effective_error: effective(Kinetic::Any),
            effective_error_quadratic: effective(Kinetic::Quadratic),
            leading_error: ErrorRecord::of(error),
            leading_error_quadratic: ErrorRecord::of(error_quadratic),
        }
    }
}

fn inner(proved: &Proved) -> Option<Inner> {
    let inner = proved.scheme.inner.as_ref()?;
    let (maps, _) = inner.step(&proved.scheme.maps());
    let of_ratio = |parts: i64| {
        let ratio = Rational::new(1.into(), parts.into());
        let gaps = resonances(proved, &ratio)?.gaps.iter().map(Gap::of).collect();
        Some(Resonances { ratio: to_text(&ratio), gaps })
    };
    Some(Inner {
        base: inner.scheme.table.name.value.clone(),
        substeps: inner.substeps,
        order: proved.order().order,
        fast_evaluations: maps.iter().filter(|map| map.kind == MapKind::Drift).count(),
        resonances: REPORTED.into_iter().filter_map(of_ratio).collect(),
    })
}

fn processor(proved: &Proved) -> Option<Processor> {
    let processor = proved.scheme.processor.as_ref()?;
    let post = processor.post.iter().map(|map| Map { map: map.kind.to_string(), weight: to_text(&map.weight) });
    Some(Processor { evaluations: processor.evaluations(), post: post.collect() })
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

/// As tables write it.
pub fn first(first: First) -> &'static str {
    match first {
        First::Kick => "kick",
        First::Drift => "drift",
    }
}

/// How many digits of the weights are right; `None` for all.
pub fn digits(held: Held) -> Option<u32> {
    match held {
        Held::Exactly => None,
        Held::Digits(digits) => Some(digits),
    }
}

/// Other names under which the scheme is known.
pub fn aliases(table: &Table) -> Vec<String> {
    table.aliases.iter().map(|alias| alias.value.clone()).collect()
}

/// The orders for H = A + εB, of the terms of ε, ε², ….
pub fn near_integrable(proof: &Proof) -> Vec<u32> {
    proof.near_integrable.iter().map(|order| order.order).collect()
}

/// The effective orders of a processed scheme for H = A + εB; of another scheme none.
pub fn effective_near_integrable(proof: &Proof) -> Vec<u32> {
    proof.effective.iter().flat_map(|effective| &effective.near_integrable).map(|order| order.order).collect()
}

/// As tables write it.
pub fn kinetic(kinetic: Kinetic) -> &'static str {
    match kinetic {
        Kinetic::Any => "any",
        Kinetic::Quadratic => "quadratic",
    }
}
