//! A system with the stepper that advances it, whatever the types of the two.

use std::ops::Deref;

use crate::number::Number;
use crate::steps::mismatch::MismatchError;
use crate::steps::scheme::{Scheme, SchemeProperties, ValidFor};
use crate::steps::scheme_maps::Maps;
use crate::steps::step_size::StepSize;
use crate::steps::stepper::Stepper;
use crate::steps::weights::WeightLists;
use crate::systems::coordinates::Coordinates;
use crate::systems::increments::Carried;
use crate::systems::state::{Saved, State};
use crate::systems::summation::{Compensated, Summation};
use crate::systems::system::{AnySystem, System, Visitor};

/// A system with the stepper that advances it: what trajectories and estimates along them are made of.
///
/// [`Stepper::with`] makes one. As a `dyn Integrator` it hides the types of the scheme and of the system, so that what
/// follows a run is compiled once for each number type.
///
/// ```
/// use shadowstep::{Carried, Integrator, Motion, Stepper, UnitMasses, steps::integrator::VectorIntegrator};
/// use shadowstep::{problems::Kepler, problems::Pendulum, tables::shipped};
///
/// fn energy_error(integrator: &mut VectorIntegrator<f64>, steps: u64) -> f64 {
///     let initial = integrator.system().energy();
///     integrator.steps(steps);
///     (integrator.system().energy() - initial).abs()
/// }
///
/// let stepper = Stepper::new(shipped("blanes-moan-srkn6b").unwrap(), "1/10")?;
/// let comet = Motion::new(Kepler, UnitMasses, vec![0.4, 0.0], vec![0.0, 2.0])?;
/// let pendulum = Motion::new(Pendulum, UnitMasses, vec![0.0], vec![1.0])?;
/// assert!(energy_error(&mut stepper.with(comet.compensated_if(false)), 100) < 1e-4);
/// assert!(energy_error(&mut stepper.with(pendulum.compensated_if(true)), 100) < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Integrator {
    /// The type of its numbers.
    type Number: Number;

    /// What holds positions, and momenta.
    type Coordinates: Coordinates<Self::Number>;

    /// How increments are added to q and p.
    type Summation: Summation<Self::Number>;

    /// The state of the system.
    fn state(&self) -> &State<Self::Number, Self::Coordinates, Self::Summation>;

    /// The system, for its energies, and to set its state.
    fn system(&mut self) -> &mut AnySystem<'_, Self::Number, Self::Coordinates, Self::Summation>;

    /// H at a state q, p, which the system need not be at.
    fn energy_at(&mut self, q: &[Self::Number], p: &[Self::Number]) -> Self::Number {
        let mut energy = self.state().increments.beta.clone();
        self.system().assign_energy(Some((q, p)), &mut energy);
        energy
    }

    /// Name and proved properties of the scheme.
    fn scheme(&self) -> SchemeProperties<'_>;

    /// The step size h.
    fn step_size(&self) -> &StepSize;

    /// Checks that the steps suit the system.
    ///
    /// # Errors
    /// Weights of another precision than the state; gradient kicks that the system has not.
    fn check(&self) -> Result<(), MismatchError>;

    /// One step: t → t + h. It clears the increments first, if these are carried along.
    fn step(&mut self, carried: Carried);

    /// The exact inverse of [`step`](Integrator::step), up to round-off: t → t − h.
    fn step_back(&mut self, carried: Carried);

    /// `count` plain steps: see [`Stepper::steps`].
    fn steps(&mut self, count: u64);

    /// `count` plain steps, of which the visitor sees the states: see [`Stepper::steps_visited`].
    fn steps_visited(&mut self, count: u64, visitor: &mut dyn Visitor<Self::Number>);

    /// One plain step of the size part·h from a state of the trajectory to another one: of a processed scheme the
    /// pre-map, the kernel and the post-map, all of part·h. The weights are those of the stepper times the part (its
    /// third power those of gradient kicks), each rounded once more.
    fn part_of_step(&mut self, part: &Self::Number);

    /// Whether the scheme is a processed one, whose steps are those of its kernel.
    fn is_processed(&self) -> bool;

    /// The pre-map of a processed scheme: see [`Stepper::preprocess`].
    fn preprocess(&mut self);

    /// The post-map of a processed scheme: see [`Stepper::postprocess`].
    fn postprocess(&mut self);

    /// The state of the trajectory that belongs to a state q, p of the kernel, which the system need not be at: q and p
    /// become it.
    fn postprocess_state(&mut self, q: &mut [Self::Number], p: &mut [Self::Number]) {
        if !self.is_processed() {
            return;
        }
        let saved = Saved::of(self.state());
        self.system().state_mut().set(q, p);
        self.postprocess();
        q.iter_mut().zip(self.state().q()).for_each(|(own, q)| own.assign(q));
        p.iter_mut().zip(self.state().p()).for_each(|(own, p)| own.assign(p));
        saved.restore(self.system().state_mut());
    }
}

/// An integrator of any scheme and system in vectors, whose sums are plain or compensated.
pub type VectorIntegrator<'a, N> =
    dyn Integrator<Number = N, Coordinates = Vec<N>, Summation = Option<Compensated<N, Vec<N>>>> + 'a;

/// Reads the system at the state of the trajectory that belongs to the present one of the kernel: see
/// [`Stepper::at_output`].
pub fn at_output<I: Integrator + ?Sized, R>(integrator: &mut I, read: impl FnOnce(&mut I) -> R) -> R {
    if !integrator.is_processed() {
        return read(integrator);
    }
    let saved = Saved::of(integrator.state());
    integrator.postprocess();
    let found = read(integrator);
    saved.restore(integrator.system().state_mut());
    found
}

/// A system with a stepper that is valid for it: [`Stepper::with`] makes it.
#[derive(Debug)]
pub struct WithStepper<'s, S: Scheme, M: System> {
    stepper: Held<'s, Stepper<S, M::Number>>,
    system: M,
}

impl<S: Scheme, N: Number> Stepper<S, N> {
    /// The system with this stepper, as trajectories and estimates along them take it.
    pub fn with<M: System<Number = N>>(&self, system: M) -> WithStepper<'_, S, M>
    where
        S: ValidFor<M::Class>,
    {
        WithStepper { stepper: Held::Borrowed(self), system }
    }

    /// The same for a stepper that is used for this system only.
    pub fn into_integrator<M: System<Number = N>>(self, system: M) -> WithStepper<'static, S, M>
    where
        S: ValidFor<M::Class>,
    {
        WithStepper { stepper: Held::Owned(Box::new(self)), system }
    }
}

/// Borrowed or owned.
#[derive(Debug)]
enum Held<'s, T> {
    Borrowed(&'s T),
    Owned(Box<T>),
}

impl<T> Deref for Held<'_, T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        match self {
            Held::Borrowed(held) => held,
            Held::Owned(held) => held,
        }
    }
}

impl<S: Scheme, M: System> WithStepper<'_, S, M> {
    /// The system at its present state.
    pub fn into_system(self) -> M {
        self.system
    }
}

impl<S: Scheme + ValidFor<M::Class>, M: System> Integrator for WithStepper<'_, S, M> {
    type Number = M::Number;
    type Coordinates = M::Coordinates;
    type Summation = M::Summation;

    #[inline(always)]
    fn state(&self) -> &State<M::Number, M::Coordinates, M::Summation> {
        self.system.state()
    }

    #[inline(always)]
    fn system(&mut self) -> &mut AnySystem<'_, M::Number, M::Coordinates, M::Summation> {
        &mut self.system
    }

    fn scheme(&self) -> SchemeProperties<'_> {
        self.stepper.scheme().summary()
    }

    fn step_size(&self) -> &StepSize {
        self.stepper.step_size()
    }

    fn check(&self) -> Result<(), MismatchError> {
        self.stepper.check(&self.system)
    }

    #[inline]
    fn step(&mut self, carried: Carried) {
        self.stepper.step_carrying(&mut self.system, carried);
    }

    #[inline]
    fn step_back(&mut self, carried: Carried) {
        self.stepper.step_back_carrying(&mut self.system, carried);
    }

    fn steps(&mut self, count: u64) {
        self.stepper.steps(std::slice::from_mut(&mut self.system), count);
    }

    fn steps_visited(&mut self, count: u64, visitor: &mut dyn Visitor<M::Number>) {
        self.stepper.steps_visited(&mut self.system, count, visitor);
    }

    fn part_of_step(&mut self, part: &M::Number) {
        let times = |weight: &M::Number, factor: &M::Number| {
            let mut product = weight.clone();
            product.assign_product(weight, factor);
            product
        };
        let linear = |weight: &M::Number| times(weight, part);
        // h³
        let cubic = |weight: &M::Number| times(&times(&times(weight, part), part), part);
        let weights = S::Weights::from_vecs(self.stepper.weights().map(linear, cubic));
        let maps = Maps::new(self.stepper.scheme(), &weights);
        let processor = self.stepper.processor().of_part(part);
        processor.preprocess(&mut self.system);
        M::advance(std::slice::from_mut(&mut self.system), &maps, 1, Carried::Nothing);
        processor.postprocess(&mut self.system);
    }

    fn is_processed(&self) -> bool {
        self.stepper.is_processed()
    }

    fn preprocess(&mut self) {
        self.stepper.preprocess(&mut self.system);
    }

    fn postprocess(&mut self) {
        self.stepper.postprocess(&mut self.system);
    }
}

/// Of an integrator behind a pointer.
macro_rules! behind {
    ($($pointer:ty),*) => {$(
        impl<I: Integrator + ?Sized> Integrator for $pointer {
            type Number = I::Number;
            type Coordinates = I::Coordinates;
            type Summation = I::Summation;

            fn state(&self) -> &State<I::Number, I::Coordinates, I::Summation> {
                (**self).state()
            }
            fn system(&mut self) -> &mut AnySystem<'_, I::Number, I::Coordinates, I::Summation> {
                (**self).system()
            }
            fn scheme(&self) -> SchemeProperties<'_> {
                (**self).scheme()
            }
            fn step_size(&self) -> &StepSize {
                (**self).step_size()
            }
            fn check(&self) -> Result<(), MismatchError> {
                (**self).check()
            }
            fn step(&mut self, carried: Carried) {
                (**self).step(carried);
            }
            fn step_back(&mut self, carried: Carried) {
                (**self).step_back(carried);
            }
            fn steps(&mut self, count: u64) {
                (**self).steps(count);
            }
            fn steps_visited(&mut self, count: u64, visitor: &mut dyn Visitor<I::Number>) {
                (**self).steps_visited(count, visitor);
            }
            fn part_of_step(&mut self, part: &I::Number) {
                (**self).part_of_step(part);
            }
            fn is_processed(&self) -> bool {
                (**self).is_processed()
            }
            fn preprocess(&mut self) {
                (**self).preprocess();
            }
            fn postprocess(&mut self) {
                (**self).postprocess();
            }
        }
    )*};
}

// used afterwards, and owned
behind!(&mut I, Box<I>);
