//! Programs carried out one instruction after the other, on numbers in registers, or on blocks of numbers.

use shadowstep_schemes::symbolic::{Function, Instruction, Place, PotentialPrograms, Program};

use std::hint::black_box;

use crate::Rational;
use crate::number::{Number, instructions};
use crate::systems::pairs::BLOCKS_AT_ONCE;

/// The programs of a function with its parameters; nothing is allocated when they run.
#[derive(Clone, Debug)]
pub(crate) struct Interpreter<N> {
    parameters: Vec<N>,
    prepare: Vec<Instruction<Slot>>,
    energy: Vec<Instruction<Slot>>,
    gradient: Vec<Instruction<Slot>>,
    gradient_and_rate: Vec<Instruction<Slot>>,
    layout: Layout,
}

/// Where an operand is, or a target.
#[derive(Clone, Copy, Debug)]
struct Slot {
    side: Side,
    index: u32,
}

/// Seen from the register that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// A register before it; the target itself is given as such a one.
    Before,
    /// A register after it, counted from the next one.
    After,
    /// A coordinate.
    Coordinate,
}

/// Where the registers of each kind begin.
#[derive(Clone, Copy, Debug)]
struct Layout {
    /// After the parameters: what the energy keeps, then what the gradient keeps.
    energy_kept: usize,
    gradient_kept: usize,
    properties: usize,
    outputs: usize,
    intermediate: usize,
    end: usize,
}

impl<N: Number> Interpreter<N> {
    /// For the programs of a function with this number of properties of bodies, with the values of its parameters.
    pub(crate) fn new(programs: &PotentialPrograms, parameters: Vec<N>, properties: usize) -> Self {
        let layout = Layout::of(programs, parameters.len(), properties);
        let PotentialPrograms { energy, gradient, gradient_and_rate, .. } = programs;
        let place = |program: &Program, list: &[Instruction], kept_from| layout.placed(program, list, kept_from);
        let mut prepare = place(energy, &energy.prepare, layout.energy_kept);
        prepare.extend(place(gradient_and_rate, &gradient_and_rate.prepare, layout.gradient_kept));
        let run = |program: &Program, kept_from| place(program, &program.instructions, kept_from);
        Interpreter {
            parameters,
            prepare,
            energy: run(energy, layout.energy_kept),
            gradient: run(gradient, layout.gradient_kept),
            gradient_and_rate: run(gradient_and_rate, layout.gradient_kept),
            layout,
        }
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
        for instruction in &self.prepare {
            match instruction {
                Instruction::AssignRational(slot, value) => registers[slot.index as usize] = exact(value, context),
                other => execute::<N, 1, 1>(other, registers.as_chunks_mut().0, &[], 1),
            }
        }
    }

    /// The places of properties of bodies, to be filled before each call; `in_each` numbers or blocks each.
    pub(crate) fn properties<'r, R>(&self, registers: &'r mut [R], in_each: usize) -> &'r mut [R] {
        &mut registers[in_each * self.layout.properties..in_each * self.layout.outputs]
    }

    /// The function at x.
    pub(crate) fn energy<'r>(&self, x: &[N], registers: &'r mut [N]) -> &'r mut N {
        &mut self.compute(&self.energy, x, registers)[0]
    }

    /// The function of one number at blocks of them: the registers of [`BLOCKS`] blocks are side by side, and so are
    /// the results.
    pub(crate) fn energies<'r, const W: usize>(&self, x: &[[N; W]], registers: &'r mut [[N; W]]) -> &'r mut [[N; W]] {
        self.compute_blocks(&self.energy, x, registers)
    }

    /// Its derivative there.
    pub(crate) fn slopes<'r, const W: usize>(&self, x: &[[N; W]], registers: &'r mut [[N; W]]) -> &'r mut [[N; W]] {
        self.compute_blocks(&self.gradient, x, registers)
    }

    /// Its derivative there, then, from the block number [`BLOCKS`] on, the summand.
    pub(crate) fn slopes_and_summands<'r, const W: usize>(
        &self,
        x: &[[N; W]],
        registers: &'r mut [[N; W]],
    ) -> &'r mut [[N; W]] {
        self.compute_blocks(&self.gradient_and_rate, x, registers)
    }

    /// Not inlined: the programs of blocks are compiled once for each kind of instructions.
    #[inline(never)]
    fn compute_blocks<'r, const W: usize>(
        &self,
        program: &[Instruction<Slot>],
        x: &[[N; W]],
        registers: &'r mut [[N; W]],
    ) -> &'r mut [[N; W]] {
        instructions::widest(
            #[inline(always)]
            || execute_all::<N, W, BLOCKS_AT_ONCE>(program, registers, x, x.len()),
        );
        &mut registers[BLOCKS_AT_ONCE * self.layout.outputs..]
    }

    /// Its gradient at x, and something more; all may be swapped with other numbers.
    pub(crate) fn gradient<'r>(&self, x: &[N], registers: &'r mut [N]) -> &'r mut [N] {
        self.compute(&self.gradient, x, registers)
    }

    /// The gradients of several systems at their x, in whose registers there is what was prepared for each: one
    /// instruction after the other, for all of them; the index of the first register of results. Not inlined: compiled
    /// once for each kind of instructions.
    #[inline(never)]
    pub(crate) fn gradients<const W: usize>(&self, x: &[[N; W]], registers: &mut [[N; W]]) -> usize {
        N::in_widest_instructions(
            #[inline(always)]
            || execute_all::<N, W, 1>(&self.gradient, registers, x, 1),
        );
        self.layout.outputs
    }

    /// Its gradient at x, then its rate, of a pair its summand, and something more; all may be swapped with other
    /// numbers.
    pub(crate) fn gradient_and_rate<'r>(&self, x: &[N], registers: &'r mut [N]) -> &'r mut [N] {
        self.compute(&self.gradient_and_rate, x, registers)
    }

    fn compute<'r>(&self, program: &[Instruction<Slot>], x: &[N], registers: &'r mut [N]) -> &'r mut [N] {
        let (blocks, _) = registers.as_chunks_mut();
        N::in_widest_instructions(
            #[inline(always)]
            || execute_all::<N, 1, 1>(program, blocks, x.as_chunks().0, 1),
        );
        &mut registers[self.layout.outputs..]
    }
}

impl Layout {
    fn of(programs: &PotentialPrograms, parameters: usize, properties: usize) -> Layout {
        let energy_kept = parameters;
        let gradient_kept = energy_kept + programs.energy.kept;
        let first_property = gradient_kept + programs.gradient_and_rate.kept;
        let outputs = first_property + properties;
        let intermediate = outputs + programs.gradient_and_rate.outputs.max(programs.energy.outputs);
        // constants that are not kept are computed among the intermediate results
        let spare = [&programs.energy, &programs.gradient_and_rate].map(|program| program.constants - program.kept);
        let end = intermediate + programs.scratch().max(spare[0]).max(spare[1]);
        Layout { energy_kept, gradient_kept, properties: first_property, outputs, intermediate, end }
    }

    /// The instructions of a program with slots for places.
    fn placed(&self, program: &Program, instructions: &[Instruction], kept_from: usize) -> Vec<Instruction<Slot>> {
        let register = |place| match place {
            Place::Parameter(j) => j,
            Place::Constant(k) if k < program.kept => kept_from + k,
            Place::Constant(k) => self.intermediate + k - program.kept,
            Place::Property(i) => self.properties + i,
            Place::Output(o) => self.outputs + o,
            Place::Scratch(s) => self.intermediate + s,
            Place::Coordinate(_) => unreachable!("a coordinate is in no register"),
        };
        let placed = |instruction: &Instruction| {
            let target = register(instruction.target());
            instruction.clone().with_places(|place| match place {
                Place::Coordinate(i) => slot(Side::Coordinate, i),
                _ if register(place) > target => slot(Side::After, register(place) - target - 1),
                _ => slot(Side::Before, register(place)),
            })
        };
        instructions.iter().map(placed).collect()
    }
}

fn slot(side: Side, index: usize) -> Slot {
    Slot { side, index: u32::try_from(index).expect("fewer registers than 2^32: memory ends before") }
}

fn exact<N: Number>(value: &Rational, context: &N::Context) -> N {
    N::from_rational(value, context)
}

#[inline(always)]
fn execute_all<N: Number, const W: usize, const B: usize>(
    program: &[Instruction<Slot>],
    registers: &mut [[N; W]],
    x: &[[N; W]],
    blocks: usize,
) {
    for instruction in program {
        execute::<N, W, B>(instruction, registers, x, blocks);
    }
}

/// The same operation on each number of the blocks. Results are written when all is read, as for all that the compiler
/// knows the places are the same: of numbers in vectors a block at once, of lanes one after the other. Long numbers are
/// not copied.
macro_rules! each_number {
    ($N:ident, $W:ident, $of:ident, $target:ident, $operation:ident $(, $name:ident)*; $($constant:expr)?) => {{
        $(let $name = $of.at($name);)*
        for block in 0..$of.blocks {
            // else the compiler would make vectors of one number of each block
            let block = if $W == 1 { block } else { black_box(block) };
            if $N::IN_VECTORS && $W > 1 {
                let mut results = $target[block].clone();
                for l in 0..$W {
                    results[l].$operation($(&$name[block][l],)* $($constant)?);
                }
                $target[block] = results;
            } else {
                for l in 0..$W {
                    if $N::LANES > 1 {
                        let mut result = $target[block][l].clone();
                        result.$operation($(&$name[block][l],)* $($constant)?);
                        $target[block][l] = result;
                    } else {
                        $target[block][l].$operation($(&$name[block][l],)* $($constant)?);
                    }
                }
            }
        }
    }};
}

/// Carries out an instruction on the first blocks of each register, which has B of them.
#[inline(always)]
fn execute<N: Number, const W: usize, const B: usize>(
    instruction: &Instruction<Slot>,
    registers: &mut [[N; W]],
    x: &[[N; W]],
    blocks: usize,
) {
    use Instruction as I;
    let (before, rest) = registers.split_at_mut(B * instruction.target().index as usize);
    if rest.len() < B {
        return;
    }
    let (target, after) = rest.split_at_mut(B);
    let target = &mut target[..blocks];
    if let I::AssignSinCos(_, cos, a) = *instruction {
        return assign_sin_cos::<N, W, B>(target, cos, a, [before, after], x);
    }
    let of = Operands::<_, B> { sides: [before, after, x], blocks };
    macro_rules! each {
        ($operation:ident $(, $name:ident)*; $($constant:expr)?) => {
            each_number!(N, W, of, target, $operation $(, $name)*; $($constant)?)
        };
    }
    match *instruction {
        I::AssignZero(_) => each!(assign_zero;),
        I::Assign(_, a) => each!(assign, a;),
        I::AssignSum(_, a, b) => each!(assign_sum, a, b;),
        I::AssignDifference(_, a, b) => each!(assign_difference, a, b;),
        I::AssignProduct(_, a, b) => each!(assign_product, a, b;),
        I::AssignQuotient(_, a, b) => each!(assign_quotient, a, b;),
        I::AssignSquare(_, a) => each!(assign_square, a;),
        I::AssignSqrt(_, a) => each!(assign_sqrt, a;),
        I::AssignReciprocalSqrt(_, a) => each!(assign_reciprocal_sqrt, a;),
        I::AssignRoot(_, a, order) => each!(assign_root, a; order),
        I::AssignFunction(function, _, a) => {
            for (target, a) in target.iter_mut().zip(of.at(a)) {
                target.iter_mut().zip(a).for_each(|(x, a)| assign_function(function, x, a));
            }
        }
        I::Add(_, a) => each!(add, a;),
        I::Subtract(_, a) => each!(subtract, a;),
        I::Multiply(_, a) => each!(multiply, a;),
        I::Divide(_, a) => each!(divide, a;),
        I::AddProduct(_, a, b) => each!(add_product, a, b;),
        I::SubtractProduct(_, a, b) => each!(subtract_product, a, b;),
        I::AssignSumWithProduct(_, c, t, a, b) => each!(assign_sum_with_product, c, t, a, b;),
        I::AssignDifferenceWithProduct(_, c, t, a, b) => {
            each!(assign_difference_with_product, c, t, a, b;);
        }
        I::AddToProduct(_, c, a, b) => each!(add_to_product, c, a, b;),
        I::MultiplyInteger(_, n) => each!(multiply_integer; n),
        I::DivideInteger(_, n) => each!(divide_integer; n),
        I::Negate(_) => each!(negate;),
        I::AssignRational(..) | I::AssignSinCos(..) => unreachable!("done before"),
    }
}

/// What can be read beside the register that is written, by its side: B blocks of each register.
struct Operands<'a, R, const B: usize> {
    sides: [&'a [R]; 3],
    blocks: usize,
}

impl<'a, R, const B: usize> Operands<'a, R, B> {
    /// The first blocks.
    #[inline(always)]
    fn at(&self, slot: Slot) -> &'a [R] {
        &self.sides[slot.side as usize][B * slot.index as usize..][..self.blocks]
    }
}

/// The cosine and its argument are on either side of the sine.
fn assign_sin_cos<N: Number, const W: usize, const B: usize>(
    sin: &mut [[N; W]],
    cos: Slot,
    a: Slot,
    [before, after]: [&mut [[N; W]]; 2],
    x: &[[N; W]],
) {
    let (own, other, others_side) = match cos.side {
        Side::Before => (before, after, Side::After),
        Side::After | Side::Coordinate => (after, before, Side::Before),
    };
    let (low, rest) = own.split_at_mut(B * cos.index as usize);
    if rest.len() < B {
        return;
    }
    let (cos_target, high) = rest.split_at_mut(B);
    let index = B * a.index as usize;
    let argument = match a.side {
        Side::Coordinate => &x[index..],
        side if side == others_side => &other[index..],
        _ if index > low.len() => &high[index - low.len() - B..],
        _ => &low[index..],
    };
    for block in 0..sin.len() {
        for l in 0..W {
            N::assign_sin_cos(&mut sin[block][l], &mut cos_target[block][l], &argument[block][l]);
        }
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
