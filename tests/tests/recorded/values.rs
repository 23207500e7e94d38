//! Values of H̄.

use shadowstep::shadow::recorded::{
    Cause, Derivatives, Logged as LoggedState, MadeStep, Observer, Repeated, Unwrapping, Value, integer_momenta,
    integer_momenta_with_gradients,
};
use shadowstep::shadow::run::Trajectory;

use super::*;

fn motion(fluid: Fluid) -> Motion<f64, Vec<f64>, Fluid, UnitMasses> {
    let [q, p] = fluid.start();
    Motion::new(fluid, UnitMasses, q, p).unwrap()
}

/// The same estimates of the same trajectory, from its own increments and from what was logged of it. They differ by
/// the round-off of rates: of some multiples of ε Σ|q_i U_qi|, which is 1e-12 here.
#[test]
fn of_our_own_trajectory_they_are_those_of_the_run() {
    let (fluid, h) = (fluid(), step_size("0.004"));
    let verlet = stepper::<f64>("stormer-verlet", "0.004", &());
    let motion = |[q, p]: [Vec<f64>; 2]| Motion::new(fluid, UnitMasses, q, p).unwrap();
    for settings in [Bilinear::new(4), Bilinear::new(7), Bilinear::with_error(8)] {
        let own = values(ShadowRun::new(verlet.with(motion(fluid.start())), 50, &settings).unwrap());
        let logged = Logged::new(&fluid, &[1.0; 81], 0.004, fluid.start(), 50);
        let found = values_of(logged.log(), &h, &[1.0; 81], &settings);
        let with_rates = Log::with_rates(81, [&logged.q, &logged.p], [&logged.energies, &logged.rates]).unwrap();
        let of_rates = values_of(with_rates, &h, &[1.0; 81], &settings);
        assert!(found.len() > 30 && found.len() == of_rates.len());
        for (&(n, found), &(_, of_rates)) in found.iter().zip(&of_rates) {
            let expected = own[n as usize].1;
            assert!((found - expected).abs() < 1e-11, "n = {n}: {found} and {expected}");
            // differences of states: ε|q||p|/h
            assert!((of_rates - expected).abs() < 1e-9, "n = {n}: {of_rates} and {expected}");
        }
        let least = found.iter().map(|(_, value)| *value).fold(f64::MAX, f64::min);
        let largest = found.iter().map(|(_, value)| *value).fold(f64::MIN, f64::max);
        assert!(largest - least < 1e-3, "{settings:?}: {least} to {largest}");
    }
}

/// For H = p²/2m + mω²q²/2 the modified energy is ½(p²/m + (1 − x²) mω²q²) arcsin(x)/(x√(1 − x²)), x = hω/2.
#[test]
fn of_an_oscillator_they_are_what_theory_says() {
    let (omega, mass) = (1.7_f64, 2.5_f64);
    let spring = shadowstep::systems::potential::from_fn(1, |q, gradient| {
        gradient[0] = mass * omega * omega * q[0];
        mass * omega * omega * q[0] * q[0] / 2.0
    });
    for h in [0.2, 0.1, 0.025] {
        let logged = Logged::new(&spring, &[mass], h, [vec![1.0], vec![0.5]], 60);
        let x: f64 = h * omega / 2.0;
        let factor = x.asin() / (x * (1.0 - x * x).sqrt());
        let found = values_of(logged.log(), &h.try_into().unwrap(), &[mass], &Bilinear::new(10));
        assert_eq!(found.len(), 51);
        for (n, value) in found {
            let (q, p) = (logged.q[n as usize], logged.p[n as usize]);
            let expected = (p * p / mass + (1.0 - x * x) * mass * omega * omega * q * q) / 2.0 * factor;
            // E_10 is off by |sin ωh/2|²⁰, 3e-16 at most here; the rest is round-off
            assert!((value - expected).abs() < 3e-14, "h = {h}, n = {n}: {value} and {expected}");
        }
    }
}

/// From each state the step of any scheme is made again: its estimates have the bits of the run's.
#[test]
fn repeated_steps_give_the_bits_of_the_run() {
    let fluid = fluid();
    let motion = || motion(fluid);
    let settings = Bilinear::with_error(6);
    for name in ["stormer-verlet", "symplectic-euler", "yoshida4"] {
        let scheme = stepper::<f64>(name, "0.004", &());
        let (mut q, mut p) = (Vec::new(), Vec::new());
        let mut trajectory = Trajectory::plain(scheme.with(motion()), 0, 40).unwrap();
        while let Some(state) = trajectory.advance().unwrap() {
            q.extend(state.q);
            p.extend(state.p);
        }
        let own = values(ShadowRun::new(scheme.with(motion()), 40, &settings).unwrap());
        let found = values(Repeated::new(scheme.with(motion()), &q, &p).unwrap().estimates(&settings).unwrap());
        assert!(found.len() > 20);
        assert!(found.iter().all(|&(n, value)| own[n as usize] == (n, value)), "{name}");
    }
    // states of another step size
    let (scheme, other) = (stepper::<f64>("yoshida4", "0.004", &()), stepper::<f64>("yoshida4", "0.00404", &()));
    let mut trajectory = Trajectory::plain(scheme.with(motion()), 0, 2).unwrap();
    let (mut q, mut p) = (Vec::new(), Vec::new());
    while let Some(state) = trajectory.advance().unwrap() {
        q.extend(state.q);
        p.extend(state.p);
    }
    let mut repeated = Repeated::new(other.with(motion()), &q, &p).unwrap();
    while repeated.advance().unwrap().is_some() {}
    let [of_q, of_p] = repeated.differences().unwrap();
    assert!((of_q.slope + 0.0099).abs() < 1e-4, "{of_q:?}");
    // after a drift that is too long, at other positions
    assert!((of_p.slope + 0.0099).abs() < 5e-3, "{of_p:?}");
}

/// Of any scheme, the increments that a program sums in its steps give the estimates of the run, and of the same states
/// at other steps they do not.
#[test]
fn increments_of_any_splitting_give_the_estimates_of_the_run() {
    let fluid = fluid();
    let motion = || motion(fluid);
    let mut scratch = vec![0.0; fluid.scratch()];
    fluid.prepare(&mut scratch, &());
    for name in ["symplectic-euler", "pefrl", "blanes-moan-srkn6b"] {
        let scheme = stepper::<f64>(name, "0.004", &());
        let own = values(ShadowRun::new(scheme.with(motion()), 60, &Bilinear::with_error(8)).unwrap());
        for factor in [1.0, 1.01] {
            let mut observer = Observer::new(&step_size("0.004"), &[1.0; 81]).unwrap();
            let mut before = vec![0.0; 81];
            let mut trajectory = Trajectory::plain(scheme.with(motion()), 0, 60).unwrap();
            trajectory.set_augmented(true);
            while let Some(state) = trajectory.advance().unwrap() {
                let (mut gradient, mut energy, mut rate) = (vec![0.0; 81], 0.0, 0.0);
                fluid.gradient_and_rate(state.q, &mut gradient, &mut rate, &mut scratch);
                fluid.energy(state.q, &mut energy, &mut scratch);
                let zeros = [0.0; 81];
                let [dq, dp] = if state.n == 0 { [&zeros[..]; 2] } else { [state.increments.q, state.increments.p] };
                let beta = state.increments.beta + before.iter().zip(dp).map(|(q, dp)| q * dp).sum::<f64>();
                let dq: Vec<f64> = dq.iter().map(|dq| factor * dq).collect();
                let step = MadeStep { q: &dq, p: dp, beta };
                let derivatives = Derivatives::Step(&gradient, step);
                observer.observe(&LoggedState { q: state.q, p: state.p, energy, derivatives }).unwrap();
                before.copy_from_slice(state.q);
            }
            let found = observer.values();
            assert!(found.len() > 30, "{name}");
            let is_own = |value: &Value| (value.modified - own[value.n as usize].1).abs() < 1e-11;
            assert_eq!(found.iter().all(is_own), factor == 1.0, "{name}, {factor}");
            assert_eq!(
                observer.diagnosis().cause,
                if factor == 1.0 { Cause::Nothing } else { Cause::OtherSteps },
                "{name}"
            );
        }
    }
}

/// Momenta of leapfrog, and positions in the box.
#[test]
fn momenta_at_half_steps_and_wrapped_positions_give_the_same_values() {
    let (fluid, h, steps) = (fluid(), 0.004, 60);
    let [start, mut p] = fluid.start();
    p.iter_mut().for_each(|p| *p *= 2.0);
    let logged = Logged::new(&fluid, &[1.0; 81], h, [start, p], steps);
    let expected = values_of(logged.log(), &h.try_into().unwrap(), &[1.0; 81], &Bilinear::new(8));

    // half a step before the first state, and after each
    let before = logged.p[..81].iter().zip(&logged.gradients).map(|(p, g)| p + h / 2.0 * g);
    let after = logged.p.iter().zip(&logged.gradients).map(|(p, g)| p - h / 2.0 * g);
    let half_steps: Vec<f64> = before.chain(after).collect();
    let p = integer_momenta(81, steps + 1, &half_steps).unwrap();

    let mut others = half_steps[..p.len()].to_vec();
    integer_momenta_with_gradients(&h.try_into().unwrap(), &mut others, &logged.gradients).unwrap();
    assert!(p.iter().zip(&others).all(|(p, other)| (p - other).abs() < 1e-14));

    let wrapped: Vec<f64> = logged.q.iter().map(|q| q.rem_euclid(fluid.side)).collect();
    let jumps = wrapped.iter().zip(&wrapped[81..]).filter(|(a, b)| (*a - *b).abs() > 1.0).count();
    assert!(jumps > 3, "{jumps}");
    let mut unwrapping =
        Unwrapping::new([[fluid.side, 0.0, 0.0], [0.0, fluid.side, 0.0], [0.0, 0.0, fluid.side]]).unwrap();
    let q: Vec<f64> = wrapped.chunks_exact(81).flat_map(|q| unwrapping.next(q).unwrap().to_vec()).collect();

    let other = Logged { q, p, ..Logged::new(&fluid, &[1.0; 81], h, fluid.start(), 0) };
    let log = Log::with_gradients(81, [&other.q, &other.p, &logged.gradients], &logged.energies).unwrap();
    let found = values_of(log, &h.try_into().unwrap(), &[1.0; 81], &Bilinear::new(8));
    for ((n, found), (_, expected)) in found.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-10, "n = {n}: {found} and {expected}");
    }
}
