//! The table of a case: what theory predicts, and the trials that show it.

use serde::Deserialize;
use serde_json::{Map, Value};
use shadowstep_scenes::arithmetic::Arithmetic;

use crate::claim::ChartTexts;
use crate::stability::suite::{Examined, Suite};

/// Values by their names.
pub(crate) type Values = Map<String, Value>;

/// A table `cases/NAME.toml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The heading.
    pub(crate) title: String,
    /// What theory predicts, in sentences.
    pub(crate) theory: String,
    /// Trials of another revision are computed again; a change of what is computed needs a new one.
    pub(crate) revision: u32,
    /// The digits of all trials; 0 for double precision, and those of the suite if there is no key.
    digits: Option<u32>,
    /// The digits that no trial exceeds.
    most_digits: Option<u32>,
    /// The schemes of the case, if none are requested; all shipped ones for two parts if there is no key.
    schemes: Option<Vec<String>>,
    /// The approximate time of a force evaluation in double precision, in seconds; or of a unit of the value `cost_of`.
    pub(crate) seconds: f64,
    pub(crate) cost_of: Option<String>,
    /// Which trials are judged together.
    #[serde(default)]
    together: Together,
    /// Values of trials. A list is the values of as many trials; of several lists the first by name varies slowest, and
    /// `each` has lists of values that belong together. `full` and `quick` are for a full and a quick examination;
    /// `evaluations` is divided by those of a step. A family can have schemes of its own, or be about these `only`, and
    /// values `aside`, which are no part of what identifies the trial.
    trials: Vec<Values>,
    pub(crate) chart: Option<ChartTexts>,
    #[serde(default)]
    pub(crate) curves: Look,
    /// More are not distinguishable.
    pub(crate) most_curves: Option<usize>,
    /// Constants of the case.
    #[serde(default)]
    pub(crate) given: Values,
}

/// Trials that are judged together.
#[derive(Clone, Copy, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Together {
    #[default]
    Scheme,
    None,
    All,
}

/// How curves are drawn.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Look {
    #[default]
    Marked,
    Line,
    Unjoined,
}

impl Table {
    /// The number type of the trials.
    pub(crate) fn arithmetic(&self, suite: &Suite) -> Arithmetic {
        let of = |digits| Arithmetic::with_digits(digits).expect("numbers of limbs have them");
        match (self.digits, self.most_digits) {
            (Some(0), _) => Arithmetic::DOUBLE,
            (Some(digits), _) => of(digits),
            (None, Some(most)) if suite.arithmetic.digits() > most => of(most),
            _ => suite.arithmetic,
        }
    }

    /// The schemes of the case, or of a family of trials.
    pub(crate) fn schemes<'a>(&self, suite: &'a Suite) -> Vec<&'a Examined> {
        self.schemes.as_ref().map_or_else(|| suite.schemes_or_all(), |names| suite.schemes_or(names))
    }

    /// The schemes and the values of all trials.
    pub(crate) fn trials<'a>(
        &self,
        suite: &'a Suite,
        complete: fn(&Examined, Values) -> Option<Values>,
    ) -> Vec<(&'a Examined, Values)> {
        let of_family = |family: &Values| {
            let mut family = family.clone();
            let mut names = |key: &str| Some(serde_json::from_value(family.remove(key)?).expect("names are texts"));
            let (own, only): (Option<Vec<String>>, Option<Vec<String>>) = (names("schemes"), names("only"));
            let schemes = own.as_ref().or(only.as_ref());
            let mut schemes = schemes.map_or_else(|| self.schemes(suite), |names| suite.schemes_or(names));
            let is_wanted = |name: &str| only.as_ref().is_none_or(|only| only.iter().any(|other| other == name));
            schemes.retain(|scheme| is_wanted(scheme.name()));
            let of_scheme = move |scheme: &'a Examined| {
                let all = expanded(&family, suite, scheme).into_iter();
                let trial = move |values| Some((scheme, complete(scheme, values)?));
                all.filter_map(trial).collect::<Vec<_>>()
            };
            schemes.into_iter().flat_map(of_scheme)
        };
        self.trials.iter().flat_map(of_family).collect()
    }

    /// What is judged together: the trials of a scheme, each trial, or all.
    pub(crate) fn groups<'b, T>(&self, all: &'b [T], scheme: fn(&T) -> &str) -> Vec<Vec<&'b T>> {
        let mut groups: Vec<Vec<&T>> = Vec::new();
        for one in all {
            let is_own = |group: &T| match self.together {
                Together::Scheme => scheme(group) == scheme(one),
                together => together == Together::All,
            };
            match groups.iter_mut().find(|group| is_own(group[0])) {
                Some(group) => group.push(one),
                None => groups.push(vec![one]),
            }
        }
        groups
    }
}

/// The values of each trial of a family.
fn expanded(family: &Values, suite: &Suite, scheme: &Examined) -> Vec<Values> {
    let mut all = vec![Values::new()];
    for (name, value) in family {
        let options = match resolved(value, suite, scheme) {
            Value::Array(options) => options,
            one => vec![one],
        };
        let with = |values: &Values, option: &Value| {
            let mut values = values.clone();
            match option {
                Value::Object(several) if name == "each" => values.extend(several.clone()),
                one => values.extend([(name.clone(), one.clone())]),
            }
            values
        };
        all = all.iter().flat_map(|values| options.iter().map(move |option| with(values, option))).collect();
    }
    all
}

/// The value of a full or a quick examination, and of a scheme.
fn resolved(value: &Value, suite: &Suite, scheme: &Examined) -> Value {
    let resolve = |value: &Value| resolved(value, suite, scheme);
    let of = |name: &str| value.as_object()?.get(name);
    match (value, of("full"), of("quick"), of("evaluations")) {
        (_, Some(full), Some(quick), _) => resolve(suite.full_or_quick(full, quick)),
        (_, _, _, Some(all)) => {
            let all = resolve(all).as_u64().expect("evaluations are a whole number");
            (all / scheme.evaluations()).into()
        }
        (Value::Array(values), ..) => values.iter().map(resolve).collect(),
        (Value::Object(members), ..) => {
            members.iter().map(|(name, value)| (name.clone(), resolve(value))).collect::<Values>().into()
        }
        _ => value.clone(),
    }
}
