//! Chains of 1 to 10⁵ coordinates: time and memory.

use std::time::Instant;

use serde::{Deserialize, Serialize};
use shadowstep::problems::CubicSpring;
use shadowstep::systems::pairs::{Ends, Pairs};
use shadowstep::{Carried, Potential, Rational, Scheme};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::Begin;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::integrator::{step_size, steps_of};
use crate::suite::{Examined, Suite};

/// The case.
pub(super) struct Chains;

/// A chain of springs.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    bodies: usize,
}

/// What its steps need.
#[derive(Serialize, Deserialize)]
pub(super) struct Cost {
    /// Nanoseconds a step and body, the least of several repeats.
    nanoseconds: f64,
    /// Numbers that are kept a body: state, gradient, and what the potential needs.
    numbers: f64,
    finite: bool,
}

const BODIES: [usize; 6] = [1, 10, 100, 1000, 10_000, 100_000];
/// Steps and bodies of a repeat together.
const WORK: usize = 400_000;
const REPEATS: usize = 7;
/// The time a body may differ by this factor between 100 and 10⁵ bodies, which fill the caches.
const LINEAR: f64 = 4.0;
const SCHEMES: [&str; 2] = ["stormer-verlet", "blanes-moan-srkn6b"];

impl Case for Chains {
    const NAME: &'static str = "chains";
    const TITLE: &'static str = "Chains of 1 to 10⁵ coordinates";
    const THEORY: &'static str = "Time and memory of a step are proportional to the number of bodies, from 100 bodies \
        on to within what caches of the processor make.";
    const REVISION: u32 = 1;

    type Trial = Trial;
    type Measured = Cost;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let of = |scheme: &&Examined| BODIES.map(|bodies| Trial { scheme: scheme.identity.clone(), bodies });
        suite.schemes_or(&SCHEMES).iter().flat_map(of).collect()
    }

    fn seconds(_: &Suite, _: &Trial) -> f64 {
        (WORK * REPEATS) as f64 * 20e-9
    }

    fn measure(suite: &Suite, trial: &Trial, arithmetic: Arithmetic, continues: Continues<'_>) -> Result<Cost, Error> {
        let scheme = suite.scheme(&trial.scheme);
        Ok(arithmetic.compute(Repeat { scheme, bodies: trial.bodies, continues }))
    }

    fn judge(suite: &Suite, measured: &[(Trial, Cost)]) -> Finding {
        let mut finding = Finding::default();
        let mut curves = Vec::new();
        for (i, all) in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme).enumerate() {
            let name = &suite.scheme(&all[0].0.scheme).name;
            let long = all.iter().filter(|(trial, _)| trial.bodies >= 100);
            let times: Vec<f64> = long.map(|(_, cost)| cost.nanoseconds).collect();
            let (least, largest) =
                (times.iter().copied().fold(f64::INFINITY, f64::min), times.iter().copied().fold(0.0, f64::max));
            let numbers = all.iter().map(|(_, cost)| cost.numbers).fold(0.0, f64::max);
            let finite = all.iter().all(|(_, cost)| cost.finite);
            let found = format!(
                "from 100 to 100 000 bodies {least:.2} to {largest:.2} ns a body and evaluation; {numbers:.0} numbers \
                    a body at most"
            );
            finding.check(name, found, Verdict::from(largest <= LINEAR * least && finite));
            let points =
                all.iter().map(|(trial, cost)| ((trial.bodies as f64).log10(), cost.nanoseconds.log10())).collect();
            curves.push(Curve::marked(name.clone(), points, i));
        }
        let (x, y) = (Axis::log10("bodies"), Axis::log10("nanoseconds a body and evaluation"));
        finding.chart(
            Chart::new("The time of a step", x, y, curves),
            "The least of 7 repeats; other work on the machine adds to it.",
        );
        finding
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
