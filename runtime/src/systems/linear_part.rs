//! Oscillations solved exactly: H = A + B with A = ½pᵀM⁻¹p + ½qᵀKq, and B = U(q) − ½qᵀKq.
//!
//! With T(p) and U(q) as parts a step must resolve the fastest oscillation: hω has a limit, and there are resonances at
//! hω = mπ below it. Here the drift is the exact flow of all oscillations, of any frequency, and a kick is by what is
//! left of the force. K may be any symmetric matrix, as B is the rest of U; mostly it is U_qq at the equilibrium. The
//! flow of a quadratic form adds nothing to β; a kick adds qᵀB_q − 2B = qᵀU_q − 2U times its weight: that of U itself,
//! as of ½qᵀKq it is 0.
//!
//! Source: Deuflhard, Z. Angew. Math. Phys. 30 (1979) 177; Hairer, Lubich & Wanner, Geometric Numerical Integration,
//! chapter XIII, where this is the method without filters: its own resonances are at h(ω_i ± ω_j ± …) = 2πm.

mod rotation;

use crate::Rational;
use crate::number::{CorrectlyRounded, Number};
use crate::systems::displaced::Displacements;
use crate::systems::gradient_kicks::{Curvature, GradientKicks, Place};
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::{DiagonalMasses, Kinetic, Quadratic};
use crate::systems::matrix::precision;
use crate::systems::motion::MotionError;
use crate::systems::potential::Potential;
use crate::systems::state::{State, VectorState};
use crate::systems::summation::{Compensated, Half};
use crate::systems::system::System;
use rotation::Rotations;

/// A system with a linear part that drifts solve exactly, at a state.
///
/// ```
/// use shadowstep::systems::linear_part::LinearPart;
/// use shadowstep::problems::HenonHeiles;
/// use shadowstep::{Stepper, System, exact, tables};
///
/// // two oscillators with ω = 1, and x²y − y³/3
/// let [zero, one] = ["0", "1"].map(|text| exact(text).unwrap());
/// let stiffness = [vec![one.clone(), zero.clone()], vec![zero, one.clone()]];
/// let mut system = LinearPart::new(HenonHeiles, &[one.clone(), one], &stiffness, &[0.1, 0.0], &[0.0, 0.1])?;
/// let before = system.energy();
/// let stepper = Stepper::new(tables::shipped("stormer-verlet").unwrap(), "3")?; // hω = 3, above the limit of T(p) and U(q)
/// for _ in 0..1000 {
///     stepper.step(&mut system);
/// }
/// assert!((system.energy() / before - 1.0).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct LinearPart<N, P> {
    potential: P,
    scratch: Vec<N>,
    stiffness: Vec<Vec<N>>,
    kinetic: DiagonalMasses<N>,
    rotations: Rotations<N>,
    state: VectorState<N>,
    /// B_q and qᵀB_q − 2B
    gradient: Vec<N>,
    rate: N,
    kept: bool,
    /// Once there was a gradient kick, with the potential's scratch space; what it keeps belongs to the q of the last
    /// evaluation.
    gradient_kicks: Option<Box<(GradientKicks<N>, Vec<N>)>>,
    scratch_of_kinetic: Vec<N>,
    /// T of an energy.
    kinetic_energy: N,
}

impl<N: CorrectlyRounded, P: Potential<N>> LinearPart<N, P> {
    /// The system at q, p, with the masses of the coordinates and K, row by row; the flow is computed in more digits
    /// than the numbers have, and rounded once.
    ///
    /// # Errors
    /// q, p, the masses, K and the potential that do not have the same dimension, at least 1; masses that are not
    /// positive; an infinite q or p, or one that is NaN; numbers of more than
    /// [`QUADRATIC_FLOW_DIGITS`](crate::systems::QUADRATIC_FLOW_DIGITS).
    pub fn new(
        potential: P,
        masses: &[Rational],
        stiffness: &[Vec<Rational>],
        q: &[N],
        p: &[N],
    ) -> Result<Self, MotionError> {
        let coordinates = q.len();
        let dimension = potential.dimension();
        if coordinates == 0 {
            return Err(MotionError::NoCoordinates);
        }
        if p.len() != coordinates {
            return Err(MotionError::Momenta { coordinates, momenta: p.len() });
        }
        if dimension != coordinates {
            return Err(MotionError::Potential { coordinates, dimension });
        }
        let rows = stiffness.iter().map(Vec::len).chain([masses.len(), stiffness.len()]);
        if let Some(dimension) = rows.into_iter().find(|found| *found != coordinates) {
            return Err(MotionError::Kinetic { coordinates, dimension });
        }
        MotionError::refuse_not_finite(q, p)?;
        let context = q[0].context();
        if precision::<N>(&context).is_none() {
            return Err(MotionError::Digits);
        }
        let kinetic = DiagonalMasses::new(masses, &context)?;
        let of_kinetic = Kinetic::<N>::scratch(&kinetic);
        let zero = N::zero(&context);
        let mut scratch = vec![zero.clone(); potential.scratch()];
        potential.prepare(&mut scratch, &context);
        Ok(LinearPart {
            potential,
            scratch,
            rotations: Rotations::new(masses, stiffness, &context),
            kinetic,
            stiffness: stiffness
                .iter()
                .map(|row| row.iter().map(|k| N::from_rational(k, &context)).collect())
                .collect(),
            state: State::new(q.to_vec(), p.to_vec(), &context).compensated_if(false),
            gradient: vec![zero.clone(); coordinates],
            rate: zero.clone(),
            kept: false,
            gradient_kicks: None,
            scratch_of_kinetic: vec![zero.clone(); of_kinetic],
            kinetic_energy: zero,
        })
    }

    /// The same system with [compensated sums](crate::systems::summation::Compensated) if `compensated` is true, else
    /// with plain ones: the round-off of a kick or drift is ε times the increment, in place of ε times the coordinate.
    #[must_use]
    pub fn compensated_if(mut self, compensated: bool) -> Self {
        self.state = self.state.compensated_if(compensated);
        self
    }

    /// The same system with gradient kicks by displaced forces, of the stepper that computed these: see
    /// [`Displacements`].
    #[must_use]
    pub fn displaced(mut self, displacements: Displacements<N>) -> Self {
        let (dimension, context) = (self.state.q.len(), self.state.context());
        let kicks = GradientKicks::new(dimension, Some(displacements), &context);
        self.gradient_kicks = Some(Box::new((kicks, Vec::new())));
        self
    }

    /// B_q = U_q − Kq and the rate of β, which is that of U.
    fn evaluate(&mut self) {
        if self.kept {
            return;
        }
        let LinearPart { potential, scratch, stiffness, state, gradient, rate, .. } = self;
        potential.update(&state.q);
        potential.gradient_and_rate(&state.q, gradient, rate, scratch);
        for (gradient, row) in gradient.iter_mut().zip(stiffness) {
            row.iter().zip(&state.q).for_each(|(k, q)| gradient.subtract_product(k, q));
        }
        self.kept = true;
        self.state.count_evaluation();
        if let Some(curved) = &mut self.gradient_kicks {
            curved.0.kept = KeptForce::Nothing;
        }
    }
}

/// Room for gradient kicks, and the scratch space of the potential for them.
fn room<N: Number, P: Potential<N>>(potential: &P, context: &N::Context) -> (GradientKicks<N>, Vec<N>) {
    let hessian = potential.hessian().expect(
        "gradient kicks need the Hessian–vector product of the potential: write it as a formula, or implement \
            `Potential::hessian`",
    );
    let mut scratch = vec![N::zero(context); hessian.hessian_scratch()];
    hessian.prepare_hessian(&mut scratch, context);
    (GradientKicks::new(potential.dimension(), None, context), scratch)
}

/// The derivatives of B = U(q) − ½qᵀKq.
struct RemainingPotential<'a, N, P> {
    potential: &'a mut P,
    scratch: &'a mut [N],
    stiffness: &'a [Vec<N>],
    kinetic: &'a DiagonalMasses<N>,
    hessian_scratch: &'a mut [N],
}

impl<N: Number, P: Potential<N>> RemainingPotential<'_, N, P> {
    /// x ← x − Kv
    fn subtract_linear_part(&self, v: &[N], x: &mut [N]) {
        for (x, row) in x.iter_mut().zip(self.stiffness) {
            row.iter().zip(v).for_each(|(k, v)| x.subtract_product(k, v));
        }
    }
}

impl<N: Number, P: Potential<N>> Curvature<N> for RemainingPotential<'_, N, P> {
    fn assign_velocity(&mut self, gradient: &[N], velocity: &mut [N]) {
        self.kinetic.assign_velocity(gradient, velocity);
    }

    /// The rate is that of U: the quadratic form adds nothing.
    fn hessian_product(&mut self, at: Place<'_, N>, v: &[N], product: &mut [N], rate: Option<&mut N>) {
        let hessian = self.potential.hessian().expect("it was there before");
        match rate {
            Some(rate) => hessian.hessian_product_and_rate(at.q, v, product, rate, self.hessian_scratch),
            None => hessian.hessian_product(at.q, v, product, self.hessian_scratch),
        }
        self.subtract_linear_part(v, product);
    }

    fn gradient(&mut self, q: &[N], gradient: &mut [N], rate: Option<&mut N>) {
        self.potential.update(q);
        match rate {
            Some(rate) => self.potential.gradient_and_rate(q, gradient, rate, self.scratch),
            None => self.potential.gradient(q, gradient, self.scratch),
        }
        self.subtract_linear_part(q, gradient);
    }
}

impl<N: CorrectlyRounded, P: Potential<N>> System for LinearPart<N, P> {
    type Number = N;
    /// A = ½pᵀM⁻¹p + f(q), and B depends on q only.
    type Class = Quadratic;
    type Coordinates = Vec<N>;
    type Summation = Option<Compensated<N, Vec<N>>>;

    fn state(&self) -> &VectorState<N> {
        &self.state
    }

    fn state_mut(&mut self) -> &mut VectorState<N> {
        self.kept = false;
        &mut self.state
    }

    fn clear_increments(&mut self) {
        self.state.clear_increments();
    }

    fn kick(&mut self, weight: &N, carried: Carried) {
        self.evaluate();
        match carried.has_increments() {
            true => self.state.kick_augmented(weight, &self.gradient, &self.rate),
            false => self.state.kick(weight, &self.gradient),
        }
    }

    fn drift(&mut self, weight: &N, carried: Carried) {
        let LinearPart { state, rotations, .. } = self;
        let (to_q, to_p) = rotations.increments(weight, &state.q, &state.p);
        for (half, increments) in [(Half::Positions, to_q), (Half::Momenta, to_p)] {
            for (index, by) in increments.iter().enumerate() {
                state.change(half, index, carried, |x| x.add(by));
            }
        }
        self.kept = false;
    }

    fn has_gradient_kicks(&self) -> bool {
        let is_displaced = self.gradient_kicks.as_ref().is_some_and(|curved| curved.0.is_displaced());
        is_displaced || self.potential.hessian().is_some()
    }

    /// The gradient kick p ← p + weight·B_qq M⁻¹B_q: ½qᵀKq as a part of A commutes with B.
    fn gradient_kick(&mut self, weight: &N, carried: Carried) {
        self.evaluate();
        let LinearPart { potential, scratch, stiffness, kinetic, state, gradient, rate, .. } = self;
        let curved = self.gradient_kicks.get_or_insert_with(|| Box::new(room(potential, &weight.context())));
        let (kicks, hessian_scratch) = &mut **curved;
        let before = kicks.evaluations;
        let rest = &mut RemainingPotential { potential, scratch, stiffness, kinetic, hessian_scratch };
        let augmented = carried.has_increments();
        kicks.evaluate(rest, Place { q: &state.q, gradient, rate }, weight, augmented);
        if kicks.is_displaced() {
            state.evaluations += kicks.evaluations - before;
        }
        match augmented {
            true => state.kick_augmented(weight, &kicks.force, &kicks.rate),
            false => state.kick(weight, &kicks.force),
        }
    }

    fn assign_energy(&mut self, at: Option<(&[N], &[N])>, energy: &mut N) {
        let (q, p) = at.unwrap_or((&self.state.q, &self.state.p));
        self.potential.update(q);
        self.potential.energy(q, energy, &mut self.scratch);
        Kinetic::energy(&self.kinetic, p, &mut self.kinetic_energy, &mut self.scratch_of_kinetic);
        energy.add(&self.kinetic_energy);
        self.kept &= at.is_none();
    }

    fn assign_kinetic_energy(&mut self, at: Option<(&[N], &[N])>, kinetic: &mut N) {
        let (_, p) = at.unwrap_or((&self.state.q, &self.state.p));
        Kinetic::energy(&self.kinetic, p, kinetic, &mut self.scratch_of_kinetic);
    }
}
