//! The distinct weights of the maps of a step, by the kind of map.

use std::fmt::Debug;

use crate::systems::maps::MapKind;

/// The distinct weights of each kind of map, in the order of their first use in a step.
///
/// The kinds may be held in different types: generated code has arrays of different lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights<K, D = K, M = K, G = K> {
    /// a_s of kicks.
    pub kicks: K,
    /// b_s of drifts.
    pub drifts: D,
    /// Those of the middle parts of H = H_1 + … + H_n; none for H of two parts.
    pub middle_parts: M,
    /// c_s of gradient kicks.
    pub gradient_kicks: G,
}

impl<T> Weights<Vec<T>> {
    /// The same weights, borrowed.
    pub fn view(&self) -> Weights<&[T]> {
        Weights {
            kicks: &self.kicks,
            drifts: &self.drifts,
            middle_parts: &self.middle_parts,
            gradient_kicks: &self.gradient_kicks,
        }
    }
}

impl<'a, T> Weights<&'a [T]> {
    /// The weights of a kind of map.
    #[inline(always)]
    pub fn of(&self, kind: MapKind) -> &'a [T] {
        match kind {
            MapKind::Kick => self.kicks,
            MapKind::Drift => self.drifts,
            MapKind::GradientKick => self.gradient_kicks,
        }
    }

    /// All weights: of kicks, drifts, middle parts, gradient kicks.
    pub fn iter(&self) -> impl Iterator<Item = &'a T> + use<'a, T> {
        self.kicks.iter().chain(self.drifts).chain(self.middle_parts).chain(self.gradient_kicks)
    }

    /// Functions of the weights: `linear` of those that steps multiply by h, `cubic` of those of gradient kicks, which
    /// they multiply by 2h³.
    pub fn map<U>(&self, mut linear: impl FnMut(&T) -> U, cubic: impl FnMut(&T) -> U) -> Weights<Vec<U>> {
        Weights {
            kicks: self.kicks.iter().map(&mut linear).collect(),
            drifts: self.drifts.iter().map(&mut linear).collect(),
            middle_parts: self.middle_parts.iter().map(&mut linear).collect(),
            gradient_kicks: self.gradient_kicks.iter().map(cubic).collect(),
        }
    }
}

/// Weights as a scheme holds them: in arrays where its code is generated, or in vectors.
pub trait WeightLists<T>: Clone + Debug {
    /// These weights.
    ///
    /// # Panics
    /// If there are more or fewer of a kind than the scheme has.
    fn from_vecs(weights: Weights<Vec<T>>) -> Self;

    /// The weights, borrowed.
    fn view(&self) -> Weights<&[T]>;
}

impl<T: Clone + Debug> WeightLists<T> for Weights<Vec<T>> {
    fn from_vecs(weights: Weights<Vec<T>>) -> Self {
        weights
    }

    fn view(&self) -> Weights<&[T]> {
        self.view()
    }
}

impl<T: Clone + Debug, const K: usize, const D: usize, const M: usize, const G: usize> WeightLists<T>
    for Weights<[T; K], [T; D], [T; M], [T; G]>
{
    fn from_vecs(weights: Weights<Vec<T>>) -> Self {
        Weights {
            kicks: array(weights.kicks),
            drifts: array(weights.drifts),
            middle_parts: array(weights.middle_parts),
            gradient_kicks: array(weights.gradient_kicks),
        }
    }

    #[inline(always)]
    fn view(&self) -> Weights<&[T]> {
        Weights {
            kicks: &self.kicks,
            drifts: &self.drifts,
            middle_parts: &self.middle_parts,
            gradient_kicks: &self.gradient_kicks,
        }
    }
}

fn array<T: Debug, const COUNT: usize>(weights: Vec<T>) -> [T; COUNT] {
    weights.try_into().expect("a scheme has as many weights as its code")
}
