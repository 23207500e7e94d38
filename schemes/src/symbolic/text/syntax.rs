//! Text to a syntax tree.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = ("+" | "-") signed | power
//! power   = atom [ "^" signed ]
//! atom    = number | name | name "(" [ sum { "," sum } ] ")" | "(" sum ")"
//! ```

use std::ops::Range;

use crate::symbolic::number::rational::Rational;
use crate::symbolic::text::error::SyntaxError;
use crate::symbolic::text::token::{Token, tokens};

/// The longest text in bytes.
const LONGEST_TEXT: usize = 10_000;

/// The deepest nesting of parentheses and signs, and the greatest height of a tree: a recursion over the tree does not
/// overflow the stack.
const DEEPEST: usize = 200;

/// A formula, or a part of one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// Its bytes in the text, with the parentheses around it and the plus signs before it.
    pub range: Range<usize>,
}

/// The forms of an expression. A tree is at most 200 expressions high.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ExpressionKind {
    /// A literal, exactly.
    Number(Rational),
    /// A name for a number.
    Name(String),
    /// The expression with its sign changed.
    Negate(Box<Expression>),
    /// Left operand, operation, right operand.
    Binary(Operation, Box<Expression>, Box<Expression>),
    /// A function of any number of arguments.
    Call {
        /// The function's name.
        function: String,
        /// The arguments in order.
        arguments: Vec<Expression>,
    },
}

/// The operations with two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operation {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `^`
    Power,
}

/// Reads a formula.
///
/// Numbers are integers and decimals, `1_000`, `.5`, `2.5e-7`. A power binds tighter than a sign
/// before it, `-2^2` is -4, and groups from the right, `2^3^2` is 2^9.
///
/// # Errors
/// A [`SyntaxError`] if the text does not follow the grammar, is longer than 10000 bytes, is
/// nested more than 200 deep (each operator of a chain `a + b + c` counts as one level), or has a
/// literal with an exponent beyond 10000.
pub fn parse(text: &str) -> Result<Expression, SyntaxError> {
    if text.len() > LONGEST_TEXT {
        let message = format!("a formula of {} bytes is too long: at most {LONGEST_TEXT} are allowed", text.len());
        return Err(SyntaxError { message, range: 0..text.len() });
    }
    let mut parser = Parser { text, tokens: tokens(text)?, next: 0, depth: 0 };
    let expression = parser.sum()?;
    match parser.symbol() {
        None if parser.next == parser.tokens.len() => Ok(expression),
        _ => Err(parser.no_operator()),
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<(Token, Range<usize>)>,
    /// The index of the token to be read next.
    next: usize,
    /// How many calls of `signed` are open.
    depth: usize,
}

impl Parser<'_> {
    fn sum(&mut self) -> Result<Expression, SyntaxError> {
        let mut left = self.product()?;
        while let Some(operation) = self.operation(&[('+', Operation::Add), ('-', Operation::Subtract)]) {
            left = self.binary(operation, left, Self::product)?;
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Expression, SyntaxError> {
        let mut left = self.signed()?;
        while let Some(operation) = self.operation(&[('*', Operation::Multiply), ('/', Operation::Divide)]) {
            left = self.binary(operation, left, Self::signed)?;
        }
        Ok(left)
    }

    /// Counts the depth: every nesting passes through here.
    fn signed(&mut self) -> Result<Expression, SyntaxError> {
        if self.depth == DEEPEST {
            return Err(too_deep(self.here()));
        }
        self.depth += 1;
        let start = self.here().start;
        let expression = match self.symbol() {
            Some(sign @ ('+' | '-')) => {
                self.next += 1;
                let operand = self.signed()?;
                let range = start..operand.range.end;
                match sign {
                    '-' => node(ExpressionKind::Negate(Box::new(operand)), range)?,
                    _ => Expression { range, ..operand },
                }
            }
            _ => self.power()?,
        };
        self.depth -= 1;
        Ok(expression)
    }

    fn power(&mut self) -> Result<Expression, SyntaxError> {
        let base = self.atom()?;
        match self.operation(&[('^', Operation::Power)]) {
            Some(operation) => self.binary(operation, base, Self::signed),
            None => Ok(base),
        }
    }

    fn atom(&mut self) -> Result<Expression, SyntaxError> {
        let Some((token, range)) = self.tokens.get(self.next).cloned() else {
            return Err(self.no_operand());
        };
        match token {
            Token::Symbol('(') => self.parenthesized(),
            Token::Symbol(_) => Err(self.no_operand()),
            Token::Number(value) => {
                self.next += 1;
                Ok(Expression { kind: ExpressionKind::Number(value), range })
            }
            Token::Name => {
                self.next += 1;
                self.name(range)
            }
        }
    }

    /// A name, or a call of a function.
    fn name(&mut self, range: Range<usize>) -> Result<Expression, SyntaxError> {
        let name = self.text[range.clone()].to_string();
        if self.symbol() != Some('(') {
            return Ok(Expression { kind: ExpressionKind::Name(name), range });
        }
        let open = self.take();
        let mut arguments = Vec::new();
        if self.symbol() != Some(')') {
            arguments.push(self.sum()?);
            while self.symbol() == Some(',') {
                self.next += 1;
                arguments.push(self.sum()?);
            }
        }
        let end = self.close(open)?;
        node(ExpressionKind::Call { function: name, arguments }, range.start..end)
    }

    fn parenthesized(&mut self) -> Result<Expression, SyntaxError> {
        let open = self.take();
        let inner = self.sum()?;
        let range = open.start..self.close(open)?;
        Ok(Expression { range, ..inner })
    }

    /// Reads the `)` that belongs to `open`; returns the byte after it.
    fn close(&mut self, open: Range<usize>) -> Result<usize, SyntaxError> {
        match self.symbol() {
            Some(')') => Ok(self.take().end),
            None if self.next == self.tokens.len() => {
                let message = "unexpected end: this `(` has no `)`".to_string();
                Err(SyntaxError { message, range: open })
            }
            _ => Err(self.no_operator()),
        }
    }

    /// Reads the next symbol if it is in the list; returns its operation.
    fn operation(&mut self, list: &[(char, Operation)]) -> Option<Operation> {
        let symbol = self.symbol()?;
        let (_, operation) = list.iter().find(|(known, _)| *known == symbol)?;
        self.next += 1;
        Some(*operation)
    }

    /// Reads the right operand and joins it with the left one.
    fn binary(
        &mut self,
        operation: Operation,
        left: Expression,
        operand: fn(&mut Self) -> Result<Expression, SyntaxError>,
    ) -> Result<Expression, SyntaxError> {
        let right = operand(self)?;
        let range = left.range.start..right.range.end;
        node(ExpressionKind::Binary(operation, Box::new(left), Box::new(right)), range)
    }

    /// The next token, if it is a symbol.
    fn symbol(&self) -> Option<char> {
        match self.tokens.get(self.next) {
            Some((Token::Symbol(symbol), _)) => Some(*symbol),
            _ => None,
        }
    }

    /// Reads a token; returns its bytes.
    fn take(&mut self) -> Range<usize> {
        let range = self.here();
        self.next += 1;
        range
    }

    /// The bytes of the next token, or the empty range after the last one.
    fn here(&self) -> Range<usize> {
        match self.tokens.get(self.next) {
            Some((_, range)) => range.clone(),
            None => self.before().map_or(0..0, |range| range.end..range.end),
        }
    }

    /// The bytes of the token before the next one.
    fn before(&self) -> Option<Range<usize>> {
        Some(self.tokens[self.next.checked_sub(1)?].1.clone())
    }

    /// The error where an operand is expected.
    fn no_operand(&self) -> SyntaxError {
        let found = match &self.text[self.here()] {
            "" => "end".to_string(),
            token => format!("`{token}`"),
        };
        let message = match self.before() {
            Some(before) => {
                let before = &self.text[before];
                format!("unexpected {found}: a number, a name or `(` should follow `{before}`")
            }
            None if self.tokens.is_empty() => "the formula is empty: write a number or a formula".to_string(),
            None => {
                format!("unexpected {found}: a formula begins with a number, a name, a sign or `(`")
            }
        };
        SyntaxError { message, range: self.here() }
    }

    /// The error where an operator or the end is expected.
    fn no_operator(&self) -> SyntaxError {
        let here = self.here();
        let (message, range) = match self.symbol() {
            Some(')') => ("`)` has no `(`".to_string(), here),
            Some(',') => {
                let message = "`,` is only allowed between the arguments of a function; the decimal point is `.`";
                (message.to_string(), here)
            }
            _ => {
                let before = self.before().unwrap_or(here.clone());
                let both = before.start..here.end;
                let [left, right] = [before, here].map(|range| &self.text[range]);
                (format!("an operator is missing between `{left}` and `{right}`"), both)
            }
        };
        SyntaxError { message, range }
    }
}

/// An expression with parts, unless its tree is too high.
fn node(kind: ExpressionKind, range: Range<usize>) -> Result<Expression, SyntaxError> {
    let expression = Expression { kind, range };
    match height(&expression) <= DEEPEST {
        true => Ok(expression),
        false => Err(too_deep(expression.range)),
    }
}

fn height(expression: &Expression) -> usize {
    1 + match &expression.kind {
        ExpressionKind::Number(_) | ExpressionKind::Name(_) => 0,
        ExpressionKind::Negate(inner) => height(inner),
        ExpressionKind::Binary(_, left, right) => height(left).max(height(right)),
        ExpressionKind::Call { arguments, .. } => arguments.iter().map(height).max().unwrap_or(0),
    }
}

fn too_deep(range: Range<usize>) -> SyntaxError {
    let message = format!("nested more than {DEEPEST} levels deep: group a long chain of operators by parentheses");
    SyntaxError { message, range }
}

impl Expression {
    /// Calls `look` with this expression and all that it consists of.
    pub fn visit(&self, look: &mut impl FnMut(&Expression)) {
        look(self);
        match &self.kind {
            ExpressionKind::Number(_) | ExpressionKind::Name(_) => {}
            ExpressionKind::Negate(inner) => inner.visit(look),
            ExpressionKind::Binary(_, left, right) => {
                left.visit(look);
                right.visit(look);
            }
            ExpressionKind::Call { arguments, .. } => arguments.iter().for_each(|argument| argument.visit(look)),
        }
    }
}
