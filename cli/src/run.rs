//! One run: a scheme, or the exact flow, and a step size.

use shadowstep::Rational;
use shadowstep::exact_flow::ExactFlowError;
use shadowstep::run::RunError;

use crate::complaint::Complaint;
use crate::estimator::Chosen;
use crate::readable::shortened;

const OTHER_START: &str = "a smaller step or another initial state may go on";

/// n = 0, …, steps at the times n h.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run<'a> {
    /// The name of a scheme, or exact-flow.
    pub(crate) propagator: &'a str,
    pub(crate) h: &'a Rational,
    pub(crate) steps: u64,
    /// The order of the estimator, where a person set it or could.
    pub(crate) order: Option<OrderSetting>,
}

/// What holds the order of the estimator, as it is spelt where the run is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OrderSetting {
    /// `--max-order`, or `order` in a scene.
    pub(crate) name: &'static str,
    pub(crate) value: u32,
}

impl Run<'_> {
    /// t = n h
    pub(crate) fn time(&self, n: i64) -> Rational {
        self.h * Rational::from_integer(n.into())
    }

    /// The time of the last state.
    pub(crate) fn time_of_last(&self) -> Rational {
        self.h * Rational::from_integer(self.steps.into())
    }

    /// The time of the n-th value of an estimator: n h, or for one whose values belong to the middle between two states
    /// (n + 1/2) h.
    pub(crate) fn time_of_value(&self, n: i64, estimator: &Chosen) -> Rational {
        if estimator.is_between() { self.h * Rational::new((2 * n + 1).into(), 2.into()) } else { self.time(n) }
    }

    /// Which run it is, in messages.
    pub(crate) fn name(&self) -> String {
        format!("{}, step {}", self.propagator, shortened(self.h, 20))
    }

    /// A state is not finite.
    pub(crate) fn failed(&self, error: &RunError) -> Complaint {
        match error {
            RunError::NotFinite { step, what } if *step < 0 => {
                self.ended_beyond(*step, what, "states before t = 0 are made for the modified energies near it")
            }
            RunError::NotFinite { step, what } if step.unsigned_abs() > self.steps => {
                self.ended_beyond(*step, what, "states after the last one are made for the modified energies near it")
            }
            RunError::NotFinite { step, what } => self.ended(&format!("the run ends at n = {step} with {what}")),
            RunError::ZeroStep => self.ended(&error.to_string()),
        }
    }

    /// The exact flow cannot be followed.
    pub(crate) fn not_followed(&self, error: &ExactFlowError) -> Complaint {
        Complaint::run(format!("{}: {error}", self.name()), "an earlier --until or another initial state may go")
    }

    /// All states are finite, an energy is not.
    pub(crate) fn not_finite(&self, energy: &str) -> Complaint {
        self.ended(&format!("{energy} is not finite"))
    }

    fn ended(&self, how: &str) -> Complaint {
        let sentence = format!("{}: {how}", self.name());
        Complaint::run(sentence, OTHER_START)
    }

    /// At a state that only the estimator needs: the lower its order, the fewer there are.
    fn ended_beyond(&self, n: i64, what: &str, why: &str) -> Complaint {
        let sentence = format!("{}: the run ends at n = {n} with {what}; {why}", self.name());
        let hint = match self.order {
            Some(OrderSetting { name, value }) => {
                format!("a lower {name} (here {value}) needs fewer of them; {OTHER_START}")
            }
            None => OTHER_START.to_owned(),
        };
        Complaint::run(sentence, hint)
    }
}
