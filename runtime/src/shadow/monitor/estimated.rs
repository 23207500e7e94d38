//! A modified energy with its error.

use crate::number::Real;
use crate::number::saved::Fields;

/// An estimate of the modified energy, and its error.
#[derive(Clone, Debug)]
pub(super) struct Estimated<N> {
    pub(super) value: N,
    /// 0 where the estimator gives none.
    pub(super) error: N,
}

impl<N: Real> Estimated<N> {
    pub(super) fn zero(context: &N::Context) -> Self {
        Estimated { value: N::zero(context), error: N::zero(context) }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Estimated { value, error } = self;
        [value, error].into_iter().for_each(|number| to.number(number));
    }

    #[inline]
    pub(super) fn assign(&mut self, other: &Self) {
        self.value.assign(&other.value);
        self.error.assign(&other.error);
    }
}
