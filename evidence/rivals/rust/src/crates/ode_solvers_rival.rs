//! The crate ode_solvers: DOP853.

use nalgebra::SVector;
use ode_solvers::{Dop853, OutputType, System};

use crate::Newton;
use crate::protocol::Request;

struct FirstOrder<'a>(&'a Newton);

impl<const BOTH: usize> System<f64, SVector<f64, BOTH>> for FirstOrder<'_> {
    fn system(&self, _: f64, y: &SVector<f64, BOTH>, dy: &mut SVector<f64, BOTH>) {
        let (q, v) = y.as_slice().split_at(BOTH / 2);
        let (dq, dv) = dy.as_mut_slice().split_at_mut(BOTH / 2);
        dq.copy_from_slice(v);
        self.0.accelerate(q, dv);
    }
}

pub(crate) fn integrate<const BOTH: usize>(newton: &Newton, request: &Request, state: &[f64], until: f64) -> Vec<f64> {
    let tolerance = request.parameter.parse().expect("a tolerance");
    let y = SVector::<f64, BOTH>::from_column_slice(state);
    // all default values but for the number of steps and the output
    let mut stepper = Dop853::from_param(
        FirstOrder(newton),
        0.0,
        until,
        0.0,
        y,
        tolerance,
        tolerance,
        0.9,
        0.0,
        0.333,
        6.0,
        until,
        0.0,
        u32::MAX,
        1000,
        OutputType::Sparse,
    );
    match stepper.integrate() {
        Ok(_) => stepper.y_out().last().expect("a state").as_slice().to_vec(),
        Err(_) => vec![f64::NAN; BOTH],
    }
}
