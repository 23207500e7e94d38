//! Shipped scenes: each a file in the folder of its group, such as `planets/`.

use shadowstep::problems::{PROBLEMS, problem};
use shadowstep_schemes::symbolic::suggestion;

use crate::document::template::template;
use crate::texts::error::Error;

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

/// Groups of scenes: what they are of, their folder, and the name and title of each.
macro_rules! shipped {
    ($($what:literal, in $folder:literal: { $($name:literal: $title:literal,)+ })+) => {
        [$(($what, &[$(ShippedScene {
            name: $name,
            title: $title,
            text: include_str!(concat!("../../", $folder, "/", $name, ".toml")),
        }),+])),+]
    };
}

/// All shipped scenes, by what they are of; those of shipped problems are [written](scene_text) as templates.
pub const SHIPPED_SCENES: [(&str, &[ShippedScene]); 8] = shipped! {
    "planetary systems", in "planets": {
        "outer-planets": "The Sun and the outer planets, on Kepler orbits that interact",
        "eight-planets": "The Sun and the eight planets, by orbital elements",
        "relativity": "The same with relativity's part of the turn of the pericentres, by a potential",
        "oblate-earth": "A satellite of the Earth and its oblateness",
        "sun-jupiter-saturn": "The Sun, Jupiter and Saturn: a kernel with a gradient kick, for the pericentres",
        "resonance": "Two planets in the 2:1 resonance",
        "hierarchical-triple": "A binary and a distant third star on an inclined orbit",
        "meeting-planets": "Two planets that come close to each other again and again, with their elements",
    }
    "close encounters", in "close-encounters": {
        "eccentric-kepler": "Kepler's problem with e = 0.999, in logarithmic time",
        "pythagorean-70": "The Pythagorean problem until t = 70, in logarithmic time",
    }
    "three parts", in "many-parts": {
        "disordered-chain": "A wave packet in the disordered nonlinear Schrödinger chain",
        "arenstorf": "Arenstorf's orbit in the frame of the Earth and the Moon: three bodies, one without mass",
        "kerr": "A geodesic around a spinning black hole, in five parts",
        "not-separable": "A Hamiltonian that is no sum of T(p) and U(q), in the extended phase space",
    }
    "explicit time", in "explicit-time": {
        "driven-pendulum": "A driven pendulum near its separatrix, once a period of the drive",
        "paul-trap": "An ion in a linear Paul trap",
        "galactic-bar": "A star in the potential of a bar that turns",
        "two-waves": "A charge in two waves, once a period of the second",
    }
    "magnetic fields", in "magnetic-fields": {
        "penning-trap": "An ion in a Penning trap",
        "drift-in-a-gradient": "Gyrations that drift around the axis of a field",
    }
    "liquids", in "liquids": {
        "argon-liquid": "Liquid argon, 864 atoms in a periodic box at 94.4 K",
    }
    "multiple time steps", in "multiple-steps": {
        "bead-spring-chain": "A polymer of 16 beads: stiff bonds in substeps, Lennard-Jones forces in steps",
    }
    "schemes with gradient kicks or processors", in "schemes": {
        "argon-gradient": "Seven argon atoms by force-gradient kicks",
        "processed-kepler": "Kepler's problem by a processed scheme of effective order 8",
        "corrected-planets": "The outer planets with Wisdom's corrector of order 17",
    }
};

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
