//! Protects the monitor of the modified energy: it changes no bit and costs nothing between its windows; its values are those of
//! a run; its numbers against closed forms; its verdicts on problems and hard cases; its errors and words.

use rug::Float;
use shadowstep::number::counting::{Counting, count};
use shadowstep::problems::{HarmonicOscillator, HenonHeiles, Kepler, Pendulum, ProblemMotion, problem};
use shadowstep::run::{RunError, ShadowRun};
use shadowstep::shadow::{Bilinear, Central, Course, Method, Report, ShadowEnergy, Sign, Stop, Verdict};
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Motion, Number, Potential, Scheme, UnitMasses, Weights, kinetic, potential};
use shadowstep_tests::{Bits, log10_distance, number, numbers, precision, rational, same_bits};

type Start<N, P> = Motion<N, Vec<N>, P, UnitMasses>;

fn henon_heiles<N: Number>(context: &N::Context) -> Start<N, HenonHeiles> {
    Motion::new(HenonHeiles, UnitMasses, numbers(&["0.1", "-0.3"], context), numbers(&["0.2", "0.1"], context))
}

fn scheme(name: &str) -> TableScheme {
    shipped(name).unwrap()
}

// ---------------------------------------------------------------------------------------------------------------
// Nothing changes, and nothing costs

fn keeps_all_bits<N: Bits>(context: &N::Context) {
    for name in ["symplectic-euler", "stormer-verlet", "ruth3", "yoshida4", "blanes-moan-srkn6b"] {
        let (scheme, h) = (scheme(name), rational("1/10"));
        let weights = scheme.weights::<N>(&h, context);
        for every in [1, 4, 9, 30, 100] {
            let (mut plain, mut watched) = (henon_heiles::<N>(context), henon_heiles(context));
            let mut monitor = ShadowEnergy::new(&mut watched, &h, &Bilinear::new(8)).unwrap().every(every);
            for n in 1..=250 {
                scheme.step(&weights, &mut plain);
                monitor.step(&scheme, &weights, &mut watched).unwrap();
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

/// Outside of windows a step has the operations of a plain one, and no gradient is evaluated twice.
#[test]
fn steps_between_windows_cost_what_plain_steps_cost() {
    let start = || {
        let q = [0.1, -0.3].map(Counting);
        Motion::new(HenonHeiles, UnitMasses, q, [0.2, 0.1].map(Counting))
    };
    for name in ["stormer-verlet", "yoshida4"] {
        let (scheme, h) = (scheme(name), rational("1/10"));
        let weights = scheme.weights::<Counting<f64>>(&h, &());
        let (mut plain, mut watched) = (start(), start());
        let mut monitor = ShadowEnergy::new(&mut watched, &h, &Bilinear::new(8)).unwrap().every(100);
        let (mut with_beta, mut as_plain, mut kept_rates) = (0, 0, 0);
        for _ in 0..5000 {
            let needs_beta = monitor.needs_beta();
            let ((), cost) = count(|| scheme.step(&weights, &mut plain));
            let (result, watched_cost) = count(|| monitor.step(&scheme, &weights, &mut watched).map(drop));
            result.unwrap();
            if needs_beta {
                with_beta += 1;
            } else if watched_cost == cost {
                as_plain += 1;
            } else {
                kept_rates += 1;
            }
        }
        // the first of 50 windows begins at the start; the step to the first state of another keeps its rate for the next one
        assert_eq!((with_beta, as_plain, kept_rates), (50 * 8, 5000 - 50 * 8 - 49, 49), "{name}");
        assert_eq!(watched.evaluations(), plain.evaluations(), "{name}");
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Values

/// One window in each `every` steps, with the bits of a run that estimates everywhere.
fn has_the_values_of_a_run<N: Bits>(method: &(impl Method<N> + std::fmt::Debug), context: &N::Context) {
    const STEPS: u64 = 400;
    let h = rational("1/10");
    for name in ["stormer-verlet", "ruth3"] {
        let scheme = scheme(name);
        let mut run = ShadowRun::new(&scheme, henon_heiles::<N>(context), &h, STEPS, method).unwrap();
        let mut expected = Vec::new();
        let mut energies = henon_heiles::<N>(context);
        while let Some((n, estimate)) = run.advance().unwrap() {
            assert_eq!(n, expected.len() as i64);
            let energy = energies.energy_of(estimate.q, estimate.p);
            expected.push((estimate.value.clone(), estimate.error.cloned(), energy));
        }
        let weights = scheme.weights::<N>(&h, context);
        for every in [1, 5, 60] {
            let mut motion = henon_heiles::<N>(context);
            let mut monitor = ShadowEnergy::new(&mut motion, &h, method).unwrap().every(every);
            let mut windows = 0;
            for _ in 0..STEPS {
                let Some(sample) = monitor.step(&scheme, &weights, &mut motion).unwrap() else { continue };
                let (value, error, energy) = &expected[sample.n as usize];
                let mut off = sample.energy.clone();
                off.subtract(energy);
                // in a window that is alone U = ½(qᵀU_q − rate), which rounds terms of size 0.1 once more
                let same = sample.modified.same_bits(value) && off.log10_abs() < -16.0;
                let same_error = match (sample.error, error) {
                    (Some(found), Some(error)) => found.same_bits(error),
                    (found, error) => found.is_none() && error.is_none(),
                };
                assert!(same && same_error, "{name}, {method:?}, a window in {every} steps, n = {}", sample.n);
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
    has_the_values_of_a_run::<f64>(&Central::best(10, Stop::Full), &());
    has_the_values_of_a_run::<Float>(&Bilinear::with_error(6), &precision(40));
    has_the_values_of_a_run::<Float>(&Central::best(8, Stop::Full), &precision(40));
}

// ---------------------------------------------------------------------------------------------------------------
// Numbers

/// From q = 1, p = 0 Störmer–Verlet keeps I = p² + (1 − x²)q² = 1 − x², x = h/2; then H = ½(I + x²q²) with q = cos nθ, θ = 2 arcsin x,
/// and H̄ = ½ I c with c = arcsin x/(x √(1 − x²)).
#[test]
fn the_parts_of_the_oscillator_are_in_closed_form() {
    let (h, scheme) = (rational("3/10"), scheme("stormer-verlet"));
    let mut motion = Motion::new(HarmonicOscillator { omega: 1.0 }, UnitMasses, [1.0], [0.0]);
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::with_error(8)).unwrap().every(20);
    let weights = scheme.weights::<f64>(&h, &());
    for _ in 0..40_000 {
        monitor.step(&scheme, &weights, &mut motion).unwrap();
    }
    let report = monitor.report();
    let x: f64 = 0.15;
    let invariant = 1.0 - x * x;
    let modified = invariant * x.asin() / (x * invariant.sqrt()) / 2.0;
    let (least, largest) = (invariant / 2.0 - modified, 0.5 - modified);
    let (a, b) = (least, x * x / 2.0);
    // of cos² the mean is 1/2, and of cos⁴ 3/8
    let rms = (a * a + a * b + 3.0 / 8.0 * b * b).sqrt();
    // E_8 is off by some (h/2)^16 = 1e-13; round-off walks
    assert!((report.modified - modified).abs() < 1e-12, "{} and {modified}", report.modified);
    // 2000 phases come within π/400 of all, and b changes by the square of that; means are as good as the phases are even
    for (found, right, tolerance) in [
        (report.energy_error, b, 1e-4),
        (report.method_least, least, 1e-4),
        (report.method_largest, largest, 1e-3),
        (report.method_rms, rms, 1e-2),
        (report.kinetic, invariant / 4.0, 1e-2),
    ] {
        assert!((found - right).abs() < tolerance * right.abs(), "{found:e} and {right:e}: {report:?}");
    }
    assert!(report.resolution.unwrap() < 1e-11 && report.wander < 1e-12, "{report:?}");
    let turn = std::f64::consts::PI / x.asin();
    assert!((report.steps_per_turn.unwrap() - turn).abs() < 1e-6 * turn && report.irregular.unwrap().abs() < 1e-6);
}

/// At many digits H̄ is closer to its closed form than an `f64` could say; smaller numbers than an `f64` has are printed.
#[test]
fn many_digits_are_kept() {
    const DIGITS: u32 = 400;
    let (context, h, scheme) = (precision(DIGITS), rational("1/100000"), scheme("stormer-verlet"));
    let start = |text: &str| vec![number(text, DIGITS)];
    let potential = HarmonicOscillator { omega: number("1", DIGITS) };
    let mut motion = Motion::new(potential, UnitMasses, start("1"), start("0"));
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::with_error(40)).unwrap().every(100);
    let weights = scheme.weights::<Float>(&h, &context);
    for _ in 0..2000 {
        monitor.step(&scheme, &weights, &mut motion).unwrap();
    }
    let report = monitor.report();
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

/// Where nothing else moves H̄, round-off does, and by what Brouwer's law says.
#[test]
fn round_off_walks_as_expected() {
    for (name, set, h) in [("kepler", "0.6", "1/40"), ("kepler", "0.1", "1/200"), ("kepler", "0.3", "1/20")] {
        let report = watch(name, &[("eccentricity", set)], "stormer-verlet", h, 100_000);
        let ratio = report.wander / report.round_off;
        // a walk ranges over 1.6 √n in the mean; measured are 0.6 to 6.5
        assert!((0.5..7.0).contains(&ratio), "{name} {set}, {h}: {ratio}");
        assert_ne!(report.course, Some(Course::Drift), "{name} {set}, {h}");
        assert_eq!(report.verdict, Verdict::Fine);
    }
}

/// p ← (1 + δ)p at every step: H̄ grows by nδ of itself in the mean.
#[test]
fn a_steady_push_is_a_drift() {
    let (h, scheme) = (rational("1/10"), scheme("stormer-verlet"));
    let mut motion = Motion::new(HarmonicOscillator { omega: 1.0 }, UnitMasses, [1.0], [0.0]);
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::with_error(8)).unwrap().every(50);
    let weights = scheme.weights::<f64>(&h, &());
    const STEPS: u32 = 40_000;
    for _ in 0..STEPS {
        monitor.step(&scheme, &weights, &mut motion).unwrap();
        motion.p_mut()[0] *= 1.0 + 1e-8;
    }
    let report = monitor.report();
    let expected = report.modified * f64::from(STEPS) * 1e-8;
    // the quiet estimates begin and end within the first and the last 1/32 of the run
    assert!((0.9..1.01).contains(&(report.change / expected)), "{:e} and {expected:e}", report.change);
    assert_eq!(report.course, Some(Course::Drift));
    assert!(report.change > 1e3 * report.round_off, "{report:?}");
}

// ---------------------------------------------------------------------------------------------------------------
// Verdicts

/// A shipped problem with a window in 20 steps, by E_8 and its error.
fn watch(name: &str, set: &[(&str, &str)], scheme: &str, h: &str, steps: u64) -> Report<f64> {
    watch_by(&Bilinear::with_error(8), name, set, scheme, h, steps)
}

fn watch_by(
    method: &Bilinear,
    name: &str,
    set: &[(&str, &str)],
    scheme_name: &str,
    h: &str,
    steps: u64,
) -> Report<f64> {
    let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let mut motion: ProblemMotion<f64> = problem(name).unwrap().setup(&set, 30).unwrap().motion(&()).unwrap();
    let (scheme, h) = (scheme(scheme_name), rational(h));
    let mut monitor = ShadowEnergy::new(&mut motion, &h, method).unwrap().every(20);
    let weights = scheme.weights::<f64>(&h, &());
    for _ in 0..steps {
        monitor.step(&scheme, &weights, &mut motion).unwrap();
    }
    monitor.report()
}

fn verdicts(expected: Verdict, name: &str, cases: &[(&[(&str, &str)], &str)]) {
    for (set, h) in cases {
        let report = watch(name, set, "stormer-verlet", h, 20_000);
        assert_eq!(report.verdict, expected, "{name} {set:?}, h = {h}: {report}");
    }
}

const FINE: Verdict = Verdict::Fine;
const MOVES: Verdict = Verdict::TooLarge(Sign::Moved);
const ENERGY_ERROR: Verdict = Verdict::TooLarge(Sign::EnergyError);

#[test]
fn the_oscillator() {
    verdicts(FINE, "harmonic-oscillator", &[(&[], "0.1"), (&[], "0.5"), (&[], "0.8")]);
    // 2 sin(π/5), 2 sin(π/4), 2 sin(π/3): a linear oscillator has no resonances, but large errors
    let large = ["1.1755705", "1.41421356", "1.7320508", "1.9", "1.99"];
    verdicts(ENERGY_ERROR, "harmonic-oscillator", &large.map(|h| (&[] as &[_], h)));
}

#[test]
fn the_pendulum_and_its_resonances() {
    let of = |p| [("p", p)];
    verdicts(FINE, "pendulum", &[(&of("0.3"), "0.8"), (&of("1"), "0.5"), (&of("2"), "0.1"), (&of("2.5"), "0.3")]);
    verdicts(Verdict::NearResonance { turns: 1, steps: 4 }, "pendulum", &[(&of("0.3"), "1.42")]);
    verdicts(ENERGY_ERROR, "pendulum", &[(&of("0.3"), "0.95"), (&of("0.3"), "1.2"), (&of("0.3"), "1.73")]);
    verdicts(MOVES, "pendulum", &[(&of("1"), "1.5"), (&of("2.5"), "1.5")]);
    verdicts(Verdict::TooLarge(Sign::NotResolved), "pendulum", &[(&of("1"), "1.25")]);
    // a weak resonance: seen with more states, and gone at a step that is a little larger
    let by_sixteen = |h| watch_by(&Bilinear::with_error(16), "pendulum", &[("p", "0.3")], "stormer-verlet", h, 20_000);
    assert_eq!(by_sixteen("1.01").verdict, Verdict::NearResonance { turns: 1, steps: 6 });
    assert_eq!(by_sixteen("1.05").verdict, ENERGY_ERROR);
}

#[test]
fn kepler() {
    let of = |e| [("eccentricity", e)];
    let fine: [(&[_], &str); 6] = [
        (&of("0.6"), "1/100"),
        (&of("0.6"), "1/20"),
        (&of("0.6"), "1/10"),
        (&of("0"), "1/20"),
        (&of("0.9"), "1/200"),
        (&of("0.9"), "1/2000"),
    ];
    verdicts(FINE, "kepler", &fine);
    verdicts(MOVES, "kepler", &[(&of("0.6"), "1/5"), (&of("0.6"), "1/4")]);
    // thrown out by the first steps
    verdicts(ENERGY_ERROR, "kepler", &[(&of("0.6"), "1/3"), (&of("0.9"), "1/20"), (&of("0.99"), "1/20")]);
    verdicts(Verdict::RoundOff, "kepler", &[(&of("0"), "1/2000")]);
    for (scheme, h, expected) in
        [("yoshida4", "1/20", FINE), ("yoshida4", "1/5", MOVES), ("blanes-moan-s6", "1/200", FINE)]
    {
        assert_eq!(watch("kepler", &[], scheme, h, 20_000).verdict, expected, "{scheme}, h = {h}");
    }
}

#[test]
fn henon_heiles_regular_and_chaotic() {
    let (regular, chaotic) = ([("px", "0.1")], [("px", "0.5"), ("py", "0.2")]);
    verdicts(FINE, "henon-heiles", &[(&regular, "1/10"), (&regular, "1/2"), (&chaotic, "1/10"), (&chaotic, "1/2")]);
    verdicts(ENERGY_ERROR, "henon-heiles", &[(&regular, "1")]);
    let more = [("px", "0.3"), ("py", "0.3")];
    let report = watch("henon-heiles", &more, "stormer-verlet", "0.9", 50_000);
    assert_eq!(report.verdict, MOVES, "{report}");
}

#[test]
fn many_bodies() {
    verdicts(FINE, "pythagorean", &[(&[], "1/10000")]);
    verdicts(MOVES, "pythagorean", &[(&[], "1/1000"), (&[], "1/100")]);
    verdicts(FINE, "fput-stiff", &[(&[], "0.001"), (&[], "0.02")]);
    verdicts(ENERGY_ERROR, "fput-stiff", &[(&[], "0.03")]);
    verdicts(FINE, "outer-solar-system", &[(&[], "100"), (&[], "200")]);
    verdicts(MOVES, "outer-solar-system", &[(&[], "800")]);
    verdicts(FINE, "argon-crystal", &[(&[], "4e-5")]);
    verdicts(MOVES, "argon-crystal", &[(&[], "1e-4")]);
}

/// A body that nothing pulls has an energy error of 0, of which nothing is a part.
#[test]
fn free_motion_is_fine() {
    potential! { struct Nothing; U(x) = 0*x }
    let (scheme, h) = (scheme("stormer-verlet"), rational("1/4"));
    let mut motion = Motion::new(Nothing, UnitMasses, [0.0], [1.0]);
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::with_error(4)).unwrap();
    let weights = scheme.weights::<f64>(&h, &());
    for n in 1..=100 {
        monitor.step(&scheme, &weights, &mut motion).unwrap();
        // with windows of 11 states the 16th ends at n = 25
        let report = monitor.report();
        assert_eq!(report.verdict == Verdict::Undecided, n < 25, "n = {n}");
        assert!(!report.to_string().is_empty());
    }
    assert_eq!(monitor.report().verdict, Verdict::Fine);
}

/// A kinetic energy of any kind, by a scheme for it.
#[test]
fn any_kinetic_energy() {
    kinetic! { struct Relativistic; T(p) = sqrt(1 + p^2) }
    potential! { struct Spring; U(q) = q^2/2 }
    let scheme = scheme("yoshida4").for_every_kinetic().unwrap();
    let h = rational("1/10");
    let mut motion = Motion::new(Spring, Relativistic, [1.0], [0.0]);
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::with_error(8)).unwrap().every(40);
    let weights = scheme.weights::<f64>(&h, &());
    for _ in 0..8000 {
        monitor.step(&scheme, &weights, &mut motion).unwrap();
    }
    let report = monitor.report();
    assert!(report.verdict == Verdict::Fine && report.moved < 1e-4 * report.energy_error, "{report}");
}

// ---------------------------------------------------------------------------------------------------------------
// Loops that are not what the monitor was told

/// Steps of the size h, watched by a monitor that was told `told`; each step is made by `step`, which is told whether β is needed.
fn watch_loop<N: Number, P: Potential<N>>(
    mut motion: Start<N, P>,
    (h, told): (&str, &str),
    steps: u64,
    mut step: impl FnMut(&TableScheme, &Weights<Vec<N>>, &mut Start<N, P>, bool),
) -> Report<N> {
    let (context, scheme) = (motion.context(), scheme("stormer-verlet"));
    let mut monitor = ShadowEnergy::new(&mut motion, &rational(told), &Bilinear::with_error(8)).unwrap().every(20);
    let weights = scheme.weights::<N>(&rational(h), &context);
    for _ in 0..steps {
        step(&scheme, &weights, &mut motion, monitor.needs_beta());
        monitor.observe(&mut motion).unwrap();
    }
    monitor.report()
}

/// As the monitor asks.
fn as_asked<N: Number, P: Potential<N>>(
    scheme: &TableScheme,
    weights: &Weights<Vec<N>>,
    motion: &mut Start<N, P>,
    needs_beta: bool,
) {
    if needs_beta { scheme.step_augmented(weights, motion) } else { scheme.step(weights, motion) }
}

/// Eccentricity 0.6.
fn comet<N: Number>(context: &N::Context) -> Start<N, Kepler> {
    Motion::new(Kepler, UnitMasses, numbers(&["0.4", "0"], context), numbers(&["0", "2"], context))
}

const TWENTIETH: (&str, &str) = ("1/20", "1/20");

#[test]
fn a_forgotten_beta_is_seen() {
    let plain =
        watch_loop::<f64, _>(comet(&()), TWENTIETH, 4000, |scheme, weights, motion, _| scheme.step(weights, motion));
    assert_eq!((plain.verdict, plain.misfits), (Verdict::Inconsistent, plain.windows), "{plain}");
    assert!(plain.reason().contains("needs_beta()"), "{plain}");
    // asked for the step before: the first step of each window has no β, and the first window's second
    let mut asked = true;
    let late = watch_loop::<f64, _>(comet(&()), TWENTIETH, 4000, |scheme, weights, motion, needs_beta| {
        as_asked(scheme, weights, motion, std::mem::replace(&mut asked, needs_beta));
    });
    assert_eq!(late.verdict, Verdict::Inconsistent, "{late}");
    // other numbers keep no increments of q and p, and H̄ has to show it
    let context = precision(30);
    let kepler = watch_loop::<Float, _>(comet(&context), TWENTIETH, 1000, |scheme, weights, motion, _| {
        scheme.step(weights, motion);
    });
    assert_eq!((kepler.verdict, kepler.misfits), (Verdict::Inconsistent, 0), "{kepler}");
    assert!(kepler.reason().starts_with("the states do not come from steps of this h that carry β"), "{kepler}");
    let tenth = ("1/10", "1/10");
    let henon = watch_loop::<Float, _>(henon_heiles(&context), tenth, 1000, |scheme, weights, motion, _| {
        scheme.step(weights, motion);
    });
    assert_eq!(henon.verdict, Verdict::TooLarge(Sign::NotResolved), "{henon}");
    assert!(henon.reason().ends_with("or β was not carried"), "{henon}");
}

#[test]
fn another_step_size_than_told_is_seen() {
    for told in ["1/10", "1/40", "1/19", "1/22"] {
        let report = watch_loop::<f64, _>(comet(&()), ("1/20", told), 4000, as_asked);
        assert_eq!((report.verdict, report.misfits), (Verdict::Inconsistent, 0), "told {told}: {report}");
    }
    let circle = Motion::new(Kepler, UnitMasses, vec![1.0, 0.0], vec![0.0, 1.0]);
    let report = watch_loop(circle, ("1/20", "1/19"), 4000, as_asked);
    assert_eq!(report.verdict, Verdict::Inconsistent, "{report}");
}

/// H − H̄ of a circular orbit never is 0, while H stays: by whatever scheme, and by estimators that are themselves off.
#[test]
fn a_circle_is_not_taken_for_another_loop() {
    let watch_circle = |scheme_name: &str, h: &str, method: &Bilinear| {
        let (scheme, h) = (scheme(scheme_name), rational(h));
        let mut motion = Motion::new(Kepler, UnitMasses, [1.0, 0.0], [0.0, 1.0]);
        let mut monitor = ShadowEnergy::new(&mut motion, &h, method).unwrap().every(20);
        let weights = scheme.weights::<f64>(&h, &());
        for _ in 0..1000 {
            monitor.step(&scheme, &weights, &mut motion).unwrap();
        }
        let report = monitor.report();
        assert_ne!(report.verdict, Verdict::Inconsistent, "{scheme_name}, h = {h}, {method:?}: {report}");
        report.verdict
    };
    for h in ["1/20", "1/5", "2/5"] {
        for name in ["symplectic-euler", "stormer-verlet", "ruth3", "yoshida4", "mclachlan-s2", "mclachlan-atela2"] {
            assert_eq!(watch_circle(name, h, &Bilinear::with_error(8)), FINE, "{name}, h = {h}");
        }
        for method in [1, 2, 3, 4, 5].into_iter().flat_map(|k| [Bilinear::new(k), Bilinear::with_error(k)]) {
            watch_circle("stormer-verlet", h, &method);
        }
    }
}

/// p ← (1 − δ)p after each step, with δ far above round-off and far below what a step does.
#[test]
fn a_weak_drag_is_a_drift() {
    for drag in [1e-9, 1e-6] {
        let report = watch_loop::<f64, _>(comet(&()), TWENTIETH, 20_000, |scheme, weights, motion, needs_beta| {
            as_asked(scheme, weights, motion, needs_beta);
            motion.p_mut().iter_mut().for_each(|p| *p *= 1.0 - drag);
        });
        assert_eq!((report.verdict, report.course), (Verdict::Drifts, Some(Course::Drift)), "{drag}: {report}");
        let reason = report.reason();
        assert!(reason.contains("steadily") && !reason.contains("bounded"), "{reason}");
    }
    // within windows changes of a thousandth of a step and more are seen at once
    let strong = watch_loop::<f64, _>(comet(&()), TWENTIETH, 2000, |scheme, weights, motion, needs_beta| {
        as_asked(scheme, weights, motion, needs_beta);
        motion.p_mut().iter_mut().for_each(|p| *p *= 1.0 - 1e-3);
    });
    assert_eq!(strong.verdict, Verdict::Inconsistent, "{strong}");
}

/// The slow oscillation of the planets' H̄ looks like a drift for a while: that is no push, but not called bounded either.
#[test]
fn a_slow_oscillation_is_no_push() {
    for (h, steps) in
        [("200", 5000), ("200", 10_000), ("200", 20_000), ("300", 20_000), ("400", 20_000), ("600", 20_000)]
    {
        let report = watch("outer-solar-system", &[], "stormer-verlet", h, steps);
        assert_eq!(report.verdict, Verdict::Fine, "h = {h}, {steps} steps: {report}");
        if report.course == Some(Course::Drift) {
            assert!(!report.reason().contains("bounded"), "{report}");
        }
    }
}

/// A momentum that is kicked once, between windows, and an angle that is wrapped where the potential has no such period.
#[test]
fn a_moved_state_is_named_as_a_cause() {
    let (mut n, mut kicked) = (0, false);
    let report = watch_loop::<f64, _>(comet(&()), TWENTIETH, 4000, |scheme, weights, motion, needs_beta| {
        as_asked(scheme, weights, motion, needs_beta);
        n += 1;
        if n >= 2000 && !needs_beta && !kicked {
            motion.p_mut()[0] += 0.02;
            kicked = true;
        }
    });
    assert!(kicked && report.misfits == 0, "{report}");
    assert_eq!(report.verdict, MOVES, "{report}");
    assert!(report.reason().contains("something other than the scheme moved the state"), "{report}");
}

/// An angle that is wrapped leaves H and its gradient as they are, but not β, nor H̄ as the estimator sees it.
#[test]
fn a_wrapped_angle_is_seen() {
    let rotor = Motion::new(Pendulum, UnitMasses, vec![0.0], vec![2.5]);
    let report = watch_loop::<f64, _>(rotor, TWENTIETH, 4000, |scheme, weights, motion, needs_beta| {
        as_asked(scheme, weights, motion, needs_beta);
        let turns = (motion.q()[0] / std::f64::consts::TAU).round();
        motion.q_mut()[0] -= turns * std::f64::consts::TAU;
    });
    assert_eq!(report.verdict, Verdict::Inconsistent, "{report}");
    assert!((1..report.windows).contains(&report.misfits), "{report}");
    assert!(report.reason().ends_with("or q or p were changed between the steps"), "{report}");
}

/// E_1 has no errors, with or without: what it does not know it says.
#[test]
fn unknown_errors_are_named() {
    for method in [Bilinear::new(1), Bilinear::with_error(1)] {
        let report = watch_by(&method, "kepler", &[], "stormer-verlet", "1/20", 4000);
        assert_eq!(report.verdict, MOVES, "{report}");
        assert!(report.reason().contains("this estimator gives no errors"), "{report}");
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Errors and words

/// Oscillator steps until `steps` are made or one is not finite.
fn oscillate(omega: f64, h: &str, steps: u64, every: u64) -> (Report<f64>, Option<RunError>) {
    let (scheme, h) = (scheme("stormer-verlet"), rational(h));
    let mut motion = Motion::new(HarmonicOscillator { omega }, UnitMasses, [1.0], [0.0]);
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::with_error(8)).unwrap().every(every);
    let weights = scheme.weights::<f64>(&h, &());
    let error = (0..steps).find_map(|_| monitor.step(&scheme, &weights, &mut motion).map(drop).err());
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
        assert_eq!(report.verdict, Verdict::TooLarge(Sign::NotFinite), "{report}");
        assert!(report.reason().contains(&format!("not finite since step {step}")), "{report}");
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
    assert_eq!(before.verdict, Verdict::Undecided);
    has_no_strange_numbers(&before);
    for q in [0.0, 0.1] {
        potential! { struct Flat; U(x) = 0*x }
        let rest = watch_loop(Motion::new(Flat, UnitMasses, vec![q], vec![0.0]), TWENTIETH, 1000, as_asked);
        assert_eq!(rest.verdict, Verdict::Fine, "{rest}");
        has_no_strange_numbers(&rest);
    }
    let bottom = Motion::new(HarmonicOscillator { omega: 1.0 }, UnitMasses, vec![0.0], vec![0.0]);
    let rest = watch_loop(bottom, TWENTIETH, 1000, as_asked);
    assert_eq!(rest.verdict, Verdict::Fine, "{rest}");
    has_no_strange_numbers(&rest);
}

#[test]
fn what_is_not_finite_has_its_step() {
    // at q = 2 the kick makes p = −7/4 − 1/4 = −2, and the drift ends in q = 0: the force of step 2 is 0/0
    let start = || Motion::new(Kepler, UnitMasses, vec![2.0, 0.0], vec![-1.75, 0.0]);
    let (scheme, h) = (scheme("symplectic-euler"), rational("1"));
    let weights = scheme.weights::<f64>(&h, &());
    for every in [1, 50] {
        let mut motion = start();
        let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::new(4)).unwrap().every(every);
        let error = (0..200).find_map(|_| monitor.step(&scheme, &weights, &mut motion).map(drop).err());
        let Some(RunError::NotFinite { step, what }) = error else { panic!("it goes on") };
        assert!(step == 2 && what.contains(" = "), "step {step}: {what}");
    }
    // between windows it is found by the next one: here after the first window, of the states 0 to 4
    let mut motion = start();
    motion.q_mut()[0] = 20.0;
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::new(4)).unwrap().every(50);
    let mut error = None;
    for n in 1..200 {
        if n == 10 {
            motion.q_mut()[1] = f64::NAN;
        }
        if let Err(found) = monitor.step(&scheme, &weights, &mut motion) {
            error = Some((n, found));
            break;
        }
    }
    let Some((n, RunError::NotFinite { step, .. })) = error else { panic!("it goes on") };
    assert!((50..100).contains(&step) && step == n, "step {step}, n = {n}");
}

#[test]
fn what_cannot_be_meant_is_refused() {
    let mut motion = Motion::new(Kepler, UnitMasses, vec![1.0, 0.0], vec![0.0, 1.0]);
    let error = ShadowEnergy::new(&mut motion, &rational("0"), &Bilinear::new(4)).map(drop).unwrap_err();
    assert_eq!(error, RunError::ZeroStep);
    let mut centre = Motion::new(Kepler, UnitMasses, vec![0.0, 0.0], vec![0.0, 1.0]);
    let error = ShadowEnergy::new(&mut centre, &rational("1"), &Bilinear::new(4)).map(drop).unwrap_err();
    assert!(matches!(error, RunError::NotFinite { step: 0, .. }), "{error}");
}

/// The report that the documentation of `ShadowEnergy` shows.
#[test]
fn a_report_reads() {
    let documentation = include_str!("../../runtime/src/shadow/monitor.rs");
    let (_, shown) = documentation.split_once("```text\n").unwrap();
    let (shown, _) = shown.split_once("/// ```").unwrap();
    let shown: Vec<&str> = shown.lines().map(|line| line.trim_start_matches("/// ")).collect();

    let (scheme, h) = (scheme("stormer-verlet"), rational("1/20"));
    let weights = scheme.weights::<f64>(&h, &());
    let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]);
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::with_error(8)).unwrap().every(100);
    for _ in 0..20_000 {
        monitor.step(&scheme, &weights, &mut motion).unwrap();
    }
    let printed = monitor.report().to_string();
    let trimmed = |lines: &[&str]| lines.iter().map(|line| line.trim().to_owned()).collect::<Vec<_>>();
    assert_eq!(trimmed(&printed.lines().collect::<Vec<_>>()), trimmed(&shown), "{printed}");
}

/// Every verdict says why, with numbers.
#[test]
fn verdicts_say_why() {
    let cases = [
        ("kepler", "1/20", "moved by", "bounded"),
        ("kepler", "1/5", "nothing near the energy is conserved", "something other than the scheme moved the state"),
        ("kepler", "1/3", "the energy error is", "of the mean kinetic energy"),
    ];
    for (name, h, begin, end) in cases {
        let reason = watch(name, &[], "stormer-verlet", h, 5000).reason();
        assert!(reason.contains(begin) && reason.ends_with(end), "{reason}");
        assert!(reason.contains(|c: char| c.is_ascii_digit()), "{reason}");
    }
    let few = watch("kepler", &[], "stormer-verlet", "1/20", 100);
    assert_eq!(few.reason(), "16 windows make a verdict, and there are 5");
}
