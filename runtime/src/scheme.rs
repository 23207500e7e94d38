//! What every scheme can do, written out by the compiler or read from a table.

use shadowstep_symbolic::decimal::from_text;

use crate::Rational;
use crate::kinetic::Quadratic;
use crate::motion::Maps;
use crate::number::Number;

/// A splitting scheme. [`crate::splitting_scheme`] implements it for a table at compile time, [`crate::tables`] at run
/// time; both give the same bits.
pub trait Scheme {
    /// Holds the distinct weights, kicks first.
    type Array<N: Number>: AsRef<[N]>;

    /// Name and proved properties.
    fn summary(&self) -> Summary<'_>;

    /// The weights h·a_s and h·b_s of a step of size h, each an exact product rounded once.
    fn weights<N: Number>(&self, h: &Rational, context: &N::Context) -> Weights<Self::Array<N>>;

    /// One step: t → t + h.
    fn step<N: Number, M: Maps<N>>(&self, weights: &Weights<Self::Array<N>>, motion: &mut M)
    where
        Self: Moves<M::Class>;

    /// One step, with what it adds to β.
    fn step_augmented<N: Number, M: Maps<N>>(&self, weights: &Weights<Self::Array<N>>, motion: &mut M)
    where
        Self: Moves<M::Class>;

    /// The exact inverse of [`Scheme::step`]: t → t − h, up to round-off.
    fn step_back<N: Number, M: Maps<N>>(&self, weights: &Weights<Self::Array<N>>, motion: &mut M)
    where
        Self: Moves<M::Class>;

    /// The exact inverse of [`Scheme::step_augmented`]; β gets the negative of what that adds.
    fn step_back_augmented<N: Number, M: Maps<N>>(&self, weights: &Weights<Self::Array<N>>, motion: &mut M)
    where
        Self: Moves<M::Class>;
}

/// Schemes that have the order they claim for a class of kinetic energies: [`Quadratic`] or
/// [`General`](crate::kinetic::General).
///
/// Every scheme has it for quadratic T. [`crate::splitting_scheme`] says so of every T(p) where it is proved of the
/// table; of a table read at run time [`crate::tables::TableScheme::for_every_kinetic`] says so. What steps a system of
/// any class asks for it:
///
/// ```
/// use shadowstep::{Maps, Moves, Number, Scheme, Weights};
///
/// fn ten_steps<N: Number, S: Scheme + Moves<M::Class>, M: Maps<N>>(
///     scheme: &S,
///     weights: &Weights<S::Array<N>>,
///     motion: &mut M,
/// ) {
///     (0..10).for_each(|_| scheme.step(weights, motion));
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "the order of `{Self}` is known to hold for quadratic T only, but this T(p) is of the class `{Class}`",
    note = "take a scheme whose table says `kinetic = \"any\"`, such as `yoshida4.toml`",
    note = "ask a table read at run time by `for_every_kinetic`; in generic code write `S: Scheme + Moves<K::Class>`"
)]
pub trait Moves<Class> {}

impl<S: Scheme> Moves<Quadratic> for S {}

/// No kinetic energy is of this class. From a single implementation the compiler would conclude which class is meant,
/// and complain of types that differ, with no word of schemes.
enum NoClass {}

impl<S: Scheme> Moves<NoClass> for S {}

/// Name and proved properties of a scheme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Summary<'a> {
    /// The table's name.
    pub name: &'a str,
    /// Order for every T(p).
    pub order: u32,
    /// Order for quadratic T.
    pub order_quadratic: u32,
    /// Whether the step is its own adjoint.
    pub symmetric: bool,
    /// Evaluations of the gradient U_q per step.
    pub evaluations: usize,
}

/// Weights times h, and their negatives for the inverse step.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights<A> {
    /// h·w
    pub forward: A,
    /// −h·w
    pub back: A,
}

impl<N: Number, const K: usize> Weights<[N; K]> {
    /// From exact weights in decimals or fractions, as the generated code has them.
    ///
    /// # Panics
    /// If a text is not an exact number; generated texts are.
    pub fn exact(weights: [&str; K], h: &Rational, context: &N::Context) -> Self {
        let scaled = weights.map(|text| h * from_text(text).expect("generated weights are exact numbers"));
        Weights {
            forward: std::array::from_fn(|i| N::from_rational(&scaled[i], context)),
            back: std::array::from_fn(|i| N::from_rational(&-&scaled[i], context)),
        }
    }
}

impl<N: Number> Weights<Vec<N>> {
    /// From exact weights.
    pub fn of<'a>(weights: impl IntoIterator<Item = &'a Rational>, h: &Rational, context: &N::Context) -> Self {
        let scaled: Vec<Rational> = weights.into_iter().map(|w| h * w).collect();
        Weights {
            forward: scaled.iter().map(|w| N::from_rational(w, context)).collect(),
            back: scaled.iter().map(|w| N::from_rational(&-w, context)).collect(),
        }
    }
}
