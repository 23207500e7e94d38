//! The system of a potential and a kinetic energy, with its state.

mod curved;
mod flows;
mod turns;

use thiserror::Error;

use crate::coordinates::Coordinates;
use crate::displaced::Displacements;
use crate::instructions;
use crate::kept::Kept;
use crate::kinetic::{Kinetic, MassError};
use crate::maps::{MapKind, MapSequence};
use crate::number::Number;
use crate::partial_sums::add_sum;
use crate::potential::Potential;
use crate::summation::{Compensated, FixedPoint, Plain, RangeError, Summation};
use crate::system::{Increments, OwnedIncrements, Remainders, System};

use curved::Curved;
use flows::{Flows, Moving};
use turns::Flowing;

/// A system H = T(p) + U(q) and its state.
///
/// The gradient of the last kick is kept as long as q stays, so that the next step's first kick costs no evaluation.
///
/// `S` is [how increments are added](crate::summation) to q and p: plainly, [compensated](Motion::compensated) or in
/// [fixed point](Motion::fixed_point).
#[derive(Clone, Debug)]
pub struct Motion<N, V, P, K, S = Plain> {
    flows: Flows<N, P, K>,
    moving: Moving<N, V, S>,
    /// Of q and p only where the numbers keep these.
    increments: OwnedIncrements<N, V>,
}

impl<N, V, P, K> Motion<N, V, P, K>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    /// The system at q, p.
    ///
    /// # Errors
    /// q, p, the potential and the kinetic energy that do not have the same dimension, at least 1; numbers of q and p of different
    /// precision.
    pub fn new(potential: P, kinetic: K, q: V, p: V) -> Result<Self, MotionError> {
        let context = check(&potential, &kinetic, q.as_ref(), p.as_ref())?;
        let zero = N::zero(&context);
        let mut increments = OwnedIncrements { q: q.clone(), p: p.clone(), beta: zero.clone() };
        increments.assign_zero();
        let mut scratch = vec![zero.clone(); potential.scratch()];
        potential.prepare(&mut scratch, &context);
        let mut kinetic_scratch = vec![zero.clone(); kinetic.scratch()];
        kinetic.prepare(&mut kinetic_scratch, &context);
        let moving =
            Moving { summation: Plain, gradient: p.clone(), rate: zero, kept: Kept::Nothing, evaluations: 0, q, p };
        let flows = Flows { potential, kinetic, keeps_rate: false, scratch, kinetic_scratch, curved: None };
        Ok(Motion { flows, moving, increments })
    }

    /// The same system with compensated sums: the round-off of a kick or drift is ε times the increment, in place of ε times the
    /// coordinate, so that it is smaller by a factor like h. See [`Compensated`]; `docs/round-off.md` has what it gains and costs.
    ///
    /// ```
    /// use shadowstep::{Motion, Stepper, UnitMasses, potential, tables::shipped};
    ///
    /// potential! { #[derive(Clone)] pub struct Spring; U(q) = q^2/2 }
    ///
    /// let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), "1/1024")?;
    /// let mut plain = Motion::new(Spring, UnitMasses, [0.6], [0.8])?;
    /// let mut compensated = plain.clone().compensated();
    /// // of an oscillator the scheme conserves this exactly, but for round-off
    /// let modified = |q: &[f64], p: &[f64]| (p[0] * p[0] + (1.0 - 0.25 / 1048576.0) * q[0] * q[0]) / 2.0;
    /// let before = modified(plain.q(), plain.p());
    /// for _ in 0..1_000_000 {
    ///     stepper.step(&mut plain);
    ///     stepper.step(&mut compensated);
    /// }
    /// let [plain, compensated] = [modified(plain.q(), plain.p()), modified(compensated.q(), compensated.p())];
    /// assert!((plain - before).abs() > 1e-15 && (compensated - before).abs() < 3e-16);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn compensated(self) -> Motion<N, V, P, K, Compensated<N, V>> {
        let summation = Compensated::of(&self.moving.q, &self.context());
        self.with(summation)
    }

    /// The same system with compensated sums if `compensated` is true: for a choice at run time.
    #[must_use]
    pub fn compensated_if(self, compensated: bool) -> Motion<N, V, P, K, Option<Compensated<N, V>>> {
        let summation = compensated.then(|| Compensated::of(&self.moving.q, &self.context()));
        self.with(summation)
    }

    /// The same system with gradient kicks by displaced forces, of the stepper that computed these: see [`Displacements`]. They take a force in place of a
    /// Hessian–vector product, which the potential then need not have, and are not exactly symplectic.
    ///
    /// ```
    /// use shadowstep::{Motion, Stepper, UnitMasses, potential::from_fn, tables::shipped};
    ///
    /// let stepper = Stepper::new(shipped("chin-4a").unwrap(), "1/20")?;
    /// let pendulum = from_fn(1, |q, gradient| {
    ///     gradient[0] = q[0].sin();
    ///     -q[0].cos()
    /// });
    /// let mut motion = Motion::new(pendulum, UnitMasses, [0.0], [1.5])?.displaced(stepper.displacements()?);
    /// let start = motion.energy();
    /// (0..1000).for_each(|_| stepper.step(&mut motion));
    /// assert!((motion.energy() - start).abs() < 1e-7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn displaced(mut self, displacements: Displacements<N>) -> Self {
        let curved = Curved::displaced(displacements, self.q().len(), &self.context());
        self.flows.curved = Some(Box::new(curved));
        self
    }

    fn with<S>(self, summation: S) -> Motion<N, V, P, K, S> {
        let Motion { flows, moving, increments } = self;
        let Moving { q, p, gradient, rate, kept, evaluations, .. } = moving;
        Motion { flows, moving: Moving { summation, q, p, gradient, rate, kept, evaluations }, increments }
    }
}

impl<V, P, K> Motion<f64, V, P, K>
where
    V: Coordinates<f64>,
    P: Potential<f64>,
    K: Kinetic<f64>,
{
    /// The same system in fixed point: [`Stepper::step_back`](crate::Stepper::step_back) undoes a step to the last bit. See [`FixedPoint`].
    ///
    /// The ranges are the largest |q_i| and |p_i| that a run may reach; a coordinate that leaves its range by a factor of 2 becomes NaN. The
    /// state is rounded to 2⁻⁶² of the ranges.
    ///
    /// ```
    /// use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, tables::shipped};
    ///
    /// let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/20")?;
    /// let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?.fixed_point(&[4.0; 2], &[8.0; 2])?;
    /// (0..1000).for_each(|_| stepper.step(&mut motion));
    /// assert!((motion.q()[0] - 0.4).abs() > 0.1);
    /// (0..1000).for_each(|_| stepper.step_back(&mut motion));
    /// assert_eq!((motion.q(), motion.p()), ([0.4, 0.0].as_slice(), [0.0, 2.0].as_slice()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Ranges that are not as many as coordinates, not positive or of an extreme size, or that the state exceeds.
    pub fn fixed_point(
        self,
        q_ranges: &[f64],
        p_ranges: &[f64],
    ) -> Result<Motion<f64, V, P, K, FixedPoint<V>>, RangeError> {
        let summation = FixedPoint::of((&self.moving.q, &self.moving.p), (q_ranges, p_ranges))?;
        let mut motion = self.with(summation);
        motion.moving.settle();
        Ok(motion)
    }
}

impl<N, V, P, K, S> Motion<N, V, P, K, S>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    /// Positions.
    pub fn q(&self) -> &[N] {
        self.moving.q.as_ref()
    }

    /// Momenta.
    pub fn p(&self) -> &[N] {
        self.moving.p.as_ref()
    }

    /// What the last augmented step added to β.
    pub fn beta(&self) -> &N {
        &self.increments.beta
    }

    /// What the last augmented step added to q, p and β.
    #[inline]
    pub fn increments(&self) -> Increments<'_, N> {
        if N::KEEPS_INCREMENTS { self.increments.view() } else { Increments::of_beta(&self.increments.beta) }
    }

    /// Positions, to be changed; the kept gradient and remainders of sums are dropped.
    pub fn q_mut(&mut self) -> &mut [N] {
        self.moving.kept = Kept::Nothing;
        self.moving.summation.forget_positions();
        self.moving.q.as_mut()
    }

    /// Momenta, to be changed; remainders of sums are dropped.
    pub fn p_mut(&mut self) -> &mut [N] {
        self.moving.summation.forget_momenta();
        self.moving.p.as_mut()
    }

    /// The potential.
    pub fn potential(&self) -> &P {
        &self.flows.potential
    }

    /// Changes the potential, which keeps its dimension; the kept gradient is dropped.
    pub fn change_potential(&mut self, change: impl FnOnce(&mut P)) {
        change(&mut self.flows.potential);
        // the scratch space for second derivatives is of the potential as it was
        self.flows.curved = self.flows.curved.take().filter(|curved| curved.kicks.is_displaced());
        self.moving.kept = Kept::Nothing;
        let context = self.context();
        self.flows.scratch.resize(self.flows.potential.scratch(), N::zero(&context));
        self.flows.potential.prepare(&mut self.flows.scratch, &context);
    }

    /// The number of evaluations of the gradient U_q, those at displaced positions included; those of T_p in drifts are not counted.
    pub fn evaluations(&self) -> u64 {
        self.moving.evaluations
    }

    /// The number of Hessian–vector products U_qq M⁻¹U_q computed for gradient kicks, since the potential was changed last.
    pub fn hessian_products(&self) -> u64 {
        let products = self.flows.curved.as_ref().filter(|curved| !curved.kicks.is_displaced());
        products.map_or(0, |curved| curved.kicks.evaluations)
    }

    /// The context of the numbers.
    pub fn context(&self) -> N::Context {
        self.increments.beta.context()
    }

    /// H = T(p) + U(q) at the present state; NaN where squares of distances overflow, a coordinate above 3.8e153 in `f64`:
    /// there a potential such as −1/r would be 0.
    pub fn energy(&mut self) -> N {
        let [mut energy, mut kinetic_energy] = [self.beta().clone(), self.beta().clone()];
        let Motion { flows, moving, .. } = self;
        flows.assign_energies((moving.q.as_ref(), moving.p.as_ref()), &mut energy, &mut kinetic_energy);
        energy
    }

    /// H = T(p) + U(q) at another state of the same system.
    pub fn energy_at(&mut self, q: &[N], p: &[N]) -> N {
        let [mut energy, mut kinetic_energy] = [self.beta().clone(), self.beta().clone()];
        self.flows.assign_energies((q, p), &mut energy, &mut kinetic_energy);
        energy
    }

    #[inline]
    fn evaluate(&mut self, with_rate: bool) {
        self.flows.evaluate(&mut self.moving, with_rate);
    }

    /// [`System::kick_augmented`], compiled for the instructions of the caller.
    #[inline(always)]
    fn kick_augmented_here(&mut self, weight: &N) {
        let Motion { flows, moving, increments } = self;
        moving.settle();
        if moving.kept != Kept::GradientAndRate {
            flows.evaluate(moving, true);
        }
        increments.beta.add_product(weight, &moving.rate);
        instructions::widest_if_long(
            N::IN_VECTORS,
            moving.p.as_ref().len(),
            #[inline(always)]
            || {
                moving.kick_with_kept_gradient(weight);
                if N::KEEPS_INCREMENTS {
                    for (increment, gradient) in increments.p.as_mut().iter_mut().zip(moving.gradient.as_ref()) {
                        increment.subtract_product(weight, gradient);
                    }
                }
            },
        );
    }

    /// [`System::gradient_kick_augmented`], likewise.
    #[inline(always)]
    fn gradient_kick_augmented_here(&mut self, weight: &N) {
        let Motion { flows, moving, increments } = self;
        flows.gradient_kick(moving, weight, true).add_increments(weight, increments);
    }

    /// [`System::drift_augmented`], likewise.
    #[inline(always)]
    fn drift_augmented_here(&mut self, weight: &N) {
        let Motion { flows, moving, increments } = self;
        moving.settle();
        instructions::widest_if_long(
            N::IN_VECTORS,
            moving.p.as_ref().len(),
            #[inline(always)]
            || {
                moving.summation.drift_augmented(
                    &flows.kinetic,
                    weight,
                    moving.p.as_ref(),
                    moving.q.as_mut(),
                    (increments.q.as_mut(), &mut increments.beta),
                    &mut flows.kinetic_scratch,
                );
            },
        );
        moving.kept = Kept::Nothing;
    }

    /// Whether every q, p and β is a finite number.
    pub fn is_finite(&self) -> bool {
        self.increments.beta.is_finite() && self.q().iter().chain(self.p()).all(N::is_finite)
    }
}

/// Checks that dimensions and precisions agree; returns the context of the numbers.
fn check<N: Number, P: Potential<N>, K: Kinetic<N>>(
    potential: &P,
    kinetic: &K,
    q: &[N],
    p: &[N],
) -> Result<N::Context, MotionError> {
    let coordinates = q.len();
    let differs = |other: usize| other != coordinates;
    let momenta = kinetic.dimension().unwrap_or(coordinates);
    match () {
        () if coordinates == 0 => Err(MotionError::NoCoordinates),
        () if differs(p.len()) => Err(MotionError::Momenta { coordinates, momenta: p.len() }),
        () if differs(potential.dimension()) => {
            Err(MotionError::Potential { coordinates, dimension: potential.dimension() })
        }
        () if differs(momenta) => Err(MotionError::Kinetic { coordinates, dimension: momenta }),
        () => {
            let context = q[0].context();
            let alike = q.iter().chain(p).all(|x| x.context() == context);
            if alike { Ok(context) } else { Err(MotionError::Precision) }
        }
    }
}

/// A state, a potential and a kinetic energy that do not fit together.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MotionError {
    /// q is empty.
    #[error("a motion needs at least one coordinate")]
    NoCoordinates,
    /// q and p have different dimensions.
    #[error("q has {coordinates} coordinates, but p has {momenta}")]
    Momenta {
        /// The dimension of q.
        coordinates: usize,
        /// The dimension of p.
        momenta: usize,
    },
    /// The potential has another dimension.
    #[error("q has {coordinates} coordinates, but the potential is a function of {dimension}")]
    Potential {
        /// The dimension of q.
        coordinates: usize,
        /// The dimension of the potential.
        dimension: usize,
    },
    /// The kinetic energy has another dimension.
    #[error("p has {coordinates} components, but the kinetic energy is a function of {dimension}")]
    Kinetic {
        /// The dimension of q and p.
        coordinates: usize,
        /// The dimension of the kinetic energy.
        dimension: usize,
    },
    /// The numbers have different precisions.
    #[error("the numbers of q and p must have the same precision")]
    Precision,
    /// The numbers have more digits than the flow of a linear part is computed to.
    #[error("a linear part needs numbers of at most 288 digits")]
    Digits,
    /// A mass is not valid.
    #[error(transparent)]
    Masses(#[from] MassError),
}

impl<N, V, P, K, S> Flowing for Motion<N, V, P, K, S>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    type Number = N;
    type Coordinates = V;
    type Potential = P;
    type Kinetic = K;
    type Summation = S;

    #[inline(always)]
    fn flows(&mut self) -> (&mut Flows<N, P, K>, &mut Moving<N, V, S>) {
        (&mut self.flows, &mut self.moving)
    }
}

impl<N, V, P, K, S> System for Motion<N, V, P, K, S>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    type Number = N;
    type Class = K::Class;

    fn q(&self) -> &[N] {
        self.moving.q.as_ref()
    }

    fn p(&self) -> &[N] {
        self.moving.p.as_ref()
    }

    #[inline]
    fn increments(&self) -> Increments<'_, N> {
        Motion::increments(self)
    }

    fn set_state(&mut self, q: &[N], p: &[N]) {
        self.q_mut().iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        self.p_mut().iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        self.moving.settle();
    }

    fn remainders(&self) -> Remainders<N> {
        self.moving.summation.remainders(self.q(), self.p())
    }

    fn set_remainders(&mut self, remainders: &Remainders<N>) {
        self.moving.summation.set_remainders(remainders);
    }

    fn is_compensated(&self) -> bool {
        self.moving.summation.is_compensated()
    }

    #[inline]
    fn kick(&mut self, weight: &N) {
        self.moving.settle();
        if self.moving.kept == Kept::Nothing {
            self.evaluate(self.flows.keeps_rate);
        }
        self.moving.kick_with_kept_gradient(weight);
    }

    #[inline]
    fn kick_augmented(&mut self, weight: &N) {
        self.kick_augmented_here(weight);
    }

    #[inline]
    fn drift(&mut self, weight: &N) {
        self.flows.drift(&mut self.moving, weight);
    }

    fn has_gradient_kicks(&self) -> bool {
        let is_displaced = self.flows.curved.as_ref().is_some_and(|curved| curved.kicks.is_displaced());
        is_displaced || self.flows.potential.hessian().is_some()
    }

    #[inline]
    fn gradient_kick(&mut self, weight: &N) {
        self.flows.gradient_kick(&mut self.moving, weight, self.flows.keeps_rate);
    }

    #[inline]
    fn gradient_kick_augmented(&mut self, weight: &N) {
        self.gradient_kick_augmented_here(weight);
    }

    fn advance(motions: &mut [Self], maps: &impl MapSequence<N>, count: u64) {
        N::in_widest_instructions(
            #[inline(always)]
            || match motions {
                [Motion { flows, moving, .. }] => flows.advance(moving, maps, count),
                many => turns::advance(many, maps, count),
            },
        );
    }

    fn advance_augmented(motions: &mut [Self], maps: &impl MapSequence<N>) {
        N::in_widest_instructions(
            #[inline(always)]
            || {
                for motion in motions {
                    motion.clear_increments();
                    maps.each(
                        0..1,
                        1,
                        #[inline(always)]
                        |kind, weight, _| match kind {
                            MapKind::Kick => motion.kick_augmented_here(weight),
                            MapKind::Drift => motion.drift_augmented_here(weight),
                            MapKind::GradientKick => motion.gradient_kick_augmented_here(weight),
                        },
                    );
                }
            },
        );
    }

    #[inline]
    fn drift_augmented(&mut self, weight: &N) {
        self.drift_augmented_here(weight);
    }

    #[inline]
    fn clear_increments(&mut self) {
        if N::KEEPS_INCREMENTS {
            self.increments.assign_zero();
        } else {
            self.increments.beta.assign_zero();
        }
    }

    /// Where the gradient and the rate are kept, U = ½(qᵀU_q − rate) costs no evaluation.
    #[inline]
    fn assign_energies(&mut self, energy: &mut N, kinetic_energy: &mut N) {
        let Motion { flows, moving: Moving { q, p, gradient, rate, kept, .. }, .. } = self;
        let (q, p) = (q.as_ref(), p.as_ref());
        if *kept != Kept::GradientAndRate {
            return flows.assign_energies((q, p), energy, kinetic_energy);
        }
        energy.assign_zero();
        add_sum(energy, [q, gradient.as_ref()], |[q, u], energy| energy.add_product(q, u));
        energy.subtract(rate);
        energy.divide_integer(2);
        flows.add_kinetic_energy((q, p), energy, kinetic_energy);
    }

    fn assign_energies_at(&mut self, q: &[N], p: &[N], energy: &mut N, kinetic_energy: &mut N) {
        self.flows.assign_energies((q, p), energy, kinetic_energy);
    }

    fn energy(&mut self) -> N {
        Motion::energy(self)
    }

    fn evaluations(&self) -> u64 {
        self.moving.evaluations
    }

    /// Keeps the rate of the last gradient: an augmented step would have to evaluate that gradient again.
    fn before_augmented_step(&mut self, follows: bool) {
        self.flows.keeps_rate = follows;
    }
}
