//! The drift of the modified energy of runs.

use pyo3::prelude::*;
use shadowstep_scenes::Error;
use shadowstep_scenes::drift::{Controls, DriftRequest, Follower, Record, Wanted};
use shadowstep_scenes::estimator::order_setting;
use shadowstep_scenes::library::EXACT_FLOW;
use shadowstep_scenes::propagator::Propagator;
use shadowstep_scenes::run::{OrderSetting, Run};

use crate::errors::exception;
use crate::estimator::Options;
use crate::given::{Given, arithmetic, number};
use crate::given_run::{SystemWithScheme, times};
use crate::scheme::Table;
use crate::waiting::{Watched, waiting_for};

/// The drift of one run, with its control on the exact flow where that is wanted, as JSON. Without a scheme it is the
/// drift on the exact flow.
#[pyfunction]
#[pyo3(signature = (problem, name, scheme, h, until, *, digits, mpfr, options, control, progress))]
#[allow(clippy::too_many_arguments)] // the package's own function has the defaults
pub(crate) fn drift(
    py: Python<'_>,
    problem: &Given,
    name: &str,
    scheme: Option<&Table>,
    h: &str,
    until: &str,
    digits: &str,
    mpfr: bool,
    options: Options,
    control: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let arithmetic = arithmetic(py, digits, mpfr)?;
    let times = times(py, problem, arithmetic, (h, None, Some(until)))?;
    let until = number(py, "until", until)?;
    let estimator = options.settings(py)?;
    let (given, scheme, name) = (problem.clone(), scheme.map(|table| table.0.clone()), name.to_owned());
    let found = waiting_for(py, progress, Some(problem), move |watched| -> Result<Record, Error> {
        let (system, propagator) = match scheme {
            Some(scheme) => {
                let posed = SystemWithScheme::of(&given, &scheme, arithmetic)?;
                (posed.system, Propagator::Scheme(Box::new(posed.scheme)))
            }
            None => {
                let system = given.system(arithmetic)?;
                let propagator = Propagator::of_system(EXACT_FLOW, &system)?;
                (system, propagator)
            }
        };
        let order = order_setting(&estimator).map(|(name, value)| OrderSetting { name, value });
        let run = Run { propagator: propagator.name(), h: &times.h, steps: times.steps, order, windows: Run::WINDOWS };
        let request = DriftRequest {
            problem: &name,
            system: &system,
            until: &until,
            arithmetic,
            estimator: &estimator,
            summarised: true,
        };
        let mut controls = Controls::new(if control { Wanted::Always } else { Wanted::Never });
        request.run(&propagator, run, &mut controls, &mut DriftProgress(watched))
    });
    let record = found?.map_err(|error| exception(py, error))?;
    serde_json::to_string(&record).map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))
}

struct DriftProgress<'a>(&'a Watched);

impl Follower for DriftProgress<'_> {
    fn reaches(&mut self, run: Run<'_>, n: i64) -> Result<(), Error> {
        match self.0.reaches(n) {
            true => Ok(()),
            false => Err(Error::run(format!("{}: interrupted at n = {n}", run.name()), "run it again")),
        }
    }
}
