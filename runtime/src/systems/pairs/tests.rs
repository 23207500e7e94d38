//! Sums in blocks against sums of one pair after the other.

use super::{Ends, Pair, Pairs, Summand, Which};
use crate::Potential;
use crate::number::counting::Counting;
use crate::number::instructions::Instructions;
use crate::number::{Dual, Fused, Lanes, Number};
use crate::systems::formula::FormulaPair;
use crate::systems::pairs::{PairPotential, Separation};
use crate::systems::problems::{CubicSpring, Gravity, LennardJones, TodaSpring};

crate::potential! {
    /// Its rate is computed from its energy.
    struct Softened { s }
    pair U(r2; m_i, m_j) = -m_i * m_j / sqrt(r2 + s^2)
}

crate::potential! {
    /// Its slope has sines and cosines.
    struct Waves { k }
    pair U(r2; m_i, m_j) = m_i * m_j * (sin(k*r2) + exp(-r2))
}

/// Bodies with some disorder, in `dimensions` dimensions.
fn places(bodies: usize, dimensions: usize) -> Vec<f64> {
    // apart from one another and from 0
    let place = |c: usize| (c / dimensions % 7) as f64 + 0.3 * (c as f64).sin() + 2.0 * (c % dimensions) as f64 + 0.4;
    (0..bodies * dimensions).map(place).collect()
}

/// Masses of bodies.
fn masses(bodies: usize) -> Vec<f64> {
    (0..bodies).map(|i| 1.0 + i as f64 / 8.0).collect()
}

fn all<P: Pair, const D: usize>(bodies: usize, pair: P) -> Pairs<P, D> {
    Pairs::all(bodies, pair).unwrap()
}

fn lennard_jones<N>(number: impl Fn(f64) -> N) -> LennardJones<N> {
    LennardJones { epsilon: number(1.5), sigma: number(0.4) }
}

/// The gradient, that which comes with the rate, and the rate with the energy.
pub(super) fn evaluated<N: crate::Number>(pairs: &impl Potential<N>, q: &[N]) -> (Vec<N>, Vec<N>, [N; 2]) {
    let context = q[0].context();
    let zeros = |count| vec![N::zero(&context); count];
    let mut scratch = zeros(pairs.scratch());
    pairs.prepare(&mut scratch, &context);
    let (mut plain, mut with_rate) = (zeros(q.len()), zeros(q.len()));
    let [mut rate, mut energy] = [N::zero(&context), N::zero(&context)];
    pairs.gradient(q, &mut plain, &mut scratch);
    pairs.gradient_and_rate(q, &mut with_rate, &mut rate, &mut scratch);
    pairs.energy(q, &mut energy, &mut scratch);
    (plain, with_rate, [rate, energy])
}

/// Numbers that count their operations take one pair after the other.
fn agree<P, Q, const D: usize>(pairs: &Pairs<P, D>, one_by_one: &Pairs<Q, D>)
where
    P: PairPotential<f64>,
    Q: PairPotential<Counting<f64>>,
{
    let q = places(pairs.bodies(), D);
    let counting: Vec<_> = q.iter().copied().map(Counting).collect();
    let expected = evaluated(one_by_one, &counting);
    let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let gradient: Vec<f64> = expected.0.iter().map(|x| x.0).collect();
    let with_the_processors_vectors = evaluated(pairs, &q);
    for instructions in Instructions::available() {
        let found = instructions.only(|| evaluated(pairs, &q));
        let what = format!("{} bodies, {instructions:?}, {:?}", pairs.bodies(), pairs.which);
        assert!(found.0.iter().all(|x| x.is_finite()) && (q.len() == 1 || found.0.iter().any(|x| *x != 0.0)), "{what}");
        assert_eq!(bits(&found.0), bits(&found.1), "{what}");
        assert_eq!(found, with_the_processors_vectors, "{what}");
        if pairs.which == Which::All && pairs.is_in_blocks() {
            // these are added up in another order: up to 40 forces a body, each rounded to 1e-16
            let size = gradient.iter().fold(0.0, |size, x| x.abs().max(size));
            let off = found.0.iter().zip(&gradient).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= 1e-14 * size, "{what}: {off:e} of {size:e}");
        } else {
            assert_eq!(bits(&found.0), bits(&gradient), "{what}");
        }
        // and so are the rates and energies of all blocks
        for (found, expected) in found.2.into_iter().zip(&expected.2) {
            let off = (found - expected.0).abs();
            assert!(off <= 1e-13 * expected.0.abs(), "{what}: {off:e}");
        }
    }
}

#[test]
fn blocks_have_the_sums_of_pairs_one_by_one() {
    for bodies in [2, 3, 4, 5, 6, 7, 8, 15, 16, 17, 23, 24, 25, 40] {
        let counting = |m: Vec<f64>| m.into_iter().map(Counting).collect();
        let (m, waves, c) = (masses(bodies), places(bodies, 1), Counting);
        agree(
            &all::<_, 3>(bodies, Gravity { g: 0.7, m: m.clone() }),
            &all(bodies, Gravity { g: c(0.7), m: counting(m.clone()) }),
        );
        agree(
            &all::<_, 3>(bodies, Softened { s: 0.2, m: m.clone() }),
            &all(bodies, Softened { s: c(0.2), m: counting(m) }),
        );
        agree(
            &all::<_, 2>(bodies, Waves { k: 0.3, m: waves.clone() }),
            &all(bodies, Waves { k: c(0.3), m: counting(waves) }),
        );
        agree(&all::<_, 2>(bodies, lennard_jones(f64::from)), &all(bodies, lennard_jones(c)));
    }
}

/// Of formulas read at run time pairs are listed, or up to four blocks are evaluated at once.
#[test]
fn formulas_have_the_bits_of_compiled_pairs() {
    fn compare<P: PairPotential<f64>, const D: usize>(compiled: P, text: &str, m: &[f64], parameter: (&str, f64)) {
        let (bodies, separation) = (m.len(), compiled.separation());
        let properties = if compiled.properties().is_empty() { vec![] } else { vec![("m", m.to_vec())] };
        let read = FormulaPair::new(text, separation, &properties, &[parameter]).unwrap();
        let [compiled, read] = [
            evaluated(&Pairs::<_, D>::all(bodies, compiled).unwrap(), &places(bodies, D)),
            evaluated(&Pairs::<_, D>::all(bodies, read).unwrap(), &places(bodies, D)),
        ];
        assert_eq!(compiled, read, "{text}, {bodies} bodies in {D} dimensions");
    }
    for bodies in [2, 3, 4, 5, 6, 7, 8, 9, 12, 15, 16, 17, 24, 25, 40, 41, 49, 90] {
        let m = masses(bodies);
        compare::<_, 3>(Softened { s: 0.2, m: m.clone() }, "-m_i * m_j / sqrt(r2 + s^2)", &m, ("s", 0.2));
        compare::<_, 2>(Gravity { g: 0.7, m: m.clone() }, "-g * m_i * m_j / sqrt(r2)", &m, ("g", 0.7));
        compare::<_, 2>(Waves { k: 0.3, m: m.clone() }, "m_i * m_j * (sin(k*r2) + exp(-r2))", &m, ("k", 0.3));
        compare::<_, 1>(CubicSpring { alpha: 0.25 }, "d^2/2 + alpha*d^3/3", &m, ("alpha", 0.25));
    }
}

#[test]
fn chains_in_blocks_have_the_bits_of_springs_one_by_one() {
    for bodies in [1, 2, 8, 15, 16, 17, 24, 25, 40] {
        for ends in [Ends::Free, Ends::Fixed, Ends::Periodic] {
            agree(
                &Pairs::<_, 1>::neighbours(bodies, CubicSpring { alpha: 0.25 }, ends).unwrap(),
                &Pairs::<_, 1>::neighbours(bodies, CubicSpring { alpha: Counting(0.25) }, ends).unwrap(),
            );
            agree(
                &Pairs::<_, 1>::neighbours(bodies, TodaSpring, ends).unwrap(),
                &Pairs::<_, 1>::neighbours(bodies, TodaSpring, ends).unwrap(),
            );
            if ends != Ends::Periodic {
                agree(
                    &Pairs::<_, 1>::neighbours(bodies, LennardJones { epsilon: 1.5, sigma: 0.4 }, ends).unwrap(),
                    &Pairs::<_, 1>::neighbours(
                        bodies,
                        LennardJones { epsilon: Counting(1.5), sigma: Counting(0.4) },
                        ends,
                    )
                    .unwrap(),
                );
            }
        }
    }
}

/// The rate that is computed from energies is that of the pairs one by one, 2r²u' − 2u.
#[test]
fn rates_are_those_of_pairs_one_by_one() {
    for bodies in [2, 5, 17, 40] {
        let m = masses(bodies);
        let pairs = Pairs::<_, 3>::all(bodies, Softened { s: 0.2, m: m.clone() }).unwrap();
        assert_eq!(pairs.pair().summand(), Summand::Energy);
        let q = places(bodies, 3);
        let expected: f64 = (0..bodies)
            .flat_map(|i| (i + 1..bodies).map(move |j| (i, j)))
            .map(|(i, j)| {
                let r2: f64 = (0..3).map(|axis| (q[3 * j + axis] - q[3 * i + axis]).powi(2)).sum();
                let t = r2 + 0.2_f64.powi(2);
                m[i] * m[j] * (r2 / t + 2.0) / t.sqrt()
            })
            .sum();
        let off = evaluated(&pairs, &q).2[0] - expected;
        // positions are up to ten times as large as differences; each of a few sums is rounded to 1e-16
        assert!(off.abs() <= 1e-14 * expected, "{bodies} bodies: {off:e} of {expected}");
    }
}

/// Sums over chosen pairs of planets add up their rates.
#[test]
fn gravity_has_rates() {
    assert_eq!(Gravity { g: 1.0, m: vec![1.0, 2.0] }.summand(), Summand::Rate);
}

/// Blocks are for all pairs.
#[test]
fn chains_have_no_blocks() {
    let pair = || LennardJones { epsilon: 1.0, sigma: 1.0 };
    let chain = Pairs::<_, 1>::neighbours(40, pair(), Ends::Free).unwrap();
    let all = Pairs::<_, 1>::all(40, pair()).unwrap();
    let [chain, all] = [&chain, &all].map(Potential::<f64>::scratch);
    assert_eq!(all - chain, 80);
}

/// Numbers in lanes take one pair after the other, too, but add up in the order of blocks.
#[test]
fn lanes_have_the_bits_of_f64() {
    fn compare<P, Q, const D: usize>(pairs: &Pairs<P, D>, in_lanes: &Pairs<Q, D>)
    where
        P: PairPotential<f64>,
        Q: PairPotential<Lanes<4>>,
    {
        let q = places(pairs.bodies(), D);
        let lanes: Vec<_> = q.iter().copied().map(Lanes::all).collect();
        let (one, all) = (evaluated(pairs, &q), evaluated(in_lanes, &lanes));
        assert_eq!(one.1, all.1.iter().map(|x| x.0[3]).collect::<Vec<_>>());
        assert_eq!(one.2, all.2.map(|x| x.0[3]), "{} bodies, {:?}", pairs.bodies(), pairs.which);
    }
    for bodies in [15, 16, 17, 24, 25, 39] {
        let all = |sigma: f64| Pairs::<_, 3>::all(bodies, LennardJones { epsilon: 1.5, sigma }).unwrap();
        let sigma = Lanes::all(0.4);
        compare(&all(0.4), &Pairs::all(bodies, LennardJones { epsilon: Lanes::all(1.5), sigma }).unwrap());
        let m = masses(bodies);
        let in_lanes = m.iter().copied().map(Lanes::all).collect();
        compare(
            &Pairs::<_, 2>::all(bodies, Gravity { g: 0.7, m: m.clone() }).unwrap(),
            &Pairs::<_, 2>::all(bodies, Gravity { g: Lanes::all(0.7), m: in_lanes }).unwrap(),
        );
        let in_lanes = m.iter().copied().map(Lanes::all).collect();
        compare(
            &Pairs::<_, 3>::all(bodies, Softened { s: 0.2, m }).unwrap(),
            &Pairs::<_, 3>::all(bodies, Softened { s: Lanes::all(0.2), m: in_lanes }).unwrap(),
        );
        for ends in [Ends::Free, Ends::Fixed, Ends::Periodic] {
            compare(
                &Pairs::<_, 1>::neighbours(bodies, CubicSpring { alpha: 0.25 }, ends).unwrap(),
                &Pairs::<_, 1>::neighbours(bodies, CubicSpring { alpha: Lanes::all(0.25) }, ends).unwrap(),
            );
        }
    }
}

/// A dual number whose derivatives depend on `index`.
fn dual<N: Number<Context = ()>>(number: impl Fn(f64) -> N, x: f64, index: usize) -> Dual<N, 2> {
    Dual::new(number(x), [1.3, 2.9].map(|k| number((k * index as f64).sin())))
}

/// Values have the bits of plain numbers, and both have the bits of the sum with the rate, which takes one dual number
/// after the other.
fn dual_numbers_agree<N, P, Q, const D: usize>(number: impl Fn(f64) -> N, plain: &Pairs<P, D>, pairs: &Pairs<Q, D>)
where
    N: Number<Context = ()> + PartialEq,
    P: PairPotential<N>,
    Q: PairPotential<Dual<N, 2>>,
{
    let q = places(pairs.bodies(), D);
    let expected = evaluated(plain, &q.iter().copied().map(&number).collect::<Vec<_>>());
    let q: Vec<_> = (1..).zip(q).map(|(index, x)| dual(&number, x, index)).collect();
    for instructions in Instructions::available() {
        let (found, with_rate, _) = instructions.only(|| evaluated(pairs, &q));
        for (c, found) in found.iter().enumerate() {
            let what = format!("coordinate {c} of {} bodies, {instructions:?}", pairs.bodies());
            assert_eq!((&found.value, &found.value), (&expected.0[c], &with_rate[c].value), "{what}");
            assert_eq!(found.derivatives, with_rate[c].derivatives, "{what}");
            assert!(found.derivatives.iter().all(N::is_finite), "{what}");
        }
    }
}

#[test]
fn blocks_of_dual_numbers_have_the_bits_of_numbers_one_by_one() {
    for bodies in [7, 8, 9, 12, 15, 16, 17, 23, 24, 25, 40] {
        let m = masses(bodies);
        let dual_m = || (0..).zip(&m).map(|(i, m)| dual(f64::from, *m, i)).collect::<Vec<_>>();
        let [s, d] = [0.2, 1.5].map(|x| dual(f64::from, x, 3));
        dual_numbers_agree(
            f64::from,
            &Pairs::<_, 3>::all(bodies, Softened { s: 0.2, m: m.clone() }).unwrap(),
            &Pairs::all(bodies, Softened { s, m: dual_m() }).unwrap(),
        );
        let lennard_jones = LennardJones { epsilon: 1.5, sigma: 0.2 };
        dual_numbers_agree(
            f64::from,
            &Pairs::<_, 2>::all(bodies, lennard_jones).unwrap(),
            &Pairs::all(bodies, LennardJones { epsilon: d, sigma: s }).unwrap(),
        );
        let toda = Pairs::<_, 1>::all(bodies, TodaSpring).unwrap();
        dual_numbers_agree(f64::from, &toda, &toda);
        let fused = m.iter().copied().map(Fused).collect();
        let dual_fused = (0..).zip(&m).map(|(i, m)| dual(Fused, *m, i)).collect();
        dual_numbers_agree(
            Fused,
            &Pairs::<_, 3>::all(bodies, Gravity { g: Fused(0.7), m: fused }).unwrap(),
            &Pairs::all(bodies, Gravity { g: dual(Fused, 0.7, 2), m: dual_fused }).unwrap(),
        );
        let formula = "-m_i * m_j / sqrt(r2 + s^2)";
        let squared = Separation::SquaredDistance;
        dual_numbers_agree(
            f64::from,
            &Pairs::<_, 3>::all(
                bodies,
                FormulaPair::new(formula, squared, &[("m", m.clone())], &[("s", 0.2)]).unwrap(),
            )
            .unwrap(),
            &Pairs::all(bodies, FormulaPair::new(formula, squared, &[("m", dual_m())], &[("s", s)]).unwrap()).unwrap(),
        );
    }
}
