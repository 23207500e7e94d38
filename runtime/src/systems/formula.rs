//! Potentials and kinetic energies from formulas read at run time: the twins of [`crate::potential!`] and
//! [`crate::kinetic!`], with the same bits.

mod bodies;
mod distance;
mod kinetic;
mod newest;
mod pair;
mod value;

pub use bodies::{AXES, DISTANCE, FormulaOfBodies, MASSES, RelativeTo};
pub use pair::FormulaPair;
pub use value::FormulaValue;

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use shadowstep_schemes::symbolic::{Graph, SemanticError, SyntaxError, parse};
use thiserror::Error;

pub use kinetic::FormulaKinetic;

use crate::Rational;
use crate::number::Number;
use crate::systems::interpreter::Interpreter;
use crate::systems::potential::{GradientProgram, HessianProduct, Potential, SYSTEMS};
use newest::{Derived, Role, Text, derived};

/// A potential from a formula read at run time: a list of operations, executed without allocation.
///
/// ```
/// use shadowstep::{Motion, UnitMasses, systems::formula::FormulaPotential};
///
/// let well = FormulaPotential::<f64>::new("-depth * exp(-(x^2 + y^2))", &["x", "y"], &[("depth", 2.0)]).unwrap();
/// let mut motion = Motion::new(well, UnitMasses, [0.0, 0.0], [1.0, 0.0]).unwrap();
/// assert_eq!(motion.energy(), 0.5 - 2.0);
/// ```
#[derive(Clone, Debug)]
pub struct FormulaPotential<N> {
    dimension: usize,
    interpreter: Interpreter<N>,
    parameters: Vec<N>,
    derived: Arc<Derived>,
    /// The interpreter of the second derivatives, made when gradient kicks need them.
    second: OnceLock<Interpreter<N>>,
}

/// A text that is not a valid potential or kinetic energy, with the place of the fault.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum FormulaError {
    /// The text is not a formula.
    #[error(transparent)]
    Syntax(#[from] SyntaxError),
    /// The formula is invalid for these coordinates and parameters, or not smooth.
    #[error("{}", .0.fault)]
    Meaning(SemanticError),
    /// A coordinate or parameter has the name of another.
    #[error("`{0}` is there twice; the names of coordinates and parameters must differ")]
    RepeatedName(String),
    /// A coordinate or parameter has the name of a constant.
    #[error("`{0}` is a constant; give the coordinate or parameter another name")]
    Constant(String),
}

shadowstep_schemes::debug_as_text!(FormulaError);

impl FormulaError {
    /// The byte range of the text that is meant; empty, if the names are.
    pub fn range(&self) -> Range<usize> {
        match self {
            FormulaError::Syntax(error) => error.range.clone(),
            FormulaError::Meaning(error) => error.range.clone(),
            FormulaError::RepeatedName(_) | FormulaError::Constant(_) => 0..0,
        }
    }
}

impl<N: Number> FormulaPotential<N> {
    /// The potential of a formula in these coordinates, with the values of its parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula, unknown or repeated names, functions that are not smooth.
    pub fn new(formula: &str, coordinates: &[&str], parameters: &[(&str, N)]) -> Result<Self, FormulaError> {
        let derived = derive(Role::Potential, formula, coordinates, parameters)?;
        let parameters = parameters.iter().map(|(_, value)| value.clone()).collect();
        Ok(FormulaPotential::of(derived, coordinates.len(), parameters))
    }

    fn of(derived: Arc<Derived>, dimension: usize, parameters: Vec<N>) -> Self {
        let interpreter = Interpreter::new(&derived.programs, parameters.clone(), 0);
        FormulaPotential { dimension, interpreter, parameters, derived, second: OnceLock::new() }
    }

    /// The same formula in other numbers, with the values of its parameters in their order.
    ///
    /// # Panics
    /// If there is not a value for each parameter.
    pub fn in_numbers<M: Number>(&self, parameters: Vec<M>) -> FormulaPotential<M> {
        assert_eq!(parameters.len(), self.parameters.len(), "each parameter has a value");
        FormulaPotential::of(Arc::clone(&self.derived), self.dimension, parameters)
    }

    /// The numbers in the formula.
    pub fn numbers(&self) -> Vec<&Rational> {
        self.derived.numbers()
    }

    /// Whether it is a quadratic form.
    pub fn is_quadratic(&self) -> bool {
        self.derived.graph.clone().is_quadratic(self.derived.node, self.dimension)
    }

    fn second(&self) -> &Interpreter<N> {
        self.second.get_or_init(|| {
            let second = self.derived.second(|graph, node| graph.hessian_product(node, self.dimension));
            Interpreter::new(second, self.parameters.clone(), self.dimension)
        })
    }
}

/// The programs of a formula in these variables and parameters.
fn derive<N>(
    role: Role,
    formula: &str,
    variables: &[&str],
    parameters: &[(&str, N)],
) -> Result<Arc<Derived>, FormulaError> {
    let text = Text {
        formula: formula.to_owned(),
        variables: variables.iter().map(|name| (*name).to_owned()).collect(),
        parameters: parameters.iter().map(|(name, _)| (*name).to_owned()).collect(),
        role,
    };
    derived(text, |Text { formula, variables, parameters, .. }| {
        let expression = parse(formula)?;
        refuse_repeated(variables.iter().chain(parameters))?;
        let mut graph = Graph::new();
        let mut node = graph.build(&expression, variables, parameters).map_err(FormulaError::Meaning)?;
        let mut variables = &variables[..];
        if role == Role::Body {
            variables = &variables[..variables.len() - 1];
            node = distance::without_distance(&mut graph, node, variables.len());
        }
        let quadratic = role == Role::Kinetic && graph.is_at_most_quadratic(node, variables.len());
        let quadratic_form = quadratic && graph.is_quadratic(node, variables.len());
        let programs = match role {
            Role::Value => graph.value(node),
            _ => graph.potential(node, variables.len()),
        };
        Ok(Derived { programs, quadratic, quadratic_form, graph, node, second: OnceLock::new() })
    })
}

/// Refuses names that are there twice, or mean something else.
pub(crate) fn refuse_repeated<'a>(names: impl Iterator<Item = &'a String>) -> Result<(), FormulaError> {
    let mut seen = Vec::new();
    for name in names {
        if name == "pi" {
            return Err(FormulaError::Constant(name.clone()));
        }
        if seen.contains(&name) {
            return Err(FormulaError::RepeatedName(name.clone()));
        }
        seen.push(name);
    }
    Ok(())
}

impl<N: Number> Potential<N> for FormulaPotential<N> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn scratch(&self) -> usize {
        self.interpreter.registers()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.interpreter.prepare(scratch, context);
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        std::mem::swap(energy, self.interpreter.energy(q, scratch));
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        let outputs = self.interpreter.gradient(q, scratch);
        gradient.swap_with_slice(&mut outputs[..self.dimension]);
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        let outputs = self.interpreter.gradient_and_rate(q, scratch);
        gradient.swap_with_slice(&mut outputs[..self.dimension]);
        std::mem::swap(rate, &mut outputs[self.dimension]);
    }

    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        Some(self)
    }

    fn program(&self) -> Option<&dyn GradientProgram<N>> {
        Some(self)
    }
}

impl<N: Number> GradientProgram<N> for FormulaPotential<N> {
    fn address(&self) -> *const () {
        Arc::as_ptr(&self.derived).cast()
    }

    fn gradients(&self, q: &[[N; SYSTEMS]], registers: &mut [[N; SYSTEMS]]) -> usize {
        self.interpreter.gradients(q, registers)
    }
}

impl<N: Number> HessianProduct<N> for FormulaPotential<N> {
    fn hessian_scratch(&self) -> usize {
        self.second().registers()
    }

    fn prepare_hessian(&self, scratch: &mut [N], context: &N::Context) {
        self.second().prepare(scratch, context);
    }

    fn hessian_product(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N]) {
        let second = self.second();
        second.properties(scratch, 1).iter_mut().zip(v).for_each(|(place, v)| place.assign(v));
        let outputs = second.gradient(q, scratch);
        product.swap_with_slice(&mut outputs[..self.dimension]);
    }

    fn hessian_product_and_rate(&self, q: &[N], v: &[N], product: &mut [N], rate: &mut N, scratch: &mut [N]) {
        let second = self.second();
        second.properties(scratch, 1).iter_mut().zip(v).for_each(|(place, v)| place.assign(v));
        let outputs = second.gradient_and_rate(q, scratch);
        product.swap_with_slice(&mut outputs[..self.dimension]);
        std::mem::swap(rate, &mut outputs[self.dimension]);
    }
}
