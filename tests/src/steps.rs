//! The four maps of a scheme with their weights, as values: one check serves every scheme without being compiled for
//! each.

use std::rc::Rc;

use shadowstep::kinetic::Quadratic;
use shadowstep::{Maps, Moves, Number, Rational, Scheme};

/// A map that moves any system with a kinetic energy of one class.
type Map<'a, N, C> = Box<dyn Fn(&mut dyn Maps<N, Class = C>) + 'a>;

/// The maps of a scheme at one step size.
pub struct Steps<'a, N, C = Quadratic> {
    step: Map<'a, N, C>,
    augmented: Map<'a, N, C>,
    back: Map<'a, N, C>,
    back_augmented: Map<'a, N, C>,
    /// The weights of a step, each times h.
    pub forward: Vec<N>,
    /// The weights of a step back.
    pub backward: Vec<N>,
}

/// Lets a scheme, which wants to know the type of what it moves, move anything.
struct Any<'a, N, C>(&'a mut dyn Maps<N, Class = C>);

impl<N, C> Maps<N> for Any<'_, N, C> {
    type Class = C;
    fn kick(&mut self, weight: &N) {
        self.0.kick(weight);
    }
    fn kick_augmented(&mut self, weight: &N) {
        self.0.kick_augmented(weight);
    }
    fn drift(&mut self, weight: &N) {
        self.0.drift(weight);
    }
    fn drift_augmented(&mut self, weight: &N) {
        self.0.drift_augmented(weight);
    }
    fn restart_beta(&mut self) {
        self.0.restart_beta();
    }
}

impl<'a, N: Number + 'a, C: 'a> Steps<'a, N, C> {
    /// The steps of size h.
    pub fn of<S: Scheme + Moves<C>>(scheme: &'a S, h: &Rational, context: &N::Context) -> Self {
        let weights = Rc::new(scheme.weights::<N>(h, context));
        let [a, b, c, d] = std::array::from_fn(|_| Rc::clone(&weights));
        Steps {
            forward: weights.forward.as_ref().to_vec(),
            backward: weights.back.as_ref().to_vec(),
            step: Box::new(move |motion| scheme.step(&a, &mut Any(motion))),
            augmented: Box::new(move |motion| scheme.step_augmented(&b, &mut Any(motion))),
            back: Box::new(move |motion| scheme.step_back(&c, &mut Any(motion))),
            back_augmented: Box::new(move |motion| scheme.step_back_augmented(&d, &mut Any(motion))),
        }
    }

    /// One step.
    pub fn step(&self, motion: &mut dyn Maps<N, Class = C>) {
        (self.step)(motion);
    }

    /// One step that carries β.
    pub fn step_augmented(&self, motion: &mut dyn Maps<N, Class = C>) {
        (self.augmented)(motion);
    }

    /// One step back.
    pub fn step_back(&self, motion: &mut dyn Maps<N, Class = C>) {
        (self.back)(motion);
    }

    /// One step back that carries β.
    pub fn step_back_augmented(&self, motion: &mut dyn Maps<N, Class = C>) {
        (self.back_augmented)(motion);
    }
}
