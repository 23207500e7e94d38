//! What advances a state in time: a scheme, or the exact flow.

use shadowstep::Stepper;
use shadowstep::number::{AnyLimbs, LimbCount, Number};
use shadowstep::problems::{Problem, ProblemMotion, Setup};
use shadowstep::shadow::exact_flow::{self, ExactFlowError};
use shadowstep::tables::TableScheme;

use crate::document::library::{self, EXACT_FLOW, NamedScheme, Schemes};
use crate::run::Run;
use crate::run::arithmetic::Arithmetic;
use crate::run::note::Note;
use crate::scene::System;
use crate::texts::error::Error;
use crate::texts::refusal::Refusal;

/// A scheme, or the exact flow, on which an estimator shows its own error.
#[derive(Debug)]
pub enum Propagator {
    /// A scheme.
    Scheme(Box<NamedScheme>),
    /// The exact flow.
    ExactFlow,
}

impl Propagator {
    /// The scheme that a word means, or for `exact-flow` the exact flow, if the problem has it.
    ///
    /// # Errors
    /// An unknown scheme, a table with faults, a problem whose exact flow is not known.
    pub fn read(word: &str, setup: &Setup) -> Result<Self, Error> {
        if word != EXACT_FLOW {
            return Ok(Propagator::Scheme(Box::new(library::scheme(word)?)));
        }
        exact_flow::has_exact_flow(setup).map_err(|error| {
            let hint = match error {
                ExactFlowError::NoSolution { .. } => "use a scheme, or one of these problems",
                _ => "choose another initial state",
            };
            Error::usage(error.to_string(), hint)
        })?;
        Ok(Propagator::ExactFlow)
    }

    /// The same for a system: the scheme must be valid for its kinetic energy.
    ///
    /// # Errors
    /// As [`Propagator::read`]; a scheme for quadratic T only where T is not.
    pub fn of_system(word: &str, system: &System) -> Result<Self, Error> {
        if word == EXACT_FLOW {
            return match in_ordinary_time(system) {
                Some(setup) => Propagator::read(word, &setup),
                None => {
                    let known: Vec<_> = exact_flow::problems().map(Problem::name).collect();
                    let hint = format!("use a scheme, or one of the shipped problems {}", known.join(", "));
                    Err(Error::usage("no exact flow of this system is known", hint))
                }
            };
        }
        Ok(Propagator::Scheme(Box::new(for_system(library::scheme(word)?, system)?)))
    }

    /// The same with weights that have the digits of a run, as [`NamedScheme::fitted`].
    ///
    /// # Errors
    /// As [`NamedScheme::fitted`].
    pub fn fitted(self, arithmetic: Arithmetic) -> Result<(Self, Option<Note>), Refusal> {
        let Propagator::Scheme(scheme) = self else { return Ok((self, None)) };
        let (scheme, note) = scheme.fitted(arithmetic)?;
        Ok((Propagator::Scheme(Box::new(scheme)), note))
    }

    /// The name by which it was asked for.
    pub fn name(&self) -> &str {
        match self {
            Propagator::Scheme(scheme) => &scheme.name,
            Propagator::ExactFlow => EXACT_FLOW,
        }
    }

    /// Its scheme, if it is one.
    pub fn scheme(&self) -> Option<&NamedScheme> {
        match self {
            Propagator::Scheme(scheme) => Some(scheme),
            Propagator::ExactFlow => None,
        }
    }
}

/// The shipped problem at its initial state, if its exact flow is known at the times of the steps; not in transformed
/// time, whose steps end at others.
pub(crate) fn with_exact_flow(system: &System) -> Option<Setup> {
    in_ordinary_time(system).filter(|setup| exact_flow::has_exact_flow(setup).is_ok())
}

fn in_ordinary_time(system: &System) -> Option<Setup> {
    system.setup().filter(|_| system.transformed_time().is_none())
}

/// The stepper of a run.
///
/// # Panics
/// If the step size is 0, which runs exclude.
pub fn stepper<N: Number>(named: &NamedScheme, run: Run<'_>, context: &N::Context) -> Stepper<TableScheme, N> {
    Stepper::with_context(named.quadratic(), run.h, context).expect("runs have a nonzero step size")
}

/// The problem at its initial state, in numbers of limbs.
///
/// # Panics
/// If a mass or its inverse is 0 or infinite in the number type, which the reading of a problem excludes.
pub fn motion(setup: &Setup, limbs: &LimbCount) -> ProblemMotion<AnyLimbs> {
    setup.motion(limbs).expect("the masses were read with the problem")
}

/// The scheme with steps for a system: for every T(p) or for many parts, where that is needed.
///
/// # Errors
/// A scheme that is not valid for the system: for quadratic T only where T is not, for two parts, with gradient kicks
/// that it has not, processed in transformed time.
pub fn for_system(named: NamedScheme, system: &System) -> Result<NamedScheme, Error> {
    Ok(system.needs().scheme(named, &Schemes::default())?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::arithmetic::Arithmetic;
    use shadowstep::tables::Source;

    #[test]
    fn the_exact_flow_is_not_that_of_the_steps_of_transformed_time() {
        let system = |time: &str| {
            let text = format!("problem.name = \"kepler\"\n{time}");
            let source = Source { path: "test.toml".to_owned(), text };
            System::read(&source, Arithmetic::DOUBLE).unwrap_or_else(|faults| panic!("{faults}")).0
        };
        let (plain, transformed) = (system(""), system("time.transform = \"logarithmic\""));
        assert!(with_exact_flow(&plain).is_some() && Propagator::of_system(EXACT_FLOW, &plain).is_ok());
        assert!(with_exact_flow(&transformed).is_none());
        let refused = Propagator::of_system(EXACT_FLOW, &transformed).unwrap_err().to_string();
        assert!(refused.starts_with("no exact flow of this system is known"), "{refused}");
    }
}
