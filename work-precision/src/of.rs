//! The errors by which schemes are compared.

use serde::{Deserialize, Serialize};

use crate::run::Measurement;
use crate::size::Size;

/// The error by which schemes are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Of {
    /// That of the position at the end, where the reference resolves it.
    Position,
    /// The largest error of H.
    Energy,
    /// The permanent change of the modified energy, above which one is excluded.
    Permanent,
}

/// The growth of errors is the median of this number of runs.
const RUNS_OF_GROWTH: usize = 5;

impl Of {
    /// Its description.
    pub fn name(self) -> &'static str {
        match self {
            Of::Position => "error of the position at the end",
            Of::Energy => "largest error of H",
            Of::Permanent => "permanent change of the modified energy, at most",
        }
    }

    /// The error of a run; `None` where it failed or the reference does not resolve it.
    pub fn error(self, run: &Measurement) -> Option<Size> {
        let error = match self {
            Of::Position => run.position.known()?,
            Of::Energy => run.energy,
            Of::Permanent => run.modified?.bound?,
        };
        (run.failed.is_none() && error.is_finite()).then_some(error)
    }

    /// By which factor errors grow if the run is twice as long: the median of the last runs, whose errors are the smallest. One run alone may have a first
    /// half in which its error happens to be small. 1 where that is not known.
    pub(crate) fn growth(self, runs: &[Measurement]) -> f64 {
        let known = runs.iter().rev().filter_map(|run| self.growth_of(run)).take(RUNS_OF_GROWTH);
        let mut all: Vec<f64> = known.collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(1.0)
    }

    /// That of one run.
    fn growth_of(self, run: &Measurement) -> Option<f64> {
        let (position, energy) = run.in_first_half;
        let decades = match self {
            Of::Position => run.largest_position.known()?.log10() - position.known()?.log10(),
            Of::Energy => run.energy.log10() - energy.log10(),
            // like the time
            Of::Permanent => 2_f64.log10(),
        };
        (run.failed.is_none() && decades.is_finite()).then(|| 10_f64.powf(decades.max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::PositionError;

    /// A run with this error at its end, and a largest one in its first half.
    fn run(first_half: f64, end: f64) -> Measurement {
        let known = |size: f64| PositionError::Known(Size::of(&size));
        Measurement {
            steps: 1,
            evaluations: 1,
            position: known(end),
            largest_position: known(end),
            energy: Size::of(&end),
            energy_at_end: Size::of(&end),
            in_first_half: (known(first_half), Size::of(&first_half)),
            modified: None,
            verdict: String::new(),
            fine: true,
            undecided: false,
            failed: None,
        }
    }

    /// Those of wisdom-kernel-17 on the outer planets with steps of 500 to 62.5 days up to 75000 days.
    #[test]
    fn one_run_does_not_decide_how_errors_grow() {
        let runs = [run(2.19e-3, 4.47e-3), run(2.09e-7, 2.05e-6), run(1.37e-9, 1.93e-9), run(8.51e-11, 1.21e-10)];
        let found = Of::Position.growth(&runs);
        // up to 300000 days, so twice as long twice, they are 2.0 and 2.4 times as large with the smaller steps
        assert!((1.3..2.1).contains(&found), "{found}");
        assert_eq!(Of::Position.growth(&[]), 1.0);
    }
}
