//! Numbers of many digits that exact results are computed with, before these are rounded to the numbers of a run.

use shadowstep_limbs::Limbs;

use super::Ordered;

/// A number type whose numbers can be rounded to any other.
pub trait Reference: Ordered + 'static {
    /// What makes numbers of at least so many bits; `None` if the type has none.
    fn context_of(bits: u32) -> Option<Self::Context>;

    /// The bits of the significand.
    fn bits(&self) -> u32;

    /// This number with so many bits, where the type has numbers of several sizes; else this number.
    #[must_use]
    fn at_bits(&self, bits: u32) -> Self {
        let _ = bits;
        self.clone()
    }

    /// The number of L limbs nearest to this one.
    fn to_limbs<const L: usize>(&self) -> Limbs<L>;

    /// target ← the number of its precision nearest to this one.
    #[cfg(feature = "mpfr")]
    fn round_to(&self, target: &mut rug::Float);
}

impl<const M: usize> Reference for Limbs<M> {
    fn context_of(bits: u32) -> Option<()> {
        (bits as usize <= 64 * M).then_some(())
    }

    fn bits(&self) -> u32 {
        64 * M as u32
    }

    fn to_limbs<const L: usize>(&self) -> Limbs<L> {
        self.resized()
    }

    #[cfg(feature = "mpfr")]
    fn round_to(&self, target: &mut rug::Float) {
        super::multiprecision::assign_limbs(target, self);
    }
}

#[cfg(feature = "mpfr")]
impl Reference for rug::Float {
    fn context_of(bits: u32) -> Option<super::Precision> {
        super::Precision::bits(bits).ok()
    }

    fn bits(&self) -> u32 {
        self.prec()
    }

    fn at_bits(&self, bits: u32) -> Self {
        rug::Float::with_val(bits, self)
    }

    fn to_limbs<const L: usize>(&self) -> Limbs<L> {
        super::multiprecision::to_limbs(self)
    }

    fn round_to(&self, target: &mut rug::Float) {
        rug::Assign::assign(target, self);
    }
}
