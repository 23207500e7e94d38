//! From nodes to a program.
//!
//! [`collect`] lists what is computed: sums, products of atoms, functions. [`products`] and [`sums`] find their common
//! parts. [`sequence`] splits them into operations with two operands, in order. [`places`] assigns a place to each
//! result and writes the instructions. [`known_products`] gives sums the factors of their products.

mod collect;
mod known_products;
mod places;
mod products;
mod sequence;
mod sums;

use crate::symbolic::graph::{Graph, Node};
use crate::symbolic::program::Program;
use crate::symbolic::program::instruction::{Instruction, Place};

/// The program for the outputs, without a search for a better form of the formulas.
pub(crate) fn program(graph: &mut Graph, outputs: &[Node]) -> Program {
    let plan = collect::plan(graph, outputs, collect::Stage::Main);
    let hoisted = plan.hoisted.clone();
    let main = places::place(&sequence::sequence(plan), outputs.len());
    let early =
        places::place(&sequence::sequence(collect::plan(graph, &hoisted, collect::Stage::Prepare)), hoisted.len());
    Program {
        prepare: early.instructions.into_iter().map(|instruction| to_constants(instruction, hoisted.len())).collect(),
        instructions: known_products::with_factors(main.instructions),
        constants: hoisted.len() + early.scratch,
        kept: hoisted.len(),
        scratch: main.scratch,
        outputs: outputs.len(),
    }
}

/// The instruction with outputs, and after them scratch places, replaced by constants.
fn to_constants(instruction: Instruction, kept: usize) -> Instruction {
    instruction.with_places(|place| match place {
        Place::Output(index) => Place::Constant(index),
        Place::Scratch(index) => Place::Constant(kept + index),
        other => other,
    })
}
