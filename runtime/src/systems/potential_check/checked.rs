//! A potential at a state, with what comparisons of its values need.

use super::comparison::Comparison;
use crate::Rational;
use crate::number::{Real, epsilon};
use crate::systems::potential::Potential;

/// Sums of n terms are known to this many times √n roundings.
const ROUNDINGS: i32 = 100;

/// A potential at a state.
pub(super) struct Checked<'a, N, P: ?Sized> {
    pub(super) potential: &'a mut P,
    pub(super) q: &'a [N],
    pub(super) state: usize,
    pub(super) scratch: Vec<N>,
    pub(super) epsilon: N,
}

impl<'a, N: Real, P: Potential<N> + ?Sized> Checked<'a, N, P> {
    pub(super) fn new(potential: &'a mut P, q: &'a [N], state: usize) -> Self {
        let context = q[0].context();
        let mut scratch = vec![N::zero(&context); potential.scratch()];
        potential.prepare(&mut scratch, &context);
        Checked { potential, q, state, scratch, epsilon: epsilon(&context) }
    }

    /// 100 √n roundings of `size`
    pub(super) fn rounding(&self, size: &N, terms: usize) -> N {
        let mut rounding = size.clone();
        rounding.multiply(&self.epsilon);
        rounding.multiply_integer(ROUNDINGS * (terms as f64).sqrt().ceil() as i32);
        rounding
    }

    /// The comparison at the coordinate where they differ most.
    pub(super) fn check_alike(&self, with_rate: &[N], gradient: &[N]) -> Comparison<N> {
        let mut size = N::zero(&self.epsilon.context());
        let (mut worst, mut most) = (0, size.clone());
        for (i, (a, b)) in with_rate.iter().zip(gradient).enumerate() {
            let mut off = a.clone();
            off.subtract(b);
            off.make_absolute();
            if off > most || !off.is_finite() {
                (worst, most) = (i, off);
            }
            let mut own = b.clone();
            own.make_absolute();
            if own > size {
                size = own;
            }
        }
        let uncertainty = self.rounding(&size, gradient.len());
        let values = (with_rate[worst].clone(), gradient[worst].clone());
        Comparison::new(self.state, Some(worst), values, uncertainty, &size)
    }

    /// A sixteenth of the root mean square of q in each coordinate, or of 1, with signs that look random.
    pub(super) fn direction(&self, seed: u64) -> Vec<N> {
        let mut length = N::zero(&self.epsilon.context());
        self.q.iter().for_each(|q| length.add_product(q, q));
        length.divide_integer(i32::try_from(self.q.len()).unwrap_or(i32::MAX));
        let mut sixteenth = length.clone();
        sixteenth.assign_sqrt(&length);
        if sixteenth == N::zero(&sixteenth.context()) {
            sixteenth = N::from_rational(&Rational::from_integer(1.into()), &sixteenth.context());
        }
        sixteenth.divide_integer(16);
        let mut state = seed;
        let mut signed = |_: &N| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            // 5 to 12 eighths: no two coordinates that cancel for all directions
            let eighths = 5 + (state >> 33) as i32 % 8;
            let mut value = sixteenth.clone();
            value.multiply_integer(if state >> 63 == 0 { eighths } else { -eighths });
            value.divide_integer(8);
            value
        };
        self.q.iter().map(&mut signed).collect()
    }
}
