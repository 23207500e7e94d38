//! What a kind of split needs of a scheme and of a run, and why something else is refused.

use shadowstep::Scheme as _;

use crate::document::library::{self, NamedScheme, Schemes};
use crate::texts::refusal::{Refusal, Unsupported};

/// What a split needs of a scheme and of a run.
#[derive(Clone, Debug)]
pub(crate) struct Needs {
    /// The class of schemes that move it.
    pub class: Class,
    /// How many parts H has.
    pub parts: usize,
    /// Why it has no gradient kicks; `None` where it has them, or the class has none.
    pub no_gradient_kicks: Option<Unsupported>,
    /// Why its schemes are not processed, if they are not.
    pub no_processor: Option<Unsupported>,
    /// Why there are no ensembles of it, if there are none.
    pub no_ensembles: Option<Refusal>,
}

/// A class of schemes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// All schemes for two parts.
    Quadratic,
    /// Schemes with an order for every T(p).
    EveryKinetic,
    /// Schemes with an order for three parts and more.
    ManyParts,
}

impl Needs {
    /// No more than that a scheme is of this class, for two parts.
    pub(crate) fn of_class(class: Class) -> Self {
        Needs { class, parts: 2, no_gradient_kicks: None, no_processor: None, no_ensembles: None }
    }

    /// The scheme with the steps that are needed: for many parts, those of many parts. The schemes that have been read
    /// keep these.
    ///
    /// # Errors
    /// A scheme that is not valid.
    pub(crate) fn scheme(&self, named: NamedScheme, schemes: &Schemes) -> Result<NamedScheme, Refusal> {
        library::check_inner(&named, self.parts)?;
        let has_gradient_kicks = named.scheme.proved().scheme.has_gradient_kicks();
        library::check_supported(&named, self.no_gradient_kicks, (has_gradient_kicks, "has gradient kicks,"))?;
        match self.class {
            Class::Quadratic => {}
            Class::EveryKinetic => library::check_every_kinetic(&named)?,
            Class::ManyParts => return schemes.for_many_parts(&named),
        }
        let is_processed = !named.scheme.processor().is_empty();
        library::check_supported(&named, self.no_processor, (is_processed, "is a processed scheme, which"))?;
        Ok(named)
    }
}
