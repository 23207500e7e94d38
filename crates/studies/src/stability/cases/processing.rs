//! Runs of processed schemes that are read at every step.

use shadowstep::Carried;
use shadowstep::steps::integrator::at_output;
use shadowstep_scenes::{CanonicalCoordinates, Parts, Planets};

use crate::stability::prelude::*;
use crate::stability::systems::setup;

/// The case.
pub(super) struct Processing;

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
/// An orbit with e = 0.3, T(p) and U(q); the outer planets, Kepler orbits and their interactions.
const PROBLEMS: [&str; 2] = ["Kepler", "Planets"];

impl Case for Processing {
    type Measured = Outputs;

    fn complete(scheme: &Examined, mut values: Values) -> Option<Values> {
        let processor = scheme.scheme.scheme.proved().scheme.table.processor.as_ref()?;
        let problem = PROBLEMS[usize::from(processor.near_integrable.is_some())];
        values.insert("problem".to_owned(), problem.into());
        Some(values)
    }

    fn seconds(trial: &Trial<'_>) -> f64 {
        trial.seconds() * if is_of_planets(trial) { 25.0 } else { 1.0 }
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Outputs, Error> {
        let evaluations = trial.evaluations();
        let (system, h) = match is_of_planets(trial) {
            true => (planets(), Rational::from_integer((200 * evaluations).into())),
            false => {
                let system = shipped("kepler", &[("eccentricity", "3/10".to_owned())]);
                (system, Rational::new(evaluations.into(), 60.into()))
            }
        };
        let (system, h) = (&system, &step_size(&h));
        let run = Run { system, scheme: trial.scheme(), h, steps: trial.steps(), continues };
        Ok(trial.arithmetic.compute(run))
    }

    fn judge(all: &[&Done<'_, Outputs>]) -> Vec<Row> {
        let Done { trial, found: outputs } = all[0];
        let bits = if outputs.same_bits { "the same bits" } else { "other bits" };
        let [first, .., last] = outputs.at_outputs;
        let found = format!(
            "{}, {} steps: {bits}; error of H at outputs {first:.1e} in the first fourth, {last:.1e} in the last; \
             {:.1e} in the kernel",
            trial.get::<String>("problem").to_lowercase(),
            trial.steps(),
            outputs.in_kernel
        );
        let point = (outputs.in_kernel.log10(), largest(outputs.at_outputs).log10());
        vec![Row::of(trial, found, outputs.verdict()).with([point])]
    }
}

fn is_of_planets(trial: &Trial<'_>) -> bool {
    trial.get::<String>("problem") == PROBLEMS[1]
}

impl Outputs {
    fn verdict(&self) -> Verdict {
        let [first, .., last] = self.at_outputs;
        Verdict::from(self.same_bits && last <= SAME * first && largest(self.at_outputs) < self.in_kernel)
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
