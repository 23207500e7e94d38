//! Kinetic energies from formulas read at run time: the twin of [`crate::kinetic!`], with the same bits.

use std::marker::PhantomData;
use std::sync::Arc;

use super::newest::{Derived, Role};
use super::{FormulaError, derive};
use crate::Rational;
use crate::number::Number;
use crate::systems::interpreter::Interpreter;
use crate::systems::kinetic::{General, Kinetic, Quadratic};

/// A kinetic energy from a formula read at run time: a list of operations, executed without allocation.
///
/// It is taken as a general T(p), which schemes for quadratic T only do not move;
/// [`into_quadratic`](FormulaKinetic::into_quadratic) turns one that is at most quadratic in p into a quadratic kinetic
/// energy.
///
/// ```
/// use shadowstep::{Motion, systems::formula::{FormulaKinetic, FormulaPotential}};
///
/// let relativistic = FormulaKinetic::new("sqrt(c^4 + c^2*p^2)", &["p"], &[("c", 2.0)]).unwrap();
/// let spring = FormulaPotential::new("q^2/2", &["q"], &[]).unwrap();
/// let mut motion = Motion::new(spring, relativistic, [0.0], [1.5]).unwrap();
/// assert_eq!(motion.energy(), 5.0);
/// ```
#[derive(Clone, Debug)]
pub struct FormulaKinetic<N, Class = General> {
    dimension: usize,
    interpreter: Interpreter<N>,
    parameters: usize,
    derived: Arc<Derived>,
    class: PhantomData<fn() -> Class>,
}

impl<N: Number> FormulaKinetic<N> {
    /// The kinetic energy of a formula in these momenta, with the values of its parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula, unknown or repeated names, functions that are not smooth.
    pub fn new(formula: &str, momenta: &[&str], parameters: &[(&str, N)]) -> Result<Self, FormulaError> {
        let derived = derive(Role::Kinetic, formula, momenta, parameters)?;
        let parameters = parameters.iter().map(|(_, value)| value.clone()).collect();
        Ok(FormulaKinetic::of(derived, momenta.len(), parameters))
    }

    fn of(derived: Arc<Derived>, dimension: usize, parameters: Vec<N>) -> Self {
        let count = parameters.len();
        let interpreter = Interpreter::new(&derived.programs, parameters, 0);
        FormulaKinetic { dimension, interpreter, parameters: count, derived, class: PhantomData }
    }

    /// The same formula in other numbers, with the values of its parameters in their order.
    ///
    /// # Panics
    /// If there is not a value for each parameter.
    pub fn in_numbers<M: Number>(&self, parameters: Vec<M>) -> FormulaKinetic<M> {
        assert_eq!(parameters.len(), self.parameters, "each parameter has a value");
        FormulaKinetic::of(Arc::clone(&self.derived), self.dimension, parameters)
    }

    /// The numbers in the formula.
    pub fn numbers(&self) -> Vec<&Rational> {
        self.derived.numbers()
    }

    /// Whether it is at most quadratic in p.
    pub fn is_quadratic(&self) -> bool {
        self.derived.quadratic
    }

    /// The same, as one that every scheme moves.
    ///
    /// # Errors
    /// The formula is not at most quadratic; it is returned.
    #[expect(clippy::result_large_err, reason = "both are the same value; neither is an error")]
    pub fn into_quadratic(self) -> Result<FormulaKinetic<N, Quadratic>, Self> {
        if !self.is_quadratic() {
            return Err(self);
        }
        let FormulaKinetic { dimension, interpreter, parameters, derived, .. } = self;
        Ok(FormulaKinetic { dimension, interpreter, parameters, derived, class: PhantomData })
    }
}

impl<N: Number, Class> Kinetic<N> for FormulaKinetic<N, Class> {
    type Class = Class;

    fn dimension(&self) -> Option<usize> {
        Some(self.dimension)
    }

    fn scratch(&self) -> usize {
        self.interpreter.registers()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.interpreter.prepare(scratch, context);
    }

    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        for (q, velocity) in q.iter_mut().zip(self.interpreter.gradient(p, scratch)) {
            q.add_product(weight, velocity);
        }
    }

    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]) {
        if self.derived.quadratic_form {
            return self.drift(weight, p, q, scratch);
        }
        let outputs = self.interpreter.gradient_and_rate(p, scratch);
        for (q, velocity) in q.iter_mut().zip(&*outputs) {
            q.add_product(weight, velocity);
        }
        beta.add_product(weight, &outputs[self.dimension]);
    }

    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        std::mem::swap(energy, self.interpreter.energy(p, scratch));
    }

    fn has_linear_terms(&self) -> bool {
        self.derived.quadratic && !self.derived.quadratic_form
    }
}
