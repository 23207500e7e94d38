//! One run: a scheme, or the exact flow, and a step size.

use shadowstep::Rational;
use shadowstep::exact_flow::ExactFlowError;
use shadowstep::run::RunError;

use crate::complaint::Complaint;
use crate::estimator::Chosen;
use crate::readable::shortened;

/// n = 0, …, steps at the times n h.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run<'a> {
    /// The name of a scheme, or exact-flow.
    pub(crate) propagator: &'a str,
    pub(crate) h: &'a Rational,
    pub(crate) steps: u64,
}

impl Run<'_> {
    /// t = n h
    pub(crate) fn time(&self, n: i64) -> Rational {
        self.h * Rational::from_integer(n.into())
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
                let why = "states before t = 0 are made for the modified energies near it";
                self.ended(&format!("the run ends at n = {step} with {what}; {why}"))
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
        Complaint::run(sentence, "a smaller step or another initial state may go on")
    }
}
