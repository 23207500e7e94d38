//! Hamiltonians of three parts and more: H = H_1 + H_2 + … + H_n, each with a flow that has a formula.
//!
//! A step is the composition of the basic map φ_n ∘ … ∘ φ_2 ∘ φ_1 and its adjoint that a scheme for two parts is (R. I.
//! McLachlan, SIAM J. Sci. Comput. 16 (1995) 151): H_1 flows where the scheme has kicks, H_n where it has drifts, and
//! the others between them. The order for n parts is that for every A + B;
//! [`for_many_parts`](crate::steps::tables::TableScheme::for_many_parts) and `#[splitting_scheme("…", parts = 3)]`
//! prove it by the words on three letters.
//!
//! A scheme with an inner scheme (`shadowstep_schemes::inner`) has multiple time steps, for three parts: slow forces,
//! fast forces and T.
//!
//! The flows, found from the formula of each part, exactly; β grows by ∫(qᵀA_q + pᵀA_p − 2A) dt:
//!
//! | part A | flow over t | increment of β |
//! | --- | --- | --- |
//! | a function of variables none of which is the momentum of another: T(p), U(q), x p_y | partners change by ±t A_x | t (xᵀA_x − 2A) |
//! | a quadratic form ½xᵀSx in x = (q, p), at most 64 coordinates | e^{tJS}, once for each t | 0 |
//! | f(I), I = ½(a q² + 2b q p + c p²) > 0 of one pair | a rotation by f′(I) √(ac − b²) t | t (2I f′ − 2f) |
//! | f(q p) of one pair | q e^{t f′}, p e^{−t f′} | t (2q p f′ − 2f) |
//! | c q^α p^β of one pair, α ≠ β whole numbers | q y^β, p y^{−α}, y^{β−α} = 1 + (β − α) t A/(q p) | t (α + β − 2) A |
//! | any [`Potential`](crate::Potential) or [`Kinetic`](crate::Kinetic): [`OfPotential`], [`OfKinetic`] | p − t U_q, q + t T_p | as above |
//! | p²/(2m) − κ/r | [Kepler's](crate::systems::kepler_drift) | 3κ ∫dt/r |
//! | sums of these in different coordinates | all of them | the sum |
//!
//! ```
//! use shadowstep::systems::many_parts::{SystemOfParts, parts};
//! use shadowstep::{Stepper, System, exact, tables};
//!
//! // a charged particle in a magnetic field and a potential
//! let formulas = ["(px^2 + py^2)/2", "b*(x*py - y*px)/2 + b^2*(x^2 + y^2)/8", "cos(x) + cos(y)"];
//! let field = [("b", exact("1/2")?)];
//! let parts = parts::<f64>(&formulas, (&["x", "y"], &["px", "py"]), &field, &())?;
//! let mut system = SystemOfParts::new(parts, &[0.3, 0.1], &[0.5, -0.2])?;
//! let before = system.energy();
//! let stepper = Stepper::new(tables::shipped("yoshida4").unwrap().for_many_parts()?, "1/20")?;
//! for _ in 0..1000 {
//!     stepper.step(&mut system);
//! }
//! assert!((system.energy() - before).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "formulas")]
mod action;
#[cfg(feature = "formulas")]
mod commuting;
#[cfg(feature = "formulas")]
mod formula;
mod functions;
#[cfg(feature = "formulas")]
mod kepler;
#[cfg(feature = "formulas")]
mod monomial;
mod part;
#[cfg(feature = "formulas")]
mod quadratic;

#[cfg(feature = "formulas")]
pub use formula::{FormulaPart, PartError, PartFormula, parts};
pub use functions::{OfKinetic, OfPotential};
pub use part::{FlowState, Part};

use crate::number::Number;
use crate::systems::increments::Carried;
use crate::systems::maps::PartOrder;
use crate::systems::motion::{MotionError, check};
use crate::systems::state::{State, VectorState};
use crate::systems::summation::Compensated;
use crate::systems::system::System;

/// The class of H = H_1 + … + H_n. Schemes for two parts do not advance its systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ManyParts {}

/// A system of parts whose flows are known, at a state.
pub struct SystemOfParts<N> {
    parts: Vec<Box<dyn Part<N>>>,
    state: VectorState<N>,
    /// The part that flowed last, if the state has not been changed otherwise.
    last: Option<usize>,
    /// Whether what each part evaluated last is that of the state.
    current: Vec<bool>,
    /// Which parts are functions of q only.
    potentials: Vec<bool>,
    /// Momenta times a number near 1.
    scaled: Vec<N>,
}

impl<N: Number> SystemOfParts<N> {
    /// The system at q, p.
    ///
    /// # Errors
    /// No coordinates, or not as many momenta; numbers of q and p of different precision; an infinite q or p, or one
    /// that is NaN.
    ///
    /// # Panics
    /// For fewer than two parts.
    pub fn new(parts: Vec<Box<dyn Part<N>>>, q: &[N], p: &[N]) -> Result<Self, MotionError> {
        assert!(parts.len() >= 2, "H has two parts at least");
        let context = check(q.len(), None, q, p)?;
        Ok(SystemOfParts {
            current: vec![false; parts.len()],
            potentials: parts.iter().map(|part| part.is_potential(q.len())).collect(),
            parts,
            state: State::new(q.to_vec(), p.to_vec(), &context).compensated_if(false),
            last: None,
            scaled: p.to_vec(),
        })
    }

    /// The same system with [compensated sums](crate::systems::summation::Compensated) if `compensated` is true, else
    /// with plain ones: the round-off of a flow is ε times the increment, in place of ε times the coordinate.
    #[must_use]
    pub fn compensated_if(mut self, compensated: bool) -> Self {
        self.state = self.state.compensated_if(compensated);
        self
    }

    /// The flow of a part.
    fn flow(&mut self, index: usize, time: &N, carried: Carried) {
        let continues = self.current[index];
        if index == 0 && !continues {
            self.state.count_evaluation();
        }
        self.parts[index].flow(time, &mut FlowState::new(&mut self.state, carried), continues);
        self.last = Some(index);
        let is_potential = self.potentials[index];
        let others = self.current.iter_mut().zip(&self.potentials);
        others.for_each(|(current, potential)| *current &= is_potential && *potential);
        self.current[index] = true;
    }
}

/// H, the sum of the parts, at a state.
fn sum<N: Number>(parts: &mut [Box<dyn Part<N>>], q: &[N], p: &[N]) -> N {
    let mut energy = N::zero(&q[0].context());
    parts.iter_mut().for_each(|part| part.add_energy(q, p, &mut energy));
    energy
}

impl<N: Number> System for SystemOfParts<N> {
    type Number = N;
    type Class = ManyParts;
    type Coordinates = Vec<N>;
    type Summation = Option<Compensated<N, Vec<N>>>;

    fn state(&self) -> &VectorState<N> {
        &self.state
    }

    fn state_mut(&mut self) -> &mut VectorState<N> {
        self.last = None;
        self.current.fill(false);
        &mut self.state
    }

    fn clear_increments(&mut self) {
        self.state.clear_increments();
    }

    fn kick(&mut self, weight: &N, carried: Carried) {
        self.flow(0, weight, carried);
    }

    /// # Panics
    /// If a scheme with an inner scheme advances more than three parts: it alone has H_2 next before H_n then.
    fn drift(&mut self, weight: &N, carried: Carried) {
        let count = self.parts.len();
        assert!(
            count <= 3 || self.last != Some(1),
            "an inner scheme is for H of three parts, and this one has {count}"
        );
        self.flow(self.parts.len() - 1, weight, carried);
    }

    fn middle_parts(&mut self, weight: &N, order: PartOrder, carried: Carried) {
        let middle = 1..self.parts.len() - 1;
        match order {
            PartOrder::Ascending => middle.for_each(|index| self.flow(index, weight, carried)),
            PartOrder::Descending => middle.rev().for_each(|index| self.flow(index, weight, carried)),
        }
    }

    fn assign_energy(&mut self, at: Option<(&[N], &[N])>, energy: &mut N) {
        let SystemOfParts { parts, state, .. } = self;
        let (q, p) = at.unwrap_or((&state.q, &state.p));
        energy.assign(&sum(parts, q, p));
    }

    /// `kinetic` ← |½ pᵀH_p|, which is T for a quadratic T(p) + U(q), and does not depend on constants in H. It is a
    /// difference of H at momenta that are 1/1024 longer and shorter: the monitor needs its size only.
    fn assign_kinetic_energy(&mut self, at: Option<(&[N], &[N])>, kinetic: &mut N) {
        const PARTS: i32 = 1024;
        let SystemOfParts { parts, state, scaled, .. } = self;
        let (q, p) = at.unwrap_or((&state.q, &state.p));
        let [mut shorter, mut longer] = [PARTS - 1, PARTS + 1].map(|by| {
            for (scaled, p) in scaled.iter_mut().zip(p) {
                scaled.assign(p);
                scaled.multiply_integer(by);
                scaled.divide_integer(PARTS);
            }
            sum(parts, q, scaled)
        });
        // 2/PARTS of pᵀH_p, of which a half is wanted
        longer.subtract(&shorter);
        longer.multiply_integer(PARTS / 4);
        shorter.assign_square(&longer);
        kinetic.assign_sqrt(&shorter);
    }
}
