//! What the tests of the whole system share: numbers from texts, distances, every shipped scheme as generated code, a
//! solution to compare with, what the compiler reports about a table.

pub mod catalogue_page;
pub mod exact_orbit;
pub mod general;
pub mod lennard_jones;
pub mod matrix;
pub mod orders;
pub mod pages;
pub mod readers;
pub mod reference;
pub mod refusals;
pub mod shipped;
pub mod steps;
pub mod systems;
pub mod variations;

use rug::Float;
use shadowstep::number::{Number, Precision, Real};
use shadowstep::shadow::{BuildEstimator, Report, ShadowEnergy};
use shadowstep::tables::{self, TableScheme};
use shadowstep::{Potential, Rational, Scheme, StepSize, Stepper, System, ValidFor, exact};

/// The precision of `digits` decimal digits.
pub fn precision(digits: u32) -> Precision {
    Precision::digits(digits).expect("tests use sensible precisions")
}

/// The exact value of an expression such as `1/3` or `0.1`.
pub fn rational(text: &str) -> Rational {
    exact(text).expect("tests write exact numbers")
}

/// An exact expression, rounded once to `digits` digits.
pub fn number(text: &str, digits: u32) -> Float {
    Float::from_rational(&rational(text), &precision(digits))
}

/// Exact expressions, rounded once to numbers of any kind.
pub fn numbers<N: Number>(texts: &[&str], context: &N::Context) -> Vec<N> {
    texts.iter().map(|text| N::from_rational(&rational(text), context)).collect()
}

/// A step size such as `1/20`.
pub fn step_size(text: &str) -> StepSize {
    text.try_into().expect("tests use valid step sizes")
}

/// A shipped scheme, read at run time, with a step size such as `1/20`.
pub fn stepper<N: Number>(scheme: &str, h: &str, context: &N::Context) -> Stepper<TableScheme, N> {
    let scheme = tables::shipped(scheme).expect("tests use shipped schemes");
    Stepper::with_context(scheme, h, context).expect("tests use valid step sizes")
}

/// What a monitor with a window in `every` steps reports of a number of steps.
///
/// # Panics
/// If a state is not finite.
pub fn watched<S, M>(
    stepper: Stepper<S, M::Number>,
    system: &mut M,
    settings: &impl BuildEstimator<M::Number>,
    every: u64,
    steps: u64,
) -> Report<M::Number>
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number: Real>,
{
    let mut monitor = ShadowEnergy::new(stepper, system, settings).expect("the start is finite").every(every);
    for _ in 0..steps {
        monitor.step(system).expect("it stays finite");
    }
    monitor.report()
}

/// log₁₀|a − b|, −∞ if they are equal.
pub fn log10_distance<N: Real>(a: &N, b: &N) -> f64 {
    let mut difference = a.clone();
    difference.subtract(b);
    difference.log10_abs()
}

/// The largest log₁₀|a_i − b_i|, −∞ if all are equal.
pub fn log10_largest_distance<N: Real>(a: &[N], b: &[N]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| log10_distance(a, b)).fold(f64::NEG_INFINITY, f64::max)
}

/// The positions of a system, then its momenta.
pub fn coordinates<M: System>(system: &M) -> Vec<M::Number> {
    [system.state().q(), system.state().p()].concat()
}

/// Checks that the increments of the last augmented step are the changes of q and p since `before`, to ε of the
/// coordinate times 10^`digits_lost`.
///
/// # Panics
/// If one is not.
pub fn check_increments<M: System<Number: Bits>>(system: &M, before: &[M::Number], digits_lost: f64) {
    let increments = system.state().increments().to_owned();
    let changes = coordinates(system).into_iter().zip(before);
    for ((later, earlier), added) in changes.zip(increments.q.iter().chain(&increments.p)) {
        let mut difference = later.clone();
        difference.subtract(earlier);
        assert!(log10_distance(added, &difference) < later.log10_epsilon() + digits_lost);
    }
}

/// U, qᵀU_q − 2U, U_q alone and U_q as it comes with that.
pub fn potential_values<N: Number>(potential: &impl Potential<N>, q: &[N]) -> Vec<N> {
    let context = q[0].context();
    let zeros = |count| vec![N::zero(&context); count];
    let mut scratch = zeros(potential.scratch());
    potential.prepare(&mut scratch, &context);
    let (mut all, mut gradient) = (zeros(2), zeros(q.len()));
    let [energy, rate] = &mut all[..] else { unreachable!("two") };
    potential.energy(q, energy, &mut scratch);
    potential.gradient(q, &mut gradient, &mut scratch);
    let plain = gradient.clone();
    potential.gradient_and_rate(q, &mut gradient, rate, &mut scratch);
    all.into_iter().chain(plain).chain(gradient).collect()
}

/// Numbers whose bits can be compared: −0 is not 0.
pub trait Bits: Real + 'static {
    /// The last place of 1, as a power of ten.
    fn log10_epsilon(&self) -> f64;

    /// Whether both are the same number, sign of zero and precision included.
    fn same_bits(&self, other: &Self) -> bool;
}

impl Bits for f64 {
    fn log10_epsilon(&self) -> f64 {
        f64::EPSILON.log10()
    }
    fn same_bits(&self, other: &f64) -> bool {
        self.to_bits() == other.to_bits()
    }
}

impl Bits for Float {
    fn log10_epsilon(&self) -> f64 {
        -f64::from(self.prec() - 1) * std::f64::consts::LOG10_2
    }
    fn same_bits(&self, other: &Float) -> bool {
        self == other && self.is_sign_negative() == other.is_sign_negative() && self.prec() == other.prec()
    }
}

/// Whether all bits are the same.
pub fn same_bits<N: Bits>(a: &[N], b: &[N]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.same_bits(b))
}

#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;

#[cfg(doctest)]
#[doc = include_str!("../../docs/start-here.md")]
struct StartHere;

#[cfg(doctest)]
#[doc = include_str!("../../docs/library.md")]
struct LibraryPage;
