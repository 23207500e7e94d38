//! Indices in texts: T_{m,m}, E_k, E_40, U_q.

/// Letters whose index is written after `_`, as in `E_k`; in braces, any letter may have one.
const LETTERS: &str = "TEUKD";

/// The parts of a text before each index with that index, and the rest with an empty one.
pub(crate) fn with_indices(text: &str) -> Vec<(&str, &str)> {
    let (mut parts, mut rest) = (Vec::new(), text);
    while let Some((before, index, after)) = first_index(rest) {
        parts.push((before, index));
        rest = after;
    }
    parts.push((rest, ""));
    parts
}

/// The text before the first index, the index, and the text after it.
fn first_index(text: &str) -> Option<(&str, &str, &str)> {
    text.match_indices('_').find_map(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + 1..]);
        if let Some((index, after)) = after.strip_prefix('{').and_then(|braced| braced.split_once('}')) {
            return (!index.is_empty() && before.ends_with(char::is_alphabetic)).then_some((before, index, after));
        }
        let mut letters = before.chars().rev();
        let letter = letters.next().is_some_and(|letter| LETTERS.contains(letter));
        // not the end of a longer name
        if !letter || letters.next().is_some_and(|c| c.is_ascii_alphanumeric() || c == '_') {
            return None;
        }
        let (index, after) = after.split_at(after.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(after.len()));
        (!index.is_empty()).then_some((before, index, after))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_found() {
        assert_eq!(first_index("|T_{m,m} − T_{m−1,m−1}|"), Some(("|T", "m,m", " − T_{m−1,m−1}|")));
        assert_eq!(first_index("by E_40."), Some(("by E", "40", ".")));
        assert_eq!(first_index("pᵀU_qq p"), Some(("pᵀU", "qq", " p")));
        assert_eq!(first_index("max_{j=m−11…m−1} e"), Some(("max", "j=m−11…m−1", " e")));
        for text in ["order_used MOST_STEPS STATE_k x_1 T_", "T_{m", "_{m}", "E_"] {
            assert_eq!(first_index(text), None, "{text}");
        }
    }
}
