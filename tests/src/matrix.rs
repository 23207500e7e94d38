//! The runs on which the monitor's verdicts are calibrated, and others on which they are tested.
//!
//! A matrix is made of scenes, schemes and steps. The thresholds of the verdicts were chosen with the
//! [calibration](Matrix::calibration) matrix only; the [held-out](Matrix::held_out) one has other scenes, schemes and
//! steps.

use shadowstep::problems::{ProblemMotion, problem};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Kinetic, Motion, Potential, Scheme, Stepper, UnitMasses};

use crate::lennard_jones::{Cutoff, Fluid};

/// Scenes, schemes and steps.
pub struct Matrix {
    /// The systems.
    pub scenes: Vec<Scene>,
    /// Names of shipped schemes.
    pub schemes: &'static [&'static str],
    /// Steps h, as parts of the scene's limit for each stage of the scheme.
    pub parts: &'static [f64],
}

/// A system with its initial state.
pub struct Scene {
    /// Its name.
    pub name: String,
    /// About the largest stable step of Störmer–Verlet.
    pub limit: f64,
    /// The steps of a run.
    pub steps: u64,
    /// Whether its forces are smooth.
    pub smooth: bool,
    start: Box<dyn Fn() -> ProblemMotion<f64>>,
}

impl Scene {
    /// The system at its initial state.
    pub fn motion(&self) -> ProblemMotion<f64> {
        (self.start)()
    }
}

impl Matrix {
    /// The one with which the thresholds were chosen: all orders that are shipped.
    pub fn calibration() -> Matrix {
        let mut scenes = vec![
            shipped_problem("harmonic-oscillator", &[], 2.0),
            shipped_problem("pendulum", &[("p", "1")], 2.0),
            shipped_problem("pendulum", &[("p", "2.5")], 1.0),
            shipped_problem("henon-heiles", &[("px", "0.1")], 2.0),
            shipped_problem("henon-heiles", &[("px", "0.5"), ("py", "0.2")], 2.0),
            shipped_problem("fput-alpha", &[], 1.0),
            shipped_problem("fput-stiff", &[], 0.04),
            shipped_problem("outer-solar-system", &[], 1379.0),
            shipped_problem("argon-crystal", &[], 1.9e-4),
        ];
        scenes.extend(["0", "0.3", "0.6", "0.9"].map(kepler));
        scenes.extend(
            [Cutoff::Smooth, Cutoff::ForceShifted, Cutoff::Shifted, Cutoff::Truncated].map(|kind| fluid(kind, 32)),
        );
        Matrix {
            scenes,
            schemes: &[
                "symplectic-euler",
                "stormer-verlet",
                "ruth3",
                "yoshida4",
                "blanes-moan-s6",
                "blanes-moan-srkn6b",
                "mclachlan-atela5",
                "blanes-moan-srkn11b",
                "yoshida6-a",
                "kahan-li8",
                "bce-rkn8-17",
                "hairer10-33",
            ],
            parts: &[1.0 / 64.0, 1.0 / 16.0, 1.0 / 8.0, 0.25, 0.375, 0.5, 0.75, 1.1],
        }
    }

    /// Other ones, for the test.
    pub fn held_out() -> Matrix {
        let mut scenes = vec![
            shipped_problem("pendulum", &[("p", "1.7")], 2.0),
            shipped_problem("henon-heiles", &[("px", "0.3"), ("py", "0.05")], 2.0),
            shipped_problem("henon-heiles", &[("px", "0.35"), ("py", "0.35")], 2.0),
            shipped_problem("figure-eight", &[], 0.4),
            shipped_problem("fput-stiff", &[("omega", "20")], 0.1),
            shipped_problem("fput-alpha", &[("alpha", "0.1")], 1.0),
        ];
        scenes.extend(["0.15", "0.45", "0.75"].map(kepler));
        scenes.extend([Cutoff::Smooth, Cutoff::ForceShifted, Cutoff::Shifted].map(|kind| fluid(kind, 27)));
        Matrix {
            scenes,
            schemes: &[
                "mclachlan-s2",
                "mclachlan-atela3",
                "suzuki4",
                "pefrl",
                "mclachlan-atela4",
                "kahan-li6",
                "blanes-moan-srkn14a",
                "sofroniou-spaletta8-21",
                "sofroniou-spaletta10-35",
            ],
            parts: &[0.03, 0.09, 0.18, 0.3, 0.45, 0.9],
        }
    }
}

fn shipped_problem(name: &'static str, set: &[(&str, &str)], limit: f64) -> Scene {
    let set: Vec<(String, String)> = set.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
    let label = set.iter().fold(name.to_owned(), |label, (key, value)| format!("{label} {key}={value}"));
    let setup = problem(name).expect("it is shipped").setup(&set, 30).expect("it has these parameters");
    let start = move || setup.motion(&()).expect("its masses are positive");
    Scene { name: label, limit, steps: 20_000, smooth: true, start: Box::new(start) }
}

/// Kepler's problem: the limit follows from the frequency at the pericentre.
fn kepler(e: &'static str) -> Scene {
    let x: f64 = e.parse().expect("a number");
    shipped_problem("kepler", &[("eccentricity", e)], 2.0 * (1.0 - x).powf(1.5) / (1.0 + x).sqrt())
}

fn fluid(kind: Cutoff, particles: usize) -> Scene {
    let start = move || {
        let fluid = Fluid { particles, side: 5.2, cutoff: 2.5, kind };
        let [q, p] = fluid.start();
        let potential: Box<dyn Potential<f64>> = Box::new(fluid);
        let kinetic: Box<dyn Kinetic<f64, Class = Quadratic>> = Box::new(UnitMasses);
        Motion::new(potential, kinetic, q, p).expect("the dimensions agree")
    };
    let name = format!("{particles} particles, {kind:?} cutoff");
    Scene { name, limit: 0.04, steps: 4000, smooth: kind == Cutoff::Smooth, start: Box::new(start) }
}

/// A stepper of a shipped scheme whose step is a part of the limit for each evaluation of the gradient, to five digits.
pub fn stepper(scheme: &str, limit: f64, part: f64) -> Stepper<TableScheme, f64> {
    let scheme = shipped(scheme).expect("it is shipped");
    let h = limit * part * scheme.summary().evaluations as f64;
    let h: f64 = format!("{h:.4e}").parse().expect("a number");
    Stepper::new(scheme, h).expect("h is not 0")
}
