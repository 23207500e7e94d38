//! Brackets of functions of positions and momenta.

use num_traits::One;

use crate::symbolic::graph::{Graph, Node};
use crate::symbolic::number::rational::Rational;

impl Graph {
    /// [F, G] = F_pᵀG_q − F_qᵀG_p, where the first `freedoms` coordinates are positions and as many after them their
    /// momenta.
    ///
    /// So [U, T] = −U_qᵀT_p. It is −{F, G} with Poisson's bracket {F, G} = F_qᵀG_p − F_pᵀG_q, and the Lie derivatives
    /// {·, F} have [{·, F}, {·, G}] = {·, [F, G]}.
    ///
    /// ```
    /// use shadowstep_schemes::symbolic::{Graph, parse};
    ///
    /// let names = ["x", "p"].map(String::from);
    /// let mut graph = Graph::new();
    /// let [u, t, force] = ["x^4/4", "p^2/2", "-x^3*p"].map(|text| graph.build(&parse(text).unwrap(), &names, &[]).unwrap());
    /// assert_eq!(graph.bracket(u, t, 1), force);
    /// ```
    pub fn bracket(&mut self, f: Node, g: Node, freedoms: usize) -> Node {
        let mut terms = Vec::new();
        for i in 0..freedoms {
            let [f_q, f_p, g_q, g_p] = [(f, i), (f, freedoms + i), (g, i), (g, freedoms + i)]
                .map(|(function, coordinate)| self.derivative(function, coordinate));
            terms.push((self.times(f_p, g_q), Rational::one()));
            terms.push((self.times(f_q, g_p), -Rational::one()));
        }
        self.sum(&terms)
    }
}
