//! A scheme with a step size: the object that makes steps.

use crate::Rational;
use crate::maps::Maps;
use crate::number::Number;
use crate::scheme::{Scheme, StepWeights, ValidFor};
use crate::step_size::{StepSize, StepSizeError};
use crate::system::System;

/// A scheme, its step size h and its weights h·a_s, h·b_s and 2h³·c_s of gradient kicks, each an exact product rounded once to the number
/// type.
///
/// Loops, runs and the [monitor](crate::shadow::ShadowEnergy) take a stepper, so that the scheme and the step size of the
/// weights are always those of the steps.
///
/// ```
/// use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, splitting_scheme};
///
/// #[splitting_scheme("yoshida4.toml")]
/// pub struct Yoshida4;
///
/// let stepper = Stepper::new(Yoshida4, "1/20")?; // or 0.05: see StepSize
/// let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?;
/// for _ in 0..1000 {
///     stepper.step(&mut motion);
/// }
/// for _ in 0..1000 {
///     stepper.step_back(&mut motion);
/// }
/// assert!((motion.q()[0] - 0.4).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Stepper<S: Scheme, N: Number> {
    scheme: S,
    h: StepSize,
    weights: StepWeights<S::Array<N>>,
}

impl<S: Scheme, N: Number> Stepper<S, N> {
    /// A stepper for numbers without a context, such as `f64`.
    ///
    /// # Errors
    /// A step size that is 0, not finite, or a text without an exact value.
    pub fn new<H>(scheme: S, h: H) -> Result<Self, StepSizeError>
    where
        N: Number<Context = ()>,
        H: TryInto<StepSize>,
        StepSizeError: From<H::Error>,
    {
        Self::with_context(scheme, h, &())
    }

    /// A stepper for numbers with a context, such as the precision of MPFR's.
    ///
    /// # Errors
    /// As [`Stepper::new`].
    pub fn with_context<H>(scheme: S, h: H, context: &N::Context) -> Result<Self, StepSizeError>
    where
        H: TryInto<StepSize>,
        StepSizeError: From<H::Error>,
    {
        let h = h.try_into()?;
        Ok(Stepper { weights: StepWeights::of(&scheme, h.exact(), context), scheme, h })
    }

    /// The scheme.
    pub fn scheme(&self) -> &S {
        &self.scheme
    }

    /// The step size h.
    pub fn step_size(&self) -> &StepSize {
        &self.h
    }

    /// The exact value of h.
    pub fn h(&self) -> &Rational {
        self.h.exact()
    }

    /// h·a_s, h·b_s and 2h³·c_s of gradient kicks, the distinct ones in the order of the plan.
    pub fn weights(&self) -> &[N] {
        self.weights.forward().as_ref()
    }

    /// The weights of the inverse step, the negatives of these.
    pub fn weights_back(&self) -> &[N] {
        self.weights.back().as_ref()
    }

    /// The maps of a step with their weights.
    fn maps(&self) -> Maps<'_, N> {
        Maps::new(self.weights(), self.scheme.maps(), self.scheme.gradient_kicks())
    }

    /// One step: t → t + h.
    #[inline]
    pub fn step<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        self.scheme.step(&self.weights, system);
    }

    /// `count` steps of each of several systems, with the bits that [`Stepper::step`] gives.
    ///
    /// Of [lanes](crate::number::Lanes) this is one loop in the widest vector instructions that the processor has; see
    /// [`instructions`](crate::instructions). The systems take turns at each kick and drift, so that operations of one need not wait
    /// for the results of another: four systems of 16 lanes are good, or one of many coordinates. [`Fused`](crate::number::Fused) numbers
    /// need it for the instructions of their products. Of other numbers it is no faster than a loop of steps.
    pub fn steps<M: System<Number = N>>(&self, systems: &mut [M], count: u64)
    where
        S: ValidFor<M::Class>,
    {
        M::advance(systems, self.maps(), count);
    }

    /// One step of each of several systems with its [increments](System::increments) of q, p and β, with the bits that
    /// [`Stepper::step_augmented`] gives. Of lanes it is compiled for the widest vector instructions, as [`Stepper::steps`] is.
    pub fn step_each_augmented<M: System<Number = N>>(&self, systems: &mut [M])
    where
        S: ValidFor<M::Class>,
    {
        M::advance_augmented(systems, self.maps());
    }

    /// One step, with its [increments](System::increments) of q, p and β.
    #[inline]
    pub fn step_augmented<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        self.scheme.step_augmented(&self.weights, system);
    }

    /// The exact inverse of [`Stepper::step`]: t → t − h, up to round-off.
    #[inline]
    pub fn step_back<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        self.scheme.step_back(&self.weights, system);
    }

    /// The exact inverse of [`Stepper::step_augmented`]; its increments are the negatives.
    #[inline]
    pub fn step_back_augmented<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        self.scheme.step_back_augmented(&self.weights, system);
    }
}
