//! Loops that are correct, of motions whose H hardly varies beside H − H̄: circles, and short arcs.

use super::*;
use shadowstep::systems::potential::from_fn;
use shadowstep::{System, ValidFor};

potential! { struct Space; U(x, y, z) = -1/sqrt(x^2 + y^2 + z^2) }
potential! { struct Plane; U(x, y) = (x^2 + y^2)/2 }

/// A window every `every` steps of a run, by E_k.
#[derive(Clone, Copy, Debug)]
struct Windows {
    every: u64,
    steps: u64,
    k: u32,
}

/// The report on a loop that is correct, and has to be taken for that.
fn watch_correct<M: System<Number = f64>>(mut motion: M, (scheme, h): (&str, &str), windows: Windows) -> Report<f64>
where
    TableScheme: ValidFor<M::Class>,
{
    let settings = Bilinear::with_error(windows.k);
    let report = watched(stepper(scheme, h, &()), &mut motion, &settings, windows.every, windows.steps);
    assert_ne!(report.verdict, Verdict::Inconsistent, "{scheme}, h = {h}, {windows:?}: {report}");
    report
}

fn is_bounded_or_undecided(report: &Report<f64>) -> bool {
    report.verdict.is_bounded() || report.verdict == Verdict::Undecided(Missing::Resolution)
}

/// From the perihelion.
fn kepler(eccentricity: f64) -> Start<f64, Kepler> {
    let speed = ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt();
    Motion::new(Kepler, UnitMasses, vec![1.0 - eccentricity, 0.0], vec![0.0, speed]).unwrap()
}

/// Windows that overlap, more than 256 of them, and some that do not.
const RUNS: [(&str, Windows); 5] = [
    ("1/20", Windows { every: 1, steps: 400, k: 16 }),
    ("1/50", Windows { every: 3, steps: 1000, k: 16 }),
    ("1/60", Windows { every: 4, steps: 1200, k: 8 }),
    ("1/90", Windows { every: 16, steps: 4500, k: 16 }),
    ("1/20", Windows { every: 20, steps: 2000, k: 16 }),
];

#[test]
fn circular_orbits_and_nearly_circular_ones() {
    for (h, windows) in RUNS {
        for scheme in ["symplectic-euler", "stormer-verlet", "yoshida4", "blanes-moan-srkn6b"] {
            for eccentricity in [0.0, 1e-9, 1e-6, 1e-3, 0.1] {
                let report = watch_correct(kepler(eccentricity), (scheme, h), windows);
                let case = format!("{scheme}, {h}, {eccentricity}, {windows:?}: {report}");
                // of the others the energy error is round-off, or nearly
                let expected =
                    report.verdict == BOUNDED || (scheme != "stormer-verlet" && is_bounded_or_undecided(&report));
                assert!(expected && report.rough.is_none(), "{case}");
            }
        }
    }
}

#[test]
fn circles_in_space_and_of_an_oscillator() {
    for (h, windows) in RUNS {
        for scheme in ["symplectic-euler", "stormer-verlet", "yoshida4", "blanes-moan-srkn6b"] {
            for eccentricity in [0.0, 1e-6, 1e-3] {
                let speed = 1.0 + eccentricity;
                // inclined, so that no coordinate is 0
                let inclined =
                    Motion::new(Space, UnitMasses, vec![0.8, 0.36, 0.48], vec![0.0, 0.8 * speed, -0.6 * speed]);
                let oscillator = Motion::new(Plane, UnitMasses, vec![1.0, 0.0], vec![0.0, speed]);
                let by = (scheme, h);
                let inclined = watch_correct(inclined.unwrap(), by, windows);
                let oscillator = watch_correct(oscillator.unwrap(), by, windows);
                for report in [inclined, oscillator] {
                    assert!(is_bounded_or_undecided(&report), "{by:?}, {eccentricity}, {windows:?}: {report}");
                }
            }
        }
    }
}

/// Planets on circles around a sun at rest, which do not disturb each other: H − H̄ is θ²T/12 of each.
#[test]
fn circular_orbits_of_several_bodies() {
    for (masses, radii) in [([1e-6, 1e-3], [1.0, 5.2]), ([1e-3, 1e-6], [1.0, 5.2]), ([1e-4, 1e-4], [1.0, 1.6])] {
        for (h, windows) in RUNS {
            let planets = from_fn(4, move |q, gradient| {
                let mut energy = 0.0;
                for (i, m) in masses.into_iter().enumerate() {
                    let r = q[2 * i].hypot(q[2 * i + 1]);
                    energy -= m / r;
                    gradient[2 * i] = m * q[2 * i] / r.powi(3);
                    gradient[2 * i + 1] = m * q[2 * i + 1] / r.powi(3);
                }
                energy
            });
            let kinetic = DiagonalMasses::from_numbers(&masses.map(|m| [m, m]).concat()).unwrap();
            let [p0, p1] = [0, 1].map(|i: usize| masses[i] / f64::sqrt(radii[i]));
            let motion = Motion::new(planets, kinetic, [radii[0], 0.0, radii[1], 0.0], [0.0, p0, 0.0, p1]);
            watch_correct(motion.unwrap(), ("stormer-verlet", h), windows);
        }
    }
}

/// A derivative of the potential jumps, by so little that H − H̄ is still as on a circle.
#[test]
fn circles_with_forces_that_are_not_smooth() {
    for (m, c) in [(1, 1e-4), (1, 1e-6), (2, 1e-3), (2, 1e-5), (3, 1e-3)] {
        for (h, windows) in RUNS {
            let bent = from_fn(2, move |q, gradient| {
                let r = q[0].hypot(q[1]);
                let x = (q[0] - 0.3).max(0.0);
                gradient[0] = q[0] / r.powi(3) + if x > 0.0 { c * f64::from(m) * x.powi(m - 1) } else { 0.0 };
                gradient[1] = q[1] / r.powi(3);
                -1.0 / r + c * x.powi(m)
            });
            let motion = Motion::new(bent, UnitMasses, vec![1.0, 0.0], vec![0.0, 1.0]).unwrap();
            let report = watch_correct(motion, ("stormer-verlet", h), windows);
            assert!(report.rough.is_some(), "m = {m}, c = {c}, h = {h}, {windows:?}: {report}");
        }
    }
}

/// Steps so short that second and fourth differences of p are round-off, of runs that turn once and of shorter ones.
#[test]
fn steps_so_short_that_round_off_hides_the_turning() {
    for h in ["1e-4", "8e-5", "6e-5", "2e-5", "1e-5", "1e-6"] {
        for eccentricity in [0.0, 1e-6, 1e-3, 0.1] {
            for (every, steps, k) in [(1, 400, 16), (20, 400, 8), (20, 2000, 8)] {
                watch_correct(kepler(eccentricity), ("stormer-verlet", h), Windows { every, steps, k });
            }
        }
    }
    // one turn and more
    watch_correct(kepler(0.0), ("stormer-verlet", "8e-5"), Windows { every: 4000, steps: 100_000, k: 8 });
}

/// On an arc much shorter than a turn H varies by a small part of H − H̄ only.
#[test]
fn short_arcs() {
    let settings = Bilinear::with_error(8);
    for name in ["kepler", "harmonic-oscillator", "henon-heiles", "pendulum", "outer-solar-system"] {
        for h in ["1e-2", "1e-4", "1e-9"] {
            let context = precision(60);
            let mut motion: ProblemMotion<Float> =
                problem(name).unwrap().setup(&[], 80).unwrap().motion(&context).unwrap();
            let verlet = stepper("stormer-verlet", h, &context);
            let report = watched(verlet, &mut motion, &settings, 20, 1000);
            assert!(report.verdict.is_bounded(), "{name}, h = {h}: {report}");
        }
    }
    // of a scheme of order 1 H − H̄ may be of one sign for more than half a turn
    for eccentricity in [0.02, 0.05, 0.1, 0.3] {
        for steps in 32..=70 {
            let windows = Windows { every: 1, steps, k: 16 };
            watch_correct(kepler(eccentricity), ("symplectic-euler", "1/10"), windows);
        }
    }
}

/// What is not correct is seen on a circle, too, also where windows overlap.
#[test]
fn wrong_loops_on_a_circle() {
    for eccentricity in [0.0, 1e-6, 1e-3] {
        for (every, steps, k) in [(1, 400, 16), (3, 1000, 16), (20, 4000, 8)] {
            for monitored in ["1/19", "1/21", "1/10"] {
                let mut motion = kepler(eccentricity);
                let [own, monitored] = ["1/20", monitored].map(|h| stepper("stormer-verlet", h, &()));
                let settings = Bilinear::with_error(k);
                let mut monitor = ShadowEnergy::new(monitored, &mut motion, &settings).unwrap().every(every);
                for _ in 0..steps {
                    own.step_augmented(&mut motion);
                    monitor.observe(&mut motion).unwrap();
                }
                assert_eq!(monitor.report().verdict, Verdict::Inconsistent, "{}", monitor.report());
            }
        }
    }
    let circle: Start<Float, Kepler> = {
        let context = precision(30);
        Motion::new(Kepler, UnitMasses, numbers(&["1", "0"], &context), numbers(&["0", "1"], &context)).unwrap()
    };
    let plain = watch_loop::<Float, _>(circle, TWENTIETH, 1000, |stepper, motion, _| stepper.step(motion));
    assert_eq!((plain.verdict, plain.mismatches), (Verdict::Inconsistent, 0), "{plain}");
}
