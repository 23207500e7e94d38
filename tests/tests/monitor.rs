//! Protects the monitor of the modified energy: it changes no bit and costs nothing between its windows; its values
//! equal a run's; its numbers against closed forms; its verdicts on problems, hard cases and wrong forces, and on runs
//! that were held out; its errors and words.

mod correct_loops;
mod forces;
mod loops;
mod matrix;
mod values;
mod verdicts;
mod words;

use rug::Float;
use shadowstep::number::counting::{Counting, count};
use shadowstep::problems::{Gravity, HarmonicOscillator, HenonHeiles, Kepler, Pendulum, ProblemMotion, problem};
use shadowstep::shadow::run::{Quantity, RunError, ShadowRun};
use shadowstep::shadow::{
    Bilinear, BuildEstimator, Central, Criterion, Missing, Report, ShadowEnergy, StoppingRule, Trend, Verdict,
};
use shadowstep::systems::pairs::Pairs;
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{DiagonalMasses, Motion, Potential, Real, Stepper, UnitMasses, kinetic, potential};
use shadowstep_tests::{Bits, log10_distance, number, numbers, precision, same_bits, stepper, watched};

type Start<N, P> = Motion<N, Vec<N>, P, UnitMasses>;

fn henon_heiles<N: Real>(context: &N::Context) -> Start<N, HenonHeiles> {
    Motion::new(HenonHeiles, UnitMasses, numbers(&["0.1", "-0.3"], context), numbers(&["0.2", "0.1"], context)).unwrap()
}

/// A shipped problem with a window in 20 steps, by E_8 and its error.
fn watch(name: &str, set: &[(&str, &str)], scheme: &str, h: &str, steps: u64) -> Report<f64> {
    watch_by(&Bilinear::with_error(8), name, set, scheme, h, steps)
}

fn watch_by(settings: &Bilinear, name: &str, set: &[(&str, &str)], scheme: &str, h: &str, steps: u64) -> Report<f64> {
    let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let mut motion: ProblemMotion<f64> = problem(name).unwrap().setup(&set, 30).unwrap().motion(&()).unwrap();
    watched(stepper(scheme, h, &()), &mut motion, settings, 20, steps)
}

const BOUNDED: Verdict = Verdict::Bounded;
const ENERGY_ERROR: Verdict = Verdict::TooLarge(Criterion::EnergyError);

/// Steps of the size h, which `step` makes, watched by a monitor with a stepper of the size `monitored`; `step` gets
/// whether the monitor needs increments.
fn watch_loop<N: Real, P: Potential<N>>(
    mut motion: Start<N, P>,
    (h, monitored): (&str, &str),
    steps: u64,
    mut step: impl FnMut(&Stepper<TableScheme, N>, &mut Start<N, P>, bool),
) -> Report<N> {
    let [stepper, of_monitor] = [h, monitored].map(|h| stepper("stormer-verlet", h, &motion.context()));
    let mut monitor = ShadowEnergy::new(of_monitor, &mut motion, &Bilinear::with_error(8)).unwrap().every(20);
    for _ in 0..steps {
        step(&stepper, &mut motion, monitor.needs_increments());
        monitor.observe(&mut motion).unwrap();
    }
    monitor.report()
}

/// With increments where the monitor needs them.
fn as_needed<N: Real, P: Potential<N>>(
    stepper: &Stepper<TableScheme, N>,
    motion: &mut Start<N, P>,
    needs_increments: bool,
) {
    if needs_increments { stepper.step_augmented(motion) } else { stepper.step(motion) }
}

const TWENTIETH: (&str, &str) = ("1/20", "1/20");
