//! What every scheme can do: compiled from its table by [`crate::splitting_scheme`], or read from it at run time.

use shadowstep_symbolic::decimal::from_text;

use crate::Rational;
use crate::kinetic::Quadratic;
pub use crate::maps::{MapKind, MapSequence, PartOrder};
use crate::number::Number;
use crate::system::System;

/// A splitting scheme. [`crate::splitting_scheme`] implements it for a table at compile time, [`crate::tables`] at run
/// time; both give the same bits.
///
/// A scheme with a step size is a [`Stepper`](crate::Stepper), which makes the steps. Only a stepper has [`StepWeights`], so weights
/// of another scheme or step size cannot be used by mistake.
pub trait Scheme {
    /// Holds the distinct weights, kicks first.
    type Array<N: Number>: AsRef<[N]> + Clone + std::fmt::Debug;

    /// Name and proved properties.
    fn summary(&self) -> Summary<'_>;

    /// The distinct weights a_s, then b_s, then those of [middle parts](Scheme::middle), then c_s of gradient kicks, each made a number by `scaled`.
    fn weights<N: Number>(&self, scaled: impl FnMut(&Rational) -> N) -> Self::Array<N>;

    /// How many of the weights are of kicks, and the maps of a step in their order: each with the place of its weight among those of
    /// its kind.
    fn maps(&self) -> (usize, &[(MapKind, usize)]);

    /// Of H of [three parts and more](crate::many_parts): how many of the weights, those after the drifts', are of the middle parts, and between
    /// each map and the next the place of the weight among them. Other schemes have none.
    fn middle(&self) -> (usize, &[usize]) {
        (0, &[])
    }

    /// How many of the weights, the last ones, are of gradient kicks: their steps take 2h³ c.
    fn gradient_kicks(&self) -> usize {
        0
    }

    /// The kicks and drifts of the post-map χ⁻¹ of a processed scheme χ⁻¹ ∘ kernelⁿ ∘ χ, in the order in which they act, with their exact
    /// weights. The pre-map χ is its exact inverse, and the steps are those of the kernel: see
    /// [`Stepper::preprocess`](crate::Stepper::preprocess). Other schemes have none.
    fn processor(&self) -> Vec<(MapKind, Rational)> {
        Vec::new()
    }

    /// One step: t → t + h.
    fn step<S: System>(&self, weights: &StepWeights<Self::Array<S::Number>>, system: &mut S)
    where
        Self: ValidFor<S::Class>;

    /// One step, with its increments of q, p and β.
    fn step_augmented<S: System>(&self, weights: &StepWeights<Self::Array<S::Number>>, system: &mut S)
    where
        Self: ValidFor<S::Class>;

    /// The exact inverse of [`Scheme::step`]: t → t − h, up to round-off.
    fn step_back<S: System>(&self, weights: &StepWeights<Self::Array<S::Number>>, system: &mut S)
    where
        Self: ValidFor<S::Class>;

    /// The exact inverse of [`Scheme::step_augmented`]; its increments are the negatives.
    fn step_back_augmented<S: System>(&self, weights: &StepWeights<Self::Array<S::Number>>, system: &mut S)
    where
        Self: ValidFor<S::Class>;
}

/// Schemes whose claimed order is proved for a class of systems: of [`Quadratic`] or [`General`](crate::kinetic::General) kinetic energies, or of
/// [`ManyParts`](crate::many_parts::ManyParts).
///
/// Every scheme is valid for quadratic T. [`crate::splitting_scheme`] implements it for every T(p) where that is proved of the
/// table; for a table read at run time, [`crate::tables::TableScheme::for_every_kinetic`] checks it. Code that advances a system of
/// any class requires it:
///
/// ```
/// use shadowstep::{Scheme, Stepper, System, ValidFor};
///
/// fn ten_steps<S: Scheme + ValidFor<M::Class>, M: System>(stepper: &Stepper<S, M::Number>, system: &mut M) {
///     (0..10).for_each(|_| stepper.step(system));
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "the order of `{Self}` is not known to hold for systems of the class `{Class}`",
    note = "`General`, every T(p), takes a scheme whose table states `kinetic = \"any\"`, such as `yoshida4.toml`",
    note = "`ManyParts`, three parts and more, takes a scheme with `parts = 3`, or a table by `for_many_parts`",
    note = "a table read at run time is checked by `for_every_kinetic`; in generic code write `S: Scheme + ValidFor<M::Class>`"
)]
pub trait ValidFor<Class> {}

impl<S: Scheme> ValidFor<Quadratic> for S {}

/// No kinetic energy is of this class. From a single implementation the compiler would conclude which class is meant,
/// and report types that differ instead of a scheme that is not valid.
enum NoClass {}

impl<S: Scheme> ValidFor<NoClass> for S {}

/// Name and proved properties of a scheme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Summary<'a> {
    /// The table's name.
    pub name: &'a str,
    /// Order for every T(p); 0 for a scheme with gradient kicks, which are for quadratic T only.
    pub order: u32,
    /// Order for quadratic T.
    pub order_quadratic: u32,
    /// Whether the step is its own adjoint.
    pub symmetric: bool,
    /// Evaluations of the gradient U_q per step.
    pub evaluations: usize,
}

/// The post-map of generated code, from decimals or fractions.
///
/// # Panics
/// If a text is not an exact number; generated texts are.
pub fn exact_maps<const K: usize>(maps: [(MapKind, &str); K]) -> Vec<(MapKind, Rational)> {
    maps.into_iter().map(|(kind, text)| (kind, from_text(text).expect("generated weights are exact numbers"))).collect()
}

/// The weights of a scheme times h, and their negatives for the inverse step. Only a [`Stepper`](crate::Stepper) makes them.
#[derive(Clone, Debug, PartialEq)]
pub struct StepWeights<A> {
    forward: A,
    back: A,
}

impl<A> StepWeights<A> {
    /// h·w of each weight w of a scheme, 2h³·w of those of gradient kicks: an exact product rounded once.
    pub(crate) fn of<N: Number, S: Scheme<Array<N> = A>>(scheme: &S, h: &Rational, context: &N::Context) -> Self
    where
        A: AsRef<[N]>,
    {
        let mut count = 0;
        scheme.weights(|_| {
            count += 1;
            N::zero(context)
        });
        let linear = count - scheme.gradient_kicks();
        let times = |h: Rational| {
            let twice_cube = h.pow(MapKind::GradientKick.power() as i32) * Rational::from_integer(2.into());
            let mut index = 0;
            scheme.weights(|weight| {
                let factor = if index < linear { &h } else { &twice_cube };
                index += 1;
                N::from_rational(&(factor * weight), context)
            })
        };
        StepWeights { forward: times(h.clone()), back: times(-h) }
    }

    /// h·w, 2h³·w of gradient kicks
    #[inline]
    pub fn forward(&self) -> &A {
        &self.forward
    }

    /// Their negatives
    #[inline]
    pub fn back(&self) -> &A {
        &self.back
    }
}

/// The weights of generated code, from decimals or fractions.
///
/// # Panics
/// If a text is not an exact number; generated texts are.
pub fn exact_weights<const K: usize>(weights: [&str; K]) -> [Rational; K] {
    weights.map(|text| from_text(text).expect("generated weights are exact numbers"))
}
