//! The sequence of kicks and drifts that is a step.

pub use shadowstep_schemes::MapKind;

/// The kicks and drifts of a step in their order, with their weights.
#[derive(Clone, Copy, Debug)]
pub struct Maps<'a, N> {
    kicks: &'a [N],
    drifts: &'a [N],
    maps: &'a [(MapKind, usize)],
}

impl<'a, N> Maps<'a, N> {
    /// So many weights of kicks, then those of drifts; each map has the place of its weight among those of its kind.
    pub(crate) fn new(weights: &'a [N], (kicks, maps): (usize, &'a [(MapKind, usize)])) -> Self {
        let (kicks, drifts) = weights.split_at(kicks);
        Maps { kicks, drifts, maps }
    }

    /// One after the other.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = (MapKind, &'a N)> {
        let Maps { kicks, drifts, maps } = *self;
        maps.iter().map(
            #[inline(always)]
            move |&(kind, index)| match kind {
                MapKind::Kick => (kind, &kicks[index]),
                MapKind::Drift => (kind, &drifts[index]),
            },
        )
    }
}
