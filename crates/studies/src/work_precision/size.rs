//! The sizes of errors: beyond the range of `f64`, as runs of many digits have them.

use std::fmt;

use serde::{Deserialize, Serialize};
use shadowstep::Real;

/// A size |x| ≥ 0 by its logarithm, so that 1e-400 is not 0. It is displayed with three digits.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(into = "Option<f64>", from = "Option<f64>")]
pub struct Size {
    log10: f64,
}

impl Size {
    /// 0
    pub(crate) const ZERO: Size = Size { log10: f64::NEG_INFINITY };

    /// Larger than all others: of what is not finite.
    pub(crate) const INFINITE: Size = Size { log10: f64::MAX };

    /// |x|; infinite where x is infinite or NaN.
    pub fn of<N: Real>(x: &N) -> Size {
        if x.is_finite() { Size { log10: x.log10_abs() } } else { Size::INFINITE }
    }

    /// 10^x
    pub fn power_of_ten(log10: f64) -> Size {
        Size { log10 }
    }

    /// log₁₀ of it; −∞ for 0.
    pub fn log10(self) -> f64 {
        self.log10
    }

    /// Whether it is neither infinite nor NaN.
    pub fn is_finite(self) -> bool {
        self.log10 < f64::MAX
    }

    /// The size times 10^log10.
    #[must_use]
    pub(crate) fn times_power_of_ten(self, log10: f64) -> Size {
        Size { log10: self.log10 + log10 }
    }
}

/// JSON has no −∞: 0 is null.
impl From<Size> for Option<f64> {
    fn from(size: Size) -> Self {
        (size.log10 > f64::NEG_INFINITY).then_some(size.log10)
    }
}

impl From<Option<f64>> for Size {
    fn from(log10: Option<f64>) -> Self {
        Size { log10: log10.unwrap_or(f64::NEG_INFINITY) }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.log10 == f64::NEG_INFINITY {
            return f.write_str("0");
        }
        if !self.is_finite() {
            return f.write_str("not finite");
        }
        let mut exponent = self.log10.floor();
        let mut digits = (10_f64.powf(self.log10 - exponent) * 100.0).round() / 100.0;
        if digits >= 10.0 {
            (digits, exponent) = (digits / 10.0, exponent + 1.0);
        }
        write!(f, "{digits:.2}e{exponent}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_three_digits() {
        let texts = [-400.0, -0.0001, 3.0, f64::NEG_INFINITY].map(|log10| Size::power_of_ten(log10).to_string());
        assert_eq!(texts, ["1.00e-400", "1.00e0", "1.00e3", "0"]);
        assert_eq!(Size::of(&-0.0123_f64).to_string(), "1.23e-2");
    }

    #[test]
    fn sizes_keep_their_bits_in_json() {
        for size in [Size::of(&1.0e-300_f64), Size::ZERO] {
            let json = serde_json::to_string(&size).unwrap();
            assert_eq!(serde_json::from_str::<Size>(&json).unwrap(), size);
        }
    }
}
