//! The schemes that need the least for an error, and the orders that the schemes show, as tables of at most 80 columns.

use shadowstep_scenes::readable::wrapped_to;
use shadowstep_work_precision::order::MeasuredOrder;
use shadowstep_work_precision::reference::{Origin, Reference};
use shadowstep_work_precision::size::Size;
use shadowstep_work_precision::study::{Cost, Of, Studied, Study};

use super::Posed;
use crate::colour::heading;
use crate::readable::table;

const WIDTH: usize = 80;

/// What was found.
pub(super) fn readable(posed: &Posed, study: &Study<'_>, coloured: bool) -> String {
    let title = |text: &str| if coloured { heading(text) } else { text.to_owned() };
    let mut text = wrapped_to(&posed.title(), "", WIDTH);
    text += &wrapped_to(&origin(&study.reference), "", WIDTH);
    for (of, name) in [(Of::Position, "error of the position at the end"), (Of::Energy, "largest error of H")] {
        let rows: Vec<_> = study.decades(of).filter_map(|error| row(study, of, error)).collect();
        if rows.is_empty() {
            text += &format!("{}: no scheme has one below 1/10\n", title(name));
            continue;
        }
        text += &format!("{}\n", title(name));
        text += &table(["error", "fewest forces", "", "shortest time", "seconds"], rows, 2..3);
        text += "\n";
    }
    text += &format!("{}\n", title("a step, and the order of the position's error with the steps at which it shows"));
    let rows = study.schemes.iter().map(|studied| orders(study, studied));
    text +=
        &table(["scheme", "forces", "µs", "order", "measured", "from h", "to", "of H"], rows.collect::<Vec<_>>(), 1..8);
    text + "\n"
}

/// The best schemes for an error.
fn row(study: &Study<'_>, of: Of, error: Size) -> Option<[String; 5]> {
    let (by_forces, forces) = study.cheapest(of, Cost::Evaluations, error).into_iter().next()?;
    let (by_time, seconds) = study.cheapest(of, Cost::Seconds, error).into_iter().next()?;
    let (forces, seconds) = (format!("{forces:.0}"), format!("{seconds:.2e}"));
    let names = [by_forces, by_time].map(|studied| studied.scheme.name.clone());
    let [by_forces, by_time] = names;
    Some([format!("1e{}", error.log10()), by_forces, forces, by_time, seconds])
}

/// A scheme with the orders that it shows.
fn orders(study: &Study<'_>, studied: &Studied<'_>) -> [String; 8] {
    let [position, energy] = [Of::Position, Of::Energy].map(|of| studied.order(study.problem, of));
    let shown = |order: Option<MeasuredOrder>| order.map_or("–".to_owned(), |found| format!("{:.2}", found.order));
    let range =
        position.map_or([String::new(), String::new()], |found| [found.from, found.to].map(|h| format!("{h:.1e}")));
    let [from, to] = range;
    [
        studied.scheme.name.clone(),
        studied.evaluations_per_step().to_string(),
        format!("{:.3}", studied.time.median * 1e6),
        studied.proved_order(study.problem).to_string(),
        shown(position),
        from,
        to,
        shown(energy),
    ]
}

fn origin(reference: &Reference) -> String {
    match &reference.origin {
        Origin::ExactFlow => "Positions are compared with the exact flow.".to_owned(),
        Origin::Scheme { name, steps, digits } => format!(
            "Positions are compared with those of {name} in {steps} steps with {digits} digits, whose error is about {}.",
            reference.error()
        ),
    }
}
