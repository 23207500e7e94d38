//! A potential whose calls choose the vector instructions.

use std::any::Any;
use std::iter::once;

use super::{FewCoordinates, HessianProduct, Potential, evaluate};
use crate::number::Number;

/// A potential behind a `dyn`, for [lanes](crate::number::Lanes): each call is compiled for the widest
/// instructions that the processor has.
///
/// A call of a `dyn Potential` is not inlined into the loop of steps, and so not compiled together with it. A potential
/// whose type is known is, and does not need this. Other numbers than lanes are computed as without it. Many steps of
/// systems with up to three coordinates, whose potentials are of one type, are one call.
///
/// ```
/// use shadowstep::systems::potential::{Potential, Vectorised};
/// use shadowstep::{Motion, UnitMasses, number::Lanes, problems::Kepler};
///
/// let potential: Box<dyn Potential<Lanes<8>>> = Box::new(Vectorised(Kepler));
/// let [zero, one] = [0.0, 1.0].map(Lanes::all);
/// let mut motion = Motion::new(potential, UnitMasses, [one, zero], [zero, one])?;
/// assert_eq!(motion.energy(), Lanes::all(-0.5));
/// # Ok::<(), shadowstep::MotionError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Vectorised<P>(pub P);

impl<N: Number, P: Potential<N> + 'static> Potential<N> for Vectorised<P> {
    fn dimension(&self) -> usize {
        self.0.dimension()
    }

    fn scratch(&self) -> usize {
        self.0.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.0.prepare(scratch, context);
    }

    fn update(&mut self, q: &[N]) {
        self.0.update(q);
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        N::in_widest_instructions(
            #[inline(always)]
            || self.0.energy(q, energy, scratch),
        );
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        N::in_widest_instructions(
            #[inline(always)]
            || self.0.gradient(q, gradient, scratch),
        );
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        N::in_widest_instructions(
            #[inline(always)]
            || self.0.gradient_and_rate(q, gradient, rate, scratch),
        );
    }

    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        self.0.hessian()
    }

    fn advance_few(&mut self, others: Vec<&mut dyn Any>, steps: &mut FewCoordinates<'_, N>) -> bool {
        let others = others.into_iter().map(|other| other.downcast_mut::<Self>().map(|other| &mut other.0));
        let Some(potentials) = once(Some(&mut self.0)).chain(others).collect::<Option<Vec<&mut P>>>() else {
            return false;
        };
        N::in_widest_instructions(
            #[inline(always)]
            || {
                // not before: here it is a constant of the type, of which the steps are compiled for this dimension
                // alone
                let dimension = potentials[0].dimension();
                steps.advance(
                    dimension,
                    potentials,
                    // a closure: a function would not be compiled for these instructions
                    #[inline(always)]
                    |potential: &mut P, q: &[N], gradient: &mut [N], scratch: &mut [N]| {
                        evaluate(potential, q, gradient, scratch);
                    },
                );
            },
        );
        true
    }

    fn as_any(&mut self) -> Option<&mut dyn Any> {
        Some(self)
    }
}
