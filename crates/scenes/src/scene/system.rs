//! What moves: a problem and the parts of its H.

use std::ops::Deref;

use num_traits::{ToPrimitive as _, Zero};
use serde_json::Value;
use shadowstep::Rational;
use shadowstep::problems::Setup;
use shadowstep::systems::transformed_time::TimeTransformation;
use shadowstep_schemes::symbolic::Exact;

use crate::run::Run;
use crate::scene::own::OwnPotential;
use crate::scene::problem::{InitialValueProblem, KineticEnergy, PotentialEnergy};
use crate::scene::split::{
    Class, Formulas, KineticAndPotential, Linear, Needs, Planets, SlowForces, Split, TransformedTime,
};
use crate::texts::error::Error;

/// A problem and how its H is split for the steps.
#[derive(Debug)]
pub struct System {
    /// H and the state at t = 0.
    pub problem: InitialValueProblem,
    /// The parts of H.
    pub parts: Parts,
}

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
    /// Slow forces, fast forces and T(p).
    SlowForces(SlowForces),
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
            Parts::SlowForces($split) => $answer,
        }
    };
}

impl Parts {
    /// The section and the key of a scene that ask for them.
    pub(crate) fn key(&self) -> (&'static str, &'static str) {
        ask!(self, split => split.key())
    }

    /// H, where the parts alone give it: the sum of their formulas.
    pub fn hamiltonian(&self) -> Option<String> {
        ask!(self, split => split.hamiltonian())
    }

    pub(crate) fn metadata(&self) -> Option<(&'static str, Value)> {
        ask!(self, split => split.metadata())
    }

    /// The slow forces, if they are a part.
    pub fn slow_forces(&self) -> Option<&SlowForces> {
        match self {
            Parts::SlowForces(slow) => Some(slow),
            _ => None,
        }
    }

    /// The planets, if these are the parts.
    pub fn planets(&self) -> Option<&Planets> {
        match self {
            Parts::WisdomHolman(planets) => Some(planets),
            _ => None,
        }
    }

    /// Whether one of two parts, the drifts, is much larger than the other.
    pub fn has_dominant_part(&self) -> bool {
        ask!(self, split => split.has_dominant_part())
    }

    pub(crate) fn is_kinetic_and_potential(&self) -> bool {
        ask!(self, split => split.is_kinetic_and_potential())
    }
}

impl Deref for System {
    type Target = InitialValueProblem;

    fn deref(&self) -> &InitialValueProblem {
        &self.problem
    }
}

/// In the parts T(p) and U(q).
impl From<InitialValueProblem> for System {
    fn from(problem: InitialValueProblem) -> Self {
        System { problem, parts: Parts::KineticAndPotential(KineticAndPotential) }
    }
}

impl System {
    /// The system of a shipped problem.
    pub fn of_setup(setup: Setup) -> System {
        System::from(InitialValueProblem::of_setup(setup))
    }

    /// The system of a potential of the caller, with the names q1, q2, … and p1, p2, ….
    ///
    /// # Errors
    /// Numbers of momenta or masses that differ from that of the coordinates; a mass that is 0.
    pub fn of_own_potential(
        own: Box<dyn OwnPotential>,
        (q, p): (Vec<Exact>, Vec<Exact>),
        masses: Option<Vec<Exact>>,
    ) -> Result<System, Error> {
        let dimension = q.len();
        for (what, count) in [("momenta", Some(p.len())), ("masses", masses.as_ref().map(Vec::len))] {
            if let Some(count) = count.filter(|count| *count != dimension) {
                let message = format!("there are {dimension} coordinates and {count} {what}");
                return Err(Error::usage(message, "give one for each coordinate"));
            }
        }
        if dimension == 0 {
            return Err(Error::usage("there are no coordinates", "give the state at t = 0: q = [1.0], p = [0.0]"));
        }
        if masses.iter().flatten().any(|mass| mass.value.is_zero()) {
            return Err(Error::usage("a mass is 0", "masses must be nonzero"));
        }
        let names = |letter: &str| (1..=dimension).map(|i| format!("{letter}{i}")).collect();
        Ok(System::from(InitialValueProblem {
            potential: PotentialEnergy::Own(own),
            kinetic: KineticEnergy::Masses(masses),
            parameters: Vec::new(),
            coordinates: names("q"),
            momenta: names("p"),
            q,
            p,
            explicit_time: false,
        }))
    }

    /// What the system needs of a scheme and of a run.
    pub(crate) fn needs(&self) -> Needs {
        ask!(&self.parts, split => split.needs(&self.problem))
    }

    /// The function of the transformed time, if time is transformed. The last coordinate of states is then t, its
    /// momentum p_t = −H(0).
    pub fn transformed_time(&self) -> Option<TimeTransformation> {
        ask!(&self.parts, split => split.transformed_time())
    }

    /// dt/ds at the start of steps of a fictitious time s, in double precision; `None` in physical time.
    pub fn rate_at_start(&self) -> Option<f64> {
        match &self.parts {
            Parts::TransformedTime(time) => Some(time.rate_at_start(&self.problem)),
            _ => None,
        }
    }

    /// About how many steps a run has that ends at a physical time where time is transformed, or at most.
    pub fn expected_steps(&self, run: Run<'_>, until: Option<&Rational>) -> u64 {
        let steps = |until: &Rational| ((until / run.h.exact()).to_f64()? / self.rate_at_start()?).abs().to_u64();
        until.and_then(steps).map_or(run.steps, |steps| steps.clamp(1, run.steps))
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

pub(super) use ask;
