//! A Lennard-Jones fluid in a periodic box, with a cutoff of different smoothness.

use shadowstep::Potential;

/// What is done at the cutoff distance r_c.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cutoff {
    /// u(r) is set to 0 beyond r_c: u jumps.
    Truncated,
    /// u(r) − u(r_c): u' jumps.
    Shifted,
    /// u(r) − u(r_c) − (r − r_c) u'(r_c): u'' jumps.
    ForceShifted,
    /// u(r) times a polynomial that goes from 1 at 0.7 r_c to 0 at r_c: u^(8) jumps.
    Smooth,
}

/// Particles of unit mass, ε = σ = 1, in a cubic box with images; positions are not wrapped.
#[derive(Clone, Copy, Debug)]
pub struct Fluid {
    /// The number of particles.
    pub particles: usize,
    /// The side of the box.
    pub side: f64,
    /// r_c
    pub cutoff: f64,
    /// What is done there.
    pub kind: Cutoff,
}

/// u and du/dr · 1/r of plain Lennard-Jones.
fn lennard_jones(r2: f64) -> (f64, f64) {
    let s6 = (r2 * r2 * r2).recip();
    (4.0 * s6 * (s6 - 1.0), -24.0 * s6 * (2.0 * s6 - 1.0) / r2)
}

impl Fluid {
    /// u(r) and u'(r)/r.
    fn pair(&self, r2: f64) -> (f64, f64) {
        let cutoff = self.cutoff;
        if r2 >= cutoff * cutoff {
            return (0.0, 0.0);
        }
        let (u, slope) = lennard_jones(r2);
        match self.kind {
            Cutoff::Truncated => (u, slope),
            Cutoff::Shifted => (u - lennard_jones(cutoff * cutoff).0, slope),
            Cutoff::ForceShifted => {
                let (at_cutoff, slope_there) = lennard_jones(cutoff * cutoff);
                let (r, force) = (r2.sqrt(), slope_there * cutoff);
                (u - at_cutoff - (r - cutoff) * force, slope - force / r)
            }
            Cutoff::Smooth => {
                let (inner, r) = (0.7 * cutoff, r2.sqrt());
                if r <= inner {
                    return (u, slope);
                }
                let x = (r - inner) / (cutoff - inner);
                let (s, derivative) = smooth_step(x);
                (u * (1.0 - s), slope * (1.0 - s) - u * derivative / ((cutoff - inner) * r))
            }
        }
    }

    /// Calls with the bodies of each pair, their distance vector from images, u and u'/r.
    fn each_pair(&self, q: &[f64], mut with: impl FnMut(usize, usize, [f64; 3], f64, f64)) {
        let (sides, square_cutoff) = (self.side.recip(), self.cutoff * self.cutoff);
        for (i, a) in q.chunks_exact(3).enumerate() {
            for (j, b) in q.chunks_exact(3).take(i).enumerate() {
                let d: [f64; 3] = std::array::from_fn(|axis| {
                    let x = a[axis] - b[axis];
                    x - self.side * nearest_integer(x * sides)
                });
                let r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                if r2 < square_cutoff {
                    let (u, slope) = self.pair(r2);
                    with(i, j, d, u, slope);
                }
            }
        }
    }

    /// Σ r u'(r) over the pairs, by their nearest images: not qᵀU_q.
    pub fn virial(&self, q: &[f64]) -> f64 {
        let mut virial = 0.0;
        self.each_pair(q, |_, _, d, _, slope| virial += slope * d.iter().map(|d| d * d).sum::<f64>());
        virial
    }

    /// Particles on a grid with velocities that look random, of mean 0 and about temperature 1: q, p.
    pub fn start(&self) -> [Vec<f64>; 2] {
        let edge = (1..).find(|n| n * n * n >= self.particles).expect("some cube is larger");
        let spacing = self.side / edge as f64;
        let place = |i: usize| [i % edge, i / edge % edge, i / edge / edge].map(|n| n as f64 * spacing);
        let q: Vec<f64> = (0..self.particles).flat_map(place).collect();
        let mut p: Vec<f64> =
            (0..q.len()).map(|c| 1.7 * (12.9898 * (c as f64 + 1.0)).sin() * (c as f64 * 0.7).cos().signum()).collect();
        for axis in 0..3 {
            let mean = p.iter().skip(axis).step_by(3).sum::<f64>() / self.particles as f64;
            p.iter_mut().skip(axis).step_by(3).for_each(|p| *p -= mean);
        }
        [q, p]
    }
}

/// To the nearest integer for |x| < 2⁵¹: a sum whose last place is 1. Without SSE 4.1, `round` is a call.
fn nearest_integer(x: f64) -> f64 {
    const ONES: f64 = 6_755_399_441_055_744.0; // 3·2⁵¹
    x + ONES - ONES
}

/// s(0) = 0, s(1) = 1, the first seven derivatives are 0 at both ends; and s'.
fn smooth_step(x: f64) -> (f64, f64) {
    // s' = 51480 x^7 (1 − x)^7
    const COEFFICIENTS: [f64; 8] = [6435.0, -40040.0, 108_108.0, -163_800.0, 150_150.0, -83160.0, 25740.0, -3432.0];
    let polynomial = COEFFICIENTS.iter().rev().fold(0.0, |sum, c| sum * x + c);
    (polynomial * x.powi(8), 51480.0 * (x * (1.0 - x)).powi(7))
}

impl Potential<f64> for Fluid {
    fn dimension(&self) -> usize {
        3 * self.particles
    }
    fn energy(&self, q: &[f64], energy: &mut f64, _: &mut [f64]) {
        *energy = 0.0;
        self.each_pair(q, |_, _, _, u, _| *energy += u);
    }
    fn gradient(&self, q: &[f64], gradient: &mut [f64], scratch: &mut [f64]) {
        self.gradient_and_rate(q, gradient, &mut 0.0, scratch);
    }
    fn gradient_and_rate(&self, q: &[f64], gradient: &mut [f64], rate: &mut f64, _: &mut [f64]) {
        gradient.fill(0.0);
        let mut energy = 0.0;
        self.each_pair(q, |i, j, d, u, slope| {
            energy += u;
            for axis in 0..3 {
                gradient[3 * i + axis] += slope * d[axis];
                gradient[3 * j + axis] -= slope * d[axis];
            }
        });
        // not the virial of the images: positions are of the particles themselves
        *rate = q.iter().zip(gradient).map(|(q, g)| q * *g).sum::<f64>() - 2.0 * energy;
    }
}
