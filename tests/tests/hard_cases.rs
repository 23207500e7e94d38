//! Protects runs that go wrong, or nearly: they end with a sentence that names the step, or go on without a panic, and
//! say the same on every run.

use rug::Float;
use shadowstep::problems::{HarmonicOscillator, HenonHeiles, Kepler, Pendulum};
use shadowstep::shadow::run::{EnergyDrift, Quantity, RunError, ShadowRun, energy_drift};
use shadowstep::shadow::{Central, SelectionRule, ShadowEnergy, StoppingRule};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{Carried, Kinetic, Motion, MotionError, Potential, Real, System, UnitMasses};
use shadowstep_tests::{Bits, log10_largest_distance, numbers, precision, stepper};

type State<P, N> = Motion<N, Vec<N>, P, UnitMasses>;

fn state<P: Potential<N>, N: Real>(potential: P, q: &[&str], p: &[&str], context: &N::Context) -> State<P, N> {
    Motion::new(potential, UnitMasses, numbers(q, context), numbers(p, context)).unwrap()
}

/// The orbit of eccentricity e = 1 − gap, from its pericentre.
fn kepler<N: Real>(gap: &str, context: &N::Context) -> State<Kepler, N> {
    state(Kepler, &[gap, "0"], &["0", &format!("sqrt((2 - {gap})/{gap})")], context)
}

fn drift<P: Potential<N>, K: Kinetic<N, Class = Quadratic>, N: Real>(
    scheme: &str,
    motion: Motion<N, Vec<N>, P, K>,
    h: &str,
    steps: u64,
    m: u32,
) -> Result<EnergyDrift<N>, RunError> {
    let stepper = stepper(scheme, h, &motion.context());
    energy_drift(stepper.with(motion), steps, &Central::fixed(m))
}

// ---------------------------------------------------------------------------------------------------------------
// Values that are not finite

/// Straight into the centre, with a step that hits it exactly.
#[test]
fn a_head_on_collision_names_its_step() {
    // at q = 2 the kick makes p = −7/4 − 1/4 = −2, and the drift ends in q = 0: the force of step 2 is 0/0
    for reach in [1, 3] {
        let start = state::<_, f64>(Kepler, &["2", "0"], &["-7/4", "0"], &());
        let error = drift("symplectic-euler", start, "1", 20, reach).unwrap_err();
        let RunError::NotFinite { step, value } = &error else { panic!("the settings are valid") };
        assert_eq!(*step, 2, "{error}");
        assert!(matches!(value.quantity, Quantity::Position(0) | Quantity::Momentum(0)), "{error}");
        let what = value.to_string();
        assert!(what.starts_with("q1 = ") || what.starts_with("p1 = "), "{error}");
        let sentence = error.to_string();
        assert!(sentence.starts_with(&format!("the run stopped at step 2: {what}; ")), "{sentence}");
    }
    let start = state::<_, Float>(Kepler, &["2", "0"], &["-7/4", "0"], &precision(120));
    let RunError::NotFinite { step, .. } = drift("symplectic-euler", start, "1", 20, 3).unwrap_err() else {
        panic!("the settings are valid")
    };
    assert_eq!(step, 2, "the same at 120 digits");
}

/// r² overflows, so 1/r is 0: the energy would be a free body's.
#[test]
fn positions_whose_squares_overflow_are_refused() {
    let start =
        |x: &str| Motion::of_any_energy(Kepler, UnitMasses, vec![x.parse().unwrap(), 0.0], vec![0.0, 1.0]).unwrap();
    let error = drift("stormer-verlet", start("-1e160"), "1/10", 5, 2).unwrap_err().to_string();
    let sentence =
        "the run stopped at step 0: q1 = -1e160, whose square overflows; choose other initial values or parameters";
    assert_eq!(error, sentence);
    assert!(start("1e160").energy().is_nan() && start("1e160").energy_at(&[1.0, 0.0], &[0.0, 1.0]) == -0.5);
    assert_eq!(start("3e153").energy(), 0.5);
    // where the gradient is kept, the energy follows from it
    let mut kicked = start("1e160");
    kicked.kick(&0.0, Carried::Increments);
    let [mut energy, mut kinetic] = [0.0; 2];
    kicked.assign_energy(None, &mut energy);
    kicked.assign_kinetic_energy(None, &mut kinetic);
    assert!(energy.is_nan() && kinetic == 0.5);
    let monitor = ShadowEnergy::new(stepper("stormer-verlet", "1/10", &()), &mut kicked, &Central::fixed(2));
    assert!(monitor.err().unwrap().to_string().contains("q1 = 1e160, whose square overflows"));
    // numbers with larger exponents have r²
    let far = state::<_, Float>(Kepler, &["1e160", "0"], &["0", "0"], &precision(30)).energy();
    assert!((far.log10_abs() + 160.0).abs() < 1e-12, "{far}");
}

/// The state that is not finite may lie before the start, where an estimator needs states too.
#[test]
fn a_collision_before_the_start_has_a_negative_step() {
    // the inverse of symplectic Euler drifts first: from q = 1 back to 1 − 1·1 = 0
    let start = state::<_, f64>(Kepler, &["1", "0"], &["1", "0"], &());
    let RunError::NotFinite { step, value } = drift("symplectic-euler", start, "1", 5, 2).unwrap_err() else {
        panic!("the settings are valid")
    };
    assert_eq!(step, -1, "{value}");
}

/// H = 1/6 is where Hénon–Heiles opens: far above it q runs away and overflows within a few dozen steps.
#[test]
fn an_escape_ends_with_its_step() {
    let start = state::<_, f64>(HenonHeiles, &["0", "0"], &["0", "2"], &());
    let error = drift("yoshida4", start.clone(), "1/4", 1000, 2).unwrap_err();
    let RunError::NotFinite { step, .. } = &error else { panic!("the settings are valid") };
    assert!((1..100).contains(step), "{error}");

    // the states before that one are finite, the one after the last of them is not
    let stepper = stepper("yoshida4", "1/4", &());
    let mut motion = start;
    for _ in 1..*step {
        stepper.step_augmented(&mut motion);
        assert!(motion.is_finite());
    }
    assert!(motion.q()[1].abs() > 1e10, "it ran away before it overflowed: {:?}", motion.q());
    stepper.step_augmented(&mut motion);
    assert!(!motion.is_finite());

    // below 1/6 the same run stays
    let bound = state::<_, f64>(HenonHeiles, &["0", "0"], &["0", "0.5"], &());
    assert!(drift("yoshida4", bound, "1/4", 1000, 2).is_ok());
}

// ---------------------------------------------------------------------------------------------------------------
// Close encounters

/// Steps that cannot resolve the pericentre: the run goes on, and its drift shows that nothing is conserved.
#[test]
fn eccentric_orbits_run_through() {
    for (gap, least) in [("0.1", 1e-3), ("0.01", 1e-1)] {
        let start = kepler::<f64>(gap, &());
        let best = Central::best(30, StoppingRule::Full);
        let found = energy_drift(stepper("stormer-verlet", "1/20", &()).with(start), 2000, &best).unwrap();
        assert!(found.drift.is_finite() && found.drift > least, "1 − e = {gap}: {:e}", found.drift);
        assert!(found.minimum <= found.first && found.last <= found.maximum);
    }
    // small steps do resolve e = 0.9
    let start = kepler::<f64>("0.1", &());
    let found = drift("blanes-moan-srkn6b", start, "1/2000", 4000, 8).unwrap();
    assert!(found.drift < 1e-9, "{:e}", found.drift);
}

// ---------------------------------------------------------------------------------------------------------------
// The limit of stability, the separatrix, backward steps

#[test]
fn above_the_limit_the_run_says_so() {
    let potential = HarmonicOscillator { omega: 1.0 };
    let start: State<_, f64> = state(potential, &["1"], &["0"], &());
    let RunError::NotFinite { step, value } = drift("stormer-verlet", start, "2.1", 100_000, 2).unwrap_err() else {
        panic!("the settings are valid")
    };
    // growth per step: μ with μ + 1/μ = 2.1² − 2, μ = 1.88; the squares in the modified energy overflow at
    // q = 1e154 = 1.88^563, and each estimate needs two states on
    assert!((555..575).contains(&step) && value.quantity == Quantity::ModifiedEnergy, "{step}: {value}");
}

/// On the separatrix every error decides whether the pendulum turns over; the modified energy stays.
#[test]
fn separatrix_of_the_pendulum() {
    let start = state::<_, Float>(Pendulum, &["0"], &["2"], &precision(60));
    let found = drift("stormer-verlet", start, "1/20", 2000, 20).unwrap();
    // D_20 is off by about (20!)² (h/ρ)^40 with ρ = π/2, the distance of the singularities in complex time: 1e-23
    assert!(found.drift.to_f64() < 1e-20, "{:e}", found.drift.to_f64());
}

/// A run with steps −h goes back where a run with steps h came from, with the same modified energy for a palindrome.
#[test]
fn negative_steps_go_back() {
    let context = precision(60);
    let [forth, back] = ["1/20", "-1/20"].map(|h| stepper::<Float>("yoshida4", h, &context));
    let start = state::<_, Float>(HenonHeiles, &["0.1", "0"], &["0.2", "0.3"], &context);
    let mut motion = start.clone();
    for _ in 0..100 {
        forth.step(&mut motion);
    }
    let turned = motion.clone();
    for _ in 0..100 {
        back.step(&mut motion);
    }
    // round-off of two hundred steps
    assert!(log10_largest_distance(motion.q(), start.q()) < -56.0);

    let [one, other] = [(start, &forth), (turned, &back)]
        .map(|(motion, stepper)| energy_drift(stepper.with(motion), 100, &Central::fixed(15)).unwrap());
    // the same states in the other direction
    for (a, b) in [(&one.first, &other.last), (&one.last, &other.first), (&one.drift, &other.drift)] {
        let off = shadowstep_tests::log10_distance(a, b);
        assert!(off < -54.0, "10^{off}");
    }
}

/// No step at all: one state, no drift.
#[test]
fn a_run_of_no_steps_has_one_state() {
    let found = drift("stormer-verlet", kepler::<f64>("0.4", &()), "1/20", 0, 4).unwrap();
    assert_eq!((found.drift, found.at_minimum, found.at_maximum), (0.0, 0, 0));
    assert_eq!(found.first.to_bits(), found.last.to_bits());
}

// ---------------------------------------------------------------------------------------------------------------
// Reproducible and long

fn runs_are_reproducible<N: Bits + Send>(context: &N::Context)
where
    N::Context: Send + Sync,
{
    let values = || -> Vec<(N, N, u32)> {
        let stepper = stepper("blanes-moan-s6", "1/20", context);
        let best = Central::best_with_error(20, StoppingRule::Early, SelectionRule::Least);
        let mut run = ShadowRun::new(stepper.with(kepler::<N>("0.4", context)), 100, &best).unwrap();
        let mut values = Vec::new();
        while let Some((_, estimate)) = run.advance().unwrap() {
            values.push((estimate.value.clone(), estimate.error.expect("it was asked for").clone(), estimate.order));
        }
        values
    };
    let here = values();
    let elsewhere = std::thread::scope(|scope| {
        let threads = [scope.spawn(values), scope.spawn(values)];
        threads.map(|thread| thread.join().expect("no panic"))
    });
    for other in elsewhere {
        assert_eq!(here.len(), other.len());
        for (one, other) in here.iter().zip(&other) {
            assert!(one.0.same_bits(&other.0) && one.1.same_bits(&other.1) && one.2 == other.2);
        }
    }
}

#[test]
fn the_same_run_gives_the_same_bits_on_every_thread() {
    runs_are_reproducible::<f64>(&());
    runs_are_reproducible::<Float>(&precision(120));
}

/// β as one running sum would grow with time and lose its last digits; counted from step to step it does not.
#[test]
fn long_runs_keep_the_digits_of_beta() {
    const STEPS: u64 = 300_000;
    let stepper = stepper("stormer-verlet", "1/20", &());
    let start = state::<_, f64>(Pendulum, &["0"], &["1"], &());
    let mut run = ShadowRun::new(stepper.with(start), STEPS, &Central::fixed(10)).unwrap();
    let mut values = Vec::new();
    while let Some((_, estimate)) = run.advance().unwrap() {
        values.push(*estimate.value);
    }
    // Within windows of a hundred steps: the random walk of round-off in q and p, which is a property of the
    // trajectory, moves the energy much less there than the noise of the estimate.
    let scatter = |window: &[f64]| {
        let mean = window.iter().sum::<f64>() / window.len() as f64;
        (window.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / window.len() as f64).sqrt()
    };
    let (early, late) = (scatter(&values[..100]), scatter(&values[values.len() - 100..]));
    println!("scatter {early:e} at first, {late:e} after {STEPS} steps");
    // Now: last places of q and p, about 1e-16, over h = 1/20. A running sum would have grown to |β| = 10⁴, whose last
    // place of 2e-12 over h makes 1e-11 late in the run.
    assert!(early < 5e-15 && late < 5e-15, "{early:e}, {late:e}");
}

/// At the singularity already.
#[test]
fn starts_of_infinite_energy_are_refused() {
    for q in [[0.0; 2], [1e160, 0.0]] {
        let error = Motion::new(Kepler, UnitMasses, q, [1.0, 0.0]).map(drop).unwrap_err();
        assert_eq!(error, MotionError::Energy);
        let sentence = "the energy is not finite at the initial values; choose other initial values or parameters";
        assert_eq!(error.to_string(), sentence);
    }
    let start = Motion::of_any_energy(Kepler, UnitMasses, vec![0.0; 2], vec![1.0, 0.0]).unwrap();
    assert!(matches!(drift("stormer-verlet", start, "1/10", 10, 3), Err(RunError::NotFinite { step: 0, .. })));
}
