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
use crate::systems::evaluated::Evaluated;
use crate::systems::gradient_kicks::{GradientKicks, PartOfKicks, Place};
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::{DiagonalMasses, Quadratic};
use crate::systems::matrix::precision;
use crate::systems::motion::{Hamiltonian, MotionError, check};
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
    remainder: Remainder<N, P>,
    rotations: Rotations<N>,
    at: Evaluated<N>,
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
        let context = q.first().ok_or(MotionError::NoCoordinates)?.context();
        let rows = stiffness.iter().map(Vec::len).chain([masses.len(), stiffness.len()]);
        if let Some(dimension) = rows.into_iter().find(|found| *found != q.len()) {
            return Err(MotionError::Kinetic { coordinates: q.len(), dimension });
        }
        if precision::<N>(&context).is_none() {
            return Err(MotionError::Digits);
        }
        let number = |k| N::from_rational(k, &context);
        let kinetic = DiagonalMasses::new(masses, &context)?;
        check(potential.dimension(), None, q, p)?;
        Ok(LinearPart {
            remainder: Remainder {
                hamiltonian: Hamiltonian::new(potential, kinetic, &context),
                stiffness: stiffness.iter().map(|row| row.iter().map(number).collect()).collect(),
            },
            rotations: Rotations::new(masses, stiffness, &context),
            at: Evaluated::new(State::new(q.to_vec(), p.to_vec(), &context).compensated_if(false)),
        })
    }

    /// The same system with [compensated sums](crate::systems::summation::Compensated) if `compensated` is true, else
    /// with plain ones: the round-off of a kick or drift is ε times the increment, in place of ε times the coordinate.
    #[must_use]
    pub fn compensated_if(mut self, compensated: bool) -> Self {
        self.at = self.at.with(|state| state.compensated_if(compensated));
        self
    }

    /// The same system with gradient kicks by displaced forces, of the stepper that computed these: see
    /// [`Displacements`].
    #[must_use]
    pub fn displaced(mut self, displacements: Displacements<N>) -> Self {
        self.remainder.hamiltonian.displace_forces(displacements);
        self
    }

    /// The gradient always comes with the rate, so that an augmented step after a plain one evaluates nothing again.
    fn evaluate(&mut self) {
        if !self.at.kept.suffices(true) {
            self.at.evaluate(&mut self.remainder, true);
        }
    }
}

/// B = U(q) − ½qᵀKq, with T and U.
#[derive(Clone, Debug)]
struct Remainder<N, P> {
    hamiltonian: Hamiltonian<N, P, DiagonalMasses<N>>,
    stiffness: Vec<Vec<N>>,
}

impl<N: Number, P> Remainder<N, P> {
    /// x ← x − Kv
    fn subtract_linear_part(&self, v: &[N], x: &mut [N]) {
        for (x, row) in x.iter_mut().zip(&self.stiffness) {
            row.iter().zip(v).for_each(|(k, v)| x.subtract_product(k, v));
        }
    }
}

/// The rates are those of U: the quadratic form adds nothing.
impl<N: Number, P: Potential<N>> PartOfKicks<N> for Remainder<N, P> {
    fn gradient(&mut self, q: &[N], gradient: &mut [N], rate: Option<&mut N>) {
        self.hamiltonian.gradient(q, gradient, rate);
        self.subtract_linear_part(q, gradient);
    }

    fn assign_velocity(&mut self, gradient: &[N], velocity: &mut [N]) {
        self.hamiltonian.assign_velocity(gradient, velocity);
    }

    fn hessian_product(&mut self, at: Place<'_, N>, v: &[N], product: &mut [N], rate: Option<&mut N>) {
        self.hamiltonian.hessian_product(at, v, product, rate);
        self.subtract_linear_part(v, product);
    }

    fn gradient_kicks(&mut self) -> &mut Option<Box<GradientKicks<N>>> {
        self.hamiltonian.gradient_kicks()
    }
}

impl<N: CorrectlyRounded, P: Potential<N>> System for LinearPart<N, P> {
    type Number = N;
    /// A = ½pᵀM⁻¹p + f(q), and B depends on q only.
    type Class = Quadratic;
    type Coordinates = Vec<N>;
    type Summation = Option<Compensated<N, Vec<N>>>;

    fn state(&self) -> &VectorState<N> {
        &self.at.state
    }

    fn state_mut(&mut self) -> &mut VectorState<N> {
        self.at.state_mut()
    }

    fn clear_increments(&mut self) {
        self.at.state.clear_increments();
    }

    fn kick(&mut self, weight: &N, carried: Carried) {
        self.evaluate();
        self.at.kick(&mut self.remainder, weight, carried);
    }

    fn drift(&mut self, weight: &N, carried: Carried) {
        let state = self.at.state_mut();
        let (to_q, to_p) = self.rotations.increments(weight, state.q(), state.p());
        for (half, increments) in [(Half::Positions, to_q), (Half::Momenta, to_p)] {
            for (index, by) in increments.iter().enumerate() {
                state.change(half, index, carried, |x| x.add(by));
            }
        }
    }

    fn has_gradient_kicks(&self) -> bool {
        self.remainder.hamiltonian.has_gradient_kicks()
    }

    /// The gradient kick p ← p + weight·B_qq M⁻¹B_q: ½qᵀKq as a part of A commutes with B.
    fn gradient_kick(&mut self, weight: &N, carried: Carried) {
        self.evaluate();
        self.at.gradient_kick(&mut self.remainder, weight, carried);
    }

    fn assign_energy(&mut self, at: Option<(&[N], &[N])>, energy: &mut N) {
        if at.is_some() {
            // the potential is then that of another place
            self.at.kept = KeptForce::Nothing;
        }
        let at = at.unwrap_or((self.at.state.q(), self.at.state.p()));
        self.remainder.hamiltonian.assign_energy(at, energy);
    }

    fn assign_kinetic_energy(&mut self, at: Option<(&[N], &[N])>, kinetic: &mut N) {
        let (_, p) = at.unwrap_or((self.at.state.q(), self.at.state.p()));
        self.remainder.hamiltonian.assign_kinetic_energy(p, kinetic);
    }
}
