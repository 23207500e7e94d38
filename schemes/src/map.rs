//! The maps that a step is made of with their weights, and the stages of a table.

use num_traits::Zero;

use crate::map_kind::MapKind;
use crate::symbolic::Rational;

/// One map of a step with its weight.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Map {
    /// Kick, drift or gradient kick.
    pub kind: MapKind,
    /// The weight a_s, b_s or c_s.
    pub weight: Rational,
}

/// The weights of the stages s = 1..S, as many of each kind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stages {
    /// a_s of the kicks.
    pub kick: Vec<Rational>,
    /// c_s of the gradient kicks, which act with the kicks; empty, where there are none.
    pub gradient_kick: Vec<Rational>,
    /// b_s of the drifts.
    pub drift: Vec<Rational>,
}

impl Stages {
    /// The maps in the order in which they act: zero weights left out, neighbours of one kind merged.
    pub fn maps(&self) -> Vec<Map> {
        let mut maps: Vec<Map> = Vec::new();
        for (s, (a, b)) in self.kick.iter().zip(&self.drift).enumerate() {
            append(&mut maps, MapKind::Kick, a);
            self.gradient_kick.get(s).into_iter().for_each(|c| append(&mut maps, MapKind::GradientKick, c));
            append(&mut maps, MapKind::Drift, b);
        }
        maps
    }

    /// The stages of maps: 0 where a stage has no kick or no drift.
    pub fn of(maps: &[Map]) -> Stages {
        let has_gradient_kicks = maps.iter().any(|map| map.kind == MapKind::GradientKick);
        let mut stages = Stages::default();
        let mut drifts = true;
        for map in maps {
            if drifts {
                stages.kick.push(Rational::zero());
                stages.gradient_kick.extend(has_gradient_kicks.then(Rational::zero));
                stages.drift.push(Rational::zero());
            }
            drifts = map.kind == MapKind::Drift;
            let weights = match map.kind {
                MapKind::Kick => &mut stages.kick,
                MapKind::GradientKick => &mut stages.gradient_kick,
                MapKind::Drift => &mut stages.drift,
            };
            *weights.last_mut().expect("a stage has begun") = map.weight.clone();
        }
        stages
    }

    /// The stages of a step γ_1 h, a step γ_2 h, ….
    pub(crate) fn repeated(&self, gamma: &[Rational]) -> Stages {
        let scaled = |weights: &[Rational], power: u32| {
            gamma.iter().flat_map(|g| weights.iter().map(move |w| g.pow(power as i32) * w)).collect()
        };
        Stages {
            kick: scaled(&self.kick, MapKind::Kick.power()),
            gradient_kick: scaled(&self.gradient_kick, MapKind::GradientKick.power()),
            drift: scaled(&self.drift, MapKind::Drift.power()),
        }
    }
}

/// Maps in the opposite order, in the order of [`Stages::maps`]: kicks before the gradient kicks with which they
/// commute.
pub(crate) fn reversed(maps: &[Map]) -> Vec<Map> {
    let mut reversed = Vec::new();
    maps.iter().rev().for_each(|map| append(&mut reversed, map.kind, &map.weight));
    reversed
}

/// Maps one after the other, neighbours of one kind merged.
pub(crate) fn joined<'a>(maps: impl IntoIterator<Item = &'a Map>) -> Vec<Map> {
    let mut joined = Vec::new();
    maps.into_iter().for_each(|map| append(&mut joined, map.kind, &map.weight));
    joined
}

/// The maps that undo these.
pub(crate) fn inverse(maps: &[Map]) -> Vec<Map> {
    maps.iter().rev().map(|map| Map { kind: map.kind, weight: -&map.weight }).collect()
}

impl MapKind {
    /// Whether maps of both kinds commute.
    pub(crate) fn commutes_with(self, other: MapKind) -> bool {
        (self == MapKind::Drift) == (other == MapKind::Drift)
    }
}

/// Adds a map after others; of those since the last drift, which commute with it, one of its kind takes it in.
fn append(maps: &mut Vec<Map>, kind: MapKind, weight: &Rational) {
    if weight.is_zero() {
        return;
    }
    let run = maps.iter().rposition(|map| !map.kind.commutes_with(kind)).map_or(0, |before| before + 1);
    match maps[run..].iter().position(|map| map.kind == kind) {
        Some(place) => {
            maps[run + place].weight += weight;
            if maps[run + place].weight.is_zero() {
                maps.remove(run + place);
            }
        }
        None if kind == MapKind::Kick => maps.insert(run, Map { kind, weight: weight.clone() }),
        None => maps.push(Map { kind, weight: weight.clone() }),
    }
}
