//! The same short run with 16 to 5000 digits.

use shadowstep::Real;
use shadowstep::number::Limbs;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_schemes::symbolic::decimal::from_text;

use crate::stability::prelude::*;
use crate::stability::systems::setup;

/// The case.
pub(super) struct Precision;

/// What a run with D digits and one with 2D have in common.
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
const REFUSED: &str = "Nothing was measured; weights with more digits would decide.";

impl Case for Precision {
    type Measured = Agreement;

    fn seconds(trial: &Trial<'_>) -> f64 {
        trial.get::<f64>("digits").powf(1.6) * trial.seconds()
    }

    fn measure(trial: &Trial<'_>, _: Continues<'_>) -> Result<Agreement, Error> {
        let (scheme, digits) = (trial.scheme(), trial.get::<u32>("digits"));
        let arithmetics = [digits, 2 * digits].map(Arithmetic::with_digits);
        // without MPFR there are not as many digits
        let [Ok(few), Ok(many)] = arithmetics else { return Ok(Agreement::NotMeasured) };
        let few = if digits == 16 { Arithmetic::DOUBLE } else { few };
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
        Ok(Agreement::Digits(if largest.is_finite() { -largest } else { f64::from(3 * digits) }))
    }

    fn judge(all: &[&Done<'_, Agreement>]) -> Vec<Row> {
        let agree = all.iter().filter_map(|one| match one.found {
            Agreement::Digits(digits) => Some((one.trial.get("digits"), digits)),
            Agreement::Refused(_) | Agreement::NotMeasured => None,
        });
        let agree: Vec<(f64, f64)> = agree.collect();
        let list = joined(&agree, ", ", |(digits, agree)| format!("{agree:.0} of {digits}"));
        let refused = all.iter().find_map(|one| match &one.found {
            Agreement::Refused(message) => {
                Some(format!("; {} digits are refused: {message}", one.trial.get::<u32>("digits")))
            }
            _ => None,
        });
        let found = format!("digits that agree with twice as many: {list}{}", refused.unwrap_or_default());
        let holds = agree.iter().all(|(digits, agree)| *agree >= digits - LOST);
        let verdict = if agree.is_empty() { Verdict::NotDecided(REFUSED) } else { holds.into() };
        let points = agree.iter().map(|(digits, agree)| (digits.log10(), digits - agree));
        vec![Row::of(&all[0].trial, found, verdict).with(points)]
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
