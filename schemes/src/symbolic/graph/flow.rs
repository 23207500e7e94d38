//! Hamiltonians whose flow has a formula.
//!
//! A Hamiltonian is given in q_1, …, q_d, p_1, …, p_d, the coordinates 0, …, 2d − 1 of the graph. Its terms are taken
//! together where they share a degree of freedom (q_i, p_i); what does not share one commutes, and flows by itself.

use std::collections::{BTreeSet, HashMap};

use num_traits::{One, Signed, Zero};

use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::rational::Rational;

/// The most degrees of freedom of a quadratic form: the time for its flow grows with their third power.
const MOST_COUPLED: usize = 64;

/// The largest size of an exponent of a monomial: its flow sums as many powers.
const MOST_EXPONENT: u32 = 64;

/// A Hamiltonian, or a part of one, whose flow is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ExplicitFlow {
    /// A function of variables none of which is the momentum of another: they stay, and their partners change at
    /// constant rates.
    Commuting {
        /// The variables, by their index among q and p.
        variables: Vec<usize>,
        /// The function; the first of these variables is its coordinate 0, and so on.
        function: Node,
    },
    /// ½xᵀSx in x = (q, p) of some degrees of freedom.
    Quadratic {
        /// The degrees of freedom.
        freedoms: Vec<usize>,
        /// S, row by row.
        matrix: Vec<Vec<Rational>>,
    },
    /// f(I) with the positive I = ½(a q² + 2b q p + c p²): a rotation.
    Rotation {
        /// The degree of freedom.
        freedom: usize,
        /// a, b, c
        form: [Rational; 3],
        /// f, in the coordinate 0.
        function: Node,
    },
    /// f(q p): q grows as p falls.
    Squeeze {
        /// The degree of freedom.
        freedom: usize,
        /// f, in the coordinate 0.
        function: Node,
    },
    /// c q^α p^β with α ≠ β, both not 0 and at most 64 in size.
    Monomial {
        /// The degree of freedom.
        freedom: usize,
        /// α, β
        exponents: [i32; 2],
        /// c q^(α−1) p^(β−1), with q and p as the coordinates 0 and 1.
        quotient: Node,
    },
    /// |p|²/(2m) − κ/|q| with m, κ > 0.
    Kepler {
        /// The degrees of freedom.
        freedoms: Vec<usize>,
        /// m
        mass: Rational,
        /// κ
        attraction: Rational,
    },
}

/// Nodes and their factors.
type Terms = Vec<(Node, Rational)>;

/// The flow of a Hamiltonian is not known: these degrees of freedom are coupled in it in another way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoFlow {
    /// The degrees of freedom.
    pub freedoms: Vec<usize>,
}

impl Graph {
    /// The commuting flows that the flow of a Hamiltonian consists of.
    ///
    /// It has no parameters; see [`Graph::replaced`]. What is found is exact: formulas that the rules do not simplify
    /// far enough are refused.
    ///
    /// ```
    /// use shadowstep_schemes::symbolic::{ExplicitFlow, Graph, parse};
    ///
    /// let variables = ["x", "y", "px", "py"].map(String::from);
    /// let mut graph = Graph::new();
    /// let mut flows = |text| {
    ///     let node = graph.build(&parse(text).unwrap(), &variables, &[]).unwrap();
    ///     graph.explicit_flows(node, 2)
    /// };
    /// assert!(matches!(flows("x*py + x^4").unwrap()[..], [ExplicitFlow::Commuting { .. }]));
    /// assert!(matches!(flows("x*py - y*px").unwrap()[..], [ExplicitFlow::Quadratic { .. }]));
    /// assert!(matches!(flows("(x^2 + px^2)^2").unwrap()[..], [ExplicitFlow::Rotation { .. }]));
    /// assert!(matches!(flows("-px^2/x").unwrap()[..], [ExplicitFlow::Monomial { exponents: [-1, 2], .. }]));
    /// assert!(matches!(flows("(px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)").unwrap()[..], [ExplicitFlow::Kepler { .. }]));
    /// assert_eq!(flows("px^2/2 + x^4").unwrap_err().freedoms, [0]);
    /// ```
    ///
    /// # Errors
    /// Degrees of freedom whose flow is not known.
    pub fn explicit_flows(&mut self, hamiltonian: Node, freedoms: usize) -> Result<Vec<ExplicitFlow>, NoFlow> {
        if self.commutes(hamiltonian, freedoms) {
            return Ok(vec![self.commuting(hamiltonian)]);
        }
        // the flows of commuting variables are computed together
        let mut together = Vec::new();
        let mut flows = Vec::new();
        for (of, term) in self.components(hamiltonian, freedoms) {
            match self.commutes(term, freedoms) {
                true => together.push((term, Rational::one())),
                false => flows.push(self.flow_of(term, of, freedoms)?),
            }
        }
        if !together.is_empty() {
            let sum = self.sum(&together);
            flows.push(self.commuting(sum));
        }
        Ok(flows)
    }

    /// The variables in a formula.
    fn variables(&self, node: Node) -> BTreeSet<usize> {
        let index = |part| match self.form(part) {
            Form::Coordinate(index) => Some(*index),
            _ => None,
        };
        self.below(&[node]).into_iter().filter_map(index).collect()
    }

    /// Whether no variable is the momentum of another.
    fn commutes(&self, node: Node, freedoms: usize) -> bool {
        let variables = self.variables(node);
        !variables.iter().any(|index| variables.contains(&(index + freedoms)))
    }

    fn commuting(&mut self, node: Node) -> ExplicitFlow {
        let variables: Vec<usize> = self.variables(node).into_iter().collect();
        let renamed = variables.iter().enumerate();
        let renamed = renamed.map(|(new, old)| (self.coordinate(*old), self.coordinate(new))).collect();
        ExplicitFlow::Commuting { function: self.replaced(&[node], renamed)[0], variables }
    }

    /// The sums of the terms that share degrees of freedom, and of those without any.
    fn components(&mut self, node: Node, freedoms: usize) -> Vec<(BTreeSet<usize>, Node)> {
        let terms = match &*self.shared_form(node) {
            Form::Sum { constant, terms } => {
                let mut terms = terms.clone();
                if !constant.is_zero() {
                    terms.push((self.number(constant.clone()), Rational::one()));
                }
                terms
            }
            _ => vec![(node, Rational::one())],
        };
        let mut components: Vec<(BTreeSet<usize>, Terms)> = Vec::new();
        for (term, factor) in terms {
            let mut of: BTreeSet<usize> = self.variables(term).into_iter().map(|index| index % freedoms).collect();
            let mut members = vec![(term, factor)];
            let (shared, others): (Vec<_>, Vec<_>) =
                components.into_iter().partition(|(other, _)| !other.is_disjoint(&of));
            for (other, terms) in shared {
                of.extend(other);
                members.extend(terms);
            }
            components = others;
            components.push((of, members));
        }
        components.into_iter().map(|(of, terms)| (of, self.sum(&terms))).collect()
    }

    /// The flow of a function of coupled degrees of freedom.
    fn flow_of(&mut self, node: Node, of: BTreeSet<usize>, freedoms: usize) -> Result<ExplicitFlow, NoFlow> {
        let of: Vec<usize> = of.into_iter().collect();
        if of.len() <= MOST_COUPLED
            && let Some(matrix) = self.quadratic_form(node, &of, freedoms)
        {
            return Ok(ExplicitFlow::Quadratic { freedoms: of, matrix });
        }
        let found = match of[..] {
            [freedom] => self.of_one_pair(node, freedom, freedoms).or_else(|| self.monomial(node, freedom, freedoms)),
            _ => None,
        };
        found.or_else(|| self.kepler(node, &of, freedoms)).ok_or(NoFlow { freedoms: of })
    }

    /// S, if the node is ½xᵀSx in q and p of these degrees of freedom.
    fn quadratic_form(&mut self, node: Node, of: &[usize], freedoms: usize) -> Option<Vec<Vec<Rational>>> {
        let rate = self.rate(node);
        if !self.vanishes(rate) {
            return None;
        }
        let variables: Vec<usize> = of.iter().copied().chain(of.iter().map(|i| i + freedoms)).collect();
        let mut matrix = Vec::new();
        for &i in &variables {
            let slope = self.derivative(node, i);
            let second = |j: &usize| {
                let second = self.derivative(slope, *j);
                self.as_number(second).cloned()
            };
            matrix.push(variables.iter().map(second).collect::<Option<Vec<_>>>()?);
        }
        Some(matrix)
    }

    /// f(I) of one pair of variables: I is looked for among the sums in the formula.
    fn of_one_pair(&mut self, node: Node, freedom: usize, freedoms: usize) -> Option<ExplicitFlow> {
        let (q, p) = (freedom, freedom + freedoms);
        let zero = Rational::zero;
        let mut candidates = vec![[zero(), Rational::one(), zero()]];
        let parts: Vec<Node> = self.below(&[node]).into_iter().collect();
        candidates.extend(parts.into_iter().filter_map(|part| self.own_quadratic_terms(part, q, p)));
        candidates.into_iter().find_map(|form| self.function_of(node, form, freedom, freedoms))
    }

    /// a, b, c of the terms ½a q² + b q p + ½c p² of a sum, if there are any.
    fn own_quadratic_terms(&mut self, node: Node, q: usize, p: usize) -> Option<[Rational; 3]> {
        let [q, p] = [q, p].map(|index| self.coordinate(index));
        let two = Rational::from_integer(2.into());
        let [square_of_q, square_of_p] = [q, p].map(|x| self.power(x, &two));
        let product = self.times(q, p);
        let Form::Sum { terms, .. } = self.form(node) else { return None };
        let factor = |of: Node| {
            terms.iter().find(|(term, _)| *term == of).map_or_else(Rational::zero, |(_, factor)| factor.clone())
        };
        let form = [factor(square_of_q) * &two, factor(product), factor(square_of_p) * &two];
        form.iter().any(|factor| !factor.is_zero()).then_some(form)
    }

    /// The flow, if the node is a function of I = ½(a q² + 2b q p + c p²): then it has no Poisson bracket with I.
    fn function_of(
        &mut self,
        node: Node,
        form: [Rational; 3],
        freedom: usize,
        freedoms: usize,
    ) -> Option<ExplicitFlow> {
        let determinant = &form[0] * &form[2] - &form[1] * &form[1];
        let is_rotation = determinant.is_positive();
        let is_product = form[0].is_zero() && form[2].is_zero();
        if !is_rotation && !is_product {
            return None;
        }
        let form = if form[0].is_negative() { form.map(|x| -x) } else { form };
        let [a, b, c] = &form;
        let (q, p) = (self.coordinate(freedom), self.coordinate(freedom + freedoms));
        let [of_q, of_p] =
            [[(q, a.clone()), (p, b.clone())], [(q, b.clone()), (p, c.clone())]].map(|terms| self.sum(&terms));
        let [slope_q, slope_p] = [freedom, freedom + freedoms].map(|index| self.derivative(node, index));
        let [forth, back] = [(slope_q, of_p), (slope_p, of_q)].map(|(slope, of)| self.times(slope, of));
        let bracket = self.sum(&[(forth, Rational::one()), (back, -Rational::one())]);
        if !self.vanishes(bracket) {
            return None;
        }
        // f(I): of a rotation at p = 0 and q = √(2I/a), else at q = 1 and p = I
        let action = self.coordinate(0);
        let values = if is_rotation {
            let square = self.scaled(action, &(Rational::from_integer(2.into()) / a));
            [self.power(square, &Rational::new(1.into(), 2.into())), self.number(Rational::zero())]
        } else {
            [self.number(Rational::one()), action]
        };
        let function = self.replaced(&[node], HashMap::from([(q, values[0]), (p, values[1])]))[0];
        Some(match is_rotation {
            true => ExplicitFlow::Rotation { freedom, form, function },
            false => ExplicitFlow::Squeeze { freedom, function },
        })
    }

    /// The flow, if the node is c q^α p^β with whole exponents.
    fn monomial(&mut self, node: Node, freedom: usize, freedoms: usize) -> Option<ExplicitFlow> {
        let (q, p) = (self.coordinate(freedom), self.coordinate(freedom + freedoms));
        let product = match self.form(node) {
            Form::Sum { constant, terms } if constant.is_zero() && terms.len() == 1 => terms[0].0,
            _ => node,
        };
        let Form::Product(factors) = self.form(product) else { return None };
        let of = |variable: Node| factors.iter().find(|(factor, _)| *factor == variable).map(|(_, exponent)| exponent);
        let exponents = [of(q)?, of(p)?];
        if factors.len() != 2 || !exponents.iter().all(|exponent| exponent.is_integer()) {
            return None;
        }
        let exponents: [i32; 2] = [exponents[0].numer().try_into().ok()?, exponents[1].numer().try_into().ok()?];
        if exponents.iter().any(|exponent| exponent.unsigned_abs() > MOST_EXPONENT) {
            return None;
        }
        let inverse = -Rational::one();
        let quotient = self.product(&[(node, Rational::one()), (q, inverse.clone()), (p, inverse)]);
        let renamed = HashMap::from([(q, self.coordinate(0)), (p, self.coordinate(1))]);
        Some(ExplicitFlow::Monomial { freedom, exponents, quotient: self.replaced(&[quotient], renamed)[0] })
    }

    /// The flow, if the node is |p|²/(2m) − κ/|q|.
    fn kepler(&mut self, node: Node, of: &[usize], freedoms: usize) -> Option<ExplicitFlow> {
        let one = Rational::one;
        let two = Rational::from_integer(2.into());
        let squares = |graph: &mut Graph, offset: usize| -> Vec<(Node, Rational)> {
            of.iter()
                .map(|i| {
                    let variable = graph.coordinate(i + offset);
                    (graph.power(variable, &two), one())
                })
                .collect()
        };
        let [of_q, of_p] = [0, freedoms].map(|offset| squares(self, offset));
        let square_of_r = self.sum(&of_q);
        let inverse = self.power(square_of_r, &Rational::new((-1).into(), 2.into()));
        let Form::Sum { terms, .. } = self.form(node) else { return None };
        let factor = |of: Node| terms.iter().find(|(term, _)| *term == of).map(|(_, factor)| factor.clone());
        let (of_kinetic, attraction) = (factor(of_p[0].0)?, -factor(inverse)?);
        if !of_kinetic.is_positive() || !attraction.is_positive() {
            return None;
        }
        let mut terms: Vec<_> = of_p.into_iter().map(|(square, _)| (square, of_kinetic.clone())).collect();
        terms.push((inverse, -&attraction));
        let mass = one() / (&of_kinetic * &two);
        let expected = self.sum(&terms);
        (expected == node).then(|| ExplicitFlow::Kepler { freedoms: of.to_vec(), mass, attraction })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::parse;

    const VARIABLES: [&str; 6] = ["x", "y", "z", "px", "py", "pz"];

    fn flows(text: &str) -> Result<Vec<ExplicitFlow>, NoFlow> {
        let mut graph = Graph::new();
        let node = graph.build(&parse(text).unwrap(), &VARIABLES.map(String::from), &[]).unwrap();
        graph.explicit_flows(node, 3)
    }

    fn kinds(text: &str) -> Vec<&'static str> {
        let kind = |flow: &ExplicitFlow| match flow {
            ExplicitFlow::Commuting { .. } => "commuting",
            ExplicitFlow::Quadratic { .. } => "quadratic",
            ExplicitFlow::Rotation { .. } => "rotation",
            ExplicitFlow::Squeeze { .. } => "squeeze",
            ExplicitFlow::Monomial { .. } => "monomial",
            ExplicitFlow::Kepler { .. } => "kepler",
        };
        flows(text).unwrap_or_else(|refused| panic!("{text}: {refused:?}")).iter().map(kind).collect()
    }

    #[test]
    fn formulas_of_every_kind() {
        for (text, expected) in [
            ("px^2/2 + py^4", &["commuting"][..]),
            ("cos(x - y) + 3", &["commuting"]),
            ("x*py + sin(x)*exp(py)", &["commuting"]),
            ("x*py - y*px", &["quadratic"]),
            ("(px - y/2)^2/2 + (py + x/2)^2/2", &["quadratic"]),
            ("(x^2 + px^2)/2 + (x^2 + px^2)^2/8", &["rotation"]),
            ("x^4 + 2*x^2*px^2 + px^4 + x^2 + px^2", &["rotation"]),
            ("sqrt(1 + x^2 + 4*px^2)", &["rotation"]),
            ("sin(x^2 + x*px + px^2)", &["rotation"]),
            ("(x*px)^2", &["squeeze"]),
            ("exp(x*px)", &["squeeze"]),
            ("-px^2/x", &["monomial"]),
            ("3*px^2/(2*x^2) + y*py^3", &["monomial", "monomial"]),
            ("x*px^2", &["monomial"]),
            ("(px^2 + py^2 + pz^2)/6 - 4/sqrt(x^2 + y^2 + z^2)", &["kepler"]),
            ("px^2/2 - 1/sqrt(x^2)", &["kepler"]),
            ("(x^2 + px^2)^2 + py*y + pz^2", &["rotation", "quadratic", "commuting"]),
            ("(x^2 + px^2)^2 + (y^2 + 9*py^2)^3 + 1", &["rotation", "rotation", "commuting"]),
        ] {
            let mut found = kinds(text);
            let mut expected = expected.to_vec();
            found.sort_unstable();
            expected.sort_unstable();
            assert_eq!(found, expected, "{text}");
        }
    }

    #[test]
    fn others() {
        for (text, freedoms) in [
            ("px^2/2 + x^4", vec![0]),
            ("py^2/2 + sin(y) + x", vec![1]),
            ("(x*px)^2 + x^2 + px^2", vec![0]),
            ("px^2/x + px^2/x^2", vec![0]),
            ("px^2/sqrt(x)", vec![0]),
            ("px^2*sin(x)", vec![0]),
            ("x^65*px^2", vec![0]),
            ("(px^2 + py^2)/2 + 1/sqrt(x^2 + y^2)", vec![0, 1]),
            ("(px^2 + 2*py^2)/2 - 1/sqrt(x^2 + y^2)", vec![0, 1]),
            ("(x^2 - px^2)^2", vec![0]),
            ("(x^2 + px^2)*(y^2 + py^2)", vec![0, 1]),
        ] {
            assert_eq!(flows(text), Err(NoFlow { freedoms }), "{text}");
        }
    }

    #[test]
    fn a_rotation_has_the_function_of_its_action() {
        let rational = |n: i32, d: i32| Rational::new(n.into(), d.into());
        let mut graph = Graph::new();
        let node =
            graph.build(&parse("3*(x^2 + 4*px^2) + (x^2 + 4*px^2)^2/8").unwrap(), &VARIABLES.map(String::from), &[]);
        let flows = graph.explicit_flows(node.unwrap(), 3).unwrap();
        let [ExplicitFlow::Rotation { freedom: 0, form, function }] = &flows[..] else { panic!("{flows:?}") };
        // of x² + 4 px² with a factor: I is this times the factor
        let scale = &form[0];
        assert_eq!(form[1], Rational::zero());
        assert_eq!(form[2], scale * rational(4, 1));
        let (linear, square) = (rational(6, 1) / scale, rational(1, 2) / (scale * scale));
        let action = graph.coordinate(0);
        let squared = graph.power(action, &rational(2, 1));
        assert_eq!(graph.sum(&[(action, linear), (squared, square)]), *function);
    }
}
