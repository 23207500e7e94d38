//! Gradients backwards: of a function of the end state by the state at the beginning, with steps back.

use super::vectors::{set_vector, vector};
use crate::number::{Dual, Number};
use crate::steps::integrator::Integrator;
use crate::systems::increments::Carried;

/// A covector (∂L/∂q, ∂L/∂p).
pub type Covector<N> = (Vec<N>, Vec<N>);

/// ∂L/∂(q, p) at the beginning, of a function L of the state after `count` steps: the integrator makes these steps, `at_end` gives ∂L/∂(q, p) at its end state,
/// and as many steps back take that to the beginning, where the integrator is then.
///
/// The memory does not grow with the steps, and the derivatives by all q and p cost one vector: as the tangent map M of the steps is symplectic, Mᵀ = J M⁻¹ J⁻¹
/// with J = (0, 1; −1, 0), and M⁻¹ is the tangent map of the steps back. They make the states of the steps up to round-off, so that on chaotic trajectories
/// the gradient is as uncertain as the states; more digits help.
///
/// Gradient kicks by displaced forces are not exactly symplectic, nor is then the gradient exact.
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
    let state = integrator.state();
    let values = |numbers: &[Dual<N>]| numbers.iter().map(|x| x.value.clone()).collect::<Vec<_>>();
    let (mut of_q, mut of_p) = at_end(&values(state.q()), &values(state.p()));
    assert_eq!(
        (of_q.len(), of_p.len()),
        (state.q().len(), state.p().len()),
        "a covector has the dimension of the state"
    );
    // J⁻¹ λ = (−λ_p, λ_q)
    of_p.iter_mut().for_each(N::negate);
    of_p.append(&mut of_q);
    set_vector(integrator.system().state_mut(), 0, &of_p);
    (0..count).for_each(|_| integrator.step_back(Carried::Nothing));
    let mut of_p = vector(integrator.state(), 0);
    let of_q = of_p.split_off(integrator.state().q().len());
    of_p.iter_mut().for_each(N::negate);
    (of_q, of_p)
}
