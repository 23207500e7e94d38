//! A table of printed decimals → one whose order conditions hold to the requested number of digits.
//!
//! Papers print 12 to 40 digits, and not all of them are right: where a solution is ill-conditioned, a residual near
//! the rounding of f64 hides weights that are off by a thousand times as much. [`polish`] takes the printed decimals
//! for the beginning of Newton's iteration on the order conditions themselves.
//!
//! | module | what it does |
//! | --- | --- |
//! | `unknowns`, `palindrome` | table → its decimals as unknowns, and the weights as functions of them |
//! | `formulas` | what the cells name |
//! | `printed` | what holds of the table as printed |
//! | `equations`, `composition` | which conditions must hold; for compositions, conditions in the γ's alone |
//! | `dual` | values with their derivatives, in fixed point |
//! | `least_squares`, `newton` | linear algebra; the choice of what stays as printed; the iteration |
//! | `rounded` | the values as they are written, with sums of exactly 1 |
//! | `write`, `new_table` | the table's text with the new decimals; its proof |
//! | `outcome` | the result: the polished table, or the reason why there is none |
//! | `refusal`, `numbers` | why a table was not polished, in messages with numbers |
//!
//! The arithmetic is in integers, with twice the digits at each step of the iteration. The result is read and proved as
//! any table is.

mod composition;
mod dual;
mod equations;
mod formulas;
mod least_squares;
mod new_table;
mod newton;
mod numbers;
mod outcome;
mod palindrome;
mod printed;
mod refusal;
mod rounded;
mod unknowns;
mod write;

use std::collections::BTreeSet;

use shadowstep_schemes::symbolic::{Rational, nearest, nearest_few};

pub(crate) use composition::{conditions, lyndon_words};
pub(crate) use equations::{Equations, OfUnknowns, maps, processed_maps};
use new_table::NewTable;
use newton::Problem;
pub use numbers::power_of_ten;
pub use outcome::{NotPolished, Polished, PolishedWeight, Role};
use shadowstep_schemes::ExactScheme;
use shadowstep_schemes::document::{Faults, Source};
use shadowstep_schemes::exact::{self, DIGITS};
use shadowstep_schemes::library::Library;
use shadowstep_schemes::table::{Table, Weights};
pub(crate) use unknowns::{Cell, Model};
use write::Written;

/// The largest number of digits that can be requested: as many as a table may claim.
pub const MOST_POLISHED_DIGITS: u32 = DIGITS;

/// The most decimals that are solved for: the work grows with their square.
const MOST_DECIMALS: usize = 200;

/// A condition number beyond which two thirds of the digits of an f64 are lost and more.
const NEARLY_SINGULAR: f64 = 1e12;

/// What is requested.
#[derive(Clone, Copy, Debug, Default)]
pub struct Request<'a> {
    /// Digits to which the conditions shall hold, from 1 to [`MOST_POLISHED_DIGITS`]; `None` for as many as can be.
    pub digits: Option<u32>,
    /// Decimals that stay as printed, beside those that the table calls free: names of constants, or places such as
    /// `kick[2]`, `drift[3]`, `gamma[1]`.
    pub free: &'a [String],
    /// Whether Σ a_s³ = 0 is to hold too: where kicks are themselves split by a symmetric step of order 2, as in
    /// heliocentric coordinates, each leaves an error (a_s h)³ (Farrés et al., Celest. Mech. Dyn. Astron. 116 (2013)
    /// 141).
    pub split_kicks: bool,
    /// Where about the step of the harmonic oscillator turns by a multiple of π, hω, and must not be unstable: each is
    /// one more unknown, with two conditions.
    pub closed_gaps: &'a [f64],
}

fn request(message: impl Into<String>, hint: impl Into<String>) -> NotPolished {
    NotPolished::Request { message: message.into(), hint: hint.into() }
}

/// Finds the values near the printed decimals with which the conditions hold of the orders that the table claims, the
/// near-integrable ones among them.
///
/// # Errors
/// Faults of the table; names of decimals that it does not have; conditions that no values near the printed ones meet,
/// or that do not determine them.
pub fn polish(source: &Source, library: Library<'_>, wanted: &Request<'_>) -> Result<Polished, NotPolished> {
    let (scheme, base) = readable(source, library)?;
    let table = &scheme.table;
    let model = Model::of(table, base)?;
    if model.unknowns.is_empty() {
        return Err(request(
            format!("{} has no printed decimals, its weights are exact", source.path),
            refusal::fixed_decimals(table).unwrap_or("decimals that stand alone are polished".to_owned()),
        ));
    }
    if model.unknowns.len() > MOST_DECIMALS {
        let message = format!("{} decimals are too many to solve for", model.unknowns.len());
        return Err(request(
            message,
            format!("at most {MOST_DECIMALS} are, those that mirror each other counted once"),
        ));
    }
    let held = held(&model, table, wanted)?;
    if held.iter().collect::<BTreeSet<_>>().len() == model.unknowns.len() {
        let hint = "leave some out of --free, and of `free` in the table: the conditions are solved for these";
        return Err(request("every decimal is held as printed, so there is nothing to solve for", hint));
    }
    let equations = Equations::of(&model, table, wanted.split_kicks);
    let problem = Problem { model: &model, equations: &equations, closed_gaps: wanted.closed_gaps };
    let printed_digits = model.unknowns.iter().map(|u| u.decimal.significant).max().unwrap_or(1);
    let residual_printed = problem.residual(&problem.printed(), printed_digits);
    let most_digits = wanted.digits.unwrap_or(MOST_POLISHED_DIGITS);
    let solution = problem.solve(&held, most_digits).map_err(|failure| {
        let (message, hint) = refusal::unsolved(&problem, &failure, residual_printed, &held);
        NotPolished::Unsolved { message, hint: refusal::reason(&scheme, &model).unwrap_or(hint) }
    })?;
    let names = write::names(table, &model);
    let mut found = NewTable::of(&problem, table, &names, &solution, most_digits, library)?;
    // closed forms and bases have fewer digits than can be requested: then as many as they have
    while wanted.digits.is_none() && found.holds() < found.digits && found.holds() > printed_digits {
        found = NewTable::of(&problem, table, &names, &solution, found.holds(), library)?;
    }
    found.is_enough()?;
    let NewTable { x, written, text, proved, residual, .. } = found;
    let weights = (0..names.len()).map(|u| weight(&model, u, &names[u], &x[u], &written[u], &held)).collect();
    let conditions = problem.rows(&x, 20).map_or(0, |(rows, _)| rows.len());
    let unused = model.unused.iter().map(|name| format!("`{name}` is used by no weight"));
    let higher = printed::higher_orders(table, &printed::proof(&scheme, &model));
    let is_singular = solution.condition_number > NEARLY_SINGULAR;
    let steps = is_singular.then(|| printed::verlet_steps(&scheme, &model)).flatten();
    Ok(Polished {
        text,
        proved,
        weights,
        in_gamma: equations.are_in_gamma(),
        conditions,
        condition_number: solution.condition_number,
        residual_printed,
        residual,
        notes: unused.chain(higher).chain(steps).collect(),
    })
}

/// The scheme and the base of a composition; the claims need not hold yet.
pub(crate) fn readable(
    source: &Source,
    library: Library<'_>,
) -> Result<(ExactScheme, Option<ExactScheme>), NotPolished> {
    let (scheme, faults) = exact::scheme(source, library);
    let Some(scheme) = scheme.filter(|_| faults.is_empty()) else {
        return Err(NotPolished::Faults(Faults::of(faults).expect("what is not a scheme has a fault")));
    };
    let base = match &scheme.table.weights {
        Some(Weights::Composition { base, .. }) => {
            library(&base.value, source).and_then(|base| exact::scheme(&base, library).0)
        }
        _ => None,
    };
    Ok((scheme, base))
}

fn held(model: &Model, table: &Table, wanted: &Request<'_>) -> Result<Vec<usize>, NotPolished> {
    let named = |name: &String| {
        model.unknown(name).ok_or_else(|| {
            if model.unused.contains(name) {
                return request(format!("`{name}` is used by no weight"), "leave it out of --free: it stays as it is");
            }
            if model.is_exact(name) {
                let hint = "leave it out of --free: fractions and formulas stay as they are";
                return request(format!("`{name}` is not a printed decimal"), hint);
            }
            let names = || model.unknowns.iter().map(|u| u.name.as_str());
            let hint = match nearest(name, names()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => {
                    let (few, all) = (nearest_few(name, names(), 6), names().count());
                    format!("its decimals: {}{}", few.join(", "), if few.len() < all { ", …" } else { "" })
                }
            };
            request(format!("the table has no printed decimal `{name}`"), hint)
        })
    };
    // a free parameter of the table may be a fraction, which stays as it is
    let free = table.free.iter().filter_map(|name| model.unknown(&name.value)).map(Ok);
    free.chain(wanted.free.iter().map(named)).collect()
}

fn weight(
    model: &Model,
    unknown: usize,
    constant: &str,
    polished: &Rational,
    written: &Written,
    held: &[usize],
) -> PolishedWeight {
    let printed = &model.unknowns[unknown];
    PolishedWeight {
        name: printed.name.clone(),
        constant: constant.to_owned(),
        printed: printed.decimal.value.clone(),
        printed_digits: printed.decimal.significant,
        polished: polished.clone(),
        right: printed.right_digits(polished),
        role: match written {
            Written::AsPrinted if held.contains(&unknown) => Role::Held,
            Written::AsPrinted => Role::Free,
            Written::Decimal(_) => Role::Solved,
            Written::Formula(_) => Role::Formula,
        },
    }
}
