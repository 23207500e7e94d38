//! Positions at the times at which errors are taken: the ends of equal parts of a run.

use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::{Carried, Integrator as _, Real};

/// The positions of a run at its samples; fewer where they are not finite.
pub(crate) fn at_samples<N: Real>(integrator: &mut VectorIntegrator<'_, N>, steps: u64, samples: u64) -> Vec<Vec<N>> {
    let mut positions = Vec::new();
    for _ in 0..samples {
        (0..steps / samples).for_each(|_| integrator.step(Carried::Nothing));
        let q = at_output(integrator, |integrator| integrator.state().q().to_vec());
        if !q.iter().all(N::is_finite) {
            break;
        }
        positions.push(q);
    }
    positions
}

/// |a − b|², in the number type of both.
pub(crate) fn square_distance<N: Real>(a: &[N], b: &[N], context: &N::Context) -> N {
    let [mut sum, mut difference] = [N::zero(context), N::zero(context)];
    for (a, b) in a.iter().zip(b) {
        difference.assign_difference(a, b);
        sum.add_product(&difference, &difference);
    }
    sum
}
