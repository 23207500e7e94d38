//! Gradients backwards: of a function of states by the state at the beginning and by parameters, with steps back.

use super::vectors::{set_vector, vector};
use crate::number::{Dual, Number};
use crate::steps::integrator::{Integrator, at_output};
use crate::systems::increments::Carried;
use crate::systems::state::Saved;
use crate::systems::summation::Remainders;

/// A covector (∂L/∂q, ∂L/∂p).
pub type Covector<N> = (Vec<N>, Vec<N>);

/// The derivatives λ = ∂L/∂(q, p) of a function L of states of a trajectory by the present state, which go backwards
/// along it: λ ← DΦᵀ λ with each step back, and derivatives by parameters, ∂L/∂θ ← ∂L/∂θ + λ·∂Φ/∂θ.
///
/// The memory does not grow with the steps, and the derivatives by all q and p cost one vector: as the tangent map M of
/// a step is symplectic, Mᵀ = J M⁻¹ J⁻¹ with J = (0, 1; −1, 0), and M⁻¹ is the tangent map of the step back. A
/// parameter costs one vector more: with z = Φ⁻¹(Φ(z)), DΦ⁻¹ ∂Φ/∂θ = −∂Φ⁻¹/∂θ.
///
/// Steps back make the states of the steps up to round-off, so that on chaotic trajectories the gradient is as
/// uncertain as the states; more digits help. In [fixed point](crate::Motion::fixed_point) they make them to the last
/// bit, and the gradient is that of the steps whatever their number. Gradient kicks by displaced forces are not exactly
/// symplectic, nor are then the gradients exact.
#[derive(Debug)]
pub struct Adjoint<I: Integrator> {
    /// Its vector is J⁻¹ λ = (−λ_p, λ_q).
    integrator: I,
    parameters: Vec<Parameter<I>>,
}

#[derive(Debug)]
struct Parameter<I: Integrator> {
    /// Its constants have the derivatives by the parameter.
    integrator: I,
    /// ∂L/∂θ, by the steps so far.
    sum: I::Number,
}

impl<I, N> Adjoint<I>
where
    N: Number,
    I: Integrator<Number = Dual<N>>,
{
    /// λ = 0 at the present state of an integrator.
    pub fn new(mut integrator: I) -> Self {
        clear(&mut integrator);
        Adjoint { integrator, parameters: Vec::new() }
    }

    /// Derivatives by a parameter, too: by an integrator for the same steps, whose constants have the derivatives by
    /// it: see [`with_parameter`](crate::number::with_parameter).
    pub fn add_parameter(&mut self, integrator: I) {
        let sum = Dual::zero(&self.integrator.state().context());
        self.parameters.push(Parameter { integrator, sum });
    }

    /// λ = ∂L/∂(q, p) at the present state, of processed schemes at that of the kernel.
    pub fn covector(&self) -> Covector<N> {
        covector(&self.integrator)
    }

    /// The derivatives of L by the parameters, in the order in which these were added.
    pub fn by_parameters(&self) -> Vec<N> {
        self.parameters.iter().map(|parameter| parameter.sum.value.clone()).collect()
    }

    /// The integrator, at the present state.
    pub fn integrator(&mut self) -> &mut I {
        &mut self.integrator
    }

    /// λ ← λ + the derivatives of L by the present state as it is output: for processed schemes after the post-map.
    ///
    /// # Panics
    /// Covectors of another dimension than the state.
    pub fn add(&mut self, (of_q, of_p): &Covector<N>) {
        let state = self.integrator.state();
        assert_eq!(
            (of_q.len(), of_p.len()),
            (state.q().len(), state.p().len()),
            "a covector has the dimension of the state"
        );
        let mut turned: Vec<N> = of_p.iter().chain(of_q).cloned().collect();
        turned[..of_p.len()].iter_mut().for_each(N::negate);
        if self.integrator.is_processed() {
            self.set_states();
            self.parameters.iter_mut().for_each(|parameter| parameter.add_of_output((of_q, of_p)));
        }
        let mut sum = vector(self.integrator.state(), 0);
        if self.integrator.is_processed() {
            let saved = Saved::of(self.integrator.state());
            self.integrator.postprocess();
            set_vector(self.integrator.system().state_mut(), 0, &turned);
            self.integrator.preprocess();
            turned = vector(self.integrator.state(), 0);
            saved.restore(self.integrator.system().state_mut());
        }
        sum.iter_mut().zip(&turned).for_each(|(sum, own)| sum.add(own));
        set_vector(self.integrator.system().state_mut(), 0, &sum);
    }

    /// The integrators of parameters ← the present state, without derivatives.
    fn set_states(&mut self) {
        let state = self.integrator.state();
        let constants =
            |numbers: &[Dual<N>]| numbers.iter().map(|x| Dual::constant(x.value.clone())).collect::<Vec<_>>();
        for Parameter { integrator, .. } in &mut self.parameters {
            let remainders = state.remainders();
            let own = integrator.system().state_mut();
            own.set(&constants(state.q()), &constants(state.p()));
            own.set_remainders(&Remainders { q: constants(&remainders.q), p: constants(&remainders.p) });
        }
    }

    /// One step back.
    pub fn step_back(&mut self) {
        self.set_states();
        self.integrator.step_back(Carried::Nothing);
        if self.parameters.is_empty() {
            return;
        }
        let (of_q, of_p) = covector(&self.integrator);
        for Parameter { integrator, sum } in &mut self.parameters {
            integrator.step_back(Carried::Nothing);
            let components = integrator.state().q().iter().chain(integrator.state().p());
            let along = components.zip(of_q.iter().chain(&of_p));
            along.for_each(|(x, covector)| sum.value.subtract_product(&x.derivatives[0], covector));
        }
    }
}

impl<I, N> Parameter<I>
where
    N: Number,
    I: Integrator<Number = Dual<N>>,
{
    /// The post-map of a processed scheme depends on the parameter, too.
    fn add_of_output(&mut self, (of_q, of_p): (&[N], &[N])) {
        let saved = Saved::of(self.integrator.state());
        self.integrator.postprocess();
        let along = vector(self.integrator.state(), 0);
        saved.restore(self.integrator.system().state_mut());
        along.iter().zip(of_q.iter().chain(of_p)).for_each(|(x, covector)| self.sum.value.add_product(x, covector));
    }
}

fn clear<N: Number, I: Integrator<Number = Dual<N>>>(integrator: &mut I) {
    let state = integrator.state();
    let zeros = vec![N::zero(&state.context()); 2 * state.q().len()];
    set_vector(integrator.system().state_mut(), 0, &zeros);
}

fn covector<N: Number, I: Integrator<Number = Dual<N>>>(integrator: &I) -> Covector<N> {
    let mut of_p = vector(integrator.state(), 0);
    let of_q = of_p.split_off(integrator.state().q().len());
    of_p.iter_mut().for_each(N::negate);
    (of_q, of_p)
}

/// ∂L/∂(q, p) at the beginning, of a function L of the state after `count` steps: the integrator makes these steps,
/// `at_end` gives ∂L/∂(q, p) at its end state, and as many steps back take that to the beginning, where the integrator
/// is then.
///
/// See [`Adjoint`], which has derivatives by parameters, and of functions of several states.
///
/// ```
/// use shadowstep::prelude::*;
/// use shadowstep::problems::Pendulum;
/// use shadowstep::tangent::{gradient, with_derivatives};
///
/// // L = q(10)
/// let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/10")?;
/// let at = |q: f64| Motion::new(Pendulum, UnitMasses, with_derivatives(&[q], [&[0.0]]), with_derivatives(&[1.0], [&[0.0]]));
/// let (of_q, _) = gradient(&mut stepper.with(at(0.3)?), 100, |_, _| (vec![1.0], vec![0.0]));
///
/// let end = |q: f64| {
///     let mut pendulum = at(q).unwrap();
///     stepper.steps(std::slice::from_mut(&mut pendulum), 100);
///     pendulum.q()[0].value
/// };
/// let difference = (end(0.3 + 1e-6) - end(0.3 - 1e-6)) / 2e-6;
/// assert!((of_q[0] - difference).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Panics
/// Covectors of another dimension than the state.
pub fn gradient<I, N>(integrator: &mut I, count: u64, at_end: impl FnOnce(&[N], &[N]) -> Covector<N>) -> Covector<N>
where
    N: Number,
    I: Integrator<Number = Dual<N>> + ?Sized,
{
    (0..count).for_each(|_| integrator.step(Carried::Nothing));
    let values = |numbers: &[Dual<N>]| numbers.iter().map(|x| x.value.clone()).collect::<Vec<_>>();
    let (q, p) = at_output(integrator, |at| (values(at.state().q()), values(at.state().p())));
    let of_end = at_end(&q, &p);
    let mut adjoint = Adjoint::new(integrator);
    adjoint.add(&of_end);
    (0..count).for_each(|_| adjoint.step_back());
    adjoint.covector()
}
