//! Known words that are spelt like a given one.

use strsim::osa_distance;

/// The known word with the smallest distance from `word`; `None` if the distance exceeds a third of the word's letters
/// and 1, or the words have no letter in common, as two of one letter.
///
/// The distance is the number of typing errors: letters missing, added, replaced, or swapped with their neighbours
/// (optimal string alignment). Case does not matter. Among equally near words the first is chosen.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = (word.chars().count() / 3).max(1);
    let with_distance = known.into_iter().map(|other| (distance(word, other), other));
    let length = |other: &str| word.chars().count().max(other.chars().count());
    let near = with_distance.filter(|(errors, other)| *errors <= allowed && *errors < length(other));
    // exchanged letters are likelier than a missing one
    let letters = |text: &str| {
        let mut letters: Vec<char> = text.to_lowercase().chars().collect();
        letters.sort_unstable();
        letters
    };
    near.min_by_key(|(errors, other)| (*errors, letters(other) != letters(word))).map(|(_, found)| found)
}

/// A hint for an unknown word: the nearest known word, or a list of all of them.
pub fn suggestion(word: &str, known: &[&str]) -> String {
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known: {}", list(known)),
    }
}

/// The `count` nearest known words, the nearest first; equally near ones keep their order.
pub fn nearest_few<'a>(word: &str, known: impl IntoIterator<Item = &'a str>, count: usize) -> Vec<&'a str> {
    let mut words: Vec<&str> = known.into_iter().collect();
    words.sort_by_cached_key(|other| distance(word, other));
    words.truncate(count);
    words
}

/// A list of the known words after the nearest one, which may also be one of the `unlisted`.
pub(crate) fn hint(word: &str, known: &[&str], unlisted: &[&str], title: &str, none: &str) -> String {
    let list = if known.is_empty() { none.to_string() } else { format!("{title}: {}", list(known)) };
    match nearest(word, known.iter().chain(unlisted).copied()) {
        Some(near) => format!("did you mean `{near}`? {list}"),
        None => list,
    }
}

/// The words, or the first of them where they would fill a screen, as the coordinates of a hundred bodies do.
fn list(words: &[&str]) -> String {
    const MOST: usize = 40;
    match words.get(MOST..).map(<[_]>::len) {
        Some(more @ 1..) => format!("{}, … and {more} more", words[..MOST].join(", ")),
        _ => words.join(", "),
    }
}

/// The typing errors between two words.
fn distance(one: &str, other: &str) -> usize {
    osa_distance(&one.to_lowercase(), &other.to_lowercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_counts_typing_errors() {
        let table = [
            ("", "", 0),
            ("", "abc", 3),
            ("yoshida", "Yoshida", 0),
            ("yoshida", "yoshda", 1),
            ("yoshida", "yoshidas", 1),
            ("yoshida", "yoshika", 1),
            ("yoshida", "yosihda", 1),
            ("kitten", "sitting", 3),
            ("ç", "c", 1),
        ];
        for (one, other, expected) in table {
            assert_eq!(distance(one, other), expected, "{one} {other}");
            assert_eq!(distance(other, one), expected, "{other} {one}");
        }
    }

    #[test]
    fn distant_words_are_not_suggested() {
        let known = ["strang", "yoshida4", "ruth"];
        assert_eq!(nearest("Strnag", known), Some("strang"));
        assert_eq!(nearest("yoshida6", known), Some("yoshida4"));
        assert_eq!(nearest("rutt", known), Some("ruth"));
        assert_eq!(nearest("leapfrog", known), None);
        assert_eq!(nearest("rxxh", known), None);
        assert_eq!(nearest("strang", []), None);
        assert_eq!((nearest("q", ["x", "y"]), nearest("z", ["x", "pz"])), (None, Some("pz")));
    }

    #[test]
    fn of_equally_near_words_the_first_wins() {
        assert_eq!(nearest("g3", ["g1", "g0"]), Some("g1"));
        assert_eq!(nearest_few("g3", ["long", "g1", "g0", "g3"], 3), ["g3", "g1", "g0"]);
    }

    #[test]
    fn a_long_list_is_cut() {
        let names: Vec<String> = (1..=41).map(|i| format!("x{i}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let known = |count: usize| suggestion("energy", &names[..count]);
        assert!(known(40).ends_with(", x39, x40"), "{}", known(40));
        assert!(known(41).ends_with(", x39, x40, … and 1 more"), "{}", known(41));
    }

    #[test]
    fn few_have_no_cutoff_but_a_count() {
        assert_eq!(nearest_few("x", ["leapfrog", "ruth"], 5), ["ruth", "leapfrog"]);
        assert!(nearest_few("x", ["ruth"], 0).is_empty());
    }
}
