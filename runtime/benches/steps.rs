//! What steps cost, as ratios within one run: medians over rounds in which all contestants take turns.
//!
//! `cargo bench -p shadowstep`

mod timing;

use std::hint::black_box;

use rug::Float;
use shadowstep::number::{Number, Precision};
use shadowstep::problems::Kepler;
use shadowstep::shadow::{BuildEstimator, Central, Estimator, StoppingRule};
use shadowstep::systems::formula::FormulaPotential;
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{Motion, Potential, Scheme, Stepper, UnitMasses, ValidFor, exact, splitting_scheme, tables};

use timing::{Contestant, compare, head, measure};

#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

fn digits() -> Precision {
    Precision::digits(120).expect("120 digits are allowed")
}

fn number(text: &str) -> Float {
    Float::from_rational(&exact(text).expect("an exact number"), &digits())
}

type Big<P> = Motion<Float, [Float; 2], P, UnitMasses>;

fn big<P: Potential<Float>>(potential: P, q: [&str; 2], p: [&str; 2]) -> Big<P> {
    Motion::new(potential, UnitMasses, q.map(number), p.map(number)).expect("the dimensions agree")
}

fn steps<'a, S: Scheme + ValidFor<Quadratic> + 'a, N: shadowstep::Real + 'a, P: Potential<N> + 'a, const D: usize>(
    name: &'static str,
    scheme: S,
    mut motion: Motion<N, [N; D], P, UnitMasses>,
) -> Contestant<'a> {
    let stepper = Stepper::with_context(scheme, "1/100", &motion.context()).expect("h is not 0");
    let run = move |repetitions| {
        for _ in 0..repetitions {
            stepper.step(&mut motion);
        }
        black_box(motion.q());
    };
    (name, Box::new(run))
}

fn augmented<'a, S: Scheme + ValidFor<Quadratic> + 'a>(
    name: &'static str,
    scheme: S,
    mut motion: Big<Kepler>,
) -> Contestant<'a> {
    let stepper = Stepper::with_context(scheme, "1/100", &digits()).expect("h is not 0");
    let run = move |repetitions| {
        for _ in 0..repetitions {
            stepper.step_augmented(&mut motion);
        }
        black_box(motion.q());
    };
    (name, Box::new(run))
}

/// What the operations of a step work on, at one state of an orbit.
struct Operands {
    q: [Float; 2],
    p: [Float; 2],
    gradient: [Float; 2],
    square: Float,
    inverse: Float,
    cube: Float,
}

/// 500 states around the orbit: the same two numbers again and again would teach the branch predictor.
fn orbit() -> Vec<Operands> {
    let mut motion = big(Kepler, ["0.4", "0"], ["0", "2"]);
    let stepper = Stepper::with_context(StormerVerlet, "1/80", &digits()).expect("h is not 0");
    let state = |_| {
        stepper.step(&mut motion);
        let (q, p) = ([motion.q()[0].clone(), motion.q()[1].clone()], [motion.p()[0].clone(), motion.p()[1].clone()]);
        let bits = q[0].prec();
        let square = Float::with_val(bits, &q[0] * &q[0]) + Float::with_val(bits, &q[1] * &q[1]);
        let inverse = square.clone().recip_sqrt();
        let cube = Float::with_val(bits, inverse.square_ref()) * &inverse;
        let gradient = [Float::with_val(bits, &cube * &q[0]), Float::with_val(bits, &cube * &q[1])];
        Operands { q, p, gradient, square, inverse, cube }
    };
    (0..500).map(state).collect()
}

fn set<T>(target: &mut Float, value: T)
where
    Float: rug::Assign<T>,
{
    rug::Assign::assign(target, value);
}

/// One MPFR operation at one state after the other, with a weight whose sign alternates from round to round.
fn operation<'a>(name: &'static str, weight: &str, work: impl Fn(&mut Operands, &Float) + 'a) -> Contestant<'a> {
    let mut orbit = orbit();
    let mut weights = [number(weight), -number(weight)];
    let run = move |repetitions: u32| {
        for _ in 0..repetitions / 500 {
            for operands in &mut orbit {
                work(operands, &weights[0]);
            }
            weights.swap(0, 1);
        }
        black_box(&orbit);
    };
    (name, Box::new(run))
}

/// The step of Störmer–Verlet on Kepler against the sum of the MPFR operations that it consists of.
fn kepler_against_its_operations() {
    let mut contestants = vec![
        steps("step", StormerVerlet, big(Kepler, ["0.4", "0"], ["0", "2"])),
        operation("p -= w g", "1/200", |x, w| x.p[0] -= w * &x.gradient[0]),
        operation("q += w p", "1/100", |x, w| x.q[1] += w * &x.p[1]),
        operation("x^2", "1", |x, _| set(&mut x.square, x.q[0].square_ref())),
        operation("x^2 + y^2", "1", |x, _| x.square += &x.q[1] * &x.q[1]),
        operation("1/sqrt(r^2)", "1", |x, _| set(&mut x.inverse, x.square.recip_sqrt_ref())),
        operation("r^-2", "1", |x, _| set(&mut x.cube, x.inverse.square_ref())),
        operation("r^-3", "1", |x, _| set(&mut x.gradient[0], &x.cube * &x.inverse)),
        operation("r^-3 x", "1", |x, _| set(&mut x.gradient[0], &x.cube * &x.q[0])),
    ];
    let counts = [0.0, 4.0, 2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0];
    let times: Vec<f64> = measure(&mut contestants, 5_000).iter().map(|measured| measured.nanoseconds).collect();
    let sum: f64 = times.iter().zip(counts).map(|(time, count)| time * count).sum();
    head("Störmer–Verlet on Kepler, 120 digits, against the sum of its MPFR operations");
    for ((name, _), (time, count)) in contestants.iter().zip(times.iter().zip(counts)).skip(1) {
        println!("| {count} × {name} | {time:.1} | |");
    }
    println!("| sum | {sum:.1} | 1.000 |");
    println!("| step | {:.1} | {:.3} |", times[0], times[0] / sum);
}

/// Störmer–Verlet on Kepler as a careful person writes it for f64.
fn kepler_by_hand() -> Contestant<'static> {
    let (mut q, mut p, h) = ([0.4_f64, 0.0], [0.0, 2.0], 0.01);
    let gradient = |q: [f64; 2]| {
        let inverse = 1.0 / (q[0] * q[0] + q[1] * q[1]).sqrt();
        let cube = inverse * inverse * inverse;
        [cube * q[0], cube * q[1]]
    };
    let mut g = gradient(q);
    let run = move |repetitions| {
        for _ in 0..repetitions {
            p = [p[0] - 0.5 * h * g[0], p[1] - 0.5 * h * g[1]];
            q = [q[0] + h * p[0], q[1] + h * p[1]];
            g = gradient(q);
            p = [p[0] - 0.5 * h * g[0], p[1] - 0.5 * h * g[1]];
        }
        black_box((q, p));
    };
    ("by hand", Box::new(run))
}

/// Takes a state a repetition; the states are from Störmer–Verlet on Kepler, made before.
fn estimates<'a>(name: &'static str, settings: Central) -> Contestant<'a> {
    let mut motion = big(Kepler, ["0.4", "0"], ["0", "2"]);
    let stepper = Stepper::with_context(StormerVerlet, "1/20", &digits()).expect("h is not 0");
    let mut estimator = settings.build(stepper.step_size(), 2, &digits()).expect("valid settings");
    let run = move |repetitions| {
        for _ in 0..repetitions {
            stepper.step_augmented(&mut motion);
            black_box(estimator.push(motion.q(), motion.p(), motion.increments()));
        }
    };
    (name, Box::new(run))
}

fn main() {
    let table = |name| tables::shipped(name).expect("a shipped scheme");
    let double = || Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).expect("the dimensions agree");
    let kepler = || big(Kepler, ["0.4", "0"], ["0", "2"]);

    let text = "-1/sqrt(x^2 + y^2)";
    let formula = FormulaPotential::new(text, &["x", "y"], &[]).expect("a formula");
    let double_formula = Motion::new(formula, UnitMasses, [0.4, 0.0], [0.0, 2.0]).expect("the dimensions agree");
    let formula = FormulaPotential::new(text, &["x", "y"], &[]).expect("a formula");
    let kepler_formula = big(formula, ["0.4", "0"], ["0", "2"]);

    kepler_against_its_operations();
    compare(
        "Störmer–Verlet on Kepler, f64",
        vec![
            kepler_by_hand(),
            steps("generated", StormerVerlet, double()),
            steps("from the table at run time", table("stormer-verlet"), double()),
            steps("generated, potential from a formula at run time", StormerVerlet, double_formula),
        ],
        1_000_000,
    );
    compare(
        "Yoshida 4 on Kepler, f64",
        vec![steps("generated", Yoshida4, double()), steps("from the table at run time", table("yoshida4"), double())],
        300_000,
    );
    compare(
        "Yoshida 4 on Kepler, 120 digits",
        vec![
            steps("generated", Yoshida4, kepler()),
            augmented("generated, with β", Yoshida4, kepler()),
            steps("from the table at run time", table("yoshida4"), kepler()),
            steps("generated, potential from a formula at run time", Yoshida4, kepler_formula),
        ],
        2_000,
    );
    compare(
        "Störmer–Verlet on Kepler with the modified energy at each step, 120 digits",
        vec![
            augmented("step with β alone", StormerVerlet, kepler()),
            estimates("D_20", Central::fixed(20)),
            estimates("D_200", Central::fixed(200)),
            estimates("best m ≤ 200", Central::best(200, StoppingRule::Full)),
            estimates("best m ≤ 200, early stop", Central::best(200, StoppingRule::Early)),
        ],
        150,
    );
}
