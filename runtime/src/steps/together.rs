//! The loop over the states of what is advanced together: a system, several in turns, lanes, a system beside its
//! derivatives.

use crate::steps::integrator::Integrator;
use crate::systems::increments::Carried;

/// What is advanced together: an [`Integrator`], or several systems.
pub trait Together {
    /// Makes this number of steps, each of which carries this along.
    fn advance(&mut self, steps: u64, carried: Carried);
}

impl<I: Integrator + ?Sized> Together for I {
    fn advance(&mut self, steps: u64, carried: Carried) {
        match carried {
            Carried::Nothing => self.steps(steps),
            carried => (0..steps).for_each(|_| self.step(carried)),
        }
    }
}

/// Shows the state 0, which is the present one, and then others up to the last one; `see` takes the number of a state,
/// and says which is the next one to be shown, and what the steps to it carry along.
///
/// ```
/// use shadowstep::steps::together::follow;
/// use shadowstep::{Carried, Integrator, Motion, Stepper, UnitMasses, problems::Pendulum, tables::shipped};
///
/// let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/10")?;
/// let mut pendulum = stepper.with(Motion::new(Pendulum, UnitMasses, vec![0.0], vec![1.0])?);
/// let mut largest = 0.0_f64;
/// follow(&mut pendulum, 1000, |n, pendulum| {
///     largest = largest.max(pendulum.state().q()[0]);
///     // every tenth state, as long as it is finite
///     if largest.is_finite() { Ok((n + 10, Carried::Nothing)) } else { Err(n) }
/// })
/// .expect("all are finite");
/// assert!((1.0..1.05).contains(&largest));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of `see`, which end it.
pub fn follow<T: Together + ?Sized, E>(
    together: &mut T,
    last: u64,
    mut see: impl FnMut(u64, &mut T) -> Result<(u64, Carried), E>,
) -> Result<(), E> {
    let mut n = 0;
    loop {
        let (next, carried) = see(n, together)?;
        if n == last {
            return Ok(());
        }
        let next = next.min(last);
        together.advance(next - n, carried);
        n = next;
    }
}
