//! The schemes that need the least for an error, and the orders that the schemes show, as tables of at most 80 columns.

use shadowstep_scenes::readable::wrapped;
use shadowstep_schemes::symbolic::decimal::significant;
use shadowstep_studies::work_precision::of::Of;
use shadowstep_studies::work_precision::order::MeasuredOrder;
use shadowstep_studies::work_precision::study::{Studied, Study};
use shadowstep_studies::work_precision::tables::Cheapest;

use super::PosedProblem;
use crate::colour::{heading, on_stdout};
use crate::readable::table;

/// What was found.
pub(super) fn readable(posed: &PosedProblem, study: &Study<'_>) -> String {
    let title = |text: &str| heading(text, on_stdout());
    let mut text = wrapped(&posed.title(), "");
    text += &wrapped(&study.reference.described(), "");
    for of in [Of::Position, Of::Energy] {
        let rows: Vec<_> = study.cheapest_by_decade(of).into_iter().map(row).collect();
        if rows.is_empty() {
            text += &format!("{}: no scheme has one below 1/10\n", title(of.name()));
            continue;
        }
        text += &format!("{}\n", title(of.name()));
        text += &table(["error", "fewest forces", "", "shortest time", "seconds"], rows, 2..3);
        text += "\n";
    }
    text += &format!("{}\n", title("a step, and the order of the position's error with the steps at which it shows"));
    let rows = study.schemes.iter().map(|studied| orders(study, studied));
    text +=
        &table(["scheme", "forces", "µs", "order", "measured", "from h", "to", "of H"], rows.collect::<Vec<_>>(), 1..8);
    let remark = study.remark_on_times().map_or(String::new(), |remark| wrapped(&remark, ""));
    text + "\n" + &remark
}

/// The best schemes for an error.
fn row(Cheapest { error, by_evaluations, by_time }: Cheapest<'_>) -> [String; 5] {
    let (evaluations, seconds) = (format!("{:.0}", by_evaluations.1), format!("{:.2e}", by_time.1));
    [format!("1e{}", error.log10()), by_evaluations.0.to_owned(), evaluations, by_time.0.to_owned(), seconds]
}

/// A scheme with the orders that it shows.
fn orders(study: &Study<'_>, studied: &Studied<'_>) -> [String; 8] {
    let [position, energy] = [Of::Position, Of::Energy].map(|of| studied.order(study.problem, of));
    let shown = |order: Option<MeasuredOrder>| order.map_or("–".to_owned(), |found| format!("{:.2}", found.order));
    let range = position
        .map_or([String::new(), String::new()], |advised| [advised.from, advised.to].map(|h| format!("{h:.1e}")));
    let [from, to] = range;
    [
        studied.scheme.name.clone(),
        studied.evaluations_per_step().to_string(),
        significant(studied.time.median * 1e6, 4),
        studied.proved_order(study.problem).to_string(),
        shown(position),
        from,
        to,
        shown(energy),
    ]
}
