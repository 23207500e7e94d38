//! What the axes and what is kept must fit: the scene.

use std::collections::BTreeSet;
use std::ops::Range;

use shadowstep::tables::Faults;
use shadowstep_scenes::family::Family;
use shadowstep_scenes::{Error, Scene};
use shadowstep_schemes::document::{Fault, Reader};
use shadowstep_schemes::symbolic::nearest;
use toml::de::DeTable;

use super::digests::scheme_axis;
use crate::sweeps::axes::Axes;
use crate::sweeps::axis::Axis;
use crate::sweeps::keep::{Column, Keep};
use crate::sweeps::values::Need;

/// Refuses axes that the scene does not use, words where it needs numbers, and schemes that do not exist.
///
/// # Errors
/// A scene or a table of a scheme that cannot be read.
pub(super) fn axes(reader: &mut Reader<'_>, root: &DeTable<'_>, family: &Family, axes: &Axes) -> Result<(), Error> {
    let (names, whole) = (family.names()?, family.whole_names()?);
    let known: Vec<&str> = axes.all().iter().map(|axis| axis.name.as_str()).collect();
    for (name, at) in whole.iter().filter(|(name, _)| axes.find(name).is_none()) {
        let hint = match nearest(name, known.iter().copied()) {
            Some(near) => format!("did you mean `${near}`?"),
            None => format!("the axes are {}", known.join(", ")),
        };
        reader.faults.push(family.source().fault(at, format!("there is no axis `{name}`")).hint(hint));
    }
    for axis in axes.all().iter().filter(|axis| !whole.iter().any(|(name, _)| *name == axis.name)) {
        match (names.contains(&axis.name), axis.first_word()) {
            (true, None) => {}
            (true, Some((number, error))) => {
                let word = axis.value(number).text();
                let message =
                    if word.len() < 60 { format!("`{word}` is not a number: {error}") } else { error.to_string() };
                let hint = format!("the scene has \"{0}\" for a number; words need \"${0}\" there", axis.name);
                reader.fault(&member(root, axis, number), message, hint);
            }
            (false, word) => {
                let use_it = if word.is_none() { axis.name.clone() } else { format!("${}", axis.name) };
                let hint = format!("write \"{use_it}\" where the scene is to have its value");
                let message = format!("the scene does not use the axis `{}`", axis.name);
                reader.fault(&place(root, axis), message, hint);
            }
        }
    }
    schemes(reader, root, family, axes)
}

/// Reads and proves all schemes of an axis, each with its place.
fn schemes(reader: &mut Reader<'_>, root: &DeTable<'_>, family: &Family, axes: &Axes) -> Result<(), Error> {
    let (scene, _) = shadowstep_schemes::document::document(family.source());
    let axis = scene.as_ref().and_then(|scene| scheme_axis(scene, axes));
    let Some(axis) = axis.filter(|axis| !axis.is_numeric()) else { return Ok(()) };
    for number in 0..axis.count() {
        match family.schemes().scheme_of(&axis.value(number).text(), family.source(), None).map_err(Error::from) {
            Err(Error::Usage { message, hint }) => reader.fault(&member(root, axis, number), message, hint),
            other => drop(other?),
        }
    }
    Ok(())
}

/// Refuses what cannot be kept of this scene.
pub(super) fn scene(reader: &mut Reader<'_>, root: &DeTable<'_>, keep: &Keep, scene: &Scene) {
    for text in keep.expressions() {
        scene.system.check(text, reader);
    }
    let at = root.get("keep").map_or(0..0, |keep| keep.span());
    let output = &scene.output;
    if keep.needs(Need::Estimates) && output.modified_energy.is_none() {
        let hint = "add modified_energy = { estimator = \"bilinear\", order = 16 } to [output] of the scene";
        reader.fault(&at, "drift and permanent_change require an estimator", hint);
    }
    if keep.rows && !output.has_rows() {
        reader.fault(&at, "rows require [output] in the scene", "add output.trajectory = { every = 10 }, for example");
    }
}

/// Refuses two columns of the same name. Those of numbers may have doubles beside them.
pub(super) fn columns(reader: &mut Reader<'_>, root: &DeTable<'_>, axes: &Axes, keep: &Keep, columns: &[Column]) {
    let mut named: Vec<(&str, bool, Range<usize>)> =
        axes.all().iter().map(|axis| (axis.name.as_str(), axis.is_numeric(), place(root, axis))).collect();
    let section = root.get("keep").map_or(0..0, |keep| keep.span());
    for Column { name, is_number, .. } in columns {
        let formula = keep.formulas.iter().rfind(|(text, _)| text.value == *name);
        named.push((name, *is_number, formula.map_or(section.clone(), |(text, _)| text.at.clone())));
    }
    let mut seen = BTreeSet::from(["run", "failure"].map(str::to_owned));
    for (name, is_number, at) in named {
        let own = [Some(name.to_owned()), is_number.then(|| format!("{name}_double"))];
        if let Some(twice) = own.into_iter().flatten().find(|column| !seen.insert(column.clone())) {
            let hint = "give the axis or formula another name";
            reader.fault(&at, format!("two columns would be named `{twice}`"), hint);
        }
    }
}

/// Faults of a scene, where values of axes are of the wrong kind.
pub(super) fn with_axes(faults: Faults, axes: &Axes) -> Faults {
    Faults(faults.0.into_iter().map(|fault| with_axis(fault, axes)).collect())
}

fn with_axis(mut fault: Fault, axes: &Axes) -> Fault {
    let marked: String = fault.source_line.chars().skip(fault.marked.start).take(fault.marked.len()).collect();
    let word = marked.trim_matches('"');
    let Some(axis) = axes.find(word.trim_start_matches('$')) else { return fault };
    if let Some((found, _)) = &mut fault.values {
        match word.starts_with('$') {
            true => *found = format!("{}, a value of the axis `{}`", axis.value(0).text(), axis.name),
            false => fault.hint = Some(format!("write \"${}\" for the value of the axis", axis.name)),
        }
    }
    fault
}

/// The place of the name of an axis.
fn place(root: &DeTable<'_>, axis: &Axis) -> Range<usize> {
    let axes = root.get("axes").and_then(|axes| axes.get_ref().as_table());
    axes.and_then(|axes| axes.get_key_value(axis.name.as_str())).map_or(0..0, |(key, _)| key.span())
}

/// The place of a value of an axis with a list, within its quotes.
fn member(root: &DeTable<'_>, axis: &Axis, number: u64) -> Range<usize> {
    let list = root.get("axes").and_then(|axes| axes.get_ref().get(axis.name.as_str()));
    list.and_then(|list| list.get_ref().get(number as usize)).map_or_else(|| place(root, axis), |value| value.span())
}
