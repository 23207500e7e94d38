//! Positions at the times at which errors are taken: the ends of equal parts of a run.

use shadowstep::{Ordered, Scheme, Stepper, System, ValidFor};
use shadowstep_scenes::start::Work;

/// Makes all steps; calls with the number of each sample and the system there, as long as that returns true. A processed scheme has made its
/// pre-map before.
pub(crate) fn at_samples<S, M>(
    stepper: &Stepper<S, M::Number>,
    system: &mut M,
    (steps, samples): (u64, u64),
    mut take: impl FnMut(usize, &mut M) -> bool,
) where
    S: Scheme + ValidFor<M::Class>,
    M: System,
{
    for sample in 0..samples {
        (0..steps / samples).for_each(|_| stepper.step(system));
        if !stepper.at_output(system, |system| take(sample as usize, system)) {
            return;
        }
    }
}

/// The positions of a run at its samples; fewer where they are not finite.
pub(crate) struct Positions {
    pub(crate) steps: u64,
    pub(crate) samples: u64,
}

impl<N: Ordered> Work<N> for Positions {
    type Output = Vec<Vec<N>>;

    fn with<S, M>(self, stepper: &Stepper<S, N>, mut system: M) -> Self::Output
    where
        S: Scheme + Clone + ValidFor<M::Class> + 'static,
        M: System<Number = N> + 'static,
    {
        let mut positions = Vec::new();
        at_samples(stepper, &mut system, (self.steps, self.samples), |_, system| {
            let finite = system.q().iter().all(N::is_finite);
            if finite {
                positions.push(system.q().to_vec());
            }
            finite
        });
        positions
    }
}

/// |a − b|², in the number type of both.
pub(crate) fn square_distance<N: Ordered>(a: &[N], b: &[N], context: &N::Context) -> N {
    let [mut sum, mut difference] = [N::zero(context), N::zero(context)];
    for (a, b) in a.iter().zip(b) {
        difference.assign_difference(a, b);
        sum.add_product(&difference, &difference);
    }
    sum
}
