//! The linear part of a system: T(p) + ½qᵀKq with K = U_qq at the origin, and what is left of U.

use num_traits::Signed;
use serde_json::{Value, json};
use shadowstep::number::{AnyLimbs, CorrectlyRounded, LimbCount};
use shadowstep::systems::QUADRATIC_FLOW_DIGITS;
use shadowstep::systems::linear_part::LinearPart;
use shadowstep::{MotionError, Number, Potential, Rational, exact};
use shadowstep_schemes::symbolic::decimal::from_text;

use super::{Class, Needs, Split, State};
use crate::run::arithmetic::Arithmetic;
use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::{InitialValueProblem, KineticEnergy};
use crate::texts::refusal::Refusal;

/// T(p) + ½qᵀKq with this K, row by row, and what is left of U.
#[derive(Clone, Debug)]
pub struct Linear(Vec<Vec<Rational>>);

/// The value of the key `parts` for it.
pub(crate) const LINEAR: &str = "linear";

/// The most coordinates: the flow is computed in time that grows with their third power.
const MOST_COORDINATES: usize = 100;

impl Split for Linear {
    fn needs(&self, _: &InitialValueProblem) -> Needs {
        Needs::of_class(Class::Quadratic)
    }

    fn metadata(&self) -> Option<(&'static str, Value)> {
        Some(("parts", json!(LINEAR)))
    }

    fn integrator<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        steps: Steps<'_>,
        (q, p): State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        let mut system = LinearPart::new(problem.potential(context), &problem.exact_masses(), &self.0, &q, &p)?;
        if let Some(displacements) = steps.displacements(context) {
            system = system.displaced(displacements);
        }
        Ok(steps.integrator(steps.quadratic(), system.compensated_if(steps.compensated), context))
    }

    fn has_dominant_part(&self) -> bool {
        true
    }
}

/// What helps where a system has no linear part.
const CHANGE: &str = "remove `parts`, or change that";

impl Linear {
    /// T(p) + ½qᵀKq with this K, row by row, of a system with as many coordinates, and what is left of U.
    pub fn new(stiffness: Vec<Vec<Rational>>) -> Self {
        Linear(stiffness)
    }

    /// K, row by row.
    pub(crate) fn stiffness(&self) -> &[Vec<Rational>] {
        &self.0
    }

    /// The parts of a system in this arithmetic; `of_bodies` if it is one of bodies that attract each other.
    ///
    /// # Errors
    /// A system that has no linear part, or whose flow is not computed to these digits.
    pub(crate) fn of(problem: &InitialValueProblem, arithmetic: Arithmetic, of_bodies: bool) -> Result<Self, Refusal> {
        let coordinates = problem.q.len();
        let refuse = |message: String| Err(Refusal::new(message, CHANGE));
        match () {
            () if of_bodies => {
                let message = "the attraction between bodies has no linear part";
                return Err(Refusal::new(message, "write parts = \"wisdom-holman\""));
            }
            () if problem.explicit_time => {
                return Err(Refusal::new(
                    "a linear part requires an H that does not depend on t",
                    "give the parts by their formulas: parts = [\"px^2/2 + x^2/2\", \"x^3*cos(t)\"]",
                ));
            }
            () if coordinates > MOST_COORDINATES => {
                return refuse(format!("a linear part has at most {MOST_COORDINATES} coordinates, not {coordinates}"));
            }
            () if matches!(problem.kinetic, KineticEnergy::Formula(_)) => {
                return refuse("a linear part requires T by masses, not by a formula".to_owned());
            }
            () if arithmetic.digits() > QUADRATIC_FLOW_DIGITS => {
                return refuse(format!("a linear part is computed to {QUADRATIC_FLOW_DIGITS} digits"));
            }
            () => {}
        }
        match stiffness(|count| problem.potential::<AnyLimbs>(count)) {
            Some(stiffness) => Ok(Linear(stiffness)),
            None => Err(Refusal::new(
                "U has no second derivatives at q = 0",
                "remove `parts`: the force has no linear part",
            )),
        }
    }
}

/// Differences are of gradients so far apart: their error is of the size of its square, and round-off is less. Those of
/// both distances agree, unless U has no second derivatives there.
const DISTANCES: [&str; 2] = ["1e-60", "2e-60"];

/// How far they may differ as a part of the largest of them, or at all: a U that is finite has less.
const AGREE: [&str; 2] = ["1e-50", "1e-25"];

/// Numbers of 327 digits.
const LIMBS: u32 = 17 * 64;

/// U_qq at q = 0, row by row, exact to some 120 digits; `None` where it has no value.
///
/// The steps need no more: half of qᵀKq is added to one part and subtracted from the other with the same K.
fn stiffness(potential: impl Fn(&LimbCount) -> Box<dyn Potential<AnyLimbs>>) -> Option<Vec<Vec<Rational>>> {
    let count = LimbCount::of_bits(LIMBS)?;
    let mut potential = potential(&count);
    let dimension = potential.dimension();
    let zero = AnyLimbs::zero(count);
    let mut scratch = vec![zero; potential.scratch()];
    potential.prepare(&mut scratch, &count);
    let number = |text: &str| exact(text).expect("a number");
    let mut of_distance = |distance: &str| -> Option<Vec<Vec<Rational>>> {
        let distance = AnyLimbs::from_rational(&number(distance), &count);
        let mut gradient_at = |coordinate: usize, negative: bool| {
            let mut q = vec![zero; dimension];
            q[coordinate].assign(&distance);
            if negative {
                q[coordinate].negate();
            }
            let mut gradient = q.clone();
            potential.update(&q);
            potential.gradient(&q, &mut gradient, &mut scratch);
            gradient
        };
        let column = |coordinate: usize| -> Option<Vec<Rational>> {
            let (after, before) = (gradient_at(coordinate, false), gradient_at(coordinate, true));
            let quotient = |(after, before): (AnyLimbs, AnyLimbs)| {
                let mut quotient = after;
                quotient.subtract(&before);
                quotient.divide(&distance);
                quotient.divide_integer(2);
                quotient.is_finite().then(|| from_text(&quotient.to_text()).ok()).flatten()
            };
            after.into_iter().zip(before).map(quotient).collect()
        };
        (0..dimension).map(column).collect()
    };
    let [columns, others] = [of_distance(DISTANCES[0])?, of_distance(DISTANCES[1])?];
    let largest = columns.iter().flatten().map(Signed::abs).max()?;
    let allowed = (largest * number(AGREE[0])).max(number(AGREE[1]));
    let agree = |(a, b): (&Rational, &Rational)| (a - b).abs() <= allowed;
    if !columns.iter().flatten().zip(others.iter().flatten()).all(agree) {
        return None;
    }
    // symmetric to the last digit
    let two = Rational::from_integer(2.into());
    let mean = |i: usize, j: usize| (&columns[i][j] + &columns[j][i]) / &two;
    Some((0..dimension).map(|i| (0..dimension).map(|j| mean(i, j)).collect()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::problems::problem;

    fn stiffness_of(name: &str) -> Option<Vec<Vec<Rational>>> {
        let setup = problem(name).unwrap().setup(&[], 140).unwrap();
        stiffness(|count| setup.potential::<AnyLimbs>(count))
    }

    #[test]
    fn oscillators_have_second_derivatives_at_the_origin_and_a_centre_of_attraction_has_none() {
        let one = |i: usize, j: usize| Rational::from_integer(i64::from(i == j).into());
        let found = stiffness_of("henon-heiles").unwrap();
        let small = exact("1e-100").unwrap();
        for (i, row) in found.iter().enumerate() {
            assert!(row.iter().enumerate().all(|(j, k)| (k - one(i, j)).abs() < small), "{row:?}");
        }
        assert_eq!(stiffness_of("kepler"), None);
    }
}
