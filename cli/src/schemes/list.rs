//! `shadowstep schemes`: the shipped schemes and custom tables, a line each.

use std::io::Write;

use clap::{Args, ValueEnum};
use rayon::prelude::*;
use shadowstep::tables::{TableScheme, shipped, shipped_names};
use shadowstep_schemes::Kinetic;
use shadowstep_schemes::claims::HIGHEST_ORDER;

use crate::output::Output;
use crate::quantity::whole;
use crate::readable::wrapped_to;
use crate::report::{self, Status};
use crate::schemes::columns;
use crate::schemes::facts::{NEAR_INTEGRABLE, nested_text};
use crate::schemes::record::Record;
use shadowstep_scenes::Error;
use shadowstep_scenes::library::{self, NamedScheme};
use shadowstep_symbolic::nearest;

/// Which schemes are listed, and in which order.
#[derive(Debug, Args)]
#[group(skip)]
pub(crate) struct Arguments {
    /// Files of tables to list too, such as mine.toml
    ///
    /// They are listed among the shipped schemes whatever their order.
    #[arg(value_name = "FILE")]
    tables: Vec<String>,
    /// Only schemes of this order, such as 6
    #[arg(long, value_name = "ORDER", value_parser = |text: &str| whole(text, 1..=HIGHEST_ORDER))]
    order: Option<u32>,
    /// Only schemes for these kinetic energies
    ///
    /// --order and --sort then use the orders and effective errors for them.
    #[arg(long = "for", value_name = "KINETIC")]
    kinetic: Option<KineticChoice>,
    /// What comes first
    #[arg(long, value_name = "KEY", default_value = "order")]
    sort: SortKey,
    /// All columns; they need 163 characters a line
    #[arg(long, conflicts_with = "json")]
    wide: bool,
    /// One JSON object a line, with all columns and more
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum KineticChoice {
    /// Every T(p): schemes that need a quadratic one are left out
    Any,
    /// T = ½pᵀM⁻¹p: all schemes
    Quadratic,
}

impl KineticChoice {
    fn kinetic(self) -> Kinetic {
        match self {
            KineticChoice::Any => Kinetic::Any,
            KineticChoice::Quadratic => Kinetic::Quadratic,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SortKey {
    /// The lowest order, then the smallest effective error: it compares schemes of one order only
    EffectiveError,
    /// The largest stability limit
    Stability,
    /// The fewest force evaluations a step
    Evaluations,
    /// The alphabet
    Name,
    /// The lowest order, then the fewest force evaluations
    Order,
}

/// The shipped schemes that are asked for, and custom tables among them.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let custom = arguments.tables.iter().map(|word| table_of(word)).collect::<Result<Vec<_>, _>>()?;
    let of_order =
        |scheme: &TableScheme| arguments.order.is_none_or(|order| Some(order) == order_for(scheme, arguments));
    let all: Vec<_> = shipped_names().into_par_iter().filter_map(|name| Some((name, shipped(name)?))).collect();
    let moves = |scheme: &TableScheme| {
        arguments.kinetic != Some(KineticChoice::Any) || scheme.proved().holds_for_every_kinetic()
    };
    let chosen = all.par_iter().filter(|(_, scheme)| of_order(scheme) && moves(scheme));
    let mut records: Vec<Record> = chosen.map(|(name, scheme)| Record::of(name, scheme, true)).collect();
    if let (true, Some(order)) = (records.is_empty(), arguments.order) {
        note_orders(&all, order, arguments);
    }
    records.extend(custom.iter().map(|named| Record::of(&named.name, &named.quadratic(), false)));
    sort(&mut records, arguments);
    let mut output = Output::stdout();
    if arguments.json {
        records.iter().try_for_each(|record| output.json(record))?;
    } else {
        let kinetic = arguments.kinetic.map(KineticChoice::kinetic);
        let columns = if arguments.wide { columns::all() } else { columns::to_choose_by(kinetic) };
        writeln!(output, "{}", columns::table_of(&columns, &records))?;
        write!(output, "{}", wrapped_to(&columns::legend(arguments.wide, kinetic), "", 80))?;
        if records.iter().any(|record| !record.orders.near_integrable.is_empty()) {
            write!(output, "{}", wrapped_to(NEAR_INTEGRABLE, "", 80))?;
        }
        let nested = records.iter().filter(|record| record.is_nested).map(|record| record.name.as_str());
        match nested.collect::<Vec<_>>() {
            names if names.is_empty() => {}
            names => write!(output, "{}", wrapped_to(&nested_text(&names), "", 80))?,
        }
    }
    output.finish()?;
    Ok(Status::Success)
}

/// A custom table.
fn table_of(word: &str) -> Result<NamedScheme, Error> {
    if word.ends_with(".toml") || word.contains(std::path::is_separator) {
        return Ok(library::scheme(word)?);
    }
    let message = format!("`{word}` is not the file of a table");
    let hint = match library::scheme(word) {
        Ok(_) => format!("for a shipped scheme write: shadowstep schemes show {word}"),
        Err(unknown) => match nearest(word, ["show", "check", "polish", "prove"]) {
            Some(command) => format!("did you mean `shadowstep schemes {command}`?"),
            None => return Err(unknown.into()),
        },
    };
    Err(Error::usage(message, hint))
}

fn note_orders(all: &[(&str, TableScheme)], order: u32, arguments: &Arguments) {
    let mut orders: Vec<u32> = all.iter().filter_map(|(_, scheme)| order_for(scheme, arguments)).collect();
    orders.sort_unstable();
    orders.dedup();
    let orders = orders.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
    let class = class(arguments);
    report::note(format_args!("no shipped scheme has order {order} {class}; there are the orders {orders}"));
}

fn order_for(scheme: &TableScheme, arguments: &Arguments) -> Option<u32> {
    let proved = scheme.proved();
    let kinetic = if for_quadratic(arguments) { Kinetic::Quadratic } else { Kinetic::Any };
    let of_kernel =
        if for_quadratic(arguments) { Some(&proved.proof.quadratic) } else { proved.order_for_every_kinetic() };
    let order = of_kernel?;
    Some(proved.proof.effective.as_ref().map_or(order, |effective| effective.for_kinetic(kinetic)).order)
}

fn for_quadratic(arguments: &Arguments) -> bool {
    arguments.kinetic == Some(KineticChoice::Quadratic)
}

fn class(arguments: &Arguments) -> &'static str {
    if for_quadratic(arguments) { "for quadratic T" } else { "for every T(p) (--for quadratic looks at quadratic T)" }
}

/// By name, then order and cost, then what is asked for: each sort keeps the order of equals.
fn sort(records: &mut [Record], arguments: &Arguments) {
    let quadratic = for_quadratic(arguments);
    if arguments.sort == SortKey::Name {
        records.sort_by(|a, b| a.name.cmp(&b.name));
        return;
    }
    records.sort_by_key(|record| {
        let orders = (record.orders.order.unwrap_or(record.orders.order_quadratic), record.orders.order_quadratic);
        (if quadratic { (orders.1, orders.0) } else { orders }, record.evaluations + record.hessian_products)
    });
    match arguments.sort {
        SortKey::EffectiveError => {
            let own = |r: &Record| {
                r.orders.effective_error.filter(|_| !quadratic).unwrap_or(r.orders.effective_error_quadratic)
            };
            let order = |r: &Record| r.orders.order.filter(|_| !quadratic).unwrap_or(r.orders.order_quadratic);
            records.sort_by(|a, b| order(a).cmp(&order(b)).then(own(a).total_cmp(&own(b))));
        }
        SortKey::Stability => {
            let limit = |record: &Record| record.limit().unwrap_or(0.0);
            records.sort_by(|a, b| limit(b).total_cmp(&limit(a)));
        }
        SortKey::Evaluations => records.sort_by_key(|record| record.evaluations + record.hessian_products),
        SortKey::Order | SortKey::Name => {}
    }
}
