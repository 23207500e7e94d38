//! Problems with their parameters and initial states: those of the paper, then scenes of many bodies.

mod argon_crystal;
mod figure_eight;
mod fput_alpha;
mod fput_stiff;
mod gravity;
mod harmonic_oscillator;
mod henon_heiles;
mod initial;
mod kepler;
mod outer_solar_system;
mod pendulum;
mod pythagorean;
mod scattering;
mod toda;

pub use argon_crystal::LennardJones;
pub use fput_alpha::CubicSpring;
pub use fput_stiff::StiffFput;
pub use gravity::Gravity;
pub use harmonic_oscillator::HarmonicOscillator;
pub use henon_heiles::HenonHeiles;
pub use initial::Initial;
pub use kepler::Kepler;
pub use pendulum::Pendulum;
pub use scattering::Scattering;
pub use toda::TodaSpring;

use std::collections::BTreeMap;

use shadowstep_symbolic::{Exact, evaluate, meant, parse};
use thiserror::Error;

use crate::Rational;
use crate::kinetic::{DiagonalMasses, Kinetic, MassError, Quadratic, UnitMasses};
use crate::motion::Motion;
use crate::number::Number;
use crate::pairs::{Ends, Pairs};
use crate::potential::Potential;

/// A problem: its potential and, as exact expressions, its parameters and initial state.
#[derive(Clone, Copy, Debug)]
pub struct Problem {
    /// Short name.
    pub name: &'static str,
    /// A line for people.
    pub title: &'static str,
    /// H(q, p) as a formula.
    pub hamiltonian: &'static str,
    /// Parameters in an order in which each default needs earlier ones only.
    pub parameters: &'static [Parameter],
    /// The initial state and the masses, which may use the parameters.
    pub initial: fn() -> Initial,
    /// A step size with which a scheme of order 4 follows it.
    pub step: &'static str,
    /// A time by which something has happened.
    pub until: &'static str,
    /// Where problem and numbers are from.
    pub source: &'static str,
}

/// A parameter of a problem.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its default, an exact expression.
    pub default: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// Which values make sense, in words.
    pub range: &'static str,
    /// Whether a value makes sense.
    pub allowed: fn(&Rational) -> bool,
}

/// All problems: those of the paper in its order, then those of many bodies.
pub const PROBLEMS: [Problem; 12] = [
    harmonic_oscillator::PROBLEM,
    pendulum::PROBLEM,
    kepler::PROBLEM,
    henon_heiles::PROBLEM,
    scattering::PROBLEM,
    outer_solar_system::PROBLEM,
    figure_eight::PROBLEM,
    pythagorean::PROBLEM,
    argon_crystal::PROBLEM,
    fput_stiff::PROBLEM,
    fput_alpha::PROBLEM,
    toda::PROBLEM,
];

/// A problem by its name.
///
/// # Errors
/// An unknown name; the message has the nearest known one.
pub fn problem(name: &str) -> Result<&'static Problem, ProblemError> {
    PROBLEMS.iter().find(|p| p.name == name).ok_or_else(|| ProblemError::UnknownProblem {
        name: name.to_owned(),
        hint: meant(name, &PROBLEMS.map(|p| p.name)),
    })
}

/// The system of a problem, chosen at run time.
pub type ProblemMotion<N> = Motion<N, Vec<N>, Box<dyn Potential<N>>, Box<dyn Kinetic<N, Class = Quadratic>>>;

/// A problem with all its values.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The problem.
    pub problem: &'static Problem,
    /// Every parameter, position and momentum by its name, in the order of the problem.
    pub values: Vec<(String, Exact)>,
    /// One per coordinate; none, if all are 1.
    pub masses: Option<Vec<Exact>>,
}

impl Problem {
    /// The problem with some values set by exact expressions, which may use parameters that stand before.
    ///
    /// Irrational values are rounded to `digits` digits.
    ///
    /// # Errors
    /// Unknown or repeated names, expressions that have no value, parameters out of range.
    pub fn setup(&'static self, set: &[(String, String)], digits: u32) -> Result<Setup, ProblemError> {
        let Initial { positions, momenta, masses } = (self.initial)();
        let parameters = self.parameters.iter().map(|p| (p.name.to_owned(), p.default.to_owned()));
        let all: Vec<(String, String)> = parameters.chain(positions).chain(momenta).collect();
        let names: Vec<_> = all.iter().map(|(name, _)| name.as_str()).collect();
        for (i, (name, _)) in set.iter().enumerate() {
            if !names.contains(&name.as_str()) {
                return Err(ProblemError::UnknownParameter {
                    problem: self.name,
                    name: name.clone(),
                    hint: meant(name, &names),
                });
            }
            if set[..i].iter().any(|(other, _)| other == name) {
                return Err(ProblemError::SetTwice { name: name.clone() });
            }
        }
        let mut known = BTreeMap::new();
        let mut values = Vec::new();
        for (name, default) in all {
            let text = set.iter().find(|(n, _)| *n == name).map_or(default, |(_, text)| text.clone());
            let value = value_of(&name, &text, &known, digits)?;
            self.check(&name, &text, &value.value)?;
            known.insert(name.clone(), value.clone());
            values.push((name, value));
        }
        let mass = |text: &String| value_of("mass", text, &known, digits);
        let masses = masses.map(|texts| texts.iter().map(mass).collect::<Result<_, ProblemError>>()).transpose()?;
        Ok(Setup { problem: self, values, masses })
    }

    fn check(&self, name: &str, text: &str, value: &Rational) -> Result<(), ProblemError> {
        match self.parameters.iter().find(|p| p.name == name) {
            Some(parameter) if !(parameter.allowed)(value) => {
                Err(ProblemError::OutOfRange { name: parameter.name, text: text.to_owned(), range: parameter.range })
            }
            _ => Ok(()),
        }
    }
}

fn value_of(name: &str, text: &str, known: &BTreeMap<String, Exact>, digits: u32) -> Result<Exact, ProblemError> {
    let wrong = |why: String| ProblemError::NoValue { name: name.to_owned(), text: text.to_owned(), why };
    let expression = parse(text).map_err(|e| wrong(e.to_string()))?;
    evaluate(&expression, known, digits).map_err(|e| wrong(e.to_string()))
}

fn numbers<N: Number>(values: &[(String, Exact)], context: &N::Context) -> Vec<N> {
    values.iter().map(|(_, exact)| N::from_rational(&exact.value, context)).collect()
}

impl Setup {
    /// A value by its name.
    ///
    /// # Panics
    /// If the problem has no value of this name.
    pub fn value(&self, name: &str) -> &Rational {
        let found = self.values.iter().find(|(known, _)| known == name);
        &found.unwrap_or_else(|| panic!("{} has no `{name}`", self.problem.name)).1.value
    }

    /// The initial positions by their names.
    pub fn positions(&self) -> &[(String, Exact)] {
        let state = &self.values[self.problem.parameters.len()..];
        &state[..state.len() / 2]
    }

    /// The initial momenta by their names.
    pub fn momenta(&self) -> &[(String, Exact)] {
        let state = &self.values[self.problem.parameters.len()..];
        &state[state.len() / 2..]
    }

    /// The initial q, each rounded once.
    pub fn q<N: Number>(&self, context: &N::Context) -> Vec<N> {
        numbers(self.positions(), context)
    }

    /// The initial p, each rounded once.
    pub fn p<N: Number>(&self, context: &N::Context) -> Vec<N> {
        numbers(self.momenta(), context)
    }

    /// The system at its initial state.
    ///
    /// # Errors
    /// A mass that is not positive.
    pub fn motion<N: Number + 'static>(&self, context: &N::Context) -> Result<ProblemMotion<N>, MassError> {
        let kinetic = self.kinetic(context)?;
        Ok(Motion::new(self.potential(context), kinetic, self.q(context), self.p(context)))
    }

    /// The kinetic energy.
    ///
    /// # Errors
    /// A mass that is not positive.
    pub fn kinetic<N: Number + 'static>(
        &self,
        context: &N::Context,
    ) -> Result<Box<dyn Kinetic<N, Class = Quadratic>>, MassError> {
        Ok(match &self.masses {
            None => Box::new(UnitMasses),
            Some(masses) => {
                let masses: Vec<Rational> = masses.iter().map(|mass| mass.value.clone()).collect();
                Box::new(DiagonalMasses::new(&masses, context)?)
            }
        })
    }

    /// The potential.
    pub fn potential<N: Number + 'static>(&self, context: &N::Context) -> Box<dyn Potential<N>> {
        let number = |name: &str| N::from_rational(self.value(name), context);
        match self.problem.name {
            "harmonic-oscillator" => Box::new(HarmonicOscillator { omega: number("omega") }),
            "pendulum" => Box::new(Pendulum),
            "kepler" => Box::new(Kepler),
            "henon-heiles" => Box::new(HenonHeiles),
            "scattering" => Box::new(Scattering),
            "outer-solar-system" => {
                let m = outer_solar_system::MASSES.map(number).to_vec();
                Box::new(Pairs::<_, 3>::all(m.len(), Gravity { g: number("g"), m }))
            }
            "figure-eight" | "pythagorean" => {
                let m = ["m_1", "m_2", "m_3"].map(number).to_vec();
                Box::new(Pairs::<_, 2>::all(3, Gravity { g: number("g"), m }))
            }
            "argon-crystal" => {
                let pair = LennardJones { epsilon: number("epsilon"), sigma: number("sigma") };
                Box::new(Pairs::<_, 2>::all(argon_crystal::ATOMS, pair))
            }
            "fput-stiff" => Box::new(StiffFput { omega: number("omega") }),
            "fput-alpha" => {
                let pair = CubicSpring { alpha: number("alpha") };
                Box::new(Pairs::<_, 1>::neighbours(fput_alpha::BODIES, pair, Ends::Fixed))
            }
            "toda" => Box::new(Pairs::<_, 1>::neighbours(toda::BODIES, TodaSpring, Ends::Periodic)),
            name => unreachable!("{name} is not among the problems"),
        }
    }
}

/// What is wrong with a problem's name or values.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ProblemError {
    /// There is no such problem.
    #[error("there is no problem `{name}`; {hint}")]
    UnknownProblem {
        /// The name given.
        name: String,
        /// The nearest one.
        hint: String,
    },
    /// The problem has no such parameter or initial value.
    #[error("{problem} has no parameter or initial value `{name}`; {hint}")]
    UnknownParameter {
        /// The problem.
        problem: &'static str,
        /// The name given.
        name: String,
        /// The nearest one.
        hint: String,
    },
    /// A parameter is given twice.
    #[error("`{name}` is set twice; keep one")]
    SetTwice {
        /// Its name.
        name: String,
    },
    /// An expression has no value.
    #[error("{name}={text}: {why}")]
    NoValue {
        /// The parameter.
        name: String,
        /// The expression.
        text: String,
        /// Why.
        why: String,
    },
    /// A value makes no sense.
    #[error("{name}={text} is out of range: {range}")]
    OutOfRange {
        /// The parameter.
        name: &'static str,
        /// The expression.
        text: String,
        /// The values that make sense.
        range: &'static str,
    },
}
