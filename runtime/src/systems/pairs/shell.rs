//! The energy of a pair at some distances.

use shadowstep_schemes::symbolic::{Separation, Summand};

use super::cutoff::Cutoff;
use super::pair::{Pair, PairPotential};
use super::switch::{COEFFICIENTS, Polynomial};
use crate::Rational;
use crate::number::Number;

/// The energy w u(r²) of a pair with w = S_out − S_in, where S_out and S_in fall from 1 to 0 between the two distances
/// of a [switch](super::Switch) each: those of a shell. Without a cutoff S_out is 1, without a smaller one S_in is 0.
/// Shells whose cutoffs follow each other have the sum u.
///
/// Of pairs in r² with a rate of their own.
#[derive(Clone, Debug)]
pub(crate) struct Shell<P> {
    pair: P,
    /// r_c² and 1/(r_c² − r_s²), outside and inside.
    switches: [Option<[Rational; 2]>; 2],
    polynomial: Polynomial,
}

/// What is in the scratch space before that of the pair: the coefficients, the numbers of both switches, and t, S, S′,
/// w, w′ and u.
const OWN: usize = COEFFICIENTS + 4 + 6;

impl<P> Shell<P> {
    /// The part of a pair's energy between the switches of these cutoffs, which have equally many derivatives.
    ///
    /// # Panics
    /// If there is no cutoff, or one that ends abruptly.
    pub(crate) fn new<const D: usize>(pair: P, outer: Option<&Cutoff<D>>, inner: Option<&Cutoff<D>>) -> Self {
        let switch = outer.or(inner).and_then(Cutoff::switch).expect("a shell has a cutoff with a switch");
        let squares = |cutoff: &Cutoff<D>| {
            let [at, _, width] = cutoff.squares();
            [at, width]
        };
        let polynomial = Polynomial { derivatives: switch.derivatives };
        Shell { pair, switches: [outer, inner].map(|cutoff| cutoff.map(squares)), polynomial }
    }

    /// w and w′ = dw/dr² in the scratch space, which is given in its parts: those two, a place for u, and that of the
    /// pair.
    fn weigh<'s, N: Number>(&self, x: &N, scratch: &'s mut [N]) -> ([&'s mut N; 3], &'s mut [N]) {
        let (own, pair) = scratch.split_at_mut(OWN);
        let (constants, places) = own.split_at_mut(COEFFICIENTS + 4);
        let [t, value, slope, weight, change, energy] = places else { unreachable!("there are six") };
        let (coefficients, switches) = constants.split_first_chunk().expect("as many as asked for");
        weight.assign_zero();
        change.assign_zero();
        if self.switches[0].is_none() {
            weight.assign(&coefficients[0]);
        }
        for (place, numbers) in switches.chunks(2).enumerate().filter(|(place, _)| self.switches[*place].is_some()) {
            t.assign_difference(&numbers[0], x);
            t.multiply(&numbers[1]);
            value.assign_zero();
            t.make_at_least(value);
            let ones = (std::array::from_ref(&*t), std::array::from_mut(value), std::array::from_mut(slope));
            self.polynomial.assign(coefficients, ones.0, ones.1, ones.2);
            // dt/dr² = −1/(r_c² − r_s²)
            slope.multiply(&numbers[1]);
            match place {
                0 => {
                    weight.add(value);
                    change.subtract(slope);
                }
                _ => {
                    weight.subtract(value);
                    change.add(slope);
                }
            }
        }
        ([weight, change, energy], pair)
    }
}

impl<P: Pair> Pair for Shell<P> {
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

impl<N: Number, P: PairPotential<N>> PairPotential<N> for Shell<P> {
    fn scratch(&self) -> usize {
        OWN + self.pair.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let (own, pair) = scratch.split_at_mut(OWN);
        let mut assign = |from: usize, numbers: &mut dyn Iterator<Item = Rational>| {
            own[from..].iter_mut().zip(numbers).for_each(|(own, number)| *own = N::from_rational(&number, context));
        };
        assign(0, &mut self.polynomial.coefficients());
        for (place, switch) in self.switches.iter().enumerate() {
            assign(COEFFICIENTS + 2 * place, &mut switch.iter().flatten().cloned());
        }
        self.pair.prepare(pair, context);
    }

    fn energy(&self, i: usize, j: usize, x: &N, energy: &mut N, scratch: &mut [N]) {
        let ([weight, _, of_pair], pair) = self.weigh(x, scratch);
        self.pair.energy(i, j, x, of_pair, pair);
        energy.assign_product(weight, of_pair);
    }

    /// w 2u′ + 2u w′
    fn slope(&self, i: usize, j: usize, x: &N, slope: &mut N, scratch: &mut [N]) {
        let ([weight, change, of_pair], pair) = self.weigh(x, scratch);
        self.pair.slope(i, j, x, of_pair, pair);
        slope.assign_product(weight, of_pair);
        self.pair.energy(i, j, x, of_pair, pair);
        of_pair.multiply_integer(2);
        slope.add_product(change, of_pair);
    }

    fn slope_and_summand(&self, i: usize, j: usize, x: &N, slope: &mut N, summand: &mut N, scratch: &mut [N]) {
        self.slope(i, j, x, slope, scratch);
        self.energy(i, j, x, summand, scratch);
        summand.multiply_integer(-2);
        summand.add_product(x, slope);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact;
    use crate::systems::pairs::{Gravity, Pairs};
    use crate::systems::potential::Potential;

    fn cutoff(at: &str, from: &str) -> Cutoff<2> {
        Cutoff::at(exact(at).unwrap()).unwrap().switched(exact(from).unwrap(), 3).unwrap()
    }

    /// U, its gradient and its rate of two bodies at this distance.
    fn of<P: PairPotential<f64>>(pair: P, distance: f64) -> [f64; 3] {
        let pairs = Pairs::<_, 2>::all(2, pair).unwrap();
        let mut scratch = vec![0.0; Potential::<f64>::scratch(&pairs)];
        pairs.prepare(&mut scratch, &());
        let (q, mut gradient, mut energy, mut rate) = ([0.0, 0.0, distance, 0.0], [0.0; 4], 0.0, 0.0);
        pairs.energy(&q, &mut energy, &mut scratch);
        pairs.gradient_and_rate(&q, &mut gradient, &mut rate, &mut scratch);
        [energy, gradient[2], rate]
    }

    #[test]
    fn shells_have_the_sum_of_the_whole_and_each_the_derivative_of_its_energy() {
        let gravity = || Gravity { g: 2.0, m: vec![3.0, 0.5] };
        let (wide, narrow) = (cutoff("2", "1"), cutoff("1", "0.4"));
        let shells = [(None, Some(&wide)), (Some(&wide), Some(&narrow)), (Some(&narrow), None)];
        let at = |(outer, inner): (Option<&Cutoff<2>>, Option<&Cutoff<2>>), r: f64| {
            of(Shell::new(gravity(), outer, inner), r)
        };
        for r in [0.1, 0.3, 0.4, 0.5, 0.9, 1.0, 1.1, 1.7, 2.0, 5.0] {
            let parts = shells.map(|shell| at(shell, r));
            let whole = of(gravity(), r);
            for number in 0..3 {
                let sum: f64 = parts.iter().map(|part| part[number]).sum();
                assert!((sum / whole[number] - 1.0).abs() < 1e-14, "{r}: {sum} of {whole:?}");
            }
            for shell in shells {
                let [_, slope, rate] = at(shell, r);
                let h = 1e-5;
                let difference = (at(shell, r + h)[0] - at(shell, r - h)[0]) / (2.0 * h);
                // h² of third derivatives up to 1e5
                assert!((difference - slope).abs() < 1e-5 * whole[1].max(1.0), "{r}: {difference} and {slope}");
                assert!((rate - (r * slope - 2.0 * at(shell, r)[0])).abs() < 1e-13 * whole[2].abs());
            }
        }
        assert_eq!(at((None, Some(&wide)), 0.9), [0.0; 3]);
        assert_eq!(at((Some(&narrow), None), 1.1), [0.0; 3]);
    }
}
