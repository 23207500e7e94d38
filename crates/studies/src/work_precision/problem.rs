//! What schemes are compared on: a system, an interval of time, a number type.

use std::f64::consts::TAU;

use num_traits::Signed;
use shadowstep::problems::Setup;
use shadowstep::shadow::exact_flow::has_exact_flow;
use shadowstep::{Number, Rational, StepSize};
use shadowstep_scenes::arithmetic::{Arithmetic, Numbers};
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::library::{NamedScheme, fingerprint};
use shadowstep_scenes::posed::Posed;
use shadowstep_scenes::readable::{LONGEST_NUMBER, shortened};
use shadowstep_scenes::run::Run;
use shadowstep_scenes::start::{Begin, SceneIntegrator, Steps};
use shadowstep_scenes::steps::MOST_STEPS;
use shadowstep_scenes::{Error, System};
use shadowstep_schemes::symbolic::decimal::to_text;

/// Errors along a run are taken at this number of times at most.
pub(crate) const MOST_SAMPLES: u64 = 64;

/// More turns than this are more steps than there may be, even with a hundred turns in a step.
const MOST_TURNS: f64 = 100.0 * MOST_STEPS as f64;

/// A system from t = 0 to `until` in a number type. Where time is transformed, `until` is a physical time, and steps
/// are in s.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// H and the initial state.
    pub system: &'a System,
    /// The end of the runs; negative for runs back in time.
    pub until: &'a Rational,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// About the [length](crate::work_precision::length::length_of) of the runs in s, where time is transformed: runs of n steps have
    /// steps of an nth of it.
    pub length: Option<&'a Rational>,
}

impl Problem<'_> {
    /// |until| as an `f64`.
    pub(crate) fn duration(&self) -> f64 {
        <f64 as Number>::from_rational(self.until, &()).abs()
    }

    /// The length of all steps: `until`, or that in s.
    fn steps_length(&self) -> &Rational {
        self.length.unwrap_or(self.until)
    }

    /// The size of the length of all steps.
    pub(crate) fn size(&self) -> f64 {
        <f64 as Number>::from_rational(self.steps_length(), &()).abs()
    }

    /// The step size of this number of steps.
    pub fn step_size(&self, steps: u64) -> Rational {
        self.steps_length() / Rational::from_integer(steps.into())
    }

    /// The shipped problem, where its exact flow is known.
    pub(crate) fn exact_flow(&self) -> Option<Setup> {
        self.system.setup().filter(|setup| has_exact_flow(setup).is_ok())
    }

    /// The step size of this number of steps.
    pub(crate) fn h(&self, steps: u64) -> StepSize {
        StepSize::try_from(self.step_size(steps)).expect("the run has a nonzero length")
    }

    /// A run of this number of steps of this size. One in transformed time is ended by what follows it: it has not come
    /// to its end after this multiple of the steps that its length in s suggests, if it ever comes there.
    pub(crate) fn posed<'b>(&'b self, named: &'b NamedScheme, (h, steps): (&'b StepSize, u64)) -> Posed<'b> {
        const MOST_LONGER: u64 = 16;
        let steps = if self.length.is_some() { MOST_LONGER * (steps + 1) } else { steps };
        let run = Run { propagator: &named.name, h, steps, order: None, windows: Run::WINDOWS };
        Posed::new(self.system, &named.scheme, run, (self.arithmetic, false))
    }

    /// The system at t = 0 with a scheme that makes this number of steps.
    pub(crate) fn integrator<N: RunNumber>(
        &self,
        named: &NamedScheme,
        steps: u64,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, Error> {
        let h = self.h(steps);
        let compensated = self.arithmetic.is_compensated();
        let (displaced, begin) = (false, Begin::InitialState);
        let steps = Steps { scheme: &named.scheme, h: &h, compensated, displaced, begin };
        Ok(self.system.integrator(steps, self.system.start(context), context)?)
    }

    /// Refuses a problem whose H is not finite at t = 0: no run of it has an error.
    pub(crate) fn check_energy(&self) -> Result<(), Error> {
        self.arithmetic.compute(EnergyAtStart(self.system)).map_or(Ok(()), |energy| {
            let message = format!("H is {energy} at t = 0 in {}", self.arithmetic.described());
            let hint = match self.arithmetic.numbers() {
                Numbers::Digits(..) => "choose another initial state",
                _ => "choose another initial state, or 16 digits, whose numbers are of any size",
            };
            Err(Error::run(message, hint))
        })
    }

    /// Refuses times in which the fastest oscillation at t = 0 turns so often that every scheme needs too many steps.
    pub(crate) fn check_duration(&self) -> Result<(), Error> {
        let Some(frequency) = self.system.fastest_motion() else { return Ok(()) };
        let turns = self.duration() * frequency.omega / TAU;
        if turns <= MOST_TURNS {
            return Ok(());
        }
        let until = shortened(self.until, LONGEST_NUMBER);
        let message = format!(
            "until {until} the fastest oscillation at the start makes {turns:.1e} turns: which are too many steps of \
                any scheme"
        );
        Err(Error::usage(message, "the limit is 1e10 steps: give an earlier time"))
    }

    /// Whether the runs go forward in time.
    pub(crate) fn is_forward(&self) -> bool {
        self.until.is_positive()
    }

    /// What distinguishes its results from those of all other problems.
    pub(crate) fn fingerprint(&self) -> String {
        let all = format!("{:?} {} {:?}", self.system, to_text(self.until), self.arithmetic.label());
        let all = self.length.map_or(all.clone(), |length| format!("{all} s {}", to_text(length)));
        fingerprint(&all)
    }
}

/// H at t = 0 as a text, where it is not finite.
struct EnergyAtStart<'a>(&'a System);

impl Computation for EnergyAtStart<'_> {
    type Output = Option<String>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Option<String> {
        let (q, p) = self.0.start(context);
        let energy: N = self.0.energy(context)(&q, &p);
        (!energy.is_finite()).then(|| energy.to_text())
    }
}

/// The most samples that are at states of a run with this number of steps.
pub(crate) fn most_samples(steps: u64) -> u64 {
    (1..=MOST_SAMPLES).rev().find(|samples| steps.is_multiple_of(*samples)).unwrap_or(1)
}
