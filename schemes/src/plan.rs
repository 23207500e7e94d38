//! Proved scheme → the plan of a step: its maps, the constants they share, and what a step costs.

use shadowstep_symbolic::Rational;

use crate::map::MapKind;

use crate::scheme::ExactScheme;

/// The maps of one step, each with the index of its weight among the distinct ones.
///
/// Maps of equal kind and weight share one constant. The gradient of the last kick serves the next step's first, so
/// the first map costs no evaluation where both ends of the step are kicks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Distinct weights of the kicks, in the order of their first use.
    pub kicks: Vec<Rational>,
    /// Distinct weights of the drifts, in the order of their first use.
    pub drifts: Vec<Rational>,
    /// What is done: the kind of the map and the index of its weight in `kicks` or `drifts`.
    pub maps: Vec<(MapKind, usize)>,
    /// Evaluations of the gradient per step, the first step of a run not counted.
    pub evaluations: usize,
}

/// Operations of one step in d dimensions with unit masses, beside the evaluations of the gradient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepCost {
    /// Multiplications per dimension, and as many additions.
    pub products_per_dimension: usize,
    /// Products that a step carrying β adds, and as many additions.
    pub products_for_beta: usize,
}

impl Plan {
    /// The plan of a scheme's step.
    pub fn of(scheme: &ExactScheme) -> Plan {
        let mut plan = Plan { kicks: Vec::new(), drifts: Vec::new(), maps: Vec::new(), evaluations: 0 };
        for map in scheme.maps() {
            let weights = match map.kind {
                MapKind::Kick => &mut plan.kicks,
                MapKind::Drift => &mut plan.drifts,
            };
            let known = weights.iter().position(|w| *w == map.weight);
            let index = known.unwrap_or_else(|| {
                weights.push(map.weight);
                weights.len() - 1
            });
            plan.maps.push((map.kind, index));
        }
        plan.evaluations = plan.count(MapKind::Kick) - usize::from(plan.keeps_gradient());
        plan
    }

    /// How many maps of a kind a step has.
    pub fn count(&self, kind: MapKind) -> usize {
        self.maps.iter().filter(|(k, _)| *k == kind).count()
    }

    /// Whether the gradient of the last kick serves the next step's first.
    pub fn keeps_gradient(&self) -> bool {
        let is_kick = |map: Option<&(MapKind, usize)>| matches!(map, Some((MapKind::Kick, _)));
        self.maps.len() > 1 && is_kick(self.maps.first()) && is_kick(self.maps.last())
    }

    /// Operations beside the gradient.
    pub fn cost(&self) -> StepCost {
        StepCost { products_per_dimension: self.maps.len(), products_for_beta: self.count(MapKind::Kick) }
    }
}
