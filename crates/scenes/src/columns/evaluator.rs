//! Expressions and conditions in the numbers of a run.

use std::ops::Range;

use shadowstep::number::{Lanes, Number};
use shadowstep::systems::formula::{FormulaError, FormulaValue};
use shadowstep::tables::{Faults, Source};
use shadowstep::{Rational, Real};
use shadowstep_schemes::document::{Reader, Text};
use shadowstep_schemes::symbolic::Exact;
use thiserror::Error;

use crate::columns::quantity_of_bodies::QuantityOfBodies;
use crate::document::expression::{Comparison, Condition, ENERGY, Expression, TIME, name_of_quantity};
use crate::document::quantity::{Compute, Quantity};
use crate::document::reserved_names;
use crate::motion::lanes::LANES;
use crate::scene::split::ShownCoordinates;
use crate::scene::{Direction, EnergyAt, NamedExpression, SceneNumber, Surface, System};
use crate::texts::error::Error;
use crate::texts::refusal::Refusal;

/// What is read of a text that stands alone, which has this name in its faults.
pub(crate) fn alone<T>(
    name: &str,
    text: &str,
    read: impl FnOnce(Text, &mut Reader<'_>) -> Option<T>,
) -> Result<T, Error> {
    let source = Source { path: name.to_owned(), text: text.to_owned() };
    let mut reader = Reader::new(&source, Vec::new());
    let found = read(Text::alone(text), &mut reader);
    Ok(Faults::or(reader.faults, found)?)
}

impl System {
    /// The condition of a text that stands alone.
    ///
    /// # Errors
    /// A text that is not one comparison of formulas in the numbers of the system's states, with the column of the
    /// fault.
    pub fn condition(&self, name: &str, text: &str) -> Result<Condition, Error> {
        alone(name, text, |text, reader| {
            let condition = Condition::read(reader, &text)?;
            self.check(condition.difference(), reader).map(|()| condition)
        })
    }

    /// The surface of section of a text that stands alone: where the formula is 0.
    ///
    /// # Errors
    /// A text that is not a formula in the numbers of the system's states, with the column of the fault.
    pub fn section(&self, name: &str, text: &str, direction: Direction) -> Result<Surface, Error> {
        alone(name, text, |text, reader| self.surface(text, direction, reader))
    }

    /// The surface where a formula is 0, or faults.
    pub(crate) fn surface(&self, text: Text, direction: Direction, reader: &mut Reader<'_>) -> Option<Surface> {
        let expression = Expression::new(text);
        if expression.has_time && !self.explicit_time && self.transformed_time().is_none() {
            let help = "write `every` for states at times that are known, or a formula in positions and momenta";
            let message = "a section is a function of q and p, and t is no coordinate here";
            return reader.wrong(&expression.text.at, message, help);
        }
        self.check(&expression, reader).map(|()| Surface { expression, direction })
    }

    /// Checks an expression for the system; a fault has its place, and then there is nothing.
    pub fn check(&self, expression: &Expression, reader: &mut Reader<'_>) -> Option<()> {
        // that of a condition has another length
        let is_whole = expression.formula.len() == expression.text.value.len();
        let place = |range: &Range<usize>| match is_whole {
            true => expression.text.place(range),
            false => expression.text.at.clone(),
        };
        if let Some(Refusal { message, hint }) = self.two_meanings(expression) {
            return reader.wrong(&expression.text.at, message, hint);
        }
        let Err(error) = Evaluator::<f64>::new(expression, self, &()) else { return Some(()) };
        let (message, hint, range) = match error {
            NotOfSystem::Quantity { no: Refusal { message, hint }, range } => (message, hint, range),
            NotOfSystem::Formula(error) => {
                let known =
                    self.coordinates.iter().chain(&self.momenta).take(6).cloned().collect::<Vec<_>>().join(", ");
                let sums: String = QuantityOfBodies::sums(self).map(|sum| format!(", {sum}")).collect();
                let hint =
                    format!("it is a formula in {known}, t, E{sums} and the parameters, in a sweep also the axes");
                let (message, hint) = match error.to_string().split_once(" is not smooth") {
                    Some((name, _)) => (
                        format!("{name} is not known here"),
                        "use smooth functions: \"x^2 > 100\" for |x| > 10".to_owned(),
                    ),
                    None => (error.to_string(), hint),
                };
                (message, hint, error.range())
            }
        };
        reader.wrong(&place(&range), message, hint)
    }

    /// A name of the formula that could be read in two ways.
    fn two_meanings(&self, expression: &Expression) -> Option<Refusal> {
        let quantities = reserved_names::quantities().filter(|(name, _)| *name != TIME || !self.explicit_time);
        let of = |names: &[String], what| names.iter().map(move |name| (name.clone(), what)).collect::<Vec<_>>();
        let parameters: Vec<_> = self.parameters.iter().map(|(name, _)| name.clone()).collect();
        let all = [
            of(&self.coordinates, "the coordinate"),
            of(&self.momenta, "the momentum"),
            of(&parameters, "the parameter"),
        ];
        let all = all.concat().into_iter().chain(quantities.map(|(name, what)| (name.to_owned(), what)));
        let all: Vec<_> = all.collect();
        expression.names.iter().find_map(|name| {
            let meanings: Vec<_> = all.iter().filter(|(own, _)| own == name).map(|(_, what)| *what).collect();
            let [one, other, ..] = meanings[..] else { return None };
            let message = format!("`{name}` could be {one} or {other} here");
            Some(Refusal::new(message, format!("give {one} another name")))
        })
    }
}

/// Why an expression has no value for the states of a system.
#[derive(Clone, Debug, Error)]
pub enum NotOfSystem {
    /// It is not a formula in the names of the system.
    #[error(transparent)]
    Formula(#[from] FormulaError),
    /// The system has no such quantity of bodies.
    #[error("{}", .no.message)]
    Quantity {
        /// Why, and what would be right.
        no: Refusal,
        /// Its bytes in the formula.
        range: Range<usize>,
    },
}

/// An expression in the numbers of a run.
pub struct Evaluator<N> {
    formula: FormulaValue<N>,
    /// q, p, t, E and the quantities of bodies.
    point: Vec<N>,
    value: N,
    has_time: bool,
    has_energy: bool,
    quantities: Vec<Compute<N>>,
    has_momentum_of_time: bool,
    /// Converts states, where formulas are in other coordinates than the steps.
    shown: Option<ShownCoordinates<N>>,
    /// H, where the steps follow another Hamiltonian: in transformed time, where t is a coordinate.
    energy: Option<EnergyAt<N>>,
}

impl<N: SceneNumber> Evaluator<N> {
    /// For the states of a run, also in transformed time.
    ///
    /// # Errors
    /// As [`new`](Evaluator::new).
    pub fn of_run(expression: &Expression, system: &System, context: &N::Context) -> Result<Self, NotOfSystem> {
        let energy = system.transformed_time().map(|_| system.energy(context));
        Ok(Evaluator { energy, shown: system.shown(context), ..Evaluator::new(expression, system, context)? })
    }

    /// For the states of a system in the coordinates of its scene.
    ///
    /// # Errors
    /// A formula that is not one of these names, a quantity that the system does not have.
    pub fn new(expression: &Expression, system: &System, context: &N::Context) -> Result<Self, NotOfSystem> {
        let number = |exact: &Exact| N::from_rational(&exact.value, context);
        let parameters = system.parameters.iter().map(|(name, exact)| (name.as_str(), number(exact))).collect();
        let quantities = quantities(expression, system)?;
        let quantities = quantities.iter().map(|quantity| quantity.in_numbers(system, context)).collect();
        Evaluator::with(expression, system, (parameters, quantities), context)
    }
}

impl NamedExpression {
    /// The evaluator of an expression that was checked with its scene.
    pub(crate) fn evaluator<N: SceneNumber>(&self, system: &System, context: &N::Context) -> Evaluator<N> {
        Evaluator::of_run(&self.expression, system, context).expect("it was checked with the scene")
    }
}

fn quantities(expression: &Expression, system: &System) -> Result<Vec<QuantityOfBodies>, NotOfSystem> {
    let of = |quantity: &Quantity| {
        QuantityOfBodies::new(quantity, system)
            .map_err(|no| NotOfSystem::Quantity { no, range: quantity.range.clone() })
    };
    expression.quantities.iter().map(of).collect()
}

impl<N: Number + 'static> Evaluator<N> {
    /// For a system with these values of its parameters and these quantities.
    fn with(
        expression: &Expression,
        system: &System,
        (mut parameters, quantities): (Vec<(&str, N)>, Vec<Compute<N>>),
        context: &N::Context,
    ) -> Result<Self, NotOfSystem> {
        // t may be a coordinate; no formula has the empty name
        let time = if system.explicit_time { "" } else { TIME };
        let of_quantities: Vec<String> = (0..quantities.len()).map(name_of_quantity).collect();
        let names = system.coordinates.iter().chain(&system.momenta).map(String::as_str).chain([time, ENERGY]);
        let names: Vec<&str> = names.chain(of_quantities.iter().map(String::as_str)).collect();
        let formula = match &expression.derived {
            None => {
                parameters.retain(|(name, _)| !names.contains(name));
                FormulaValue::new(&expression.formula, &names, &parameters, context)?
            }
            Some(derived) => {
                let values = parameters.into_iter().map(|(_, value)| value).collect();
                FormulaValue::of(&derived.graph, derived.node, values, context)
            }
        };
        let zero = N::zero(context);
        let (has_time, has_energy) = (expression.has_time && !system.explicit_time, expression.has_energy);
        let has_momentum_of_time = expression.derived.as_ref().is_some_and(|derived| derived.has_momentum_of_time);
        let point = vec![zero.clone(); names.len() + usize::from(has_momentum_of_time)];
        let value = zero;
        Ok(Evaluator {
            has_momentum_of_time,
            formula,
            point,
            value,
            shown: None,
            has_time,
            has_energy,
            quantities,
            energy: None,
        })
    }

    /// The value at the present state of a system.
    pub fn value<M: shadowstep::System<Number = N> + ?Sized>(
        &mut self,
        system: &mut M,
        time: impl Fn() -> Rational,
    ) -> &N {
        let energy = self.has_energy.then(|| match &mut self.energy {
            Some(energy) => energy(system.state().q(), system.state().p()),
            None => system.energy(),
        });
        let context = self.value.context();
        let state = (system.state().q(), system.state().p());
        self.value_with(state, || N::from_rational(&time(), &context), energy)
    }

    /// The value at a state with its physical time, in the coordinates of the steps; `energy` is H there.
    pub fn value_at(&mut self, state: (&[N], &[N]), time: &N, energy: impl FnOnce() -> N) -> &N {
        let (rest, energy) = (self.rest(), self.has_energy.then(energy));
        // a derived formula may have t, too
        self.point[rest].assign(time);
        self.value_with(state, || time.clone(), energy)
    }

    /// The value at another state of a system; t is a coordinate, if the expression has it.
    pub(crate) fn value_at_other<M: shadowstep::System<Number = N> + ?Sized>(
        &mut self,
        system: &mut M,
        (q, p): (&[N], &[N]),
    ) -> &N {
        let energy = self.has_energy.then(|| match &mut self.energy {
            Some(energy) => energy(q, p),
            None => {
                let mut energy = self.value.clone();
                system.assign_energy(Some((q, p)), &mut energy);
                energy
            }
        });
        self.value_with((q, p), || unreachable!("t is a coordinate"), energy)
    }

    /// The value at a state with its time, which the state has itself where time is transformed, and its H.
    fn value_with(&mut self, (q, p): (&[N], &[N]), time: impl FnOnce() -> N, energy: Option<N>) -> &N {
        self.set_state(q, p);
        let rest = self.rest();
        if self.has_time {
            self.point[rest] = match (&self.energy, q.last()) {
                (Some(_), Some(t)) => t.clone(),
                _ => time(),
            };
        }
        if let Some(energy) = energy {
            self.point[rest + 1] = energy;
        }
        self.evaluate()
    }

    /// The place of t and E in the point.
    fn rest(&self) -> usize {
        self.point.len() - usize::from(self.has_momentum_of_time) - self.quantities.len() - 2
    }

    fn set_state(&mut self, q: &[N], p: &[N]) {
        if let (true, Some(place), Some(momentum)) = (self.has_momentum_of_time, self.point.last_mut(), p.last()) {
            place.assign(momentum);
        }
        let of_quantities = self.rest() + 2;
        let (q, p) = match &mut self.shown {
            Some(shown) => shown.of_state(q, p),
            None => (q, p),
        };
        self.point.iter_mut().zip(q.iter().chain(p)).for_each(|(own, value)| own.assign(value));
        for (own, quantity) in self.point[of_quantities..].iter_mut().zip(&mut self.quantities) {
            *own = quantity(q, p);
        }
    }

    fn evaluate(&mut self) -> &N {
        self.value.assign(self.formula.at(&self.point));
        &self.value
    }
}

impl Evaluator<Lanes<LANES>> {
    /// For several systems of one form, each in a lane.
    ///
    /// # Errors
    /// As [`new`](Evaluator::new).
    pub fn of_each(expression: &Expression, systems: &[&System; LANES]) -> Result<Self, NotOfSystem> {
        let mut of_systems = Vec::new();
        for system in systems {
            of_systems.push(quantities(expression, system)?);
        }
        let in_lanes = |number: usize| {
            in_lanes(of_systems.iter().zip(systems).map(|(of_system, system)| (&of_system[number], *system)))
        };
        let quantities = (0..expression.quantities.len()).map(in_lanes).collect();
        Evaluator::with(expression, systems[0], (System::parameters_of_each(systems), quantities), &())
    }
}

/// A quantity of a system in each lane.
fn in_lanes<'a>(quantities: impl Iterator<Item = (&'a QuantityOfBodies, &'a System)>) -> Compute<Lanes<LANES>> {
    let mut each: Vec<Compute<f64>> = quantities.map(|(quantity, system)| quantity.in_numbers(system, &())).collect();
    Box::new(move |q, p| {
        let mut values = Lanes::all(0.0);
        for (lane, (value, compute)) in values.0.iter_mut().zip(&mut each).enumerate() {
            let of_lane = |numbers: &[Lanes<LANES>]| numbers.iter().map(|x| x.0[lane]).collect::<Vec<_>>();
            *value = compute(&of_lane(q), &of_lane(p));
        }
        values
    })
}

/// A condition in the numbers of a run.
pub struct Test<N> {
    difference: Evaluator<N>,
    met: Comparison,
    zero: N,
}

impl<N: SceneNumber> Test<N> {
    /// For the states of a run.
    ///
    /// # Errors
    /// As [`Evaluator::new`].
    pub fn new(condition: &Condition, system: &System, context: &N::Context) -> Result<Self, NotOfSystem> {
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

impl<N: SceneNumber> Test<N> {
    /// Whether H is in it.
    pub(crate) fn has_energy(&self) -> bool {
        self.difference.has_energy
    }

    /// Whether a state meets the condition, which has no H.
    pub(crate) fn is_met_at(&mut self, state: (&[N], &[N]), time: impl FnOnce() -> N) -> bool {
        self.met.is_of(self.difference.value_with(state, time, None).partial_cmp(&self.zero))
    }
}

/// A condition on q and p alone, in double precision, at several states of one system.
pub(crate) struct TestInLanes {
    test: Test<Lanes<LANES>>,
    /// The places in q and p of what it names.
    places: Vec<usize>,
}

impl TestInLanes {
    /// `None` of another condition, and of a system whose states are shown in other coordinates.
    pub(crate) fn of(condition: &Condition, system: &System) -> Option<Self> {
        let difference = condition.difference();
        let has_others = difference.has_energy || difference.has_time || !difference.quantities.is_empty();
        if has_others || system.transformed_time().is_some() || system.shown::<f64>(&()).is_some() {
            return None;
        }
        let names = system.coordinates.iter().chain(&system.momenta).enumerate();
        let places = names.filter(|(_, name)| difference.names.contains(name)).map(|(place, _)| place).collect();
        Some(TestInLanes { test: Test::of_each(condition, &[system; LANES]).ok()?, places })
    }

    /// The first state, of as many as there are lanes or fewer, that meets the condition; each has q and p, which are
    /// `size` numbers.
    pub(crate) fn first_met<N: Real>(&mut self, states: &[N], size: usize) -> Option<usize> {
        let Test { difference, met, .. } = &mut self.test;
        for &place in &self.places {
            let values = states.iter().skip(place).step_by(size);
            difference.point[place].0.iter_mut().zip(values).for_each(|(own, value)| *own = value.to_f64());
        }
        let count = states.len() / size;
        let are_met = difference.evaluate().0.map(|difference| met.is_of(difference.partial_cmp(&0.0)));
        // most often none is
        let is_any = are_met.iter().fold(false, |any, is_met| any | is_met);
        is_any.then(|| are_met[..count].iter().position(|is_met| *is_met)).flatten()
    }
}

impl Test<Lanes<LANES>> {
    /// For several systems of one form, each in a lane.
    ///
    /// # Errors
    /// As [`new`](Evaluator::new).
    pub fn of_each(condition: &Condition, systems: &[&System; LANES]) -> Result<Self, NotOfSystem> {
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
