//! What most figures use.

pub(crate) use shadowstep::Real;
pub(crate) use shadowstep::problems::Problem;
pub(crate) use shadowstep::shadow::{EstimatorSettings, StoppingRule};

pub(crate) use crate::chart::{Axis, Curve, Mark, Marker};
pub(crate) use crate::figures::drawing::{Drawing, Points, Series, lines};
pub(crate) use crate::figures::estimator::{BEST, best, bilinear, central};
pub(crate) use crate::figures::fit::{
    ExponentialDecay, Line, ROUND_OFF, Ratio, against_aliasing, by_step, decay, range,
};
pub(crate) use crate::figures::interval::Interval;
pub(crate) use crate::figures::measured::Energies;
pub(crate) use crate::figures::numbers::{Wide, decimal, number, power, scientific};
pub(crate) use crate::figures::run::{EXACT_FLOW, FORCES, Run, SCHEMES};
pub(crate) use crate::verdict::{Coverage, Verdict};
