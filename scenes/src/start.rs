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
    /// Whether gradient kicks are by displaced forces, which the scheme must allow: see [`shadowstep::displaced`].
    pub displaced: bool,
    /// At which state they begin.
    pub begin: Begin,
}

/// The state at which steps begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begin {
    /// The initial state: a processed scheme begins with its pre-map.
    InitialState,
    /// A state that the steps of the scheme have made; of a processed scheme, those of the kernel.
    Step,
}

/// What is done with a system at a state and a stepper, whatever the class of its kinetic energy.
pub trait Work<N: Number> {
    /// Its result.
    type Output;

    /// Does it. For a processed scheme the system is at a state of its kernel: see [`Stepper::at_output`].
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
    /// If the step size is 0, the scheme is not valid for T(p) or has gradient kicks that cannot be displaced as wanted, which reading a system and its scheme excludes.
    pub fn with<N: Rounded + 'static, W: Work<N>>(
        &self,
        Steps { scheme, h, compensated, displaced, begin: at }: Steps<'_>,
        (q, p): (Vec<N>, Vec<N>),
        context: &N::Context,
        work: W,
    ) -> Result<W::Output, MotionError> {
        let displacements = || {
            let stepper = displaced.then(|| stepper(scheme.clone(), h, context));
            stepper.map(|stepper| stepper.displacements().expect("the scheme was read for displaced forces"))
        };
        let other = match &self.parts {
            Parts::KineticAndPotential | Parts::Linear(_) => None,
            Parts::Formulas(formulas) => Some(self.in_formulas(formulas, (&q, &p), context)?),
            Parts::WisdomHolman(planets) => Some(planets.system((&q, &p), compensated, displacements(), context)?),
            Parts::TransformedTime(time) => {
                Some(self.in_transformed_time(*time, (q.clone(), p.clone()), compensated, context)?)
            }
        };
        if let Some(system) = other {
            let scheme = match &self.parts {
                Parts::Formulas(_) => in_many_parts(scheme),
                _ => scheme.clone(),
            };
            return Ok(begin(&stepper(scheme, h, context), system, at, work));
        }
        let (potential, displacements, scheme) = (self.potential(context), displacements(), scheme.clone());
        if let Parts::Linear(stiffness) = &self.parts {
            let mut system = LinearPart::new(potential, &self.exact_masses(), stiffness, &q, &p)?;
            if let Some(displacements) = displacements {
                system = system.displaced(displacements);
            }
            return Ok(begin(&stepper(scheme, h, context), Boxed::Quadratic(Box::new(system)), at, work));
        }
        Ok(match self.kinetic(context) {
            ClassifiedKinetic::Quadratic(kinetic) => {
                let mut motion = Motion::new(potential, kinetic, q, p)?;
                if let Some(displacements) = displacements {
                    motion = motion.displaced(displacements);
                }
                let motion = motion.compensated_if(compensated);
                begin(&stepper(scheme, h, context), motion, at, work)
            }
            ClassifiedKinetic::General(kinetic) => {
                let scheme = scheme.for_every_kinetic().expect("the scheme was read for this T");
                let motion = Motion::new(potential, kinetic, q, p)?.compensated_if(compensated);
                begin(&stepper(scheme, h, context), motion, at, work)
            }
        })
    }
}

/// The scheme with the steps of many parts, which it has already where the scene was read with it.
fn in_many_parts(scheme: &TableScheme) -> TableScheme {
    match scheme.proved().proof.many_parts {
        Some(_) => scheme.clone(),
        None => scheme.clone().for_many_parts().expect("the scheme is valid for many parts").into(),
    }
}

fn begin<N, S, M, W>(stepper: &Stepper<S, N>, mut system: M, at: Begin, work: W) -> W::Output
where
    N: Number,
    S: Scheme + Clone + ValidFor<M::Class> + 'static,
    M: System<Number = N> + 'static,
    W: Work<N>,
{
    if at == Begin::InitialState {
        stepper.preprocess(&mut system);
    }
    work.with(stepper, system)
}

fn stepper<S: Scheme, N: Number>(scheme: S, h: &Rational, context: &N::Context) -> Stepper<S, N> {
    Stepper::with_context(scheme, h, context).expect("the step size was read as nonzero")
}
