//! How the modified energy changes from state to state.

/// The k of E_k, of which the changes are.
pub(super) const K: u32 = 8;
/// C(8, i)²/C(16, 8): E_8 is the mean of H̄ over nine states with these weights.
const MEAN: [f64; 9] = {
    const SQUARES: [f64; 9] = [1.0, 64.0, 784.0, 3136.0, 4900.0, 3136.0, 784.0, 64.0, 1.0];
    let mut mean = [0.0; 9];
    let mut i = 0;
    while i < 9 {
        mean[i] = SQUARES[i] / 12870.0;
        i += 1;
    }
    mean
};
/// From one estimate to the next that has but one state in common with it.
const LAG: usize = 8;
/// The standard deviation of a normal distribution as a multiple of the median size.
const NORMAL: f64 = 1.482_602_218_505_602;
/// A jump is a change of the size of so many usual ones.
const JUMP: f64 = 6.0;

/// Estimates E_8 without errors, of all states that have one: n and the value.
#[derive(Clone, Debug, Default)]
pub(super) struct Changes {
    values: Vec<(i64, f64)>,
}

/// A sudden change of the modified energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// n of the state after it.
    pub n: i64,
    /// What the energy changed by.
    pub energy: f64,
}

impl Changes {
    pub(super) fn push(&mut self, n: i64, value: f64) {
        self.values.push((n, value));
    }

    /// E(n + lag) − E(n) with the n, of states without a gap between them.
    fn after(&self, lag: usize) -> impl Iterator<Item = (i64, f64)> {
        let pairs = self.values.iter().zip(self.values.iter().skip(lag));
        let lag = lag as i64;
        pairs.filter(move |((n, _), (later, _))| later - n == lag).map(|((n, before), (_, after))| (*n, after - before))
    }

    /// The mean square of what H̄ changes by in a step, if what it does in one step and in another is independent.
    pub(super) fn square_in_a_step(&self) -> f64 {
        let (mut sum, mut count) = (0.0, 0_u64);
        for (_, change) in self.after(LAG) {
            sum += change * change;
            count += 1;
        }
        sum / count as f64 / seen()
    }

    /// The rms of changes from state to state as a multiple of what it would be with a normal distribution of the same median: 1 for noise,
    /// large where H̄ changes at few states only.
    pub(super) fn isolation(&self) -> f64 {
        let sizes: Vec<f64> = self.after(1).map(|(_, change)| change.abs()).collect();
        let rms = (sizes.iter().map(|size| size * size).sum::<f64>() / sizes.len() as f64).sqrt();
        rms / (NORMAL * median(sizes))
    }

    /// Sudden changes, the largest first. At the ends of a window, where a change may be the beginning of a larger one, there are none.
    pub(super) fn jumps(&self) -> Vec<Jump> {
        let usual = NORMAL * median(self.after(1).map(|(_, change)| change.abs()).collect());
        let mut largest: Vec<(i64, f64)> = self.after(1).filter(|(_, change)| change.abs() > JUMP * usual).collect();
        largest.sort_by(|(_, a), (_, b)| b.abs().total_cmp(&a.abs()));
        let mut jumps: Vec<Jump> = Vec::new();
        for (n, _) in largest {
            if jumps.iter().all(|jump| (jump.n - n - 1).abs() > LAG as i64) {
                let across = self.value(n + 4).zip(self.value(n - 3)).map(|(after, before)| after - before);
                jumps.extend(across.map(|energy| Jump { n: n + 1, energy }));
            }
        }
        jumps
    }

    fn value(&self, n: i64) -> Option<f64> {
        let place = self.values.binary_search_by_key(&n, |(n, _)| *n).ok()?;
        Some(self.values[place].1)
    }
}

/// Σ over all places of a jump of 1 of the square of what is seen of it in E(n + 8) − E(n).
fn seen() -> f64 {
    // of a jump between the states t − 1 and t before the newest
    let part = |t: isize| MEAN.iter().take(t.clamp(0, 9) as usize).sum::<f64>();
    let lag = LAG as isize;
    (-lag..=9).map(|t| (part(t + lag) - part(t)).powi(2)).sum()
}

/// NaN of nothing.
pub(super) fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}
