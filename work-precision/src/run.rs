//! One run: the errors of its positions and of H, and its modified energy.

use serde::{Deserialize, Serialize};
use shadowstep::Real;
use shadowstep::shadow::Verdict;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep_scenes::Error;
use shadowstep_scenes::computation::RunNumber;
use shadowstep_scenes::library::NamedScheme;

use crate::positions::{ASKED, Ended, Sampler};
use crate::problem::Problem;
use crate::reference::Reference;
use crate::size::Size;

/// The monitor's estimator is E_8 with its error, in a window of 9 states.
const MONITOR_ORDER: u32 = 8;
/// The monitor has about this number of windows.
const WINDOWS: u64 = 256;

/// What a run with some number of steps has shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// The number of steps.
    pub steps: u64,
    /// Evaluations of the gradient for these steps.
    pub evaluations: u64,
    /// |q − q_ref| at the end.
    pub position: PositionError,
    /// The largest |q − q_ref| at the samples, where it is known.
    pub largest_position: PositionError,
    /// The largest |H(t) − H(0)| at the states, as a part of |H(0)| unless that is 0.
    pub energy: Size,
    /// |H − H(0)| at the end, in the same form.
    pub energy_at_end: Size,
    /// The largest error of the position and of H in the first half of the run.
    pub in_first_half: (PositionError, Size),
    /// The modified energy H̄, in the same form; `None` where the run is too short for an estimate.
    pub modified: Option<Modified>,
    /// The verdict of the monitor on the step size.
    pub verdict: String,
    /// Whether that is bounded or round-off.
    pub fine: bool,
    /// Whether it is undecided.
    pub undecided: bool,
    /// The time at which a state was not finite, as a part of the run: the errors are those until then.
    pub failed: Option<f64>,
}

/// An error of positions as far as the reference resolves it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum PositionError {
    /// It is known.
    Known(Size),
    /// It is not larger than some times the error of the reference: this is a bound.
    Below(Size),
    /// The run has no finite states there.
    None,
}

impl PositionError {
    /// The error, where it is known.
    pub fn known(self) -> Option<Size> {
        match self {
            PositionError::Known(size) => Some(size),
            PositionError::Below(_) | PositionError::None => None,
        }
    }
}

/// The modified energy of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Modified {
    /// max − min of the accurate estimates.
    pub drift: Size,
    /// The newest accurate estimate less the first one.
    pub change: Size,
    /// A permanent change above this is excluded.
    pub bound: Option<Size>,
}

impl Measurement {
    /// Makes a run of this number of steps, with as many evaluations, and measures it; `None` if it was not to continue.
    ///
    /// # Errors
    /// A system that cannot be moved.
    pub(crate) fn of<N: RunNumber>(
        problem: Problem<'_>,
        named: &NamedScheme,
        (steps, evaluations): (u64, u64),
        reference: &Reference,
        continues: &dyn Fn() -> bool,
        context: &N::Context,
    ) -> Result<Option<Measurement>, Error> {
        let mut integrator = problem.integrator::<N>(named, steps, context)?;
        let integrator = &mut *integrator;
        let mut sampler = Sampler::new(problem, named, (steps, reference.samples()), context)?;
        let failed =
            |sample: usize| Measurement::failed(steps, evaluations, sample as f64 / reference.samples() as f64);
        let monitor = N::monitor(integrator, MONITOR_ORDER, (steps / WINDOWS).max(1));
        let Ok(mut monitor) = monitor else { return Ok(Some(failed(0))) };
        let conserved = EnergyError::new(at_output(integrator, |integrator| integrator.system().energy()));
        // where time is transformed, the steps conserve another function
        let mut energy_of = problem.system.energy_of_rows::<N>(context);
        let mut energy_of = |integrator: &mut VectorIntegrator<'_, N>| match &mut energy_of {
            Some(energy_of) => energy_of(integrator.state().q(), integrator.state().p()),
            None => at_output(integrator, |integrator| integrator.system().energy()),
        };
        let mut energy = EnergyError::new(energy_of(integrator));
        let mut made = 0_u64;
        let (mut position, mut largest_position) = (PositionError::None, PositionError::None);
        let mut in_first_half = (PositionError::None, Size::ZERO);
        for (sample, expected) in reference.in_two_parts::<N>(context).iter().enumerate() {
            let mut step = |integrator: &mut VectorIntegrator<'_, N>| {
                // what is not finite stays so, and is seen at the sample
                let _ = monitor.step(integrator);
                energy.include(&energy_of(integrator));
                made += 1;
                !made.is_multiple_of(ASKED) || continues()
            };
            let q = match sampler.position(sample as u64 + 1, integrator, &mut step) {
                Ok(q) => q,
                Err(Ended::Stopped) => return Ok(None),
                Err(Ended::NotFinite) => return Ok(Some(failed(sample))),
            };
            let distance = distance(&q, expected);
            if !distance.is_finite() || !energy.last.is_finite() {
                return Ok(Some(failed(sample)));
            }
            position = PositionError::of(distance, reference.resolved_at(sample));
            largest_position = largest_position.or_larger(position);
            if 2 * (sample as u64 + 1) <= reference.samples() {
                in_first_half = (largest_position, energy.relative(&energy.largest));
            }
        }
        let report = monitor.report();
        let modified = (report.windows > 0).then(|| Modified {
            drift: conserved.relative(&report.range),
            change: conserved.relative(&report.change),
            bound: report.permanent_bound.as_ref().map(|bound| conserved.relative(bound)),
        });
        Ok(Some(Measurement {
            steps,
            evaluations,
            position,
            largest_position,
            energy: energy.relative(&energy.largest),
            energy_at_end: energy.relative(&energy.last),
            in_first_half,
            modified,
            verdict: report.verdict.to_string(),
            fine: report.verdict.is_bounded(),
            undecided: matches!(report.verdict, Verdict::Undecided(_)),
            failed: None,
        }))
    }
}

/// |q − a − b| where a + b is the reference.
fn distance<N: Real>(q: &[N], [a, b]: &[Vec<N>; 2]) -> Size {
    let context = q[0].context();
    let [mut sum, mut difference] = [N::zero(&context), N::zero(&context)];
    for ((q, a), b) in q.iter().zip(a).zip(b) {
        difference.assign_difference(q, a);
        difference.subtract(b);
        sum.add_product(&difference, &difference);
    }
    difference.assign_sqrt(&sum);
    Size::of(&difference)
}

/// |H(t) − H(0)|, the largest and the last one.
struct EnergyError<N> {
    initial: N,
    largest: N,
    last: N,
}

impl<N: Real> EnergyError<N> {
    fn new(initial: N) -> Self {
        let zero = N::zero(&initial.context());
        EnergyError { initial, largest: zero.clone(), last: zero }
    }

    fn include(&mut self, energy: &N) {
        self.last.assign_difference(energy, &self.initial);
        self.last.make_absolute();
        // also where one of them is not a number
        if self.last > self.largest || !self.last.is_finite() {
            self.largest.assign(&self.last);
        }
    }

    /// The size of a difference of energies as a part of |H(0)|, unless that is 0.
    fn relative(&self, difference: &N) -> Size {
        let initial = Size::of(&self.initial).log10();
        let part = if initial.is_finite() { -initial } else { 0.0 };
        Size::of(difference).times_power_of_ten(part)
    }
}

impl PositionError {
    fn of(distance: Size, bound: Size) -> PositionError {
        if distance >= bound { PositionError::Known(distance) } else { PositionError::Below(bound) }
    }

    fn or_larger(self, other: PositionError) -> PositionError {
        let size = |error: PositionError| match error {
            PositionError::Known(size) => size,
            PositionError::Below(_) | PositionError::None => Size::ZERO,
        };
        if matches!(self, PositionError::None) || size(other) > size(self) { other } else { self }
    }
}

impl Measurement {
    fn failed(steps: u64, evaluations: u64, part: f64) -> Measurement {
        let (position, infinite) = (PositionError::None, Size::INFINITE);
        Measurement {
            steps,
            evaluations,
            position,
            largest_position: position,
            energy: infinite,
            energy_at_end: infinite,
            in_first_half: (position, infinite),
            modified: None,
            verdict: "a state is not finite".to_owned(),
            fine: false,
            undecided: false,
            failed: Some(part),
        }
    }
}
