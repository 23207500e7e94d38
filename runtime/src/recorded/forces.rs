//! Whether logged forces are smooth along the trajectory, from their differences in time.

/// The states that it needs, one after the other.
pub(super) const STATES: usize = 17;
/// The order m of the differences.
const ORDER: usize = 8;
/// (−1)^i C(8, i)
const WEIGHTS: [f64; ORDER + 1] = [1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0, 1.0];
/// C(16, 8), the sum of their squares.
const SQUARES: f64 = 12870.0;

/// Eighth differences of the gradients of states a step apart, and of every second state.
///
/// The mean square S of a difference, divided by C(16, 8), is σ² for noise of variance σ², at both distances. Where U' jumps it doubles with the
/// distance, as twice as many jumps are seen; where U'' jumps it is 2³ times as large. Where the forces are smooth and the steps resolve the motion,
/// it is 2¹⁶ times as large.
#[derive(Clone, Debug)]
pub(super) struct ForceDifferences {
    dimension: usize,
    /// The newest gradients, that of the state n in place n mod their number.
    ring: Vec<f64>,
    /// States since the sequence began, and since the log did.
    pushed: usize,
    count: u64,
    /// Σ of squares at the distances h and 2h.
    squares: [f64; 2],
    /// Σ of squares at the distance h times those of the velocities.
    powers: f64,
    gradients: f64,
}

impl ForceDifferences {
    pub(super) fn new(dimension: usize) -> Self {
        ForceDifferences {
            dimension,
            ring: vec![0.0; STATES * dimension],
            pushed: 0,
            count: 0,
            squares: [0.0; 2],
            powers: 0.0,
            gradients: 0.0,
        }
    }

    /// The next state does not follow the newest.
    pub(super) fn begin(&mut self) {
        self.pushed = 0;
    }

    /// Takes the gradient at a state with these momenta, of coordinates with these masses.
    pub(super) fn push(&mut self, gradient: &[f64], p: &[f64], masses: &[f64]) {
        let dimension = self.dimension;
        let place = |back: usize| (self.pushed + STATES - back) % STATES * dimension;
        self.ring[place(0)..][..dimension].copy_from_slice(gradient);
        self.pushed += 1;
        if self.pushed < STATES {
            return;
        }
        let newest = self.pushed - 1;
        let place = |back: usize| (newest + STATES - back) % STATES * dimension;
        let rows = |distance: usize| -> [&[f64]; ORDER + 1] {
            std::array::from_fn(|i| &self.ring[place(i * distance)..][..dimension])
        };
        let difference = |rows: &[&[f64]; ORDER + 1], c: usize| -> f64 {
            rows.iter().zip(WEIGHTS).map(|(row, weight)| weight * row[c]).sum()
        };
        let (near, far) = (rows(1), rows(2));
        for c in 0..dimension {
            let square = difference(&near, c).powi(2);
            self.squares[0] += square;
            self.squares[1] += difference(&far, c).powi(2);
            self.powers += square * (p[c] / masses[c]).powi(2);
        }
        self.count += dimension as u64;
        self.gradients += gradient.iter().map(|x| x * x).sum::<f64>();
    }

    /// The mean of Σ (σ v)² of a state, where the differences are noise of each component, of its size σ; v is the velocity.
    pub(super) fn power(&self) -> f64 {
        self.powers / SQUARES / (self.count as f64 / self.dimension as f64)
    }

    /// Once there were as many states as it needs.
    pub(super) fn found(&self) -> Option<Smoothness> {
        let count = self.count as f64;
        let [near, far] = self.squares.map(|squares| squares / count / SQUARES);
        (self.count > 0).then(|| Smoothness {
            gradient: (self.gradients / count).sqrt(),
            differences: near.sqrt(),
            exponent: (far / near).log2(),
        })
    }
}

/// How smooth the gradient is along the trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothness {
    /// The root mean square of U_q.
    pub gradient: f64,
    /// That of its eighth differences in time, divided by √C(16, 8): the size of the noise of a component, if they are noise.
    pub differences: f64,
    /// log₂ of how many times as large their squares are where the distance of the states is doubled: 0 for noise, 1 where U′ jumps, 3 where U″
    /// does, 16 where the forces are smooth and the steps resolve the motion.
    pub exponent: f64,
}
