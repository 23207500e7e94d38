//! A problem: the sections of a scene that describe a system, or a function that computes its forces.

use std::ops::Deref;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use shadowstep::StepSize;
use shadowstep::problems::PROBLEMS;
use shadowstep::tables::Source;
use shadowstep_scenes::arithmetic::{Arithmetic, DigitsError, MOST_DIGITS};
use shadowstep_scenes::keys::PROBLEM;
use shadowstep_scenes::outside::reading_outside;
use shadowstep_scenes::{Error, Note, System, source};
use shadowstep_symbolic::Exact;

use crate::errors::{exception, usage};
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
struct Read {
    system: System,
    notes: Vec<Note>,
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
    fn of_text(py: Python<'_>, text: String, path: String, allow_outside: bool) -> PyResult<Self> {
        Given::of(ProblemSource::Scene { source: Source { path, text }, outside: allow_outside }, py)
    }

    /// From a scene's file.
    #[staticmethod]
    fn of_file(py: Python<'_>, path: std::path::PathBuf, allow_outside: bool) -> PyResult<Self> {
        let source = source(&path).map_err(|error| exception(py, error))?;
        Given::of(ProblemSource::Scene { source, outside: allow_outside }, py)
    }

    /// With a function for the forces: a number is the address of a C function, anything else is called.
    #[staticmethod]
    #[pyo3(signature = (function, q, p, masses))]
    fn of_forces(
        py: Python<'_>,
        function: &Bound<'_, PyAny>,
        q: Vec<String>,
        p: Vec<String>,
        masses: Option<Vec<String>>,
    ) -> PyResult<Self> {
        let numbers = |what: &str, texts: Vec<String>| {
            texts.iter().map(|text| exact(py, what, text)).collect::<PyResult<Vec<_>>>()
        };
        let (q, p) = (numbers("q", q)?, numbers("p", p)?);
        let masses = masses.map(|masses| numbers("masses", masses)).transpose()?;
        let forces = Forces::of(function, q.len())?;
        Given::of(ProblemSource::Own { forces, q, p, masses }, py)
    }

    /// What [`of_text`](Given::of_text) makes it of again; `None` with a function for the forces.
    #[getter]
    fn source(&self) -> Option<(&str, &str, bool)> {
        match &self.0.source {
            ProblemSource::Scene { source: Source { path, text }, outside } => Some((text, path, *outside)),
            ProblemSource::Own { .. } => None,
        }
    }

    /// The names of q_1, q_2, ….
    #[getter]
    fn coordinates(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.system(Arithmetic::DOUBLE).map_err(|error| exception(py, error))?.coordinates.clone())
    }

    /// The names of p_1, p_2, ….
    #[getter]
    fn momenta(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.system(Arithmetic::DOUBLE).map_err(|error| exception(py, error))?.momenta.clone())
    }

    /// The parameters with their values as texts, to 100 digits.
    #[getter]
    fn parameters(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        let digits = Arithmetic::with_digits(100).expect("there are numbers of 100 digits");
        let system = self.system(digits).map_err(|error| exception(py, error))?;
        Ok(system.parameters.iter().map(|(name, exact)| (name.clone(), exact.value.to_string())).collect())
    }

    /// The state at t = 0 in double precision, in the coordinates that trajectories have.
    #[getter]
    fn initial(&self, py: Python<'_>) -> PyResult<(Vec<f64>, Vec<f64>)> {
        let system = self.system(Arithmetic::DOUBLE).map_err(|error| exception(py, error))?;
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
    fn energy(&self, py: Python<'_>) -> PyResult<f64> {
        let system = self.system(Arithmetic::DOUBLE).map_err(|error| exception(py, error))?;
        let (q, p) = system.start::<f64>(&());
        let energy = system.energy::<f64>(&())(&q, &p);
        self.raised(py)?;
        Ok(energy)
    }
}

/// The system of a problem, in the number type of a run.
pub(crate) struct GivenSystem(Arc<Read>);

impl Deref for GivenSystem {
    type Target = System;

    fn deref(&self) -> &System {
        &self.0.system
    }
}

impl Given {
    /// The system in a number type, which is read once.
    fn read(&self, arithmetic: Arithmetic) -> Result<Arc<Read>, Error> {
        let all = || self.0.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = all().iter().find(|(known, _)| *known == arithmetic) {
            return Ok(Arc::clone(known));
        }
        let (system, notes) = self.read_anew(arithmetic)?;
        let read = Arc::new(Read { system, notes });
        all().push((arithmetic, Arc::clone(&read)));
        Ok(read)
    }

    /// The system in a number type, which may be needed once.
    pub(crate) fn read_anew(&self, arithmetic: Arithmetic) -> Result<(System, Vec<Note>), Error> {
        let (system, notes) = match &self.0.source {
            ProblemSource::Scene { source, outside } => reading_outside(*outside, || System::read(source, arithmetic))?,
            ProblemSource::Own { forces, q, p, masses } => {
                let own = Box::new(forces.clone());
                (System::of_own_potential(own, (q.clone(), p.clone()), masses.clone())?, Vec::new())
            }
        };
        system.check_digits(arithmetic)?;
        Ok((system, notes))
    }

    /// The system in a number type.
    pub(crate) fn system(&self, arithmetic: Arithmetic) -> Result<GivenSystem, Error> {
        self.read(arithmetic).map(GivenSystem)
    }

    /// What the user should know about it.
    pub(crate) fn notes(&self, arithmetic: Arithmetic) -> Result<Vec<Note>, Error> {
        Ok(self.read(arithmetic)?.notes.clone())
    }

    /// Whether the function for the forces has raised something that was not [taken](Given::raised).
    pub(crate) fn has_raised(&self, py: Python<'_>) -> bool {
        match &self.0.source {
            ProblemSource::Own { forces, .. } => forces.has_raised(py),
            ProblemSource::Scene { .. } => false,
        }
    }

    /// What the function for the forces has raised since it was asked last.
    pub(crate) fn raised(&self, py: Python<'_>) -> PyResult<()> {
        match &self.0.source {
            ProblemSource::Own { forces, .. } => forces.raised(py),
            ProblemSource::Scene { .. } => Ok(()),
        }
    }

    fn of(source: ProblemSource, py: Python<'_>) -> PyResult<Self> {
        let given = Given(Arc::new(GivenProblem { source, read: Mutex::default() }));
        given.system(Arithmetic::DOUBLE).map_err(|error| exception(py, error))?;
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

fn exact(py: Python<'_>, what: &str, text: &str) -> PyResult<Exact> {
    number(py, what, text).map(|value| Exact { value, rounded: false })
}

/// A step size, exactly.
pub(crate) fn step_size(py: Python<'_>, h: &str) -> PyResult<StepSize> {
    let exact = number(py, "h", h)?;
    StepSize::try_from(exact).map_err(|error| usage(py, format!("h = {h}: {error}"), "write a step size such as 1/10"))
}

/// The exact number of an argument.
pub(crate) fn number(py: Python<'_>, what: &str, text: &str) -> PyResult<shadowstep::Rational> {
    shadowstep::exact(text).map_err(|error| {
        usage(py, format!("{what} = `{text}`: {error}"), shadowstep_scenes::arithmetic::NUMBER_EXAMPLES)
    })
}

/// The number type of some digits: a name or a number.
pub(crate) fn arithmetic(py: Python<'_>, digits: &str, mpfr: bool) -> PyResult<Arithmetic> {
    if let Some((_, named)) = Arithmetic::NAMED.iter().find(|(name, _)| *name == digits) {
        return match mpfr {
            true => {
                Err(usage(py, format!("mpfr requires a number of digits, not digits = \"{digits}\""), "digits = 120"))
            }
            false => Ok(*named),
        };
    }
    let names = Arithmetic::NAMED.iter().map(|(name, _)| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let hint = format!("give a number of decimal digits up to {MOST_DIGITS}, or one of {names}");
    match digits.parse() {
        Ok(count @ 1..=MOST_DIGITS) => Arithmetic::of_digits(count, mpfr).map_err(|error: DigitsError| {
            let hint = match error {
                DigitsError::NeedsMpfr(_) => "use fewer digits, or a wheel with MPFR: `make wheel MPFR=1`".to_owned(),
                DigitsError::Precision(_) => hint,
            };
            usage(py, format!("digits = {digits}: {error}"), hint)
        }),
        _ => Err(usage(py, format!("digits = {digits} is not a number type"), hint)),
    }
}

/// The meaning of a word among those that an option has.
pub(crate) fn word<T: Copy>(py: Python<'_>, option: &str, word: &str, known: &[(&str, T)]) -> PyResult<T> {
    known.iter().find(|(name, _)| *name == word).map(|(_, value)| *value).ok_or_else(|| {
        let names = known.iter().map(|(name, _)| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
        usage(py, format!("{option} = \"{word}\" is not known"), format!("it is one of {names}"))
    })
}
