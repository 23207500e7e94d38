//! The columns of the list: by default what a person chooses by, within 80 characters; all others with `--wide`.

use std::fmt::Display;

use shadowstep_schemes::Kinetic;
use shadowstep_schemes::symbolic::decimal::significant;

use crate::readable::{rounded, table};
use crate::schemes::record::{Listed, effective_error};

/// A column: its header, whether it is one of numbers, and what it shows of a scheme.
pub(super) struct Column {
    header: &'static str,
    is_number: bool,
    cell: fn(&Listed<'_>) -> String,
}

const fn number(header: &'static str, cell: fn(&Listed<'_>) -> String) -> Column {
    Column { header, is_number: true, cell }
}

const fn text(header: &'static str, cell: fn(&Listed<'_>) -> String) -> Column {
    Column { header, is_number: false, cell }
}

const FORCES: Column = number("forces\na step", |scheme| {
    let plan = &scheme.facts.proved.plan;
    match plan.hessian_products {
        0 => plan.evaluations.to_string(),
        products => format!("{}+{products}", plan.evaluations),
    }
});
const ERROR: Column = number("eff.\nerror", |scheme| four_digits(effective_error(&scheme.facts.accuracy())));
const ERROR_QUADRATIC: Column =
    number("eff.\nerror", |scheme| four_digits(Some(scheme.facts.accuracy().effective_error(Kinetic::Quadratic))));
const PER_FORCE: Column = number("stable\na force", |scheme| four_digits(scheme.facts.limit_per_force()));
const SYMMETRIC: Column = text("sym-\nmetric", |scheme| yes_or_no(scheme.facts.proved.proof.symmetric).to_owned());
const ORDER: Column = number("order", |scheme| or_none(scheme.facts.proved.orders().general.map(|order| order.order)));
const ORDER_QUADRATIC: Column = number("order", |scheme| scheme.facts.proved.orders().quadratic.order.to_string());
const NAME: Column = text("name", |scheme| scheme.name.to_owned());

/// What a person chooses by, for the kinetic energy that was requested.
pub(super) fn to_choose_by(kinetic: Option<Kinetic>) -> Vec<Column> {
    let (order, error) = match kinetic {
        None => (number("order", both_orders), ERROR),
        Some(Kinetic::Any) => (ORDER, ERROR),
        Some(Kinetic::Quadratic) => (ORDER_QUADRATIC, ERROR_QUADRATIC),
    };
    vec![order, FORCES, error, PER_FORCE, SYMMETRIC, text("for", meant_for), NAME]
}

/// Everything that fits a line.
pub(super) fn all() -> Vec<Column> {
    vec![
        ORDER,
        Column { header: "order\nquadratic", ..ORDER_QUADRATIC },
        number("A + εB", |scheme| scheme.facts.proved.orders().in_epsilon()),
        number("stages", |scheme| scheme.facts.proved.scheme.stages.kick.len().to_string()),
        FORCES,
        number("products per\ndimension", |scheme| scheme.facts.proved.plan.cost().products_per_dimension.to_string()),
        number("products\nfor β", |scheme| scheme.facts.proved.plan.cost().products_for_beta.to_string()),
        ERROR,
        Column { header: "eff. error\nquadratic", ..ERROR_QUADRATIC },
        number("stable\nto hω", |scheme| {
            or_none(scheme.facts.stability.as_ref().map(|interval| rounded(&interval.limit, 4)))
        }),
        PER_FORCE,
        number("digits", |scheme| {
            scheme.facts.proved.scheme.held.digits().map_or_else(|| "exact".to_owned(), |digits| digits.to_string())
        }),
        SYMMETRIC,
        text("for", meant_for),
        NAME,
    ]
}

/// The table of these columns.
pub(super) fn table_of(columns: &[Column], schemes: &[Listed<'_>]) -> String {
    let row = |scheme: &Listed<'_>| columns.iter().map(|column| (column.cell)(scheme)).collect();
    let numbers = columns.iter().take_while(|column| column.is_number).count();
    table(columns.iter().map(|column| column.header), schemes.iter().map(row).collect::<Vec<Vec<_>>>(), 0..numbers)
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

/// What the orders of a near-integrable scheme are worth, and what they need.
pub(super) const NEAR_INTEGRABLE: &str = "\
A + εB: orders such as (8,4) mean errors of ε h^8 and ε² h^4. They pay only if the drift solves A exactly and εB is \
small, as where drifts are Kepler orbits and kicks the attractions of planets: scenes with parts = \"wisdom-holman\". \
With T and U as parts nothing is small, and they gain nothing.";

/// What the numbers of schemes with multiple time steps are of.
pub(super) fn nested(names: &[&str]) -> String {
    format!(
        "{}: multiple time steps, for slow forces, fast forces and T. The numbers are those of the outer scheme, \
         whose forces are the slow ones; `schemes show` has the others.",
        names.join(", ")
    )
}

fn both_orders(scheme: &Listed<'_>) -> String {
    let orders = scheme.facts.proved.orders();
    let quadratic = orders.quadratic.order;
    match orders.general.map(|general| general.order) {
        Some(any) if any == quadratic => any.to_string(),
        Some(any) => format!("{any} ({quadratic})"),
        None => format!("({quadratic})"),
    }
}

pub(super) fn yes_or_no(is_so: bool) -> &'static str {
    if is_so { "yes" } else { "no" }
}

/// A dash in place of what there is not.
fn or_none(value: Option<impl Display>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| value.to_string())
}

fn four_digits(value: Option<f64>) -> String {
    or_none(value.map(|value| significant(value, 4)))
}

/// What a scheme is for.
fn meant_for(scheme: &Listed<'_>) -> String {
    let proved = scheme.facts.proved;
    match proved.orders().in_epsilon() {
        orders if proved.scheme.processor.is_some() => format!("proc.{orders}"),
        orders if !orders.is_empty() => format!("A+εB {orders}"),
        _ if proved.holds_for_every_kinetic() => Kinetic::Any.to_string(),
        _ => Kinetic::Quadratic.to_string(),
    }
}
