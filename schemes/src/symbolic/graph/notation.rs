//! Formulas of a graph as text: as they are read here, and for LaTeX, Rust and NumPy.

use std::collections::{BTreeSet, HashMap};

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::function::Function;
use crate::symbolic::number::rational::Rational;
use crate::symbolic::text::decimal::to_significant;

/// How formulas are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// As [`parse`](crate::symbolic::parse) reads it: `x^2/2 + sqrt(y)`.
    Formula,
    /// `\frac{x^{2}}{2} + \sqrt{y}`
    Latex,
    /// Numbers in `f64`: `x.powi(2)/2.0 + y.sqrt()`.
    Rust,
    /// `x**2/2 + np.sqrt(y)`
    NumPy,
}

/// Numerators and denominators up to this one are written as fractions.
const LARGEST_IN_FRACTIONS: u64 = 1_000_000_000_000_000;

/// The most terms of a sum that is not in groups.
const LONGEST_SUM: usize = 50;

/// How strongly a text holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

struct Written {
    text: String,
    binding: Binding,
}

impl Graph {
    /// The indices of the parameters in some formulas.
    pub fn parameters(&self, nodes: &[Node]) -> BTreeSet<usize> {
        let parameter = |node: Node| match self.form(node) {
            Form::Parameter(index) => Some(*index),
            _ => None,
        };
        self.below(nodes).into_iter().filter_map(parameter).collect()
    }

    /// The number of symbols of the formula of a node as text, in which common parts are written as often as they
    /// occur.
    pub fn written_size(&self, node: Node) -> u64 {
        let mut sizes = HashMap::new();
        for part in self.below(&[node]) {
            let size = self.children(part).map(|child| sizes[&child]).fold(1, u64::saturating_add);
            sizes.insert(part, size);
        }
        sizes[&node]
    }

    /// The formula of a node with these names of coordinates and parameters. Numbers that are no short fractions have
    /// `digits` significant digits.
    ///
    /// ```
    /// use shadowstep_schemes::symbolic::{Graph, Notation, parse};
    ///
    /// let names = ["x", "px"].map(String::from);
    /// let mut graph = Graph::new();
    /// let node = graph.build(&parse("-px^2*sqrt(1 + x)/12")?, &names, &[])?;
    /// let written = |notation| graph.text(node, notation, (&names, &[]), 17);
    /// assert_eq!(written(Notation::Formula), "-px^2*sqrt(x + 1)/12");
    /// assert_eq!(written(Notation::Latex), r"-\frac{p_{x}^{2} \sqrt{x + 1}}{12}");
    /// assert_eq!(written(Notation::Rust), "-px.powi(2)*(x + 1.0).sqrt()/12.0");
    /// assert_eq!(written(Notation::NumPy), "-px**2*np.sqrt(x + 1)/12");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn text(&self, node: Node, notation: Notation, names: (&[String], &[String]), digits: usize) -> String {
        Writer { graph: self, notation, names, digits }.node(node).text
    }
}

struct Writer<'a> {
    graph: &'a Graph,
    notation: Notation,
    /// Of coordinates and parameters.
    names: (&'a [String], &'a [String]),
    digits: usize,
}

impl Writer<'_> {
    fn node(&self, node: Node) -> Written {
        let atom = |text| Written { text, binding: Binding::Atom };
        match self.graph.form(node) {
            Form::Number(value) => self.sum(value, &[]),
            Form::Coordinate(index) => atom(self.name(&self.names.0[*index])),
            Form::Parameter(index) => atom(self.name(&self.names.1[*index])),
            Form::Property(_) => unreachable!("formulas of pairs are not written"),
            Form::Sum { constant, terms } => self.sum(constant, terms),
            Form::Product(factors) => self.product(&Rational::one(), factors),
            Form::Call(function, argument) => self.call(*function, *argument),
        }
    }

    fn at_least(&self, binding: Binding, written: Written) -> String {
        match (written.binding >= binding, self.notation) {
            (true, _) => written.text,
            (false, Notation::Latex) => format!(r"\left({}\right)", written.text),
            (false, _) => format!("({})", written.text),
        }
    }

    /// Long sums are in groups: what reads them nests a level for each term.
    fn sum(&self, constant: &Rational, terms: &[(Node, Rational)]) -> Written {
        if terms.len() <= LONGEST_SUM || self.notation == Notation::Latex {
            return self.short_sum(constant, terms);
        }
        let (first, rest) = terms.split_at(terms.len() % LONGEST_SUM);
        let groups = rest.chunks(LONGEST_SUM).map(|group| self.short_sum(&Rational::zero(), group));
        let groups: String = groups.map(|group| format!(" + ({})", group.text)).collect();
        Written { text: self.short_sum(constant, first).text + &groups, binding: Binding::Sum }
    }

    fn short_sum(&self, constant: &Rational, terms: &[(Node, Rational)]) -> Written {
        let mut text = String::new();
        let mut binding = Binding::Product;
        let pieces = terms.iter().map(|(node, c)| (c, Some(*node)));
        let constant = Some((constant, None)).filter(|(value, _)| !value.is_zero() || terms.is_empty());
        for (c, node) in pieces.chain(constant) {
            let written = match node.map(|node| (node, self.graph.form(node))) {
                Some((_, Form::Product(factors))) => self.product(&c.abs(), factors),
                Some((node, _)) => self.product(&c.abs(), &[(node, Rational::one())]),
                None => self.product(&c.abs(), &[]),
            };
            match (text.is_empty(), c.is_negative()) {
                (true, false) => binding = written.binding,
                (true, true) => {
                    text.push('-');
                    binding = Binding::Sum;
                }
                (false, negative) => {
                    text += if negative { " - " } else { " + " };
                    binding = Binding::Sum;
                }
            }
            text += &self.at_least(Binding::Product, written);
        }
        Written { text, binding }
    }

    /// |c| Π base^exponent
    fn product(&self, c: &Rational, factors: &[(Node, Rational)]) -> Written {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let is_short = |n: &BigInt| n.magnitude() <= &LARGEST_IN_FRACTIONS.into();
        if !is_short(c.numer()) || !is_short(c.denom()) {
            above.push(Written { text: self.decimal(c), binding: Binding::Atom });
        } else {
            let integer = |n: &BigInt| Written { text: self.integer(n), binding: Binding::Atom };
            above.extend(Some(c.numer()).filter(|n| !n.is_one()).map(integer));
            below.extend(Some(c.denom()).filter(|n| !n.is_one()).map(integer));
        }
        for (base, exponent) in factors {
            let side = if exponent.is_negative() { &mut below } else { &mut above };
            side.push(self.power(*base, &exponent.abs()));
        }
        if above.is_empty() {
            above.push(Written { text: self.integer(&BigInt::one()), binding: Binding::Atom });
        }
        let (above, below) = (self.joined(above), (!below.is_empty()).then(|| self.joined(below)));
        match (below, self.notation) {
            (None, _) => above,
            (Some(below), Notation::Latex) => {
                Written { text: format!(r"\frac{{{}}}{{{}}}", above.text, below.text), binding: Binding::Product }
            }
            (Some(below), _) => {
                let (above, below) = (self.at_least(Binding::Product, above), self.at_least(Binding::Power, below));
                Written { text: format!("{above}/{below}"), binding: Binding::Product }
            }
        }
    }

    fn joined(&self, mut factors: Vec<Written>) -> Written {
        if factors.len() == 1 {
            return factors.remove(0);
        }
        let sign = if self.notation == Notation::Latex { " " } else { "*" };
        let texts: Vec<_> = factors.into_iter().map(|factor| self.at_least(Binding::Power, factor)).collect();
        Written { text: texts.join(sign), binding: Binding::Product }
    }

    /// base^exponent for a positive exponent
    fn power(&self, base: Node, exponent: &Rational) -> Written {
        let base = self.node(base);
        if exponent.is_one() {
            return base;
        }
        let (n, root) = (exponent.numer(), exponent.denom());
        let is_root = |of: u32| *root == BigInt::from(of);
        let has_root = (is_root(2) && (n.is_one() || self.notation == Notation::Formula)) || is_root(3);
        let (base, exponent) = match has_root {
            true if self.notation == Notation::Latex => (base, exponent.clone()),
            true => (self.root(base, is_root(3)), Rational::from_integer(n.clone())),
            false => (base, exponent.clone()),
        };
        if exponent.is_one() {
            return base;
        }
        if self.notation == Notation::Latex && n.is_one() && (is_root(2) || is_root(3)) {
            let index = if is_root(3) { "[3]" } else { "" };
            return Written { text: format!(r"\sqrt{index}{{{}}}", base.text), binding: Binding::Atom };
        }
        let base = self.at_least(Binding::Atom, base);
        let text = match self.notation {
            Notation::Formula if exponent.is_integer() => format!("{base}^{exponent}"),
            Notation::Formula => format!("{base}^({exponent})"),
            Notation::Latex => format!("{base}^{{{exponent}}}"),
            Notation::Rust if exponent.is_integer() => format!("{base}.powi({exponent})"),
            Notation::Rust => format!("{base}.powf({}/{})", self.integer(n), self.integer(root)),
            Notation::NumPy if exponent.is_integer() => format!("{base}**{exponent}"),
            Notation::NumPy => format!("{base}**({exponent})"),
        };
        // a call of a method is an atom
        let binding = if self.notation == Notation::Rust { Binding::Atom } else { Binding::Power };
        Written { text, binding }
    }

    /// The square or the cube root.
    fn root(&self, base: Written, is_cubic: bool) -> Written {
        let name = if is_cubic { "cbrt" } else { "sqrt" };
        let text = match self.notation {
            Notation::Rust => format!("{}.{name}()", self.at_least(Binding::Atom, base)),
            Notation::NumPy => format!("np.{name}({})", base.text),
            Notation::Formula | Notation::Latex => format!("{name}({})", base.text),
        };
        Written { text, binding: Binding::Atom }
    }

    fn call(&self, function: Function, argument: Node) -> Written {
        let (argument, name) = (self.node(argument), function.to_string());
        let arc = |name: &str| name.strip_prefix('a').map_or(name.to_owned(), |rest| format!("arc{rest}"));
        let text = match self.notation {
            Notation::Formula => format!("{name}({})", argument.text),
            Notation::Latex => format!(r"\{}\left({}\right)", arc(&name), argument.text),
            Notation::NumPy => format!("np.{}({})", arc(&name), argument.text),
            Notation::Rust => {
                let method = if function == Function::Log { "ln" } else { &name };
                format!("{}.{method}()", self.at_least(Binding::Atom, argument))
            }
        };
        Written { text, binding: Binding::Atom }
    }

    fn integer(&self, n: &BigInt) -> String {
        if self.notation == Notation::Rust { format!("{n}.0") } else { n.to_string() }
    }

    fn decimal(&self, c: &Rational) -> String {
        let text = to_significant(c, self.digits);
        match (text.split_once('e'), self.notation) {
            (Some((mantissa, exponent)), Notation::Latex) => format!(r"{mantissa} \cdot 10^{{{exponent}}}"),
            (None, Notation::Rust) if !text.contains('.') => format!("{text}.0"),
            _ => text,
        }
    }

    fn name(&self, name: &str) -> String {
        if self.notation != Notation::Latex {
            return name.to_owned();
        }
        let symbol = latex_name(name);
        let is_other = |other: &String| other != name && latex_name(other) == symbol;
        let (coordinates, parameters) = self.names;
        // x1 beside x_1
        if coordinates.iter().chain(parameters).any(is_other) { upright(name) } else { symbol }
    }
}

const GREEK: [&str; 23] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
];

/// x_{1} for x1, p_{x} for px, \theta for theta, else an upright word.
fn latex_name(name: &str) -> String {
    if GREEK.contains(&name) {
        return format!(r"\{name}");
    }
    let mut letters = name.chars();
    let (first, rest) = (letters.next().unwrap_or_default(), letters.as_str());
    let index = rest.trim_start_matches('_');
    match index {
        "" => name.to_owned(),
        _ if first == 'p' || rest.starts_with('_') || index.bytes().all(|byte| byte.is_ascii_digit()) => {
            format!("{first}_{{{}}}", latex_name(index))
        }
        _ => upright(name),
    }
}

fn upright(name: &str) -> String {
    format!(r"\mathrm{{{}}}", name.replace('_', r"\_"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::parse;

    fn graph_of(text: &str) -> (Graph, Node, [String; 3]) {
        let names = ["x", "y", "px"].map(String::from);
        let mut graph = Graph::new();
        let node = graph.build(&parse(text).unwrap(), &names, &["theta".to_owned(), "width".to_owned()]).unwrap();
        (graph, node, names)
    }

    const FORMULAS: [&str; 16] = [
        "(x + y)/(2*px)",
        "(x - y)/3 + 2/(x + y)",
        "0",
        "-3/7",
        "x - y",
        "-x",
        "1/(2*x)",
        "-(x + y)^3*(x - y)/(3*sqrt(x))",
        "x^(-3/2) + 2.5",
        "cbrt(x*y)^2/theta",
        "(x*y)^(1/5)",
        "sin(x + y)^2 - exp(-x)*log(theta)",
        "atan(x/y)/(x^2 + y^2)^2",
        "-(-x + 1)",
        "x/(y*px)*3/4",
        "1/(1/x + 1/y)",
    ];

    #[test]
    fn long_sums_are_read_again() {
        let sum = (1..=789).map(|n| format!("x^{n}/{n}")).collect::<Vec<_>>();
        let sum = sum.chunks(100).map(|terms| format!("({})", terms.join(" - "))).collect::<Vec<_>>().join(" + ");
        let (mut graph, node, names) = graph_of(&sum);
        let text = graph.text(node, Notation::Formula, (&names, &[]), 20);
        assert_eq!(graph.build(&parse(&text).unwrap(), &names, &[]).unwrap(), node);
    }

    /// What is written is what it is of.
    #[test]
    fn formulas_are_read_again() {
        for formula in FORMULAS {
            let (mut graph, node, names) = graph_of(formula);
            let parameters = ["theta".to_owned(), "width".to_owned()];
            let text = graph.text(node, Notation::Formula, (&names, &parameters), 20);
            let again = graph.build(&parse(&text).unwrap(), &names, &parameters).unwrap();
            assert_eq!(again, node, "{formula} is written {text}");
        }
    }

    #[test]
    fn notations() {
        let written = |formula, notation| {
            let (graph, node, names) = graph_of(formula);
            graph.text(node, notation, (&names, &["theta".to_owned(), "width".to_owned()]), 5)
        };
        for (formula, latex, rust, numpy) in [
            (
                "-(x + y)^3*width/(3*sqrt(x))",
                r"-\frac{\left(x + y\right)^{3} \mathrm{width}}{3 \sqrt{x}}",
                "-(x + y).powi(3)*width/(3.0*x.sqrt())",
                "-(x + y)**3*width/(3*np.sqrt(x))",
            ),
            ("x^(3/2)", "x^{3/2}", "x.powf(3.0/2.0)", "x**(3/2)"),
            ("log(asin(px))", r"\log\left(\arcsin\left(p_{x}\right)\right)", "px.asin().ln()", "np.log(np.arcsin(px))"),
            ("1.23456789012345678e-9*theta", r"1.2346 \cdot 10^{-9} \theta", "1.2346e-9*theta", "1.2346e-9*theta"),
        ] {
            assert_eq!(written(formula, Notation::Latex), latex);
            assert_eq!(written(formula, Notation::Rust), rust);
            assert_eq!(written(formula, Notation::NumPy), numpy);
        }
    }

    #[test]
    fn names_that_latex_would_write_alike_stay_apart() {
        let names = ["x1", "x_1", "px"].map(String::from);
        let mut graph = Graph::new();
        let node = graph.build(&parse("x1*p_x*px/x_1").unwrap(), &names, &["p_x".to_owned()]).unwrap();
        let latex = graph.text(node, Notation::Latex, (&names, &["p_x".to_owned()]), 5);
        assert_eq!(latex, r"\frac{\mathrm{x1} \mathrm{p\_x} \mathrm{px}}{\mathrm{x\_1}}");
    }
}
