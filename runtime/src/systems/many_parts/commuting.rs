//! A function of variables none of which is the momentum of another: they stay, and their partners change at constant
//! rates.

use shadowstep_schemes::symbolic::PotentialPrograms;

use super::part::{FlowState, Part};
use crate::number::Number;
use crate::systems::formula::FormulaValue;

/// A(x) of some variables x.
pub(super) struct Commuting<N> {
    /// By their index among q and p.
    variables: Vec<usize>,
    function: FormulaValue<N>,
    x: Vec<N>,
    /// A_x and xᵀA_x − 2A
    gradient: Vec<N>,
    rate: N,
    has_rate: bool,
}

impl<N: Number> Commuting<N> {
    pub(super) fn new(variables: Vec<usize>, programs: &PotentialPrograms, context: &N::Context) -> Self {
        let function = FormulaValue::with(programs, Vec::new(), context);
        let [x, gradient] = [(); 2].map(|()| vec![N::zero(context); variables.len()]);
        Commuting { variables, function, x, gradient, rate: N::zero(context), has_rate: false }
    }

    fn evaluate(&mut self, state: &FlowState<'_, N>) {
        let Commuting { variables, function, x, gradient, rate, has_rate } = self;
        x.iter_mut().zip(&*variables).for_each(|(x, index)| x.assign(state.variable(*index)));
        *has_rate = state.is_augmented();
        function.slopes_at(x, gradient, has_rate.then_some(rate));
    }
}

impl<N: Number> Part<N> for Commuting<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        for (x, &index) in self.x.iter_mut().zip(&self.variables) {
            x.assign(if index < q.len() { &q[index] } else { &p[index - q.len()] });
        }
        energy.add(self.function.at(&self.x));
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, continues: bool) {
        if !continues || state.is_augmented() && !self.has_rate {
            self.evaluate(state);
        }
        let count = state.q().len();
        for (&index, slope) in self.variables.iter().zip(&self.gradient) {
            match index < count {
                true => state.subtract_product(index + count, time, slope),
                false => state.add_product(index - count, time, slope),
            }
        }
        state.add_to_beta(time, &self.rate);
    }

    fn is_potential(&self, coordinates: usize) -> bool {
        self.variables.iter().all(|index| *index < coordinates)
    }
}
