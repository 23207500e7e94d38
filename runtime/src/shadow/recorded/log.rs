//! The states of a log, and what the other program has logged of U at each.

use super::error::RecordedError;

/// A state of a log, with what is known of U there.
#[derive(Clone, Copy, Debug)]
pub struct Logged<'a> {
    /// Positions, unwrapped: see [`Unwrapping`](super::Unwrapping).
    pub q: &'a [f64],
    /// Momenta at the time of the positions: see [`integer_momenta`](super::integer_momenta) for momenta of leapfrog.
    pub p: &'a [f64],
    /// U(q)
    pub energy: f64,
    /// Its derivatives.
    pub derivatives: Derivatives<'a>,
}

/// What is known of the derivatives of U at a state.
#[derive(Clone, Copy, Debug)]
pub enum Derivatives<'a> {
    /// The gradient U_q: the forces times −1, as the steps used them.
    Gradient(&'a [f64]),
    /// The rate qᵀU_q − 2U alone, of the logged q: not the virial by nearest images.
    Rate(f64),
    /// The gradient U_q, and what the step to the state added: for every splitting.
    Step(&'a [f64], MadeStep<'a>),
}

/// What a step of any splitting from a state q_n, p_n added, as the program has summed it along its kicks and drifts.
/// Before the first step it is not read.
///
/// A kick by h a_s U_q, and a drift by h b_s M⁻¹p, add to
///
/// $$\Delta p = -\sum_s h a_s U_q(q_s), \quad \Delta q = \sum_s h b_s M^{-1} p_s, \quad
/// \Delta\beta' = \sum_s h a_s \left( (q_s - q_n)^{\mathsf T} U_q(q_s) - 2U(q_s) \right),$$
///
/// so that q_s − q_n is what Δq has become before the kick: wherever q is counted from, and whatever image of a
/// periodic box the program has of it.
#[derive(Clone, Copy, Debug)]
pub struct MadeStep<'a> {
    /// Δq
    pub q: &'a [f64],
    /// Δp
    pub p: &'a [f64],
    /// Δβ'; β itself grows by Δβ' − q_nᵀΔp.
    pub beta: f64,
}

impl<'a> Derivatives<'a> {
    /// U_q, where it is known.
    pub(super) fn gradient(&self) -> Option<&'a [f64]> {
        match self {
            Derivatives::Gradient(gradient) | Derivatives::Step(gradient, _) => Some(gradient),
            Derivatives::Rate(_) => None,
        }
    }

    /// What of them is known.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Derivatives::Gradient(_) => "a gradient",
            Derivatives::Rate(_) => "a rate",
            Derivatives::Step(..) => "increments",
        }
    }
}

/// A log in memory: arrays with a row for each of the states n = 0, 1, …, at equal distances h.
#[derive(Clone, Copy, Debug)]
pub struct Log<'a> {
    dimension: usize,
    q: &'a [f64],
    p: &'a [f64],
    energies: &'a [f64],
    derivatives: LoggedDerivatives<'a>,
}

#[derive(Clone, Copy, Debug)]
enum LoggedDerivatives<'a> {
    Gradients(&'a [f64]),
    Rates(&'a [f64]),
}

impl<'a> Log<'a> {
    /// A log of q, p, U and U_q: for each state `dimension` numbers of `q`, `p` and `gradients`, one after the other,
    /// and one of `energies`.
    ///
    /// # Errors
    /// Arrays that are not of as many states; no coordinates.
    pub fn with_gradients(
        dimension: usize,
        [q, p, gradients]: [&'a [f64]; 3],
        energies: &'a [f64],
    ) -> Result<Self, RecordedError> {
        let log = Log { dimension, q, p, energies, derivatives: LoggedDerivatives::Gradients(gradients) };
        log.check(("the gradient", gradients, dimension))
    }

    /// A log of q, p, U and the rate qᵀU_q − 2U.
    ///
    /// # Errors
    /// As [`with_gradients`](Log::with_gradients).
    pub fn with_rates(
        dimension: usize,
        [q, p]: [&'a [f64]; 2],
        [energies, rates]: [&'a [f64]; 2],
    ) -> Result<Self, RecordedError> {
        let log = Log { dimension, q, p, energies, derivatives: LoggedDerivatives::Rates(rates) };
        log.check(("the rate", rates, 1))
    }

    fn check(self, of_derivatives: (&'static str, &[f64], usize)) -> Result<Self, RecordedError> {
        if self.dimension == 0 {
            return Err(RecordedError::NoCoordinates);
        }
        let rows = self.energies.len();
        for (name, numbers, columns) in [("q", self.q, self.dimension), ("p", self.p, self.dimension), of_derivatives] {
            if numbers.len() != rows * columns {
                return Err(RecordedError::Shape { name, found: numbers.len(), rows, columns });
            }
        }
        Ok(self)
    }

    /// How many states there are.
    pub fn len(&self) -> usize {
        self.energies.len()
    }

    /// Whether there is no state.
    pub fn is_empty(&self) -> bool {
        self.energies.is_empty()
    }

    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The state n; `None` after the last.
    pub fn state(&self, n: usize) -> Option<Logged<'a>> {
        let energy = *self.energies.get(n)?;
        let row = |numbers: &'a [f64]| &numbers[n * self.dimension..][..self.dimension];
        let derivatives = match self.derivatives {
            LoggedDerivatives::Gradients(gradients) => Derivatives::Gradient(row(gradients)),
            LoggedDerivatives::Rates(rates) => Derivatives::Rate(rates[n]),
        };
        Some(Logged { q: row(self.q), p: row(self.p), energy, derivatives })
    }

    /// The states in the order of time.
    pub fn states(&self) -> impl Iterator<Item = Logged<'a>> {
        let log = *self;
        (0..self.len()).filter_map(move |n| log.state(n))
    }
}
