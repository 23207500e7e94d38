//! The length of a run in the fictitious time s, where time is transformed, and how many steps of given sizes there
//! are.

use num_integer::Integer as _;
use num_traits::{FromPrimitive, One as _, Signed};
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::{Integrator as _, Number, Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::column::Column;
use shadowstep_scenes::computation::RunNumber as _;
use shadowstep_scenes::library::scheme;
use shadowstep_scenes::posed::Posed;
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::readable::{LONGEST_NUMBER, shortened};
use shadowstep_scenes::run::Run;
use shadowstep_scenes::steps::{self, nearly_equal};
use shadowstep_scenes::{Error, System};
use shadowstep_schemes::symbolic::decimal::{from_text, to_significant};

/// A composition of the leapfrog, for every T(p).
const SCHEME: &str = "sofroniou-spaletta6-13";
/// A run of fewer steps says little of the length.
const FEWEST_STEPS: u64 = 64;
/// No run makes more steps.
const MOST_STEPS: u64 = 1 << 24;
/// The step is halved so often at most.
const MOST_HALVINGS: u32 = 60;
/// The lengths with a step and with half of it agree to this part.
const AGREE: f64 = 0.01;

/// The length in s of a run to the physical time `until`, to about a hundredth, with three digits: which multiple of it
/// a step is says about how many there are. `None` where time is not transformed.
///
/// # Errors
/// A system that has no states up to this time.
pub fn length_of(system: &System, until: &Rational) -> Result<Option<Rational>, Error> {
    if system.transformed_time().is_none() {
        return Ok(None);
    }
    let mut h = until.clone();
    let mut last = f64::NAN;
    for _ in 0..MOST_HALVINGS {
        let found = length_by(system, until, &h)?;
        if let Some(length) = found.filter(|length| (length / last - 1.0).abs() < AGREE) {
            let length = Rational::from_f64(length).expect("it is finite");
            return Ok(from_text(&to_significant(&length, 3)).ok());
        }
        last = found.unwrap_or(f64::NAN);
        h /= Rational::from_integer(2.into());
    }
    let message = "there are no steps in the transformed time up to the end of the runs";
    Err(Error::run(message, "use a shorter time, or remove [time]"))
}

/// The length by steps of this size, linearly in the last of them; `None` if there are few, or too many, or a state is
/// not finite.
fn length_by(system: &System, until: &Rational, h: &Rational) -> Result<Option<f64>, Error> {
    let scheme = for_system(scheme(SCHEME)?, system)?;
    let size = StepSize::try_from(h.clone()).map_err(|error| Error::usage(error.to_string(), "use a longer time"))?;
    let run = Run { propagator: SCHEME, h: &size, steps: MOST_STEPS, order: None, windows: Run::WINDOWS };
    let posed = Posed::new(system, &scheme.scheme, run, (Arithmetic::DOUBLE, false));
    let mut steps = StepsUntil { end: <f64 as Number>::from_rational(&until.abs(), &()), before: 0.0, found: None };
    match f64::follow(&posed, &(), &mut [&mut steps], &mut ()) {
        Ok(_) | Err(Error::Run { .. }) => {
            let found = steps.found.filter(|steps| *steps >= FEWEST_STEPS as f64);
            Ok(found.map(|steps| <f64 as Number>::from_rational(h, &()) * steps))
        }
        Err(error) => Err(error),
    }
}

/// Counts the steps to a physical time, and ends the run there.
struct StepsUntil {
    end: f64,
    /// The time of the state before.
    before: f64,
    found: Option<f64>,
}

impl Column<f64> for StepsUntil {
    fn sees_each(&self) -> bool {
        true
    }

    fn see(&mut self, n: i64, _: Run<'_>, integrator: &mut VectorIntegrator<'_, f64>) -> bool {
        let t = integrator.state().q().last().map_or(f64::NAN, |t| t.abs());
        if t < self.end {
            self.before = t;
            return false;
        }
        self.found = Some((n - 1) as f64 + (self.end - self.before) / (t - self.before));
        true
    }
}

/// The numbers of steps of these sizes, the least first and each once. The time of the runs must be a multiple of each
/// size; a length in s, where time is transformed, becomes one.
///
/// # Errors
/// Sizes that do not divide the time, have another sign, or are longer than it.
pub fn counts(sizes: &[StepSize], until: &Rational, length: Option<&mut Rational>) -> Result<Vec<u64>, Error> {
    let until = match length {
        Some(length) => {
            // the steps to the end are about as many as there are in a length that is a multiple of all
            let exact: Vec<_> = sizes.iter().map(|h| h.exact().clone()).collect();
            *length = common_multiple(length, &exact);
            length
        }
        None => until,
    };
    let count = |h: &StepSize| {
        let [step, end] = [h.exact(), until].map(|time| shortened(time, LONGEST_NUMBER));
        let count =
            steps::count((h, &step), (until, &end)).map_err(|none| Error::usage(none.to_string(), none.hint()))?;
        if nearly_equal(&(h.exact() * Rational::from_integer(count.into())), until) {
            return Ok(count);
        }
        let message =
            format!("until {end} is not a multiple of the step {step}, so that runs would end at other times");
        Err(Error::usage(message, "use steps that divide the time"))
    };
    let mut counts = sizes.iter().map(count).collect::<Result<Vec<u64>, Error>>()?;
    counts.sort_unstable();
    counts.dedup();
    Ok(counts)
}

/// The common multiple of these step sizes that is closest to the length, at least one.
pub(crate) fn common_multiple(length: &Rational, steps: &[Rational]) -> Rational {
    let least =
        steps.iter().map(Signed::abs).reduce(|a, b| Rational::new(a.numer().lcm(b.numer()), a.denom().gcd(b.denom())));
    let least = least.unwrap_or_else(|| length.abs());
    let half = Rational::new(1.into(), 2.into());
    let times = (length.abs() / &least + half).floor().max(Rational::one());
    least * times * length.signum()
}

#[cfg(test)]
mod tests {
    use shadowstep::exact;

    use super::common_multiple;

    #[test]
    fn the_closest_common_multiple_of_steps() {
        let [length, h, g] = ["10.1", "1/4", "1/6"].map(|text| exact(text).unwrap());
        assert_eq!(common_multiple(&length, &[h, g]), exact("10").unwrap());
    }
}
