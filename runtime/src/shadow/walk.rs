//! What the round-off of the steps makes of the modified energy.

use crate::Rational;
use crate::number::{Number, epsilon};

/// The walk that round-off is expected to make, √(Σ kick²), by Brouwer's law: errors of the states are independent, so that the
/// energy goes like the square root of the number of steps (D. Brouwer, Astron. J. 46 (1937) 149).
///
/// A step rounds q and p by c ε|q| and c ε|p| at least, which moves H by U_q δq and T_p δp; T_p is Δq/h, and U_q is −Δp/h.
#[derive(Clone, Debug)]
pub(crate) struct Walk<N> {
    last: Option<(Vec<N>, Vec<N>)>,
    /// (c ε/h)²
    factor: N,
    /// Σ ((Δq p)² + (Δp q)²)
    sum: N,
    x: N,
    y: N,
}

impl<N: Number> Walk<N> {
    pub(crate) fn new(h: &Rational, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        Walk { last: None, factor: kick_factor(&epsilon(context), h, context), sum: zero(), x: zero(), y: zero() }
    }

    /// Takes the next state.
    pub(crate) fn include(&mut self, q: &[N], p: &[N]) {
        let Some((last_q, last_p)) = &mut self.last else {
            self.last = Some((q.to_vec(), p.to_vec()));
            return;
        };
        add_squares(&mut self.sum, [last_q, q], [last_p, p], [&mut self.x, &mut self.y]);
        last_q.iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        last_p.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
    }

    /// The walk over all steps.
    pub(crate) fn expected(&self) -> N {
        let (mut square, mut walk) = (self.sum.clone(), self.sum.clone());
        square.multiply(&self.factor);
        walk.assign_sqrt(&square);
        walk
    }
}

/// Adds Σ ((Δq p)² + (Δp q)²) of a step to the newer ones of these states; the rest is room for intermediate results.
pub(super) fn add_squares<N: Number>(sum: &mut N, [q0, q1]: [&[N]; 2], [p0, p1]: [&[N]; 2], [x, y]: [&mut N; 2]) {
    for (((q0, q1), p0), p1) in q0.iter().zip(q1).zip(p0).zip(p1) {
        for [before, after, rounded] in [[q0, q1, p1], [p0, p1, q1]] {
            x.assign_difference(after, before);
            y.assign_product(x, rounded);
            sum.add_product(y, y);
        }
    }
}

/// (c ε/h)², with ε the distance from 1 to the next number.
///
/// A rounding of x is off by at most half the last place of x, by 1/√12 of it rms; and that place is ε|x|/m for a mantissa m
/// between 1 and 2, of which the mean square with the density 1/(m log 2) is 3ε²x²/(8 log 2). So c² = 1/(32 log 2), c = 0.2123.
pub(super) fn kick_factor<N: Number>(epsilon: &N, h: &Rational, context: &N::Context) -> N {
    let mut factor = epsilon.clone();
    factor.multiply(&N::from_rational(&(Rational::new(2123.into(), 10_000.into()) / h), context));
    let mut square = N::zero(context);
    square.assign_square(&factor);
    square
}
