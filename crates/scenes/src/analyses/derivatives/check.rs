//! Whether derivatives by a parameter are right: a number may enter the steps otherwise than as a constant.

use shadowstep::number::AnyLimbs;
use shadowstep::steps::integrator::at_output;
use shadowstep::{Carried, Integrator as _, Number, Rational, StepSize};

use super::{Base, Differentiation, Parameter, distance, output, precise};
use crate::run::arithmetic::{Digits, Numbers};
use crate::scene::split::State;
use crate::scene::{SceneNumber, System};
use crate::texts::error::Error;

/// Of the largest derivative. The difference is right to the distance, at most 10⁻²⁵ of the second derivative; a
/// derivative that is missing is wrong by a size of order 1.
const TOLERANCE: f64 = 1e-9;

/// Of the distance and the largest coordinate or momentum: where all derivatives are 0, a difference has only its
/// error.
const TOLERANCE_OF_ZERO: f64 = 1e4;

impl Differentiation<'_> {
    /// The value of a parameter at which the derivative of the first step is the difference of two steps: its own, if
    /// formulas have the same form there and nearby.
    pub(super) fn base(&self, parameter: &Parameter) -> Result<Base, Error> {
        let arithmetic = precise(self.arithmetic)?;
        let Numbers::Digits(_, Digits::Limbs(count)) = arithmetic.numbers() else { unreachable!("they have limbs") };
        let step = |system: &System, h: &StepSize| -> Result<Vec<AnyLimbs>, Error> {
            let state = AnyLimbs::start_at(system, beside(system.initial::<AnyLimbs>(&count), &count), &count);
            let mut integrator = system.integrator(self.steps(h), state, &count)?;
            integrator.step(Carried::Nothing);
            let mut shown = system.shown(&count);
            Ok(at_output(&mut *integrator, |integrator| output(integrator, &mut shown)))
        };
        let [(system, h), _] = &parameter.nearby;
        let (here, mut differences) = (step(self.precise, self.run.h)?, step(system, h)?);
        let distance = distance(self.arithmetic);
        let inverse = AnyLimbs::from_rational(&distance.recip(), &count);
        for (difference, here) in differences.iter_mut().zip(&here) {
            difference.subtract(here);
            difference.multiply(&inverse);
        }
        let largest = |numbers: &[AnyLimbs]| numbers.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        let size = <f64 as Number>::from_rational(&distance, &()) * largest(&here);
        let tolerance = TOLERANCE * largest(&differences) + TOLERANCE_OF_ZERO * size;
        let is_right = |base| -> Result<bool, Error> {
            let exactly = Differentiation { system: self.precise, ..*self };
            let mut begun =
                exactly.begin_parameter::<AnyLimbs>((parameter, base), |state| beside(state, &count), &count)?;
            begun.integrator.step(Carried::Nothing);
            let output = begun.output();
            let mut pairs = output.iter().map(|found| found.derivatives[0].to_f64()).zip(&differences);
            // the run says of a number that is not finite where it is
            Ok(pairs.all(|(found, expected)| {
                let error = (found - expected.to_f64()).abs();
                error.is_nan() || error <= tolerance
            }))
        };
        if is_right(Base::Own).unwrap_or(false) {
            return Ok(Base::Own);
        }
        if is_right(Base::Nearby)? {
            return Ok(Base::Nearby);
        }
        let name = &parameter.name;
        Err(Error::usage(
            format!("derivatives by {name} are not known: it is no constant of the steps"),
            "take derivatives by other parameters; differences of runs at nearby values are left",
        ))
    }
}

/// A state beside another one, from which nothing vanishes by symmetry: a part that a state at rest does not show is
/// not missed.
fn beside<N: Number>((mut q, mut p): State<N>, context: &N::Context) -> State<N> {
    for (i, x) in (1..).zip(q.iter_mut().chain(&mut p)) {
        x.multiply(&N::from_rational(&Rational::new((8192 + i % 7).into(), 8192.into()), context));
        x.add(&N::from_rational(&Rational::new((1 + i % 5).into(), 65_536.into()), context));
    }
    (q, p)
}
