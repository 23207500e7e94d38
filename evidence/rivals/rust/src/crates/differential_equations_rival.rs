//! The crate differential-equations: its symplectic schemes, and DOP853.

use differential_equations::methods::{ExplicitRungeKutta, SymplecticIntegrator};
use differential_equations::prelude::{Hamiltonian, IVP};

use crate::Newton;
use crate::protocol::Request;

struct Separable<'a>(&'a Newton);

/// The crate's vectors have room for q and p; either is in the first half.
impl<const BOTH: usize> Hamiltonian<f64, [f64; BOTH]> for Separable<'_> {
    fn velocity(&self, _: f64, _: &[f64; BOTH], p: &[f64; BOTH], dq: &mut [f64; BOTH]) {
        dq[..BOTH / 2].copy_from_slice(&p[..BOTH / 2]);
    }

    fn force(&self, _: f64, q: &[f64; BOTH], _: &[f64; BOTH], dp: &mut [f64; BOTH]) {
        self.0.accelerate(&q[..BOTH / 2], &mut dp[..BOTH / 2]);
    }
}

pub(crate) fn integrate<const BOTH: usize>(
    newton: &Newton,
    request: &Request,
    method: &str,
    state: &[f64],
    until: f64,
) -> Vec<f64> {
    let y = <[f64; BOTH]>::try_from(state).expect("the dimension");
    let system = Separable(newton);
    let problem = IVP::hamiltonian(&system, 0.0, until, y);
    let h = || request.until / request.steps() as f64;
    let solution = match method {
        "velocity_verlet" => {
            problem.method(SymplecticIntegrator::velocity_verlet(h()).max_steps(usize::MAX)).t_eval([until]).solve()
        }
        "ruth_forest" => {
            problem.method(SymplecticIntegrator::ruth_forest(h()).max_steps(usize::MAX)).t_eval([until]).solve()
        }
        "dop853" => {
            let tolerance: f64 = request.parameter.parse().expect("a tolerance");
            let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(usize::MAX);
            problem.method(method).t_eval([until]).solve()
        }
        other => panic!("no method {other}"),
    };
    // it stops where a state is not finite, or where round-off makes one step too many
    solution.ok().and_then(|solution| solution.y.last().copied()).unwrap_or([f64::NAN; BOTH]).to_vec()
}
