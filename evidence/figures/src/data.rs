//! Results as CSV: every run that a figure shows, with all digits, after lines with # that give version and command.

use std::collections::HashSet;

use shadowstep::shadow::{EstimatorSettings, StoppingRule};
use shadowstep_studies::files;

use crate::Error;
use crate::measured::Permanent;
use crate::results::Used;
use crate::run::Run;

const RUN: [&str; 8] = ["problem", "set", "scheme", "step", "until", "digits", "estimator", "order"];

/// The CSV files of a figure that this command makes: the end of the file name, and the text.
pub(crate) fn csv(command: &str, used: &[Used]) -> Result<Vec<(&'static str, String)>, Error> {
    let mut drifts =
        vec![header(&["drift", "permanent_change", "largest_jump", "resolution", "order_least", "order_most"])];
    let mut energies =
        vec![header(&["t", "distance", "modified_energy", "order_used", "log10_estimated_error", "log10_last_term"])];
    let mut numbers = vec![header(&["quantity", "value"])];
    let mut blocks = vec![["differences", "steps", "scatter", "wander"].map(str::to_owned).to_vec()];
    for used in used {
        match used {
            Used::Drift(run, estimator, drift) => {
                let of =
                    |text: fn(&Permanent) -> &String| drift.permanent.as_ref().map(text).cloned().unwrap_or_default();
                let [change, jump, resolution] = [of(|p| &p.change), of(|p| &p.largest_jump), of(|p| &p.resolution)];
                let [least, most] = [drift.orders.0, drift.orders.1].map(|order| order.to_string());
                drifts.push(row(run, Some(estimator), [drift.drift.clone(), change, jump, resolution, least, most]));
            }
            Used::Energies(run, estimator, found) => {
                energies.extend((0..found.times.len()).map(|n| {
                    let [t, distance] = [found.times[n], found.distances[n]].map(|number| number.to_string());
                    let size = |sizes: &[Option<f64>]| sizes[n].map_or(String::new(), |size| format!("{size:.4}"));
                    let [error, last_term] = [size(&found.errors), size(&found.last_terms)];
                    let order = found.orders[n].to_string();
                    row(run, Some(estimator), [t, distance, found.values[n].clone(), order, error, last_term])
                }));
            }
            Used::Escape(run, escape) => {
                let time = escape.time.map_or("none".to_owned(), |time| time.to_string());
                numbers.push(row(run, None, ["time of escape".to_owned(), time]));
                numbers.push(row(run, None, ["returns before it".to_owned(), escape.returns.to_string()]));
                numbers.push(row(run, None, ["largest |q|".to_owned(), escape.farthest.to_string()]));
            }
            Used::Number(run, what, value) => numbers.push(row(run, None, [(*what).to_owned(), value.clone()])),
            Used::Blocks(differences, found) => blocks.extend(found.iter().map(|block| {
                let name = serde_json::to_value(differences)
                    .map_or(String::new(), |name| name.as_str().unwrap_or("").to_owned());
                vec![name, block.steps.to_string(), format!("{:e}", block.scatter), format!("{:e}", block.wander)]
            })),
        }
    }
    let files = [("", drifts), ("-energies", energies), ("-values", numbers), ("-blocks", blocks)];
    let files = files.into_iter().filter(|(_, rows)| rows.len() > 1);
    files.map(|(kind, rows)| Ok((kind, text(command, &rows)?))).collect()
}

fn header(last: &[&str]) -> Vec<String> {
    RUN.iter().chain(last).map(|&name| name.to_owned()).collect()
}

fn row<const N: usize>(run: &Run, estimator: Option<&EstimatorSettings>, last: [String; N]) -> Vec<String> {
    let set: Vec<_> = run.set.iter().map(|(name, value)| format!("{name}={value}")).collect();
    let (name, order) = estimator.map_or(("", String::new()), |settings| (settings.name(), order(settings)));
    let first = [
        run.problem.name().to_owned(),
        set.join(" "),
        run.propagator.to_owned(),
        run.step.clone(),
        run.until.to_owned(),
    ];
    let how = [run.digits.to_string(), name.to_owned(), order];
    first.into_iter().chain(how).chain(last).collect()
}

/// The CSV text. Results that a figure uses twice are written once.
fn text(command: &str, rows: &[Vec<String>]) -> Result<String, Error> {
    let mut written = HashSet::new();
    let head = [format!("shadowstep: {}", env!("CARGO_PKG_VERSION")), format!("command: {command}")];
    files::csv(&head, rows.iter().filter(|row| written.insert(*row)))
}

/// The order, or where it is searched for.
fn order(settings: &EstimatorSettings) -> String {
    let options = settings.options();
    match (options.order, options.max_order) {
        (Some(order), _) => order.to_string(),
        (None, Some(largest)) if options.stop == Some(StoppingRule::Early) => {
            format!("best of 2-{largest}, early stop")
        }
        (None, Some(largest)) if options.stop == Some(StoppingRule::Printed) => {
            format!("best of 2-{largest}, early stop as printed")
        }
        (None, Some(largest)) => format!("best of 2-{largest}"),
        (None, None) => "best".to_owned(),
    }
}
