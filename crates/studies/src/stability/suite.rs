//! What is examined: schemes, a number type, how thoroughly.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use shadowstep::Scheme;
use shadowstep::tables::shipped_names;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::{NamedScheme, scheme};
use shadowstep_schemes::shipped_proved;

/// What is examined.
#[derive(Debug)]
pub struct Suite {
    /// The requested schemes; each case has its own choice if there are none.
    schemes: Vec<Examined>,
    /// The number type of cases that are not about one.
    pub(crate) arithmetic: Arithmetic,
    /// Whether fewer and shorter trials are enough.
    pub(crate) quick: bool,
    /// The shipped schemes, each read when it is needed.
    shipped: BTreeMap<&'static str, OnceLock<Examined>>,
}

/// A scheme with its identity.
#[derive(Debug)]
pub(crate) struct Examined {
    pub(crate) scheme: NamedScheme,
    /// Its name and a hash of its weights.
    pub(crate) identity: String,
}

impl Examined {
    fn new(scheme: NamedScheme) -> Self {
        Examined { identity: scheme.identity(), scheme }
    }

    pub(crate) fn name(&self) -> &str {
        &self.scheme.name
    }

    /// Whether it is for T(p) and U(q) only.
    pub(crate) fn has_gradient_kicks(&self) -> bool {
        self.scheme.scheme.proved().scheme.has_gradient_kicks()
    }

    /// Force evaluations of a step.
    pub(crate) fn evaluations(&self) -> u64 {
        self.scheme.scheme.summary().evaluations as u64
    }
}

impl Suite {
    /// A suite of these schemes, or of each case's own choice if there are none.
    pub fn new(schemes: Vec<NamedScheme>, arithmetic: Arithmetic, quick: bool) -> Suite {
        let shipped = shipped_names().iter().map(|name| (*name, OnceLock::new())).collect();
        Suite { schemes: schemes.into_iter().map(Examined::new).collect(), arithmetic, quick, shipped }
    }

    /// The schemes of a case: the requested ones, or these shipped ones.
    pub(crate) fn schemes_or(&self, names: &[impl AsRef<str>]) -> Vec<&Examined> {
        match &self.schemes[..] {
            [] => names.iter().map(|name| self.shipped(name.as_ref())).collect(),
            own => own.iter().collect(),
        }
    }

    /// The schemes of a case: the requested ones, or all shipped ones for two parts.
    pub(crate) fn schemes_or_all(&self) -> Vec<&Examined> {
        let has_two_parts = |name: &&str| shipped_proved(name).is_some_and(|proved| proved.scheme.inner.is_none());
        self.schemes_or(&shipped_names().into_iter().filter(has_two_parts).collect::<Vec<_>>())
    }

    /// A shipped scheme.
    fn shipped(&self, name: &str) -> &Examined {
        let place = self.shipped.get(name).expect("cases name shipped schemes");
        place.get_or_init(|| Examined::new(scheme(name).expect("shipped schemes are proved")))
    }

    /// One value for a full examination, another for a quick one.
    pub(crate) fn full_or_quick<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }
}
