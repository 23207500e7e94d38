//! Whether a formula is a quadratic form, or at most quadratic.

use crate::symbolic::graph::{Form, Graph, Node};

impl Graph {
    /// Whether f = ½xᵀAx in the first `coordinates` coordinates x, where A does not depend on x.
    ///
    /// This holds if f is homogeneous of degree 2 (xᵀf_x − 2f = 0) and no second derivative depends on x. Both are
    /// checked on simplified formulas; where the rules do not simplify far enough, the result is false.
    ///
    /// ```
    /// use shadowstep_schemes::symbolic::{Graph, parse};
    ///
    /// let mut graph = Graph::new();
    /// let mut is_quadratic = |text| {
    ///     let coordinates = ["x".to_string(), "y".to_string()];
    ///     let node = graph.build(&parse(text).unwrap(), &coordinates, &["m".to_string()]).unwrap();
    ///     graph.is_quadratic(node, 2)
    /// };
    /// assert!(is_quadratic("(x - y)^2/(2*m) + x*y"));
    /// assert!(!is_quadratic("x^2/2 + y")); // not homogeneous
    /// assert!(!is_quadratic("x^3/y")); // of degree 2, but not a polynomial
    /// ```
    pub fn is_quadratic(&mut self, node: Node, coordinates: usize) -> bool {
        let rate = self.rate(node);
        self.is_zero(rate) && self.is_at_most_quadratic(node, coordinates)
    }

    /// Whether f = ½xᵀAx + bᵀx + c in the first `coordinates` coordinates x: no second derivative depends on x. Where
    /// the rules do not simplify far enough, the result is false.
    ///
    /// ```
    /// use shadowstep_schemes::symbolic::{Graph, parse};
    ///
    /// let mut graph = Graph::new();
    /// let mut is_at_most_quadratic = |text| {
    ///     let coordinates = ["x".to_string(), "y".to_string()];
    ///     let node = graph.build(&parse(text).unwrap(), &coordinates, &["m".to_string()]).unwrap();
    ///     graph.is_at_most_quadratic(node, 2)
    /// };
    /// assert!(is_at_most_quadratic("x^2/(2*m) + y + 1"));
    /// assert!(!is_at_most_quadratic("x^2/2 + y^3"));
    /// ```
    pub fn is_at_most_quadratic(&mut self, node: Node, coordinates: usize) -> bool {
        (0..coordinates).all(|i| {
            let slope = self.derivative(node, i);
            (i..coordinates).all(|j| {
                let second = self.derivative(slope, j);
                self.is_free_of_coordinates(second)
            })
        })
    }

    fn is_free_of_coordinates(&self, node: Node) -> bool {
        !self.below(&[node]).into_iter().any(|part| matches!(self.form(part), Form::Coordinate(_)))
    }
}

#[cfg(test)]
mod tests {
    use crate::symbolic::{Graph, parse};

    fn is_quadratic(text: &str) -> bool {
        let names = ["x", "y", "z"].map(String::from);
        let mut graph = Graph::new();
        let node = graph.build(&parse(text).unwrap(), &names, &["m".to_string()]).unwrap();
        graph.is_quadratic(node, 3)
    }

    #[test]
    fn quadratic_forms() {
        for text in ["x^2/2", "0", "x*y", "m^-1 * (x^2 + 2*x*y - y*z/3)", "(x + 2*y - z)^2/sin(m)", "x^3/x"] {
            assert!(is_quadratic(text), "{text}");
        }
    }

    #[test]
    fn others() {
        for text in [
            "1",
            "x",
            "x^2 + 1",
            "x^2 + y",
            "x^4",
            "x^3/y",
            "sqrt(1 + x^2)",
            "sqrt(x^4 + y^4)",
            "cos(x)",
            "exp(x) - x",
            "m*x",
            "x^2*exp(y/x)",
        ] {
            assert!(!is_quadratic(text), "{text}");
        }
    }

    #[test]
    fn polynomials_of_degree_two_at_most() {
        let names = ["x", "y", "z"].map(String::from);
        let is = |text: &str| {
            let mut graph = Graph::new();
            let node = graph.build(&parse(text).unwrap(), &names, &["m".to_string()]).unwrap();
            graph.is_at_most_quadratic(node, 3)
        };
        for text in ["1", "x", "x^2/2 + z", "x^2 + y/3 + m", "(x - 1)^2/(2*m) + x*y", "x*y + z", "sin(m)*x"] {
            assert!(is(text), "{text}");
        }
        for text in ["x^3", "x^2 + y^3/10", "sqrt(1 + x^2) + y", "cos(x) + y^2", "x^2/2 + x*y*z", "x^2*exp(y/x)"] {
            assert!(!is(text), "{text}");
        }
    }
}
