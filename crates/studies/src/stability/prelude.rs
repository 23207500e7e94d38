//! What most cases use.

pub(crate) use std::ops::ControlFlow;

pub(crate) use serde::{Deserialize, Serialize};
pub(crate) use shadowstep::{Number, Rational, Scheme, StepSize};
pub(crate) use shadowstep_scenes::System;
pub(crate) use shadowstep_scenes::computation::{Computation, RunNumber};
pub(crate) use shadowstep_scenes::library::NamedScheme;
pub(crate) use shadowstep_scenes::start::Begin;

pub(crate) use crate::Continues;
pub(crate) use crate::Error;
pub(crate) use crate::finding::Finding;
pub(crate) use crate::stability::case::{Case, Done, Row, joined, largest};
pub(crate) use crate::stability::integrator::{AnyIntegrator, start, start_in, step_size, steps_of};
pub(crate) use crate::stability::suite::{Examined, Suite};
pub(crate) use crate::stability::systems::{known_values, of_formula, rational, rationals, shipped};
pub(crate) use crate::stability::table::{Table, Values};
pub(crate) use crate::stability::trial::Trial;
pub(crate) use crate::stability::watched::Watched;
pub(crate) use crate::verdict::Verdict;
