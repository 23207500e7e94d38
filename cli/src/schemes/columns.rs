//! The columns of the list: by default what a person chooses by, within 80 characters; all others with `--wide`.

use shadowstep_schemes::Kinetic;
use shadowstep_symbolic::decimal::significant;

use crate::readable::{rounded, table};
use crate::schemes::facts::{digits_text, near_integrable_text};
use crate::schemes::record::Record;

/// A column: its header, whether it is one of numbers, and what it shows of a scheme.
pub(super) struct Column {
    header: &'static str,
    is_number: bool,
    cell: fn(&Record) -> String,
}

const fn number(header: &'static str, cell: fn(&Record) -> String) -> Column {
    Column { header, is_number: true, cell }
}

const fn text(header: &'static str, cell: fn(&Record) -> String) -> Column {
    Column { header, is_number: false, cell }
}

const FORCES: Column = number("forces\na step", |record| match record.hessian_products {
    0 => record.evaluations.to_string(),
    products => format!("{}+{products}", record.evaluations),
});
const ERROR: Column =
    number("eff.\nerror", |record| record.orders.effective_error.map_or_else(none, |error| significant(error, 4)));
const ERROR_QUADRATIC: Column = number("eff.\nerror", |record| significant(record.orders.effective_error_quadratic, 4));
const PER_FORCE: Column = number("stable\na force", |record| {
    record.stability_limit_per_force.map_or_else(|| "–".to_owned(), |limit| significant(limit, 4))
});
const SYMMETRIC: Column = text("sym-\nmetric", |record| if record.symmetric { "yes" } else { "no" }.to_owned());
const ORDER: Column = number("order", |record| record.orders.order.map_or_else(none, |order| order.to_string()));
const NAME: Column = text("name", |record| record.name.clone());

/// What a person chooses by, for the kinetic energy that was requested.
pub(super) fn to_choose_by(kinetic: Option<Kinetic>) -> Vec<Column> {
    let order = match kinetic {
        None => number("order", both_orders),
        Some(Kinetic::Any) => ORDER,
        Some(Kinetic::Quadratic) => number("order", |record| record.orders.order_quadratic.to_string()),
    };
    let error = if kinetic == Some(Kinetic::Quadratic) { ERROR_QUADRATIC } else { ERROR };
    vec![order, FORCES, error, PER_FORCE, SYMMETRIC, text("for", meant_for), NAME]
}

/// Everything that fits a line.
pub(super) fn all() -> Vec<Column> {
    vec![
        ORDER,
        number("order\nquadratic", |record| record.orders.order_quadratic.to_string()),
        number("A + εB", |record| near_integrable_text(&record.orders.near_integrable)),
        number("stages", |record| record.stages.to_string()),
        FORCES,
        number("products per\ndimension", |record| record.products_per_dimension.to_string()),
        number("products\nfor β", |record| record.products_for_beta.to_string()),
        ERROR,
        Column { header: "eff. error\nquadratic", ..ERROR_QUADRATIC },
        number("stable\nto hω", |record| {
            record.stability_limit.as_ref().map_or_else(|| "–".to_owned(), |limit| rounded(limit, 4))
        }),
        PER_FORCE,
        number("digits", |record| digits_text(record.digits)),
        SYMMETRIC,
        text("for", meant_for),
        NAME,
    ]
}

/// The table of these columns.
pub(super) fn table_of(columns: &[Column], records: &[Record]) -> String {
    let row = |record: &Record| -> Vec<String> { columns.iter().map(|column| (column.cell)(record)).collect() };
    let numbers = columns.iter().take_while(|column| column.is_number).count();
    table(columns.iter().map(|column| column.header), records.iter().map(row).collect(), 0..numbers)
}

/// What the columns mean.
pub(super) fn legend(is_wide: bool, kinetic: Option<Kinetic>) -> String {
    let error = "effective error: forces · ‖leading error‖^(1/order), which compares schemes of one order";
    let stable = "stable a force: the stability limit hω of the harmonic oscillator, by the forces of a step; forces \
        2+1: 2 forces and 1 Hessian–vector product of a gradient kick, which is counted as a force; of processed \
        schemes (proc.) orders and effective errors are those after processing, of their kernels `show` has them";
    if is_wide {
        return format!(
            "{error}; {stable}; products per dimension: what a step takes beside its forces with unit masses, and as many \
             additions; products for β: what the modified energy adds"
        );
    }
    let class = match kinetic {
        None => "order: for every T(p), in brackets for quadratic T; eff. error: for every T(p) (--for quadratic)",
        Some(Kinetic::Any) => "order and eff. error: for every T(p)",
        Some(Kinetic::Quadratic) => "order and eff. error: for quadratic T",
    };
    format!("{class}; {error}; {stable}; --wide has all columns, `schemes show NAME` everything about one scheme")
}

fn both_orders(record: &Record) -> String {
    match (record.orders.order, record.orders.order_quadratic) {
        (Some(any), quadratic) if any == quadratic => any.to_string(),
        (Some(any), quadratic) => format!("{any} ({quadratic})"),
        (None, quadratic) => format!("({quadratic})"),
    }
}

/// In place of a number that there is not.
fn none() -> String {
    "–".to_owned()
}

/// What a scheme is for.
fn meant_for(record: &Record) -> String {
    if record.kernel.is_some() {
        return format!("proc.{}", near_integrable_text(&record.orders.near_integrable));
    }
    match &record.orders.near_integrable[..] {
        [] if record.moves_any => "every T(p)".to_owned(),
        [] => "quadratic T".to_owned(),
        orders => format!("A+εB {}", near_integrable_text(orders)),
    }
}
