//! Whether logged forces, or U, are smooth along the trajectory, from what is left of them where a polynomial in time
//! is taken away.

use super::window::Window;

/// A linear combination of states that follow each other at a distance, which is 0 for polynomials below some degree.
struct Filter {
    weights: [f64; 9],
    distance: usize,
    /// Σ weights²
    squares: f64,
}

impl Filter {
    const fn of(weights: [i32; 9], distance: usize) -> Filter {
        let (mut own, mut squares, mut i) = ([0.0; 9], 0, 0);
        while i < 9 {
            own[i] = weights[i] as f64;
            squares += weights[i] * weights[i];
            i += 1;
        }
        Filter { weights: own, distance, squares: squares as f64 }
    }
}

/// (−1)^i C(8, i), which is also the orthogonal polynomial of degree 8 of nine places.
const EIGHTH: [i32; 9] = [1, -8, 28, -56, 70, -56, 28, -8, 1];

/// The orthogonal polynomials of degree 5 to 8 of nine places: two smooth ones, and two rough ones.
const NINE: [[Filter; 2]; 2] = [
    [Filter::of([-1, 6, -14, 14, 0, -14, 14, -6, 1], 1), Filter::of(EIGHTH, 1)],
    [Filter::of([-4, 11, -4, -9, 0, 9, 4, -11, 4], 1), Filter::of([4, -17, 22, 1, -20, 1, 22, -17, 4], 1)],
];

/// Eighth differences of states a step apart, and of every second one.
const SEVENTEEN: [[Filter; 1]; 2] = [[Filter::of(EIGHTH, 1)], [Filter::of(EIGHTH, 2)]];

/// log₂ of the ratio of the squares that [`NINE`] finds in forces whose p-th derivative jumps, at all places in turn,
/// and 2p + 1: the exponent. For noise both are 0.
const EXPONENTS: [(f64, f64); 5] = [(0.0, 0.0), (0.5481, 1.0), (1.8637, 3.0), (3.3715, 5.0), (5.1819, 7.0)];

impl Window {
    /// What is left of forces beside noise, and what is left of them where they are less smooth than by the first.
    fn filters(self) -> [&'static [Filter]; 2] {
        match self {
            Window::Nine => [&NINE[0], &NINE[1]],
            Window::Seventeen => [&SEVENTEEN[0], &SEVENTEEN[1]],
        }
    }

    /// The exponent that belongs to log₂ of the ratio of their squares.
    fn exponent(self, ratio: f64) -> f64 {
        match self {
            Window::Seventeen => ratio,
            Window::Nine => {
                let last = &EXPONENTS[EXPONENTS.len() - 2..];
                let part = EXPONENTS.windows(2).find(|part| ratio < part[1].0).unwrap_or(last);
                let ((from, low), (to, high)) = (part[0], part[1]);
                low + (high - low) * (ratio - from) / (to - from)
            }
        }
    }
}

/// Sums of squares of what the filters of a window leave of the gradients.
///
/// The mean square S of what a filter leaves, divided by Σ weights², is σ² for noise of variance σ². For eighth
/// differences it doubles with the distance where U' jumps, as twice as many jumps are seen; where U'' jumps it is 2³
/// times as large. Where the forces are smooth and the steps resolve the motion, it is 2¹⁶ times as large.
#[derive(Clone, Debug)]
pub(super) struct Roughness {
    window: Window,
    dimension: usize,
    /// The newest gradients, the gradient at the state n in place n mod their number.
    ring: Vec<f64>,
    /// States since the sequence began, and components of all windows.
    pushed: usize,
    count: u64,
    /// Σ of squares by the filters.
    squares: [f64; 2],
    /// Σ of the first filter of the gradients times the same filter of the velocities.
    powers: f64,
    gradients: f64,
}

impl Roughness {
    pub(super) fn new(window: Window, dimension: usize) -> Self {
        Roughness {
            window,
            dimension,
            ring: vec![0.0; window.states() * dimension],
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
        let (dimension, states, newest) = (self.dimension, self.window.states(), self.pushed);
        let place = |back: usize| (newest + states - back) % states * dimension;
        self.ring[place(0)..][..dimension].copy_from_slice(gradient);
        self.pushed += 1;
        if self.pushed < states {
            return;
        }
        let mean_squares = self.window.filters().map(|filters| {
            let mut found = vec![0.0; dimension];
            for Filter { weights, distance, squares } in filters {
                let rows: [&[f64]; 9] = std::array::from_fn(|i| &self.ring[place(i * distance)..][..dimension]);
                for (c, found) in found.iter_mut().enumerate() {
                    let left: f64 = rows.iter().zip(weights).map(|(row, weight)| weight * row[c]).sum();
                    *found += left * left / (squares * filters.len() as f64);
                }
            }
            found
        });
        for ((rough, p), mass) in mean_squares[0].iter().zip(p).zip(masses) {
            self.powers += rough * (p / mass).powi(2);
        }
        for (sum, found) in self.squares.iter_mut().zip(&mean_squares) {
            *sum += found.iter().sum::<f64>();
        }
        self.count += dimension as u64;
        self.gradients += gradient.iter().map(|x| x * x).sum::<f64>();
    }

    /// The mean of Σ (σ v)² of a state, where what is left is noise of each component, of its size σ; v is the
    /// velocity.
    pub(super) fn power(&self) -> f64 {
        self.powers / (self.count as f64 / self.dimension as f64)
    }

    /// Once there were as many states as it needs.
    pub(super) fn found(&self) -> Option<Smoothness> {
        let count = self.count as f64;
        let [near, far] = self.squares.map(|sum| sum / count);
        (self.count > 0).then(|| Smoothness {
            size: (self.gradients / count).sqrt(),
            differences: near.sqrt(),
            exponent: self.window.exponent((far / near).log2()),
        })
    }
}

/// How smooth U_q, or U, is along the trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothness {
    /// The root mean square of a component of U_q, or of U.
    pub size: f64,
    /// The root mean square of its differences in time, which for noise is its size in a component: of eighth
    /// differences, divided by √C(16, 8); in windows of nine states, of the coefficients of the orthogonal polynomials
    /// of degree 7 and 8.
    pub differences: f64,
    /// 0 for noise, 1 where U′ jumps, 3 where U″ does, large where the forces are smooth and the steps resolve the
    /// motion; of U, 1 where U jumps. It is log₂ of how many times as large the squares of the differences are where
    /// the distance of the states is doubled, then 16 at most; in windows of nine states it follows from the ratio of
    /// the squares of the coefficients of degree 5 and 6 to the squares of the coefficients of degree 7 and 8.
    pub exponent: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left of a polynomial of lower degree is 0, in integers.
    #[test]
    fn filters_are_orthogonal_polynomials() {
        let filters: Vec<&Filter> = NINE.iter().rev().flatten().collect();
        for (filter, degree) in filters.iter().zip(5..) {
            for power in 0..degree {
                let left: f64 = (0..9).map(|i| filter.weights[i] * (i as f64 - 4.0).powi(power)).sum();
                assert_eq!(left, 0.0, "degree {degree}, power {power}");
            }
        }
        for (i, a) in filters.iter().enumerate() {
            for b in &filters[..i] {
                assert_eq!(a.weights.iter().zip(b.weights).map(|(a, b)| a * b).sum::<f64>(), 0.0);
            }
        }
    }

    /// Forces whose p-th derivative jumps at a place that is anywhere in the window.
    #[test]
    fn the_exponent_of_nine_states_is_that_of_jumps() {
        const PLACES: usize = 20_000;
        for (p, (ratio, exponent)) in EXPONENTS.into_iter().skip(1).enumerate() {
            let mut forces = Roughness::new(Window::Nine, 1);
            for place in 0..PLACES {
                let at = 8.0 * (place as f64 + 0.5) / PLACES as f64;
                forces.begin();
                for n in 0..9 {
                    let after = (n as f64 - at).max(0.0);
                    forces.push(&[if p == 0 { f64::from(after > 0.0) } else { after.powi(p as i32) }], &[0.0], &[1.0]);
                }
            }
            let found = forces.found().unwrap().exponent;
            // the ratios have four decimals
            assert!((found - exponent).abs() < 2e-4, "p = {p}: {found}, ratio {ratio}");
        }
    }
}
