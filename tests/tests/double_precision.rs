//! Protects the modified energy in double precision: how far the estimates scatter, and what the increments are for.

use shadowstep::problems::Kepler;
use shadowstep::shadow::run::{ShadowRun, States, Trajectory};
use shadowstep::shadow::{Bilinear, BuildEstimator, Central, Estimator, StoppingRule};
use shadowstep::{Increments, Motion, Real, UnitMasses};
use shadowstep_tests::{precision, stepper};

type Double = Motion<f64, Vec<f64>, Kepler, UnitMasses>;

/// Eccentricity 0.6, from the pericentre; the period is 2π.
fn kepler() -> Double {
    Motion::new(Kepler, UnitMasses, vec![0.4, 0.0], vec![0.0, 2.0]).unwrap()
}

/// The distance from the centre and the modified energy of every state n = 0..=steps.
fn estimates(h: &str, steps: u64, settings: &impl BuildEstimator<f64>) -> Vec<(f64, f64)> {
    let verlet = stepper("stormer-verlet", h, &());
    let mut run = ShadowRun::new(verlet.with(kepler()), steps, settings).unwrap();
    let mut all = Vec::new();
    while let Some((_, estimate)) = run.advance().unwrap() {
        all.push((estimate.q[0].hypot(estimate.q[1]), *estimate.value));
    }
    all
}

/// The scatter at each of the last `orbits` apocentres: max − min of the estimates within `reach` steps of it.
///
/// The modified energy itself is moved by the round-off of the steps, by 3e-13 in 10⁶ of them; what these few move it
/// by is in the scatter.
fn scatters(estimates: &[(f64, f64)], reach: usize, orbits: usize) -> Vec<f64> {
    let is_apocentre = |&n: &usize| {
        let r = |n: usize| estimates[n].0;
        r(n) > 1.0 && r(n - 1) < r(n) && r(n) >= r(n + 1)
    };
    let apocentres = (reach..estimates.len() - reach).rev().filter(is_apocentre);
    let spread = |n: usize| {
        let values = estimates[n - reach..=n + reach].iter().map(|(_, value)| *value);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    let all: Vec<f64> = apocentres.take(orbits).map(spread).collect();
    assert_eq!(all.len(), orbits, "the run is too short");
    all
}

fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, f64::max)
}

#[test]
fn scatter_at_apocentre_is_below_2e_15_after_a_million_steps() {
    let scatter = largest(scatters(&estimates("1/20", 1_000_000, &Bilinear::new(8)), 10, 100));
    println!("{scatter:e}");
    // round-off there is: less would be a run that does not move
    assert!(scatter > 1e-16 && scatter < 2e-15, "{scatter:e}");
}

#[test]
fn scatter_at_apocentre_is_below_2e_15_with_every_estimator() {
    fn check(settings: &(impl BuildEstimator<f64> + std::fmt::Debug)) {
        let scatter = largest(scatters(&estimates("1/20", 20_000, settings), 10, 100));
        println!("{settings:?}: {scatter:e}");
        assert!(scatter > 1e-16 && scatter < 2e-15, "{settings:?}: {scatter:e}");
    }
    [4, 6, 10, 12, 16].into_iter().for_each(|k| check(&Bilinear::new(k)));
    // D_5 itself is off by as much as that, in exact arithmetic
    [10, 20].into_iter().for_each(|m| check(&Central::fixed(m)));
    check(&Central::best(20, StoppingRule::Full));
}

/// The estimates of the states of a run, with what each step added or with β's increments only.
fn estimates_of_states(h: &str, steps: u64, settings: &impl BuildEstimator<f64>, vectors: bool) -> Vec<(f64, f64)> {
    let verlet = stepper("stormer-verlet", h, &());
    let mut estimator = settings.build(verlet.step_size(), 2, &()).unwrap();
    let mut trajectory = Trajectory::new(verlet.with(kepler()), steps, estimator.states() / 2).unwrap();
    let mut all = Vec::new();
    while let Some(state) = trajectory.advance().unwrap() {
        let of_beta = Increments::of_beta(state.increments.beta);
        let increments = if vectors { state.increments } else { of_beta };
        let estimate = estimator.push(state.q, state.p, increments);
        all.extend(estimate.map(|e| (e.q[0].hypot(e.q[1]), *e.value)));
    }
    all
}

/// The round-off of states is divided by h in an estimate; the round-off of increments is not.
#[test]
fn increments_keep_the_round_off_of_states_out_of_small_steps() {
    fn check(settings: &(impl BuildEstimator<f64> + std::fmt::Debug)) {
        // an eighth of the period on both sides of two apocentres
        let scatter = |vectors| {
            let all = estimates_of_states("1/1000", 12_000, settings, vectors);
            largest(scatters(&all, 785, 2))
        };
        let [states, increments] = [false, true].map(scatter);
        println!("{settings:?}: {states:e} from states, {increments:e} from increments");
        assert!(increments < 4e-15 && 20.0 * increments < states, "{settings:?}: {states:e}, {increments:e}");
    }
    check(&Bilinear::new(8));
    check(&Central::fixed(10));
    check(&Central::best(10, StoppingRule::Full));
}

/// More digits do what increments do: numbers that have them keep β's alone.
#[test]
fn numbers_of_many_digits_keep_no_vectors() {
    let context = precision(40);
    let numbers = |texts: &[&str]| shadowstep_tests::numbers::<rug::Float>(texts, &context);
    let mut motion = Motion::new(Kepler, UnitMasses, numbers(&["0.4", "0"]), numbers(&["0", "2"])).unwrap();
    stepper("stormer-verlet", "1/20", &context).step_augmented(&mut motion);
    let Increments { q, p, beta } = motion.increments();
    assert!(q.is_empty() && p.is_empty() && beta.log10_abs() > -2.0);
}
