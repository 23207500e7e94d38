//! Protects the exact flow: its energies, its closed forms, its β against independent integrals; and what the
//! estimators show on it, against numbers of an independent program.

use rug::Float;
use rug::float::Constant;
use shadowstep::number::CorrectlyRounded;
use shadowstep::problems::{PROBLEMS, Problem, Setup, SolutionError, problem};
use shadowstep::shadow::exact_flow::{self, ExactFlow, ExactFlowError, has_exact_flow};
use shadowstep::shadow::run::{ShadowRun, States};
use shadowstep::shadow::weights::central;
use shadowstep::shadow::{Bilinear, BuildEstimator, Central, StoppingRule};
use shadowstep::{Number, Real};
use shadowstep_tests::{log10_distance, number, numbers, potential_values, precision, rational, step_size};

const DIGITS: u32 = 60;

/// A state of the exact flow.
#[derive(Clone, Debug)]
struct Owned<N> {
    n: i64,
    q: Vec<N>,
    p: Vec<N>,
    beta: N,
}

fn setup(name: &str, set: &[(&str, &str)]) -> Setup {
    let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    problem(name).unwrap().setup(&set, 400).unwrap()
}

fn states<N: CorrectlyRounded>(
    setup: &Setup,
    h: &str,
    steps: u64,
    reach: usize,
    context: &N::Context,
) -> Vec<Owned<N>> {
    let mut flow = ExactFlow::<N>::new(setup, &step_size(h), steps, reach, context).unwrap();
    let mut all = Vec::new();
    while let Some(state) = flow.advance().unwrap() {
        all.push(Owned { n: state.n, q: state.q.to_vec(), p: state.p.to_vec(), beta: state.increments.beta.clone() });
    }
    assert_eq!(all.len(), steps as usize + 2 * reach + 1);
    all
}

fn at_60(setup: &Setup, h: &str, steps: u64, reach: usize) -> Vec<Owned<Float>> {
    states(setup, h, steps, reach, &precision(DIGITS))
}

/// The default start of every problem whose exact flow is known, and harder ones: circles, near collisions, tilted and
/// retrograde ellipses, libration, rotation in both directions and nearly the separatrix.
fn starts() -> Vec<Setup> {
    let tilted = [("x", "1"), ("y", "1/2"), ("px", "-1/3"), ("py", "-1")];
    let harder = [
        setup("kepler", &[("eccentricity", "0")]),
        setup("kepler", &[("eccentricity", "3/10")]),
        setup("kepler", &[("eccentricity", "9/10")]),
        setup("kepler", &[("eccentricity", "999/1000")]),
        setup("kepler", &tilted),
        setup("harmonic-oscillator", &[("omega", "sqrt(2)"), ("q", "1/3"), ("p", "-2")]),
        setup("pendulum", &[("q", "2"), ("p", "-1/2")]),
        setup("pendulum", &[("q", "-1"), ("p", "3")]),
        setup("pendulum", &[("q", "1"), ("p", "-20")]),
        setup("pendulum", &[("p", "2 - 1/1000000")]),
        setup("pendulum", &[("p", "2")]),
        setup("pendulum", &[("p", "0")]),
    ];
    exact_flow::problems().map(|problem| setup(problem.name(), &[])).chain(harder).collect()
}

#[test]
fn the_energy_is_that_of_the_start() {
    for setup in starts() {
        let context = precision(DIGITS);
        let mut motion = setup.motion::<Float>(&context).unwrap();
        let energy = motion.energy();
        for Owned { n, q, p, .. } in at_60(&setup, "1/7", 300, 5) {
            // near the centre the rounding of q is enlarged by |U_q| |q| = 1/|q| ≤ 1000, of p by |p|² ≤ 2000
            let off = log10_distance(&motion.energy_at(&q, &p), &energy);
            assert!(off < -f64::from(DIGITS) + 4.0, "{:?}, n = {n}: 1e{off}", setup.values);
        }
    }
}

#[test]
fn the_state_0_is_the_start_and_states_do_not_depend_on_the_way_to_them() {
    let context = precision(DIGITS);
    for setup in starts() {
        let all = at_60(&setup, "1/4", 20, 3);
        assert_eq!((&all[3].q, &all[3].p), (&setup.values.q(&context), &setup.values.p(&context)));
        assert_eq!(all[3].n, 0);
        // half the step, twice the steps
        let finer = at_60(&setup, "1/8", 40, 6);
        for (coarse, fine) in all.iter().zip(finer.iter().step_by(2)) {
            assert_eq!(coarse.n * 2, fine.n);
            let pairs = coarse.q.iter().chain(&coarse.p).zip(fine.q.iter().chain(&fine.p));
            for (a, b) in pairs {
                assert!(log10_distance(a, b) < -f64::from(DIGITS) + 3.0, "{:?}: {coarse:?}, {fine:?}", setup.values);
            }
        }
    }
}

/// The derivatives satisfy the equations of motion and β' = qᵀU_q − 2U: differences at 40 digits, D_30 of steps far
/// below the distance of the nearest singularity, 0.03 for e = 0.9 and 0.3 for e = 0.6.
#[test]
fn derivatives_are_those_of_the_system_and_of_beta() {
    let m = 30;
    let eccentricity = |setup: &Setup| setup.values.named()[0].1.value.clone();
    for setup in starts().into_iter().filter(|setup| eccentricity(setup) != rational("999/1000")) {
        let h = if eccentricity(&setup) == rational("9/10") { "1/2000" } else { "1/200" };
        let potential = setup.potential::<Float>(&precision(DIGITS));
        let all = at_60(&setup, h, 3, m);
        let weights = central(m as u32);
        for middle in m..all.len() - m {
            let difference = |of: &dyn Fn(usize, usize) -> Float| {
                let mut sum = number("0", DIGITS);
                for (j, weight) in (1..).zip(weights.iter()) {
                    sum += of(middle - j, middle + j) * number(&(weight / rational(h)).to_string(), DIGITS);
                }
                sum
            };
            let added = |from: usize, to: usize| {
                all[from + 1..=to].iter().fold(number("0", DIGITS), |sum, state| sum + &state.beta)
            };
            let values = potential_values(&potential, &all[middle].q);
            let (rate, gradient) = (&values[1], &values[2..2 + all[middle].q.len()]);
            let close = |found: &Float, right: &Float, what: &str| {
                let off = log10_distance(found, right);
                assert!(off < -40.0, "{:?}, {what}: 1e{off}", setup.values);
            };
            close(&difference(&|from, to| added(from, to)), rate, "beta");
            for (i, gradient) in gradient.iter().enumerate() {
                close(&difference(&|from, to| all[to].q[i].clone() - &all[from].q[i]), &all[middle].p[i], "q");
                close(&difference(&|from, to| all[from].p[i].clone() - &all[to].p[i]), gradient, "p");
            }
        }
    }
}

/// After half a period 2π/2 the orbit of a = 1 is at its apocentre, and β = 3E has grown by 3π; after a period it is
/// back.
#[test]
fn kepler_at_its_apocentre() {
    let pi = step_size(&Float::with_val(400, Constant::Pi).to_text());
    for e in ["0", "1/10", "6/10", "9/10"] {
        let setup = setup("kepler", &[("eccentricity", e)]);
        let mut flow = ExactFlow::<Float>::new(&setup, &pi, 2, 0, &precision(DIGITS)).unwrap();
        let [start, half, full] = [0, 1, 2].map(|n| {
            let state = flow.advance().unwrap().unwrap();
            assert_eq!(state.n, n);
            (state.q.to_vec(), state.p.to_vec(), state.increments.beta.clone())
        });
        let right = numbers::<Float>(&[&format!("-1 - {e}"), "0"], &precision(DIGITS));
        let speed = (number(&format!("1 - {e}"), 80) / number(&format!("1 + {e}"), 80)).sqrt();
        let slow = [number("0", DIGITS), -Float::with_val(start.2.prec(), speed)];
        let beta = Float::with_val(start.2.prec(), Constant::Pi) * 3u32;
        let found = half.0.iter().chain(&half.1).chain([&half.2, &full.2]).chain(&full.0).chain(&full.1);
        let expected = right.iter().chain(&slow).chain([&beta, &beta]).chain(&start.0).chain(&start.1);
        for (found, expected) in found.zip(expected) {
            assert!(log10_distance(found, expected) < -f64::from(DIGITS) + 1.0, "e = {e}: {found}, {expected}");
        }
    }
}

/// Times reversed and momenta turned: q(−t) = q(t) and p(−t) = −p(t) in x; the pendulum from q = 0 is odd.
#[test]
fn negative_times_mirror_positive_ones() {
    let mirrored = |setup: &Setup, signs: &[i32]| {
        let all = at_60(setup, "1/10", 0, 40);
        for n in 0..40 {
            let (earlier, later) = (&all[40 - n], &all[40 + n]);
            let earlier = earlier.q.iter().chain(&earlier.p);
            for ((a, b), sign) in earlier.zip(later.q.iter().chain(&later.p)).zip(signs) {
                assert!(*a == b.clone() * *sign, "{:?}, n = {n}: {a}, {b}", setup.values);
            }
            assert!(log10_distance(&all[40 - n].beta, &all[41 + n].beta) < -f64::from(DIGITS), "n = {n}");
        }
    };
    mirrored(&setup("kepler", &[]), &[1, -1, -1, 1]);
    mirrored(&setup("pendulum", &[]), &[-1, 1]);
    mirrored(&setup("harmonic-oscillator", &[]), &[1, -1]);
}

#[test]
fn the_oscillator_is_its_closed_form() {
    let setup = setup("harmonic-oscillator", &[("omega", "3"), ("q", "2"), ("p", "5")]);
    for Owned { n, q, p, beta } in at_60(&setup, "1/10", 50, 2) {
        let angle = number("3/10", 80) * n as i32;
        let (sin, cos) = angle.sin_cos(number("0", 80));
        let right = [cos.clone() * 2u32 + sin.clone() * 5u32 / 3u32, cos * 5u32 - sin * 6u32];
        for (found, right) in [&q[0], &p[0]].into_iter().zip(&right) {
            assert!(log10_distance(found, &Float::with_val(found.prec(), right)) < -f64::from(DIGITS) + 1.0, "n = {n}");
        }
        assert!(beta.is_zero());
    }
}

/// π/AGM(1, √(1 − k²))·½ = K(k)
fn quarter_period(k: &Float) -> Float {
    let (mut a, mut b) = (Float::with_val(k.prec(), 1), (1u32 - k.clone().square()).sqrt());
    for _ in 0..30 {
        (a, b) = ((a.clone() + &b) / 2u32, (a * &b).sqrt());
    }
    Float::with_val(k.prec(), Constant::Pi) / 2u32 / a
}

/// sin(q/2) = k sn(t, k) with k = p(0)/2: after K(k) the pendulum turns, sin(q/2) = k, and after 4K(k) it is back;
/// rotation, k > 1, is round once after 2K(1/k)/k.
#[test]
fn the_pendulum_has_jacobis_periods() {
    for p in ["1/10", "1", "199/100"] {
        let k = number(p, 120) / 2u32;
        let h = step_size(&quarter_period(&k).to_text());
        let mut flow = ExactFlow::<Float>::new(&setup("pendulum", &[("p", p)]), &h, 4, 0, &precision(DIGITS)).unwrap();
        let mut all = Vec::new();
        while let Some(state) = flow.advance().unwrap() {
            all.push((state.q[0].clone(), state.p[0].clone()));
        }
        let turn = Float::with_val(all[0].0.prec(), k.asin() * 2u32);
        assert!(log10_distance(&all[1].0, &turn) < -f64::from(DIGITS) + 1.0, "p = {p}: {}", all[1].0);
        assert!(all[1].1.log10_abs() < -f64::from(DIGITS) + 1.0);
        assert!(all[4].0.log10_abs() < -f64::from(DIGITS) + 1.0, "p = {p}: {}", all[4].0);
        assert!(log10_distance(&all[4].1, &all[0].1) < -f64::from(DIGITS));
    }
    let k = number("3", 120) / 2u32;
    let h = step_size(&(quarter_period(&k.clone().recip()) * 2u32 / &k).to_text());
    let mut flow = ExactFlow::<Float>::new(&setup("pendulum", &[("p", "3")]), &h, 1, 0, &precision(DIGITS)).unwrap();
    flow.advance().unwrap();
    let round = flow.advance().unwrap().unwrap();
    let turn = Float::with_val(round.q[0].prec(), Constant::Pi) * 2u32;
    assert!(log10_distance(&round.q[0], &turn) < -f64::from(DIGITS) + 1.0);
    assert!(log10_distance(&round.p[0], &number("3", DIGITS)) < -f64::from(DIGITS) + 1.0);
}

/// On the separatrix p = 2/cosh t, although errors grow by e^t.
#[test]
fn the_separatrix_keeps_its_digits() {
    let setup = setup("pendulum", &[("p", "2")]);
    for Owned { n, p, .. } in at_60(&setup, "1", 100, 0) {
        let right = number("2", 120) / number(&n.to_string(), 120).cosh();
        let off = log10_distance(&p[0], &Float::with_val(p[0].prec(), &right));
        assert!(off < -f64::from(DIGITS) + 1.0, "t = {n}: 1e{off}");
    }
}

#[test]
fn doubles_are_the_nearest_ones_at_all_times() {
    // but for the separatrix, on which p goes to 0 and keeps no relative accuracy
    for setup in starts().into_iter().filter(|setup| setup.values.named()[1].1.value != rational("2")) {
        let double = states::<f64>(&setup, "5", 8, 1, &());
        let precise = at_60(&setup, "5", 8, 1);
        for (found, right) in double.iter().zip(&precise) {
            let found = found.q.iter().chain(&found.p).chain([&found.beta]);
            let right = right.q.iter().chain(&right.p).chain([&right.beta]);
            found.zip(right).for_each(|(found, right)| assert_eq!(*found, right.to_f64(), "{:?}", setup.values));
        }
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Estimators

/// The largest |value + 1/2| over an orbit of Kepler's problem, e = 0.6.
fn largest_error(h: &str, settings: &impl BuildEstimator<Float>) -> f64 {
    let (context, h) = (precision(DIGITS), step_size(h));
    // 2π/h states
    let steps = (std::f64::consts::TAU / f64::from_rational(h.exact(), &())) as u64 + 1;
    let setup = setup("kepler", &[]);
    let mut run = ShadowRun::<ExactFlow<Float>, _>::of_exact_flow(&setup, &h, steps, settings, &context).unwrap();
    let mut largest = 0.0_f64;
    while let Some((_, found)) = run.advance().unwrap() {
        largest = largest.max(Float::to_f64(&(found.value.clone() + 0.5)).abs());
    }
    largest
}

/// Computed by another program.
#[test]
fn the_bilinear_estimator_errs_as_known() {
    for (h, known) in [("1/10", [8.4e-5, 3.7e-6, 3.0e-7]), ("1/20", [5.2e-7, 6.5e-10, 1.4e-12])] {
        for (k, known) in [4, 8, 16].into_iter().zip(known) {
            let found = largest_error(h, &Bilinear::new(k));
            println!("h = {h}, k = {k}: {found:e}");
            assert!((found / known - 1.0).abs() < 0.1, "h = {h}, k = {k}: {found:e}");
        }
    }
}

/// The error of D_m falls by 2^{2m} where h is halved and small.
#[test]
fn the_central_estimator_errs_by_its_order() {
    for m in [1, 2, 4, 8] {
        let [coarse, fine] = ["1/160", "1/320"].map(|h| largest_error(h, &Central::fixed(m)));
        let order = (coarse / fine).log2();
        println!("m = {m}: {coarse:e}, {fine:e}, order {order}");
        assert!((order - 2.0 * f64::from(m)).abs() < 0.2, "m = {m}: {order}");
    }
}

#[test]
fn the_drift_is_that_of_the_estimates() {
    let (setup, h) = (setup("kepler", &[]), step_size("1/20"));
    let best = Central::best(40, StoppingRule::Full);
    let mut run = ShadowRun::<ExactFlow<f64>, _>::of_exact_flow(&setup, &h, 200, &best, &()).unwrap();
    let found = run.drift().unwrap();
    assert!(found.minimum <= -0.5 && found.maximum >= -0.5 && found.drift < 1e-4, "{found:?}");
    assert_eq!((found.drift, found.evaluations), (found.maximum - found.minimum, 0));
}

// ---------------------------------------------------------------------------------------------------------------
// Refusals

#[test]
fn what_has_no_exact_flow_is_refused() {
    let names: Vec<_> = exact_flow::problems().map(Problem::name).collect();
    assert!(names.contains(&"kepler") && !names.contains(&"henon-heiles"));
    for &problem in PROBLEMS {
        let answer = has_exact_flow(&setup(problem.name(), &[]));
        match names.contains(&problem.name()) {
            true => assert_eq!(answer, Ok(())),
            false => {
                let (problem, known) = (problem.name(), names.join(", "));
                assert_eq!(answer, Err(ExactFlowError::NoSolution { problem, known }));
            }
        }
    }
    let refusal = |set: &[(&str, &str)]| has_exact_flow(&setup("kepler", set)).unwrap_err().to_string();
    let unbound =
        "the exact flow of kepler is computed for bound orbits only: this initial state has H = |p|^2/2 - 1/|q| >= 0";
    let radial = "the exact flow of kepler is computed for ellipses only: this initial state has no angular momentum, \
        x py - y px = 0";
    assert_eq!(refusal(&[("x", "1"), ("py", "2")]), unbound);
    assert_eq!(refusal(&[("x", "2"), ("py", "1")]), unbound);
    assert_eq!(refusal(&[("px", "1"), ("py", "0")]), radial);
    assert_eq!(refusal(&[("x", "0")]), radial);
}

#[test]
fn too_many_digits_are_refused() {
    let (setup, h) = (setup("pendulum", &[("p", "2")]), step_size("1"));
    let new = |steps| ExactFlow::<f64>::new(&setup, &h, steps, 0, &()).err();
    assert!(matches!(new(10_000), Some(ExactFlowError::Solution(SolutionError::TooSensitive { .. }))));
    assert_eq!(new(2_000), None);
}
