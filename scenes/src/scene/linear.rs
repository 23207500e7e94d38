//! The linear part of a system: U_qq at the origin.

use shadowstep::number::{AnyLimbs, LimbCount};
use shadowstep::{Number, Potential, Rational, exact};
use shadowstep_symbolic::decimal::from_text;

/// The value of the key `parts` for it.
pub(crate) const LINEAR: &str = "linear";

/// The most coordinates: the flow is computed in time that grows with their third power.
pub(crate) const MOST_COORDINATES: usize = 100;

/// Differences are of gradients so far apart: their error is of the size of its square, and round-off is less.
const DISTANCE: &str = "1e-60";

/// Numbers of 327 digits.
const LIMBS: u32 = 17 * 64;

/// U_qq at q = 0, row by row, exact to some 120 digits; `None` where the gradient has no value there.
///
/// The steps need no more: half of qᵀKq is added to one part and subtracted from the other with the same K.
pub(crate) fn stiffness(potential: impl Fn(&LimbCount) -> Box<dyn Potential<AnyLimbs>>) -> Option<Vec<Vec<Rational>>> {
    let count = LimbCount::of_bits(LIMBS)?;
    let mut potential = potential(&count);
    let dimension = potential.dimension();
    let zero = AnyLimbs::zero(count);
    let mut scratch = vec![zero; potential.scratch()];
    potential.prepare(&mut scratch, &count);
    let distance = AnyLimbs::from_rational(&exact(DISTANCE).expect("a number"), &count);
    let mut gradient_at = |coordinate: usize, negative: bool| {
        let mut q = vec![zero; dimension];
        q[coordinate].assign(&distance);
        if negative {
            q[coordinate].negate();
        }
        let mut gradient = q.clone();
        potential.update(&q);
        potential.gradient(&q, &mut gradient, &mut scratch);
        gradient
    };
    let column = |coordinate: usize| -> Option<Vec<Rational>> {
        let (after, before) = (gradient_at(coordinate, false), gradient_at(coordinate, true));
        let quotient = |(after, before): (AnyLimbs, AnyLimbs)| {
            let mut quotient = after;
            quotient.subtract(&before);
            quotient.divide(&distance);
            quotient.divide_integer(2);
            quotient.is_finite().then(|| from_text(&quotient.to_text()).ok()).flatten()
        };
        after.into_iter().zip(before).map(quotient).collect()
    };
    let columns = (0..dimension).map(column).collect::<Option<Vec<_>>>()?;
    // symmetric to the last digit
    let two = Rational::from_integer(2.into());
    let mean = |i: usize, j: usize| (&columns[i][j] + &columns[j][i]) / &two;
    Some((0..dimension).map(|i| (0..dimension).map(|j| mean(i, j)).collect()).collect())
}
