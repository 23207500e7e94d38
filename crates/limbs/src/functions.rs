//! Elementary functions, computed with at least one limb more than the number has and then rounded.

mod angle;
mod constants;
mod exponential;
mod fraction;
mod logarithm;
mod series;
mod tables;
mod trigonometric;

use crate::Limbs;
use crate::newton::top;

/// The functions of numbers of a width, and only of some widths.
trait Functions: Sized {
    fn exp(&self) -> Self;
    fn log(&self) -> Self;
    fn sin_cos(&self) -> (Self, Self);
    fn tan(&self) -> Self;
    fn sinh(&self) -> Self;
    fn cosh(&self) -> Self;
    fn tanh(&self) -> Self;
    fn atan(&self) -> Self;
    fn asin(&self) -> Self;
    fn acos(&self) -> Self;
    fn root(&self, n: u32) -> Self;
}

macro_rules! compiled {
    ($($width:literal)*) => {$(
        #[rustfmt::skip]
        impl Functions for Limbs<$width> { precompiled! {
            fn exp(&self) -> Self { exponential::exp(self) }
            fn log(&self) -> Self { logarithm::log(self) }
            fn sin_cos(&self) -> (Self, Self) { trigonometric::sin_cos(self) }
            fn tan(&self) -> Self { trigonometric::tan(self) }
            fn sinh(&self) -> Self { exponential::sinh(self) }
            fn cosh(&self) -> Self { exponential::cosh(self) }
            fn tanh(&self) -> Self { exponential::tanh(self) }
            fn atan(&self) -> Self { angle::atan(self) }
            fn asin(&self) -> Self { angle::asin(self) }
            fn acos(&self) -> Self { angle::acos(self) }
            fn root(&self, n: u32) -> Self { logarithm::root(self, n) }
        } }
    )*};
}

compiled! { 3 4 5 6 8 10 13 17 }

/// Calls a function of the smallest width above L.
macro_rules! widened {
    ($narrow:ident, $function:ident($x:expr $(, $n:expr)?)) => {
        match L {
            2 => $narrow(Functions::$function(&$x.resized::<3>() $(, $n)?)),
            3 => $narrow(Functions::$function(&$x.resized::<4>() $(, $n)?)),
            4 => $narrow(Functions::$function(&$x.resized::<5>() $(, $n)?)),
            5 => $narrow(Functions::$function(&$x.resized::<6>() $(, $n)?)),
            6 | 7 => $narrow(Functions::$function(&$x.resized::<8>() $(, $n)?)),
            8 | 9 => $narrow(Functions::$function(&$x.resized::<10>() $(, $n)?)),
            10..=12 => $narrow(Functions::$function(&$x.resized::<13>() $(, $n)?)),
            _ => $narrow(Functions::$function(&$x.resized::<17>() $(, $n)?)),
        }
    };
}

fn one<const W: usize, const L: usize>(x: Limbs<W>) -> Limbs<L> {
    x.resized()
}

fn both<const W: usize, const L: usize>((x, y): (Limbs<W>, Limbs<W>)) -> (Limbs<L>, Limbs<L>) {
    (x.resized(), y.resized())
}

/// Elementary functions of up to 16 limbs. They are computed with one limb more, or some, and then rounded: the error
/// is less than (1/2 + 2^-20) ulp, so that nearly all results are correctly rounded.
impl<const L: usize> Limbs<L> {
    /// e^x
    pub fn exp(&self) -> Self {
        widened!(one, exp(self))
    }

    /// The natural logarithm: NaN for x < 0.
    pub fn log(&self) -> Self {
        widened!(one, log(self))
    }

    /// sin x; NaN for |x| ≥ 2^65536.
    pub fn sin(&self) -> Self {
        self.sin_cos().0
    }

    /// cos x; NaN for |x| ≥ 2^65536.
    pub fn cos(&self) -> Self {
        self.sin_cos().1
    }

    /// sin x and cos x, for little more than the price of one; NaN for |x| ≥ 2^65536.
    pub fn sin_cos(&self) -> (Self, Self) {
        widened!(both, sin_cos(self))
    }

    /// tan x; NaN for |x| ≥ 2^65536.
    pub fn tan(&self) -> Self {
        widened!(one, tan(self))
    }

    /// sinh x
    pub fn sinh(&self) -> Self {
        widened!(one, sinh(self))
    }

    /// cosh x
    pub fn cosh(&self) -> Self {
        widened!(one, cosh(self))
    }

    /// tanh x
    pub fn tanh(&self) -> Self {
        widened!(one, tanh(self))
    }

    /// arctan x, from −π/2 to π/2
    pub fn atan(&self) -> Self {
        widened!(one, atan(self))
    }

    /// arcsin x, from −π/2 to π/2; NaN for |x| > 1.
    pub fn asin(&self) -> Self {
        widened!(one, asin(self))
    }

    /// arccos x, from 0 to π; NaN for |x| > 1.
    pub fn acos(&self) -> Self {
        widened!(one, acos(self))
    }

    /// The real root of an order n ≥ 1; of x < 0 only if n is odd, else NaN.
    pub fn root(&self, n: u32) -> Self {
        widened!(one, root(self, n))
    }

    /// π
    pub fn pi() -> Self {
        let pi = fraction::number::<17>(&top(&constants::QUARTER_PI), 2);
        pi.resized()
    }
}
