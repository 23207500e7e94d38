//! Runs of processed schemes that are read at every step.

use serde::{Deserialize, Serialize};
use shadowstep::steps::integrator::at_output;
use shadowstep::{Carried, Rational, Scheme, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::Begin;
use shadowstep_scenes::{CanonicalCoordinates, Error, Parts, Planets, System};
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::integrator::{start, step_size, steps_of};
use crate::suite::{Examined, Suite};
use crate::systems::{setup, shipped};

/// The case.
pub(super) struct Processing;

/// A processed scheme on a problem.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    problem: Problem,
    steps: u64,
}

#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
enum Problem {
    /// An orbit with e = 0.3, T(p) and U(q).
    Kepler,
    /// The outer planets, Kepler orbits and their interactions.
    Planets,
}

/// What the run has shown.
#[derive(Serialize, Deserialize)]
pub(super) struct Outputs {
    /// Whether the kernel ends in the same bits with outputs as without.
    same_bits: bool,
    /// The largest |H − H(0)| as a part of |H(0)| at the outputs, in each fourth of the run.
    at_outputs: [f64; 4],
    /// The same at the states of the kernel, beside H at its first one, in the whole run.
    in_kernel: f64,
}

/// How much the error of H may differ between the first and the last fourth, if it is the same oscillation.
const SAME: f64 = 1.5;

impl Case for Processing {
    const NAME: &'static str = "processing";
    const TITLE: &'static str = "Processed schemes that are read at every step";
    const THEORY: &'static str = "A processed run is a run of its kernel, seen through the post-map: reading it at \
        every step changes no bit of it, and the error of H at the outputs stays as bounded as that of any symplectic \
        scheme, and is smaller than that of the kernel, whose effective order it raises. Schemes for A + εB are on \
        the outer planets as Kepler orbits and their interactions, others on Kepler's problem.";
    const REVISION: u32 = 1;

    type Trial = Trial;
    type Measured = Outputs;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let steps = suite.full_or_quick(20_000, 1000);
        let processed = suite.schemes_or_all().into_iter();
        let processor = |examined: &Examined| examined.scheme.scheme.proved().scheme.table.processor.clone();
        let trial = |examined: &Examined| {
            let processor = processor(examined)?;
            let problem = if processor.near_integrable.is_some() { Problem::Planets } else { Problem::Kepler };
            Some(Trial { scheme: examined.identity.clone(), problem, steps })
        };
        processed.filter_map(trial).collect()
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        let scheme = &suite.scheme(&trial.scheme).quadratic();
        let maps = 2 * scheme.summary().evaluations + scheme.processor().len();
        let map = if trial.problem == Problem::Planets { 500e-9 } else { 20e-9 };
        trial.steps as f64 * maps as f64 * map
    }

    fn measure(
        suite: &Suite,
        trial: &Trial,
        arithmetic: Arithmetic,
        continues: Continues<'_>,
    ) -> Result<Outputs, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let evaluations = scheme.scheme.summary().evaluations as i64;
        let (system, h) = match trial.problem {
            Problem::Kepler => {
                let system = shipped("kepler", &[("eccentricity", "3/10".to_owned())]);
                (system, Rational::new(evaluations.into(), 60.into()))
            }
            Problem::Planets => (planets(), Rational::from_integer((200 * evaluations).into())),
        };
        let (system, h) = (&system, &step_size(&h));
        Ok(arithmetic.compute(Run { system, scheme, h, steps: trial.steps, continues }))
    }

    fn judge(suite: &Suite, measured: &[(Trial, Outputs)]) -> Finding {
        let (mut finding, mut points) = (Finding::default(), Vec::new());
        for (trial, outputs) in measured {
            let name = &suite.scheme(&trial.scheme).name;
            finding.check(name, outputs.described(trial), outputs.verdict());
            let largest = outputs.largest();
            points.push((outputs.in_kernel.log10(), largest.log10(), name.clone()));
        }
        let curves = points
            .into_iter()
            .enumerate()
            .map(|(i, (kernel, output, name))| Curve::marked(name, vec![(kernel, output)], i));
        let (x, y) = (Axis::log10("largest error of H of the kernel"), Axis::log10("largest error of H at outputs"));
        finding.chart(
            Chart::new("What the post-map does to the error of H", x, y, curves.collect()),
            "Errors are parts of H(0); each mark is a processed scheme.",
        );
        finding
    }
}

impl Outputs {
    fn largest(&self) -> f64 {
        self.at_outputs.into_iter().fold(0.0, f64::max)
    }

    fn described(&self, trial: &Trial) -> String {
        let problem = if trial.problem == Problem::Planets { "planets" } else { "kepler" };
        let bits = if self.same_bits { "the same bits" } else { "other bits" };
        let [first, .., last] = self.at_outputs;
        format!(
            "{problem}, {} steps: {bits}; error of H at outputs {first:.1e} in the first fourth, {last:.1e} in the \
                last; {:.1e} in the kernel",
            trial.steps, self.in_kernel
        )
    }

    fn verdict(&self) -> Verdict {
        let [first, .., last] = self.at_outputs;
        Verdict::from(self.same_bits && last <= SAME * first && self.largest() < self.in_kernel)
    }
}

/// The Kepler orbits of the outer planets, and their interactions.
fn planets() -> System {
    let setup = setup("outer-solar-system", &[]);
    let (bodies, dimensions) = setup.bodies().expect("they are bodies");
    let planets = Planets { coordinates: CanonicalCoordinates::Jacobi, bodies, dimensions, encounters: None };
    System { parts: Parts::WisdomHolman(planets), ..System::of_setup(setup) }
}

/// One run that is read at every step, beside one that is not.
struct Run<'a> {
    system: &'a System,
    scheme: &'a NamedScheme,
    h: &'a StepSize,
    steps: u64,
    continues: Continues<'a>,
}

impl Computation for Run<'_> {
    type Output = Outputs;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Outputs {
        let Run { system, scheme, h, steps, continues } = self;
        let begin = |begin: Begin| start::<N>(system, steps_of(scheme, h, begin), context);
        let error = |energy: &N, initial: f64| ((energy.to_f64() - initial) / initial).abs().min(f64::MAX);
        let initial = begin(Begin::Step).system().energy().to_f64();
        let [mut run, mut alone] = [(), ()].map(|()| begin(Begin::InitialState));
        let first_of_kernel = run.system().energy().to_f64();
        let (mut at_outputs, mut in_kernel) = ([0.0_f64; 4], 0.0_f64);
        for n in 0..steps {
            run.step(Carried::Nothing);
            let largest = &mut at_outputs[(4 * n / steps) as usize];
            *largest = largest.max(error(&at_output(&mut *run, |run| run.system().energy()), initial));
            in_kernel = in_kernel.max(error(&run.system().energy(), first_of_kernel));
            if n % 256 == 0 && !continues(n as f64 / steps as f64) {
                break;
            }
        }
        alone.steps(steps);
        let same = |a: &[N], b: &[N]| a.iter().zip(b).all(|(a, b)| a == b);
        let (alone, run) = (alone.state(), run.state());
        Outputs { same_bits: same(alone.q(), run.q()) && same(alone.p(), run.p()), at_outputs, in_kernel }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_bits_or_errors_that_grow_differ() {
        let outputs =
            |same_bits, last, in_kernel| Outputs { same_bits, at_outputs: [1e-6, 1e-6, 1e-6, last], in_kernel };
        assert_eq!(outputs(true, 1e-6, 1e-5).verdict(), Verdict::Agrees);
        assert_eq!(outputs(false, 1e-6, 1e-5).verdict(), Verdict::Differs);
        assert_eq!(outputs(true, 2e-6, 1e-5).verdict(), Verdict::Differs);
        assert_eq!(outputs(true, 1e-6, 1e-6).verdict(), Verdict::Differs);
    }
}
