//! The section \[picture\] of a sweep's text: what it means for its axes and columns.

use num_traits::Zero;
use shadowstep::Rational;
use shadowstep_scenes::schema::Table;
use shadowstep_schemes::document::{Placed, Reader, Text};
use shadowstep_schemes::symbolic::nearest;
use toml::de::DeTable;

use super::drawn::{OfSeveral, Picture, Scale};
use crate::sweeps::axes::Axes;
use crate::sweeps::axis::{Axis, number};
use crate::sweeps::keep::Column;
use crate::sweeps::keys;

impl Picture {
    /// That of the section, with what suits the axes and columns where nothing is written; `None` where nothing can be
    /// drawn.
    pub(crate) fn read(
        reader: &mut Reader<'_>,
        root: &DeTable<'_>,
        axes: &Axes,
        columns: &[Column],
    ) -> Option<Picture> {
        let before = reader.faults.len();
        let section = Table::of(reader.source, root, &keys::PICTURE);
        let texts = ["x", "y", "curves", "panels"].map(|key| section.text(key));
        let names = axes.all().iter().map(|axis| &axis.name);
        let given = texts.each_ref().map(|text| place(reader, text.as_ref()?, names.clone(), "axis"));
        let value = match section.text("value") {
            Some(text) => place(reader, &text, columns.iter().map(|column| &column.name), "value"),
            None => columns.iter().position(|column| column.is_number).or((!columns.is_empty()).then_some(0)),
        };
        let texts: Vec<&Text> = texts.iter().flatten().collect();
        for (place, text) in texts.iter().enumerate() {
            if texts[..place].iter().any(|other| other.value == text.value) {
                let message = format!("the axis `{}` is in the picture twice", text.value);
                reader.fault(&text.at, message, "give another axis");
            }
        }
        let scale = section.word("scale", &[("linear", Scale::Linear), ("log", Scale::Logarithmic)]);
        let range = section.list("range").and_then(|list| range(reader, &list, scale));
        if reader.faults.len() > before {
            return None;
        }
        let [x, y, curves, panels] = chosen(axes.all(), given);
        if range.is_some() && y.is_none() {
            let message = "range is of the colours of a map, and curves are drawn";
            return reader.wrong(&section.place("range"), message, "leave it out, or give y for a map");
        }
        let words = [("mean", OfSeveral::Mean), ("largest", OfSeveral::Largest), ("least", OfSeveral::Least)];
        let of_several = section.word("of_several", &words).unwrap_or(OfSeveral::Mean);
        let [title, label] = ["title", "label"].map(|key| section.text(key).map(|text| text.value));
        Some(Picture { x: x?, y, curves, panels, value: value?, of_several, scale, range, title, label })
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
fn range(reader: &mut Reader<'_>, list: &Placed<Vec<Text>>, scale: Option<Scale>) -> Option<[Rational; 2]> {
    let found = list.value.iter().map(|text| number(reader, text)).collect::<Option<Vec<_>>>()?;
    let wrong = match <[Rational; 2]>::try_from(found) {
        Err(_) => "range has two values",
        Ok([least, most]) if least >= most => "range must have the smaller value first",
        Ok([least, _]) if scale == Some(Scale::Logarithmic) && least <= Rational::zero() => {
            "the range of a logarithmic scale must be positive"
        }
        Ok(ends) => return Some(ends),
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
