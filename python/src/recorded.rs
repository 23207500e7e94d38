//! The modified energy of trajectories that other programs have computed.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use shadowstep::StepSize;
use shadowstep::shadow::recorded::{
    self, Derivatives, Diagnosis, Log, Logged, MadeStep, Recorded, RecordedError, Repeated, Units, Unwrapping, Value,
    Window, integer_momenta, integer_momenta_with_gradients,
};
use shadowstep::shadow::run::{ShadowRun, States};
use shadowstep::shadow::{Bilinear, Estimator};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;

use crate::errors::{Failure, Fallible, usage};
use crate::given::{Given, step_size};
use crate::given_run::{fitted, integrator};
use crate::scheme::Table;
use crate::values::Rows;
use crate::waiting::{waiting, waiting_for};

/// H̄ and its error of each state, NaN where there is no estimate.
type Estimates<'py> = [Bound<'py, PyArray1<f64>>; 2];

/// The name of the unit of energies; that of times and how many of it a time has.
type UnitsOf = (String, String, f64);

/// States of another program.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct GivenStates {
    q: Rows,
    p: Rows,
    h: String,
    /// Whether momenta are those of leapfrog: half a step before each state where gradients are given, else with a row
    /// more than there are states, for those before and after.
    half_steps: bool,
    /// The vectors of a box into which positions are wrapped.
    cell: Option<[[f64; 3]; 3]>,
}

impl GivenStates {
    /// The step size, q without jumps between images of the box, p at the states, and the number of these.
    fn read(self, gradients: Option<&[f64]>) -> Fallible<(StepSize, [Vec<f64>; 2], usize)> {
        let (h, dimension) = (step_size(&self.h)?, self.q.dimension);
        let (mut q, mut p) = (self.q.numbers, self.p.numbers);
        let states = q.len() / dimension.max(1);
        if let Some(cell) = self.cell {
            let mut unwrapping = Unwrapping::new(cell)?;
            for row in q.chunks_exact_mut(dimension.max(1)) {
                row.copy_from_slice(unwrapping.next(row)?);
            }
        }
        match gradients.filter(|_| self.half_steps) {
            Some(gradients) => integer_momenta_with_gradients(&h, &mut p, gradients)?,
            None if self.half_steps => p = integer_momenta(self.p.dimension, states, &p)?,
            None => {}
        }
        Ok((h, [q, p], states))
    }
}

/// The estimates E_k of a log of velocity Verlet: U with the gradients at each state, or with the rate qᵀU_q − 2U; and
/// why its states are not those of steps.
#[pyfunction]
pub(crate) fn energies_of_log<'py>(
    py: Python<'py>,
    states: GivenStates,
    energies: Rows,
    gradients: Option<Rows>,
    rates: Option<Rows>,
    masses: Vec<f64>,
    k: u32,
) -> Fallible<(Estimates<'py>, Option<String>)> {
    let (estimates, other_steps) = waiting(py, move |_| {
        let (dimension, gradients) = (states.q.dimension, gradients.as_ref().map(|rows| &rows.numbers[..]));
        let (h, [q, p], states) = states.read(gradients)?;
        let log = match (gradients, &rates) {
            (Some(gradients), _) => Log::with_gradients(dimension, [&q, &p, gradients], &energies.numbers)?,
            (None, rates) => {
                let rates = rates.as_ref().map_or(&[][..], |rates| &rates.numbers);
                Log::with_rates(dimension, [&q, &p], [&energies.numbers, rates])?
            }
        };
        let mut steps = Recorded::new(log, &h, &masses)?;
        let estimates = all(states, steps.clone().estimates(&h, &Bilinear::with_error(k))?)?;
        while steps.advance().map_err(RecordedError::from)?.is_some() {}
        Ok((estimates, steps.other_steps()))
    })?;
    Ok((estimates.map(|numbers| PyArray1::from_vec(py, numbers)), other_steps))
}

/// The estimates E_k of states of a scheme, with the steps made again in a problem of ours.
#[pyfunction]
pub(crate) fn energies_of_states<'py>(
    py: Python<'py>,
    states: GivenStates,
    problem: &Given,
    scheme: &Table,
    k: u32,
) -> Fallible<Estimates<'py>> {
    let (given, scheme) = (problem.clone(), scheme.0.clone());
    let estimates = waiting_for(py, None, Some(problem), move |_| {
        let (h, [q, p], states) = states.read(None)?;
        let system = &given.read(Arithmetic::DOUBLE)?.system;
        let (scheme, _) = fitted(&scheme, system, Arithmetic::DOUBLE)?;
        let integrator = integrator(system, &scheme, (&h, false));
        let mut integrator = integrator.map_err(|error| usage(error.to_string(), "check the problem"))?;
        let steps = Repeated::new(&mut *integrator, &q, &p)?;
        Ok(all(states, steps.estimates(&Bilinear::with_error(k))?)?)
    })?;
    Ok(estimates.map(|numbers| PyArray1::from_vec(py, numbers)))
}

fn all<T: States<Number = f64>, E: Estimator<f64>>(
    states: usize,
    mut run: ShadowRun<T, E>,
) -> Result<[Vec<f64>; 2], RecordedError> {
    let mut all = [(); 2].map(|()| vec![f64::NAN; states]);
    while let Some((n, estimate)) = run.advance()? {
        let row = usize::try_from(n).expect("states of a log are counted from 0");
        (all[0][row], all[1][row]) = (*estimate.value, estimate.error.copied().unwrap_or(f64::NAN));
    }
    Ok(all)
}

/// Follows a trajectory that another program computes.
#[pyclass(module = "shadowstep._shadowstep")]
pub(crate) struct Observer {
    observer: recorded::Observer,
    h: StepSize,
    unwrapping: Option<Unwrapping>,
}

#[pymethods]
impl Observer {
    /// Before its first state.
    #[staticmethod]
    fn of(
        masses: Vec<f64>,
        h: &str,
        window: usize,
        cell: Option<[[f64; 3]; 3]>,
        periodic: [bool; 3],
    ) -> Fallible<Self> {
        let h = step_size(h)?;
        let known = [Window::Nine, Window::Seventeen].into_iter().find(|known| known.states() == window);
        let unknown = || usage(format!("window = {window} is not known"), "a window has 9 or 17 states");
        let window = known.ok_or_else(unknown)?;
        let unwrapping = cell.map(Unwrapping::new).transpose()?.map(|unwrapping| unwrapping.along(periodic));
        Ok(Observer { observer: recorded::Observer::with_window(&h, &masses, window)?, h, unwrapping })
    }

    /// The next state is the state n, which does not follow the newest by a step.
    fn begin(&mut self, n: i64) -> Fallible<()> {
        self.unwrapping.iter_mut().for_each(Unwrapping::begin);
        Ok(self.observer.begin(n)?)
    }

    /// How many states a window needs.
    #[getter]
    fn window(&self) -> usize {
        self.observer.states()
    }

    /// Takes the next state; `half_step` if the momenta are leapfrog's, half a step before it; with what the step to it
    /// added, where that is of another splitting. Python's lock is kept: other threads find the observer complete.
    fn observe(
        &mut self,
        q: Rows,
        mut p: Rows,
        energy: f64,
        gradient: Rows,
        half_step: bool,
        step: Option<(Rows, Rows, f64)>,
    ) -> Fallible<Option<(i64, f64, f64, f64)>> {
        let Observer { observer, h, unwrapping } = self;
        let gradient = &gradient.numbers;
        if half_step {
            integer_momenta_with_gradients(h, &mut p.numbers, gradient)?;
        }
        let q = match unwrapping {
            Some(unwrapping) => unwrapping.next(&q.numbers)?,
            None => &q.numbers,
        };
        let derivatives = match &step {
            Some((q, p, beta)) => Derivatives::Step(gradient, MadeStep { q: &q.numbers, p: &p.numbers, beta: *beta }),
            None => Derivatives::Gradient(gradient),
        };
        let observed = observer.observe(&Logged { q, p: &p.numbers, energy, derivatives })?;
        Ok(observed.map(|value| (value.n, value.modified, value.error, value.energy)))
    }

    /// n, H̄, its error and H of all states that have an estimate.
    fn values<'py>(&self, py: Python<'py>) -> (Bound<'py, PyArray1<i64>>, [Bound<'py, PyArray1<f64>>; 3]) {
        let values = self.observer.values();
        let of = |number: fn(&Value) -> f64| PyArray1::from_vec(py, values.iter().map(number).collect());
        let n = PyArray1::from_vec(py, values.iter().map(|value| value.n).collect());
        (n, [of(|value| value.modified), of(|value| value.error), of(|value| value.energy)])
    }

    /// What moves the energy, with texts in these units.
    fn diagnosis<'py>(&self, py: Python<'py>, units: Option<UnitsOf>) -> PyResult<Bound<'py, PyDict>> {
        let units = units.map(|(energy, time, of_time)| Units { energy, time: Some((time, of_time)) });
        dictionary(py, &self.observer.diagnosis().in_units(units.unwrap_or_default()))
    }
}

fn dictionary<'py>(py: Python<'py>, diagnosis: &Diagnosis) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    all.set_item("cause", diagnosis.cause.name())?;
    all.set_item("size", diagnosis.cause.size())?;
    all.set_item("reason", diagnosis.reason())?;
    all.set_item("text", diagnosis.to_string())?;
    all.set_item("states", diagnosis.states)?;
    all.set_item("estimates", diagnosis.estimates)?;
    let smoothness = diagnosis.smoothness;
    let [of_q, of_p] = diagnosis.differences.map_or([None; 2], |differences| differences.map(Some));
    let numbers = [
        ("kinetic", Some(diagnosis.kinetic)),
        ("energy_error", Some(diagnosis.energy_error)),
        ("method_error", Some(diagnosis.method_error)),
        ("change", Some(diagnosis.change)),
        ("range", Some(diagnosis.range)),
        ("moved", Some(diagnosis.moved)),
        ("known_to", Some(diagnosis.known_to)),
        ("time", Some(diagnosis.time)),
        ("forces", smoothness.map(|smoothness| smoothness.size)),
        ("force_differences", smoothness.map(|smoothness| smoothness.differences)),
        ("exponent", smoothness.map(|smoothness| smoothness.exponent)),
        ("excess", diagnosis.excess),
        ("energy_differences", diagnosis.energy_smoothness.map(|smoothness| smoothness.differences)),
        ("energy_exponent", diagnosis.energy_smoothness.map(|smoothness| smoothness.exponent)),
        ("in_a_step", Some(diagnosis.in_a_step)),
        ("growth", Some(diagnosis.growth)),
        ("isolation", Some(diagnosis.isolation)),
        ("off_q", of_q.map(|of| of.of_increments)),
        ("off_p", of_p.map(|of| of.of_increments)),
    ];
    for (name, number) in numbers {
        all.set_item(name, number)?;
    }
    all.set_item("reordered", diagnosis.reordered)?;
    all.set_item("jumps", diagnosis.jumps.iter().map(|jump| (jump.n, jump.energy)).collect::<Vec<_>>())?;
    Ok(all)
}

impl From<RecordedError> for Failure {
    fn from(error: RecordedError) -> Self {
        let hint = match &error {
            RecordedError::Run(error) => return Error::run(error.to_string(), "check the log there").into(),
            RecordedError::NotFinite { .. } => {
                "give the states before it; a run that overflows has steps that are too large"
            }
            RecordedError::Mass { .. } => "give the mass of each coordinate or particle",
            _ => "give arrays with a row for each state",
        };
        usage(error.to_string(), hint)
    }
}
