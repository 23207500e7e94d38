//! Texts in pictures: their approximate widths, their places without overlaps, raised and lowered characters.

use maud::{Markup, html};

use super::indices::with_indices;

/// The width of a character in em: about that of `DejaVu Sans`, the widest of the faces that pictures name.
const CHARACTER: f64 = 0.56;

/// How many times as wide a bold face is.
pub(crate) const BOLD: f64 = 1.16;

/// The approximate width of a text at a font size.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    // small raised digits and signs are narrower
    let characters = text.chars().map(|character| match character {
        '⁰'..='⁹' | '¹' | '²' | '³' | '⁻' => 0.7,
        'i' | 'j' | 'l' | '.' | ',' | ' ' | 'I' | '(' | ')' | '\'' => 0.6,
        'm' | 'w' | 'M' | 'W' | '–' | '—' => 1.5,
        _ => 1.0,
    });
    characters.sum::<f64>() * CHARACTER * size
}

/// The lines of a text of at most this width; a single word may be wider.
pub(crate) fn lines(text: &str, most: f64, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Places within `range`, as close as possible to those wanted, and at least `gap` apart.
///
/// They minimise the sum of squared shifts. If the range is too short, the gap is reduced.
pub(crate) fn separate(wanted: &[f64], gap: f64, range: (f64, f64)) -> Vec<f64> {
    let (low, high) = range;
    let gap = gap.min((high - low) / wanted.len().saturating_sub(1).max(1) as f64);
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|&i, &j| wanted[i].total_cmp(&wanted[j]));
    // without their gaps the places must be nondecreasing: violating neighbours are pooled at their mean
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (rank, &i) in order.iter().enumerate() {
        pools.push((wanted[i] - rank as f64 * gap, 1));
        while let [.., (before, m), (after, n)] = pools[..]
            && before > after
        {
            pools.truncate(pools.len() - 2);
            pools.push(((before * m as f64 + after * n as f64) / (m + n) as f64, m + n));
        }
    }
    let highest = high - gap * wanted.len().saturating_sub(1) as f64;
    let risen = pools.iter().flat_map(|&(mean, n)| std::iter::repeat_n(mean.min(highest).max(low), n));
    let mut places = vec![0.0; wanted.len()];
    for ((rank, &i), place) in order.iter().enumerate().zip(risen) {
        places[i] = place + rank as f64 * gap;
    }
    places
}

/// A text with exponents as raised and indices as lowered small letters: many fonts lack some of the raised characters,
/// or have them in two styles.
pub(crate) fn set(text: &str) -> Markup {
    html! {
        @for (before, index) in with_indices(text) {
            (with_exponents(before))
            // the line goes back where the index ends: by 0.3 em of the smaller font
            @if !index.is_empty() {
                tspan dy="0.3em" font-size="0.75em" { (index) } tspan dy="-0.225em" { "\u{200b}" }
            }
        }
    }
}

fn with_exponents(text: &str) -> Markup {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    let characters: Vec<char> = text.chars().collect();
    let mut runs = characters.chunk_by(|a, b| RAISED.contains(*a) == RAISED.contains(*b)).peekable();
    let lowered =
        |raised: &char| RAISED.chars().zip("0123456789-".chars()).find(|(of, _)| of == raised).map(|found| found.1);
    html! {
        @while let Some(run) = runs.next() {
            @if lowered(&run[0]).is_none() {
                (run.iter().collect::<String>())
            } @else {
                tspan dy="-0.4em" font-size="0.75em" { (run.iter().filter_map(lowered).collect::<String>()) }
                @if runs.peek().is_some() { tspan dy="0.3em" { "\u{200b}" } }
            }
        }
    }
}

/// A text with its indices in line: E40.
pub(crate) fn without_marks(text: &str) -> String {
    with_indices(text).into_iter().flat_map(|(before, index)| [before, index]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_that_do_not_touch_stay() {
        assert_eq!(separate(&[50.0, 10.0, 90.0], 15.0, (0.0, 100.0)), [50.0, 10.0, 90.0]);
    }

    #[test]
    fn labels_at_one_place_are_separated_evenly() {
        assert_eq!(separate(&[50.0, 50.0, 50.0], 10.0, (0.0, 100.0)), [40.0, 50.0, 60.0]);
    }

    #[test]
    fn labels_stay_within_the_range() {
        assert_eq!(separate(&[99.0, 98.0, -5.0], 10.0, (0.0, 100.0)), [100.0, 90.0, 0.0]);
        assert_eq!(separate(&[7.0, 7.0, 7.0], 80.0, (0.0, 100.0)), [0.0, 50.0, 100.0]);
        assert!(separate(&[], 10.0, (0.0, 100.0)).is_empty());
    }

    #[test]
    fn long_texts_are_broken_between_words() {
        assert_eq!(lines("one two three", width("one two", 10.0), 10.0), ["one two", "three"]);
        assert_eq!(lines("unbreakable", 1.0, 10.0), ["unbreakable"]);
    }
}
