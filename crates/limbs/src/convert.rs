//! From and to other numbers.

use crate::Limbs;

impl<const L: usize> Limbs<L> {
    /// The number nearest to ± m 2^exponent, where m = Σ magnitude\[i\] 2^(64 i) is of any size. With `more`, some part
    /// of a unit of m is to be added to it before rounding: enough for quotients and roots whose remainder is not 0.
    ///
    /// ```
    /// use shadowstep_limbs::Limbs;
    ///
    /// assert_eq!(Limbs::<2>::from_magnitude(true, &[3], -2, false).to_f64(), -0.75);
    /// ```
    pub fn from_magnitude(negative: bool, magnitude: &[u64], exponent: i64, more: bool) -> Self {
        let Some(highest) = magnitude.iter().rposition(|limb| *limb != 0) else {
            return Limbs { negative, ..Self::ZERO };
        };
        let zeros = magnitude[highest].leading_zeros();
        let limb = |from_top: usize| if from_top <= highest { magnitude[highest - from_top] } else { 0 };
        let shifted = |i: usize| limb(i) << zeros | limb(i + 1) >> 1 >> (63 - zeros);
        let mantissa = std::array::from_fn(|i| shifted(L - 1 - i));
        let rest = magnitude[..(highest + 1).saturating_sub(L + 1)].iter().any(|limb| *limb != 0);
        let below = shifted(L) | u64::from(rest || more);
        // the exponent in two steps: it may be out of range
        let bits = 64 * (highest as i64 + 1) - i64::from(zeros);
        let rounded = Self::rounded(negative, 0, mantissa, below);
        Self::in_range(
            negative,
            (exponent.saturating_add(bits)).saturating_add(rounded.exponent.into()),
            rounded.mantissa,
        )
    }

    /// The nearest `f64`, ties to even; infinite where that overflows.
    ///
    /// ```
    /// use shadowstep_limbs::Limbs;
    ///
    /// assert_eq!((&Limbs::<4>::ONE / &Limbs::from(3)).to_f64(), 1.0 / 3.0);
    /// ```
    pub fn to_f64(&self) -> f64 {
        let sign = if self.negative { -1.0 } else { 1.0 };
        if !self.is_regular() {
            return match self {
                _ if self.is_zero() => 0.0 * sign,
                _ if self.is_infinite() => f64::INFINITY * sign,
                _ => f64::NAN,
            };
        }
        // the bits of the significand that the f64 has: 53, fewer below 2^-1022; rounded as an integer
        let bits = (self.exponent.saturating_add(1074)).clamp(-1, 53);
        if self.exponent > 1024 || bits < 0 {
            return if bits < 0 { 0.0 * sign } else { f64::INFINITY * sign };
        }
        let rest = self.mantissa[..L - 1].iter().any(|limb| *limb != 0);
        let wide = u128::from(self.mantissa[L - 1]) << 62 | u128::from(rest); // < 2^126
        let shift = 126 - bits as u32;
        let (whole, part, half) = ((wide >> shift) as u64, wide & ((1 << shift) - 1), 1 << (shift - 1));
        let integer = whole + u64::from(part > half || part == half && whole & 1 != 0);
        integer as f64 * power(self.exponent - bits) * sign
    }

    /// Significand in [1/2, 1) and exponent of 2, whose product is the number to 53 bits; 0, infinities and NaN
    /// themselves with exponent 0.
    pub fn to_f64_exponent(&self) -> (f64, i32) {
        match self.exponent() {
            Some(exponent) => (Limbs { exponent: 0, ..*self }.to_f64(), exponent),
            None => (self.to_f64(), 0),
        }
    }
}

/// 2^exponent for exponents from −1074 to 1023.
fn power(exponent: i32) -> f64 {
    if exponent >= -1022 {
        f64::from_bits(((exponent + 1023) as u64) << 52)
    } else {
        f64::from_bits(1 << (exponent + 1074))
    }
}

impl<const L: usize> From<i64> for Limbs<L> {
    fn from(n: i64) -> Self {
        Self::from_magnitude(n < 0, &[n.unsigned_abs()], 0, false)
    }
}

impl<const L: usize> From<i32> for Limbs<L> {
    fn from(n: i32) -> Self {
        Self::from(i64::from(n))
    }
}

impl<const L: usize> From<f64> for Limbs<L> {
    /// The same number.
    fn from(x: f64) -> Self {
        let (negative, field) = (x.is_sign_negative(), (x.to_bits() >> 52 & 0x7ff) as i64);
        let fraction = x.to_bits() & ((1 << 52) - 1);
        match field {
            0x7ff if fraction != 0 => Self::NAN,
            0x7ff => Limbs { negative, ..Self::INFINITY },
            0 => Self::from_magnitude(negative, &[fraction], -1074, false),
            _ => Self::from_magnitude(negative, &[fraction | 1 << 52], field - 1075, false),
        }
    }
}

impl<const L: usize> Limbs<L> {
    /// The mantissa, lowest limb first, of a finite number: |x| = Σ mantissa\[i\] 2^(64 i) · 2^(exponent − 64 L).
    pub fn mantissa(&self) -> &[u64; L] {
        &self.mantissa
    }

    /// The nearest number of another number of limbs.
    pub fn resized<const M: usize>(&self) -> Limbs<M> {
        if !self.is_regular() {
            return Limbs { negative: self.negative, ..Limbs::of_kind(false, self.exponent) };
        }
        let mantissa = crate::newton::top(&self.mantissa);
        if M >= L {
            return Limbs { mantissa, exponent: self.exponent, negative: self.negative };
        }
        let rest = self.mantissa[..(L - M).saturating_sub(1)].iter().any(|limb| *limb != 0);
        Limbs::rounded(
            self.negative,
            self.exponent,
            mantissa,
            self.mantissa[(L - 1).saturating_sub(M)] | u64::from(rest),
        )
    }
}

impl<const L: usize> std::fmt::Debug for Limbs<L> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let sign = if self.negative { "-" } else { "" };
        match self.exponent() {
            Some(exponent) => write!(f, "{sign}{:016x?}e{exponent}", self.mantissa),
            None => write!(f, "{:?}", self.to_f64()),
        }
    }
}
