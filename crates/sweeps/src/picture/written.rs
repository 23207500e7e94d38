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

    /// With what suits the axes and columns where nothing is written; `None` where nothing can be drawn.
    pub(crate) fn resolve(self, reader: &mut Reader<'_>, axes: &Axes, columns: &[Column]) -> Option<Picture> {
        let before = reader.faults.len();
        let mut axis = |text: &Option<Text>| {
            let names = axes.all().iter().map(|axis| &axis.name);
            text.as_ref().and_then(|text| place(reader, text, names, "axis"))
        };
        let [x, y, curves, panels] = [&self.x, &self.y, &self.curves, &self.panels].map(&mut axis);
        let value = match &self.value {
            Some(text) => place(reader, text, columns.iter().map(|column| &column.name), "value"),
            None => columns.iter().position(|column| column.is_number).or((!columns.is_empty()).then_some(0)),
        };
        let given: Vec<&Text> = [&self.x, &self.y, &self.curves, &self.panels].into_iter().flatten().collect();
        for (place, text) in given.iter().enumerate() {
            if given[..place].iter().any(|other| other.value == text.value) {
                let message = format!("the axis `{}` is in the picture twice", text.value);
                reader.fault(&text.at, message, "give another axis");
            }
        }
        if reader.faults.len() > before {
            return None;
        }
        let [x, y, curves, panels] = chosen(axes.all(), [x, y, curves, panels]);
        if let Some(range) = self.range.as_ref().filter(|_| y.is_none()) {
            let message = "range is of the colours of a map, and curves are drawn";
            return reader.wrong(&range.at, message, "leave it out, or give y for a map");
        }
        Some(Picture {
            x: x?,
            y,
            curves,
            panels,
            value: value?,
            of_several: self.of_several.unwrap_or(OfSeveral::Mean),
            scale: self.scale,
            range: self.range.map(|range| range.value),
            title: self.title.map(|title| title.value),
            label: self.label.map(|label| label.value),
        })
    }
}

/// The axes of x, y, curves and panels: those that are given, and others that suit.
fn chosen(all: &[Axis], [x, y, curves, panels]: [Option<usize>; 4]) -> [Option<usize>; 4] {
    let free = |taken: &[Option<usize>], suits: fn(&Axis) -> bool| {
        let is_free = |place: usize| !taken.contains(&Some(place)) && all[place].count() > 1;
        (0..all.len()).find(|&place| is_free(place) && suits(&all[place]))
    };
    let ordered = |axis: &Axis| axis.is_numeric() && !axis.is_random();
    let words = |axis: &Axis| !axis.is_numeric() && axis.count() <= MOST_PANELS;
    let taken = [y, curves, panels];
    let x = x.or_else(|| free(&taken, ordered)).or_else(|| free(&taken, |_| true));
    match y.or_else(|| curves.map_or_else(|| free(&[x, panels], ordered), |_| None)) {
        Some(y) => [x, Some(y), curves, panels.or_else(|| free(&[x, Some(y)], words))],
        None => [x, None, curves.or_else(|| free(&[x, panels], words)), panels],
    }
}

/// The values at the ends of the colours.
fn range(reader: &mut Reader<'_>, list: &Placed<Vec<Text>>, scale: Option<Scale>) -> Option<Placed<[Rational; 2]>> {
    let found = list.value.iter().map(|text| number(reader, text)).collect::<Option<Vec<_>>>()?;
    let wrong = match <[Rational; 2]>::try_from(found) {
        Err(_) => "range has two values",
        Ok([least, most]) if least >= most => "range must have the smaller value first",
        Ok([least, _]) if scale == Some(Scale::Logarithmic) && least <= Rational::zero() => {
            "the range of a logarithmic scale must be positive"
        }
        Ok(value) => return Some(Placed { value, at: list.at.clone() }),
    };
    reader.wrong(&list.at, wrong, "write the values at both ends, such as [1, 100]")
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
