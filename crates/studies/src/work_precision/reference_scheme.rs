//! The scheme of a reference.

use num_traits::ToPrimitive;
use shadowstep::Carried;
use shadowstep_scenes::library::{NamedScheme, scheme};
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::start::SceneIntegrator;

use crate::Error;
use crate::work_precision::problem::Problem;
use crate::work_precision::size::Size;

/// The largest coordinate at t = 0; where all are 0, that after a radian of the fastest oscillation.
pub(crate) fn largest_coordinate(problem: Problem<'_>) -> Size {
    let largest = |q: &[f64]| q.iter().fold(0.0_f64, |size, q| size.max(q.abs()));
    let size = match largest(&problem.system.start::<f64>(&()).0) {
        0.0 => after_a_radian(problem).map_or(0.0, |mut moved| largest(moved.system().state().q())),
        size => size,
    };
    Size::of(&size.max(f64::MIN_POSITIVE))
}

/// One step from t = 0.
fn after_a_radian(problem: Problem<'_>) -> Option<SceneIntegrator<f64>> {
    let named = for_system(scheme(Scheme::ANY.name).ok()?, problem.system).ok()?;
    let mut integrator = problem.integrator(&named, first_steps(problem, 1), &()).ok()?;
    integrator.step(Carried::Nothing);
    Some(integrator)
}

/// Errors above this part of the largest coordinate cost less by the scheme for planets; log₁₀.
const LEAST_OF_PLANETS: f64 = -14.0;

/// The scheme of a reference; its weights have 250 digits.
#[derive(Clone, Copy)]
pub(crate) struct Scheme {
    pub(crate) name: &'static str,
    /// Its evaluations in a step.
    pub(crate) evaluations: f64,
    /// Where half the step divides the differences by this and more, it shows its order, and the error is less than the
    /// last difference by this factor; log₁₀.
    pub(crate) gain: f64,
}

impl Scheme {
    /// Of order 10 for every T(p): half the step divides its error by 1024.
    pub(crate) const ANY: Scheme = Scheme { name: "sofroniou-spaletta10-35", evaluations: 35.0, gain: 2.4 };
    /// Beside Kepler orbits, of order (10, 6, 4), a quarter of the cost for errors above 1e-14: half the step divides
    /// its error by 16 at least.
    pub(crate) const PLANETS: Scheme = Scheme { name: "abah1064", evaluations: 9.0, gain: 0.9 };

    /// The one for positions with an error of about this size, with steps for the system.
    pub(crate) fn of(problem: Problem<'_>, error: Size) -> Result<(Scheme, NamedScheme), Error> {
        let system = problem.system;
        if system.parts.planets().is_some()
            && error > largest_coordinate(problem).times_power_of_ten(LEAST_OF_PLANETS)
            && let Ok(named) = for_system(scheme(Scheme::PLANETS.name)?, system)
        {
            return Ok((Scheme::PLANETS, named));
        }
        Ok((Scheme::ANY, for_system(scheme(Scheme::ANY.name)?, system)?))
    }
}

/// The number of steps for which the fastest motion turns by about a radian in each; one a sample where none is known.
pub(crate) fn first_steps(problem: Problem<'_>, samples: u64) -> u64 {
    let omega = problem.system.fastest_motion().map_or(0.0, |motion| motion.omega);
    let per_sample = (omega * problem.duration() / samples as f64).ceil().to_u64().unwrap_or(1);
    samples * per_sample.max(1)
}
