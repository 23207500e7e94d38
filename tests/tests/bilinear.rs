//! Protects the bilinear estimator: its weights against their definition and against printed tables, in exact
//! arithmetic; its order; its closed form; runs between states; schemes of all kinds.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::Zero;
use rug::Float;
use shadowstep::problems::{HenonHeiles, Kepler, Pendulum};
use shadowstep::shadow::run::{ShadowRun, energy_drift};
use shadowstep::shadow::weights::{bilinear, central};
use shadowstep::shadow::{Bilinear, BuildEstimator, Central, Estimator};
use shadowstep::tables::TableScheme;
use shadowstep::{Motion, Number, Potential, Rational, Stepper, UnitMasses};
use shadowstep_tests::{log10_distance, numbers, precision, rational, stepper};

fn integer(n: impl Into<BigInt>) -> Rational {
    Rational::from_integer(n.into())
}

// ---------------------------------------------------------------------------------------------------------------
// Weights, exactly

/// P_ij for all i and j.
fn weight(rows: &[Vec<Rational>], i: usize, j: usize) -> Rational {
    match i.cmp(&j) {
        std::cmp::Ordering::Greater => rows[i - j - 1][j].clone(),
        std::cmp::Ordering::Less => -rows[j - i - 1][i].clone(),
        std::cmp::Ordering::Equal => Rational::zero(),
    }
}

/// C(n, r)
fn binomial(n: u32, r: u32) -> Rational {
    (0..r).map(|i| Rational::new((n - i).into(), (i + 1).into())).product()
}

/// With q = e^{xt} and p = e^{yt}, Σ P_ij q_i p_j is (x − y) Σ_i w_i e^{−i(x+y)}, w_i = C(k,i)²/C(2k,k), up to terms of
/// degree 2k + 1 in x and y: the estimate is the mean with the weights w of ½(q'p − qp'), to the order 2k.
#[test]
fn weights_have_their_defining_property() {
    for k in 1..=12 {
        let (rows, size) = (bilinear(k), k as usize);
        let power = |base: usize, exponent: u32| (0..exponent).map(|_| integer(base)).product::<Rational>();
        let factorial = |n: u32| (1..=n).map(integer).product::<Rational>();
        // the coefficient of x^a y^b, but for the sign (−1)^{a+b}
        let found = |a: u32, b: u32| -> Rational {
            let pairs = (0..=size).flat_map(|i| (0..=size).map(move |j| (i, j)));
            let sum: Rational = pairs.map(|(i, j)| weight(&rows, i, j) * power(i, a) * power(j, b)).sum();
            sum / factorial(a) / factorial(b)
        };
        let mean = |n: u32| -> Rational {
            let all: Rational = (0..=k).map(|i| binomial(k, i) * binomial(k, i) * power(i as usize, n)).sum();
            all / binomial(2 * k, k)
        };
        // (x − y)(x + y)^n/n! at x^a y^b, a + b = n + 1, times the mean of iⁿ; (−1)^n = −(−1)^{a+b}
        let expected = |a: u32, b: u32| -> Rational {
            let n = a + b - 1;
            let from_x = if a > 0 { binomial(n, a - 1) } else { Rational::zero() };
            let from_y = if b > 0 { binomial(n, b - 1) } else { Rational::zero() };
            -(from_x - from_y) * mean(n) / factorial(n)
        };
        for degree in 1..=2 * k {
            for a in 0..=degree {
                assert_eq!(found(a, degree - a), expected(a, degree - a), "k = {k}: x^{a} y^{}", degree - a);
            }
        }
        let next = 2 * k + 1;
        assert!((0..=next).any(|a| found(a, next - a) != expected(a, next - a)), "k = {k}: more than was to be shown");
    }
}

/// ∇^i q·∇^j p of the tables as products of states: ∇^i = Σ_r (−1)^r C(i,r) (r states back).
#[test]
fn weights_are_those_of_the_printed_tables() {
    let tables: toml::Table = include_str!("skeel_engle.toml").parse().unwrap();
    assert_eq!(tables.len(), 6);
    for (k, table) in &tables {
        let k: u32 = k.parse().unwrap();
        let mut products: BTreeMap<(u32, u32), Rational> = BTreeMap::new();
        let mut betas: BTreeMap<u32, Rational> = BTreeMap::new();
        let sign = |n: u32| if n.is_multiple_of(2) { integer(1) } else { integer(-1) };
        for (place, c) in table.as_table().unwrap() {
            let (i, j) = place.split_once(',').unwrap();
            let (i, j, c): (u32, u32, _) = (i.parse().unwrap(), j.parse().unwrap(), rational(c.as_str().unwrap()));
            for (r, s) in (0..=i).flat_map(|r| (0..=j).map(move |s| (r, s))) {
                let value = &c * sign(r + s) * binomial(i, r) * binomial(j, s);
                *products.entry((r, s)).or_insert_with(Rational::zero) += &value;
                *products.entry((s, r)).or_insert_with(Rational::zero) -= &value;
            }
            if j == 0 {
                for r in 0..=i {
                    *betas.entry(r).or_insert_with(Rational::zero) += &c * sign(r) * binomial(i, r);
                }
            }
        }
        let rows = bilinear(k);
        for ((i, j), value) in products {
            assert_eq!(value, weight(&rows, i as usize, j as usize), "k = {k}: P_{i},{j}");
        }
        for (i, value) in betas {
            let sum: Rational = (0..=k).map(|j| weight(&rows, i as usize, j as usize)).sum();
            assert_eq!(value, sum, "k = {k}: B_{i}");
        }
    }
}

/// Added up over the positions of a pair in the window, the weights are the weights of D_k.
#[test]
fn weights_of_each_lag_sum_to_those_of_central_differences() {
    for k in (1..=30).chain([100]) {
        for (row, d) in bilinear(k).iter().zip(central(k).iter()) {
            assert_eq!(row.iter().sum::<Rational>(), d * integer(-2), "k = {k}");
            assert!(row.iter().eq(row.iter().rev()), "k = {k}: both ends of the window are alike");
        }
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Values

/// The formula as it stands, over the newest states.
fn written_out(states: &[(Vec<Float>, Vec<Float>, Float)], h: &Rational, digits: u32) -> Float {
    let (rows, context) = (bilinear(states.len() as u32 - 1), precision(digits));
    let mut sum = Float::new(context.in_bits());
    for i in 0..states.len() {
        for j in 0..i {
            let (older, newer) = (&states[states.len() - 1 - i], &states[states.len() - 1 - j]);
            let mut pair = newer.2.clone() - &older.2;
            for c in 0..older.0.len() {
                pair += older.0[c].clone() * &newer.1[c] - older.1[c].clone() * &newer.0[c];
            }
            sum += pair * Float::from_rational(&weight(&rows, i, j), &context);
        }
    }
    sum / Float::from_rational(&(h * integer(2)), &context)
}

#[test]
fn values_are_the_formula_written_out() {
    const DIGITS: u32 = 60;
    let context = precision(DIGITS);
    for name in ["stormer-verlet", "symplectic-euler", "ruth3"] {
        let stepper = stepper::<Float>(name, "1/20", &context);
        for k in [1, 2, 3, 7, 12] {
            let start = [numbers(&["0", "0.1"], &context), numbers(&["0.3", "0"], &context)];
            let mut motion = Motion::new(HenonHeiles, UnitMasses, start[0].clone(), start[1].clone()).unwrap();
            let settings = Bilinear::new(k);
            let mut estimator = BuildEstimator::<Float>::build(&settings, stepper.step_size(), 2, &context).unwrap();
            let (mut states, mut beta) = (Vec::new(), Float::new(context.in_bits()));
            for n in 0..=40 {
                if n > 0 {
                    stepper.step_augmented(&mut motion);
                    beta += motion.beta();
                }
                states.push((motion.q().to_vec(), motion.p().to_vec(), beta.clone()));
                let found = estimator.push(motion.q(), motion.p(), motion.increments()).map(|e| e.value.clone());
                assert_eq!(found.is_some(), n >= k as usize, "{name}, k = {k}, n = {n}");
                if let Some(found) = found {
                    let expected = written_out(&states[n - k as usize..], stepper.h(), DIGITS);
                    // the sums of β lose a digit or two
                    let off = log10_distance(&found, &expected);
                    assert!(off < -55.0, "{name}, k = {k}, n = {n}: off by 10^{off}");
                }
            }
        }
    }
}

fn first_value<P: Potential<Float>>(
    stepper: &Stepper<TableScheme, Float>,
    motion: Motion<Float, Vec<Float>, P, UnitMasses>,
    k: u32,
) -> Float {
    let mut run = ShadowRun::new(stepper.with(motion), 1, &Bilinear::new(k)).unwrap();
    assert_eq!(run.is_between(), k % 2 == 1);
    let (_, estimate) = run.advance().unwrap().unwrap();
    estimate.value.clone()
}

/// E_k is off by c h^{2k}, so halving h shows 2k: for a palindrome, and for schemes that are not.
#[test]
fn the_order_is_2k() {
    const DIGITS: u32 = 100;
    let context = precision(DIGITS);
    let pendulum =
        || Motion::new(Pendulum, UnitMasses, numbers(&["0.4"], &context), numbers(&["1"], &context)).unwrap();
    for scheme in ["stormer-verlet", "symplectic-euler", "ruth3", "blanes-moan-srkn6b"] {
        for k in [1, 2, 3, 4, 7] {
            let off = |h: &str| {
                let stepper = stepper(scheme, h, &context);
                // with k = 40 the error is far below all that is measured
                let [found, right] = [k, 40].map(|k| first_value(&stepper, pendulum(), k));
                log10_distance(&found, &right) / std::f64::consts::LOG10_2
            };
            let order = off("1/64") - off("1/128");
            println!("{scheme}, k = {k}: {order:.4}");
            // c h with c of size 1 to 5; for odd k the window's middle wanders by half a step
            assert!((order - f64::from(2 * k)).abs() < 0.1, "{scheme}, k = {k}: {order}");
        }
    }
}

/// Nine states beat what hundreds of central differences find near a close encounter.
#[test]
fn the_modified_energy_of_kepler_is_conserved() {
    let context = precision(60);
    let [q, p] = [["0.4", "0"], ["0", "2"]].map(|texts| numbers::<Float>(&texts, &context));
    let motion = Motion::new(Kepler, UnitMasses, q, p).unwrap();
    let verlet = stepper("stormer-verlet", "1/20", &context);
    let drift = |k| energy_drift(verlet.with(motion.clone()), 400, &Bilinear::new(k)).unwrap().drift.to_f64();
    let [four, eight, sixteen] = [4, 8, 16].map(drift);
    println!("{four:e} {eight:e} {sixteen:e}");
    assert!(sixteen < eight / 10.0 && eight < four / 10.0 && eight < 1e-8, "{four:e} {eight:e} {sixteen:e}");
}

/// max − min of E_k over 1 + ⌈√k⌉ windows on either side, or the largest |E_k − the mean of the two E_{k−1} within| of
/// these.
#[test]
fn the_error_is_its_rule_written_out() {
    for (k, around) in [(2, 3), (3, 3), (6, 4), (9, 4)] {
        let run = |settings: Bilinear| {
            let motion = Motion::new(Kepler, UnitMasses, vec![0.4, 0.0], vec![0.0, 2.0]).unwrap();
            let verlet = stepper("stormer-verlet", "1/20", &());
            let mut run = ShadowRun::new(verlet.with(motion), 60, &settings).unwrap();
            let mut all = BTreeMap::new();
            while let Some((n, found)) = run.advance().unwrap() {
                all.insert(n, (*found.value, found.last_term.copied(), found.error.copied()));
            }
            all
        };
        let (values, last) = (run(Bilinear::new(k)), run(Bilinear::new(k - 1)));
        // E_k is about n or n + 1/2, and the two windows of E_{k−1} are half a step before and after that
        let term = |n: i64| {
            let within = if k % 2 == 0 { [n - 1, n] } else { [n, n + 1] };
            Some((values.get(&n)?.0 - (last.get(&within[0])?.0 + last.get(&within[1])?.0) / 2.0).abs())
        };
        // sums of at most ten numbers of size 1/h and smaller, in another order
        let same = |a: f64, b: f64| (a - b).abs() < 200.0 * f64::EPSILON;
        let mut compared = 0;
        for (n, (value, last_term, error)) in run(Bilinear::with_error(k)) {
            assert_eq!(value, values[&n].0);
            let near = n - around..=n + around;
            let Some(terms) = near.clone().map(term).collect::<Option<Vec<f64>>>() else { continue };
            assert!(same(last_term.unwrap(), term(n).unwrap()));
            let near: Vec<f64> = near.map(|n| values[&n].0).collect();
            let [most, least] = [f64::max, f64::min].map(|of| near.iter().copied().reduce(of).unwrap());
            let right = terms.into_iter().fold(most - least, f64::max);
            assert!(same(error.unwrap(), right), "k = {k}, n = {n}: {error:?}, {right}");
            compared += 1;
        }
        assert!(compared > 40);
    }
}

/// The error of E_1 on a circle is the same at all states, and it has no term before its last.
#[test]
fn the_first_orders_have_no_error() {
    let motion = || Motion::new(Kepler, UnitMasses, vec![1.0, 0.0], vec![0.0, 1.0]).unwrap();
    let verlet = stepper("stormer-verlet", "1/20", &());
    let mut run = ShadowRun::new(verlet.with(motion()), 10, &Bilinear::with_error(1)).unwrap();
    assert!(run.advance().unwrap().unwrap().1.error.is_none());
    let mut run = ShadowRun::new(verlet.with(motion()), 10, &Central::fixed_with_error(1)).unwrap();
    assert!(run.advance().unwrap().unwrap().1.error.is_none());
}

/// A state at k = 1000 would take half a million products: 4000 steps at 120 digits took minutes.
#[test]
fn a_k_that_takes_too_long_is_refused() {
    let h = shadowstep::StepSize::try_from("1/10").unwrap();
    let refusal =
        |settings: Bilinear| BuildEstimator::<f64>::build(&settings, &h, 2, &()).err().map(|error| error.to_string());
    assert_eq!(refusal(Bilinear::new(256)), None);
    assert_eq!(refusal(Bilinear::best(256)), None);
    let sentence = "must be at most 256, not 257: the cost of a state grows like the square of it";
    assert_eq!(refusal(Bilinear::with_error(257)), Some(format!("k {sentence}")));
    assert_eq!(refusal(Bilinear::best(257)), Some(format!("the largest k {sentence}")));
}
