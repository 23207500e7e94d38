//! Shipped scenes of planetary systems: each a file in `scenes/planets/`.

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

/// All shipped scenes of planetary systems; those of shipped problems are [written](crate::template) as templates.
pub const PLANETARY_SCENES: [ShippedScene; 4] = [
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
        name: "resonance",
        title: "Two planets in the 2:1 resonance",
        text: include_str!("../planets/resonance.toml"),
    },
    ShippedScene {
        name: "hierarchical-triple",
        title: "A binary and a distant third star on an inclined orbit",
        text: include_str!("../planets/hierarchical-triple.toml"),
    },
];

/// The shipped scene of a planetary system with this name.
pub fn planetary_scene(name: &str) -> Option<&'static ShippedScene> {
    PLANETARY_SCENES.iter().find(|scene| scene.name.eq_ignore_ascii_case(name))
}
