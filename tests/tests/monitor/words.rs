//! Errors and words.

use super::*;

/// Oscillator steps until `steps` are made or one is not finite.
fn oscillate(omega: f64, h: &str, steps: u64, every: u64) -> (Report<f64>, Option<RunError>) {
    let verlet = stepper("stormer-verlet", h, &());
    let mut motion = Motion::new(HarmonicOscillator { omega }, UnitMasses, [1.0], [0.0]).unwrap();
    let mut monitor = ShadowEnergy::new(verlet, &mut motion, &Bilinear::with_error(8)).unwrap().every(every);
    let error = (0..steps).find_map(|_| monitor.step(&mut motion).map(drop).err());
    (monitor.report(), error)
}

fn has_no_strange_numbers(report: &Report<f64>) {
    let text = report.to_string();
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
}

#[test]
fn a_blow_up_is_too_large() {
    for (omega, h, every) in [(1.0, "2.01", 20), (1.0, "2.01", 1), (100.0, "1/49", 20), (1.0, "100", 20)] {
        let (report, error) = oscillate(omega, h, 100_000, every);
        let Some(RunError::NotFinite { step, .. }) = error else { panic!("{error:?}") };
        assert_eq!(report.verdict, Verdict::TooLarge(Criterion::NotFinite), "{report}");
        assert!(report.reason().contains(&format!("not finite from step {step} on")), "{report}");
        has_no_strange_numbers(&report);
    }
    // before it, at all sizes up to those whose squares overflow
    for steps in [400, 500, 700, 1000, 1500, 1780] {
        let (report, error) = oscillate(1.0, "2.01", steps, 20);
        assert!(error.is_none() && matches!(report.verdict, Verdict::TooLarge(_)), "{report}");
        has_no_strange_numbers(&report);
    }
}

#[test]
fn no_report_has_strange_numbers() {
    // at ωh = 2 the states alternate between two turning points
    for (omega, h) in [(1.0, "2"), (0.7, "20/7")] {
        let (report, _) = oscillate(omega, h, 2000, 20);
        assert!(matches!(report.verdict, Verdict::TooLarge(_)), "{report}");
        has_no_strange_numbers(&report);
    }
    let (before, _) = oscillate(1.0, "1/10", 0, 20);
    assert_eq!(before.verdict, Verdict::Undecided(Missing::Windows));
    has_no_strange_numbers(&before);
    for q in [0.0, 0.1] {
        potential! { struct Flat; U(x) = 0*x }
        let rest = watch_loop(Motion::new(Flat, UnitMasses, vec![q], vec![0.0]).unwrap(), TWENTIETH, 1000, as_needed);
        assert_eq!(rest.verdict, Verdict::Bounded, "{rest}");
        has_no_strange_numbers(&rest);
    }
    let bottom = Motion::new(HarmonicOscillator { omega: 1.0 }, UnitMasses, vec![0.0], vec![0.0]).unwrap();
    let rest = watch_loop(bottom, TWENTIETH, 1000, as_needed);
    assert_eq!(rest.verdict, Verdict::Bounded, "{rest}");
    has_no_strange_numbers(&rest);
}

#[test]
fn what_is_not_finite_has_its_step() {
    // at q = 2 the kick makes p = −7/4 − 1/4 = −2, and the drift ends in q = 0: the force of step 2 is 0/0
    let start = || Motion::new(Kepler, UnitMasses, vec![2.0, 0.0], vec![-1.75, 0.0]).unwrap();
    let euler = stepper("symplectic-euler", "1", &());
    for every in [1, 8] {
        let mut motion = start();
        let mut monitor = ShadowEnergy::new(euler.clone(), &mut motion, &Bilinear::new(4)).unwrap().every(every);
        let error = (0..200).find_map(|_| monitor.step(&mut motion).map(drop).err());
        let Some(RunError::NotFinite { step, value }) = error else { panic!("it goes on") };
        let is_of_state = matches!(value.quantity, Quantity::Position(_) | Quantity::Momentum(_) | Quantity::Beta);
        assert!(step == 2 && is_of_state && value.to_string().contains(" = "), "step {step}: {value}");
    }
    // between windows it is found by the next one: here after the first window, of the states 12 to 16
    let mut motion = start();
    motion.q_mut()[0] = 20.0;
    let mut monitor = ShadowEnergy::new(euler, &mut motion, &Bilinear::new(4)).unwrap().every(50);
    let mut error = None;
    for n in 1..200 {
        if n == 20 {
            motion.q_mut()[1] = f64::NAN;
        }
        if let Err(found) = monitor.step(&mut motion) {
            error = Some((n, found));
            break;
        }
    }
    let Some((n, RunError::NotFinite { step, .. })) = error else { panic!("it goes on") };
    assert!((50..100).contains(&step) && step == n, "step {step}, n = {n}");
}

#[test]
fn a_start_that_is_not_finite_is_refused() {
    let mut centre = Motion::of_any_energy(Kepler, UnitMasses, vec![0.0, 0.0], vec![0.0, 1.0]).unwrap();
    let verlet = stepper("stormer-verlet", "1", &());
    let error = ShadowEnergy::new(verlet, &mut centre, &Bilinear::new(4)).map(drop).unwrap_err();
    assert!(matches!(error, RunError::NotFinite { step: 0, .. }), "{error}");
}

/// The report that the documentation of `ShadowEnergy` shows.
#[test]
fn a_report_reads() {
    let documentation = include_str!("../../../runtime/src/shadow/monitor/shadow_energy.rs");
    let (_, shown) = documentation.split_once("```text\n").unwrap();
    let (shown, _) = shown.split_once("/// ```").unwrap();
    let shown: Vec<&str> = shown.lines().map(|line| line.trim_start_matches("/// ")).collect();

    let verlet = stepper("stormer-verlet", "1/20", &());
    let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap();
    let printed = watched(verlet, &mut motion, &Bilinear::with_error(8), 100, 20_000).to_string();
    let trimmed = |lines: &[&str]| lines.iter().map(|line| line.trim().to_owned()).collect::<Vec<_>>();
    assert_eq!(trimmed(&printed.lines().collect::<Vec<_>>()), trimmed(&shown), "{printed}");
}

/// Every verdict states why, with numbers.
#[test]
fn verdicts_say_why() {
    let cases = [
        (
            "kepler",
            "stormer-verlet",
            "1/20",
            "the energy error is 1.9 % of T; in 20000 steps a net change above",
            "per unit time, is excluded",
        ),
        (
            "argon-crystal",
            "blanes-moan-srkn6b",
            "7.125e-5",
            "the error grows with the length of the run",
            "or something other than the scheme, have such effects, too",
        ),
        ("kepler", "stormer-verlet", "1/3", "the energy error is", "of the mean kinetic energy"),
    ];
    for (name, scheme, h, begin, end) in cases {
        let reason = watch(name, &[], scheme, h, 20_000).reason();
        assert!(reason.contains(begin) && reason.ends_with(end), "{reason}");
        assert!(reason.contains(|c: char| c.is_ascii_digit()), "{reason}");
    }
    let few = watch("kepler", &[], "stormer-verlet", "1/20", 100);
    assert_eq!(few.reason(), "a verdict needs 16 windows, and there are 5");
    let none = watch("kepler", &[], "stormer-verlet", "1/20", 1).to_string();
    assert_eq!(none, "undecided (1 steps, 0 windows)\n  a verdict needs 16 windows, and there are 0");
}
