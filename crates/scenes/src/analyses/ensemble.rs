//! Ensembles: a scene with a section \[ensemble\], whose columns have a number for each trajectory.
//!
//! All numbers of the scene can contain the names of the columns, as they contain parameters. The trajectories are
//! computed on all cores, those of T(p) and U(q), and those of planets with the same masses, in lanes
//! ([`shadowstep::shadow::ensemble`]): each has the bits that it has alone, but for exp, log, sin and cos.
//!
//! ```
//! use shadowstep::tables::Source;
//! use shadowstep_scenes::ensemble::Ensemble;
//!
//! let text = r#"
//! [problem]
//! name = "kepler"
//! parameters.eccentricity = "e"
//! [run]
//! scheme = "yoshida4"
//! step = "1/20"
//! steps = 100
//! digits = "double"
//! [output]
//! energy = { every = 10 }
//! [ensemble]
//! columns = { e = [0, "1/3", 0.5] }
//! "#;
//! let ensemble = Ensemble::read(Source { path: "scene.toml".to_owned(), text: text.to_owned() })?;
//! let mut rows = Vec::new();
//! ensemble.run_into(&mut rows, || true)?;
//! let rows = String::from_utf8(rows).unwrap();
//! let mut rows = rows.lines().filter(|line| !line.starts_with('#'));
//! assert_eq!(rows.next(), Some("trajectory,e,x,y,px,py,energy_error,energy_start,energy_end,not_finite"));
//! assert!(rows.nth(1).unwrap().starts_with("1,1/3,"));
//! # Ok::<(), shadowstep_scenes::Error>(())
//! ```

mod alone;
mod columns;
mod planets;
mod rows;
mod settings;

use std::io::Write;

use rayon::prelude::*;
use shadowstep::number::Lanes;
use shadowstep::shadow::ensemble::{self, Block, EnsembleError, Outcome};
use shadowstep::tables::{Faults, Source};
use shadowstep::{Rational, Scheme, Stepper};
use shadowstep_schemes::document::document;
use shadowstep_schemes::symbolic::Exact;

use crate::document::keys::ENSEMBLE;
use crate::files::whole_file::WholeFile;
use crate::motion::lanes::{LANES, SystemInLanes};
use crate::read::family::{Family, Parsed};
use crate::results::{FileOptions, Identity, Origin, no_file};
use crate::run::start::Begin;
use crate::scene::{KineticEnergy, Scene, System};
use crate::texts::error::Error;
use alone::Alone;
use columns::Columns;
use planets::Apart;
use settings::{Observed, settings};

/// A system that is set up for one trajectory after the other is there for as many, at least.
const MANY: usize = 16;

/// What is read of each trajectory but the first; what is the same in all is that of the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Differing {
    /// All: \[run\] and \[output\] may differ, or the class of T(p).
    Scenes,
    /// The problem and its initial state.
    Systems,
    /// The initial state.
    States,
}

impl Differing {
    /// The least that is enough: the other sections contain no names whose values may differ.
    fn of(parsed: &Parsed<'_>, columns: &Columns, first: &System) -> Differing {
        let columns: Vec<&String> = columns.names.iter().collect();
        let is_of_run = |section: &str| ["run", "output"].contains(&section);
        let is_of_problem = |section: &str| !is_of_run(section) && !["initial", ENSEMBLE.name()].contains(&section);
        let problem_differs = parsed.has_names(is_of_problem, &columns);
        let parameters = first.parameters.iter().map(|(name, _)| name).filter(|_| problem_differs);
        let names: Vec<&String> = columns.iter().copied().chain(parameters).collect();
        if !matches!(first.kinetic, KineticEnergy::Masses(_)) || parsed.has_names(is_of_run, &names) {
            Differing::Scenes
        } else if problem_differs {
            Differing::Systems
        } else {
            Differing::States
        }
    }
}

/// A scene with columns of initial values and parameters.
#[derive(Debug)]
pub struct Ensemble {
    family: Family,
    columns: Columns,
    /// The scene of the first trajectory, with what is the same in all.
    first: Scene,
    observed: Observed,
    differing: Differing,
}

impl Ensemble {
    /// Whether the text has a section \[ensemble\].
    pub fn is_in(source: &Source) -> bool {
        document(source).0.is_some_and(|document| document.contains_key(ENSEMBLE.name()))
    }

    /// Reads the scene and its columns.
    ///
    /// # Errors
    /// All faults of the text with the values of the first trajectory; a file of columns that cannot be read; a scene
    /// of which there can be no ensemble.
    pub fn read(source: Source) -> Result<Ensemble, Error> {
        let columns = Columns::read(&source)?;
        Ensemble::of(source, columns)
    }

    /// The same with columns that are not in the text: their names, and a row of values for each trajectory.
    ///
    /// # Errors
    /// As [`read`](Ensemble::read); no trajectory, or rows of other lengths than the names.
    pub fn with_columns(source: Source, names: Vec<String>, rows: Vec<Vec<Rational>>) -> Result<Ensemble, Error> {
        if rows.is_empty() || rows.iter().any(|row| row.len() != names.len()) {
            return Err(Error::usage(
                "an ensemble needs a value of each column for each trajectory",
                "give at least one",
            ));
        }
        Ensemble::of(source, Columns { names, rows, at: 0..0 })
    }

    fn of(source: Source, columns: Columns) -> Result<Ensemble, Error> {
        let family = Family::new(source, &["ensemble"]);
        let first = family.scene(&columns.values(0)).map_err(|faults| columns.with_trajectory(faults, 0))?;
        columns.refuse_repeated(family.source(), first.system.columns())?;
        let observed = settings(family.source(), &first)?;
        let differing = Differing::of(&family.parsed()?, &columns, &first.system);
        Ok(Ensemble { family, columns, first, observed, differing })
    }

    /// The scene of the first trajectory.
    pub fn first(&self) -> &Scene {
        &self.first
    }

    /// Computes all trajectories, and writes metadata and a row for each; `continues` is as for
    /// [`outcomes`](Ensemble::outcomes).
    ///
    /// # Errors
    /// Values of a trajectory that the scene cannot have, a writer that fails; an end.
    pub fn run_into(&self, writer: &mut dyn Write, continues: impl Fn() -> bool + Sync) -> Result<(), Error> {
        let outcomes = self.outcomes(continues)?;
        rows::write(&self.columns, &self.first, self.observed.modified_energy.is_some(), &outcomes, writer)
    }

    /// The same into the file that the scene names. Returns whether that was complete before: then nothing is done,
    /// unless the options restart it.
    ///
    /// # Errors
    /// As [`run_into`](Ensemble::run_into); a scene without a file; a file that is not from this ensemble.
    pub fn run_to_file(&self, options: FileOptions, continues: impl Fn() -> bool + Sync) -> Result<bool, Error> {
        let Some((path, _)) = &self.first.output.file else { return Err(no_file()) };
        let (identity, columns) = (Identity::of(&self.first), self.columns.sha256());
        let origin = Origin::of(
            path,
            self.first.output.format,
            identity.scene(),
            identity.inputs().chain([(columns.as_str(), "with different columns".to_owned())]),
        );
        origin.check(path, options)?;
        if origin == Origin::Same && !options.restart {
            return Ok(true);
        }
        let replaces = origin != Origin::None;
        let mut file = if replaces { WholeFile::create(path, "file") } else { WholeFile::create_new(path, "file") }?;
        self.run_into(&mut file, continues)?;
        file.finish()?;
        Ok(false)
    }

    /// Computes all trajectories; `continues` is asked now and then, and ends the computation where it returns false.
    ///
    /// # Errors
    /// Values of a trajectory that the scene cannot have; an end.
    pub fn outcomes(&self, continues: impl Fn() -> bool + Sync) -> Result<Vec<Outcome>, Error> {
        self.outcomes_while(&continues)
    }

    // not generic: the steps are compiled with this crate, for speed, not with a program that may be compiled for size
    fn outcomes_while(&self, continues: &(dyn Fn() -> bool + Sync)) -> Result<Vec<Outcome>, Error> {
        let parsed = self.family.parsed()?;
        if let Some(outcomes) = self.of_planets(&parsed, continues)? {
            return Ok(outcomes);
        }
        if !self.has_lanes() {
            return self.one_by_one(&parsed, continues, &|| self.first_alone());
        }
        let compensated = self.first.arithmetic.is_compensated();
        let steps = self.first.steps_from(Begin::InitialState);
        let outcomes = if self.first.system.has_general_kinetic() {
            let stepper = self.stepper(steps.for_every_kinetic());
            let system = |block| Ok(self.together(&parsed, &block)?.general(compensated));
            self.trajectories().run_while(&stepper, system, continues)
        } else {
            let stepper = self.stepper(steps.quadratic());
            let system = |block| Ok(self.together(&parsed, &block)?.quadratic(compensated));
            self.trajectories().run_while(&stepper, system, continues)
        };
        outcomes.map_err(|error| error_of(error, |error| error))
    }

    fn first_alone(&self) -> Result<Alone, Error> {
        Alone::new(&self.first.system, self.first.steps_from(Begin::InitialState))
    }

    /// Each trajectory alone; where they differ in their states only, they have a system that `of_first` sets up once
    /// for many.
    fn one_by_one(
        &self,
        parsed: &Parsed<'_>,
        continues: &(dyn Fn() -> bool + Sync),
        of_first: &(dyn Fn() -> Result<Alone, Error> + Sync),
    ) -> Result<Vec<Outcome>, Error> {
        let steps = self.first.most_steps();
        let one = |known: &mut Option<Alone>, t: usize| {
            let Some((q, p)) = self.state(parsed, t) else {
                let system = self.system(parsed, t)?;
                let mut alone = Alone::new(&system, self.first.steps_from(Begin::InitialState))?;
                return alone.outcome((&system, steps), (&system.q, &system.p), self.observed, continues);
            };
            let alone = match known {
                Some(alone) => alone,
                None => known.insert(of_first()?),
            };
            alone.outcome((&self.first.system, steps), (&q, &p), self.observed, continues)
        };
        let all = (0..self.columns.trajectories()).into_par_iter().with_min_len(MANY);
        let outcomes: Vec<_> = all.map_init(|| None, one).collect();
        outcomes.into_iter().collect()
    }

    /// All trajectories, if they are of planets with the same masses.
    fn of_planets(
        &self,
        parsed: &Parsed<'_>,
        continues: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<Outcome>>, Error> {
        let planets = planets::in_lanes_of(&self.first.system).filter(|_| !self.first.displaced);
        let Some(planets) = planets else { return Ok(None) };
        let steps = self.first.steps_from(Begin::InitialState);
        let system = |t| self.system(parsed, t);
        match planets::outcomes(&self.trajectories(), planets, steps, system, continues) {
            Ok(outcomes) => Ok(Some(outcomes)),
            Err(EnsembleError::System(Apart::Masses)) => Ok(None),
            Err(error) => Err(error_of(error, |apart| match apart {
                Apart::Scene(error) => error,
                Apart::Masses => unreachable!("it is no error"),
            })),
        }
    }

    /// Whether there are steps in lanes.
    fn has_lanes(&self) -> bool {
        self.first.system.has_lanes() && !self.first.displaced
    }

    fn trajectories(&self) -> ensemble::Ensemble {
        let Observed { every, modified_energy } = self.observed;
        let (trajectories, steps) = (self.columns.trajectories(), self.first.most_steps());
        ensemble::Ensemble { trajectories, steps, every, modified_energy, merged: false, threads: None }
    }

    fn stepper<S: Scheme>(&self, scheme: S) -> Stepper<S, Lanes<LANES>> {
        Stepper::new(scheme, self.first.h.clone()).expect("the step size was read as nonzero")
    }

    /// The system of some lanes.
    fn together(&self, parsed: &Parsed<'_>, block: &Block<LANES>) -> Result<SystemInLanes, Error> {
        let states = block.trajectories().map(|t| self.state(parsed, t)).collect::<Option<Vec<_>>>();
        if let Some(states) = states {
            let system = SystemInLanes::of(&[&self.first.system; LANES]).expect("a system has the form of itself");
            return Ok(system.at_states(&states));
        }
        let systems = block.trajectories().map(|t| self.system(parsed, t)).collect::<Result<Vec<System>, Error>>()?;
        let systems = std::array::from_fn(|lane| &systems[lane]);
        SystemInLanes::of(&systems).ok_or_else(|| {
            let fault = self.columns.fault(self.family.source(), "trajectories differ in more than numbers");
            Faults(vec![fault.hint("use the names of columns in numbers and formulas only")]).into()
        })
    }

    /// The initial state of a trajectory, if they differ in nothing else; `None` also if it has a fault, which reading
    /// its scene gives.
    fn state(&self, parsed: &Parsed<'_>, t: usize) -> Option<(Vec<Exact>, Vec<Exact>)> {
        let state = || parsed.state(&self.columns.values(t), &self.first.system, self.first.arithmetic);
        (self.differing == Differing::States).then(state)?
    }

    /// The system of a trajectory, for steps in lanes.
    fn system(&self, parsed: &Parsed<'_>, t: usize) -> Result<System, Error> {
        if self.differing != Differing::Scenes
            && let Ok(system) = parsed.system(&self.columns.values(t), self.first.arithmetic)
        {
            return Ok(system);
        }
        // its faults are those of the scene
        Ok(self.scene(parsed, t)?.system)
    }

    /// The scene of a trajectory.
    fn scene(&self, parsed: &Parsed<'_>, t: usize) -> Result<Scene, Error> {
        let scene = parsed.scene(&self.columns.values(t)).map_err(|faults| self.columns.with_trajectory(faults, t))?;
        self.refuse_other_steps(&scene, t)?;
        Ok(scene)
    }

    fn refuse_other_steps(&self, scene: &Scene, t: usize) -> Result<(), Error> {
        let steps = |scene: &Scene| (scene.h.clone(), scene.steps(), scene.scheme.name.clone());
        if steps(scene) == steps(&self.first) {
            return Ok(());
        }
        let message = format!("trajectory {t} has another step size, number of steps or scheme than trajectory 0");
        let hint = "use the names of columns in [problem] and [initial] only; a sweep can have different steps";
        Err(Faults(vec![self.columns.fault(self.family.source(), message).hint(hint)]).into())
    }
}

/// What is said of an ensemble that cannot be computed.
fn error_of<E>(error: EnsembleError<E>, of_system: impl FnOnce(E) -> Error) -> Error {
    match error {
        EnsembleError::System(error) => of_system(error),
        EnsembleError::Stopped => Error::run("the ensemble was interrupted", "run it again"),
        EnsembleError::Estimator(error) => {
            Error::usage(format!("the modified energy: {error}"), "give another order of the estimator")
        }
        EnsembleError::EveryZero => unreachable!("`every` was read as positive"),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use shadowstep::Integrator as _;

    use super::*;

    fn ensemble(problem: &str, run: &str, values: &str) -> Result<Ensemble, Error> {
        let text = format!(
            "{problem}\nrun = {{ scheme = \"yoshida4\", steps = 20, digits = \"double\", {run} }}\noutput.energy = true\n\
             ensemble.columns = {{ e = {values} }}\n"
        );
        Ensemble::read(Source { path: "scene.toml".to_owned(), text })
    }

    #[test]
    fn where_h_is_0_at_first_there_is_no_relative_error() {
        let free = "problem = { potential = \"x^3\", coordinates = [\"x\"] }\ninitial = { q = [0], p = [\"e\"] }";
        let found = ensemble(free, "step = \"1/20\"", "[0, 1]").unwrap().outcomes(|| true).unwrap();
        assert!(found[0].energy_error.is_none() && found[1].energy_error.is_some(), "{found:?}");
    }

    /// Those of which the state alone or the system alone is read, and those of which the whole scene is read.
    #[test]
    fn systems_are_those_of_whole_scenes() {
        let kepler = "problem.name = \"kepler\"";
        let plane = "coordinates = [\"x\", \"y\"]";
        let bodies = "bodies = { count = 3, m = \"1 + i/10\" }, masses = [1, 2, 3]";
        let problems = [
            (Differing::Systems, format!("{kepler}\nproblem.parameters.eccentricity = \"sqrt(e)\"")),
            (
                Differing::Systems,
                format!(
                    "problem = {{ potential = \"-e/sqrt(x^2 + y^2)\", {plane} }}\ninitial = {{ q = [1, \"e\"], p = \
                        [0, \"1 - e^2\"] }}"
                ),
            ),
            (
                Differing::States,
                format!("problem = {{ potential = \"x*y + t\", {plane} }}\ninitial = {{ q = [1, \"e\"], p = [0, 1] }}"),
            ),
            (Differing::States, format!("{kepler}\ninitial.q = [\"eccentricity - e\", 1]")),
            (
                Differing::States,
                format!(
                    "problem = {{ potential = \"k*(x^2 + y^4)\", {plane}, masses = [2, \"k\"], parameters = {{ k = 3 }} }}\n\
                     initial = {{ q = [\"k*e\", \"sqrt(e)\"], v = [\"e\", \"1/7\"] }}"
                ),
            ),
            (
                Differing::States,
                format!(
                    "problem = {{ pair = \"-m_i*m_j/sqrt(r2 + 1)\", dimensions = 2, {bodies} }}\n\
                     initial = {{ q = [[0, \"e\"], [1, 0], [\"e\", 2]], v = [0, 0, 0, 1, \"e\", 0] }}"
                ),
            ),
            (
                Differing::States,
                format!(
                    "problem = {{ pair = \"-m_i*m_j/sqrt(r2 + 1)\", dimensions = 1, {bodies} }}\ninitial = {{ q \
                        = \"i*m + e\", p = \"e*i\" }}"
                ),
            ),
        ];
        for (differing, problem) in problems {
            // the weight of a name that is 0 in the step size
            let [part, all] = ["1/20", "1/20 + 0*e"]
                .map(|step| ensemble(&problem, &format!("step = \"{step}\""), "[0.1, \"1/3\", 0.7]").unwrap());
            assert_eq!((part.differing, all.differing), (differing, Differing::Scenes), "{problem}");
            let [part, all] = [part, all].map(|ensemble| ensemble.outcomes(|| true).unwrap());
            assert!(part == all && all[0] != all[1], "{problem}");
        }
    }

    /// A star and planets, which all trajectories have at other places; of the mass 1/1000 times `mass`.
    fn of_planets(parts: &str, digits: &str, planets: usize, mass: &str) -> Ensemble {
        let body = |i| {
            format!(
                "[[body]]\nname = \"p{i}\"\nmass = \"{mass}/{i}\"\na = \"{i} + s/10\"\ne = \"1/5 + s/9\"\ni = \"20 + \
                    10*s\"\nM = \"{i}0 + 100*s\"\n"
            )
        };
        let bodies: String = (1..=planets).map(body).collect();
        let values = (-10..=10).map(|i| format!("\"{i}/20\"")).collect::<Vec<_>>().join(", ");
        let text = format!(
            "[problem]\nparts = \"{parts}\"\nparameters = {{ g = 1 }}\n[[body]]\nname = \"star\"\nmass = 1\n{bodies}\
             [run]\nscheme = \"saba2\"\nstep = \"1/4\"\nsteps = 60\ndigits = \"{digits}\"\n\
             [output]\nmodified_energy = {{ estimator = \"bilinear\", order = 8, every = 20 }}\n\
             [ensemble]\ncolumns = {{ s = [{values}] }}\n"
        );
        Ensemble::read(Source { path: "scene.toml".to_owned(), text }).unwrap_or_else(|error| panic!("{error}"))
    }

    fn together(ensemble: &Ensemble) -> Option<Vec<Outcome>> {
        ensemble.of_planets(&ensemble.family.parsed().unwrap(), &|| true).unwrap()
    }

    #[test]
    fn planets_in_lanes_have_the_bits_of_planets_alone() {
        for parts in ["wisdom-holman", "wisdom-holman-heliocentric"] {
            for (planets, digits) in [(1, "double"), (2, "compensated"), (9, "double")] {
                let ensemble = of_planets(parts, digits, planets, "1/1000");
                let found = together(&ensemble).expect("the masses are the same");
                let parsed = ensemble.family.parsed().unwrap();
                assert_eq!(found.len(), 21);
                for (t, found) in found.iter().enumerate() {
                    let scene = ensemble.scene(&parsed, t).unwrap();
                    let system = &scene.system;
                    let mut alone = Alone::new(system, scene.steps_from(Begin::InitialState)).unwrap();
                    let steps = (system, scene.most_steps());
                    let alone = alone.outcome(steps, (&system.q, &system.p), ensemble.observed, &|| true).unwrap();
                    assert!(alone.not_finite.is_none() && alone.modified_drift.is_some());
                    assert_eq!(*found, alone, "{parts}, {planets} planets, trajectory {t}");
                }
            }
        }
    }

    #[test]
    fn other_masses_are_computed_alone() {
        let ensemble = of_planets("wisdom-holman", "double", 2, "(1 + s)/1000");
        assert!(together(&ensemble).is_none());
        assert_eq!(ensemble.outcomes(|| true).unwrap().len(), 21);
    }

    /// Systems that are not computed in lanes: with a constant magnetic field, with one of position and time, of parts,
    /// with a cutoff, with oscillations.
    const OF_PARTS: [&str; 5] = [
        "potential = \"(x^2 + y^2)^2/8\"\nvector_potential = [\"-3*y/4\", \"3*x/4\"]\ncoordinates = \
            [\"x\", \"y\"]\nmasses = [1, 2]",
        "potential = \"(x^2 + y^2)^2/8\"\nvector_potential = [\"-y*cos(t)/2\", \"x/2 + x^3/12\"]\ncoordinates = \
            [\"x\", \"y\"]",
        "parts = [\"(px^2 + py^2)/2\", \"y*px - x*py\", \"-1/sqrt(x^2 + y^2 + 1)\"]\ncoordinates = [\"x\", \"y\"]",
        "pair = \"-1/sqrt(r2 + 1/10)\"\nbodies = 2\ndimensions = 1\ncutoff = 3",
        "name = \"henon-heiles\"\nparts = \"linear\"",
    ];

    /// Trajectories that differ in their states only have one system, for as many as a thread has, and the bits that
    /// they have with a system each.
    #[test]
    fn one_system_serves_many_states() {
        let many = (0..100).map(|i| format!("{i}/100")).collect::<Vec<_>>().join("\", \"");
        let of_one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        for problem in OF_PARTS {
            let problem = format!(
                "problem = {{ {} }}\ninitial = {{ q = [\"e\", \"1/3\"], p = [\"1/5\", \"e/2\"] }}",
                problem.replace('\n', ", ")
            );
            let ensemble = ensemble(&problem, "step = \"1/20\"", &format!("[\"{many}\"]")).unwrap();
            let parsed = ensemble.family.parsed().unwrap();
            let set_up = AtomicUsize::new(0);
            let of_first = || {
                set_up.fetch_add(1, Ordering::Relaxed);
                ensemble.first_alone()
            };
            let found = of_one_thread.install(|| ensemble.one_by_one(&parsed, &|| true, &of_first)).unwrap();
            assert!((1..=2).contains(&set_up.load(Ordering::Relaxed)), "{problem}: {set_up:?}");
            assert_eq!(found.len(), 100);
            for (t, found) in found.iter().enumerate() {
                let scene = ensemble.scene(&parsed, t).unwrap();
                let mut alone = scene.integrator::<f64>(&()).unwrap();
                alone.steps(20);
                assert_eq!((&found.q[..], &found.p[..]), (alone.state().q(), alone.state().p()), "{problem}, {t}");
            }
        }
    }
}
