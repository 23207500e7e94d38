//! Results as CSV: every run that a figure shows, with all digits, after lines with # that give version and command.

use std::collections::HashSet;

use shadowstep::shadow::{EstimatorSettings, StoppingRule};

use crate::Error;
use crate::figures::calculation::{Outcome, Quantity};
use crate::figures::measured::Permanent;
use crate::figures::results::Used;
use crate::figures::run::Run;
use crate::figures::series::GRADES;
use crate::files;

const RUN: [&str; 8] = ["problem", "set", "scheme", "step", "until", "digits", "estimator", "order"];

/// The CSV files of a figure that this command makes: the end of the file name, and the text.
pub(crate) fn csv(command: &str, used: &[Used]) -> Result<Vec<(&'static str, String)>, Error> {
    let mut drifts =
        vec![header(&["drift", "permanent_change", "largest_jump", "resolution", "order_least", "order_most"])];
    let mut energies =
        vec![header(&["t", "distance", "modified_energy", "order_used", "log10_estimated_error", "log10_last_term"])];
    let mut numbers = vec![header(&["quantity", "value"])];
    let mut blocks = vec![["differences", "steps", "scatter", "wander"].map(str::to_owned).to_vec()];
    for (quantity, outcome) in used {
        let mut include = |run: &Run, what: &str, value: String| numbers.push(row(run, None, [what.to_owned(), value]));
        match (quantity, outcome) {
            (Quantity::Drift { run, estimator }, Outcome::Drift(drift)) => {
                let of =
                    |text: fn(&Permanent) -> &String| drift.permanent.as_ref().map(text).cloned().unwrap_or_default();
                let [change, jump, resolution] = [of(|p| &p.change), of(|p| &p.largest_jump), of(|p| &p.resolution)];
                let [least, most] = [drift.orders.0, drift.orders.1].map(|order| order.to_string());
                drifts.push(row(run, Some(estimator), [drift.drift.clone(), change, jump, resolution, least, most]));
            }
            (Quantity::Energies { run, estimator }, Outcome::Energies(found)) => {
                energies.extend((0..found.times.len()).map(|n| {
                    let [t, distance] = [found.times[n], found.distances[n]].map(|number| number.to_string());
                    let size = |sizes: &[Option<f64>]| sizes[n].map_or(String::new(), |size| format!("{size:.4}"));
                    let [error, last_term] = [size(&found.errors), size(&found.last_terms)];
                    let order = found.orders[n].to_string();
                    row(run, Some(estimator), [t, distance, found.values[n].clone(), order, error, last_term])
                }));
            }
            (Quantity::Escape { run }, Outcome::Escape(escape)) => {
                include(run, "time of escape", escape.time.map_or("none".to_owned(), |time| time.to_string()));
                include(run, "returns before it", escape.returns.to_string());
                include(run, "largest |q|", escape.farthest.to_string());
            }
            (Quantity::CoordinateError { run }, Outcome::Number(value)) => {
                include(run, "largest error of q", value.clone());
            }
            (Quantity::Transit { run }, Outcome::Number(value)) => include(run, "change of H", value.clone()),
            (Quantity::Series { run }, Outcome::Numbers(found)) => {
                GRADES.iter().zip(found).for_each(|((_, what), value)| include(run, what, value.clone()));
            }
            (Quantity::Noise { differences, .. }, Outcome::Blocks(found)) => blocks.extend(found.iter().map(|block| {
                let name = serde_json::to_value(differences)
                    .map_or(String::new(), |name| name.as_str().unwrap_or("").to_owned());
                vec![name, block.steps.to_string(), format!("{:e}", block.scatter), format!("{:e}", block.wander)]
            })),
            // an orbit is drawn only
            _ => {}
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
    let first =
        [run.problem.name().to_owned(), set.join(" "), run.propagator.clone(), run.step.clone(), run.until.clone()];
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
