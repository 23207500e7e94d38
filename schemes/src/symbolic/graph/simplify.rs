//! Construction of simplified nodes, by rules that hold for all real numbers for which both sides are defined.
//!
//! A rule may widen the domain (x/x becomes 1, √x² becomes x) but never changes a value: (x²)^(1/2) is |x| and stays.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::symbolic::number::rational::Rational;

use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::function::{Function, Parity, exact_value};
use crate::symbolic::number::power::exact_power;

/// c · Π node^exponent: an expanded power.
type Expanded = (Rational, Vec<(Node, Rational)>);

impl Graph {
    /// Σ coefficient · node: nested sums are flattened, like terms collected.
    pub fn sum(&mut self, terms: &[(Node, Rational)]) -> Node {
        let mut total = Rational::zero();
        let mut collected: BTreeMap<Node, Rational> = BTreeMap::new();
        let mut collect =
            |node, coefficient: Rational| *collected.entry(node).or_insert_with(Rational::zero) += coefficient;
        for (node, coefficient) in terms {
            match self.form(*node) {
                Form::Number(value) => total += value * coefficient,
                Form::Sum { constant, terms } => {
                    total += constant * coefficient;
                    terms.iter().for_each(|(inner, factor)| collect(*inner, factor * coefficient));
                }
                _ => collect(*node, coefficient.clone()),
            }
        }
        let terms: Vec<_> = collected.into_iter().filter(|(_, coefficient)| !coefficient.is_zero()).collect();
        match &terms[..] {
            [] => self.number(total),
            [(node, coefficient)] if total.is_zero() && coefficient.is_one() => *node,
            _ => self.intern(Form::Sum { constant: total, terms }),
        }
    }

    /// Π node^exponent: nested products are flattened where the rules allow it, powers of one base collected, numbers
    /// moved to the front. Sums are not multiplied out.
    pub(crate) fn product(&mut self, factors: &[(Node, Rational)]) -> Node {
        let mut coefficient = Rational::one();
        let mut collected: BTreeMap<Node, Rational> = BTreeMap::new();
        let mut waiting = factors.to_vec();
        while let Some((node, exponent)) = waiting.pop() {
            let exponent = exponent + collected.remove(&node).unwrap_or_else(Rational::zero);
            if exponent.is_zero() {
                continue;
            }
            match self.expanded(node, &exponent) {
                Some((number, parts)) => {
                    coefficient *= number;
                    waiting.extend(parts);
                }
                None => _ = collected.insert(node, exponent),
            }
        }
        let factors: Vec<_> = collected.into_iter().collect();
        let node = match &factors[..] {
            [] => return self.number(coefficient),
            [(node, exponent)] if exponent.is_one() => *node,
            _ => self.intern(Form::Product(factors)),
        };
        self.scaled(node, &coefficient)
    }

    /// coefficient · node
    pub fn scaled(&mut self, node: Node, coefficient: &Rational) -> Node {
        self.sum(&[(node, coefficient.clone())])
    }

    /// node^exponent, as described at [`Form::Product`]
    pub fn power(&mut self, node: Node, exponent: &Rational) -> Node {
        self.product(&[(node, exponent.clone())])
    }

    /// left · right
    pub fn times(&mut self, left: Node, right: Node) -> Node {
        self.product(&[(left, Rational::one()), (right, Rational::one())])
    }

    /// left + right
    pub fn plus(&mut self, left: Node, right: Node) -> Node {
        self.sum(&[(left, Rational::one()), (right, Rational::one())])
    }

    /// node^exponent as a number times powers of other nodes; `None` if no rule applies.
    fn expanded(&mut self, node: Node, exponent: &Rational) -> Option<Expanded> {
        match &*self.shared_form(node) {
            Form::Number(value) => self.expanded_number(value, exponent),
            Form::Sum { constant, terms } => self.expanded_sum(node, constant, terms, exponent),
            Form::Product(factors) => expanded_product(factors, exponent).map(|parts| (Rational::one(), parts)),
            _ => None,
        }
    }

    /// v^n is a number if it is rational; otherwise the exponent is reduced to 0 < n < 1 and the base made positive.
    ///
    /// 0^-1 and √-1 are kept: a derivative with such a part is not defined anywhere.
    fn expanded_number(&mut self, value: &Rational, exponent: &Rational) -> Option<Expanded> {
        if let Some(number) = exact_power(value, exponent) {
            return Some((number, Vec::new()));
        }
        if value.is_zero() || value.is_negative() && exponent.denom().is_even() || exponent.is_integer() {
            return None;
        }
        if value.is_negative() {
            return Some((sign_power(exponent), vec![(self.number(-value), exponent.clone())]));
        }
        let whole = exponent.floor();
        let number = exact_power(value, &whole).filter(|_| !whole.is_zero())?;
        Some((number, vec![(self.number(value.clone()), exponent - whole)]))
    }

    /// (c·s)^n = c^n s^n, where |c| is the common absolute value of all coefficients and c has the sign of the first.
    fn expanded_sum(
        &mut self,
        node: Node,
        constant: &Rational,
        terms: &[(Node, Rational)],
        exponent: &Rational,
    ) -> Option<Expanded> {
        let mut factor = Rational::one();
        let mut number = Rational::one();
        if let Some(size) = common_size(constant, terms)
            && let Some(power) = exact_power(&size, exponent)
        {
            (factor, number) = (size, power);
        }
        if terms[0].1.is_negative() && exponent.denom().is_odd() {
            factor = -factor;
            number *= sign_power(exponent);
        }
        if factor.is_one() {
            return None;
        }
        let rest = self.scaled(node, &factor.recip());
        Some((number, vec![(rest, exponent.clone())]))
    }

    /// π as 4 arctan 1, a constant that programs compute once.
    pub fn pi(&mut self) -> Node {
        let one = self.number(Rational::one());
        let quarter = self.call(Function::Atan, one);
        self.scaled(quarter, &Rational::from_integer(4.into()))
    }

    /// function(node); f(−x) = ±f(x) and rational values are used.
    pub fn call(&mut self, function: Function, node: Node) -> Node {
        if let Some(value) = self.as_number(node).and_then(|argument| exact_value(function, argument)) {
            return self.number(value);
        }
        if function.parity() == Parity::Neither || !self.begins_with_minus(node) {
            return self.intern(Form::Call(function, node));
        }
        let minus = -Rational::one();
        let opposite = self.scaled(node, &minus);
        let call = self.intern(Form::Call(function, opposite));
        if function.parity() == Parity::Odd { self.scaled(call, &minus) } else { call }
    }

    /// Whether the number, or the first coefficient of the sum, is negative: this holds for one of x and −x.
    fn begins_with_minus(&self, node: Node) -> bool {
        match self.form(node) {
            Form::Number(value) => value.is_negative(),
            Form::Sum { terms, .. } => terms[0].1.is_negative(),
            _ => false,
        }
    }
}

/// The absolute value of all coefficients of a sum, if it is the same; a constant 0 does not count.
pub(crate) fn common_size(constant: &Rational, terms: &[(Node, Rational)]) -> Option<Rational> {
    let size = terms[0].1.abs();
    let shared =
        terms[1..].iter().map(|(_, coefficient)| coefficient).chain([constant].into_iter().filter(|c| !c.is_zero()));
    shared.into_iter().all(|coefficient| coefficient.abs() == size).then_some(size)
}

/// (Π b^a)^n = Π b^(a n): for an n with an odd denominator always; else only for one factor, whose power a must have
/// the sign of b, so that √(x²) does not become x.
fn expanded_product(factors: &[(Node, Rational)], exponent: &Rational) -> Option<Vec<(Node, Rational)>> {
    let allowed = match factors {
        _ if exponent.denom().is_odd() => true,
        [(_, inner)] => inner.numer().is_odd(),
        _ => false,
    };
    allowed.then(|| factors.iter().map(|(base, inner)| (*base, inner * exponent)).collect())
}

/// (−1)^exponent for an exponent with an odd denominator
fn sign_power(exponent: &Rational) -> Rational {
    let sign = if exponent.numer().is_odd() { -1 } else { 1 };
    Rational::from_integer(BigInt::from(sign))
}
