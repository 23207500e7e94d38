//! One run: a scheme, or the exact flow, and a step size.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`arithmetic`] | number types and their digits |
//! | [`steps`] | the number of steps |
//! | [`start`] | a system at a state with its stepper |
//! | [`estimator`] | messages about options of estimators |
//! | `note` | what the user should know that is not an error |
//! | `snapshots`, `saved_state`, `saved_summary` | what is kept of a run so that it can be resumed |
//! | [`cpu_time`] | what it costs |

pub mod arithmetic;
pub mod cpu_time;
pub mod estimator;
pub(crate) mod note;
pub(crate) mod saved_state;
pub(crate) mod saved_summary;
pub(crate) mod snapshots;
pub mod start;
pub mod steps;

use std::any::Any;

use num_traits::ToPrimitive;
use shadowstep::shadow::EstimatorSettings;
use shadowstep::shadow::exact_flow::ExactFlowError;
use shadowstep::shadow::run::{NotFinite, Quantity, RunError};
use shadowstep::{Number, Rational, StepSize};

use crate::texts::error::Error;
use crate::texts::readable::shortened;

const OTHER_START: &str = "try a smaller step size or another initial state";

/// n = 0, …, steps at the times n h.
#[derive(Clone, Copy, Debug)]
pub struct Run<'a> {
    /// The name of a scheme, or exact-flow.
    pub propagator: &'a str,
    /// The step size.
    pub h: &'a StepSize,
    /// The number of steps.
    pub steps: u64,
    /// The option that sets the order of the estimator, if there is one.
    pub order: Option<OrderSetting>,
    /// In about how many windows a summary compares modified energies, [`Run::WINDOWS`] where nothing else is wanted.
    pub windows: u64,
}

/// The option that sets the order of the estimator or its largest order, as it is spelt by the caller.
#[derive(Clone, Copy, Debug)]
pub struct OrderSetting {
    /// Such as `order`.
    pub name: &'static str,
    /// Its value.
    pub value: u32,
}

/// n h where both parts of the fraction are doubles without rounding, so that their quotient is rounded once: a run
/// that keeps each state takes a third less time than with fractions.
fn double_multiple(h: &Rational, n: i64) -> Option<f64> {
    const EXACT: i64 = 1 << f64::MANTISSA_DIGITS;
    let is_exact = |x: &i64| (-EXACT..=EXACT).contains(x);
    let numerator = h.numer().to_i64()?.checked_mul(n).filter(is_exact)?;
    let denominator = h.denom().to_i64().filter(is_exact)?;
    Some(numerator as f64 / denominator as f64)
}

impl Run<'_> {
    /// The windows of a summary: the same number however long the run is, so that it costs the same.
    pub const WINDOWS: u64 = 256;

    /// t = n h
    pub fn time(&self, n: i64) -> Rational {
        self.h.exact() * Rational::from_integer(n.into())
    }

    /// The same in a number of the run, rounded once.
    pub(crate) fn time_in<N: Number + 'static>(&self, n: i64, context: &N::Context) -> N {
        let of_doubles = double_multiple(self.h.exact(), n);
        let own = of_doubles.and_then(|time| (&time as &dyn Any).downcast_ref::<N>().cloned());
        own.unwrap_or_else(|| N::from_rational(&self.time(n), context))
    }

    /// The time of the last state.
    pub(crate) fn time_of_last(&self) -> Rational {
        self.h.exact() * Rational::from_integer(self.steps.into())
    }

    /// The time of the n-th value of an estimator: n h, or for one whose values belong to the middle between two states
    /// (n + 1/2) h.
    pub fn time_of_value(&self, n: i64, estimator: &EstimatorSettings) -> Rational {
        if estimator.is_between() { self.h.exact() * Rational::new((2 * n + 1).into(), 2.into()) } else { self.time(n) }
    }

    /// Which run it is, in messages.
    pub fn name(&self) -> String {
        format!("{}, step {}", self.propagator, shortened(self.h.exact(), 20))
    }

    /// The run stopped; coordinates and momenta are numbered.
    pub fn failed(&self, error: &RunError) -> Error {
        self.failed_naming(error, &[], &[])
    }

    /// The run stopped; coordinates and momenta have these names.
    pub(crate) fn failed_naming(&self, error: &RunError, coordinates: &[String], momenta: &[String]) -> Error {
        let RunError::NotFinite { step, value } = error else { return self.ended(&error.to_string()) };
        let value = named(value, coordinates, momenta);
        if *step < 0 {
            self.ended_beyond(*step, &value, "states before t = 0 are made for the modified energies near it")
        } else if step.unsigned_abs() > self.steps {
            self.ended_beyond(*step, &value, "states after the last one are made for the modified energies near it")
        } else {
            let hint = if *step == 0 { "choose another initial state, or other parameters" } else { OTHER_START };
            Error::run(format!("{}: the run stopped at n = {step}: {value}", self.name()), hint)
        }
    }

    /// The exact flow cannot be followed.
    pub fn not_followed(&self, error: &ExactFlowError) -> Error {
        Error::run(format!("{}: {error}", self.name()), "try a shorter time or another initial state")
    }

    /// All states are finite, an energy is not.
    pub fn not_finite(&self, energy: &str) -> Error {
        self.ended(&format!("{energy} is not finite"))
    }

    fn ended(&self, how: &str) -> Error {
        let message = format!("{}: {how}", self.name());
        Error::run(message, OTHER_START)
    }

    /// At a state that only the estimator needs: the lower its order, the fewer there are.
    fn ended_beyond(&self, n: i64, value: &str, why: &str) -> Error {
        let message = format!("{}: the run stopped at n = {n}: {value}; {why}", self.name());
        let hint = match self.order {
            Some(OrderSetting { name, value }) => {
                format!("a lower {name} (here {value}) needs fewer of them; {OTHER_START}")
            }
            None => OTHER_START.to_owned(),
        };
        Error::run(message, hint)
    }
}

/// The value that is not finite, with the name of its coordinate or momentum if it has one.
fn named(value: &NotFinite, coordinates: &[String], momenta: &[String]) -> String {
    let name = match value.quantity {
        Quantity::Position(index) => coordinates.get(index),
        Quantity::Momentum(index) => momenta.get(index),
        _ => None,
    };
    name.map_or_else(|| value.to_string(), |name| format!("{name} = {}", value.value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rounded_once() {
        let steps = [
            "1/10",
            "1/3",
            "-7/1000",
            "100",
            "0.30000000000000004",
            "9007199254740993",
            "1/9007199254740993",
            "1e-300",
        ];
        for h in steps {
            let h = StepSize::try_from(h).unwrap();
            let run = Run { propagator: "yoshida4", h: &h, steps: 1, order: None, windows: Run::WINDOWS };
            for n in [0, 1, -1, 3, 10, 12345, 1 << 40, i64::MAX, i64::MIN] {
                let expected = f64::from_rational(&run.time(n), &());
                assert_eq!(run.time_in::<f64>(n, &()).to_bits(), expected.to_bits(), "{n} * {h:?}");
            }
        }
        assert_eq!(
            [1, i64::MAX].map(|n| double_multiple(&Rational::new(1.into(), 3.into()), n)),
            [Some(1.0 / 3.0), None]
        );
    }
}
