//! Whether derivatives by a parameter are right: a number may enter the steps otherwise than as a constant.

use shadowstep::number::AnyLimbs;
use shadowstep::steps::integrator::at_output;
use shadowstep::{Carried, Integrator as _, Number, Rational, StepSize};

use super::{Differentiation, Parameter, distance, output, precise};
use crate::arithmetic::{Digits, Numbers};
use crate::error::Error;
use crate::scene::System;
use crate::scene::split::State;

/// Of the largest derivative. The difference is right to the distance, at most 10⁻²⁵ of the second derivative; a derivative that is missing is wrong by a size
/// of order 1.
const TOLERANCE: f64 = 1e-9;

impl Differentiation<'_> {
    /// Compares the derivative of the first step with the difference of two steps.
    pub(super) fn check_first_step(&self, parameter: &Parameter) -> Result<(), Error> {
        let arithmetic = precise(self.arithmetic)?;
        let Numbers::Digits(_, Digits::Limbs(count)) = arithmetic.numbers() else { unreachable!("they have limbs") };
        let step = |system: &System, h: &StepSize| -> Result<Vec<AnyLimbs>, Error> {
            let state = system.start_at(beside(system.initial::<AnyLimbs>(&count), &count), &count);
            let mut integrator = system.integrator(self.steps(h), state, &count)?;
            integrator.step(Carried::Nothing);
            let mut shown = system.shown(&count);
            Ok(at_output(&mut *integrator, |integrator| output(integrator, &mut shown)))
        };
        let (here, there) = (step(self.precise, self.run.h)?, step(&parameter.system, &parameter.h)?);
        let exactly = Differentiation { system: self.precise, ..*self };
        let mut begun = exactly.begin_parameter::<AnyLimbs>(parameter, |state| beside(state, &count), &count)?;
        begun.integrator.step(Carried::Nothing);
        let inverse = AnyLimbs::from_rational(&distance(self.arithmetic).recip(), &count);
        let pairs: Vec<(f64, f64)> = begun
            .output()
            .iter()
            .zip(here.iter().zip(there))
            .map(|(found, (here, mut there))| {
                there.subtract(here);
                there.multiply(&inverse);
                (found.derivatives[0].to_f64(), there.to_f64())
            })
            .collect();
        let largest = pairs.iter().map(|(_, expected)| expected.abs()).fold(0.0, f64::max);
        if pairs.iter().all(|(found, expected)| (found - expected).abs() <= TOLERANCE * largest) {
            return Ok(());
        }
        let name = &parameter.name;
        Err(Error::usage(
            format!("derivatives by {name} are not known: it is no constant of the steps"),
            "take derivatives by other parameters; differences of runs at nearby values are left",
        ))
    }
}

/// A state beside another one, from which nothing vanishes by symmetry: a part that a state at rest does not show is not missed.
fn beside<N: Number>((mut q, mut p): State<N>, context: &N::Context) -> State<N> {
    for (i, x) in (1..).zip(q.iter_mut().chain(&mut p)) {
        x.multiply(&N::from_rational(&Rational::new((8192 + i % 7).into(), 8192.into()), context));
        x.add(&N::from_rational(&Rational::new((1 + i % 5).into(), 65_536.into()), context));
    }
    (q, p)
}
