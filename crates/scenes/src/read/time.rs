//! [time]: how the fictitious time of the steps runs.

use shadowstep::systems::transformed_time::TimeTransformation;

use super::reader::Reader;
use crate::document::schema::Table;
use crate::scene::split::TransformedTime;
use crate::scene::{Parts, System};

/// The values of `transform`.
#[derive(Clone, Copy)]
enum Transform {
    Logarithmic,
    Power,
}

const TRANSFORMS: [(&str, Transform); 2] = [("logarithmic", Transform::Logarithmic), ("power", Transform::Power)];

/// The system in its time.
pub(super) fn transformed(reader: &mut Reader<'_>, section: &Table<'_, '_>, system: Option<System>) -> Option<System> {
    if !section.is_there() {
        return system;
    }
    let time = transformation(reader, section);
    let (system, time) = (system?, time?);
    let parts = TransformedTime::of(time, &system, system.parts.is_kinetic_and_potential());
    Some(System { parts: Parts::TransformedTime(reader.found(&section.at, parts)?), ..system })
}

fn transformation(reader: &mut Reader<'_>, section: &Table<'_, '_>) -> Option<TimeTransformation> {
    let transform = section.word("transform", &TRANSFORMS)?;
    match (transform, section.get("exponent")) {
        (Transform::Logarithmic, None) => Some(TimeTransformation::Logarithmic),
        (Transform::Logarithmic, Some(value)) => {
            let help = "remove it, or write `transform = \"power\"`";
            reader.toml.wrong(&value.span(), "logarithmic time has no exponent", help)
        }
        (Transform::Power, None) => {
            let help = "add `exponent = \"-1/2\"`";
            reader.toml.wrong(&section.at, "the key `exponent` is missing", help)
        }
        (Transform::Power, Some(_)) => {
            let (text, exponent) = reader.value(section, "exponent")?;
            match TimeTransformation::power(&exponent.value) {
                Ok(time) => Some(time),
                Err(error) => reader.toml.wrong(&text.at, error.to_string(), "write an exponent such as \"-1/2\""),
            }
        }
    }
}
