//! The system of a potential and a kinetic energy, with its state.

mod few;
mod hamiltonian;
mod side_by_side;
mod steps;
mod turns;

use thiserror::Error;

use shadowstep_schemes::symbolic::{Error as FormulaError, exact};

use crate::number::{AnyLimbs, LimbCount, Number, Precision};
use crate::systems::coordinates::{Coordinates, first_not_finite};
use crate::systems::displaced::Displacements;
use crate::systems::evaluated::Evaluated;
use crate::systems::gradient_kicks::are_displaced;
use crate::systems::increments::Increments;
use crate::systems::kinetic::{Kinetic, MassError};
use crate::systems::matrix::QUADRATIC_FLOW_DIGITS;
use crate::systems::potential::Potential;
use crate::systems::state::State;
use crate::systems::summation::{Compensated, FixedPoint, InDouble, Plain, RangeError, Summation};

pub(crate) use hamiltonian::Hamiltonian;

/// A system H = T(p) + U(q) and its state.
///
/// The gradient of the last kick is kept as long as q stays, so that the next step's first kick costs no evaluation.
///
/// `S` is [how increments are added](crate::systems::summation) to q and p: plainly, [compensated](Motion::compensated)
/// or in [fixed point](Motion::fixed_point).
#[derive(Clone, Debug)]
pub struct Motion<N, V, P, K, S = Plain> {
    hamiltonian: Hamiltonian<N, P, K>,
    at: Evaluated<N, V, S>,
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
    /// q, p, the potential and the kinetic energy that do not have the same dimension, at least 1; numbers of q and p
    /// of different precision; an infinite q or p, or one that is NaN; an energy that is, as at a collision. In lanes,
    /// trajectories of finite energy go on without the others.
    pub fn new(potential: P, kinetic: K, q: V, p: V) -> Result<Self, MotionError> {
        let mut motion = Motion::of_any_energy(potential, kinetic, q, p)?;
        if N::LANES > 1 || motion.energy().is_finite() { Ok(motion) } else { Err(MotionError::Energy) }
    }

    /// The system at q, p, where U may be infinite and is not evaluated: for a state that is set later. A run from
    /// there ends with an error, which names the value.
    ///
    /// # Errors
    /// As [`Motion::new`], but for the energy.
    pub fn of_any_energy(potential: P, kinetic: K, q: V, p: V) -> Result<Self, MotionError> {
        let context = check(potential.dimension(), kinetic.dimension(), q.as_ref(), p.as_ref())?;
        let hamiltonian = Hamiltonian::new(potential, kinetic, &context);
        Ok(Motion { hamiltonian, at: Evaluated::new(State::new(q, p, &context)) })
    }

    /// The same system with compensated sums: the round-off of a kick or drift is ε times the increment, in place of ε
    /// times the coordinate, so that it is smaller by a factor like h. See [`Compensated`]; `docs/round-off.md` has
    /// what it gains and costs.
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
        self.with(State::compensated)
    }
}

impl<P, K, const D: usize> Motion<AnyLimbs, [AnyLimbs; D], P, K>
where
    P: Potential<AnyLimbs>,
    K: Kinetic<AnyLimbs>,
{
    /// The system at exact initial values, in numbers of at least this many decimal digits. A value is a formula
    /// without names, such as `2/5`, `0.4` or `sqrt(3)/2`; it is rounded once.
    ///
    /// ```
    /// use shadowstep::{Motion, Number, Real, Stepper, UnitMasses, problems::Kepler, tables::shipped};
    ///
    /// let mut motion = Motion::exact(Kepler, UnitMasses, ["2/5", "0"], ["0", "2"], 120)?;
    /// let stepper = Stepper::with_context(shipped("yoshida4").unwrap(), "1/20", &motion.context())?;
    /// let start = motion.energy();
    /// (0..100).for_each(|_| stepper.step(&mut motion));
    /// (0..100).for_each(|_| stepper.step_back(&mut motion));
    /// let mut error = motion.energy();
    /// error.subtract(&start);
    /// assert!(error.log10_abs() < -118.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Values that are not exact numbers; more digits than 17 limbs hold, 327; as [`Motion::new`].
    pub fn exact(potential: P, kinetic: K, q: [&str; D], p: [&str; D], digits: u32) -> Result<Self, MotionError> {
        let context = Precision::digits(digits).ok().and_then(Precision::limbs);
        let context = context.ok_or(MotionError::NumberOfDigits { digits })?;
        let number = |name: &str, index: usize, text: &str| match exact(text) {
            Ok(value) => Ok(AnyLimbs::from_rational(&value, &context)),
            Err(error) => Err(MotionError::Value { name: format!("{name}{}", index + 1), error }),
        };
        let numbers = |name: &str, texts: [&str; D]| -> Result<[AnyLimbs; D], MotionError> {
            let found: Vec<_> =
                texts.iter().enumerate().map(|(i, text)| number(name, i, text)).collect::<Result<_, _>>()?;
            Ok(found.try_into().expect("there are D of them"))
        };
        Motion::new(potential, kinetic, numbers("q", q)?, numbers("p", p)?)
    }
}

impl<N, V, P, K> Motion<N, V, P, K>
where
    N: InDouble,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    /// The same system in fixed point, of `f64` or its dual numbers: [`Stepper::step_back`](crate::Stepper::step_back)
    /// undoes a step to the last bit. See [`FixedPoint`].
    ///
    /// The ranges are the largest |q_i| and |p_i| that a run may reach; a coordinate that leaves its range by a factor
    /// of 2 becomes NaN. The state is rounded to 2⁻⁶² of the ranges.
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
    ) -> Result<Motion<N, V, P, K, FixedPoint<V>>, RangeError> {
        let sums = FixedPoint::of((&self.at.state.q, &self.at.state.p), (q_ranges, p_ranges))?;
        let mut motion = self.with(|state| state.with_sums(sums));
        motion.at.state.settle();
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
    /// The same system with compensated sums if `compensated` is true, else with plain ones: for a choice at run time.
    #[must_use]
    pub fn compensated_if(self, compensated: bool) -> Motion<N, V, P, K, Option<Compensated<N, V>>> {
        self.with(|state| state.compensated_if(compensated))
    }

    /// The same system with the same state whose sums are other ones.
    fn with<T>(self, with_sums: impl FnOnce(State<N, V, S>) -> State<N, V, T>) -> Motion<N, V, P, K, T> {
        Motion { hamiltonian: self.hamiltonian, at: self.at.with(with_sums) }
    }

    /// The same system with gradient kicks by displaced forces, of the stepper that computed these: see
    /// [`Displacements`]. They take a force in place of a Hessian–vector product, which the potential then need not
    /// have, and are not exactly symplectic.
    ///
    /// ```
    /// use shadowstep::{Motion, Stepper, UnitMasses, systems::potential::from_fn, tables::shipped};
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
        self.hamiltonian.displace_forces(displacements);
        self
    }

    /// The state.
    pub fn state(&self) -> &State<N, V, S> {
        &self.at.state
    }

    /// Positions.
    pub fn q(&self) -> &[N] {
        self.at.state.q()
    }

    /// Momenta.
    pub fn p(&self) -> &[N] {
        self.at.state.p()
    }

    /// What the last augmented step added to β.
    pub fn beta(&self) -> &N {
        &self.at.state.increments.beta
    }

    /// What the last augmented step added to q, p and β.
    #[inline]
    pub fn increments(&self) -> Increments<'_, N> {
        self.at.state.increments()
    }

    /// Positions, to be changed; the kept gradient and remainders of sums are dropped.
    pub fn q_mut(&mut self) -> &mut [N] {
        self.at.state_mut().q_mut()
    }

    /// Momenta, to be changed; remainders of sums are dropped.
    pub fn p_mut(&mut self) -> &mut [N] {
        self.at.state.p_mut()
    }

    /// The potential.
    pub fn potential(&self) -> &P {
        &self.hamiltonian.potential.function
    }

    /// The number of evaluations of the gradient U_q, those at displaced positions included; those of T_p in drifts are
    /// not counted.
    pub fn evaluations(&self) -> u64 {
        self.at.state.evaluations
    }

    /// The number of Hessian–vector products U_qq M⁻¹U_q computed for gradient kicks.
    pub fn hessian_products(&self) -> u64 {
        let kicks = self.hamiltonian.gradient_kicks.as_deref();
        if are_displaced(kicks) { 0 } else { kicks.map_or(0, |kicks| kicks.evaluations) }
    }

    /// The context of the numbers.
    pub fn context(&self) -> N::Context {
        self.at.state.context()
    }

    /// H = T(p) + U(q) at the present state; NaN where squares of distances overflow, a coordinate above 3.8e153 in
    /// `f64`: there a potential such as −1/r would be 0. A potential may renew what it keeps, such as a list of
    /// neighbours, and so needs `&mut`; of a motion that is shared, `motion.clone().energy()` is the same.
    pub fn energy(&mut self) -> N {
        let mut energy = self.beta().clone();
        let state = &self.at.state;
        self.hamiltonian.assign_energy((state.q(), state.p()), &mut energy);
        energy
    }

    /// H = T(p) + U(q) at another state of the same system.
    pub fn energy_at(&mut self, q: &[N], p: &[N]) -> N {
        let mut energy = self.beta().clone();
        self.hamiltonian.assign_energy((q, p), &mut energy);
        energy
    }

    /// Whether every q, p and β is a finite number.
    pub fn is_finite(&self) -> bool {
        self.at.state.is_finite()
    }
}

/// Checks that dimensions and precisions agree, of a potential, of a kinetic energy if it is fixed, and of q and p;
/// returns the context of the numbers.
pub(crate) fn check<N: Number>(
    potential: usize,
    kinetic: Option<usize>,
    q: &[N],
    p: &[N],
) -> Result<N::Context, MotionError> {
    let coordinates = q.len();
    let differs = |other: usize| other != coordinates;
    let momenta = kinetic.unwrap_or(coordinates);
    match () {
        () if coordinates == 0 => Err(MotionError::NoCoordinates),
        () if differs(p.len()) => Err(MotionError::Momenta { coordinates, momenta: p.len() }),
        () if differs(potential) => Err(MotionError::Potential { coordinates, dimension: potential }),
        () if differs(momenta) => Err(MotionError::Kinetic { coordinates, dimension: momenta }),
        () => {
            let context = q[0].context();
            if q.iter().chain(p).any(|x| x.context() != context) {
                return Err(MotionError::Precision);
            }
            match first_not_finite(q, p) {
                Some(name) => Err(MotionError::NotFinite { name }),
                None => Ok(context),
            }
        }
    }
}

/// A state, a potential and a kinetic energy that do not fit together.
#[derive(Clone, PartialEq, Eq, Error)]
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
    /// An initial value is infinite or NaN.
    #[error("the initial value of {name} is not finite")]
    NotFinite {
        /// Such as q1, counted from 1.
        name: String,
    },
    /// H is infinite or NaN at the initial values.
    #[error("the energy is not finite at the initial values; choose other initial values or parameters")]
    Energy,
    /// The numbers have different precisions.
    #[error("the numbers of q and p must have the same precision")]
    Precision,
    /// The numbers have more digits than the flow of a linear part is computed to.
    #[error("a linear part needs numbers of at most {QUADRATIC_FLOW_DIGITS} digits")]
    Digits,
    /// An initial value is not an exact number.
    #[error("{name}: {error}")]
    Value {
        /// Such as q1, counted from 1.
        name: String,
        /// What is wrong with it.
        error: FormulaError,
    },
    /// More digits than 17 limbs hold, or none.
    #[error("the initial values cannot be rounded to {digits} digits: give a number from 1 to \
        {most}", most = Precision::of_bits(LimbCount::MOST.bits()).in_digits())]
    NumberOfDigits {
        /// The digits that were asked for.
        digits: u32,
    },
    /// A mass is not valid.
    #[error(transparent)]
    Masses(#[from] MassError),
}

shadowstep_schemes::debug_as_text!(MotionError);
