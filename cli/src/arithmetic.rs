//! The kind of the numbers of a run, and how many digits go with it.

use shadowstep::number::Precision;
use shadowstep_schemes::exact::DIGITS as TABLE_DIGITS;
use shadowstep_schemes::scheme::Held;
use shadowstep_symbolic::Exact;
use shadowstep_symbolic::decimal::{to_significant, to_text};

use crate::complaint::remark;
use crate::library::Named;

/// Digits beyond those of the run, so that values are rounded once only as far as the run can see.
pub(crate) const GUARD_DIGITS: u32 = 20;

/// Irrational values are not computed to more digits.
pub(crate) const MOST_VALUE_DIGITS: u32 = 5000;

/// The most digits of a run.
pub(crate) const MOST_DIGITS: u32 = 100_000;

/// The digits of a run that asks for none.
pub(crate) const DEFAULT_DIGITS: u32 = 120;

/// What else helps where a scheme's weights have too few digits.
pub(crate) const OTHER_SCHEME: &str = "a scheme whose weights are fractions";

/// The significant digits of f64, rounded up.
const DOUBLE_DIGITS: u32 = 16;

/// The kind of the numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Arithmetic {
    Double,
    Digits(u32, Precision),
}

impl Arithmetic {
    pub(crate) fn digits(self) -> u32 {
        match self {
            Arithmetic::Double => DOUBLE_DIGITS,
            Arithmetic::Digits(digits, _) => digits,
        }
    }

    /// The digits of what is given to the run.
    pub(crate) fn value_digits(self) -> u32 {
        self.digits() + GUARD_DIGITS
    }

    /// Whether a value is exact, or has the digits that a run needs.
    pub(crate) fn has_digits_of(self, value: &Exact) -> bool {
        !value.rounded || self.value_digits() <= MOST_VALUE_DIGITS
    }

    /// The exact text of a value that is given to the run, or the digits of an irrational one.
    pub(crate) fn text(self, exact: &Exact) -> String {
        match exact.rounded {
            true => to_significant(&exact.value, self.value_digits() as usize),
            false => to_text(&exact.value),
        }
    }

    /// Refuses more digits than the weights have, in a sentence and with the most that they allow; remarks on an order
    /// that holds to fewer digits than the run has.
    pub(crate) fn suits(self, Named { name, scheme }: &Named) -> Result<(), (String, u32)> {
        let digits = self.digits();
        let proved = scheme.proved();
        let closed_forms = proved.scheme.held == Held::Digits(TABLE_DIGITS) && proved.scheme.table.digits.is_none();
        if closed_forms && digits > TABLE_DIGITS {
            let sentence =
                format!("{name} has irrational weights, held to {TABLE_DIGITS} digits; the run asks for {digits}");
            return Err((sentence, TABLE_DIGITS));
        }
        let order = proved.order();
        if let Some(held) = order.digits.filter(|held| !closed_forms && *held < digits) {
            let order = order.order;
            remark(format_args!("{name} has order {order} to {held} digits only; below that its order is lower"));
        }
        Ok(())
    }
}
