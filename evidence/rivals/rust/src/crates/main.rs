//! Other crates as contestants: `CRATE/METHOD` is the method of a request.

mod differential_equations_rival;
mod forces;
mod initial;
mod ode_solvers_rival;
#[path = "../protocol.rs"]
mod protocol;
mod utsuroi_rival;

use forces::Gradient;
use initial::Initial;
use protocol::{Answer, Request, serve};

/// What the crates integrate: q″ = −M⁻¹U_q.
pub struct Newton {
    initial: Initial,
    gradient: Gradient,
}

impl Newton {
    /// acceleration ← −M⁻¹U_q
    #[inline]
    fn accelerate(&self, q: &[f64], acceleration: &mut [f64]) {
        (self.gradient)(&self.initial, q, acceleration);
        acceleration.iter_mut().zip(&self.initial.masses).for_each(|(a, m)| *a /= -m);
    }

    /// Integrates one sample after the other; `integrate` goes from the state (q, v) to its end over a time.
    fn samples(&self, request: &Request, mut integrate: impl FnMut(Vec<f64>, f64) -> Vec<f64>) -> Answer {
        let mut state = self.initial.positions_and_velocities();
        let mut answer = Answer::default();
        for _ in 0..request.samples {
            state = answer.time(|| integrate(state, request.until / request.samples as f64));
            let (q, v) = state.split_at(state.len() / 2);
            answer.state(q.iter().copied().chain(v.iter().zip(&self.initial.masses).map(|(v, m)| v * m)));
        }
        answer
    }
}

fn main() {
    serve(|request| match request.problem.as_str() {
        "kepler" => answer::<2, 4>(request, forces::kepler),
        "henon-heiles" => answer::<2, 4>(request, forces::henon_heiles),
        "outer-solar-system" => answer::<18, 36>(request, forces::outer),
        "fput-alpha" => answer::<32, 64>(request, forces::fput),
        other => panic!("no problem {other}"),
    });
}

fn answer<const D: usize, const BOTH: usize>(request: &Request, gradient: Gradient) -> Answer {
    let newton = Newton { initial: Initial::read(&request.problem), gradient };
    let (which, method) = request.method.split_once('/').expect("a crate and a method");
    newton.samples(request, |state, until| match which {
        "utsuroi" => utsuroi_rival::integrate::<D>(&newton, request, method, &state, until),
        "ode_solvers" => ode_solvers_rival::integrate::<BOTH>(&newton, request, &state, until),
        "differential-equations" => {
            differential_equations_rival::integrate::<BOTH>(&newton, request, method, &state, until)
        }
        other => panic!("no crate {other}"),
    })
}
