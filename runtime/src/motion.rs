//! The system of a potential and a kinetic energy, with its state.

use thiserror::Error;

use crate::coordinates::Coordinates;
use crate::kinetic::{Kinetic, MassError};
use crate::maps::{MapKind, Maps};
use crate::number::Number;
use crate::potential::Potential;
use crate::summation::{Compensated, FixedPoint, Plain, RangeError, Summation};
use crate::system::{Increments, OwnedIncrements, Remainders, System};

/// What is kept at the present q.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kept {
    Nothing,
    Gradient,
    GradientAndRate,
}

/// A system H = T(p) + U(q) and its state.
///
/// The gradient of the last kick is kept as long as q stays, so that the next step's first kick costs no evaluation.
///
/// `S` is [how increments are added](crate::summation) to q and p: plainly, [compensated](Motion::compensated) or in
/// [fixed point](Motion::fixed_point).
#[derive(Clone, Debug)]
pub struct Motion<N, V, P, K, S = Plain> {
    summation: S,
    potential: P,
    kinetic: K,
    q: V,
    p: V,
    /// Of q and p only where the numbers keep these.
    increments: OwnedIncrements<N, V>,
    gradient: V,
    /// qᵀU_q − 2U
    rate: N,
    kept: Kept,
    /// Whether plain kicks that evaluate the gradient find and keep the rate as well.
    keeps_rate: bool,
    /// The potential's, with what it keeps there.
    scratch: Vec<N>,
    /// The kinetic energy's, likewise.
    kinetic_scratch: Vec<N>,
    evaluations: u64,
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
        Ok(Motion {
            summation: Plain,
            scratch,
            kinetic_scratch,
            gradient: p.clone(),
            rate: zero,
            increments,
            kept: Kept::Nothing,
            keeps_rate: false,
            evaluations: 0,
            potential,
            kinetic,
            q,
            p,
        })
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
        let summation = Compensated::of(&self.q, &self.context());
        self.with(summation)
    }

    /// The same system with compensated sums if `compensated` is true: for a choice at run time.
    #[must_use]
    pub fn compensated_if(self, compensated: bool) -> Motion<N, V, P, K, Option<Compensated<N, V>>> {
        let summation = compensated.then(|| Compensated::of(&self.q, &self.context()));
        self.with(summation)
    }

    fn with<S>(self, summation: S) -> Motion<N, V, P, K, S> {
        let Motion { potential, kinetic, q, p, increments, gradient, rate, kept, .. } = self;
        let Motion { keeps_rate, scratch, kinetic_scratch, evaluations, .. } = self;
        Motion {
            summation,
            potential,
            kinetic,
            q,
            p,
            increments,
            gradient,
            rate,
            kept,
            keeps_rate,
            scratch,
            kinetic_scratch,
            evaluations,
        }
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
        let summation = FixedPoint::of((&self.q, &self.p), (q_ranges, p_ranges))?;
        let mut motion = self.with(summation);
        motion.settle();
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
        self.q.as_ref()
    }

    /// Momenta.
    pub fn p(&self) -> &[N] {
        self.p.as_ref()
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
        self.kept = Kept::Nothing;
        self.summation.forget_positions();
        self.q.as_mut()
    }

    /// Momenta, to be changed; remainders of sums are dropped.
    pub fn p_mut(&mut self) -> &mut [N] {
        self.summation.forget_momenta();
        self.p.as_mut()
    }

    /// The potential.
    pub fn potential(&self) -> &P {
        &self.potential
    }

    /// Changes the potential, which keeps its dimension; the kept gradient is dropped.
    pub fn change_potential(&mut self, change: impl FnOnce(&mut P)) {
        change(&mut self.potential);
        self.kept = Kept::Nothing;
        let context = self.context();
        self.scratch.resize(self.potential.scratch(), N::zero(&context));
        self.potential.prepare(&mut self.scratch, &context);
    }

    /// The number of evaluations of the gradient U_q; those of T_p in drifts are not counted.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The context of the numbers.
    pub fn context(&self) -> N::Context {
        self.increments.beta.context()
    }

    /// H = T(p) + U(q) at the present state; NaN where squares of distances overflow, a coordinate above 3.8e153 in `f64`:
    /// there a potential such as −1/r would be 0.
    pub fn energy(&mut self) -> N {
        let Motion { potential, kinetic, q, p, scratch, kinetic_scratch, increments, .. } = self;
        let [mut energy, mut kinetic_energy] = [increments.beta.clone(), increments.beta.clone()];
        let energies = (&mut energy, &mut kinetic_energy);
        assign_energies(potential, kinetic, (q.as_ref(), p.as_ref()), (scratch, kinetic_scratch), energies);
        energy
    }

    /// H = T(p) + U(q) at another state of the same system.
    pub fn energy_at(&mut self, q: &[N], p: &[N]) -> N {
        let [mut energy, mut kinetic_energy] = [self.beta().clone(), self.beta().clone()];
        self.assign_energies_at(q, p, &mut energy, &mut kinetic_energy);
        energy
    }

    #[inline]
    fn evaluate(&mut self, with_rate: bool) {
        self.evaluate_here(with_rate);
    }

    /// [`System::kick`], compiled for the instructions of the caller.
    #[inline(always)]
    fn kick_here(&mut self, weight: &N) {
        self.settle();
        if self.kept == Kept::Nothing {
            self.evaluate_here(self.keeps_rate);
        }
        self.kick_with_kept_gradient(weight);
    }

    /// [`System::drift`], likewise.
    #[inline(always)]
    fn drift_here(&mut self, weight: &N) {
        self.settle();
        let Motion { summation, kinetic, p, q, kinetic_scratch, .. } = self;
        summation.drift(kinetic, weight, p.as_ref(), q.as_mut(), kinetic_scratch);
        self.kept = Kept::Nothing;
    }

    /// [`System::kick_augmented`], likewise.
    #[inline(always)]
    fn kick_augmented_here(&mut self, weight: &N) {
        self.settle();
        if self.kept != Kept::GradientAndRate {
            self.evaluate_here(true);
        }
        self.kick_with_kept_gradient(weight);
        self.increments.beta.add_product(weight, &self.rate);
        if N::KEEPS_INCREMENTS {
            for (increment, gradient) in self.increments.p.as_mut().iter_mut().zip(self.gradient.as_ref()) {
                increment.subtract_product(weight, gradient);
            }
        }
    }

    /// [`System::drift_augmented`], likewise.
    #[inline(always)]
    fn drift_augmented_here(&mut self, weight: &N) {
        self.settle();
        let Motion { summation, kinetic, p, q, increments, kinetic_scratch, .. } = self;
        summation.drift_augmented(
            kinetic,
            weight,
            p.as_ref(),
            q.as_mut(),
            (increments.q.as_mut(), &mut increments.beta),
            kinetic_scratch,
        );
        self.kept = Kept::Nothing;
    }

    #[inline(always)]
    fn evaluate_here(&mut self, with_rate: bool) {
        let (q, gradient) = (self.q.as_ref(), self.gradient.as_mut());
        self.potential.update(q);
        self.kept = if with_rate {
            self.potential.gradient_and_rate(q, gradient, &mut self.rate, &mut self.scratch);
            Kept::GradientAndRate
        } else {
            self.potential.gradient(q, gradient, &mut self.scratch);
            Kept::Gradient
        };
        self.evaluations += 1;
    }

    /// Whether every q, p and β is a finite number.
    pub fn is_finite(&self) -> bool {
        self.increments.beta.is_finite() && self.q().iter().chain(self.p()).all(N::is_finite)
    }

    #[inline(always)]
    fn kick_with_kept_gradient(&mut self, weight: &N) {
        self.summation.kick(weight, self.gradient.as_ref(), self.p.as_mut());
    }

    #[inline(always)]
    fn settle(&mut self) {
        self.summation.settle(self.q.as_mut(), self.p.as_mut());
    }
}

/// energy ← T(p) + U(q), kinetic_energy ← T(p)
fn assign_energies<N: Number, P: Potential<N>, K: Kinetic<N>>(
    potential: &mut P,
    kinetic: &K,
    (q, p): (&[N], &[N]),
    (scratch, kinetic_scratch): (&mut [N], &mut [N]),
    (energy, kinetic_energy): (&mut N, &mut N),
) {
    kinetic.energy(p, kinetic_energy, kinetic_scratch);
    potential.update(q);
    potential.energy(q, energy, scratch);
    energy.add(kinetic_energy);
    refuse_overflow(q, energy);
}

/// energy ← NaN where it is finite though squares of positions overflow: an infinite r² makes 0 of 1/r.
fn refuse_overflow<N: Number>(q: &[N], energy: &mut N) {
    q.iter().for_each(|position| energy.make_nan_where_square_overflows(position));
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
    /// A mass is not valid.
    #[error(transparent)]
    Masses(#[from] MassError),
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
        self.q.as_ref()
    }

    fn p(&self) -> &[N] {
        self.p.as_ref()
    }

    #[inline]
    fn increments(&self) -> Increments<'_, N> {
        Motion::increments(self)
    }

    fn set_state(&mut self, q: &[N], p: &[N]) {
        self.q_mut().iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        self.p_mut().iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        self.settle();
    }

    fn remainders(&self) -> Remainders<N> {
        self.summation.remainders(self.q.as_ref(), self.p.as_ref())
    }

    fn set_remainders(&mut self, remainders: &Remainders<N>) {
        self.summation.set_remainders(remainders);
    }

    fn is_compensated(&self) -> bool {
        self.summation.is_compensated()
    }

    #[inline]
    fn kick(&mut self, weight: &N) {
        self.settle();
        if self.kept == Kept::Nothing {
            self.evaluate(self.keeps_rate);
        }
        self.kick_with_kept_gradient(weight);
    }

    #[inline]
    fn kick_augmented(&mut self, weight: &N) {
        self.kick_augmented_here(weight);
    }

    #[inline]
    fn drift(&mut self, weight: &N) {
        self.drift_here(weight);
    }

    fn advance(motions: &mut [Self], maps: Maps<'_, N>, count: u64) {
        N::in_widest_instructions(
            #[inline(always)]
            || {
                for _ in 0..count {
                    for (kind, weight) in maps.iter() {
                        match kind {
                            MapKind::Kick => {
                                for motion in &mut *motions {
                                    motion.kick_here(weight);
                                }
                            }
                            MapKind::Drift => {
                                for motion in &mut *motions {
                                    motion.drift_here(weight);
                                }
                            }
                        }
                    }
                }
            },
        );
    }

    fn advance_augmented(motions: &mut [Self], maps: Maps<'_, N>) {
        N::in_widest_instructions(
            #[inline(always)]
            || {
                for motion in motions {
                    motion.clear_increments();
                    for (kind, weight) in maps.iter() {
                        match kind {
                            MapKind::Kick => motion.kick_augmented_here(weight),
                            MapKind::Drift => motion.drift_augmented_here(weight),
                        }
                    }
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
    fn assign_energies(&mut self, energy: &mut N, kinetic_energy: &mut N) {
        let Motion { potential, kinetic, q, p, gradient, rate, kept, scratch, kinetic_scratch, .. } = self;
        kinetic.energy(p.as_ref(), kinetic_energy, kinetic_scratch);
        if *kept == Kept::GradientAndRate {
            energy.assign_zero();
            q.as_ref().iter().zip(gradient.as_ref()).for_each(|(q, u)| energy.add_product(q, u));
            energy.subtract(rate);
            energy.divide_integer(2);
        } else {
            potential.update(q.as_ref());
            potential.energy(q.as_ref(), energy, scratch);
        }
        energy.add(kinetic_energy);
        refuse_overflow(q.as_ref(), energy);
    }

    fn assign_energies_at(&mut self, q: &[N], p: &[N], energy: &mut N, kinetic_energy: &mut N) {
        let Motion { potential, kinetic, scratch, kinetic_scratch, .. } = self;
        assign_energies(potential, kinetic, (q, p), (scratch, kinetic_scratch), (energy, kinetic_energy));
    }

    fn energy(&mut self) -> N {
        Motion::energy(self)
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Keeps the rate of the last gradient: an augmented step would have to evaluate that gradient again.
    fn before_augmented_step(&mut self, follows: bool) {
        self.keeps_rate = follows;
    }
}
