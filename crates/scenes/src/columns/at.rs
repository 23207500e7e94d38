//! A state of a run as columns see it: each thing is computed when it is first asked for, and once.

use shadowstep::shadow::Estimate;
use shadowstep::steps::integrator::VectorIntegrator;

use crate::motion::tangent::{FollowingVectors, TangentRun};
use crate::run::Run;
use crate::scene::split::ShownCoordinates;
use crate::scene::{EnergyAt, SceneNumber, System};
use crate::texts::error::Error;

/// What a state of a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The state n.
    State,
    /// A crossing of the surface of section, in the step after the state n.
    Crossing,
    /// At the physical end, a part of a step after the last state.
    PhysicalEnd,
}

/// A state of the trajectory. Where modified energies are estimated the steps are ahead of it.
pub struct At<'s, 'i, N: SceneNumber> {
    /// Its number; of a [`PhysicalEnd`](Place::PhysicalEnd) one more than that of the last state.
    pub n: i64,
    /// What it is.
    pub place: Place,
    /// Whether it is the last state; where a physical time ends the run, that may be known later.
    pub is_last: bool,
    /// Whether a condition ends the run with it: everything that is written of states is written of it.
    pub is_met: bool,
    /// The modified energy, where it is estimated.
    pub estimate: Option<&'s Estimate<'s, N>>,
    /// The run.
    pub run: Run<'s>,
    /// The system.
    pub system: &'s System,
    pub(crate) context: &'s N::Context,
    pub(crate) integrator: &'s mut VectorIntegrator<'i, N>,
    /// q and p where they are not those of the integrator; those of the estimate once they are asked for.
    pub(crate) other: Option<(Vec<N>, Vec<N>)>,
    /// The time of a crossing.
    pub(crate) time: Option<N>,
    pub(crate) energy: Option<N>,
    pub(crate) energy_of: Option<&'s mut EnergyAt<N>>,
    pub(crate) shown: Option<&'s mut ShownCoordinates<N>>,
    pub(crate) vectors: Option<&'s mut FollowingVectors>,
}

impl<N: SceneNumber> At<'_, '_, N> {
    /// q and p in the coordinates of the steps.
    pub fn state(&mut self) -> (&[N], &[N]) {
        self.leave_kernel();
        numbers(&self.other, self.integrator)
    }

    /// The steps of a processed scheme are those of its kernel.
    fn leave_kernel(&mut self) {
        if let (Some(estimate), None) = (self.estimate, &self.other) {
            let [mut q, mut p] = estimate.state().map(|numbers| numbers.cloned().collect::<Vec<_>>());
            self.integrator.postprocess_state(&mut q, &mut p);
            self.other = Some((q, p));
        }
    }

    /// q and p in the coordinates that are shown.
    pub fn shown_state(&mut self) -> (&[N], &[N]) {
        self.leave_kernel();
        let At { shown, other, integrator, .. } = self;
        let (q, p) = numbers(other, *integrator);
        match shown {
            Some(shown) => shown.of_state(q, p),
            None => (q, p),
        }
    }

    /// The physical time.
    pub fn time(&mut self) -> N {
        let (system, run, n, context) = (self.system, self.run, self.n, self.context);
        let of_steps = self.time.clone();
        let physical = system.time_of(self.state().0).cloned();
        physical.or(of_steps).unwrap_or_else(|| run.time_in(n, context))
    }

    /// H.
    ///
    /// # Errors
    /// One that is not finite.
    pub fn energy(&mut self) -> Result<&N, Error> {
        if self.energy.is_none() {
            self.leave_kernel();
            let At { energy_of, other, integrator, .. } = self;
            self.energy = Some(match (energy_of, other) {
                (Some(energy_of), other) => {
                    let (q, p) = numbers(other, *integrator);
                    energy_of(q, p)
                }
                (None, Some((q, p))) => integrator.energy_at(q, p),
                (None, None) => integrator.system().energy(),
            });
        }
        let energy = self.energy.as_ref().expect("it was computed");
        match energy.is_finite() {
            true => Ok(energy),
            false => Err(self.run.not_finite(&format!("the energy at n = {}, {},", self.n, energy.to_text()))),
        }
    }

    /// The growth of tangent vectors up to the state, where there are some.
    pub(crate) fn vectors(&mut self) -> Option<&dyn TangentRun> {
        self.vectors.as_mut().map(|vectors| vectors.end())
    }
}

/// Other q and p, or those of the integrator.
fn numbers<'s, N: SceneNumber>(
    other: &'s Option<(Vec<N>, Vec<N>)>,
    integrator: &'s VectorIntegrator<'_, N>,
) -> (&'s [N], &'s [N]) {
    match other {
        Some((q, p)) => (q, p),
        None => (integrator.state().q(), integrator.state().p()),
    }
}

/// What states are shown in.
pub(crate) struct View<'a, N: SceneNumber> {
    pub(crate) system: &'a System,
    pub(crate) run: Run<'a>,
    pub(crate) context: &'a N::Context,
    /// Converts states, where those of the steps have other coordinates.
    pub(crate) shown: Option<ShownCoordinates<N>>,
    /// H, where the steps conserve another function.
    pub(crate) energy_of: Option<EnergyAt<N>>,
    pub(crate) vectors: Option<FollowingVectors>,
}

impl<'a, N: SceneNumber> View<'a, N> {
    pub(crate) fn new(
        system: &'a System,
        run: Run<'a>,
        context: &'a N::Context,
        vectors: Option<FollowingVectors>,
    ) -> Self {
        View { system, run, context, shown: system.shown(context), energy_of: system.energy_of_rows(context), vectors }
    }

    /// The state of the integrator.
    pub(crate) fn at<'s, 'i>(&'s mut self, n: i64, integrator: &'s mut VectorIntegrator<'i, N>) -> At<'s, 'i, N> {
        let View { system, run, context, shown, energy_of, vectors } = self;
        At {
            n,
            place: Place::State,
            is_last: false,
            is_met: false,
            estimate: None,
            run: *run,
            system,
            context,
            integrator,
            other: None,
            time: None,
            energy: None,
            energy_of: energy_of.as_mut(),
            shown: shown.as_mut(),
            vectors: vectors.as_mut(),
        }
    }
}
