//! Positions at the times at which errors are taken: the ends of equal parts of a run.

use num_traits::Signed;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::steps::step_to_time;
use shadowstep::{Integrator as _, Rational, Real};
use shadowstep_scenes::at::At;
use shadowstep_scenes::column::{Column, next_multiple};
use shadowstep_scenes::computation::RunNumber;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::run::Run;
use shadowstep_scenes::start::SceneIntegrator;
use shadowstep_scenes::{Error, Observer};

use crate::work_precision::problem::Problem;

/// Keeps the positions of a run at its samples, in their order; fewer where they are not finite.
pub(crate) struct Positions<N: Real> {
    samples: usize,
    /// Steps between samples.
    every: u64,
    /// Where time is transformed.
    in_time: Option<InTime<N>>,
    pub(crate) found: Vec<Vec<N>>,
}

impl<N: RunNumber> Positions<N> {
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
            let (forward, next) = (length.is_positive(), N::from_rational(&part, context));
            Ok::<_, Error>(InTime { part, forward, integrator, before: None, next })
        };
        let in_time = problem.length.map(of_time).transpose()?;
        Ok(Positions { samples: samples as usize, every: steps / samples, in_time, found: Vec::new() })
    }

    pub(crate) fn are_complete(&self) -> bool {
        self.found.len() == self.samples
    }

    fn is_sample(&self, n: i64) -> bool {
        self.in_time.is_none() && n > 0 && n.unsigned_abs().is_multiple_of(self.every)
    }
}

impl<N: RunNumber> Column<N> for Positions<N> {
    fn next(&self, n: i64) -> i64 {
        if self.in_time.is_none() { next_multiple(n, self.every) } else { i64::MAX }
    }

    fn take(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        if self.is_sample(at.n) {
            self.found.push(at.state().0.to_vec());
        }
        Ok(())
    }

    fn sees_each(&self) -> bool {
        self.in_time.is_some()
    }

    /// Keeps also the positions of samples at states, for a column that sees each state.
    fn see(&mut self, n: i64, _: Run<'_>, integrator: &mut VectorIntegrator<'_, N>) -> bool {
        if self.is_sample(n) {
            self.found.push(at_output(integrator, |integrator| integrator.state().q().to_vec()));
        }
        let Some(in_time) = &mut self.in_time else { return false };
        in_time.see(integrator, (&mut self.found, self.samples)).is_none() || self.are_complete()
    }
}

/// Samples at physical times, where time is transformed: none of them is that of a state, and from the state before
/// each a part of a step is made.
struct InTime<N: Real> {
    /// The time between samples.
    part: Rational,
    forward: bool,
    /// Makes the parts of steps, so that the run is as without samples.
    integrator: SceneIntegrator<N>,
    /// The state before the present one.
    before: Option<(Vec<N>, Vec<N>)>,
    /// The time of the next sample.
    next: N,
}

impl<N: RunNumber> InTime<N> {
    /// Keeps the positions, without t, of the samples between the state before and the present one; `None` where there
    /// is none.
    fn see(&mut self, present: &VectorIntegrator<'_, N>, (found, samples): (&mut Vec<Vec<N>>, usize)) -> Option<()> {
        let (q, p) = (present.state().q(), present.state().p());
        while found.len() < samples {
            let t = q.last().expect("time is a coordinate");
            if if self.forward { *t < self.next } else { *t > self.next } {
                break;
            }
            let (q, p) = self.before.as_ref()?;
            self.integrator.system().state_mut().set(q, p);
            // none is made where the state before is at this time
            let _ = step_to_time(&mut *self.integrator, &self.next);
            let (t, q) = self.integrator.state().q().split_last()?;
            if !(t.is_finite() && q.iter().all(N::is_finite)) {
                return None;
            }
            found.push(q.to_vec());
            let time = &self.part * Rational::from_integer((found.len() + 1).into());
            self.next = N::from_rational(&time, &present.state().context());
        }
        self.before = Some((q.to_vec(), p.to_vec()));
        Some(())
    }
}

/// Asks now and then whether a run is to continue.
pub(crate) struct Asking<'a> {
    continues: &'a dyn Fn() -> bool,
    asked: u64,
}

impl<'a> Asking<'a> {
    pub(crate) fn new(continues: &'a dyn Fn() -> bool) -> Self {
        Asking { continues, asked: 0 }
    }
}

impl Observer for Asking<'_> {
    fn stops(&mut self) -> bool {
        /// After this number of states that a run shows.
        const ASKED: u64 = 16;
        self.asked += 1;
        self.asked.is_multiple_of(ASKED) && !(self.continues)()
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
