//! Systems in the number types of scenes. They are compiled in this crate, once for each, and not again in every crate
//! that uses them.

use shadowstep::number::{AnyLimbs, CorrectlyRounded, Dual};
use shadowstep::problems::CubicSpring;
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
    /// A state in the coordinates of the steps, from positions and momenta in those of the scene.
    fn start_at(system: &System, state: State<Self>, context: &Self::Context) -> State<Self>;

    /// [`System::shown`]
    fn shown(system: &System, context: &Self::Context) -> Option<ShownCoordinates<Self>>;

    /// [`System::energy`]
    fn energy(system: &System, context: &Self::Context) -> EnergyAt<Self>;

    /// −qᵀU_q of bodies with mass, in a periodic box of the nearest images, for one of the system's potentials.
    fn virial(system: &System, potential: &PotentialEnergy, context: &Self::Context) -> OfPositions<Self>;

    /// [`System::integrator`]
    ///
    /// # Errors
    /// As there.
    fn integrator(
        system: &System,
        steps: Steps<'_>,
        state: State<Self>,
        context: &Self::Context,
    ) -> Result<SceneIntegrator<Self>, MotionError>;
}

impl System {
    /// Positions and momenta at t = 0, in the coordinates of the steps.
    pub fn start<N: SceneNumber>(&self, context: &N::Context) -> State<N> {
        N::start_at(self, self.initial(context), context)
    }

    /// Converts states from the coordinates of the steps to those that are shown, where these differ.
    pub fn shown<N: SceneNumber>(&self, context: &N::Context) -> Option<ShownCoordinates<N>> {
        N::shown(self, context)
    }

    /// H of any state, in the coordinates of the steps; where time is transformed, of its q and p.
    ///
    /// # Panics
    /// If q, p and U have different dimensions, which reading a system excludes.
    pub fn energy<N: SceneNumber>(&self, context: &N::Context) -> EnergyAt<N> {
        N::energy(self, context)
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
        N::integrator(self, steps, state, context)
    }
}

fn virial<N: SceneNumber>(system: &System, potential: &PotentialEnergy, context: &N::Context) -> OfPositions<N> {
    if let Some(in_box) = potential.pairs().and_then(|pairs| pairs.virial_in_box(&system.parameters, context)) {
        return in_box;
    }
    let massive = system.massive_coordinates().min(system.coordinates_of_columns());
    let mut potential = system.in_numbers::<N>(potential, context);
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

/// The chain of the problem fput-alpha, of as many bodies as the state has, with its stepper.
///
/// # Errors
/// No bodies, or not as many momenta.
///
/// # Panics
/// As [`System::integrator`].
pub(crate) fn springs<N: SceneNumber>(
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

// not inlined: callers in other crates would compile what is called once more
macro_rules! scene_numbers {
    ($($number:ty),*) => {$(
        impl SceneNumber for $number {
            #[inline(never)]
            fn start_at(system: &System, state: State<Self>, context: &Self::Context) -> State<Self> {
                ask!(&system.parts, split => split.start(&system.problem, state, context))
            }

            #[inline(never)]
            fn shown(system: &System, context: &Self::Context) -> Option<ShownCoordinates<Self>> {
                ask!(&system.parts, split => split.shown(&system.problem, context))
            }

            #[inline(never)]
            fn energy(system: &System, context: &Self::Context) -> EnergyAt<Self> {
                ask!(&system.parts, split => split.energy(&system.problem, context))
            }

            #[inline(never)]
            fn virial(system: &System, potential: &PotentialEnergy, context: &Self::Context) -> OfPositions<Self> {
                virial(system, potential, context)
            }

            #[inline(never)]
            fn integrator(
                system: &System,
                steps: Steps<'_>,
                state: State<Self>,
                context: &Self::Context,
            ) -> Result<SceneIntegrator<Self>, MotionError> {
                ask!(&system.parts, split => split.integrator(&system.problem, steps, state, context))
            }
        }
    )*};
}

number_types!(scene_numbers);

// with a tangent vector: other numbers are followed with those of limbs
scene_numbers!(Dual<f64>, Dual<AnyLimbs>);
