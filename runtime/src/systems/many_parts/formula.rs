//! Parts from formulas read at run time.

use std::ops::Range;

use shadowstep_schemes::symbolic::{ExplicitFlow, Graph, Node, parse};
use thiserror::Error;

use super::action::{Rotation, Squeeze};
use super::commuting::Commuting;
use super::kepler::Kepler;
use super::monomial::Monomial;
use super::part::{FlowState, Part};
use super::quadratic::Quadratic;
use crate::Rational;
use crate::number::{CorrectlyRounded, Number};
use crate::systems::formula::{FormulaError, refuse_repeated};
use crate::systems::matrix::QUADRATIC_FLOW_DIGITS;

/// A text that is no part of H with a known flow.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum PartError {
    /// It is not a formula of the coordinates, momenta and parameters.
    #[error(transparent)]
    Formula(#[from] FormulaError),
    /// Its flow has no formula here.
    #[error("the flow of this part has no formula: it couples {0}")]
    NoFlow(String),
    /// The numbers have more digits than the flow of a quadratic form is computed to.
    #[error("the flow of a quadratic form is computed to at most {QUADRATIC_FLOW_DIGITS} digits")]
    Digits,
}

shadowstep_schemes::debug_as_text!(PartError);

impl PartError {
    /// The byte range of the text that is meant; empty, if it is all of it.
    pub fn range(&self) -> Range<usize> {
        match self {
            PartError::Formula(error) => error.range(),
            PartError::NoFlow(_) | PartError::Digits => 0..0,
        }
    }
}

/// A part of H as its formula says: its flows, whose numbers are exact.
#[derive(Clone, Debug)]
pub struct PartFormula {
    graph: Graph,
    /// The formula, with parameters.
    hamiltonian: Node,
    /// With the values of parameters.
    flows: Vec<ExplicitFlow>,
}

impl PartFormula {
    /// The part of a formula, with the names of the coordinates, as many of their momenta, and the exact values of
    /// parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula, unknown or repeated names, a part whose flow has no formula.
    pub fn new(
        formula: &str,
        (coordinates, momenta): (&[&str], &[&str]),
        parameters: &[(&str, Rational)],
    ) -> Result<Self, PartError> {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let variables = [names(coordinates), names(momenta)].concat();
        let parameter_names: Vec<String> = parameters.iter().map(|(name, _)| (*name).to_owned()).collect();
        refuse_repeated(variables.iter().chain(&parameter_names))?;
        let expression = parse(formula).map_err(FormulaError::from)?;
        let mut graph = Graph::new();
        let hamiltonian = graph.build(&expression, &variables, &parameter_names).map_err(FormulaError::Meaning)?;
        let values = parameters.iter().enumerate();
        let values = values.map(|(j, (_, value))| (graph.parameter(j), graph.number(value.clone()))).collect();
        let with_values = graph.replaced(&[hamiltonian], values)[0];
        let flows = graph.explicit_flows(with_values, coordinates.len()).map_err(|refused| {
            let pairs = refused.freedoms.iter().take(4).map(|i| format!("{} and {}", coordinates[*i], momenta[*i]));
            let more = if refused.freedoms.len() > 4 { ", …" } else { "" };
            PartError::NoFlow(pairs.collect::<Vec<_>>().join(", ") + more)
        })?;
        Ok(PartFormula { graph, hamiltonian, flows })
    }

    /// The part in numbers.
    ///
    /// # Errors
    /// [`PartError::Digits`].
    pub fn in_numbers<N: CorrectlyRounded + 'static>(&self, context: &N::Context) -> Result<FormulaPart<N>, PartError> {
        let mut graph = self.graph.clone();
        let flows = self.flows.iter().map(|flow| part(&mut graph, flow.clone(), context));
        let flows = flows.collect::<Option<_>>().ok_or(PartError::Digits)?;
        Ok(FormulaPart { flows })
    }

    /// Whether one of its flows is that of a quadratic form, which is computed to at most [`QUADRATIC_FLOW_DIGITS`].
    pub fn has_quadratic_form(&self) -> bool {
        self.flows.iter().any(|flow| matches!(flow, ExplicitFlow::Quadratic { .. }))
    }

    /// The numbers in the formula.
    pub fn numbers(&self) -> Vec<&Rational> {
        self.graph.numbers(self.hamiltonian)
    }
}

/// A part of H from a formula in coordinates, momenta and parameters: the flows of which it consists.
pub struct FormulaPart<N> {
    flows: Vec<Box<dyn Part<N>>>,
}

impl<N: CorrectlyRounded + 'static> FormulaPart<N> {
    /// The part of a formula, as [`PartFormula::new`] reads it, in numbers.
    ///
    /// # Errors
    /// As [`PartFormula::new`]; [`PartError::Digits`].
    pub fn new(
        formula: &str,
        names: (&[&str], &[&str]),
        parameters: &[(&str, Rational)],
        context: &N::Context,
    ) -> Result<Self, PartError> {
        PartFormula::new(formula, names, parameters)?.in_numbers(context)
    }
}

/// `None` if the numbers have more digits than the flow is computed to.
fn part<N: CorrectlyRounded + 'static>(
    graph: &mut Graph,
    flow: ExplicitFlow,
    context: &N::Context,
) -> Option<Box<dyn Part<N>>> {
    let mut programs = |function: Node, count| graph.potential(function, count);
    Some(match flow {
        ExplicitFlow::Commuting { variables, function } => {
            let programs = programs(function, variables.len());
            Box::new(Commuting::new(variables, &programs, context))
        }
        ExplicitFlow::Quadratic { freedoms, matrix } => Box::new(Quadratic::new(freedoms, matrix, context)?),
        ExplicitFlow::Rotation { freedom, form, function } => {
            Box::new(Rotation::new(freedom, &form, &programs(function, 1), context))
        }
        ExplicitFlow::Squeeze { freedom, function } => Box::new(Squeeze::new(freedom, &programs(function, 1), context)),
        ExplicitFlow::Monomial { freedom, exponents, quotient } => {
            Box::new(Monomial::new(freedom, exponents, &programs(quotient, 2), context))
        }
        ExplicitFlow::Kepler { freedoms, mass, attraction } => {
            Box::new(Kepler::new(freedoms, &mass, &attraction, context))
        }
    })
}

impl<N: Number> Part<N> for FormulaPart<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        self.flows.iter_mut().for_each(|part| part.add_energy(q, p, energy));
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, continues: bool) {
        // they have no degree of freedom in common
        self.flows.iter_mut().for_each(|part| part.flow(time, state, continues));
    }

    fn is_potential(&self, coordinates: usize) -> bool {
        self.flows.iter().all(|part| part.is_potential(coordinates))
    }
}

/// The parts of formulas, for [`SystemOfParts`](super::SystemOfParts).
///
/// # Errors
/// As [`FormulaPart::new`], of the first part that is refused.
pub fn parts<N: CorrectlyRounded + 'static>(
    formulas: &[&str],
    names: (&[&str], &[&str]),
    parameters: &[(&str, Rational)],
    context: &N::Context,
) -> Result<Vec<Box<dyn Part<N>>>, PartError> {
    let part = |formula: &&str| {
        let part = FormulaPart::new(formula, names, parameters, context)?;
        Ok(Box::new(part) as Box<dyn Part<N>>)
    };
    formulas.iter().map(part).collect()
}
