//! Weights a_s, b_s → the sequence of kicks and drifts.

use num_traits::Zero;

use crate::map::{Map, Stages, inverse, joined, reversed};
use crate::map_kind::{First, MapKind};
use crate::table::{Table, Weights};

/// How far the weights of a table are to be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// They are exactly the scheme's.
    Exactly,
    /// They are rounded to this number of significant digits.
    Digits(u32),
}

impl Held {
    /// How many digits are right; `None` for all.
    pub fn digits(self) -> Option<u32> {
        match self {
            Held::Exactly => None,
            Held::Digits(digits) => Some(digits),
        }
    }

    /// The fewer digits of both.
    pub fn weaker(self, other: Held) -> Held {
        match (self, other) {
            (Held::Digits(a), Held::Digits(b)) => Held::Digits(a.min(b)),
            (Held::Exactly, held) | (held, Held::Exactly) => held,
        }
    }

    /// What is known of numbers derived from the weights that lose some digits.
    pub(crate) fn losing(self, lost: u32) -> Held {
        match self {
            Held::Exactly => Held::Exactly,
            Held::Digits(digits) => Held::Digits(digits.saturating_sub(lost).max(1)),
        }
    }
}

/// A scheme with exact weights, as its table claims it; see [`crate::proof::prove`] for what is true of it.
#[derive(Clone, Debug)]
pub struct ExactScheme {
    /// The table, for names, claims and places.
    pub table: Table,
    /// a_s, c_s and b_s, s = 1..S (Moan & Niesen, eq. 1: in each stage the kick comes before the drift).
    pub stages: Stages,
    /// What is known of the weights' digits.
    pub held: Held,
    /// The base of a composition.
    pub base: Option<Box<ExactScheme>>,
    /// The processor, if it is a processed scheme; the weights are the kernel's.
    pub processor: Option<ExactProcessor>,
    /// The inner scheme of multiple time steps; the weights are the outer scheme's.
    pub inner: Option<ExactInner>,
}

/// The inner scheme of [multiple time steps](crate::inner).
#[derive(Clone, Debug)]
pub struct ExactInner {
    /// The scheme.
    pub scheme: Box<ExactScheme>,
    /// Its steps for each drift of the outer scheme.
    pub substeps: u32,
}

/// The post-map χ⁻¹ of a processed scheme χ⁻¹ ∘ kernelⁿ ∘ χ; the pre-map χ is its exact inverse.
#[derive(Clone, Debug)]
pub struct ExactProcessor {
    /// The maps of χ⁻¹ in the order in which they act, with weights in units of the step size.
    pub post: Vec<Map>,
    /// What is known of the digits of the processed step's weights.
    pub held: Held,
}

impl ExactProcessor {
    /// The maps of χ in the order in which they act.
    pub(crate) fn pre(&self) -> Vec<Map> {
        inverse(&self.post)
    }

    /// Evaluations of the gradient for an output: one for each kick of the post-map.
    pub fn evaluations(&self) -> usize {
        self.post.iter().filter(|map| map.kind == MapKind::Kick).count()
    }
}

impl ExactScheme {
    /// The maps of a step in the order in which they act: zero weights left out, neighbours of one kind merged.
    pub fn maps(&self) -> Vec<Map> {
        self.stages.maps()
    }

    /// The scheme of its components that its table calls by this name.
    pub(crate) fn component(&self, name: &str) -> Option<&ExactScheme> {
        let base = match &self.table.weights {
            Some(Weights::Composition { base, .. }) if base.value == name => self.base.as_deref(),
            _ => None,
        };
        let is_inner = self.table.inner.as_ref().is_some_and(|inner| inner.base.value == name);
        base.or_else(|| self.inner.as_ref().filter(|_| is_inner).map(|inner| &*inner.scheme))
    }

    /// Whether some of them are gradient kicks, which need a quadratic T.
    pub fn has_gradient_kicks(&self) -> bool {
        self.stages.gradient_kick.iter().any(|c| !c.is_zero())
    }

    /// The maps of a processed step, of the pre-map, the kernel and the post-map; `None` for a scheme without a
    /// processor.
    pub fn processed_maps(&self) -> Option<Vec<Map>> {
        let processor = self.processor.as_ref()?;
        Some(joined(processor.pre().iter().chain(&self.maps()).chain(&processor.post)))
    }

    /// The same weights with the roles of kick and drift exchanged, where `first` asks for it.
    ///
    /// The order for quadratic T may be another one then: prove it again.
    pub fn starting_with(mut self, first: First) -> ExactScheme {
        if self.first() == first {
            return self;
        }
        let mut maps = self.maps();
        maps.iter_mut().for_each(|map| map.kind = map.kind.other());
        self.stages = Stages::of(&maps);
        if let Some(processor) = &mut self.processor {
            processor.post.iter_mut().for_each(|map| map.kind = map.kind.other());
        }
        let of_processor = self.table.processor.as_mut().and_then(|processor| processor.near_integrable.as_mut());
        for claim in self.table.near_integrable.iter_mut().chain(of_processor) {
            claim.dominant = claim.dominant.other();
        }
        self
    }

    /// The kind of the first map.
    pub fn first(&self) -> First {
        match self.maps().first() {
            Some(Map { kind: MapKind::Drift, .. }) => First::Drift,
            _ => First::Kick,
        }
    }

    /// Whether the maps read the same from both ends, so that the step is its own adjoint; with an inner scheme, those
    /// of both.
    pub fn is_symmetric(&self) -> bool {
        let maps = self.maps();
        maps == reversed(&maps) && self.inner.as_ref().is_none_or(|inner| inner.scheme.is_symmetric())
    }

    /// The schemes that it is made of: its base, and its inner scheme.
    pub(crate) fn components(&self) -> impl Iterator<Item = &ExactScheme> {
        self.base.as_deref().into_iter().chain(self.inner.iter().map(|inner| &*inner.scheme))
    }

    /// Itself and all schemes that it is made of.
    pub(crate) fn all(&self) -> Vec<&ExactScheme> {
        std::iter::once(self).chain(self.components().flat_map(ExactScheme::all)).collect()
    }
}
