//! Kicks and drifts: the maps that a step is made of, and the stages of a table.

use std::fmt;

use num_traits::Zero;
use shadowstep_symbolic::Rational;

/// Which map a step begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum First {
    /// p −= h a_1 U_q(q) comes first.
    Kick,
    /// q += h b_1 M⁻¹p comes first.
    Drift,
}

/// A kick or a drift.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MapKind {
    /// p −= h w U_q(q)
    Kick,
    /// q += h w M⁻¹p
    Drift,
}

impl MapKind {
    /// The other one.
    pub fn other(self) -> MapKind {
        match self {
            MapKind::Kick => MapKind::Drift,
            MapKind::Drift => MapKind::Kick,
        }
    }
}

impl fmt::Display for MapKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            MapKind::Kick => "kick",
            MapKind::Drift => "drift",
        })
    }
}

/// One map of a step with its weight.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Map {
    /// Kick or drift.
    pub kind: MapKind,
    /// The weight a_s or b_s.
    pub weight: Rational,
}

/// Stages → maps, zero weights left out and neighbours of one kind merged.
pub fn merged(kick: &[Rational], drift: &[Rational]) -> Vec<Map> {
    let mut maps: Vec<Map> = Vec::new();
    for (a, b) in kick.iter().zip(drift) {
        for (kind, weight) in [(MapKind::Kick, a), (MapKind::Drift, b)] {
            append(&mut maps, kind, weight);
        }
    }
    maps
}

/// Maps → stages: a_s and b_s, 0 where a stage has no kick or no drift.
pub fn stages_of(maps: &[Map]) -> (Vec<Rational>, Vec<Rational>) {
    let (mut kick, mut drift) = (Vec::new(), Vec::new());
    for map in maps {
        if map.kind == MapKind::Kick || kick.is_empty() {
            kick.push(Rational::zero());
            drift.push(Rational::zero());
        }
        let weights = if map.kind == MapKind::Kick { &mut kick } else { &mut drift };
        *weights.last_mut().expect("a stage has begun") = map.weight.clone();
    }
    (kick, drift)
}

fn append(maps: &mut Vec<Map>, kind: MapKind, weight: &Rational) {
    match maps.last_mut() {
        Some(last) if last.kind == kind => last.weight += weight,
        _ => maps.push(Map { kind, weight: weight.clone() }),
    }
    if maps.last().is_some_and(|last| last.weight.is_zero()) {
        maps.pop();
    }
}
