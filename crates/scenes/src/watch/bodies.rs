//! The bodies of a run about a central one: how close they come to each other, and whether the steps resolve that.

use shadowstep::Real;
use shadowstep::number::saved::Fields;

use super::approaches::{Approaches, Interactions};
use super::light::{LightBodies, LightBody};
use super::places::Places;
use crate::scene::System;

/// Follows the bodies of a run in double precision.
pub struct Bodies {
    /// The newest states, which are not looked at yet.
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
        if self.places.take(n, q) {
            self.look();
        }
    }

    /// Looks at the states that were taken.
    fn look(&mut self) {
        let Bodies { places, approaches, light } = self;
        places.arrange();
        approaches.iter_mut().for_each(|approaches| approaches.include(places));
        light.iter_mut().for_each(|light| light.include(places));
        places.clear();
    }

    /// What the states so far have shown of planets, and of light bodies that were near a planet.
    pub fn found(&mut self) -> (Option<Interactions>, Vec<LightBody>) {
        self.look();
        (self.approaches.as_ref().map(Approaches::found), self.light.as_ref().map_or(Vec::new(), LightBodies::found))
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        self.look();
        self.approaches.iter_mut().for_each(|approaches| approaches.fields(to));
        self.light.iter_mut().for_each(|light| light.fields(to));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use shadowstep::tables::Source;

    /// Nothing depends on which states are looked at together.
    #[test]
    fn states_together_show_what_they_show_one_by_one() {
        for parts in ["wisdom-holman", "wisdom-holman-heliocentric", "kinetic-potential"] {
            let bodies = "{ mass = 1 }, { mass = 1e-3, a = 1 }, { mass = 1e-7, a = 2 }, { mass = 1e-4, a = 3 }, { mass = \
                          0, a = 4 }, { mass = 0, a = 5 }";
            let text = format!(
                "problem = {{ parts = \"{parts}\", parameters = {{ g = 1 }} }}\nbody = [{bodies}]\n\
                 run = {{ scheme = \"stormer-verlet\", step = 1, steps = 9, digits = \"double\" }}\noutput.energy = true"
            );
            let scene = Scene::read(Source { path: "test.toml".to_owned(), text }).unwrap();
            let begin = || Bodies::of(&scene.system, 7, Some(1.0)).unwrap();
            let (mut together, mut one_by_one) = (begin(), begin());
            let place = |body: i32, n: i64| {
                let (size, angle) = (f64::from(body), 0.9 * n as f64 / f64::from(body.max(1)).powf(1.5));
                [size * angle.cos(), size * angle.sin(), 0.1 * (3.0 * angle).cos()]
            };
            for n in 0..5003 {
                let q: Vec<f64> = (0..6).flat_map(|body| place(body, n)).collect();
                together.include(n, &q[..scene.system.q.len()]);
                one_by_one.include(n, &q[..scene.system.q.len()]);
                one_by_one.look();
            }
            let (planets, light) = together.found();
            assert_eq!((planets, light.len()), (one_by_one.found().0, 3), "{parts}");
            assert_eq!(light, one_by_one.found().1, "{parts}");
        }
    }
}
