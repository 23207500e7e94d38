//! The sequence of kicks, drifts, gradient kicks and middle parts that is a step.

pub use shadowstep_schemes::MapKind;

/// The order in which the middle parts H_2, …, H_(n−1) of H flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartOrder {
    /// From H_2 to H_(n−1): after a kick.
    Ascending,
    /// From H_(n−1) to H_2: after a drift.
    Descending,
}

impl PartOrder {
    /// The order after a map.
    pub fn after(kind: MapKind) -> PartOrder {
        match kind {
            MapKind::Drift => PartOrder::Descending,
            MapKind::Kick | MapKind::GradientKick => PartOrder::Ascending,
        }
    }
}

/// The maps of a step in their order, with their weights.
#[derive(Clone, Copy, Debug)]
pub struct Maps<'a, N> {
    kicks: &'a [N],
    drifts: &'a [N],
    middle_weights: &'a [N],
    gradient_kicks: &'a [N],
    maps: &'a [(MapKind, usize)],
    middle: &'a [usize],
}

impl<'a, N> Maps<'a, N> {
    /// So many weights of kicks, then those of drifts, then so many of middle parts and of gradient kicks; each map has the place of its weight
    /// among those of its kind, and `middle` those between each map and the next.
    pub(crate) fn new(
        weights: &'a [N],
        (kicks, maps): (usize, &'a [(MapKind, usize)]),
        (middle_weights, middle): (usize, &'a [usize]),
        gradient_kicks: usize,
    ) -> Self {
        let (kicks, others) = weights.split_at(kicks);
        let (others, gradient_kicks) = others.split_at(others.len() - gradient_kicks);
        let (drifts, middle_weights) = others.split_at(others.len() - middle_weights);
        Maps { kicks, drifts, middle_weights, gradient_kicks, maps, middle }
    }

    /// The weight of the middle parts between the map at this index and the next, in the order that is [their order](PartOrder::after) after
    /// it; `None` for H of two parts.
    #[inline(always)]
    pub fn middle_after(&self, index: usize) -> Option<&'a N> {
        self.middle.get(index).map(|&place| &self.middle_weights[place])
    }

    /// One after the other, without the middle parts.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = (MapKind, &'a N)> {
        let Maps { kicks, drifts, gradient_kicks, maps, .. } = *self;
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
