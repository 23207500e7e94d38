//! What takes a state on in time: a scheme, or the exact flow.

use shadowstep::exact_flow::ExactFlowError;
use shadowstep::problems::Setup;

use crate::complaint::Complaint;
use crate::library::{self, EXACT_FLOW, Named};

/// A scheme, or the exact flow as the control of an estimator.
#[derive(Debug)]
pub(crate) enum Propagator {
    Scheme(Box<Named>),
    ExactFlow,
}

impl Propagator {
    /// What a word means, for a problem that has it.
    pub(crate) fn read(word: &str, setup: &Setup) -> Result<Self, Complaint> {
        if word != EXACT_FLOW {
            return Ok(Propagator::Scheme(Box::new(library::scheme(word)?)));
        }
        shadowstep::exact_flow::has_exact_flow(setup).map_err(|error| {
            let hint = match error {
                ExactFlowError::NoClosedForm { .. } => "take a scheme, or one of these problems",
                _ => "--set x, y, px and py to another start",
            };
            Complaint::usage(error.to_string(), hint)
        })?;
        Ok(Propagator::ExactFlow)
    }

    pub(crate) fn name(&self) -> &str {
        match self {
            Propagator::Scheme(scheme) => &scheme.name,
            Propagator::ExactFlow => EXACT_FLOW,
        }
    }

    /// Its scheme, if it is one.
    pub(crate) fn scheme(&self) -> Option<&Named> {
        match self {
            Propagator::Scheme(scheme) => Some(scheme),
            Propagator::ExactFlow => None,
        }
    }
}
