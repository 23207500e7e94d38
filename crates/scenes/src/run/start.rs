//! The steps of a run: a system at its first state with its stepper.

use shadowstep::number::CorrectlyRounded;
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::systems::displaced::Displacements;
use shadowstep::systems::kinetic::General;
use shadowstep::systems::many_parts::SystemOfParts;
use shadowstep::systems::summation::Compensated;
use shadowstep::tables::{AtRunTime, TableScheme};
use shadowstep::{Number, Scheme, StepSize, Stepper, System, ValidFor};

/// The steps that are made.
#[derive(Clone, Copy, Debug)]
pub struct Steps<'a> {
    /// The scheme.
    pub scheme: &'a TableScheme<AtRunTime>,
    /// The step size.
    pub h: &'a StepSize,
    /// Whether q and p are sums with remainders.
    pub compensated: bool,
    /// Whether gradient kicks are by displaced forces, which the scheme must allow: see
    /// [`shadowstep::systems::displaced`].
    pub displaced: bool,
    /// At which state they begin.
    pub begin: Begin,
}

/// The state at which steps begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begin {
    /// The initial state: a processed scheme begins with its pre-map.
    InitialState,
    /// A state that the steps of the scheme have made; of a processed scheme, those of the kernel.
    Step,
}

/// A system with its stepper, whatever the kind of split and the scheme: what follows a run is compiled once for each
/// number type.
///
/// For a processed scheme the system is at a state of its kernel: see
/// [`at_output`](shadowstep::steps::integrator::at_output).
pub type SceneIntegrator<N> = Box<VectorIntegrator<'static, N>>;

/// The class of the system was known when the scheme was read.
const READ: &str = "the scheme was read for this system";

impl Steps<'_> {
    /// The scheme for systems with quadratic T.
    pub(crate) fn quadratic(self) -> TableScheme {
        self.scheme.clone().for_quadratic().expect(READ)
    }

    /// The scheme for every T(p).
    pub(crate) fn for_every_kinetic(self) -> TableScheme<General> {
        self.quadratic().for_every_kinetic().expect(READ)
    }

    /// A system of three parts and more at the first state with its stepper.
    pub(crate) fn of_parts<N: Number + 'static>(
        self,
        system: SystemOfParts<N>,
        context: &N::Context,
    ) -> SceneIntegrator<N> {
        let scheme = self.scheme.clone().for_many_parts().expect(READ);
        self.integrator(scheme, system.compensated_if(self.compensated), context)
    }

    /// The displacements of the forces, where gradient kicks are made by them.
    pub(crate) fn displacements<N: CorrectlyRounded>(self, context: &N::Context) -> Option<Displacements<N>> {
        let stepper = self.displaced.then(|| stepper(self.scheme.clone(), self.h, context));
        stepper.map(|stepper| stepper.displacements().expect("the scheme was read for displaced forces"))
    }

    /// A system at the first state with its stepper, by the scheme as it is valid for the system.
    pub(crate) fn integrator<N, S, M>(self, scheme: S, mut system: M, context: &N::Context) -> SceneIntegrator<N>
    where
        N: Number + 'static,
        S: Scheme + ValidFor<M::Class> + 'static,
        M: System<Number = N, Coordinates = Vec<N>, Summation = Option<Compensated<N, Vec<N>>>> + 'static,
    {
        let stepper = stepper(scheme, self.h, context);
        if self.begin == Begin::InitialState {
            stepper.preprocess(&mut system);
        }
        Box::new(stepper.into_integrator(system))
    }
}

fn stepper<S: Scheme, N: Number>(scheme: S, h: &StepSize, context: &N::Context) -> Stepper<S, N> {
    Stepper::with_context(scheme, h, context).expect("the step size was read as nonzero")
}
