//! What a monitor costs and changes, which is nothing; its values equal a run's; its numbers against closed forms.

use super::*;

fn keeps_all_bits<N: Bits>(context: &N::Context) {
    for name in ["symplectic-euler", "stormer-verlet", "ruth3", "yoshida4", "blanes-moan-srkn6b"] {
        let stepper = stepper(name, "1/10", context);
        for every in [1, 4, 9, 30, 100] {
            let (mut plain, mut watched) = (henon_heiles::<N>(context), henon_heiles(context));
            let mut monitor = ShadowEnergy::new(stepper.clone(), &mut watched, &Bilinear::new(8)).unwrap().every(every);
            for n in 1..=250 {
                stepper.step(&mut plain);
                monitor.step(&mut watched).unwrap();
                let same = same_bits(plain.q(), watched.q()) && same_bits(plain.p(), watched.p());
                assert!(same && monitor.n() == n, "{name}, a window in {every} steps, n = {n}");
            }
        }
    }
}

#[test]
fn a_watched_trajectory_has_all_its_bits() {
    keeps_all_bits::<f64>(&());
    keeps_all_bits::<Float>(&precision(40));
}

/// Outside of windows a step has the operations of a plain one, but for T at some, and no gradient is evaluated twice.
#[test]
fn steps_between_windows_cost_what_plain_steps_cost() {
    let start = || {
        let q = [0.1, -0.3].map(Counting);
        Motion::new(HenonHeiles, UnitMasses, q, [0.2, 0.1].map(Counting)).unwrap()
    };
    for name in ["stormer-verlet", "yoshida4"] {
        let stepper = stepper(name, "1/10", &());
        let (mut plain, mut watched) = (start(), start());
        let mut monitor = ShadowEnergy::new(stepper.clone(), &mut watched, &Bilinear::new(8)).unwrap().every(100);
        let (mut with_beta, mut as_plain, mut with_more) = (0, 0, 0);
        for _ in 0..5000 {
            let needs_increments = monitor.needs_increments();
            let ((), cost) = count(|| stepper.step(&mut plain));
            let (result, watched_cost) = count(|| monitor.step(&mut watched).map(drop));
            result.unwrap();
            if needs_increments {
                with_beta += 1;
            } else if watched_cost == cost {
                as_plain += 1;
            } else {
                with_more += 1;
            }
        }
        // the step to the first state of a window keeps its rate for the next one; T is computed at 200 states, 179 of
        // which are elsewhere
        let more = 50 + 179;
        assert_eq!((with_beta, as_plain, with_more), (50 * 8, 5000 - 50 * 8 - more, more), "{name}");
        assert_eq!(watched.evaluations(), plain.evaluations(), "{name}");
    }
}

/// Steps at once are steps one by one: their states, their evaluations and their report.
#[test]
fn steps_at_once_have_the_report_of_steps_one_by_one() {
    for (name, every) in [("stormer-verlet", 100), ("yoshida4", 17), ("blanes-moan-srkn6b", 3), ("bcm6-13", 100)] {
        let stepper = stepper(name, "1/10", &());
        let begin =
            |motion: &mut _| ShadowEnergy::new(stepper.clone(), motion, &Bilinear::with_error(8)).unwrap().every(every);
        let (mut one, mut all) = (henon_heiles::<f64>(&()), henon_heiles::<f64>(&()));
        let (mut one_by_one, mut at_once) = (begin(&mut one), begin(&mut all));
        for count in [0, 1, 2, 90, 107, 1000, 3000] {
            for _ in 0..count {
                one_by_one.step(&mut one).unwrap();
            }
            at_once.steps(&mut all, count).unwrap();
            assert_eq!((at_once.n(), all.q(), all.p()), (one_by_one.n(), one.q(), one.p()), "{name}, {every}");
        }
        assert_eq!(all.evaluations(), one.evaluations(), "{name}, {every}");
        let [found, expected] = [&at_once, &one_by_one].map(|monitor| format!("{:?}", monitor.report()));
        assert_eq!(found, expected, "{name}, {every}");
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Values

/// One window in each `every` steps, with the bits of a run that estimates everywhere.
fn has_the_values_of_a_run<N: Bits>(settings: &(impl BuildEstimator<N> + std::fmt::Debug), context: &N::Context) {
    const STEPS: u64 = 400;
    for name in ["stormer-verlet", "ruth3"] {
        let stepper = stepper(name, "1/10", context);
        let mut run = ShadowRun::new(stepper.with(henon_heiles::<N>(context)), STEPS, settings).unwrap();
        let mut expected = Vec::new();
        let mut energies = henon_heiles::<N>(context);
        while let Some((n, estimate)) = run.advance().unwrap() {
            assert_eq!(n, expected.len() as i64);
            let energy = energies.energy_at(estimate.q, estimate.p);
            expected.push((estimate.value.clone(), estimate.error.cloned(), energy));
        }
        for every in [1, 5, 60] {
            let mut motion = henon_heiles::<N>(context);
            let mut monitor = ShadowEnergy::new(stepper.clone(), &mut motion, settings).unwrap().every(every);
            let mut windows = 0;
            for _ in 0..STEPS {
                let Some(sample) = monitor.step(&mut motion).unwrap() else { continue };
                let (value, error, energy) = &expected[sample.n as usize];
                let mut off = sample.energy.clone();
                off.subtract(energy);
                // in a window that is alone U = ½(qᵀU_q − rate), which rounds terms of size 0.1 once more
                let same = sample.modified.same_bits(value) && off.log10_abs() < -16.0;
                let same_error = match (sample.error, error) {
                    (Some(found), Some(error)) => found.same_bits(error),
                    (found, error) => found.is_none() && error.is_none(),
                };
                assert!(same && same_error, "{name}, {settings:?}, a window in {every} steps, n = {}", sample.n);
                windows += 1;
            }
            assert_eq!(monitor.report().windows, windows);
            let most = STEPS / every;
            assert!(windows <= most && windows + 41 / every + 1 >= most, "{windows} windows, one in {every} steps");
        }
    }
}

#[test]
fn values_are_those_of_a_run() {
    for k in [3, 8] {
        has_the_values_of_a_run::<f64>(&Bilinear::new(k), &());
        has_the_values_of_a_run::<f64>(&Bilinear::with_error(k), &());
    }
    has_the_values_of_a_run::<f64>(&Central::fixed_with_error(5), &());
    has_the_values_of_a_run::<f64>(&Central::best(10, StoppingRule::Full), &());
    has_the_values_of_a_run::<Float>(&Bilinear::with_error(6), &precision(40));
    has_the_values_of_a_run::<Float>(&Central::best(8, StoppingRule::Full), &precision(40));
}

// ---------------------------------------------------------------------------------------------------------------
// Numbers

/// From q = 1, p = 0 Störmer–Verlet keeps I = p² + (1 − x²)q² = 1 − x², x = h/2; then H = ½(I + x²q²) with q = cos nθ,
/// θ = 2 arcsin x, and H̄ = ½ I c with c = arcsin x/(x √(1 − x²)).
#[test]
fn the_parts_of_the_oscillator_are_in_closed_form() {
    let verlet = stepper("stormer-verlet", "3/10", &());
    let mut motion = Motion::new(HarmonicOscillator { omega: 1.0 }, UnitMasses, [1.0], [0.0]).unwrap();
    let report = watched(verlet, &mut motion, &Bilinear::with_error(8), 20, 40_000);
    let x: f64 = 0.15;
    let invariant = 1.0 - x * x;
    let modified = invariant * x.asin() / (x * invariant.sqrt()) / 2.0;
    let (least, largest) = (invariant / 2.0 - modified, 0.5 - modified);
    let (a, b) = (least, x * x / 2.0);
    // of cos² the mean is 1/2, and of cos⁴ 3/8
    let rms = (a * a + a * b + 3.0 / 8.0 * b * b).sqrt();
    // E_8 is off by some (h/2)^16 = 1e-13; round-off walks
    assert!((report.modified - modified).abs() < 1e-12, "{} and {modified}", report.modified);
    // 2000 phases come within π/400 of all, and b changes by the square of that; means are as good as the phases are
    // even
    for (found, right, tolerance) in [
        (report.energy_error, b, 1e-4),
        (report.method_least, least, 1e-4),
        (report.method_largest, largest, 1e-3),
        (report.method_rms, rms, 1e-2),
        (report.kinetic, invariant / 4.0, 1e-2),
    ] {
        assert!((found - right).abs() < tolerance * right.abs(), "{found:e} and {right:e}: {report:?}");
    }
    assert!(report.resolution.unwrap() < 1e-11 && report.range < 1e-12, "{report:?}");
    let turn = std::f64::consts::PI / x.asin();
    assert!((report.steps_per_turn.unwrap() - turn).abs() < 1e-6 * turn && report.irregular.unwrap().abs() < 1e-6);
}

/// The pendulum is nearly at rest for most of its period of 53 steps or so, and middles of windows 312 steps apart miss
/// half of what is left.
#[test]
fn the_mean_kinetic_energy_sees_all_phases() {
    for every in [10, 100, 312] {
        let verlet = stepper("stormer-verlet", "1/2", &());
        let mut motion = Motion::new(Pendulum, UnitMasses, [3.0], [0.0]).unwrap();
        let mut monitor = ShadowEnergy::new(verlet, &mut motion, &Bilinear::with_error(16)).unwrap().every(every);
        let (mut sum, steps) = (0.0, 256 * every);
        for _ in 0..steps {
            monitor.step(&mut motion).unwrap();
            sum += motion.p()[0].powi(2) / 2.0;
        }
        // 1024 independent states or more, where the standard deviation of T is 1.6 of its mean: 3 standard errors
        let (found, all) = (monitor.report().kinetic, sum / steps as f64);
        assert!((found / all - 1.0).abs() < 0.15, "every {every}: {found} and {all}");
    }
}

/// At many digits H̄ is closer to its closed form than an `f64` could show; smaller numbers than an `f64` has are
/// printed.
#[test]
fn many_digits_are_kept() {
    const DIGITS: u32 = 400;
    let verlet = stepper("stormer-verlet", "1/100000", &precision(DIGITS));
    let start = |text: &str| vec![number(text, DIGITS)];
    let potential = HarmonicOscillator { omega: number("1", DIGITS) };
    let mut motion = Motion::new(potential, UnitMasses, start("1"), start("0")).unwrap();
    let report = watched(verlet, &mut motion, &Bilinear::with_error(40), 100, 2000);
    let x = number("1/200000", DIGITS);
    let invariant: Float = 1 - x.clone().square();
    let modified = invariant.clone() * x.clone().asin() / (x * invariant.sqrt()) / 2u32;
    // the estimator is off by some (h/2)^80 = 1e-424; the states have 400 digits, which β does not divide by h here
    let off = log10_distance(&report.modified, &modified);
    assert!(off < -390.0, "10^{off}");
    let round_off = report.round_off.log10_abs();
    assert!((-402.0..-398.0).contains(&round_off), "10^{round_off}");
    let printed = report.to_string();
    assert!(printed.contains("e-40") && !printed.contains("e-324") && !printed.contains("inf"), "{printed}");
}

/// Where nothing else moves H̄, round-off does, by as much as Brouwer's law predicts.
#[test]
fn round_off_walks_as_expected() {
    for (name, set, h) in [("kepler", "0.6", "1/40"), ("kepler", "0.1", "1/200"), ("kepler", "0.3", "1/20")] {
        let report = watch(name, &[("eccentricity", set)], "stormer-verlet", h, 100_000);
        let ratio = report.range / report.round_off;
        // a walk ranges over 1.6 √n in the mean; measured are 0.6 to 6.5
        assert!((0.5..7.0).contains(&ratio), "{name} {set}, {h}: {ratio}");
        assert_ne!(report.trend, Some(Trend::Linear), "{name} {set}, {h}");
        assert_eq!(report.verdict, Verdict::Bounded);
    }
}

/// p ← (1 + δ)p at every step: H̄ grows by nδ of itself in the mean.
#[test]
fn a_steady_push_is_a_drift() {
    let verlet = stepper("stormer-verlet", "1/10", &());
    let mut motion = Motion::new(HarmonicOscillator { omega: 1.0 }, UnitMasses, [1.0], [0.0]).unwrap();
    let mut monitor = ShadowEnergy::new(verlet, &mut motion, &Bilinear::with_error(8)).unwrap().every(50);
    const STEPS: u32 = 40_000;
    for _ in 0..STEPS {
        monitor.step(&mut motion).unwrap();
        motion.p_mut()[0] *= 1.0 + 1e-8;
    }
    let report = monitor.report();
    let expected = report.modified * f64::from(STEPS) * 1e-8;
    // the accurate estimates begin and end within the first and the last 1/32 of the run
    assert!((0.9..1.01).contains(&(report.change / expected)), "{:e} and {expected:e}", report.change);
    assert_eq!(report.trend, Some(Trend::Linear));
    assert!(report.change > 1e3 * report.round_off, "{report:?}");
}

/// Of an oscillator H̄ is conserved to the last digits of 60: no bound is below the effect of round-off.
#[test]
fn no_change_is_excluded_above_less_than_round_off() {
    let context = precision(60);
    for steps in [400, 1000] {
        let (q, p) = (numbers::<Float>(&["1"], &context), numbers(&["0"], &context));
        let spring = HarmonicOscillator { omega: number("1", 60) };
        let mut motion = Motion::new(spring, UnitMasses, q, p).unwrap();
        let stepper = stepper("stormer-verlet", "1/10", &context);
        let report = watched(stepper, &mut motion, &Bilinear::with_error(24), 1, steps);
        let bound = report.permanent_bound.clone().unwrap();
        assert!(bound >= report.round_off && report.verdict == Verdict::Bounded, "{report}");
        assert!(bound.log10_abs() < -55.0, "{report}");
    }
}
