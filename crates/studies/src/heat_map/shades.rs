//! From a value to its colour.
//!
//! A picture has at most 256 colours: those of the colour bar or of the words, and those of special values.

use super::scale::{ends, extremes, scale};
use super::strip::Strip;
use super::{ColourScale, HeatMap};
use crate::picture::ticks::{Scale, significant};

/// The colours of the bar; an odd number, so that 0 has the middle one where both signs occur.
pub(super) const LEVELS: u8 = 249;

// the numbers of special colours, after the levels
pub(super) const ZERO: u8 = LEVELS;
pub(super) const NEGATIVE: u8 = LEVELS + 1;
pub(super) const MINUS_INFINITE: u8 = LEVELS + 2;
pub(super) const INFINITE: u8 = LEVELS + 3;
pub(super) const MISSING: u8 = LEVELS + 4;
/// Below and above the range of the colour bar, with the colours of its ends.
pub(super) const BELOW: u8 = LEVELS + 5;
pub(super) const ABOVE: u8 = LEVELS + 6;

/// Special colours that are not in viridis, with the names of their values.
pub(super) const SPECIAL: [(u8, &str); 5] =
    [(ZERO, "0"), (NEGATIVE, "negative"), (MINUS_INFINITE, "−∞"), (INFINITE, "∞"), (MISSING, "no value")];

/// The eight of Okabe and Ito (2008) and four others, which people with any colour vision can distinguish; neighbours
/// in this order differ in lightness as well.
const OF_WORDS: [[u8; 3]; 12] = [
    [0x00, 0x72, 0xB2],
    [0xF0, 0xE4, 0x42],
    [0xD5, 0x5E, 0x00],
    [0x56, 0xB4, 0xE9],
    [0x00, 0x9E, 0x73],
    [0x88, 0x22, 0x55],
    [0xCC, 0x79, 0xA7],
    [0x33, 0x22, 0x88],
    [0xE6, 0x9F, 0x00],
    [0x8C, 0x51, 0x0A],
    [0xFF, 0xC9, 0xD8],
    [0x00, 0x00, 0x00],
];

pub(super) const MOST_WORDS: usize = OF_WORDS.len();

/// The colours of a picture.
pub(super) struct Shades<'a> {
    words: Option<&'a [String]>,
    pub(super) scale: Scale,
    /// The values at the ends of the colour bar.
    ends: Option<(f64, f64)>,
    /// The same in the measure of the scale; `None` without a finite value.
    pub(super) range: Option<(f64, f64)>,
    /// The smallest and the largest finite value, on a logarithmic scale of the positive ones.
    pub(super) data: Option<(f64, f64)>,
}

impl<'a> Shades<'a> {
    pub(super) fn of(map: &'a HeatMap) -> Shades<'a> {
        let scale = scale(&map.colour, &map.panels);
        if let ColourScale::Words(words) = &map.colour.scale {
            return Shades { words: Some(words), scale, ends: None, range: None, data: None };
        }
        let data = extremes(scale, &map.panels);
        let ends = map.colour.range.or(data).map(|range| ends(scale, range));
        let range = ends.map(|(least, most)| (scale.at(least), scale.at(most)));
        Shades { words: None, scale, ends, range, data }
    }

    pub(super) fn words(&self) -> &'a [String] {
        self.words.unwrap_or_default()
    }

    /// Whether the colours go from negative to positive values.
    fn is_signed(&self) -> bool {
        self.scale != Scale::Log10 && self.range.is_some_and(|(least, most)| least < 0.0 && most > 0.0)
    }

    /// Whether the values differ by so much that a colour bar can have ticks.
    pub(super) fn has_bar(&self) -> bool {
        self.range.is_some_and(|range| Scale::Linear.has_ticks(range))
    }

    /// Special colours beyond the colour bar, with the names of their values.
    pub(super) fn beyond(&self) -> [(u8, String); 2] {
        let (least, most) = self.ends.unwrap_or_default();
        [(BELOW, format!("< {}", significant(least, 4))), (ABOVE, format!("> {}", significant(most, 4)))]
    }

    /// The number of the colour of a value.
    pub(super) fn number(&self, value: Option<f64>) -> u8 {
        let Some(value) = value.filter(|value| !value.is_nan()) else { return MISSING };
        if self.words.is_some() {
            return value as u8;
        }
        if value.is_infinite() {
            return if value > 0.0 { INFINITE } else { MINUS_INFINITE };
        }
        let place = self.scale.at(value);
        match self.range {
            Some((least, _)) if place < least && place.is_finite() => BELOW,
            Some((_, most)) if place > most => ABOVE,
            Some((least, most)) if place.is_finite() => {
                let part = if self.has_bar() { (place - least) / (most - least) } else { 0.5 };
                (part * f64::from(LEVELS - 1)).round() as u8
            }
            _ if value == 0.0 => ZERO,
            _ => NEGATIVE,
        }
    }

    /// The numbers of the colours of a panel, from the lowest row upwards, each row from left to right.
    pub(super) fn numbers(&self, cells: &[Option<f64>], x: &Strip, y: &Strip) -> Vec<u8> {
        let row = |j: &usize| {
            let start = j * x.order.len();
            x.order.iter().map(move |i| self.number(cells[start + i]))
        };
        y.order.iter().flat_map(row).collect()
    }

    /// Red, green and blue of a colour.
    pub(super) fn rgb(&self, number: u8) -> [u8; 3] {
        match number {
            ZERO => [0xFF, 0xFF, 0xFF],
            NEGATIVE => [0xE8, 0x9A, 0xC7],
            MINUS_INFINITE => [0x80, 0x80, 0x80],
            INFINITE | MISSING => [0x00, 0x00, 0x00],
            BELOW => self.rgb(0),
            ABOVE => self.rgb(LEVELS - 1),
            word if self.words.is_some() => OF_WORDS[usize::from(word) % OF_WORDS.len()],
            level => {
                let part = f64::from(level) / f64::from(LEVELS - 1);
                // from blue to red, as temperatures
                let colour = match self.is_signed() {
                    true => colorous::RED_BLUE.eval_continuous(1.0 - part),
                    false => colorous::VIRIDIS.eval_continuous(part),
                };
                [colour.r, colour.g, colour.b]
            }
        }
    }

    /// The same as an attribute of SVG.
    pub(super) fn hex(&self, number: u8) -> String {
        let [r, g, b] = self.rgb(number);
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// The lightness L* of a colour (CIE 1976), from 0 to 100: what remains of it in grey print.
pub(super) fn lightness([r, g, b]: [u8; 3]) -> f64 {
    let linear = |part: u8| match f64::from(part) / 255.0 {
        part if part <= 0.04045 => part / 12.92,
        part => ((part + 0.055) / 1.055).powf(2.4),
    };
    let luminance = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    116.0 * if luminance > 0.008_856 { luminance.cbrt() } else { 7.787 * luminance + 16.0 / 116.0 } - 16.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heat_map::{CellAxis, Colour, Panel};

    fn map(colour: Colour, cells: &[f64]) -> HeatMap {
        let axis = |count: usize| CellAxis::linear("", (0..count).map(|n| n as f64).collect());
        let panel = Panel::new("", cells.iter().copied().map(Some).collect());
        HeatMap::new("", axis(cells.len()), axis(1), colour, vec![panel])
    }

    /// In grey print, a larger value is brighter, by about the same everywhere.
    #[test]
    fn lightness_grows_evenly_along_the_bar() {
        let map = map(Colour::linear(""), &[0.0, 1.0]);
        let shades = Shades::of(&map);
        let light: Vec<_> = (0..LEVELS).map(|level| lightness(shades.rgb(level))).collect();
        let whole = light[usize::from(LEVELS) - 1] - light[0];
        assert!(whole > 70.0, "{whole}");
        for n in 0..31 {
            let part = (light[8 * n + 8] - light[8 * n]) / whole;
            assert!((0.016..0.05).contains(&part), "{n}: {part}");
        }
    }

    #[test]
    fn zero_is_in_the_middle_where_both_signs_occur() {
        for colour in [Colour::linear(""), Colour::symmetric_logarithmic("")] {
            let map = map(colour, &[-1.0, 0.0, 4.0]);
            let shades = Shades::of(&map);
            assert_eq!([0.0, 4.0, -4.0].map(|value| shades.number(Some(value))), [124, 248, 0]);
            let [r, g, b] = shades.rgb(124);
            assert!(r.abs_diff(g) < 8 && g.abs_diff(b) < 8 && r > 230, "{r} {g} {b}");
            let ([red, _, _], [_, _, blue]) = (shades.rgb(248), shades.rgb(0));
            assert!(red > shades.rgb(248)[2] && blue > shades.rgb(0)[0]);
        }
    }

    /// Special values have colours that no number has.
    #[test]
    fn special_values_are_not_mistaken_for_others() {
        let cells = [1e-8, 1.0, 0.0, -2.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        let map = map(Colour::logarithmic(""), &cells);
        let shades = Shades::of(&map);
        let numbers = cells.map(|value| shades.number(Some(value)));
        assert_eq!(numbers, [0, 248, ZERO, NEGATIVE, INFINITE, MINUS_INFINITE, MISSING]);
        assert_eq!(shades.number(None), MISSING);
        let distance = |a: [u8; 3], b: [u8; 3]| (0..3).map(|n| u32::from(a[n].abs_diff(b[n])).pow(2)).sum::<u32>();
        for (number, name) in SPECIAL {
            for level in 0..LEVELS {
                let apart = distance(shades.rgb(number), shades.rgb(level));
                assert!(apart > 50 * 50, "{name} is like level {level}: {apart}");
            }
        }
    }

    #[test]
    fn words_have_different_colours() {
        let words: Vec<_> = (0..MOST_WORDS).map(|n| n.to_string()).collect();
        let map = map(Colour::words("", words), &[0.0, 11.0]);
        let shades = Shades::of(&map);
        for a in 0..MOST_WORDS as u8 {
            for b in 0..a {
                assert_ne!(shades.rgb(a), shades.rgb(b));
            }
            let light = |word| lightness(shades.rgb(word));
            assert!(a == 0 || (light(a) - light(a - 1)).abs() > 10.0, "{a}");
        }
    }
}
