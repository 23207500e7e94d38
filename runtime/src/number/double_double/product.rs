//! The rounding error of a product: exact in either way, so that its bits do not depend on the processor.

/// a b − p, where p = a b is rounded, exactly.
///
/// By a fused multiply-add where the processor has it: where it is known at compile time, by [`f64::mul_add`]; else by
/// the one instruction, as `mul_add` would call a function of the C library.
#[inline(always)]
pub(super) fn error_of_product(a: f64, b: f64, product: f64) -> f64 {
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        return a.mul_add(b, -product);
    }
    #[cfg(all(target_arch = "x86_64", not(miri)))]
    if std::arch::is_x86_feature_detected!("fma") {
        return fused_by_instruction(a, b, product);
    }
    from_halves(a, b, product)
}

#[cfg(all(target_arch = "x86_64", not(miri)))]
#[expect(unsafe_code, reason = "one arithmetic instruction, on processors that have it")]
#[inline(always)]
fn fused_by_instruction(a: f64, b: f64, product: f64) -> f64 {
    let mut error = a;
    // SAFETY: the only caller has found that the processor has the instruction, which touches no memory.
    unsafe {
        std::arch::asm!(
            "vfmsub213sd {a}, {b}, {p}",
            a = inout(xmm_reg) error,
            b = in(xmm_reg) b,
            p = in(xmm_reg) product,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    error
}

/// Dekker's product: of halves of at most 26 bits, so that their products are exact.
#[inline(always)]
pub(super) fn from_halves(a: f64, b: f64, product: f64) -> f64 {
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    ((ah * bh - product) + ah * bl + al * bh) + al * bl
}

/// The nearest number of 26 bits, and the rest, which has at most 26 bits and a sign.
#[inline(always)]
fn halves(a: f64) -> (f64, f64) {
    const LAST_BITS: u64 = (1 << 27) - 1;
    let high = f64::from_bits((a.to_bits().wrapping_add(1 << 26)) & !LAST_BITS);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn halves_and_fused_operations_agree(a: f64, b: f64) {
            let product = a * b;
            prop_assume!(product == 0.0 || (1e-290..1e308).contains(&product.abs()));
            let exact = a.mul_add(b, -product);
            prop_assert_eq!(from_halves(a, b, product), exact);
            prop_assert_eq!(error_of_product(a, b, product), exact);
        }

        #[test]
        fn halves_have_26_bits(bits in 0..f64::MAX.to_bits() - (1 << 27)) {
            let a = f64::from_bits(bits);
            let (high, low) = halves(a);
            prop_assert_eq!(high + low, a);
            prop_assert_eq!(high.to_bits() & ((1 << 27) - 1), 0);
            prop_assert!(low == 0.0 || low.to_bits().trailing_zeros() >= 26 || low.abs() < f64::MIN_POSITIVE);
        }
    }
}
