//! Random and adversarial numbers.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rug::Float;

use super::super::DoubleDouble;
use crate::number::{CorrectlyRounded, Number};

/// Enough for exact sums and products of the numbers here.
pub(super) const BITS: u32 = 420;

pub(super) fn big(x: DoubleDouble) -> Float {
    let (high, low) = x.parts();
    Float::with_val(BITS, high) + low
}

pub(super) fn rounded(x: &Float) -> DoubleDouble {
    let mut rounded = DoubleDouble::zero(&());
    rounded.assign_rounded(x);
    rounded
}

/// A source of numbers.
pub(super) struct Cases(Pcg64Mcg);

impl Cases {
    pub(super) fn new(seed: u64) -> Self {
        Cases(Pcg64Mcg::seed_from_u64(seed))
    }

    pub(super) fn below(&mut self, n: u64) -> u64 {
        self.0.next_u64() % n
    }

    /// 52 bits: random, few, or near a power of two, where relative errors are largest.
    fn significand(&mut self) -> u64 {
        const ALL: u64 = (1 << 52) - 1;
        let bits = self.0.next_u64() & ALL;
        match self.below(8) {
            0 => bits & (ALL << self.below(52)),
            1 => ALL - self.below(8),
            2 => self.below(8),
            3 => bits >> self.below(52),
            _ => bits,
        }
    }

    /// A machine number with an exponent from `least` up to, not including, `end`.
    pub(super) fn machine(&mut self, least: i32, end: i32) -> f64 {
        let exponent = least + self.below((end - least) as u64) as i32;
        let size = f64::from_bits(((1023 + exponent) as u64) << 52 | self.significand());
        if self.below(2) == 0 { size } else { -size }
    }

    /// A double-double whose parts are adjacent, overlap in a tie, or have a gap.
    pub(super) fn number(&mut self, least: i32, end: i32) -> DoubleDouble {
        let high = self.machine(least, end);
        let exponent = (high.to_bits() >> 52 & 2047) as i32 - 1023;
        let half_place = 2f64.powi(exponent - 53);
        let low = match self.below(8) {
            0 => 0.0,
            1 => half_place,
            2 => -half_place,
            3 => self.machine(exponent - 110, exponent - 53),
            _ => self.machine(exponent - 56, exponent - 53),
        };
        let low = [low, low / 2.0, 0.0].into_iter().find(|low| high + low == high);
        DoubleDouble::new(high, low.expect("0 does not change it"))
    }

    pub(super) fn positive(&mut self, least: i32, end: i32) -> DoubleDouble {
        self.number(least, end).absolute()
    }

    /// A number next to −x, or one of its size.
    pub(super) fn partner(&mut self, x: &Float) -> DoubleDouble {
        match self.below(3) {
            0 => rounded(&-Float::with_val(BITS, x)),
            1 => rounded(&(-Float::with_val(BITS, x) * (1.0 + self.machine(-60, 0)))),
            _ => self.number(-20, 20),
        }
    }

    /// A number next to k π/2.
    pub(super) fn near_quarter_turns(&mut self) -> DoubleDouble {
        let bits = self.below(30) as u32;
        let k = self.below(1 << bits) as i32;
        rounded(&(Float::with_val(BITS, rug::float::Constant::Pi) * k / 2_u32))
    }
}
