//! Transformed time: the system in q, t and p, p_t.

use num_traits::ToPrimitive;
use serde_json::{Value, json};
use shadowstep::number::CorrectlyRounded;
use shadowstep::systems::transformed_time::{TimeTransformation, TransformedKinetic, TransformedPotential};
use shadowstep::{Kinetic, Motion, MotionError, Number, Potential, Real};

use super::{Class, Needs, ShownCoordinates, Split, State};
use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::{ClassifiedKinetic, EnergyAt, InitialValueProblem};
use crate::texts::refusal::{Refusal, Unsupported};

/// f(T + p_t) and −f(−U): the steps are in a fictitious time.
#[derive(Clone, Copy, Debug)]
pub struct TransformedTime(TimeTransformation);

/// What helps where another scheme is needed.
const COMPOSITION: &str = "use a composition of the leapfrog, such as sofroniou-spaletta6-13";

impl Split for TransformedTime {
    fn needs(&self, _: &InitialValueProblem) -> Needs {
        Needs {
            no_gradient_kicks: Some(Unsupported {
                reason: "but in transformed time no part of H is a quadratic form of the momenta",
                hint: COMPOSITION,
            }),
            // runs that end at a physical time compare it with t of the states of steps, which are the kernel's
            no_processor: Some(Unsupported { reason: "transformed time does not have", hint: COMPOSITION }),
            no_ensembles: Some(Refusal::new(
                "an ensemble has no transformed time: its steps end at different times",
                "remove [time]",
            )),
            ..Needs::of_class(Class::EveryKinetic)
        }
    }

    fn key(&self) -> (&'static str, &'static str) {
        ("time", "transform")
    }

    fn metadata(&self) -> Option<(&'static str, Value)> {
        Some(("time", json!(self.0.to_string())))
    }

    /// q, 0 and p, −H
    fn start<N: Number + 'static>(
        &self,
        problem: &InitialValueProblem,
        (mut q, mut p): State<N>,
        context: &N::Context,
    ) -> State<N> {
        let mut momentum = problem.plain_energy(context)(&q, &p);
        momentum.negate();
        q.push(N::zero(context));
        p.push(momentum);
        (q, p)
    }

    /// Without t and p_t.
    fn shown<N: Number + 'static>(
        &self,
        problem: &InitialValueProblem,
        context: &N::Context,
    ) -> Option<ShownCoordinates<N>> {
        let assign = |own: &[N], shown: &mut [N]| shown.iter_mut().zip(own).for_each(|(shown, own)| shown.assign(own));
        Some(ShownCoordinates::by(problem.q.len(), context, move |(q, p), shown| {
            assign(q, shown.0);
            assign(p, shown.1);
        }))
    }

    fn energy<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        context: &N::Context,
    ) -> EnergyAt<N> {
        let (mut energy, dimension) = (problem.plain_energy(context), problem.q.len());
        Box::new(move |q, p| energy(&q[..dimension], &p[..dimension]))
    }

    fn integrator<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        steps: Steps<'_>,
        state: State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        let potential = TransformedPotential::new(self.0, problem.potential(context));
        match problem.kinetic(context) {
            ClassifiedKinetic::Quadratic(kinetic) => self.of_kinetic(potential, kinetic, steps, state, context),
            ClassifiedKinetic::General(kinetic) => self.of_kinetic(potential, kinetic, steps, state, context),
        }
    }

    fn transformed_time(&self) -> Option<TimeTransformation> {
        Some(self.0)
    }
}

impl TransformedTime {
    /// The parts of a problem in this time; `plain` if they are T(p) and U(q) without it.
    ///
    /// # Errors
    /// A system that is split in another way, or whose U is not negative at its initial state.
    pub fn of(time: TimeTransformation, problem: &InitialValueProblem, plain: bool) -> Result<Self, Refusal> {
        if problem.particles() > 0 {
            return Err(Refusal::new(
                "transformed time is that of an H, which does not contain bodies of mass 0",
                "remove [time], or the bodies of mass 0",
            ));
        }
        if !plain {
            return Err(Refusal::new(
                "transformed time requires the parts T(p) and U(q): others have no explicit flows in it",
                "remove [time]; where `parts` is a word, parts = \"kinetic-potential\" has them",
            ));
        }
        match wrong_sign(problem) {
            Some(message) => Err(Refusal::new(
                message,
                "remove [time]; transformed time is for attraction whose potential is 0 at infinity, as in gravity",
            )),
            None => Ok(TransformedTime(time)),
        }
    }

    /// dt/ds at the initial state.
    pub(crate) fn rate_at_start(&self, problem: &InitialValueProblem) -> f64 {
        let x = -potential_at_start(problem);
        match self.0 {
            TimeTransformation::Logarithmic => x.recip(),
            TimeTransformation::Power(exponent) => x.powf(exponent.value().to_f64().unwrap_or(f64::NAN) - 1.0),
        }
    }

    fn of_kinetic<N: CorrectlyRounded + 'static, K: Kinetic<N> + 'static>(
        &self,
        potential: TransformedPotential<Box<dyn Potential<N>>>,
        kinetic: K,
        steps: Steps<'_>,
        (q, p): State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        let motion = Motion::of_any_energy(potential, TransformedKinetic::new(self.0, kinetic), q, p)?;
        Ok(steps.integrator(steps.for_every_kinetic(), motion.compensated_if(steps.compensated), context))
    }
}

/// Why the initial state has no transformed time.
fn wrong_sign(problem: &InitialValueProblem) -> Option<String> {
    let energy = potential_at_start(problem);
    (energy >= 0.0 || !energy.is_finite()).then(|| {
        format!(
            "transformed time requires a finite U < 0 on the whole orbit, as time runs at a rate that is a function \
                of -U; at t = 0 U is {}",
            energy.to_text()
        )
    })
}

/// U at the initial state, in double precision.
fn potential_at_start(problem: &InitialValueProblem) -> f64 {
    let (q, _) = problem.initial::<f64>(&());
    let mut potential = problem.potential::<f64>(&());
    let mut scratch = vec![0.0; potential.scratch()];
    potential.prepare(&mut scratch, &());
    let mut energy = <f64 as Number>::zero(&());
    potential.update(&q);
    potential.energy(&q, &mut energy, &mut scratch);
    energy
}

#[cfg(test)]
mod tests {
    use crate::watch::observer::testing;

    /// Where all bodies stay within the cutoff, rows are those without one; in one to three dimensions.
    #[test]
    fn pairs_may_have_a_cutoff() {
        let rows = |dimensions: usize, cutoff: &str| {
            let (zeros, row) = (", 0".repeat(dimensions - 1), |x: &str| format!("{x}{}", ", 0".repeat(dimensions - 1)));
            let text = format!(
                "[problem]\npair = \"-1/sqrt(r2 + 1/10)\"\ndimensions = {dimensions}\nbodies = \
                    2\n{cutoff}\n[initial]\nq = [{}, 1{zeros}]\np = [{}, \"-1/3\"{zeros}]\n\
                 [time]\ntransform = \"logarithmic\"\n[run]\nscheme = \"yoshida4\"\nstep = \"1/10\"\nuntil = \
                 2\ndigits = \"double\"\n[output]\nenergy = true\ntrajectory = true",
                row("0"),
                row("0")
            );
            let rows = testing::rows(&testing::read(&text));
            rows[1..].iter().flatten().map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>()
        };
        for dimensions in 1..=3 {
            let (with, without) = (rows(dimensions, "cutoff = 9"), rows(dimensions, ""));
            assert!(with.len() == without.len() && with.len() > 100);
            assert!(with.iter().zip(&without).all(|(a, b)| (a - b).abs() < 1e-13), "{with:?} {without:?}");
        }
    }
}
