//! The modified energy of trajectories that other programs have computed.

use numpy::{PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use shadowstep::StepSize;
use shadowstep::shadow::recorded::{
    Derivatives, Diagnosis, Log, Logged, MadeStep, Recorded, RecordedError, Repeated, Units, Unwrapping, Window,
    integer_momenta, integer_momenta_with_gradients,
};
use shadowstep::shadow::run::{ShadowRun, States};
use shadowstep::shadow::{Bilinear, Estimator};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::start::{Begin, SceneIntegrator, Steps};

use crate::errors::{exception, usage};
use crate::given::{Given, step_size};
use crate::given_run::SystemWithScheme;
use crate::scheme::Table;
use crate::waiting::{waiting, waiting_for};

/// n, H̄ and its error of the states that have one.
type LogEstimates = (Vec<i64>, Vec<f64>, Vec<f64>);

/// The name of the unit of energies; that of times and how many of it a time has.
type UnitsOf = (String, String, f64);

/// The estimates E_k of a log of velocity Verlet: U with the forces of each state, or with the rate qᵀU_q − 2U; and why
/// its states are not those of steps.
#[pyfunction]
#[pyo3(signature = (q, p, energies, forces, rates, masses, h, k))]
#[allow(clippy::too_many_arguments)] // the package's own function has the defaults
pub(crate) fn energies_of_log(
    py: Python<'_>,
    q: PyReadonlyArray2<'_, f64>,
    p: PyReadonlyArray2<'_, f64>,
    energies: PyReadonlyArray1<'_, f64>,
    forces: Option<PyReadonlyArray2<'_, f64>>,
    rates: Option<PyReadonlyArray1<'_, f64>>,
    masses: Vec<f64>,
    h: &str,
    k: u32,
) -> PyResult<(LogEstimates, Option<String>)> {
    let h = step_size(py, h)?;
    let (dimension, q, p, energies) = (q.shape()[1], rows(&q)?, rows(&p)?, energies.to_vec()?);
    let gradients = forces.map(|forces| Ok::<_, PyErr>(negative(rows(&forces)?))).transpose()?;
    let rates = rates.map(|rates| rates.to_vec()).transpose()?;
    waiting(py, None, move |_| {
        let log = match (&gradients, &rates) {
            (Some(gradients), _) => Log::with_gradients(dimension, [&q, &p, gradients], &energies)?,
            (None, rates) => Log::with_rates(dimension, [&q, &p], [&energies, rates.as_deref().unwrap_or_default()])?,
        };
        let mut steps = Recorded::new(log, &h, &masses)?;
        let estimates = all(steps.clone().estimates(&h, &Bilinear::with_error(k))?)?;
        while steps.advance()?.is_some() {}
        Ok((estimates, steps.other_steps()))
    })?
    .map_err(|error: RecordedError| refused(py, &error))
}

/// The estimates E_k of states of a scheme, with the steps made again in a problem of ours.
#[pyfunction]
pub(crate) fn energies_of_states(
    py: Python<'_>,
    q: PyReadonlyArray2<'_, f64>,
    p: PyReadonlyArray2<'_, f64>,
    problem: &Given,
    scheme: &Table,
    h: &str,
    k: u32,
) -> PyResult<LogEstimates> {
    let h = step_size(py, h)?;
    let (given, scheme, q, p) = (problem.clone(), scheme.0.clone(), rows(&q)?, rows(&p)?);
    let found = waiting_for(py, None, Some(problem), move |_| -> Result<_, Error> {
        let posed = SystemWithScheme::of(&given, &scheme, Arithmetic::DOUBLE)?;
        let begin = Begin::InitialState;
        let steps = Steps { scheme: &posed.scheme.scheme, h: &h, compensated: false, displaced: false, begin };
        let integrator = posed.system.integrator(steps, posed.system.start::<f64>(&()), &());
        let integrator = integrator.map_err(|error| Error::usage(error.to_string(), "check the problem"))?;
        Ok(again(integrator, &q, &p, k))
    });
    found?.map_err(|error| exception(py, error))?.map_err(|error| refused(py, &error))
}

fn again(mut integrator: SceneIntegrator<f64>, q: &[f64], p: &[f64], k: u32) -> Result<LogEstimates, RecordedError> {
    all(Repeated::new(&mut *integrator, q, p)?.estimates(&Bilinear::with_error(k))?)
}

fn all<T: States<Number = f64>, E: Estimator<f64>>(mut run: ShadowRun<T, E>) -> Result<LogEstimates, RecordedError> {
    let mut all = LogEstimates::default();
    while let Some((n, found)) = run.advance()? {
        all.0.push(n);
        all.1.push(*found.value);
        all.2.push(found.error.copied().unwrap_or(f64::NAN));
    }
    Ok(all)
}

/// The momenta at the states, from the momenta of leapfrog between them: rows before and after each state.
#[pyfunction]
pub(crate) fn momenta_of_half_steps(
    py: Python<'_>,
    states: usize,
    half_steps: PyReadonlyArray2<'_, f64>,
) -> PyResult<Vec<f64>> {
    let dimension = half_steps.shape()[1];
    integer_momenta(dimension, states, &rows(&half_steps)?).map_err(|error| refused(py, &error))
}

/// The momenta at the states of those half a step before, with the forces.
#[pyfunction]
pub(crate) fn momenta_with_forces(
    py: Python<'_>,
    h: &str,
    half_steps: PyReadonlyArray2<'_, f64>,
    forces: PyReadonlyArray2<'_, f64>,
) -> PyResult<Vec<f64>> {
    let (h, mut p) = (step_size(py, h)?, rows(&half_steps)?);
    let converted = integer_momenta_with_gradients(&h, &mut p, &negative(rows(&forces)?));
    converted.map_err(|error| refused(py, &error)).map(|()| p)
}

/// Positions without jumps between the images of a periodic box.
#[pyfunction]
pub(crate) fn unwrapped(
    py: Python<'_>,
    q: PyReadonlyArray2<'_, f64>,
    cell: [[f64; 3]; 3],
    periodic: [bool; 3],
) -> PyResult<Vec<f64>> {
    let (dimension, q) = (q.shape()[1].max(1), rows(&q)?);
    let unwrap = || -> Result<Vec<f64>, RecordedError> {
        let mut unwrapping = Unwrapping::new(cell)?.along(periodic);
        let mut all = Vec::with_capacity(q.len());
        for row in q.chunks_exact(dimension) {
            all.extend(unwrapping.next(row)?);
        }
        Ok(all)
    };
    unwrap().map_err(|error| refused(py, &error))
}

/// Follows a trajectory that another program computes.
#[pyclass(module = "shadowstep._shadowstep")]
pub(crate) struct Observer {
    observer: shadowstep::shadow::recorded::Observer,
    h: StepSize,
    unwrapping: Option<Unwrapping>,
}

#[pymethods]
impl Observer {
    /// Before its first state.
    #[staticmethod]
    fn of(
        py: Python<'_>,
        masses: Vec<f64>,
        h: &str,
        window: usize,
        cell: Option<[[f64; 3]; 3]>,
        periodic: [bool; 3],
    ) -> PyResult<Self> {
        let h = step_size(py, h)?;
        let Some(window) = [Window::Nine, Window::Seventeen].into_iter().find(|known| known.states() == window) else {
            return Err(usage(py, format!("window = {window} is not known"), "a window has 9 or 17 states"));
        };
        let begin = || -> Result<_, RecordedError> {
            let unwrapping = cell.map(Unwrapping::new).transpose()?.map(|unwrapping| unwrapping.along(periodic));
            Ok((shadowstep::shadow::recorded::Observer::with_window(&h, &masses, window)?, unwrapping))
        };
        let (observer, unwrapping) = begin().map_err(|error| refused(py, &error))?;
        Ok(Observer { observer, h, unwrapping })
    }

    /// The next state is the state n, which does not follow the newest by a step.
    fn begin(&mut self, py: Python<'_>, n: i64) -> PyResult<()> {
        if let Some(unwrapping) = &mut self.unwrapping {
            unwrapping.begin();
        }
        self.observer.begin(n).map_err(|error| refused(py, &error))
    }

    /// How many states a window needs.
    #[getter]
    fn window(&self) -> usize {
        self.observer.states()
    }

    /// Takes the next state; `half_step` if the momenta are leapfrog's, half a step before it; with what the step to it
    /// added, where that is of another splitting.
    #[allow(clippy::too_many_arguments)] // the package's own function has the defaults
    fn observe(
        &mut self,
        py: Python<'_>,
        q: PyReadonlyArray1<'_, f64>,
        p: PyReadonlyArray1<'_, f64>,
        energy: f64,
        forces: PyReadonlyArray1<'_, f64>,
        half_step: bool,
        step: Option<(PyReadonlyArray1<'_, f64>, PyReadonlyArray1<'_, f64>, f64)>,
    ) -> PyResult<Option<(i64, f64, f64, f64)>> {
        let (q, mut p, gradient) = (q.to_vec()?, p.to_vec()?, negative(forces.to_vec()?));
        let step = step.map(|(q, p, beta)| Ok::<_, PyErr>((q.to_vec()?, p.to_vec()?, beta))).transpose()?;
        let Observer { observer, h, unwrapping } = self;
        // with Python's lock: other threads of it find the observer complete
        let mut observe = || -> Result<_, RecordedError> {
            if half_step {
                integer_momenta_with_gradients(h, &mut p, &gradient)?;
            }
            let q = match unwrapping {
                Some(unwrapping) => unwrapping.next(&q)?,
                None => &q,
            };
            let derivatives = match &step {
                Some((q, p, beta)) => Derivatives::Step(&gradient, MadeStep { q, p, beta: *beta }),
                None => Derivatives::Gradient(&gradient),
            };
            observer.observe(&Logged { q, p: &p, energy, derivatives })
        };
        let found = observe().map_err(|error| refused(py, &error))?;
        Ok(found.map(|value| (value.n, value.modified, value.error, value.energy)))
    }

    /// n, H̄, its error and H of all states that have an estimate.
    fn values(&self) -> (Vec<i64>, [Vec<f64>; 3]) {
        let values = self.observer.values();
        let of = |number: fn(&shadowstep::shadow::recorded::Value) -> f64| values.iter().map(number).collect();
        (values.iter().map(|value| value.n).collect(), [of(|v| v.modified), of(|v| v.error), of(|v| v.energy)])
    }

    /// What moves the energy, with texts in these units.
    fn diagnosis<'py>(&self, py: Python<'py>, units: Option<UnitsOf>) -> PyResult<Bound<'py, PyDict>> {
        let units = units.map(|(energy, time, of_time)| Units { energy, time: Some((time, of_time)) });
        dictionary(py, &self.observer.diagnosis().in_units(units.unwrap_or_default()))
    }
}

fn dictionary<'py>(py: Python<'py>, found: &Diagnosis) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    all.set_item("cause", found.cause.name())?;
    all.set_item("size", found.cause.size())?;
    all.set_item("reason", found.reason())?;
    all.set_item("text", found.to_string())?;
    all.set_item("states", found.states)?;
    all.set_item("estimates", found.estimates)?;
    let smoothness = found.smoothness;
    let [of_q, of_p] = found.differences.map_or([None; 2], |differences| differences.map(Some));
    let numbers = [
        ("kinetic", Some(found.kinetic)),
        ("energy_error", Some(found.energy_error)),
        ("method_error", Some(found.method_error)),
        ("change", Some(found.change)),
        ("range", Some(found.range)),
        ("moved", Some(found.moved)),
        ("known_to", Some(found.known_to)),
        ("time", Some(found.time)),
        ("forces", smoothness.map(|smoothness| smoothness.size)),
        ("force_differences", smoothness.map(|smoothness| smoothness.differences)),
        ("exponent", smoothness.map(|smoothness| smoothness.exponent)),
        ("excess", found.excess),
        ("energy_differences", found.energy_smoothness.map(|smoothness| smoothness.differences)),
        ("energy_exponent", found.energy_smoothness.map(|smoothness| smoothness.exponent)),
        ("in_a_step", Some(found.in_a_step)),
        ("growth", Some(found.growth)),
        ("isolation", Some(found.isolation)),
        ("off_q", of_q.map(|of| of.of_increments)),
        ("off_p", of_p.map(|of| of.of_increments)),
    ];
    for (name, number) in numbers {
        all.set_item(name, number)?;
    }
    all.set_item("reordered", found.reordered)?;
    all.set_item("jumps", found.jumps.iter().map(|jump| (jump.n, jump.energy)).collect::<Vec<_>>())?;
    Ok(all)
}

fn refused(py: Python<'_>, error: &RecordedError) -> PyErr {
    match error {
        RecordedError::Run(error) => exception(py, Error::run(error.to_string(), "check the log there")),
        RecordedError::NotFinite { .. } => {
            usage(py, error.to_string(), "give the states before it; a run that overflows has steps that are too large")
        }
        RecordedError::Mass { .. } => usage(py, error.to_string(), "give the mass of each coordinate or particle"),
        _ => usage(py, error.to_string(), "give arrays with a row for each state"),
    }
}

/// The numbers row by row.
fn rows(array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<f64>> {
    Ok(array.as_array().iter().copied().collect())
}

/// The gradient of forces, or the reverse.
fn negative(mut numbers: Vec<f64>) -> Vec<f64> {
    numbers.iter_mut().for_each(|number| *number = -*number);
    numbers
}
