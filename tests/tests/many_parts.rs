//! Protects Hamiltonians of three parts and more: the flow and β of each kind of part, the orders, the modified energy,
//! and steps that are steps.
//!
//! Yardstick: Gragg's extrapolated midpoint rule on the equations of motion of the formulas, which does not depend on
//! the split.

use rug::Float;
use shadowstep::number::{CorrectlyRounded, Number};
use shadowstep::shadow::{Bilinear, Verdict};
use shadowstep::systems::formula::FormulaPotential;
use shadowstep::systems::many_parts::{FlowState, FormulaPart, ManyParts, Part, SystemOfParts, parts};
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Carried, Potential, Rational, Scheme, State, Stepper, System, splitting_scheme};
use shadowstep_tests::steps::Steps;
use shadowstep_tests::{
    Bits, coordinates, log10_largest_distance, numbers, precision, rational, same_bits, variations, watched,
};

const DIGITS: u32 = 60;

#[splitting_scheme("yoshida4.toml", parts = 3)]
#[derive(Clone, Copy)]
struct Yoshida4;

#[splitting_scheme("blanes-moan-s6.toml", first = "drift", parts = 4)]
#[derive(Clone, Copy)]
struct DriftFirst;

#[splitting_scheme("symplectic-euler.toml", parts = 3)]
#[derive(Clone, Copy)]
struct Euler;

/// Three sites of the disordered discrete nonlinear Schrödinger chain.
const CHAIN: [&str; 3] = [
    "e*(q1^2 + p1^2)/2 + (q1^2 + p1^2)^2/8 + (q2^2 + p2^2)/5 + (q2^2 + p2^2)^2/8 - (q3^2 + p3^2)/3 + (q3^2 + p3^2)^2/8",
    "-p1*p2 - p2*p3",
    "-q1*q2 - q2*q3",
];
const NAMES: (&[&str], &[&str]) = (&["q1", "q2", "q3"], &["p1", "p2", "p3"]);

fn parameters() -> Vec<(&'static str, Rational)> {
    vec![("e", rational("7/10"))]
}

/// A scheme for many parts.
fn many(name: &str) -> TableScheme<ManyParts> {
    shipped(name).unwrap().for_many_parts().unwrap()
}

fn chain<N: CorrectlyRounded + 'static>(context: &N::Context) -> SystemOfParts<N> {
    let parts = parts(&CHAIN, NAMES, &parameters(), context).unwrap();
    let (q, p) = (numbers(&["0.4", "-0.7", "0.5"], context), numbers(&["0.3", "0.6", "-1.1"], context));
    SystemOfParts::new(parts, &q, &p).unwrap()
}

/// The sums of ẋ = J A_x and of β̇ = xᵀA_x − 2A of formulas.
struct Equations {
    formulas: Vec<(FormulaPotential<Float>, Vec<Float>)>,
    dimension: usize,
}

impl Equations {
    fn of(formulas: &[&str], (q, p): (&[&str], &[&str])) -> Self {
        let context = precision(DIGITS + 20);
        let variables = [q, p].concat();
        let values: Vec<_> =
            parameters().iter().map(|(name, value)| (*name, Float::from_rational(value, &context))).collect();
        let formula = |text: &&str| {
            let potential = FormulaPotential::new(text, &variables, &values).unwrap();
            let mut scratch = vec![Float::zero(&context); potential.scratch()];
            potential.prepare(&mut scratch, &context);
            (potential, scratch)
        };
        Equations { formulas: formulas.iter().map(formula).collect(), dimension: q.len() }
    }

    /// The time derivatives of q, p and β.
    fn slope(&mut self, x: &[Float]) -> Vec<Float> {
        let (state, beta) = x.split_at(2 * self.dimension);
        let zero = Float::zero(&beta[0].context());
        let (mut sum, mut gradient, mut rate) = (vec![zero.clone(); x.len()], state.to_vec(), zero);
        for (formula, scratch) in &mut self.formulas {
            formula.gradient_and_rate(state, &mut gradient, &mut rate, scratch);
            for i in 0..self.dimension {
                sum[i] += &gradient[i + self.dimension];
                sum[i + self.dimension] -= &gradient[i];
            }
            sum[2 * self.dimension] += &rate;
        }
        sum
    }

    /// q, p and β after a time.
    fn flow(&mut self, start: &[Float], time: &Float, columns: u32) -> Vec<Float> {
        let mut row: Vec<Vec<Float>> = Vec::new();
        for k in 1..=columns {
            let mut next = vec![self.midpoint(start, time, 2 * k)];
            for j in 1..k {
                let (coarse, fine) = (&row[j as usize - 1], &next[j as usize - 1]);
                let ratio = Float::with_val(time.prec(), k) / (k - j);
                let weight = ratio.square() - 1;
                next.push(coarse.iter().zip(fine).map(|(c, f)| f.clone() + (f.clone() - c) / &weight).collect());
            }
            row = next;
        }
        row.pop().unwrap()
    }

    fn midpoint(&mut self, start: &[Float], time: &Float, count: u32) -> Vec<Float> {
        let step = time.clone() / count;
        let moved = |from: &[Float], slope: Vec<Float>, by: &Float| -> Vec<Float> {
            from.iter().zip(slope).map(|(x, v)| x.clone() + v * by).collect()
        };
        let mut before = start.to_vec();
        let mut now = moved(start, self.slope(start), &step);
        for _ in 1..count {
            let next = moved(&before, self.slope(&now), &(step.clone() * 2));
            before = std::mem::replace(&mut now, next);
        }
        now
    }
}

/// Each kind of flow is the solution of the equations of its formula, and so is its part of β.
#[test]
fn flows_solve_the_equations_of_their_formulas() {
    let names: (&[&str], &[&str]) = (&["x", "y"], &["px", "py"]);
    let context = precision(DIGITS + 20);
    for (formula, time) in [
        ("px^4/4 + cos(py)", "1/5"),
        ("cos(x - y) + x^3 + 2", "1/5"),
        ("x*py^2 + sin(x)*exp(py)", "1/7"),
        ("x*py - y*px", "1/3"),
        ("e*(px - y/2)^2/2 + (py + x/2)^2/2 + x*y/3", "1/3"),
        ("(x^2 + px^2)/2 + (x^2 + px^2)^2/8", "1/4"),
        ("sqrt(1 + 2*x^2 + x*px + 3*px^2) + (y^2 + 4*py^2)^3/200", "1/6"),
        ("(x*px)^2 + exp(x*px)", "1/5"),
        ("(px^2 + py^2)/(3*e) - 2/sqrt(x^2 + y^2)", "1/4"),
        ("(x^2 + px^2)^2 + y*py + 1", "1/5"),
        ("-px^2/x", "1/7"),
        ("3*px^2/(2*x^2) + e*y*py^3", "1/9"),
        ("x*px^2 - y^5*py^2/7", "-1/8"),
        ("e*x^3*px + y^3*py^-2", "1/10"),
    ] {
        let (q, p) = (numbers::<Float>(&["0.8", "-0.5"], &context), numbers::<Float>(&["0.3", "0.9"], &context));
        let mut part = FormulaPart::<Float>::new(formula, names, &parameters(), &context).unwrap();
        let time = Float::from_rational(&rational(time), &context);
        let zero = Float::zero(&context);
        let start = [&q[..], &p[..], std::slice::from_ref(&zero)].concat();
        let exact = Equations::of(&[formula], names).flow(&start, &time, 30);

        let mut flow = |carried| {
            let mut state = State::new(q.clone(), p.clone(), &context).compensated_if(false);
            part.flow(&time, &mut FlowState::new(&mut state, carried), false);
            state
        };
        let (plain, augmented) = (flow(Carried::Nothing), flow(Carried::Increments));
        let (new_q, new_p) = (augmented.q().to_vec(), augmented.p().to_vec());
        let increments = augmented.increments().to_owned();
        assert!(same_bits(plain.q(), &new_q) && same_bits(plain.p(), &new_p), "{formula}");

        let found = [&new_q[..], &new_p[..], std::slice::from_ref(&increments.beta)].concat();
        let off = log10_largest_distance(&found, &exact);
        println!("{formula}: 10^{off:.1}");
        assert!(off < 5.0 - f64::from(DIGITS), "{formula}: 10^{off}");
        for (before, increment, after) in
            [(&q, &increments.q, &new_q), (&p, &increments.p, &new_p)].into_iter().flat_map(|(a, b, c)| {
                a.iter().zip(b).zip(c).map(|((a, b), c)| (a.clone(), b.clone(), c.clone())).collect::<Vec<_>>()
            })
        {
            assert!(((before + increment) - after).abs().to_f64() < 1e-70, "{formula}");
        }
        // the energy stays
        let energy = |part: &mut FormulaPart<Float>, q: &[Float], p: &[Float]| {
            let mut energy = zero.clone();
            part.add_energy(q, p, &mut energy);
            energy
        };
        let change = energy(&mut part, &new_q, &new_p) - energy(&mut part, &q, &p);
        assert!(change.abs().to_f64() < 1e-70, "{formula}");
    }
}

#[test]
fn formulas_without_a_known_flow_are_refused() {
    let names: (&[&str], &[&str]) = (&["x", "y"], &["px", "py"]);
    let refused = |formula: &str| {
        let Err(error) = FormulaPart::<f64>::new(formula, names, &parameters(), &()) else { panic!("{formula}") };
        error.to_string()
    };
    assert_eq!(refused("px^2/2 + cos(x)"), "the flow of this part has no formula: it couples x and px");
    assert_eq!(
        refused("(px^2 + py^2)/2 + 1/sqrt(x^2 + y^2)"),
        "the flow of this part has no formula: it couples x and px, y and py"
    );
    assert!(refused("px^2 + z").contains("`z`"));
}

#[test]
fn the_orders_are_those_proved() {
    let context = precision(DIGITS + 20);
    let start = [coordinates(&chain::<Float>(&context)), vec![Float::zero(&context)]].concat();
    let mut equations = Equations::of(&CHAIN, NAMES);
    for (name, k) in [
        ("symplectic-euler", 7),
        ("stormer-verlet", 7),
        ("ruth3", 7),
        ("yoshida4", 7),
        ("suzuki4", 7),
        ("blanes-moan-s6", 7),
        ("pefrl", 6),
        ("saba2", 7),
        ("kahan-li6", 6),
        ("blanes-moan-s10", 6),
        ("kahan-li8", 5),
    ] {
        let scheme = many(name);
        let proved = scheme.proved().proof.many_parts.as_ref().unwrap().order;
        let mut error = |k: u32| {
            let h = rational(&format!("1/{}", 1_u64 << k));
            let exact = equations.flow(&start, &Float::from_rational(&h, &context), 14);
            let mut system = chain::<Float>(&context);
            Stepper::with_context(scheme.clone(), h, &context).unwrap().step(&mut system);
            log10_largest_distance(&coordinates(&system), &exact[..6]) / std::f64::consts::LOG10_2
        };
        let order = error(k - 1) - error(k) - 1.0;
        println!("{name}: {order:.3}, proved {proved}");
        assert!((order - f64::from(proved)).abs() < 0.15, "{name}: {order} measured, {proved} proved");
    }
}

#[test]
fn the_modified_energy_converges() {
    let context = precision(DIGITS);
    let mut found = Vec::new();
    for h in ["1/10", "1/20", "1/40"] {
        let stepper = Stepper::with_context(many("stormer-verlet"), h, &context).unwrap();
        found.push(variations::of_energies(&stepper, || chain::<Float>(&context), 200, [8, 4]));
    }
    let order = |j: usize| (found[1][j] / found[2][j]).log2();
    assert!((order(0) - 2.0).abs() < 0.3, "{found:?}");
    // E_k of a symmetric scheme is off by h^(2k)
    assert!((order(1) - 16.0).abs() < 1.0, "{found:?}");
}

/// A half of pᵀH_p, whatever is added to U; its difference is exact but for round-off where T is quadratic, and off by
/// some 1e-6 of T elsewhere.
#[test]
fn the_energy_that_errors_are_compared_with_has_no_constants() {
    let kinetic_of = |formulas: &[&str]| {
        let parts = parts::<f64>(formulas, (&["x", "y"], &["p", "r"]), &[], &()).unwrap();
        let mut system = SystemOfParts::new(parts, &[0.3, -0.2], &[0.7, 1.1]).unwrap();
        let [mut energy, mut kinetic] = [0.0; 2];
        system.assign_energy(None, &mut energy);
        system.assign_kinetic_energy(None, &mut kinetic);
        assert_eq!(energy, system.energy());
        kinetic
    };
    let t = (0.7_f64.powi(2) + 1.1 * 1.1) / 2.0;
    for constant in ["", " + 1000", " - 3"] {
        let potential = format!("x^4 + cos(y){constant}");
        assert!((kinetic_of(&["(p^2 + r^2)/2", &potential]) / t - 1.0).abs() < 1e-8, "{potential}");
    }
    // pᵀT_p/2 = 2p⁴ of T = p⁴
    assert!((kinetic_of(&["p^4", "x^2/2", "cos(y)"]) / (2.0 * 0.7_f64.powi(4)) - 1.0).abs() < 1e-5);
    // a rotating frame, where p is not the velocity
    let rotating = kinetic_of(&["(p^2 + r^2)/2", "y*p - x*r", "x^2*y^2 - 50"]);
    assert!((rotating / (t + (-0.2 * 0.7 - 0.3 * 1.1) / 2.0) - 1.0).abs() < 1e-8, "{rotating}");
}

#[test]
fn the_monitor_follows_a_run() {
    let stepper = Stepper::new(many("suzuki4"), "1/20").unwrap();
    let mut system = chain::<f64>(&());
    let report = watched(stepper, &mut system, &Bilinear::with_error(8), 50, 2000);
    assert_eq!(report.verdict, Verdict::Bounded, "{report}");
    // Σ(q² + p²) is an integral of the chain
    let norm = |state: Vec<f64>| state.iter().map(|x| x * x).sum::<f64>();
    assert!((norm(coordinates(&system)) - norm(coordinates(&chain::<f64>(&())))).abs() < 1e-5);
}

fn steps_are_steps<N, S>(scheme: S, twin: TableScheme<ManyParts>, context: &N::Context)
where
    N: Bits + CorrectlyRounded + 'static,
    S: Scheme + shadowstep::ValidFor<ManyParts> + Copy + 'static,
{
    assert_eq!(scheme.summary(), twin.summary());
    let h = rational("1/3");
    let (generated, twin) = (Steps::<N, ManyParts>::of(scheme, &h, context), Steps::of(twin, &h, context));
    let [mut plain, mut augmented, mut other] = [(); 3].map(|()| chain::<N>(context));
    for _ in 0..5 {
        generated.step(&mut plain);
        generated.step_augmented(&mut augmented);
        twin.step_augmented(&mut other);
        assert!(same_bits(&coordinates(&augmented), &coordinates(&other)));
        assert!(augmented.state().increments().beta.same_bits(other.state().increments().beta));
    }
    // in one loop
    let mut loops = [chain::<N>(context)];
    Stepper::with_context(scheme, h, context).unwrap().steps(&mut loops, 5);
    assert!(same_bits(&coordinates(&loops[0]), &coordinates(&plain)));
    generated.check("generated", || chain::<N>(context), 5, 3.0);
}

#[test]
fn generated_steps_have_the_bits_of_their_twins_and_are_undone() {
    let drift_first = || {
        use shadowstep::tables::{First, read, shipped_source};
        let source = shipped_source("blanes-moan-s6").unwrap();
        read(&source, &|base, _| shipped_source(base), Some(First::Drift)).unwrap().for_many_parts().unwrap()
    };
    steps_are_steps::<f64, _>(Yoshida4, many("yoshida4"), &());
    steps_are_steps::<f64, _>(DriftFirst, drift_first(), &());
    steps_are_steps::<f64, _>(Euler, many("symplectic-euler"), &());
    steps_are_steps::<Float, _>(DriftFirst, drift_first(), &precision(DIGITS));
    steps_are_steps::<Float, _>(Yoshida4, many("yoshida4"), &precision(DIGITS));
}

/// H_1 is evaluated as often as the gradient of a scheme for two parts.
#[test]
fn the_first_part_is_evaluated_as_often_as_it_must_be() {
    let scheme = many("yoshida4");
    assert_eq!(scheme.summary().evaluations, 3);
    let mut system = chain::<f64>(&());
    let stepper = Stepper::new(scheme, "1/10").unwrap();
    (0..100).for_each(|_| stepper.step(&mut system));
    assert_eq!(system.state().evaluations(), 301);
}
