//! The monitor of the modified energy, for loops that do something else between steps.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use shadowstep::run::RunError;
use shadowstep::shadow::{Bilinear, Estimator, Report, ShadowEnergy};
use shadowstep::{Scheme, Stepper, System, ValidFor};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::start::{Begin, Steps, Work};

use crate::errors::exception;
use crate::given::{Given, arithmetic, number};
use crate::integrate::Posed;
use crate::scheme::Table;

/// A system in double precision with its steps and its monitor.
#[pyclass(unsendable, module = "shadowstep._shadowstep")]
pub(crate) struct Monitor {
    followed: Box<dyn Followed>,
    problem: Py<Given>,
}

#[pymethods]
impl Monitor {
    #[new]
    #[pyo3(signature = (problem, scheme, h, *, order, every, digits))]
    fn new(
        py: Python<'_>,
        problem: Py<Given>,
        scheme: &Table,
        h: &str,
        order: u32,
        every: u64,
        digits: &str,
    ) -> PyResult<Self> {
        let arithmetic = arithmetic(py, digits, false)?;
        let h = number(py, h)?;
        let given = problem.get();
        let failed = |error| exception(py, error);
        if arithmetic.is_longer_than_double() {
            let message = "a monitor for loops computes in double precision";
            return Err(failed(Error::usage(message, "give digits = \"double\" or \"compensated\"")));
        }
        if h == shadowstep::Rational::from_integer(0.into()) {
            return Err(failed(Error::usage("the step size must be nonzero", "write a step size such as 1/10")));
        }
        let posed = Posed::of(given, &scheme.0, arithmetic).map_err(failed)?;
        let compensated = matches!(arithmetic, Arithmetic::Compensated);
        let steps =
            Steps { scheme: &posed.scheme.scheme, h: &h, compensated, displaced: false, begin: Begin::InitialState };
        let start = posed.system.start::<f64>(&());
        let begun = posed.system.with(steps, start, &(), Begun { order, every });
        given.raised(py)?;
        let begun = begun.map_err(|error| failed(Error::usage(error.to_string(), "check the initial state")))?;
        let followed = begun.map_err(|error| failed(of_run(&error)))?;
        Ok(Monitor { followed, problem })
    }

    /// Makes `count` steps.
    fn step(&mut self, py: Python<'_>, count: u64) -> PyResult<()> {
        const SIGNALS: u64 = 4096;
        let mut left = count;
        while left > 0 {
            let now = left.min(SIGNALS);
            let found = self.followed.steps(now);
            self.problem.get().raised(py)?;
            found.map_err(|error| exception(py, of_run(&error)))?;
            left -= now;
            py.check_signals()?;
        }
        Ok(())
    }

    /// The number of the present state.
    #[getter]
    fn n(&self) -> u64 {
        self.followed.n()
    }

    /// q and p of the present state.
    fn state<'py>(&mut self, py: Python<'py>) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        let (q, p) = self.followed.state();
        (PyArray1::from_vec(py, q), PyArray1::from_vec(py, p))
    }

    /// H of the present state.
    fn energy(&mut self) -> f64 {
        self.followed.energy()
    }

    /// The newest estimate: n, the modified energy, its error and H, all of the middle of its window; `None` before the first.
    #[getter]
    fn newest(&self) -> Option<(u64, f64, Option<f64>, f64)> {
        self.followed.newest()
    }

    /// The report on the run so far.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        dictionary(py, &self.followed.report())
    }
}

fn of_run(error: &RunError) -> Error {
    Error::run(error.to_string(), "try a smaller step size or another initial state")
}

fn dictionary<'py>(py: Python<'py>, report: &Report<f64>) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    all.set_item("verdict", report.verdict.name())?;
    all.set_item("is_fine", report.verdict.is_fine())?;
    all.set_item("reason", report.reason())?;
    all.set_item("text", report.to_string())?;
    all.set_item("steps", report.steps)?;
    all.set_item("windows", report.windows)?;
    let numbers = [
        ("time", Some(report.time)),
        ("energy_error", Some(report.energy_error)),
        ("kinetic", Some(report.kinetic)),
        ("method_least", Some(report.method_least)),
        ("method_largest", Some(report.method_largest)),
        ("method_rms", Some(report.method_rms)),
        ("modified", Some(report.modified)),
        ("range", Some(report.range)),
        ("change", Some(report.change)),
        ("moved", Some(report.moved)),
        ("permanent_bound", report.permanent_bound),
        ("permanent_change", report.permanent_change),
        ("resolution", report.resolution),
        ("worst_error", report.worst_error),
        ("round_off", Some(report.round_off)),
        ("steps_per_turn", report.steps_per_turn),
        ("irregular", report.irregular),
    ];
    for (name, number) in numbers {
        all.set_item(name, number)?;
    }
    Ok(all)
}

/// A system of any kind with its monitor.
trait Followed {
    fn steps(&mut self, count: u64) -> Result<(), RunError>;
    fn n(&self) -> u64;
    fn state(&mut self) -> (Vec<f64>, Vec<f64>);
    fn energy(&mut self) -> f64;
    fn newest(&self) -> Option<(u64, f64, Option<f64>, f64)>;
    fn report(&self) -> Report<f64>;
}

struct Following<S: Scheme, M, E> {
    system: M,
    monitor: ShadowEnergy<S, f64, E>,
    newest: Option<(u64, f64, Option<f64>, f64)>,
}

impl<S, M, E> Followed for Following<S, M, E>
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number = f64>,
    E: Estimator<f64>,
{
    fn steps(&mut self, count: u64) -> Result<(), RunError> {
        for _ in 0..count {
            if let Some(sample) = self.monitor.step(&mut self.system)? {
                self.newest = Some((sample.n, *sample.modified, sample.error.copied(), *sample.energy));
            }
        }
        Ok(())
    }

    fn n(&self) -> u64 {
        self.monitor.n()
    }

    fn state(&mut self) -> (Vec<f64>, Vec<f64>) {
        let read = |system: &mut M| (system.q().to_vec(), system.p().to_vec());
        self.monitor.stepper().at_output(&mut self.system, read)
    }

    fn energy(&mut self) -> f64 {
        self.monitor.stepper().at_output(&mut self.system, M::energy)
    }

    fn newest(&self) -> Option<(u64, f64, Option<f64>, f64)> {
        self.newest
    }

    fn report(&self) -> Report<f64> {
        self.monitor.report()
    }
}

/// Begins to follow a system.
struct Begun {
    order: u32,
    every: u64,
}

impl Work<f64> for Begun {
    type Output = Result<Box<dyn Followed>, RunError>;

    fn with<S, M>(self, stepper: &Stepper<S, f64>, mut system: M) -> Self::Output
    where
        S: Scheme + Clone + ValidFor<M::Class> + 'static,
        M: System<Number = f64> + 'static,
    {
        let monitor = ShadowEnergy::new(stepper.clone(), &mut system, &Bilinear::with_error(self.order))?;
        Ok(Box::new(Following { monitor: monitor.every(self.every), system, newest: None }))
    }
}
