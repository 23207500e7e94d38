//! The gradients of the potentials, written by hand.

use crate::initial::Initial;

/// gradient ← U_q
pub type Gradient = fn(&Initial, &[f64], &mut [f64]);

pub fn kepler(_: &Initial, q: &[f64], g: &mut [f64]) {
    let r2 = q[0] * q[0] + q[1] * q[1];
    let inverse_cube = 1.0 / (r2 * r2.sqrt());
    g[0] = q[0] * inverse_cube;
    g[1] = q[1] * inverse_cube;
}

pub fn henon_heiles(_: &Initial, q: &[f64], g: &mut [f64]) {
    g[0] = q[0] + 2.0 * q[0] * q[1];
    g[1] = q[1] + q[0] * q[0] - q[1] * q[1];
}

pub fn outer(initial: &Initial, q: &[f64], g: &mut [f64]) {
    g.fill(0.0);
    for i in 0..6 {
        for j in i + 1..6 {
            let d = [0, 1, 2].map(|axis| q[3 * j + axis] - q[3 * i + axis]);
            let r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            let slope = initial.parameters[0] * initial.masses[3 * i] * initial.masses[3 * j] / (r2 * r2.sqrt());
            for axis in 0..3 {
                g[3 * i + axis] -= slope * d[axis];
                g[3 * j + axis] += slope * d[axis];
            }
        }
    }
}

pub fn fput(initial: &Initial, q: &[f64], g: &mut [f64]) {
    let spring = |d: f64| d + initial.parameters[0] * d * d;
    let mut left = spring(q[0]);
    for i in 0..q.len() {
        let right = spring(q.get(i + 1).copied().unwrap_or(0.0) - q[i]);
        g[i] = left - right;
        left = right;
    }
}
