//! The weights that meet the order conditions, as a manifold: the way to it from any weights, and its directions.

use crate::search::space::{Linear, Space};

/// Conditions, scaled to slopes of length 1, are met to this: the weights are then off by some units of rounding.
const MET: f64 = 1e-14;

/// What rounding may leave of them where the slopes are badly conditioned.
const NEARLY_MET: f64 = 1e-11;

/// Steps of Levenberg and Marquardt.
const MOST_STEPS: usize = 200;

/// A step moves no weight by more.
const LONGEST_STEP: f64 = 0.3;

/// Steps with the same slopes; where more are needed, new ones are better.
const MOST_CHORDS: usize = 30;

/// Directions with a smaller part along the manifold than this are across it.
const ALONG: f64 = 1e-6;

/// Weights near `from` that meet the conditions, by Levenberg and Marquardt's method on those in `moving`: the steps
/// −Jᵀ(JJᵀ + μ)⁻¹c are the shortest ones that solve the linear equations, for dependent conditions too. `None` where
/// there are none near.
pub(super) fn nearest(space: &Space, from: &[f64], moving: &[usize]) -> Option<Vec<f64>> {
    let mut x = from.to_vec();
    let mut linear = space.linear(&x);
    let mut damping = 1e-3;
    for _ in 0..MOST_STEPS {
        if linear.largest() < MET {
            break;
        }
        let Some(step) = shortest_step(&linear.slopes, &linear.off, moving, damping) else { break };
        let largest = step.iter().fold(0.0, |most: f64, s| most.max(s.abs()));
        let shorter = (LONGEST_STEP / largest).min(1.0);
        let mut moved = x.clone();
        moving.iter().zip(&step).for_each(|(&unknown, s)| moved[unknown] -= s * shorter);
        let there = space.linear(&moved);
        if there.size() < linear.size() {
            (x, linear) = (moved, there);
            damping = (damping / 10.0).max(1e-15);
        } else {
            damping *= 10.0;
            if damping > 1e4 || linear.largest() < NEARLY_MET {
                break;
            }
        }
    }
    (linear.largest() < NEARLY_MET).then_some(x)
}

/// Jᵀ(JJᵀ + μ)⁻¹c along some unknowns; μ is relative to the mean of the diagonal. `None` where rounding made the matrix
/// indefinite.
fn shortest_step(slopes: &[Vec<f64>], off: &[f64], moving: &[usize], damping: f64) -> Option<Vec<f64>> {
    let multipliers = Cholesky::of(slopes, moving, damping)?.solve(off);
    let along = |&u: &usize| slopes.iter().zip(&multipliers).map(|(row, y)| row[u] * y).sum();
    Some(moving.iter().map(along).collect())
}

/// The lower triangle L of JJᵀ + μ = LLᵀ.
struct Cholesky(Vec<Vec<f64>>);

impl Cholesky {
    fn of(slopes: &[Vec<f64>], moving: &[usize], damping: f64) -> Option<Cholesky> {
        let dot = |a: &[f64], b: &[f64]| moving.iter().map(|&u| a[u] * b[u]).sum::<f64>();
        let n = slopes.len();
        let mut l: Vec<Vec<f64>> = (0..n).map(|i| (0..=i).map(|j| dot(&slopes[i], &slopes[j])).collect()).collect();
        let mean = (0..n).map(|i| l[i][i]).sum::<f64>() / n as f64;
        (0..n).for_each(|i| l[i][i] += damping.max(1e-14) * mean);
        for j in 0..n {
            for i in j..n {
                let product: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
                let rest = l[i][j] - product;
                l[i][j] = if i > j { rest / l[j][j] } else { Some(rest).filter(|r| *r > 0.0)?.sqrt() };
            }
        }
        Some(Cholesky(l))
    }

    /// (JJᵀ + μ)⁻¹c
    fn solve(&self, right: &[f64]) -> Vec<f64> {
        let (l, mut y) = (&self.0, right.to_vec());
        for i in 0..y.len() {
            let product: f64 = (0..i).map(|k| l[i][k] * y[k]).sum();
            y[i] = (y[i] - product) / l[i][i];
        }
        for i in (0..y.len()).rev() {
            let product: f64 = (i + 1..y.len()).map(|k| l[k][i] * y[k]).sum();
            y[i] = (y[i] - product) / l[i][i];
        }
        y
    }
}

/// The directions of the manifold, orthonormal, and as many unknowns that can be chosen on it: the coordinates.
pub(super) struct Tangent {
    pub(super) directions: Vec<Vec<f64>>,
    pub(super) coordinates: Vec<usize>,
    linear: Linear,
    factors: Option<Cholesky>,
}

impl Tangent {
    /// At weights that meet the conditions; the coordinates are weights.
    pub(super) fn at(space: &Space, x: &[f64]) -> Tangent {
        let linear = space.linear(x);
        let across = orthonormal(linear.slopes.clone()).0;
        let unit = |n: usize| (0..x.len()).map(|i| if i == n { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
        // twice, so that what rounding leaves of the directions across is small beside what is left
        let along = |n: usize| (0..2).fold(unit(n), |vector, _| without(vector, &across));
        let (directions, coordinates) = orthonormal((0..x.len() - space.closed_gaps).map(along).collect());
        let factors = Cholesky::of(&linear.slopes, &(0..x.len()).collect::<Vec<_>>(), 0.0);
        Tangent { directions, coordinates, linear, factors }
    }

    /// Weights near some that are near those of the tangent, and meet the conditions: Newton's iteration with the
    /// slopes of the tangent, which are not computed again. `None` where it does not converge.
    pub(super) fn nearest(&self, space: &Space, from: &[f64]) -> Option<Vec<f64>> {
        let (mut x, mut last) = (from.to_vec(), f64::INFINITY);
        for _ in 0..MOST_CHORDS {
            let off: Vec<f64> = space.off(&x).iter().zip(&self.linear.scales).map(|(off, scale)| off * scale).collect();
            let largest = off.iter().fold(0.0, |most: f64, off| most.max(off.abs()));
            if largest < MET || largest < NEARLY_MET && largest > last / 2.0 {
                return Some(x);
            }
            if largest.is_nan() || largest >= last / 2.0 {
                return None;
            }
            last = largest;
            for (row, y) in self.linear.slopes.iter().zip(self.factors.as_ref()?.solve(&off)) {
                x.iter_mut().zip(row).for_each(|(x, slope)| *x -= slope * y);
            }
        }
        None
    }

    /// x + Σ y_k·(direction k)
    pub(super) fn moved(&self, x: &[f64], y: &[f64]) -> Vec<f64> {
        let mut moved = x.to_vec();
        for (direction, y) in self.directions.iter().zip(y) {
            moved.iter_mut().zip(direction).for_each(|(x, d)| *x += y * d);
        }
        moved
    }
}

/// Orthonormal vectors that span what some vectors span, by Gram and Schmidt's method, the longest one first each time;
/// and which vectors they began as.
pub(super) fn orthonormal(mut vectors: Vec<Vec<f64>>) -> (Vec<Vec<f64>>, Vec<usize>) {
    let (mut basis, mut places): (Vec<Vec<f64>>, Vec<usize>) = (Vec::new(), Vec::new());
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    while let Some(place) = (0..vectors.len()).max_by(|&a, &b| length(&vectors[a]).total_cmp(&length(&vectors[b]))) {
        let size = length(&vectors[place]);
        if size < ALONG {
            break;
        }
        let unit: Vec<f64> = vectors[place].iter().map(|x| x / size).collect();
        basis.push(without(unit, &basis));
        places.push(place);
        let last = &basis[basis.len() - 1..];
        vectors = vectors.into_iter().map(|vector| without(vector, last)).collect();
    }
    (basis, places)
}

/// A vector without its parts along orthonormal ones.
fn without(mut vector: Vec<f64>, basis: &[Vec<f64>]) -> Vec<f64> {
    for unit in basis {
        let along: f64 = vector.iter().zip(unit).map(|(x, u)| x * u).sum();
        vector.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
    }
    vector
}
