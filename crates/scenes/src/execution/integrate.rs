//! A run into memory: states at equal intervals of steps, with their energies and modified energies.
//!
//! ```
//! use shadowstep::StepSize;
//! use shadowstep::tables::Source;
//! use shadowstep_scenes::arithmetic::Arithmetic;
//! use shadowstep_scenes::integrate::KeptStates;
//! use shadowstep_scenes::posed::Posed;
//! use shadowstep_scenes::propagator::for_system;
//! use shadowstep_scenes::run::Run;
//! use shadowstep_scenes::{System, library};
//!
//! let text = "[problem]\nname = \"kepler\"".to_owned();
//! let (system, _) = System::read(&Source { path: "kepler".to_owned(), text }, Arithmetic::DOUBLE)?;
//! let scheme = for_system(library::scheme("yoshida4")?, &system)?;
//! let h = StepSize::try_from("1/20").unwrap();
//! let run = Run { propagator: &scheme.name, h: &h, steps: 1000, order: None, windows: Run::WINDOWS };
//! let posed = Posed::new(&system, &scheme.scheme, run, (Arithmetic::DOUBLE, false));
//! let samples = posed.samples::<f64>((KeptStates::Every(100), &[]), &(), &mut ())?;
//! assert_eq!(samples.n, (0..=10).map(|i| 100 * i).collect::<Vec<_>>());
//! assert!(samples.energy.iter().all(|energy| (energy + 0.5).abs() < 1e-3));
//! # Ok::<(), shadowstep_scenes::Error>(())
//! ```

use crate::columns::at::{At, Place};
use crate::columns::column::{Column, next_multiple};
use crate::columns::{Group as _, Values};
use crate::execution::computation::RunNumber;
use crate::execution::posed::Posed;
use crate::results::Cell;
use crate::scene::{self, NamedExpression};
use crate::texts::error::Error;
use crate::watch::observer::{Observer, interrupted};
use crate::watch::{Bodies, Energies, Interactions};

/// Which states of a run are kept.
#[derive(Clone, Copy, Debug)]
pub enum KeptStates<'a> {
    /// The states n = 0, m, 2m, …, and the last one.
    Every(u64),
    /// Where the trajectory crosses a surface that was [checked](scene::System::section) for the system: each is a part
    /// of a step after the state n.
    Crossings(&'a scene::Surface),
}

/// The states of a run.
#[derive(Clone, Debug, Default)]
pub struct Samples<N> {
    /// The numbers of the states: t = n h; of a crossing that of the state before.
    pub n: Vec<i64>,
    /// Their physical times.
    pub t: Vec<N>,
    /// Positions, one state after the other.
    pub q: Vec<N>,
    /// Momenta, in the same form.
    pub p: Vec<N>,
    /// H
    pub energy: Vec<N>,
    /// The value of each formula at each of these states; `None` of one that is not finite.
    pub values: Vec<Vec<Option<N>>>,
    /// The modified energies of these states, or of the middles between them and the next ones; the last one is then
    /// missing.
    pub modified: Vec<Modified<N>>,
    /// Evaluations of the gradient, those for the states beyond both ends included.
    pub evaluations: u64,
    /// What the kept states show of the interactions of planets; `None` of other systems.
    pub interactions: Option<Interactions>,
}

/// A modified energy.
#[derive(Clone, Debug)]
pub struct Modified<N> {
    /// The modified energy H̄.
    pub value: N,
    /// Its estimated error, where there is one.
    pub error: Option<N>,
    /// The k of E_k, or the m of D_m.
    pub order: u32,
}

impl Posed<'_> {
    /// Makes the run and keeps its states, with the values of formulas there, and a summary for an observer that
    /// [wants](Observer::summarises) one.
    ///
    /// # Errors
    /// Crossings with displaced forces; a state or an energy that is not finite; settings of the estimator that are not
    /// valid; an observer that stops.
    ///
    /// # Panics
    /// If the scheme is not valid for the system.
    pub fn samples<N: RunNumber>(
        self,
        (kept, values): (KeptStates<'_>, &[NamedExpression]),
        context: &N::Context,
        observer: &mut dyn Observer,
    ) -> Result<Samples<N>, Error> {
        let (every, section) = match kept {
            KeptStates::Every(every) => (Some(every.max(1)), None),
            KeptStates::Crossings(surface) => (None, Some(surface)),
        };
        let summarised = observer.summarises();
        let energies = every.filter(|_| summarised).map(Energies::Given);
        let posed = Posed { section, energies, summarised, ..self };
        let mut samples = Samples::none();
        samples.values = vec![Vec::new(); values.len()];
        let values = Values::new(values, 1);
        let bodies = Bodies::of(posed.system, 1, None);
        let mut kept = Kept { samples, values, cells: Vec::new(), every, bodies };
        let followed = N::follow(&posed, context, &mut [&mut kept], observer)?;
        if followed.is_stopped {
            return Err(interrupted(self.run, followed.n.unsigned_abs()));
        }
        if let Some(summary) = &followed.summary {
            observer.summary(summary);
        }
        let (evaluations, interactions) = (followed.evaluations, kept.bodies.and_then(|mut bodies| bodies.found().0));
        Ok(Samples { evaluations, interactions, ..kept.samples })
    }
}

/// Keeps states of a run.
struct Kept<'a, N: RunNumber> {
    samples: Samples<N>,
    values: Values<'a, N>,
    /// Those of a state.
    cells: Vec<Cell<N>>,
    /// The period; `None` of crossings.
    every: Option<u64>,
    bodies: Option<Bodies>,
}

impl<N: RunNumber> Kept<'_, N> {
    fn push(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        let energy = at.energy()?.clone();
        let (n, time, samples) = (at.n, at.time(), &mut self.samples);
        if let Some(bodies) = &mut self.bodies {
            bodies.include(n, at.state().0);
        }
        samples.n.push(n);
        samples.t.push(time);
        samples.energy.push(energy);
        self.values.append(at, &mut self.cells)?;
        for (column, cell) in samples.values.iter_mut().zip(self.cells.drain(..)) {
            column.push(match cell {
                Cell::Number(value) => Some(value),
                _ => None,
            });
        }
        let (q, p) = at.shown_state();
        samples.q.extend_from_slice(q);
        samples.p.extend_from_slice(p);
        Ok(())
    }
}

impl<N: RunNumber> Column<N> for Kept<'_, N> {
    fn next(&self, n: i64) -> i64 {
        self.every.map_or(i64::MAX, |every| next_multiple(n, every))
    }

    fn take(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        let is_due = match (at.place, self.every) {
            (Place::State, every) => every.is_some_and(|every| at.is_last || at.n.unsigned_abs().is_multiple_of(every)),
            (Place::Crossing, _) => true,
            (Place::PhysicalEnd, every) => every.is_some(),
        };
        if !is_due {
            return Ok(());
        }
        if let Some(found) = at.estimate {
            let (value, error) = (found.value.clone(), found.error.cloned());
            self.samples.modified.push(Modified { value, error, order: found.order });
        }
        self.push(at)
    }

    /// Keeps the last state where it was not known to be that, or estimates belong to the middles between states.
    fn end(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        let is_kept = self.every.is_none() || self.samples.n.last() == Some(&at.n);
        if is_kept { Ok(()) } else { self.push(at) }
    }
}

impl<N> Samples<N> {
    fn none() -> Self {
        Samples {
            n: Vec::new(),
            t: Vec::new(),
            q: Vec::new(),
            p: Vec::new(),
            energy: Vec::new(),
            values: Vec::new(),
            modified: Vec::new(),
            evaluations: 0,
            interactions: None,
        }
    }

    /// The same states in other numbers, as texts for example.
    pub fn map<T>(self, number: impl Fn(&N) -> T) -> Samples<T> {
        let all = |numbers: &[N]| numbers.iter().map(&number).collect();
        let modified = |found: &Modified<N>| Modified {
            value: number(&found.value),
            error: found.error.as_ref().map(&number),
            order: found.order,
        };
        Samples {
            t: all(&self.t),
            q: all(&self.q),
            p: all(&self.p),
            energy: all(&self.energy),
            values: self
                .values
                .iter()
                .map(|column| column.iter().map(|value| value.as_ref().map(&number)).collect())
                .collect(),
            modified: self.modified.iter().map(modified).collect(),
            n: self.n,
            evaluations: self.evaluations,
            interactions: self.interactions,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::watch::observer::testing::{KeptSummary, read, summary};

    fn posed(scene: &Scene) -> Posed<'_> {
        let estimator = scene.output.modified_energy.as_ref().map(|(settings, _)| settings);
        Posed { estimator, ..scene.posed() }
    }

    /// Whatever a run computes besides, its summary is that of the scene; only H may be computed at other states.
    #[test]
    fn the_summary_is_that_of_the_scene() {
        let kepler = "problem.name = \"kepler\"\nrun = { scheme = \"SCHEME\", step = \"1/20\", until = 100, digits \
            = \"double\" }\n";
        let planets = "problem = { name = \"outer-solar-system\", parts = \"wisdom-holman\" }\n\
                       run = { scheme = \"saba4\", step = 100, until = 100000, digits = \"double\" }\n";
        for (text, estimated) in [
            (kepler.replace("SCHEME", "yoshida4"), false),
            (kepler.replace("SCHEME", "yoshida4"), true),
            (kepler.replace("SCHEME", "bcm6-13"), false),
            (planets.to_owned(), false),
        ] {
            let rows = if estimated {
                "output.modified_energy = { estimator = \"bilinear\", order = 8, every = 100 }\n"
            } else {
                "output.energy = { every = 100 }\n"
            };
            let scene = read(&(text + rows));
            let mut own = KeptSummary::default();
            posed(&scene).samples::<f64>((KeptStates::Every(100), &[]), &(), &mut own).unwrap();
            let (of_scene, own) = (summary(&scene), own.0.unwrap());
            assert_eq!(own.verdict_with_reason(), of_scene.verdict_with_reason());
            assert_eq!((own.to, own.encounters), (of_scene.to, of_scene.encounters));
        }
    }

    /// H of the states that are kept is in the summary, each once, whether windows or estimates are there before.
    #[test]
    fn the_error_of_h_is_over_all_states_that_are_kept() {
        let kepler = "problem.name = \"kepler\"\nrun = { scheme = \"SCHEME\", step = \"1/20\", until = \"UNTIL\", \
            digits = \"double\" }\n";
        let estimates = "output.modified_energy = { estimator = \"bilinear\", order = 8 }\n";
        for (scheme, until) in [("yoshida4", "100"), ("yoshida4", "2"), ("bcm6-13", "100"), ("bcm6-13", "2")] {
            for rows in ["output.energy = true\n", estimates] {
                let text = kepler.replace("SCHEME", scheme).replace("UNTIL", until) + rows;
                let scene = read(&text);
                let mut kept = KeptSummary::default();
                let samples = posed(&scene).samples::<f64>((KeptStates::Every(1), &[]), &(), &mut kept).unwrap();
                let found = kept.0.unwrap().energy;
                // of a processed scheme the kernel's first state is H(0) but for round-off
                let initial: f64 = found.initial.parse().unwrap();
                let errors: Vec<f64> = samples.energy.iter().map(|energy| (energy - initial).abs()).collect();
                let largest = errors.iter().copied().fold(0.0, f64::max);
                assert_eq!(found.states, errors.len() as u64, "{scheme} {until} {rows}");
                assert_eq!(found.largest.parse::<f64>().unwrap(), largest);
                assert_eq!(errors[usize::try_from(found.at).unwrap()], largest);
                assert_eq!(found.last.parse::<f64>().unwrap().abs(), *errors.last().unwrap());
            }
        }
    }
}
