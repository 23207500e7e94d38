//! What takes the states of a run: rows, arrays, records, the least and greatest values of expressions.

use shadowstep::number::saved::Fields;
use shadowstep::steps::integrator::VectorIntegrator;

use crate::columns::at::At;
use crate::results::moment::Moment;
use crate::run::Run;
use crate::scene::SceneNumber;
use crate::texts::error::Error;
use crate::watch::Watch;

/// Takes states of a run.
pub trait Column<N: SceneNumber> {
    /// The n of the next state that it takes after the state n; by default none. It is also shown others, as the last
    /// one.
    fn next(&self, n: i64) -> i64 {
        let _ = n;
        i64::MAX
    }

    /// Takes a state, or leaves it.
    ///
    /// # Errors
    /// What ends the run.
    fn take(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        let _ = at;
        Ok(())
    }

    /// Whether it [sees](Column::see) each state.
    fn sees_each(&self) -> bool {
        false
    }

    /// Whether the step to the next state that it sees carries [increments](shadowstep::Carried::Increments) along.
    fn needs_increments(&self) -> bool {
        false
    }

    /// Sees the state n of the steps, at which the integrator is: each of the run, before estimates. Whether the run
    /// ends with it. A processed scheme has the state of the trajectory
    /// [at output](shadowstep::steps::integrator::at_output).
    fn see(&mut self, n: i64, run: Run<'_>, integrator: &mut VectorIntegrator<'_, N>) -> bool {
        let _ = (n, run, integrator);
        false
    }

    /// Takes the last state once more, when all that is known of the run is known.
    ///
    /// # Errors
    /// What makes the run a failed one.
    fn end(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        let _ = at;
        Ok(())
    }

    /// Gives all numbers that the states so far have left, or replaces them.
    fn fields(&mut self, context: &N::Context, to: &mut dyn Fields<N>) {
        let _ = (context, to);
    }

    /// Keeps a moment from which the run can be resumed.
    ///
    /// # Errors
    /// A file that cannot be written.
    fn keep(&mut self, moment: &Moment) -> Result<(), Error> {
        let _ = moment;
        Ok(())
    }
}

/// The next multiple of `every` after n.
pub fn next_multiple(n: i64, every: u64) -> i64 {
    n.saturating_add_unsigned(every - n.unsigned_abs() % every)
}

/// Shows a state to all columns. H, where it is computed, is of the error of H, too.
pub(crate) fn show<N: SceneNumber>(
    columns: &mut [&mut dyn Column<N>],
    watch: &mut Option<Watch<N>>,
    at: &mut At<'_, '_, N>,
) -> Result<(), Error> {
    columns.iter_mut().try_for_each(|column| column.take(at))?;
    if let (Some(watch), Some(energy), None) = (watch, &at.energy, &at.energy_of) {
        watch.include_energy(at.n, energy);
    }
    Ok(())
}
