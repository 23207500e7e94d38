//! How many decimal digits a number is known to.

use num_traits::{ToPrimitive, Zero};

use crate::symbolic::{Fraction, Ratio};

/// The number of decimal digits of which `uncertainty` is one unit, rounded down; `None` for 0.
pub fn digits_of(uncertainty: &impl Ratio) -> Option<u32> {
    if uncertainty.numer().is_zero() {
        return None;
    }
    // bit lengths first: f64 has no room for 1e-400
    let bits = uncertainty.denom().bits() as f64 - uncertainty.numer().bits() as f64;
    let shift = bits as i32;
    let (numer, denom) = (uncertainty.numer(), uncertainty.denom());
    let scaled = if shift >= 0 {
        Fraction::new(numer << shift as usize, denom.clone())
    } else {
        Fraction::new(numer.clone(), denom << (-shift) as usize)
    };
    let log10 = scaled.to_f64().abs().log10() - f64::from(shift) * std::f64::consts::LOG10_2;
    Some((-log10).floor().max(0.0).to_u32().unwrap_or(u32::MAX))
}
