//! The steps of a scheme as values, and what all of them have in common: one check serves every scheme without being
//! compiled for each.

use std::marker::PhantomData;

use shadowstep::steps::scheme::{Flows, MapKind, PartOrder, WeightLists, Weights};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{Carried, Number, Rational, Scheme, Stepper, System, ValidFor};

use crate::{Bits, check_increments, coordinates, log10_distance, log10_largest_distance, same_bits};

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

impl<N: Bits, C> Steps<N, C> {
    /// Steps are steps: augmented ones have the bits of plain ones, their increments are what q and p change by, and
    /// steps back undo all of it, to ε times 10^`digits_lost`.
    ///
    /// # Panics
    /// If one of that is not so, with `what`.
    pub fn check<M>(&self, what: &str, start: impl Fn() -> M, count: u32, digits_lost: f64)
    where
        M: System<Number = N, Class = C>,
    {
        let [mut plain, mut augmented] = [start(), start()];
        let start = coordinates(&plain);
        let tolerance = start[0].log10_epsilon() + digits_lost;
        let mut betas = Vec::new();
        let same = |plain: &M, augmented: &M| {
            assert!(same_bits(&coordinates(plain), &coordinates(augmented)), "augmented steps move otherwise: {what}");
        };
        for _ in 0..count {
            self.step(&mut plain);
            let before = coordinates(&augmented);
            self.step_augmented(&mut augmented);
            same(&plain, &augmented);
            check_increments(&augmented, &before, digits_lost);
            betas.push(augmented.state().increments().beta.clone());
        }
        assert_eq!(plain.state().evaluations(), augmented.state().evaluations(), "{what}");
        let moved = log10_largest_distance(&coordinates(&plain), &start);
        assert!(moved > -4.0, "10^{moved}: the steps must move: {what}");
        for beta in betas.iter().rev() {
            self.step_back(&mut plain);
            self.step_back_augmented(&mut augmented);
            same(&plain, &augmented);
            let mut back = augmented.state().increments().beta.clone();
            back.negate();
            let off = log10_distance(beta, &back);
            assert!(beta.log10_abs() > -12.0 && off < tolerance, "β: {beta} there, −{back} back: {what}");
        }
        let off = log10_largest_distance(&coordinates(&plain), &start);
        assert!(off < tolerance, "10^{off} after steps and steps back: {what}");
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
