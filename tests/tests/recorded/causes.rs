//! What moves the energy of a fluid of 27 particles: sizes and places of faults, which verdicts.rs has of all kinds.
//! They are found from all states, and from windows of nine with gaps between them.

use shadowstep::shadow::recorded::{Cause, Derivatives, Diagnosis, Logged as State, Observer, Window};

use super::cases::Random;
use super::*;

/// Steps of velocity Verlet of the fluid with a fault: `evaluate` gives U and writes the gradient of the state n, and
/// what is logged is rounded by `store`.
struct Run<E> {
    h: f64,
    steps: usize,
    evaluate: E,
    store: fn(f64) -> f64,
}

impl<E: FnMut(usize, &[f64], &mut [f64]) -> f64> Run<E> {
    /// From all states, and from windows of nine in 20 steps.
    fn observe(mut self, logged_h: f64) -> [Diagnosis; 2] {
        let [mut q, mut p] = fluid().start();
        let mut gradient = vec![0.0; q.len()];
        let (h, masses) = (logged_h.try_into().unwrap(), vec![1.0; q.len()]);
        let observer = |window| Observer::with_window(&h, &masses, window).unwrap();
        let [mut all, mut windows] = [Window::Seventeen, Window::Nine].map(observer);
        let mut energy = (self.evaluate)(0, &q, &mut gradient);
        for n in 1..=self.steps {
            let [q_stored, p_stored] = [&q, &p].map(|x| x.iter().map(|x| (self.store)(*x)).collect::<Vec<f64>>());
            let derivatives = Derivatives::Gradient(&gradient);
            let state = State { q: &q_stored, p: &p_stored, energy, derivatives };
            all.observe(&state).unwrap();
            if (n - 1) % 20 == 0 && n > 1 {
                windows.begin(n as i64 - 1).unwrap();
            }
            if (n - 1) % 20 < 9 {
                windows.observe(&state).unwrap();
            }
            p.iter_mut().zip(&gradient).for_each(|(p, g)| *p -= self.h / 2.0 * g);
            q.iter_mut().zip(&p).for_each(|(q, p)| *q += self.h * p);
            energy = (self.evaluate)(n, &q, &mut gradient);
            p.iter_mut().zip(&gradient).for_each(|(p, g)| *p -= self.h / 2.0 * g);
        }
        [all.diagnosis(), windows.diagnosis()]
    }
}

fn of(kind: Cutoff) -> impl FnMut(usize, &[f64], &mut [f64]) -> f64 {
    let fluid = Fluid { kind, ..fluid() };
    move |_, q, gradient| {
        let mut energy = 0.0;
        fluid.gradient(q, gradient, &mut []);
        fluid.energy(q, &mut energy, &mut []);
        energy
    }
}

/// 1000 steps with these forces.
fn with(h: f64, evaluate: impl FnMut(usize, &[f64], &mut [f64]) -> f64) -> [Diagnosis; 2] {
    Run { h, steps: 1000, evaluate, store: |x| x }.observe(h)
}

#[test]
fn noise_is_found_with_its_size() {
    for size in [0.01, 0.1, 1.0] {
        let (mut smooth, mut random) = (of(Cutoff::Smooth), Random::new(1));
        let found = with(0.002, |n, q, gradient| {
            let energy = smooth(n, q, gradient);
            gradient.iter_mut().for_each(|g| *g += size * random.normal());
            energy
        });
        for found in found {
            let holds = matches!(found.cause, Cause::Noise { size: found } if (found / size - 1.0).abs() < 0.05);
            assert!(holds, "{size}: {found}");
            // theory: what independent kicks do to the energy
            assert!((0.5..2.0).contains(&found.excess.unwrap()), "{size}: {found}");
        }
    }
}

#[test]
fn cutoffs_are_found() {
    for truncated in with(0.002, of(Cutoff::Truncated)) {
        assert!(matches!(truncated.cause, Cause::EnergyNotSmooth { .. } | Cause::Jumps { .. }), "{truncated}");
    }
    for shifted in with(0.002, of(Cutoff::Shifted)) {
        assert!((0.5..1.6).contains(&shifted.smoothness.unwrap().exponent), "{shifted}");
    }
}

/// A list of the pairs within the cutoff that is renewed every `every` steps.
fn late(every: usize) -> impl FnMut(usize, &[f64], &mut [f64]) -> f64 {
    let fluid = fluid();
    let mut pairs: Vec<[usize; 2]> = Vec::new();
    move |n, q, gradient| {
        let pair = Fluid { particles: 2, ..fluid };
        let energy_of = |[i, j]: [usize; 2]| {
            let of_pair: Vec<f64> = [&q[3 * i..][..3], &q[3 * j..][..3]].concat();
            let (mut energy, mut of_both) = (0.0, [0.0; 6]);
            pair.energy(&of_pair, &mut energy, &mut []);
            pair.gradient(&of_pair, &mut of_both, &mut []);
            (energy, of_both)
        };
        if n % every == 0 {
            pairs =
                (0..27).flat_map(|i| (0..i).map(move |j| [i, j])).filter(|&pair| energy_of(pair).0 != 0.0).collect();
        }
        gradient.fill(0.0);
        let mut sum = 0.0;
        for &[i, j] in &pairs {
            let (energy, of_both) = energy_of([i, j]);
            sum += energy;
            (0..3).for_each(|axis| {
                gradient[3 * i + axis] += of_both[axis];
                gradient[3 * j + axis] += of_both[3 + axis];
            });
        }
        sum
    }
}

#[test]
fn lists_that_are_renewed_too_late_are_found_with_their_places() {
    let [all, windows] = with(0.002, late(100));
    for found in [&all, &windows] {
        assert!(matches!(found.cause, Cause::Jumps { size } if size > 1e-3), "{found}");
        // what H̄ changes by is the sum of the jumps
        let sum: f64 = found.jumps.iter().map(|jump| jump.energy).sum();
        assert!((sum - found.change).abs() < 0.02 * found.range, "{sum}: {found}");
    }
    assert!(all.jumps.iter().take(5).all(|jump| jump.n % 100 == 0), "{:?}", all.jumps);
    // a jump is before the middle of the first window after it, and the states 100, 200, … begin one
    assert!(windows.jumps.iter().take(5).all(|jump| jump.n % 100 == 4), "{:?}", windows.jumps);
    for found in with(0.002, late(1)) {
        assert_eq!(found.cause, Cause::Nothing, "{found}");
    }
}

#[test]
fn another_step_size_than_stated_is_found() {
    let run = Run { h: 0.002, steps: 1000, evaluate: of(Cutoff::Smooth), store: |x| x };
    for found in run.observe(0.00201) {
        assert_eq!(found.cause, Cause::OtherSteps, "{found}");
        let [of_q, _] = found.differences.unwrap();
        assert!((of_q.slope + 0.005).abs() < 1e-4, "{of_q:?}");
    }
}

#[test]
fn states_with_few_digits_are_not_accused() {
    let run = |store| Run { h: 0.002, steps: 1000, evaluate: of(Cutoff::Smooth), store }.observe(0.002);
    for single in run(|x| f64::from(x as f32)) {
        assert_eq!(single.cause, Cause::Nothing, "{single}");
        let [of_q, _] = single.differences.unwrap();
        assert!((of_q.correlation + 0.5).abs() < 0.1 && of_q.of_numbers < 1e-7, "{single}");
    }
    // two decimals
    for few in run(|x| (x * 1e2).round() / 1e2) {
        assert_eq!(few.cause, Cause::Digits, "{few}");
    }
}

/// Windows of 17 states with gaps between them: the estimates equal those from the whole trajectory.
#[test]
fn windows_with_gaps_give_the_same_values_and_causes() {
    let logged = Logged::new(&fluid(), &[1.0; 81], 0.004, fluid().start(), 600);
    let log = logged.log();
    let h = step_size("0.004");
    let [mut whole, mut windows] = [(); 2].map(|()| Observer::new(&h, &[1.0; 81]).unwrap());
    for n in 0..=600 {
        let state = log.state(n).unwrap();
        whole.observe(&state).unwrap();
        if n % 40 == 0 && n > 0 {
            windows.begin(n as i64).unwrap();
        }
        if n % 40 < 19 {
            windows.observe(&state).unwrap();
        }
    }
    assert!(windows.values().len() == 45, "{}", windows.values().len());
    for value in windows.values() {
        let same = whole.values().iter().find(|other| other.n == value.n).unwrap();
        assert!((value.modified - same.modified).abs() < 1e-11 && value.energy == same.energy, "{value:?} {same:?}");
        assert!(value.error > same.error / 2.0 && value.error < 2.0 * same.error + 1e-11, "{value:?} {same:?}");
    }
    assert_eq!(windows.diagnosis().cause, Cause::Nothing, "{}", windows.diagnosis());
    let refused = windows.begin(40).unwrap_err().to_string();
    assert!(refused.starts_with("a window cannot begin at state 40: the newest state is 600"), "{refused}");
}
