//! The run of a scene into rows, which a checkpoint can resume.

use crate::columns::Columns;
use crate::columns::at::At;
use crate::columns::column::Column;
use crate::columns::extremes::Extremes;
use crate::execution::computation::{Computation, RunNumber};
use crate::execution::posed::{Followed, Posed, Resumed};
use crate::motion::tangent::{VECTORS_OF_ROWS, Vectors};
use crate::results::moment::Moment;
use crate::results::{Cell, Checkpoint, Rows};
use crate::scene::Scene;
use crate::texts::error::Error;
use crate::watch::Energies;
use crate::watch::observer::Observer;

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

/// The run of a scene in any number type, from a checkpoint if there is one, until it is complete or the observer stops
/// it.
pub(crate) struct SceneRun<'a, 'r> {
    pub(crate) scene: &'a Scene,
    pub(crate) rows: &'a mut Rows<'r>,
    pub(crate) checkpoint: Option<&'a Checkpoint>,
    pub(crate) observer: &'a mut dyn Observer,
}

impl Computation for SceneRun<'_, '_> {
    type Output = Result<Followed, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
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
        let mut rows = StateRows { rows, columns: Columns::of(output, &scene.system), cells: Vec::new() };
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

/// Writes rows.
struct StateRows<'a, 'r, N: RunNumber> {
    rows: &'a mut Rows<'r>,
    columns: Columns<'a, N>,
    cells: Vec<Cell<N>>,
}

impl<N: RunNumber> Column<N> for StateRows<'_, '_, N> {
    fn next(&self, n: i64) -> i64 {
        self.columns.next(n)
    }

    fn take(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        self.columns.cells(at, &mut self.cells)?;
        if self.cells.is_empty() { Ok(()) } else { self.rows.row(&self.cells) }
    }

    fn keep(&mut self, moment: &Moment) -> Result<(), Error> {
        self.rows.target.keep(moment)
    }
}
