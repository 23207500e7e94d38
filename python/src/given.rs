//! A problem: the sections of a scene that describe a system, or a function that computes its forces.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use shadowstep::problems::PROBLEMS;
use shadowstep::tables::Source;
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::arithmetic::{Arithmetic, DigitsError, MOST_DIGITS, NUMBER_EXAMPLES};
use shadowstep_scenes::keys::PROBLEM;
use shadowstep_scenes::outside::reading_outside;
use shadowstep_scenes::{Error, Note, System, source};
use shadowstep_schemes::symbolic::Exact;

use crate::errors::{Fallible, usage};
use crate::own_forces::Forces;

/// A problem as it was given.
#[pyclass(frozen, module = "shadowstep._shadowstep")]
#[derive(Clone)]
pub(crate) struct Given(Arc<GivenProblem>);

struct GivenProblem {
    source: ProblemSource,
    /// The system in each number type that was asked for: exact values are computed to its digits.
    read: Mutex<Vec<(Arithmetic, Arc<Read>)>>,
}

/// A system, and what the user should know about it.
pub(crate) struct Read {
    pub(crate) system: System,
    pub(crate) notes: Vec<Note>,
}

enum ProblemSource {
    /// The text of a scene, and whether it may name files outside of its folder.
    Scene {
        source: Source,
        outside: bool,
    },
    Own {
        forces: Forces,
        q: Vec<Exact>,
        p: Vec<Exact>,
        masses: Option<Vec<Exact>>,
    },
}

#[pymethods]
impl Given {
    /// From the text of a scene, of which \[problem\], \[initial\], \[\[body\]\] and \[time\] are used.
    #[staticmethod]
    fn of_text(text: String, path: String, allow_outside: bool) -> Fallible<Self> {
        Given::of(ProblemSource::Scene { source: Source { path, text }, outside: allow_outside })
    }

    /// From a scene's file.
    #[staticmethod]
    fn of_file(path: PathBuf, allow_outside: bool) -> Fallible<Self> {
        Given::of(ProblemSource::Scene { source: source(&path)?, outside: allow_outside })
    }

    /// With a function for the forces: a number is the address of a C function, anything else is called.
    #[staticmethod]
    fn of_forces(
        function: &Bound<'_, PyAny>,
        q: Vec<String>,
        p: Vec<String>,
        masses: Option<Vec<String>>,
    ) -> Fallible<Self> {
        let (q, p) = (numbers("q", &q)?, numbers("p", &p)?);
        let masses = masses.map(|masses| numbers("masses", &masses)).transpose()?;
        let forces = Forces::of(function, q.len())?;
        Given::of(ProblemSource::Own { forces, q, p, masses })
    }

    /// What [`of_text`](Given::of_text) makes it of again; `None` with a function for the forces.
    #[getter]
    fn source(&self) -> Option<(&str, &str, bool)> {
        match &self.0.source {
            ProblemSource::Scene { source: Source { path, text }, outside } => Some((text, path, *outside)),
            ProblemSource::Own { .. } => None,
        }
    }

    /// The names of q_1, q_2, …, and of p_1, p_2, ….
    #[getter]
    fn names(&self) -> Fallible<[Vec<String>; 2]> {
        let system = &self.read(Arithmetic::DOUBLE)?.system;
        Ok([system.coordinates.clone(), system.momenta.clone()])
    }

    /// The parameters with their values as texts, to 100 digits.
    #[getter]
    fn parameters(&self) -> Fallible<Vec<(String, String)>> {
        let digits = Arithmetic::with_digits(100).expect("there are numbers of 100 digits");
        let parameters = &self.read(digits)?.system.parameters;
        Ok(parameters.iter().map(|(name, exact)| (name.clone(), exact.value.to_string())).collect())
    }

    /// The state at t = 0 in double precision, in the coordinates that trajectories have.
    #[getter]
    fn initial(&self) -> Fallible<(Vec<f64>, Vec<f64>)> {
        let system = &self.read(Arithmetic::DOUBLE)?.system;
        let (q, p) = system.start::<f64>(&());
        Ok(match system.shown::<f64>(&()) {
            Some(mut shown) => {
                let (q, p) = shown.of_state(&q, &p);
                (q.to_vec(), p.to_vec())
            }
            None => (q, p),
        })
    }

    /// H at t = 0 in double precision.
    #[getter]
    fn energy(&self, py: Python<'_>) -> Fallible<f64> {
        let system = &self.read(Arithmetic::DOUBLE)?.system;
        let (q, p) = system.start::<f64>(&());
        let energy = system.energy::<f64>(&())(&q, &p);
        self.raised(py)?;
        Ok(energy)
    }
}

impl Given {
    /// The system in a number type, which is read once.
    pub(crate) fn read(&self, arithmetic: Arithmetic) -> Result<Arc<Read>, Error> {
        let all = || self.0.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = all().iter().find(|(known, _)| *known == arithmetic) {
            return Ok(Arc::clone(known));
        }
        let read = Arc::new(self.read_anew(arithmetic)?);
        all().push((arithmetic, Arc::clone(&read)));
        Ok(read)
    }

    /// The system in a number type, which may be needed once.
    pub(crate) fn read_anew(&self, arithmetic: Arithmetic) -> Result<Read, Error> {
        let (system, notes) = match &self.0.source {
            ProblemSource::Scene { source, outside } => reading_outside(*outside, || System::read(source, arithmetic))?,
            ProblemSource::Own { forces, q, p, masses } => {
                let own = Box::new(forces.clone());
                (System::of_own_potential(own, (q.clone(), p.clone()), masses.clone())?, Vec::new())
            }
        };
        system.check_digits(arithmetic)?;
        Ok(Read { system, notes })
    }

    /// Whether the function for the forces has raised something that was not [taken](Given::raised).
    pub(crate) fn has_raised(&self, py: Python<'_>) -> bool {
        self.forces().is_some_and(|forces| forces.has_raised(py))
    }

    /// What the function for the forces has raised since it was asked last.
    pub(crate) fn raised(&self, py: Python<'_>) -> PyResult<()> {
        self.forces().map_or(Ok(()), |forces| forces.raised(py))
    }

    fn forces(&self) -> Option<&Forces> {
        match &self.0.source {
            ProblemSource::Own { forces, .. } => Some(forces),
            ProblemSource::Scene { .. } => None,
        }
    }

    fn of(source: ProblemSource) -> Fallible<Self> {
        let given = Given(Arc::new(GivenProblem { source, read: Mutex::default() }));
        given.read(Arithmetic::DOUBLE)?;
        Ok(given)
    }
}

/// The names of the shipped problems.
#[pyfunction]
pub(crate) fn problem_names() -> Vec<&'static str> {
    PROBLEMS.iter().map(|problem| problem.name()).collect()
}

/// The keys of [problem] with what they need.
#[pyfunction]
pub(crate) fn problem_keys() -> Vec<(&'static str, &'static [&'static str])> {
    PROBLEM.keys.iter().map(|key| (key.name, key.needs)).collect()
}

fn numbers(what: &str, texts: &[String]) -> Fallible<Vec<Exact>> {
    texts.iter().map(|text| Ok(Exact { value: number(what, text)?, rounded: false })).collect()
}

/// A step size, exactly.
pub(crate) fn step_size(h: &str) -> Fallible<StepSize> {
    let exact = number("h", h)?;
    StepSize::try_from(exact).map_err(|error| usage(format!("h = {h}: {error}"), "write a step size such as 1/10"))
}

/// The exact number of an argument.
pub(crate) fn number(what: &str, text: &str) -> Fallible<Rational> {
    shadowstep::exact(text).map_err(|error| usage(format!("{what} = `{text}`: {error}"), NUMBER_EXAMPLES))
}

/// The number type of some digits: a name or a number.
pub(crate) fn arithmetic(digits: &str, mpfr: bool) -> Fallible<Arithmetic> {
    match Arithmetic::NAMED.iter().find(|(name, _)| *name == digits) {
        Some(_) if mpfr => {
            let message = format!("mpfr requires a number of digits, not digits = \"{digits}\"");
            return Err(usage(message, "digits = 120"));
        }
        Some((_, named)) => return Ok(*named),
        None => {}
    }
    let names = listed(Arithmetic::NAMED);
    let hint = format!("give a number of decimal digits up to {MOST_DIGITS}, or one of {names}");
    match digits.parse() {
        Ok(count @ 1..=MOST_DIGITS) => Arithmetic::of_digits(count, mpfr).map_err(|error: DigitsError| {
            let hint = match error {
                DigitsError::NeedsMpfr(_) => "use fewer digits, or a wheel with MPFR: `make wheel MPFR=1`".to_owned(),
                DigitsError::Precision(_) => hint,
            };
            usage(format!("digits = {digits}: {error}"), hint)
        }),
        _ => Err(usage(format!("digits = {digits} is not a number type"), hint)),
    }
}

/// The meaning of a word among those that an option has.
pub(crate) fn word<T: Copy>(option: &str, word: &str, known: &[(&str, T)]) -> Fallible<T> {
    let entry = known.iter().find(|(name, _)| *name == word);
    let unknown = || usage(format!("{option} = \"{word}\" is not known"), format!("it is one of {}", listed(known)));
    entry.map(|(_, value)| *value).ok_or_else(unknown)
}

fn listed<T>(known: &[(&str, T)]) -> String {
    known.iter().map(|(name, _)| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")
}
