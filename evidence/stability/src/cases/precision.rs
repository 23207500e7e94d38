//! The same short run with 16 to 5000 digits.

use serde::{Deserialize, Serialize};
use shadowstep::number::Limbs;
use shadowstep::{Number, Rational, Real};
use shadowstep_scenes::Error;
use shadowstep_scenes::System;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::Begin;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;
use shadowstep_symbolic::decimal::from_text;

use crate::case::Case;
use crate::integrator::{start, step_size, steps_of};
use crate::suite::Suite;
use crate::systems::setup;

/// The case.
pub(super) struct Precision;

/// A scheme with D digits, and with 2D.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    digits: u32,
}

/// What the two runs have in common.
#[derive(Serialize, Deserialize)]
pub(super) enum Agreement {
    /// −log₁₀ of the largest difference; more than 2D for none.
    Digits(f64),
    /// The table has fewer digits, and the run is refused with this message.
    Refused(String),
    /// Twice as many digits are more than the table has.
    NotMeasured,
}

const STEPS: u64 = 20;
/// Digits that the round-off of 20 steps may cost.
const LOST: f64 = 3.0;
/// Double precision, and digits up to the most that irrational values have.
const DIGITS: [u32; 9] = [16, 30, 60, 120, 250, 500, 1000, 2000, 5000];
/// Weights that are fractions, algebraic numbers, and decimals of 250 digits.
const SCHEMES: [&str; 4] = ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b", "kahan-li8"];
const REFUSED: &str = "Nothing was measured; weights with more digits would decide.";

impl Case for Precision {
    const NAME: &'static str = "precision";
    const TITLE: &'static str = "From 16 to 5000 digits";
    const THEORY: &'static str = "A run with D digits agrees with the same run with 2D digits to nearly D digits. \
        Weights that are closed forms have as many digits.";
    const REVISION: u32 = 2;

    type Trial = Trial;
    type Measured = Agreement;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let schemes = suite.schemes_or(&SCHEMES);
        let digits = suite.full_or_quick(&DIGITS[..], &DIGITS[..6]);
        let trial =
            |scheme: &str| digits.iter().map(|&digits| Trial { scheme: scheme.to_owned(), digits }).collect::<Vec<_>>();
        schemes.iter().flat_map(|scheme| trial(&scheme.identity)).collect()
    }

    /// The digits are those of the trials.
    fn arithmetic(_: &Suite) -> Arithmetic {
        Arithmetic::DOUBLE
    }

    fn seconds(_: &Suite, trial: &Trial) -> f64 {
        f64::from(trial.digits).powf(1.6) * 1e-6
    }

    fn measure(suite: &Suite, trial: &Trial, _: Arithmetic, _: Continues<'_>) -> Result<Agreement, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let arithmetics = [trial.digits, 2 * trial.digits].map(Arithmetic::with_digits);
        // without MPFR there are not as many digits
        let [Ok(few), Ok(many)] = arithmetics else { return Ok(Agreement::NotMeasured) };
        let few = if trial.digits == 16 { Arithmetic::DOUBLE } else { few };
        let [short, long] = match [few, many].map(|arithmetic| scheme.clone().fitted(arithmetic)) {
            [Err(refused), _] => return Ok(Agreement::Refused(refused.message)),
            [_, Err(_)] => return Ok(Agreement::NotMeasured),
            [Ok((of_few, _)), Ok((of_many, _))] => {
                [few.compute(Run { scheme: &of_few }), many.compute(Run { scheme: &of_many })]
            }
        };
        let exact = |text: &String| from_text(text).expect("numbers are decimals");
        let difference = |(a, b)| exact(a) - exact(b);
        let log10 = |difference: Rational| Limbs::<2>::from_rational(&difference, &()).log10_abs();
        let largest = short.iter().zip(&long).map(difference).map(log10).fold(f64::NEG_INFINITY, f64::max);
        Ok(Agreement::Digits(if largest.is_finite() { -largest } else { f64::from(3 * trial.digits) }))
    }

    fn judge(suite: &Suite, measured: &[(Trial, Agreement)]) -> Finding {
        let (mut finding, mut curves) = (Finding::default(), Vec::new());
        for chunk in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let named = suite.scheme(&chunk[0].0.scheme);
            let agree = chunk.iter().filter_map(|(trial, agreement)| match agreement {
                Agreement::Digits(digits) => Some((trial.digits, *digits)),
                Agreement::Refused(_) | Agreement::NotMeasured => None,
            });
            let agree: Vec<_> = agree.collect();
            let list: Vec<_> = agree.iter().map(|(digits, agree)| format!("{agree:.0} of {digits}")).collect();
            let refused: Vec<_> =
                chunk.iter().filter(|(_, agreement)| matches!(agreement, Agreement::Refused(_))).collect();
            let mut found = format!("digits that agree with twice as many: {}", list.join(", "));
            if let Some((trial, Agreement::Refused(message))) = refused.first() {
                found += &format!("; {} digits are refused: {message}", trial.digits);
            }
            let holds = agree.iter().all(|(digits, agree)| *agree >= f64::from(*digits) - LOST);
            finding.check(
                &named.name,
                found,
                if agree.is_empty() { Verdict::NotDecided(REFUSED) } else { holds.into() },
            );
            let points =
                agree.iter().map(|(digits, agree)| (f64::from(*digits).log10(), f64::from(*digits) - agree)).collect();
            curves.push(Curve::marked(named.name.clone(), points, curves.len()));
        }
        let (x, y) = (Axis::log10("digits"), Axis::linear("digits lost"));
        finding.chart(
            Chart::new("Digits lost in 20 steps", x, y, curves),
            "Beside the same run with twice as many digits.",
        );
        finding
    }
}

/// Kepler's problem with e = 0.6 for 20 steps of 1/20: q and p as texts.
struct Run<'a> {
    scheme: &'a NamedScheme,
}

impl Computation for Run<'_> {
    type Output = Vec<String>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Vec<String> {
        let digits = N::precision(context).in_digits() + 20;
        let setup = setup("kepler", &[]).problem.setup(&[], digits).expect("the defaults are valid");
        let h = step_size("1/20");
        let steps = steps_of(self.scheme, &h, Begin::Step);
        let mut integrator = start::<N>(&System::of_setup(setup), steps, context);
        integrator.steps(STEPS);
        let state = integrator.state();
        state.q().iter().chain(state.p()).map(N::to_text).collect()
    }
}
