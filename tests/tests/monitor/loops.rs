//! Loops whose steps are not made by the monitor's stepper.

use super::*;
use shadowstep::steps::MismatchError;

/// Eccentricity 0.6.
fn comet<N: Real>(context: &N::Context) -> Start<N, Kepler> {
    Motion::new(Kepler, UnitMasses, numbers(&["0.4", "0"], context), numbers(&["0", "2"], context)).unwrap()
}

#[test]
fn a_forgotten_beta_is_seen() {
    let plain = watch_loop::<f64, _>(comet(&()), TWENTIETH, 4000, |stepper, motion, _| stepper.step(motion));
    assert_eq!((plain.verdict, plain.mismatches), (Verdict::Inconsistent, plain.windows), "{plain}");
    assert!(plain.reason().contains("needs_increments()"), "{plain}");
    // needed by the step before: the first step of each window has no β, and the first window's second
    let mut needed = true;
    let late = watch_loop::<f64, _>(comet(&()), TWENTIETH, 4000, |stepper, motion, needs_increments| {
        as_needed(stepper, motion, std::mem::replace(&mut needed, needs_increments));
    });
    assert_eq!(late.verdict, Verdict::Inconsistent, "{late}");
    // other numbers keep no increments of q and p, and H̄ has to show it
    let context = precision(30);
    let kepler = watch_loop::<Float, _>(comet(&context), TWENTIETH, 1000, |stepper, motion, _| {
        stepper.step(motion);
    });
    assert_eq!((kepler.verdict, kepler.mismatches), (Verdict::Inconsistent, 0), "{kepler}");
    assert!(kepler.reason().starts_with("the states do not belong to the increments"), "{kepler}");
    let tenth = ("1/10", "1/10");
    let henon = watch_loop::<Float, _>(henon_heiles(&context), tenth, 1000, |stepper, motion, _| {
        stepper.step(motion);
    });
    assert_eq!(henon.verdict, Verdict::Inconsistent, "{henon}");
}

#[test]
fn steps_of_another_size_are_seen() {
    for monitored in ["1/10", "1/40", "1/19", "1/22"] {
        let report = watch_loop::<f64, _>(comet(&()), ("1/20", monitored), 4000, as_needed);
        assert_eq!((report.verdict, report.mismatches), (Verdict::Inconsistent, 0), "{monitored}: {report}");
    }
    let circle = Motion::new(Kepler, UnitMasses, vec![1.0, 0.0], vec![0.0, 1.0]).unwrap();
    let report = watch_loop(circle, ("1/20", "1/19"), 4000, as_needed);
    assert_eq!(report.verdict, Verdict::Inconsistent, "{report}");
}

/// H − H̄ of a circular orbit never is 0, while H stays: by whatever scheme, and by estimators that are themselves off.
#[test]
fn a_circle_is_not_taken_for_another_loop() {
    let watch_circle = |scheme: &str, h: &str, settings: &Bilinear| {
        let mut motion = Motion::new(Kepler, UnitMasses, [1.0, 0.0], [0.0, 1.0]).unwrap();
        let report = watched(stepper(scheme, h, &()), &mut motion, settings, 20, 1000);
        assert_ne!(report.verdict, Verdict::Inconsistent, "{scheme}, h = {h}, {settings:?}: {report}");
        report.verdict
    };
    for h in ["1/20", "1/5", "2/5"] {
        for name in ["symplectic-euler", "stormer-verlet", "ruth3", "yoshida4", "mclachlan-s2", "mclachlan-atela2"] {
            assert_eq!(watch_circle(name, h, &Bilinear::with_error(8)), BOUNDED, "{name}, h = {h}");
        }
        for settings in [1, 2, 3, 4, 5].into_iter().flat_map(|k| [Bilinear::new(k), Bilinear::with_error(k)]) {
            watch_circle("stormer-verlet", h, &settings);
        }
    }
}

/// p ← (1 − δ)p after each step, with δ far above round-off and far below what a step does.
#[test]
fn a_weak_drag_is_a_drift() {
    for drag in [1e-9, 1e-6] {
        let report = watch_loop::<f64, _>(comet(&()), TWENTIETH, 20_000, |stepper, motion, needs_increments| {
            as_needed(stepper, motion, needs_increments);
            motion.p_mut().iter_mut().for_each(|p| *p *= 1.0 - drag);
        });
        assert_eq!((report.verdict, report.trend), (Verdict::Drifts, Some(Trend::Linear)), "{drag}: {report}");
        let reason = report.reason();
        assert!(reason.contains("linearly in time") && !reason.contains("bounded"), "{reason}");
    }
    // within windows changes of a thousandth of a step and more are seen at once
    let strong = watch_loop::<f64, _>(comet(&()), TWENTIETH, 2000, |stepper, motion, needs_increments| {
        as_needed(stepper, motion, needs_increments);
        motion.p_mut().iter_mut().for_each(|p| *p *= 1.0 - 1e-3);
    });
    assert_eq!(strong.verdict, Verdict::Inconsistent, "{strong}");
}

/// The slow oscillation of the planets' H̄ looks like a drift for a while: this is not a push.
#[test]
fn a_slow_oscillation_is_no_push() {
    for (h, steps) in
        [("200", 5000), ("200", 10_000), ("200", 20_000), ("300", 20_000), ("400", 20_000), ("600", 20_000)]
    {
        let report = watch("outer-solar-system", &[], "stormer-verlet", h, steps);
        assert_eq!(report.verdict, Verdict::Bounded, "h = {h}, {steps} steps: {report}");
    }
}

/// A momentum that is kicked once, between windows, and an angle that is wrapped where the potential has no such
/// period.
#[test]
fn a_moved_state_is_named_as_a_cause() {
    let (mut n, mut kicked) = (0, false);
    let report = watch_loop::<f64, _>(comet(&()), TWENTIETH, 4000, |stepper, motion, needs_increments| {
        as_needed(stepper, motion, needs_increments);
        n += 1;
        if n >= 2000 && !needs_increments && !kicked {
            motion.p_mut()[1] *= 1.1;
            kicked = true;
        }
    });
    assert!(kicked && report.mismatches == 0, "{report}");
    assert_eq!(report.verdict, Verdict::Undecided(Missing::Resolution), "{report}");
    assert!(report.reason().contains("something other than the scheme that changed the state"), "{report}");
}

/// An angle that is wrapped leaves H and its gradient as they are, but not β, nor H̄ as the estimator sees it.
#[test]
fn a_wrapped_angle_is_seen() {
    let rotor = Motion::new(Pendulum, UnitMasses, vec![0.0], vec![2.5]).unwrap();
    let report = watch_loop::<f64, _>(rotor, TWENTIETH, 4000, |stepper, motion, needs_increments| {
        as_needed(stepper, motion, needs_increments);
        let turns = (motion.q()[0] / std::f64::consts::TAU).round();
        motion.q_mut()[0] -= turns * std::f64::consts::TAU;
    });
    assert_eq!(report.verdict, Verdict::Inconsistent, "{report}");
    assert!((1..report.windows).contains(&report.mismatches), "{report}");
    assert!(report.reason().ends_with("or q or p were changed between the steps"), "{report}");
}

/// E_1 has no errors, with or without: the report names what it does not know.
#[test]
fn unknown_errors_are_named() {
    for settings in [Bilinear::new(1), Bilinear::with_error(1)] {
        let report = watch_by(&settings, "kepler", &[], "stormer-verlet", "1/20", 4000);
        assert_eq!(report.verdict, BOUNDED, "the energy itself shows that: {report}");
        assert!(report.reason().ends_with("but this estimator gives no errors"), "{report}");
    }
}

/// Weights of another precision, or another system, are errors.
#[test]
fn other_systems_are_refused() {
    let stepper = stepper("stormer-verlet", "1/20", &precision(30));
    let settings = Bilinear::with_error(8);
    let mut precise = comet::<Float>(&precision(60));
    assert_eq!(
        ShadowEnergy::new(stepper.clone(), &mut precise, &settings).map(drop),
        Err(RunError::Mismatch(MismatchError::Precision))
    );
    assert_eq!(
        ShadowRun::new(stepper.with(precise), 10, &settings).map(drop),
        Err(RunError::Mismatch(MismatchError::Precision))
    );
    assert!(ShadowRun::new(stepper.with(comet::<Float>(&precision(30))), 10, &settings).is_ok());

    let stepper = shadowstep_tests::stepper("stormer-verlet", "1/20", &());
    let pendulum = || Motion::new(Pendulum, UnitMasses, vec![0.0], vec![1.0]).unwrap();
    let mut monitor = ShadowEnergy::new(stepper.clone(), &mut comet(&()), &settings).unwrap().every(20);
    let error = (0..100).find_map(|_| monitor.step(&mut pendulum()).map(drop).err()).unwrap();
    assert_eq!(error, RunError::Dimension { coordinates: 1, begun: 2 });
    let message = "the system has 1 coordinates, and the one at the start had 2; a monitor follows one system";
    assert_eq!(error.to_string(), message);
    let mut monitor = ShadowEnergy::new(stepper, &mut pendulum(), &settings).unwrap();
    assert_eq!(monitor.step(&mut comet(&())).map(drop), Err(RunError::Dimension { coordinates: 2, begun: 1 }));
}
