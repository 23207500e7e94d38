//! Products of an `f64` and a power of two.

/// x 2ⁿ, with one rounding; with more where it is subnormal.
#[inline(always)]
pub(crate) fn scaled(x: f64, n: i64) -> f64 {
    if n == 0 || x == 0.0 {
        return x;
    }
    let n = n.clamp(-2200, 2200) as i32; // beyond, x overflows or underflows anyway
    let quarter = 2_f64.powi(n / 4); // no factor overflows or underflows
    x * quarter * quarter * quarter * 2_f64.powi(n - n / 4 * 3)
}
