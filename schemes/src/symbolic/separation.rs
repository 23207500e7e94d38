//! Pairs of bodies: the variable of their formulas, and what is added up over all pairs for the rate.

/// The variable in the formula of a pair of bodies i < j.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Separation {
    /// d = q_j − q_i, on a line
    Difference,
    /// r² = |q_j − q_i|², in any dimension
    SquaredDistance,
}

impl Separation {
    /// Its name in formulas: `d`, `r2`.
    pub fn name(self) -> &'static str {
        match self {
            Separation::Difference => "d",
            Separation::SquaredDistance => "r2",
        }
    }

    /// The separation of this name.
    pub fn named(name: &str) -> Option<Self> {
        [Separation::Difference, Separation::SquaredDistance].into_iter().find(|separation| separation.name() == name)
    }
}

/// What is added up over the pairs of bodies to find the rate qᵀU_q − 2U of their sum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Summand {
    /// A pair's own rate, d u'(d) − 2u or 2r²u'(r²) − 2u: the sum of these is the rate.
    Rate,
    /// A pair's energy u: the rate is qᵀU_q − 2 Σ u. Its round-off grows with q, as it does for other products with q
    /// in estimates.
    Energy,
}
