//! Sums over pairs of bodies: all pairs i < j in D dimensions, or neighbours in a chain.

pub use shadowstep_symbolic::Separation;

use thiserror::Error;

use crate::number::Number;
use crate::potential::Potential;

/// What the energy u of a pair of bodies depends on.
pub trait Pair {
    /// What u is a function of: of d = q_j − q_i on a line, or of r² = |q_j − q_i|² in any dimension.
    fn separation(&self) -> Separation;

    /// For each property of the bodies, such as a mass, for how many bodies it is given.
    fn properties(&self) -> Vec<usize>;
}

/// The energy u of a pair of bodies i < j. [`crate::potential!`] implements it for a `pair` formula.
pub trait PairPotential<N: Number>: Pair {
    /// How many numbers of scratch space there must be for every call.
    fn scratch(&self) -> usize;

    /// Puts into the scratch space what every call finds there: what depends on parameters only.
    fn prepare(&self, scratch: &mut [N], context: &N::Context);

    /// energy ← u(x) of the bodies i and j
    fn energy(&self, i: usize, j: usize, x: &N, energy: &mut N, scratch: &mut [N]);

    /// slope ← u'(d) or 2u'(r²), so that ∂u/∂q_j = slope or slope·(q_j − q_i)
    fn slope(&self, i: usize, j: usize, x: &N, slope: &mut N, scratch: &mut [N]);

    /// The slope, and rate ← d u'(d) − 2u or 2r²u'(r²) − 2u: what the pair adds to qᵀU_q − 2U
    fn slope_and_rate(&self, i: usize, j: usize, x: &N, slope: &mut N, rate: &mut N, scratch: &mut [N]);
}

/// The potential U = Σ u over pairs of bodies in D dimensions.
///
/// The coordinates are those of the first body, then those of the second, and so on.
///
/// ```
/// use shadowstep::{DiagonalMasses, Motion, Rational, pairs::Pairs, potential};
///
/// potential! {
///     /// Newton's gravity.
///     pub struct Gravity { g }
///     pair U(r2; m_i, m_j) = -g * m_i * m_j / sqrt(r2)
/// }
///
/// let gravity = Pairs::<_, 3>::all(2, Gravity { g: 1.0, m: vec![4.0, 2.0] }).unwrap();
/// let masses: Vec<_> = [4, 4, 4, 2, 2, 2].map(|m| Rational::from_integer(m.into())).into();
/// let masses = DiagonalMasses::new(&masses, &()).unwrap();
/// let mut motion = Motion::new(gravity, masses, vec![0.0, 0.0, 0.0, 1.0, 2.0, 2.0], vec![0.0; 6]).unwrap();
/// assert_eq!(motion.energy(), -8.0 / 3.0);
/// ```
#[derive(Clone, Debug)]
pub struct Pairs<P, const D: usize> {
    pair: P,
    bodies: usize,
    which: Which,
}

/// The pairs that interact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Which {
    All,
    Neighbours(Ends),
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

impl<P: Pair, const D: usize> Pairs<P, D> {
    /// Every body interacts with every other one.
    ///
    /// # Errors
    /// No bodies, no dimensions, properties of more or fewer bodies, a pair's formula in d where D is not 1.
    pub fn all(bodies: usize, pair: P) -> Result<Self, PairsError> {
        Self::checked(bodies, pair, Which::All)
    }

    /// Each body interacts with the next one.
    ///
    /// # Errors
    /// As [`Pairs::all`]; fixed ends where the bodies have properties, as walls have none.
    pub fn neighbours(bodies: usize, pair: P, ends: Ends) -> Result<Self, PairsError> {
        if ends == Ends::Fixed && !pair.properties().is_empty() {
            return Err(PairsError::WallsWithoutProperties);
        }
        Self::checked(bodies, pair, Which::Neighbours(ends))
    }

    fn checked(bodies: usize, pair: P, which: Which) -> Result<Self, PairsError> {
        if bodies == 0 || D == 0 {
            return Err(PairsError::Empty);
        }
        if D > 1 && pair.separation() != Separation::SquaredDistance {
            return Err(PairsError::Separation { dimensions: D });
        }
        match pair.properties().into_iter().find(|count| *count != bodies) {
            Some(values) => Err(PairsError::Property { values, bodies }),
            None => Ok(Pairs { pair, bodies, which }),
        }
    }

    /// How many bodies there are.
    pub fn bodies(&self) -> usize {
        self.bodies
    }

    /// The pair's energy.
    pub fn pair(&self) -> &P {
        &self.pair
    }
}

/// Bodies and a pair's energy that do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PairsError {
    /// There is nothing to sum over.
    #[error("a sum over pairs needs at least one body and one dimension")]
    Empty,
    /// A formula in d for bodies that are not on a line.
    #[error("a formula in d is for bodies on a line, not in {dimensions} dimensions; write it in r2")]
    Separation {
        /// The dimensions.
        dimensions: usize,
    },
    /// A property with too few or too many values.
    #[error("a property has {values} values for {bodies} bodies; give one for each body")]
    Property {
        /// The number of its values.
        values: usize,
        /// The number of bodies.
        bodies: usize,
    },
    /// Walls at the ends of a chain of bodies with properties.
    #[error("fixed ends are for pairs without properties, as walls have none")]
    WallsWithoutProperties,
}

/// The scratch space of a call.
struct Scratch<'a, N: Number + 'a, const D: usize> {
    difference: [N::Register<'a>; D],
    squared: N::Register<'a>,
    slope: N::Register<'a>,
    result: N::Register<'a>,
    pair: &'a mut [N],
}

/// difference, squared, slope, result
const fn own_scratch(dimensions: usize) -> usize {
    dimensions + 3
}

#[inline(always)]
fn parts<N: Number, const D: usize>(scratch: &mut [N]) -> Scratch<'_, N, D> {
    let (difference, rest) = scratch.split_first_chunk_mut::<D>().expect("as much as asked for");
    let [squared, slope, result, pair @ ..] = rest else { unreachable!("as much as asked for") };
    let difference = difference.each_mut().map(N::register);
    let [squared, slope, result] = [squared, slope, result].map(N::register);
    Scratch { difference, squared, slope, result, pair }
}

/// A body, or a wall at 0, with its number.
enum End<'a, N, const D: usize> {
    Wall,
    Body(usize, &'a [N; D]),
}

// derived, it would ask for numbers that are `Copy`
impl<N, const D: usize> Copy for End<'_, N, D> {}

impl<N, const D: usize> Clone for End<'_, N, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N: Number, const D: usize> End<'_, N, D> {
    /// A wall is asked for no properties.
    fn number(self) -> usize {
        match self {
            End::Wall => 0,
            End::Body(number, _) => number,
        }
    }

    /// difference ← q_j − q_i
    #[inline(always)]
    fn subtract(i: Self, j: Self, difference: &mut [N::Register<'_>; D]) {
        for (axis, difference) in difference.iter_mut().enumerate() {
            match (i, j) {
                (End::Body(_, i), End::Body(_, j)) => difference.assign_difference(&j[axis], &i[axis]),
                (End::Wall, End::Body(_, j)) => difference.assign(&j[axis]),
                (End::Body(_, i), End::Wall) => {
                    difference.assign(&i[axis]);
                    difference.negate();
                }
                (End::Wall, End::Wall) => difference.assign_zero(),
            }
        }
    }
}

impl<P, const D: usize> Pairs<P, D> {
    /// What u is a function of, from the difference.
    #[inline(always)]
    fn separation<'a, N: Number>(&self, difference: &'a [N::Register<'_>; D], squared: &'a mut N) -> &'a N
    where
        P: PairPotential<N>,
    {
        match self.pair.separation() {
            Separation::Difference => &difference[0],
            Separation::SquaredDistance => {
                let (first, others) = difference.split_first().expect("at least one dimension");
                squared.assign_square(first);
                for other in others {
                    squared.add_product(other, other);
                }
                squared
            }
        }
    }

    /// Visits the pairs that interact.
    fn each<'q, N>(&self, q: &'q [N], visit: impl FnMut(End<'q, N, D>, End<'q, N, D>)) {
        match self.which {
            Which::All => each_pair(q, visit),
            Which::Neighbours(ends) => each_neighbour(q, ends, visit),
        }
    }

    /// gradient ← U_q; `slope` computes a pair's.
    #[inline(always)]
    fn sum_gradient<N: Number>(
        &self,
        q: &[N],
        gradient: &mut [N],
        scratch: &mut [N],
        mut slope: impl FnMut(usize, usize, &N, &mut N, &mut N, &mut [N]),
    ) where
        P: PairPotential<N>,
    {
        gradient.iter_mut().for_each(N::assign_zero);
        let (gradient, _) = gradient.as_chunks_mut::<D>();
        let mut s = parts::<N, D>(scratch);
        // a closure each, so that the loop over all pairs has its own, inlined
        match self.which {
            Which::All => each_pair(q, |i, j| self.add_pair(i, j, gradient, &mut s, &mut slope)),
            Which::Neighbours(ends) => {
                each_neighbour(q, ends, |i, j| self.add_pair(i, j, gradient, &mut s, &mut slope));
            }
        }
    }

    /// Adds what a pair adds to the gradient.
    #[inline(always)]
    fn add_pair<N: Number>(
        &self,
        i: End<'_, N, D>,
        j: End<'_, N, D>,
        gradient: &mut [[N; D]],
        s: &mut Scratch<'_, N, D>,
        slope: &mut impl FnMut(usize, usize, &N, &mut N, &mut N, &mut [N]),
    ) where
        P: PairPotential<N>,
    {
        End::subtract(i, j, &mut s.difference);
        let x = self.separation(&s.difference, &mut s.squared);
        slope(i.number(), j.number(), x, &mut s.slope, &mut s.result, s.pair);
        for difference in s.difference.iter_mut() {
            match self.pair.separation() {
                Separation::Difference => difference.assign(&s.slope),
                Separation::SquaredDistance => difference.multiply(&s.slope),
            }
        }
        if let End::Body(j, _) = j {
            gradient[j].iter_mut().zip(s.difference.iter()).for_each(|(gradient, force)| gradient.add(force));
        }
        if let End::Body(i, _) = i {
            gradient[i].iter_mut().zip(s.difference.iter()).for_each(|(gradient, force)| gradient.subtract(force));
        }
    }
}

/// Visits all pairs i < j.
#[inline(always)]
fn each_pair<'q, N, const D: usize>(q: &'q [N], mut visit: impl FnMut(End<'q, N, D>, End<'q, N, D>)) {
    let (q, _) = q.as_chunks::<D>();
    for (i, q_i) in q.iter().enumerate() {
        for (j, q_j) in q.iter().enumerate().skip(i + 1) {
            visit(End::Body(i, q_i), End::Body(j, q_j));
        }
    }
}

/// Visits the pairs of neighbours in a chain.
fn each_neighbour<'q, N, const D: usize>(q: &'q [N], ends: Ends, mut visit: impl FnMut(End<'q, N, D>, End<'q, N, D>)) {
    let (q, _) = q.as_chunks::<D>();
    let body = |number: usize| End::Body(number, &q[number]);
    let last = q.len() - 1;
    if ends == Ends::Fixed {
        visit(End::Wall, body(0));
    }
    (0..last).for_each(|i| visit(body(i), body(i + 1)));
    match ends {
        Ends::Free => {}
        Ends::Fixed => visit(body(last), End::Wall),
        Ends::Periodic => visit(body(last), body(0)),
    }
}

impl<N: Number, P: PairPotential<N>, const D: usize> Potential<N> for Pairs<P, D> {
    fn dimension(&self) -> usize {
        self.bodies * D
    }

    fn scratch(&self) -> usize {
        own_scratch(D) + self.pair.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.pair.prepare(parts::<N, D>(scratch).pair, context);
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        energy.assign_zero();
        let mut s = parts::<N, D>(scratch);
        self.each(q, |i, j| {
            End::subtract(i, j, &mut s.difference);
            let x = self.separation(&s.difference, &mut s.squared);
            self.pair.energy(i.number(), j.number(), x, &mut s.result, s.pair);
            energy.add(&s.result);
        });
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        self.sum_gradient(q, gradient, scratch, |i, j, x, slope, _, scratch| self.pair.slope(i, j, x, slope, scratch));
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        rate.assign_zero();
        self.sum_gradient(q, gradient, scratch, |i, j, x, slope, part, scratch| {
            self.pair.slope_and_rate(i, j, x, slope, part, scratch);
            rate.add(part);
        });
    }
}
