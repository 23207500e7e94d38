//! Computations that can be made in every number type of runs.

use num_traits::Zero;
#[cfg(feature = "mpfr")]
use shadowstep::number::Float;
use shadowstep::number::{AnyLimbs, DoubleDouble};
use shadowstep::shadow::run::RunError;
use shadowstep::shadow::{Report, Sample};
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::{MotionError, Rational};
use shadowstep_schemes::symbolic::Exact;

use crate::columns::column::Column;
use crate::execution::follow;
use crate::execution::posed::{Followed, Posed};
use crate::run::arithmetic::{Arithmetic, Digits, Numbers, number_types};
use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::split::State;
use crate::scene::{SceneNumber, springs};
use crate::texts::error::Error;
pub use crate::watch::monitor::RunMonitor;
use crate::watch::monitor::monitor;
use crate::watch::observer::Observer;

/// A number type in which runs are made. What follows a run is compiled in this crate, once for each, and not again in
/// every crate that uses it.
pub trait RunNumber: SceneNumber {
    /// Makes a run and shows its states to columns; without an end that is known before, until a column, a condition or
    /// a physical time ends it.
    ///
    /// # Errors
    /// Crossings with displaced forces; a state or an energy that is not finite; settings of the estimator that are not
    /// valid; those of the columns.
    fn follow(
        posed: &Posed<'_>,
        context: &Self::Context,
        columns: &mut [&mut dyn Column<Self>],
        observer: &mut dyn Observer,
    ) -> Result<Followed, Error>;

    /// A monitor by E_k with its error, with a window every `every` steps. With more digits than its verdict needs, the
    /// estimates have fewer.
    ///
    /// # Errors
    /// As [`Monitor::new`](shadowstep::shadow::Monitor::new).
    fn monitor(
        integrator: &mut VectorIntegrator<'_, Self>,
        k: u32,
        every: u64,
    ) -> Result<Box<RunMonitor<Self>>, RunError>;

    /// [`Monitor::observe`](shadowstep::shadow::Monitor::observe), where that is not compiled once more.
    ///
    /// # Errors
    /// As there.
    fn observe<'m>(
        monitor: &'m mut RunMonitor<Self>,
        integrator: &mut VectorIntegrator<'_, Self>,
    ) -> Result<Option<Sample<'m, Self>>, RunError>;

    /// [`Monitor::report`](shadowstep::shadow::Monitor::report), where that is not compiled once more.
    fn report(monitor: &RunMonitor<Self>) -> Report<Self>;

    /// The chain of the problem fput-alpha, of as many bodies as the state has, with its stepper.
    ///
    /// # Errors
    /// No bodies, or not as many momenta.
    ///
    /// # Panics
    /// As [`System::integrator`](crate::System::integrator).
    fn springs(
        alpha: &Rational,
        steps: Steps<'_>,
        state: State<Self>,
        context: &Self::Context,
    ) -> Result<SceneIntegrator<Self>, MotionError>;
}

// not inlined: callers in other crates would compile what is called once more
macro_rules! run_numbers {
    ($($number:ty),*) => {$(
        impl RunNumber for $number {
            #[inline(never)]
            fn follow(
                posed: &Posed<'_>,
                context: &Self::Context,
                columns: &mut [&mut dyn Column<Self>],
                observer: &mut dyn Observer,
            ) -> Result<Followed, Error> {
                follow::follow(posed, context, columns, observer)
            }

            #[inline(never)]
            fn monitor(
                integrator: &mut VectorIntegrator<'_, Self>,
                k: u32,
                every: u64,
            ) -> Result<Box<RunMonitor<Self>>, RunError> {
                monitor(integrator, k, every)
            }

            #[inline(never)]
            fn observe<'m>(
                monitor: &'m mut RunMonitor<Self>,
                integrator: &mut VectorIntegrator<'_, Self>,
            ) -> Result<Option<Sample<'m, Self>>, RunError> {
                monitor.observe(integrator.system())
            }

            #[inline(never)]
            fn report(monitor: &RunMonitor<Self>) -> Report<Self> {
                monitor.report()
            }

            #[inline(never)]
            fn springs(
                alpha: &Rational,
                steps: Steps<'_>,
                state: State<Self>,
                context: &Self::Context,
            ) -> Result<SceneIntegrator<Self>, MotionError> {
                springs(alpha, steps, state, context)
            }
        }
    )*};
}

number_types!(run_numbers);

/// A computation that can be made in every number type.
pub trait Computation {
    /// Its result.
    type Output;

    /// Makes it with numbers of type N.
    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output;
}

impl Arithmetic {
    /// Makes a computation in this number type.
    ///
    /// ```
    /// use shadowstep_scenes::arithmetic::Arithmetic;
    /// use shadowstep_scenes::computation::{Computation, RunNumber};
    ///
    /// struct Third;
    ///
    /// impl Computation for Third {
    ///     type Output = String;
    ///
    ///     fn compute<N: RunNumber>(self, context: &N::Context) -> String {
    ///         N::from_rational(&shadowstep::exact("1/3").unwrap(), context).to_text()
    ///     }
    /// }
    ///
    /// assert_eq!(Arithmetic::DOUBLE.compute(Third), "0.3333333333333333");
    /// assert_eq!(Arithmetic::with_digits(30)?.compute(Third).len(), "0.".len() + 39);
    /// # Ok::<(), shadowstep_scenes::arithmetic::DigitsError>(())
    /// ```
    pub fn compute<C: Computation>(self, computation: C) -> C::Output {
        match self.numbers() {
            Numbers::Double => computation.compute::<f64>(&()),
            Numbers::DoubleDouble => computation.compute::<DoubleDouble>(&()),
            Numbers::Digits(_, Digits::Limbs(count)) => computation.compute::<AnyLimbs>(&count),
            #[cfg(feature = "mpfr")]
            Numbers::Digits(_, Digits::Mpfr(precision)) => computation.compute::<Float>(&precision),
        }
    }

    /// Whether a value neither overflows nor becomes 0.
    pub(crate) fn holds(self, value: &Rational) -> bool {
        self.compute(Holds(value))
    }

    /// Whether r² of two points in space with such coordinates is finite.
    pub(crate) fn has_square_of(self, value: &Rational) -> bool {
        self.compute(HasSquare(value))
    }

    /// The first of these masses that overflows or underflows, or whose inverse does.
    pub fn mass_out_of_range(self, masses: &[Exact]) -> Option<&Exact> {
        masses.iter().find(|mass| !(self.holds(&mass.value) && self.holds(&mass.value.recip())))
    }
}

/// Whether a number neither overflows nor becomes 0 in a number type.
struct Holds<'a>(&'a Rational);

impl Computation for Holds<'_> {
    type Output = bool;

    fn compute<N: RunNumber>(self, context: &N::Context) -> bool {
        let rounded = N::from_rational(self.0, context);
        rounded.is_finite() && (self.0.is_zero() || rounded != N::from_rational(&Rational::zero(), context))
    }
}

/// Whether r² of points with such coordinates is finite in a number type.
struct HasSquare<'a>(&'a Rational);

impl Computation for HasSquare<'_> {
    type Output = bool;

    fn compute<N: RunNumber>(self, context: &N::Context) -> bool {
        N::from_rational(self.0, context).has_finite_square()
    }
}
