//! The programs of the newest formulas: runs of one formula with other parameters derive them once.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::Rational;
use shadowstep_schemes::symbolic::{Graph, Node, PotentialPrograms, Separation};

/// The newest are kept up to this number of characters in all, as the programs are as long as the texts.
const KEPT: usize = 1 << 17;

/// What the programs depend on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Text {
    pub(super) formula: String,
    /// The names of coordinates, momenta or properties.
    pub(super) variables: Vec<String>,
    pub(super) parameters: Vec<String>,
    pub(super) role: Role,
}

impl Text {
    fn length(&self) -> usize {
        self.formula.len() + self.variables.iter().chain(&self.parameters).map(String::len).sum::<usize>()
    }
}

/// What the formula is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Potential,
    Kinetic,
    Pair(Separation),
    /// Without derivatives.
    Value,
    /// The energy of a body: its last variable is the length of those before.
    Body,
}

/// The programs of a formula.
#[derive(Debug)]
pub(super) struct Derived {
    pub(super) programs: PotentialPrograms,
    /// Whether it is a kinetic energy that is at most quadratic.
    pub(super) quadratic: bool,
    /// Whether it is one without linear and constant terms: a drift adds nothing to β.
    pub(super) quadratic_form: bool,
    pub(super) graph: Graph,
    pub(super) node: Node,
    /// The programs of second derivatives, derived when they are asked for.
    pub(super) second: OnceLock<PotentialPrograms>,
}

impl Derived {
    /// The numbers in the formula.
    pub(super) fn numbers(&self) -> Vec<&Rational> {
        self.graph.numbers(self.node)
    }

    /// The programs of second derivatives, which `derive` makes at the first call.
    pub(super) fn second(&self, derive: impl FnOnce(&mut Graph, Node) -> PotentialPrograms) -> &PotentialPrograms {
        self.second.get_or_init(|| derive(&mut self.graph.clone(), self.node))
    }
}

static NEWEST: Mutex<VecDeque<(Text, Arc<Derived>)>> = Mutex::new(VecDeque::new());

/// The programs of a formula, which `derive` makes unless they are there.
///
/// # Errors
/// The errors of `derive`.
pub(super) fn derived<E>(text: Text, derive: impl FnOnce(&Text) -> Result<Derived, E>) -> Result<Arc<Derived>, E> {
    let newest = || NEWEST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, derived)) = newest().iter().find(|(known, _)| *known == text) {
        return Ok(Arc::clone(derived));
    }
    let derived = Arc::new(derive(&text)?);
    let mut newest = newest();
    newest.push_front((text, Arc::clone(&derived)));
    let mut length = 0;
    let kept = newest.iter().take_while(|(text, _)| {
        length += text.length();
        length <= KEPT
    });
    let kept = kept.count();
    newest.truncate(kept);
    Ok(derived)
}
