//! The coefficient of a word in a product of exponentials of kicks and drifts, as a formula in their names.
//!
//! It is the sum over the maps in which the runs of equal letters begin. A run `L^q` that begins in map i, before a run
//! that begins in map k, has `(S_i^q − S_i'^q)/q!`: S_i is the sum of the weights of L from i to k, and S_i' without
//! that of i. The first run may begin anywhere before the second.

use shadowstep_schemes::MapKind;

/// The maps in the order in which they act, with their names.
pub(super) type Named<'a> = &'a [(MapKind, String)];

/// The runs of equal letters of a word, with their lengths.
fn runs(word: &[MapKind]) -> Vec<(MapKind, u32)> {
    word.chunk_by(|a, b| a == b).map(|run| (run[0], run.len() as u32)).collect()
}

/// How many products the formula of a word has in a step of this number of maps, about.
pub(super) fn products(word: &[MapKind], maps: usize) -> usize {
    // maps / 2 places for each run after the first, in their order
    (1..runs(word).len()).fold(1, |product, n| product * (maps / 2 + n - 1) / n)
}

/// The formula of a Lyndon word: one that is a run is a letter.
pub(super) fn coefficient(word: &[MapKind], maps: Named<'_>) -> String {
    let runs = runs(word);
    let (kind, length) = runs[0];
    let Some((next, _)) = runs.get(1) else { return names(maps, kind).join(" + ") };
    let term = |place: usize| {
        let before = names(&maps[..place], kind);
        (!before.is_empty())
            .then(|| Some(format!("{} * {}", power(&before, length), from(place, &runs[1..], maps)?)))?
    };
    let terms: Vec<_> = places(maps, *next, 0).filter_map(term).collect();
    if terms.is_empty() { "0".to_owned() } else { terms.join(" + ") }
}

/// The coefficient of runs of which the first begins in this map; `None` where no maps are left for the others.
fn from(place: usize, runs: &[(MapKind, u32)], maps: Named<'_>) -> Option<String> {
    let (kind, length) = runs[0];
    let Some((next, _)) = runs.get(1) else { return Some(begun(&names(&maps[place..], kind), length)) };
    let term = |later: usize| {
        let rest = from(later, &runs[1..], maps)?;
        Some(format!("{} * {rest}", begun(&names(&maps[place..later], kind), length)))
    };
    let terms: Vec<_> = places(maps, *next, place).filter_map(term).collect();
    (!terms.is_empty()).then(|| if terms.len() == 1 { terms[0].clone() } else { format!("({})", terms.join(" + ")) })
}

/// The places of the maps of a kind from one on.
fn places(maps: Named<'_>, kind: MapKind, first: usize) -> impl Iterator<Item = usize> {
    maps.iter().enumerate().skip(first).filter(move |(_, map)| map.0 == kind).map(|(place, _)| place)
}

fn names(maps: Named<'_>, kind: MapKind) -> Vec<&str> {
    maps.iter().filter(|map| map.0 == kind).map(|(_, name)| name.as_str()).collect()
}

/// sum^q/q!
fn power(names: &[&str], q: u32) -> String {
    match (names, q) {
        ([one], 1) => (*one).to_owned(),
        (_, 1) => format!("({})", names.join(" + ")),
        _ => format!("{} / {}", raised(names, q), factorial(q)),
    }
}

/// (sum^q − (sum without the first)^q)/q!
fn begun(names: &[&str], q: u32) -> String {
    match names {
        [first, ..] if q == 1 => (*first).to_owned(),
        [_] => power(names, q),
        _ => format!("({} - {}) / {}", raised(names, q), raised(&names[1..], q), factorial(q)),
    }
}

fn raised(names: &[&str], q: u32) -> String {
    format!("{} ^ {q}", power(names, 1))
}

fn factorial(q: u32) -> u64 {
    (1..=u64::from(q)).product()
}

#[cfg(test)]
mod tests {
    use super::*;
    use MapKind::{Drift as D, Kick as K};

    #[test]
    fn formulas_are_sums_over_the_maps_in_which_runs_begin() {
        let maps = [(K, "a1"), (D, "b1"), (K, "a2"), (D, "b2")].map(|(kind, name)| (kind, name.to_owned()));
        let formula = |word: &[MapKind]| coefficient(word, &maps);
        assert_eq!(formula(&[K]), "a1 + a2");
        assert_eq!(formula(&[K, K, D]), "a1 ^ 2 / 2 * b1 + (a1 + a2) ^ 2 / 2 * b2");
        assert_eq!(formula(&[K, D, D]), "a1 * ((b1 + b2) ^ 2 - b2 ^ 2) / 2 + (a1 + a2) * b2 ^ 2 / 2");
        assert_eq!(formula(&[K, D, K, D]), "a1 * b1 * a2 * b2");
        assert_eq!((products(&[K, D], 4), products(&[K, D, K, D], 4)), (2, 4));
    }
}
