//! The value of a formula, without derivatives.

use shadowstep_schemes::symbolic::{Graph, Node, PotentialPrograms};

use super::newest::Role;
use super::{FormulaError, derive};
use crate::number::Number;
use crate::systems::interpreter::Interpreter;

/// A function of some variables from a formula read at run time: a list of operations, executed without allocation.
///
/// ```
/// use shadowstep::systems::formula::FormulaValue;
///
/// let mut distance = FormulaValue::new("sqrt(x^2 + y^2)", &["x", "y"], &[], &())?;
/// assert_eq!(*distance.at(&[3.0, 4.0]), 5.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FormulaValue<N> {
    interpreter: Interpreter<N>,
    registers: Vec<N>,
}

impl<N: Number> FormulaValue<N> {
    /// The function of a formula in these variables, with the values of its parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula, unknown or repeated names, functions that are not smooth.
    pub fn new(
        formula: &str,
        variables: &[&str],
        parameters: &[(&str, N)],
        context: &N::Context,
    ) -> Result<Self, FormulaError> {
        let derived = derive(Role::Value, formula, variables, parameters)?;
        let parameters = parameters.iter().map(|(_, value)| value.clone()).collect();
        Ok(FormulaValue::with(&derived.programs, parameters, context))
    }

    /// The function of a node, whose coordinates are the variables, with the values of its parameters.
    pub fn of(graph: &Graph, node: Node, parameters: Vec<N>, context: &N::Context) -> Self {
        FormulaValue::with(&graph.value(node), parameters, context)
    }

    /// The function of programs, with the values of its parameters.
    pub(crate) fn with(programs: &PotentialPrograms, parameters: Vec<N>, context: &N::Context) -> Self {
        let interpreter = Interpreter::new(programs, parameters, 0);
        let mut registers = vec![N::zero(context); interpreter.registers()];
        interpreter.prepare(&mut registers, context);
        FormulaValue { interpreter, registers }
    }

    /// Its value where the variables are x.
    pub fn at(&mut self, x: &[N]) -> &N {
        self.interpreter.energy(x, &mut self.registers)
    }

    /// slopes ← its derivatives at x and, if asked for, rate ← xᵀA_x − 2A, where the programs have them.
    pub(crate) fn slopes_at(&mut self, x: &[N], slopes: &mut [N], rate: Option<&mut N>) {
        let outputs = match rate.is_some() {
            true => self.interpreter.gradient_and_rate(x, &mut self.registers),
            false => self.interpreter.gradient(x, &mut self.registers),
        };
        let (own, last) = outputs.split_at_mut(slopes.len());
        slopes.swap_with_slice(own);
        rate.into_iter().zip(last).for_each(|(rate, last)| std::mem::swap(rate, last));
    }
}
