//! The section \[picture\] of a sweep's text, and what it means for its axes and columns.

use shadowstep_schemes::document::{Reader, Text};
use shadowstep_symbolic::nearest;
use toml::de::DeTable;

use super::drawn::{OfSeveral, Picture, Scale};
use crate::axes::Axes;
use crate::axis::Axis;
use crate::keep::Column;
use crate::keys;

/// The keys of \[picture\] that the text has.
#[derive(Clone, Debug, Default)]
pub(crate) struct Written {
    x: Option<Text>,
    y: Option<Text>,
    curves: Option<Text>,
    panels: Option<Text>,
    value: Option<Text>,
    of_several: Option<OfSeveral>,
    scale: Option<Scale>,
    title: Option<Text>,
    label: Option<Text>,
}

impl Written {
    /// Reads the section.
    pub(crate) fn read(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<Written> {
        let before = reader.faults.len();
        let section = reader.section(root, "picture", keys::of("picture"));
        let text = |reader: &mut Reader<'_>, key| section.get(key).and_then(|value| reader.text(value));
        let [x, y, curves, panels, value, title, label] =
            ["x", "y", "curves", "panels", "value", "title", "label"].map(|key| text(reader, key));
        let words = [("mean", OfSeveral::Mean), ("largest", OfSeveral::Largest), ("least", OfSeveral::Least)];
        let of_several = section.get("of_several").and_then(|value| reader.word(value, &words)).map(|word| word.value);
        let words = [("linear", Scale::Linear), ("log", Scale::Logarithmic)];
        let scale = section.get("scale").and_then(|value| reader.word(value, &words)).map(|word| word.value);
        if let (Some(_), Some(curves)) = (&y, &curves) {
            reader.fault(&curves.at, "y and curves are both given", "keep y for a map, or curves for curves");
        }
        let written = Written { x, y, curves, panels, value, of_several, scale, title, label };
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
        let given: Vec<&Text> = [&self.x, &self.y, &self.curves, &self.panels].into_iter().flatten().collect();
        for (place, text) in given.iter().enumerate() {
            if given[..place].iter().any(|other| other.value == text.value) {
                reader.fault(
                    &text.at,
                    format!("the axis `{}` is in the picture twice", text.value),
                    "give another axis",
                );
            }
        }
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
        Some(Picture {
            x: x?,
            y,
            curves,
            panels,
            value: value?,
            of_several,
            scale: self.scale,
            title: self.title.map(|t| t.value),
            label: self.label.map(|l| l.value),
        })
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
