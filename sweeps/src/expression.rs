//! Expressions in q, p, the time and the energy of a state, and conditions on them.

use std::cmp::Ordering;

use shadowstep::number::{Lanes, Number};
use shadowstep::systems::formula::{FormulaError, FormulaPotential};
use shadowstep::{Potential, Rational};
use shadowstep_scenes::computation::RunNumber;
use shadowstep_scenes::lanes::LANES;
use shadowstep_scenes::{EnergyAt, ShownCoordinates, System};
use shadowstep_schemes::document::{Reader, Text};
use shadowstep_symbolic::{Exact, Expression as Syntax, parse};

/// The time and the energy.
const TIME: &str = "t";
const ENERGY: &str = "E";

/// A formula in the coordinates, momenta and parameters of a system, the names of the axes, t and E.
#[derive(Clone, Debug)]
pub(crate) struct Expression {
    formula: String,
    /// What is written.
    text: Text,
    has_time: bool,
    has_energy: bool,
    has_functions: bool,
}

/// One expression is less or greater than another.
#[derive(Clone, Debug)]
pub(crate) struct Condition {
    /// The left side less the right side.
    difference: Expression,
    met: Comparison,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Comparison {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Expression {
    pub(crate) fn new(text: Text) -> Expression {
        Expression::with(text.value.clone(), text)
    }

    fn with(formula: String, text: Text) -> Expression {
        let syntax = parse(&formula).ok();
        let has = |name| syntax.as_ref().is_some_and(|syntax| syntax.mentions(name));
        let has_functions = syntax.as_ref().is_none_or(Syntax::has_functions);
        Expression { has_time: has(TIME), has_energy: has(ENERGY), has_functions, formula, text }
    }

    /// Whether it has functions such as exp and sin.
    pub(crate) fn has_functions(&self) -> bool {
        self.has_functions
    }

    /// Checks it for a system; a fault has its place.
    pub(crate) fn check(&self, reader: &mut Reader<'_>, system: &System) {
        if let Err(error) = Evaluator::<f64>::new(self, system, &()) {
            let known =
                system.coordinates.iter().chain(&system.momenta).take(6).cloned().collect::<Vec<_>>().join(", ");
            let hint = format!("it is a formula in {known}, t, E, the parameters and the axes");
            let (message, hint) = match error.to_string().split_once(" is not smooth") {
                Some((name, _)) => {
                    (format!("{name} is not known here"), "use smooth functions: \"x^2 > 100\" for |x| > 10".to_owned())
                }
                None => (error.to_string(), hint),
            };
            let is_whole = self.formula == self.text.value;
            let place = if is_whole { self.text.place(&error.range()) } else { self.text.at.clone() };
            reader.fault(&place, message, hint);
        }
    }
}

impl Condition {
    pub(crate) fn read(reader: &mut Reader<'_>, text: &Text) -> Option<Condition> {
        let comparisons = [
            ("<=", Comparison::LessOrEqual),
            (">=", Comparison::GreaterOrEqual),
            ("<", Comparison::Less),
            (">", Comparison::Greater),
        ];
        let found = comparisons.iter().find_map(|(sign, met)| Some((text.value.split_once(sign)?, *met)));
        let Some(((left, right), met)) = found.filter(|((_, right), _)| !right.contains(['<', '>'])) else {
            return reader.wrong(&text.at, "this text is not a condition", "write one comparison: \"x^2 + y^2 > 100\"");
        };
        for side in [left, right] {
            if let Err(error) = parse(side) {
                let begin = side.as_ptr() as usize - text.value.as_ptr() as usize;
                let range = &error.range;
                let at = text.place(&(begin + range.start..begin + range.end));
                return reader.wrong(&at, error.to_string(), "write one comparison: \"x^2 + y^2 > 100\"");
            }
        }
        // one subtraction and no rounding of the sides alone
        let difference = format!("({left}) - ({right})");
        Some(Condition { difference: Expression::with(difference, text.clone()), met })
    }

    pub(crate) fn difference(&self) -> &Expression {
        &self.difference
    }
}

/// An expression in the numbers of a run.
pub(crate) struct Evaluator<N> {
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
    pub(crate) fn of_run(expression: &Expression, system: &System, context: &N::Context) -> Result<Self, FormulaError> {
        let energy = system.transformed_time().map(|_| system.energy(context));
        Ok(Evaluator { energy, shown: system.shown(context), ..Evaluator::new(expression, system, context)? })
    }
}

impl<N: Number + 'static> Evaluator<N> {
    pub(crate) fn new(expression: &Expression, system: &System, context: &N::Context) -> Result<Self, FormulaError> {
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
        let (has_time, has_energy) = (expression.has_time, expression.has_energy);
        let point = vec![zero.clone(); names.len()];
        Ok(Evaluator { formula, scratch, point, value: zero, shown: None, has_time, has_energy, energy: None })
    }

    /// The value at a state.
    pub(crate) fn value<M: shadowstep::System<Number = N> + ?Sized>(
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
    pub(crate) fn of_each(expression: &Expression, systems: &[&System; LANES]) -> Result<Self, FormulaError> {
        Evaluator::with(expression, systems[0], System::parameters_of_each(systems), &())
    }
}

/// A condition in the numbers of a run.
pub(crate) struct Test<N> {
    difference: Evaluator<N>,
    met: Comparison,
    zero: N,
}

impl<N: RunNumber> Test<N> {
    pub(crate) fn new(condition: &Condition, system: &System, context: &N::Context) -> Result<Self, FormulaError> {
        let difference = Evaluator::of_run(&condition.difference, system, context)?;
        Ok(Test { difference, met: condition.met, zero: N::zero(context) })
    }

    /// Whether a state meets the condition; one whose expression has no value does not.
    pub(crate) fn is_met<M: shadowstep::System<Number = N> + ?Sized>(
        &mut self,
        system: &mut M,
        time: impl Fn() -> Rational,
    ) -> bool {
        self.met.is_of(self.difference.value(system, time).partial_cmp(&self.zero))
    }
}

impl Test<Lanes<LANES>> {
    /// For several systems of one form, each in a lane.
    pub(crate) fn of_each(condition: &Condition, systems: &[&System; LANES]) -> Result<Self, FormulaError> {
        let difference = Evaluator::of_each(&condition.difference, systems)?;
        Ok(Test { difference, met: condition.met, zero: Lanes::all(0.0) })
    }

    /// Whether the state in each lane meets the condition.
    pub(crate) fn is_met_by_each<M: shadowstep::System<Number = Lanes<LANES>> + ?Sized>(
        &mut self,
        system: &mut M,
        time: impl Fn() -> Rational,
    ) -> [bool; LANES] {
        self.difference.value(system, time).0.map(|difference| self.met.is_of(difference.partial_cmp(&0.0)))
    }
}

impl Comparison {
    /// Whether it is that of a difference with 0; NaN has none.
    fn is_of(self, ordering: Option<Ordering>) -> bool {
        match self {
            Comparison::Less => ordering == Some(Ordering::Less),
            Comparison::LessOrEqual => matches!(ordering, Some(Ordering::Less | Ordering::Equal)),
            Comparison::Greater => ordering == Some(Ordering::Greater),
            Comparison::GreaterOrEqual => matches!(ordering, Some(Ordering::Greater | Ordering::Equal)),
        }
    }
}
