//! What a scheme shall be → tables that meet the order conditions, and make an error or another measure least.
//!
//! The weights that meet the order conditions are a manifold. From random weights, Levenberg and Marquardt's method
//! goes to it; on it, Nelder and Mead's simplex method looks for the least value of the goal, in coordinates along the
//! manifold, which Newton's iteration returns to. What is found in f64 gets as many digits as a table can claim, free
//! parameters of few digits where they cost nothing, and a proof like any table.
//!
//! | module | what it is |
//! | --- | --- |
//! | `request` | the file of a search |
//! | `form` | the table of a form: which weights there are, and which are the same |
//! | `space` | its weights as unknowns, its conditions and maps in f64 |
//! | `manifold` | the way to weights that meet the conditions, and the directions along them |
//! | `nelder_mead` | the least value of a function that may have kinks |
//! | `measure` | what shall be small |
//! | `found` | from the weights found to a table with free parameters of few digits |
//!
//! ```
//! use shadowstep_analysis::search::{Request, Search};
//! use shadowstep_schemes::{Source, shipped};
//!
//! // McLachlan's scheme of two stages and order 2: the least error of all
//! let text = "order = 2\nkinetic = \"any\"\nstages = 2\nminimise = \"effective-error\"\nstarts = 3\n";
//! let request = Request::read(&Source { path: "s2.toml".into(), text: text.into() })?;
//! let search = Search::new(request, &|name, _| shipped(name))?;
//! let candidates: Vec<_> = (0..search.starts()).filter_map(|start| search.start(start)).collect();
//! let best = &search.best(&candidates)[0];
//! assert!((best.weights[0] - 0.1931833275037836).abs() < 1e-6);
//! # Ok::<(), shadowstep_schemes::document::Faults>(())
//! ```

mod form;
mod found;
mod manifold;
mod measure;
mod nelder_mead;
mod request;
mod space;

use std::f64::consts::PI;

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use shadowstep_schemes::Proved;
use shadowstep_schemes::document::Faults;
use shadowstep_schemes::library::Library;
use shadowstep_schemes::order::weighed;

use crate::floats::Floats;
use form::Form;
use manifold::{Tangent, nearest, orthonormal};
use measure::Measures;
pub use measure::{MEASURES, Measure};
pub use request::{Goal, Request};
use space::Space;

/// A search, prepared.
pub struct Search {
    /// What is searched for.
    pub request: Request,
    /// One for each number of stages.
    spaces: Vec<Space>,
    measures: Measures,
}

/// Weights that meet the conditions, with the least value of the goal near them.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The number of the start.
    pub start: usize,
    /// The weights that are different, in the order of the table; then the hω of closed gaps.
    pub weights: Vec<f64>,
    /// The goal's measures.
    pub values: Vec<f64>,
    /// The goal.
    pub goal: f64,
}

/// A random weight is at most this far from an equal share.
const SPREAD: f64 = 0.6;

/// And a gradient kick's from 0.
const SPREAD_OF_GRADIENT_KICKS: f64 = 0.02;

/// What the names of processors' weights begin with.
const PROCESSORS: [char; 3] = ['p', 'y', 'z'];

/// And a processor's.
const SPREAD_OF_PROCESSORS: f64 = 0.3;

/// Attempts to reach the manifold at each start.
const ATTEMPTS: usize = 20;

/// Sizes of the simplices along the manifold, one after the other: large ones leave the ends of narrow valleys.
const SIZES: [f64; 5] = [0.1, 0.03, 0.01, 0.003, 0.001];

/// The most rounds of all sizes.
const MOST_ROUNDS: usize = 30;

/// Evaluations of a simplex for each of its corners.
const EVALUATIONS: usize = 40;

/// A relative gain of a round that is not worth another one.
const NO_GAIN: f64 = 1e-9;

/// Weights that differ by less are those of one scheme.
const SAME: f64 = 1e-3;

/// Of a front, each start favours one of this number of ratios of the measures.
const RATIOS: usize = 9;

impl Search {
    /// Prepares a search.
    ///
    /// # Errors
    /// A base that is not known, or is no base.
    pub fn new(request: Request, library: Library<'_>) -> Result<Search, Faults> {
        let space = |&stages: &usize| {
            let form = Form::of(&request, stages);
            // any decimals that differ
            let values: Vec<_> = (0..form.names().len()).map(|n| format!("0.123456789{}", 1000 + n)).collect();
            Space::of(
                &form.table(&request.name, &values, &[], form.least_order()),
                |cost| request.closed_gaps_at(cost),
                library,
            )
        };
        let spaces = request.stages.iter().map(space).collect::<Result<Vec<_>, _>>()?;
        let measures = Measures::of(&spaces[0].table, request.symmetric);
        Ok(Search { request, spaces, measures })
    }

    /// How many starts there are.
    pub fn starts(&self) -> usize {
        self.request.stages.len() * self.request.starts
    }

    /// The stages of a start.
    pub fn stages(&self, start: usize) -> usize {
        self.request.stages[start / self.request.starts]
    }

    /// A measure of a scheme, computed from its weights as those of candidates are.
    pub fn measure(&self, measure: Measure, proved: &Proved) -> f64 {
        let maps = proved.scheme.maps();
        let maps: Vec<_> = weighed(&maps, &Floats);
        let processed = proved.scheme.processed_maps();
        let processed = processed.map(|maps| weighed(&maps, &Floats));
        let cost = proved.plan.evaluations + proved.plan.hessian_products;
        self.measures.value(measure, (&maps, processed.as_deref()), cost)
    }

    fn space(&self, start: usize) -> &Space {
        &self.spaces[start / self.request.starts]
    }

    /// A measure of a candidate.
    pub fn value(&self, measure: Measure, candidate: &Candidate) -> f64 {
        self.measured(candidate.start, &candidate.weights, &[measure])[0]
    }

    /// What one start finds: the same for the same number and seed. `None` where the conditions are not met near any of
    /// some random weights.
    pub fn start(&self, start: usize) -> Option<Candidate> {
        self.start_while(start, &|| true)
    }

    /// The same, as long as it may continue, which it asks many times.
    pub fn start_while(&self, start: usize, continues: &dyn Fn() -> bool) -> Option<Candidate> {
        let space = self.space(start);
        // a large odd number keeps the seeds of starts apart
        let mut random = Pcg64Mcg::seed_from_u64(self.request.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ start as u64);
        let mut x = (0..ATTEMPTS).find_map(|_| self.nearest(space, &self.random_weights(space, &mut random)))?;
        let mut best = self.goal(start, &x);
        for _ in 0..MOST_ROUNDS {
            let before = best;
            for size in SIZES {
                (x, best) = self.descent(start, (x, best), size, &mut random);
            }
            if before - best <= NO_GAIN * before.abs() || !continues() {
                break;
            }
        }
        Some(Candidate { start, values: self.values(start, &x), weights: x, goal: best })
    }

    /// One simplex along the manifold, of random orientation: the weights with the least goal, and that.
    fn descent(&self, start: usize, (x, goal): (Vec<f64>, f64), size: f64, random: &mut Pcg64Mcg) -> (Vec<f64>, f64) {
        let space = self.space(start);
        let tangent = Tangent::at(space, &x);
        let dimension = tangent.directions.len();
        let at = |y: &[f64]| {
            let moved = tangent.moved(&x, y);
            match tangent.nearest(space, &moved) {
                Some(x) => self.are_small(space, &x).then_some(x),
                None => self.nearest(space, &moved),
            }
        };
        let mut value = |y: &[f64]| at(y).map_or(f64::INFINITY, |x| self.goal(start, &x));
        let vector = |_| (0..dimension).map(|_| uniform(random)).collect::<Vec<_>>();
        let turned = orthonormal((0..dimension).map(vector).collect()).0;
        let corners = turned.into_iter().map(|unit| unit.into_iter().map(|u| u * size).collect());
        let simplex = std::iter::once(vec![0.0; dimension]).chain(corners).collect();
        let (y, least) = nelder_mead::minimise(&mut value, simplex, NO_GAIN / 10.0, EVALUATIONS * (dimension + 1));
        at(&y).filter(|_| least < goal).map_or((x, goal), |x| (x, least))
    }

    /// Weights near some that meet the conditions, and are not too large.
    fn nearest(&self, space: &Space, x: &[f64]) -> Option<Vec<f64>> {
        let all: Vec<usize> = (0..x.len()).collect();
        nearest(space, x, &all).filter(|x| self.are_small(space, x))
    }

    /// Whether no weight is too large.
    fn are_small(&self, space: &Space, x: &[f64]) -> bool {
        x[..x.len() - space.closed_gaps].iter().all(|weight| weight.abs() <= self.request.largest_weight)
    }

    /// Equal shares, and something random beside them; of closed gaps, the places near which they are.
    fn random_weights(&self, space: &Space, random: &mut Pcg64Mcg) -> Vec<f64> {
        let names = space.names();
        let share = |name: &str| match name.as_bytes()[0] {
            b'c' => (0.0, SPREAD_OF_GRADIENT_KICKS),
            _ if name.starts_with(PROCESSORS) => (0.0, SPREAD_OF_PROCESSORS),
            _ => (1.0 / space.cost as f64, SPREAD),
        };
        let gap = |n: usize| ((n + 1) as f64 * PI, SPREAD);
        let ranges = names.into_iter().map(share).chain((0..space.closed_gaps).map(gap));
        ranges.map(|(middle, spread)| middle + spread * uniform(random)).collect()
    }

    fn values(&self, start: usize, x: &[f64]) -> Vec<f64> {
        self.measured(start, x, &self.request.goal.measures())
    }

    fn measured(&self, start: usize, x: &[f64], measures: &[Measure]) -> Vec<f64> {
        let space = self.space(start);
        let (maps, processed) = (space.maps(x), space.processed_maps(x));
        let value = |measure: &Measure| self.measures.value(*measure, (&maps, processed.as_deref()), space.cost);
        measures.iter().map(value).collect()
    }

    fn goal(&self, start: usize, x: &[f64]) -> f64 {
        let values = self.values(start, x);
        match &self.request.goal {
            Goal::Sum(weighed) => weighed.iter().zip(values).map(|((_, factor), value)| factor * value).sum(),
            // measures have no common unit: their logarithms have
            Goal::Front(_) => {
                let share = (start % RATIOS) as f64 / (RATIOS - 1) as f64;
                let shares = [1.0 - share, share];
                values.iter().enumerate().map(|(n, v)| shares[n % 2].max(0.01) * v.max(1e-300).ln()).sum()
            }
        }
    }

    /// The best candidates, at most as many as the request keeps, each scheme once: for a sum those of the least goal,
    /// for a front those that no other surpasses in all measures, evenly along it.
    pub fn best<'c>(&self, candidates: &'c [Candidate]) -> Vec<&'c Candidate> {
        let mut sorted: Vec<&Candidate> =
            candidates.iter().filter(|c| c.values.iter().all(|v| v.is_finite())).collect();
        let by = |candidate: &Candidate| match self.request.goal {
            Goal::Sum(_) => candidate.goal,
            Goal::Front(_) => candidate.values[0],
        };
        sorted.sort_by(|a, b| by(a).total_cmp(&by(b)));
        let mut kept: Vec<&Candidate> = Vec::new();
        for candidate in &sorted {
            let is_new = kept.iter().all(|other| !self.are_same(other, candidate));
            let surpassed = |other: &&Candidate| other.values.iter().zip(&candidate.values).all(|(o, c)| o < c);
            let is_best = match self.request.goal {
                Goal::Sum(_) => true,
                Goal::Front(_) => !sorted.iter().any(surpassed),
            };
            if is_new && is_best {
                kept.push(candidate);
            }
        }
        let (all, keep) = (kept.len(), self.request.keep);
        match self.request.goal {
            Goal::Sum(_) => kept.truncate(keep),
            Goal::Front(_) if all > keep => {
                kept = (0..keep).map(|n| kept[n * (all - 1) / (keep - 1).max(1)]).collect();
            }
            Goal::Front(_) => {}
        }
        kept
    }

    /// Whether the weights of a step are the same, but for what starts end with. Of one kernel many processors are as
    /// good.
    fn are_same(&self, one: &Candidate, other: &Candidate) -> bool {
        let names = self.space(one.start).names();
        let of_step = names.iter().filter(|name| !name.starts_with(PROCESSORS)).count();
        self.stages(one.start) == self.stages(other.start)
            && one.weights[..of_step].iter().zip(&other.weights).all(|(a, b)| (a - b).abs() < SAME)
    }
}

/// Between −1 and 1.
fn uniform(random: &mut Pcg64Mcg) -> f64 {
    2.0 * (random.next_u64() as f64 / u64::MAX as f64) - 1.0
}
