//! Sums up to a cutoff against sums over all pairs and images.

use super::{BLOCK, Cutoff, CutoffPairs};
use crate::number::counting::Counting;
use crate::number::instructions::Instructions;
use crate::number::{Lanes, Limbs, Number, Real};
use crate::systems::formula::FormulaPair;
use crate::systems::pairs::{PairPotential, Separation};
use crate::systems::potential::Potential;
use crate::systems::potential_check::check_potential;
use crate::systems::problems::LennardJones;
use crate::{Motion, Rational, Stepper, UnitMasses, tables::shipped};

crate::potential! {
    /// A mixture of charges and spheres.
    #[derive(Clone)]
    struct Mixture {}
    pair U(r2; a_i, a_j, c_i, c_j) = a_i*a_j/r2^4 + c_i*c_j/sqrt(r2)
}

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn limbs<const L: usize>(x: f64) -> Limbs<L>
where
    Limbs<L>: Number<Context = ()>,
{
    Limbs::from_rational(&Rational::from_float(x).unwrap(), &())
}

/// Bodies in disorder, no two of which are very close: on a grid of `each` places along an axis with a distance of 1,
/// beginning anywhere.
fn places(bodies: usize, each: usize, dimensions: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let start = 100.0 * random() - 50.0;
    let mut places = Vec::new();
    for body in 0..bodies {
        for axis in 0..dimensions {
            let place = body / each.pow(axis as u32) % each;
            places.push(start + place as f64 + 0.2 * random());
        }
    }
    places
}

/// What the list of neighbours at q gives: the gradient, that which comes with the rate, rate and energy.
fn evaluated<N: Number, P: PairPotential<N>, const D: usize>(
    pairs: &mut CutoffPairs<P, D>,
    q: &[N],
) -> (Vec<N>, Vec<N>, [N; 2]) {
    pairs.update(q);
    super::tests::evaluated(pairs, q)
}

/// U and U_q by the definition: all pairs, all images; the energy of a pair and its derivative from r².
fn by_definition<const D: usize>(
    q: &[f64],
    cutoff: f64,
    sides: Option<f64>,
    pair: impl Fn(usize, usize, f64) -> (f64, f64),
) -> (f64, Vec<f64>) {
    let bodies = q.len() / D;
    let (mut energy, mut gradient) = (0.0, vec![0.0; q.len()]);
    for j in 0..bodies {
        for i in 0..j {
            for image in 0..3_usize.pow(if sides.is_some() { D as u32 } else { 0 }) {
                let mut rest = image;
                let difference: [f64; D] = std::array::from_fn(|axis| {
                    let mut d = q[D * j + axis] - q[D * i + axis];
                    if let Some(side) = sides {
                        d = d.rem_euclid(side) - (rest % 3) as f64 * side;
                        rest /= 3;
                    }
                    d
                });
                let r2: f64 = difference.iter().map(|d| d * d).sum();
                if r2 < cutoff * cutoff {
                    let (u, slope) = pair(i, j, r2);
                    energy += u;
                    for axis in 0..D {
                        gradient[D * j + axis] += 2.0 * slope * difference[axis];
                        gradient[D * i + axis] -= 2.0 * slope * difference[axis];
                    }
                }
            }
        }
    }
    (energy, gradient)
}

/// S and S′ for n = 2, written out.
fn quintic(t: f64) -> (f64, f64) {
    let t = t.min(1.0);
    (t.powi(3) * (10.0 - 15.0 * t + 6.0 * t * t), 30.0 * t * t * (1.0 - t).powi(2))
}

fn lennard_jones(x: f64) -> (f64, f64) {
    (4.0 * (x.powi(-6) - x.powi(-3)), 4.0 * (3.0 * x.powi(-4) - 6.0 * x.powi(-7)))
}

fn agree<const D: usize>(bodies: usize, each: usize, in_box: bool) {
    let side = in_box.then_some(each as f64 + 0.3);
    for (seed, switched) in [(1, false), (2, true), (3, true)] {
        let mut cutoff = Cutoff::<D>::at(rational(9, 4)).unwrap();
        if switched {
            cutoff = cutoff.switched(rational(3, 2), 2).unwrap();
        }
        if in_box {
            let side = rational(10 * each as i64 + 3, 10);
            cutoff = cutoff.in_box(std::array::from_fn(|_| side.clone())).unwrap();
        }
        let q = places(bodies, each, D, seed);
        let switch = |x: f64, (u, slope): (f64, f64)| match switched {
            false => (u, slope),
            true => {
                let width = 5.0625 - 2.25;
                let (value, rise) = quintic((5.0625 - x) / width);
                (value * u, value * slope - rise / width * u)
            }
        };
        let what = format!("{bodies} bodies in {D} dimensions, box {in_box}, switch {switched}");
        let check = |(plain, with_rate, [rate, energy]): (Vec<f64>, Vec<f64>, [f64; 2]),
                     (u, gradient): (f64, Vec<f64>)| {
            assert_eq!(plain, with_rate, "{what}");
            // up to 60 forces of up to 100 a body; differences of positions of up to 60 have the round-off 7e-15
            let size = gradient.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            for (found, expected) in plain.iter().zip(&gradient) {
                assert!((found - expected).abs() < 1e-11 * size, "{what}: {found} and {expected}");
            }
            assert!((energy - u).abs() < 1e-12 * bodies as f64 * size, "{what}: {energy} and {u}");
            let by_definition = q.iter().zip(&plain).map(|(q, g)| q * g).sum::<f64>() - 2.0 * energy;
            assert!((rate - by_definition).abs() < 1e-11 * bodies as f64 * size, "{what}: {rate} and {by_definition}");
        };
        let mut pairs = CutoffPairs::new(bodies, LennardJones { epsilon: 1.0, sigma: 1.0 }, cutoff.clone()).unwrap();
        let expected = by_definition::<D>(&q, 2.25, side, |_, _, x| switch(x, lennard_jones(x)));
        check(evaluated(&mut pairs, &q), expected);
        let a: Vec<f64> = (0..bodies).map(|i| 1.0 + (i % 3) as f64 / 4.0).collect();
        let c: Vec<f64> = (0..bodies).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let expected = by_definition::<D>(&q, 2.25, side, |i, j, x| {
            let (a, c) = (a[i] * a[j], c[i] * c[j]);
            switch(x, (a / x.powi(4) + c / x.sqrt(), -4.0 * a / x.powi(5) - c / (2.0 * x * x.sqrt())))
        });
        let mut pairs = CutoffPairs::new(bodies, Mixture { a: a.clone(), c: c.clone() }, cutoff).unwrap();
        check(evaluated(&mut pairs, &q), expected);
    }
}

#[test]
fn sums_are_those_over_all_pairs_and_images() {
    for in_box in [false, true] {
        agree::<1>(30, 30, in_box);
        agree::<2>(25, 5, in_box);
        agree::<2>(144, 12, in_box);
        agree::<3>(125, 5, in_box);
        agree::<3>(343, 7, in_box);
    }
    agree::<3>(1, 1, false);
    agree::<3>(BLOCK, 2, false);
}

/// As many as 8 along each axis.
const BODIES: usize = 512;

fn fluid<N: Number<Context = ()>>(switched: bool) -> CutoffPairs<LennardJones<N>, 3> {
    fluid_in_box(switched, rational(83, 10))
}

fn fluid_in_box<N: Number<Context = ()>>(switched: bool, side: Rational) -> CutoffPairs<LennardJones<N>, 3> {
    let mut cutoff = Cutoff::at(rational(9, 4)).unwrap();
    if switched {
        cutoff = cutoff.switched(rational(2, 1), 3).unwrap();
    }
    let one = || N::from_rational(&rational(1, 1), &());
    let pair = LennardJones { epsilon: one(), sigma: one() };
    CutoffPairs::new(BODIES, pair, cutoff.in_box([side.clone(), side.clone(), side]).unwrap()).unwrap()
}

/// Vectors, single numbers and lanes add up in one order.
#[test]
fn sums_have_the_same_bits_in_blocks_one_by_one_and_in_lanes() {
    for switched in [false, true] {
        let q = places(BODIES, 8, 3, 5);
        let expected = evaluated(&mut fluid(switched), &q);
        for instructions in Instructions::available() {
            assert_eq!(instructions.only(|| evaluated(&mut fluid(switched), &q)), expected);
        }
        let counting: Vec<_> = q.iter().copied().map(Counting).collect();
        let found = evaluated(&mut fluid::<Counting<f64>>(switched), &counting);
        let plain = |numbers: Vec<Counting<f64>>| numbers.into_iter().map(|x| x.0).collect::<Vec<_>>();
        // their rate is not summed in parts
        assert_eq!(
            (plain(found.0), plain(found.1), found.2[1].0),
            (expected.0.clone(), expected.1.clone(), expected.2[1])
        );
        // another trajectory in the other lanes
        let other = places(BODIES, 8, 3, 6);
        let lanes: Vec<_> = q.iter().zip(&other).map(|(a, b)| Lanes([*b, *a])).collect();
        let found = evaluated(&mut fluid::<Lanes<2>>(switched), &lanes);
        let second = |numbers: Vec<Lanes<2>>| numbers.into_iter().map(|x| x.0[1]).collect::<Vec<_>>();
        assert_eq!((second(found.0), second(found.1), found.2.map(|x| x.0[1])), expected);
    }
}

/// What is computed does not depend on the list that is there; and the list is made again when, and only when, a body
/// has moved by half of the skin.
#[test]
fn lists_leave_no_trace() {
    let mut kept = fluid::<f64>(true);
    let mut q = places(BODIES, 8, 3, 8);
    let velocities = places(BODIES, 8, 3, 9);
    let mut made = 0;
    for step in 0..60 {
        let before = kept.list_of_neighbours().to_vec();
        assert_eq!(evaluated(&mut kept, &q), evaluated(&mut fluid(true), &q), "step {step}");
        made += usize::from(before != kept.list_of_neighbours());
        // one body jumps over the box now and then, others drift apart
        q.iter_mut().zip(&velocities).for_each(|(q, v)| *q += 0.03 * v.sin());
        if step % 20 == 19 {
            q[300] += 4.0 * 8.3;
            q[1] -= 4.2;
        }
    }
    assert!((6..40).contains(&made), "{made} lists for 60 states");
}

/// A body that is not at a finite place has no partners.
#[test]
fn positions_that_are_not_finite_do_no_harm() {
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let mut q = places(BODIES, 8, 3, 10);
        q[7] = bad;
        let (gradient, ..) = evaluated(&mut fluid(true), &q);
        assert!(gradient.iter().filter(|x| x.is_finite()).count() >= 3 * BODIES - 3, "{bad}");
    }
}

/// Energy, gradient, rate and second derivatives belong to one another, also in the range in which the energy falls.
#[test]
fn derivatives_are_those_of_the_energy() {
    let bodies = 64;
    let cutoff = Cutoff::<3>::at(rational(2, 1)).unwrap().switched(rational(1, 1), 6).unwrap();
    let side = rational(43, 10);
    let cutoff = cutoff.in_box([side.clone(), side.clone(), side]).unwrap();
    let pair = Mixture {
        a: (0..bodies).map(|i| limbs(1.0 + (i % 3) as f64 / 4.0)).collect(),
        c: (0..bodies).map(|i| limbs(if i % 2 == 0 { 1.0 } else { -1.0 })).collect(),
    };
    let mut pairs = CutoffPairs::new(bodies, pair, cutoff).unwrap();
    let q: Vec<Limbs<4>> = places(bodies, 4, 3, 11).into_iter().map(limbs).collect();
    let check = check_potential(&mut pairs, &[q]).unwrap();
    assert!(check.agrees() && check.hessian.is_some(), "{check}");
}

/// The virial is minus the derivative of U under a scaling of the positions and of the box; without a box it is −qᵀU_q.
#[test]
fn virials_are_derivatives_by_the_scale() {
    type N = Limbs<3>;
    let q = places(BODIES, 8, 3, 11);
    let mut pairs = fluid::<N>(true);
    let exact: Vec<N> = q.iter().copied().map(limbs).collect();
    let mut scratch = vec![N::ZERO; Potential::<N>::scratch(&pairs)];
    pairs.prepare(&mut scratch, &());
    let mut found = N::ZERO;
    pairs.virial(&exact, &mut found, &mut scratch);
    let tiny = rational(1, 1_000_000_000_000);
    let scaled = |scale: Rational| {
        let of_scale = N::from_rational(&scale, &());
        let mut q = exact.clone();
        q.iter_mut().for_each(|x| x.multiply(&of_scale));
        evaluated(&mut fluid_in_box::<N>(true, rational(83, 10) * scale), &q).2[1]
    };
    let mut expected = scaled(rational(1, 1) - &tiny);
    expected.subtract(&scaled(rational(1, 1) + &tiny));
    expected.divide(&N::from_rational(&(tiny * rational(2, 1)), &()));
    expected.subtract(&found);
    // the difference quotient has an error of the size of 1e-24 in 57 digits, of which 12 are lost
    assert!(expected.log10_abs() < found.log10_abs() - 20.0, "{} {}", expected.log10_abs(), found.log10_abs());

    let mut open = CutoffPairs::<_, 3>::new(
        BODIES,
        LennardJones { epsilon: 1.0, sigma: 1.0 },
        Cutoff::at(rational(9, 4)).unwrap(),
    )
    .unwrap();
    let mut scratch = vec![0.0; Potential::<f64>::scratch(&open)];
    Potential::<f64>::prepare(&open, &mut scratch, &());
    let mut found = 0.0;
    open.virial(&q, &mut found, &mut scratch);
    let gradient = evaluated(&mut open, &q).0;
    let sizes: Vec<f64> = q.iter().zip(&gradient).map(|(q, slope)| q * slope).collect();
    let expected = -sizes.iter().sum::<f64>();
    // some thousand sums, each with a round-off of the size of its terms
    let round_off = 1e-15 * BODIES as f64 * sizes.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    assert!((found - expected).abs() < round_off, "{found} {expected} {round_off}");
}

/// In fixed point steps back undo steps to the last bit, though other lists are made on the way back.
#[test]
fn steps_back_undo_steps() {
    let (q, p) = (places(BODIES, 8, 3, 12), places(BODIES, 8, 3, 13).iter().map(|x| x.sin()).collect::<Vec<_>>());
    let (q_ranges, p_ranges) = (vec![128.0; q.len()], vec![64.0; p.len()]);
    let motion = Motion::new(fluid(true), UnitMasses, q, p).unwrap();
    let mut motion = motion.fixed_point(&q_ranges, &p_ranges).unwrap();
    let start = (motion.q().to_vec(), motion.p().to_vec());
    let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), "1/100").unwrap();
    (0..40).for_each(|_| stepper.step(&mut motion));
    assert!(motion.q()[0] != start.0[0]);
    (0..40).for_each(|_| stepper.step_back(&mut motion));
    assert!((motion.q(), motion.p()) == (start.0.as_slice(), start.1.as_slice()));
}

/// A formula that is read at run time has the bits of the compiled one, with properties of bodies too.
#[test]
fn formulas_have_the_bits_of_compiled_ones() {
    let a: Vec<f64> = (0..BODIES).map(|i| 1.0 + (i % 3) as f64 / 4.0).collect();
    let c: Vec<f64> = (0..BODIES).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
    let cutoff = Cutoff::<3>::at(rational(2, 1)).unwrap().switched(rational(3, 2), 3).unwrap();
    let (formula, properties) = ("a_i*a_j/r2^4 + c_i*c_j/sqrt(r2)", [("a", a.clone()), ("c", c.clone())]);
    let read = FormulaPair::new(formula, Separation::SquaredDistance, &properties, &[]).unwrap();
    let q = places(BODIES, 8, 3, 14);
    let found = evaluated(&mut CutoffPairs::new(BODIES, read, cutoff.clone()).unwrap(), &q);
    assert_eq!(found, evaluated(&mut CutoffPairs::new(BODIES, Mixture { a, c }, cutoff).unwrap(), &q));
}
