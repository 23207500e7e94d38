//! Potentials U(q).

mod from_fn;

pub use from_fn::{FromFn, from_fn};

use crate::number::Number;

/// A potential U(q) with its gradient, for one kind of numbers or, written once, for all.
///
/// A potential declares how many numbers of scratch space it needs, and gets them with every call: big numbers are allocated
/// once, not per call.
///
/// ```
/// use shadowstep::{Number, Potential};
///
/// /// U = q⁴/4
/// struct Quartic;
///
/// impl<N: Number> Potential<N> for Quartic {
///     fn dimension(&self) -> usize { 1 }
///     fn scratch(&self) -> usize { 1 }
///     fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
///         scratch[0].assign_square(&q[0]);
///         energy.assign_square(&scratch[0]);
///         energy.divide_integer(4);
///     }
///     fn gradient(&self, q: &[N], gradient: &mut [N], _: &mut [N]) {
///         gradient[0].assign_square(&q[0]);
///         gradient[0].multiply(&q[0]);
///     }
/// }
/// ```
pub trait Potential<N: Number> {
    /// The dimension of q.
    fn dimension(&self) -> usize;

    /// The number of scratch numbers that every call needs.
    fn scratch(&self) -> usize {
        0
    }

    /// Prepares the scratch space: values that do not depend on q. Called once, before all other calls, and again when the
    /// potential has changed.
    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let _ = (scratch, context);
    }

    /// energy ← U(q)
    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]);

    /// gradient ← U_q(q), as long as q
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]);

    /// gradient ← U_q(q), rate ← qᵀU_q − 2U
    ///
    /// The rate is what a kick adds to β (Moan & Niesen, eq. 2, whose printed sign is wrong). A term of U that is
    /// homogeneous of degree k adds (k − 2) times itself, a quadratic one nothing; this costs less than the definition, which is the
    /// default implementation.
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.gradient(q, gradient, scratch);
        self.energy(q, rate, scratch);
        rate.multiply_integer(-2);
        for (q, gradient) in q.iter().zip(gradient) {
            rate.add_product(q, gradient);
        }
    }
}

impl<N: Number, P: Potential<N> + ?Sized> Potential<N> for Box<P> {
    fn dimension(&self) -> usize {
        (**self).dimension()
    }
    fn scratch(&self) -> usize {
        (**self).scratch()
    }
    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        (**self).prepare(scratch, context);
    }
    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        (**self).energy(q, energy, scratch);
    }
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        (**self).gradient(q, gradient, scratch);
    }
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        (**self).gradient_and_rate(q, gradient, rate, scratch);
    }
}
