//! Weights a_s, b_s → the sequence of kicks and drifts.

use std::fmt;

use num_traits::Zero;
use shadowstep_symbolic::Rational;

use crate::table::Table;

/// How far the weights of a table are to be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// They are exactly the scheme's.
    Exactly,
    /// They are rounded to so many significant digits.
    Digits(u32),
}

impl Held {
    /// The fewer digits of both.
    pub fn weaker(self, other: Held) -> Held {
        match (self, other) {
            (Held::Digits(a), Held::Digits(b)) => Held::Digits(a.min(b)),
            (Held::Exactly, held) | (held, Held::Exactly) => held,
        }
    }
}

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

/// A scheme with exact weights, as its table claims it; see [`crate::prove`] for what is true of it.
#[derive(Clone, Debug)]
pub struct Scheme {
    /// The table, for names, claims and places.
    pub table: Table,
    /// a_s, s = 1..S (Moan & Niesen, eq. 1: in each stage the kick comes before the drift).
    pub kick: Vec<Rational>,
    /// b_s, s = 1..S.
    pub drift: Vec<Rational>,
    /// What is known of the weights' digits.
    pub held: Held,
}

impl Scheme {
    /// The maps of a step in the order in which they act: zero weights left out, neighbours of one kind merged.
    pub fn maps(&self) -> Vec<Map> {
        merged(&self.kick, &self.drift)
    }

    /// The same weights with the roles of kick and drift exchanged, where `first` asks for it.
    ///
    /// The order for quadratic T may be another one then: prove it again.
    pub fn starting_with(mut self, first: First) -> Scheme {
        if self.first() == first {
            return self;
        }
        let mut maps = self.maps();
        maps.iter_mut().for_each(|map| map.kind = map.kind.other());
        (self.kick, self.drift) = stages_of(&maps);
        if let Some(claim) = &mut self.table.near_integrable {
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

    /// Whether the maps read the same from both ends, so that the step is its own adjoint.
    pub fn is_symmetric(&self) -> bool {
        let maps = self.maps();
        maps.iter().eq(maps.iter().rev())
    }
}

/// Stages → maps, zero weights left out and neighbours of one kind merged.
pub(crate) fn merged(kick: &[Rational], drift: &[Rational]) -> Vec<Map> {
    let mut maps: Vec<Map> = Vec::new();
    for (a, b) in kick.iter().zip(drift) {
        for (kind, weight) in [(MapKind::Kick, a), (MapKind::Drift, b)] {
            append(&mut maps, kind, weight);
        }
    }
    maps
}

/// Maps → stages: a_s and b_s, 0 where a stage has no kick or no drift.
pub(crate) fn stages_of(maps: &[Map]) -> (Vec<Rational>, Vec<Rational>) {
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
