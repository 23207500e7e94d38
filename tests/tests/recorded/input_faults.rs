//! Faults of the log, and steps that are far too large: they are found before the forces are blamed.

use shadowstep::shadow::recorded::{Cause, Derivatives, Diagnosis, Observer, Window};
use shadowstep::systems::potential::from_fn;

use super::*;

/// From all states, and from windows of nine in 20 steps.
fn diagnoses(logged: &Logged, h: f64) -> [Diagnosis; 2] {
    let masses = vec![1.0; logged.dimension];
    [Window::Seventeen, Window::Nine].map(|window| {
        let mut observer = Observer::with_window(&h.try_into().unwrap(), &masses, window).unwrap();
        let log = logged.log();
        for n in 0..logged.energies.len() {
            let (of_window, place) = (window == Window::Nine, n % 20);
            if of_window && place == 0 && n > 0 {
                observer.begin(n as i64).unwrap();
            }
            if !of_window || place < 9 {
                let state = log.state(n).unwrap();
                assert!(matches!(state.derivatives, Derivatives::Gradient(_)));
                observer.observe(&state).unwrap();
            }
        }
        observer.diagnosis()
    })
}

/// 200 oscillators of the frequencies 1 to 1.05, weakly coupled, of one phase or of phases all over the circle.
fn oscillators(h: f64, in_phase: bool) -> Logged {
    const COUPLING: f64 = 1e-3;
    let potential = from_fn(200, |q: &[f64], gradient: &mut [f64]| {
        let mut energy = 0.0;
        for (i, (q, gradient)) in q.iter().zip(&mut *gradient).enumerate() {
            let omega = 1.0 + 0.05 * i as f64 / 199.0;
            *gradient = omega * omega * q;
            energy += q * *gradient / 2.0;
        }
        for i in 1..q.len() {
            let difference = q[i] - q[i - 1];
            energy += COUPLING * difference * difference / 2.0;
            gradient[i] += COUPLING * difference;
            gradient[i - 1] -= COUPLING * difference;
        }
        energy
    });
    let phase = |i: usize| if in_phase { 0.0 } else { 2.4 * i as f64 };
    let start = [f64::cos, f64::sin].map(|of| (0..200).map(|i| of(phase(i))).collect());
    Logged::new(&potential, &[1.0; 200], h, start, 700)
}

#[test]
fn a_step_that_is_far_too_large_is_the_time_step() {
    for h in [1.5, 1.6, 1.7, 1.8, 1.89] {
        let [all, windows] = diagnoses(&oscillators(h, true), h);
        assert_eq!(all.cause, Cause::TimeStep, "h = {h}: {all}");
        assert!(all.reason().starts_with("the time step is too large: H − H̄"), "{all}");
        // windows do not see all that H does, and the errors of many phases add up to little
        let [all, of_windows] = diagnoses(&oscillators(h, false), h);
        for found in [windows, all, of_windows] {
            let is_large = found.method_error >= 0.4 * found.kinetic;
            let is_right =
                found.cause == Cause::TimeStep || !is_large && matches!(found.cause, Cause::Nothing | Cause::Undecided);
            assert!(is_right, "h = {h}: {found}");
        }
    }
    for in_phase in [true, false] {
        for h in [0.05, 0.1, 0.2, 0.4] {
            for found in diagnoses(&oscillators(h, in_phase), h) {
                assert_eq!(found.cause, Cause::Nothing, "h = {h}: {found}");
            }
        }
    }
}

/// Frames of a file that is not sorted by atoms, as LAMMPS writes it unless it is asked to: of every `every`-th state
/// the atoms are in another order.
fn permuted(mut logged: Logged, every: usize) -> Logged {
    let dimension = logged.dimension;
    for n in (every - 1..logged.energies.len()).step_by(every) {
        for values in [&mut logged.q, &mut logged.p, &mut logged.gradients] {
            // an order of its own in each such state
            values[n * dimension..][..dimension].rotate_left(3 * (1 + n % 26));
        }
    }
    logged
}

#[test]
fn states_in_another_order_of_atoms_are_other_steps() {
    for every in [1, 7, 47] {
        let logged = permuted(Logged::new(&fluid(), &[1.0; 81], 0.002, fluid().start(), 1000), every);
        let [all, windows] = diagnoses(&logged, 0.002);
        let first = every.max(2) as i64 - 1;
        assert_eq!((all.cause, all.reordered), (Cause::OtherSteps, Some(first)), "{all}");
        assert!(all.reason().contains(&format!("first at the state {first}")), "{all}");
        assert_eq!(windows.cause, Cause::OtherSteps, "{windows}");
    }
    let sorted = Logged::new(&fluid(), &[1.0; 81], 0.002, fluid().start(), 1000);
    for found in diagnoses(&sorted, 0.002) {
        assert_eq!((found.cause, found.reordered), (Cause::Nothing, None), "{found}");
    }
}

/// As many particles leave the box on one side as on the other: sorted, their coordinates are nearly those of the step.
#[test]
fn positions_in_a_periodic_box_are_not_another_order() {
    const SIDE: f64 = 50.0;
    let mut logged = oscillators(0.2, false);
    logged.q.iter_mut().for_each(|q| *q = q.rem_euclid(SIDE));
    for found in diagnoses(&logged, 0.2) {
        assert_eq!((found.cause, found.reordered), (Cause::OtherSteps, None), "{found}");
        assert!(found.reason().contains("wrapped positions"), "{found}");
    }
}
