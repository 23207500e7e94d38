//! Stumpff's functions c₀, c₁, c₂, c₃ in any number type.

use crate::Rational;
use crate::number::Number;
use crate::number::scaled;

/// c_k(z) = Σ (−z)ⁿ/(2n + k)!, n = 0, 1, …: c₀ = cos √z and c₁ = sin √z/√z where z > 0, cosh and sinh where z < 0.
///
/// z is divided by 4 until the series are short, and c₀ … c₃ are doubled back: c₃(4z) = (c₂ + c₀c₃)/4, c₂(4z) = c₁²/2,
/// c₁(4z) = c₀c₁; with c₀ = 1 − z c₂ at each z, as 2c₀² − 1 would lose two bits each time. (K. Stumpff, Himmelsmechanik
/// I, 1959; J. M. A. Danby, Fundamentals of Celestial Mechanics, 2nd ed., 1988, sec. 6.9)
///
/// The first terms are quotients by 6, 12, 20 and 30: 1/6 as an `f64` has an error, the same in each of millions of
/// drifts.
#[derive(Clone, Debug)]
pub(super) struct Stumpff<N> {
    /// c₀ … c₃ of the last z.
    pub(super) c: [N; 4],
    /// 24c₄ and 120c₅, for derivatives.
    pub(super) longer: [N; 2],
    /// c₀ … c₃ of lanes that are done, and 24c₄ and 120c₅, while z of other lanes is divided more often.
    done: ([N; 4], [N; 2]),
    /// 120 (−1)ᵏ/(2k + 7)! of an even k and the next one, and 720 (−1)ᵏ/(2k + 8)! of both; the highest k first.
    coefficients: Vec<[N; 4]>,
    /// The largest |z| whose series are summed.
    largest: f64,
    one: N,
    z: N,
    square: N,
    sums: [N; 4],
}

/// Which terms of the series are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Terms {
    /// All that matter.
    All,
    /// Those that matter for six digits, of z that are not divided.
    Few,
}

impl<N: Number> Stumpff<N> {
    /// For numbers of this number of bits.
    pub(super) fn new(bits: u32, context: &N::Context) -> Self {
        let largest: f64 = if bits <= 53 { 0.9 } else { 1.0 / 16.0 };
        let rational =
            |above: i64, below: &Rational| N::from_rational(&(Rational::from_integer(above.into()) / below), context);
        let zero = || N::zero(context);
        let zeros = || [zero(), zero(), zero(), zero()];
        let mut coefficients = Vec::new();
        let mut factorial = Rational::from_integer(5040.into()); // (2k + 7)!
        // bits of the largest term that is left out of 6c₃: z^(k + 2) 6/(2k + 7)!
        let (mut k, mut left_out) = (0_i64, 2.0 * largest.log2() - 840_f64.log2());
        while left_out > -f64::from(bits) - 2.0 || k == 0 {
            let mut group = zeros();
            for i in 0..2 {
                let sign = if i == 0 { 1 } else { -1 };
                group[i] = rational(sign * 120, &factorial);
                factorial *= Rational::from_integer((2 * k + 8).into());
                group[2 + i] = rational(sign * 720, &factorial);
                factorial *= Rational::from_integer((2 * k + 9).into());
                left_out += largest.log2() - (((2 * k + 8) * (2 * k + 9)) as f64).log2();
                k += 1;
            }
            coefficients.insert(0, group);
        }
        let one = rational(1, &Rational::from_integer(1.into()));
        let longer = || [zero(), zero()];
        let done = (zeros(), longer());
        Stumpff {
            c: zeros(),
            longer: longer(),
            done,
            coefficients,
            largest,
            one,
            z: zero(),
            square: zero(),
            sums: zeros(),
        }
    }

    /// Whether the series of z converge at once.
    #[inline(always)]
    pub(super) fn is_small(&self, z: f64) -> bool {
        z.abs() <= self.largest
    }

    /// How often z is divided by 4: not at all if it is NaN.
    #[inline(always)]
    fn quarterings(&self, z: &N, lane: usize) -> u32 {
        let (m, n) = z.lane(lane);
        let mut size = scaled(m, n).abs();
        let mut count = 0;
        while size > self.largest && count < 40 {
            size *= 0.25;
            count += 1;
        }
        count
    }

    /// c ← c₀ … c₃ of z, with the bits of each lane that it has alone.
    #[inline(always)]
    pub(super) fn assign(&mut self, z: &N, terms: Terms) {
        if terms == Terms::Few {
            return self.assign_with(z, 0, terms);
        }
        let first = self.quarterings(z, 0);
        if (1..N::LANES).all(|lane| self.quarterings(z, lane) == first) {
            return self.assign_with(z, first, terms);
        }
        self.assign_lanes(z);
    }

    /// Lanes whose z are divided differently often.
    #[cold]
    fn assign_lanes(&mut self, z: &N) {
        for lane in 0..N::LANES {
            let count = self.quarterings(z, lane);
            if (0..lane).any(|earlier| self.quarterings(z, earlier) == count) {
                continue;
            }
            self.assign_with(z, count, Terms::All);
            for other in lane..N::LANES {
                if self.quarterings(z, other) == count {
                    let done = self.done.0.iter_mut().chain(&mut self.done.1);
                    done.zip(self.c.iter().chain(&self.longer)).for_each(|(done, c)| done.assign_lane(other, c));
                }
            }
        }
        std::mem::swap(&mut self.c, &mut self.done.0);
        std::mem::swap(&mut self.longer, &mut self.done.1);
    }

    /// With z divided by 4 so often.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn assign_with(&mut self, z: &N, quarterings: u32, terms: Terms) {
        self.z.assign(z);
        for _ in 0..quarterings {
            self.z.divide_integer(4);
        }
        self.sum_series(terms);
        let [c0, c1, c2, c3] = &mut self.c;
        for _ in 0..quarterings {
            // c₅(4z) = (c₅ + c₄ + c₂c₃)/16, c₄(4z) = (1 + c₁)c₃/8
            let [c4, c5] = &mut self.longer;
            c4.multiply_integer(5);
            c5.add(c4);
            c4.assign_product(c2, c3);
            c4.multiply_integer(120);
            c5.add(c4);
            c5.divide_integer(16);
            c4.assign(c3);
            c4.add_product(c1, c3);
            c4.multiply_integer(3);
            c3.multiply(c0);
            c3.add(c2);
            c3.divide_integer(4);
            c2.assign_square(c1);
            c2.divide_integer(2);
            c1.multiply(c0);
            self.z.multiply_integer(4);
            one_minus(c0, &self.one, &self.z, c2);
        }
    }

    /// c₃ = (1 − z/20 (1 − z Σ₃))/6, c₂ = (1 − z/12 (1 − z/30 (1 − z Σ₂)))/2, c₁ = 1 − z c₃, c₀ = 1 − z c₂
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sum_series(&mut self, terms: Terms) {
        self.sum_tails(terms);
        let [tail3, tail2, factor, product] = &mut self.sums;
        let [c0, c1, c2, c3] = &mut self.c;
        factor.assign(&self.z);
        factor.divide_integer(20);
        one_minus(product, &self.one, &self.z, tail3);
        one_minus(c3, &self.one, factor, product);
        self.longer[1].assign(product);
        c3.divide_integer(6);
        one_minus(product, &self.one, &self.z, tail2);
        factor.assign(&self.z);
        factor.divide_integer(30);
        one_minus(tail2, &self.one, factor, product);
        self.longer[0].assign(tail2);
        factor.assign(&self.z);
        factor.divide_integer(12);
        one_minus(c2, &self.one, factor, tail2);
        c2.divide_integer(2);
        one_minus(c1, &self.one, &self.z, c3);
        one_minus(c0, &self.one, &self.z, c2);
    }

    /// The first two of `sums` ← Σ₃, Σ₂, each from its even and odd terms.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sum_tails(&mut self, terms: Terms) {
        let first = match terms {
            Terms::All => 0,
            Terms::Few => self.coefficients.len() - 1,
        };
        let mut groups = self.coefficients[first..].iter();
        let highest = groups.next().expect("there is one at least");
        for (sum, coefficient) in self.sums.iter_mut().zip(highest) {
            sum.assign(coefficient);
        }
        self.square.assign_square(&self.z);
        for group in groups {
            for (sum, coefficient) in self.sums.iter_mut().zip(group) {
                sum.multiply(&self.square);
                sum.add(coefficient);
            }
        }
        let [even3, odd3, even2, odd2] = &mut self.sums;
        odd3.multiply(&self.z);
        even3.add(odd3);
        odd2.multiply(&self.z);
        even2.add(odd2);
        odd3.assign(even2);
    }
}

/// x ← 1 − a b
#[inline(always)]
fn one_minus<N: Number>(x: &mut N, one: &N, a: &N, b: &N) {
    x.assign(one);
    x.subtract_product(a, b);
}
