//! Momenta at the times of the positions, from the momenta of leapfrog between them.

use super::error::RecordedError;
use crate::number::Number;
use crate::steps::step_size::StepSize;

/// The momenta p_n = ½(p_{n−1/2} + p_{n+1/2}) of the states n = 0, 1, … from the momenta of leapfrog, which are half a
/// step before and after.
///
/// In leapfrog p_{n+1/2} = p_{n−1/2} − h U_q(q_n), so that p_{n±1/2} = p_n ∓ ½h U_q(q_n) with p_n of velocity Verlet:
/// the two make the same trajectory, and the mean is its p_n exactly, not an approximation. `half_steps` has a row more
/// than there are states, that before the first state included; where that is not known, leave the first state out.
///
/// ```
/// use shadowstep::shadow::recorded::integer_momenta;
///
/// let p = integer_momenta(1, 2, &[1.0, 0.5, -0.5])?;
/// assert_eq!(p, [0.75, 0.0]);
/// # Ok::<(), shadowstep::shadow::recorded::RecordedError>(())
/// ```
///
/// # Errors
/// Rows that are not one more than the states.
pub fn integer_momenta(dimension: usize, states: usize, half_steps: &[f64]) -> Result<Vec<f64>, RecordedError> {
    let needed = states + 1;
    if half_steps.len() != needed * dimension {
        let found = half_steps.len() / dimension.max(1);
        return Err(RecordedError::HalfSteps { states, needed, found });
    }
    // 0.5 x is exact
    Ok(half_steps.iter().zip(&half_steps[dimension..]).map(|(before, after)| 0.5 * before + 0.5 * after).collect())
}

/// The momenta p_n = p_{n−1/2} − ½h U_q(q_n) from the momenta of leapfrog half a step before each state, and the
/// gradients at the states, in place.
///
/// The same momenta as by [`integer_momenta`], for programs that log forces: each state needs nothing of another one.
///
/// # Errors
/// Arrays that do not have as many numbers.
pub fn integer_momenta_with_gradients(
    h: &StepSize,
    half_steps: &mut [f64],
    gradients: &[f64],
) -> Result<(), RecordedError> {
    let (columns, found) = (half_steps.len(), gradients.len());
    if columns != found {
        return Err(RecordedError::Shape { name: "the gradient", found, rows: 1, columns });
    }
    let half = f64::from_rational(h.exact(), &()) / 2.0;
    half_steps.iter_mut().zip(gradients).for_each(|(p, gradient)| *p -= half * gradient);
    Ok(())
}
