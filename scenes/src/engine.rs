//! The run of a scene into rows, which a checkpoint can resume.

use crate::at::{At, Place};
use crate::column::{Column, next_multiple};
use crate::computation::{Computation, FollowedNumber, RunNumber};
use crate::error::Error;
use crate::moment::Moment;
use crate::observer::Observer;
use crate::posed::{Followed, Posed, Resumed};
use crate::results::{Checkpoint, Indicators, ModifiedEnergy, Row, Rows};
use crate::scene::{Outputs, Scene};
use crate::tangent::{VECTORS_OF_ROWS, Vectors};
use crate::values::{Extremes, ValuesOfRows};
use crate::watch::Energies;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// With its last step.
    Complete {
        /// The number of steps.
        steps: u64,
        /// Evaluations of the gradient in this call; a resumed run made others before.
        force_evaluations: u64,
    },
    /// The file was complete before: nothing was done.
    AlreadyComplete,
    /// The observer stopped it.
    Stopped {
        /// After this state.
        n: i64,
    },
}

/// The run of a scene in any number type, from a checkpoint if there is one, until it is complete or the observer stops it.
pub(crate) struct SceneRun<'a, 'r> {
    pub(crate) scene: &'a Scene,
    pub(crate) rows: &'a mut Rows<'r>,
    pub(crate) checkpoint: Option<&'a Checkpoint>,
    pub(crate) observer: &'a mut dyn Observer,
}

impl Computation for SceneRun<'_, '_> {
    type Output = Result<Followed, Error>;

    fn compute<N: FollowedNumber>(self, context: &N::Context) -> Self::Output {
        let SceneRun { scene, rows, checkpoint, observer } = self;
        let summarised = scene.summarises(observer);
        let output = &scene.output;
        let posed = Posed {
            section: output.section.as_ref(),
            estimator: output.modified_energy.as_ref().map(|(settings, _)| settings),
            vectors: output.chaos.map(|_| (Vectors::Free(VECTORS_OF_ROWS), 1)),
            energies: output.energy.filter(|_| summarised).map(Energies::Given),
            summarised,
            resumed: Resumed { interval: output.checkpoint, checkpoint },
            ..scene.posed()
        };
        let values = output.values.iter().map(|columns| ValuesOfRows::new(columns, &scene.system, context));
        let mut rows = StateRows { output, rows, values: values.collect() };
        let extremes = if summarised { &output.extremes[..] } else { &[] };
        let mut extremes = Extremes::new(extremes, &scene.system, context);
        let columns: &mut [&mut dyn Column<N>] = &mut [&mut rows, &mut extremes];
        let mut followed = N::follow(&posed, context, columns, observer)?;
        if let Some(summary) = &mut followed.summary {
            summary.extremes = extremes.found();
        }
        Ok(followed)
    }
}

/// What a row has besides modified energies and indicators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Due {
    energy: bool,
    state: bool,
    /// Some of the values.
    values: bool,
}

impl Due {
    const NOTHING: Due = Due { energy: false, state: false, values: false };
}

/// Writes rows.
struct StateRows<'a, 'r, N: RunNumber> {
    output: &'a Outputs,
    rows: &'a mut Rows<'r>,
    /// Columns of expressions.
    values: Vec<ValuesOfRows<'a, N>>,
}

impl<N: RunNumber> StateRows<'_, '_, N> {
    /// Whether something with this period is to be written of a state.
    fn is_due(every: Option<u64>, at: &At<'_, '_, N>) -> bool {
        every.is_some_and(|every| match at.place {
            Place::State => at.is_met || at.n.unsigned_abs().is_multiple_of(every),
            Place::Crossing | Place::PhysicalEnd => true,
        })
    }

    /// What is due. A crossing has its state, whatever else is written.
    fn due(&self, at: &At<'_, '_, N>) -> Due {
        let Outputs { energy, trajectory, .. } = self.output;
        Due {
            energy: Self::is_due(*energy, at),
            state: at.place == Place::Crossing || Self::is_due(*trajectory, at),
            values: self.values.iter().any(|own| Self::is_due(Some(own.every), at)),
        }
    }
}

impl<N: RunNumber> Column<N> for StateRows<'_, '_, N> {
    fn next(&self, n: i64) -> i64 {
        let Outputs { energy, trajectory, chaos, modified_energy, .. } = self.output;
        let periods = [*energy, *trajectory, *chaos, modified_energy.as_ref().map(|(_, every)| *every)];
        let periods = periods.into_iter().flatten().chain(self.values.iter().map(|own| own.every));
        periods.map(|every| next_multiple(n, every)).min().unwrap_or(i64::MAX)
    }

    fn take(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        let due = self.due(at);
        let is_state = at.place == Place::State;
        let modified =
            self.output.modified_energy.as_ref().filter(|(_, every)| is_state && Self::is_due(Some(*every), at));
        let modified_energy = modified.and(at.estimate).map(ModifiedEnergy::of);
        let has_indicators = is_state && Self::is_due(self.output.chaos, at);
        if due == Due::NOTHING && modified_energy.is_none() && !has_indicators {
            return Ok(());
        }
        let chaos = at.vectors().filter(|_| has_indicators).map(Indicators::of);
        let (n, t) = (at.n, at.time());
        let needs_energy = due.energy || (due.values && self.values.iter().any(ValuesOfRows::needs_energy));
        let energy = if needs_energy { Some(at.energy()?.clone()) } else { None };
        let mut values = Vec::new();
        for own in &mut self.values {
            let is_due = Self::is_due(Some(own.every), at);
            own.append(is_due.then(|| (at.state(), &t, energy.as_ref())), &mut values);
        }
        let state = due.state.then(|| at.shown_state());
        let energy = energy.as_ref().filter(|_| due.energy);
        self.rows.row(&Row { n, t: &t, energy, modified_energy, chaos, values, state })
    }

    fn keep(&mut self, moment: &Moment) -> Result<(), Error> {
        self.rows.target.keep(moment)
    }
}
