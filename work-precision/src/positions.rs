//! Positions at the times at which errors are taken: the ends of equal parts of a run.

use num_traits::Signed;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::steps::step_to_time;
use shadowstep::{Integrator as _, Rational, Real};
use shadowstep_scenes::Error;
use shadowstep_scenes::computation::RunNumber;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::SceneIntegrator;

use crate::problem::Problem;

/// Makes the steps of a run from sample to sample.
pub(crate) struct Sampler<N: Real> {
    steps_per_sample: u64,
    in_time: Option<InTime<N>>,
}

/// A run asks after this number of steps whether it is to continue.
pub(crate) const ASKED: u64 = 16;

/// Makes a step, and returns whether the run is to continue.
pub(crate) type Step<'a, N> = &'a mut dyn FnMut(&mut VectorIntegrator<'_, N>) -> bool;

/// Why a run has no position at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ended {
    /// A state is not finite, or its time never comes.
    NotFinite,
    /// It was not to continue.
    Stopped,
}

impl<N: RunNumber> Sampler<N> {
    /// For a run of this number of steps and its samples.
    pub(crate) fn new(
        problem: Problem<'_>,
        named: &NamedScheme,
        (steps, samples): (u64, u64),
        context: &N::Context,
    ) -> Result<Self, Error> {
        let of_time = |length: &Rational| {
            let part = problem.until / Rational::from_integer(samples.into());
            let integrator = problem.integrator(named, steps, context)?;
            let most = MOST_LONGER * (steps + 1);
            Ok::<_, Error>(InTime { part, forward: length.is_positive(), integrator, most, made: 0, before: None })
        };
        let in_time = problem.length.map(of_time).transpose()?;
        Ok(Sampler { steps_per_sample: steps / samples, in_time })
    }

    /// The position at the sample i = 1, 2, …, to which this makes the steps. Samples are asked for in their order.
    pub(crate) fn position(
        &mut self,
        i: u64,
        integrator: &mut VectorIntegrator<'_, N>,
        step: Step<'_, N>,
    ) -> Result<Vec<N>, Ended> {
        let q = match &mut self.in_time {
            Some(in_time) => in_time.position(i, integrator, step)?,
            None => {
                for _ in 0..self.steps_per_sample {
                    if !step(integrator) {
                        return Err(Ended::Stopped);
                    }
                }
                at_output(integrator, |integrator| integrator.state().q().to_vec())
            }
        };
        if q.iter().all(N::is_finite) { Ok(q) } else { Err(Ended::NotFinite) }
    }
}

/// Samples at physical times, where time is transformed: none of them is that of a state, and from the state before each a part of a step is made.
struct InTime<N: Real> {
    /// The time between samples.
    part: Rational,
    forward: bool,
    /// Makes the parts of steps, so that the run is as without samples.
    integrator: SceneIntegrator<N>,
    /// A run that has not come to its end after this number of steps does not come there.
    most: u64,
    made: u64,
    /// The state before the present one.
    before: Option<(Vec<N>, Vec<N>)>,
}

/// A run may make this multiple of the steps that the length of the run in s suggests.
const MOST_LONGER: u64 = 16;

impl<N: RunNumber> InTime<N> {
    /// Without t, which is that of the sample.
    fn position(
        &mut self,
        i: u64,
        integrator: &mut VectorIntegrator<'_, N>,
        step: Step<'_, N>,
    ) -> Result<Vec<N>, Ended> {
        let time = N::from_rational(&(&self.part * Rational::from_integer(i.into())), &integrator.state().context());
        let is_before = |t: &N| if self.forward { *t < time } else { *t > time };
        while is_before(integrator.state().q().last().expect("time is a coordinate")) {
            if self.made > self.most {
                return Err(Ended::NotFinite);
            }
            let state = integrator.state();
            self.before = Some((state.q().to_vec(), state.p().to_vec()));
            self.made += 1;
            if !step(integrator) {
                return Err(Ended::Stopped);
            }
        }
        let Some((q, p)) = &self.before else { return Err(Ended::NotFinite) };
        self.integrator.system().state_mut().set(q, p);
        // none is made where the state before is at this time
        let _ = step_to_time(&mut *self.integrator, &time);
        let (t, q) = self.integrator.state().q().split_last().expect("time is a coordinate");
        if t.is_finite() && integrator.state().q().iter().all(N::is_finite) {
            Ok(q.to_vec())
        } else {
            Err(Ended::NotFinite)
        }
    }
}

/// |a − b|², in the number type of both.
pub(crate) fn square_distance<N: Real>(a: &[N], b: &[N], context: &N::Context) -> N {
    let [mut sum, mut difference] = [N::zero(context), N::zero(context)];
    for (a, b) in a.iter().zip(b) {
        difference.assign_difference(a, b);
        sum.add_product(&difference, &difference);
    }
    sum
}
