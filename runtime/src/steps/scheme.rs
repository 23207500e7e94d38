//! What every scheme can do: compiled from its table by [`crate::splitting_scheme`], or read from it at run time.

use shadowstep_schemes::symbolic::decimal::from_text;

use crate::Rational;
use crate::number::Number;
pub use crate::steps::weights::{WeightLists, Weights};
pub use crate::systems::maps::{Flows, MapKind, MapSequence, PartOrder, Sequence};

/// A splitting scheme. [`crate::splitting_scheme`] implements it for a table at compile time, [`crate::steps::tables`]
/// at run time; both give the same bits.
///
/// A scheme with a step size is a [`Stepper`](crate::Stepper), which makes the steps: it alone has the weights of a
/// step and the flows of a system, so weights of another scheme or step size cannot be used by mistake.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a splitting scheme",
    note = "a scheme is a struct with `#[splitting_scheme(\"yoshida4.toml\")]`, or a table: \
        `tables::shipped(\"yoshida4\").unwrap()`"
)]
pub trait Scheme {
    /// Whether [`forward`](Scheme::forward) is inlined wherever it is called, as generated code of a short step: then
    /// many steps are made by it, else by a loop over the [`sequence`](Scheme::sequence).
    const IS_INLINED: bool = false;

    /// Holds the weights of a step, each rounded once.
    type Weights<N: Number>: WeightLists<N>;

    /// Name and proved properties.
    fn summary(&self) -> SchemeProperties<'_>;

    /// The distinct weights, exact.
    fn exact_weights(&self) -> Weights<Vec<Rational>>;

    /// The maps of a step in their order.
    fn sequence(&self) -> Sequence<'_>;

    /// The kicks and drifts of the post-map χ⁻¹ of a processed scheme χ⁻¹ ∘ kernelⁿ ∘ χ, in the order in which they
    /// act, with their exact weights. The pre-map χ is its exact inverse, and the steps are those of the kernel: see
    /// [`Stepper::preprocess`](crate::Stepper::preprocess). Other schemes have none.
    fn processor(&self) -> Vec<(MapKind, Rational)> {
        Vec::new()
    }

    /// The maps of one step, t → t + h for weights times h, 2h³ those of gradient kicks.
    fn forward<F: Flows>(&self, weights: &Self::Weights<F::Number>, flows: &mut F);

    /// The maps in the opposite order: with the negative weights the exact inverse, t → t − h, up to round-off.
    fn back<F: Flows>(&self, weights: &Self::Weights<F::Number>, flows: &mut F);
}

/// Schemes whose claimed order is proved for a class of systems: of [`Quadratic`](crate::systems::kinetic::Quadratic)
/// or [`General`](crate::systems::kinetic::General) kinetic energies, or of
/// [`ManyParts`](crate::systems::many_parts::ManyParts).
///
/// [`crate::splitting_scheme`] implements it for quadratic T, and for every T(p) where that is proved of the table, or
/// with `parts = 3` for three parts and more; for a table read at run time,
/// [`crate::steps::tables::TableScheme::for_every_kinetic`] and
/// [`for_many_parts`](crate::steps::tables::TableScheme::for_many_parts) check it. Code that advances a system of any
/// class requires it:
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
    note = "a table read at run time is checked by `for_every_kinetic`; in generic code write `S: Scheme + \
        ValidFor<M::Class>`"
)]
pub trait ValidFor<Class> {}

/// No system is of these classes. From a single implementation the compiler would conclude which class is meant, and
/// report types that differ instead of a scheme that is not valid.
enum NoClass<const FIRST: bool> {}

impl<S: Scheme> ValidFor<NoClass<true>> for S {}

impl<S: Scheme> ValidFor<NoClass<false>> for S {}

/// Name and proved properties of a scheme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SchemeProperties<'a> {
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

/// The post-map of generated code: each map with the place of its weight among these decimals or fractions.
///
/// # Panics
/// If a text is not an exact number; generated texts are.
pub fn exact_maps(maps: &[(MapKind, usize)], weights: &[&str]) -> Vec<(MapKind, Rational)> {
    let weights: Vec<_> = weights.iter().map(|text| exact_weight(text)).collect();
    maps.iter().map(|&(kind, place)| (kind, weights[place].clone())).collect()
}

/// The weights of generated code, from decimals or fractions.
///
/// # Panics
/// If a text is not an exact number; generated texts are.
pub fn exact_weights(weights: Weights<&[&str]>) -> Weights<Vec<Rational>> {
    weights.map(|text| exact_weight(text), |text| exact_weight(text))
}

fn exact_weight(text: &str) -> Rational {
    from_text(text).expect("generated weights are exact numbers")
}
