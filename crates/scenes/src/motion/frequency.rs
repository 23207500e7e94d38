//! The fastest oscillation of a system, linearised at its initial state: the frequency ω of M^{-1/2} U_qq M^{-1/2}.

use std::time::Duration;

use shadowstep::Potential;

use crate::run::cpu_time::CpuTime;
use crate::scene::{KineticEnergy, PotentialEnergy, System};

/// ω, the largest frequency of the linearised system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequency {
    /// ω: its square is the largest eigenvalue.
    pub omega: f64,
    /// Whether U is a quadratic form, so that ω holds for all times and states.
    pub quadratic: bool,
}

/// More iterations than these make no difference that matters for a warning.
const MOST_ITERATIONS: usize = 200;
/// The CPU time that they may take, which other work on the machine does not change: a run is not to wait for what it
/// is warned of.
const MOST_TIME: Duration = Duration::from_millis(100);
/// The estimates of the eigenvalue agree to this part at the end.
const TOLERANCE: f64 = 1e-7;
/// The distance of the gradients whose difference is taken, as a part of the largest coordinate.
const DISTANCE: f64 = 1e-6;

impl System {
    /// The largest frequency at the initial state, in double precision, from differences of the gradient by the power
    /// method; `None` where nothing oscillates, T(p) is given by a formula or is not a part, the initial energy is not
    /// finite, or numbers overflow.
    ///
    /// An eigenvalue that the iterations do not reach in 0.1 s of CPU time, as where a gradient of thousands of bodies
    /// takes long, is underestimated.
    pub fn fastest_frequency(&self) -> Option<Frequency> {
        self.fastest_motion().filter(|_| self.parts.is_kinetic_and_potential())
    }

    /// The same whatever the parts of H are: the frequency of T(p) + U(q). Steps resolve it where they do not solve the
    /// fastest motion exactly.
    pub fn fastest_motion(&self) -> Option<Frequency> {
        if !matches!(self.kinetic, KineticEnergy::Masses(_)) || matches!(self.potential, PotentialEnergy::OfParts) {
            return None;
        }
        let (q, p) = self.problem.initial::<f64>(&());
        if !self.problem.plain_energy::<f64>(&())(&q, &p).is_finite() {
            return None;
        }
        let number = |mass: &shadowstep::Rational| <f64 as shadowstep::Number>::from_rational(mass, &());
        let mut roots: Vec<f64> = self.exact_masses().iter().map(|mass| number(mass).sqrt()).collect();
        // t passes as it does, as a body of infinite mass
        roots.resize(q.len(), f64::INFINITY);
        let mut hessian = Hessian::new(self.potential::<f64>(&()), q, roots);
        let largest = hessian.eigenvalue(0.0)?;
        // shifted by the eigenvalue of largest size, all are positive, and the largest one is the largest in size
        let squared = if largest > 0.0 { largest } else { hessian.eigenvalue(-largest * 1.01)? };
        (squared > 0.0).then(|| Frequency { omega: squared.sqrt(), quadratic: self.is_quadratic() })
    }

    /// Whether U is known to be a quadratic form.
    fn is_quadratic(&self) -> bool {
        match &self.potential {
            PotentialEnergy::Shipped(setup) => setup.problem.name() == "harmonic-oscillator",
            PotentialEnergy::Formula(formula) => formula.meaning().is_quadratic(),
            PotentialEnergy::Pairs(_) | PotentialEnergy::Own(_) | PotentialEnergy::OfParts => false,
        }
    }
}

/// M^{-1/2} U_qq M^{-1/2} at a state.
struct Hessian {
    potential: Box<dyn Potential<f64>>,
    q: Vec<f64>,
    /// √m of each coordinate.
    roots: Vec<f64>,
    scratch: Vec<f64>,
    distance: f64,
}

impl Hessian {
    fn new(potential: Box<dyn Potential<f64>>, q: Vec<f64>, roots: Vec<f64>) -> Self {
        let mut scratch = vec![0.0; potential.scratch()];
        potential.prepare(&mut scratch, &());
        let size = q.iter().fold(0.0_f64, |size, q| size.max(q.abs()));
        let distance = DISTANCE * if size > 0.0 { size } else { 1.0 };
        Hessian { potential, q, roots, scratch, distance }
    }

    fn gradient(&mut self, v: &[f64], factor: f64) -> Vec<f64> {
        let q: Vec<f64> = self.q.iter().zip(v).map(|(q, v)| q + factor * v).collect();
        let mut gradient = vec![0.0; q.len()];
        self.potential.update(&q);
        self.potential.gradient(&q, &mut gradient, &mut self.scratch);
        gradient
    }

    /// The product with a vector.
    fn times(&mut self, v: &[f64]) -> Vec<f64> {
        let mut direction: Vec<f64> = v.iter().zip(&self.roots).map(|(v, root)| v / root).collect();
        let length = norm(&direction);
        direction.iter_mut().for_each(|d| *d /= length);
        let [ahead, behind] = [self.distance, -self.distance].map(|factor| self.gradient(&direction, factor));
        let slope = length / (2.0 * self.distance);
        let differences = ahead.iter().zip(&behind).map(|(ahead, behind)| (ahead - behind) * slope);
        differences.zip(&self.roots).map(|(difference, root)| difference / root).collect()
    }

    /// The eigenvalue of largest size of the matrix plus a multiple of 1, less that multiple.
    fn eigenvalue(&mut self, shift: f64) -> Option<f64> {
        // no symmetry of a problem has this direction
        let mut v: Vec<f64> = (1..=self.q.len()).map(|i| (i as f64 * 0.754_877_666).fract() - 0.5 + 1e-3).collect();
        let mut last = f64::NAN;
        let start = CpuTime::begin();
        for _ in 0..MOST_ITERATIONS {
            let length = norm(&v);
            v.iter_mut().for_each(|v| *v /= length);
            let image: Vec<f64> = self.times(&v).iter().zip(&v).map(|(image, v)| image + shift * v).collect();
            // Rayleigh's quotient
            let value: f64 = image.iter().zip(&v).map(|(image, v)| image * v).sum();
            if !value.is_finite() || norm(&image) == 0.0 {
                return None;
            }
            if (value - last).abs() <= TOLERANCE * value.abs() {
                return Some(value - shift);
            }
            (last, v) = (value, image);
            if start.elapsed() > MOST_TIME {
                break;
            }
        }
        Some(last - shift)
    }
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::arithmetic::Arithmetic;
    use shadowstep::tables::Source;

    fn frequency(problem: &str) -> Option<Frequency> {
        let source = Source { path: "test.toml".to_owned(), text: problem.to_owned() };
        System::read(&source, Arithmetic::DOUBLE).unwrap().0.fastest_frequency()
    }

    #[test]
    fn springs_have_their_frequencies() {
        // two masses and three springs: ω² = 1/m and 3/m
        let text = "[problem]\npotential = \"(x^2 + (x - y)^2 + y^2)/2\"\ncoordinates = [\"x\", \"y\"]\nmasses = [4, 4]\n\
                    [initial]\nq = [1, 2]\np = [0, 0]\n";
        let found = frequency(text).unwrap();
        assert!(found.quadratic && (found.omega - 0.75_f64.sqrt()).abs() < 1e-6, "{found:?}");
        let oscillator = frequency("[problem]\nname = \"harmonic-oscillator\"\nparameters = { omega = 3 }").unwrap();
        assert!(oscillator.quadratic && (oscillator.omega - 3.0).abs() < 1e-6, "{oscillator:?}");
    }

    #[test]
    fn only_directions_in_which_the_potential_curves_upwards_oscillate() {
        // at the pericentre r = 2/5: −2/r³ along the radius, 1/r³ across it
        let kepler = frequency("[problem]\nname = \"kepler\"").unwrap();
        assert!(!kepler.quadratic && (kepler.omega - 0.4_f64.powf(-1.5)).abs() < 1e-5, "{kepler:?}");
        let hill = "[problem]\npotential = \"-x^2\"\ncoordinates = [\"x\"]\n[initial]\nq = [1]\np = [0]\n";
        assert_eq!(frequency(hill), None);
    }
}
