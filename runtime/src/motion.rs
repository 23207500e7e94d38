//! The system of a potential and a kinetic energy, with its state.

use thiserror::Error;

use crate::kinetic::{Kinetic, MassError};
use crate::number::Number;
use crate::potential::Potential;
use crate::system::{Increments, System};

/// Holds the coordinates of a state: an array `[N; D]`, or a `Vec<N>` or `Box<[N]>` where the dimension is known at run
/// time only.
pub trait Coordinates<N>: AsRef<[N]> + AsMut<[N]> + Clone {}

impl<N, V: AsRef<[N]> + AsMut<[N]> + Clone> Coordinates<N> for V {}

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
#[derive(Clone, Debug)]
pub struct Motion<N, V, P, K> {
    potential: P,
    kinetic: K,
    q: V,
    p: V,
    increments: Increments<N>,
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
        let dimension = q.as_ref().len();
        let zero = N::zero(&context);
        let mut scratch = vec![zero.clone(); potential.scratch()];
        potential.prepare(&mut scratch, &context);
        let mut kinetic_scratch = vec![zero.clone(); kinetic.scratch()];
        kinetic.prepare(&mut kinetic_scratch, &context);
        Ok(Motion {
            scratch,
            kinetic_scratch,
            gradient: p.clone(),
            rate: zero,
            increments: Increments::zero(dimension, &context),
            kept: Kept::Nothing,
            keeps_rate: false,
            evaluations: 0,
            potential,
            kinetic,
            q,
            p,
        })
    }

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
    pub fn increments(&self) -> &Increments<N> {
        &self.increments
    }

    /// Positions, to be changed; the kept gradient is dropped.
    pub fn q_mut(&mut self) -> &mut [N] {
        self.kept = Kept::Nothing;
        self.q.as_mut()
    }

    /// Momenta, to be changed.
    pub fn p_mut(&mut self) -> &mut [N] {
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
        self.increments.beta.is_finite() && self.q().iter().chain(self.p()).all(Number::is_finite)
    }

    #[inline]
    fn kick_with_kept_gradient(&mut self, weight: &N) {
        for (p, gradient) in self.p.as_mut().iter_mut().zip(self.gradient.as_ref()) {
            p.subtract_product(weight, gradient);
        }
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
    if energy.is_finite() && !q.iter().all(N::has_finite_square) {
        energy.assign_zero();
        let zero = energy.clone();
        energy.divide(&zero);
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
    /// A mass is not valid.
    #[error(transparent)]
    Masses(#[from] MassError),
}

impl<N, V, P, K> System for Motion<N, V, P, K>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    type Number = N;
    type Class = K::Class;

    fn q(&self) -> &[N] {
        self.q.as_ref()
    }

    fn p(&self) -> &[N] {
        self.p.as_ref()
    }

    fn increments(&self) -> &Increments<N> {
        &self.increments
    }

    fn set_state(&mut self, q: &[N], p: &[N]) {
        self.q_mut().iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        self.p_mut().iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
    }

    #[inline]
    fn kick(&mut self, weight: &N) {
        if self.kept == Kept::Nothing {
            self.evaluate(self.keeps_rate);
        }
        self.kick_with_kept_gradient(weight);
    }

    #[inline]
    fn kick_augmented(&mut self, weight: &N) {
        if self.kept != Kept::GradientAndRate {
            self.evaluate(true);
        }
        self.kick_with_kept_gradient(weight);
        self.increments.beta.add_product(weight, &self.rate);
        for (increment, gradient) in self.increments.p.iter_mut().zip(self.gradient.as_ref()) {
            increment.subtract_product(weight, gradient);
        }
    }

    #[inline]
    fn drift(&mut self, weight: &N) {
        self.kinetic.drift(weight, self.p.as_ref(), self.q.as_mut(), &mut self.kinetic_scratch);
        self.kept = Kept::Nothing;
    }

    #[inline]
    fn drift_augmented(&mut self, weight: &N) {
        let (p, q, increments) = (self.p.as_ref(), self.q.as_mut(), &mut self.increments);
        self.kinetic.drift_augmented(weight, p, q, &mut increments.beta, &mut self.kinetic_scratch);
        if increments.has_vectors() {
            self.kinetic.drift(weight, p, &mut increments.q, &mut self.kinetic_scratch);
        }
        self.kept = Kept::Nothing;
    }

    #[inline]
    fn clear_increments(&mut self) {
        self.increments.assign_zero();
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
