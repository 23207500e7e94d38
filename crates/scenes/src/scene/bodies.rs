//! The bodies of a system, by the names of its coordinates.

use std::ops::Range;

use shadowstep_schemes::symbolic::nearest;

use crate::scene::System;
use crate::texts::refusal::Refusal;

/// Bodies whose coordinates follow each other.
pub(crate) struct Bodies {
    pub(crate) names: Vec<String>,
    pub(crate) dimensions: usize,
}

impl Bodies {
    /// Those with coordinates such as x_sun, y_sun, x_jupiter, y_jupiter, or those of a sum over pairs; `None` without
    /// bodies.
    pub(crate) fn of(system: &System) -> Option<Bodies> {
        Bodies::named(system).or_else(|| {
            let pairs = system.potential.pairs()?;
            let names = (1..=pairs.bodies).map(|body| body.to_string()).collect();
            Some(Bodies { names, dimensions: pairs.dimensions })
        })
    }

    fn named(system: &System) -> Option<Bodies> {
        let split: Vec<_> = system.coordinates.iter().map(|name| name.split_once('_')).collect::<Option<_>>()?;
        let groups: Vec<_> = split.chunk_by(|a, b| a.1 == b.1).collect();
        let dimensions = groups.first()?.len();
        let is_of_body =
            |group: &&[(&str, &str)]| group.iter().map(|(axis, _)| *axis).eq(AXES.into_iter().take(dimensions));
        let all = groups.len() > 1 && (2..=3).contains(&dimensions) && groups.iter().all(is_of_body);
        all.then(|| Bodies { names: groups.iter().map(|group| group[0].1.to_owned()).collect(), dimensions })
    }

    /// The number of a value of the first body among those of the states: `x` or `px`.
    pub(crate) fn axis(&self, name: &str, momenta: usize) -> Option<usize> {
        let axes: &[&str] = if self.dimensions == 1 { &["q"] } else { &AXES[..self.dimensions] };
        let (axis, begin) = match name {
            "p" if self.dimensions == 1 => ("q", momenta),
            _ => name.strip_prefix('p').map_or((name, 0), |axis| (axis, momenta)),
        };
        axes.iter().position(|known| *known == axis).map(|number| begin + number)
    }

    /// The coordinates of a body among those of the states.
    pub(crate) fn coordinates(&self, body: usize) -> Range<usize> {
        body * self.dimensions..(body + 1) * self.dimensions
    }

    /// The number of a body from 0.
    ///
    /// # Errors
    /// That there is no such body, and which there are.
    pub(crate) fn number(&self, name: &str) -> Result<usize, Refusal> {
        self.names.iter().position(|known| known == name).ok_or_else(|| {
            let hint = match (nearest(name, self.names.iter().map(String::as_str)), &self.names[..]) {
                (Some(near), _) => format!("did you mean `{near}`?"),
                (None, [first, .., last]) => format!("the bodies are {first} to {last}"),
                (None, _) => "the system has one body".to_owned(),
            };
            Refusal::new(format!("there is no body `{name}`"), hint)
        })
    }
}

/// The axes of space.
pub(crate) const AXES: [&str; 3] = ["x", "y", "z"];
