//! [time]: how the fictitious time of the steps runs.

use shadowstep::transformed_time::TimeTransformation;
use shadowstep::{Number, Ordered};
use toml::de::DeTable;

use super::reader::Reader;
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
    if !matches!(system.parts, Parts::KineticAndPotential) {
        let help = "remove [time], or write `parts = \"kinetic-potential\"`";
        return reader.toml.wrong(
            &section.at,
            "transformed time requires the parts T(p) and U(q): others have no explicit flows in it",
            help,
        );
    }
    if let Some(message) = wrong_sign(&system) {
        let help = "remove [time]; transformed time is for attraction whose potential is 0 at infinity, as in gravity";
        return reader.toml.wrong(&section.at, message, help);
    }
    Some(System { parts: Parts::TransformedTime(time), ..system })
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

/// Why the initial state has no transformed time, in double precision.
fn wrong_sign(system: &System) -> Option<String> {
    let (q, _) = system.start::<f64>(&());
    let potential = system.potential::<f64>(&());
    let mut scratch = vec![0.0; potential.scratch()];
    potential.prepare(&mut scratch, &());
    let mut energy = <f64 as Number>::zero(&());
    potential.energy(&q, &mut energy, &mut scratch);
    (energy >= 0.0).then(|| {
        format!(
            "transformed time requires U < 0 on the whole orbit, as time runs at a rate that is a function of -U; at t = 0 U is {}",
            energy.to_text()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::shipped::ENCOUNTER_SCENES;
    use shadowstep::tables::Source;

    #[test]
    fn the_shipped_scenes_are_in_transformed_time() {
        for shipped in &ENCOUNTER_SCENES {
            let source = Source { path: "test.toml".to_owned(), text: shipped.text.to_owned() };
            let scene = Scene::read(source).unwrap_or_else(|faults| panic!("{}: {faults}", shipped.name));
            assert_eq!(scene.system.transformed_time(), Some(TimeTransformation::Logarithmic), "{}", shipped.name);
        }
    }
}
