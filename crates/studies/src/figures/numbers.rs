//! Numbers as texts: with all their digits, and for people.

use shadowstep::Real;
use shadowstep::number::Limbs;

/// A number with more digits than any run has.
pub(crate) type Wide = Limbs<17>;

/// log₁₀|x| of a number in a text; −∞ for 0.
pub(crate) fn log10(text: &str) -> f64 {
    number(text).log10_abs()
}

/// The number in a text.
pub(crate) fn number(text: &str) -> Wide {
    text.parse().expect("the texts are those of numbers")
}

/// 1.2e-34 from its log₁₀.
pub(crate) fn power(log10: f64) -> String {
    if !log10.is_finite() {
        return if log10 == f64::NEG_INFINITY { "0" } else { "–" }.to_owned();
    }
    let exponent = log10.floor();
    let digits = format!("{:.2}", 10_f64.powf(log10 - exponent));
    if digits == "10.00" { format!("1.00e{}", exponent + 1.0) } else { format!("{digits}e{exponent}") }
}

/// Three digits and a power of ten.
pub(crate) fn scientific(value: f64) -> String {
    power(value.abs().log10())
}

/// A number with this number of decimals.
pub(crate) fn decimal(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}")
}
