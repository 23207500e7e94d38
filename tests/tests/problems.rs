//! Protects the initial data of the problems: against energies that are published or follow by hand, against orbits
//! that are known, and against invariants that no wrong force would keep.

use num_traits::{One, Zero};
use rug::Float;
use shadowstep::number::Precision;
use shadowstep::number::counting::{Counting, count};
use shadowstep::problems::{PROBLEMS, ProblemMotion, Setup, problem};
use shadowstep::{Number, Potential, Rational, Real, Stepper, splitting_scheme};
use shadowstep_tests::{log10_distance, number, precision};

#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

fn setup(name: &str) -> Setup {
    problem(name).unwrap().setup(&[], 150).unwrap()
}

fn motion<N: Real + 'static>(name: &str, context: &N::Context) -> ProblemMotion<N> {
    setup(name).motion(context).unwrap()
}

fn digits() -> Precision {
    precision(120)
}

fn energy(name: &str) -> Float {
    motion::<Float>(name, &digits()).energy()
}

/// Steps of Yoshida's scheme in double precision; `look` sees q and p after each.
fn follow(mut motion: ProblemMotion<f64>, h: &str, steps: u32, mut look: impl FnMut(&[f64], &[f64])) {
    let stepper = Stepper::new(Yoshida4, h).unwrap();
    for _ in 0..steps {
        stepper.step(&mut motion);
        look(motion.q(), motion.p());
    }
}

/// Runs of problems without functions are computed together in lanes.
#[test]
fn problems_with_functions_are_those_that_count_some() {
    for problem in PROBLEMS {
        let mut motion = motion::<Counting<f64>>(problem.name(), &());
        let stepper = Stepper::<_, Counting<f64>>::new(Yoshida4, "1/1000").unwrap();
        let (_, operations) = count(|| {
            stepper.step(&mut motion);
            motion.energy()
        });
        assert_eq!(problem.has_functions(), operations.elementary > 0, "{}", problem.name());
    }
}

#[test]
fn states_masses_and_potentials_fit() {
    for &problem in PROBLEMS {
        let setup = problem.setup(&[], 40).unwrap();
        let dimension = setup.potential::<f64>(&()).dimension();
        assert_eq!(
            (setup.values.positions().len(), setup.values.momenta().len()),
            (dimension, dimension),
            "{}",
            problem.name()
        );
        assert!(setup.values.masses().is_none_or(|masses| masses.len() == dimension), "{}", problem.name());
        assert!(motion::<f64>(problem.name(), &()).energy().is_finite(), "{}", problem.name());
    }
}

#[test]
fn energies_that_are_published() {
    // Hairer, Lubich & Wanner, to the digits they print
    let k_b = number("1.380658e-23", 120);
    let argon = (energy("argon-crystal") / k_b.clone()).to_f64();
    assert!((argon - -1260.2).abs() < 0.05, "{argon}");
    let setup = setup("argon-crystal");
    let kinetic: f64 = setup.values.p::<f64>(&()).iter().map(|p| p * p / (2.0 * 66.34e-27)).sum();
    let temperature = kinetic / (7.0 * k_b.to_f64());
    assert!((temperature - 22.72).abs() < 0.005, "{temperature}");
    let stiff = energy("fput-stiff");
    assert!(log10_distance(&stiff, &number("2.00120008", 120)) < -118.0, "{stiff}");
}

#[test]
fn energies_by_hand() {
    // 3·4/5 + 3·5/4 + 4·5/3 at rest
    let pythagorean = energy("pythagorean");
    assert!(log10_distance(&pythagorean, &number("-769/60", 120)) < -118.0, "{pythagorean}");
    // only the momenta: Σ ½ sin²(iπ/100) over two waves is 200/4
    let toda = energy("toda");
    assert!(log10_distance(&toda, &number("50", 120)) < -117.0, "{toda}");
    // A cos(kπ/33) differences: ω² A² 33/4 with ω = 2 sin(π/66); the cubic terms cancel
    let chain = energy("fput-alpha");
    let pi = Float::with_val(420, rug::float::Constant::Pi);
    let amplitude = (pi.clone() * 16u32 / 33u32).sin().recip();
    let omega = (pi / 66u32).sin() * 2u32;
    let expected = Float::with_val(420, (omega * amplitude).square() * 33u32 / 4);
    assert!(log10_distance(&chain, &expected) < -117.0, "{chain} and {expected}");
}

#[test]
fn the_largest_displacement_of_the_first_mode_is_one() {
    let setup = setup("fput-alpha");
    assert_eq!(setup.values.value("q16"), &Rational::one());
    let q = setup.values.q::<Float>(&digits());
    assert!(q.iter().all(|other| *other <= q[15]), "{q:?}");
}

#[test]
fn planets_go_around_the_sun_at_their_distances() {
    // semi-major axes in astronomical units, from 1/a = 2/r − v²/μ
    let known = [5.2, 9.55, 19.2, 30.1, 39.5];
    let setup = setup("outer-solar-system");
    let masses: Vec<f64> = setup.values.masses().unwrap().iter().map(|m| f64::from_rational(&m.value, &())).collect();
    let (q, p) = (setup.values.q::<f64>(&()), setup.values.p::<f64>(&()));
    let g = 2.95912208286e-4;
    for (planet, known) in (1..6).zip(known) {
        let square = |of: &dyn Fn(usize) -> f64| (0..3).map(|axis| of(3 * planet + axis).powi(2)).sum::<f64>();
        let (r, v2) = (square(&|i| q[i]).sqrt(), square(&|i| p[i] / masses[i]));
        let axis = 1.0 / (2.0 / r - v2 / (g * (masses[0] + masses[3 * planet])));
        // the elements change with time by some per cent
        assert!((axis / known - 1.0).abs() < 0.03, "planet {planet}: {axis}");
    }
    let mut farthest = 0.0_f64;
    follow(motion("outer-solar-system", &()), "100", 2000, |q, _| {
        farthest = farthest.max((3..18).map(|i| q[i].abs()).fold(0.0, f64::max))
    });
    assert!((30.0..50.0).contains(&farthest), "{farthest}");
}

#[test]
fn the_centre_of_mass_of_three_bodies_and_of_the_crystal_is_at_rest() {
    for name in ["figure-eight", "pythagorean", "argon-crystal"] {
        let setup = setup(name);
        for axis in 0..2 {
            let momenta = setup.values.momenta().iter().skip(axis).step_by(2).map(|(_, p)| &p.value);
            assert_eq!(momenta.sum::<Rational>(), Rational::zero(), "{name}");
        }
    }
}

#[test]
fn the_figure_eight_closes() {
    let period = 6.32591398;
    let steps = 2000;
    let start = motion::<f64>("figure-eight", &());
    let mut end = Vec::new();
    follow(motion("figure-eight", &()), &format!("6.32591398/{steps}"), steps, |q, _| end = q.to_vec());
    // eight digits of the initial values and of the period
    let gap = start.q().iter().zip(&end).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(gap < 1e-6 * period, "{gap}");
}

#[test]
fn the_toda_lattice_keeps_its_third_invariant() {
    // Σ p³/3 + (p_k + p_(k+1)) exp(q_k − q_(k+1)), Hénon 1974; the one with −exp is not kept
    let invariant = |q: &[f64], p: &[f64], sign: f64| {
        let next = |k: usize| (k + 1) % q.len();
        (0..q.len()).map(|k| p[k].powi(3) / 3.0 + sign * (p[k] + p[next(k)]) * (q[k] - q[next(k)]).exp()).sum::<f64>()
    };
    // the shipped start is too symmetric for a distinction
    let set = [("p1", "2"), ("p8", "-1"), ("q50", "-0.7")].map(|(name, value)| (name.to_owned(), value.to_owned()));
    let motion = problem("toda").unwrap().setup(&set, 20).unwrap().motion(&()).unwrap();
    let (mut kept, mut wrong) = (Vec::new(), Vec::new());
    follow(motion, "1/20", 1000, |q, p| {
        kept.push(invariant(q, p, 1.0));
        wrong.push(invariant(q, p, -1.0));
    });
    let range = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max((value - values[0]).abs()));
    // of fourth order in h = 1/20
    assert!(range(&kept) < 1e-4, "{}", range(&kept));
    assert!(range(&wrong) > 0.1, "{}", range(&wrong));
}
