//! Which shipped scheme a scheme is, by its weights.

use std::sync::LazyLock;

use num_traits::{Signed, ToPrimitive};
use shadowstep_schemes::map::Map;
use shadowstep_schemes::table::{Table, Weights};
use shadowstep_schemes::{ExactScheme, MapKind, Rational, exact, shipped, shipped_names};

/// Schemes whose weights differ by more than this are different ones.
const NEAR: f64 = 1e-5;

/// A shipped scheme, not proved again.
#[derive(Debug)]
pub struct Known {
    /// Its name.
    pub name: &'static str,
    scheme: ExactScheme,
    maps: Vec<Map>,
    /// The weights of `maps`.
    floats: Vec<f64>,
    /// The γ's of a composition of Störmer–Verlet.
    pub(crate) gamma: Option<Vec<f64>>,
}

impl Known {
    fn of(name: &'static str) -> Option<Known> {
        let scheme =
            exact::scheme(&shipped(name)?, &|base, _| shipped(base)).0.filter(|scheme| scheme.inner.is_none())?;
        let maps = scheme.maps();
        let float = |map: &Map| map.weight.to_f64().unwrap_or(f64::NAN);
        let gamma = match &scheme.table.weights {
            Some(Weights::Composition { base, .. }) if base.value == "stormer-verlet" => {
                Some(maps.iter().skip(1).step_by(2).map(float).collect())
            }
            _ => None,
        };
        Some(Known { name, floats: maps.iter().map(float).collect(), maps, scheme, gamma })
    }

    /// Its table.
    pub(crate) fn table(&self) -> &Table {
        &self.scheme.table
    }

    /// The weights of its maps.
    pub(crate) fn floats(&self) -> &[f64] {
        &self.floats
    }

    /// Whether its names, its title or its reference have a word, in small letters.
    pub(crate) fn mentions(&self, word: &str) -> bool {
        let table = self.table();
        let aliases = table.aliases.iter().map(|alias| &alias.value);
        let texts = aliases.chain(&table.title).chain(&table.reference).map(|text| text.to_lowercase());
        self.name.contains(word) || texts.into_iter().any(|text| text.contains(word))
    }
}

/// All shipped schemes without an inner one; those without a processor first.
pub(crate) static KNOWN: LazyLock<Vec<Known>> = LazyLock::new(|| {
    let mut known: Vec<_> = shipped_names().into_iter().filter_map(Known::of).collect();
    known.sort_by_key(|known| known.scheme.processor.is_some());
    known
});

/// How a scheme is one of the shipped ones.
#[derive(Clone, Debug)]
pub struct Likeness {
    /// The shipped scheme.
    pub known: &'static Known,
    /// Whether its kicks are drifts, and its drifts kicks.
    pub exchanged: bool,
    /// Whether its maps are in the opposite order.
    pub reversed: bool,
    /// The largest distance of two weights.
    pub distance: Rational,
}

impl Likeness {
    /// The shipped scheme that maps are within 10⁻⁵ in all weights: the nearest one. Kicks and drifts may be exchanged,
    /// and the order reversed.
    ///
    /// ```
    /// use shadowstep_analysis::Likeness;
    /// use shadowstep_schemes::shipped_proved;
    ///
    /// let maps = shipped_proved("yoshida4").unwrap().scheme.maps();
    /// let likeness = Likeness::of(&maps).unwrap();
    /// assert_eq!((likeness.known.name, likeness.digits()), ("yoshida4", None));
    /// ```
    pub fn of(maps: &[Map]) -> Option<Likeness> {
        let floats: Vec<_> = maps.iter().map(|map| map.weight.to_f64().unwrap_or(f64::NAN)).collect();
        let has_gradient_kicks = maps.iter().any(|map| map.kind == MapKind::GradientKick);
        let mut nearest: Option<Likeness> = None;
        for known in KNOWN.iter().filter(|known| known.maps.len() == maps.len()) {
            for (exchanged, reversed) in [(false, false), (true, false), (false, true), (true, true)] {
                if has_gradient_kicks && (exchanged || reversed) {
                    continue;
                }
                let theirs = |i: usize| if reversed { maps.len() - 1 - i } else { i };
                let alike = |i: usize| {
                    let (mine, other) = (maps[i].kind, known.maps[theirs(i)].kind);
                    mine == if exchanged { other.other() } else { other }
                        && (floats[i] - known.floats[theirs(i)]).abs() < NEAR
                };
                if !(0..maps.len()).all(alike) {
                    continue;
                }
                let distances = (0..maps.len()).map(|i| (&maps[i].weight - &known.maps[theirs(i)].weight).abs());
                let distance = distances.max()?;
                if nearest.as_ref().is_none_or(|nearest| distance < nearest.distance) {
                    nearest = Some(Likeness { known, exchanged, reversed, distance });
                }
            }
        }
        nearest
    }

    /// The map whose weight is farthest from that of the shipped scheme, which is this.
    pub(crate) fn farthest(&self, maps: &[Map]) -> Option<(usize, &'static Rational)> {
        let known = self.known;
        let theirs = |i: usize| &known.maps[if self.reversed { maps.len() - 1 - i } else { i }].weight;
        // of mirror images, the first
        let farthest = (0..maps.len()).rev().max_by_key(|i| (&maps[*i].weight - theirs(*i)).abs())?;
        Some((farthest, theirs(farthest)))
    }

    /// The decimal digits to which all weights agree; `None` if they are the same.
    pub fn digits(&self) -> Option<u32> {
        shadowstep_schemes::digits_of(&self.distance)
    }
}

/// Whether weights of kicks and drifts in turn are within 10⁻⁵ those of a shipped scheme, whichever comes first.
pub(crate) fn resembles(weights: &[f64]) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < NEAR;
    let is_alike = |known: &&Known| {
        let theirs = &known.floats;
        theirs.len() == weights.len()
            && (theirs.iter().zip(weights).all(|(a, b)| near(*a, *b))
                || theirs.iter().rev().zip(weights).all(|(a, b)| near(*a, *b)))
    };
    KNOWN.iter().filter(|known| known.scheme.stages.gradient_kick.is_empty()).any(|known| is_alike(&known))
}

/// A list of weights that is that of a shipped scheme but for a few entries.
#[derive(Debug)]
pub(crate) enum Slip {
    /// These entries are others, beside their mirror images: their places, and what they should be.
    Wrong(Vec<(usize, f64)>),
    /// One of these is there once too often.
    Twice(usize),
    /// One is missing at this place.
    Missing(usize, f64),
}

/// Weights that differ by less are the same here: printed digits are not judged.
const SAME: f64 = 1e-7;

/// The shipped list that a list was copied from with a slip: at least three weights are the same, and at most two
/// others are not.
pub(crate) fn slip<'a>(
    list: &[f64],
    theirs: impl Iterator<Item = (&'static Known, &'a [f64])>,
) -> Option<(&'static Known, Slip)> {
    let same = |a: f64, b: f64| (a - b).abs() < SAME;
    let distinct = |values: &mut dyn Iterator<Item = f64>| {
        let mut found: Vec<f64> = Vec::new();
        // few digits agree by accident
        let is_telling = |value: f64| !same(value * 24.0, (value * 24.0).round());
        values.filter(|value| is_telling(*value)).for_each(|value| {
            if !found.iter().any(|known| same(*known, value)) {
                found.push(value);
            }
        });
        found.len()
    };
    let mut best: Option<(usize, &'static Known, Slip)> = None;
    for (known, other) in theirs {
        let found = if list.len() == other.len() {
            let folded = |i: usize| if same(list[i], list[list.len() - 1 - i]) { i.min(list.len() - 1 - i) } else { i };
            let wrong = (0..list.len()).filter(|i| !same(list[*i], other[*i]) && folded(*i) == *i);
            let wrong: Vec<_> = wrong.map(|i| (i, other[i])).collect();
            let agree = distinct(&mut (0..list.len()).filter(|i| same(list[*i], other[*i])).map(|i| list[i]));
            (!wrong.is_empty() && wrong.len() <= 2 && agree >= 3).then_some((agree, Slip::Wrong(wrong)))
        } else if list.len().abs_diff(other.len()) == 1 {
            let (long, short) = if list.len() > other.len() { (list, other) } else { (other, list) };
            let before = short.iter().zip(long).take_while(|(a, b)| same(**a, **b)).count();
            let behind = short.iter().rev().zip(long.iter().rev()).take_while(|(a, b)| same(**a, **b)).count();
            let agree = distinct(&mut short.iter().copied());
            let slip = if list.len() > other.len() {
                Slip::Twice(before)
            } else {
                Slip::Missing(before, other[before.min(other.len() - 1)])
            };
            (before + behind >= short.len() && agree >= 3).then_some((agree, slip))
        } else {
            None
        };
        if let Some((agree, slip)) = found
            && best.as_ref().is_none_or(|(most, ..)| agree > *most)
        {
            best = Some((agree, known, slip));
        }
    }
    best.map(|(_, known, slip)| (known, slip))
}
