//! States, and tangent vectors beside them, as texts that give the same numbers when they are read.

use num_traits::Zero;
use serde::{Deserialize, Serialize};
use shadowstep::tangent::Growth;
use shadowstep::{Real, Remainders};
use shadowstep_schemes::symbolic::decimal::from_text;

use crate::run::snapshots::Snapshot;

/// A tangent vector with the state that it is beside.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct SavedVector {
    pub(crate) state: SavedState,
    /// The derivatives of the numbers of the state.
    pub(crate) derivatives: SavedState,
    /// By which power of 2 the vector was divided.
    pub(crate) exponent: i64,
    /// [`Growth::parts`]
    pub(crate) growth: Vec<String>,
    /// What the vector is: [`Tangents::combinations`](shadowstep::tangent::Tangents::combinations).
    #[serde(default)]
    pub(crate) combination: Vec<String>,
}

/// A state as texts that give the same numbers when they are read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct SavedState {
    pub(crate) n: i64,
    pub(crate) q: Vec<String>,
    pub(crate) p: Vec<String>,
    /// What the sums of q and p have beyond these.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) q_remainders: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) p_remainders: Vec<String>,
}

/// q and p.
pub(crate) type State<N> = (Vec<N>, Vec<N>);

impl SavedState {
    /// A state; `None` if a number has an exponent that cannot be read.
    pub(crate) fn of<N: Real>(Snapshot { n, q, p, remainders }: &Snapshot<N>) -> Option<SavedState> {
        let text = |x: &N| Some(x.to_text()).filter(|text| number(text, &x.context()).as_ref() == Some(x));
        let texts = |numbers: &[N]| numbers.iter().map(text).collect::<Option<_>>();
        Some(SavedState {
            n: *n,
            q: texts(q)?,
            p: texts(p)?,
            q_remainders: texts(&remainders.q)?,
            p_remainders: texts(&remainders.p)?,
        })
    }

    /// q and p, and their remainders.
    pub(crate) fn numbers<N: Real>(&self, context: &N::Context) -> Option<(State<N>, Remainders<N>)> {
        let numbers = |texts: &[String]| texts.iter().map(|text| number(text, context)).collect::<Option<_>>();
        let remainders = Remainders { q: numbers(&self.q_remainders)?, p: numbers(&self.p_remainders)? };
        Some(((numbers(&self.q)?, numbers(&self.p)?), remainders))
    }
}

impl SavedVector {
    pub(crate) fn growth(&self) -> Option<Growth> {
        Some(Growth::of_parts(doubles(&self.growth)?.try_into().ok()?))
    }

    pub(crate) fn combination(&self) -> Option<Vec<f64>> {
        doubles(&self.combination)
    }
}

fn doubles(texts: &[String]) -> Option<Vec<f64>> {
    texts.iter().map(|text| number(text, &())).collect()
}

/// The number of a text; `None` if it has an exponent that cannot be read.
pub(crate) fn number<N: Real>(text: &str, context: &N::Context) -> Option<N> {
    let exact = from_text(text).ok()?;
    let mut number = N::from_rational(&exact, context);
    // a rational 0 has no sign, a number's 0 has
    if exact.is_zero() && text.starts_with('-') {
        number.negate();
    }
    Some(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::number::{Limbs, Number};

    fn snapshot<N: Real>(q: &[N], p: &[N]) -> Snapshot<N> {
        Snapshot { n: 7, q: q.to_vec(), p: p.to_vec(), remainders: Remainders::default() }
    }

    #[test]
    fn numbers_are_read_with_their_sign() {
        for text in ["-0.0", "0.0", "0.1", "-1e-300", "5e-324", "1.7976931348623157e308"] {
            let x: f64 = text.parse().unwrap();
            let saved = SavedState::of(&snapshot(&[x], &[-x])).unwrap();
            let ((q, p), remainders) = saved.numbers::<f64>(&()).unwrap();
            assert_eq!(remainders, Remainders::default());
            assert_eq!((q[0].to_bits(), p[0].to_bits()), (x.to_bits(), (-x).to_bits()), "{text}");
            let mut third = number::<Limbs<4>>(text, &()).unwrap();
            third.divide_integer(3);
            let saved = SavedState::of(&snapshot(&[third], &[])).unwrap();
            assert_eq!(saved.numbers::<Limbs<4>>(&()).unwrap().0.0, [third]);
        }
    }

    #[test]
    fn numbers_that_cannot_be_read_are_not_saved() {
        let mut tiny = number::<Limbs<2>>("1e-9999", &()).unwrap();
        let same = tiny;
        tiny.multiply(&same);
        assert!(!tiny.is_zero());
        assert_eq!(SavedState::of(&snapshot(&[tiny], &[])), None);
    }
}
