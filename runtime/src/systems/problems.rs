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
use std::sync::OnceLock;

use shadowstep_schemes::symbolic::decimal::to_text;
use shadowstep_schemes::symbolic::{Budget, Exact, Expression, evaluate_within, parse, suggestion};

use crate::Rational;
use crate::number::{Lanes, Number};
use crate::systems::kinetic::{Kinetic, Quadratic};
use crate::systems::motion::{Motion, MotionError};
use crate::systems::potential::Potential;
use crate::systems::problems::exact_flow::solver::Solver;
use crate::systems::wisdom_holman::Bodies;
use definition::Definition;

/// Makes the enum of all problems and everything that depends on which one it is, from one list `Variant: module`,
/// whose module has a type `Entry` that implements [`Definition`].
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

            /// Whether U has functions such as exp and sin, which in [lanes](crate::number::Lanes) are not those of the
            /// platform.
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
        self.check_names(&set.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>())?;
        let given = |name: &str| set.iter().find(|(own, _)| own == name).map(|(_, text)| Given::Text(text));
        self.setup_of(given, digits)
    }

    /// The same with some values set by numbers: of many setups, in less time.
    ///
    /// # Errors
    /// As [`setup`](Problem::setup).
    pub fn setup_with_numbers(self, set: &[(String, Rational)], digits: u32) -> Result<Setup, ProblemError> {
        self.check_names(&set.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>())?;
        let given = |name: &str| set.iter().find(|(own, _)| own == name).map(|(_, number)| Given::Number(number));
        self.setup_of(given, digits)
    }

    fn setup_of<'g>(self, given: impl Fn(&str) -> Option<Given<'g>>, digits: u32) -> Result<Setup, ProblemError> {
        let Defaults { named: defaults, masses } = self.defaults();
        let (mut known, budget) = (BTreeMap::new(), Budget::default());
        let mut named = Vec::with_capacity(defaults.len());
        for (name, default) in defaults {
            let value = match given(name) {
                Some(Given::Number(number)) => Exact { value: number.clone(), rounded: false },
                Some(Given::Text(text)) => value_of(name, &Parsed::of(name, text)?, &known, digits, &budget)?,
                None => value_of(name, default, &known, digits, &budget)?,
            };
            self.check_range(name, &value.value, || given(name).map_or(default.text.clone(), |given| given.text()))?;
            known.insert(name.clone(), value.clone());
            named.push((name.clone(), value));
        }
        let mass = |default: &Parsed| value_of("mass", default, &known, digits, &budget);
        let masses = masses.as_ref().map(|masses| masses.iter().map(mass).collect::<Result<_, _>>()).transpose()?;
        Ok(Setup { problem: self, values: Values::new(named, self.description().parameters.len(), masses) })
    }

    /// The values that are not set, parsed once for each problem.
    fn defaults(self) -> &'static Defaults {
        static ALL: [OnceLock<Defaults>; PROBLEMS.len()] = [const { OnceLock::new() }; PROBLEMS.len()];
        ALL[self as usize].get_or_init(|| {
            const SHIPPED: &str = "the texts of shipped problems are expressions";
            let Initial { positions, momenta, masses } = (self.description().initial)();
            let parameters = self.description().parameters;
            let parameters = parameters.iter().map(|p| (p.name.to_owned(), p.default.to_owned()));
            let parsed = |name: &str, text: &str| Parsed::of(name, text).expect(SHIPPED);
            let all = parameters.chain(positions).chain(momenta);
            Defaults {
                named: all.map(|(name, text)| (name.clone(), parsed(&name, &text))).collect(),
                masses: masses.map(|masses| masses.iter().map(|text| parsed("mass", text)).collect()),
            }
        })
    }

    fn check_names(self, set: &[&str]) -> Result<(), ProblemError> {
        for (i, name) in set.iter().enumerate() {
            if !self.defaults().named.iter().any(|(known, _)| known == name) {
                let names: Vec<_> = self.defaults().named.iter().map(|(name, _)| name.as_str()).collect();
                let (problem, hint) = (self.name(), suggestion(name, &names));
                return Err(ProblemError::UnknownParameter { problem, name: (*name).to_owned(), hint });
            }
            if set[..i].contains(name) {
                return Err(ProblemError::SetTwice { name: (*name).to_owned() });
            }
        }
        Ok(())
    }

    fn check_range(self, name: &str, value: &Rational, text: impl Fn() -> String) -> Result<(), ProblemError> {
        match self.description().parameters.iter().find(|p| p.name == name) {
            Some(parameter) if !(parameter.allowed)(value) => {
                Err(ProblemError::OutOfRange { name: parameter.name, text: text(), range: parameter.range })
            }
            _ => Ok(()),
        }
    }
}

/// A value that is set.
#[derive(Clone, Copy)]
enum Given<'g> {
    Text(&'g str),
    Number(&'g Rational),
}

impl Given<'_> {
    fn text(self) -> String {
        match self {
            Given::Text(text) => text.to_owned(),
            Given::Number(number) => to_text(number),
        }
    }
}

/// The values of a problem where they are not set: parameters, positions, momenta; and masses.
struct Defaults {
    named: Vec<(String, Parsed)>,
    masses: Option<Vec<Parsed>>,
}

/// A text, and what it means.
struct Parsed {
    text: String,
    expression: Expression,
}

impl Parsed {
    fn of(name: &str, text: &str) -> Result<Parsed, ProblemError> {
        match parse(text) {
            Ok(expression) => Ok(Parsed { text: text.to_owned(), expression }),
            Err(error) => Err(no_value(name, text, error.to_string())),
        }
    }
}

fn no_value(name: &str, text: &str, why: String) -> ProblemError {
    ProblemError::NoValue { name: name.to_owned(), text: text.to_owned(), why }
}

fn value_of(
    name: &str,
    Parsed { text, expression }: &Parsed,
    known: &BTreeMap<String, Exact>,
    digits: u32,
    budget: &Budget,
) -> Result<Exact, ProblemError> {
    evaluate_within(expression, known, digits, budget).map_err(|error| no_value(name, text, error.to_string()))
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

    /// The potential energy of several trajectories of one problem, whose parameters may differ: each lane has the
    /// parameters of one. Numbers are lanes, or made of lanes.
    ///
    /// # Panics
    /// If they are not all of one problem.
    pub fn potential_of_each<N, const W: usize>(each: &[&Setup; W]) -> Box<dyn Potential<N>>
    where
        N: Number + From<Lanes<W>> + 'static,
    {
        let problem = each[0].problem;
        assert!(
            each.iter().all(|setup| setup.problem == problem),
            "trajectories of different problems are not one system"
        );
        problem.potential(&|name| Lanes(each.map(|setup| setup.values.number(name, &()))).into())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_set_what_their_texts_set() {
        let text = |value: &Rational| to_text(value);
        for problem in PROBLEMS {
            let named: Vec<_> = problem.setup(&[], 20).unwrap().values.named().to_vec();
            let numbers: Vec<_> = named.iter().map(|(name, exact)| (name.clone(), exact.value.clone())).collect();
            let texts: Vec<_> = numbers.iter().map(|(name, value)| (name.clone(), text(value))).collect();
            let [of_texts, of_numbers] = [problem.setup(&texts, 20), problem.setup_with_numbers(&numbers, 20)];
            assert_eq!(of_texts.unwrap().values.named(), of_numbers.unwrap().values.named(), "{}", problem.name());
        }
    }

    #[test]
    fn numbers_that_cannot_be_set_are_refused_as_texts_are() {
        let kepler = problem("kepler").unwrap();
        let refused = |set: &[(&str, i32)]| {
            let number = |value: i32| Rational::from_integer(value.into());
            let numbers: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), number(*value))).collect();
            let texts: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), value.to_string())).collect();
            let found = kepler.setup_with_numbers(&numbers, 20).unwrap_err().to_string();
            assert_eq!(found, kepler.setup(&texts, 20).unwrap_err().to_string());
            found
        };
        assert!(refused(&[("eccentricity", 2)]).contains("eccentricity"));
        assert!(refused(&[("excentricity", 0)]).contains("excentricity"));
        assert!(refused(&[("x", 1), ("x", 2)]).contains('x'));
    }
}
