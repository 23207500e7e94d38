//! How the analysis of a scheme is told, to machines and to people.

use serde::Serialize;
use shadowstep_schemes::analysis::error::LeadingError;
use shadowstep_schemes::analysis::{self, stability, trace};
use shadowstep_schemes::{Analysis, Kinetic, to_text};

use crate::figures::shortened;

/// More terms than these are too many to read.
const MOST_TERMS: usize = 6;

/// The leading error of log(step) for one class of kinetic energies.
#[derive(Serialize)]
pub(crate) struct Error {
    power: u32,
    norm: f64,
    terms: Vec<Term>,
}

#[derive(Serialize)]
struct Term {
    bracket: String,
    coefficient: f64,
}

#[derive(Serialize)]
pub(crate) struct Gap {
    from: String,
    /// `None` beyond 2·(evaluations).
    to: Option<String>,
    width: f64,
}

/// (φ − hω)/hω = coefficient·(hω)^power + …
#[derive(Serialize)]
pub(crate) struct Phase {
    coefficient: f64,
    power: u32,
}

#[derive(Serialize)]
pub(crate) struct Sizes {
    sum_of_sizes: String,
    smallest: String,
    largest: String,
}

impl Error {
    pub(crate) fn of(error: &LeadingError) -> Error {
        let term =
            |(bracket, c): &(analysis::bracket::Bracket, f64)| Term { bracket: bracket.to_string(), coefficient: *c };
        Error { power: error.power, norm: error.norm(), terms: error.terms.iter().map(term).collect() }
    }
}

impl Gap {
    pub(crate) fn of(gap: &stability::Gap) -> Gap {
        Gap { from: gap.from.clone(), to: gap.to.clone(), width: gap.width }
    }
}

impl Phase {
    pub(crate) fn of(phase: trace::PhaseError) -> Phase {
        Phase { coefficient: phase.coefficient, power: phase.power }
    }
}

impl Sizes {
    pub(crate) fn of(sizes: &analysis::Sizes) -> Sizes {
        Sizes {
            sum_of_sizes: to_text(&sizes.sum_of_sizes),
            smallest: to_text(&sizes.smallest),
            largest: to_text(&sizes.largest),
        }
    }
}

/// Lines for people, each with its margin.
pub(crate) fn lines(analysis: &Analysis) -> Vec<String> {
    let phase = analysis.phase;
    let mut lines = vec![
        format!(
            "effective error: {:.4} for every T(p), {:.4} for quadratic T",
            analysis.effective_error(Kinetic::Any),
            analysis.effective_error(Kinetic::Quadratic)
        ),
        format!("leading error:   {}", error_text(&analysis.general)),
        format!("quadratic T:     {}", error_text(&analysis.quadratic)),
        format!("oscillator:      stable up to hω = {}", analysis.stability.limit),
    ];
    lines.extend(analysis.stability.gaps.iter().map(|gap| match &gap.to {
        Some(to) => format!("unstable gap:    hω from {} to {to}, {:.3e} wide", gap.from, gap.width),
        None => format!("unstable:        hω from {} to {} at least", gap.from, 2 * analysis.evaluations),
    }));
    lines.push(format!("phase error:     {:.4e} (hω)^{}, relative", phase.coefficient, phase.power));
    for (name, sizes) in [("kicks", &analysis.kicks), ("drifts", &analysis.drifts)] {
        let [sum, smallest, largest] =
            [&sizes.sum_of_sizes, &sizes.smallest, &sizes.largest].map(|size| shortened(size, 6));
        lines.push(format!("{:17}from {smallest} to {largest}, sizes sum to {sum}", format!("{name}:")));
    }
    lines
}

fn error_text(error: &LeadingError) -> String {
    let norm = format!("h^{}, norm {:.4e}", error.power, error.norm());
    if error.terms.len() > MOST_TERMS {
        return format!("{norm}, {} brackets (--json writes them)", error.terms.len());
    }
    let terms = error.terms.iter().map(|(bracket, c)| format!("{c:.4e} {bracket}")).collect::<Vec<_>>();
    format!("{norm}: {}", terms.join(", "))
}
