//! Verdicts on problems and hard cases.

use super::*;

fn verdicts(expected: Verdict, name: &str, cases: &[(&[(&str, &str)], &str)]) {
    for (set, h) in cases {
        let report = watch(name, set, "stormer-verlet", h, 20_000);
        assert_eq!(report.verdict, expected, "{name} {set:?}, h = {h}: {report}");
    }
}

#[test]
fn the_oscillator() {
    verdicts(BOUNDED, "harmonic-oscillator", &[(&[], "0.1"), (&[], "0.5"), (&[], "0.8")]);
    // 2 sin(π/5), 2 sin(π/4), 2 sin(π/3): a linear oscillator has no resonances, but large errors
    let large = ["1.1755705", "1.41421356", "1.7320508", "1.9", "1.99"];
    verdicts(ENERGY_ERROR, "harmonic-oscillator", &large.map(|h| (&[] as &[_], h)));
}

#[test]
fn the_pendulum_and_its_resonances() {
    let of = |p| [("p", p)];
    verdicts(BOUNDED, "pendulum", &[(&of("0.3"), "0.8"), (&of("1"), "0.5"), (&of("2"), "0.1"), (&of("2.5"), "0.3")]);
    verdicts(Verdict::NearResonance { turns: 1, steps: 4 }, "pendulum", &[(&of("0.3"), "1.42")]);
    verdicts(ENERGY_ERROR, "pendulum", &[(&of("0.3"), "0.95"), (&of("0.3"), "1.2"), (&of("0.3"), "1.73")]);
    verdicts(ENERGY_ERROR, "pendulum", &[(&of("1"), "1.25"), (&of("1"), "1.5"), (&of("2.5"), "1.5")]);
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
    verdicts(BOUNDED, "kepler", &fine);
    // thrown out, by the first steps or later
    verdicts(
        ENERGY_ERROR,
        "kepler",
        &[(&of("0.6"), "1/5"), (&of("0.6"), "1/4"), (&of("0.6"), "1/3"), (&of("0.9"), "1/20"), (&of("0.99"), "1/20")],
    );
    verdicts(Verdict::RoundOff, "kepler", &[(&of("0"), "1/2000")]);
    for (scheme, h, expected) in
        [("yoshida4", "1/20", BOUNDED), ("yoshida4", "1/5", ENERGY_ERROR), ("blanes-moan-s6", "1/200", BOUNDED)]
    {
        assert_eq!(watch("kepler", &[], scheme, h, 20_000).verdict, expected, "{scheme}, h = {h}");
    }
}

#[test]
fn henon_heiles_regular_and_chaotic() {
    let (regular, chaotic) = ([("px", "0.1")], [("px", "0.5"), ("py", "0.2")]);
    verdicts(BOUNDED, "henon-heiles", &[(&regular, "1/10"), (&regular, "1/2"), (&chaotic, "1/10"), (&chaotic, "1/2")]);
    verdicts(ENERGY_ERROR, "henon-heiles", &[(&regular, "1")]);
    let more = [("px", "0.3"), ("py", "0.3")];
    let report = watch("henon-heiles", &more, "stormer-verlet", "0.9", 50_000);
    assert_eq!(report.verdict, ENERGY_ERROR, "{report}");
}

#[test]
fn many_bodies() {
    verdicts(BOUNDED, "pythagorean", &[(&[], "1/10000")]);
    verdicts(ENERGY_ERROR, "pythagorean", &[(&[], "1/1000"), (&[], "1/100")]);
    verdicts(BOUNDED, "fput-stiff", &[(&[], "0.001"), (&[], "0.02")]);
    verdicts(ENERGY_ERROR, "fput-stiff", &[(&[], "0.03")]);
    verdicts(BOUNDED, "outer-solar-system", &[(&[], "100"), (&[], "200")]);
    verdicts(ENERGY_ERROR, "outer-solar-system", &[(&[], "800")]);
    verdicts(BOUNDED, "argon-crystal", &[(&[], "4e-5")]);
    verdicts(ENERGY_ERROR, "argon-crystal", &[(&[], "1e-4")]);
    // the energy error is small, and grows
    for (scheme, h) in [("blanes-moan-srkn6b", "7.125e-5"), ("yoshida6-a", "8.3125e-5")] {
        assert_eq!(watch("argon-crystal", &[], scheme, h, 20_000).verdict, Verdict::NotConserved, "{scheme}");
    }
}

/// A body without forces has an energy error of 0, so that nothing can be compared with it.
#[test]
fn free_motion_is_bounded() {
    potential! { struct Nothing; U(x) = 0*x }
    let mut motion = Motion::new(Nothing, UnitMasses, [0.0], [1.0]).unwrap();
    let verlet = stepper("stormer-verlet", "1/4", &());
    let mut monitor = ShadowEnergy::new(verlet, &mut motion, &Bilinear::with_error(4)).unwrap();
    for n in 1..=100 {
        monitor.step(&mut motion).unwrap();
        // with windows of 11 states the 16th ends at n = 25
        let report = monitor.report();
        assert_eq!(report.verdict == Verdict::Undecided(Missing::Windows), n < 25, "n = {n}");
        assert!(!report.to_string().is_empty());
    }
    assert_eq!(monitor.report().verdict, Verdict::Bounded);
}

/// A kinetic energy of any kind, by a scheme for it.
#[test]
fn any_kinetic_energy() {
    kinetic! { struct Relativistic; T(p) = sqrt(1 + p^2) }
    potential! { struct Spring; U(q) = q^2/2 }
    let yoshida = Stepper::new(shipped("yoshida4").unwrap().for_every_kinetic().unwrap(), "1/10").unwrap();
    let mut motion = Motion::new(Spring, Relativistic, [1.0], [0.0]).unwrap();
    let report = watched(yoshida, &mut motion, &Bilinear::with_error(8), 40, 8000);
    assert!(report.verdict == Verdict::Bounded && report.moved < 1e-4 * report.energy_error, "{report}");
}

/// Beyond the stability limit hω = 3.1635 of the scheme, in the gap.
#[test]
fn a_step_beyond_the_limit_is_too_large() {
    for (h, steps) in [("3.1951", 20_000), ("3.1951", 400), ("3.2", 20_000)] {
        let report = watch("harmonic-oscillator", &[], "blanes-moan-srkn6b", h, steps);
        assert_eq!(report.verdict, ENERGY_ERROR, "h = {h}: {report}");
    }
}

/// Two stars, and a planet of the mass m whose orbit around one of them, of radius 1/10, has ω = 31.6.
fn planet(m: f64) -> Motion<f64, Vec<f64>, Pairs<Gravity<f64>, 2>, DiagonalMasses<f64>> {
    let (masses, distance, radius) = ([1.0, 0.5, m], 10.0, 0.1);
    let omega = (1.5 / 1000.0_f64).sqrt();
    let [x1, x2] = [-distance / 3.0, distance * 2.0 / 3.0];
    let v = omega * x1 + 10.0_f64.sqrt();
    let kinetic = DiagonalMasses::from_numbers(&masses.map(|m| [m, m]).concat()).unwrap();
    let gravity = Pairs::all(3, Gravity { g: 1.0, m: masses.to_vec() }).unwrap();
    let p = vec![0.0, omega * x1, 0.0, 0.5 * omega * x2, 0.0, m * v];
    Motion::new(gravity, kinetic, vec![x1, 0.0, x2, 0.0, x1 + radius, 0.0], p).unwrap()
}

/// The energy does not show how a light planet is resolved; the report does.
#[test]
fn a_light_planet_is_reported() {
    let watch_every = |every: u64, m: f64, h: &str, steps: u64| {
        let mut motion = planet(m);
        let verlet = stepper("stormer-verlet", h, &());
        watched(verlet, &mut motion, &Bilinear::with_error(8), every, steps)
    };
    let watch = |m: f64, h: &str, steps: u64| watch_every(100, m, h, steps);
    // hω = 0.1
    let light = watch(1e-12, "0.00316", 20_000);
    assert_eq!(light.verdict, Verdict::RoundOff, "{light}");
    let (coordinate, steps) = light.fastest_coordinate.unwrap();
    assert!(coordinate >= 4 && (steps - 62.8).abs() < 1.0, "{coordinate}, {steps}: {light}");
    assert!(light.reason().contains("where it resolves coordinate"), "{light}");
    // hω = 1.43, 2 and 2.5: the planet is thrown out in the first steps
    for h in ["0.0452", "0.0632", "0.079"] {
        let lost = watch(1e-3, h, 4000);
        // a coordinate of the planet, or of its star, which it moves
        let (coordinate, steps) = lost.fastest_coordinate.unwrap();
        assert!([0, 1, 4, 5].contains(&coordinate) && steps < 6.0, "{coordinate}, {steps}: {lost}");
        assert!(!lost.verdict.is_bounded() && lost.lost_coordinate.is_some(), "{lost}");
    }
    // with a planet that its steps do not resolve, H̄ may be anything, and the loop is correct all the same
    for every in [9, 20, 50] {
        let unresolved = watch_every(every, 1e-12, "0.0452", 20_000);
        assert!(unresolved.verdict != Verdict::Inconsistent && !unresolved.verdict.is_bounded(), "{unresolved}");
    }
    // with steps so short that the second differences of p are below the last place of an f64
    let mut slow: ProblemMotion<Float> =
        problem("kepler").unwrap().setup(&[], 80).unwrap().motion(&precision(60)).unwrap();
    let verlet = stepper("stormer-verlet", "1e-9", &precision(60));
    let report = watched(verlet, &mut slow, &Bilinear::with_error(8), 20, 1000);
    assert_eq!(report.lost_coordinate, None, "{report}");
    let resolved = watch(1e-3, "0.00316", 4000);
    assert!(resolved.verdict == BOUNDED && !resolved.reason().contains("it may be lost"), "{resolved}");
}
