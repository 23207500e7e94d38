//! What differences of logged states from the steps do to the energy.

/// The sums of g·r_q + v·r_p, the work of the differences r of logged states from the steps between them, with the mean
/// g and v of both states.
#[derive(Clone, Debug, Default)]
pub(super) struct Work {
    of_step: f64,
    sum: f64,
    /// The smallest and the largest sum.
    bounds: [f64; 2],
    /// Of q and of p.
    squares: [f64; 2],
    steps: u64,
}

impl Work {
    /// Takes the work of one coordinate.
    #[inline]
    pub(super) fn add(&mut self, [of_q, of_p]: [f64; 2]) {
        self.of_step += of_q + of_p;
        self.squares[0] += of_q * of_q;
        self.squares[1] += of_p * of_p;
    }

    /// Ends a step.
    pub(super) fn end(&mut self) {
        self.sum += std::mem::take(&mut self.of_step);
        let [lowest, highest] = self.bounds;
        self.bounds = [lowest.min(self.sum), highest.max(self.sum)];
        self.steps += 1;
    }

    /// max − min of the sum over all steps, also of `steps` steps of which these are a part.
    pub(super) fn range(&self, steps: u64) -> f64 {
        let [lowest, highest] = self.bounds;
        (highest - lowest) * (steps as f64 / self.steps as f64)
    }

    /// The root mean squares of a step, of q and of p, if the differences of the coordinates are independent.
    pub(super) fn in_a_step(&self) -> [f64; 2] {
        self.squares.map(|squares| (squares / self.steps as f64).sqrt())
    }
}
