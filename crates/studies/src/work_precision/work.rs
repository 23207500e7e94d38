//! What a step costs: evaluations of the gradient, and what costs about as much.

use shadowstep::Scheme;
use shadowstep::steps::scheme::MapKind;
use shadowstep_scenes::System;
use shadowstep_scenes::library::NamedScheme;

/// The parts of a step that cost the most. Each counts as one evaluation of the gradient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the gradient.
    pub forces: u64,
    /// Hessian–vector products, one in each gradient kick.
    pub products: u64,
    /// Flows of a dominant part, such as Kepler orbits: drifts of T(p) alone cost little.
    pub flows: u64,
}

impl Work {
    /// Of a step of a scheme for a system.
    pub(crate) fn of_step(named: &NamedScheme, system: &System) -> Work {
        let sequence = named.scheme.sequence();
        let count = |kind: MapKind| sequence.maps.iter().filter(|(map, _)| *map == kind).count() as u64;
        let flows = if system.parts.has_dominant_part() { count(MapKind::Drift) } else { 0 };
        Work { forces: named.scheme.summary().evaluations as u64, products: count(MapKind::GradientKick), flows }
    }

    /// Of this number of steps.
    #[must_use]
    pub(crate) fn times(self, steps: u64) -> Work {
        let Work { forces, products, flows } = self;
        Work { forces: forces * steps, products: products * steps, flows: flows * steps }
    }

    /// All together.
    pub fn total(self) -> u64 {
        self.forces + self.products + self.flows
    }

    /// `700 forces`, `700 forces, 100 Hessian–vector products, 800 flows`
    pub fn described(self) -> String {
        let others = [(self.products, "Hessian–vector products"), (self.flows, "flows of the dominant part")];
        let others =
            others.into_iter().filter(|(count, _)| *count > 0).map(|(count, name)| format!(", {count} {name}"));
        format!("{} forces", self.forces) + &others.collect::<String>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::tables::Source;
    use shadowstep_scenes::arithmetic::Arithmetic;
    use shadowstep_scenes::library::scheme;

    #[test]
    fn gradient_kicks_and_flows_of_a_dominant_part_are_counted() {
        let work = |name: &str, text: &str| {
            let source = Source { path: "test.toml".to_owned(), text: text.to_owned() };
            let (system, _) = System::read(&source, Arithmetic::DOUBLE).unwrap();
            Work::of_step(&scheme(name).unwrap(), &system)
        };
        let (plain, planets) = (
            "problem.name = 'outer-solar-system'",
            "problem = { name = 'outer-solar-system', parts = 'wisdom-holman' }",
        );
        assert_eq!(work("stormer-verlet", plain), Work { forces: 1, products: 0, flows: 0 });
        assert_eq!(work("chin-4a", plain), Work { forces: 2, products: 1, flows: 0 });
        assert_eq!(work("aba1064", planets), Work { forces: 8, products: 0, flows: 9 });
        assert_eq!(work("wisdom-kernel-7", planets).times(10).total(), 40);
    }
}
