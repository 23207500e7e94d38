//! Protects estimators in fixed point, as with `Limbs`: against the same estimators in MPFR, on the same states, with
//! many more digits and with as many.

use rug::integer::Order;
use rug::{Float, Integer};
use shadowstep::number::{Limbs, Precision, Real};
use shadowstep::problems::{PROBLEMS, Problem};
use shadowstep::shadow::run::{States, Trajectory, TrajectoryState};
use shadowstep::shadow::{
    Bilinear, BuildEstimator, Central, Estimator, EstimatorSettings, SelectionRule, StoppingRule,
};
use shadowstep::tables::shipped;
use shadowstep::{Increments, StepSize, Stepper};

/// q, p and the increment of β.
#[derive(Clone)]
struct Given<N> {
    q: Vec<N>,
    p: Vec<N>,
    beta: N,
}

/// An estimate; the numbers of one that is computed without errors are the value alone.
struct Found<N> {
    numbers: Vec<N>,
    order: u32,
    /// Σ |q| |p|/h, which the last places of a state count in an estimate.
    scale: f64,
}

fn estimates<N: Real + 'static>(
    states: &[Given<N>],
    settings: &EstimatorSettings,
    context: &N::Context,
) -> Vec<Found<N>> {
    let h = StepSize::try_from("1/20").unwrap();
    let mut estimator = BuildEstimator::<N>::build(settings, &h, states[0].q.len(), context).unwrap();
    let mut found = Vec::new();
    for Given { q, p, beta } in states {
        if let Some(estimate) = estimator.push(q, p, Increments::of_beta(beta)) {
            let numbers = [Some(estimate.value), estimate.last_term, estimate.error];
            let products = estimate.q.iter().zip(estimate.p).map(|(q, p)| (q.to_f64() * p.to_f64()).abs());
            let scale = 20.0 * products.sum::<f64>();
            let numbers = numbers.into_iter().flatten().cloned().collect();
            found.push(Found { numbers, order: estimate.order, scale });
        }
    }
    found
}

/// The same number, if it fits into these bits.
fn float<const L: usize>(x: &Limbs<L>, bits: u32) -> Float {
    let Some(exponent) = x.exponent() else { return Float::with_val(bits, x.to_f64()) };
    let mantissa = Float::with_val(bits, Integer::from_digits(x.mantissa(), Order::Lsf));
    let size = mantissa << (exponent - Limbs::<L>::BITS as i32);
    if x.is_sign_negative() { -size } else { size }
}

fn floats<const L: usize>(states: &[Given<Limbs<L>>], bits: u32) -> Vec<Given<Float>> {
    let numbers = |vector: &[Limbs<L>]| vector.iter().map(|x| float(x, bits)).collect();
    states.iter().map(|s| Given { q: numbers(&s.q), p: numbers(&s.p), beta: float(&s.beta, bits) }).collect()
}

/// |x| 2^(64 L)
fn size<const L: usize>(x: &Float) -> f64 {
    (Float::with_val(64, x).abs() << Limbs::<L>::BITS).to_f64()
}

/// |a − b| 2^(64 L), where both are finite; 0 where neither is.
fn distance<const L: usize>(a: &Float, b: &Float) -> f64 {
    match (a.is_finite(), b.is_finite()) {
        (true, true) => size::<L>(&Float::with_val(64, a - b)),
        (false, false) => 0.0,
        _ => f64::INFINITY,
    }
}

/// Errors in fixed point are at most five times the largest of MPFR with as many bits, among the estimates up to `near`
/// places away, and ε Σ |q| |p|/h; and so are errors of the last terms, also where another order is selected.
fn compare<const L: usize>(what: &str, states: &[Given<Limbs<L>>], settings: &EstimatorSettings, near: usize) {
    let bits = Limbs::<L>::BITS;
    let in_mpfr = |bits: u32| estimates(&floats(states, bits), settings, &Precision::bits(bits).unwrap());
    let (fixed, rounded, exact) = (estimates(states, settings, &()), in_mpfr(bits), in_mpfr(3 * bits + 500));
    assert!(fixed.len() == exact.len() && exact.len() > 10, "{what}: {} estimates", exact.len());
    for (n, (found, right)) in fixed.iter().zip(&exact).enumerate() {
        assert_eq!(found.numbers.len(), right.numbers.len());
        for (i, (found_number, right_number)) in found.numbers.iter().zip(&right.numbers).enumerate() {
            let others = n.saturating_sub(near)..(n + near + 1).min(exact.len());
            let usual = others.map(|n| distance::<L>(&rounded[n].numbers[i], &exact[n].numbers[i])).fold(0.0, f64::max);
            let error = distance::<L>(&float(found_number, 2 * bits), right_number);
            // another order is as good where the terms are alike: the values differ by such terms
            let alike = if found.order == right.order || i > 0 { 0.0 } else { 4.0 * size::<L>(&right.numbers[1]) };
            assert!(
                error <= 5.0 * usual + right.scale + alike,
                "{what}, {settings}, number {i} of estimate {n}: error {error:e}, of MPFR {usual:e}"
            );
        }
    }
}

fn all_settings(largest: u32) -> Vec<EstimatorSettings> {
    let best = |stop| EstimatorSettings::from(Central::best(largest, stop));
    vec![
        best(StoppingRule::Full),
        best(StoppingRule::Early),
        best(StoppingRule::Printed),
        Central::best_with_error(largest, StoppingRule::Full, SelectionRule::Robust).into(),
        Central::best_with_error(largest, StoppingRule::Early, SelectionRule::Robust).into(),
        Bilinear::new(1).into(),
        Bilinear::with_error(8).into(),
        Bilinear::with_error(23).into(),
        Bilinear::best(16).into(),
    ]
}

fn trajectory<const L: usize>(problem: Problem, h: &str, steps: u64) -> Vec<Given<Limbs<L>>> {
    let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), h).unwrap();
    let start = problem.setup(&[], 120).unwrap().motion::<Limbs<L>>(&()).unwrap();
    let mut states = Trajectory::new(stepper.with(start), steps, 0).unwrap();
    let mut all = Vec::new();
    while let Some(TrajectoryState { q, p, increments, .. }) = states.advance().unwrap() {
        all.push(Given { q: q.to_vec(), p: p.to_vec(), beta: *increments.beta });
    }
    all
}

/// In one to 18 coordinates.
#[test]
fn states_of_all_problems() {
    for problem in PROBLEMS {
        let h = match problem {
            Problem::OuterSolarSystem => "100",
            Problem::ArgonCrystal | Problem::FputStiff => "1/1000",
            _ => "1/20",
        };
        let states = trajectory::<3>(*problem, h, 90);
        for settings in all_settings(20) {
            compare(problem.name(), &states, &settings, usize::MAX / 2);
        }
    }
}

/// As many terms and digits as in the paper: digits of differences are dropped seven times.
#[test]
fn two_hundred_terms_of_120_digits() {
    let states = trajectory::<7>(Problem::Kepler, "1/20", 430);
    for stop in [StoppingRule::Full, StoppingRule::Early] {
        compare("Kepler", &states, &Central::best(200, stop).into(), usize::MAX / 2);
    }
    compare("Kepler", &states, &Bilinear::with_error(50).into(), usize::MAX / 2);
}

/// The fewest limbs and the most; and weights of four limbs.
#[test]
fn few_limbs_and_many() {
    compare(
        "two limbs",
        &trajectory::<2>(Problem::Kepler, "1/20", 90),
        &Central::best(30, StoppingRule::Full).into(),
        99,
    );
    let states = trajectory::<17>(Problem::Kepler, "1/20", 180);
    compare("17 limbs", &states, &Central::best(70, StoppingRule::Full).into(), 99);
    compare("17 limbs", &states, &Bilinear::with_error(128).into(), 99);
}

/// States of which every coordinate is a product of a size and a smooth function of n.
fn synthetic(count: i32, coordinate: impl Fn(usize, i32) -> Float) -> Vec<Given<Limbs<4>>> {
    let number = |c, n| {
        let x: Float = coordinate(c, n);
        let parts = x.get_significand().map_or_else(Vec::new, |integer| integer.to_digits::<u64>(Order::Lsf));
        let exponent = i64::from(x.get_exp().unwrap_or(0)) - i64::from(x.prec());
        Limbs::from_magnitude(x.is_sign_negative(), &parts, exponent, false)
    };
    let state =
        |n| Given { q: vec![number(0, n), number(1, n)], p: vec![number(2, n), number(3, n)], beta: number(4, n) };
    (0..count).map(state).collect()
}

/// cos((1 + c/10) n/20), and its phase shifted for p.
fn wave(c: usize, n: i32) -> Float {
    let angle: Float = Float::with_val(320, 10 + c as u32) * n / 200_u32;
    (angle + c as u32).cos()
}

fn power(base: f64, n: i32) -> Float {
    Float::with_val(320, rug::ops::Pow::pow(Float::with_val(320, base), n))
}

#[test]
fn coordinates_of_very_different_sizes() {
    let sizes = [0, -30, 0, 30, -12].map(|exponent| power(10.0, exponent));
    let states = synthetic(120, |c, n| wave(c, n) * &sizes[c]);
    all_settings(24).iter().for_each(|settings| compare("sizes", &states, settings, 99));
}

/// By 10^30 in the states of an estimate: the unit of a row follows, and the error of each estimate follows from the
/// states near it.
#[test]
fn coordinates_that_grow_and_shrink() {
    for base in [4.0, 0.25] {
        let states = synthetic(160, |c, n| wave(c, n) * power(base, n));
        all_settings(24).iter().for_each(|settings| compare("growth", &states, settings, 6));
        let states = synthetic(160, |c, n| wave(c, n) * power(if c < 2 { base } else { 1.0 / base }, n));
        all_settings(24).iter().for_each(|settings| compare("growth of q", &states, settings, 6));
    }
}

#[test]
fn coordinates_that_are_zero() {
    let zero = |condition: bool, x: Float| if condition { Float::new(320) } else { x };
    let always = synthetic(100, |c, n| zero(c % 2 == 1, wave(c, n)));
    let at_first = synthetic(100, |c, n| zero(n < 40 || c == 4, wave(c, n) / 1_000_000));
    let at_times = synthetic(100, |c, n| zero(n % 7 == c as i32, wave(c, n)));
    for settings in all_settings(20) {
        compare("0 always", &always, &settings, 99);
        compare("0 at first", &at_first, &settings, 99);
        compare("0 at times", &at_times, &settings, 99);
    }
}

/// Differences of order r are 2^r times as large as states: the most that there is room for.
#[test]
fn states_that_alternate() {
    let sign = |n: i32| if n % 2 == 0 { 1 } else { -1 };
    // the largest numbers of a row, whose next ones begin a digit higher
    let largest = Float::with_val(320, Float::i_exp(1, 47)) - Float::with_val(320, Float::i_exp(1, -150));
    let states = synthetic(300, |c, n| Float::with_val(320, &largest * sign(n)) / (1 + (c == 4) as i32));
    compare("alternating", &states, &Central::best(140, StoppingRule::Full).into(), 999);
    let states = synthetic(300, |c, n| Float::with_val(320, wave(c, n) * sign(n)));
    compare("alternating waves", &states, &Central::best(140, StoppingRule::Full).into(), 999);
}

/// Estimates with such a state are NaN, and those after it are as if it had not been.
#[test]
fn states_that_are_not_finite() {
    for bad in [f64::NAN, f64::INFINITY] {
        for c in 0..5 {
            let mut states = synthetic(150, wave);
            let Given { q, p, beta } = &mut states[50];
            *q.iter_mut().chain(p).chain([beta]).nth(c).unwrap() = Limbs::from(bad);
            for settings in all_settings(20) {
                let (found, clean) = (estimates(&states, &settings, &()), estimates(&states[51..], &settings, &()));
                let is_finite = |found: &Found<Limbs<4>>| found.numbers.iter().all(Limbs::is_finite);
                assert!(!found.iter().all(is_finite), "{settings}: the state is in some estimates");
                for (found, clean) in found.iter().rev().zip(clean.iter().rev()) {
                    let errors = found.numbers.iter().zip(&clean.numbers).map(|(a, b)| (a - b).abs().to_f64());
                    assert!(errors.fold(0.0, f64::max) < 1e-72 && found.order == clean.order, "{settings}");
                }
            }
        }
    }
}

/// 0 times NaN: the differences of such a state are 0 where they are known.
#[test]
fn states_that_are_not_finite_with_increments_that_are() {
    let h = StepSize::try_from("1/20").unwrap();
    let mut estimator = BuildEstimator::<Limbs<4>>::build(&Central::best(2, StoppingRule::Full), &h, 1, &()).unwrap();
    let zero = [Limbs::from(0.0)];
    let mut are_finite = Vec::new();
    for n in 0..20 {
        let p = [if n == 10 { Limbs::from(f64::NAN) } else { zero[0] }];
        let increments = Increments { q: &zero, p: &zero, beta: &zero[0] };
        are_finite.extend(estimator.push(&zero, &p, increments).map(|estimate| estimate.value.is_finite()));
    }
    // the first value is of the state 2
    let expected: Vec<bool> = (2..18).map(|n| n != 10).collect();
    assert_eq!(are_finite, expected);
}
