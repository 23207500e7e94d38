//! Protects transformed time: orbits that leapfrog steps keep, orders that are those proved, the modified energy of H′,
//! and runs that end at physical times.
//!
//! Yardsticks: the ellipse and the period of Kepler's orbits; the extrapolation of leapfrog steps of H′ with
//! derivatives written here.

use rug::Float;
use shadowstep::number::{Limbs, Number, Real};
use shadowstep::problems::{Kepler, problem};
use shadowstep::steps::step_to_time;
use shadowstep::systems::kinetic::General;
use shadowstep::systems::transformed_time::{TimeTransformation, TransformedKinetic, TransformedPotential};
use shadowstep::tables::{Source, TableScheme};
use shadowstep::{DiagonalMasses, Integrator as _, Motion, Potential, Rational, Stepper, UnitMasses};
use shadowstep_scenes::Scene;
use shadowstep_schemes::First;
use shadowstep_tests::reference::Separable;
use shadowstep_tests::shipped::twin;
use shadowstep_tests::steps::Steps;
use shadowstep_tests::{log10_largest_distance, number, precision, rational, variations};

/// A system of masses in transformed time.
type Transformed<N> =
    Motion<N, Vec<N>, TransformedPotential<Box<dyn Potential<N>>>, TransformedKinetic<DiagonalMasses<N>>>;

const LOGARITHMIC: TimeTransformation = TimeTransformation::Logarithmic;

fn power(exponent: &str) -> TimeTransformation {
    TimeTransformation::power(&rational(exponent)).expect("it is a small fraction")
}

/// A scheme that begins with a drift, or as its table does.
fn scheme(name: &str, first: Option<First>) -> TableScheme<General> {
    twin(name, first).for_every_kinetic().expect("it is valid for every T(p)")
}

/// Kepler's orbit of a = 1 at its pericentre.
fn kepler<N: Real>(
    time: TimeTransformation,
    e: &str,
    context: &N::Context,
) -> Motion<N, Vec<N>, TransformedPotential<Kepler>, TransformedKinetic<UnitMasses>> {
    let e = rational(e);
    let one = rational("1");
    let number = |value: &Rational| N::from_rational(value, context);
    let mut speed = number(&((&one + &e) / (&one - &e)));
    let squared = speed.clone();
    speed.assign_sqrt(&squared);
    let (potential, kinetic) = (TransformedPotential::new(time, Kepler), TransformedKinetic::new(time, UnitMasses));
    let (q, p) = ([&one - &e, rational("0"), rational("0")], [number(&rational("0")), speed, number(&rational("1/2"))]);
    Motion::new(potential, kinetic, q.map(|q| number(&q)).to_vec(), p.to_vec()).expect("the dimensions agree")
}

/// How far q is from the ellipse r + e x = 1 − e², the largest over ten periods: log₁₀.
fn off_the_ellipse<N: Real>(first: Option<First>, context: &N::Context) -> f64 {
    let stepper = Stepper::with_context(scheme("stormer-verlet", first), "1/20", context).expect("it is nonzero");
    let mut system = kepler::<N>(LOGARITHMIC, "0.999", context);
    let [e, parameter] = ["0.999", "1 - 0.999^2"].map(|text| N::from_rational(&rational(text), context));
    let mut largest = f64::NEG_INFINITY;
    while system.q()[2].to_f64() < 20.0 * std::f64::consts::PI {
        stepper.step(&mut system);
        let q = system.q();
        let mut squared = q[0].clone();
        squared.assign_square(&q[0]);
        squared.add_product(&q[1], &q[1]);
        let mut off = q[0].clone();
        off.assign_sqrt(&squared);
        off.add_product(&e, &q[0]);
        off.subtract(&parameter);
        largest = largest.max(off.log10_abs());
    }
    largest
}

#[test]
fn leapfrog_steps_with_a_drift_first_stay_on_the_ellipse() {
    let [double, many] =
        [off_the_ellipse::<f64>(Some(First::Drift), &()), off_the_ellipse::<Limbs<4>>(Some(First::Drift), &())];
    let kicks = off_the_ellipse::<Limbs<4>>(None, &());
    println!("off the ellipse: 10^{double}, 10^{many}; with a kick first 10^{kicks}");
    assert!(double < -13.5 && many < -70.0, "10^{double}, 10^{many}");
}

/// The Pythagorean problem: q, t and p, p_t.
struct Pythagorean;

const MASSES: [i64; 6] = [3, 3, 4, 4, 5, 5];
const POSITIONS: [i64; 6] = [1, 3, -2, -1, 1, -1];

impl Pythagorean {
    fn system<N: Number + 'static>(time: TimeTransformation, context: &N::Context) -> Transformed<N> {
        let setup = problem("pythagorean").expect("it is shipped").setup(&[], 1).expect("it has no parameters to set");
        let whole = |value: i64| Rational::from_integer(value.into());
        let masses = DiagonalMasses::new(&MASSES.map(whole), context).expect("they are positive");
        let number = |value: Rational| N::from_rational(&value, context);
        let mut q: Vec<N> = POSITIONS.iter().map(|&x| number(whole(x))).collect();
        let mut p = vec![number(whole(0)); 6];
        q.push(number(whole(0)));
        // −H = 12/3 + 15/4 ... of pairs at distances 5, 4 and 3
        p.push(number(rational("3*4/5 + 3*5/4 + 4*5/3")));
        let potential = TransformedPotential::new(time, setup.potential(context));
        Motion::new(potential, TransformedKinetic::new(time, masses), q, p).expect("the dimensions agree")
    }
}

/// −U and U_q of the Pythagorean problem.
fn gravity(q: &[Float]) -> (Float, Vec<Float>) {
    let zero = Float::new(q[0].prec());
    let (mut depth, mut gradient) = (zero.clone(), vec![zero; 7]);
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let d = [0, 1].map(|axis| q[2 * j + axis].clone() - &q[2 * i + axis]);
        let r = (d[0].clone().square() + d[1].clone().square()).sqrt();
        let attraction = Float::with_val(r.prec(), MASSES[2 * i] * MASSES[2 * j]) / &r;
        let cube = attraction.clone() / r.square();
        depth += attraction;
        for (axis, d) in d.iter().enumerate() {
            gradient[2 * i + axis] -= cube.clone() * d;
            gradient[2 * j + axis] += cube.clone() * d;
        }
    }
    (depth, gradient)
}

/// f′ = x^exponent
fn slope(x: &Float, exponent: &Float) -> Float {
    (x.clone().ln() * exponent).exp()
}

/// log₁₀ of the error after s = 1 at the steps 1/n and 1/(2n).
fn errors(name: &str, time: TimeTransformation, n: i64, exact: &[Float]) -> [f64; 2] {
    let context = precision(60);
    [n, 2 * n].map(|n| {
        let h = Rational::new(1.into(), n.into());
        let stepper = Stepper::with_context(scheme(name, Some(First::Drift)), h, &context).expect("it is nonzero");
        let mut system = Pythagorean::system::<Float>(time, &context);
        (0..n).for_each(|_| stepper.step(&mut system));
        log10_largest_distance(&[system.q(), system.p()].concat(), exact)
    })
}

#[test]
fn orders_are_those_proved() {
    // x^(γ−1) with γ = 0, as of the logarithm, and −1/2
    for (time, exponent) in [(LOGARITHMIC, "-1"), (power("-1/2"), "-1.5")] {
        let exponent = number(exponent, 60);
        let velocity = |p: &[Float]| {
            let x = p[..6].iter().zip(MASSES).fold(p[6].clone(), |x, (p, m)| x + p.clone().square() / (2 * m));
            let slope = slope(&x, &exponent);
            let mut velocity: Vec<Float> = p[..6].iter().zip(MASSES).map(|(p, m)| p.clone() / m * &slope).collect();
            velocity.push(slope);
            velocity
        };
        let gradient = |q: &[Float]| {
            let (depth, gradient) = gravity(q);
            let slope = slope(&depth, &exponent);
            gradient.into_iter().map(|u| u * &slope).collect()
        };
        let start = Pythagorean::system::<Float>(time, &precision(60));
        let start = [start.q(), start.p()].concat();
        let separable = Separable { velocity: &velocity, gradient: &gradient };
        let part = number("1/32", 60);
        let exact = (0..32).fold(start, |state, _| separable.flow(&state, &part, 14));
        for (name, order, n) in [
            ("stormer-verlet", 2.0, 64),
            ("suzuki4", 4.0, 32),
            ("blanes-moan-s10", 6.0, 32),
            ("sofroniou-spaletta8-21", 8.0, 16),
            ("sofroniou-spaletta10-35", 10.0, 16),
        ] {
            let [coarse, fine] = errors(name, time, n, &exact);
            let measured = (coarse - fine) / 2f64.log10();
            println!("{name} in {time}: order {measured:.3} (10^{coarse:.1}, 10^{fine:.1})");
            assert!((measured - order).abs() < 0.35, "{name} in {time}: {measured}");
        }
    }
}

#[test]
fn the_modified_energy_is_conserved() {
    for time in [LOGARITHMIC, power("-1/2")] {
        let drifts = ["1/50", "1/100"].map(|h| {
            let stepper =
                Stepper::<_, Limbs<4>>::new(scheme("stormer-verlet", Some(First::Drift)), h).expect("it is nonzero");
            variations::of_energies(&stepper, || Pythagorean::system::<Limbs<4>>(time, &()), 200, [8, 16])
        });
        println!("{time}: {drifts:?}");
        for [energy, k8, k16] in drifts {
            assert!(k8 < 1e-3 * energy && k16 < 1e-2 * k8, "{time}: H′ {energy:e}, E_8 {k8:e}, E_16 {k16:e}");
        }
    }
}

#[test]
fn steps_are_steps() {
    let steps = Steps::of(scheme("blanes-moan-s6", Some(First::Drift)), &rational("1/10"), &());
    steps.check("blanes-moan-s6", || kepler::<f64>(LOGARITHMIC, "0.99", &()), 50, 5.0);
}

#[test]
fn a_step_ends_at_a_physical_time() {
    // close to the pericentre, where time runs fastest, and half a period from it
    for until in ["1e-6", "1e-3", "0.02"] {
        let stepper =
            Stepper::<_, Limbs<4>>::new(scheme("stormer-verlet", Some(First::Drift)), "1/2").expect("it is nonzero");
        let mut integrator = stepper.with(kepler::<Limbs<4>>(LOGARITHMIC, "0.999", &()));
        let until = Limbs::from_rational(&rational(until), &());
        let part = step_to_time(&mut integrator, &until).expect("it is a nonzero step");
        let off = log10_largest_distance(&integrator.state().q()[2..], std::slice::from_ref(&until));
        assert!(off < -74.0, "t is off by 10^{off} with the part {part}");
        assert!(step_to_time(&mut integrator, &until).is_none() || off > f64::NEG_INFINITY);
    }
}

fn scene(text: &str) -> Result<Scene, Vec<String>> {
    let source = Source { path: "test.toml".to_owned(), text: text.to_owned() };
    Scene::read(source).map_err(|faults| faults.0.iter().map(|fault| fault.message.clone()).collect())
}

fn rows(scene: &Scene) -> Vec<Vec<f64>> {
    let mut bytes = Vec::new();
    scene.run_into(&mut bytes, &mut ()).expect("it runs");
    let text = String::from_utf8(bytes).expect("it is a text");
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|row| row.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect()
}

const RUN: &str = "[run]\nscheme = \"sofroniou-spaletta8-21\"\nfirst = \"drift\"\nstep = \"1/2\"\nuntil = 7\ndigits = 30\n\
                   [output]\nenergy = true\ntrajectory = true\n";

#[test]
fn a_scene_ends_at_its_physical_time() {
    let text = format!(
        "[problem]\nname = \"kepler\"\nparameters = {{ eccentricity = \"0.99\" }}\n[time]\ntransform \
            = \"logarithmic\"\n{RUN}"
    );
    let scene = scene(&text).expect("it is a scene");
    let rows = rows(&scene);
    let last = rows.last().expect("there are rows");
    // n, t, energy, x, y, px, py
    let whole = &rows[rows.len() - 2];
    assert_eq!((last[0], last[1], last.len(), scene.steps()), (whole[0] + 1.0, 7.0, 7, None));
    assert!((last[2] + 0.5).abs() < 1e-9, "{last:?}");
    // E − e sin E = 7 − 2π by Newton's method
    let mean = 7.0 - 2.0 * std::f64::consts::PI;
    let eccentric = (0..50).fold(2.0f64, |x, _| x - (x - 0.99 * x.sin() - mean) / (1.0 - 0.99 * x.cos()));
    let exact = [eccentric.cos() - 0.99, (1.0 - 0.99f64 * 0.99).sqrt() * eccentric.sin()];
    let off = (last[3] - exact[0]).hypot(last[4] - exact[1]);
    println!("off by {off:e}");
    assert!(off < 1e-6, "{last:?} {exact:?}");
    // all steps before it are whole, and t grows
    assert!(rows.windows(2).all(|pair| pair[0][1] < pair[1][1]));
}

#[test]
fn potentials_that_are_not_negative_are_refused() {
    let system = |potential: &str, q: &str, p: &str| {
        format!(
            "[problem]\npotential = \"{potential}\"\ncoordinates = [\"x\"]\n[initial]\nq = [{q}]\np = [{p}]\n\
             [time]\ntransform = \"logarithmic\"\n{RUN}"
        )
    };
    let refused = scene(&system("x^2/2", "1", "0")).expect_err("U is positive");
    assert_eq!(refused.len(), 1, "{refused:?}");
    assert!(refused[0].contains("requires a finite U < 0") && refused[0].ends_with("U is 0.5"), "{refused:?}");
    // negative at first
    let scene = scene(&system("-cos(x)", "\"1/2\"", "2")).expect("U is negative at the start");
    let error = scene.run_into(&mut Vec::new(), &mut ()).expect_err("U becomes positive").to_string();
    assert!(error.contains("requires U < 0 and T + p_t > 0"), "{error}");
}

#[test]
fn wrong_sections_are_refused() {
    let kepler =
        |time: &str| scene(&format!("[problem]\nname = \"kepler\"\n[time]\n{time}\n{RUN}")).expect_err("it is wrong");
    for (time, message) in [
        ("", "the key `transform` is missing"),
        ("transform = \"power\"", "the key `exponent` is missing"),
        ("transform = \"logarithmic\"\nexponent = 2", "logarithmic time has no exponent"),
        ("transform = \"power\"\nexponent = 0", "exponent must be nonzero, not 0"),
        ("transform = \"power\"\nexponent = \"1/100\"", "must be a fraction"),
    ] {
        let faults = kepler(time);
        assert!(faults.iter().any(|fault| fault.contains(message)), "{time}: {faults:?}");
    }
    let nystrom = RUN.replace("sofroniou-spaletta8-21", "blanes-moan-srkn11b");
    let faults = scene(&format!("[problem]\nname = \"kepler\"\n[time]\ntransform = \"logarithmic\"\n{nystrom}"));
    let faults = faults.expect_err("it is for quadratic T");
    assert!(faults.iter().any(|fault| fault.contains("quadratic T")), "{faults:?}");
}
