//! Reference solutions at 40 digits.

use shadowstep::shadow::exact_flow::{ExactFlow, has_exact_flow};
use shadowstep::number::{Float, Real, Precision};
use shadowstep::shadow::run::States as _;
use shadowstep::steps::step_size::StepSize;
use shadowstep::{Stepper, tables};

use crate::integrate::step_size;
use crate::problems::setup;

/// Prints q at the end: of the exact flow where it is known, else of a scheme of order 10 with a number of steps.
pub fn print(problem: &str, until: &str, steps: &str) {
    let setup = setup(problem);
    let digits = Precision::digits(40).expect("40 digits are allowed");
    let until: f64 = until.parse().expect("a time");
    let q = if has_exact_flow(&setup).is_ok() {
        let h = StepSize::try_from(step_size(until, 1)).expect("a step size");
        let mut flow = ExactFlow::<Float>::new(&setup, &h, 1, 0, &digits).expect("the exact flow");
        flow.advance().expect("the initial state");
        flow.advance().expect("a finite state").expect("the final state").q.to_vec()
    } else {
        let steps = steps.parse().expect("a number of steps");
        let mut motion = setup.motion::<Float>(&digits).expect("positive masses");
        let scheme = tables::shipped("sofroniou-spaletta10-35").expect("a shipped scheme");
        let stepper = Stepper::with_context(scheme, step_size(until, steps), &digits).expect("a step size");
        (0..steps).for_each(|_| stepper.step(&mut motion));
        motion.q().to_vec()
    };
    let texts: Vec<_> = q.iter().map(Real::to_text).collect();
    println!("{}", texts.join(" "));
}
