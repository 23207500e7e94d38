//! Numbers of operations of a program.

use std::fmt;

use crate::symbolic::program::instruction::Instruction;

/// Numbers of operations. Copies and negations are not counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct Operations {
    /// additions and subtractions
    pub additions: u64,
    /// multiplications, squares, and multiplications by an integer
    pub multiplications: u64,
    /// divisions, also by an integer
    pub divisions: u64,
    /// roots and reciprocals of square roots
    pub roots: u64,
    /// elementary functions; a sine together with its cosine is one
    pub elementary: u64,
}

impl Operations {
    /// The numbers of operations of a list of instructions.
    pub fn of(instructions: &[Instruction]) -> Self {
        let mut operations = Operations::default();
        for instruction in instructions {
            operations.count(instruction);
        }
        operations
    }

    fn count(&mut self, instruction: &Instruction) {
        use Instruction as I;
        match instruction {
            I::AssignRational(..) | I::AssignZero(..) | I::Assign(..) | I::Negate(..) => {}
            I::AssignSum(..) | I::AssignDifference(..) | I::Add(..) | I::Subtract(..) => self.additions += 1,
            I::AssignSumWithProduct(..) | I::AssignDifferenceWithProduct(..) | I::AddToProduct(..) => {
                self.additions += 1
            }
            I::AssignProduct(..) | I::AssignSquare(..) | I::Multiply(..) | I::MultiplyInteger(..) => {
                self.multiplications += 1;
            }
            I::AddProduct(..) | I::SubtractProduct(..) => {
                self.multiplications += 1;
                self.additions += 1;
            }
            I::AssignQuotient(..) | I::Divide(..) | I::DivideInteger(..) => self.divisions += 1,
            I::AssignSqrt(..) | I::AssignReciprocalSqrt(..) | I::AssignRoot(..) => self.roots += 1,
            I::AssignFunction(..) | I::AssignSinCos(..) => self.elementary += 1,
        }
    }

    /// The approximate time in additions, to compare programs by.
    pub(crate) fn weight(&self) -> u64 {
        self.additions + self.multiplications + 3 * self.divisions + 6 * self.roots + 30 * self.elementary
    }
}

/// As in `2 additions, 1 root`.
impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts = [
            (self.additions, "addition", "additions"),
            (self.multiplications, "multiplication", "multiplications"),
            (self.divisions, "division", "divisions"),
            (self.roots, "root", "roots"),
            (self.elementary, "elementary function", "elementary functions"),
        ];
        let mut separator = "";
        for (count, one, many) in counts.into_iter().filter(|(count, ..)| *count > 0) {
            write!(f, "{separator}{count} {}", if count == 1 { one } else { many })?;
            separator = ", ";
        }
        if separator.is_empty() { f.write_str("no operations") } else { Ok(()) }
    }
}
