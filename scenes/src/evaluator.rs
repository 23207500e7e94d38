//! Expressions and conditions in the numbers of a run.

use shadowstep::number::{Lanes, Number};
use shadowstep::systems::formula::{FormulaError, FormulaPotential};
use shadowstep::tables::{Faults, Source};
use shadowstep::{Potential, Rational};
use shadowstep_schemes::document::{Reader, Text};
use shadowstep_symbolic::Exact;

use crate::computation::RunNumber;
use crate::error::Error;
use crate::expression::{Comparison, Condition, ENERGY, Expression, TIME};
use crate::lanes::LANES;
use crate::scene::split::ShownCoordinates;
use crate::scene::{EnergyAt, System};

impl System {
    /// The condition of a text that stands alone.
    ///
    /// # Errors
    /// A text that is not one comparison of formulas in the numbers of the system's states, with the column of the fault.
    pub fn condition(&self, name: &str, text: &str) -> Result<Condition, Error> {
        let source = Source { path: name.to_owned(), text: text.to_owned() };
        let mut reader = Reader::new(&source, Vec::new());
        let condition = Condition::read(&mut reader, &Text::alone(text));
        if let Some(condition) = &condition {
            self.check(condition.difference(), &mut reader);
        }
        match (Faults::of(reader.faults), condition) {
            (None, Some(condition)) => Ok(condition),
            (Some(faults), _) => Err(faults.into()),
            (None, None) => unreachable!("what cannot be read is a fault"),
        }
    }

    /// Checks an expression for the system; a fault has its place.
    pub fn check(&self, expression: &Expression, reader: &mut Reader<'_>) {
        if let Err(error) = Evaluator::<f64>::new(expression, self, &()) {
            let known = self.coordinates.iter().chain(&self.momenta).take(6).cloned().collect::<Vec<_>>().join(", ");
            let hint = format!("it is a formula in {known}, t, E and the parameters, in a sweep also the axes");
            let (message, hint) = match error.to_string().split_once(" is not smooth") {
                Some((name, _)) => {
                    (format!("{name} is not known here"), "use smooth functions: \"x^2 > 100\" for |x| > 10".to_owned())
                }
                None => (error.to_string(), hint),
            };
            let is_whole = expression.formula == expression.text.value;
            let place = if is_whole { expression.text.place(&error.range()) } else { expression.text.at.clone() };
            reader.fault(&place, message, hint);
        }
    }
}

/// An expression in the numbers of a run.
pub struct Evaluator<N> {
    formula: FormulaPotential<N>,
    scratch: Vec<N>,
    /// q, p, t and E.
    point: Vec<N>,
    value: N,
    has_time: bool,
    has_energy: bool,
    /// Converts states, where formulas are in other coordinates than the steps.
    shown: Option<ShownCoordinates<N>>,
    /// H, where the steps follow another Hamiltonian: in transformed time, where t is a coordinate.
    energy: Option<EnergyAt<N>>,
}

impl<N: RunNumber> Evaluator<N> {
    /// For the states of a run, also in transformed time.
    ///
    /// # Errors
    /// As [`new`](Evaluator::new).
    pub fn of_run(expression: &Expression, system: &System, context: &N::Context) -> Result<Self, FormulaError> {
        let energy = system.transformed_time().map(|_| system.energy(context));
        Ok(Evaluator { energy, shown: system.shown(context), ..Evaluator::new(expression, system, context)? })
    }
}

impl<N: Number + 'static> Evaluator<N> {
    /// For the states of a system in the coordinates of its scene.
    ///
    /// # Errors
    /// A formula that is not one of these names.
    pub fn new(expression: &Expression, system: &System, context: &N::Context) -> Result<Self, FormulaError> {
        let number = |exact: &Exact| N::from_rational(&exact.value, context);
        let parameters = system.parameters.iter().map(|(name, exact)| (name.as_str(), number(exact))).collect();
        Evaluator::with(expression, system, parameters, context)
    }

    /// For a system with these values of its parameters.
    fn with(
        expression: &Expression,
        system: &System,
        mut parameters: Vec<(&str, N)>,
        context: &N::Context,
    ) -> Result<Self, FormulaError> {
        // t may be a coordinate; no formula has the empty name
        let time = if system.explicit_time { "" } else { TIME };
        let names = system.coordinates.iter().chain(&system.momenta).map(String::as_str).chain([time, ENERGY]);
        let names: Vec<&str> = names.collect();
        parameters.retain(|(name, _)| !names.contains(name));
        let formula = FormulaPotential::new(&expression.formula, &names, &parameters)?;
        let zero = N::zero(context);
        let mut scratch = vec![zero.clone(); formula.scratch()];
        formula.prepare(&mut scratch, context);
        let (has_time, has_energy) = (expression.has_time && !system.explicit_time, expression.has_energy);
        let point = vec![zero.clone(); names.len()];
        Ok(Evaluator { formula, scratch, point, value: zero, shown: None, has_time, has_energy, energy: None })
    }

    /// The value at a state.
    pub fn value<M: shadowstep::System<Number = N> + ?Sized>(
        &mut self,
        system: &mut M,
        time: impl Fn() -> Rational,
    ) -> &N {
        let (q, p) = match &mut self.shown {
            Some(shown) => shown.of_state(system.q(), system.p()),
            None => (system.q(), system.p()),
        };
        let (state, rest) = self.point.split_at_mut(2 * q.len());
        state.iter_mut().zip(q.iter().chain(p)).for_each(|(own, value)| own.assign(value));
        if self.has_time {
            rest[0] = match (&self.energy, system.q().last()) {
                (Some(_), Some(t)) => t.clone(),
                _ => N::from_rational(&time(), &self.value.context()),
            };
        }
        if self.has_energy {
            rest[1] = match &mut self.energy {
                Some(energy) => energy(system.q(), system.p()),
                None => system.energy(),
            };
        }
        self.formula.energy(&self.point, &mut self.value, &mut self.scratch);
        &self.value
    }
}

impl Evaluator<Lanes<LANES>> {
    /// For several systems of one form, each in a lane.
    ///
    /// # Errors
    /// As [`new`](Evaluator::new).
    pub fn of_each(expression: &Expression, systems: &[&System; LANES]) -> Result<Self, FormulaError> {
        Evaluator::with(expression, systems[0], System::parameters_of_each(systems), &())
    }
}

/// A condition in the numbers of a run.
pub struct Test<N> {
    difference: Evaluator<N>,
    met: Comparison,
    zero: N,
}

impl<N: RunNumber> Test<N> {
    /// For the states of a run.
    ///
    /// # Errors
    /// As [`Evaluator::new`].
    pub fn new(condition: &Condition, system: &System, context: &N::Context) -> Result<Self, FormulaError> {
        let difference = Evaluator::of_run(condition.difference(), system, context)?;
        Ok(Test { difference, met: condition.met, zero: N::zero(context) })
    }

    /// Whether a state meets the condition; one whose expression has no value does not.
    pub fn is_met<M: shadowstep::System<Number = N> + ?Sized>(
        &mut self,
        system: &mut M,
        time: impl Fn() -> Rational,
    ) -> bool {
        self.met.is_of(self.difference.value(system, time).partial_cmp(&self.zero))
    }
}

impl Test<Lanes<LANES>> {
    /// For several systems of one form, each in a lane.
    ///
    /// # Errors
    /// As [`new`](Evaluator::new).
    pub fn of_each(condition: &Condition, systems: &[&System; LANES]) -> Result<Self, FormulaError> {
        let difference = Evaluator::of_each(condition.difference(), systems)?;
        Ok(Test { difference, met: condition.met, zero: Lanes::all(0.0) })
    }

    /// Whether the state in each lane meets the condition.
    pub fn is_met_by_each<M: shadowstep::System<Number = Lanes<LANES>> + ?Sized>(
        &mut self,
        system: &mut M,
        time: impl Fn() -> Rational,
    ) -> [bool; LANES] {
        self.difference.value(system, time).0.map(|difference| self.met.is_of(difference.partial_cmp(&0.0)))
    }
}
