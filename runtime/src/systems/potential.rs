//! Potentials U(q).

mod few_coordinates;
mod from_fn;
mod hessian;
mod prepared;
mod program;
mod sum;
mod vectorised;

pub use few_coordinates::FewCoordinates;
pub(crate) use few_coordinates::FewOfSystem;
pub use from_fn::{FromFn, from_fn};
pub use hessian::HessianProduct;
pub(crate) use prepared::Prepared;
pub use program::GradientProgram;
pub(crate) use program::SYSTEMS;
pub use sum::Sum;
pub use vectorised::Vectorised;

use std::any::Any;

use crate::number::Number;

/// A potential U(q) with its gradient, for one kind of numbers or, written once, for all.
///
/// **Smoothness.** A scheme of order r needs U with at least r continuous derivatives. Where the m-th derivative of U
/// jumps, as at a cutoff, a crossing changes the energy by a part of the size of h^m, so that orders above m gain
/// nothing in the long run: a truncated potential has m = 0, a shifted one m = 1, a force-shifted one m = 2.
///
/// **The gradient must belong to the energy**, and the rate must be qᵀU_q − 2U of the same coordinates: with periodic
/// images q stays unwrapped, and the rate is not the virial of the images. [`check_potential`](crate::check_potential)
/// compares them.
///
/// A potential declares how many numbers of scratch space it needs, and gets them with every call: big numbers are
/// allocated once, not per call.
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

    /// Prepares the scratch space: values that do not depend on q. Called once, before all other calls, and again when
    /// the potential has changed.
    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let _ = (scratch, context);
    }

    /// Prepares what depends on q, such as a list of neighbours. Called before each evaluation at q, also where q is
    /// the same as before. The default does nothing.
    ///
    /// A list that is kept while no particle has moved by half of its margin:
    ///
    /// ```
    /// # use shadowstep::{Motion, Stepper, UnitMasses, Potential, System, tables::shipped};
    /// /// U = Σ (r − 1)⁴/4 over the pairs on a line that are closer than 1.
    /// struct Soft {
    ///     pairs: Vec<(usize, usize)>,
    ///     listed_at: Vec<f64>,
    /// }
    ///
    /// const MARGIN: f64 = 0.3;
    ///
    /// impl Potential<f64> for Soft {
    ///     fn dimension(&self) -> usize { 4 }
    ///
    ///     fn update(&mut self, q: &[f64]) {
    ///         let is_current = self.listed_at.len() == q.len()
    ///             && self.listed_at.iter().zip(q).all(|(a, b)| (a - b).abs() < MARGIN / 2.0);
    ///         if !is_current {
    ///             let close = |i: &usize, j: usize| (q[*i] - q[j]).abs() < 1.0 + MARGIN;
    ///             self.pairs = (0..4).flat_map(|j| (0..j).filter(move |i| close(i, j)).map(move |i| (i, j))).collect();
    ///             self.listed_at = q.to_vec();
    ///         }
    ///     }
    ///
    ///     fn energy(&self, q: &[f64], energy: &mut f64, _: &mut [f64]) {
    ///         *energy = self.pairs.iter().map(|&(i, j)| ((q[i] - q[j]).abs() - 1.0).min(0.0).powi(4) / 4.0).sum();
    ///     }
    ///
    ///     fn gradient(&self, q: &[f64], gradient: &mut [f64], _: &mut [f64]) {
    ///         gradient.fill(0.0);
    ///         for &(i, j) in &self.pairs {
    ///             let slope = ((q[i] - q[j]).abs() - 1.0).min(0.0).powi(3) * (q[i] - q[j]).signum();
    ///             gradient[i] += slope;
    ///             gradient[j] -= slope;
    ///         }
    ///     }
    /// }
    ///
    /// let soft = Soft { pairs: vec![], listed_at: vec![] };
    /// let mut motion = Motion::new(soft, UnitMasses, [0.0, 0.9, 2.0, 3.5], [0.5, 0.0, 0.0, -0.4])?;
    /// let start = motion.energy();
    /// let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), "1/100")?;
    /// for _ in 0..500 {
    ///     stepper.step(&mut motion);
    /// }
    /// assert!((motion.energy() - start).abs() < 1e-5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn update(&mut self, q: &[N]) {
        let _ = q;
    }

    /// energy ← U(q)
    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]);

    /// gradient ← U_q(q), as long as q
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]);

    /// gradient ← U_q(q), rate ← qᵀU_q − 2U
    ///
    /// The rate is what a kick adds to β (Moan & Niesen, eq. 2, whose printed sign is wrong). A term of U that is
    /// homogeneous of degree k adds (k − 2) times itself, a quadratic one nothing; this costs less than the definition,
    /// which is the default implementation.
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.gradient(q, gradient, scratch);
        self.energy(q, rate, scratch);
        rate.multiply_integer(-2);
        for (q, gradient) in q.iter().zip(gradient) {
            rate.add_product(q, gradient);
        }
    }

    /// Its Hessian–vector product, which gradient kicks need; the default has none.
    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        None
    }

    /// Makes steps of systems with a few coordinates, compiled for the type of the potential; false, and nothing is
    /// done, where this potential and the others, one of each system, are not of one type. There is no need to
    /// implement it: the default calls [`update`](Potential::update) and [`gradient`](Potential::gradient), of one
    /// system alone that is not in lanes.
    fn advance_few(&mut self, others: Vec<&mut dyn Any>, steps: &mut FewCoordinates<'_, N>) -> bool {
        let is_alone = others.is_empty() && N::LANES == 1;
        if is_alone {
            steps.advance(self.dimension(), vec![self], evaluate);
        }
        is_alone
    }

    /// Itself, where [`advance_few`](Potential::advance_few) finds other potentials of its type; the default is
    /// nothing.
    fn as_any(&mut self) -> Option<&mut dyn Any> {
        None
    }

    /// Its gradient for several systems at once, where an interpreter evaluates it; the default has none.
    fn program(&self) -> Option<&dyn GradientProgram<N>> {
        None
    }

    /// Whether the type of the potential is known at run time only, so that many steps are better made by one call of
    /// [`advance_few`](Potential::advance_few).
    fn is_boxed() -> bool
    where
        Self: Sized,
    {
        false
    }
}

/// gradient ← U_q(q), of a q at which nothing has been evaluated.
#[inline(always)]
pub(crate) fn evaluate<N: Number, P: Potential<N> + ?Sized>(
    potential: &mut P,
    q: &[N],
    gradient: &mut [N],
    scratch: &mut [N],
) {
    potential.update(q);
    potential.gradient(q, gradient, scratch);
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
    #[inline(always)]
    fn update(&mut self, q: &[N]) {
        (**self).update(q);
    }
    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        (**self).energy(q, energy, scratch);
    }
    #[inline(always)]
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        (**self).gradient(q, gradient, scratch);
    }
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        (**self).gradient_and_rate(q, gradient, rate, scratch);
    }
    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        (**self).hessian()
    }
    fn advance_few(&mut self, others: Vec<&mut dyn Any>, steps: &mut FewCoordinates<'_, N>) -> bool {
        (**self).advance_few(others, steps)
    }
    fn as_any(&mut self) -> Option<&mut dyn Any> {
        (**self).as_any()
    }
    fn program(&self) -> Option<&dyn GradientProgram<N>> {
        (**self).program()
    }
    fn is_boxed() -> bool {
        true
    }
}
