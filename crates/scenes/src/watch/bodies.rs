//! The bodies of a run about a central one: how close they come to each other, and whether the steps resolve that.

use shadowstep::Real;
use shadowstep::number::saved::Fields;

use super::approaches::{Approaches, Interactions};
use super::light::{LightBodies, LightBody};
use super::places::Places;
use crate::scene::System;

/// Follows the bodies of a run in double precision.
pub struct Bodies {
    places: Places,
    approaches: Option<Approaches>,
    light: Option<LightBodies>,
}

impl Bodies {
    /// `None` of a system without planets and light bodies. ε of planets, which costs as much as the forces of a step,
    /// is that of some thousand states, and then of those whose n is a multiple of `every`; light bodies are followed
    /// in steps of h, if that is given.
    pub fn of(system: &System, every: u64, h: Option<f64>) -> Option<Bodies> {
        let approaches = Approaches::of(system, every);
        let light = h.and_then(|h| LightBodies::of(system, h));
        (approaches.is_some() || light.is_some()).then(|| Bodies { places: Places::of(system), approaches, light })
    }

    /// Takes the state n after the last one, in the coordinates of the steps; not one whose bodies are so far away that
    /// cubes of distances overflow.
    pub fn include<N: Real>(&mut self, n: i64, q: &[N]) {
        let Bodies { places, approaches, light } = self;
        if !places.take(q) {
            return;
        }
        approaches.iter_mut().for_each(|approaches| approaches.include(n, places));
        light.iter_mut().for_each(|light| light.include(n, places));
    }

    /// What the states so far have shown of planets.
    pub fn interactions(&self) -> Option<Interactions> {
        self.approaches.as_ref().map(Approaches::found)
    }

    /// What they have shown of light bodies that were near a planet.
    pub fn light(&self) -> Vec<LightBody> {
        self.light.as_ref().map_or(Vec::new(), LightBodies::found)
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        self.approaches.iter_mut().for_each(|approaches| approaches.fields(to));
        self.light.iter_mut().for_each(|light| light.fields(to));
    }
}
