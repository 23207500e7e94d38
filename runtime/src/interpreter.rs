//! Programs carried out one instruction after the other, on numbers in registers.

use shadowstep_symbolic::{Function, Instruction, Place, PotentialPrograms, Program};

use crate::Rational;
use crate::number::Number;

/// The programs of a function with its parameters; nothing is allocated when they run.
#[derive(Clone, Debug)]
pub(crate) struct Interpreter<N> {
    parameters: Vec<N>,
    /// All places are registers, in the order of [`Layout`].
    programs: PotentialPrograms,
    layout: Layout,
}

/// Where the registers of each kind begin.
#[derive(Clone, Copy, Debug)]
struct Layout {
    /// After the parameters: what the energy keeps, then what the gradient keeps.
    energy_kept: usize,
    gradient_kept: usize,
    coordinates: usize,
    properties: usize,
    outputs: usize,
    intermediate: usize,
    end: usize,
}

impl<N: Number> Interpreter<N> {
    /// For a function x of so many coordinates and, behind them, properties of bodies.
    pub(crate) fn new(programs: PotentialPrograms, parameters: Vec<N>, coordinates: usize, properties: usize) -> Self {
        let layout = Layout::of(&programs, parameters.len(), [coordinates, properties]);
        let programs = PotentialPrograms {
            energy: layout.placed(programs.energy, layout.energy_kept),
            gradient: layout.placed(programs.gradient, layout.gradient_kept),
            gradient_and_rate: layout.placed(programs.gradient_and_rate, layout.gradient_kept),
        };
        Interpreter { parameters, programs, layout }
    }

    /// How many registers there must be.
    pub(crate) fn registers(&self) -> usize {
        self.layout.end
    }

    /// Computes what the programs keep.
    pub(crate) fn prepare(&self, registers: &mut [N], context: &N::Context) {
        for (register, parameter) in registers.iter_mut().zip(&self.parameters) {
            register.assign(parameter);
        }
        for instruction in self.programs.energy.prepare.iter().chain(&self.programs.gradient_and_rate.prepare) {
            match instruction {
                Instruction::AssignRational(place, value) => registers[index(*place)] = exact(value, context),
                other => execute(other, registers),
            }
        }
    }

    /// The function at x.
    pub(crate) fn energy<'x, 'r>(&self, x: impl IntoIterator<Item = &'x N>, registers: &'r mut [N]) -> &'r N
    where
        N: 'x,
    {
        &self.compute(&self.programs.energy, x, registers)[0]
    }

    /// Its gradient at x, and something more.
    pub(crate) fn gradient<'x, 'r>(&self, x: impl IntoIterator<Item = &'x N>, registers: &'r mut [N]) -> &'r [N]
    where
        N: 'x,
    {
        self.compute(&self.programs.gradient, x, registers)
    }

    /// Its gradient at x, then its rate, and something more.
    pub(crate) fn gradient_and_rate<'x, 'r>(
        &self,
        x: impl IntoIterator<Item = &'x N>,
        registers: &'r mut [N],
    ) -> &'r [N]
    where
        N: 'x,
    {
        self.compute(&self.programs.gradient_and_rate, x, registers)
    }

    fn compute<'x, 'r>(&self, program: &Program, x: impl IntoIterator<Item = &'x N>, registers: &'r mut [N]) -> &'r [N]
    where
        N: 'x,
    {
        for (register, x) in registers[self.layout.coordinates..].iter_mut().zip(x) {
            register.assign(x);
        }
        program.instructions.iter().for_each(|instruction| execute(instruction, registers));
        &registers[self.layout.outputs..]
    }
}

impl Layout {
    fn of(programs: &PotentialPrograms, parameters: usize, arguments: [usize; 2]) -> Layout {
        let energy_kept = parameters;
        let gradient_kept = energy_kept + programs.energy.kept;
        let coordinates = gradient_kept + programs.gradient_and_rate.kept;
        let properties = coordinates + arguments[0];
        let outputs = properties + arguments[1];
        let intermediate = outputs + programs.gradient_and_rate.outputs;
        // constants that are not kept are computed among the intermediate results
        let spare = [&programs.energy, &programs.gradient_and_rate].map(|program| program.constants - program.kept);
        let end = intermediate + programs.scratch().max(spare[0]).max(spare[1]);
        Layout { energy_kept, gradient_kept, coordinates, properties, outputs, intermediate, end }
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
                Place::Property(i) => self.properties + i,
                Place::Output(o) => self.outputs + o,
                Place::Scratch(s) => self.intermediate + s,
            })
        };
        let placed = |list: Vec<Instruction>| list.into_iter().map(|i| i.with_places(register)).collect();
        Program { prepare: placed(program.prepare), instructions: placed(program.instructions), ..program }
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
