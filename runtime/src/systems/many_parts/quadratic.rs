//! A quadratic form ½xᵀSx in x = (q, p) of some degrees of freedom: x ← e^{tJS} x, computed once for each t.
//!
//! Increments need E = e^{tJS} − 1, which has no cancellation: its series for a small t, and then by doubling t, E ← E² + 2E.

use shadowstep_symbolic::decimal::from_text;

use super::part::{FlowState, Part};
use crate::Rational;
use crate::number::{AnyLimbs, CorrectlyRounded, Number, Real};
use crate::systems::matrix::{MOST_KEPT, MOST_TERMS, Matrix, add, precision, product, round, scale};

/// The form with the flows over the times that have occurred: a scheme has a few.
pub(super) struct Quadratic<N> {
    freedoms: Vec<usize>,
    matrix: Matrix<Rational>,
    rounded: Matrix<N>,
    known: Vec<(N, Matrix<N>)>,
    x: Vec<N>,
    by: N,
}

impl<N: CorrectlyRounded> Quadratic<N> {
    /// `None` if the numbers have more digits than flows are computed to.
    pub(super) fn new(freedoms: Vec<usize>, matrix: Matrix<Rational>, context: &N::Context) -> Option<Self> {
        precision::<N>(context)?;
        let number = |value: &Rational| N::from_rational(value, context);
        Some(Quadratic {
            rounded: matrix.iter().map(|row| row.iter().map(number).collect()).collect(),
            known: Vec::new(),
            x: vec![N::zero(context); matrix.len()],
            by: N::zero(context),
            freedoms,
            matrix,
        })
    }

    fn flow_over(&mut self, time: &N) -> usize {
        if let Some(index) = self.known.iter().position(|(known, _)| known == time) {
            return index;
        }
        if self.known.len() == MOST_KEPT {
            self.known.clear();
        }
        self.known.push((time.clone(), exponential(&self.matrix, time)));
        self.known.len() - 1
    }
}

impl<N: CorrectlyRounded> Part<N> for Quadratic<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        let Quadratic { freedoms, rounded, x, by, .. } = self;
        let variables = freedoms.iter().map(|i| &q[*i]).chain(freedoms.iter().map(|i| &p[*i]));
        x.iter_mut().zip(variables).for_each(|(x, variable)| x.assign(variable));
        let mut twice = energy.clone();
        twice.assign_zero();
        for (row, left) in rounded.iter().zip(&*x) {
            by.assign_zero();
            row.iter().zip(&*x).for_each(|(s, right)| by.add_product(s, right));
            twice.add_product(left, by);
        }
        twice.divide_integer(2);
        energy.add(&twice);
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, _: bool) {
        let index = self.flow_over(time);
        let Quadratic { freedoms, known, x, by, .. } = self;
        let count = state.q().len();
        let variables = || freedoms.iter().copied().chain(freedoms.iter().map(|i| i + count));
        x.iter_mut().zip(variables()).for_each(|(x, variable)| x.assign(state.variable(variable)));
        for (row, variable) in known[index].1.iter().zip(variables()) {
            by.assign_zero();
            row.iter().zip(&*x).for_each(|(e, x)| by.add_product(e, x));
            state.add(variable, by);
        }
    }
}

/// e^{tJS} − 1, computed in more digits and rounded once.
fn exponential<N: CorrectlyRounded>(form: &Matrix<Rational>, time: &N) -> Matrix<N> {
    let count = precision::<N>(&time.context()).expect("it was checked with the form");
    // the decimal reads back to the same number, thus differs by less than its rounding
    let Ok(exact) = from_text(&time.to_text()) else {
        // a time that is infinite or NaN: so are all coordinates after it
        return vec![vec![time.clone(); form.len()]; form.len()];
    };
    // tJS: the rows of p, and then those of q with the other sign
    let number = |value: Rational| AnyLimbs::from_rational(&(value * &exact), &count);
    let (of_q, of_p) = form.split_at(form.len() / 2);
    let falling = of_q.iter().map(|row| row.iter().map(|s| number(-s)).collect());
    let mut argument: Matrix<AnyLimbs> =
        of_p.iter().map(|row| row.iter().map(|s| number(s.clone())).collect()).chain(falling).collect();
    let norm = argument.iter().map(|row| row.iter().map(|x| x.to_f64().abs()).sum::<f64>()).fold(0.0, f64::max);
    let halvings = if norm.is_finite() { (norm * 16.0).max(1.0).log2().ceil() as u32 } else { 0 };
    for _ in 0..halvings {
        argument.iter_mut().flatten().for_each(|x| x.divide_integer(2));
    }
    let mut sum = argument.clone();
    let mut term = argument.clone();
    for k in 2..MOST_TERMS {
        // a term is less than 1/16 of the one before
        term = product(&term, &argument, count);
        term.iter_mut().flatten().for_each(|x| x.divide_integer(k));
        add(&mut sum, &term);
        let largest = term.iter().flatten().map(AnyLimbs::log10_abs).fold(f64::NEG_INFINITY, f64::max);
        if largest < -f64::from(count.bits()) * std::f64::consts::LOG10_2 {
            break;
        }
    }
    for _ in 0..halvings {
        let square = product(&sum, &sum, count);
        scale(&mut sum, 2);
        add(&mut sum, &square);
    }
    round(&sum, &N::zero(&time.context()))
}
