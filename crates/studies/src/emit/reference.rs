//! What the self-tests expect: Kepler's problem with e = 3/5, computed by `shadowstep` with the scheme that is emitted.

use std::ops::Range;

use shadowstep::problems::problem;
use shadowstep::shadow::exact_flow::ExactFlow;
use shadowstep::shadow::run::States;
use shadowstep::systems::potential::HessianProduct;
use shadowstep::tables::TableScheme;
use shadowstep::{Motion, Potential, Rational, StepSize, Stepper, UnitMasses};

/// The steps of the run whose end a self-test compares.
pub(crate) const STEPS: u32 = 1000;

/// Their size is 1/64: the products of h with weights are exact, so that h a_s, rounded once, is h times the rounded
/// weight.
pub(crate) const HALVINGS: u32 = 6;

/// The farthest that other roundings may take a run from the expected end.
pub(crate) const TOLERANCE: &str = "1e-11";

/// The time at which the order is measured: behind the next pericentre.
pub(crate) const TIME: u32 = 8;

/// The least error from which an order is taken. Round-off is some 1e-14.
const LEAST_ERROR: f64 = 5e-12;

/// The largest error from which an order is taken.
const LARGEST_ERROR: f64 = 0.1;

/// How far below the proved order and above it an observed one may be. The self-tests accept half an order less.
/// McLachlan and Atela's scheme of order 5 shows order 6 until round-off is reached.
const NEAR: Range<f64> = -0.35..1.6;

/// The finest step size at which the order is measured is 2^−FINEST.
const FINEST: u32 = 9;

/// A state q, p.
pub(crate) type State = [f64; 4];

/// Where the order can be measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OrderRun {
    /// The coarser number of steps to t = 8; the finer is twice that.
    pub(crate) steps: u32,
    /// The exact state there, rounded.
    pub(crate) exact: State,
}

/// U = −1/r, its derivatives in operations whose order the emitted self-tests repeat.
struct Kepler;

impl Potential<f64> for Kepler {
    fn dimension(&self) -> usize {
        2
    }

    fn energy(&self, q: &[f64], energy: &mut f64, _: &mut [f64]) {
        *energy = -1.0 / (q[0] * q[0] + q[1] * q[1]).sqrt();
    }

    fn gradient(&self, q: &[f64], gradient: &mut [f64], _: &mut [f64]) {
        let r2 = q[0] * q[0] + q[1] * q[1];
        let r3 = r2 * r2.sqrt();
        gradient[0] = q[0] / r3;
        gradient[1] = q[1] / r3;
    }

    fn hessian(&self) -> Option<&dyn HessianProduct<f64>> {
        Some(self)
    }
}

impl HessianProduct<f64> for Kepler {
    fn hessian_product(&self, q: &[f64], v: &[f64], product: &mut [f64], _: &mut [f64]) {
        let r2 = q[0] * q[0] + q[1] * q[1];
        let r3 = r2 * r2.sqrt();
        let s = 3.0 * (q[0] * v[0] + q[1] * v[1]) / r2;
        product[0] = (v[0] - s * q[0]) / r3;
        product[1] = (v[1] - s * q[1]) / r3;
    }

    fn hessian_product_and_rate(&self, q: &[f64], v: &[f64], product: &mut [f64], rate: &mut f64, scratch: &mut [f64]) {
        self.hessian_product(q, v, product, scratch);
        let r2 = q[0] * q[0] + q[1] * q[1];
        *rate = -3.0 * (q[0] * v[0] + q[1] * v[1]) / (r2 * r2.sqrt());
    }
}

/// The state at the end of the run that a self-test compares.
pub(crate) fn end(scheme: &TableScheme) -> State {
    run(scheme, HALVINGS, STEPS)
}

/// The state after `steps` steps of size 2^−halvings from the pericentre.
fn run(scheme: &TableScheme, halvings: u32, steps: u32) -> State {
    let stepper = Stepper::new(scheme.clone(), fraction(1, halvings)).expect("the step size is a power of two");
    let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).expect("the state has two dimensions");
    stepper.preprocess(&mut motion);
    (0..steps).for_each(|_| stepper.step(&mut motion));
    stepper.at_output(&mut motion, |motion| [motion.q()[0], motion.q()[1], motion.p()[0], motion.p()[1]])
}

/// numerator/2^halvings
fn fraction(numerator: u32, halvings: u32) -> StepSize {
    StepSize::try_from(Rational::new(numerator.into(), (1_u64 << halvings).into())).expect("it is not 0")
}

/// The finest pair of step sizes whose errors are well above round-off and show the order.
pub(crate) fn order_run(scheme: &TableScheme, order: u32) -> Option<OrderRun> {
    let exact = exact();
    let error = |halvings| largest_difference(&run(scheme, halvings, TIME << halvings), &exact);
    let (mut found, mut coarse) = (None, error(0));
    for halvings in 1..=FINEST {
        let fine = error(halvings);
        if fine < LEAST_ERROR {
            break;
        }
        let observed = (coarse / fine).log2();
        if coarse < LARGEST_ERROR && NEAR.contains(&(observed - f64::from(order))) {
            found = Some(OrderRun { steps: TIME << (halvings - 1), exact });
        }
        coarse = fine;
    }
    found
}

/// The exact state at t = 8, rounded.
fn exact() -> State {
    let kepler = problem("kepler").expect("it is shipped").setup(&[], 40).expect("its defaults are in their ranges");
    let time = fraction(TIME, 0);
    let mut flow = ExactFlow::<f64>::new(&kepler, &time, 1, 0, &()).expect("the exact flow is known");
    let mut state = [0.0; 4];
    while let Some(at) = flow.advance().expect("the states are finite") {
        state = [at.q[0], at.q[1], at.p[0], at.p[1]];
    }
    state
}

fn largest_difference(a: &State, b: &State) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::check_potential;
    use shadowstep::tables::{shipped, shipped_names};

    use crate::emit::step::Step;

    #[test]
    fn the_order_of_all_schemes_shows() {
        for name in shipped_names() {
            let scheme = shipped(name).unwrap();
            assert!(order_run(&scheme, Step::of(&scheme).order()).is_some(), "{name}");
        }
    }

    #[test]
    fn the_end_is_that_of_the_shipped_problem() {
        for name in ["stormer-verlet", "blanes-moan-srkn6b", "chin-4a", "wisdom-kernel-5"] {
            let scheme = shipped(name).unwrap();
            let stepper = Stepper::new(scheme.clone(), 1.0 / 64.0).unwrap();
            let mut motion = Motion::new(shadowstep::problems::Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap();
            stepper.preprocess(&mut motion);
            (0..STEPS).for_each(|_| stepper.step(&mut motion));
            let found = stepper.at_output(&mut motion, |at| [at.q()[0], at.q()[1], at.p()[0], at.p()[1]]);
            // its formula has other operations: round-off of 1000 steps
            assert!(largest_difference(&found, &end(&scheme)) < 1e-11, "{name} {found:?}");
        }
    }

    #[test]
    fn the_derivatives_of_the_potential_agree() {
        let check = check_potential(&mut Kepler, &[[0.4, 0.3], [-1.0, 0.7]]).unwrap();
        assert!(check.hessian.is_some() && check.agrees(), "{check}");
    }
}
