//! Numbers of 32 digits: unevaluated sums of two machine numbers.

mod arithmetic;
mod constants;
mod decimal;
mod exponential;
mod lanes;
mod machine;
mod nearest;
mod number;
mod polynomial;
mod product;
mod root;
#[cfg(test)]
mod tests;
mod trigonometric;

pub use machine::Machine;

/// A number of about 32 digits: the sum of two machine numbers, of which the second is at most half a last place of the
/// first.
///
/// The machine number is `f64`, or lanes of it. The arithmetic is double-word arithmetic whose bounds are proved; with
/// u = 2⁻⁵³, the relative errors are at most
///
/// | operation | algorithm | bound | largest found |
/// | --- | --- | --- | --- |
/// | a + b, a − b | AccurateDWPlusDW | 3u² + 13u³ | 2.50u² |
/// | a b, a² | DWTimesDW1 | 5u² | 4.48u² |
/// | a / b | DWDivDW2 | 15u² + 56u³ | 7.31u² |
/// | n a, a / n | DWTimesFP2, DWDivFP3; powers of two are exact | 3u² | 2.98u² |
/// | √a | SQRTDWtoDW | 25/8 u² | 3.125u² |
/// | 1/√a | quotient of 1 and the root | 18.2u² | 5.72u² |
/// | exp; log | table of 32 powers, of 47 logarithms; series | 4u²; 14u² | 1.78u²; 2.06u² |
/// | sinh; cosh; tanh | from exp; series | 12u²; 15u²; 29u² | 3.31u²; 2.84u²; 8.33u² |
/// | sin, cos; tan | table of 129 sines; series | 22u²; 42u² | 2.95u²; 5.92u² |
/// | atan; asin; acos | a step of Newton from an `f64` | 38u²; 25u²; 30u² | 4.11u²; 3.02u²; 3.95u² |
/// | n-th root, n > 2 | a step of Halley from an `f64` | 12u² | 2.72u² |
///
/// u² = 2⁻¹⁰⁶ = 1.2e-32. x + a b has an error of at most u² (|x + a b| + 2|x| + 9|a b|) (1 + 20u), of which two thirds
/// were found: the product enters the sum without being rounded to a double word first. AccurateDWPlusDW's first two
/// sums and its Fast2Sums stay exact for
/// |low| ≤ 3.1u |high|, and what it neglects is u times its third sum and u times its fourth.
///
/// Sources: M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous error bounds for basic building blocks of
/// double-word arithmetic", ACM Trans. Math. Softw. 44 (2017) 15; the bound of products from J.-M. Muller, L. Rideau,
/// "Formalization of double-word arithmetic …", ibid. 48 (2022) 9; the root from V. Lefèvre, N. Louvet, J.-M. Muller,
/// J. Picot, L. Rideau, "Accurate calculation of Euclidean norms using double-word arithmetic", ibid. 49 (2023) 1. The
/// bounds of functions are sums of the bounds of their operations. All are tested against MPFR; the last column is from
/// `cargo test --release --features mpfr -p shadowstep --lib double_double -- --ignored --nocapture`, 10⁷ random and
/// adversarial cases.
///
/// The bounds hold where neither the result nor a product of high parts, nor half of it, nor its last place underflows
/// or overflows: for numbers and results between 2⁻⁹⁰⁰ and 2¹⁰²². Below, digits are lost; near 1.8e308 a result may be
/// NaN. Beyond, it is infinite, as in `f64`.
///
/// Errors of products are found by a fused multiply-add where the processor has it, else from halves of 26 bits
/// (Dekker). Both are exact, so that the bits are the same on every machine, but where 2⁻⁹⁶⁹ is above the product.
/// Among the functions, atan, asin, acos and roots of an order above 2 begin with the platform's `f64`.
///
/// ```
/// use shadowstep::number::{DoubleDouble, Number, Real};
///
/// let third = DoubleDouble::from_rational(&shadowstep::exact("1/3").unwrap(), &());
/// assert_eq!(third.to_text(), "0.333333333333333333333333333333332");
/// let mut one = third;
/// one.multiply_integer(3);
/// assert_eq!(one.to_text(), "1.0");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct DoubleDouble<T = f64> {
    high: T,
    low: T,
}

impl<T: Machine> DoubleDouble<T> {
    /// The nearest machine number, and the rest.
    #[inline]
    pub fn parts(self) -> (T, T) {
        (self.high, self.low)
    }

    #[inline(always)]
    fn of((high, low): (T, T)) -> Self {
        DoubleDouble { high, low }
    }

    /// `less` in lanes where a < b, else `otherwise`.
    #[inline(always)]
    fn where_less(a: Self, b: Self, less: Self, otherwise: Self) -> Self {
        DoubleDouble::of(T::where_less(a.parts(), b.parts(), less.parts(), otherwise.parts()))
    }

    #[inline(always)]
    fn every(x: f64) -> Self {
        DoubleDouble { high: T::every(x), low: T::every(0.0) }
    }

    /// |x|, +0 of −0
    #[inline(always)]
    fn absolute(self) -> Self {
        let zero = DoubleDouble::every(0.0);
        let size = DoubleDouble::where_less(self, zero, -self, self);
        DoubleDouble { high: size.high + zero.high, low: size.low }
    }
}
