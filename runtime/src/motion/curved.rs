//! What gradient kicks need beside the gradient.

use super::kept::Kept;
use crate::kinetic::Kinetic;
use crate::number::Number;
use crate::potential::Potential;

/// The force of gradient kicks, allocated when the first of them is made.
#[derive(Clone, Debug)]
pub(super) struct Curved<N> {
    /// −U_qq M⁻¹U_q: a gradient kick subtracts weight times it from p, as a kick the gradient.
    pub(super) force: Vec<N>,
    /// −vᵀ∂(qᵀU_q − 2U)/∂q with v = M⁻¹U_q: it adds weight times it to β.
    pub(super) rate: N,
    pub(super) kept: Kept,
    /// The Hessian–vector products computed so far.
    pub(super) evaluations: u64,
    velocity: Vec<N>,
    one: N,
    /// The potential's, for Hessian–vector products.
    scratch: Vec<N>,
}

impl<N: Number> Curved<N> {
    /// Room for a potential's.
    ///
    /// # Panics
    /// If the potential has no Hessian–vector product.
    pub(super) fn new(potential: &impl Potential<N>, context: &N::Context) -> Self {
        let hessian = potential.hessian().expect(
            "gradient kicks need the Hessian–vector product of the potential: write it as a formula, or implement `Potential::hessian`",
        );
        let zeros = |count: usize| vec![N::zero(context); count];
        let mut scratch = zeros(hessian.hessian_scratch());
        hessian.prepare_hessian(&mut scratch, context);
        let (force, velocity) = (zeros(potential.dimension()), zeros(potential.dimension()));
        let one = N::from_rational(&crate::Rational::from_integer(1.into()), context);
        Curved { force, velocity, rate: N::zero(context), kept: Kept::Nothing, evaluations: 0, one, scratch }
    }

    /// Computes the force, and the rate where it is wanted, from the gradient at q.
    pub(super) fn evaluate(
        &mut self,
        (potential, kinetic): (&impl Potential<N>, &impl Kinetic<N>),
        (q, gradient): (&[N], &[N]),
        with_rate: bool,
        kinetic_scratch: &mut [N],
    ) {
        let hessian = potential.hessian().expect("it was there before");
        let Curved { force, rate, velocity, one, scratch, .. } = self;
        // the drift of a quadratic T moves by M⁻¹ times a vector
        velocity.iter_mut().for_each(N::assign_zero);
        kinetic.drift(one, gradient, velocity, kinetic_scratch);
        if with_rate {
            hessian.hessian_product_and_rate(q, velocity, force, rate, scratch);
            rate.negate();
            self.kept = Kept::GradientAndRate;
        } else {
            hessian.hessian_product(q, velocity, force, scratch);
            self.kept = Kept::Gradient;
        }
        force.iter_mut().for_each(N::negate);
        self.evaluations += 1;
    }
}
