//! The analysis of a scheme as records and as text.

use shadowstep_analysis::error::LeadingError;
use shadowstep_analysis::sampling::SamplingError;
use shadowstep_analysis::{self as analysis, Analysis, stability};
use shadowstep_schemes::Kinetic;
use shadowstep_symbolic::decimal::significant;

use crate::readable::shortened;

/// More terms than these are too many to read.
const MOST_TERMS: usize = 6;

/// The analysis as text, each fact with its name.
pub(crate) fn facts(analysis: &Analysis) -> Vec<(String, String)> {
    let has_gradient_kicks = analysis.hessian_products > 0;
    let (phase, end) = (analysis.phase, 2 * (analysis.evaluations + analysis.hessian_products));
    let errors = |[general, quadratic]: [&LeadingError; 2], effective: &dyn Fn(Kinetic) -> f64| {
        let both = match has_gradient_kicks {
            true => format!(
                "{} for quadratic T, a Hessian–vector product counted as a force",
                significant(effective(Kinetic::Quadratic), 4)
            ),
            false => {
                format!(
                    "{} for every T(p), {} for quadratic T",
                    significant(effective(Kinetic::Any), 4),
                    significant(effective(Kinetic::Quadratic), 4)
                )
            }
        };
        let of_general = if has_gradient_kicks { String::new() } else { error_text(general) };
        [("effective error", both), ("leading error", of_general), ("quadratic T", error_text(quadratic))]
    };
    let mut facts = Vec::new();
    let of_kernel = match &analysis.processed {
        Some([general, quadratic]) => {
            facts.extend(errors([general, quadratic], &|kinetic| analysis.processed_effective_error(kinetic)));
            facts[0].1 += ", after processing, without outputs";
            "of the kernel, "
        }
        None => "",
    };
    let kernel = errors([&analysis.general, &analysis.quadratic], &|kinetic| analysis.effective_error(kinetic));
    facts.extend(
        kernel
            .into_iter()
            .filter(|(_, fact)| !fact.is_empty())
            .map(|(what, fact)| (what, format!("{of_kernel}{fact}"))),
    );
    facts.push((
        "where",
        "K and D are the Lie derivatives of the kick and the drift; words and trees of them likewise".to_owned(),
    ));
    facts.push(match &analysis.stability {
        Some(stability) => ("oscillator", format!("stable up to hω = {}", stability.limit)),
        None => ("oscillator", format!("not analysed: the step has more than {} maps", stability::MOST_MAPS)),
    });
    facts.extend(analysis.stability.iter().flat_map(|stability| &stability.gaps).map(|gap| match &gap.to {
        Some(to) => ("unstable gap", format!("hω from {} to {to}, {:.3e} wide", gap.from, gap.width)),
        None => ("unstable", format!("hω from {} to {end} at least", gap.from)),
    }));
    facts.push(("phase error", format!("{:.4e} (hω)^{}, relative", phase.coefficient, phase.power)));
    facts.extend(analysis.sampling.map(|error| ("sampling", format!("{of_kernel}{}", sampling_text(error)))));
    facts.push(("kicks", sizes_text(&analysis.kicks)));
    if has_gradient_kicks {
        facts.push(("gradient kicks", sizes_text(&analysis.gradient_kicks)));
    }
    facts.push(("drifts", sizes_text(&analysis.drifts)));
    facts.retain(|(_, fact)| !fact.is_empty());
    facts.into_iter().map(|(what, fact)| (what.to_owned(), fact)).collect()
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

fn sizes_text(sizes: &analysis::Sizes) -> String {
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
