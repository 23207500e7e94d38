//! Protects the orders: what is proved of a table is what its steps show on nonlinear problems, the pendulum and
//! Hénon–Heiles. (On a linear problem many conditions are met by chance.)
//!
//! One step of size h from a general state is compared with a solution that owes nothing to any table. Its error is
//! C h^{p+1} (1 + c h + …), so halving h shows p + 1 up to about c h.

use std::array;

use rug::Float;
use shadowstep::number::{Number, Real};
use shadowstep_schemes::{MapKind, Proved, shipped_names, shipped_proved};
use shadowstep_tests::precision;
use shadowstep_tests::reference::{Separable, State};
use shadowstep_tests::shipped::{Shipped, all};
use shadowstep_tests::systems::{Masses, Problem, system};

/// Digits of the computation; the smallest errors, of order 10, are about 1e-33.
const DIGITS: u32 = 80;

/// Columns of the extrapolation: the error of the reference is about h^25, below 1e-60 at the steps used here.
const COLUMNS: u32 = 12;

/// U_q, written once more, in plain formulas.
fn gradient(problem: Problem, q: &[Float]) -> Vec<Float> {
    match problem {
        Problem::Pendulum => vec![q[0].clone().sin()],
        Problem::HenonHeiles => {
            let [x, y] = [q[0].clone(), q[1].clone()];
            vec![x.clone() + x.clone() * &y * 2, y.clone() + x.square() - y.square()]
        }
        other => unreachable!("{other:?} is not measured"),
    }
}

/// The flow over a time h, unit masses.
fn reference(problem: Problem, start: &[Float], h: &Float, columns: u32) -> State {
    let system = Separable { velocity: &|p| p.to_vec(), gradient: &|q| gradient(problem, q) };
    system.flow(start, h, columns)
}

/// Largest difference, as a power of two.
fn log2_distance(a: &[Float], b: &[Float]) -> f64 {
    shadowstep_tests::log10_largest_distance(a, b) / std::f64::consts::LOG10_2
}

fn start(problem: Problem) -> State {
    let system = system(problem, Masses::Unit, &precision(DIGITS));
    [system.q(), system.p()].concat()
}

/// log₂ of the error of one step of size 2^−k, for every shipped scheme.
fn errors(problem: Problem, k: i32) -> Vec<(Shipped<Float>, f64)> {
    let context = precision(DIGITS);
    let h = shadowstep_tests::rational(&format!("1/{}", 1_u64 << k));
    let exact = reference(problem, &start(problem), &(Float::with_val(context.in_bits(), 1) >> k), COLUMNS);
    all::<Float>(&h, &context)
        .into_iter()
        .map(|scheme| {
            let mut motion = system(problem, Masses::Unit, &context);
            scheme.generated.step(&mut motion);
            let error = log2_distance(&[motion.q(), motion.p()].concat(), &exact);
            (scheme, error)
        })
        .collect()
}

#[test]
fn the_reference_is_far_better_than_what_it_judges() {
    let half_step = Float::with_val(precision(DIGITS).in_bits(), 1) >> 6;
    for problem in [Problem::Pendulum, Problem::HenonHeiles] {
        let start = start(problem);
        let [good, better] = [COLUMNS, COLUMNS + 1].map(|columns| reference(problem, &start, &half_step, columns));
        let change = shadowstep_tests::log10_largest_distance(&good, &better);
        assert!(change < -50.0, "{problem:?}: 10^{change}");
    }
}

#[test]
fn the_order_measured_is_the_order_proved() {
    for problem in [Problem::Pendulum, Problem::HenonHeiles] {
        // every step size that some table needs, once
        let table: [Vec<(Shipped<Float>, f64)>; 12] = array::from_fn(|k| errors(problem, k as i32));
        for (i, (scheme, _)) in table[0].iter().enumerate() {
            let proved = scheme.summary.order_quadratic;
            let k = scheme.halvings(proved, DIGITS) as usize;
            let order = table[k - 1][i].1 - table[k][i].1 - 1.0;
            println!("{problem:?} {}: {order:.4} at h = 2^-{k}, error 2^{:.1}", scheme.name, table[k][i].1);
            // c h / ln 2 with c of size 1 to 10, h ≤ 1/64
            assert!((order - f64::from(proved)).abs() < 0.1, "{}: {order} measured, {proved} proved", scheme.name);
        }
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Near-integrable systems: H = p²/2 + εU(q), U = −cos q, with the drift the dominant part

/// Digits for ε³h⁵ with ε = 1e-40.
const NEAR_DIGITS: u32 = 220;

/// The error of one step of size 2^−k for ε = 1e-40 times `times`; it vanishes with ε.
fn near_error(scheme: &Proved, k: u32, times: i32) -> State {
    let bits = precision(NEAR_DIGITS).in_bits();
    let epsilon = Float::with_val(bits, Float::parse("1e-40").expect("a number")) * times;
    let h = Float::with_val(bits, 1) >> k;
    let start = vec![Float::with_val(bits, 0.7), Float::with_val(bits, 1.1)];
    let [mut q, mut p] = [start[0].clone(), start[1].clone()];
    for map in scheme.scheme.maps() {
        let power = Float::with_val(bits, rug::ops::Pow::pow(&h, map.kind.power()));
        let weight = Float::from_rational(&map.weight, &precision(NEAR_DIGITS)) * power;
        match map.kind {
            MapKind::Kick => p -= q.clone().sin() * weight * &epsilon,
            MapKind::Drift => q += weight * &p,
            // 2 U″U′
            MapKind::GradientKick => p += Float::with_val(bits, &q * 2).sin() * weight * &epsilon * &epsilon,
        }
    }
    let system = Separable { velocity: &|p| p.to_vec(), gradient: &|q| vec![q[0].clone().sin() * &epsilon] };
    let exact = system.flow(&start, &h, COLUMNS);
    vec![q - &exact[0], p - &exact[1]]
}

/// log₂ of the terms of ε, ε², ε³ of the error, by differences in ε: what is left of higher powers is 1e-40 of them.
fn near_terms(scheme: &Proved, k: u32) -> [f64; 3] {
    let differences: [&[(i32, i32)]; 3] = [&[(1, 1)], &[(1, 1), (1, -1)], &[(1, 2), (-2, 1), (2, -1), (-1, -2)]];
    let bits = precision(NEAR_DIGITS).in_bits();
    differences.map(|difference| {
        let mut sum = [Float::new(bits), Float::new(bits)];
        for &(factor, times) in difference {
            for (sum, error) in sum.iter_mut().zip(near_error(scheme, k, times)) {
                *sum += error * factor;
            }
        }
        let largest = sum.iter().map(Real::log10_abs).fold(f64::NEG_INFINITY, f64::max);
        largest / std::f64::consts::LOG10_2
    })
}

#[test]
fn the_near_integrable_orders_measured_are_those_proved() {
    for name in shipped_names() {
        let scheme = shipped_proved(name).expect("it is listed");
        let Some(claim) = &scheme.scheme.table.near_integrable else { continue };
        let [coarse, fine] = [6, 7].map(|k| near_terms(scheme, k));
        for (i, (coarse, fine)) in coarse.iter().zip(fine).enumerate() {
            let order = coarse - fine - 1.0;
            let proved = f64::from(claim.orders.get(i).or(claim.orders.last()).expect("there are orders").value);
            println!("{name} ε^{}: {order:.4}", i + 1);
            // c h / ln 2 as above, h = 1/128; ε³ comes with h⁵ at least: the shortest of its words is KKKD
            let off = if i < claim.orders.len() { (order - proved).abs() } else { proved - order };
            assert!(off < 0.1, "{name}, ε^{}: {order} measured, {proved} proved", i + 1);
        }
    }
}
