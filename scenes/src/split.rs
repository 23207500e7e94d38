//! How H is split into parts whose flows are exact. Each kind of split has its file and answers the same questions.
//!
//! ```text
//! read/parts.rs: a word or a section of the scene → a kind of split, or why the system has none of this kind
//! needs         → what the reader and the command line ask of schemes, sums and ensembles
//! start         → with (a work on the system and its stepper) → shown, energy_of_rows: the rows
//! ```

mod formulas;
mod kinetic_and_potential;
mod linear;
mod needs;
mod shown;
mod transformed_time;
mod wisdom_holman;

pub use formulas::Formulas;
pub use kinetic_and_potential::KineticAndPotential;
pub(crate) use linear::LINEAR;
pub use linear::Linear;
pub use needs::{Class, Needs, NoProcessor, Refusal};
pub use shown::Shown;
pub use transformed_time::TransformedTime;
pub(crate) use wisdom_holman::OfPlanets;
pub use wisdom_holman::{Canonical, Planets};

use serde_json::Value;
use shadowstep::number::Rounded;
use shadowstep::transformed_time::TimeTransformation;
use shadowstep::{MotionError, Number};

use crate::scene::{EnergyAt, System};
use crate::start::{Steps, Work};

/// The most digits of a run with a flow that is computed in more digits and rounded: of a linear part, or of a quadratic form.
pub(crate) const LONGEST_EXACT_FLOW: u32 = 288;

/// The parts of H: one of the kinds of split.
#[derive(Debug)]
pub enum Parts {
    /// T(p) and U(q).
    KineticAndPotential(KineticAndPotential),
    /// The Kepler orbits of planets, and their interactions.
    WisdomHolman(Planets),
    /// T(p) + ½qᵀKq, and what is left of U.
    Linear(Linear),
    /// f(T + p_t) and −f(−U): the steps are in a fictitious time.
    TransformedTime(TransformedTime),
    /// H is the sum of formulas.
    Formulas(Formulas),
}

/// Asks the kind of split: the one place where the kinds are told apart.
macro_rules! ask {
    ($parts:expr, $split:ident => $answer:expr) => {
        match $parts {
            Parts::KineticAndPotential($split) => $answer,
            Parts::WisdomHolman($split) => $answer,
            Parts::Linear($split) => $answer,
            Parts::TransformedTime($split) => $answer,
            Parts::Formulas($split) => $answer,
        }
    };
}

/// Positions and momenta.
pub(crate) type State<N> = (Vec<N>, Vec<N>);

/// What a kind of split answers, of a system whose H is split in this way.
pub(crate) trait Split {
    /// What it needs of a scheme and of a run.
    fn needs(&self, system: &System) -> Needs;

    /// The section and the key of a scene that ask for it.
    fn key(&self) -> (&'static str, &'static str) {
        ("problem", "parts")
    }

    /// Its name and value in the head of a file.
    fn metadata(&self) -> Option<(&'static str, Value)>;

    /// The state at t = 0 in the coordinates of the steps, from that of the scene.
    fn start<N: Number + 'static>(&self, _: &System, state: State<N>, _: &N::Context) -> State<N> {
        state
    }

    /// Converts states from the coordinates of the steps to those that are shown, where these differ.
    fn shown<N: Number + 'static>(&self, _: &System, _: &N::Context) -> Option<Shown<N>> {
        None
    }

    /// H of any state in the coordinates of the steps.
    fn energy<N: Rounded + 'static>(&self, system: &System, context: &N::Context) -> EnergyAt<N> {
        system.plain_energy(context)
    }

    /// Does some work with the system at a state in the coordinates of the steps.
    ///
    /// # Errors
    /// A state of another dimension.
    fn with<N: Rounded + 'static, W: Work<N>>(
        &self,
        system: &System,
        steps: Steps<'_>,
        state: State<N>,
        context: &N::Context,
        work: W,
    ) -> Result<W::Output, MotionError>;

    /// H, where the parts alone give it.
    fn hamiltonian(&self) -> Option<String> {
        None
    }

    /// The function of the transformed time: the last coordinate is then t, its momentum p_t = −H(0), and the steps conserve another function than H.
    fn transformed_time(&self) -> Option<TimeTransformation> {
        None
    }

    /// The planets whose approaches are followed.
    fn planets(&self) -> Option<&Planets> {
        None
    }

    /// Whether the parts are T(p) and U(q): the fastest oscillation limits the step size, and lanes have flows.
    fn is_kinetic_and_potential(&self) -> bool {
        false
    }
}

impl Parts {
    /// The section and the key of a scene that ask for them.
    pub fn key(&self) -> (&'static str, &'static str) {
        ask!(self, split => split.key())
    }

    /// H, where the parts alone give it: the sum of their formulas.
    pub fn hamiltonian(&self) -> Option<String> {
        ask!(self, split => split.hamiltonian())
    }

    pub(crate) fn metadata(&self) -> Option<(&'static str, Value)> {
        ask!(self, split => split.metadata())
    }

    pub(crate) fn planets(&self) -> Option<&Planets> {
        ask!(self, split => split.planets())
    }

    pub(crate) fn is_kinetic_and_potential(&self) -> bool {
        ask!(self, split => split.is_kinetic_and_potential())
    }
}

impl System {
    /// What the system needs of a scheme and of a run.
    pub fn needs(&self) -> Needs {
        ask!(&self.parts, split => split.needs(self))
    }

    /// Positions and momenta at t = 0, in the coordinates of the steps.
    pub fn start<N: Number + 'static>(&self, context: &N::Context) -> (Vec<N>, Vec<N>) {
        let state = self.initial(context);
        ask!(&self.parts, split => split.start(self, state, context))
    }

    /// Converts states from the coordinates of the steps to those that are shown, where these differ.
    pub fn shown<N: Number + 'static>(&self, context: &N::Context) -> Option<Shown<N>> {
        ask!(&self.parts, split => split.shown(self, context))
    }

    /// H of any state, in the coordinates of the steps; where time is transformed, of its q and p.
    ///
    /// # Panics
    /// If q, p and U have different dimensions, which reading a system excludes.
    pub fn energy<N: Rounded + 'static>(&self, context: &N::Context) -> EnergyAt<N> {
        ask!(&self.parts, split => split.energy(self, context))
    }

    /// H for rows, where the steps conserve another function.
    pub(crate) fn energy_of_rows<N: Rounded + 'static>(&self, context: &N::Context) -> Option<EnergyAt<N>> {
        self.transformed_time().map(|_| self.energy(context))
    }

    /// Does some work with the system at a state and a scheme that is valid for it.
    ///
    /// # Errors
    /// A state of another dimension.
    ///
    /// # Panics
    /// If the step size is 0, the scheme is not valid for the parts or has gradient kicks that cannot be displaced as wanted, which reading a system
    /// and its scheme excludes.
    pub fn with<N: Rounded + 'static, W: Work<N>>(
        &self,
        steps: Steps<'_>,
        state: (Vec<N>, Vec<N>),
        context: &N::Context,
        work: W,
    ) -> Result<W::Output, MotionError> {
        ask!(&self.parts, split => split.with(self, steps, state, context, work))
    }

    /// The function of the transformed time, if time is transformed. The last coordinate of states is then t, its momentum p_t = −H(0).
    pub fn transformed_time(&self) -> Option<TimeTransformation> {
        ask!(&self.parts, split => split.transformed_time())
    }

    /// The physical time of a state in the coordinates of the steps, where time is transformed.
    pub fn time_of<'s, N>(&self, q: &'s [N]) -> Option<&'s N> {
        self.transformed_time().and_then(|_| q.last())
    }

    /// The dimension of q in the coordinates of the steps.
    pub(crate) fn dimension(&self) -> usize {
        self.q.len() + usize::from(self.transformed_time().is_some())
    }

    /// Whether schemes for quadratic T only do not move it.
    pub fn has_general_kinetic(&self) -> bool {
        self.needs().class != Class::Quadratic
    }
}
