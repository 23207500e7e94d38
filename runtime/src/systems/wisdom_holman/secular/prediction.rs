//! What the modified Hamiltonian predicts of secular frequencies: means over both mean longitudes of two planets.

use crate::systems::wisdom_holman::{Jacobi, PlanetaryCoordinates, WisdomHolman};

/// The places on each orbit: means over them have all digits while the larger orbit is some 4/3 of the smaller one.
const PLACES: usize = 128;

/// e of the second differences: small beside 1, with squares large beside the round-off.
const SMALL: f64 = 1e-3;

/// A secular frequency of two planets by averaging.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedFrequency {
    /// g of A + B, in radians per unit of time.
    pub omega: f64,
    /// What a step adds to it.
    pub change: f64,
}

/// The frequencies of the pericentres of two planets near the plane of their first two coordinates, and what the term
/// factor · B_QᵀM′⁻¹B_Q of a modified Hamiltonian adds: first that of the mode with the larger part of the inner
/// planet.
///
/// A Wisdom–Holman map has `A + B + h²(α [A,[A,B]] + β [B,[B,A]]) + …`, and `[B,[B,A]]` is B_QᵀM′⁻¹B_Q. A change of
/// coordinates, as by a corrector, that takes `α [A,[A,B]]` out adds `−α [B,[A,B]] = α [B,[B,A]]`, so that secular
/// frequencies depend on **factor = (α + β) h²**. The leapfrog with drifts first has α = −1/24 and β = 1/12, thus
/// h²/24, with a corrector and without.
///
/// The means F of B and of the term are of second order in e, ½ Σ S_jk e_j e_k cos(ϖ_j − ϖ_k). With the actions Γ_j =
/// Λ_j e_j²/2, Λ = m′√(μa), the frequencies are the eigenvalues of −S_jk/√(Λ_jΛ_k) of B (as of Laplace and Lagrange),
/// and the change is vᵀ(…)v of the term by the eigenvectors v of B.
///
/// The errors are of second order in the masses, where near resonances have small divisors, of order e², and of the
/// next power of h. `None` unless there are two planets on elliptic orbits.
///
/// Source: C. D. Murray & S. F. Dermott, *Solar System Dynamics*, 7.1–7.3; H. Rein, G. Brown & D. Tamayo, Mon. Not. R.
/// Astron. Soc. 490 (2019) 5122.
pub fn predicted_frequencies<const D: usize>(
    system: &WisdomHolman<f64, Jacobi<f64, D>, D>,
    factor: f64,
) -> Option<[PredictedFrequency; 2]> {
    let mut means = Means::of(system)?;
    let circles = means.at([0.0, 0.0]);
    let [one, other, same, opposite] =
        [[SMALL, 0.0], [0.0, SMALL], [SMALL, SMALL], [SMALL, -SMALL]].map(|e| means.at(e));
    let [g_one, g_other] = means.actions;
    // −S_jk/√(Λ_jΛ_k) of B and of the term
    let [[a, b, c], [da, db, dc]] = [0, 1].map(|of| {
        let square = SMALL * SMALL;
        [
            -2.0 * (one[of] - circles[of]) / square / g_one,
            -(same[of] - opposite[of]) / (2.0 * square) / (g_one * g_other).sqrt(),
            -2.0 * (other[of] - circles[of]) / square / g_other,
        ]
    });
    let (sin, cos) = (f64::atan2(2.0 * b, a - c) / 2.0).sin_cos();
    let mode = |[x, y]: [f64; 2]| PredictedFrequency {
        omega: a * x * x + 2.0 * b * x * y + c * y * y,
        change: factor * (da * x * x + 2.0 * db * x * y + dc * y * y),
    };
    let modes = [mode([cos, sin]), mode([-sin, cos])];
    Some(if cos.abs() >= sin.abs() { modes } else { [modes[1], modes[0]] })
}

/// Means over the mean longitudes of two planets in a plane, with their semi-major axes.
struct Means<const D: usize> {
    coordinates: Jacobi<f64, D>,
    axes: [f64; 2],
    /// Λ
    actions: [f64; 2],
    q: Vec<f64>,
    gradient: Vec<f64>,
}

impl<const D: usize> Means<D> {
    fn of(system: &WisdomHolman<f64, Jacobi<f64, D>, D>) -> Option<Self> {
        let orbits = system.coordinates().orbits();
        if orbits.planets.len() != 2 || D < 2 {
            return None;
        }
        let axis = |planet: usize| {
            let (orbit, first) = (&orbits.planets[planet], (planet + 1) * D);
            let square = |values: &[f64]| values[first..first + D].iter().map(|x| x * x).sum::<f64>();
            let axis = (2.0 / square(system.at.state.q()).sqrt()
                - square(system.at.state.p()) / (orbit.mass * orbit.mass * orbit.parameter))
                .recip();
            (axis > 0.0).then_some(axis)
        };
        let axes = [axis(0)?, axis(1)?];
        let action =
            |planet: usize| orbits.planets[planet].mass * (orbits.planets[planet].parameter * axes[planet]).sqrt();
        Some(Means {
            coordinates: system.coordinates().clone(),
            axes,
            actions: [action(0), action(1)],
            q: vec![0.0; 3 * D],
            gradient: vec![0.0; 3 * D],
        })
    }

    /// The means of B and of B_QᵀM′⁻¹B_Q with these eccentricities; of a negative one the pericentre is opposite.
    fn at(&mut self, e: [f64; 2]) -> [f64; 2] {
        let orbits = [0, 1].map(|planet| orbit(self.axes[planet], e[planet]));
        let mut sums = [0.0; 2];
        for one in &orbits[0] {
            self.q[D..D + 2].copy_from_slice(one);
            for other in &orbits[1] {
                self.q[2 * D..2 * D + 2].copy_from_slice(other);
                let energies = self.energies();
                sums = [sums[0] + energies[0], sums[1] + energies[1]];
            }
        }
        sums.map(|sum| sum / (PLACES * PLACES) as f64)
    }

    /// B and B_QᵀM′⁻¹B_Q at Q.
    fn energies(&mut self) -> [f64; 2] {
        let mut rate = 0.0;
        self.coordinates.gradient_and_rate(&self.q, &mut self.gradient, Some(&mut rate));
        let planets = self.coordinates.orbits().planets.iter().zip(&self.gradient.as_chunks::<D>().0[1..]);
        let squares = planets.map(|(orbit, slope)| slope.iter().map(|x| x * x).sum::<f64>() / orbit.mass);
        // the rate is −3B
        [-rate / 3.0, squares.sum()]
    }
}

/// Places at equal intervals of the mean anomaly.
fn orbit(a: f64, e: f64) -> [[f64; 2]; PLACES] {
    std::array::from_fn(|n| {
        let anomaly = std::f64::consts::TAU * n as f64 / PLACES as f64;
        let mut eccentric = anomaly;
        // Newton's method, of a function of one sign beyond the first step
        for _ in 0..20 {
            let (sin, cos) = eccentric.sin_cos();
            eccentric -= (eccentric - e * sin - anomaly) / (1.0 - e * cos);
        }
        let (sin, cos) = eccentric.sin_cos();
        [a * (cos - e), a * (1.0 - e * e).sqrt() * sin]
    })
}

#[cfg(test)]
mod tests;
