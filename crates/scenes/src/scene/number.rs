//! Systems in the number types of scenes. They are compiled in this crate, once for each, and not again in every crate
//! that uses them.

use shadowstep::number::{AnyLimbs, CorrectlyRounded, Dual};
use shadowstep::problems::{CubicSpring, ProblemMotion, Setup};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::pairs::{Ends, Pairs};
use shadowstep::{Kinetic, Motion, MotionError, Potential, Rational, UnitMasses};

use super::pairs::OfPositions;
use super::problem::{EnergyAt, PotentialEnergy};
use super::system::{Parts, System, ask};
use crate::run::arithmetic::number_types;
use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::split::{ShownCoordinates, Split as _, State};

/// A number type in which systems are computed.
pub trait SceneNumber: CorrectlyRounded + 'static {
    /// A system in these numbers.
    fn system(system: &System) -> &dyn SystemIn<Self>;

    /// The motion of a shipped problem.
    ///
    /// # Errors
    /// As [`Setup::motion`].
    fn motion(setup: &Setup, context: &Self::Context) -> Result<ProblemMotion<Self>, MotionError>;

    /// The chain of the problem fput-alpha, of as many bodies as the state has, with its stepper.
    ///
    /// # Errors
    /// No bodies, or not as many momenta.
    ///
    /// # Panics
    /// As [`System::integrator`].
    fn springs(
        alpha: &Rational,
        steps: Steps<'_>,
        state: State<Self>,
        context: &Self::Context,
    ) -> Result<SceneIntegrator<Self>, MotionError>;
}

/// What a system gives in numbers N.
pub trait SystemIn<N: SceneNumber> {
    /// [`System::start_at`]
    fn start_at(&self, state: State<N>, context: &N::Context) -> State<N>;

    /// [`System::shown`]
    fn shown(&self, context: &N::Context) -> Option<ShownCoordinates<N>>;

    /// [`System::energy`]
    fn energy(&self, context: &N::Context) -> EnergyAt<N>;

    /// −qᵀU_q of bodies with mass, in a periodic box of the nearest images, for one of the system's potentials.
    fn virial(&self, potential: &PotentialEnergy, context: &N::Context) -> OfPositions<N>;

    /// [`System::integrator`]
    ///
    /// # Errors
    /// As there.
    fn integrator(
        &self,
        steps: Steps<'_>,
        state: State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError>;
}

impl System {
    /// Positions and momenta at t = 0, in the coordinates of the steps.
    pub fn start<N: SceneNumber>(&self, context: &N::Context) -> State<N> {
        self.start_at(self.initial(context), context)
    }

    /// The same from positions and momenta in the coordinates of the scene.
    pub fn start_at<N: SceneNumber>(&self, state: State<N>, context: &N::Context) -> State<N> {
        N::system(self).start_at(state, context)
    }

    /// Converts states from the coordinates of the steps to those that are shown, where these differ.
    pub fn shown<N: SceneNumber>(&self, context: &N::Context) -> Option<ShownCoordinates<N>> {
        N::system(self).shown(context)
    }

    /// H of any state, in the coordinates of the steps; where time is transformed, of its q and p.
    ///
    /// # Panics
    /// If q, p and U have different dimensions, which reading a system excludes.
    pub fn energy<N: SceneNumber>(&self, context: &N::Context) -> EnergyAt<N> {
        N::system(self).energy(context)
    }

    /// H for rows, where the steps conserve another function.
    pub fn energy_of_rows<N: SceneNumber>(&self, context: &N::Context) -> Option<EnergyAt<N>> {
        self.transformed_time().map(|_| self.energy(context))
    }

    /// The system at a state with its stepper, whose scheme is valid for it.
    ///
    /// # Errors
    /// A state of another dimension.
    ///
    /// # Panics
    /// If the step size is 0, the scheme is not valid for the parts or has gradient kicks that cannot be displaced as
    /// wanted, which reading a system and its scheme excludes.
    pub fn integrator<N: SceneNumber>(
        &self,
        steps: Steps<'_>,
        state: State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        N::system(self).integrator(steps, state, context)
    }
}

impl<N: SceneNumber> SystemIn<N> for System {
    fn start_at(&self, state: State<N>, context: &N::Context) -> State<N> {
        ask!(&self.parts, split => split.start(&self.problem, state, context))
    }

    fn shown(&self, context: &N::Context) -> Option<ShownCoordinates<N>> {
        ask!(&self.parts, split => split.shown(&self.problem, context))
    }

    fn energy(&self, context: &N::Context) -> EnergyAt<N> {
        ask!(&self.parts, split => split.energy(&self.problem, context))
    }

    fn virial(&self, potential: &PotentialEnergy, context: &N::Context) -> OfPositions<N> {
        if let Some(in_box) = potential.pairs().and_then(|pairs| pairs.virial_in_box(&self.parameters, context)) {
            return in_box;
        }
        let massive = self.massive_coordinates().min(self.coordinates_of_columns());
        let mut potential = self.in_numbers::<N>(potential, context);
        let zero = N::zero(context);
        let mut scratch = vec![zero.clone(); potential.scratch()];
        potential.prepare(&mut scratch, context);
        let mut gradient = vec![zero.clone(); potential.dimension()];
        Box::new(move |q| {
            let q = &q[..gradient.len()];
            potential.update(q);
            potential.gradient(q, &mut gradient, &mut scratch);
            let mut virial = zero.clone();
            q[..massive].iter().zip(&gradient).for_each(|(q, slope)| virial.subtract_product(q, slope));
            virial
        })
    }

    fn integrator(
        &self,
        steps: Steps<'_>,
        state: State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        ask!(&self.parts, split => split.integrator(&self.problem, steps, state, context))
    }
}

fn springs<N: SceneNumber>(
    alpha: &Rational,
    steps: Steps<'_>,
    (q, p): State<N>,
    context: &N::Context,
) -> Result<SceneIntegrator<N>, MotionError> {
    if q.is_empty() {
        return Err(MotionError::NoCoordinates);
    }
    let spring = CubicSpring { alpha: N::from_rational(alpha, context) };
    let chain = Pairs::<_, 1>::neighbours(q.len(), spring, Ends::Fixed).expect("the pairs fit");
    // in the types of shipped problems, which are compiled anyway
    let potential: Box<dyn Potential<N>> = Box::new(chain);
    let kinetic: Box<dyn Kinetic<N, Class = Quadratic>> = Box::new(UnitMasses);
    let motion = Motion::of_any_energy(potential, kinetic, q, p)?.compensated_if(steps.compensated);
    Ok(steps.integrator(steps.quadratic(), motion, context))
}

// not inlined: callers in other crates would compile what is called, and the methods of a `dyn`, once more
macro_rules! scene_numbers {
    ($($number:ty),*) => {$(
        impl SceneNumber for $number {
            #[inline(never)]
            fn system(system: &System) -> &dyn SystemIn<Self> {
                system
            }

            #[inline(never)]
            fn motion(setup: &Setup, context: &Self::Context) -> Result<ProblemMotion<Self>, MotionError> {
                setup.motion(context)
            }

            #[inline(never)]
            fn springs(
                alpha: &Rational,
                steps: Steps<'_>,
                state: State<Self>,
                context: &Self::Context,
            ) -> Result<SceneIntegrator<Self>, MotionError> {
                springs(alpha, steps, state, context)
            }
        }
    )*};
}

number_types!(scene_numbers);

// with a tangent vector: other numbers are followed with those of limbs
scene_numbers!(Dual<f64>, Dual<AnyLimbs>);
