//! The estimator of the modified energy that is asked for, by flags or by the keys of a scene.

use num_traits::Signed;
use shadowstep::number::Number;
use shadowstep::shadow::{
    BestBilinear, BestBilinearEstimator, Bilinear, BilinearEstimator, Central, CentralEstimator, Estimate, Estimator,
    Method, Rule, Stop,
};
use shadowstep::{Increments, Rational};
use shadowstep_symbolic::decimal::to_significant;

/// Beyond this order the exact weights take longer than any run.
pub const HIGHEST_ORDER: u32 = 1000;

/// The largest m that is tried where none is asked for.
pub const DEFAULT_LARGEST_M: u32 = 200;

/// The largest k that is tried where none is asked for.
pub const DEFAULT_LARGEST_K: u32 = 64;

/// What is to be done about an accuracy that is none.
pub const NO_ACCURACY: &str =
    "write the largest error wanted, such as 1e-20, or leave it out for the best that can be had";

/// Why this is no accuracy, if it is none: it is absolute, in the units of the energy, and no unit makes energies so large.
pub fn no_accuracy(accuracy: &Rational) -> Option<&'static str> {
    let largest = Rational::from_integer(10.into()).pow(LARGEST_ACCURACY);
    match () {
        () if !accuracy.is_positive() => Some("is no size of an error"),
        () if *accuracy > largest => Some("is more than 1e100, an error larger than any energy"),
        () => None,
    }
}

/// Its power of ten.
const LARGEST_ACCURACY: i32 = 100;

/// An estimator with its order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Chosen {
    /// D_m
    Central(u32),
    /// The best m of each state, at most this.
    Best(u32, Stop, Rule),
    /// E_k
    Bilinear(u32),
    /// The best k of each state.
    BestBilinear(BestBilinear),
}

/// The kind of an estimator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Central differences D_m.
    Central,
    /// Products of states in pairs, E_k.
    Bilinear,
}

/// What is said of an estimator; what is not said has its default.
#[derive(Debug)]
pub struct Wish {
    /// Which kind.
    pub kind: Kind,
    /// m or k; none for the best.
    pub order: Option<u32>,
    /// The largest order that is tried.
    pub largest: Option<u32>,
    /// Where the search for the best m ends.
    pub stop: Option<Stop>,
    /// Which m is the best.
    pub rule: Option<Rule>,
    /// The target error.
    pub accuracy: Option<Rational>,
}

/// A setting that does not go with another one.
#[derive(Debug, PartialEq, Eq)]
pub struct Misfit {
    /// Its name: `max_order`, `stop`, `rule` or `accuracy`.
    pub name: &'static str,
    /// The setting it is for, with a value, and the value that this has.
    setting: &'static str,
    needed: &'static str,
    found: String,
}

impl Wish {
    /// The estimator, if all settings go together.
    ///
    /// # Errors
    /// The first setting that does not go with another one.
    pub fn chosen(self) -> Result<Chosen, Misfit> {
        let given = [
            ("max_order", self.largest.is_some()),
            ("stop", self.stop.is_some()),
            ("rule", self.rule.is_some()),
            ("accuracy", self.accuracy.is_some()),
        ];
        let first_of = |names: &[&str]| given.iter().find(|(name, given)| *given && names.contains(name));
        let (names, setting, needed, found): (&[&str], _, _, _) = match (self.order, self.kind) {
            (Some(order), _) => (&["max_order", "stop", "rule", "accuracy"], "order", "auto", order.to_string()),
            (None, Kind::Central) => (&["accuracy"], "estimator", "bilinear", "central".to_owned()),
            (None, Kind::Bilinear) => (&["stop", "rule"], "estimator", "central", "bilinear".to_owned()),
        };
        let misfit = first_of(names).map(|(name, _)| Misfit { name, setting, needed, found });
        match (misfit, self.order, self.kind) {
            (Some(misfit), ..) => Err(misfit),
            (None, Some(m), Kind::Central) => Ok(Chosen::Central(m)),
            (None, Some(k), Kind::Bilinear) => Ok(Chosen::Bilinear(k)),
            (None, None, Kind::Central) => Ok(Chosen::Best(
                self.largest.unwrap_or(DEFAULT_LARGEST_M),
                self.stop.unwrap_or(Stop::Full),
                self.rule.unwrap_or(Rule::Least),
            )),
            (None, None, Kind::Bilinear) => {
                let largest = self.largest.unwrap_or(DEFAULT_LARGEST_K);
                Ok(Chosen::BestBilinear(BestBilinear { largest, accuracy: self.accuracy }))
            }
        }
    }
}

impl Misfit {
    /// What is wrong and what to do, with settings spelt as they are where they are written.
    pub fn told(&self, name: &str, spelt: impl Fn(&str, &str) -> String) -> (String, String) {
        let needed = spelt(self.setting, self.needed);
        let found = spelt(self.setting, &self.found);
        (format!("{name} is for {needed}, not for {found}"), format!("leave it out, or write {needed}"))
    }
}

/// What makes it; an estimate of the error costs more.
#[derive(Clone, Debug)]
pub enum Made {
    /// D_m
    Central(Central),
    /// E_k
    Bilinear(Bilinear),
    /// The best E_k.
    BestBilinear(BestBilinear),
}

impl Chosen {
    /// The method, which estimates its error only if asked to, or where the best k is chosen by it.
    pub fn method(&self, with_error: bool) -> Made {
        match *self {
            Chosen::Central(m) => Made::Central(Central::Fixed { m, with_error }),
            Chosen::Best(largest, stop, rule) => Made::Central(Central::Best { largest, stop, rule, with_error }),
            Chosen::Bilinear(k) => Made::Bilinear(Bilinear { k, with_error }),
            Chosen::BestBilinear(ref best) => Made::BestBilinear(best.clone()),
        }
    }

    /// As it is named where it is asked for.
    pub fn name(&self) -> &'static str {
        match self {
            Chosen::Central(_) | Chosen::Best(..) => "central",
            Chosen::Bilinear(_) | Chosen::BestBilinear(_) => "bilinear",
        }
    }

    /// Its m or k, if this is fixed.
    pub fn order(&self) -> Option<u32> {
        match self {
            Chosen::Central(order) | Chosen::Bilinear(order) => Some(*order),
            Chosen::Best(..) | Chosen::BestBilinear(_) => None,
        }
    }

    /// The largest order that is tried, where it is not fixed.
    pub fn max_order(&self) -> Option<u32> {
        match self {
            Chosen::Best(largest, ..) | Chosen::BestBilinear(BestBilinear { largest, .. }) => Some(*largest),
            Chosen::Central(_) | Chosen::Bilinear(_) => None,
        }
    }

    /// How the best m is searched for, in the words of flags and keys.
    pub fn stop_and_rule(&self) -> Option<(&'static str, &'static str)> {
        let Chosen::Best(_, stop, rule) = self else { return None };
        let stop = match stop {
            Stop::Full => "full",
            Stop::Early => "early",
        };
        let rule = match rule {
            Rule::Least => "least",
            Rule::Robust => "robust",
        };
        Some((stop, rule))
    }

    /// The largest error wanted.
    pub fn accuracy(&self) -> Option<&Rational> {
        let Chosen::BestBilinear(best) = self else { return None };
        best.accuracy.as_ref()
    }

    /// What sets its order, or the largest one that is tried: `order` or `max_order`, with the value.
    pub fn order_setting(&self) -> (&'static str, u32) {
        match self {
            Chosen::Central(order) | Chosen::Bilinear(order) => ("order", *order),
            Chosen::Best(largest, ..) | Chosen::BestBilinear(BestBilinear { largest, .. }) => ("max_order", *largest),
        }
    }

    /// What its order is called.
    pub fn letter(&self) -> &'static str {
        match self {
            Chosen::Central(_) | Chosen::Best(..) => "m",
            Chosen::Bilinear(_) | Chosen::BestBilinear(_) => "k",
        }
    }

    /// As people call it: `central differences, m = 4`.
    pub fn described(&self) -> String {
        match self {
            Chosen::Central(m) => format!("central differences, m = {m}"),
            Chosen::Best(largest, stop, rule) => {
                let by = if *rule == Rule::Robust { " by the robust rule" } else { "" };
                let end = if *stop == Stop::Early { " before errors rise" } else { "" };
                format!("central differences, the best m of 2–{largest}{by}{end}")
            }
            Chosen::Bilinear(k) => format!("products of {} states, k = {k}", k + 1),
            Chosen::BestBilinear(BestBilinear { largest, accuracy: None }) => {
                format!("products of states, the best k of 2–{largest}")
            }
            Chosen::BestBilinear(BestBilinear { largest, accuracy: Some(accuracy) }) => {
                format!(
                    "products of states, the best k of 2–{largest} for an accuracy of {}",
                    to_significant(accuracy, 6)
                )
            }
        }
    }

    /// Whether it can estimate its error; a series of one term cannot.
    pub fn tells_error(&self) -> bool {
        self.order() != Some(1)
    }

    /// Whether its values belong to the times between the states.
    pub fn is_between(&self) -> bool {
        matches!(self, Chosen::Bilinear(k) if k % 2 == 1)
    }
}

impl<N: Number> Method<N> for Made {
    type Estimator = Either<N>;

    fn estimator(&self, h: &Rational, dimension: usize, context: &N::Context) -> Either<N> {
        match self {
            Made::Central(method) => Either::Central(method.estimator(h, dimension, context)),
            Made::Bilinear(method) => Either::Bilinear(method.estimator(h, dimension, context)),
            Made::BestBilinear(method) => Either::BestBilinear(method.estimator(h, dimension, context)),
        }
    }
}

/// One of the estimators.
pub enum Either<N> {
    /// D_m
    Central(CentralEstimator<N>),
    /// E_k
    Bilinear(BilinearEstimator<N>),
    /// The best E_k.
    BestBilinear(BestBilinearEstimator<N>),
}

impl<N: Number> Estimator<N> for Either<N> {
    fn states(&self) -> usize {
        match self {
            Either::Central(estimator) => estimator.states(),
            Either::Bilinear(estimator) => estimator.states(),
            Either::BestBilinear(estimator) => estimator.states(),
        }
    }

    fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) -> Option<Estimate<'_, N>> {
        match self {
            Either::Central(estimator) => estimator.push(q, p, increments),
            Either::Bilinear(estimator) => estimator.push(q, p, increments),
            Either::BestBilinear(estimator) => estimator.push(q, p, increments),
        }
    }
}
