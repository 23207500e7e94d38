//! Lanes of `f64` as the machine numbers of a double-double.

use std::array::from_fn;

use super::machine::Machine;
use super::product::from_halves;
use crate::number::Lanes;
use crate::number::instructions;

/// Operations on each lane.
macro_rules! operators {
    ($($Trait:ident $method:ident;)*) => {$(
        impl<const W: usize> std::ops::$Trait for Lanes<W> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                Lanes::of_two(&self, &b, std::ops::$Trait::$method)
            }
        }
    )*};
}

operators! {
    Add add;
    Sub sub;
    Mul mul;
    Div div;
}

impl<const W: usize> std::ops::Neg for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Lanes::of(&self, std::ops::Neg::neg)
    }
}

/// The pair in the lanes where it is chosen, the other one elsewhere.
#[inline(always)]
fn choose<const W: usize>(
    chosen: impl Fn(usize) -> bool,
    (mut high, mut low): (Lanes<W>, Lanes<W>),
    other: (Lanes<W>, Lanes<W>),
) -> (Lanes<W>, Lanes<W>) {
    for i in 0..W {
        let is_chosen = chosen(i);
        high.0[i] = if is_chosen { high.0[i] } else { other.0.0[i] };
        low.0[i] = if is_chosen { low.0[i] } else { other.1.0[i] };
    }
    (high, low)
}

/// Products are computed from halves: which instructions a loop is compiled for is not known here, and without fused
/// multiply-adds a lane would call a function of the C library.
impl<const W: usize> Machine for Lanes<W> {
    const LANES: usize = W;

    #[inline(always)]
    fn in_widest_instructions<R>(work: impl FnOnce() -> R) -> R {
        instructions::widest(work)
    }

    #[inline(always)]
    fn every(x: f64) -> Self {
        Lanes::all(x)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes::of(&self, f64::sqrt)
    }

    #[inline(always)]
    fn two_product(self, b: Self) -> (Self, Self) {
        let product = self * b;
        (product, Lanes::of_three(&self, &b, &product, from_halves))
    }

    #[inline(always)]
    fn if_finite(test: Self, pair: (Self, Self), plain: Self) -> (Self, Self) {
        choose(|i| test.0[i].is_finite(), pair, (plain, Lanes::all(0.0)))
    }

    #[inline(always)]
    fn where_less(a: (Self, Self), b: (Self, Self), less: (Self, Self), otherwise: (Self, Self)) -> (Self, Self) {
        choose(|i| (a.0.0[i], a.1.0[i]) < (b.0.0[i], b.1.0[i]), less, otherwise)
    }

    fn each<const N: usize>(
        pair: (Self, Self),
        functions: impl Fn((f64, f64)) -> [(f64, f64); N],
    ) -> [(Self, Self); N] {
        let results: [[(f64, f64); N]; W] = from_fn(|i| functions((pair.0.0[i], pair.1.0[i])));
        from_fn(|n| (Lanes(from_fn(|i| results[i][n].0)), Lanes(from_fn(|i| results[i][n].1))))
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        self.0[lane] = value;
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        self.0.into_iter().all(f64::is_finite)
    }
}
