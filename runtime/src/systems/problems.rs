//! Problems with their parameters and initial states: first the paper's, then systems of many bodies.
//!
//! A problem is a file in `problems/` that implements `Definition`: its formula, parameters and their defaults, initial
//! state, source and, where a solution is known, its exact flow. It is registered by its `mod` line and its line of the
//! [registry](Problem); nothing else depends on which problems there are.

mod definition;
mod error;
pub(crate) mod exact_flow;
mod gravity;
mod initial;
pub(crate) mod values;

mod argon_crystal;
mod figure_eight;
mod fput_alpha;
mod fput_stiff;
mod harmonic_oscillator;
mod henon_heiles;
mod kepler;
mod outer_solar_system;
mod pendulum;
mod pythagorean;
mod scattering;
mod toda;

pub use crate::systems::pairs::Gravity;
pub use argon_crystal::LennardJones;
pub use definition::{Description, Parameter};
pub use error::ProblemError;
pub use exact_flow::solution::SolutionError;
pub use fput_alpha::CubicSpring;
pub use fput_stiff::StiffFput;
pub use harmonic_oscillator::HarmonicOscillator;
pub use henon_heiles::HenonHeiles;
pub use initial::Initial;
pub use kepler::Kepler;
pub use pendulum::Pendulum;
pub use scattering::Scattering;
pub use toda::TodaSpring;
pub use values::Values;

use std::collections::BTreeMap;

use shadowstep_symbolic::{Budget, Exact, evaluate_within, parse, suggestion};

use crate::Rational;
use crate::number::{Lanes, Number};
use crate::systems::kinetic::{Kinetic, Quadratic};
use crate::systems::motion::{Motion, MotionError};
use crate::systems::potential::Potential;
use crate::systems::problems::exact_flow::solver::Solver;
use crate::systems::wisdom_holman::Bodies;
use definition::Definition;

/// Makes the enum of all problems and everything that depends on which one it is, from one list `Variant: module`, whose
/// module has a type `Entry` that implements [`Definition`].
macro_rules! registry {
    ($($Name:ident: $module:ident,)+) => {
        /// A shipped problem.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum Problem {
            $(#[doc = concat!("Defined in `problems/", stringify!($module), ".rs`.")] $Name,)+
        }

        /// All problems: first the paper's in its order, then systems of many bodies.
        pub const PROBLEMS: &[Problem] = &[$(Problem::$Name,)+];

        impl Problem {
            /// Its name, formula, parameters and initial state.
            pub const fn description(self) -> &'static Description {
                match self { $(Problem::$Name => &<$module::Entry as Definition>::DESCRIPTION,)+ }
            }

            /// How its exact flow is computed, where a solution is known.
            #[inline]
            pub(crate) const fn exact_flow(self) -> Option<Solver> {
                match self { $(Problem::$Name => <$module::Entry as Definition>::EXACT_FLOW,)+ }
            }

            /// Whether U has functions such as exp and sin, which in [lanes](crate::number::Lanes) are not those of the platform.
            pub const fn has_functions(self) -> bool {
                match self { $(Problem::$Name => <$module::Entry as Definition>::HAS_FUNCTIONS,)+ }
            }

            const fn gravity(self) -> Option<usize> {
                match self { $(Problem::$Name => <$module::Entry as Definition>::GRAVITY,)+ }
            }

            fn potential<N: Number + 'static>(self, number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
                match self { $(Problem::$Name => $module::Entry::potential(number),)+ }
            }
        }
    };
}

registry! {
    HarmonicOscillator: harmonic_oscillator,
    Pendulum: pendulum,
    Kepler: kepler,
    HenonHeiles: henon_heiles,
    Scattering: scattering,
    OuterSolarSystem: outer_solar_system,
    FigureEight: figure_eight,
    Pythagorean: pythagorean,
    ArgonCrystal: argon_crystal,
    FputStiff: fput_stiff,
    FputAlpha: fput_alpha,
    Toda: toda,
}

/// The problem with this name, in capital or small letters.
///
/// # Errors
/// An unknown name; the message has the nearest known one.
pub fn problem(name: &str) -> Result<Problem, ProblemError> {
    let names: Vec<_> = PROBLEMS.iter().map(|problem| problem.name()).collect();
    let found = PROBLEMS.iter().find(|problem| problem.name().eq_ignore_ascii_case(name));
    found.copied().ok_or_else(|| ProblemError::UnknownProblem { name: name.to_owned(), hint: suggestion(name, &names) })
}

/// The system of a problem, chosen at run time.
pub type ProblemMotion<N> = Motion<N, Vec<N>, Box<dyn Potential<N>>, Box<dyn Kinetic<N, Class = Quadratic>>>;

/// A problem with all its values.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The problem.
    pub problem: Problem,
    /// Its parameters, initial state and masses.
    pub values: Values,
}

impl Problem {
    /// Its short name, as the command line and scenes spell it.
    pub const fn name(self) -> &'static str {
        self.description().name
    }

    /// The problem with some values set by exact expressions, which may use parameters that stand before.
    ///
    /// Irrational values are rounded to `digits` digits.
    ///
    /// # Errors
    /// Unknown or repeated names, expressions that cannot be evaluated, parameters out of range.
    pub fn setup(self, set: &[(String, String)], digits: u32) -> Result<Setup, ProblemError> {
        let Initial { positions, momenta, masses } = (self.description().initial)();
        let parameters = self.description().parameters;
        let defaults = parameters.iter().map(|p| (p.name.to_owned(), p.default.to_owned()));
        let all: Vec<(String, String)> = defaults.chain(positions).chain(momenta).collect();
        self.check_names(set, &all)?;
        let (mut known, budget) = (BTreeMap::new(), Budget::default());
        let mut named = Vec::new();
        for (name, default) in all {
            let text = set.iter().find(|(n, _)| *n == name).map_or(default, |(_, text)| text.clone());
            let value = value_of(&name, &text, &known, digits, &budget)?;
            self.check_range(&name, &text, &value.value)?;
            known.insert(name.clone(), value.clone());
            named.push((name, value));
        }
        let mass = |text: &String| value_of("mass", text, &known, digits, &budget);
        let masses = masses.map(|texts| texts.iter().map(mass).collect::<Result<_, ProblemError>>()).transpose()?;
        Ok(Setup { problem: self, values: Values::new(named, parameters.len(), masses) })
    }

    fn check_names(self, set: &[(String, String)], all: &[(String, String)]) -> Result<(), ProblemError> {
        let names: Vec<_> = all.iter().map(|(name, _)| name.as_str()).collect();
        for (i, (name, _)) in set.iter().enumerate() {
            if !names.contains(&name.as_str()) {
                let (problem, hint) = (self.name(), suggestion(name, &names));
                return Err(ProblemError::UnknownParameter { problem, name: name.clone(), hint });
            }
            if set[..i].iter().any(|(other, _)| other == name) {
                return Err(ProblemError::SetTwice { name: name.clone() });
            }
        }
        Ok(())
    }

    fn check_range(self, name: &str, text: &str, value: &Rational) -> Result<(), ProblemError> {
        match self.description().parameters.iter().find(|p| p.name == name) {
            Some(parameter) if !(parameter.allowed)(value) => {
                Err(ProblemError::OutOfRange { name: parameter.name, text: text.to_owned(), range: parameter.range })
            }
            _ => Ok(()),
        }
    }
}

fn value_of(
    name: &str,
    text: &str,
    known: &BTreeMap<String, Exact>,
    digits: u32,
    budget: &Budget,
) -> Result<Exact, ProblemError> {
    let wrong = |why: String| ProblemError::NoValue { name: name.to_owned(), text: text.to_owned(), why };
    let expression = parse(text).map_err(|e| wrong(e.to_string()))?;
    evaluate_within(&expression, known, digits, budget).map_err(|e| wrong(e.to_string()))
}

impl Setup {
    /// The potential energy U(q).
    pub fn potential<N: Number + 'static>(&self, context: &N::Context) -> Box<dyn Potential<N>> {
        self.problem.potential(&|name| self.values.number(name, context))
    }

    /// The bodies and their number of dimensions, if only Newton's gravity acts between them.
    pub fn bodies(&self) -> Option<(Bodies, usize)> {
        let dimensions = self.problem.gravity()?;
        let masses = self.values.masses()?.iter().step_by(dimensions).map(|mass| mass.value.clone());
        Some((Bodies::new(self.values.value("g").clone(), masses.collect()).ok()?, dimensions))
    }

    /// The potential energy of several trajectories of one problem, whose parameters may differ: each lane has the parameters of one.
    ///
    /// # Panics
    /// If they are not all of one problem.
    pub fn potential_of_each<const W: usize>(each: &[&Setup; W]) -> Box<dyn Potential<Lanes<W>>> {
        let problem = each[0].problem;
        assert!(
            each.iter().all(|setup| setup.problem == problem),
            "trajectories of different problems are not one system"
        );
        problem.potential(&|name| Lanes(each.map(|setup| setup.values.number(name, &()))))
    }

    /// The system at its initial state.
    ///
    /// # Errors
    /// A mass that is not positive.
    pub fn motion<N: Number + 'static>(&self, context: &N::Context) -> Result<ProblemMotion<N>, MotionError> {
        let Setup { values, .. } = self;
        Motion::new(self.potential(context), values.kinetic(context)?, values.q(context), values.p(context))
    }
}
