//! [time]: how the fictitious time of the steps runs.

use shadowstep::systems::transformed_time::TimeTransformation;
use toml::de::DeTable;

use super::reader::Reader;
use crate::refusal::Refusal;
use crate::scene::split::TransformedTime;
use crate::scene::{Parts, System};
use shadowstep_schemes::document::Section;

/// The name of the section.
pub(super) const TIME: &str = "time";

/// The values of `transform`.
#[derive(Clone, Copy)]
enum Transform {
    Logarithmic,
    Power,
}

const TRANSFORMS: [(&str, Transform); 2] = [("logarithmic", Transform::Logarithmic), ("power", Transform::Power)];

/// The section, if there is one.
pub(super) fn section<'t, 'i>(reader: &mut Reader<'_>, root: &'t DeTable<'i>) -> Section<'t, 'i> {
    reader.section(root, TIME)
}

/// The system in its time.
pub(super) fn transformed(
    reader: &mut Reader<'_>,
    section: &Section<'_, '_>,
    system: Option<System>,
) -> Option<System> {
    if !section.is_there() {
        return system;
    }
    let time = transformation(reader, section);
    let (system, time) = (system?, time?);
    match TransformedTime::of(time, &system, system.parts.is_kinetic_and_potential()) {
        Ok(parts) => Some(System { parts: Parts::TransformedTime(parts), ..system }),
        Err(Refusal { message, hint }) => reader.toml.wrong(&section.at, message, hint),
    }
}

fn transformation(reader: &mut Reader<'_>, section: &Section<'_, '_>) -> Option<TimeTransformation> {
    let exponent = section.get("exponent").map(|value| (value.span(), reader.number(value)));
    let Some(value) = section.get("transform") else {
        reader.toml.missing(section, &["transform"]);
        return None;
    };
    match (reader.word(value, &TRANSFORMS)?, exponent) {
        (Transform::Logarithmic, None) => Some(TimeTransformation::Logarithmic),
        (Transform::Logarithmic, Some((at, _))) => {
            reader.toml.wrong(&at, "logarithmic time has no exponent", "remove it, or write `transform = \"power\"`")
        }
        (Transform::Power, None) => {
            reader.toml.missing(section, &["exponent"]);
            None
        }
        (Transform::Power, Some((at, text))) => {
            let exponent = reader.evaluate(&text?)?;
            match TimeTransformation::power(&exponent.value) {
                Ok(time) => Some(time),
                Err(error) => reader.toml.wrong(&at, error.to_string(), "write an exponent such as \"-1/2\""),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::shipped::ENCOUNTERS;
    use shadowstep::tables::Source;

    #[test]
    fn the_shipped_scenes_are_in_transformed_time() {
        for shipped in &ENCOUNTERS {
            let source = Source { path: "test.toml".to_owned(), text: shipped.text.to_owned() };
            let scene = Scene::read(source).unwrap_or_else(|faults| panic!("{}: {faults}", shipped.name));
            assert_eq!(scene.system.transformed_time(), Some(TimeTransformation::Logarithmic), "{}", shipped.name);
        }
    }
}
