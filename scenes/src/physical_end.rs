//! The end of a run: the first state that meets a condition; in transformed time how many steps fit before a physical time, and the last step to that time.

use std::ops::ControlFlow::{self, Break, Continue};

use num_traits::Signed;
use shadowstep::shadow::Estimate;
use shadowstep::shadow::run::RunError;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::steps::step_to_time;
use shadowstep::{Rational, Real};

use crate::computation::{Computation, RunNumber};
use crate::error::Error;
use crate::evaluator::Test;
use crate::expression::Condition;
use crate::follow::Follower;
use crate::run::Run;
use crate::scene::{Scene, System};
use crate::steps::{End, MOST_STEPS};

impl Scene {
    /// The number of steps. Of a run that ends on a condition, or in transformed time at a physical time, the first call makes them all to count them;
    /// in transformed time another step of the exact remainder then ends the run.
    pub fn steps(&self) -> u64 {
        self.end().steps
    }

    pub(crate) fn end(&self) -> End {
        *self.end.get_or_init(|| self.arithmetic.compute(Counting { scene: self }))
    }

    /// The physical time of the last step, where time is transformed and the run ends there.
    pub(crate) fn physical_end(&self) -> Option<&Rational> {
        self.until.as_ref().filter(|_| self.system.transformed_time().is_some() && !self.end().is_met)
    }
}

/// Finds the end of a run.
struct Counting<'a> {
    scene: &'a Scene,
}

impl Computation for Counting<'_> {
    type Output = End;

    fn compute<N: RunNumber>(self, context: &N::Context) -> End {
        let scene = self.scene;
        let Ok(mut integrator) = scene.integrator::<N>(context) else { return End { steps: 0, is_met: false } };
        let until = scene.until.as_ref().filter(|_| scene.system.transformed_time().is_some());
        let ends = Ends { until, condition: scene.ends.as_ref() };
        let most = scene.most_steps.unwrap_or(MOST_STEPS);
        find_end(&mut *integrator, &scene.system, ends, (scene.h.exact(), most), context)
    }
}

/// What ends a run before its last step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ends<'a> {
    /// The physical time, where time is transformed.
    pub(crate) until: Option<&'a Rational>,
    /// The condition, which was checked for the system.
    pub(crate) condition: Option<&'a Condition>,
}

/// Makes steps of h, at most this number, to find where they end.
pub(crate) fn find_end<N: RunNumber>(
    integrator: &mut VectorIntegrator<'_, N>,
    system: &System,
    Ends { until, condition }: Ends<'_>,
    (h, most): (&Rational, u64),
    context: &N::Context,
) -> End {
    let mut found = FindEnd {
        until: until.map(|until| (N::from_rational(until, context), until.is_positive())),
        test: condition.map(|condition| Test::new(condition, system, context).expect("it was checked with the system")),
        h,
        end: End { steps: 0, is_met: false },
    };
    // a step whose state is not finite counts, so that the run finds it
    let _ = N::follow(integrator, (None, most), None, &mut found);
    found.end
}

/// Finds the last step at or before a physical time, or the first one after t = 0 at which a condition is met.
struct FindEnd<'a, N> {
    /// The time, and whether steps go forwards.
    until: Option<(N, bool)>,
    test: Option<Test<N>>,
    h: &'a Rational,
    end: End,
}

impl<N: RunNumber> Follower<N> for FindEnd<'_, N> {
    fn output(
        &mut self,
        n: i64,
        _: Option<&Estimate<'_, N>>,
        integrator: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error> {
        if let Some((until, forward)) = &self.until {
            let t = integrator.state().q().last().expect("time is a coordinate");
            if if *forward { t > until } else { t < until } {
                return Ok(Break(()));
            }
        }
        self.end.steps = n.unsigned_abs();
        let Some(test) = self.test.as_mut().filter(|_| n != 0) else { return Ok(Continue(())) };
        let time = || self.h * Rational::from_integer(n.into());
        self.end.is_met = at_output(integrator, |integrator| test.is_met(integrator.system(), time));
        Ok(if self.end.is_met { Break(()) } else { Continue(()) })
    }

    fn failed(&mut self, error: RunError) -> Result<(), Error> {
        if let RunError::NotFinite { step, .. } = error {
            self.end.steps = step.unsigned_abs();
        }
        Ok(())
    }
}

/// Makes the last step from a state, unless its time is `until` already: then false.
///
/// # Errors
/// A state that is not finite on the way.
pub(crate) fn last_step<N: Real>(
    integrator: &mut VectorIntegrator<'_, N>,
    (q, p): (&[N], &[N]),
    (run, until): (Run<'_>, &Rational),
) -> Result<bool, Error> {
    let until = N::from_rational(until, &integrator.state().context());
    integrator.system().state_mut().set(q, p);
    if q.last() == Some(&until) {
        return Ok(false);
    }
    match step_to_time(integrator, &until) {
        Some(_) => Ok(true),
        None => {
            let message = format!("{}: no last step to t = {until} has a finite state", run.name());
            Err(Error::run(message, "try a smaller step size"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Outcome;
    use shadowstep::number::Limbs;
    use shadowstep::problems::Kepler;
    use shadowstep::systems::transformed_time::{TimeTransformation, TransformedKinetic, TransformedPotential};
    use shadowstep::tables::{Faults, Source, shipped};
    use shadowstep::{Carried, Integrator as _, Motion, Number as _, Stepper, UnitMasses};
    use shadowstep_symbolic::decimal::from_text;

    fn read(text: &str) -> Result<Scene, Faults> {
        Scene::read(Source { path: "test.toml".to_owned(), text: text.to_owned() })
    }

    fn pendulum(end: &str, output: &str) -> Result<Scene, Faults> {
        read(&format!(
            "problem.name = \"pendulum\"\n[run]\nscheme = \"yoshida4\"\nstep = \"1/10\"\nuntil = 100\nend = {end}\ndigits = \"double\"\n[output]\n{output}"
        ))
    }

    fn rows(scene: &Scene) -> Vec<String> {
        let mut rows = Vec::new();
        assert!(matches!(scene.run_into(&mut rows, &mut ()).unwrap(), Outcome::Complete { .. }));
        let text = String::from_utf8(rows).unwrap();
        text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
    }

    /// The first state at which p < 0 is the last one, whatever is written, and the rows before are those of a run that goes on.
    #[test]
    fn a_condition_ends_a_run_at_the_first_state_that_meets_it() {
        for output in
            ["trajectory = true", "trajectory = true\nmodified_energy = { estimator = \"bilinear\", order = 4 }"]
        {
            let (ended, free) = (pendulum("\"p < 0\"", output).unwrap(), pendulum("\"p > 100\"", output).unwrap());
            assert_eq!((ended.steps(), ended.end().is_met), (17, true));
            assert_eq!((free.steps(), free.end().is_met), (1000, false));
            let (ended, free) = (rows(&ended), rows(&free));
            assert_eq!(ended.len(), 1 + 18);
            assert_eq!(ended, free[..ended.len()]);
            let momentum = |row: &String| row.rsplit(',').next().unwrap().parse::<f64>().unwrap();
            let sparse = output.replace("trajectory = true", "trajectory = { every = 1000 }");
            assert_eq!(rows(&pendulum("\"p < 0\"", &sparse).unwrap()).last(), ended.last());
            assert!(momentum(&ended[17]) >= 0.0 && momentum(&ended[18]) < 0.0);
        }
    }

    /// t of the condition is the physical one; then no last step is made to `until`.
    #[test]
    fn a_condition_ends_a_run_in_transformed_time() {
        let text = "problem.name = \"kepler\"\ntime.transform = \"logarithmic\"\noutput.trajectory = true\n\
                    run = { scheme = \"stormer-verlet\", first = \"drift\", step = \"1/20\", until = 20, end = \"t > 3\", digits = \"double\" }";
        let rows = rows(&read(text).unwrap());
        let time = |row: &String| row.split(',').nth(1).unwrap().parse::<f64>().unwrap();
        assert!(time(&rows[rows.len() - 2]) <= 3.0 && time(&rows[rows.len() - 1]) > 3.0);
    }

    #[test]
    fn faults_of_a_condition_have_their_places() {
        let fault = |end: &str| {
            let Err(Faults(faults)) = pendulum(end, "energy = true") else { panic!("{end} is read") };
            format!("{}:{}: {}", faults[0].line, faults[0].column, faults[0].message)
        };
        assert_eq!(fault("\"p\""), "6:7: this text is not a condition");
        assert_eq!(fault("\"p < z\""), "6:7: unknown name `z`; known names: q, p, t, E");
        assert_eq!(fault("\"p < 2^^3\""), "6:14: unexpected `^`: a number, a name or `(` should follow `^`");
        assert_eq!(fault("1"), "6:7: this value is of the wrong kind");
    }

    /// The step is from a state of the trajectory to another one: a part of a step of the kernel alone would have the kernel's error.
    #[test]
    fn a_last_step_of_a_processed_scheme_has_its_effective_order() {
        // Kepler's orbit of a = 1 and e = 1/2 from its pericentre, whose H is −1/2; E − e sin E = 3 was solved by mpmath
        let exact = [
            "-1.49554367949370064987359367969044780902165371283298359243394",
            "0.0816675374007804714178980304045221740152716243638199507374892",
        ];
        let number = |text: &str| Limbs::<4>::from_rational(&from_text(text).unwrap(), &());
        let mut speed = number("3");
        speed.assign_sqrt(&number("3"));
        for name in ["bcm6-13", "blanes6-7", "shadowstep6-7p"] {
            let [coarse, fine] = ["1/10", "1/20"].map(|h| {
                let (q, p) = (["0.5", "0", "0"].map(number).to_vec(), vec![number("0"), speed, number("0.5")]);
                let time = TimeTransformation::Logarithmic;
                let kinetic = TransformedKinetic::new(time, UnitMasses);
                let motion = Motion::new(TransformedPotential::new(time, Kepler), kinetic, q, p).unwrap();
                let scheme = shipped(name).unwrap().for_every_kinetic().unwrap();
                let mut integrator = Stepper::<_, Limbs<4>>::new(scheme, h).unwrap().into_integrator(motion);
                integrator.preprocess();
                let until = number("3");
                let mut before = (Vec::new(), Vec::new());
                let mut state = || {
                    at_output(&mut integrator, |at| before = (at.state().q().to_vec(), at.state().p().to_vec()));
                    integrator.step(Carried::Nothing);
                    before.clone()
                };
                let states = std::iter::from_fn(|| Some(state())).take_while(|(q, _)| q[2] < until);
                let (q, p) = states.last().unwrap();
                integrator.system().state_mut().set(&q, &p);
                step_to_time(&mut integrator, &until).unwrap();
                let error = |(x, exact): (&Limbs<4>, &str)| {
                    let mut error = *x;
                    error.subtract(&number(exact));
                    error.log10_abs()
                };
                integrator.state().q().iter().zip(exact).map(error).fold(f64::NEG_INFINITY, f64::max)
            });
            let order = (coarse - fine) / std::f64::consts::LOG10_2;
            println!("{name}: {coarse} {fine} {order}");
            assert!((order - 6.0).abs() < 0.4, "{name}: {order}");
        }
    }
}
