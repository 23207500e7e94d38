//! Transformed time: the system in q, t and p, p_t.

use shadowstep::transformed_time::{TimeTransformation, TransformedKinetic, TransformedPotential};
use shadowstep::{Kinetic, Motion, MotionError, Number, Potential};

use crate::boxed::Boxed;
use crate::scene::system::{ClassifiedKinetic, System};

impl System {
    /// The function of the transformed time, if time is transformed. The last coordinate of states is then t, its momentum p_t = −H(0).
    pub fn transformed_time(&self) -> Option<TimeTransformation> {
        match self.parts {
            super::Parts::TransformedTime(time) => Some(time),
            _ => None,
        }
    }

    /// The physical time of a state in the coordinates of the steps, where time is transformed.
    pub fn time_of<'s, N>(&self, q: &'s [N]) -> Option<&'s N> {
        self.transformed_time().and_then(|_| q.last())
    }

    /// The dimension of q in the coordinates of the steps.
    pub(crate) fn dimension(&self) -> usize {
        self.q.len() + usize::from(self.transformed_time().is_some())
    }

    /// q, 0 and p, −H
    pub(super) fn with_time<N: Number + 'static>(
        &self,
        (mut q, mut p): (Vec<N>, Vec<N>),
        context: &N::Context,
    ) -> (Vec<N>, Vec<N>) {
        let mut momentum = self.plain_energy(context)(&q, &p);
        momentum.negate();
        q.push(N::zero(context));
        p.push(momentum);
        (q, p)
    }

    /// The system of H′ at a state.
    pub(crate) fn in_transformed_time<N: Number + 'static>(
        &self,
        time: TimeTransformation,
        (q, p): (Vec<N>, Vec<N>),
        compensated: bool,
        context: &N::Context,
    ) -> Result<Boxed<N>, MotionError> {
        let potential = self.potential(context);
        match self.kinetic(context) {
            ClassifiedKinetic::Quadratic(kinetic) => motion(time, potential, kinetic, (q, p), compensated),
            ClassifiedKinetic::General(kinetic) => motion(time, potential, kinetic, (q, p), compensated),
        }
    }
}

fn motion<N: Number + 'static, K: Kinetic<N> + 'static>(
    time: TimeTransformation,
    potential: Box<dyn Potential<N>>,
    kinetic: K,
    (q, p): (Vec<N>, Vec<N>),
    compensated: bool,
) -> Result<Boxed<N>, MotionError> {
    let (potential, kinetic) = (TransformedPotential::new(time, potential), TransformedKinetic::new(time, kinetic));
    Ok(Boxed::General(Box::new(Motion::new(potential, kinetic, q, p)?.compensated_if(compensated))))
}
