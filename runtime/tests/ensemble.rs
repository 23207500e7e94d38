//! Ensembles: each trajectory has the outcome that it has alone, whatever computes it.

use std::num::NonZero;

use shadowstep::number::Lanes;
use shadowstep::number::instructions::Instructions;
use shadowstep::problems::Kepler;
use shadowstep::shadow::ensemble::{Block, Ensemble, EnsembleError, Outcome};
use shadowstep::shadow::{BuildEstimator, Estimator, FixedBilinear};
use shadowstep::systems::kinetic::{Kinetic, Quadratic};
use shadowstep::{DiagonalMasses, FullMasses, Motion, MotionError, Stepper, UnitMasses, potential, splitting_scheme};

#[splitting_scheme("yoshida4.toml")]
#[derive(Clone, Copy)]
pub struct Yoshida4;

potential! { pub struct Well { depth, width } U(x, y) = -depth / (1 + (x^2 + 2*y^2)/width^2) }

/// 100 trajectories: columns of parameters and initial values.
struct Columns {
    depth: Vec<f64>,
    width: Vec<f64>,
    x: Vec<f64>,
    p: Vec<f64>,
}

fn columns() -> Columns {
    let column = |a: f64, b: f64| (0..100).map(|t| a + b * (f64::from(t) * 1.7).sin()).collect();
    Columns { depth: column(1.0, 0.3), width: column(2.0, 0.5), x: column(0.1, 0.4), p: column(0.0, 0.6) }
}

const ENSEMBLE: Ensemble =
    Ensemble { trajectories: 100, steps: 60, every: 10, modified_energy: Some(6), merged: false, threads: None };

fn run<const W: usize>(ensemble: Ensemble) -> Vec<Outcome> {
    let Columns { depth, width, x, p } = columns();
    let stepper = Stepper::new(Yoshida4, "1/10").unwrap();
    let found = ensemble.run::<W, _, _, _>(&stepper, |block| {
        let well = Well { depth: block.lanes(|t| depth[t]), width: block.lanes(|t| width[t]) };
        let (q, p) = ([block.lanes(|t| x[t]), block.lanes(|_| 0.3)], [block.lanes(|t| p[t]), block.lanes(|_| 0.1)]);
        Motion::new(well, UnitMasses, q, p)
    });
    found.unwrap()
}

/// The outcome of one trajectory by the plain loop over `f64`.
fn alone(t: usize) -> Outcome {
    let Columns { depth, width, x, p } = columns();
    let stepper = Stepper::new(Yoshida4, "1/10").unwrap();
    let well = Well { depth: depth[t], width: width[t] };
    let mut motion = Motion::new(well, UnitMasses, [x[t], 0.3], [p[t], 0.1]).unwrap();
    let initial = motion.energy();
    let (mut largest, mut range) = (0.0_f64, [f64::INFINITY, f64::NEG_INFINITY]);
    let mut modified = Vec::new();
    let mut estimator = None;
    for n in 0..60 {
        if n % 10 == 0 {
            estimator = Some(FixedBilinear::new(6).build(stepper.step_size(), 2, &()).unwrap());
        }
        if let Some(estimate) = estimator.as_mut().unwrap().push(motion.q(), motion.p(), motion.increments()) {
            range = [range[0].min(*estimate.value), range[1].max(*estimate.value)];
            modified.push(*estimate.value);
        }
        stepper.step_augmented(&mut motion);
        if n % 10 == 9 {
            largest = largest.max((motion.energy() - initial).abs());
        }
        if n % 10 == 5 {
            let estimate = estimator.as_mut().unwrap().push(motion.q(), motion.p(), motion.increments());
            let value = *estimate.expect("7 states").value;
            range = [range[0].min(value), range[1].max(value)];
            modified.push(value);
            estimator = Some(FixedBilinear::new(6).build(stepper.step_size(), 2, &()).unwrap());
        }
    }
    Outcome {
        q: motion.q().to_vec(),
        p: motion.p().to_vec(),
        energies: [initial, motion.energy()],
        energy_error: Some(largest / initial.abs()),
        modified_drift: Some(range[1] - range[0]),
        modified_energies: Some([modified[0], *modified.last().unwrap()]),
        not_finite: None,
    }
}

#[test]
fn outcomes_are_those_of_each_trajectory_alone() {
    let found = run::<8>(ENSEMBLE);
    assert_eq!(found.len(), 100);
    for (t, found) in found.iter().enumerate() {
        let expected = alone(t);
        assert_eq!([&found.q, &found.p], [&expected.q, &expected.p], "trajectory {t}");
        assert_eq!(found.energy_error, expected.energy_error, "trajectory {t}");
        assert_eq!(found.modified_drift, expected.modified_drift, "trajectory {t}");
        assert_eq!(found.energies, expected.energies, "trajectory {t}");
        assert_eq!(found.modified_energies, expected.modified_energies, "trajectory {t}");
    }
    // of one the six estimates agree to the last bit
    let drifting = found.iter().filter(|found| found.modified_drift > Some(0.0)).count();
    assert!(drifting >= 99, "{drifting}");
}

#[test]
fn outcomes_do_not_depend_on_lanes_threads_or_instructions() {
    let expected = run::<8>(ENSEMBLE);
    assert_eq!(run::<4>(ENSEMBLE), expected);
    assert_eq!(run::<16>(ENSEMBLE), expected);
    for threads in [1, 2, 3, 8] {
        assert_eq!(run::<8>(Ensemble { threads: NonZero::new(threads), ..ENSEMBLE }), expected);
    }
    for instructions in Instructions::available() {
        let one_thread = Ensemble { threads: NonZero::new(1), ..ENSEMBLE };
        assert_eq!(instructions.only(|| run::<8>(one_thread)), expected, "{instructions:?}");
    }
    // the energy alone has the same states
    for (with, without) in expected.iter().zip(run::<8>(Ensemble { modified_energy: None, ..ENSEMBLE })) {
        assert_eq!((&with.q, &with.p, with.energy_error), (&without.q, &without.p, without.energy_error));
        assert_eq!(without.modified_drift, None);
    }
}

/// Only the steps between states whose energy is computed are merged.
#[test]
fn merged_outcomes_are_those_of_merged_steps() {
    let merged = Ensemble { merged: true, modified_energy: None, threads: NonZero::new(1), ..ENSEMBLE };
    let found = run::<8>(merged);
    for instructions in Instructions::available() {
        assert_eq!(instructions.only(|| run::<16>(merged)), found, "{instructions:?}");
    }
    let Columns { depth, width, x, p } = columns();
    let stepper = Stepper::new(Yoshida4, "1/10").unwrap();
    for (t, (found, plain)) in found.iter().zip(run::<8>(ENSEMBLE)).enumerate() {
        let well = Well { depth: depth[t], width: width[t] };
        let mut motion = Motion::new(well, UnitMasses, [x[t], 0.3], [p[t], 0.1]).unwrap();
        (0..6).for_each(|_| stepper.merged_steps(std::slice::from_mut(&mut motion), 10));
        assert_eq!([&found.q[..], &found.p], [motion.q(), motion.p()], "trajectory {t}");
        // 60 steps of 7 maps, each of which rounds numbers of size 1
        assert!((found.energy_error.unwrap() - plain.energy_error.unwrap()).abs() < 1e-13, "trajectory {t}");
    }
}

#[test]
fn estimates_may_overlap() {
    let every_step = run::<8>(Ensemble { every: 1, ..ENSEMBLE });
    let every_ten = run::<8>(ENSEMBLE);
    for (one, ten) in every_step.iter().zip(&every_ten) {
        assert_eq!((&one.q, &one.p), (&ten.q, &ten.p));
        assert!(one.energy_error >= ten.energy_error && one.modified_drift >= ten.modified_drift);
    }
}

/// A trajectory begins at the centre, another one where r² overflows.
#[test]
fn a_trajectory_that_is_not_finite_is_reported_alone() {
    let stepper = Stepper::new(Yoshida4, "1/20").unwrap();
    let x = |t: usize| match t {
        3 => 0.0,
        70 => 1e200,
        t => 0.5 + 0.01 * t as f64,
    };
    let ensemble = Ensemble { trajectories: 80, steps: 40, every: 7, modified_energy: Some(4), ..Ensemble::default() };
    let found = ensemble.run::<8, _, _, _>(&stepper, |block| {
        let [zero, speed] = [0.0, 1.1].map(|x| block.lanes(|_| x));
        Motion::new(Kepler, UnitMasses, [block.lanes(x), zero], [zero, speed])
    });
    for (t, outcome) in found.unwrap().iter().enumerate() {
        assert_eq!(outcome.not_finite, [3, 70].contains(&t).then_some(0), "trajectory {t}");
        assert!(
            outcome.not_finite.is_some()
                || outcome.energy_error.unwrap() < 0.1 && outcome.modified_drift.unwrap() < 0.1
        );
    }
}

#[test]
fn masses_are_rounded_once_for_all() {
    let stepper = Stepper::new(Yoshida4, "1/20").unwrap();
    let masses = ["3", "5"].map(|text| shadowstep::exact(text).unwrap());
    let ensemble = Ensemble { trajectories: 5, steps: 40, ..Ensemble::default() };
    let found = ensemble.run::<4, _, _, _>(&stepper, |block| {
        let [zero, one] = [0.0, 1.0].map(|x| block.lanes(|_| x));
        Motion::new(Kepler, DiagonalMasses::new(&masses, &())?, [one, zero], [zero, block.lanes(|t| 1.0 + t as f64)])
    });
    let stepper = Stepper::new(Yoshida4, "1/20").unwrap();
    for (t, outcome) in found.unwrap().iter().enumerate() {
        let masses = DiagonalMasses::new(&masses, &()).unwrap();
        let mut motion = Motion::new(Kepler, masses, [1.0, 0.0], [0.0, 1.0 + t as f64]).unwrap();
        (0..40).for_each(|_| stepper.step(&mut motion));
        assert_eq!(outcome.q, motion.q());
    }
}

/// E_4 and the errors of H, of trajectories with different masses.
fn with_masses<const W: usize, K, A>(together: impl Fn(&Block<W>) -> K + Sync, alone: impl Fn(usize) -> A)
where
    K: Kinetic<Lanes<W>, Class = Quadratic>,
    A: Kinetic<f64, Class = Quadratic>,
{
    const TRAJECTORIES: usize = 21;
    let ensemble =
        Ensemble { trajectories: TRAJECTORIES, steps: 40, every: 10, modified_energy: Some(4), ..Ensemble::default() };
    let stepper = Stepper::new(Yoshida4, "1/20").unwrap();
    for instructions in Instructions::available() {
        let one_thread = Ensemble { threads: NonZero::new(1), ..ensemble };
        let found = instructions.only(|| {
            one_thread.run::<W, _, _, _>(&stepper, |block| {
                let [zero, one] = [0.0, 1.0].map(|x| block.lanes(|_| x));
                Motion::new(Kepler, together(&block), [one, zero], [zero, one])
            })
        });
        for (t, outcome) in found.unwrap().iter().enumerate() {
            let stepper = Stepper::new(Yoshida4, "1/20").unwrap();
            let mut motion = Motion::new(Kepler, alone(t), [1.0, 0.0], [0.0, 1.0]).unwrap();
            let initial = motion.energy();
            (0..40).for_each(|_| stepper.step(&mut motion));
            assert_eq!((&outcome.q[..], &outcome.p[..]), (motion.q(), motion.p()), "trajectory {t}");
            // one of the masses makes H 0 at the beginning
            let Some(error) = outcome.energy_error else {
                assert_eq!(initial, 0.0, "trajectory {t}");
                continue;
            };
            assert!(error >= ((motion.energy() - initial) / initial).abs());
            // the increments have the same masses: with others E_4 would be no better than H
            assert!(outcome.modified_drift.unwrap() < 0.2 * error, "trajectory {t}: {outcome:?}");
        }
    }
}

#[test]
fn masses_may_differ_from_trajectory_to_trajectory() {
    let heavy = |t: usize| 1.0 + 0.1 * t as f64;
    let alone = |t: usize| DiagonalMasses::from_numbers(&[1.0, heavy(t)]).unwrap();
    let all: Vec<_> = (0..21).map(alone).collect();
    with_masses::<8, _, _>(|block| DiagonalMasses::of_each(&block.each(|t| &all[t])).unwrap(), alone);
    let alone = |t: usize| {
        let rational = |text: &str| shadowstep::exact(text).unwrap();
        let rows = [vec![rational("1"), rational("1/5")], vec![rational("1/5"), rational(&heavy(t).to_string())]];
        FullMasses::from_inverse(&rows, &()).unwrap()
    };
    let all: Vec<_> = (0..21).map(alone).collect();
    with_masses::<4, _, _>(|block| FullMasses::of_each(&block.each(|t| &all[t])).unwrap(), alone);
    let [two, three]: [DiagonalMasses<f64>; 2] = [2, 3].map(|d| DiagonalMasses::from_numbers(&vec![1.0; d]).unwrap());
    let error = DiagonalMasses::of_each(&[&two, &two, &three, &two]).unwrap_err();
    assert_eq!(error.to_string(), "the masses of one trajectory are for 2 coordinates, those of another for 3");
}

#[test]
fn wrong_settings_are_errors() {
    type Found = Result<Vec<Outcome>, EnsembleError<MotionError>>;
    let run = |ensemble: Ensemble| -> Found {
        let stepper = Stepper::new(Yoshida4, "1/10").unwrap();
        ensemble.run::<4, _, _, _>(&stepper, |block| {
            let one = block.lanes(|_| 1.0);
            Motion::new(Kepler, UnitMasses, vec![one, one, one], vec![one, one, one])
        })
    };
    let message = |ensemble| run(ensemble).unwrap_err().to_string();
    assert_eq!(
        message(Ensemble { trajectories: 2, ..Ensemble::default() }),
        "q has 3 coordinates, but the potential is a function of 2"
    );
    assert_eq!(
        message(Ensemble { every: 0, ..Ensemble::default() }),
        "the energy can be looked at every 1 step or more, not every 0 steps"
    );
    let wrong = Ensemble { modified_energy: Some(0), ..Ensemble::default() };
    assert_eq!(message(wrong), "the modified energy: k must be at least 1, not 0");
    assert_eq!(run(Ensemble::default()), Ok(Vec::new()));
}
