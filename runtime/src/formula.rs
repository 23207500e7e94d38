//! Potentials from formulas read at run time: the twin of [`crate::potential!`], with the same bits.

use std::ops::Range;

use shadowstep_symbolic::{
    Function, Graph, GraphError, Instruction, Place, PotentialPrograms, Program, SyntaxError, parse,
};
use thiserror::Error;

use crate::Rational;
use crate::number::Number;
use crate::potential::Potential;

/// A potential whose operations are carried out one by one from a list; nothing is allocated per evaluation.
///
/// ```
/// use shadowstep::{Motion, UnitMasses, formula::FormulaPotential};
///
/// let well = FormulaPotential::<f64>::new("-depth * exp(-(x^2 + y^2))", &["x", "y"], &[("depth", 2.0)]).unwrap();
/// let mut motion = Motion::new(well, UnitMasses, [0.0, 0.0], [1.0, 0.0]);
/// assert_eq!(motion.energy(), 0.5 - 2.0);
/// ```
#[derive(Clone, Debug)]
pub struct FormulaPotential<N> {
    dimension: usize,
    parameters: Vec<N>,
    /// All places are registers, in the order of [`Layout`].
    programs: PotentialPrograms,
    layout: Layout,
}

/// Where the registers of each kind begin in the scratch space.
#[derive(Clone, Copy, Debug)]
struct Layout {
    /// After the parameters: what the energy keeps, then what the gradient keeps.
    energy_kept: usize,
    gradient_kept: usize,
    coordinates: usize,
    outputs: usize,
    intermediate: usize,
    end: usize,
}

/// A text that is no potential, and the place.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FormulaError {
    /// The text is no formula.
    #[error(transparent)]
    Syntax(#[from] SyntaxError),
    /// The formula is none of these coordinates and parameters, or not smooth.
    #[error("{}", .0.fault)]
    Meaning(GraphError),
}

impl FormulaError {
    /// The byte range of the text that is meant.
    pub fn range(&self) -> Range<usize> {
        match self {
            FormulaError::Syntax(error) => error.range.clone(),
            FormulaError::Meaning(error) => error.range.clone(),
        }
    }
}

impl<N: Number> FormulaPotential<N> {
    /// The potential of a formula in these coordinates, with the values of its parameters.
    ///
    /// # Errors
    /// A text that is no formula, unknown names, functions that are not smooth.
    pub fn new(formula: &str, coordinates: &[&str], parameters: &[(&str, N)]) -> Result<Self, FormulaError> {
        let expression = parse(formula)?;
        let coordinates: Vec<String> = coordinates.iter().map(|name| (*name).to_owned()).collect();
        let names: Vec<String> = parameters.iter().map(|(name, _)| (*name).to_owned()).collect();
        let mut graph = Graph::new();
        let energy = graph.build(&expression, &coordinates, &names).map_err(FormulaError::Meaning)?;
        let programs = graph.potential(energy, coordinates.len());
        let layout = Layout::of(&programs, parameters.len(), coordinates.len());
        Ok(FormulaPotential {
            dimension: coordinates.len(),
            parameters: parameters.iter().map(|(_, value)| value.clone()).collect(),
            programs: PotentialPrograms {
                energy: layout.placed(programs.energy, layout.energy_kept),
                gradient: layout.placed(programs.gradient, layout.gradient_kept),
                gradient_and_rate: layout.placed(programs.gradient_and_rate, layout.gradient_kept),
            },
            layout,
        })
    }

    fn compute(&self, program: &Program, q: &[N], registers: &mut [N]) {
        for (register, q) in registers[self.layout.coordinates..].iter_mut().zip(q) {
            register.assign(q);
        }
        program.instructions.iter().for_each(|instruction| execute(instruction, registers));
    }
}

impl Layout {
    fn of(programs: &PotentialPrograms, parameters: usize, dimension: usize) -> Layout {
        let energy_kept = parameters;
        let gradient_kept = energy_kept + programs.energy.kept;
        let coordinates = gradient_kept + programs.gradient_and_rate.kept;
        let outputs = coordinates + dimension;
        let intermediate = outputs + dimension + 1;
        // constants that are not kept are computed among the intermediate results
        let spare = [&programs.energy, &programs.gradient_and_rate].map(|program| program.constants - program.kept);
        let end = intermediate + programs.scratch().max(spare[0]).max(spare[1]);
        Layout { energy_kept, gradient_kept, coordinates, outputs, intermediate, end }
    }

    /// The program with registers for places.
    fn placed(&self, program: Program, kept_from: usize) -> Program {
        let kept = program.kept;
        let register = |place| {
            Place::Scratch(match place {
                Place::Parameter(j) => j,
                Place::Constant(k) if k < kept => kept_from + k,
                Place::Constant(k) => self.intermediate + k - kept,
                Place::Coordinate(i) => self.coordinates + i,
                Place::Output(o) => self.outputs + o,
                Place::Scratch(s) => self.intermediate + s,
            })
        };
        let placed = |list: Vec<Instruction>| list.into_iter().map(|i| i.with_places(register)).collect();
        Program { prepare: placed(program.prepare), instructions: placed(program.instructions), ..program }
    }
}

impl<N: Number> Potential<N> for FormulaPotential<N> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn scratch(&self) -> usize {
        self.layout.end
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        for (register, parameter) in scratch.iter_mut().zip(&self.parameters) {
            register.assign(parameter);
        }
        for instruction in self.programs.energy.prepare.iter().chain(&self.programs.gradient_and_rate.prepare) {
            match instruction {
                Instruction::AssignRational(place, value) => scratch[index(*place)] = exact(value, context),
                other => execute(other, scratch),
            }
        }
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        self.compute(&self.programs.energy, q, scratch);
        energy.assign(&scratch[self.layout.outputs]);
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        self.compute(&self.programs.gradient, q, scratch);
        for (gradient, output) in gradient.iter_mut().zip(&scratch[self.layout.outputs..]) {
            gradient.assign(output);
        }
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.compute(&self.programs.gradient_and_rate, q, scratch);
        let outputs = &scratch[self.layout.outputs..];
        for (gradient, output) in gradient.iter_mut().zip(outputs) {
            gradient.assign(output);
        }
        rate.assign(&outputs[self.dimension]);
    }
}

fn exact<N: Number>(value: &Rational, context: &N::Context) -> N {
    N::from_rational(value, context)
}

fn index(place: Place) -> usize {
    match place {
        Place::Scratch(register) => register,
        other => unreachable!("{other} is no register"),
    }
}

/// The registers beside the one that is written.
struct Others<'a, N> {
    before: &'a [N],
    after: &'a [N],
}

impl<N> Others<'_, N> {
    fn at(&self, place: Place) -> &N {
        let register = index(place);
        // no operation reads its target
        self.before.get(register).unwrap_or_else(|| &self.after[register - self.before.len() - 1])
    }
}

fn execute<N: Number>(instruction: &Instruction, registers: &mut [N]) {
    use Instruction as I;
    if let I::AssignSinCos(sin, cos, a) = *instruction {
        return assign_sin_cos(registers, index(sin), index(cos), index(a));
    }
    let target = index(instruction.target());
    let (before, rest) = registers.split_at_mut(target);
    let Some((x, after)) = rest.split_first_mut() else { return };
    let of = Others { before, after };
    match *instruction {
        I::AssignZero(_) => x.assign_zero(),
        I::Assign(_, a) => x.assign(of.at(a)),
        I::AssignSum(_, a, b) => x.assign_sum(of.at(a), of.at(b)),
        I::AssignDifference(_, a, b) => x.assign_difference(of.at(a), of.at(b)),
        I::AssignProduct(_, a, b) => x.assign_product(of.at(a), of.at(b)),
        I::AssignQuotient(_, a, b) => x.assign_quotient(of.at(a), of.at(b)),
        I::AssignSquare(_, a) => x.assign_square(of.at(a)),
        I::AssignSqrt(_, a) => x.assign_sqrt(of.at(a)),
        I::AssignReciprocalSqrt(_, a) => x.assign_reciprocal_sqrt(of.at(a)),
        I::AssignRoot(_, a, order) => x.assign_root(of.at(a), order),
        I::AssignFunction(function, _, a) => assign_function(function, x, of.at(a)),
        I::Add(_, a) => x.add(of.at(a)),
        I::Subtract(_, a) => x.subtract(of.at(a)),
        I::Multiply(_, a) => x.multiply(of.at(a)),
        I::Divide(_, a) => x.divide(of.at(a)),
        I::AddProduct(_, a, b) => x.add_product(of.at(a), of.at(b)),
        I::SubtractProduct(_, a, b) => x.subtract_product(of.at(a), of.at(b)),
        I::MultiplyInteger(_, n) => x.multiply_integer(n),
        I::DivideInteger(_, n) => x.divide_integer(n),
        I::Negate(_) => x.negate(),
        I::AssignRational(..) | I::AssignSinCos(..) => unreachable!("done before"),
    }
}

fn assign_sin_cos<N: Number>(registers: &mut [N], sin: usize, cos: usize, a: usize) {
    // three different registers, as no operation reads its target
    if let Ok([sin, cos, a]) = registers.get_disjoint_mut([sin, cos, a]) {
        N::assign_sin_cos(sin, cos, a);
    }
}

fn assign_function<N: Number>(function: Function, x: &mut N, a: &N) {
    match function {
        Function::Exp => x.assign_exp(a),
        Function::Log => x.assign_log(a),
        Function::Sin => x.assign_sin(a),
        Function::Cos => x.assign_cos(a),
        Function::Tan => x.assign_tan(a),
        Function::Sinh => x.assign_sinh(a),
        Function::Cosh => x.assign_cosh(a),
        Function::Tanh => x.assign_tanh(a),
        Function::Atan => x.assign_atan(a),
        Function::Asin => x.assign_asin(a),
        Function::Acos => x.assign_acos(a),
    }
}
