//! The monitor of the modified energy, for loops that do something else between steps.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use shadowstep::shadow::Report;
use shadowstep::shadow::run::RunError;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep_scenes::Error;
use shadowstep_scenes::computation::{Monitoring, RunNumber as _};
use shadowstep_scenes::start::{Begin, SceneIntegrator, Steps};

use crate::errors::exception;
use crate::given::{Given, arithmetic, step_size};
use crate::integrate::SystemWithScheme;
use crate::scheme::Table;

/// A system in double precision with its steps and its monitor.
#[pyclass(unsendable, module = "shadowstep._shadowstep")]
pub(crate) struct Monitor {
    integrator: SceneIntegrator<f64>,
    monitor: Box<dyn Monitoring<f64>>,
    newest: Option<(u64, f64, Option<f64>, f64)>,
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
        let h = step_size(py, h)?;
        let given = problem.get();
        let failed = |error| exception(py, error);
        if arithmetic.is_longer_than_double() {
            let message = "a monitor for loops computes in double precision";
            return Err(failed(Error::usage(message, "give digits = \"double\" or \"compensated\"")));
        }
        let posed = SystemWithScheme::of(given, &scheme.0, arithmetic).map_err(failed)?;
        let compensated = arithmetic.is_compensated();
        let steps =
            Steps { scheme: &posed.scheme.scheme, h: &h, compensated, displaced: false, begin: Begin::InitialState };
        let integrator = posed.system.integrator(steps, posed.system.start::<f64>(&()), &());
        let mut integrator = integrator.map_err(|error| failed(error.into()))?;
        let monitor = f64::monitor(&mut *integrator, order, every);
        given.raised(py)?;
        let monitor = monitor.map_err(|error| failed(of_run(&error)))?;
        Ok(Monitor { integrator, monitor, newest: None, problem })
    }

    /// A number of steps.
    fn step(&mut self, py: Python<'_>, count: u64) -> PyResult<()> {
        const SIGNALS: u64 = 4096;
        let mut left = count;
        while left > 0 {
            let now = left.min(SIGNALS);
            let found = self.steps(now);
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
        self.monitor.n()
    }

    /// q and p of the present state.
    fn state<'py>(&mut self, py: Python<'py>) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        let state = |integrator: &mut VectorIntegrator<'_, f64>| {
            (integrator.state().q().to_vec(), integrator.state().p().to_vec())
        };
        let (q, p) = at_output(&mut *self.integrator, state);
        (PyArray1::from_vec(py, q), PyArray1::from_vec(py, p))
    }

    /// H of the present state.
    fn energy(&mut self) -> f64 {
        at_output(&mut *self.integrator, |integrator| integrator.system().energy())
    }

    /// The newest estimate: n, the modified energy, its error and H, all of the middle of its window; `None` before the first.
    #[getter]
    fn newest(&self) -> Option<(u64, f64, Option<f64>, f64)> {
        self.newest
    }

    /// The report on the run so far.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        dictionary(py, &self.monitor.report())
    }
}

impl Monitor {
    fn steps(&mut self, count: u64) -> Result<(), RunError> {
        for _ in 0..count {
            if let Some(sample) = self.monitor.step(&mut *self.integrator)? {
                self.newest = Some((sample.n, *sample.modified, sample.error.copied(), *sample.energy));
            }
        }
        Ok(())
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
