//! What an ensemble computes besides states, from \[run\] and \[output\].

use std::ops::Range;

use shadowstep::shadow::EstimatorSettings;
use shadowstep::tables::{Faults, Source};
use shadowstep_schemes::document::{Reader, document};

use crate::run::Run;
use crate::scene::{Format, Scene};
use crate::texts::error::Error;

/// Energies of the trajectories.
#[derive(Clone, Copy, Debug)]
pub(super) struct Observed {
    /// H is computed at each n that is a multiple of this, and at the end.
    pub(super) every: u64,
    /// The k of E_k.
    pub(super) modified_energy: Option<u32>,
}

/// What the scene asks for.
///
/// # Errors
/// What an ensemble cannot have: other numbers than doubles, rows of states, checkpoints, charts, JSON lines, other
/// estimators.
pub(super) fn settings(source: &Source, scene: &Scene) -> Result<Observed, Error> {
    let mut reader = Reader::new(source, Vec::new());
    refuse_numbers(&mut reader, scene);
    refuse_outputs(&mut reader, scene);
    let observed = observed(&mut reader, scene);
    match (Faults::of(reader.faults), observed) {
        (None, Some(observed)) => Ok(observed),
        (Some(faults), _) => Err(faults.into()),
        (None, None) => unreachable!("what cannot be computed is a fault"),
    }
}

/// Where a key is, or else its section.
fn place(source: &Source, section: &str, key: &str) -> Range<usize> {
    let (root, _) = document(source);
    let section = root.as_ref().and_then(|root| root.get(section));
    let value = section.and_then(|section| section.get_ref().as_table()?.get(key));
    value.or(section).map_or(0..0, |value| value.span())
}

fn refuse_numbers(reader: &mut Reader<'_>, scene: &Scene) {
    if scene.arithmetic.is_longer_than_double() {
        let at = place(reader.source, "run", "digits");
        let hint = "write digits = \"double\" or \"compensated\" in [run]";
        reader.fault(&at, "an ensemble is computed in double precision", hint);
    }
}

fn refuse_outputs(reader: &mut Reader<'_>, scene: &Scene) {
    let output = &scene.output;
    let refused = [
        ("trajectory", output.has_states(), "its rows have the states at the end"),
        ("chaos", output.chaos.is_some(), "a sweep keeps indicators of chaos of many runs"),
        ("values", output.named_values().count() > 0, "a sweep keeps formulas at the end of many runs"),
        ("extremes", !output.extremes.is_empty(), "a sweep keeps the least and greatest values of many runs"),
        ("windows", output.windows != Run::WINDOWS, "it has no summary"),
        ("plot", output.plot.is_some(), "draw its rows with another program"),
        ("checkpoint", output.checkpoint.is_some(), "a run that is stopped begins again"),
    ];
    for (key, _, why) in refused.into_iter().filter(|(_, there, _)| *there) {
        let at = place(reader.source, "output", key);
        reader.fault(&at, format!("an ensemble has no `{key}`"), format!("remove `{key}`: {why}"));
    }
    if scene.ends.is_some() {
        let help = "remove `end`: its trajectories end together; a sweep ends each of its runs alone";
        reader.fault(&place(reader.source, "run", "end"), "an ensemble has no `end`", help);
    }
    if let Some(refusal) = scene.system.needs().no_ensembles {
        let (section, key) = scene.system.parts.key();
        reader.fault(&place(reader.source, section, key), refusal.message, refusal.hint);
    }
    let Some((file, at)) = &output.file else { return };
    if output.format != Format::Csv {
        reader.fault(at, "an ensemble is written as CSV", "name a file such as \"out.csv\"");
    }
    if same_file::is_same_file(file, &scene.source.path).unwrap_or(false) {
        reader.fault(at, "the file is the scene itself", "give it another name");
    }
}

fn observed(reader: &mut Reader<'_>, scene: &Scene) -> Option<Observed> {
    let output = &scene.output;
    let Some((estimator, every)) = &output.modified_energy else {
        return Some(Observed {
            every: output.energy.unwrap_or_else(|| scene.most_steps()).max(1),
            modified_energy: None,
        });
    };
    let at = place(reader.source, "output", "modified_energy");
    if output.energy.is_some_and(|energy| energy != *every) {
        let message = "the energy and the modified energy of an ensemble have the same `every`";
        return reader.wrong(&at, message, "give both the same");
    }
    let hint = "write modified_energy = { estimator = \"bilinear\", order = 8, every = 100 }";
    match fixed_order(estimator) {
        Some(k) => Some(Observed { every: *every, modified_energy: Some(k) }),
        None => reader.wrong(&at, "the modified energy of an ensemble is E_k of a fixed k", hint),
    }
}

/// The k of the bilinear estimator, where it is fixed.
fn fixed_order(estimator: &EstimatorSettings) -> Option<u32> {
    estimator.order().filter(|_| estimator.name() == "bilinear")
}
