//! Values of syntax trees, nodes and programs in any numbers.

use std::collections::HashMap;

use shadowstep_schemes::symbolic::{
    Expression, ExpressionKind, Form, Function, Graph, Instruction, Node, Operation, Place, Program, Rational, parse,
};

/// Digits to which results must agree; the numbers have some 300.
pub(crate) const DIGITS: u32 = 120;
const BITS: u32 = 1000;

/// Numbers to compute with.
pub(crate) trait Real: Clone {
    fn rational(value: &Rational) -> Self;
    fn add(&self, other: &Self) -> Self;
    fn multiply(&self, other: &Self) -> Self;
    fn divide(&self, other: &Self) -> Self;
    /// The real root; for an odd order of negative numbers, too.
    fn root(&self, order: u32) -> Self;
    fn call(&self, function: Function) -> Self;

    fn integer(value: i32) -> Self {
        Self::rational(&Rational::from_integer(value.into()))
    }

    fn negate(&self) -> Self {
        self.multiply(&Self::integer(-1))
    }

    fn power(&self, exponent: &Rational) -> Self {
        let small = |value: &num_bigint::BigInt| value.to_string().parse::<i32>().unwrap();
        let root = self.root(small(exponent.denom()) as u32);
        let count = small(exponent.numer());
        let power = (0..count.abs()).fold(Self::integer(1), |power, _| power.multiply(&root));
        if count < 0 { Self::integer(1).divide(&power) } else { power }
    }
}

/// A function by its method, which all these numbers have under the same name.
macro_rules! call_method {
    ($x:expr, $function:expr) => {
        match $function {
            Function::Exp => $x.exp(),
            Function::Log => $x.ln(),
            Function::Sin => $x.sin(),
            Function::Cos => $x.cos(),
            Function::Tan => $x.tan(),
            Function::Sinh => $x.sinh(),
            Function::Cosh => $x.cosh(),
            Function::Tanh => $x.tanh(),
            Function::Atan => $x.atan(),
            Function::Asin => $x.asin(),
            Function::Acos => $x.acos(),
        }
    };
}

impl Real for f64 {
    fn rational(value: &Rational) -> Self {
        rug_rational(value).to_f64()
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn multiply(&self, other: &Self) -> Self {
        self * other
    }
    fn divide(&self, other: &Self) -> Self {
        self / other
    }
    fn root(&self, order: u32) -> Self {
        match order {
            1 => *self,
            2 => self.sqrt(),
            3 => self.cbrt(),
            _ if order % 2 == 1 => self.abs().powf(1.0 / f64::from(order)).copysign(*self),
            _ => self.powf(1.0 / f64::from(order)),
        }
    }
    fn call(&self, function: Function) -> Self {
        call_method!(self, function)
    }
}

impl Real for rug::Float {
    fn rational(value: &Rational) -> Self {
        rug::Float::with_val(BITS, rug_rational(value))
    }
    fn add(&self, other: &Self) -> Self {
        rug::Float::with_val(BITS, self + other)
    }
    fn multiply(&self, other: &Self) -> Self {
        rug::Float::with_val(BITS, self * other)
    }
    fn divide(&self, other: &Self) -> Self {
        rug::Float::with_val(BITS, self / other)
    }
    fn root(&self, order: u32) -> Self {
        self.clone().root(order)
    }
    fn call(&self, function: Function) -> Self {
        call_method!(self.clone(), function)
    }
}

/// Exact numbers, for formulas without roots and functions; `None` after a division by zero.
impl Real for Option<Rational> {
    fn rational(value: &Rational) -> Self {
        Some(value.clone())
    }
    fn add(&self, other: &Self) -> Self {
        Some(self.as_ref()? + other.as_ref()?)
    }
    fn multiply(&self, other: &Self) -> Self {
        Some(self.as_ref()? * other.as_ref()?)
    }
    fn divide(&self, other: &Self) -> Self {
        let other = other.as_ref().filter(|other| *other.numer() != 0.into())?;
        Some(self.as_ref()? / other)
    }
    fn root(&self, order: u32) -> Self {
        assert_eq!(order, 1, "a rational formula");
        self.clone()
    }
    fn call(&self, function: Function) -> Self {
        panic!("{function} in a rational formula")
    }
}

pub(crate) fn rug_rational(value: &Rational) -> rug::Rational {
    value.to_string().parse().unwrap()
}

/// The values of coordinates, parameters and properties of bodies.
pub(crate) struct Point<R> {
    pub(crate) coordinates: Vec<R>,
    pub(crate) parameters: Vec<R>,
    pub(crate) properties: Vec<R>,
}

pub(crate) fn names(text: &str) -> Vec<String> {
    text.split_whitespace().map(String::from).collect()
}

/// The value of a syntax tree, operation by operation.
pub(crate) fn of_tree<R: Real>(tree: &Expression, names: &HashMap<String, R>) -> R {
    match &tree.kind {
        ExpressionKind::Number(value) => R::rational(value),
        ExpressionKind::Name(name) => names[name].clone(),
        ExpressionKind::Negate(inner) => of_tree(inner, names).negate(),
        ExpressionKind::Binary(Operation::Power, base, exponent) => {
            let exponent = shadowstep_schemes::symbolic::evaluate(exponent, &Default::default(), 50).unwrap();
            assert!(!exponent.rounded);
            of_tree(base, names).power(&exponent.value)
        }
        ExpressionKind::Binary(operation, left, right) => {
            let (left, right) = (of_tree(left, names), of_tree(right, names));
            match operation {
                Operation::Add => left.add(&right),
                Operation::Subtract => left.add(&right.negate()),
                Operation::Multiply => left.multiply(&right),
                Operation::Divide => left.divide(&right),
                Operation::Power => unreachable!(),
            }
        }
        ExpressionKind::Call { function, arguments } => {
            let argument = of_tree(&arguments[0], names);
            match function.as_str() {
                "sqrt" => argument.root(2),
                "cbrt" => argument.root(3),
                name => argument.call(Function::named(name).unwrap()),
            }
        }
    }
}

/// The value of a node, each node below it computed once.
pub(crate) fn of_node<R: Real>(graph: &Graph, node: Node, point: &Point<R>) -> R {
    fn value<R: Real>(graph: &Graph, node: Node, point: &Point<R>, known: &mut HashMap<Node, R>) -> R {
        if let Some(value) = known.get(&node) {
            return value.clone();
        }
        let result = match graph.form(node) {
            Form::Number(value) => R::rational(value),
            Form::Coordinate(index) => point.coordinates[*index].clone(),
            Form::Parameter(index) => point.parameters[*index].clone(),
            Form::Property(index) => point.properties[*index].clone(),
            Form::Sum { constant, terms } => terms.iter().fold(R::rational(constant), |sum, (part, coefficient)| {
                sum.add(&R::rational(coefficient).multiply(&value(graph, *part, point, known)))
            }),
            Form::Product(factors) => factors.iter().fold(R::integer(1), |product, (base, exponent)| {
                product.multiply(&value(graph, *base, point, known).power(exponent))
            }),
            Form::Call(function, argument) => value(graph, *argument, point, known).call(*function),
        };
        known.insert(node, result.clone());
        result
    }
    value(graph, node, point, &mut HashMap::new())
}

/// The outputs of a program, run as it stands. Reading a place that was never written, or breaking the promise about
/// targets and operands, is a panic.
pub(crate) fn of_program<R: Real>(program: &Program, point: &Point<R>) -> Vec<R> {
    let mut machine = Machine { point, places: HashMap::new() };
    for instruction in &program.prepare {
        let target = instruction.targets()[0];
        assert!(matches!(target, Place::Constant(index) if index < program.constants), "{instruction}");
        machine.run(instruction);
    }
    machine.places.retain(|place, _| matches!(place, Place::Constant(index) if *index < program.kept));
    for instruction in &program.instructions {
        for target in instruction.targets() {
            let allowed = match target {
                Place::Scratch(index) => index < program.scratch,
                Place::Output(index) => index < program.outputs,
                _ => false,
            };
            assert!(allowed, "{instruction}");
        }
        machine.run(instruction);
    }
    (0..program.outputs).map(|output| machine.read(Place::Output(output))).collect()
}

struct Machine<'a, R> {
    point: &'a Point<R>,
    places: HashMap<Place, R>,
}

impl<R: Real> Machine<'_, R> {
    fn read(&self, place: Place) -> R {
        match place {
            Place::Coordinate(index) => self.point.coordinates[index].clone(),
            Place::Parameter(index) => self.point.parameters[index].clone(),
            Place::Property(index) => self.point.properties[index].clone(),
            _ => self.places.get(&place).unwrap_or_else(|| panic!("{place} was never written")).clone(),
        }
    }

    fn run(&mut self, instruction: &Instruction) {
        use Instruction as I;
        let targets = instruction.targets();
        assert!(instruction.operands().iter().all(|operand| !targets.contains(operand)), "{instruction}");
        if instruction.overwrites() {
            targets.iter().for_each(|target| _ = self.places.remove(target));
        }
        let at = |place: &Place| self.read(*place);
        let result = match instruction {
            I::AssignRational(_, value) => R::rational(value),
            I::AssignZero(_) => R::integer(0),
            I::Assign(_, a) => at(a),
            I::AssignSum(_, a, b) => at(a).add(&at(b)),
            I::AssignDifference(_, a, b) => at(a).add(&at(b).negate()),
            I::AssignProduct(_, a, b) => at(a).multiply(&at(b)),
            I::AssignQuotient(_, a, b) => at(a).divide(&at(b)),
            I::AssignSquare(_, a) => at(a).multiply(&at(a)),
            I::AssignSqrt(_, a) => at(a).root(2),
            I::AssignReciprocalSqrt(_, a) => R::integer(1).divide(&at(a).root(2)),
            I::AssignRoot(_, a, order) => at(a).root(*order),
            I::AssignFunction(function, _, a) => at(a).call(*function),
            I::AssignSinCos(_, cos, a) => {
                let (sin, cosine) = (at(a).call(Function::Sin), at(a).call(Function::Cos));
                self.places.insert(*cos, cosine);
                sin
            }
            I::Add(x, a) => at(x).add(&at(a)),
            I::Subtract(x, a) => at(x).add(&at(a).negate()),
            I::Multiply(x, a) => at(x).multiply(&at(a)),
            I::Divide(x, a) => at(x).divide(&at(a)),
            I::AddProduct(x, a, b) => at(x).add(&at(a).multiply(&at(b))),
            I::SubtractProduct(x, a, b) => at(x).add(&at(a).multiply(&at(b)).negate()),
            I::AssignSumWithProduct(_, c, _, a, b) => at(c).add(&at(a).multiply(&at(b))),
            I::AssignDifferenceWithProduct(_, c, _, a, b) => at(c).add(&at(a).multiply(&at(b)).negate()),
            I::AddToProduct(_, c, a, b) => at(c).add(&at(a).multiply(&at(b))),
            I::MultiplyInteger(x, n) => at(x).multiply(&R::integer(*n)),
            I::DivideInteger(x, n) => at(x).divide(&R::integer(*n)),
            I::Negate(x) => at(x).negate(),
        };
        self.places.insert(targets[0], result);
    }
}

/// The program of a potential's gradient, with the rate if asked for.
pub(crate) fn program(text: &str, coordinates: &str, parameters: &str, rate: bool) -> Program {
    let coordinates = names(coordinates);
    let mut graph = Graph::new();
    let potential = graph.build(&parse(text).unwrap(), &coordinates, &names(parameters)).unwrap();
    let mut outputs: Vec<Node> = (0..coordinates.len()).map(|index| graph.derivative(potential, index)).collect();
    if rate {
        outputs.push(graph.rate(potential));
    }
    graph.program(&outputs)
}
