//! The crate utsuroi: Störmer–Verlet, Yoshida's schemes and DOP853.

use nalgebra::SVector;
use utsuroi::{Dop853, DynamicalSystem, State, StormerVerlet, Tolerances, Yoshida4, Yoshida6, Yoshida8};

use crate::Newton;
use crate::protocol::Request;

struct System<'a, const D: usize>(&'a Newton);

impl<const D: usize> DynamicalSystem for System<'_, D> {
    type State = State<D, 2>;

    #[inline]
    fn derivatives(&self, _: f64, state: &State<D, 2>) -> State<D, 2> {
        let mut acceleration = SVector::<f64, D>::zeros();
        self.0.accelerate(state.y().as_slice(), acceleration.as_mut_slice());
        State::from_derivative(*state.dy(), acceleration)
    }
}

pub(crate) fn integrate<const D: usize>(
    newton: &Newton,
    request: &Request,
    method: &str,
    state: &[f64],
    until: f64,
) -> Vec<f64> {
    let (q, v) = state.split_at(D);
    let start = State::<D, 2>::new(SVector::from_column_slice(q), SVector::from_column_slice(v));
    let system = System::<D>(newton);
    let steps = |step: &dyn Fn(&State<D, 2>, f64) -> State<D, 2>| {
        let h = request.until / request.steps() as f64;
        (0..request.steps() / request.samples).fold(start.clone(), |state, _| step(&state, h))
    };
    let end = match method {
        "StormerVerlet" => steps(&|state, h| StormerVerlet.step(&system, 0.0, state, h)),
        "Yoshida4" => steps(&|state, h| Yoshida4.step(&system, 0.0, state, h)),
        "Yoshida6" => steps(&|state, h| Yoshida6.step(&system, 0.0, state, h)),
        "Yoshida8" => steps(&|state, h| Yoshida8.step(&system, 0.0, state, h)),
        "Dop853" => {
            let tolerance = request.parameter.parse().expect("a tolerance");
            let tolerances = Tolerances { rtol: tolerance, atol: tolerance };
            let mut stepper = Dop853.stepper(&system, start, 0.0, until / 1e4, tolerances);
            let never = |_: f64, _: &State<D, 2>| std::ops::ControlFlow::<()>::Continue(());
            match stepper.advance_to(until, |_, _| {}, never) {
                Ok(_) => stepper.into_state(),
                Err(_) => return vec![f64::NAN; 2 * D],
            }
        }
        other => panic!("no method {other}"),
    };
    end.y().iter().chain(end.dy().iter()).copied().collect()
}
