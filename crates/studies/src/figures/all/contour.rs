//! The contour of the proof of lemma 3: around the states, within the domain of analyticity.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::figures::prelude::*;

/// A point of the contour about −mh, …, mh at the distance ρ, h = 1: straight above and below, half circles at the
/// ends.
fn contour(m: f64, rho: f64, part: f64) -> (f64, f64) {
    let (straight, half) = (2.0 * m, PI * rho);
    let way = part * 2.0 * (straight + half);
    let around = |centre: f64, angle: f64| (centre + rho * angle.cos(), rho * angle.sin());
    match way {
        way if way < straight => (m - way, rho),
        way if way < straight + half => around(-m, FRAC_PI_2 + (way - straight) / rho),
        way if way < 2.0 * straight + half => (way - straight - half - m, -rho),
        way => around(m, -FRAC_PI_2 + (way - 2.0 * straight - half) / rho),
    }
}

/// log|K_m(z)| with K_m = (m!)² / (z² (z² − 1) ⋯ (z² − m²)), h = 1.
fn log_kernel(m: u32, (x, y): (f64, f64)) -> f64 {
    let to = |j: f64| 0.5 * ((x - j).powi(2) + y * y).ln();
    let factors = (1..=m).map(f64::from).map(|j| 2.0 * j.ln() - to(j) - to(-j));
    factors.sum::<f64>() - 2.0 * to(0.0)
}

/// By how much, in log₁₀, the largest |K_m| on the contour is above |K_m(iρ)|.
fn excess(m: u32, rho: f64) -> f64 {
    let points = (0..4000).map(|i| contour(f64::from(m), rho, f64::from(i) / 4000.0));
    let largest = points.map(|z| log_kernel(m, z)).fold(f64::NEG_INFINITY, f64::max);
    (largest - log_kernel(m, (0.0, rho))) / std::f64::consts::LN_10
}

pub(super) fn draw(d: &mut Drawing<'_>) {
    let (m, rho) = (4.0, 1.6);
    let around = (0..=400).map(|i| contour(m, rho, f64::from(i) / 400.0)).collect();
    let states = (-4..=4).map(|j| (f64::from(j), 0.0)).collect();
    let curves = vec![
        Curve::thick("γ", around, 1),
        Curve::dots("states −mh, …, mh", states, 0, Marker::Dot),
        Curve::dots("±iρ", vec![(0.0, rho), (0.0, -rho)], 2, Marker::Cross),
    ];
    d.chart("contour", curves);
    let (orders, distances) = ([2_u32, 5, 10, 20, 50, 100, 200], [0.5, 1.0, 2.0, 5.0, 10.0, 20.0]);
    let all = || orders.into_iter().flat_map(|m| distances.map(|rho| (m, rho)));
    let found = all().map(|(m, rho)| excess(m, rho)).fold(f64::NEG_INFINITY, f64::max);
    d.check(
        "Along γ the kernel has its maximum in modulus at z = iρ.",
        format!(
            "at 4000 points of γ, for {} pairs of m = {} to {} and ρ/h = {} to {}, the largest |K_m| is at most {:.6} \
                times |K_m(iρ)|",
            all().count(),
            orders[0],
            orders[orders.len() - 1],
            distances[0],
            distances[distances.len() - 1],
            10_f64.powf(found)
        ),
        found < 1e-9,
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For m = 1: |K_1(iρ)| = 1/(ρ² (1 + ρ²)); the contour is closed and at the distance ρ from the states.
    #[test]
    fn kernel_and_contour_by_hand() {
        let rho = 1.5_f64;
        assert!((log_kernel(1, (0.0, rho)) + (rho.powi(2) * (1.0 + rho.powi(2))).ln()).abs() < 1e-14);
        for part in 0..100 {
            let (x, y) = contour(3.0, rho, f64::from(part) / 100.0);
            let outside = (x.abs() - 3.0).max(0.0);
            assert!((outside.hypot(y) - rho).abs() < 1e-12, "{x} {y}");
        }
        let ends = [contour(3.0, rho, 0.0), contour(3.0, rho, 1.0)];
        assert!((ends[0].0 - ends[1].0).hypot(ends[0].1 - ends[1].1) < 1e-12, "{ends:?}");
    }
}
