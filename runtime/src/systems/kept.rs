//! What is kept at the present q.

/// What is kept: nothing, a force (the gradient, or the force of gradient kicks), or the force with its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum KeptForce {
    Nothing,
    Gradient,
    GradientAndRate,
}

impl KeptForce {
    /// A force that has been evaluated with its rate, or without.
    #[inline(always)]
    pub(crate) fn with(rate: bool) -> Self {
        if rate { KeptForce::GradientAndRate } else { KeptForce::Gradient }
    }

    /// Whether a force is there, with its rate if that is wanted.
    #[inline(always)]
    pub(crate) fn suffices(self, with_rate: bool) -> bool {
        match self {
            KeptForce::Nothing => false,
            KeptForce::Gradient => !with_rate,
            KeptForce::GradientAndRate => true,
        }
    }
}
