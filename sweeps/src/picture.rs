//! \[picture\]: a map of a value over two axes, or curves over one.

mod cells;
mod draw;

use shadowstep_schemes::document::{Key, Keys, Reader, Text};
use shadowstep_symbolic::nearest;
use toml::de::DeTable;

use crate::axes::Axes;
use crate::axis::Axis;
use crate::keep::Column;

pub(crate) use cells::{Cells, fraction};

/// What is drawn: places of axes and of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    pub(crate) x: usize,
    /// The second axis of a map; without one, curves are drawn.
    pub(crate) y: Option<usize>,
    /// The axis with a curve for each value.
    pub(crate) curves: Option<usize>,
    /// The axis with a map for each value.
    pub(crate) panels: Option<usize>,
    /// The column with the values.
    pub(crate) value: usize,
    pub(crate) of_several: OfSeveral,
    /// Of the values; where it is not given, that which suits them.
    pub(crate) scale: Option<Scale>,
}

/// What is shown of several runs at the same place, which differ in other axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OfSeveral {
    Mean,
    Largest,
    Least,
}

/// The scale of the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    Linear,
    Logarithmic,
}

/// \[picture\] as it is written.
#[derive(Clone, Debug, Default)]
pub(crate) struct Written {
    x: Option<Text>,
    y: Option<Text>,
    curves: Option<Text>,
    panels: Option<Text>,
    value: Option<Text>,
    of_several: Option<OfSeveral>,
    scale: Option<Scale>,
}

impl Picture {
    pub(crate) fn read(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<Written> {
        let keys = Keys::new(
            "[picture]",
            [
                Key::new("x", "\"h\""),
                Key::new("y", "\"e\""),
                Key::new("curves", "\"scheme\""),
                Key::new("panels", "\"scheme\""),
                Key::new("value", "\"permanent_change\""),
                Key::new("of_several", "\"largest\""),
                Key::new("scale", "\"log\""),
            ],
        );
        let before = reader.faults.len();
        let section = reader.section(root, "picture", keys);
        let text = |reader: &mut Reader<'_>, key| section.get(key).and_then(|value| reader.text(value));
        let [x, y, curves, panels, value] = ["x", "y", "curves", "panels", "value"].map(|key| text(reader, key));
        let words = [("mean", OfSeveral::Mean), ("largest", OfSeveral::Largest), ("least", OfSeveral::Least)];
        let of_several = section.get("of_several").and_then(|value| reader.word(value, &words)).map(|word| word.value);
        let words = [("linear", Scale::Linear), ("log", Scale::Logarithmic)];
        let scale = section.get("scale").and_then(|value| reader.word(value, &words)).map(|word| word.value);
        if let (Some(_), Some(curves)) = (&y, &curves) {
            reader.fault(&curves.at, "y and curves are both given", "keep y for a map, or curves for curves");
        }
        let written = Written { x, y, curves, panels, value, of_several, scale };
        (reader.faults.len() == before).then_some(written)
    }
}

impl Written {
    /// With what suits the axes and columns where nothing is written; `None` where nothing can be drawn.
    pub(crate) fn resolve(self, reader: &mut Reader<'_>, axes: &Axes, columns: &[Column]) -> Option<Picture> {
        let before = reader.faults.len();
        let all = axes.all();
        let mut axis = |text: &Option<Text>| {
            text.as_ref().and_then(|text| place(reader, text, all.iter().map(|axis| &axis.name), "axis"))
        };
        let [mut x, mut y, mut curves, mut panels] =
            [axis(&self.x), axis(&self.y), axis(&self.curves), axis(&self.panels)];
        let value = match &self.value {
            Some(text) => place(reader, text, columns.iter().map(|column| &column.name), "value"),
            None => {
                columns.iter().position(|column| column.is_number).or(if columns.is_empty() { None } else { Some(0) })
            }
        };
        if reader.faults.len() > before {
            return None;
        }
        let is_free = |taken: &[Option<usize>], place: usize| !taken.contains(&Some(place)) && all[place].count() > 1;
        let ordered = |taken: &[Option<usize>]| {
            let suits = |axis: &Axis| axis.is_numeric() && !axis.is_random();
            (0..all.len()).find(|&place| is_free(taken, place) && suits(&all[place]))
        };
        x = x
            .or_else(|| ordered(&[y, curves, panels]))
            .or_else(|| (0..all.len()).find(|&place| is_free(&[y, curves, panels], place)));
        if self.y.is_none() && curves.is_none() {
            y = ordered(&[x, panels]);
        }
        let words = |taken: &[Option<usize>]| {
            (0..all.len())
                .find(|&place| is_free(taken, place) && !all[place].is_numeric() && all[place].count() <= MOST_PANELS)
        };
        match y {
            Some(_) => panels = panels.or_else(|| words(&[x, y])),
            None => curves = curves.or_else(|| words(&[x, panels])),
        }
        let of_several = self.of_several.unwrap_or(OfSeveral::Mean);
        Some(Picture { x: x?, y, curves, panels, value: value?, of_several, scale: self.scale })
    }
}

/// The most maps or curves that are drawn unless they are asked for.
const MOST_PANELS: u64 = 12;

fn place<'a>(
    reader: &mut Reader<'_>,
    text: &Text,
    names: impl Iterator<Item = &'a String> + Clone,
    what: &str,
) -> Option<usize> {
    let found = names.clone().position(|name| *name == text.value);
    if found.is_none() {
        let all: Vec<&str> = names.map(String::as_str).collect();
        let hint = match nearest(&text.value, all.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("there are {}", all.join(", ")),
        };
        reader.fault(&text.at, format!("there is no {what} `{}`", text.value), hint);
    }
    found
}
