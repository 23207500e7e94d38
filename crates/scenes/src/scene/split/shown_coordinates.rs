//! States in the coordinates of the steps → those that are shown.

use shadowstep::Number;

/// Converts a state.
type Convert<N> = Box<dyn FnMut((&[N], &[N]), (&mut [N], &mut [N]))>;

/// Converts states of a system to those that are shown.
pub struct ShownCoordinates<N> {
    convert: Convert<N>,
    q: Vec<N>,
    p: Vec<N>,
}

impl<N: Number> ShownCoordinates<N> {
    /// The conversion into states of this dimension.
    pub(super) fn by(
        dimension: usize,
        context: &N::Context,
        convert: impl FnMut((&[N], &[N]), (&mut [N], &mut [N])) + 'static,
    ) -> Self {
        let zeros = || vec![N::zero(context); dimension];
        ShownCoordinates { convert: Box::new(convert), q: zeros(), p: zeros() }
    }

    /// The positions and momenta that are shown of a state.
    pub fn of_state(&mut self, q: &[N], p: &[N]) -> (&[N], &[N]) {
        (self.convert)((q, p), (&mut self.q, &mut self.p));
        (&self.q, &self.p)
    }
}
