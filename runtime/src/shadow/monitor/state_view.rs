//! The states that are kept of a window, as rows of numbers.

/// The states that are kept, with second differences.
pub(super) const STATES_KEPT: usize = 3;

/// A state that is kept.
pub(super) struct StateView<'a, N> {
    pub(super) q: &'a mut [N],
    pub(super) p: &'a mut [N],
    /// δ²p
    pub(super) second: &'a mut [N],
}

/// The states from the oldest to the newest.
#[inline(always)]
pub(super) fn in_order<N>(states: &mut [N], newest: usize, dimension: usize) -> [StateView<'_, N>; STATES_KEPT] {
    let length = 3 * dimension;
    let (a, others) = states.split_at_mut(length);
    let (b, others) = others.split_at_mut(length);
    let c = &mut others[..length];
    let [a, b, c] = match newest {
        0 => [b, c, a],
        1 => [c, a, b],
        _ => [a, b, c],
    };
    [StateView::of(a, dimension), StateView::of(b, dimension), StateView::of(c, dimension)]
}

impl<'a, N> StateView<'a, N> {
    #[inline(always)]
    fn of(row: &'a mut [N], dimension: usize) -> Self {
        let (q, others) = row.split_at_mut(dimension);
        let (p, second) = others.split_at_mut(dimension);
        StateView { q, p, second }
    }
}
