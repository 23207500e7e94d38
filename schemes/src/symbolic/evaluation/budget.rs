//! How much computing formulas may take: numbers have up to 30000 digits, and a document has many formulas.

use std::cell::Cell;

/// A limit of the time that formulas take together, a few seconds on any machine. It is counted, not measured, so that
/// the same text has the same result everywhere: an operation on numbers of b bits counts b², for their common divisors
/// take most of the time, and a function of them counts as a hundred operations.
///
/// ```
/// use shadowstep_schemes::symbolic::{Budget, evaluate_within, parse};
/// use std::collections::BTreeMap;
///
/// let names = BTreeMap::new();
/// let budget = Budget::new(3 * 100 * 1100 * 1100);
/// let value = |text: &str| evaluate_within(&parse(text).unwrap(), &names, 300, &budget);
/// assert!(value("sin(1)").is_ok() && value("cos(1)").is_ok());
/// assert!(value("sin(2) + cos(2)").unwrap_err().to_string().starts_with("this takes too long"));
/// assert!(budget.is_spent());
/// ```
#[derive(Debug)]
pub struct Budget {
    left: Cell<u64>,
}

/// Bits squared of the whole budget.
const WHOLE: u64 = 2_000_000_000_000;

impl Default for Budget {
    fn default() -> Self {
        Budget::new(WHOLE)
    }
}

impl Budget {
    /// A budget of this many bits squared.
    pub fn new(work: u64) -> Self {
        Budget { left: Cell::new(work) }
    }

    /// Whether nothing is left.
    pub fn is_spent(&self) -> bool {
        self.left.get() == 0
    }

    /// Takes the cost of some operations on numbers of this length; false if that is more than is left.
    pub(crate) fn take(&self, operations: u64, bits: u64) -> bool {
        let cost = bits.saturating_mul(bits).saturating_mul(operations);
        let left = self.left.get().checked_sub(cost);
        self.left.set(left.unwrap_or(0));
        left.is_some()
    }
}
