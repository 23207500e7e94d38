//! The section \[picture\] of a sweep's text, and what it means for its axes and columns.

use num_traits::Zero;
use shadowstep::Rational;
use shadowstep_scenes::schema::Table;
use shadowstep_schemes::document::{Placed, Reader, Text};
use shadowstep_symbolic::nearest;
use toml::de::DeTable;

use super::drawn::{OfSeveral, Picture, Scale};
use crate::axes::Axes;
use crate::axis::{Axis, number};
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
    range: Option<Placed<[Rational; 2]>>,
    title: Option<Text>,
    label: Option<Text>,
}

impl Written {
    /// Reads the section.
    pub(crate) fn read(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<Written> {
        let before = reader.faults.len();
        let section = Table::of(reader.source, root, &keys::PICTURE);
        let [x, y, curves, panels, value, title, label] =
            ["x", "y", "curves", "panels", "value", "title", "label"].map(|key| section.text(key));
        let words = [("mean", OfSeveral::Mean), ("largest", OfSeveral::Largest), ("least", OfSeveral::Least)];
        let of_several = section.word("of_several", &words);
        let scale = section.word("scale", &[("linear", Scale::Linear), ("log", Scale::Logarithmic)]);
        let range = section.list("range").and_then(|list| range(reader, &list, scale));
        let written = Written { x, y, curves, panels, value, of_several, scale, range, title, label };
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
        if let Some(range) = self.range.as_ref().filter(|_| y.is_none()) {
            reader.fault(
                &range.at,
                "range is of the colours of a map, and curves are drawn",
                "leave it out, or give y for a map",
            );
            return None;
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
            range: self.range.map(|range| range.value),
            title: self.title.map(|t| t.value),
            label: self.label.map(|l| l.value),
        })
    }
}

/// The values at the ends of the colours.
fn range(reader: &mut Reader<'_>, list: &Placed<Vec<Text>>, scale: Option<Scale>) -> Option<Placed<[Rational; 2]>> {
    const TWO: &str = "the values at both ends, such as [1, 100]";
    let found = list.value.iter().map(|text| number(reader, text)).collect::<Option<Vec<_>>>()?;
    let at = list.at.clone();
    let Ok([least, most]) = <[Rational; 2]>::try_from(found) else {
        return reader.wrong(&at, "range has two values", format!("write {TWO}"));
    };
    if least >= most {
        return reader.wrong(&at, "range must have the smaller value first", format!("write {TWO}"));
    }
    if scale == Some(Scale::Logarithmic) && least <= Rational::zero() {
        return reader.wrong(&at, "the range of a logarithmic scale must be positive", format!("write {TWO}"));
    }
    Some(Placed { value: [least, most], at })
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
