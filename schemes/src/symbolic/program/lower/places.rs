//! The places of values, and the instructions that compute them there.
//!
//! Values that are computed in place from each other are a chain, which has one place: an output if the chain ends as
//! one, otherwise an output that is not yet needed, otherwise a scratch place.

use std::collections::HashMap;

use super::sequence::{Operation, Sequence, Value};
use crate::symbolic::number::function::Function;
use crate::symbolic::program::instruction::{Instruction, Place};

/// A time after all operations, when the outputs are read.
const END: usize = usize::MAX;

/// The program of a sequence.
pub(super) struct Placed {
    pub(super) instructions: Vec<Instruction>,
    pub(super) scratch: usize,
}

/// Writes the instructions.
pub(super) fn place(sequence: &Sequence, outputs: usize) -> Placed {
    let schedule = Schedule::of(sequence);
    let chains = Chains::of(&schedule);
    let (places, scratch) = chains.places(outputs);
    let mut writer = Writer { schedule: &schedule, chains: &chains, places, instructions: Vec::new() };
    for time in 0..schedule.steps.len() {
        writer.step(time);
    }
    writer.copy_outputs(outputs);
    Placed { instructions: writer.instructions, scratch }
}

/// When values are computed, and how long they are needed.
struct Schedule<'a> {
    sequence: &'a Sequence,
    /// The values computed at each time: one, or a sine and its cosine.
    steps: Vec<Vec<Value>>,
    /// Whether a product is added to a sum immediately, without a place.
    fused: Vec<bool>,
    /// When a value is read for the last time.
    last_use: Vec<usize>,
}

impl<'a> Schedule<'a> {
    fn of(sequence: &'a Sequence) -> Self {
        let fused = fused(sequence);
        let calls: HashMap<&Operation, Value> =
            sequence.operations.iter().enumerate().map(|(value, operation)| (operation, value)).collect();
        let mut steps: Vec<Vec<Value>> = Vec::new();
        let mut done = vec![false; sequence.operations.len()];
        for (value, operation) in sequence.operations.iter().enumerate() {
            if done[value] || fused[value] || matches!(operation, Operation::Leaf(_)) {
                continue;
            }
            let mut step = vec![value];
            if let Operation::Call(function @ (Function::Sin | Function::Cos), argument) = operation {
                let other = if *function == Function::Sin { Function::Cos } else { Function::Sin };
                step.extend(calls.get(&Operation::Call(other, *argument)));
                step.sort_by_key(|call| matches!(sequence.operations[*call], Operation::Call(Function::Cos, _)));
            }
            step.iter().for_each(|value| done[*value] = true);
            steps.push(step);
        }
        let mut schedule = Schedule { sequence, steps, last_use: vec![0; fused.len()], fused };
        schedule.find_last_uses();
        schedule
    }

    fn find_last_uses(&mut self) {
        for time in 0..self.steps.len() {
            for operand in self.read(time) {
                self.last_use[operand] = time;
            }
        }
        self.sequence.outputs.iter().flatten().for_each(|output| self.last_use[*output] = END);
    }

    fn operation(&self, value: Value) -> &Operation {
        &self.sequence.operations[value]
    }

    /// What is read at a time, through fused products.
    fn read(&self, time: usize) -> Vec<Value> {
        let operands = self.operation(self.steps[time][0]).operands();
        let through = |value| if self.fused[value] { self.operation(value).operands() } else { vec![value] };
        operands.into_iter().flat_map(through).collect()
    }

    /// Whether a value may be changed at a time: it has its own place and is not read later.
    fn dies(&self, value: Value, time: usize) -> bool {
        !self.fused[value] && !matches!(self.operation(value), Operation::Leaf(_)) && self.last_use[value] == time
    }

    /// The operand that becomes the result by an operation in place.
    fn in_place(&self, time: usize) -> Option<Value> {
        let dies = |value: &Value| self.dies(*value, time);
        match self.operation(self.steps[time][0]) {
            Operation::Scale(a, _) | Operation::Shrink(a, _) | Operation::Negate(a) => Some(*a).filter(dies),
            Operation::Product(a, b) if a != b => [*a, *b].into_iter().find(dies),
            Operation::Quotient(a, b) if a != b => Some(*a).filter(dies),
            Operation::Sum(parts) => {
                let read = self.read(time);
                let once = |value: &Value| read.iter().filter(|other| *other == value).count() == 1;
                parts
                    .iter()
                    .filter(|(negative, _)| !negative)
                    .map(|(_, part)| *part)
                    .find(|part| dies(part) && once(part))
            }
            _ => None,
        }
    }
}

/// Products that only one sum needs.
fn fused(sequence: &Sequence) -> Vec<bool> {
    let mut uses = vec![0; sequence.operations.len()];
    let mut in_sum = vec![false; sequence.operations.len()];
    for operation in &sequence.operations {
        for operand in operation.operands() {
            uses[operand] += 1;
            in_sum[operand] = matches!(operation, Operation::Sum(_));
        }
    }
    sequence.outputs.iter().flatten().for_each(|output| uses[*output] += 1);
    let product = |value: Value| matches!(sequence.operations[value], Operation::Product(..));
    (0..uses.len()).map(|value| product(value) && uses[value] == 1 && in_sum[value]).collect()
}

/// Values that follow each other in one place.
struct Chain {
    /// When the place is written first.
    start: usize,
    /// When it is read last.
    end: usize,
    /// The output that it ends as.
    output: Option<usize>,
}

struct Chains {
    chains: Vec<Chain>,
    /// The chain of each value that has one.
    of_value: HashMap<Value, usize>,
}

impl Chains {
    fn of(schedule: &Schedule) -> Self {
        let mut all = Chains { chains: Vec::new(), of_value: HashMap::new() };
        for (time, step) in schedule.steps.iter().enumerate() {
            let before = schedule.in_place(time).map(|value| all.of_value[&value]);
            for value in step {
                let chain = before.unwrap_or_else(|| {
                    all.chains.push(Chain { start: time, end: time, output: None });
                    all.chains.len() - 1
                });
                all.of_value.insert(*value, chain);
                all.chains[chain].end = schedule.last_use[*value].max(time);
                all.chains[chain].output = schedule.sequence.outputs.iter().position(|output| *output == Some(*value));
            }
        }
        all
    }

    /// The place of each chain, and how many scratch places there are.
    fn places(&self, outputs: usize) -> (Vec<Place>, usize) {
        // The time from which an output holds its own chain, and the time until which another chain uses it.
        let mut needed = vec![END; outputs];
        for chain in &self.chains {
            if let Some(output) = chain.output {
                needed[output] = chain.start;
            }
        }
        let mut lent: Vec<Option<usize>> = vec![None; outputs];
        let mut scratch: Vec<usize> = Vec::new();
        let mut places = Vec::new();
        for chain in &self.chains {
            let free = |until: Option<usize>| until.is_none_or(|until| until < chain.start);
            let place = if let Some(output) = chain.output {
                Place::Output(output)
            } else if let Some(output) = (0..outputs).find(|output| chain.end < needed[*output] && free(lent[*output]))
            {
                lent[output] = Some(chain.end);
                Place::Output(output)
            } else {
                let index = scratch.iter().position(|until| free(Some(*until))).unwrap_or(scratch.len());
                scratch.resize(scratch.len().max(index + 1), 0);
                scratch[index] = chain.end;
                Place::Scratch(index)
            };
            places.push(place);
        }
        (places, scratch.len())
    }
}

struct Writer<'a> {
    schedule: &'a Schedule<'a>,
    chains: &'a Chains,
    places: Vec<Place>,
    instructions: Vec<Instruction>,
}

impl Writer<'_> {
    fn place(&self, value: Value) -> Place {
        match self.schedule.operation(value) {
            Operation::Leaf(place) => *place,
            _ => self.places[self.chains.of_value[&value]],
        }
    }

    fn push(&mut self, instruction: Instruction) {
        self.instructions.push(instruction);
    }

    fn step(&mut self, time: usize) {
        let schedule = self.schedule;
        let step = &schedule.steps[time];
        let target = self.place(step[0]);
        let changed = schedule.in_place(time);
        match schedule.operation(step[0]) {
            Operation::Leaf(_) => unreachable!("a leaf is not computed"),
            Operation::Number(index) => {
                self.push(Instruction::AssignRational(target, schedule.sequence.numbers[*index].clone()));
            }
            Operation::Sum(parts) => self.sum(target, parts, changed),
            Operation::Product(a, b) => self.product(target, *a, *b, changed),
            Operation::Quotient(a, b) => {
                let (a, b) = (self.place(*a), self.place(*b));
                self.push(match changed {
                    Some(_) => Instruction::Divide(target, b),
                    None => Instruction::AssignQuotient(target, a, b),
                });
            }
            Operation::Scale(a, n) => self.change(target, *a, changed, Instruction::MultiplyInteger(target, *n)),
            Operation::Shrink(a, n) => self.change(target, *a, changed, Instruction::DivideInteger(target, *n)),
            Operation::Negate(a) => self.change(target, *a, changed, Instruction::Negate(target)),
            Operation::Sqrt(a) => self.push(Instruction::AssignSqrt(target, self.place(*a))),
            Operation::ReciprocalSqrt(a) => self.push(Instruction::AssignReciprocalSqrt(target, self.place(*a))),
            Operation::Root(a, order) => self.push(Instruction::AssignRoot(target, self.place(*a), *order)),
            Operation::Call(function, a) => self.push(match step.get(1) {
                Some(cos) => Instruction::AssignSinCos(target, self.place(*cos), self.place(*a)),
                None => Instruction::AssignFunction(*function, target, self.place(*a)),
            }),
        }
    }

    /// A change of a value, or of its copy.
    fn change(&mut self, target: Place, operand: Value, changed: Option<Value>, change: Instruction) {
        if changed.is_none() {
            self.push(Instruction::Assign(target, self.place(operand)));
        }
        self.push(change);
    }

    fn product(&mut self, target: Place, a: Value, b: Value, changed: Option<Value>) {
        let other = if changed == Some(a) { b } else { a };
        let instruction = match changed {
            Some(_) => Instruction::Multiply(target, self.place(other)),
            None if a == b => Instruction::AssignSquare(target, self.place(a)),
            None => Instruction::AssignProduct(target, self.place(a), self.place(b)),
        };
        self.push(instruction);
    }

    /// A sum begins with the part that is changed in place, with two values, or with a product; then comes the rest.
    fn sum(&mut self, target: Place, parts: &[(bool, Value)], changed: Option<Value>) {
        // Without a positive part, the opposite is computed.
        let opposite = parts.iter().all(|(negative, _)| *negative);
        let mut parts: Vec<_> = parts.iter().map(|(negative, part)| (*negative != opposite, *part)).collect();
        match changed {
            Some(changed) => parts.retain(|(_, part)| *part != changed),
            None => self.begin(target, &mut parts),
        }
        for (negative, part) in parts {
            self.add(target, negative, part);
        }
        if opposite {
            self.push(Instruction::Negate(target));
        }
    }

    /// Takes the first part or two from a sum with a positive part, and writes them.
    fn begin(&mut self, target: Place, parts: &mut Vec<(bool, Value)>) {
        let fused = &self.schedule.fused;
        let first_value = parts.iter().position(|(negative, part)| !negative && !fused[*part]);
        let product = parts.iter().position(|(negative, part)| !negative && fused[*part]);
        let values = parts.iter().filter(|(_, part)| !fused[*part]).count();
        match (first_value, product) {
            (Some(index), _) if values > 1 => {
                let (_, a) = parts.remove(index);
                let second = parts.iter().position(|(_, part)| !fused[*part]).expect("there is another value");
                let (negative, b) = parts.remove(second);
                let assign = if negative { Instruction::AssignDifference } else { Instruction::AssignSum };
                self.push(assign(target, self.place(a), self.place(b)));
            }
            (_, Some(index)) => {
                let (_, part) = parts.remove(index);
                let operands = self.schedule.operation(part).operands();
                self.product(target, operands[0], operands[1], None);
            }
            (Some(index), None) => {
                let (_, part) = parts.remove(index);
                self.push(Instruction::Assign(target, self.place(part)));
            }
            (None, None) => unreachable!("there is a positive part"),
        }
    }

    fn add(&mut self, target: Place, negative: bool, part: Value) {
        let instruction = if self.schedule.fused[part] {
            let operands = self.schedule.operation(part).operands();
            let (a, b) = (self.place(operands[0]), self.place(operands[1]));
            if negative { Instruction::SubtractProduct(target, a, b) } else { Instruction::AddProduct(target, a, b) }
        } else {
            let a = self.place(part);
            if negative { Instruction::Subtract(target, a) } else { Instruction::Add(target, a) }
        };
        self.push(instruction);
    }

    /// Outputs without a chain: zeros, coordinates, constants, and repetitions.
    fn copy_outputs(&mut self, outputs: usize) {
        for output in 0..outputs {
            let target = Place::Output(output);
            match self.schedule.sequence.outputs[output] {
                None => self.push(Instruction::AssignZero(target)),
                Some(value) if self.place(value) != target => self.push(Instruction::Assign(target, self.place(value))),
                Some(_) => {}
            }
        }
    }
}
