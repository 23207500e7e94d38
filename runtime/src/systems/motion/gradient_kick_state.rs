//! What gradient kicks need beside the gradient.

use crate::number::Number;
use crate::systems::displaced::Displacements;
use crate::systems::gradient_kicks::{Curvature, GradientKicks, Place};
use crate::systems::kinetic::Kinetic;
use crate::systems::potential::Potential;

/// The force of gradient kicks with its scratch space, allocated when the first of them is made.
#[derive(Clone, Debug)]
pub(super) struct GradientKickState<N> {
    pub(super) kicks: GradientKicks<N>,
    /// 1 and −1.
    one: [N; 2],
    /// 0, where T_p is b.
    origin: Vec<N>,
    /// The potential's, for Hessian–vector products.
    scratch: Vec<N>,
}

/// U(q) and T(p) with their scratch space.
pub(super) struct Parts<'a, N, P, K> {
    pub(super) potential: &'a mut P,
    pub(super) kinetic: &'a K,
    pub(super) scratch: &'a mut [N],
    pub(super) kinetic_scratch: &'a mut [N],
}

impl<N: Number> GradientKickState<N> {
    /// Room for the second derivatives of a potential.
    ///
    /// # Panics
    /// If the potential has no Hessian–vector product.
    pub(super) fn new(potential: &impl Potential<N>, context: &N::Context) -> Self {
        let hessian = potential.hessian().expect(
            "gradient kicks need the Hessian–vector product of the potential: write it as a formula, or implement \
                `Potential::hessian`",
        );
        let mut scratch = vec![N::zero(context); hessian.hessian_scratch()];
        hessian.prepare_hessian(&mut scratch, context);
        GradientKickState { scratch, ..GradientKickState::with(None, potential.dimension(), context) }
    }

    /// Room for displaced forces.
    pub(super) fn displaced(displacements: Displacements<N>, dimension: usize, context: &N::Context) -> Self {
        GradientKickState::with(Some(displacements), dimension, context)
    }

    fn with(displacements: Option<Displacements<N>>, dimension: usize, context: &N::Context) -> Self {
        let one = [1, -1].map(|one| N::from_rational(&crate::Rational::from_integer(one.into()), context));
        let (kicks, origin) =
            (GradientKicks::new(dimension, displacements, context), vec![N::zero(context); dimension]);
        GradientKickState { kicks, one, origin, scratch: Vec::new() }
    }

    /// Computes the force for a gradient kick of this weight, and the rate where it is wanted, unless they are known.
    pub(super) fn evaluate<P: Potential<N>, K: Kinetic<N>>(
        &mut self,
        parts: Parts<'_, N, P, K>,
        at: Place<'_, N>,
        weight: &N,
        with_rate: bool,
    ) {
        let GradientKickState { kicks, one, origin, scratch } = self;
        kicks.evaluate(&mut MotionCurvature { parts, one, origin, hessian_scratch: scratch }, at, weight, with_rate);
    }
}

struct MotionCurvature<'a, N, P, K> {
    parts: Parts<'a, N, P, K>,
    one: &'a [N; 2],
    origin: &'a [N],
    hessian_scratch: &'a mut [N],
}

impl<N: Number, P: Potential<N>, K: Kinetic<N>> Curvature<N> for MotionCurvature<'_, N, P, K> {
    fn assign_velocity(&mut self, gradient: &[N], velocity: &mut [N]) {
        // the drift of a quadratic T moves by M⁻¹ times a vector, and by b
        let [one, minus] = self.one;
        velocity.iter_mut().for_each(N::assign_zero);
        self.parts.kinetic.drift(one, gradient, velocity, self.parts.kinetic_scratch);
        if self.parts.kinetic.has_linear_terms() {
            self.parts.kinetic.drift(minus, self.origin, velocity, self.parts.kinetic_scratch);
        }
    }

    fn hessian_product(&mut self, at: Place<'_, N>, v: &[N], product: &mut [N], rate: Option<&mut N>) {
        let hessian = self.parts.potential.hessian().expect("it was there before");
        match rate {
            Some(rate) => hessian.hessian_product_and_rate(at.q, v, product, rate, self.hessian_scratch),
            None => hessian.hessian_product(at.q, v, product, self.hessian_scratch),
        }
    }

    fn gradient(&mut self, q: &[N], gradient: &mut [N], rate: Option<&mut N>) {
        let Parts { potential, scratch, .. } = &mut self.parts;
        potential.update(q);
        match rate {
            Some(rate) => potential.gradient_and_rate(q, gradient, rate, scratch),
            None => potential.gradient(q, gradient, scratch),
        }
    }
}
