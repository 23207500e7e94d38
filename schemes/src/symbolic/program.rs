//! Straight-line programs of in-place arithmetic.

mod factor;
pub(crate) mod instruction;
mod lower;
pub(crate) mod operations;
pub(crate) mod potential;

use std::fmt;

use crate::symbolic::number::function::Function;
use crate::symbolic::program::instruction::{Instruction, Place};
use crate::symbolic::program::operations::Operations;

/// A list of operations that computes formulas.
///
/// [`Graph::program`](crate::symbolic::Graph::program) makes it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Program {
    /// Computes the constants, once, from exact numbers and the parameters.
    pub prepare: Vec<Instruction>,
    /// Computes the outputs from coordinates, parameters and constants.
    pub instructions: Vec<Instruction>,
    /// How many constants there are. `prepare` uses those from [`Program::kept`] on for intermediate results.
    pub constants: usize,
    /// How many of the constants, the first ones, are read by `instructions`.
    pub kept: usize,
    /// How many scratch places `instructions` uses.
    pub scratch: usize,
    /// How many outputs there are.
    pub outputs: usize,
}

impl Program {
    /// The numbers of operations of `instructions`, without the operations of `prepare`.
    pub fn cost(&self) -> Operations {
        Operations::of(&self.instructions)
    }

    /// The program without its last output. Operations that only this output needs are removed and all others kept, so
    /// that the other outputs have the same bits. Intermediate results in the removed output move to a scratch place.
    pub fn without_last_output(&self) -> Program {
        let outputs = self.outputs.saturating_sub(1);
        let (dropped, spare) = (Place::Output(outputs), Place::Scratch(self.scratch));
        let mut needed: Vec<Place> = (0..outputs).map(Place::Output).collect();
        let mut instructions = Vec::new();
        for instruction in self.instructions.iter().rev() {
            let targets = instruction.targets();
            if !targets.iter().any(|target| needed.contains(target)) {
                continue;
            }
            let instruction = match *instruction {
                // sine and cosine are rounded separately: one alone has the same bits
                Instruction::AssignSinCos(sin, cos, a) if !needed.contains(&cos) => {
                    Instruction::AssignFunction(Function::Sin, sin, a)
                }
                Instruction::AssignSinCos(sin, cos, a) if !needed.contains(&sin) => {
                    Instruction::AssignFunction(Function::Cos, cos, a)
                }
                _ => instruction.clone(),
            };
            if instruction.overwrites() {
                needed.retain(|place| !targets.contains(place));
            }
            needed.extend(instruction.operands());
            instructions.push(instruction.with_places(|place| if place == dropped { spare } else { place }));
        }
        instructions.reverse();
        let uses_spare = instructions.iter().any(|i: &Instruction| i.targets().contains(&spare));
        Program { instructions, outputs, scratch: self.scratch + usize::from(uses_spare), ..self.clone() }
    }
}

/// One instruction a line, first the instructions of `prepare`.
impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.prepare.iter().chain(&self.instructions).try_for_each(|instruction| writeln!(f, "{instruction}"))
    }
}
