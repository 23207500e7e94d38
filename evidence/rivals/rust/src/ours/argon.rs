//! 500 argon atoms in free space: 5×5×5 cells of the face-centred cubic crystal, with the units, mass and Lennard-Jones
//! potential of the shipped problem argon-crystal (nanometres, nanoseconds, kilograms).

use crate::initial::Initial;

const CELLS: usize = 5;
const MASS: f64 = 66.34e-27;
const BOLTZMANN: f64 = 1.380658e-23;
const EPSILON: f64 = 119.8 * BOLTZMANN;
const SIGMA: f64 = 0.341;
/// In kelvin, at the start; half of it goes into the potential energy.
const TEMPERATURE: f64 = 60.0;

/// The crystal at rest distance, with velocities that are distributed evenly and have no mean.
pub fn initial() -> Initial {
    let cell = 2f64.powf(1.0 / 6.0) * SIGMA * 2f64.sqrt();
    let corners = [[0.0, 0.0, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]];
    let range = 0..CELLS.pow(3);
    let cells = range.map(|n| [n / CELLS / CELLS, n / CELLS % CELLS, n % CELLS].map(|n| n as f64));
    let atoms = cells.flat_map(|[x, y, z]| corners.map(|[a, b, c]| [x + a, y + b, z + c]));
    let q: Vec<f64> = atoms.flatten().map(|coordinate| cell * coordinate).collect();
    Initial { parameters: vec![EPSILON, SIGMA], masses: vec![MASS; q.len()], p: momenta(q.len()), q }
}

/// Even distributions of the variance m k_B T in each coordinate, by a linear congruential generator.
fn momenta(count: usize) -> Vec<f64> {
    let mut state = 1_u64;
    let mut even = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    // in nanometres per nanosecond a metre per second is 1, so that no factor is needed
    let width = (12.0 * MASS * BOLTZMANN * TEMPERATURE).sqrt();
    let mut p: Vec<f64> = (0..count).map(|_| width * even()).collect();
    for axis in 0..3 {
        let mean = p.iter().skip(axis).step_by(3).sum::<f64>() / (count / 3) as f64;
        p.iter_mut().skip(axis).step_by(3).for_each(|p| *p -= mean);
    }
    p
}
