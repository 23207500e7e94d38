//! What charts of a run show: energies in time, orbits, distances of bodies.

use std::ops::Range;
use std::path::PathBuf;

use shadowstep_schemes::symbolic::nearest;

use crate::scene::System;
use crate::scene::bodies::Bodies;
use crate::texts::refusal::{Refusal, refuse};

/// More curves in one chart cannot be told apart.
pub const MOST_CURVES: usize = 12;

/// What can be drawn, for messages.
const KINDS: &str =
    "write energies, orbit=x:y with two coordinates or momenta, distance, distance=1 or distance=1:2 with bodies";

/// The charts of a run, and their file.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The file of the first chart; those of the others have the chart's name before `.svg`.
    pub file: PathBuf,
    /// The place of the file's name in the scene.
    pub at: Range<usize>,
    /// The charts, each once.
    pub pictures: Vec<Picture>,
}

/// One chart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// As it was requested: `orbit=x:y`.
    pub text: String,
    /// What it shows.
    pub content: Content,
}

/// What a chart shows. States are q_1, …, q_d, p_1, …, p_d; numbers of their values begin at 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Content {
    /// |H − H(0)|, |H̄ − H̄*| with the H̄* of the least estimated error, and the estimated error of H̄, in time.
    Energies,
    /// One value of the states against another.
    Orbit {
        /// The names of the axes.
        axes: [String; 2],
        /// A curve for each body, or one.
        curves: Vec<Orbit>,
        /// Whether both axes are lengths.
        is_in_space: bool,
    },
    /// Distances in time.
    Distances(Vec<Distance>),
}

/// A curve of two values of the states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Orbit {
    /// The body, if there are several.
    pub body: Option<String>,
    /// The numbers of both values.
    pub values: [usize; 2],
}

/// The distance of two points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Distance {
    /// `sun–jupiter`, or `|q|`.
    pub label: String,
    /// The numbers of a body's coordinates.
    pub from: Range<usize>,
    /// Those of the other body; `None` for the origin.
    pub to: Option<Range<usize>>,
}

impl Picture {
    /// Reads `energies`, `orbit=x:y`, `distance`, `distance=sun` or `distance=sun:jupiter`.
    ///
    /// # Errors
    /// Another word, a name that the system does not have, more than [`MOST_CURVES`] curves.
    pub fn read(text: &str, system: &System) -> Result<Picture, Refusal> {
        let text = text.replace(' ', "");
        let (kind, names) = text.split_once('=').map_or((&*text, None), |(kind, names)| (kind, Some(names)));
        let names: Vec<&str> = names.map_or(Vec::new(), |names| names.split(':').collect());
        let content = match (kind, &names[..]) {
            ("energies", []) => Content::Energies,
            ("orbit", [x, y]) => orbit(system, [x, y])?,
            ("distance", names) if names.len() <= 2 => distances(system, names)?,
            _ => return refuse(format!("`{text}` cannot be plotted"), KINDS),
        };
        let curves = content.curves();
        if curves > MOST_CURVES {
            let message = format!("`{text}` has {curves} curves; a chart has at most {MOST_CURVES}");
            return refuse(
                message,
                "name one body or two: distance=1 or distance=1:2, or two values of one body: orbit=x1:y1",
            );
        }
        Ok(Picture { text, content })
    }

    /// The chart in names of files: `orbit-x-y`.
    pub fn name(&self) -> String {
        self.text.replace(['=', ':'], "-")
    }
}

impl Content {
    /// The number of curves of one run; energies are those of H and of the modified energy.
    pub fn curves(&self) -> usize {
        match self {
            Content::Energies => 2,
            Content::Orbit { curves, .. } => curves.len(),
            Content::Distances(distances) => distances.len(),
        }
    }

    /// Whether positions and momenta are needed.
    pub fn needs_states(&self) -> bool {
        *self != Content::Energies
    }
}

/// Two coordinates or momenta, or the same axes of all bodies.
fn orbit(system: &System, names: [&str; 2]) -> Result<Content, Refusal> {
    let axes = names.map(str::to_owned);
    let dimension = system.coordinates.len();
    let all: Vec<&String> = system.coordinates.iter().chain(&system.momenta).collect();
    let numbers = names.map(|name| all.iter().position(|known| *known == name));
    if let [Some(x), Some(y)] = numbers {
        let is_in_space = x < dimension && y < dimension;
        return Ok(Content::Orbit { axes, curves: vec![Orbit { body: None, values: [x, y] }], is_in_space });
    }
    if let Some((bodies, [x, y])) = Bodies::of(system).and_then(|bodies| {
        let [x, y] = names.map(|name| bodies.axis(name, dimension));
        Some((bodies, [x?, y?]))
    }) {
        let curve = |(n, body): (usize, &String)| {
            let values = [x, y].map(|value| value + n * bodies.dimensions);
            Orbit { body: Some(body.clone()), values }
        };
        let curves = bodies.names.iter().enumerate().map(curve).collect();
        return Ok(Content::Orbit { axes, curves, is_in_space: x < dimension && y < dimension });
    }
    let unknown = names.iter().zip(numbers).find(|(_, number)| number.is_none()).map_or(names[0], |(name, _)| name);
    let hint = match nearest(unknown, all.iter().map(|name| name.as_str())) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("the coordinates and momenta are {}", some_of(&all)),
    };
    refuse(format!("there is no coordinate or momentum `{unknown}`"), hint)
}

/// The first few of many names.
fn some_of(names: &[&String]) -> String {
    const SHOWN: usize = 12;
    let shown: Vec<&str> = names.iter().take(SHOWN).map(|name| name.as_str()).collect();
    let more = if names.len() > SHOWN { ", …" } else { "" };
    format!("{}{more}", shown.join(", "))
}

/// Of the origin, of every two bodies, of one from the others, or of two.
fn distances(system: &System, names: &[&str]) -> Result<Content, Refusal> {
    let Some(bodies) = Bodies::of(system) else {
        return match names {
            [] => {
                let all = 0..system.coordinates.len();
                Ok(Content::Distances(vec![Distance { label: "|q|".to_owned(), from: all, to: None }]))
            }
            _ => refuse(
                format!("this system has no bodies, so there is no distance of `{}`", names[0]),
                "write `distance` for the distance from the origin",
            ),
        };
    };
    let numbers = names.iter().map(|name| bodies.number(name)).collect::<Result<Vec<_>, _>>()?;
    let count = bodies.names.len();
    let pairs: Vec<(usize, usize)> = match numbers[..] {
        [i, j] if i == j => return refuse(format!("`{0}:{0}` is one body", names[0]), "name two bodies"),
        [i, j] => vec![(i, j)],
        [i] => (0..count).filter(|j| *j != i).map(|j| (i, j)).collect(),
        _ => (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j))).collect(),
    };
    let distance = |(i, j): (usize, usize)| {
        let label = format!("{}–{}", bodies.names[i], bodies.names[j]);
        Distance { label, from: bodies.coordinates(i), to: Some(bodies.coordinates(j)) }
    };
    Ok(Content::Distances(pairs.into_iter().map(distance).collect()))
}

#[cfg(test)]
mod tests {
    use shadowstep::problems::problem;

    use super::*;

    fn read(name: &str, text: &str) -> Result<Content, Refusal> {
        let setup = problem(name).unwrap().setup(&[], 20).unwrap();
        Picture::read(text, &System::of_setup(setup)).map(|picture| picture.content)
    }

    fn message(name: &str, text: &str) -> String {
        let Refusal { message, hint } = read(name, text).unwrap_err();
        format!("{message}\n  hint: {hint}")
    }

    #[test]
    fn an_orbit_is_of_two_values_or_of_every_body() {
        let Ok(Content::Orbit { curves, is_in_space, .. }) = read("kepler", "orbit=y:px") else { panic!() };
        assert_eq!((curves[0].values, curves.len(), is_in_space), ([1, 2], 1, false));
        let Ok(Content::Orbit { curves, is_in_space, .. }) = read("outer-solar-system", "orbit=x:y") else { panic!() };
        assert_eq!((curves[1].values, curves[1].body.as_deref(), is_in_space), ([3, 4], Some("jupiter"), true));
        let Ok(Content::Orbit { curves, .. }) = read("outer-solar-system", "orbit=z:pz") else { panic!() };
        assert_eq!((curves[5].values, curves.len()), ([17, 35], 6));
        let one = read("outer-solar-system", "orbit=x_saturn:y_saturn");
        assert!(matches!(one, Ok(Content::Orbit { curves, .. }) if curves.len() == 1));
    }

    #[test]
    fn distances_are_of_bodies_or_of_the_origin() {
        let labels = |name: &str, text: &str| match read(name, text) {
            Ok(Content::Distances(distances)) => distances.into_iter().map(|d| d.label).collect::<Vec<_>>().join(" "),
            other => panic!("{other:?}"),
        };
        assert_eq!(labels("kepler", "distance"), "|q|");
        assert_eq!(labels("figure-eight", "distance"), "1–2 1–3 2–3");
        assert_eq!(labels("outer-solar-system", "distance=sun:pluto"), "sun–pluto");
        assert_eq!(labels("figure-eight", "distance=2"), "2–1 2–3");
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        for text in ["energy", "orbit=x", "orbit", "energies=x", "distance=1:2:3", "orbit=x:y:px"] {
            assert!(message("kepler", text).starts_with(&format!("`{text}` cannot be plotted")), "{text}");
        }
        assert!(message("kepler", "orbit=x:z").starts_with("there is no coordinate or momentum `z`"));
        assert!(message("kepler", "distance=1").contains("no bodies"));
        assert!(message("figure-eight", "distance=2:2").contains("one body"));
        assert!(message("outer-solar-system", "distance=sun:mars").contains("there is no body `mars`"));
        assert!(message("outer-solar-system", "distance").contains("15 curves"));
    }
}
