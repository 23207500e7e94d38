//! Operations in place, and the places of numbers.

use std::fmt;

use crate::symbolic::number::function::Function;
use crate::symbolic::number::rational::Rational;

/// The place of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Place {
    /// The coordinate with this index; never written.
    Coordinate(usize),
    /// The parameter with this index; never written.
    Parameter(usize),
    /// The property of bodies with this index; never written.
    Property(usize),
    /// The constant with this index; written in [`Program::prepare`](crate::symbolic::Program::prepare) only.
    Constant(usize),
    /// A number for intermediate results.
    Scratch(usize),
    /// The result with this index. Before it holds the result it may hold intermediate ones.
    Output(usize),
}

/// One operation. Its first place is its target; `P` is [`Place`], or another type for places.
///
/// An `Assign…` does not read its target. The other operands of an operation are never at its target, so that the
/// target can be borrowed mutably and the operands immutably.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Instruction<P = Place> {
    /// x ← an exact number, rounded once; in [`Program::prepare`](crate::symbolic::Program::prepare) only
    AssignRational(P, Rational),
    /// x ← 0
    AssignZero(P),
    /// x ← a
    Assign(P, P),
    /// x ← a + b
    AssignSum(P, P, P),
    /// x ← a − b
    AssignDifference(P, P, P),
    /// x ← a b
    AssignProduct(P, P, P),
    /// x ← a / b
    AssignQuotient(P, P, P),
    /// x ← a²
    AssignSquare(P, P),
    /// x ← √a
    AssignSqrt(P, P),
    /// x ← 1/√a
    AssignReciprocalSqrt(P, P),
    /// x ← the real root of a of this order, at least 3; of a negative number, too, if the order is odd
    AssignRoot(P, P, u32),
    /// x ← f(a)
    AssignFunction(Function, P, P),
    /// x ← sin a, y ← cos a
    AssignSinCos(P, P, P),
    /// x ← x + a
    Add(P, P),
    /// x ← x − a
    Subtract(P, P),
    /// x ← x a
    Multiply(P, P),
    /// x ← x / a
    Divide(P, P),
    /// x ← x + a b
    AddProduct(P, P, P),
    /// x ← x − a b
    SubtractProduct(P, P, P),
    /// x ← c + t, where t is a b, with c, t, a and b in this order
    AssignSumWithProduct(P, P, P, P, P),
    /// x ← c − t, where t is a b, with the same rounding
    AssignDifferenceWithProduct(P, P, P, P, P),
    /// x ← x + c, where x is a b, with c, a and b in this order
    AddToProduct(P, P, P, P),
    /// x ← n x
    MultiplyInteger(P, i32),
    /// x ← x / n
    DivideInteger(P, i32),
    /// x ← −x
    Negate(P),
}

impl<P: Copy> Instruction<P> {
    /// The name of the method of the target, as in `target.assign_sum(a, b)`.
    ///
    /// `assign_sin_cos` writes to two numbers; [`AssignRational`](Instruction::AssignRational) has a constructor,
    /// `from_rational`.
    pub fn method(&self) -> String {
        let name = match self {
            Instruction::AssignRational(..) => "from_rational",
            Instruction::AssignZero(..) => "assign_zero",
            Instruction::Assign(..) => "assign",
            Instruction::AssignSum(..) => "assign_sum",
            Instruction::AssignDifference(..) => "assign_difference",
            Instruction::AssignProduct(..) => "assign_product",
            Instruction::AssignQuotient(..) => "assign_quotient",
            Instruction::AssignSquare(..) => "assign_square",
            Instruction::AssignSqrt(..) => "assign_sqrt",
            Instruction::AssignReciprocalSqrt(..) => "assign_reciprocal_sqrt",
            Instruction::AssignRoot(..) => "assign_root",
            Instruction::AssignFunction(function, ..) => return format!("assign_{function}"),
            Instruction::AssignSinCos(..) => "assign_sin_cos",
            Instruction::Add(..) => "add",
            Instruction::Subtract(..) => "subtract",
            Instruction::Multiply(..) => "multiply",
            Instruction::Divide(..) => "divide",
            Instruction::AddProduct(..) => "add_product",
            Instruction::SubtractProduct(..) => "subtract_product",
            Instruction::AssignSumWithProduct(..) => "assign_sum_with_product",
            Instruction::AssignDifferenceWithProduct(..) => "assign_difference_with_product",
            Instruction::AddToProduct(..) => "add_to_product",
            Instruction::MultiplyInteger(..) => "multiply_integer",
            Instruction::DivideInteger(..) => "divide_integer",
            Instruction::Negate(..) => "negate",
        };
        name.to_string()
    }

    /// The target: the first place.
    pub fn target(&self) -> P {
        use Instruction as I;
        match *self {
            I::AssignRational(x, _) | I::AssignZero(x) | I::MultiplyInteger(x, _) | I::DivideInteger(x, _) => x,
            I::Negate(x) | I::Assign(x, _) | I::AssignSquare(x, _) | I::AssignSqrt(x, _) => x,
            I::AssignReciprocalSqrt(x, _) | I::AssignRoot(x, _, _) | I::AssignFunction(_, x, _) => x,
            I::Add(x, _) | I::Subtract(x, _) | I::Multiply(x, _) | I::Divide(x, _) => x,
            I::AssignSum(x, _, _) | I::AssignDifference(x, _, _) | I::AssignProduct(x, _, _) => x,
            I::AssignQuotient(x, _, _) | I::AssignSinCos(x, _, _) => x,
            I::AddProduct(x, _, _) | I::SubtractProduct(x, _, _) | I::AddToProduct(x, ..) => x,
            I::AssignSumWithProduct(x, ..) | I::AssignDifferenceWithProduct(x, ..) => x,
        }
    }

    /// The places it writes to.
    pub fn targets(&self) -> Vec<P> {
        let written = if matches!(self, Instruction::AssignSinCos(..)) { 2 } else { 1 };
        self.places()[..written].to_vec()
    }

    /// The places it reads, without its target.
    pub fn operands(&self) -> Vec<P> {
        let written = if matches!(self, Instruction::AssignSinCos(..)) { 2 } else { 1 };
        self.places()[written..].to_vec()
    }

    /// Whether it overwrites its target without reading it.
    pub fn overwrites(&self) -> bool {
        use Instruction::{Add, AddProduct, AddToProduct, Divide, DivideInteger, Multiply, MultiplyInteger};
        use Instruction::{Negate, Subtract, SubtractProduct};
        let changes = matches!(self, Add(..) | AddProduct(..) | Divide(..) | DivideInteger(..) | Multiply(..))
            || matches!(self, MultiplyInteger(..) | Negate(..) | Subtract(..) | SubtractProduct(..) | AddToProduct(..));
        !changes
    }

    /// The same operation at other places.
    pub fn with_places<Q>(self, to: impl Fn(P) -> Q) -> Instruction<Q> {
        use Instruction as I;
        match self {
            I::AssignRational(x, value) => I::AssignRational(to(x), value),
            I::AssignZero(x) => I::AssignZero(to(x)),
            I::Assign(x, a) => I::Assign(to(x), to(a)),
            I::AssignSum(x, a, b) => I::AssignSum(to(x), to(a), to(b)),
            I::AssignDifference(x, a, b) => I::AssignDifference(to(x), to(a), to(b)),
            I::AssignProduct(x, a, b) => I::AssignProduct(to(x), to(a), to(b)),
            I::AssignQuotient(x, a, b) => I::AssignQuotient(to(x), to(a), to(b)),
            I::AssignSquare(x, a) => I::AssignSquare(to(x), to(a)),
            I::AssignSqrt(x, a) => I::AssignSqrt(to(x), to(a)),
            I::AssignReciprocalSqrt(x, a) => I::AssignReciprocalSqrt(to(x), to(a)),
            I::AssignRoot(x, a, order) => I::AssignRoot(to(x), to(a), order),
            I::AssignFunction(function, x, a) => I::AssignFunction(function, to(x), to(a)),
            I::AssignSinCos(x, y, a) => I::AssignSinCos(to(x), to(y), to(a)),
            I::Add(x, a) => I::Add(to(x), to(a)),
            I::Subtract(x, a) => I::Subtract(to(x), to(a)),
            I::Multiply(x, a) => I::Multiply(to(x), to(a)),
            I::Divide(x, a) => I::Divide(to(x), to(a)),
            I::AddProduct(x, a, b) => I::AddProduct(to(x), to(a), to(b)),
            I::SubtractProduct(x, a, b) => I::SubtractProduct(to(x), to(a), to(b)),
            I::AssignSumWithProduct(x, c, t, a, b) => I::AssignSumWithProduct(to(x), to(c), to(t), to(a), to(b)),
            I::AssignDifferenceWithProduct(x, c, t, a, b) => {
                I::AssignDifferenceWithProduct(to(x), to(c), to(t), to(a), to(b))
            }
            I::AddToProduct(x, c, a, b) => I::AddToProduct(to(x), to(c), to(a), to(b)),
            I::MultiplyInteger(x, n) => I::MultiplyInteger(to(x), n),
            I::DivideInteger(x, n) => I::DivideInteger(to(x), n),
            I::Negate(x) => I::Negate(to(x)),
        }
    }

    /// All places in their order.
    fn places(&self) -> Vec<P> {
        use Instruction as I;
        match *self {
            I::AssignRational(x, _) | I::AssignZero(x) | I::MultiplyInteger(x, _) | I::DivideInteger(x, _) => vec![x],
            I::Negate(x) => vec![x],
            I::Assign(x, a) | I::AssignSquare(x, a) | I::AssignSqrt(x, a) | I::AssignReciprocalSqrt(x, a) => vec![x, a],
            I::AssignRoot(x, a, _) | I::AssignFunction(_, x, a) => vec![x, a],
            I::Add(x, a) | I::Subtract(x, a) | I::Multiply(x, a) | I::Divide(x, a) => vec![x, a],
            I::AssignSum(x, a, b) | I::AssignDifference(x, a, b) | I::AssignProduct(x, a, b) => vec![x, a, b],
            I::AssignQuotient(x, a, b) | I::AssignSinCos(x, a, b) => vec![x, a, b],
            I::AddProduct(x, a, b) | I::SubtractProduct(x, a, b) => vec![x, a, b],
            I::AssignSumWithProduct(x, c, t, a, b) | I::AssignDifferenceWithProduct(x, c, t, a, b) => {
                vec![x, c, t, a, b]
            }
            I::AddToProduct(x, c, a, b) => vec![x, c, a, b],
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Coordinate(index) => write!(f, "q{index}"),
            Place::Parameter(index) => write!(f, "p{index}"),
            Place::Property(index) => write!(f, "b{index}"),
            Place::Constant(index) => write!(f, "c{index}"),
            Place::Scratch(index) => write!(f, "s{index}"),
            Place::Output(index) => write!(f, "out{index}"),
        }
    }
}

/// As in `s0.add_product(q0, q1)`.
impl fmt::Display for Instruction<Place> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut arguments: Vec<String> = self.places()[1..].iter().map(Place::to_string).collect();
        match self {
            Instruction::AssignRational(_, value) => arguments.push(value.to_string()),
            Instruction::AssignRoot(_, _, order) => arguments.push(order.to_string()),
            Instruction::MultiplyInteger(_, n) | Instruction::DivideInteger(_, n) => arguments.push(n.to_string()),
            _ => {}
        }
        write!(f, "{}.{}({})", self.places()[0], self.method(), arguments.join(", "))
    }
}
