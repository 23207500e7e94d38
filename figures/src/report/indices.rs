//! T_{m,m} and E_k in texts, as they are printed.

use maud::{Markup, html};

/// A text in which what follows the _ of T_{m,m}, E_k and E_40 is set below the line.
pub(super) fn set(text: &str) -> Markup {
    let mut rest = text;
    let mut pieces = Vec::new();
    while let Some((before, index, after)) = first_index(rest) {
        pieces.push((before, index));
        rest = after;
    }
    html! { @for (before, index) in pieces { (before) sub { (index) } } (rest) }
}

/// What is before the first index, the index, and what is after it.
fn first_index(text: &str) -> Option<(&str, &str, &str)> {
    text.match_indices('_').find_map(|(at, _)| {
        let mut before = text[..at].chars().rev();
        let letter = before.next().is_some_and(|letter| "TE".contains(letter));
        // the end of a longer name is no symbol
        if !letter || before.next().is_some_and(|c| c.is_alphanumeric() || c == '_') {
            return None;
        }
        let after = &text[at + 1..];
        let (index, after) = match after.strip_prefix('{') {
            Some(braced) => braced.split_once('}')?,
            None => after.split_at(after.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(after.len())),
        };
        (!index.is_empty()).then_some((&text[..at], index, after))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_set_below_the_line() {
        for (text, expected) in [
            ("|T_{m,m} − T_{m−1,m−1}|", "|T<sub>m,m</sub> − T<sub>m−1,m−1</sub>|"),
            ("E_k, of E_40.", "E<sub>k</sub>, of E<sub>40</sub>."),
            ("E_<b>", "E_&lt;b&gt;"),
            ("T_{<b>} & T_{m", "T<sub>&lt;b&gt;</sub> &amp; T_{m"),
            ("order_used MOST_STEPS STATE_k x_1 T_", "order_used MOST_STEPS STATE_k x_1 T_"),
        ] {
            assert_eq!(set(text).into_string(), expected);
        }
    }
}
