//! The sequence of kicks, drifts and gradient kicks that is a step.

pub use shadowstep_schemes::MapKind;

/// The maps of a step in their order, with their weights.
#[derive(Clone, Copy, Debug)]
pub struct Maps<'a, N> {
    kicks: &'a [N],
    drifts: &'a [N],
    gradient_kicks: &'a [N],
    maps: &'a [(MapKind, usize)],
}

impl<'a, N> Maps<'a, N> {
    /// So many weights of kicks, then those of drifts, then so many of gradient kicks; each map has the place of its weight among those
    /// of its kind.
    pub(crate) fn new(weights: &'a [N], (kicks, maps): (usize, &'a [(MapKind, usize)]), gradient_kicks: usize) -> Self {
        let (kicks, others) = weights.split_at(kicks);
        let (drifts, gradient_kicks) = others.split_at(others.len() - gradient_kicks);
        Maps { kicks, drifts, gradient_kicks, maps }
    }

    /// One after the other.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = (MapKind, &'a N)> {
        let Maps { kicks, drifts, gradient_kicks, maps } = *self;
        maps.iter().map(
            #[inline(always)]
            move |&(kind, index)| match kind {
                MapKind::Kick => (kind, &kicks[index]),
                MapKind::Drift => (kind, &drifts[index]),
                MapKind::GradientKick => (kind, &gradient_kicks[index]),
            },
        )
    }
}
