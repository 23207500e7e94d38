//! Protects the schemes for sampling: the properties for which their authors chose the free weights.

use shadowstep::problems::HarmonicOscillator;
use shadowstep::tables::shipped as shipped_scheme;
use shadowstep::{Motion, Stepper, UnitMasses};
use shadowstep_analysis::Analysis;
use shadowstep_analysis::gaussian::{Gaussian, acceptance_of_many};
use shadowstep_analysis::proposals::{Proposal, Proposals};
use shadowstep_schemes::MapKind;
use shadowstep_schemes::{First, Proved, Source, read, read_first, shipped, shipped_proved, to_significant};
use shadowstep_tests::rational;

/// The largest ρ(hω) for 0 < hω < forces, sampled. For an oscillator in equilibrium the expected error of the energy,
/// for any number of steps, is at most ρ, times the temperature: (B + C)²/(2(1 − A²)) for the matrix (A B; C A) of a
/// step (Blanes, Casas, Sanz-Serna 2014).
fn largest_rho(proved: &Proved) -> f64 {
    const POINTS: u32 = 20_000;
    let weight = |weight: &_| to_significant(weight, 18).parse::<f64>().unwrap();
    let maps: Vec<_> = proved.scheme.maps().iter().map(|map| (map.kind, weight(&map.weight))).collect();
    let rho = |h_omega: f64| {
        let mut columns = [[1.0, 0.0], [0.0, 1.0]];
        for (kind, weight) in &maps {
            for [q, p] in &mut columns {
                match kind {
                    MapKind::Kick => *p -= weight * h_omega * *q,
                    MapKind::Drift => *q += weight * h_omega * *p,
                    MapKind::GradientKick => *p += 2.0 * weight * h_omega.powi(3) * *q,
                }
            }
        }
        let [[a, c], [b, d]] = columns;
        let a = f64::midpoint(a, d);
        (b + c).powi(2) / (2.0 * (1.0 - a * a))
    };
    let end = proved.plan.evaluations as f64;
    let values = (1..POINTS).map(|n| rho(end * f64::from(n) / f64::from(POINTS)));
    // where the trace touches −2, both parts of the fraction vanish
    values.filter(|value| value.is_finite()).fold(0.0, f64::max)
}

/// A shipped table with another text in the place of a weight.
fn changed(name: &str, from: &str, to: &str) -> Proved {
    let source = shipped(name).unwrap();
    let text = source.text.replace(&format!("\"{from}\""), &format!("\"{to}\""));
    assert_ne!(text, source.text);
    read(&Source { path: "changed.toml".to_owned(), text }, &|base, _| shipped(base))
        .unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn two_and_three_stages_have_the_least_largest_error() {
    for (name, printed, around) in
        [("bcss2", "0.211781", ["0.2112", "0.2123"]), ("bcss3", "0.11888010966548", ["0.1187", "0.1190"])]
    {
        let least = largest_rho(shipped_proved(name).unwrap());
        for other in around {
            let other = largest_rho(&changed(name, printed, other));
            assert!(least < other, "{name}: {least:e}, {other:e} with a weight changed");
        }
    }
    // the rule of Gauss, which others take for it
    let gauss = read_first(&shipped("saba2").unwrap(), &|base, _| shipped(base), Some(First::Kick)).unwrap();
    let [chosen, gauss] = [shipped_proved("bcss2").unwrap(), &gauss].map(largest_rho);
    assert!(chosen < 0.8 * gauss, "{chosen:e} {gauss:e}");
}

#[test]
fn more_stages_have_smaller_errors_at_equal_cost() {
    let errors = ["bcss2", "bcss3", "bcss4"].map(|name| largest_rho(shipped_proved(name).unwrap()));
    assert!(errors.is_sorted_by(|a, b| *b < 0.3 * a), "{errors:?}");
}

/// The decimals of the paper are the closed forms, rounded.
#[test]
fn printed_decimals_are_what_the_formulas_give() {
    for (name, is_kick, at, printed) in [
        ("bcss3", false, 0, "0.29619504261126"),
        ("predescu3", false, 0, "0.290485609075128726"),
        ("bcss4", true, 0, "0.071353913450279725904"),
        ("bcss4", true, 1, "0.26854879116123010582"),
    ] {
        let scheme = &shipped_proved(name).unwrap().scheme;
        let weight = if is_kick { &scheme.stages.kick[at] } else { &scheme.stages.drift[at] };
        let off = weight - &rational(printed);
        let off: f64 = to_significant(&off, 3).parse().unwrap();
        let unit = 10_f64.powi(-(printed.len() as i32 - 2));
        assert!(off.abs() <= unit, "{name}: {printed} is off by {off:e}");
    }
}

/// The trace of bcss4 touches −2 at hω = 3.043 and stays within [−2, 2].
#[test]
fn a_double_root_is_no_end_of_stability() {
    for (name, limit) in [("bcss4", 5.353_717_672_2), ("bcss3", 4.661_846_078_2), ("predescu3", 4.583_767_923_8)] {
        let stability = Analysis::of(shipped_proved(name).unwrap()).stability.unwrap();
        let found: f64 = stability.limit.parse().unwrap();
        assert!((found - limit).abs() < 1e-9, "{name}: {found}");
    }
}

/// Then the error of the energy of an oscillator in equilibrium is of order 4.
#[test]
fn both_leading_errors_of_predescu_are_equal() {
    let error = Analysis::of(shipped_proved("predescu3").unwrap()).quadratic;
    let [(_, first), (_, second)] = &error.terms[..] else { panic!("{:?}", error.terms) };
    assert!((first / second - 1.0).abs() < 1e-13, "{first} {second}");
}

/// Of every kind of symmetric scheme: kick or drift first, gradient kicks, several orders.
const SYMMETRIC: [&str; 6] =
    ["stormer-verlet", "bcss3", "chin-4a", "omelyan-4mn5fp", "blanes-moan-srkn11b", "kahan-li8"];

/// ΔH of steps from (q, p) of oscillators, made by the stepper of the library.
struct Made {
    frequencies: Vec<f64>,
    stepper: Stepper<shadowstep::tables::TableScheme, f64>,
    steps: u64,
}

impl Made {
    fn of(scheme: &str, target: &Gaussian, proposal: &Proposal) -> Made {
        let h = shadowstep::Rational::from_float(proposal.h).unwrap();
        let stepper =
            Stepper::new(shipped_scheme(scheme).unwrap(), shadowstep::StepSize::try_from(h).unwrap()).unwrap();
        Made { frequencies: target.frequencies().to_vec(), stepper, steps: proposal.steps }
    }

    /// ΔH of an oscillator from ωq = x, p = y.
    fn change(&self, omega: f64, [x, y]: [f64; 2]) -> f64 {
        let mut motion = Motion::new(HarmonicOscillator { omega }, UnitMasses, vec![x / omega], vec![y]).unwrap();
        for _ in 0..self.steps {
            self.stepper.step(&mut motion);
        }
        let (x_end, y_end) = (motion.q()[0] * omega, motion.p()[0]);
        (x_end * x_end + y_end * y_end - x * x - y * y) / 2.0
    }
}

/// ΔH is a quadratic form, so that its mean over two normal variables is the sum of its values at (1, 0) and (0, 1).
#[test]
fn expected_errors_are_those_of_steps_that_are_made() {
    let target = Gaussian::new(vec![0.3, 0.71, 1.0, 1.9]).unwrap();
    for name in SYMMETRIC {
        let proposals = Proposals::of(shipped_proved(name).unwrap()).unwrap();
        for (time, steps) in [(3.0, 4), (7.0, 9), (40.0, 100)] {
            let proposal = proposals.proposal(&target, time, steps).unwrap();
            let made = Made::of(name, &target, &proposal);
            let errors =
                made.frequencies.iter().map(|omega| made.change(*omega, [1.0, 0.0]) + made.change(*omega, [0.0, 1.0]));
            let found: f64 = errors.sum();
            // what ΔH loses to rounding: some 1e-16 in each map
            let allowed = 1e-9 * found + 1e-13;
            assert!((proposal.error - found).abs() < allowed, "{name}: {} and {found}", proposal.error);
        }
    }
}

/// The acceptance of independent draws, within four standard errors.
#[test]
fn acceptances_are_those_of_proposals_that_are_made() {
    const DRAWS: usize = 20_000;
    let mut normal = normal_numbers();
    for (name, frequencies, time, steps) in [
        ("stormer-verlet", vec![1.0], 4.5, 3),
        ("bcss3", vec![0.5, 1.0, 1.0, 1.3], 6.0, 2),
        ("chin-4a", (1..=12).map(f64::from).collect(), 1.5, 7),
    ] {
        let target = Gaussian::new(frequencies).unwrap();
        let proposal = Proposals::of(shipped_proved(name).unwrap()).unwrap().proposal(&target, time, steps).unwrap();
        let made = Made::of(name, &target, &proposal);
        let accepted = |_| {
            let change: f64 = made.frequencies.iter().map(|omega| made.change(*omega, [normal(), normal()])).sum();
            (-change).exp().min(1.0)
        };
        let draws: Vec<f64> = (0..DRAWS).map(accepted).collect();
        let mean = draws.iter().sum::<f64>() / DRAWS as f64;
        let variance = draws.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / DRAWS as f64;
        let deviations = (mean - proposal.acceptance) / (variance / DRAWS as f64).sqrt();
        assert!(deviations.abs() < 4.0, "{name}: {mean} and {}, {deviations} standard errors", proposal.acceptance);
        // with so few oscillators the limit of many is another number
        let of_many = acceptance_of_many(proposal.error);
        assert!(
            proposal.acceptance < 0.97 && (mean - of_many).abs() > (mean - proposal.acceptance).abs(),
            "{name}: {of_many}"
        );
    }
}

/// Normal numbers from a fixed sequence of uniform ones, by Box and Muller.
fn normal_numbers() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    let mut uniform = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    };
    move || (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos()
}

/// Blanes, Casas and Sanz-Serna's bound: no number of steps has a larger error than ρ, and some come near it.
#[test]
fn no_length_has_a_larger_error_than_the_bound() {
    let target = Gaussian::new(vec![1.0]).unwrap();
    for name in SYMMETRIC {
        let proposals = Proposals::of(shipped_proved(name).unwrap()).unwrap();
        let of = |steps: u64| proposals.proposal(&target, 0.9 * steps as f64, steps).unwrap();
        let errors: Vec<f64> = (1..=200).map(|steps| of(steps).error).collect();
        let (largest, bound) = (errors.iter().copied().fold(0.0, f64::max), of(1).largest_error);
        assert!(largest <= bound * (1.0 + 1e-9) && largest > 0.99 * bound, "{name}: {largest:e} {bound:e}");
    }
}
