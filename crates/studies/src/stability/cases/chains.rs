//! Chains of 1 to 10⁵ coordinates: time and memory.

use std::time::Instant;

use shadowstep::problems::CubicSpring;
use shadowstep::systems::pairs::{Ends, Pairs};
use shadowstep::{Carried, Potential};

use crate::stability::prelude::*;

/// The case.
pub(super) struct Chains;

/// What the steps of a chain of springs need.
#[derive(Serialize, Deserialize)]
pub(super) struct Cost {
    /// Nanoseconds a step and body, the least of several repeats.
    nanoseconds: f64,
    /// Numbers that are kept a body: state, gradient, and what the potential needs.
    numbers: f64,
    finite: bool,
}

/// Steps and bodies of a repeat together.
const WORK: usize = 400_000;
const REPEATS: usize = 7;
/// The time a body may differ by this factor between 100 and 10⁵ bodies, which fill the caches.
const LINEAR: f64 = 4.0;

impl Case for Chains {
    type Measured = Cost;

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Cost, Error> {
        Ok(trial.arithmetic.compute(Repeat { scheme: trial.scheme(), bodies: trial.get("bodies"), continues }))
    }

    fn judge(all: &[&Done<'_, Cost>]) -> Vec<Row> {
        let bodies = |one: &Done<'_, Cost>| one.trial.get::<f64>("bodies");
        let times = || all.iter().filter(|one| bodies(one) >= 100.0).map(|one| one.found.nanoseconds);
        let (least, most) = (times().fold(f64::INFINITY, f64::min), largest(times()));
        let numbers = largest(all.iter().map(|one| one.found.numbers));
        let found = format!(
            "from 100 to 100 000 bodies {least:.2} to {most:.2} ns a body and evaluation; {numbers:.0} numbers a body \
             at most"
        );
        let linear = most <= LINEAR * least && all.iter().all(|one| one.found.finite);
        let points = all.iter().map(|one| (bodies(one).log10(), one.found.nanoseconds.log10()));
        vec![Row::of(&all[0].trial, found, linear).with(points)]
    }
}

/// Steps of a chain, repeated.
struct Repeat<'a> {
    scheme: &'a NamedScheme,
    bodies: usize,
    continues: Continues<'a>,
}

impl Computation for Repeat<'_> {
    type Output = Cost;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Cost {
        let Repeat { scheme, bodies, continues } = self;
        let evaluations = scheme.scheme.summary().evaluations;
        let ratio = |numerator: i64, denominator: i64| Rational::new(numerator.into(), denominator.into());
        let number = |numerator: i64, denominator: i64| N::from_rational(&ratio(numerator, denominator), context);
        let spring = CubicSpring { alpha: number(1, 4) };
        let potential = Pairs::<_, 1>::neighbours(bodies, spring, Ends::Fixed).expect("the pairs fit");
        let numbers = 3.0 + potential.scratch() as f64 / bodies as f64;
        let q = (0..bodies).map(|i| number((i % 7) as i64 - 3, 100)).collect();
        let p = vec![number(0, 1); bodies];
        let h = step_size(ratio(evaluations as i64, 20));
        let chain = N::springs(&ratio(1, 4), steps_of(scheme, &h, Begin::Step), (q, p), context);
        let mut chain = chain.expect("as many as bodies");
        let steps = (WORK / bodies / evaluations).max(1);
        let mut nanoseconds = f64::INFINITY;
        for i in 0..REPEATS {
            if !continues(i as f64 / REPEATS as f64) {
                break;
            }
            let begin = Instant::now();
            (0..steps).for_each(|_| chain.step(Carried::Nothing));
            let evaluated = (steps * evaluations * bodies) as f64;
            nanoseconds = nanoseconds.min(begin.elapsed().as_nanos() as f64 / evaluated);
        }
        Cost { nanoseconds: nanoseconds.min(f64::MAX), numbers, finite: chain.state().is_finite() }
    }
}
