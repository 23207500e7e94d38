//! The steps of a scheme as values: one check serves every scheme without being compiled for each.

use std::marker::PhantomData;

use shadowstep::steps::scheme::{Flows, PartOrder, WeightLists, Weights};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{Carried, Number, Rational, Scheme, Stepper, System, ValidFor};

/// The maps of a step, of flows of any type.
type Maps<N> = Box<dyn Fn(&mut dyn Flows<Number = N>)>;

/// The steps of a scheme at one step size.
pub struct Steps<N, C = Quadratic> {
    maps: Maps<N>,
    maps_back: Maps<N>,
    /// The weights of a step, each times h.
    pub forward: Vec<N>,
    /// The weights of a step back.
    pub backward: Vec<N>,
    class: PhantomData<C>,
}

impl<N: Number + 'static, C> Steps<N, C> {
    /// The steps of size h.
    pub fn of<S: Scheme + ValidFor<C> + Clone + 'static>(scheme: S, h: &Rational, context: &N::Context) -> Self {
        let stepper = Stepper::<S, N>::with_context(scheme.clone(), h, context).expect("the step size is not 0");
        let weights = |weights: Weights<&[N]>| S::Weights::<N>::from_vecs(weights.map(N::clone, N::clone));
        let (forward, back) = (weights(stepper.weights()), weights(stepper.weights_back()));
        let other = scheme.clone();
        Steps {
            forward: stepper.weights().iter().cloned().collect(),
            backward: stepper.weights_back().iter().cloned().collect(),
            maps: Box::new(move |flows| scheme.forward(&forward, &mut Dynamic(flows))),
            maps_back: Box::new(move |flows| other.back(&back, &mut Dynamic(flows))),
            class: PhantomData,
        }
    }

    /// One step.
    pub fn step<M: System<Number = N, Class = C>>(&self, system: &mut M) {
        (self.maps)(&mut Carrying { system, carried: Carried::Nothing });
    }

    /// One step that carries β.
    pub fn step_augmented<M: System<Number = N, Class = C>>(&self, system: &mut M) {
        system.clear_increments();
        (self.maps)(&mut Carrying { system, carried: Carried::Increments });
    }

    /// One step back.
    pub fn step_back<M: System<Number = N, Class = C>>(&self, system: &mut M) {
        (self.maps_back)(&mut Carrying { system, carried: Carried::Nothing });
    }

    /// One step back that carries β.
    pub fn step_back_augmented<M: System<Number = N, Class = C>>(&self, system: &mut M) {
        system.clear_increments();
        (self.maps_back)(&mut Carrying { system, carried: Carried::Increments });
    }
}

/// The flows of a system, with what they carry along.
struct Carrying<'a, M> {
    system: &'a mut M,
    carried: Carried,
}

impl<M: System> Flows for Carrying<'_, M> {
    type Number = M::Number;
    fn map(&mut self, kind: MapKind, weight: &M::Number) {
        self.system.map(kind, weight, self.carried);
    }
    fn middle_parts(&mut self, weight: &M::Number, order: PartOrder) {
        self.system.middle_parts(weight, order, self.carried);
    }
}

/// Flows of any type as one type.
struct Dynamic<'a, N>(&'a mut dyn Flows<Number = N>);

impl<N: Number> Flows for Dynamic<'_, N> {
    type Number = N;
    fn map(&mut self, kind: MapKind, weight: &N) {
        self.0.map(kind, weight);
    }
    fn middle_parts(&mut self, weight: &N, order: PartOrder) {
        self.0.middle_parts(weight, order);
    }
}
