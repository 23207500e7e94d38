//! `shadowstep schemes`: the shipped schemes and custom tables, a line each.

use clap::builder::TypedValueParser;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use shadowstep_schemes::claims::HIGHEST_ORDER;
use shadowstep_schemes::{Kinetic, Proved, shipped_names, shipped_proved};

use crate::output::Output;
use crate::quantity::whole;
use crate::readable::wrapped;
use crate::report::{self, Status};
use crate::run_arguments::words;
use crate::schemes::columns;
use crate::schemes::record::{Listed, effective_error};
use shadowstep_scenes::Error;
use shadowstep_scenes::library::{self, NamedScheme};
use shadowstep_schemes::symbolic::nearest;

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
    #[arg(long = "for", value_name = "KINETIC", value_parser = words(&KINETIC, &KINETIC_MEANINGS).map(|word| kinetic(&word)))]
    kinetic: Option<Kinetic>,
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

const KINETIC: [&str; 2] = ["any", "quadratic"];
const KINETIC_MEANINGS: [&str; 2] =
    ["Every T(p): schemes that need a quadratic one are left out", "T = ½pᵀM⁻¹p: all schemes"];

fn kinetic(word: &str) -> Kinetic {
    if word == KINETIC[0] { Kinetic::Any } else { Kinetic::Quadratic }
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
    let all: Vec<_> = shipped_names().into_par_iter().filter_map(|name| Some((name, shipped_proved(name)?))).collect();
    let is_chosen = |proved: &Proved| {
        arguments.order.is_none_or(|order| Some(order) == order_for(proved, arguments))
            && (arguments.kinetic != Some(Kinetic::Any) || proved.holds_for_every_kinetic())
    };
    let chosen = all.par_iter().filter(|(_, proved)| is_chosen(proved));
    let mut schemes: Vec<_> = chosen.map(|(name, proved)| Listed::of(name, proved, true)).collect();
    if let (true, Some(order)) = (schemes.is_empty(), arguments.order) {
        note_orders(&all, order, arguments);
    }
    schemes.extend(custom.iter().map(|named| Listed::of(&named.name, named.scheme.proved(), false)));
    sort(&mut schemes, arguments);
    let records = schemes.iter().map(Listed::record);
    Output::stdout().records_or_text(arguments.json, records, || readable(&schemes, arguments))?;
    Ok(Status::Success)
}

/// The table and what it means.
fn readable(schemes: &[Listed<'_>], arguments: &Arguments) -> String {
    let columns = if arguments.wide { columns::all() } else { columns::to_choose_by(arguments.kinetic) };
    let mut legends = vec![columns::legend(arguments.wide, arguments.kinetic)];
    if schemes.iter().any(|scheme| !scheme.facts.proved.orders().near_integrable.is_empty()) {
        legends.push(columns::NEAR_INTEGRABLE.to_owned());
    }
    let nested: Vec<_> = schemes.iter().filter(|scheme| scheme.is_nested()).map(|scheme| scheme.name).collect();
    legends.extend((!nested.is_empty()).then(|| columns::nested(&nested)));
    let legends: String = legends.iter().map(|legend| wrapped(legend, "")).collect();
    format!("{}\n{legends}", columns::table_of(&columns, schemes))
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

fn note_orders(all: &[(&str, &Proved)], order: u32, arguments: &Arguments) {
    let mut orders: Vec<u32> = all.iter().filter_map(|(_, proved)| order_for(proved, arguments)).collect();
    orders.sort_unstable();
    orders.dedup();
    let orders = orders.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
    let class = class(arguments);
    report::note(format_args!("no shipped scheme has order {order} {class}; there are the orders {orders}"));
}

fn order_for(proved: &Proved, arguments: &Arguments) -> Option<u32> {
    let orders = proved.orders();
    let order = if for_quadratic(arguments) { Some(orders.quadratic) } else { orders.general };
    order.map(|order| order.order)
}

fn for_quadratic(arguments: &Arguments) -> bool {
    arguments.kinetic == Some(Kinetic::Quadratic)
}

fn class(arguments: &Arguments) -> &'static str {
    if for_quadratic(arguments) { "for quadratic T" } else { "for every T(p) (--for quadratic looks at quadratic T)" }
}

/// By name, then order and cost, then what is asked for: each sort keeps the order of equals.
fn sort(schemes: &mut [Listed<'_>], arguments: &Arguments) {
    if arguments.sort == SortKey::Name {
        schemes.sort_by_key(|scheme| scheme.name);
        return;
    }
    let quadratic = for_quadratic(arguments);
    let orders = |scheme: &Listed<'_>| {
        let orders = scheme.facts.proved.orders();
        let (general, of_quadratic) = (orders.general.unwrap_or(orders.quadratic).order, orders.quadratic.order);
        if quadratic { (of_quadratic, general) } else { (general, of_quadratic) }
    };
    let forces = |scheme: &Listed<'_>| scheme.facts.proved.plan.degree();
    schemes.sort_by_key(|scheme| (orders(scheme), forces(scheme)));
    match arguments.sort {
        SortKey::EffectiveError => {
            let error = |scheme: &Listed<'_>| {
                let accuracy = scheme.facts.accuracy();
                let general = effective_error(&accuracy).filter(|_| !quadratic);
                general.unwrap_or_else(|| accuracy.effective_error(Kinetic::Quadratic))
            };
            schemes.sort_by(|a, b| orders(a).0.cmp(&orders(b).0).then(error(a).total_cmp(&error(b))));
        }
        SortKey::Stability => {
            let limit = |scheme: &Listed<'_>| scheme.facts.limit().unwrap_or(0.0);
            schemes.sort_by(|a, b| limit(b).total_cmp(&limit(a)));
        }
        SortKey::Evaluations => schemes.sort_by_key(forces),
        SortKey::Order | SortKey::Name => {}
    }
}
