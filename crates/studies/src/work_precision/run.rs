//! One run: the errors of its positions and of H, and its modified energy.

use serde::{Deserialize, Serialize};
use shadowstep::Real;
use shadowstep::shadow::Verdict;
use shadowstep::shadow::run::RunError;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep_scenes::column::Column;
use shadowstep_scenes::computation::{RunMonitor, RunNumber};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::run::Run;
use shadowstep_scenes::{EnergyAt, Error};

use crate::work_precision::positions::{Asking, Positions};
use crate::work_precision::problem::Problem;
use crate::work_precision::reference::Reference;
use crate::work_precision::size::Size;

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
    /// Makes a run of this number of steps, with as many evaluations, and measures it; `None` if it was not to
    /// continue.
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
        let h = problem.h(steps);
        let mut measuring = Measuring {
            reference,
            expected: reference.in_two_parts(context),
            positions: Positions::new(problem, named, (steps, reference.samples()), context)?,
            every: (steps / WINDOWS).max(1),
            // where time is transformed, the steps conserve another function
            energy_of: problem.system.energy_of_rows::<N>(context),
            begun: None,
        };
        let posed = problem.posed(named, (&h, steps));
        match N::follow(&posed, context, &mut [&mut measuring], &mut Asking::new(continues)) {
            Ok(followed) if followed.is_stopped => Ok(None),
            // it has no more states that are finite
            Ok(_) | Err(Error::Run { .. }) => Ok(Some(measuring.measurement(steps, evaluations))),
            Err(error) => Err(error),
        }
    }
}

/// Measures a run.
struct Measuring<'a, N: RunNumber> {
    reference: &'a Reference,
    /// The positions of the reference, in two parts.
    expected: Vec<[Vec<N>; 2]>,
    positions: Positions<N>,
    /// Steps between windows of the monitor.
    every: u64,
    energy_of: Option<EnergyAt<N>>,
    begun: Option<Begun<N>>,
}

/// What has been measured so far.
struct Begun<N: RunNumber> {
    monitor: Box<RunMonitor<N>>,
    /// H(0) of the function that the steps conserve.
    conserved: EnergyError<N>,
    energy: EnergyError<N>,
    /// The number of samples that were compared, and their errors.
    compared: usize,
    position: PositionError,
    largest_position: PositionError,
    in_first_half: (PositionError, Size),
}

impl<N: RunNumber> Measuring<'_, N> {
    fn begin(&self, integrator: &mut VectorIntegrator<'_, N>, energy: N) -> Result<Begun<N>, RunError> {
        Ok(Begun {
            monitor: N::monitor(integrator, MONITOR_ORDER, self.every)?,
            conserved: EnergyError::new(at_output(integrator, |integrator| integrator.system().energy())),
            energy: EnergyError::new(energy),
            compared: 0,
            position: PositionError::None,
            largest_position: PositionError::None,
            in_first_half: (PositionError::None, Size::ZERO),
        })
    }

    fn measurement(self, steps: u64, evaluations: u64) -> Measurement {
        let samples = self.reference.samples();
        let begun = match self.begun {
            Some(begun) if begun.compared as u64 == samples => begun,
            begun => {
                let compared = begun.map_or(0, |begun| begun.compared);
                return Measurement::failed(steps, evaluations, compared as f64 / samples as f64);
            }
        };
        let Begun { monitor, conserved, energy, position, largest_position, in_first_half, .. } = begun;
        let report = N::report(&monitor);
        let modified = (report.windows > 0).then(|| Modified {
            drift: conserved.relative(&report.range),
            change: conserved.relative(&report.change),
            bound: report.permanent_bound.as_ref().map(|bound| conserved.relative(bound)),
        });
        Measurement {
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
        }
    }
}

impl<N: RunNumber> Begun<N> {
    /// Takes the positions of the samples that are new; `None` where one of them, or H, is not finite.
    fn compare(&mut self, found: &[Vec<N>], expected: &[[Vec<N>; 2]], reference: &Reference) -> Option<()> {
        for (q, expected) in found.iter().zip(expected).skip(self.compared) {
            let distance = distance(q, expected);
            if !distance.is_finite() || !self.energy.last.is_finite() {
                return None;
            }
            self.position = PositionError::of(distance, reference.resolved_at(self.compared));
            self.largest_position = self.largest_position.or_larger(self.position);
            self.compared += 1;
            if 2 * self.compared as u64 <= reference.samples() {
                self.in_first_half = (self.largest_position, self.energy.relative(&self.energy.largest));
            }
        }
        Some(())
    }
}

impl<N: RunNumber> Column<N> for Measuring<'_, N> {
    fn sees_each(&self) -> bool {
        true
    }

    fn needs_increments(&self) -> bool {
        self.begun.as_ref().is_some_and(|begun| begun.monitor.needs_increments())
    }

    fn see(&mut self, n: i64, run: Run<'_>, integrator: &mut VectorIntegrator<'_, N>) -> bool {
        let energy = match &mut self.energy_of {
            Some(energy_of) => energy_of(integrator.state().q(), integrator.state().p()),
            None => at_output(integrator, |integrator| integrator.system().energy()),
        };
        let Some(begun) = &mut self.begun else {
            self.begun = self.begin(integrator, energy).ok();
            self.positions.see(n, run, integrator);
            return self.begun.is_none();
        };
        // what is not finite stays so, and is seen at the sample
        let _ = N::observe(&mut begun.monitor, integrator);
        begun.energy.include(&energy);
        let ends = self.positions.see(n, run, integrator);
        begun.compare(&self.positions.found, &self.expected, self.reference).is_none() || ends
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
