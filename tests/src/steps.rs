//! The four kinds of steps of a stepper, as values: one check serves every scheme without being compiled for each.

use std::rc::Rc;

use shadowstep::kinetic::Quadratic;
use shadowstep::scheme::PartOrder;
use shadowstep::{Increments, Number, Rational, Remainders, Scheme, Stepper, System, ValidFor};

/// A step of any system of one class.
type Step<N, C> = Box<dyn Fn(&mut dyn System<Number = N, Class = C>)>;

/// The steps of a scheme at one step size.
pub struct Steps<N, C = Quadratic> {
    step: Step<N, C>,
    augmented: Step<N, C>,
    back: Step<N, C>,
    back_augmented: Step<N, C>,
    /// The weights of a step, each times h.
    pub forward: Vec<N>,
    /// The weights of a step back.
    pub backward: Vec<N>,
}

/// Any system as one type, since a stepper requires a type of known size.
struct Any<'a, N, C>(&'a mut dyn System<Number = N, Class = C>);

impl<N: Number, C> System for Any<'_, N, C> {
    type Number = N;
    type Class = C;
    fn q(&self) -> &[N] {
        self.0.q()
    }
    fn p(&self) -> &[N] {
        self.0.p()
    }
    fn increments(&self) -> Increments<'_, N> {
        self.0.increments()
    }
    fn set_state(&mut self, q: &[N], p: &[N]) {
        self.0.set_state(q, p);
    }
    fn remainders(&self) -> Remainders<N> {
        self.0.remainders()
    }
    fn set_remainders(&mut self, remainders: &Remainders<N>) {
        self.0.set_remainders(remainders);
    }
    fn is_compensated(&self) -> bool {
        self.0.is_compensated()
    }
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
    fn has_gradient_kicks(&self) -> bool {
        self.0.has_gradient_kicks()
    }
    fn gradient_kick(&mut self, weight: &N) {
        self.0.gradient_kick(weight);
    }
    fn gradient_kick_augmented(&mut self, weight: &N) {
        self.0.gradient_kick_augmented(weight);
    }
    fn middle_parts(&mut self, weight: &N, order: PartOrder) {
        self.0.middle_parts(weight, order);
    }
    fn middle_parts_augmented(&mut self, weight: &N, order: PartOrder) {
        self.0.middle_parts_augmented(weight, order);
    }
    fn clear_increments(&mut self) {
        self.0.clear_increments();
    }
    fn assign_energies(&mut self, energy: &mut N, kinetic: &mut N) {
        self.0.assign_energies(energy, kinetic);
    }
    fn assign_energies_at(&mut self, q: &[N], p: &[N], energy: &mut N, kinetic: &mut N) {
        self.0.assign_energies_at(q, p, energy, kinetic);
    }
    fn evaluations(&self) -> u64 {
        self.0.evaluations()
    }
    fn before_augmented_step(&mut self, follows: bool) {
        self.0.before_augmented_step(follows);
    }
    fn context(&self) -> N::Context {
        self.0.context()
    }
}

impl<N: Number + 'static, C: 'static> Steps<N, C> {
    /// The steps of size h.
    pub fn of<S: Scheme + ValidFor<C> + 'static>(scheme: S, h: &Rational, context: &N::Context) -> Self {
        let stepper = Stepper::<S, N>::with_context(scheme, h, context).expect("the step size is not 0");
        let stepper = Rc::new(stepper);
        let [a, b, c, d] = std::array::from_fn(|_| Rc::clone(&stepper));
        Steps {
            forward: stepper.weights().to_vec(),
            backward: stepper.weights_back().to_vec(),
            step: Box::new(move |system| a.step(&mut Any(system))),
            augmented: Box::new(move |system| b.step_augmented(&mut Any(system))),
            back: Box::new(move |system| c.step_back(&mut Any(system))),
            back_augmented: Box::new(move |system| d.step_back_augmented(&mut Any(system))),
        }
    }

    /// One step.
    pub fn step(&self, system: &mut dyn System<Number = N, Class = C>) {
        (self.step)(system);
    }

    /// One step that carries β.
    pub fn step_augmented(&self, system: &mut dyn System<Number = N, Class = C>) {
        (self.augmented)(system);
    }

    /// One step back.
    pub fn step_back(&self, system: &mut dyn System<Number = N, Class = C>) {
        (self.back)(system);
    }

    /// One step back that carries β.
    pub fn step_back_augmented(&self, system: &mut dyn System<Number = N, Class = C>) {
        (self.back_augmented)(system);
    }
}
