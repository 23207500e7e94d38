//! A system at a state with its stepper: the one place that dispatches on its parts and the class of its kinetic energy.

use shadowstep::linear_part::LinearPart;
use shadowstep::number::Rounded;
use shadowstep::tables::TableScheme;
use shadowstep::{Motion, MotionError, Number, Rational, Scheme, Stepper, System, ValidFor};

use crate::boxed::Boxed;
use crate::scene::{self, ClassifiedKinetic, Parts};

/// The steps that are made.
#[derive(Clone, Copy, Debug)]
pub struct Steps<'a> {
    /// The scheme.
    pub scheme: &'a TableScheme,
    /// The step size.
    pub h: &'a Rational,
    /// Whether q and p are sums with remainders.
    pub compensated: bool,
}

/// What is done with a system at a state and a stepper, whatever the class of its kinetic energy.
pub trait Work<N: Number> {
    /// Its result.
    type Output;

    /// Does it.
    fn with<S, M>(self, stepper: &Stepper<S, N>, system: M) -> Self::Output
    where
        S: Scheme + Clone + ValidFor<M::Class> + 'static,
        M: System<Number = N> + 'static;
}

impl scene::System {
    /// Does some work with the system at a state and a scheme that is valid for it.
    ///
    /// # Errors
    /// A state of another dimension.
    ///
    /// # Panics
    /// If the step size is 0 or the scheme is not valid for T(p), which reading a system and its scheme excludes.
    pub fn with<N: Rounded + 'static, W: Work<N>>(
        &self,
        Steps { scheme, h, compensated }: Steps<'_>,
        (q, p): (Vec<N>, Vec<N>),
        context: &N::Context,
        work: W,
    ) -> Result<W::Output, MotionError> {
        if let Parts::WisdomHolman(planets) = &self.parts {
            let system = planets.system((&q, &p), compensated, context)?;
            return Ok(work.with(&stepper(scheme.clone(), h, context), system));
        }
        let (potential, scheme) = (self.potential(context), scheme.clone());
        if let Parts::Linear(stiffness) = &self.parts {
            let system = LinearPart::new(potential, &self.exact_masses(), stiffness, &q, &p)?;
            return Ok(work.with(&stepper(scheme, h, context), Boxed::Quadratic(Box::new(system))));
        }
        Ok(match self.kinetic(context) {
            ClassifiedKinetic::Quadratic(kinetic) => {
                let motion = Motion::new(potential, kinetic, q, p)?.compensated_if(compensated);
                work.with(&stepper(scheme, h, context), motion)
            }
            ClassifiedKinetic::General(kinetic) => {
                let scheme = scheme.for_every_kinetic().expect("the scheme was read for this T");
                let motion = Motion::new(potential, kinetic, q, p)?.compensated_if(compensated);
                work.with(&stepper(scheme, h, context), motion)
            }
        })
    }
}

fn stepper<S: Scheme, N: Number>(scheme: S, h: &Rational, context: &N::Context) -> Stepper<S, N> {
    Stepper::with_context(scheme, h, context).expect("the step size was read as nonzero")
}
