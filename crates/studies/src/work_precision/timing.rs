//! The time of a step: the bare steps, all schemes by turns, the median of several repeats.

use std::time::Duration;

use serde::{Deserialize, Serialize};
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::cpu_time::CpuTime;
use shadowstep_scenes::library::NamedScheme;

use crate::Error;
use crate::work_precision::problem::Problem;

/// Repeats of each scheme.
const REPEATS: usize = 9;
/// A repeat takes so long at least, where there is time.
pub(crate) const SHORTEST: Duration = Duration::from_millis(4);

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

/// The time of a step of each scheme, with a number of steps to the end, from repeats that take at least the shortest
/// time.
pub(crate) fn time_of_steps(
    problem: Problem<'_>,
    schemes: &[(&NamedScheme, u64)],
    shortest: Duration,
) -> Result<Vec<StepTime>, Error> {
    let steps =
        |(scheme, steps): &(&NamedScheme, u64)| problem.arithmetic.compute(Steps { problem, scheme, steps: *steps });
    let mut repeats: Vec<(Repeat, u32)> = Vec::new();
    for scheme in schemes {
        let mut repeat = steps(scheme)?;
        let count = enough(&mut repeat, shortest);
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
fn enough(repeat: &mut Repeat, shortest: Duration) -> u32 {
    let mut count = 1;
    while repeat(count) < shortest && count < 1 << 30 {
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

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let Steps { problem, scheme, steps } = self;
        let mut integrator = problem.integrator::<N>(scheme, steps, context)?;
        let (q, p) = (integrator.state().q().to_vec(), integrator.state().p().to_vec());
        // steps and nothing else, from the initial state each time: so all repeats make the same steps
        Ok(Box::new(move |count| {
            integrator.system().state_mut().set(&q, &p);
            let begin = CpuTime::begin();
            integrator.steps(count.into());
            begin.elapsed()
        }))
    }
}
