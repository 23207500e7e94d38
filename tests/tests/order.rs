//! Protects the orders: what is proved of a table is what its steps show on nonlinear problems, the pendulum and
//! Hénon–Heiles. (On a linear problem many conditions are met by chance.)

use rug::Float;
use shadowstep_schemes::{Proved, shipped_names, shipped_proved};
use shadowstep_tests::orders::{Measured, near_integrable_error};
use shadowstep_tests::reference::Separable;
use shadowstep_tests::systems::{Masses, Problem, system};
use shadowstep_tests::{coordinates, precision};

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

#[test]
fn the_order_measured_is_the_order_proved() {
    let context = precision(DIGITS);
    for problem in [Problem::Pendulum, Problem::HenonHeiles] {
        let start = || system(problem, Masses::Unit, &context);
        let separable = Separable { velocity: &|p| p.to_vec(), gradient: &|q| gradient(problem, q) };
        let flow = |h: &Float| separable.flow(&coordinates(&start()), h, COLUMNS);
        // c h / ln 2 with c of size 1 to 10, h ≤ 1/64
        Measured {
            start: &start,
            coordinates: |system| coordinates(system),
            flow: &flow,
            digits: DIGITS,
            halvings: 10,
        }
        .check_all(0.1);
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Near-integrable systems: H = p²/2 + εU(q), U = −cos q, with the drift the dominant part

/// The terms of ε, ε², ε³ of the error by differences in ε: what is left of higher powers is 1e-40 of them.
const DIFFERENCES: [&[(i32, i32)]; 3] =
    [&[(1, 1), (-1, -1)], &[(1, 1), (1, -1)], &[(1, 2), (-2, 1), (2, -1), (-1, -2)]];

#[test]
fn the_near_integrable_orders_measured_are_those_proved() {
    for name in shipped_names() {
        let scheme = &shipped_proved(name).expect("it is listed").scheme;
        let Some(claim) = &scheme.table.near_integrable else { continue };
        for (i, terms) in DIFFERENCES.iter().enumerate() {
            let [coarse, fine] = [6, 7].map(|k| near_integrable_error(&scheme.maps(), k, "1e-40", terms));
            let order = coarse - fine - 1.0;
            let proved = f64::from(claim.orders.get(i).or(claim.orders.last()).expect("there are orders").value);
            println!("{name} ε^{}: {order:.4}", i + 1);
            // c h / ln 2 as above, h = 1/128; ε³ comes with h⁵ at least: the shortest of its words is KKKD
            let off = if i < claim.orders.len() { (order - proved).abs() } else { proved - order };
            assert!(off < 0.1, "{name}, ε^{}: {order} measured, {proved} proved", i + 1);
        }
    }
}

/// What holds of a processed step with its pre-map and post-map: ε and ε², and with ε = 1 the order for quadratic T.
#[test]
fn the_effective_orders_measured_are_those_proved() {
    for name in shipped_names() {
        let Proved { scheme, proof, .. } = shipped_proved(name).expect("it is listed");
        let Some(effective) = &proof.effective else { continue };
        let maps = scheme.processed_maps().expect("it has a processor");
        let near = DIFFERENCES[..2].iter().zip(&effective.near_integrable);
        let near = near.map(|(terms, order)| (*terms, "1e-40", order.order));
        for (terms, epsilon, proved) in near.chain([(&[(1, 1)][..], "1", effective.quadratic.order)]) {
            let [coarse, fine] = [8, 9].map(|k| near_integrable_error(&maps, k, epsilon, terms));
            let order = coarse - fine - 1.0;
            println!("{name}: {order:.3} measured, {proved} proved, error 2^{fine:.1}");
            assert!((order - f64::from(proved)).abs() < 0.2, "{name}: {order} measured, {proved} proved");
        }
    }
}
