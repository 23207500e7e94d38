//! Time reversal: steps forth and back.

use serde::{Deserialize, Serialize};
use shadowstep::number::CorrectlyRounded;
use shadowstep::problems::Kepler;
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::tables::TableScheme;
use shadowstep::{Carried, Motion, Rational, Scheme, Stepper, UnitMasses};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::Begin;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::{Case, MOST_CURVES};
use crate::integrator::{start, step_size, steps_of};
use crate::suite::Suite;
use crate::systems::shipped;

/// The case.
pub(super) struct Reversal;

/// A scheme on a problem, with steps of 1/`inverse` for each force evaluation.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    problem: &'static str,
    inverse: u32,
    /// In f64 with q and p in fixed point.
    fixed_point: bool,
    /// Numbers of steps forth, the largest one last.
    steps: Vec<u64>,
}

/// Distances |Δ(q, p)| in units of the last place of 1, ε.
#[derive(Serialize, Deserialize)]
pub(super) struct Back {
    /// From the start after n steps and n inverse steps, for each n.
    to_start: Vec<f64>,
    /// Between n inverse steps and n steps of −h, both after n steps, for a short run.
    to_negative: f64,
}

/// Steps of −h are compared after this number of steps.
const SHORT: u64 = 1000;
/// Each step changes the actions of a regular motion by a few ε, which drives its phases apart like n^{3/2}: a step
/// of 17 evaluations on an eccentric orbit makes 1.3 times that.
const FACTOR: f64 = 10.0;
/// Palindromic schemes of several orders, and two that are not palindromic.
const SCHEMES: [&str; 6] =
    ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b", "kahan-li8", "ruth3", "symplectic-euler"];

impl Trial {
    fn longest(&self) -> u64 {
        *self.steps.last().expect("there are some")
    }
}

impl Case for Reversal {
    const NAME: &'static str = "reversal";
    const TITLE: &'static str = "Time reversal";
    const THEORY: &'static str = "The inverse of a step undoes it up to round-off, which drives the phase of a \
        regular motion by less than 10 n^{3/2} ε in n steps forth and back. For a palindromic scheme the step of −h \
        is the inverse, bit for bit; for others it is another map. In fixed point the inverse undoes each step to the \
        last bit.";
    const REVISION: u32 = 3;

    type Trial = Trial;
    type Measured = Back;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let steps: Vec<u64> = (2..=suite.full_or_quick(6, 4)).map(|decade| 10_u64.pow(decade)).collect();
        let schemes = suite.schemes_or(&SCHEMES);
        let trials = schemes.iter().flat_map(|scheme| {
            [("kepler", 200), ("henon-heiles", 40)].map(|(problem, inverse)| Trial {
                scheme: scheme.identity.clone(),
                problem,
                inverse,
                fixed_point: false,
                steps: steps.clone(),
            })
        });
        let most = suite.full_or_quick(10_000_000, 10_000);
        let fixed = schemes.iter().map(|scheme| Trial {
            scheme: scheme.identity.clone(),
            problem: "kepler",
            inverse: 200,
            fixed_point: true,
            // the same number of evaluations, to a factor of a few
            steps: vec![if scheme.scheme.scheme.summary().evaluations > 3 { most / 10 } else { most }],
        });
        trials.chain(fixed).collect()
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        2.2 * trial.longest() as f64 * suite.scheme(&trial.scheme).scheme.summary().evaluations as f64 * 20e-9
    }

    fn measure(suite: &Suite, trial: &Trial, arithmetic: Arithmetic, continues: Continues<'_>) -> Result<Back, Error> {
        let scheme = suite.scheme(&trial.scheme);
        Ok(match trial.fixed_point {
            true => in_fixed_point(&scheme.quadratic(), trial, continues),
            false => arithmetic.compute(Forth { scheme, trial, continues }),
        })
    }

    fn judge(suite: &Suite, measured: &[(Trial, Back)]) -> Finding {
        let mut finding = Finding::default();
        for (trial, back) in measured {
            let named = suite.scheme(&trial.scheme);
            if trial.fixed_point {
                let same = back.to_start[0] == 0.0;
                let end = if same {
                    "the same bits".to_owned()
                } else {
                    format!("{:.1e} ε from the start", back.to_start[0])
                };
                let found = format!("{} in fixed point, {} steps: {end}", trial.problem, trial.longest());
                finding.check(&named.name, found, same);
                continue;
            }
            let (steps, to_start) = (trial.longest() as f64, *back.to_start.last().expect("there are some"));
            let symmetric = named.scheme.summary().symmetric;
            let same = back.to_negative == 0.0;
            let found = format!(
                "{}, {} steps: {:.1e} ε from the start, {:.1e} n^{{3/2}} ε; −h is {}",
                trial.problem,
                trial.longest(),
                to_start,
                to_start / steps.powf(1.5),
                if same { "the inverse, bit for bit" } else { "another map" },
            );
            let verdict = Verdict::from(to_start <= FACTOR * steps.powf(1.5) && same == symmetric);
            finding.check(&named.name, found, verdict);
        }
        let curve = |(i, (trial, back)): (usize, &(Trial, Back))| {
            let points = trial.steps.iter().zip(&back.to_start).filter(|(_, to_start)| **to_start > 0.0);
            let points = points.map(|(n, to_start)| ((*n as f64).log10(), to_start.log10())).collect();
            Curve::marked(format!("{}, {}", suite.scheme(&trial.scheme).name, trial.problem), points, i)
        };
        let (x, y) = (Axis::log10("steps forth, and as many back"), Axis::log10("distance from the start in ε"));
        let curves =
            measured.iter().filter(|(trial, _)| !trial.fixed_point).take(MOST_CURVES).enumerate().map(curve).collect();
        finding.chart(Chart::new("Forth and back", x, y, curves), "Round-off in units of the last place of 1.");
        finding
    }
}

/// Steps forth and back.
struct Forth<'a> {
    scheme: &'a NamedScheme,
    trial: &'a Trial,
    continues: Continues<'a>,
}

impl Computation for Forth<'_> {
    type Output = Back;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Back {
        let Forth { scheme, trial, continues } = self;
        let h = Rational::new(scheme.scheme.summary().evaluations.into(), trial.inverse.into());
        let [h, minus_h] = [h.clone(), -h].map(step_size);
        let system = shipped(trial.problem, &[]);
        let [mut forth, mut negative] =
            [&h, &minus_h].map(|h| start::<N>(&system, steps_of(scheme, h, Begin::Step), context));
        let begin = state(&*forth);
        forth.steps(SHORT);
        set(&mut *negative, &state(&*forth));
        negative.steps(SHORT);
        steps_back(&mut *forth, SHORT);
        let to_negative = distance(&state(&*forth), &state(&*negative));

        let mut to_start = Vec::new();
        for count in &trial.steps {
            set(&mut *forth, &begin);
            forth.steps(*count);
            if continues(0.5) {
                steps_back(&mut *forth, *count);
            }
            to_start.push(distance(&begin, &state(&*forth)));
        }
        Back { to_start, to_negative }
    }
}

fn state<N: RunNumber>(integrator: &VectorIntegrator<'_, N>) -> Vec<N> {
    [integrator.state().q(), integrator.state().p()].concat()
}

fn set<N: RunNumber>(integrator: &mut VectorIntegrator<'_, N>, state: &[N]) {
    let (q, p) = state.split_at(state.len() / 2);
    integrator.system().state_mut().set(q, p);
}

fn steps_back<N: RunNumber>(integrator: &mut VectorIntegrator<'_, N>, count: u64) {
    (0..count).for_each(|_| integrator.step_back(Carried::Nothing));
}

/// Ranges of |q| and |p| that no orbit of Kepler's problem with e = 0.6 leaves.
const RANGES: [[f64; 2]; 2] = [[4.0; 2], [8.0; 2]];

fn in_fixed_point(scheme: &TableScheme, trial: &Trial, continues: Continues<'_>) -> Back {
    let h = Rational::new(scheme.summary().evaluations.into(), trial.inverse.into());
    let stepper = Stepper::new(scheme.clone(), &h).expect("it is positive");
    let start = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).expect("two coordinates");
    let mut motion = start.fixed_point(&RANGES[0], &RANGES[1]).expect("the ranges hold the orbit");
    let begin = [motion.q(), motion.p()].concat();
    let count = trial.longest();
    (0..count).for_each(|_| stepper.step(&mut motion));
    if continues(0.5) {
        (0..count).for_each(|_| stepper.step_back(&mut motion));
    }
    Back { to_start: vec![distance(&begin, &[motion.q(), motion.p()].concat())], to_negative: 0.0 }
}

fn distance<N: CorrectlyRounded>(one: &[N], other: &[N]) -> f64 {
    let last_place = -f64::from(N::precision(&one[0].context()).in_bits() - 1) * std::f64::consts::LOG10_2;
    let square = one.iter().zip(other).map(|(a, b)| {
        let mut difference = a.clone();
        difference.subtract(b);
        10_f64.powf(2.0 * (difference.log10_abs() - last_place))
    });
    square.sum::<f64>().sqrt()
}
