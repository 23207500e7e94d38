//! What a pair of bodies is: its energy and slope, of one pair or of a block of them.

use std::slice::{from_mut, from_ref};

use shadowstep_schemes::symbolic::{Separation, Summand};

use crate::number::Number;

pub use crate::number::BLOCK;

/// How many blocks of pairs are evaluated at once at most: of one block, an instruction of a formula takes longer to
/// read than to carry out.
pub(crate) const BLOCKS_AT_ONCE: usize = 4;

/// What the energy u of a pair of bodies depends on.
pub trait Pair {
    /// What u is a function of: of d = q_j − q_i on a line, or of r² = |q_j − q_i|² in any dimension.
    fn separation(&self) -> Separation;

    /// What a pair gives to the rate of the sum beside its slope.
    fn summand(&self) -> Summand;

    /// For each property of the bodies, such as a mass, for how many bodies it is given.
    fn properties(&self) -> Vec<usize>;
}

/// The energy u of a pair of bodies i < j. [`crate::potential!`] implements it for a `pair` formula.
pub trait PairPotential<N: Number>: Pair {
    /// Whether several blocks are best evaluated at once: it is so where a call has much to do beside its arithmetic.
    const SEVERAL_BLOCKS: bool = false;

    /// How many numbers of scratch space there must be for every call.
    fn scratch(&self) -> usize;

    /// Puts into the scratch space what every call finds there: what depends on parameters only.
    fn prepare(&self, scratch: &mut [N], context: &N::Context);

    /// energy ← u(x) of the bodies i and j
    fn energy(&self, i: usize, j: usize, x: &N, energy: &mut N, scratch: &mut [N]);

    /// slope ← u'(d) or 2u'(r²), so that ∂u/∂q_j = slope or slope·(q_j − q_i)
    fn slope(&self, i: usize, j: usize, x: &N, slope: &mut N, scratch: &mut [N]);

    /// The slope, and summand ← what [`Pair::summand`] names: d u'(d) − 2u or 2r²u'(r²) − 2u, or u(x)
    fn slope_and_summand(&self, i: usize, j: usize, x: &N, slope: &mut N, summand: &mut N, scratch: &mut [N]);

    /// Its second derivatives, which gradient kicks need; the default has none.
    fn curved(&self) -> Option<&dyn PairCurvature<N>> {
        None
    }

    /// Of one pair, slope ← its slope where `FORCES`, and summand ← its summand where `SUM`, without forces its energy.
    #[inline(always)]
    fn of_one<const FORCES: bool, const SUM: bool>(
        &self,
        [i, j]: [usize; 2],
        x: &N,
        slope: &mut N,
        summand: &mut N,
        scratch: &mut [N],
    ) {
        if !FORCES {
            self.energy(i, j, x, summand, scratch);
        } else if SUM {
            self.slope_and_summand(i, j, x, slope, summand, scratch);
        } else {
            self.slope(i, j, x, slope, scratch);
        }
    }

    /// The same of pairs in up to four blocks, one x for each; `bodies` gives i and j of each place, counted through all
    /// blocks.
    #[inline(always)]
    fn of_places<const W: usize, const FORCES: bool, const SUM: bool>(
        &self,
        bodies: impl Fn(usize) -> [usize; 2],
        x: &[[N; W]],
        slopes: &mut [[N; W]],
        summands: &mut [[N; W]],
        scratch: &mut [N],
    ) {
        for block in 0..x.len() {
            for l in 0..W {
                let (slope, summand) = (&mut slopes[block][l], &mut summands[block][l]);
                self.of_one::<FORCES, SUM>(bodies(block * W + l), &x[block][l], slope, summand, scratch);
            }
        }
    }

    /// The same of the body i with the bodies j, j + 1, …, whose properties are side by side.
    #[inline(always)]
    fn of_blocks<const W: usize, const FORCES: bool, const SUM: bool>(
        &self,
        [i, j]: [usize; 2],
        x: &[[N; W]],
        slopes: &mut [[N; W]],
        summands: &mut [[N; W]],
        scratch: &mut [N],
    ) {
        self.of_places::<W, FORCES, SUM>(|l| [i, j + l], x, slopes, summands, scratch);
    }

    /// The slopes of the body i with a block of bodies j, j + 1, …: `x` gives x of each and something more, which
    /// `take` gets with the slope. What is computed of numbers with derivatives is one loop in it, without calls, which
    /// the compiler makes vector operations of.
    #[inline(always)]
    fn each_slope<M>(
        &self,
        (i, j): (usize, usize),
        x: impl Fn(usize) -> (N, M),
        mut take: impl FnMut(usize, N, M),
        scratch: &mut [N],
    ) {
        let of_places: [(N, M); BLOCK] = std::array::from_fn(x);
        let x = of_places.each_ref().map(|(x, _)| x.clone());
        let (mut slopes, mut summands) = (x.clone(), x.clone());
        let results = (from_mut(&mut slopes), from_mut(&mut summands));
        self.of_blocks::<BLOCK, true, false>([i, j], from_ref(&x), results.0, results.1, scratch);
        for (l, (slope, (_, more))) in slopes.into_iter().zip(of_places).enumerate() {
            take(l, slope, more);
        }
    }
}

/// The second derivatives of a pair's energy u. [`crate::potential!`] implements it for a `pair` formula.
pub trait PairCurvature<N: Number> {
    /// How many numbers of scratch space there must be for every call.
    fn curvature_scratch(&self) -> usize {
        0
    }

    /// Puts into the scratch space what every call finds there: what depends on parameters only.
    fn prepare_curvature(&self, scratch: &mut [N], context: &N::Context) {
        let _ = (scratch, context);
    }

    /// slope as [`PairPotential::slope`], curvature ← u″(d) or 4u″(r²): of a vector with the difference w = v_j − v_i
    /// the pair adds curvature·w, or slope·w + curvature·(dᵀw) d with d = q_j − q_i, to the Hessian–vector product of
    /// the body j.
    fn curvature(&self, i: usize, j: usize, x: &N, slope: &mut N, curvature: &mut N, scratch: &mut [N]);

    /// The same, and rate ← the derivative of the pair's rate: it adds rate·w, or rate·dᵀw, to vᵀ∂(qᵀU_q − 2U)/∂q.
    fn curvature_and_rate(&self, i: usize, j: usize, x: &N, results: [&mut N; 3], scratch: &mut [N]);
}

/// What is at the ends of a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Nothing: the first and the last body have one neighbour.
    Free,
    /// Walls: both have a neighbour that rests at 0.
    Fixed,
    /// The first body follows the last one: a ring. Positions are displacements, hence unwrapped.
    Periodic,
}
