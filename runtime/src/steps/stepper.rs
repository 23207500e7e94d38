//! A scheme with a step size: the object that makes steps.

use crate::Rational;
use crate::number::{Number, Real};
use crate::steps::displacements::{DisplacementError, displacements};
use crate::steps::mismatch::MismatchError;
use crate::steps::processor::Processor;
use crate::steps::scheme::{Scheme, ValidFor};
use crate::steps::scheme_maps::{Maps, MergedMaps};
use crate::steps::step_size::{StepSize, StepSizeError};
use crate::steps::weights::{WeightLists, Weights};
use crate::systems::displaced::Displacements;
use crate::systems::increments::Carried;
use crate::systems::maps::MapKind;
use crate::systems::state::Saved;
use crate::systems::system::{Carrying, System, Visitor};

/// A scheme, its step size h and its weights h·a_s, h·b_s and 2h³·c_s of gradient kicks, each an exact product rounded
/// once to the number type.
///
/// Loops, runs and the [monitor](crate::shadow::ShadowEnergy) take a stepper, so that the scheme and the step size of
/// the weights are always those of the steps.
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
///
/// # Processed schemes
///
/// A processed scheme is χ⁻¹ ∘ kernelⁿ ∘ χ. The steps are those of its kernel: [`preprocess`](Stepper::preprocess) once
/// before the first of them, and read a state through [`at_output`](Stepper::at_output), as often as one is wanted. For
/// other schemes both do nothing, so that a loop may always have them.
///
/// ```
/// use shadowstep::{Motion, Stepper, UnitMasses, potential, tables::shipped};
///
/// // a harmonic oscillator and a perturbation: not what the scheme is for, since its drifts are not those of the oscillator
/// potential! { #[derive(Clone)] pub struct Weak; U(q) = cos(q)/1000 }
///
/// let error = |name| {
///     let stepper = Stepper::new(shipped(name).unwrap(), "1/2").unwrap();
///     let mut motion = Motion::new(Weak, UnitMasses, [0.0], [1.0]).unwrap();
///     let before = motion.energy();
///     stepper.preprocess(&mut motion);
///     (0..5).for_each(|_| stepper.step(&mut motion));
///     stepper.at_output(&mut motion, |motion| (motion.energy() - before).abs())
/// };
/// // H = A + εB with A = p²/2: the leapfrog has the error O(εh²), a corrector of order 7 has O(εh⁸ + ε²h²)
/// assert!(error("wisdom-corrector-7") < error("stormer-verlet") / 100.0);
/// ```
#[derive(Clone, Debug)]
pub struct Stepper<S: Scheme, N: Number> {
    scheme: S,
    h: StepSize,
    forward: S::Weights<N>,
    /// The negatives.
    back: S::Weights<N>,
    /// Of the last map of a step and the first of the next as one.
    merged: Option<N>,
    processor: Processor<N>,
}

impl<S: Scheme, N: Number> Stepper<S, N> {
    /// A stepper for numbers without a context, such as `f64`.
    ///
    /// # Errors
    /// A step size that is 0, not finite, beyond the range of a [`StepSize`], or a text without an exact value.
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
        let exact = scheme.exact_weights();
        let forward = times(exact.view(), h.exact(), context);
        let back = times(exact.view(), &-h.exact(), context);
        let merged = merged_weight(&scheme, exact.view(), h.exact(), context);
        Ok(Stepper { forward, back, merged, processor: Processor::of(&scheme, h.exact(), context), scheme, h })
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

    /// h·a_s, h·b_s, those of middle parts and 2h³·c_s of gradient kicks: the distinct ones, in the order of the plan.
    pub fn weights(&self) -> Weights<&[N]> {
        self.forward.view()
    }

    /// The weights of the inverse step, the negatives of these.
    pub fn weights_back(&self) -> Weights<&[N]> {
        self.back.view()
    }

    /// How far the gradient kicks of its steps displace positions, for a system that makes them by displaced forces in
    /// place of second derivatives: see [`Displacements`].
    ///
    /// # Errors
    /// A scheme without gradient kicks; a gradient kick without a kick at the same q; gradient kicks of equal weight
    /// with kicks of different weights.
    pub fn displacements(&self) -> Result<Displacements<N>, DisplacementError>
    where
        N: Real,
    {
        displacements(&self.scheme, self.h(), self.weights().gradient_kicks)
    }

    /// Refuses a system whose numbers have another precision than the weights, or that has not the gradient kicks of
    /// the scheme.
    pub(crate) fn check<M: System<Number = N> + ?Sized>(&self, system: &M) -> Result<(), MismatchError> {
        let context = system.state().context();
        if !self.weights().iter().all(|weight| weight.context() == context) {
            return Err(MismatchError::Precision);
        }
        if !self.weights().gradient_kicks.is_empty() && !system.has_gradient_kicks() {
            return Err(MismatchError::NoGradientKicks { scheme: self.scheme().summary().name.to_owned() });
        }
        Ok(())
    }

    /// The pre-map and the post-map with their weights.
    pub(crate) fn processor(&self) -> &Processor<N> {
        &self.processor
    }

    /// The maps of a step with their weights.
    fn maps(&self) -> Maps<'_, S, N> {
        Maps::new(&self.scheme, &self.forward)
    }

    /// One step: t → t + h.
    #[inline]
    pub fn step<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        self.scheme.forward(&self.forward, &mut Carrying { system, carried: Carried::Nothing });
    }

    /// One step before an augmented one, with the bits of [`Stepper::step`]: what it evaluates last, such as the rate
    /// qᵀU_q − 2U beside the gradient, is kept for the augmented step, which then costs no evaluation more.
    #[inline]
    pub fn step_before_augmented<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        self.scheme.forward(&self.forward, &mut Carrying { system, carried: Carried::Rate });
    }

    /// Whether the scheme is a processed one, whose steps are those of its kernel.
    pub fn is_processed(&self) -> bool {
        !self.processor.is_identity()
    }

    /// The pre-map χ of a processed scheme, which takes an initial state to that at which the kernel begins; nothing
    /// for other schemes.
    pub fn preprocess<M: System<Number = N>>(&self, system: &mut M) {
        self.processor.preprocess(system);
    }

    /// The post-map χ⁻¹ of a processed scheme, which takes a state of the kernel to one of the trajectory; nothing for
    /// other schemes.
    pub fn postprocess<M: System<Number = N>>(&self, system: &mut M) {
        self.processor.postprocess(system);
    }

    /// Reads the system at the state of the trajectory that belongs to the present one of the kernel: through the
    /// post-map, after which the system has its state back, to the last bit. For other schemes it is at its own state.
    pub fn at_output<M: System<Number = N>, R>(&self, system: &mut M, read: impl FnOnce(&mut M) -> R) -> R {
        if !self.is_processed() {
            return read(system);
        }
        let saved = Saved::of(system.state());
        self.postprocess(system);
        let found = read(system);
        saved.restore(system.state_mut());
        found
    }

    /// `count` steps of each of several systems, with the bits that [`Stepper::step`] gives.
    ///
    /// Of [lanes](crate::number::Lanes) this is one loop in the widest vector instructions that the processor has. The
    /// systems take turns: all kicks and drifts of one up to its next evaluation of the gradient, then those of the
    /// next, so that operations of one need not wait for the results of another; fewer than 8 steps, and those with
    /// gradient kicks, map by map. Four systems of 16 lanes are good, or one of many coordinates. Potentials behind a
    /// `dyn`, of up to three coordinates, take turns as those of a known type do if they are
    /// [`Vectorised`](crate::systems::potential::Vectorised). Each map, and each instruction, of four systems with one
    /// [formula](crate::systems::formula::FormulaPotential) is carried out for all of them before the next one.
    ///
    /// [`Fused`](crate::number::Fused) numbers need it for the instructions of their products. Of `f64` in arrays it is
    /// as fast as a loop of steps or a little faster, with schemes from tables by 9 to 29 %.
    pub fn steps<M: System<Number = N>>(&self, systems: &mut [M], count: u64)
    where
        S: ValidFor<M::Class>,
    {
        M::advance(systems, &self.maps(), count, Carried::Nothing);
    }

    /// `count` steps of a system, with the bits that [`Stepper::step`] gives; the visitor sees the state after each.
    ///
    /// It is for what needs each state of a long run and little of it: of `f64` in vectors, behind a `dyn`, a step
    /// takes less time than one by one, as with [`Stepper::steps`].
    pub fn steps_visited<M: System<Number = N>>(&self, system: &mut M, count: u64, visitor: &mut dyn Visitor<N>)
    where
        S: ValidFor<M::Class>,
    {
        system.advance_visited(&self.maps(), count, visitor);
    }

    /// `count` steps of each of several systems, where the last map of a step and the first of the next are made as
    /// one: n steps of Störmer–Verlet are n + 1 kicks and n drifts.
    ///
    /// This is a map less a step, and its bits are other ones than those of [`Stepper::steps`]: the merged map has the
    /// weight h(w + w′), the exact product rounded once, and q or p is rounded once where it was twice. Of two kicks no
    /// gradient is saved, as that of the last serves the first anyway; two drifts are a flow less, such as a Kepler
    /// orbit. As no state between two steps is made, take it for stretches of steps in which none is wanted.
    ///
    /// Where a step begins and ends with different maps, or with a gradient kick, and for three parts and more, these
    /// are its steps. As [`Stepper::steps`] it is compiled for the widest vector instructions.
    ///
    /// ```
    /// use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, tables::shipped};
    ///
    /// let stepper = Stepper::new(shipped("saba4").unwrap(), "1/20")?;
    /// let mut motions = [Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?];
    /// let mut one_by_one = motions.clone();
    /// stepper.merged_steps(&mut motions, 100);
    /// stepper.steps(&mut one_by_one, 100);
    /// assert!((motions[0].q()[0] - one_by_one[0].q()[0]).abs() < 1e-13);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn merged_steps<M: System<Number = N>>(&self, systems: &mut [M], count: u64)
    where
        S: ValidFor<M::Class>,
    {
        match &self.merged {
            Some(weight) => M::advance(systems, &MergedMaps { maps: self.maps(), weight }, count, Carried::Nothing),
            None => M::advance(systems, &self.maps(), count, Carried::Nothing),
        }
    }

    /// One step of each of several systems with its [increments](crate::State::increments) of q, p and β, with the bits
    /// that [`Stepper::step_augmented`] gives. Of lanes it is compiled for the widest vector instructions, as
    /// [`Stepper::steps`] is.
    pub fn step_each_augmented<M: System<Number = N>>(&self, systems: &mut [M])
    where
        S: ValidFor<M::Class>,
    {
        M::advance(systems, &self.maps(), 1, Carried::Increments);
    }

    /// One step, with its [increments](crate::State::increments) of q, p and β.
    #[inline]
    pub fn step_augmented<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        system.clear_increments();
        self.scheme.forward(&self.forward, &mut Carrying { system, carried: Carried::Increments });
    }

    /// The exact inverse of [`Stepper::step`]: t → t − h, up to round-off.
    #[inline]
    pub fn step_back<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        self.scheme.back(&self.back, &mut Carrying { system, carried: Carried::Nothing });
    }

    /// The exact inverse of [`Stepper::step_augmented`]; its increments are the negatives.
    #[inline]
    pub fn step_back_augmented<M: System<Number = N>>(&self, system: &mut M)
    where
        S: ValidFor<M::Class>,
    {
        system.clear_increments();
        self.scheme.back(&self.back, &mut Carrying { system, carried: Carried::Increments });
    }

    /// One step that carries this along.
    #[inline]
    pub(crate) fn step_carrying<M: System<Number = N>>(&self, system: &mut M, carried: Carried)
    where
        S: ValidFor<M::Class>,
    {
        // an arm each: what is carried along is then known where the step is compiled
        match carried {
            Carried::Nothing => self.step(system),
            Carried::Rate => self.step_before_augmented(system),
            Carried::Increments => self.step_augmented(system),
        }
    }

    /// The inverse of a step that carries this along.
    #[inline]
    pub(crate) fn step_back_carrying<M: System<Number = N>>(&self, system: &mut M, carried: Carried)
    where
        S: ValidFor<M::Class>,
    {
        match carried.has_increments() {
            true => self.step_back_augmented(system),
            false => self.step_back(system),
        }
    }
}

/// h·w of each weight w of a scheme, 2h³·w of those of gradient kicks: an exact product rounded once.
fn times<N: Number, W: WeightLists<N>>(exact: Weights<&[Rational]>, h: &Rational, context: &N::Context) -> W {
    let twice_cube = h.pow(MapKind::GradientKick.power() as i32) * Rational::from_integer(2.into());
    let number = |factor: Rational| move |weight: &Rational| N::from_rational(&(&factor * weight), context);
    W::from_vecs(exact.map(number(h.clone()), number(twice_cube)))
}

/// h(w + w′) of the weights of the last map of a step and the first of the next, where both are kicks or both are
/// drifts of H of two parts.
fn merged_weight<N: Number>(
    scheme: &impl Scheme,
    exact: Weights<&[Rational]>,
    h: &Rational,
    context: &N::Context,
) -> Option<N> {
    let sequence = scheme.sequence();
    let &[(kind, first), .., (closing, last)] = sequence.maps else { return None };
    if kind != closing || kind == MapKind::GradientKick || !sequence.middle_parts.is_empty() {
        return None;
    }
    let weights = exact.of(kind);
    Some(N::from_rational(&(h * (&weights[first] + &weights[last])), context))
}
