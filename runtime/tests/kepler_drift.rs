//! Protects the Kepler drift: its digits in every number type, its bits in lanes, its round-off in long runs, that its
//! solver ends, and its messages.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use shadowstep::exact;
use shadowstep::number::counting::Counting;
use shadowstep::number::{AnyLimbs, DoubleDouble, Dual, Fused, Lanes, LimbCount, Limbs, Number, Real};
use shadowstep::systems::kepler_drift::{KeplerDrift, KeplerDriftError};
use std::f64::consts::{PI, TAU};

/// As many digits as the reference cases have, and some more.
type Reference = Limbs<4>;

/// μ, q, v, t
type Input<N> = [N; 8];

/// s, q, v
type Output<N> = [N; 7];

fn drift<N: Number>(drift: &mut KeplerDrift<N>, [mu, x, y, z, vx, vy, vz, t]: Input<N>) -> Output<N> {
    let (mut q, mut v) = ([x, y, z], [vx, vy, vz]);
    let s = drift.advance(&mu, &t, &mut q, &mut v).clone();
    let ([x, y, z], [vx, vy, vz]) = (q, v);
    [s, x, y, z, vx, vy, vz]
}

fn new<N: Number<Context = ()>>() -> KeplerDrift<N> {
    KeplerDrift::new(&())
}

fn reference(input: &Input<f64>) -> Output<Reference> {
    drift(&mut new(), input.map(Reference::from))
}

fn exactly<N: Real>(x: &N) -> Reference {
    Reference::from_rational(&exact(&x.to_text()).unwrap(), &())
}

fn sum<N: Number>(a: &N, b: &N) -> N {
    let mut sum = a.clone();
    sum.add(b);
    sum
}

fn difference<N: Number>(a: &N, b: &N) -> N {
    let mut difference = a.clone();
    difference.subtract(b);
    difference
}

/// |a − b| of vectors
fn distance<const L: usize>(a: &[Limbs<L>], b: &[Limbs<L>]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| difference(a, b).square());
    squares.fold(Limbs::ZERO, |all, square| sum(&all, &square)).sqrt().to_f64()
}

/// By how much more than the input q and v of the result change: the root of the sum of (∂/∂xᵢ · xᵢ)² over the eight
/// numbers, relative to |q| and |v|.
fn conditions(input: &Input<f64>, expected: &Output<Reference>) -> [f64; 2] {
    let mut squares = [0.0; 2];
    for i in 0..8 {
        let mut changed = input.map(Reference::from);
        changed[i] = sum(&changed[i], &changed[i].times_power_of_two(-90));
        let found = drift(&mut new(), changed);
        for (square, range) in squares.iter_mut().zip([1..4, 4..7]) {
            let change = distance(&found[range.clone()], &expected[range.clone()]) / size(&expected[range]);
            *square += (change * 2_f64.powi(90)).powi(2);
        }
    }
    squares.map(f64::sqrt)
}

fn size(vector: &[Reference]) -> f64 {
    distance(vector, &[Reference::ZERO; 3])
}

/// The relative errors of q and v in units of u times 1 + their condition.
fn errors<N: Real>(found: &Output<N>, input: &Input<f64>, expected: &Output<Reference>, u: f64) -> [f64; 2] {
    let found = found.each_ref().map(exactly);
    let conditions = conditions(input, expected);
    std::array::from_fn(|i| {
        let range = 3 * i + 1..3 * i + 4;
        let error = distance(&found[range.clone()], &expected[range.clone()]) / size(&expected[range]);
        error / (u * (1.0 + conditions[i]))
    })
}

fn cases() -> Vec<(Input<f64>, Output<Reference>)> {
    let parse = |line: &str| {
        let texts: Vec<_> = line.split(' ').collect();
        let input = std::array::from_fn(|i| texts[i].parse().unwrap());
        (input, std::array::from_fn(|i| Reference::from_rational(&exact(texts[8 + i]).unwrap(), &())))
    };
    include_str!("kepler_drift/cases.txt").lines().map(parse).collect()
}

#[test]
fn limbs_have_the_digits_of_mpmath() {
    for (input, expected) in cases() {
        let found = reference(&input);
        for (range, digits) in [(0..1, 59.0), (1..4, 56.0), (4..7, 56.0)] {
            let error = distance(&found[range.clone()], &expected[range.clone()]).log10()
                - distance(&expected[range], &[Reference::ZERO; 3]).log10();
            assert!(error < -digits, "{input:?}: {error}");
        }
    }
}

#[test]
fn errors_are_a_few_units_of_the_last_place_times_the_condition() {
    let (mut double, mut fused, mut pair) = (new::<f64>(), new::<Fused>(), new::<DoubleDouble>());
    for (input, expected) in cases() {
        let check = |[q, v]: [f64; 2], bound| assert!(q < bound && v < bound, "{input:?}: {q}, {v}");
        let u = f64::EPSILON / 2.0;
        check(errors(&drift(&mut double, input), &input, &expected, u), 6.0);
        check(errors(&drift(&mut fused, input.map(Fused)), &input, &expected, u), 6.0);
        // a double-double has no more digits for passages
        check(errors(&drift(&mut pair, input.map(DoubleDouble::from)), &input, &expected, u * u), 150.0);
    }
}

/// From the first guess both terms of the step to the root are long, but their sum is short.
#[test]
fn terms_of_a_step_that_cancel_by_chance() {
    let q = [11.863841986000011, 8.404289091002756, -7.668337769148922];
    let v = [0.201920653579026, 0.2941001786722487, -0.11891535585920407];
    let input = [1.1621836174209779, q[0], q[1], q[2], v[0], v[1], v[2], -52.74623311233583];
    let (found, expected) = (drift(&mut new::<f64>(), input), reference(&input));
    assert!((found[0] / expected[0].to_f64() - 1.0).abs() < 1e-13, "{found:?}");
}

/// Orbits and times as in `kepler_drift/reference.py`.
struct Orbits(Pcg64Mcg);

impl Orbits {
    fn new(seed: u64) -> Self {
        Orbits(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Between two bounds.
    fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 * 2_f64.powi(-53)
    }

    fn power_of_ten(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.number(low, high))
    }

    fn sign(&mut self) -> f64 {
        if self.0.next_u64() & 1 == 0 { 1.0 } else { -1.0 }
    }

    fn eccentricity(&mut self) -> f64 {
        match self.number(0.0, 1.0) {
            kind if kind < 0.2 => self.number(0.0, 0.3),
            kind if kind < 0.5 => 1.0 - self.power_of_ten(-4.0, 0.0),
            kind if kind < 0.65 => 1.0 + self.power_of_ten(-6.0, 0.95),
            kind if kind < 0.75 => self.number(1.0, 10.0),
            _ => 1.0 + self.sign() * self.power_of_ten(-14.0, -8.0),
        }
    }

    fn input(&mut self) -> Input<f64> {
        let (e, pericentre, mu) = (self.eccentricity(), self.power_of_ten(-1.0, 1.0), self.power_of_ten(-1.5, 1.5));
        let largest = if (e - 1.0).abs() < 1e-7 {
            3.0
        } else if e > 1.0 {
            (-1.0 / e).acos() - 0.05
        } else {
            PI
        };
        let anomaly = self.number(-largest, largest);
        let p = pericentre * (1.0 + e);
        let (r, k) = (p / (1.0 + e * anomaly.cos()), (mu / p).sqrt());
        let angles: [f64; 3] = std::array::from_fn(|_| self.number(0.0, TAU));
        let [x, y, z] = rotated([r * anomaly.cos(), r * anomaly.sin()], angles);
        let [vx, vy, vz] = rotated([-k * anomaly.sin(), k * (e + anomaly.cos())], angles);
        let size = if e < 0.9999 { pericentre / (1.0 - e) } else { pericentre };
        let t = self.sign() * TAU * (size.powi(3) / mu).sqrt() * self.power_of_ten(-6.0, 30_f64.log10());
        [mu, x, y, z, vx, vy, vz, t]
    }
}

fn rotated([x, y]: [f64; 2], [a, b, c]: [f64; 3]) -> [f64; 3] {
    let (x, y) = (x * a.cos() - y * a.sin(), x * a.sin() + y * a.cos());
    let (y, z) = (y * b.cos(), y * b.sin());
    [x * c.cos() - y * c.sin(), x * c.sin() + y * c.cos(), z]
}

/// The larger error of q and v of random orbits, sorted, by their eccentricities.
fn errors_by_kind<N: Real + Number<Context = ()>>(count: usize, u: f64, of: impl Fn(f64) -> N) -> [Vec<f64>; 4] {
    let (mut orbits, mut kepler) = (Orbits::new(5), new::<N>());
    let mut kinds = [const { Vec::new() }; 4];
    for _ in 0..count {
        let input = orbits.input();
        let [q, v] = errors(&drift(&mut kepler, input.map(&of)), &input, &reference(&input), u);
        let e = eccentricity(&input);
        let kind = if (e - 1.0).abs() < 1e-7 {
            2
        } else if e > 1.0 {
            3
        } else {
            usize::from(e > 0.3)
        };
        kinds[kind].push(q.max(v));
    }
    kinds.iter_mut().for_each(|kind| kind.sort_by(f64::total_cmp));
    kinds
}

/// e² = (1 − αr/μ)² + αη²/μ²
fn eccentricity([mu, x, y, z, vx, vy, vz, _]: &Input<f64>) -> f64 {
    let (r, eta) = ((x * x + y * y + z * z).sqrt(), x * vx + y * vy + z * vz);
    let alpha = 2.0 * mu / r - (vx * vx + vy * vy + vz * vz);
    ((1.0 - alpha * r / mu).powi(2) + alpha * (eta / mu).powi(2)).sqrt()
}

#[test]
fn errors_of_random_orbits() {
    for kind in errors_by_kind(300, f64::EPSILON / 2.0, |x| x) {
        let (largest, median) = (kind[kind.len() - 1], kind[kind.len() / 2]);
        assert!(largest < 8.0 && median < 0.7, "{largest}, {median}");
    }
}

/// What the documentation says: `cargo test --release -p shadowstep kepler_drift -- --ignored --nocapture`
#[test]
#[ignore = "some minutes"]
fn errors_of_a_hundred_thousand_random_orbits() {
    let u = f64::EPSILON / 2.0;
    let kinds = [
        ("f64", errors_by_kind(100_000, u, |x| x)),
        ("double-double", errors_by_kind(100_000, u * u, DoubleDouble::from)),
    ];
    for (name, kinds) in kinds {
        for (kind, errors) in ["e < 0.3", "0.3 < e < 1", "|e - 1| < 1e-7", "e > 1"].iter().zip(kinds) {
            let at = |part: f64| errors[((errors.len() - 1) as f64 * part) as usize];
            eprintln!(
                "{name}, {kind}: {} median {:.2}, 99 % {:.2}, largest {:.1}",
                errors.len(),
                at(0.5),
                at(0.99),
                at(1.0)
            );
            assert!(name != "f64" || at(1.0) < 15.0);
        }
    }
}

/// Lanes of orbits of all kinds at once.
fn inputs_in_lanes<const W: usize>(orbits: &mut Orbits) -> ([Input<f64>; W], Input<Lanes<W>>) {
    let alone: [_; W] = std::array::from_fn(|_| orbits.input());
    (alone, std::array::from_fn(|i| Lanes(std::array::from_fn(|lane| alone[lane][i]))))
}

#[test]
fn lanes_have_the_bits_of_numbers_alone() {
    let mut orbits = Orbits::new(11);
    let (mut single, mut lanes) = (new::<f64>(), new::<Lanes<8>>());
    let (mut single_pair, mut lanes_pair) = (new::<DoubleDouble>(), new::<DoubleDouble<Lanes<4>>>());
    for _ in 0..40 {
        let (alone, together) = inputs_in_lanes::<8>(&mut orbits);
        let found = drift(&mut lanes, together);
        for (lane, input) in alone.into_iter().enumerate() {
            assert_eq!(found.map(|x| x.0[lane]), drift(&mut single, input), "{input:?}");
        }
        let (alone, together) = inputs_in_lanes::<4>(&mut orbits);
        let mut pairs = together.map(|_| DoubleDouble::<Lanes<4>>::zero(&()));
        for (pair, lanes) in pairs.iter_mut().zip(together) {
            (0..4).for_each(|lane| pair.set_lane(lane, lanes.0[lane], 0));
        }
        let found = drift(&mut lanes_pair, pairs);
        for (lane, input) in alone.into_iter().enumerate() {
            let expected = drift(&mut single_pair, input.map(DoubleDouble::from)).map(DoubleDouble::parts);
            assert_eq!(found.map(|x| (x.parts().0.0[lane], x.parts().1.0[lane])), expected, "{input:?}");
        }
    }
}

#[test]
fn numbers_of_one_precision_have_the_same_bits() {
    let mut orbits = Orbits::new(12);
    let (mut double, mut counting) = (new::<f64>(), new::<Counting<f64>>());
    let count = LimbCount::of_bits(256).unwrap();
    let (mut limbs, mut any) = (new::<Limbs<4>>(), KeplerDrift::<AnyLimbs>::new(&count));
    for _ in 0..50 {
        let input = orbits.input();
        assert_eq!(drift(&mut counting, input.map(Counting)).map(|x| x.0), drift(&mut double, input));
        let of_any = drift(&mut any, input.map(|x| AnyLimbs::from_f64(x, count)));
        assert_eq!(of_any.map(|x| x.to_text()), drift(&mut limbs, input.map(Limbs::from)).map(|x| x.to_text()));
    }
}

#[cfg(feature = "mpfr")]
#[test]
fn mpfr_has_the_digits_of_limbs_and_any_precision_ends() {
    use shadowstep::number::{Float, Precision};
    let mut orbits = Orbits::new(13);
    for bits in [5, 24, 53, 80, 200] {
        let precision = Precision::bits(bits).unwrap();
        let mut kepler = KeplerDrift::<Float>::new(&precision);
        for _ in 0..20 {
            let mut input = orbits.input();
            // the same numbers in both
            input = input.map(|x| Float::with_val(bits.min(53), x).to_f64());
            let expected = reference(&input);
            let u = 2_f64.powi(-(bits as i32));
            let found = drift(&mut kepler, input.map(|x| Float::with_val(bits, x)));
            let [q, v] = errors(&found, &input, &expected, u);
            // beyond the precision of the input the condition does not bound the error of such coarse numbers
            assert!(bits < 53 || q < 150.0 && v < 150.0, "{bits} bits, {input:?}: {q}, {v}");
        }
    }
}

#[test]
fn powers_of_two_scale_all_numbers() {
    fn check<N: Number>(orbits: &mut Orbits, context: &N::Context, length: i64, velocity: i64, text: fn(&N) -> String) {
        let mut kepler = KeplerDrift::<N>::new(context);
        let exponents = |of: [i64; 4]| {
            let [mu, q, v, t] = of;
            [mu, q, q, q, v, v, v, t]
        };
        let scaled = |x: &N, n: i64| {
            let mut factor = N::zero(context);
            factor.set_lane(0, 1.0, n);
            factor.multiply(x);
            factor
        };
        for _ in 0..30 {
            let number = |x: f64| {
                let mut number = N::zero(context);
                number.set_lane(0, x, 0);
                number
            };
            let mut input = orbits.input();
            if input[0] > 1.0 {
                [input[2], input[4]] = [0.0; 2]; // q·v = 0
                input[6] = 0.0;
                input[3] = 0.0;
            }
            let input = input.map(number);
            let units = exponents([length + 2 * velocity, length, velocity, length - velocity]);
            let large: Input<N> = std::array::from_fn(|i| scaled(&input[i], units[i]));
            let found = drift(&mut kepler, large);
            let expected = drift(&mut kepler, input);
            let units = [-velocity, length, length, length, velocity, velocity, velocity];
            for (i, unit) in units.into_iter().enumerate() {
                assert_eq!(text(&found[i]), text(&scaled(&expected[i], unit)));
            }
        }
    }
    let orbits = &mut Orbits::new(14);
    for (length, velocity) in [(60, 0), (-50, 40), (100, -70), (-100, -20)] {
        check::<f64>(orbits, &(), length, velocity, Real::to_text);
    }
    for (length, velocity) in [(100_000, 0), (-1_000_000, 3000), (0, 20_000)] {
        check::<Limbs<2>>(orbits, &(), length, velocity, Real::to_text);
    }
}

#[test]
fn two_drifts_are_one_and_back_is_the_inverse() {
    let mut orbits = Orbits::new(15);
    let mut kepler = new::<Limbs<5>>();
    for _ in 0..20 {
        let input = orbits.input().map(Limbs::<5>::from);
        let start = input;
        let mut half = input;
        half[7] = input[7].over_integer(3);
        let [s_half, x, y, z, vx, vy, vz] = drift(&mut kepler, half);
        let mut rest = [input[0], x, y, z, vx, vy, vz, difference(&input[7], &half[7])];
        let [s_rest, ..] = drift(&mut kepler, rest);
        let whole = drift(&mut kepler, input);
        let two = drift(&mut kepler, rest);
        let relative = |a: &[Limbs<5>], b: &[Limbs<5>]| distance(a, b) / distance(b, &[Limbs::ZERO; 3]);
        assert!(relative(&[sum(&s_half, &s_rest)], &whole[..1]) < 1e-75);
        assert!(relative(&two[1..4], &whole[1..4]) < 1e-75 && relative(&two[4..], &whole[4..]) < 1e-75);
        rest = [input[0], whole[1], whole[2], whole[3], whole[4], whole[5], whole[6], -input[7]];
        let back = drift(&mut kepler, rest);
        assert!(relative(&back[1..4], &start[1..4]) < 1e-70 && relative(&back[4..], &start[4..7]) < 1e-70);
    }
}

#[test]
fn increments_are_those_of_the_drift_and_have_no_cancellation() {
    let mut orbits = Orbits::new(16);
    let (mut kepler, mut plain) = (new::<f64>(), new::<f64>());
    for power in [1.0, 1e-3, 1e-6, 1e-9] {
        for _ in 0..30 {
            let mut input = orbits.input();
            input[7] *= power;
            let [mu, x, y, z, vx, vy, vz, t] = input;
            let (mut q, mut v, mut dq, mut dv) = ([x, y, z], [vx, vy, vz], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]);
            let s = *kepler.advance_augmented(&mu, &t, &mut q, &mut v, &mut dq, &mut dv);
            assert_eq!([s, q[0], q[1], q[2], v[0], v[1], v[2]], drift(&mut plain, input));
            if power < 1.0 {
                let expected = reference(&input);
                for i in 1..3 {
                    for (found, range) in [(dq[i], 1..4), (dv[i], 4..7)] {
                        let start = Reference::from(input[range.start + i]);
                        let right = difference(&expected[range.start + i], &start).to_f64();
                        let whole = distance(&expected[range.clone()], &input.map(Reference::from)[range]);
                        assert!((found - right).abs() < 1e-14 * whole, "{input:?}: {found}, not {right}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_radial_orbit_comes_back() {
    let period = TAU / 8_f64.sqrt(); // from rest at the distance 1, a = 1/2
    let mut kepler = new::<f64>();
    let mut at = |t: f64| drift(&mut kepler, [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, t]);
    for fraction in [0.1, 0.3, 0.45] {
        let ([_, x, .., vx, _, _], [_, y, .., vy, _, _]) = (at(fraction * period), at((1.0 - fraction) * period));
        assert!((x - y).abs() < 1e-13 && (vx + vy).abs() < 1e-12, "{x}, {y}; {vx}, {vy}");
        assert!((vx * vx / 2.0 - 1.0 / x + 1.0).abs() < 1e-13 / x);
    }
    // away from the centre for ever, to it, and through it
    for (v, t) in [(3.0, 1.0), (-3.0, 0.3), (-3.0, 2.0), (-(2_f64.sqrt()), 5.0)] {
        let input = [1.0, 1.0, 0.0, 0.0, v, 0.0, 0.0, t];
        let (found, expected) = (drift(&mut kepler, input), reference(&input));
        assert!((found[1] / expected[1].to_f64() - 1.0).abs() < 1e-13, "{found:?}");
    }
}

#[test]
fn any_input_ends() {
    let sizes = [0.0, -0.0, 1.0, -3.0, 1e-300, 1e300, 5e-324, f64::MAX, 1e-20, f64::INFINITY, f64::NAN];
    let (mut kepler, mut pair, mut lanes) = (new::<f64>(), new::<DoubleDouble>(), new::<Lanes<4>>());
    for mu in sizes {
        for x in sizes {
            for vx in sizes {
                for t in sizes {
                    let input = [mu, x, 0.5, 0.0, vx, 0.25, 0.0, t];
                    let found = drift(&mut kepler, input);
                    drift(&mut pair, input.map(DoubleDouble::from));
                    let mut with_others = [1.0, 1.0, 0.5, 0.0, 0.0, 0.25, 0.0, 0.1].map(Lanes::<4>::all);
                    let expected = drift(&mut lanes, with_others).map(|x| x.0[0]);
                    with_others.iter_mut().zip(input).for_each(|(lanes, x)| lanes.0[1] = x);
                    let together = drift(&mut lanes, with_others);
                    assert_eq!(together.map(|x| x.0[0]), expected, "{input:?}");
                    let bits = |x: f64| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() };
                    assert_eq!(together.map(|x| bits(x.0[1])), found.map(bits), "{input:?}");
                }
            }
        }
    }
}

#[test]
fn wrong_input_is_refused() {
    let check = |mu: f64, t: f64, q: &[f64], v: &[f64]| KeplerDrift::check(&mu, &t, q, v);
    let (q, v) = ([1.0, 0.0], [0.0, 1.0]);
    assert_eq!(check(1.0, -3.0, &q, &v), Ok(()));
    assert_eq!(check(0.0, 1.0, &q, &v), Err(KeplerDriftError::Gravity(0.0)));
    assert!(check(f64::INFINITY, 1.0, &q, &v).is_err() && check(f64::NAN, 1.0, &q, &v).is_err());
    let message = |result: Result<(), KeplerDriftError>| result.unwrap_err().to_string();
    assert_eq!(message(check(1.0, f64::NAN, &q, &v)), "the time of a Kepler drift must be finite, but it is NaN");
    assert_eq!(
        message(check(1.0, 1.0, &q, &[0.0, f64::INFINITY])),
        "the state of a Kepler drift must be finite, but v[1] is inf"
    );
    assert_eq!(
        message(check(1.0, 1.0, &[0.0, -0.0], &v)),
        "the position of a Kepler drift must not be the centre, q = 0"
    );
    assert_eq!(
        message(check(1.0, 1.0, &q, &[0.0])),
        "a Kepler drift needs as many velocities as positions, and one at least, but it has 2 positions and 1 \
            velocities"
    );
    // in any lane, and the state is unchanged
    let mut lanes = new::<Lanes<4>>();
    let (mut q, mut v) = (q.map(Lanes::<4>::all), v.map(Lanes::<4>::all));
    let mut mu = Lanes::all(1.0);
    mu.0[2] = -2.0;
    let result = lanes.try_advance(&mu, &Lanes::all(0.1), &mut q, &mut v);
    assert_eq!(result.unwrap_err(), KeplerDriftError::Gravity(-2.0));
    assert_eq!(q[0], Lanes::all(1.0));
}

/// Energy, angular momentum and the angle of the pericentre, relative to their first values, of orbits after a number
/// of drifts.
fn wander(orbits: u64, drifts: u64) -> Vec<[f64; 3]> {
    let mut kepler = new::<f64>();
    let of_orbit = |seed| {
        let mut random = Orbits::new(100 + seed);
        let e = random.number(0.01, 0.3);
        let (mut q, mut v) = ([1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()]);
        let start = constants(q, v);
        let t = TAU / random.number(15.0, 100.0);
        (0..drifts).for_each(|_| _ = kepler.advance(&1.0, &t, &mut q, &mut v));
        let end = constants(q, v);
        [end[0] / start[0] - 1.0, end[1] / start[1] - 1.0, (end[2] - start[2] + PI).rem_euclid(TAU) - PI]
    };
    (0..orbits).map(of_orbit).collect()
}

fn constants(q: [f64; 2], v: [f64; 2]) -> [f64; 3] {
    let (r, l) = (q[0].hypot(q[1]), q[0] * v[1] - q[1] * v[0]);
    let eccentricity = [v[1] * l - q[0] / r, -v[0] * l - q[1] / r];
    [(v[0] * v[0] + v[1] * v[1]) / 2.0 - 1.0 / r, l, eccentricity[1].atan2(eccentricity[0])]
}

/// The mean over the orbits in units of its standard error, and the root mean square.
fn bias_and_size(errors: &[[f64; 3]], i: usize) -> [f64; 2] {
    let count = errors.len() as f64;
    let mean = errors.iter().map(|e| e[i]).sum::<f64>() / count;
    let size = (errors.iter().map(|e| e[i] * e[i]).sum::<f64>() / count).sqrt();
    [mean / (size / count.sqrt()), size]
}

#[test]
fn round_off_wanders() {
    let [few, many] = [250, 4000].map(|drifts| wander(40, drifts));
    for i in 0..3 {
        let ([_, short], [bias, long]) = (bias_and_size(&few, i), bias_and_size(&many, i));
        // √16 = 4, where a bias would be 16; each size has an error of a tenth
        assert!(bias.abs() < 4.0 && (2.0..8.0).contains(&(long / short)), "{i}: {bias}, {short:e}, {long:e}");
    }
}

/// The numbers in the documentation, as above.
#[test]
#[ignore = "some minutes"]
fn ten_million_drifts_wander() {
    for drifts in [10_000, 100_000, 1_000_000, 10_000_000] {
        let errors = wander(32, drifts);
        let [energy, momentum, angle] = [0, 1, 2].map(|i| {
            let [bias, size] = bias_and_size(&errors, i);
            assert!(bias.abs() < 4.5, "{drifts} drifts, {i}: {bias}");
            format!("{size:.1e} (mean {bias:.1} standard errors)")
        });
        eprintln!("{drifts} drifts: energy {energy}, angular momentum {momentum}, pericentre {angle}");
    }
}

#[test]
fn a_drift_of_a_planet_has_so_many_operations() {
    let mut kepler = new::<Counting<f64>>();
    let (mut q, mut v) = ([1.0, 0.0, 0.0].map(Counting), [0.0, 1.05, 0.1].map(Counting));
    let (_, operations) = shadowstep::number::counting::count(|| {
        kepler.advance(&Counting(1.0), &Counting(0.1), &mut q, &mut v);
    });
    assert!(operations.roots == 1 && operations.elementary == 0, "{operations}");
    assert!(
        operations.additions < 110 && operations.multiplications < 140 && operations.divisions < 40,
        "{operations}"
    );
}

/// Changes of a relative size around 1 of all eight numbers.
fn direction(input: &Input<f64>) -> Input<f64> {
    std::array::from_fn(|i| input[i] * (1.0 + i as f64).sin())
}

/// The derivatives along that direction.
fn derivatives<N: Number<Context = ()>>(input: &Input<f64>, number: fn(f64) -> N) -> Output<N> {
    let along = direction(input);
    let found: Output<Dual<N>> =
        drift(&mut new(), std::array::from_fn(|i| Dual::new(number(input[i]), [number(along[i])])));
    found.map(|x| {
        let [derivative] = x.derivatives;
        derivative
    })
}

/// The largest error of the derivative of q and v along a direction, as a part of its size, in numbers N beside numbers
/// with more digits.
fn error_of_derivative<N: Number<Context = ()>>(
    input: &Input<f64>,
    number: fn(f64) -> N,
    exactly: fn(&N) -> Reference,
) -> f64 {
    let (long, found) = (derivatives(input, Reference::from), derivatives(input, number).map(|x| exactly(&x)));
    let errors = [1..4, 4..7].map(|range| distance(&found[range.clone()], &long[range.clone()]) / size(&long[range]));
    errors.into_iter().fold(0.0, f64::max)
}

/// Of conditioned inputs, whose times are at most that of a revolution: most derivatives have all digits but two or
/// three, and where terms cancel some fewer.
#[test]
fn derivatives_have_the_digits_of_numbers() {
    let mut orbits = Orbits::new(31);
    let short = |mut input: Input<f64>| {
        let [mu, x, y, z, _, _, _, _] = input;
        let r = (x * x + y * y + z * z).sqrt();
        input[7] = (input[7] * 1e3).sin() * r * (r / mu).sqrt();
        input
    };
    let inputs: Vec<_> =
        cases().into_iter().map(|(input, _)| input).chain((0..300).map(|_| orbits.input())).map(short).collect();
    let check = |error: &dyn Fn(&Input<f64>) -> f64, u: f64| {
        let mut errors: Vec<_> = inputs.iter().map(error).collect();
        errors.sort_by(f64::total_cmp);
        let [most, worst] = [errors[errors.len() * 9 / 10] / u, errors[errors.len() - 1] / u];
        assert!(most < 50.0 && worst < 1e5, "{most} {worst}");
    };
    check(&|input| error_of_derivative(input, |x| x, exactly::<f64>), f64::EPSILON);
    check(&|input| error_of_derivative(input, Limbs::<2>::from, exactly), 2_f64.powi(-127));
}

/// Of any orbit over up to 30 revolutions: central differences of 10⁻²⁵ have an error of 10⁻⁵⁰ times third derivatives,
/// in 96 digits.
#[test]
fn derivatives_are_limits_of_differences() {
    let mut orbits = Orbits::new(37);
    let inputs = cases().into_iter().map(|(input, _)| input).chain((0..300).map(|_| orbits.input()));
    for input in inputs {
        let (along, found) = (direction(&input), derivatives(&input, Reference::from));
        let moved = |by: &str| -> Output<Reference> {
            let by = Reference::from_rational(&exact(by).unwrap(), &());
            let at = |i: usize| {
                let mut moved = Reference::from(input[i]);
                moved.add_product(&by, &Reference::from(along[i]));
                moved
            };
            drift(&mut new(), std::array::from_fn(at))
        };
        let half = Reference::from_rational(&exact("5e24").unwrap(), &());
        let expected: Vec<Reference> = moved("1e-25")
            .iter()
            .zip(moved("-1e-25"))
            .map(|(plus, minus)| {
                let mut difference = difference(plus, &minus);
                difference.multiply(&half);
                difference
            })
            .collect();
        for range in [0..1, 1..4, 4..7] {
            let error = distance(&found[range.clone()], &expected[range.clone()]) / size(&expected[range.clone()]);
            assert!(error < 1e-25, "{range:?} of {input:?}: {error:e}");
        }
    }
}
