//! A quadratic form ½xᵀSx in x = (q, p) of some degrees of freedom: x ← e^{tJS} x, computed once for each t.
//!
//! Increments need E = e^{tJS} − 1, which has no cancellation.

use shadowstep_schemes::symbolic::decimal::from_text;

use super::part::{FlowState, Part};
use crate::Rational;
use crate::number::CorrectlyRounded;
use crate::systems::matrix::{Form, MOST_KEPT, Matrix, precision, round};

/// The form with the flows over the times that have occurred: a scheme has a few.
pub(super) struct Quadratic<N> {
    freedoms: Vec<usize>,
    form: Form<N>,
    known: Vec<(N, Matrix<N>)>,
    x: Vec<N>,
    by: N,
}

impl<N: CorrectlyRounded> Quadratic<N> {
    /// `None` if the numbers have more digits than flows are computed to.
    pub(super) fn new(freedoms: Vec<usize>, matrix: Matrix<Rational>, context: &N::Context) -> Option<Self> {
        precision::<N>(context)?;
        Some(Quadratic {
            known: Vec::new(),
            x: vec![N::zero(context); matrix.len()],
            by: N::zero(context),
            freedoms,
            form: Form::new(matrix, context),
        })
    }

    fn flow_over(&mut self, time: &N) -> usize {
        if let Some(index) = self.known.iter().position(|(known, _)| known == time) {
            return index;
        }
        if self.known.len() == MOST_KEPT {
            self.known.clear();
        }
        self.known.push((time.clone(), flow(&mut self.form, time)));
        self.known.len() - 1
    }
}

impl<N: CorrectlyRounded> Part<N> for Quadratic<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        let Quadratic { freedoms, form, x, by, .. } = self;
        let variables = freedoms.iter().map(|i| &q[*i]).chain(freedoms.iter().map(|i| &p[*i]));
        x.iter_mut().zip(variables).for_each(|(x, variable)| x.assign(variable));
        let mut twice = energy.clone();
        twice.assign_zero();
        for (row, left) in form.rounded.iter().zip(&*x) {
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

/// e^{tJS} − 1, computed in more digits and rounded once, with its derivatives.
fn flow<N: CorrectlyRounded>(form: &mut Form<N>, time: &N) -> Matrix<N> {
    let count = precision::<N>(&time.context()).expect("it was checked with the form");
    // the decimal reads back to the same number, thus differs by less than its rounding
    let Ok(exact) = from_text(&time.to_text()) else {
        // a time that is infinite or NaN: so are all coordinates after it
        return vec![vec![time.clone(); form.rounded.len()]; form.rounded.len()];
    };
    let mut flow = round(&form.flow(&exact, count), &N::zero(&time.context()));
    for (k, derivative) in form.derivatives_of_flow(time, count) {
        let pairs = flow.iter_mut().flatten().zip(derivative.iter().flatten());
        pairs.for_each(|(x, derivative)| x.assign_rounded_derivative(k, derivative));
    }
    flow
}
