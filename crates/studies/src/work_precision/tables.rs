//! What schemes need for an error, and the orders that they show.

use crate::finding::Table;
use crate::work_precision::of::Of;
use crate::work_precision::order::MeasuredOrder;
use crate::work_precision::size::Size;
use crate::work_precision::study::{Cost, Studied, Study};

/// The schemes that need the least for an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Cheapest<'a> {
    /// The error.
    pub error: Size,
    /// The scheme with the fewest evaluations, and how many.
    pub by_evaluations: (&'a str, f64),
    /// The scheme with the shortest time, and its seconds.
    pub by_time: (&'a str, f64),
}

impl Study<'_> {
    /// The best schemes for each decade of an error that some scheme reaches, from the largest one.
    pub fn cheapest_by_decade(&self, of: Of) -> Vec<Cheapest<'_>> {
        let best = |cost, error| {
            let (studied, cost): (&Studied<'_>, f64) = self.cheapest(of, cost, error).into_iter().next()?;
            Some((studied.scheme.name.as_str(), cost))
        };
        let of_error = |error| {
            Some(Cheapest {
                error,
                by_evaluations: best(Cost::Evaluations, error)?,
                by_time: best(Cost::Seconds, error)?,
            })
        };
        self.decades(of).filter_map(of_error).collect()
    }

    /// The same and the measured orders, for a page.
    pub(crate) fn tables(&self) -> Vec<Table> {
        let best = [
            (Of::Position, "The best schemes for an error of the position at the end"),
            (Of::Energy, "… for the largest error of H"),
        ];
        let mut tables: Vec<Table> = best.into_iter().map(|(of, caption)| self.table_of_best(of, caption)).collect();
        tables.push(self.table_of_orders());
        tables
    }

    fn table_of_best(&self, of: Of, caption: &str) -> Table {
        let row = |Cheapest { error, by_evaluations, by_time }: Cheapest<'_>| {
            let (evaluations, seconds) = (format!("{:.0}", by_evaluations.1), format!("{:.2e}", by_time.1));
            vec![
                format!("1e{}", error.log10()),
                by_evaluations.0.to_owned(),
                evaluations,
                by_time.0.to_owned(),
                seconds,
            ]
        };
        Table {
            caption: caption.to_owned(),
            header: ["error", "fewest evaluations", "evaluations", "shortest time", "seconds"]
                .map(str::to_owned)
                .to_vec(),
            rows: self.cheapest_by_decade(of).into_iter().map(row).collect(),
        }
    }

    fn table_of_orders(&self) -> Table {
        let row = |studied: &Studied<'_>| {
            let mut row = vec![
                studied.scheme.name.clone(),
                studied.evaluations_per_step().to_string(),
                format!(
                    "{:.3} ({:.3}–{:.3})",
                    studied.time.median * 1e6,
                    studied.time.least * 1e6,
                    studied.time.most * 1e6
                ),
                studied.proved_order(self.problem).to_string(),
            ];
            row.extend([Of::Position, Of::Energy].map(|of| shown(studied.order(self.problem, of))));
            row
        };
        let header = ["scheme", "forces a step", "µs a step", "order proved", "measured of the position", "of H"];
        Table {
            caption: "Steps and orders".to_owned(),
            header: header.map(str::to_owned).to_vec(),
            rows: self.schemes.iter().map(row).collect(),
        }
    }
}

/// An order with its standard error and the steps at which it holds.
fn shown(order: Option<MeasuredOrder>) -> String {
    order.map_or("not seen".to_owned(), |MeasuredOrder { order, error, from, to, points }| {
        format!("{order:.2} ± {error:.2} for h = {from:.1e} … {to:.1e}, {points} steps")
    })
}
