//! Runs that were not used to choose the thresholds: `cargo bench -p shadowstep-tests --bench verdicts` has all of
//! them.

use super::*;
use shadowstep_tests::matrix::{Matrix, Scene, stepper};

const SCENES: [&str; 4] =
    ["pendulum p=1.7", "henon-heiles px=0.3 py=0.05", "henon-heiles px=0.35 py=0.35", "kepler eccentricity=0.45"];
const SCHEMES: [&str; 3] = ["mclachlan-s2", "suzuki4", "blanes-moan-srkn14a"];
const STEPS: u64 = 8000;

/// The verdicts of monitors with different k, all of the same states.
fn verdicts_of(scene: &Scene, scheme: &str, part: f64) -> Vec<Report<f64>> {
    let stepper = stepper(scheme, scene.limit, part);
    let mut motion = scene.motion();
    let monitor = |k| ShadowEnergy::new(stepper.clone(), &mut motion, &Bilinear::with_error(k)).unwrap().every(70);
    let mut monitors: Vec<_> = [6, 8, 16, 32].map(monitor).into();
    for _ in 0..STEPS {
        stepper.step_augmented(&mut motion);
        // what is not finite stays so, and each monitor has to see it
        monitors.iter_mut().for_each(|monitor| drop(monitor.observe(&mut motion)));
    }
    monitors.iter().map(|monitor| monitor.report()).collect()
}

/// max − min of H in a run of three times the length; infinite where it is not finite.
fn longer(scene: &Scene, scheme: &str, part: f64) -> f64 {
    let stepper = stepper(scheme, scene.limit, part);
    let mut motion = scene.motion();
    let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
    for n in 0..3 * STEPS {
        if n % 5 == 0 {
            let energy = motion.energy();
            if !energy.is_finite() {
                return f64::INFINITY;
            }
            (least, largest) = (least.min(energy), largest.max(energy));
        }
        stepper.step(&mut motion);
    }
    largest - least
}

/// Whichever k there is: no verdict contradicts another one, none that is fine is followed by a larger error, and none
/// that is too large is followed by the same, small one.
#[test]
fn verdicts_hold_for_the_trajectory() {
    let matrix = Matrix::held_out();
    let mut decided = 0;
    for name in SCENES {
        let scene = matrix.scenes.iter().find(|scene| scene.name == name).expect("it is in the matrix");
        for (scheme, &part) in
            SCHEMES.iter().flat_map(|scheme| matrix.parts[..5].iter().map(move |part| (scheme, part)))
        {
            let reports = verdicts_of(scene, scheme, part);
            let later = longer(scene, scheme, part);
            for report in &reports {
                let growth = later / report.energy_error;
                let case = format!("{name}, {scheme}, {part}: {growth} times {report}");
                match report.verdict {
                    Verdict::Undecided(_) => continue,
                    // 3 times the length; windows are a sample of the states, so that H may range over a third more
                    Verdict::Bounded => assert!(growth < 1.5 && later < 0.6 * report.kinetic, "{case}"),
                    Verdict::TooLarge(_) | Verdict::NotConserved => {
                        assert!(growth > 1.5 || later > 0.3 * report.kinetic || later.is_nan(), "{case}")
                    }
                    _ => panic!("{case}"),
                }
                decided += 1;
            }
            let has = |is: fn(Verdict) -> bool| reports.iter().any(|report| is(report.verdict));
            let grows = has(|verdict| matches!(verdict, Verdict::TooLarge(_) | Verdict::NotConserved));
            let contradicts = has(Verdict::is_bounded) && grows;
            assert!(
                !contradicts,
                "{name}, {scheme}, {part}: {:?}",
                reports.iter().map(|r| r.verdict).collect::<Vec<_>>()
            );
        }
    }
    // of 4 · 15 runs with 4 estimators
    assert!(decided >= 200, "{decided}");
}
