//! Numbers beside MPFR's of the same bits, and random ones.

use rug::Float;
use rug::Integer;
use rug::float::Round;
use rug::integer::Order;
use shadowstep_limbs::Limbs;

/// The same number.
pub(crate) fn float<const L: usize>(x: &Limbs<L>) -> Float {
    let bits = 64 * L as u32;
    let Some(exponent) = x.exponent() else {
        return Float::with_val(bits, x.to_f64());
    };
    let (mut magnitude, _) = Float::with_val_round(bits, Integer::from_digits(x.mantissa(), Order::Lsf), Round::Zero);
    magnitude >>= bits;
    magnitude <<= exponent;
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// Checks that a result has the bits of MPFR's.
#[track_caller]
pub(crate) fn same<const L: usize, const M: usize>(name: &str, result: &Limbs<L>, expected: &Float, of: &[&Limbs<M>]) {
    let own = float(result);
    let is_same = if own.is_nan() { expected.is_nan() } else { own == *expected };
    let is_same = is_same && (own.is_nan() || own.is_sign_negative() == expected.is_sign_negative());
    assert!(is_same, "{name} of {of:?}:\n{result:?}, that is {own}, but MPFR {expected}");
}

/// A generator of random numbers (splitmix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A number in [1/2, 1): of random bits; of few bits; of long runs of 0 and 1.
    pub(crate) fn mantissa<const L: usize>(&mut self) -> Limbs<L> {
        let mut limbs: [u64; L] = std::array::from_fn(|_| self.next());
        match self.below(6) {
            0 => {
                // a number of bits, the last of which is 1
                let bits = 1 + self.below(64 * L as u64) as usize;
                let zeros = 64 * L - bits;
                for (i, limb) in limbs.iter_mut().enumerate() {
                    let clear = zeros.saturating_sub(64 * i).min(64);
                    *limb = if clear == 64 { 0 } else { *limb >> clear << clear };
                }
                limbs[zeros / 64] |= 1 << (zeros % 64);
            }
            1 | 2 => {
                let (mut bit, mut left) = (1, 0);
                for limb in limbs.iter_mut().rev() {
                    *limb = 0;
                    for i in (0..64).rev() {
                        if left == 0 {
                            let longest = [3, 70, 64 * L as u64][self.below(3) as usize];
                            left = 1 + self.below(longest);
                            bit = 1 - bit;
                        }
                        left -= 1;
                        *limb |= bit << i;
                    }
                }
            }
            _ => {}
        }
        limbs[L - 1] |= 1 << 63;
        Limbs::from_magnitude(false, &limbs, -(64 * L as i64), false)
    }

    /// A number of any sign and exponent, now and then 0 or at the ends of the exponents.
    pub(crate) fn number<const L: usize>(&mut self) -> Limbs<L> {
        let exponent = match self.below(64) {
            0 => return Limbs::from([0.0, -0.0, f64::INFINITY, f64::NAN][self.below(4) as usize]),
            1 => (1 << 30) - 1 - self.below(3) as i32,
            2 => -(1 << 30) + 1 + self.below(3) as i32,
            3 => (1 << 29) + self.below(3) as i32 - 1,
            4 => -(1 << 29) + self.below(3) as i32 - 1,
            5..16 => self.below(2500) as i32 - 1250,
            16..32 => self.distance(L),
            _ => self.below(20) as i32 - 10,
        };
        let number = self.mantissa::<L>().times_power_of_two(exponent);
        if self.below(2) == 0 { -number } else { number }
    }

    /// A difference of exponents at which an operation changes its way.
    pub(crate) fn distance(&mut self, limbs: usize) -> i32 {
        let near = self.below(limbs as u64 + 2) as i32 * 64 + self.below(5) as i32 - 2;
        if self.below(2) == 0 { -near } else { near }
    }

    /// The number itself, or one a few last places away.
    pub(crate) fn neighbour<const L: usize>(&mut self, x: &Limbs<L>) -> Limbs<L> {
        let Some(exponent) = x.exponent() else { return *x };
        let mut limbs = *x.mantissa();
        limbs[0] ^= [1, 2, 3, 1 << 63, u64::MAX][self.below(5) as usize];
        Limbs::from_magnitude(x.is_sign_negative(), &limbs, i64::from(exponent) - 64 * L as i64, false)
    }

    /// An integer of any size.
    pub(crate) fn integer(&mut self) -> i32 {
        self.next() as i32 >> self.below(32)
    }
}
