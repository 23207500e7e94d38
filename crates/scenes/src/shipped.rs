//! Shipped scenes: each a file in `planets/`, `close-encounters/`, `many-parts/`, `explicit-time/`, `magnetic-fields/`,
//! `schemes/`, `liquids/` or `multiple-steps/` of this crate.

use shadowstep::problems::{PROBLEMS, problem};
use shadowstep_symbolic::suggestion;

use crate::error::Error;
use crate::template::template;

/// A shipped scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShippedScene {
    /// Its name.
    pub name: &'static str,
    /// What it is of.
    pub title: &'static str,
    /// Its text.
    pub text: &'static str,
}

/// All shipped scenes, by what they are of; those of shipped problems are [written](scene_text) as templates.
pub const SHIPPED_SCENES: [(&str, &[ShippedScene]); 8] = [
    ("planetary systems", &PLANETARY),
    ("close encounters", &ENCOUNTERS),
    ("three parts", &MANY_PARTS),
    ("explicit time", &EXPLICIT_TIME),
    ("magnetic fields", &MAGNETIC_FIELDS),
    ("liquids", &LIQUIDS),
    ("multiple time steps", &MULTIPLE_STEPS),
    ("schemes with gradient kicks or processors", &SCHEMES),
];

pub(crate) const PLANETARY: [ShippedScene; 8] = [
    ShippedScene {
        name: "outer-planets",
        title: "The Sun and the outer planets, on Kepler orbits that interact",
        text: include_str!("../planets/outer-planets.toml"),
    },
    ShippedScene {
        name: "eight-planets",
        title: "The Sun and the eight planets, by orbital elements",
        text: include_str!("../planets/eight-planets.toml"),
    },
    ShippedScene {
        name: "relativity",
        title: "The same with relativity's part of the turn of the pericentres, by a potential",
        text: include_str!("../planets/relativity.toml"),
    },
    ShippedScene {
        name: "oblate-earth",
        title: "A satellite of the Earth and its oblateness",
        text: include_str!("../planets/oblate-earth.toml"),
    },
    ShippedScene {
        name: "sun-jupiter-saturn",
        title: "The Sun, Jupiter and Saturn: a kernel with a gradient kick, for the pericentres",
        text: include_str!("../planets/sun-jupiter-saturn.toml"),
    },
    ShippedScene {
        name: "resonance",
        title: "Two planets in the 2:1 resonance",
        text: include_str!("../planets/resonance.toml"),
    },
    ShippedScene {
        name: "hierarchical-triple",
        title: "A binary and a distant third star on an inclined orbit",
        text: include_str!("../planets/hierarchical-triple.toml"),
    },
    ShippedScene {
        name: "meeting-planets",
        title: "Two planets that come close to each other again and again, with their elements",
        text: include_str!("../planets/meeting-planets.toml"),
    },
];

pub(crate) const ENCOUNTERS: [ShippedScene; 2] = [
    ShippedScene {
        name: "eccentric-kepler",
        title: "Kepler's problem with e = 0.999, in logarithmic time",
        text: include_str!("../close-encounters/eccentric-kepler.toml"),
    },
    ShippedScene {
        name: "pythagorean-70",
        title: "The Pythagorean problem until t = 70, in logarithmic time",
        text: include_str!("../close-encounters/pythagorean-70.toml"),
    },
];

pub(crate) const MANY_PARTS: [ShippedScene; 4] = [
    ShippedScene {
        name: "disordered-chain",
        title: "A wave packet in the disordered nonlinear Schrödinger chain",
        text: include_str!("../many-parts/disordered-chain.toml"),
    },
    ShippedScene {
        name: "arenstorf",
        title: "Arenstorf's orbit in the frame of the Earth and the Moon: three bodies, one without mass",
        text: include_str!("../many-parts/arenstorf.toml"),
    },
    ShippedScene {
        name: "kerr",
        title: "A geodesic around a spinning black hole, in five parts",
        text: include_str!("../many-parts/kerr.toml"),
    },
    ShippedScene {
        name: "not-separable",
        title: "A Hamiltonian that is no sum of T(p) and U(q), in the extended phase space",
        text: include_str!("../many-parts/not-separable.toml"),
    },
];

const EXPLICIT_TIME: [ShippedScene; 4] = [
    ShippedScene {
        name: "driven-pendulum",
        title: "A driven pendulum near its separatrix, once a period of the drive",
        text: include_str!("../explicit-time/driven-pendulum.toml"),
    },
    ShippedScene {
        name: "paul-trap",
        title: "An ion in a linear Paul trap",
        text: include_str!("../explicit-time/paul-trap.toml"),
    },
    ShippedScene {
        name: "galactic-bar",
        title: "A star in the potential of a bar that turns",
        text: include_str!("../explicit-time/galactic-bar.toml"),
    },
    ShippedScene {
        name: "two-waves",
        title: "A charge in two waves, once a period of the second",
        text: include_str!("../explicit-time/two-waves.toml"),
    },
];

const MAGNETIC_FIELDS: [ShippedScene; 2] = [
    ShippedScene {
        name: "penning-trap",
        title: "An ion in a Penning trap",
        text: include_str!("../magnetic-fields/penning-trap.toml"),
    },
    ShippedScene {
        name: "drift-in-a-gradient",
        title: "Gyrations that drift around the axis of a field",
        text: include_str!("../magnetic-fields/drift-in-a-gradient.toml"),
    },
];

const SCHEMES: [ShippedScene; 3] = [
    ShippedScene {
        name: "argon-gradient",
        title: "Seven argon atoms by force-gradient kicks",
        text: include_str!("../schemes/argon-gradient.toml"),
    },
    ShippedScene {
        name: "processed-kepler",
        title: "Kepler's problem by a processed scheme of effective order 8",
        text: include_str!("../schemes/processed-kepler.toml"),
    },
    ShippedScene {
        name: "corrected-planets",
        title: "The outer planets with Wisdom's corrector of order 17",
        text: include_str!("../schemes/corrected-planets.toml"),
    },
];

const MULTIPLE_STEPS: [ShippedScene; 1] = [ShippedScene {
    name: "bead-spring-chain",
    title: "A polymer of 16 beads: stiff bonds in substeps, Lennard-Jones forces in steps",
    text: include_str!("../multiple-steps/bead-spring-chain.toml"),
}];

const LIQUIDS: [ShippedScene; 1] = [ShippedScene {
    name: "argon-liquid",
    title: "Liquid argon, 864 atoms in a periodic box at 94.4 K",
    text: include_str!("../liquids/argon-liquid.toml"),
}];

fn all() -> impl Iterator<Item = &'static ShippedScene> {
    SHIPPED_SCENES.iter().flat_map(|(_, scenes)| *scenes)
}

/// The names of all shipped problems and scenes.
pub(crate) fn scene_names() -> impl Iterator<Item = &'static str> {
    PROBLEMS.iter().map(|problem| problem.name()).chain(all().map(|scene| scene.name))
}

/// The text of the shipped scene with this name, or of a scene of the problem with this name.
///
/// ```
/// use shadowstep::tables::Source;
/// use shadowstep_scenes::{Scene, scene_text};
///
/// let text = scene_text("kepler")?;
/// assert!(Scene::read(Source { path: "scene.toml".to_owned(), text }).is_ok());
/// let error = scene_text("eight-planet").unwrap_err().to_string();
/// assert!(error.ends_with("hint: did you mean `eight-planets`?"));
/// # Ok::<(), shadowstep_scenes::Error>(())
/// ```
///
/// # Errors
/// An unknown name; the hint has the nearest known one.
pub fn scene_text(name: &str) -> Result<String, Error> {
    if let Some(scene) = all().find(|scene| scene.name.eq_ignore_ascii_case(name)) {
        return Ok(scene.text.to_owned());
    }
    match problem(name) {
        Ok(problem) => Ok(template(problem.description())),
        Err(_) => {
            let names: Vec<&str> = scene_names().collect();
            Err(Error::usage(format!("there is no problem or shipped scene `{name}`"), suggestion(name, &names)))
        }
    }
}
