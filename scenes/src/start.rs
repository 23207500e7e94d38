//! The steps of a run, and what is done with a system at a state and its stepper.

use shadowstep::displaced::Displacements;
use shadowstep::number::Rounded;
use shadowstep::tables::TableScheme;
use shadowstep::{Number, Rational, Scheme, Stepper, System, ValidFor};

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

impl Steps<'_> {
    /// The displacements of the forces, where gradient kicks are made by them.
    pub(crate) fn displacements<N: Rounded>(self, context: &N::Context) -> Option<Displacements<N>> {
        let stepper = self.displaced.then(|| stepper(self.scheme.clone(), self.h, context));
        stepper.map(|stepper| stepper.displacements().expect("the scheme was read for displaced forces"))
    }

    /// Does some work with a system at the first state, by the scheme as it is valid for the system.
    pub(crate) fn begin<N, S, M, W>(self, scheme: S, mut system: M, context: &N::Context, work: W) -> W::Output
    where
        N: Number,
        S: Scheme + Clone + ValidFor<M::Class> + 'static,
        M: System<Number = N> + 'static,
        W: Work<N>,
    {
        let stepper = stepper(scheme, self.h, context);
        if self.begin == Begin::InitialState {
            stepper.preprocess(&mut system);
        }
        work.with(&stepper, system)
    }
}

fn stepper<S: Scheme, N: Number>(scheme: S, h: &Rational, context: &N::Context) -> Stepper<S, N> {
    Stepper::with_context(scheme, h, context).expect("the step size was read as nonzero")
}
