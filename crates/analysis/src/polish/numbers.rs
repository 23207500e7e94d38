//! Numbers in messages.

/// `1.6e-15`, beyond the range of f64 too.
pub fn power_of_ten(log10: f64) -> String {
    if log10 == f64::NEG_INFINITY {
        return "0".to_owned();
    }
    format!("{:.1}e{}", 10_f64.powf(log10 - log10.floor()), log10.floor())
}
