//! Sums over the windows of a run.

use super::arithmetic::{difference, integer, quotient, root};
use super::estimated::Estimated;
use crate::number::Real;
use crate::number::saved::Fields;
use crate::shadow::rules::ERROR_FACTOR;

/// The least and the largest number so far.
#[derive(Clone, Debug)]
pub(super) struct Range<N> {
    pub(super) least: N,
    pub(super) largest: N,
}

impl<N: Real> Range<N> {
    pub(super) fn of(first: &N) -> Self {
        Range { least: first.clone(), largest: first.clone() }
    }

    #[inline]
    pub(super) fn include(&mut self, value: &N) {
        if *value < self.least {
            self.least.assign(value);
        }
        if *value > self.largest {
            self.largest.assign(value);
        }
    }

    pub(super) fn width(&self) -> N {
        difference(&self.largest, &self.least)
    }
}

/// H and H − H̄ over the windows.
#[derive(Clone, Debug)]
pub(super) struct Statistics<N> {
    pub(super) windows: u64,
    /// H, at the first state too.
    pub(super) energy: Range<N>,
    /// H − H̄, where there has been a window.
    pub(super) method: Range<N>,
    /// The largest H̄ − 3e and the least H̄ + 3e, e its error.
    beyond_errors: Range<N>,
    bound: N,
    sum_of_squares: N,
    /// Σ of squares of the errors of the H̄ in these differences.
    method_errors: N,
    /// Σ of squares of the errors, and of H − H̄ with the H̄ of the same window.
    errors: N,
    distances: N,
}

impl<N: Real> Statistics<N> {
    pub(super) fn new(energy: &N) -> Self {
        let zero = N::zero(&energy.context());
        Statistics {
            windows: 0,
            energy: Range::of(energy),
            method: Range::of(&zero),
            beyond_errors: Range::of(&zero),
            bound: zero.clone(),
            sum_of_squares: zero.clone(),
            method_errors: zero.clone(),
            errors: zero.clone(),
            distances: zero,
        }
    }

    /// Takes a window: H, H − H̄ with the error of this H̄, and the window's own H̄.
    #[inline]
    pub(super) fn add(&mut self, energy: &N, (method, error): (&N, &N), modified: &Estimated<N>) {
        self.energy.include(energy);
        self.include_bounds(modified);
        if self.windows == 0 {
            self.method.least.assign(method);
            self.method.largest.assign(method);
        }
        self.method.include(method);
        self.sum_of_squares.add_product(method, method);
        self.method_errors.add_product(error, error);
        self.errors.add_product(&modified.error, &modified.error);
        self.bound.assign_difference(energy, &modified.value);
        self.distances.add_product(&self.bound, &self.bound);
        self.windows += 1;
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Statistics { windows, energy, method, beyond_errors, .. } = self;
        to.count(windows);
        [energy, method, beyond_errors].into_iter().for_each(|Range { least, largest }| {
            to.number(least);
            to.number(largest);
        });
        let Statistics { bound: _, sum_of_squares, method_errors, errors, distances, .. } = self;
        [sum_of_squares, method_errors, errors, distances].into_iter().for_each(|sum| to.number(sum));
    }

    /// The root mean square of H − H̄ with the H̄ of the same window, as a part of the root mean square of the errors:
    /// small where H̄ changes with H from state to state. NaN without errors.
    pub(super) fn distance_of_error(&self) -> f64 {
        quotient(&self.distances, &self.errors).to_f64().sqrt()
    }

    /// The root mean square of the errors.
    pub(super) fn error_rms(&self) -> N {
        root(&quotient(&self.errors, &self.count()))
    }

    #[inline]
    fn include_bounds(&mut self, Estimated { value, error }: &Estimated<N>) {
        let Range { least, largest } = &mut self.beyond_errors;
        for (sign, bound) in [(-ERROR_FACTOR, largest), (ERROR_FACTOR, least)] {
            self.bound.assign(error);
            self.bound.multiply_integer(sign);
            self.bound.add(value);
            let beyond = if sign < 0 { self.bound > *bound } else { self.bound < *bound };
            if self.windows == 0 || beyond {
                bound.assign(&self.bound);
            }
        }
    }

    /// max (H̄ − 3e) − min (H̄ + 3e), or 0: how far H̄ has moved beyond its errors.
    pub(super) fn moved(&self) -> N {
        let mut moved = self.beyond_errors.width();
        if moved.is_below_zero() {
            moved.assign_zero();
        }
        moved
    }

    /// How many windows, at least 1.
    pub(super) fn count(&self) -> N {
        integer(self.windows.max(1), &self.sum_of_squares.context())
    }

    /// √⟨(H − H̄)²⟩, and the same of the errors of these H̄.
    pub(super) fn method_rms(&self) -> [N; 2] {
        [&self.sum_of_squares, &self.method_errors].map(|sum| root(&quotient(sum, &self.count())))
    }
}
