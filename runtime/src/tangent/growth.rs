//! How a tangent vector grows: the largest Lyapunov exponent, MEGNO, and what they decide.

use std::fmt;

/// log |δ| of a tangent vector along a trajectory, and what follows from it.
///
/// With L(t) = log(|δ(t)|/|δ(0)|):
///
/// - the finite-time Lyapunov exponent is L(t)/t. G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15
///   (1980) 9;
/// - MEGNO is Y(t) = (2/t) ∫₀ᵗ L′(s) s ds, and its mean Ȳ(t) = (1/t) ∫₀ᵗ Y(s) ds. Along a quasiperiodic trajectory
///   vectors grow like t, and both tend to 2 (to 0 where all frequencies are constant, as vectors do not grow); along a
///   chaotic one Y grows like λt and Ȳ like λt/2. P. M. Cincotta, C. Simó, Astron. Astrophys. Suppl. 147 (2000) 205; P.
///   M. Cincotta, C. M. Giordano, C. Simó, Physica D 182 (2003) 151.
///
/// Integrals are sums by the midpoint rule over the intervals between observations.
#[derive(Clone, Debug)]
pub struct Growth {
    initial: f64,
    time: f64,
    logarithm: f64,
    /// ∫ L′ s ds
    weighted: f64,
    /// ∫ Y ds
    integral: f64,
    marks: Marks,
}

/// Whether a trajectory is chaotic, as far as it was followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regularity {
    /// Vectors grow no faster than on a quasiperiodic trajectory. Slower chaos than a run shows is always possible.
    Regular,
    /// Vectors grow exponentially, at all times.
    Chaotic,
    /// The run is too short, or ends in another kind of motion than it begins with.
    Undecided,
}

impl fmt::Display for Regularity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Regularity::Regular => "regular",
            Regularity::Chaotic => "chaotic",
            Regularity::Undecided => "undecided",
        })
    }
}

/// A Lyapunov exponent with its error.
///
/// The error is half the width of an interval that is meant to have the exponent of the limit t → ∞ in it with a
/// probability of 90 to 95 %. It is the largest one of three, Student's intervals of 95 % by the means over 6, 4 and 3
/// parts of the trajectory: motion that stays long near regular orbits makes short parts alike, and their scatter too
/// small. Where parts are independent the probability is 99 %; along orbits that stay near regular ones for a time as
/// long as the run it is smaller, as the run does not show it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent {
    /// λ
    pub value: f64,
    /// Its error.
    pub error: f64,
}

/// Into how many parts the last three quarters are divided, with the quantile of 97.5 % of Student's distribution of a
/// degree of freedom less.
const PARTS: [(usize, f64); 3] = [(6, 2.570_58), (4, 3.182_45), (3, 4.302_65)];

/// Up to this mean MEGNO a trajectory is regular: the mean of regular ones tends to 2 or, without shear, to 0.
const REGULAR: f64 = 2.5;

/// From this mean of Y over a half of the run on it may be chaotic: growth by a power of t would be t⁴.
const CHAOTIC: f64 = 8.0;

/// By at least this factor Y is larger in the second half of a chaotic run than in its second quarter. Y ∝ t would have
/// 2; growth by a power of t has 1.
const STEADY: f64 = 1.4;

impl Growth {
    /// Of a vector with this log |δ| at t = 0.
    pub fn new(logarithm: f64) -> Self {
        Growth { initial: logarithm, time: 0.0, logarithm: 0.0, weighted: 0.0, integral: 0.0, marks: Marks::default() }
    }

    /// log |δ(0)|, t, L, ∫ L′ s ds and ∫ Y ds: what a run needs to be resumed.
    pub fn parts(&self) -> [f64; 5] {
        [self.initial, self.time, self.logarithm, self.weighted, self.integral]
    }

    /// Growth with these [`parts`](Growth::parts), that goes on. The [exponent](Growth::exponent) with its error and
    /// the [regularity](Growth::regularity) need observations of the whole trajectory, which it has not.
    pub fn of_parts([initial, time, logarithm, weighted, integral]: [f64; 5]) -> Self {
        Growth { initial, time, logarithm, weighted, integral, marks: Marks::default() }
    }

    /// The vector has this log |δ| at |t|, later than before.
    pub fn observe(&mut self, time: f64, logarithm: f64) {
        let grown = logarithm - self.initial;
        let (interval, middle) = (time - self.time, (time + self.time) / 2.0);
        let before = self.megno();
        self.weighted += (grown - self.logarithm) * middle;
        (self.time, self.logarithm) = (time, grown);
        self.integral += interval * (before + self.megno()) / 2.0;
        self.marks.push([time, grown, self.integral]);
    }

    /// How long the trajectory was followed.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// L = log(|δ(t)|/|δ(0)|).
    pub fn logarithm(&self) -> f64 {
        self.logarithm
    }

    /// The finite-time Lyapunov exponent L(t)/t; `None` at t = 0.
    pub fn lyapunov(&self) -> Option<f64> {
        (self.time > 0.0).then(|| self.logarithm / self.time)
    }

    /// MEGNO, Y; 0 at t = 0.
    pub fn megno(&self) -> f64 {
        if self.time == 0.0 { 0.0 } else { 2.0 * self.weighted / self.time }
    }

    /// The mean of MEGNO, Ȳ; `None` at t = 0.
    pub fn mean_megno(&self) -> Option<f64> {
        (self.time > 0.0).then(|| self.integral / self.time)
    }

    /// The error of Ȳ as that of its limit: |Ȳ(t) − Ȳ(t/2)|, which is what is left of c/t; half of Ȳ and more along a
    /// chaotic trajectory, where it has no limit. `None` of fewer than 64 observations.
    pub fn mean_megno_error(&self) -> Option<f64> {
        let [time, _, integral] = self.marks.near(self.time / 2.0)?;
        Some((self.mean_megno()? - integral / time).abs())
    }

    /// The exponent over the last three quarters of the trajectory, where vectors have turned to the direction that
    /// grows fastest, with its error from parts of them; `None` of fewer than 64 observations.
    pub fn exponent(&self) -> Option<Exponent> {
        let at: Vec<_> = (4..=16).map(|i| self.marks.near(self.time * f64::from(i) / 16.0)).collect::<Option<_>>()?;
        let rates = |parts: usize| -> Vec<f64> {
            let ends: Vec<_> = at.iter().step_by(12 / parts).collect();
            ends.windows(2).map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).collect()
        };
        let mean = |rates: &[f64]| rates.iter().sum::<f64>() / rates.len() as f64;
        let error = |(parts, student): (usize, f64)| {
            let rates = rates(parts);
            let value = mean(&rates);
            let variance = rates.iter().map(|rate| (rate - value).powi(2)).sum::<f64>() / (parts - 1) as f64;
            student * (variance / parts as f64).sqrt()
        };
        Some(Exponent { value: mean(&rates(PARTS[0].0)), error: PARTS.into_iter().map(error).fold(0.0, f64::max) })
    }

    /// Whether the motion is regular or chaotic, as far as the trajectory shows it.
    ///
    /// Y₂ is the mean of Y over the second quarter of the trajectory, Y₃₄ that over its second half. Regular: −½ ≤
    /// Y₃₄ ≤ 2.5 and Y₂ ≤ 2.5. Chaotic: Y₃₄ ≥ 8 and Y₃₄ ≥ 1.4 Y₂, so that vectors grow faster than t⁴, and their growth
    /// does not slow down.
    pub fn regularity(&self) -> Regularity {
        let marks = [0.25, 0.5, 1.0].map(|part| self.marks.near(self.time * part));
        let [Some(quarter), Some(half), Some(end)] = marks else { return Regularity::Undecided };
        let mean = |from: [f64; 3], to: [f64; 3]| (to[2] - from[2]) / (to[0] - from[0]);
        let (earlier, later) = (mean(quarter, half), mean(half, end));
        if later >= CHAOTIC && later >= STEADY * earlier {
            Regularity::Chaotic
        } else if (-0.5..=REGULAR).contains(&later) && earlier <= REGULAR {
            Regularity::Regular
        } else {
            Regularity::Undecided
        }
    }
}

/// Up to 256 observations of (t, L, ∫Y) at nearly equal distances, whatever their number.
#[derive(Clone, Debug, Default)]
struct Marks {
    kept: Vec<[f64; 3]>,
    /// Every 2ⁿth observation is kept.
    every: u32,
    seen: u64,
    last: Option<[f64; 3]>,
}

impl Marks {
    const MOST: usize = 256;
    const LEAST: usize = 64;

    fn push(&mut self, mark: [f64; 3]) {
        self.last = Some(mark);
        self.seen += 1;
        if !self.seen.is_multiple_of(1 << self.every) {
            return;
        }
        self.kept.push(mark);
        if self.kept.len() == Self::MOST {
            let mut number = 0_usize;
            self.kept.retain(|_| {
                number += 1;
                number.is_multiple_of(2)
            });
            self.every += 1;
        }
    }

    /// The observation that is nearest in time; `None` of fewer than 64.
    fn near(&self, time: f64) -> Option<[f64; 3]> {
        let enough = self.kept.len() >= Self::LEAST;
        let distance = |mark: &[f64; 3]| (mark[0] - time).abs();
        let nearest = self.kept.iter().chain(&self.last).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.copied().filter(|_| enough)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The growth L(t) = f(t), of 0 at t = 0.
    fn growth(until: f64, steps: u32, f: impl Fn(f64) -> f64) -> Growth {
        let mut growth = Growth::new(1.5);
        for n in 1..=steps {
            let t = until * f64::from(n) / f64::from(steps);
            growth.observe(t, 1.5 + f(t));
        }
        growth
    }

    #[test]
    fn exponential_growth() {
        let found = growth(100.0, 10_000, |t| 0.3 * t);
        assert!((found.lyapunov().unwrap() - 0.3).abs() < 1e-12);
        assert!((found.megno() - 30.0).abs() < 1e-9); // λt
        assert!((found.mean_megno().unwrap() - 15.0).abs() < 1e-3); // λt/2
        assert!((found.mean_megno_error().unwrap() - 7.5).abs() < 0.1);
        let exponent = found.exponent().unwrap();
        assert!((exponent.value - 0.3).abs() < 1e-9 && exponent.error < 1e-9);
        assert_eq!(found.regularity(), Regularity::Chaotic);
    }

    /// |δ|² = 1 + t² of a sheared flow: Y = 2 − 2 arctan(t)/t.
    #[test]
    fn linear_growth() {
        let found = growth(1000.0, 100_000, |t| (1.0 + t * t).ln() / 2.0);
        assert!((found.megno() - (2.0 - 2.0 * 1000_f64.atan() / 1000.0)).abs() < 1e-4);
        assert!((found.mean_megno().unwrap() - 2.0).abs() < 0.05);
        let error = found.mean_megno_error().unwrap();
        assert!((found.mean_megno().unwrap() - 2.0).abs() < 2.0 * error && error < 0.05, "{error}");
        assert_eq!(found.regularity(), Regularity::Regular);
        let exponent = found.exponent().unwrap();
        assert!(exponent.value.abs() < 0.005);
    }

    #[test]
    fn what_is_between_is_undecided() {
        assert_eq!(growth(100.0, 10_000, |t| 0.04 * t).regularity(), Regularity::Undecided); // too short
        assert_eq!(growth(100.0, 10_000, |t| 4.0 * (1.0 + t * t).ln()).regularity(), Regularity::Undecided); // a power of t
        let ended = |t: f64| if t < 40.0 { 0.5 * t } else { 20.0 };
        assert_eq!(growth(100.0, 10_000, ended).regularity(), Regularity::Undecided);
        assert_eq!(growth(100.0, 63, |t| 0.3 * t).regularity(), Regularity::Undecided); // too few
        assert_eq!(growth(100.0, 10_000, |t| t.sin()).regularity(), Regularity::Regular); // no shear
        assert!(growth(100.0, 10, |t| t).exponent().is_none() && growth(100.0, 10, |t| t).mean_megno_error().is_none());
    }

    /// Of 1000 series of rates 1 + noise, how many have 1 within the error: `memory` is the correlation of two rates
    /// beside one another.
    fn coverage(memory: f64) -> f64 {
        let mut seed = 1_u64;
        // of the variance 1
        let mut noise = || {
            let uniform = |_| {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (seed >> 11) as f64 / (1_u64 << 53) as f64
            };
            (0..12).map(uniform).sum::<f64>() - 6.0
        };
        let covers = (0..1000).filter(|_| {
            let (mut growth, mut rate, mut logarithm) = (Growth::new(0.0), noise(), 0.0);
            for n in 1..=1024_u32 {
                rate = memory * rate + (1.0 - memory * memory).sqrt() * noise();
                logarithm += 1.0 + rate;
                growth.observe(f64::from(n), logarithm);
            }
            let Exponent { value, error } = growth.exponent().unwrap();
            (value - 1.0).abs() <= error
        });
        covers.count() as f64 / 1000.0
    }

    /// With a memory of 0.99 rates are alike over 100 of the 768 observations from which the exponent follows. Twice
    /// the standard error of six parts had coverages of 0.90 and 0.73.
    #[test]
    fn errors_cover_the_exponent() {
        for (memory, least) in [(0.0, 0.97), (0.99, 0.92)] {
            let found = coverage(memory);
            assert!(found >= least, "{memory}: {found}");
        }
    }

    #[test]
    fn nothing_is_known_at_first() {
        let found = Growth::new(0.0);
        assert_eq!(
            (found.lyapunov(), found.mean_megno(), found.mean_megno_error(), found.exponent()),
            (None, None, None, None)
        );
    }

    #[test]
    fn observations_are_kept_at_equal_distances() {
        let found = growth(1.0, 100_000, |t| t);
        assert!(found.marks.kept.len() < Marks::MOST);
        for part in [0.25, 0.5, 1.0] {
            assert!((found.marks.near(part).unwrap()[0] - part).abs() < 1.0 / 64.0);
        }
    }
}
