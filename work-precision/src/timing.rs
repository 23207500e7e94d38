//! The time of a step: the bare steps, all schemes by turns, the median of several repeats.

use std::slice;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use shadowstep::number::Rounded;
use shadowstep::{Ordered, Scheme, Stepper, System, ValidFor};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Computation;
use shadowstep_scenes::cpu_time::CpuTime;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::Work;

use crate::problem::Problem;

/// Repeats of each scheme.
const REPEATS: usize = 9;
/// A repeat takes so long at least.
const SHORTEST: Duration = Duration::from_millis(4);

/// Seconds for a step, without estimates, energies or output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepTime {
    /// The fastest repeat.
    pub least: f64,
    /// The median.
    pub median: f64,
    /// The slowest repeat.
    pub most: f64,
}

/// The time of a step of each scheme, with a number of steps to the end.
pub(crate) fn time_of_steps(problem: Problem<'_>, schemes: &[(&NamedScheme, u64)]) -> Result<Vec<StepTime>, Error> {
    let steps =
        |(scheme, steps): &(&NamedScheme, u64)| problem.arithmetic.compute(Steps { problem, scheme, steps: *steps });
    let mut repeats: Vec<(Repeat, u32)> = Vec::new();
    for scheme in schemes {
        let mut repeat = steps(scheme)?;
        let count = enough(&mut repeat);
        repeats.push((repeat, count));
    }
    let mut times = vec![Vec::new(); schemes.len()];
    for _ in 0..REPEATS {
        for ((repeat, count), times) in repeats.iter_mut().zip(&mut times) {
            times.push(repeat(*count).as_secs_f64() / f64::from(*count));
        }
    }
    Ok(times.into_iter().map(StepTime::of).collect())
}

/// Makes a number of steps, and returns the time that they took.
type Repeat = Box<dyn FnMut(u32) -> Duration>;

/// The number of steps that take long enough to be timed.
fn enough(repeat: &mut Repeat) -> u32 {
    let mut count = 1;
    while repeat(count) < SHORTEST && count < 1 << 30 {
        count *= 2;
    }
    count
}

impl StepTime {
    fn of(mut times: Vec<f64>) -> StepTime {
        times.sort_by(f64::total_cmp);
        StepTime { least: times[0], median: times[times.len() / 2], most: times[times.len() - 1] }
    }
}

/// The steps of a scheme in any number type.
struct Steps<'a> {
    problem: Problem<'a>,
    scheme: &'a NamedScheme,
    steps: u64,
}

impl Computation for Steps<'_> {
    type Output = Result<Repeat, Error>;

    fn compute<N: Rounded + 'static>(self, context: &N::Context) -> Self::Output {
        let Steps { problem, scheme, steps } = self;
        let start = problem.system.start::<N>(context);
        let h = problem.step_size(steps);
        let found = problem.system.with(problem.steps(scheme, &h), start, context, Bare);
        found.map_err(|error| Error::usage(error.to_string(), "check the initial state"))
    }
}

/// Steps and nothing else, from the initial state each time: so all repeats make the same steps.
struct Bare;

impl<N: Ordered + 'static> Work<N> for Bare {
    type Output = Repeat;

    fn with<S, M>(self, stepper: &Stepper<S, N>, mut system: M) -> Repeat
    where
        S: Scheme + Clone + ValidFor<M::Class> + 'static,
        M: System<Number = N> + 'static,
    {
        let (q, p, stepper) = (system.q().to_vec(), system.p().to_vec(), stepper.clone());
        Box::new(move |count| {
            system.state_mut().set(&q, &p);
            let begin = CpuTime::begin();
            stepper.steps(slice::from_mut(&mut system), count.into());
            begin.elapsed()
        })
    }
}
