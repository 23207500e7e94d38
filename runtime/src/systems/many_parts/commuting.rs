//! A function of variables none of which is the momentum of another: they stay, and their partners change at constant
//! rates.

use shadowstep_schemes::symbolic::PotentialPrograms;

use super::part::{FlowState, Part};
use crate::number::Number;
use crate::systems::interpreter::Interpreter;

/// A(x) of some variables x.
pub(super) struct Commuting<N> {
    /// By their index among q and p.
    variables: Vec<usize>,
    interpreter: Interpreter<N>,
    registers: Vec<N>,
    x: Vec<N>,
    /// A_x and xᵀA_x − 2A
    gradient: Vec<N>,
    rate: N,
    has_rate: bool,
}

impl<N: Number> Commuting<N> {
    pub(super) fn new(variables: Vec<usize>, programs: &PotentialPrograms, context: &N::Context) -> Self {
        let interpreter = Interpreter::new(programs, Vec::new(), 0);
        let zeros = |count| vec![N::zero(context); count];
        let mut registers = zeros(interpreter.registers());
        interpreter.prepare(&mut registers, context);
        Commuting {
            x: zeros(variables.len()),
            gradient: zeros(variables.len()),
            rate: N::zero(context),
            has_rate: false,
            variables,
            interpreter,
            registers,
        }
    }

    fn evaluate(&mut self, state: &FlowState<'_, N>) {
        let Commuting { variables, interpreter, registers, x, gradient, rate, has_rate } = self;
        x.iter_mut().zip(&*variables).for_each(|(x, index)| x.assign(state.variable(*index)));
        *has_rate = state.is_augmented();
        let outputs = match *has_rate {
            true => interpreter.gradient_and_rate(x, registers),
            false => interpreter.gradient(x, registers),
        };
        let (own, last) = outputs.split_at_mut(gradient.len());
        gradient.swap_with_slice(own);
        if *has_rate {
            std::mem::swap(rate, &mut last[0]);
        }
    }
}

impl<N: Number> Part<N> for Commuting<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        for (x, &index) in self.x.iter_mut().zip(&self.variables) {
            x.assign(if index < q.len() { &q[index] } else { &p[index - q.len()] });
        }
        energy.add(self.interpreter.energy(&self.x, &mut self.registers));
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
