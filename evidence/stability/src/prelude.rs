//! What most cases use.

pub(crate) use std::ops::ControlFlow;

pub(crate) use serde::{Deserialize, Serialize};
pub(crate) use shadowstep::{Number, Rational, Scheme, StepSize};
pub(crate) use shadowstep_scenes::computation::{Computation, RunNumber};
pub(crate) use shadowstep_scenes::library::NamedScheme;
pub(crate) use shadowstep_scenes::start::Begin;
pub(crate) use shadowstep_scenes::{Error, System};
pub(crate) use shadowstep_studies::Continues;
pub(crate) use shadowstep_studies::finding::Finding;
pub(crate) use shadowstep_studies::verdict::Verdict;

pub(crate) use crate::case::{Case, Done, Row, joined, largest};
pub(crate) use crate::integrator::{AnyIntegrator, start, start_in, step_size, steps_of};
pub(crate) use crate::suite::{Examined, Suite};
pub(crate) use crate::systems::{known_values, of_formula, rational, rationals, shipped};
pub(crate) use crate::table::{Table, Values};
pub(crate) use crate::trial::Trial;
pub(crate) use crate::watched::Watched;
