//! What a case is, and its trials as calculations whose outcomes are saved.

use serde::de::DeserializeOwned;
use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_studies::finding::Finding;
use shadowstep_studies::{Calculation, Continues};

use crate::suite::Suite;

/// The curves of a chart, at most: more are not distinguishable.
pub(crate) const MOST_CURVES: usize = 12;

/// A hard case: what theory predicts, what is computed to see it, and whether it holds.
pub(crate) trait Case {
    /// The name by which it is requested.
    const NAME: &'static str;
    /// Its heading.
    const TITLE: &'static str;
    /// What theory predicts, in sentences.
    const THEORY: &'static str;
    /// Trials of another revision are computed again; a change of what is computed needs a new one.
    const REVISION: u32;

    /// One computation with all that it depends on: its JSON identifies it.
    type Trial: Serialize + Sync + 'static;
    /// What it has measured. Numbers must be finite.
    type Measured: Serialize + DeserializeOwned;

    /// All trials.
    fn trials(suite: &Suite) -> Vec<Self::Trial>;

    /// The number type of the trials.
    fn arithmetic(suite: &Suite) -> Arithmetic {
        suite.arithmetic
    }

    /// The time that a trial takes in double precision, in seconds, to a factor of a few.
    fn seconds(suite: &Suite, trial: &Self::Trial) -> f64;

    /// Makes a trial in a number type. One that is asked not to continue ends at once, with any result, which is
    /// dropped.
    fn measure(
        suite: &Suite,
        trial: &Self::Trial,
        arithmetic: Arithmetic,
        continues: Continues<'_>,
    ) -> Result<Self::Measured, Error>;

    /// What the trials show; failed ones are left out.
    fn judge(suite: &Suite, measured: &[(Self::Trial, Self::Measured)]) -> Finding;
}

/// A case in the list of all cases.
pub(crate) struct Entry {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    pub(crate) theory: &'static str,
    trials: for<'a> fn(&'a Suite) -> Vec<Trial<'a>>,
    finding: fn(&Suite, Vec<Option<Value>>) -> Finding,
}

impl Entry {
    pub(crate) const fn of<C: Case>() -> Entry {
        Entry { name: C::NAME, title: C::TITLE, theory: C::THEORY, trials: trials::<C>, finding: finding::<C> }
    }

    /// The computations of the case.
    pub(crate) fn trials<'a>(&self, suite: &'a Suite) -> Vec<Trial<'a>> {
        (self.trials)(suite)
    }

    /// What their results, in the same order, show.
    pub(crate) fn finding(&self, suite: &Suite, results: Vec<Option<Value>>) -> Finding {
        Finding { stated: vec![self.theory.to_owned()], ..(self.finding)(suite, results) }
    }
}

fn trials<C: Case>(suite: &Suite) -> Vec<Trial<'_>> {
    let arithmetic = C::arithmetic(suite);
    let prepare = |trial: C::Trial| Trial {
        key: json!({ "case": C::NAME, "revision": C::REVISION, "digits": arithmetic.label(), "trial": trial }),
        seconds: C::seconds(suite, &trial) * arithmetic.numbers().cost(),
        measure: Box::new(move |continues| {
            let measured = C::measure(suite, &trial, arithmetic, continues)?;
            Ok(serde_json::to_value(measured)?)
        }),
    };
    C::trials(suite).into_iter().map(prepare).collect()
}

fn finding<C: Case>(suite: &Suite, results: Vec<Option<Value>>) -> Finding {
    let measured = |result: Option<Value>| serde_json::from_value::<C::Measured>(result?).ok();
    let pairs =
        C::trials(suite).into_iter().zip(results).filter_map(|(trial, result)| Some((trial, measured(result)?)));
    C::judge(suite, &pairs.collect::<Vec<_>>())
}

/// A computation of a case.
pub(crate) struct Trial<'a> {
    key: Value,
    seconds: f64,
    measure: Box<Measuring<'a>>,
}

type Measuring<'a> = dyn Fn(Continues<'_>) -> Result<Value, Error> + Sync + 'a;

impl Serialize for Trial<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.key.serialize(serializer)
    }
}

impl Calculation for Trial<'_> {
    type Outcome = Value;
    type Shared = ();

    fn cost(&self) -> f64 {
        self.seconds
    }

    fn compute(&self, (): &(), continues: Continues<'_>) -> Result<Value, Error> {
        (self.measure)(continues)
    }
}
