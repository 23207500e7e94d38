//! Second derivatives of potentials, as force-gradient kicks need them.

use crate::number::Number;

/// The Hessian–vector product U_qq v of a potential.
///
/// With v = M⁻¹U_q it is the force of a gradient kick, p += 2h³ c U_qq M⁻¹U_q. A formula of [`crate::potential!`] has
/// it, derived; a custom potential implements this and returns itself from
/// [`Potential::hessian`](crate::Potential::hessian).
///
/// ```
/// use shadowstep::systems::potential::HessianProduct;
/// use shadowstep::{Motion, Potential, Stepper, UnitMasses, tables::shipped};
///
/// /// U = q⁴/4
/// struct Quartic;
///
/// impl Potential<f64> for Quartic {
///     fn dimension(&self) -> usize { 1 }
///     fn energy(&self, q: &[f64], energy: &mut f64, _: &mut [f64]) { *energy = q[0].powi(4) / 4.0; }
///     fn gradient(&self, q: &[f64], gradient: &mut [f64], _: &mut [f64]) { gradient[0] = q[0].powi(3); }
///     fn hessian(&self) -> Option<&dyn HessianProduct<f64>> { Some(self) }
/// }
///
/// impl HessianProduct<f64> for Quartic {
///     fn hessian_product(&self, q: &[f64], v: &[f64], product: &mut [f64], _: &mut [f64]) {
///         product[0] = 3.0 * q[0] * q[0] * v[0];
///     }
///     fn hessian_product_and_rate(&self, q: &[f64], v: &[f64], product: &mut [f64], rate: &mut f64, scratch: &mut [f64]) {
///         self.hessian_product(q, v, product, scratch);
///         *rate = 2.0 * q[0].powi(3) * v[0]; // (3 − 1) vᵀU_q: U_q has degree 3
///     }
/// }
///
/// let mut motion = Motion::new(Quartic, UnitMasses, [1.0], [0.0])?;
/// let start = motion.energy();
/// let stepper = Stepper::new(shipped("chin-4a").unwrap(), "1/20")?;
/// (0..1000).for_each(|_| stepper.step(&mut motion));
/// assert!((motion.energy() - start).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait HessianProduct<N: Number> {
    /// The number of scratch numbers that every call needs.
    fn hessian_scratch(&self) -> usize {
        0
    }

    /// Prepares the scratch space: values that do not depend on q. Called once, before all other calls.
    fn prepare_hessian(&self, scratch: &mut [N], context: &N::Context) {
        let _ = (scratch, context);
    }

    /// product ← U_qq(q) v, as long as q
    fn hessian_product(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N]);

    /// The product with the same bits, and rate ← vᵀ∂(qᵀU_q − 2U)/∂q = qᵀU_qq v − vᵀU_q.
    ///
    /// A term of U that is homogeneous of degree k adds (k − 2) times its own vᵀU_q, a quadratic one nothing. With v =
    /// M⁻¹U_q, a gradient kick adds −2h³ c times the rate to β.
    fn hessian_product_and_rate(&self, q: &[N], v: &[N], product: &mut [N], rate: &mut N, scratch: &mut [N]);
}
