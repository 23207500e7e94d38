//! What a switched cutoff leaves of the energy of a pair: the long-range part.

use shadowstep_symbolic::{Separation, Summand};

use super::cutoff::Cutoff;
use super::pair::{Pair, PairPotential};
use super::switch::{COEFFICIENTS, Polynomial};
use crate::Rational;
use crate::number::Number;

/// The energy (1 − S) u(r²) of a pair, where S falls from 1 to 0 between the two distances of a [switch](super::Switch): with [`CutoffPairs`](super::CutoffPairs), which have
/// S u(r²), it is a splitting of u into a part that is 0 at small distances and one that is 0 at large ones.
///
/// Of pairs in r² whose summand is their rate.
#[derive(Clone, Debug)]
pub(crate) struct LongRange<P> {
    pair: P,
    /// r_c² and 1/(r_c² − r_s²)
    squares: [Rational; 2],
    switch: Polynomial,
}

/// What is in the scratch space before that of the pair: the squares, the coefficients, and t, S, S′ and u.
const OWN: usize = 2 + COEFFICIENTS + 4;

impl<P> LongRange<P> {
    /// The part that this cutoff leaves; `None` if it ends abruptly.
    pub(crate) fn new<const D: usize>(pair: P, cutoff: &Cutoff<D>) -> Option<Self> {
        let [at, _, width] = cutoff.squares();
        let switch = Polynomial { derivatives: cutoff.switch()?.derivatives };
        Some(LongRange { pair, squares: [at, width], switch })
    }
}

impl<P: Pair> Pair for LongRange<P> {
    fn separation(&self) -> Separation {
        self.pair.separation()
    }

    fn summand(&self) -> Summand {
        Summand::Rate
    }

    fn properties(&self) -> Vec<usize> {
        self.pair.properties()
    }
}

impl<P> LongRange<P> {
    /// S and S′/(r_c² − r_s²) in the scratch space, which is given in its parts: those two, a place for u, and that of the pair.
    fn switch<'s, N: Number>(&self, x: &N, scratch: &'s mut [N]) -> ([&'s mut N; 3], &'s mut [N]) {
        let (own, pair) = scratch.split_at_mut(OWN);
        let (constants, places) = own.split_at_mut(2 + COEFFICIENTS);
        let [t, value, slope, energy] = places else { unreachable!("there are four") };
        let [at, width, coefficients @ ..] = &*constants else { unreachable!("there are two and more") };
        let zero = value;
        zero.assign_zero();
        t.assign_difference(at, x);
        t.multiply(width);
        t.make_at_least(zero);
        let coefficients = coefficients.try_into().expect("as many as asked for");
        let (t, value) = (std::array::from_ref(&*t), std::array::from_mut(zero));
        self.switch.assign(coefficients, t, value, std::array::from_mut(slope));
        slope.multiply(width);
        let [value] = value;
        ([value, slope, energy], pair)
    }
}

impl<N: Number, P: PairPotential<N>> PairPotential<N> for LongRange<P> {
    fn scratch(&self) -> usize {
        OWN + self.pair.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let (own, pair) = scratch.split_at_mut(OWN);
        let numbers = self.squares.iter().cloned().chain(self.switch.coefficients());
        own.iter_mut().zip(numbers).for_each(|(own, number)| *own = N::from_rational(&number, context));
        self.pair.prepare(pair, context);
    }

    fn energy(&self, i: usize, j: usize, x: &N, energy: &mut N, scratch: &mut [N]) {
        let ([value, _, of_pair], pair) = self.switch(x, scratch);
        self.pair.energy(i, j, x, of_pair, pair);
        energy.assign(of_pair);
        energy.subtract_product(value, of_pair);
    }

    /// (1 − S) 2u′ + 2u S′/(r_c² − r_s²)
    fn slope(&self, i: usize, j: usize, x: &N, slope: &mut N, scratch: &mut [N]) {
        let ([value, falls, of_pair], pair) = self.switch(x, scratch);
        self.pair.energy(i, j, x, of_pair, pair);
        of_pair.multiply(falls);
        of_pair.multiply_integer(2);
        let mut whole = slope.clone();
        self.pair.slope(i, j, x, &mut whole, pair);
        slope.assign(&whole);
        slope.subtract_product(value, &whole);
        slope.add(of_pair);
    }

    fn slope_and_summand(&self, i: usize, j: usize, x: &N, slope: &mut N, summand: &mut N, scratch: &mut [N]) {
        self.slope(i, j, x, slope, scratch);
        self.energy(i, j, x, summand, scratch);
        summand.multiply_integer(-2);
        summand.add_product(x, slope);
    }
}
