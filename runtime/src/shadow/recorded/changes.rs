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
/// [`seen`] by E_7 in a step: Σ C(7, i)⁴/C(14, 7)².
const SEEN_BY_SEVEN: f64 = 2.0 * (1.0 + 2401.0 + 194_481.0 + 1_500_625.0) / (3432.0 * 3432.0);
/// From one estimate to the next that has but one state in common with it.
const LAG: usize = 8;
/// The standard deviation of a normal distribution as a multiple of the median size.
const NORMAL: f64 = 1.482_602_218_505_602;
/// A change is a jump if it is larger than the usual ones by this factor.
const JUMP: f64 = 6.0;

/// Estimates E_8 without errors, of all states that have one: n and the value.
#[derive(Clone, Debug, Default)]
pub(super) struct Changes {
    values: Vec<(i64, f64)>,
    /// Σ of squares of the changes of E_7 in a step, and their number.
    of_seven: (f64, u64),
}

/// A sudden change of the modified energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// n of the state after it; with windows of one estimate each, of the middle of the first window after it.
    pub n: i64,
    /// What the energy changed by.
    pub energy: f64,
}

impl Changes {
    pub(super) fn push(&mut self, n: i64, value: f64) {
        self.values.push((n, value));
    }

    /// Takes what E_7 changes by from one state to the next, where windows have one E_8.
    pub(super) fn push_seven(&mut self, change: f64) {
        self.of_seven = (self.of_seven.0 + change * change, self.of_seven.1 + 1);
    }

    /// E(n + lag) − E(n) with the n, of states without a gap between them.
    fn after(&self, lag: usize) -> impl Iterator<Item = (i64, f64)> {
        let pairs = self.values.iter().zip(self.values.iter().skip(lag));
        let lag = lag as i64;
        pairs.filter(move |((n, _), (later, _))| later - n == lag).map(|((n, before), (_, after))| (*n, after - before))
    }

    /// Whether windows have one estimate each, so that changes are those from one to the next.
    fn is_of_single_estimates(&self) -> bool {
        self.after(1).next().is_none()
    }

    /// Changes from one window to the next: n of the later one, the steps between their estimates, and the change.
    fn between(&self) -> impl Iterator<Item = (i64, u64, f64)> {
        let pairs = self.values.windows(2).map(|both| (both[0], both[1]));
        let changes = pairs.map(|((n, before), (later, after))| (later, later.abs_diff(n), after - before));
        changes.filter(|(_, steps, _)| *steps >= LAG as u64)
    }

    /// Changes from state to state, or from window to window where these have one estimate each; the latter are reduced
    /// to one step as if they added up like noise.
    fn sizes(&self) -> Vec<f64> {
        match self.is_of_single_estimates() {
            true => self.between().map(|(_, steps, change)| change.abs() / seen(steps).sqrt()).collect(),
            false => self.after(1).map(|(_, change)| change.abs()).collect(),
        }
    }

    /// The mean square of what H̄ changes by in a step, if what it does in one step and in another is independent.
    pub(super) fn square_in_a_step(&self) -> f64 {
        let (mut sum, mut count) = (0.0, 0_u64);
        let mut add = |change: f64, steps: u64| {
            sum += change * change / seen(steps);
            count += 1;
        };
        match self.after(LAG).next() {
            None => self.between().for_each(|(_, steps, change)| add(change, steps)),
            Some(_) => self.after(LAG).for_each(|(_, change)| add(change, LAG as u64)),
        }
        sum / count as f64
    }

    /// The mean square of what H̄ changes by over eight steps, or from window to window, divided by that over one step,
    /// each reduced to one step as if what it does in one step and in another were independent: 1 if it is.
    pub(super) fn growth(&self) -> f64 {
        let in_one = if self.is_of_single_estimates() {
            self.of_seven.0 / self.of_seven.1 as f64 / SEEN_BY_SEVEN
        } else {
            let (sum, count) =
                self.after(1).fold((0.0, 0_u64), |(sum, count), (_, change)| (sum + change * change, count + 1));
            sum / count as f64 / seen(1)
        };
        self.square_in_a_step() / in_one
    }

    /// The standard deviation of what one estimate has and the next ones, of other states, have not: what does not add
    /// up, as errors of stored states do not. 0 where all that H̄ changes by adds up.
    pub(super) fn scatter(&self) -> f64 {
        let mut apart: Vec<(i64, f64)> = Vec::new();
        for &(n, value) in &self.values {
            if apart.last().is_none_or(|(last, _)| n - last > i64::from(K)) {
                apart.push((n, value));
            }
        }
        let mean_square = |lag: usize| {
            let changes = apart.iter().zip(apart.iter().skip(lag)).map(|((_, before), (_, after))| after - before);
            changes.map(|change| change * change).sum::<f64>() / apart.len().saturating_sub(lag) as f64
        };
        // over `lag` of them a random walk of variance w and scatter of variance s make lag·w + 2s
        let lag = 8;
        let scatter = (lag as f64 * mean_square(1) - mean_square(lag)) / (2.0 * (lag as f64 - 1.0));
        scatter.max(0.0).sqrt()
    }

    /// The rms of changes from state to state as a multiple of what it would be with a normal distribution of the same
    /// median: 1 for noise, large where H̄ changes at few states only.
    pub(super) fn isolation(&self) -> f64 {
        let sizes = self.sizes();
        let rms = (sizes.iter().map(|size| size * size).sum::<f64>() / sizes.len() as f64).sqrt();
        rms / (NORMAL * median(sizes))
    }

    /// Sudden changes, the largest first. At the ends of a window, where a change may be the beginning of a larger one,
    /// there are none; nor in windows of one estimate each, but from one to the next.
    pub(super) fn jumps(&self) -> Vec<Jump> {
        let usual = NORMAL * median(self.sizes());
        if self.is_of_single_estimates() {
            let is_sudden = |(_, steps, change): &(i64, u64, f64)| change.abs() > JUMP * usual * seen(*steps).sqrt();
            let sudden = self.between().filter(is_sudden).map(|(n, _, energy)| Jump { n, energy });
            let mut jumps: Vec<Jump> = sudden.collect();
            jumps.sort_by(|a, b| b.energy.abs().total_cmp(&a.energy.abs()));
            return jumps;
        }
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

/// Σ over all places of a jump of 1 of the square of what is seen of it in E(n + lag) − E(n).
fn seen(lag: u64) -> f64 {
    // beyond 9 states all of a jump is seen at each place more
    let (lag, more) = (lag.min(9) as isize, lag.saturating_sub(9) as f64);
    // of a jump between the states t − 1 and t before the newest
    let part = |t: isize| MEAN.iter().take(t.clamp(0, 9) as usize).sum::<f64>();
    more + (-lag..=9).map(|t| (part(t + lag) - part(t)).powi(2)).sum::<f64>()
}

/// NaN of nothing.
pub(super) fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}
