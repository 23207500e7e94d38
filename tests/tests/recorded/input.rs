//! Logs that cannot be used.

use shadowstep::shadow::recorded::{RecordedError, Unwrapping, integer_momenta};

use super::*;

fn sentence<T>(result: Result<T, RecordedError>) -> String {
    result.err().map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn arrays_that_do_not_fit_are_refused() {
    let h = step_size("1/10");
    let log = |q: &[f64], energies: &[f64]| sentence(Log::with_gradients(2, [q, &[0.0; 4], &[0.0; 4]], energies));
    assert_eq!(log(&[0.0; 4], &[0.0; 2]), "");
    assert_eq!(log(&[0.0; 3], &[0.0; 2]), "q has 3 numbers, and 2 states of 2 numbers are 4");
    assert_eq!(log(&[0.0; 4], &[0.0; 3]), "q has 4 numbers, and 3 states of 2 numbers are 6");
    let numbers = [0.0; 4];
    let log = Log::with_gradients(2, [&numbers; 3], &[0.0; 2]).unwrap();
    let masses = |masses: &[f64]| sentence(Recorded::new(log, &h, masses));
    assert_eq!(masses(&[1.0, 0.0]), "the mass of coordinate 1 is 0; it must be positive and finite");
    assert_eq!(masses(&[1.0; 3]), "q of state 0 has 2 numbers, and there are 3 masses: one for each coordinate");
    assert_eq!(
        sentence(integer_momenta(2, 2, &numbers)),
        "momenta at half steps need 3 rows for 2 states: those before and after each state; there are 2"
    );
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    let h = step_size("1/10");
    let (zeros, mut forces) = ([0.0; 12], [0.0; 12]);
    forces[10] = f64::NAN;
    let log = Log::with_gradients(6, [&zeros, &zeros, &forces], &[0.0; 2]).unwrap();
    assert_eq!(
        sentence(Recorded::new(log, &h, &[1.0; 6])),
        "the gradient of state 1 is NaN at coordinate 4: y of particle 1, counted from 0; a log needs finite numbers"
    );
    let log = Log::with_rates(1, [&[0.0; 2], &[0.0; 2]], [&[0.0, f64::INFINITY], &[0.0; 2]]).unwrap();
    assert_eq!(sentence(Recorded::new(log, &h, &[1.0])), "U of state 1 is inf; a log needs finite numbers");
}

#[test]
fn a_move_whose_image_is_not_decided_is_refused() {
    let cell = [[8.0, 0.0, 0.0], [2.0, 8.0, 0.0], [0.0, 1.0, 8.0]];
    let mut unwrapping = Unwrapping::new(cell).unwrap();
    unwrapping.next(&[0.0; 6]).unwrap();
    // the image by the second and the third vector, and a little on
    let moved = unwrapping.next(&[0.0, 0.0, 0.0, -2.0, -8.9, -8.0]).unwrap().to_vec();
    assert!(moved.iter().zip([0.0, 0.0, 0.0, 0.0, 0.1, 0.0]).all(|(a, b)| (a - b).abs() < 1e-14), "{moved:?}");
    assert_eq!(
        sentence(unwrapping.next(&[0.0, 0.0, 3.0, 0.0, 0.0, 0.0])),
        "particle 0 moved by 0.38 of box vector 2 from state 1 to 2, at least: which image it came to is not decided; \
         log states more often, or unwrapped positions"
    );
    let mut along = Unwrapping::new(cell).unwrap().along([true, true, false]);
    along.next(&[0.0; 3]).unwrap();
    assert_eq!(along.next(&[0.0, 0.0, 6.0]).unwrap()[2], 6.0);
    assert!(sentence(Unwrapping::new([[1.0, 2.0, 3.0]; 3])).ends_with("span no volume"));
}
