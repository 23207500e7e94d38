//! The pendulum at and around its separatrix.

use crate::stability::prelude::*;

/// The case.
pub(super) struct Pendulum;

/// How the pendulum moved.
#[derive(Serialize, Deserialize)]
pub(super) struct Moved {
    watched: Watched,
    /// Whether it swung back, and whether it turned over.
    back: bool,
    over: bool,
    /// The largest |H − H(0)|.
    energy_error: f64,
}

impl Case for Pendulum {
    type Measured = Moved;

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Moved, Error> {
        let run = &mut *trial.start(&shipped("pendulum", &[("p", trial.get("momentum"))]), &trial.step());
        let (mut back, mut over, mut energy_error) = (false, false, 0.0_f64);
        let watched = trial.watched(run, continues, &mut |_, run| {
            back |= run.p(0) < 0.0;
            over |= run.q(0).abs() > std::f64::consts::PI;
            energy_error = energy_error.max(run.energy_change().abs());
            ControlFlow::Continue(())
        });
        Ok(Moved { watched, back, over, energy_error })
    }

    fn judge(all: &[&Done<'_, Moved>]) -> Vec<Row> {
        let start = |one: &Done<'_, Moved>| one.trial.get::<String>("momentum");
        let momentum = |one: &Done<'_, Moved>| start(one).parse::<f64>().expect("it is a number");
        let ways = joined(all, ", ", |one| format!("p(0) = {} {}", start(one), one.found.way()));
        let error = largest(all.iter().map(|one| one.found.energy_error));
        let verdict = Verdict::of_all(all.iter().map(|one| one.found.verdict(momentum(one))));
        let points = all.iter().map(|one| (momentum(one), one.found.energy_error.log10()));
        vec![Row::of(&all[0].trial, format!("{ways}; error of H {error:.1e} at most"), verdict).with(points)]
    }
}

impl Moved {
    fn way(&self) -> &'static str {
        match (self.back, self.over) {
            (true, true) => "both",
            (true, false) => "swings",
            (false, true) => "turns over",
            (false, false) => "neither",
        }
    }

    /// From a momentum at the start.
    fn verdict(&self, p: f64) -> Verdict {
        // H of the start beside that of the separatrix, 1
        let distance = p * p / 2.0 - 2.0;
        let as_exact = if distance < 0.0 { self.back && !self.over } else { self.over && !self.back };
        let decided = distance.abs() > self.energy_error;
        let both = self.back && self.over;
        let said = if both { Verdict::from(!self.watched.fine) } else { self.watched.is_fine() };
        Verdict::of_all([said, Verdict::from(as_exact || !decided)])
    }
}
