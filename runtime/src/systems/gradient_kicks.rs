//! The force of gradient kicks, from second derivatives of B or from a force at displaced positions.

use crate::number::Number;
use crate::systems::displaced::Displacements;
use crate::systems::kept::KeptForce;

/// B(q), whose flow are kicks, and the M of A's kinetic part ½pᵀM⁻¹p.
pub(crate) trait PartOfKicks<N> {
    /// gradient ← B_q and, if asked for, rate ← qᵀB_q − 2B.
    fn gradient(&mut self, q: &[N], gradient: &mut [N], rate: Option<&mut N>);

    /// velocity ← M⁻¹ times a gradient
    fn assign_velocity(&mut self, gradient: &[N], velocity: &mut [N]);

    /// product ← B_qq v and, if asked for, rate ← vᵀ∂(qᵀB_q − 2B)/∂q, at a place.
    fn hessian_product(&mut self, at: Place<'_, N>, v: &[N], product: &mut [N], rate: Option<&mut N>);

    /// Once there was a gradient kick; what they keep belongs to the q of the last evaluation of the gradient.
    fn gradient_kicks(&mut self) -> &mut Option<Box<GradientKicks<N>>>;
}

/// A q with B_q and qᵀB_q − 2B there, the latter where rates are wanted.
#[derive(Debug)]
pub(crate) struct Place<'a, N> {
    pub(crate) q: &'a [N],
    pub(crate) gradient: &'a [N],
    pub(crate) rate: &'a N,
}

/// The force of gradient kicks at the present q.
#[derive(Clone, Debug)]
pub(crate) struct GradientKicks<N> {
    /// −B_qq M⁻¹B_q: a gradient kick subtracts weight times it from p, as a kick the gradient.
    pub(crate) force: Vec<N>,
    /// −vᵀ∂(qᵀB_q − 2B)/∂q with v = M⁻¹B_q: it adds weight times it to β.
    pub(crate) rate: N,
    pub(crate) kept: KeptForce,
    /// The Hessian–vector products or displaced forces computed so far.
    pub(crate) evaluations: u64,
    velocity: Vec<N>,
    displaced: Option<Displaced<N>>,
}

/// What displaced forces need.
#[derive(Clone, Debug)]
struct Displaced<N> {
    displacements: Displacements<N>,
    /// The place of the one that the kept force is of.
    last: usize,
    q: Vec<N>,
}

impl<N: Number> GradientKicks<N> {
    /// By second derivatives, unless there are displacements.
    pub(crate) fn new(dimension: usize, displacements: Option<Displacements<N>>, context: &N::Context) -> Self {
        let zeros = || vec![N::zero(context); dimension];
        let displaced = displacements.map(|displacements| Displaced { displacements, last: 0, q: zeros() });
        GradientKicks {
            force: zeros(),
            velocity: zeros(),
            rate: N::zero(context),
            kept: KeptForce::Nothing,
            evaluations: 0,
            displaced,
        }
    }

    /// Computes the force for a gradient kick of this weight, and the rate where it is wanted, unless they are known.
    pub(crate) fn evaluate(&mut self, of: &mut impl PartOfKicks<N>, at: Place<'_, N>, weight: &N, with_rate: bool) {
        let GradientKicks { force, rate, kept, evaluations, velocity, displaced } = self;
        let displaced = displaced.as_mut().map(|Displaced { displacements, last, q }| {
            let (place, delta) = displacements.of_weight(weight);
            if std::mem::replace(last, place) != place {
                *kept = KeptForce::Nothing;
            }
            (delta, q)
        });
        if kept.suffices(with_rate) {
            return;
        }
        of.assign_velocity(at.gradient, velocity);
        let wanted = with_rate.then_some(&mut *rate);
        match displaced {
            None => {
                of.hessian_product(at, velocity, force, wanted);
                force.iter_mut().for_each(N::negate);
                if with_rate {
                    rate.negate();
                }
            }
            // the quotients of differences, so that with the kick there is h a (B_q + δ force) = h a B_q(q′)
            Some((delta, q)) => {
                for ((displaced, q), v) in q.iter_mut().zip(at.q).zip(&*velocity) {
                    displaced.assign(q);
                    displaced.subtract_product(delta, v);
                }
                of.gradient(q, force, wanted);
                let quotient = |difference: &mut N, subtrahend: &N| {
                    difference.subtract(subtrahend);
                    difference.divide(delta);
                };
                force.iter_mut().zip(at.gradient).for_each(|(force, gradient)| quotient(force, gradient));
                if with_rate {
                    quotient(rate, at.rate);
                }
            }
        }
        *kept = KeptForce::with(with_rate);
        *evaluations += 1;
    }
}

/// Whether there are gradient kicks by displaced forces.
pub(crate) fn are_displaced<N>(gradient_kicks: Option<&GradientKicks<N>>) -> bool {
    gradient_kicks.is_some_and(|kicks| kicks.displaced.is_some())
}
