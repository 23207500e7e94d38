//! A step of the harmonic oscillator as a matrix.

use num_traits::{One, Zero};
use shadowstep::Rational;
use shadowstep::number::{Limbs, Number};
use shadowstep::tables::TableScheme;
use shadowstep_schemes::MapKind;

/// 115 digits.
type Digits = Limbs<6>;

/// The matrix of a step with ω = 1 at 115 digits: q ← aq + bp, p ← cq + dp.
pub(crate) struct LinearStep {
    a: Digits,
    b: Digits,
    c: Digits,
    d: Digits,
}

impl LinearStep {
    pub(crate) fn of(scheme: &TableScheme, h: &Rational) -> LinearStep {
        let [one, zero] = [Rational::one(), Rational::zero()].map(|value| Digits::from_rational(&value, &()));
        let mut matrix = LinearStep { a: one, b: zero, c: zero, d: one };
        for map in scheme.proved().scheme.maps() {
            let weight = Digits::from_rational(&(h.pow(map.kind.power() as i32) * &map.weight), &());
            let LinearStep { a, b, c, d } = &mut matrix;
            match map.kind {
                MapKind::Kick => {
                    c.subtract_product(&weight, a);
                    d.subtract_product(&weight, b);
                }
                MapKind::GradientKick => {
                    // twice
                    for _ in 0..2 {
                        c.add_product(&weight, a);
                        d.add_product(&weight, b);
                    }
                }
                MapKind::Drift => {
                    a.add_product(&weight, c);
                    b.add_product(&weight, d);
                }
            }
        }
        matrix
    }

    /// arcosh(|tr|/2), 0 if it is stable.
    pub(crate) fn growth(&self) -> f64 {
        let mut half = self.a;
        Number::add(&mut half, &self.d);
        half.divide_integer(2);
        half.make_absolute();
        let one = Digits::from_rational(&Rational::one(), &());
        Number::subtract(&mut half, &one);
        // arcosh(1 + x) = 2 arsinh √(x/2)
        let x = half.to_f64();
        if x > 0.0 { 2.0 * (x / 2.0).sqrt().asinh() } else { 0.0 }
    }

    /// Half of the trace: cos φ for a step that turns by φ.
    pub(crate) fn cosine(&self) -> f64 {
        (self.a.to_f64() + self.d.to_f64()) / 2.0
    }

    /// c q² + (d − a) q p − b p², which the step conserves, with the sign that makes it positive where the step is
    /// stable.
    pub(crate) fn invariant(&self, q: f64, p: f64) -> f64 {
        let [a, b, c, d] = [&self.a, &self.b, &self.c, &self.d].map(|entry| entry.to_f64());
        (c * q * q + (d - a) * q * p - b * p * p) * -b.signum()
    }

    /// The largest |q| of the ellipse of the invariant through (1, 0).
    pub(crate) fn largest(&self) -> f64 {
        let [a, b, c, d] = [&self.a, &self.b, &self.c, &self.d].map(|entry| entry.to_f64());
        let middle = d - a;
        (4.0 * b * c / (4.0 * b * c + middle * middle)).abs().sqrt()
    }
}
