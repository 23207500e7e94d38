//! Proved scheme → the plan of a step: its maps, the constants they share, and what a step costs.

use crate::symbolic::Rational;

use crate::map::Map;
use crate::map_kind::MapKind;

use crate::scheme::ExactScheme;

/// The maps of one step, each with the index of its weight among the distinct ones.
///
/// Maps of equal kind and weight share one constant. The gradient of the last kick serves the next step's first, so
/// the first map costs no evaluation where both ends of the step are kicks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepPlan {
    /// Distinct weights of the kicks, in the order of their first use.
    pub kicks: Vec<Rational>,
    /// Distinct weights of the drifts, in the order of their first use.
    pub drifts: Vec<Rational>,
    /// Distinct weights of the middle parts of H = H_1 + … + H_n, in the order of their first use; none for two parts.
    pub middle_weights: Vec<Rational>,
    /// Distinct weights of the gradient kicks, in the order of their first use.
    pub gradient_kicks: Vec<Rational>,
    /// What is done: the kind of the map and the index of its weight among the weights of its kind.
    pub maps: Vec<(MapKind, usize)>,
    /// For [many parts](crate::many_parts): between each map and the next the index of the weight of the middle parts,
    /// which flow from H_2 to H_(n−1) after a kick, and from H_(n−1) to H_2 after a drift. With an
    /// [inner scheme](crate::inner), these are the fast kicks.
    pub middle: Vec<usize>,
    /// Evaluations of the gradient per step, the first step of a run not counted.
    pub evaluations: usize,
    /// Hessian–vector products U_qq M⁻¹U_q per step, one for each gradient kick, the first step of a run not counted.
    pub hessian_products: usize,
}

/// Operations of one step in d dimensions with unit masses, beside the evaluations of the gradient and Hessian–vector
/// products, which include M⁻¹U_q.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepCost {
    /// Multiplications per dimension, and as many additions.
    pub products_per_dimension: usize,
    /// Products that a step carrying β adds, and as many additions.
    pub products_for_beta: usize,
}

impl StepPlan {
    /// The most maps of a step that generated code inlines wherever it is called: 7 are those of Yoshida's scheme of
    /// order 4.
    pub const MOST_INLINED: usize = 8;

    /// The plan of a scheme's step.
    pub fn of(scheme: &ExactScheme) -> StepPlan {
        StepPlan::of_maps(&scheme.maps())
    }

    fn of_maps(maps: &[Map]) -> StepPlan {
        let mut plan = StepPlan {
            kicks: Vec::new(),
            drifts: Vec::new(),
            middle_weights: Vec::new(),
            gradient_kicks: Vec::new(),
            maps: Vec::new(),
            middle: Vec::new(),
            evaluations: 0,
            hessian_products: 0,
        };
        for map in maps {
            let weights = match map.kind {
                MapKind::Kick => &mut plan.kicks,
                MapKind::Drift => &mut plan.drifts,
                MapKind::GradientKick => &mut plan.gradient_kicks,
            };
            plan.maps.push((map.kind, index_of(&map.weight, weights)));
        }
        plan.evaluations = plan.evaluated(|_| true);
        plan.hessian_products = plan.evaluated(|kind| kind == MapKind::GradientKick);
        plan
    }

    /// The plan of its step for three parts and more, with the weights of the middle parts between each map and the
    /// next.
    pub(crate) fn of_many_parts(maps: &[Map], middle: &[Rational]) -> StepPlan {
        let mut plan = StepPlan::of_maps(maps);
        plan.middle = middle.iter().map(|weight| index_of(weight, &mut plan.middle_weights)).collect();
        plan
    }

    /// How many of the runs of kicks and gradient kicks between drifts have a map for which something is evaluated,
    /// which a run at the end of a step leaves to one at the beginning of the next.
    fn evaluated(&self, needs: impl Fn(MapKind) -> bool) -> usize {
        let runs: Vec<_> = self.maps.split(|(kind, _)| *kind == MapKind::Drift).collect();
        let needing = |run: &&[(MapKind, usize)]| run.iter().any(|(kind, _)| needs(*kind));
        let kept = match &runs[..] {
            [first, .., last] => needing(first) && needing(last),
            _ => false,
        };
        runs.iter().filter(|run| needing(run)).count() - usize::from(kept)
    }

    /// The evaluations of a step, Hessian–vector products counted like gradients. It is the degree in (hω)² of the
    /// harmonic oscillator's trace.
    pub fn degree(&self) -> usize {
        self.evaluations + self.hessian_products
    }

    /// How many maps of a kind a step has. With an [inner scheme](crate::inner) the fast forces are evaluated once for
    /// each drift: the fast kicks at both sides of a slow one are at the same q.
    pub fn count(&self, kind: MapKind) -> usize {
        self.maps.iter().filter(|(k, _)| *k == kind).count()
    }

    /// Whether the gradient of the last kick serves the next step's first.
    pub fn keeps_gradient(&self) -> bool {
        let is_kick = |map: Option<&(MapKind, usize)>| map.is_some_and(|(kind, _)| *kind != MapKind::Drift);
        self.maps.len() > 1 && is_kick(self.maps.first()) && is_kick(self.maps.last())
    }

    /// Operations beside the gradient.
    pub fn cost(&self) -> StepCost {
        StepCost {
            products_per_dimension: self.maps.len(),
            products_for_beta: self.maps.len() - self.count(MapKind::Drift),
        }
    }
}

/// The index of a weight among others, to which it is added if it is a new one.
fn index_of(weight: &Rational, weights: &mut Vec<Rational>) -> usize {
    let known = weights.iter().position(|known| known == weight);
    known.unwrap_or_else(|| {
        weights.push(weight.clone());
        weights.len() - 1
    })
}
