//! Texts with subscripts and words of code in HTML.

use maud::{Markup, html};

use crate::picture::indices::with_indices;

/// A text in which the indices are subscripts, and what is between backticks is code.
pub(super) fn set(text: &str) -> Markup {
    html! {
        @for (number, part) in text.split('`').enumerate() {
            @if number % 2 == 1 { code { (part) } } @else { (with_subscripts(part)) }
        }
    }
}

fn with_subscripts(text: &str) -> Markup {
    html! { @for (before, index) in with_indices(text) { (before) @if !index.is_empty() { sub { (index) } } } }
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
            ("`--stop <T_m>` of E_k", "<code>--stop &lt;T_m&gt;</code> of E<sub>k</sub>"),
            ("T_{<b>} & T_{m", "T<sub>&lt;b&gt;</sub> &amp; T_{m"),
            ("order_used MOST_STEPS STATE_k x_1 T_", "order_used MOST_STEPS STATE_k x_1 T_"),
        ] {
            assert_eq!(set(text).into_string(), expected);
        }
    }
}
