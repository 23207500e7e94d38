//! Protects the monitor of the modified energy: it changes no bit and costs nothing between its windows; its values are those of
//! a run; its numbers against closed forms; its verdicts on problems and hard cases; its errors and words.

mod loops;
mod values;
mod verdicts;
mod words;

use rug::Float;
use shadowstep::number::counting::{Counting, count};
use shadowstep::problems::{HarmonicOscillator, HenonHeiles, Kepler, Pendulum, ProblemMotion, problem};
use shadowstep::run::{RunError, ShadowRun};
use shadowstep::shadow::{Bilinear, Central, Course, Method, Report, ShadowEnergy, Sign, Stop, Verdict};
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Motion, Number, Potential, Scheme, UnitMasses, Weights, kinetic, potential};
use shadowstep_tests::{Bits, log10_distance, number, numbers, precision, rational, same_bits};

type Start<N, P> = Motion<N, Vec<N>, P, UnitMasses>;

fn henon_heiles<N: Number>(context: &N::Context) -> Start<N, HenonHeiles> {
    Motion::new(HenonHeiles, UnitMasses, numbers(&["0.1", "-0.3"], context), numbers(&["0.2", "0.1"], context))
}

fn scheme(name: &str) -> TableScheme {
    shipped(name).unwrap()
}

/// A shipped problem with a window in 20 steps, by E_8 and its error.
fn watch(name: &str, set: &[(&str, &str)], scheme: &str, h: &str, steps: u64) -> Report<f64> {
    watch_by(&Bilinear::with_error(8), name, set, scheme, h, steps)
}

fn watch_by(
    method: &Bilinear,
    name: &str,
    set: &[(&str, &str)],
    scheme_name: &str,
    h: &str,
    steps: u64,
) -> Report<f64> {
    let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let mut motion: ProblemMotion<f64> = problem(name).unwrap().setup(&set, 30).unwrap().motion(&()).unwrap();
    let (scheme, h) = (scheme(scheme_name), rational(h));
    let mut monitor = ShadowEnergy::new(&mut motion, &h, method).unwrap().every(20);
    let weights = scheme.weights::<f64>(&h, &());
    for _ in 0..steps {
        monitor.step(&scheme, &weights, &mut motion).unwrap();
    }
    monitor.report()
}

const FINE: Verdict = Verdict::Fine;
const MOVES: Verdict = Verdict::TooLarge(Sign::Moved);
const ENERGY_ERROR: Verdict = Verdict::TooLarge(Sign::EnergyError);

/// Steps of the size h, watched by a monitor that was told `told`; each step is made by `step`, which is told whether β is needed.
fn watch_loop<N: Number, P: Potential<N>>(
    mut motion: Start<N, P>,
    (h, told): (&str, &str),
    steps: u64,
    mut step: impl FnMut(&TableScheme, &Weights<Vec<N>>, &mut Start<N, P>, bool),
) -> Report<N> {
    let (context, scheme) = (motion.context(), scheme("stormer-verlet"));
    let mut monitor = ShadowEnergy::new(&mut motion, &rational(told), &Bilinear::with_error(8)).unwrap().every(20);
    let weights = scheme.weights::<N>(&rational(h), &context);
    for _ in 0..steps {
        step(&scheme, &weights, &mut motion, monitor.needs_beta());
        monitor.observe(&mut motion).unwrap();
    }
    monitor.report()
}

/// As the monitor asks.
fn as_asked<N: Number, P: Potential<N>>(
    scheme: &TableScheme,
    weights: &Weights<Vec<N>>,
    motion: &mut Start<N, P>,
    needs_beta: bool,
) {
    if needs_beta { scheme.step_augmented(weights, motion) } else { scheme.step(weights, motion) }
}

const TWENTIETH: (&str, &str) = ("1/20", "1/20");
