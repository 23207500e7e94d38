//! What names and comments claim of a list: that it is a splitting scheme, and its order.

use std::ops::Range;

use crate::known::KNOWN;

/// Words of names and comments of splitting schemes, beside the names of their authors.
const HINTS: [&str; 26] = [
    "composition",
    "drift",
    "forest",
    "gamma",
    "integrator",
    "kick",
    "leapfrog",
    "nystrom",
    "pefrl",
    "position",
    "product",
    "respa",
    "saba",
    "splitting",
    "strang",
    "suzuki",
    "symmetric",
    "symplectic",
    "thermostat",
    "triplejump",
    "trotter",
    "velocity",
    "vefrl",
    "verlet",
    "yoshida",
    "neri",
];

/// Those that names of other things have as well.
const COMMON: [&str; 8] =
    ["drift", "gamma", "integrator", "position", "product", "symmetric", "thermostat", "velocity"];

/// Families of schemes that are called by their authors.
const AUTHORS: [&str; 12] = [
    "blanes",
    "calvo",
    "chin",
    "kahan",
    "mclachlan",
    "morales",
    "omelyan",
    "ruth",
    "sofroniou",
    "suzuki",
    "takahashi",
    "yoshida",
];

/// Numerals before the word "order".
const ORDINALS: [(&str, u32); 9] = [
    ("second", 2),
    ("third", 3),
    ("fourth", 4),
    ("fifth", 5),
    ("sixth", 6),
    ("seventh", 7),
    ("eighth", 8),
    ("ninth", 9),
    ("tenth", 10),
];

/// An order that is claimed, and by what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Claim {
    pub(super) order: u32,
    pub(super) by: String,
}

/// What stands about a list.
pub(super) struct Context {
    /// Its name and that of its function, each with its words.
    names: Vec<(String, Vec<String>)>,
    comments: Vec<String>,
    /// A number that is called `order` beside it.
    order: Option<u32>,
}

/// Bytes before a list in which a comment is about it.
const BEFORE: usize = 400;

impl Context {
    pub(super) fn of(
        text: &str,
        names: &[&str],
        at: &Range<usize>,
        comments: &[Range<usize>],
        orders: &[(i64, usize)],
    ) -> Context {
        let before = at.start.saturating_sub(BEFORE);
        let about = comments.iter().filter(|comment| comment.end > before && comment.start < at.end);
        let line = |place: usize| text[..place].matches('\n').count();
        // the last lines above, and none that belong to another list
        let above = line(at.start).saturating_sub(8);
        let comments =
            about.filter(|comment| line(comment.end) >= above).map(|comment| words(&text[comment.clone()]).join(" "));
        let mut order = orders
            .iter()
            .filter(|(_, place)| *place < at.end && *place + 200 > at.start && line(*place) + 3 >= line(at.start));
        let order = order.next_back().and_then(|(order, _)| u32::try_from(*order).ok()).filter(|order| *order > 1);
        let names =
            names.iter().filter(|name| !name.is_empty()).map(|name| ((*name).to_owned(), words(name))).collect();
        Context { names, comments: comments.collect(), order }
    }

    /// Whether names or comments are of a splitting scheme.
    pub(super) fn hints(&self) -> bool {
        let in_comments = self.comments.iter().flat_map(|comment| comment.split(' '));
        let mut words = self.names.iter().flat_map(|(_, words)| words.iter().map(String::as_str)).chain(in_comments);
        words.any(|word| HINTS.contains(&word) || AUTHORS.contains(&word))
    }

    /// Whether the names alone are of a splitting scheme.
    pub(super) fn are_named(&self) -> bool {
        let is_hint = |word: &&str| HINTS.contains(word) && !COMMON.contains(word);
        self.names.iter().flat_map(|(_, words)| words).any(|word| is_hint(&&**word) || AUTHORS.contains(&&**word))
    }

    /// The order that is claimed: by the name of the list, else that of its function, a key beside it, or the comment
    /// above.
    pub(super) fn order(&self) -> Option<Claim> {
        let by_name = self.names.iter().find_map(|(name, words)| {
            let order = order_in(words).or_else(|| numbered_author(words))?;
            Some(Claim { order, by: format!("`{name}`") })
        });
        let by_key = || self.order.map(|order| Claim { order, by: "`order` beside it".to_owned() });
        by_name.or_else(by_key).or_else(|| {
            let orders = self.comments.iter().rev().filter_map(|comment| {
                let words: Vec<_> = comment.split(' ').map(str::to_owned).collect();
                order_in(&words)
            });
            orders.min().map(|order| Claim { order, by: "the comment".to_owned() })
        })
    }

    /// The author after whom it is named, and the least order of the shipped schemes of that name.
    pub(super) fn author(&self) -> Option<(&'static str, u32)> {
        let words = self.names.first().map(|(_, words)| words)?;
        let author = AUTHORS.into_iter().find(|author| words.iter().any(|word| word == author))?;
        let orders = KNOWN.iter().filter(|known| known.name.starts_with(author)).map(|known| known.table().order.value);
        Some((author, orders.min()?))
    }
}

/// The words of a name or a text in small letters: `lf8Order_a` is lf, 8, order, a.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = vec![String::new()];
    let mut before = ' ';
    for c in text.chars() {
        let begins = c.is_ascii_digit() != before.is_ascii_digit() || (c.is_uppercase() && before.is_lowercase());
        if begins || !c.is_alphanumeric() {
            words.push(String::new());
        }
        if c.is_alphanumeric() {
            words.last_mut().expect("there is one").extend(c.to_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// `fourth order`, `4th order`, `order 4`: the least of all.
fn order_in(words: &[String]) -> Option<u32> {
    let number = |word: &String| word.parse().ok().filter(|order| (2..=12).contains(order));
    let found = (0..words.len()).filter(|i| words[*i] == "order").filter_map(|i| {
        let before = |back: usize| i.checked_sub(back).map(|i| &words[i]);
        let ordinal =
            before(1).and_then(|word| ORDINALS.iter().find(|(name, _)| name == word)).map(|(_, order)| *order);
        let th = || {
            before(1)
                .filter(|word| matches!(&***word, "st" | "nd" | "rd" | "th"))
                .and_then(|_| before(2))
                .and_then(number)
        };
        ordinal.or_else(th).or_else(|| words.get(i + 1).and_then(number))
    });
    found.min()
}

/// `yoshida6`
fn numbered_author(words: &[String]) -> Option<u32> {
    let pairs = words.windows(2).filter(|pair| AUTHORS.contains(&&*pair[0]));
    pairs.filter_map(|pair| pair[1].parse().ok()).find(|order| [4, 6, 8, 10].contains(order))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claimed(name: &str, comment: &str) -> Option<u32> {
        let text = format!("{comment}\nx");
        let at = text.len() - 1..text.len();
        Context::of(&text, &[name], &at, std::slice::from_ref(&(0..comment.len())), &[])
            .order()
            .map(|claim| claim.order)
    }

    #[test]
    fn orders_are_claimed_by_names_before_comments() {
        assert_eq!(claimed("FOURTH_ORDER_COEFFS", "of order 8"), Some(4));
        assert_eq!(claimed("eighthOrder", ""), Some(8));
        assert_eq!(claimed("yoshida6_w", ""), Some(6));
        assert_eq!(claimed("w", "a 4th-order composition of a 2nd-order base"), Some(2));
        assert_eq!(claimed("w", "the fourth-order one"), Some(4));
        assert_eq!(claimed("lf8_6_4_a", "in order of their size"), None);
    }
}
