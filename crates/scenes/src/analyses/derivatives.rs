//! Derivatives of the states of a run by the initial state and by parameters, forwards and backwards.

mod backward;
mod check;
mod forward;
#[cfg(test)]
mod tests;

use shadowstep::number::{Dual, Number, ParameterError, with_parameter};
use shadowstep::shadow::run::{NotFinite, Quantity, RunError};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::tables::{AtRunTime, TableScheme};
use shadowstep::{Integrator as _, MotionError, Rational, Remainders, StepSize, exact};

use crate::run::Run;
use crate::run::arithmetic::Arithmetic;
use crate::run::start::{Begin, SceneIntegrator, Steps};
use crate::scene::split::{ShownCoordinates, State};
use crate::scene::{SceneNumber, System};
use crate::texts::error::Error;

/// A run whose states are differentiated.
///
/// States are those that runs show, n = 0, `every`, 2 `every`, … and the last one.
#[derive(Clone, Copy)]
pub struct Differentiation<'a> {
    /// H and the initial state.
    pub system: &'a System,
    /// The same, read to [more digits](precise).
    pub precise: &'a System,
    /// The scheme, valid for the [system](crate::motion::propagator::for_system).
    pub scheme: &'a TableScheme<AtRunTime>,
    /// The steps. In transformed time their number is that of steps of s.
    pub run: Run<'a>,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// Whether gradient kicks are by displaced forces.
    pub displaced: bool,
    /// Each such state is one of the result.
    pub every: u64,
    /// By what derivatives are taken.
    pub by: &'a [Variable],
}

/// By what derivatives are taken.
#[derive(Debug)]
pub enum Variable {
    /// A position at t = 0, in the coordinates of the scene.
    Position(usize),
    /// A momentum at t = 0.
    Momentum(usize),
    /// The initial state along (δq, δp), in the coordinates of the scene.
    Direction(Vec<Rational>),
    /// A number in the text of the scene, or the step size at a fixed number of steps.
    Parameter(Parameter),
}

/// A number in the text of a scene, by nearby values.
#[derive(Debug)]
pub struct Parameter {
    /// Its name, for messages.
    pub name: String,
    /// The systems where it is larger by the [distance()], and by twice the distance, read to [more digits](precise),
    /// each with its step size.
    pub nearby: [(Box<System>, StepSize); 2],
}

/// The value of a parameter at which constants are differentiated.
///
/// At 1, 2 or ⅓ a formula may have fewer constants than beside it, as 1·x is x. Its derivative is then taken at the
/// first value nearby, which differs by less than the digits of the run; the states stay those of the run.
#[derive(Clone, Copy, PartialEq)]
enum Base {
    Own,
    Nearby,
}

/// The digits of values of which differences are taken: twice those of the run, and more.
fn digits_of_distance(arithmetic: Arithmetic) -> u32 {
    arithmetic.digits().max(20) + 5
}

/// How much larger a [`Parameter`] is nearby: small beyond the digits of the run.
///
/// # Panics
/// Never.
pub fn distance(arithmetic: Arithmetic) -> Rational {
    exact(&format!("1e-{}", digits_of_distance(arithmetic))).expect("it is a number")
}

/// The number type for which systems are read of which differences are taken.
///
/// # Errors
/// More digits than numbers of limbs have.
pub fn precise(arithmetic: Arithmetic) -> Result<Arithmetic, Error> {
    let digits = 2 * digits_of_distance(arithmetic) + 20;
    let found = Arithmetic::with_digits(digits).ok().filter(|found| found.limbs().is_some());
    found.ok_or_else(|| {
        let digits = arithmetic.digits();
        Error::usage(
            format!("{digits} digits are too many for derivatives by parameters"),
            "use 138 digits or fewer, or derivatives by the initial state only",
        )
    })
}

/// Numbers of a result: doubles of a run in double precision, else decimal texts.
#[derive(Clone, Debug, PartialEq)]
pub enum Array {
    /// In double precision.
    Doubles(Vec<f64>),
    /// With all digits of the run.
    Texts(Vec<String>),
}

impl Array {
    fn of<N: SceneNumber>(numbers: &[N], arithmetic: Arithmetic) -> Self {
        match arithmetic.is_longer_than_double() {
            false => Array::Doubles(numbers.iter().map(N::to_f64).collect()),
            true => Array::Texts(numbers.iter().map(N::to_text).collect()),
        }
    }
}

/// A system at its first state, of which a variable has the derivative 1.
struct Begun<N: SceneNumber> {
    integrator: SceneIntegrator<Dual<N>>,
    shown: Option<ShownCoordinates<Dual<N>>>,
    base: Base,
}

impl<N: SceneNumber> Begun<N>
where
    Dual<N>: SceneNumber<Context = N::Context>,
{
    /// q and then p as they are shown, of the present state.
    fn output(&mut self) -> Vec<Dual<N>> {
        let Begun { integrator, shown, .. } = self;
        at_output(&mut **integrator, |integrator| output(integrator, shown))
    }

    /// The values of the state, with the remainders of their sums ← those of another integrator; derivatives stay.
    fn set_values(&mut self, plain: &VectorIntegrator<'_, N>) {
        let (of, state) = (plain.state(), self.integrator.system().state_mut());
        let dual = |(value, own): (&N, &Dual<N>)| Dual::new(value.clone(), own.derivatives.clone());
        let set = |values: &[N], own: &[Dual<N>]| values.iter().zip(own).map(dual).collect::<Vec<_>>();
        let (values, own) = (of.remainders(), state.remainders());
        let remainders = Remainders { q: set(&values.q, &own.q), p: set(&values.p, &own.p) };
        let (q, p) = (set(of.q(), state.q()), set(of.p(), state.p()));
        state.set(&q, &p);
        state.set_remainders(&remainders);
    }
}

fn output<N: Number>(integrator: &VectorIntegrator<'_, N>, shown: &mut Option<ShownCoordinates<N>>) -> Vec<N> {
    let (q, p) = (integrator.state().q(), integrator.state().p());
    let (q, p) = match shown {
        Some(shown) => shown.of_state(q, p),
        None => (q, p),
    };
    [q, p].concat()
}

impl Differentiation<'_> {
    fn steps<'s>(&'s self, h: &'s StepSize) -> Steps<'s> {
        let compensated = self.arithmetic.is_compensated();
        Steps { scheme: self.scheme, h, compensated, displaced: self.displaced, begin: Begin::InitialState }
    }

    /// The numbers of the states of the result.
    fn rows(&self) -> Vec<u64> {
        let last = self.run.steps;
        std::iter::successors(Some(0), |n| (*n < last).then(|| self.row_after(*n).min(last))).collect()
    }

    /// The next one after n.
    fn row_after(&self, n: u64) -> u64 {
        let every = self.every.max(1);
        (n / every + 1).saturating_mul(every)
    }

    /// The system at its first state, of which the variable, if there is one, has the derivative 1.
    fn begin<N: SceneNumber>(
        &self,
        variable: Option<(&Variable, Base)>,
        context: &N::Context,
    ) -> Result<Begun<N>, Error>
    where
        Dual<N>: SceneNumber<Context = N::Context>,
    {
        let (mut q, mut p) = self.system.initial::<Dual<N>>(context);
        let one = || [N::from_rational(&num_traits::One::one(), context)];
        match variable {
            None => {}
            Some((Variable::Position(i), _)) => q[*i].derivatives = one(),
            Some((Variable::Momentum(i), _)) => p[*i].derivatives = one(),
            Some((Variable::Direction(components), _)) => {
                for (x, component) in q.iter_mut().chain(&mut p).zip(components) {
                    x.derivatives = [N::from_rational(component, context)];
                }
            }
            Some((Variable::Parameter(parameter), base)) => {
                return self.begin_parameter((parameter, base), |state| state, context);
            }
        }
        Ok(self.begin_at(self.system, self.run.h, (q, p))?)
    }

    fn begin_parameter<N: SceneNumber>(
        &self,
        (parameter, base): (&Parameter, Base),
        from: impl Fn(State<Dual<N>>) -> State<Dual<N>>,
        context: &N::Context,
    ) -> Result<Begun<N>, Error>
    where
        Dual<N>: SceneNumber<Context = N::Context>,
    {
        let [near, further] = parameter.nearby.each_ref().map(|(system, h)| (&**system, h));
        let of = match base {
            Base::Own => [(self.system, self.run.h), (self.precise, self.run.h), near],
            Base::Nearby => [near, near, further],
        };
        let begin = |(system, h): (&System, &StepSize)| self.begin_at(system, h, from(system.initial(context)));
        let found = match with_parameter(&distance(self.arithmetic), |i| begin(of[i])) {
            // nothing depends on it, so that all derivatives are 0
            Err(ParameterError::NoConstant) => begin(of[0]),
            found => found.map_err(|error| {
                let name = &parameter.name;
                Error::usage(format!("derivatives by {name} are not known: {error}"), "choose a value beside it")
            })?,
        };
        Ok(Begun { base, ..found? })
    }

    fn begin_at<N: SceneNumber>(
        &self,
        system: &System,
        h: &StepSize,
        state: State<Dual<N>>,
    ) -> Result<Begun<N>, MotionError>
    where
        Dual<N>: SceneNumber<Context = N::Context>,
    {
        let context = &state.0[0].context();
        let state = SceneNumber::start_at(system, state, context);
        let integrator = system.integrator(self.steps(h), state, context)?;
        Ok(Begun { integrator, shown: system.shown(context), base: Base::Own })
    }

    /// Checks what is not known before; for each variable the value at which constants are differentiated.
    fn bases(&self) -> Result<Vec<Base>, Error> {
        crate::motion::tangent::needs_second_derivatives(self.system)?;
        let base = |variable: &Variable| match variable {
            Variable::Parameter(parameter) => self.base(parameter),
            Variable::Direction(components) => self.check_direction(components.len()).map(|()| Base::Own),
            Variable::Position(_) | Variable::Momentum(_) => Ok(Base::Own),
        };
        self.by.iter().map(base).collect()
    }

    fn check_direction(&self, components: usize) -> Result<(), Error> {
        let expected = 2 * self.system.q.len();
        if components == expected {
            return Ok(());
        }
        Err(Error::usage(
            format!("a tangent vector has {components} components, not {expected}"),
            "give one for each coordinate, and then one for each momentum",
        ))
    }

    /// The run stopped, if a number is not finite.
    fn check_finite<N: SceneNumber>(&self, n: u64, output: &[Dual<N>]) -> Result<(), Error> {
        let dimension = output.len() / 2;
        let not_finite = |x: &Dual<N>| !(x.value.is_finite() && x.derivatives[0].is_finite());
        let Some(i) = output.iter().position(not_finite) else { return Ok(()) };
        let quantity = if i < dimension { Quantity::Position(i) } else { Quantity::Momentum(i - dimension) };
        if output[i].value.is_finite() {
            let text = output[i].derivatives[0].to_text();
            return Err(self.run.not_finite(&format!("a derivative of the state {n} is {text}: it")));
        }
        let value = NotFinite { quantity, value: output[i].value.to_text() };
        let error = RunError::NotFinite { step: i64::try_from(n).unwrap_or(i64::MAX), value };
        Err(self.run.failed_naming(&error, &self.system.coordinates, &self.system.momenta))
    }
}
