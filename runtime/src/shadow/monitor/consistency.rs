//! Whether the states of a window belong to the increments of the steps.

use crate::number::partial_sums::PartialSums;
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
    three: PartialSums<N, 3>,
    x: N,
    y: N,
}

impl<N: Real> Consistency<N> {
    pub(super) fn new(context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let (rounding, three) = (square_rounding(context), PartialSums::new(context));
        Consistency { rounding, mismatch: false, mismatches: 0, three, x: zero(), y: zero() }
    }

    /// Compares a vector after a step with the one before and with what the step added.
    #[inline(always)]
    pub(super) fn compare(&mut self, before: &[N], after: &[N], added: &[N]) {
        let Consistency { rounding, three, x, y, .. } = self;
        self.mismatch |= differ([before, after, added], rounding, three, [x, y]);
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

/// Whether a state differs from the one before plus its increments, by more than 1/1000 of these and 1000 ε of its numbers: of q, or of p.
///
/// Increments that a plain step left behind belong to an earlier step, or are 0.
#[inline(always)]
fn differ<N: Real>(
    [before, after, added]: [&[N]; 3],
    rounding: &N,
    three: &mut PartialSums<N, 3>,
    [x, y]: [&mut N; 2],
) -> bool {
    let [off, changes, sizes] =
        three.of([after, before, &added[..after.len()]], |[after, before, added], [off, changes, sizes]| {
            let mut difference = x.register();
            difference.assign_difference(after, before);
            changes.add_product(&difference, &difference);
            difference.subtract(added);
            off.add_product(&difference, &difference);
            sizes.add_product(after, after);
        });
    // what is off, 1000 times, squared; and what it may be
    let (mut x, mut y) = (x.register(), y.register());
    x.assign(&off);
    x.multiply_integer(1_000_000);
    y.assign(&changes);
    y.add_product(&sizes, rounding);
    // false for NaN, which is found elsewhere
    *x > *y
}
