//! T_{m,m} and E_k in texts, with subscripts.

use maud::{Markup, html};

/// A text in which the indices of T_{m,m}, E_k and E_40 are subscripts.
pub(super) fn set(text: &str) -> Markup {
    let mut rest = text;
    let mut pieces = Vec::new();
    while let Some((before, index, after)) = first_index(rest) {
        pieces.push((before, index));
        rest = after;
    }
    html! { @for (before, index) in pieces { (before) sub { (index) } } (rest) }
}

/// The text before the first index, the index, and the text after it.
fn first_index(text: &str) -> Option<(&str, &str, &str)> {
    text.match_indices('_').find_map(|(at, _)| {
        let mut before = text[..at].chars().rev();
        let letter = before.next().is_some_and(|letter| "TE".contains(letter));
        // not the end of a longer name
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
    fn indices_are_subscripts() {
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
