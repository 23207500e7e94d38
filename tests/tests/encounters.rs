//! Close encounters of planets by shells: beside the whole attraction in one part, and what is conserved.

use shadowstep::number::DoubleDouble;
use shadowstep::systems::kinetic::General;
use shadowstep::systems::pairs::{Gravity, Pairs};
use shadowstep::systems::wisdom_holman::{
    Bodies, BodiesError, DemocraticHeliocentric, Encounters, Shells, WisdomHolman,
};
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{DiagonalMasses, Motion, Number, Rational, Real, Stepper, System, exact};
use shadowstep_tests::steps::Steps;

const MASSES: [&str; 3] = ["1", "1/5000", "1/20000"];

fn bodies() -> Bodies {
    Bodies::new(exact("1").unwrap(), MASSES.map(|mass| exact(mass).unwrap()).to_vec()).unwrap()
}

/// Two planets in a plane, whose distance is 0.0068 at t = 7.16, 0.15 of their Hill radius.
const Q: [&str; 6] = ["0", "0", "1", "0", "1.127", "0.28"];
/// The same, but 0.0003 at t = 2.47: 0.007 of their Hill radius.
const CLOSER: [&str; 6] = ["0", "0", "1", "0", "1.127", "0.34"];
const V: [&str; 6] = ["0", "0", "0", "1", "-0.311", "0.852"];

fn state<N: Number<Context = ()>>(q: [&str; 6]) -> (Vec<N>, Vec<N>) {
    let number = |text: &str| exact(text).unwrap();
    let q = q.map(|text| N::from_rational(&number(text), &()));
    let p = (0..6).map(|i| N::from_rational(&(number(V[i]) * number(MASSES[i / 2])), &()));
    (q.to_vec(), p.collect())
}

fn scheme(name: &str) -> TableScheme<General> {
    shipped(name).unwrap().for_every_kinetic().unwrap()
}

fn encounters(q: [&str; 6], substep: &str) -> Encounters<f64, 2> {
    let (q, p) = state::<f64>(q);
    let shells = Shells::within(exact("1/8").unwrap()).unwrap();
    Encounters::new(&bodies(), (&q, &p), &shells, &exact(substep).unwrap(), &()).unwrap()
}

/// The inertial positions at t = 10, and the least distance of the planets.
fn whole(h: &str) -> (Vec<f64>, f64) {
    let (q, p) = state::<DoubleDouble>(Q);
    let masses: Vec<Rational> = MASSES.iter().flat_map(|mass| [exact(mass).unwrap(), exact(mass).unwrap()]).collect();
    let m = MASSES.map(|mass| DoubleDouble::from_rational(&exact(mass).unwrap(), &())).to_vec();
    let gravity = Pairs::<_, 2>::all(3, Gravity { g: DoubleDouble::from(1.0), m }).unwrap();
    let mut motion = Motion::new(gravity, DiagonalMasses::new(&masses, &()).unwrap(), q, p).unwrap();
    let stepper = Stepper::new(scheme("sofroniou-spaletta8-21"), h).unwrap();
    let mut least = f64::INFINITY;
    let steps = (exact("10").unwrap() / exact(h).unwrap()).to_integer();
    for _ in 0..steps.to_string().parse::<u64>().unwrap() {
        stepper.step(&mut motion);
        least = least.min(distance(&motion.q().iter().map(Real::to_f64).collect::<Vec<_>>()));
    }
    (motion.q().iter().map(Real::to_f64).collect(), least)
}

fn distance(q: &[f64]) -> f64 {
    (q[2] - q[4]).hypot(q[3] - q[5])
}

fn after(name: &str, h: &str, substep: &str) -> Vec<f64> {
    let mut planets = encounters(Q, substep);
    let stepper = Stepper::new(scheme(name), h).unwrap();
    let steps = (exact("10").unwrap() / exact(h).unwrap()).to_integer();
    (0..steps.to_string().parse::<u64>().unwrap()).for_each(|_| stepper.step(&mut planets));
    planets.inertial().0
}

fn off(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// The yardstick is the whole attraction in one part at 32 digits, with steps of which two sizes agree to 1.3e-15.
#[test]
fn planets_that_meet_move_as_by_the_whole_attraction() {
    let (reference, least) = whole("1/500");
    assert!(least < 0.007, "{least}");
    let errors = ["1/40", "1/80", "1/160"].map(|h| off(&after("stormer-verlet", h, h), &reference));
    for pair in errors.windows(2) {
        // order 2
        assert!((3.6..4.4).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
    // long substeps are what is left of the error of a scheme of order (8, 4)
    let substeps =
        ["1/500", "1/1000", "1/2000"].map(|substep| off(&after("mclachlan-aba84", "1/80", substep), &reference));
    assert!(substeps[2] < 1e-6 && substeps[0] / substeps[2] > 8.0, "{substeps:?}");
}

#[test]
fn the_energy_is_there_again_after_an_encounter() {
    let (q, p) = state::<f64>(CLOSER);
    let by_kicks = WisdomHolman::<_, DemocraticHeliocentric<_, 2>, 2>::new(&bodies(), (&q, &p), &()).unwrap();
    let (by_shells, by_kicks) = (change_of_energy(encounters(CLOSER, "1/320")), change_of_energy(by_kicks));
    assert!(by_shells < 1e-8 && by_kicks > 1e-5, "{by_shells:e}, {by_kicks:e}");
}

fn change_of_energy<M: System<Number = f64, Class = General>>(mut planets: M) -> f64 {
    let stepper = Stepper::new(scheme("stormer-verlet"), "1/80").unwrap();
    let before = planets.energy();
    (0..800).for_each(|_| stepper.step(&mut planets));
    (planets.energy() / before - 1.0).abs()
}

#[test]
fn steps_through_an_encounter_are_steps() {
    let steps = Steps::of(scheme("blanes-moan-s6"), &exact("1/20").unwrap(), &());
    // the round-off of 1e-16 that grew in the encounter, twice
    steps.check("blanes-moan-s6", || encounters(Q, "1/80"), 160, 5.7);
}

/// Without encounters, kicks are those of the whole attraction, and drifts are one Kepler drift: to the last bit.
#[test]
fn planets_that_stay_apart_move_as_without_shells() {
    let (q, p) = state::<f64>(Q);
    let mut plain = WisdomHolman::<_, DemocraticHeliocentric<_, 2>, 2>::new(&bodies(), (&q, &p), &()).unwrap();
    let shells = Shells::within(exact("1e-4").unwrap()).unwrap();
    let mut planets = Encounters::<f64, 2>::new(&bodies(), (&q, &p), &shells, &exact("1/1000").unwrap(), &()).unwrap();
    let stepper = Stepper::new(scheme("yoshida4"), "1/20").unwrap();
    for _ in 0..20 {
        stepper.step(&mut plain);
        stepper.step(&mut planets);
    }
    assert_eq!((planets.state().q(), planets.state().p()), (plain.state().q(), plain.state().p()));
    assert_eq!(planets.state().evaluations(), plain.state().evaluations());
}

#[test]
fn wrong_shells_are_refused() {
    assert_eq!(Shells::within(exact("0").unwrap()).unwrap_err(), BodiesError::Shells);
    let (q, p) = state::<f64>(Q);
    let shells = Shells::within(exact("1").unwrap()).unwrap();
    let found = Encounters::<f64, 2>::new(&bodies(), (&q, &p), &shells, &exact("-1").unwrap(), &()).unwrap_err();
    assert_eq!(found.to_string(), "the substep must be positive");
}
