//! Hénon–Heiles: regular, chaotic, escaping.

use serde::{Deserialize, Serialize};
use shadowstep::{Number, Rational, Scheme};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::start::Begin;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::{Case, MOST_CURVES};
use crate::integrator::{start_in, step_size, steps_of};
use crate::suite::{Examined, OF_ORDERS_2_TO_8, Suite};
use crate::systems::{rational, shipped};
use crate::watched::{Next, Watched, watched};

/// The case.
pub(super) struct HenonHeiles;

/// A start.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    kind: OrbitKind,
    steps: u64,
}

/// Of what kind the exact orbit is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
enum OrbitKind {
    Regular,
    Chaotic,
    Escaping,
}

/// What a run has shown.
#[derive(Serialize, Deserialize)]
pub(super) struct Measured {
    watched: Watched,
    /// The largest |H − H(0)|/|H(0)| in each half of the run.
    energy_errors: [f64; 2],
    /// log₁₀ of the growth of a distance at the start, at most 12.
    growth: f64,
    /// The same at some times.
    growing: Vec<(f64, f64)>,
    /// When |q| is first above 2, beyond which nothing returns.
    escaped: Option<u64>,
}

/// Steps of 1/40 for each evaluation of the force.
const STEPS_A_UNIT: i64 = 40;
/// Beyond this distance the orbit has left the triangle of the equipotential 1/6, whose corners are at 1.
const OUTSIDE: f64 = 2.0;
/// Regular orbits separate like t, chaotic ones by factors: 1e4 is between the two for t = 1000 and more.
const CHAOTIC: f64 = 5.0;
const BOUNDED: f64 = 1.5;
const NEAR: f64 = 1e-10;
/// The growth is kept at this number of times.
const SAMPLES: u64 = 200;
const STAYS: &str = "It may escape later; a longer run would decide.";
impl OrbitKind {
    /// The initial state: H = 0.005; H = 1/8 from the chaotic sea; H = 0.2, above 1/6.
    fn start(self) -> [(&'static str, String); 4] {
        let [x, y, px, py] = match self {
            OrbitKind::Regular => ["0", "0", "1/10", "0"],
            OrbitKind::Chaotic => ["0", "-1/10", "sqrt(1/4 - 1/100 - 1/1500)", "0"],
            OrbitKind::Escaping => ["0", "0", "sqrt(2/5 - 9/100)", "3/10"],
        };
        [("x", x.to_owned()), ("y", y.to_owned()), ("px", px.to_owned()), ("py", py.to_owned())]
    }
}

impl Case for HenonHeiles {
    const NAME: &'static str = "henon-heiles";
    const TITLE: &'static str = "Hénon–Heiles: regular, chaotic, escaping";
    const THEORY: &'static str = "Chaos is not an error: neighbouring orbits separate exponentially, and the error of \
        H is as bounded as for regular orbits; the monitor calls the step fine. Above H = 1/6 orbits escape, whatever \
        the step.";
    const REVISION: u32 = 3;

    type Trial = Trial;
    type Measured = Measured;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let steps = suite.full_or_quick(1_000_000, 40_000);
        let of = |scheme: &&Examined| {
            let evaluations = scheme.scheme.scheme.summary().evaluations as u64;
            [OrbitKind::Regular, OrbitKind::Chaotic, OrbitKind::Escaping].map(|kind| Trial {
                scheme: scheme.identity.clone(),
                kind,
                steps: steps / evaluations,
            })
        };
        suite.schemes_or(&OF_ORDERS_2_TO_8).iter().flat_map(of).collect()
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        2.0 * trial.steps as f64 * suite.scheme(&trial.scheme).scheme.summary().evaluations as f64 * 40e-9
    }

    fn measure(
        suite: &Suite,
        trial: &Trial,
        arithmetic: Arithmetic,
        continues: Continues<'_>,
    ) -> Result<Measured, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let h = Rational::new(scheme.scheme.summary().evaluations.into(), STEPS_A_UNIT.into());
        let length = <f64 as Number>::from_rational(&h, &());
        let h = step_size(&h);
        let system = shipped("henon-heiles", &trial.kind.start());
        let mut beside = shipped("henon-heiles", &trial.kind.start());
        beside.problem.q[0].value += rational(NEAR);
        let [mut run, mut near] =
            [&system, &beside].map(|system| start_in(arithmetic, system, steps_of(scheme, &h, Begin::Step)));
        let initial = run.energy();
        let (mut energy_errors, mut growth, mut growing, mut escaped) = ([0.0_f64; 2], 0.0_f64, Vec::new(), None);
        let watched = watched(&mut *run, (trial.steps / 256).max(1), trial.steps, continues, &mut |n, run| {
            let [x, y] = [run.q(0), run.q(1)];
            if x.hypot(y) > OUTSIDE {
                escaped = Some(n);
                return Next::End;
            }
            let error = ((run.energy() - initial) / initial).abs();
            let half = usize::from(2 * n > trial.steps);
            energy_errors[half] = energy_errors[half].max(error);
            near.step();
            let distance = (near.q(0) - x).hypot(near.q(1) - y);
            growth = growth.max((distance / NEAR).max(1.0).log10().min(12.0));
            if n * SAMPLES % trial.steps < SAMPLES {
                growing.push((n as f64 * length, growth));
            }
            Next::Continue
        });
        Ok(Measured { watched, energy_errors, growth, growing, escaped })
    }

    fn judge(suite: &Suite, measured: &[(Trial, Measured)]) -> Finding {
        let (mut finding, mut curves) = (Finding::default(), Vec::new());
        for (trial, one) in measured {
            let [first, second] = one.energy_errors;
            let bounded = second <= BOUNDED * first;
            let (found, verdict) = match (trial.kind, one.escaped) {
                (OrbitKind::Escaping, Some(n)) => (format!("escapes at step {n}"), Verdict::Agrees),
                (OrbitKind::Escaping, None) => ("does not escape".to_owned(), Verdict::NotDecided(STAYS)),
                (_, Some(n)) => (format!("escapes at step {n}"), Verdict::Differs),
                (kind, None) => {
                    let chaotic = one.growth > CHAOTIC;
                    let found = format!(
                        "a distance grows to 1e{:.1} of its size; error of H {first:.1e} and {second:.1e} in the \
                            halves; the monitor: {}",
                        one.growth, one.watched.verdict
                    );
                    let as_exact = Verdict::from(bounded && chaotic == (kind == OrbitKind::Chaotic));
                    (found, Verdict::of_all([as_exact, one.watched.is_fine()]))
                }
            };
            let kind = format!("{:?}", trial.kind).to_lowercase();
            let name = &suite.scheme(&trial.scheme).name;
            finding.check(name, format!("{kind}: {found}"), verdict);
            if trial.kind != OrbitKind::Escaping && curves.len() < MOST_CURVES {
                curves.push(Curve::line(format!("{name}, {kind}"), one.growing.clone(), curves.len()));
            }
        }
        let (x, y) = (Axis::linear("t"), Axis::log10("largest distance, beside that at the start"));
        finding.chart(
            Chart::new("Two orbits that begin 1e-10 apart", x, y, curves),
            "Chaotic orbits are as far apart as the region is large soon.",
        );
        finding
    }
}
