//! Protects the modified energy of recorded trajectories: of one of ours it equals the run's own, of an oscillator the
//! theoretical value; and logs that cannot be used are refused.

mod cases;
mod causes;
mod input;
mod input_faults;
mod values;
mod verdicts;

use shadowstep::shadow::recorded::{Log, Recorded};
use shadowstep::shadow::run::{ShadowRun, States};
use shadowstep::shadow::{Bilinear, Estimator};
use shadowstep::{Motion, Potential, StepSize, UnitMasses};
use shadowstep_tests::lennard_jones::{Cutoff, Fluid};
use shadowstep_tests::{step_size, stepper};

/// What a program logs: of the states 0 to `steps`, one after the other.
struct Logged {
    dimension: usize,
    q: Vec<f64>,
    p: Vec<f64>,
    energies: Vec<f64>,
    gradients: Vec<f64>,
    rates: Vec<f64>,
}

impl Logged {
    /// Steps of velocity Verlet, written here.
    fn new<P: Potential<f64>>(potential: &P, masses: &[f64], h: f64, start: [Vec<f64>; 2], steps: usize) -> Self {
        let dimension = masses.len();
        let [mut q, mut p] = start;
        let mut logged = Logged { dimension, q: vec![], p: vec![], energies: vec![], gradients: vec![], rates: vec![] };
        let (mut gradient, mut rate, mut energy) = (vec![0.0; dimension], 0.0, 0.0);
        let mut scratch = vec![0.0; potential.scratch()];
        potential.prepare(&mut scratch, &());
        for n in 0..=steps {
            if n > 0 {
                (0..dimension).for_each(|i| p[i] -= h / 2.0 * gradient[i]);
                (0..dimension).for_each(|i| q[i] += h * (p[i] / masses[i]));
            }
            potential.gradient_and_rate(&q, &mut gradient, &mut rate, &mut scratch);
            potential.energy(&q, &mut energy, &mut scratch);
            if n > 0 {
                (0..dimension).for_each(|i| p[i] -= h / 2.0 * gradient[i]);
            }
            logged.q.extend(&q);
            logged.p.extend(&p);
            logged.gradients.extend(&gradient);
            logged.energies.push(energy);
            logged.rates.push(rate);
        }
        logged
    }

    fn log(&self) -> Log<'_> {
        Log::with_gradients(self.dimension, [&self.q, &self.p, &self.gradients], &self.energies).unwrap()
    }
}

/// 27 particles whose forces are smooth.
fn fluid() -> Fluid {
    Fluid { particles: 27, side: 5.1, cutoff: 2.5, kind: Cutoff::Smooth }
}

/// n and H̄ of all states that have one.
fn values<T: States<Number = f64>, E: Estimator<f64>>(mut run: ShadowRun<T, E>) -> Vec<(i64, f64)> {
    let mut all = Vec::new();
    while let Some((n, found)) = run.advance().unwrap() {
        all.push((n, *found.value));
    }
    all
}

fn values_of(log: Log<'_>, h: &StepSize, masses: &[f64], settings: &Bilinear) -> Vec<(i64, f64)> {
    values(Recorded::new(log, h, masses).unwrap().estimates(h, settings).unwrap())
}
