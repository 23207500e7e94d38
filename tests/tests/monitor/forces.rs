//! Findings about forces: not smooth, not the gradient of the energy, a rate that is not qᵀU_q − 2U.

use super::*;
use shadowstep::shadow::Rough;
use shadowstep::systems::potential::from_fn;
use shadowstep_tests::lennard_jones::{Cutoff, Fluid};

/// 27 particles, 1200 steps, with a window in 20.
fn watch_fluid(kind: Cutoff, scheme: &str, h: &str, k: u32) -> Report<f64> {
    let fluid = Fluid { particles: 27, side: 5.1, cutoff: 2.5, kind };
    let [q, p] = fluid.start();
    let mut motion = Motion::new(fluid, UnitMasses, q, p).unwrap();
    watched(stepper(scheme, h, &()), &mut motion, &Bilinear::with_error(k), 20, 1200)
}

/// A step that is small enough is never too large, whatever the order of the scheme: it is the forces that limit it.
#[test]
fn a_cutoff_is_found() {
    for kind in [Cutoff::Shifted, Cutoff::ForceShifted] {
        for (scheme, h) in [("yoshida4", "0.002"), ("blanes-moan-srkn6b", "0.002")] {
            for k in [8, 16] {
                let report = watch_fluid(kind, scheme, h, k);
                let jumps = if kind == Cutoff::Shifted { 1 } else { 2 };
                let found = report.rough.is_some_and(|Rough { least, most }| (least..=most).contains(&jumps));
                assert!(found, "{kind:?}, {scheme}, k = {k}: {report}");
                let is_bounded_or_forces = report.verdict.is_bounded() || report.verdict == Verdict::NotSmooth;
                assert!(is_bounded_or_forces, "{kind:?}, {scheme}, k = {k}: {report}");
                assert!(report.to_string().contains("schemes gain up to order"), "{report}");
            }
        }
    }
    // windows too short to tell leave it undecided
    let short = watch_fluid(Cutoff::ForceShifted, "blanes-moan-s6", "0.004", 6);
    assert!(!matches!(short.verdict, Verdict::TooLarge(_)), "{short}");
    let smooth = watch_fluid(Cutoff::Smooth, "blanes-moan-srkn6b", "0.003", 8);
    assert_eq!((smooth.rough, smooth.verdict), (None, BOUNDED), "{smooth}");
}

/// Forces that are 1 % too large, of a potential that is not homogeneous.
#[test]
fn a_wrong_force_is_found() {
    let watch_with = |factor: f64| {
        let wrong = from_fn(2, move |q, gradient| {
            gradient[0] = factor * (q[0] + 2.0 * q[0] * q[1]);
            gradient[1] = factor * (q[1] + q[0] * q[0] - q[1] * q[1]);
            (q[0] * q[0] + q[1] * q[1]) / 2.0 + q[0] * q[0] * q[1] - q[1].powi(3) / 3.0
        });
        let motion = Motion::new(wrong, UnitMasses, vec![0.1, -0.3], vec![0.2, 0.1]).unwrap();
        watch_loop::<f64, _>(motion, TWENTIETH, 20_000, as_needed)
    };
    let report = watch_with(1.01);
    assert_eq!(report.verdict, Verdict::NotTheGradient, "{report}");
    assert!(report.reason().contains("check_potential"), "{report}");
    assert_eq!(watch_with(1.0).verdict, BOUNDED);
}

/// qᵀU_q by the distances of nearest images.
#[test]
fn a_virial_of_images_is_found() {
    struct Virial(Fluid);
    impl Potential<f64> for Virial {
        fn dimension(&self) -> usize {
            self.0.dimension()
        }
        fn energy(&self, q: &[f64], energy: &mut f64, scratch: &mut [f64]) {
            self.0.energy(q, energy, scratch);
        }
        fn gradient_and_rate(&self, q: &[f64], gradient: &mut [f64], rate: &mut f64, scratch: &mut [f64]) {
            self.0.gradient(q, gradient, scratch);
            *rate = self.0.virial(q);
            let mut energy = 0.0;
            self.0.energy(q, &mut energy, scratch);
            *rate -= 2.0 * energy;
        }
        fn gradient(&self, q: &[f64], gradient: &mut [f64], scratch: &mut [f64]) {
            self.0.gradient(q, gradient, scratch);
        }
    }
    let fluid = Fluid { particles: 27, side: 5.1, cutoff: 2.5, kind: Cutoff::Smooth };
    let [q, p] = fluid.start();
    let mut motion = Motion::new(Virial(fluid), UnitMasses, q, p).unwrap();
    let verlet = stepper("stormer-verlet", "0.004", &());
    let report = watched(verlet, &mut motion, &Bilinear::with_error(8), 20, 1200);
    assert_eq!(report.verdict, Verdict::Inconsistent, "{report}");
    assert!(report.reason().contains("check_potential"), "{report}");
}
