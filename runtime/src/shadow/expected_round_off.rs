//! What the round-off of the steps makes of the modified energy.

use std::collections::VecDeque;

use crate::Rational;
use crate::number::{Number, epsilon};

/// Second differences need this number of states.
const STATES: usize = 3;

/// The walk that round-off is expected to make, √(Σ kick²), by Brouwer's law: errors of the states are independent, so
/// that the energy goes like the square root of the number of steps (D. Brouwer, Astron. J. 46 (1937) 149).
///
/// A step rounds q and p by c ε|q| and c ε|p| at least, which moves H by U_q δq and T_p δp; T_p is Δq/h, and U_q is
/// −Δp/h. In compensated sums the increments are rounded.
#[derive(Clone, Debug)]
pub(crate) struct ExpectedRoundOff<N> {
    compensated: bool,
    /// The newest states, the newest one last.
    states: VecDeque<(Vec<N>, Vec<N>)>,
    /// (c ε/h)²
    factor: N,
    /// Σ ((Δq p)² + (Δp q)²)
    sum: N,
    x: N,
    y: N,
}

impl<N: Number> ExpectedRoundOff<N> {
    pub(crate) fn new(h: &Rational, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        ExpectedRoundOff {
            compensated: false,
            states: VecDeque::new(),
            factor: kick_factor(&epsilon(context), h, context),
            sum: zero(),
            x: zero(),
            y: zero(),
        }
    }

    /// Whether the sums are compensated.
    pub(crate) fn set_compensated(&mut self, compensated: bool) {
        self.compensated = compensated;
    }

    /// Takes the next state.
    pub(crate) fn include(&mut self, q: &[N], p: &[N]) {
        if self.states.len() < STATES {
            self.states.push_back((q.to_vec(), p.to_vec()));
        } else {
            self.states.rotate_left(1);
            let (own_q, own_p) = &mut self.states[STATES - 1];
            own_q.iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
            own_p.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        }
        let ExpectedRoundOff { compensated, states, sum, x, y, .. } = self;
        match (states.iter().rev().collect::<Vec<_>>().as_slice(), *compensated) {
            ([(q1, p1), (q0, p0), ..], false) => add_squares(sum, [q0, q1], [p0, p1], [x, y]),
            ([(q2, p2), (q1, p1), (q0, p0)], true) => {
                add_squares_of_increments(sum, [q0, q1, q2], [p0, p1, p2], [x, y]);
            }
            _ => {}
        }
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

/// Adds Σ (2 (Δq Δp)² + (δ²q p)² + (δ²p q)²) in the same way: Δq and Δp are rounded by cε of them, and the force is
/// that at q rounded by cε|q|, which changes it by h U_qq cε q, with h U_qq Δq = −δ²p; so does the drift with p.
pub(super) fn add_squares_of_increments<N: Number>(
    sum: &mut N,
    [q0, q1, q2]: [&[N]; 3],
    [p0, p1, p2]: [&[N]; 3],
    [x, y]: [&mut N; 2],
) {
    for i in 0..q2.len() {
        x.assign_difference(&q2[i], &q1[i]);
        y.assign_difference(&p2[i], &p1[i]);
        x.multiply(y);
        sum.add_product(x, x);
        sum.add_product(x, x);
        for [x0, x1, x2, rounded] in [[&q0[i], &q1[i], &q2[i], &p2[i]], [&p0[i], &p1[i], &p2[i], &q2[i]]] {
            x.assign_sum(x0, x2);
            x.subtract(x1);
            x.subtract(x1);
            x.multiply(rounded);
            sum.add_product(x, x);
        }
    }
}

/// (c ε/h)², with ε the distance from 1 to the next number.
///
/// A rounding of x is off by at most half the last place of x, by 1/√12 of it rms; and that place is ε|x|/m for a
/// mantissa m between 1 and 2, of which the mean square with the density 1/(m log 2) is 3ε²x²/(8 log 2). So c² = 1/(32
/// log 2), c = 0.2123.
pub(super) fn kick_factor<N: Number>(epsilon: &N, h: &Rational, context: &N::Context) -> N {
    let mut factor = epsilon.clone();
    factor.multiply(&N::from_rational(&(Rational::new(2123.into(), 10_000.into()) / h), context));
    let mut square = N::zero(context);
    square.assign_square(&factor);
    square
}
