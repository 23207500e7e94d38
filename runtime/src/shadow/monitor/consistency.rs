//! Whether the states of a window belong to the increments of the steps.

use crate::number::partial_sums::{PartialSums, add_sum};
use crate::number::saved::Fields;
use crate::number::{Real, epsilon};

/// Counts the windows with a state that differs from its increments.
#[derive(Clone, Debug)]
pub(super) struct Consistency<N> {
    /// (10⁶ ε)²
    rounding: N,
    /// Whether a state of this window differs from its increments.
    mismatch: bool,
    /// The number of windows with such a state.
    mismatches: u64,
    /// Intermediate results.
    two: PartialSums<N, 2>,
    x: N,
    y: N,
}

impl<N: Real> Consistency<N> {
    pub(super) fn new(context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let (rounding, two) = (square_rounding(context), PartialSums::new(context));
        Consistency { rounding, mismatch: false, mismatches: 0, two, x: zero(), y: zero() }
    }

    /// Compares a vector after a step with the one before and with what the step added. Returns whether what has
    /// changed is certainly finite.
    #[inline(always)]
    pub(super) fn compare(&mut self, before: &[N], after: &[N], added: &[N]) -> bool {
        let Consistency { rounding, two, x, y, .. } = self;
        let differs = differ([before, after, added], rounding, two, [x, y]);
        self.mismatch |= differs == Some(true);
        differs.is_some()
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        to.flag(&mut self.mismatch);
        to.count(&mut self.mismatches);
    }

    /// Ends a window.
    #[inline(always)]
    pub(super) fn end(&mut self) {
        self.mismatches += u64::from(std::mem::take(&mut self.mismatch));
    }

    /// The number of windows in which a state differs from its increments.
    pub(super) fn mismatches(&self) -> u64 {
        self.mismatches
    }
}

/// (10⁶ ε)²
pub(super) fn square_rounding<N: Real>(context: &N::Context) -> N {
    let mut epsilon: N = epsilon(context);
    epsilon.multiply_integer(1_000_000);
    let mut rounding = N::zero(context);
    rounding.assign_square(&epsilon);
    rounding
}

/// Whether a state differs from the one before plus its increments, by more than 1/1000 of these and 1000 ε of its
/// numbers: of q, or of p. `None` where squares are not finite.
///
/// Increments that a plain step left behind belong to an earlier step, or are 0.
#[inline(always)]
fn differ<N: Real>(
    [before, after, added]: [&[N]; 3],
    rounding: &N,
    two: &mut PartialSums<N, 2>,
    [x, y]: [&mut N; 2],
) -> Option<bool> {
    let vectors = [after, before, &added[..after.len()]];
    let [off, changes] = two.of(vectors, |[after, before, added], [off, changes]| {
        let mut difference = x.register();
        difference.assign_difference(after, before);
        changes.add_product(&difference, &difference);
        difference.subtract(added);
        off.add_product(&difference, &difference);
    });
    if !changes.is_finite() {
        return None;
    }
    // what is off, 1000 times, squared
    let mut x = x.register();
    x.assign(&off);
    x.multiply_integer(1_000_000);
    Some(*x > *changes && is_more_than_rounding(&*x, &*changes, (after, rounding), y))
}

/// Whether the square of what is off is also more than what is rounded of numbers of these sizes; false for NaN.
#[cold]
#[inline(never)]
fn is_more_than_rounding<N: Real>(off: &N, changes: &N, (numbers, rounding): (&[N], &N), allowed: &mut N) -> bool {
    allowed.assign_zero();
    add_sum(allowed, [numbers], |[number], sizes| sizes.add_product(number, number));
    allowed.multiply(rounding);
    allowed.add(changes);
    *off > *allowed
}
