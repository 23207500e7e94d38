//! Secular frequencies: how fast the pericentres of planets turn.
//!
//! In the mean over the revolutions e exp(iϖ) of a planet is a sum of terms z exp(iωt) with the slow frequencies g_1,
//! g_2, … of the system. The largest of them is found by frequency analysis: the ω at which |∫ z(t) exp(−iωt) w(t) dt|
//! is largest, w being a power of Hann's window (Laskar, Icarus 88 (1990) 266). Of a system that is regular its error
//! falls with a high power of the time.
//!
//! Conjugate maps have the same frequencies, so that those of a processed scheme are the frequencies of its kernel. Of
//! two planets the modified Hamiltonian [predicts](predicted_frequencies) how wrong they are.

mod prediction;

pub use prediction::{PredictedFrequency, predicted_frequencies};

use super::{Jacobi, PlanetaryCoordinates, WisdomHolman};
use crate::number::Real;

/// e cos ϖ and e sin ϖ of a planet: in three dimensions e times the first two components of the direction of the
/// pericentre.
type Eccentricity = [f64; 2];

/// e exp(iϖ) of each planet on its Kepler orbit in Jacobi coordinates: of the vector v × (Q × v)/μ − Q/|Q| with v =
/// P/m.
pub fn eccentricities<N: Real, const D: usize>(system: &WisdomHolman<N, Jacobi<N, D>, D>) -> Vec<Eccentricity> {
    let numbers = |values: &[N]| values.iter().map(Real::to_f64).collect::<Vec<_>>();
    let (q, p) = (numbers(system.at.state.q()), numbers(system.at.state.p()));
    let planets = system.coordinates().orbits().planets.iter();
    let states = q.as_chunks::<D>().0.iter().zip(p.as_chunks::<D>().0).skip(1);
    let of_planet = |(orbit, (q, p)): (&super::orbits::Orbit<N>, (&[f64; D], &[f64; D]))| {
        let (mass, mu) = (orbit.mass.to_f64(), orbit.parameter.to_f64());
        let v = p.map(|p| p / mass);
        let dot = |a: &[f64; D], b: &[f64; D]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (along, across) = (dot(&v, &v) / mu - 1.0 / dot(q, q).sqrt(), dot(q, &v) / mu);
        [along * q[0] - across * v[0], along * q[1] - across * v[1]]
    };
    planets.zip(states).map(of_planet).collect()
}

/// A frequency found in samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequency {
    /// ω, in radians per unit of time.
    pub omega: f64,
    /// The largest difference of the frequencies of both halves of the samples from it: mostly far more than its error,
    /// which falls with the length.
    pub uncertainty: f64,
}

/// The frequency of the largest term of samples at equal intervals of time, among those of at most `largest` in size.
///
/// ```
/// use shadowstep::systems::wisdom_holman::secular::main_frequency;
///
/// let sample = |n: i32| {
///     let t = f64::from(n);
///     [0.05 * (0.003 * t).cos() + 0.02 * (0.02 * t + 1.0).cos(), 0.05 * (0.003 * t).sin() + 0.02 * (0.02 * t + 1.0).sin()]
/// };
/// let found = main_frequency(&(0..20_000).map(sample).collect::<Vec<_>>(), 1.0, 0.1);
/// assert!((found.omega - 0.003).abs() < 1e-9 && found.uncertainty < 1e-7);
/// ```
///
/// # Panics
/// With fewer than 16 samples.
pub fn main_frequency(samples: &[Eccentricity], interval: f64, largest: f64) -> Frequency {
    assert!(samples.len() >= 16, "a frequency needs 16 samples or more, not {}", samples.len());
    let omega = strongest(samples, interval, largest);
    let halves = samples.split_at(samples.len() / 2);
    let [first, second] = [halves.0, halves.1].map(|half| strongest(half, interval, largest));
    Frequency { omega, uncertainty: (first - omega).abs().max((second - omega).abs()) }
}

/// The ω at which the spectrum is largest: the best of a grid finer than its lines, and then the middle of shrinking
/// intervals.
fn strongest(samples: &[Eccentricity], interval: f64, largest: f64) -> f64 {
    let width = std::f64::consts::TAU / (samples.len() as f64 * interval);
    let reach = (largest / width).ceil() as i64 * 2;
    let size = |omega: f64| spectrum(samples, interval * omega);
    let best = (-reach..=reach).map(|n| n as f64 * width / 2.0).max_by(|a, b| size(*a).total_cmp(&size(*b)));
    let middle = best.expect("there are frequencies");
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high) = (middle - width / 2.0, middle + width / 2.0);
    let mut inner = [high - golden * (high - low), low + golden * (high - low)];
    let mut sizes = inner.map(size);
    // a maximum is known to the square root of the round-off, relative to the width of its line
    while high - low > 1e-9 * width {
        if sizes[0] > sizes[1] {
            (high, inner[1], sizes[1]) = (inner[1], inner[0], sizes[0]);
            inner[0] = high - golden * (high - low);
            sizes[0] = size(inner[0]);
        } else {
            (low, inner[0], sizes[0]) = (inner[0], inner[1], sizes[1]);
            inner[1] = low + golden * (high - low);
            sizes[1] = size(inner[1]);
        }
    }
    (low + high) / 2.0
}

/// |Σ z_n exp(−i n angle) w_n|², w the square of Hann's window.
fn spectrum(samples: &[Eccentricity], angle: f64) -> f64 {
    let (mut real, mut imaginary) = (0.0, 0.0);
    let count = samples.len() as f64;
    for (n, [x, y]) in samples.iter().enumerate() {
        let hann = 1.0 - (std::f64::consts::TAU * (n as f64 + 0.5) / count).cos();
        let (sin, cos) = (angle * n as f64).sin_cos();
        real += hann * hann * (x * cos + y * sin);
        imaginary += hann * hann * (y * cos - x * sin);
    }
    real * real + imaginary * imaginary
}
