//! What most figures use.

pub(crate) use shadowstep::Real;
pub(crate) use shadowstep::problems::Problem;
pub(crate) use shadowstep::shadow::{EstimatorSettings, StoppingRule};
pub(crate) use shadowstep_studies::chart::{Axis, Curve, Mark, Marker};
pub(crate) use shadowstep_studies::verdict::{Coverage, Verdict};

pub(crate) use crate::drawing::{Drawing, Points, Series, lines};
pub(crate) use crate::estimator::{BEST, best, bilinear, central};
pub(crate) use crate::fit::{ExponentialDecay, Line, ROUND_OFF, Ratio, against_aliasing, by_step, decay, range};
pub(crate) use crate::interval::Interval;
pub(crate) use crate::measured::Energies;
pub(crate) use crate::numbers::{Wide, decimal, number, power, scientific};
pub(crate) use crate::run::{EXACT_FLOW, FORCES, Run, SCHEMES};
