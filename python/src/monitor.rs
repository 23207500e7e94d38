//! The monitor of the modified energy, for loops that do something else between steps.

use std::cell::RefCell;
use std::process;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Mutex, PoisonError};

use numpy::PyArray1;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;

use shadowstep::shadow::Report;
use shadowstep::shadow::run::RunError;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::{Number as _, StepSize};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{RunMonitor, RunNumber as _};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::SceneIntegrator;
use shadowstep_scenes::watch::light;
use shadowstep_scenes::watch::{Bodies, Interactions, LightBody};

use crate::errors::{Fallible, usage};
use crate::given::{Given, arithmetic, step_size};
use crate::given_run::{fitted, integrator};
use crate::scheme::Table;
use crate::values::Json;
use crate::waiting::{Task, Watched, asked, new_number, soon, spawned, within};

/// n, the modified energy, its error and H, all of the middle of a window.
type Newest = (u64, f64, Option<f64>, f64);

/// A system in double precision with its steps and its monitor, in a thread of its own: what they are made of cannot go
/// from one thread to another.
struct Followed {
    integrator: SceneIntegrator<f64>,
    monitor: Box<RunMonitor<f64>>,
    newest: Option<Newest>,
    bodies: Option<Bodies>,
    /// The names of the coordinates.
    names: Vec<String>,
}

thread_local! {
    /// That of the thread of a monitor.
    static FOLLOWED: RefCell<Option<Followed>> = const { RefCell::new(None) };
}

/// The monitor of a system, for all threads of Python.
#[pyclass(frozen, module = "shadowstep._shadowstep")]
pub(crate) struct Monitor {
    tasks: Mutex<Sender<Task>>,
    /// A forked process has no such thread.
    process: u32,
    /// By which it is known that its own forces ask it.
    number: u64,
    problem: Given,
}

#[pymethods]
impl Monitor {
    /// At the problem's initial state.
    #[staticmethod]
    fn of(
        py: Python<'_>,
        problem: &Given,
        scheme: &Table,
        h: &str,
        order: u32,
        every: u64,
        digits: &str,
    ) -> Fallible<Self> {
        let (arithmetic, h) = (arithmetic(digits, false)?, step_size(h)?);
        if arithmetic.is_longer_than_double() {
            let hint = "give digits = \"double\" or \"compensated\"";
            return Err(usage("a monitor for loops computes in double precision", hint));
        }
        let (tasks, next) = channel::<Task>();
        spawned(Box::new(move || {
            while let Some(task) = soon(&next).or_else(|| next.recv().ok()) {
                task();
            }
        }))?;
        let (process, number, tasks) = (process::id(), new_number(), Mutex::new(tasks));
        let monitor = Monitor { tasks, process, number, problem: problem.clone() };
        let (given, scheme) = (problem.clone(), scheme.0.clone());
        monitor.ask_thread(py, move |_| {
            FOLLOWED.set(Some(Followed::new(&given, &scheme, &h, (order, every), arithmetic)?));
            Ok(())
        })?;
        Ok(monitor)
    }

    /// A number of steps.
    fn step(&self, py: Python<'_>, count: u64) -> Fallible<()> {
        self.ask(py, move |followed, watched| Ok(followed.steps(count, watched).map_err(|error| of_run(&error))?))
    }

    /// The number of the present state.
    #[getter]
    fn n(&self, py: Python<'_>) -> Fallible<u64> {
        self.ask(py, |followed, _| Ok(followed.monitor.n()))
    }

    /// q and p of the present state.
    fn state<'py>(&self, py: Python<'py>) -> Fallible<[Bound<'py, PyArray1<f64>>; 2]> {
        let state = |integrator: &mut VectorIntegrator<'_, f64>| {
            [integrator.state().q().to_vec(), integrator.state().p().to_vec()]
        };
        let state = self.ask(py, move |followed, _| Ok(at_output(&mut *followed.integrator, state)))?;
        Ok(state.map(|numbers| PyArray1::from_vec(py, numbers)))
    }

    /// H of the present state.
    fn energy(&self, py: Python<'_>) -> Fallible<f64> {
        let energy = |integrator: &mut VectorIntegrator<'_, f64>| integrator.system().energy();
        self.ask(py, move |followed, _| Ok(at_output(&mut *followed.integrator, energy)))
    }

    /// The newest estimate; `None` before the first.
    #[getter]
    fn newest(&self, py: Python<'_>) -> Fallible<Option<Newest>> {
        self.ask(py, |followed, _| Ok(followed.newest))
    }

    /// The report on the run so far.
    fn report<'py>(&self, py: Python<'py>) -> Fallible<Bound<'py, PyDict>> {
        let (report, planets, light) = self.ask(py, |followed, _| {
            let mut report = f64::report(&followed.monitor);
            report.coordinate_names.clone_from(&followed.names);
            let (planets, light) = followed.bodies.as_mut().map(Bodies::found).unwrap_or_default();
            Ok((report, planets, light))
        })?;
        dictionary(py, &report, planets.as_ref(), &light)
    }
}

impl Monitor {
    /// What the thread answers of its system.
    fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        task: impl FnOnce(&mut Followed, &Watched) -> Fallible<T> + Send + 'static,
    ) -> Fallible<T> {
        self.ask_thread(py, |watched| {
            FOLLOWED.with_borrow_mut(|followed| task(followed.as_mut().expect("it was made first"), watched))
        })
    }

    fn ask_thread<T: Send + 'static>(
        &self,
        py: Python<'_>,
        task: impl FnOnce(&Watched) -> Fallible<T> + Send + 'static,
    ) -> Fallible<T> {
        if process::id() != self.process {
            let message = "a monitor belongs to the process that made it: make one in the forked process";
            return Err(PyRuntimeError::new_err(message).into());
        }
        let within = within(self.number).ok_or_else(|| {
            PyRuntimeError::new_err("the forces of a monitor cannot ask the monitor itself, which waits for them")
        })?;
        let send = |task| {
            // without its thread there is no answer, which is reported then
            let _ = self.tasks.lock().unwrap_or_else(PoisonError::into_inner).send(task);
            Ok(())
        };
        let result = asked(py, (None, None), within, send, task);
        self.problem.raised(py)?;
        result
    }
}

impl Followed {
    fn new(
        given: &Given,
        scheme: &NamedScheme,
        h: &StepSize,
        (order, every): (u32, u64),
        arithmetic: Arithmetic,
    ) -> Result<Self, Error> {
        let read = given.read(arithmetic)?;
        let system = &read.system;
        let (scheme, _) = fitted(scheme, system, arithmetic)?;
        let mut integrator = integrator(system, &scheme, (h, arithmetic.is_compensated()))?;
        let monitor = f64::monitor(&mut *integrator, order, every).map_err(|error| of_run(&error))?;
        let bodies = Bodies::of(system, 1, Some(f64::from_rational(h.exact(), &())));
        let names = system.coordinates.clone();
        let mut followed = Followed { integrator, monitor, newest: None, bodies, names };
        followed.include();
        Ok(followed)
    }

    /// Steps until there are as many, or Python asks to end.
    fn steps(&mut self, count: u64, watched: &Watched) -> Result<(), RunError> {
        for _ in (0..count).take_while(|_| watched.continues()) {
            self.integrator.step(self.monitor.carried());
            if let Some(sample) = f64::observe(&mut self.monitor, &mut *self.integrator)? {
                self.newest = Some((sample.n, *sample.modified, sample.error.copied(), *sample.energy));
            }
            self.include();
        }
        Ok(())
    }

    /// Takes the bodies of the present state.
    fn include(&mut self) {
        let Followed { integrator, monitor, bodies, .. } = self;
        let n = i64::try_from(monitor.n()).unwrap_or(i64::MAX);
        bodies.iter_mut().for_each(|bodies| bodies.include(n, integrator.state().q()));
    }
}

fn of_run(error: &RunError) -> Error {
    Error::run(error.to_string(), "try a smaller step size or another initial state")
}

fn dictionary<'py>(
    py: Python<'py>,
    report: &Report<f64>,
    planets: Option<&Interactions>,
    light: &[LightBody],
) -> Fallible<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let at = |n: i64| format!("n = {n}");
    // the energy has no part of light bodies
    let lost = light::not_resolved(light, at).filter(|_| report.verdict.is_bounded());
    all.set_item("verdict", if lost.is_some() { "light-bodies" } else { report.verdict.name() })?;
    all.set_item("is_bounded", report.verdict.is_bounded() && lost.is_none())?;
    let lines =
        [planets.map(|found| ("planets", found.text(at))), light::text(light, at).map(|text| ("light bodies", text))];
    let lines: String = lines.into_iter().flatten().map(|(name, text)| format!("\n  {name}: {text}")).collect();
    all.set_item("text", format!("{report}{lines}"))?;
    all.set_item("reason", lost.unwrap_or_else(|| report.reason()))?;
    all.set_item("planets", planets.map(|found| Json::of(&json!(found))).transpose()?)?;
    all.set_item("light", Json::of(&json!(light))?)?;
    all.set_item("steps", report.steps)?;
    all.set_item("windows", report.windows)?;
    let [method_rms, method_least, method_largest] =
        report.method().map_or([None; 3], |all| all.map(|number| Some(*number)));
    let numbers = [
        ("time", Some(report.time)),
        ("energy_error", Some(report.energy_error)),
        ("kinetic", Some(report.kinetic)),
        ("method_least", method_least),
        ("method_largest", method_largest),
        ("method_rms", method_rms),
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
