//! Arguments → problem, schemes and steps: the runs to make.

use num_traits::{Signed, ToPrimitive, Zero};
use shadowstep::Rational;
use shadowstep::number::{Number, Precision};
use shadowstep::problems::{ProblemMotion, Setup, problem};
use shadowstep::shadow::{Central, Stop};
use shadowstep_schemes::exact::DIGITS as TABLE_DIGITS;
use shadowstep_schemes::scheme::Held;
use shadowstep_symbolic::decimal::{to_significant, to_text};

use crate::arguments::{OrderChoice, RunArguments, StopChoice};
use crate::complaint::{Complaint, remark};
use crate::figures::shortened;
use crate::library::{self, Named};
use crate::quantity;
use crate::run::Run;

/// More steps than anyone can wait for.
const MOST_STEPS: u64 = 10_000_000_000;

/// Digits beyond those of the run, so that values are rounded once only as far as the run can see.
const GUARD_DIGITS: u32 = 20;

/// Irrational values are not computed to more digits.
const MOST_VALUE_DIGITS: u32 = 5000;

/// The significant digits of f64, rounded up.
const DOUBLE_DIGITS: u32 = 16;

/// Everything that is to be run.
#[derive(Debug)]
pub(crate) struct Selection {
    pub(crate) setup: Setup,
    pub(crate) until: Rational,
    pub(crate) arithmetic: Arithmetic,
    pub(crate) order: Order,
    schemes: Vec<Named>,
    steps: Vec<(Rational, u64)>,
}

/// The kind of the numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Arithmetic {
    Double,
    Digits(u32, Precision),
}

/// The m of the estimator.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Order {
    Fixed(u32),
    Best(u32, Stop),
}

impl Selection {
    pub(crate) fn read(arguments: &RunArguments) -> Result<Self, Complaint> {
        let arithmetic = arithmetic(arguments)?;
        let order = order(arguments)?;
        let setup = setup(arguments, arithmetic)?;
        let until = quantity::number("--until", &arguments.until)?;
        let mut steps: Vec<_> = arguments.steps.iter().map(|text| step(text, &until)).collect::<Result<_, _>>()?;
        let words = each_once(&arguments.schemes, |word| word.clone(), "scheme");
        let schemes = words.iter().map(|word| library::scheme(word)).collect::<Result<_, _>>()?;
        steps = each_once(&steps, |(h, _)| to_text(h), "step");
        let selection = Selection { setup, until, arithmetic, order, schemes, steps };
        let digits = arithmetic.digits();
        selection.schemes.iter().try_for_each(|scheme| check_digits(scheme, digits))?;
        selection.remark_on_ends();
        Ok(selection)
    }

    /// The runs, all steps of a scheme together.
    pub(crate) fn runs(&self) -> impl Iterator<Item = Run<'_>> {
        let steps = |scheme| self.steps.iter().map(move |(h, steps)| Run { scheme, h, steps: *steps });
        self.schemes.iter().flat_map(steps)
    }

    /// The one run, where there is one only.
    pub(crate) fn single(&self) -> Option<Run<'_>> {
        let mut runs = self.runs();
        runs.next().filter(|_| runs.next().is_none())
    }

    /// The problem at its initial state.
    pub(crate) fn motion<N: Number + 'static>(&self, context: &N::Context) -> ProblemMotion<N> {
        self.setup.motion(context).expect("problems allow positive masses only")
    }

    /// The estimator; a fixed order estimates its error only if asked to.
    pub(crate) fn method(&self, with_error: bool) -> Central {
        match self.order {
            Order::Fixed(m) => Central::Fixed { m, with_error },
            Order::Best(largest, stop) => Central::best(largest, stop),
        }
    }

    /// Every parameter and initial value with its exact text, or the digits of what is irrational.
    pub(crate) fn values(&self) -> Vec<(String, String)> {
        let digits = value_digits(self.arithmetic) as usize;
        let text = |exact: &shadowstep_symbolic::Exact| match exact.rounded {
            true => to_significant(&exact.value, digits),
            false => to_text(&exact.value),
        };
        self.setup.values.iter().map(|(name, exact)| (name.clone(), text(exact))).collect()
    }

    fn remark_on_ends(&self) {
        for (h, steps) in &self.steps {
            let end = h * Rational::from_integer((*steps).into());
            if end != self.until {
                let (until, h, end) = (shortened(&self.until, 20), shortened(h, 20), to_significant(&end, 12));
                remark(format_args!("{until} is not a multiple of {h}: the run ends at n = {steps}, t = {end}"));
            }
        }
    }
}

impl Arithmetic {
    fn digits(self) -> u32 {
        match self {
            Arithmetic::Double => DOUBLE_DIGITS,
            Arithmetic::Digits(digits, _) => digits,
        }
    }
}

/// Refuses more digits than the weights have; remarks on an order that holds to fewer digits than the run has.
fn check_digits(Named { name, scheme }: &Named, digits: u32) -> Result<(), Complaint> {
    let proved = scheme.proved();
    let closed_forms = proved.scheme.held == Held::Digits(TABLE_DIGITS) && proved.scheme.table.digits.is_none();
    if closed_forms && digits > TABLE_DIGITS {
        let sentence =
            format!("{name} has irrational weights, held to {TABLE_DIGITS} digits; the run asks for {digits}");
        let hint = format!("use --digits {TABLE_DIGITS}, or a scheme whose weights are fractions");
        return Err(Complaint::usage(sentence, hint));
    }
    let order = proved.order();
    if let Some(held) = order.digits.filter(|held| !closed_forms && *held < digits) {
        let order = order.order;
        remark(format_args!("{name} has order {order} to {held} digits only; below that its order is lower"));
    }
    Ok(())
}

fn arithmetic(arguments: &RunArguments) -> Result<Arithmetic, Complaint> {
    if arguments.double {
        return Ok(Arithmetic::Double);
    }
    let precision = Precision::digits(arguments.digits);
    let precision = precision.map_err(|error| Complaint::usage(error.to_string(), "use --digits 120"))?;
    Ok(Arithmetic::Digits(arguments.digits, precision))
}

fn order(arguments: &RunArguments) -> Result<Order, Complaint> {
    match arguments.order {
        OrderChoice::Auto => {
            let stop = match arguments.stop {
                Some(StopChoice::Early) => Stop::Early,
                Some(StopChoice::Full) | None => Stop::Full,
            };
            Ok(Order::Best(arguments.max_order.unwrap_or(200), stop))
        }
        OrderChoice::Fixed(m) if arguments.max_order.is_none() && arguments.stop.is_none() => Ok(Order::Fixed(m)),
        OrderChoice::Fixed(m) => Err(Complaint::usage(
            format!("--max-order and --stop are for --order auto, not for --order {m}"),
            "leave them out, or write --order auto",
        )),
    }
}

fn setup(arguments: &RunArguments, arithmetic: Arithmetic) -> Result<Setup, Complaint> {
    let set = arguments.set.iter().map(|text| quantity::assignment(text)).collect::<Result<Vec<_>, _>>()?;
    let digits = value_digits(arithmetic);
    let setup = problem(&arguments.problem)?.setup(&set, digits)?;
    match setup.values.iter().find(|(_, value)| value.rounded && digits > MOST_VALUE_DIGITS) {
        None => Ok(setup),
        Some((name, _)) => Err(Complaint::usage(
            format!("{name} is irrational and computed to {MOST_VALUE_DIGITS} digits, the run needs {digits}"),
            format!("use --digits {} or less, or set {name} to a fraction", MOST_VALUE_DIGITS - GUARD_DIGITS),
        )),
    }
}

fn value_digits(arithmetic: Arithmetic) -> u32 {
    arithmetic.digits() + GUARD_DIGITS
}

/// The list without what is in it twice, which a remark tells.
fn each_once<T: Clone>(list: &[T], name: impl Fn(&T) -> String, what: &str) -> Vec<T> {
    let mut kept: Vec<T> = Vec::new();
    for item in list {
        if kept.iter().any(|other| name(other) == name(item)) {
            remark(format_args!("the {what} {} is named twice; it is run once", name(item)));
        } else {
            kept.push(item.clone());
        }
    }
    kept
}

/// A step size h, and how many steps end at or before `until`.
fn step(text: &str, until: &Rational) -> Result<(Rational, u64), Complaint> {
    let h = quantity::number("--step", text)?;
    let refuse = |sentence: String, hint: &str| Err(Complaint::usage(sentence, hint));
    if h.is_zero() {
        return refuse(format!("--step {text} is zero"), "a step has a size, such as 1/10");
    }
    let end = to_text(until);
    if until.is_zero() {
        return refuse(format!("--until {end} leaves no time for a step"), "write a time such as --until 100");
    }
    let count = (until / &h).floor();
    if count.is_negative() {
        let hint = "both are positive, or both negative to go back in time";
        return refuse(format!("steps of {text} never come to --until {end}: their signs differ"), hint);
    }
    match count.to_u64() {
        Some(0) => refuse(format!("--step {text} is longer than the run until {end}"), "use a shorter step"),
        Some(steps) if steps <= MOST_STEPS => Ok((h, steps)),
        _ => refuse(
            format!("steps of {text} until {end} are {} steps", to_significant(&count, 3)),
            "more than 1e10 are not run: use a longer step or a shorter time",
        ),
    }
}
