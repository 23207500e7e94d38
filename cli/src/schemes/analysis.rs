//! The analysis of a scheme as text.

use shadowstep_analysis::error::LeadingError;
use shadowstep_analysis::sampling::SamplingError;
use shadowstep_analysis::{Sizes, stability};
use shadowstep_scenes::scheme_record::{Accuracy, SchemeFacts};
use shadowstep_schemes::symbolic::decimal::significant;
use shadowstep_schemes::{Kinetic, MapKind};

use crate::readable::shortened;

/// More terms than these are too many to read.
const MOST_TERMS: usize = 6;

/// A fact as text, with its name.
pub(super) type Fact = (&'static str, String);

/// The analysis, each fact with its name.
pub(super) fn facts(scheme: &SchemeFacts<'_>) -> Vec<Fact> {
    let (maps, phase) = (scheme.proved.scheme.maps(), scheme.phase_error());
    let mut facts = errors(&scheme.accuracy());
    let mut of_kernel = "";
    if let Some(kernel) = scheme.kernel() {
        facts[0].1 += ", after processing, without outputs";
        of_kernel = "of the kernel, ";
        facts.extend(errors(&kernel).into_iter().map(|(what, fact)| (what, format!("{of_kernel}{fact}"))));
    }
    let where_ = "K and D are the Lie derivatives of the kick and the drift; words and trees of them likewise";
    facts.push(("where", where_.to_owned()));
    match &scheme.stability {
        Some(stability) => facts.push(("oscillator", format!("stable up to hω = {}", stability.limit))),
        None => {
            facts.push(("oscillator", format!("not analysed: the step has more than {} maps", stability::MOST_MAPS)));
        }
    }
    let end = 2 * scheme.proved.plan.degree();
    facts.extend(scheme.stability.iter().flat_map(|stability| &stability.gaps).map(|gap| match &gap.to {
        Some(to) => ("unstable gap", format!("hω from {} to {to}, {:.3e} wide", gap.from, gap.width)),
        None => ("unstable", format!("hω from {} to {end} at least", gap.from)),
    }));
    facts.push(("phase error", format!("{:.4e} (hω)^{}, relative", phase.coefficient, phase.power)));
    facts.extend(scheme.sampling_error().map(|error| ("sampling", format!("{of_kernel}{}", sampling_text(error)))));
    let kinds = [("kicks", MapKind::Kick), ("gradient kicks", MapKind::GradientKick), ("drifts", MapKind::Drift)];
    let used = kinds.into_iter().filter(|(_, kind)| maps.iter().any(|map| map.kind == *kind));
    facts.extend(used.map(|(what, kind)| (what, sizes_text(&Sizes::of(&maps, kind)))));
    facts
}

fn errors(accuracy: &Accuracy<'_>) -> Vec<Fact> {
    let [general, quadratic] = accuracy.errors;
    let [every, of_quadratic] = [Kinetic::Any, Kinetic::Quadratic]
        .map(|kinetic| format!("{} for {kinetic}", significant(accuracy.effective_error(kinetic), 4)));
    let quadratic = ("quadratic T", error_text(quadratic));
    match accuracy.orders.general {
        Some(_) => {
            let both = format!("{every}, {of_quadratic}");
            vec![("effective error", both), ("leading error", error_text(general)), quadratic]
        }
        None => {
            let counted = format!("{of_quadratic}, a Hessian–vector product counted as a force");
            vec![("effective error", counted), quadratic]
        }
    }
}

/// What schemes for Hamiltonian Monte Carlo minimise.
fn sampling_text(error: SamplingError) -> String {
    let range = error.range;
    match error.largest {
        Some(largest) => format!(
            "expected energy error of the oscillator at most {largest:.3e} over 0 < hω < {range}, the forces of a step"
        ),
        None => format!("the oscillator is unstable within 0 < hω < {range}, the forces of a step"),
    }
}

fn sizes_text(sizes: &Sizes) -> String {
    let [sum, smallest, largest] =
        [&sizes.sum_of_sizes, &sizes.smallest, &sizes.largest].map(|size| shortened(size, 6));
    format!("from {smallest} to {largest}, sizes sum to {sum}")
}

/// The coefficients that are not 0.
fn error_text(error: &LeadingError) -> String {
    let norm = format!("h^{}, norm {:.4e}", error.power, error.norm());
    let terms: Vec<_> = error.terms.iter().filter(|(_, c)| *c != 0.0).collect();
    if terms.len() > MOST_TERMS {
        return format!("{norm}, {} brackets (--json writes them)", terms.len());
    }
    let terms = terms.into_iter().map(|(bracket, c)| format!("{c:.4e} {bracket}")).collect::<Vec<_>>();
    format!("{norm}: {}", terms.join(", "))
}
