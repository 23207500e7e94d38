//! Time reversal: steps forth and back.

use serde_json::json;
use shadowstep::number::CorrectlyRounded;
use shadowstep::problems::Kepler;
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::{Carried, Motion, Stepper, UnitMasses};

use crate::stability::prelude::*;

/// The case.
pub(super) struct Reversal;

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

impl Case for Reversal {
    type Measured = Back;

    fn complete(scheme: &Examined, mut values: Values) -> Option<Values> {
        if values["fixed_point"] == true && scheme.evaluations() > 3 {
            // the same number of evaluations, to a factor of a few
            values.insert("steps".to_owned(), json!([values["steps"][0].as_u64()? / 10]));
        }
        Some(values)
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Back, Error> {
        let h = Rational::new(trial.evaluations().into(), trial.get::<u64>("inverse").into());
        Ok(match trial.get("fixed_point") {
            true => in_fixed_point(trial, &h, continues),
            false => trial.arithmetic.compute(Forth { trial, h: &h, continues }),
        })
    }

    fn judge(all: &[&Done<'_, Back>]) -> Vec<Row> {
        let Done { trial, found: back } = all[0];
        let (problem, steps) = (trial.get::<String>("problem"), trial.steps());
        let to_start = *back.to_start.last().expect("there are some");
        if trial.get("fixed_point") {
            let same = to_start == 0.0;
            let end = if same { "the same bits".to_owned() } else { format!("{to_start:.1e} ε from the start") };
            return vec![Row::of(trial, format!("{problem} in fixed point, {steps} steps: {end}"), same)];
        }
        let (same, unit) = (back.to_negative == 0.0, (steps as f64).powf(1.5));
        let found = format!(
            "{problem}, {steps} steps: {to_start:.1e} ε from the start, {:.1e} n^{{3/2}} ε; −h is {}",
            to_start / unit,
            if same { "the inverse, bit for bit" } else { "another map" },
        );
        let as_predicted = to_start <= FACTOR * unit && same == trial.scheme().scheme.summary().symmetric;
        let steps = trial.get::<Vec<f64>>("steps");
        let points = steps.iter().zip(&back.to_start).filter(|(_, to_start)| **to_start > 0.0);
        let points = points.map(|(n, to_start)| (n.log10(), to_start.log10()));
        vec![Row::of(trial, found, as_predicted).with_curve(format!("{}, {problem}", trial.name()), points)]
    }
}

/// Steps forth and back.
struct Forth<'a> {
    trial: &'a Trial<'a>,
    h: &'a Rational,
    continues: Continues<'a>,
}

impl Computation for Forth<'_> {
    type Output = Back;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Back {
        let Forth { trial, h, continues } = self;
        let [h, minus_h] = [h.clone(), -h].map(step_size);
        let system = shipped(&trial.get::<String>("problem"), &[]);
        let [mut forth, mut negative] =
            [&h, &minus_h].map(|h| start::<N>(&system, steps_of(trial.scheme(), h, Begin::Step), context));
        let begin = state(&*forth);
        forth.steps(SHORT);
        set(&mut *negative, &state(&*forth));
        negative.steps(SHORT);
        steps_back(&mut *forth, SHORT);
        let to_negative = distance(&state(&*forth), &state(&*negative));

        let mut to_start = Vec::new();
        for count in trial.get::<Vec<u64>>("steps") {
            set(&mut *forth, &begin);
            forth.steps(count);
            if continues(0.5) {
                steps_back(&mut *forth, count);
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

fn in_fixed_point(trial: &Trial<'_>, h: &Rational, continues: Continues<'_>) -> Back {
    let stepper = Stepper::new(trial.scheme().quadratic(), h).expect("it is positive");
    let start = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).expect("two coordinates");
    let mut motion = start.fixed_point(&RANGES[0], &RANGES[1]).expect("the ranges hold the orbit");
    let begin = [motion.q(), motion.p()].concat();
    let count = trial.steps();
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
