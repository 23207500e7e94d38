//! Whether a trajectory is chaotic, and whether its step size makes it so.

use serde::{Serialize, Serializer};
use shadowstep::shadow::{Criterion, Verdict};
use shadowstep::tangent::{Exponent, Growth, Regularity};
use shadowstep::{Rational, StepSize};
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::execution::computation::{Computation, RunNumber};
use crate::execution::posed::{Followed, Posed};
use crate::motion::tangent::{TangentRun, Vectors};
use crate::run::Run;
use crate::run::arithmetic::{Arithmetic, DigitsLabel};
use crate::texts::error::Error;
use crate::watch::Energies;
use crate::watch::observer::{Observer, interrupted};
use crate::watch::summary::Summary;

/// Indicators of chaos along a trajectory. Numbers that are not defined, as of too few observations, are `None`.
#[derive(Clone, Debug, Serialize)]
pub struct ChaosRecord {
    /// The name of the scheme.
    pub scheme: String,
    /// The step size.
    pub step: String,
    /// The number of steps.
    pub steps: u64,
    /// The number type.
    pub digits: DigitsLabel,
    /// The length of the trajectory in time; in physical time where time is transformed.
    pub time: f64,
    /// Whether it is regular: see [`Growth::regularity`].
    #[serde(serialize_with = "displayed")]
    pub motion: Regularity,
    /// The largest Lyapunov exponent over the last three quarters of the trajectory.
    pub exponent: Option<f64>,
    /// Its error: see [`Exponent`].
    pub exponent_error: Option<f64>,
    /// The finite-time exponent L(t)/t of the whole trajectory, if there is a step.
    pub lyapunov: Option<f64>,
    /// MEGNO, Y.
    pub megno: f64,
    /// The mean of MEGNO, Ȳ, if there is a step.
    pub mean_megno: Option<f64>,
    /// Its error: see [`Growth::mean_megno_error`].
    pub mean_megno_error: Option<f64>,
    /// SALI of the first two vectors, if there are two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sali: Option<f64>,
    /// GALI of all vectors, if there are three or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gali: Option<f64>,
    /// The exponents of orthonormal vectors, the largest first, each with its error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exponents: Option<Vec<[f64; 2]>>,
    /// The error of H and the verdict of the modified energy.
    pub summary: Summary,
}

impl ChaosRecord {
    fn of(
        (run, arithmetic, vectors): (Run<'_>, Arithmetic, Vectors),
        tangents: &dyn TangentRun,
        summary: Summary,
    ) -> Self {
        let orthonormal = matches!(vectors, Vectors::Orthonormal(_));
        let growths = tangents.growths();
        let (growth, exponent) = (growths[0], growths[0].exponent());
        let each = |growth: &&Growth| growth.exponent().map(|Exponent { value, error }| [value, error]);
        ChaosRecord {
            scheme: run.propagator.to_owned(),
            step: to_text(run.h.exact()),
            steps: run.steps,
            digits: arithmetic.label(),
            time: growth.time(),
            motion: growth.regularity(),
            exponent: exponent.map(|found| found.value),
            exponent_error: exponent.map(|found| found.error),
            lyapunov: growth.lyapunov().filter(|x| x.is_finite()),
            megno: growth.megno(),
            mean_megno: growth.mean_megno().filter(|x| x.is_finite()),
            mean_megno_error: growth.mean_megno_error(),
            sali: tangents.sali(),
            gali: tangents.gali(),
            exponents: orthonormal.then(|| growths.iter().map(each).collect()).flatten(),
            summary,
        }
    }

    /// Whether the motion is undecided, although the run was long enough, and vectors grew far more than along a
    /// regular orbit, where MEGNO is 2.
    fn grows_unsteadily(&self) -> bool {
        const FAR_MORE: f64 = 20.0;
        self.motion == Regularity::Undecided && self.mean_megno_error.is_some() && self.megno > FAR_MORE
    }
}

fn displayed<S: Serializer>(regularity: &Regularity, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(regularity)
}

/// What two runs at h and h/2 say of the problem, in a sentence.
///
/// Exponents of chaotic runs agree if their difference is at most the sum of their errors, or a quarter of the larger
/// one: exponents of finite runs scatter more than their parts do.
pub fn conclusion(whole: &ChaosRecord, half: &ChaosRecord) -> String {
    use Regularity::{Chaotic, Regular};
    let (h, half_step) = (&whole.step, &half.step);
    let too_large = Verdict::TooLarge(Criterion::EnergyError).to_string();
    match (whole.motion, half.motion) {
        (Chaotic, Chaotic) if [whole, half].iter().all(|record| record.summary.verdict == too_large) => {
            "chaotic at both step sizes, which are too large: not decided; try smaller steps".to_owned()
        }
        (Chaotic, Chaotic) if exponents_agree(whole, half) => {
            "chaotic at both step sizes with the same exponent: of the problem".to_owned()
        }
        (Chaotic, Chaotic) => {
            "chaotic at both step sizes, with exponents that differ: try smaller steps, or a longer run".to_owned()
        }
        (Regular, Regular) => "regular at both step sizes; slower chaos than the run shows is possible".to_owned(),
        (Chaotic, Regular) => format!("chaotic at {h} and regular at {half_step}: of the step size"),
        (Regular, Chaotic) => format!("regular at {h} and chaotic at {half_step}: not decided; try smaller steps"),
        _ if [whole, half].iter().any(|record| record.grows_unsteadily()) => {
            "not decided: vectors grew more than along a regular orbit, but not at all times; a longer run shows \
                whether they go on"
                .to_owned()
        }
        _ => "not decided: the run is too short".to_owned(),
    }
}

fn exponents_agree(whole: &ChaosRecord, half: &ChaosRecord) -> bool {
    let [a, b] = [whole, half].map(|record| record.exponent.unwrap_or(f64::NAN));
    let errors = [whole, half].map(|record| record.exponent_error.unwrap_or(f64::NAN)).iter().sum::<f64>();
    (a - b).abs() <= errors.max(a.max(b) / 4.0)
}

/// A run with tangent vectors. Nothing is written.
#[derive(Clone, Copy)]
pub struct ChaosRequest<'a> {
    /// The run.
    pub posed: Posed<'a>,
    /// The vectors.
    pub vectors: Vectors,
    /// Vectors are measured every `every` steps.
    pub every: u64,
}

impl ChaosRequest<'_> {
    /// Makes the run with steps of h/`parts`.
    ///
    /// # Errors
    /// A run that fails, an observer that stops; those of
    /// [`FollowingVectors::new`](crate::motion::tangent::FollowingVectors::new).
    pub fn run(&self, parts: u32, observer: &mut dyn Observer) -> Result<ChaosRecord, Error> {
        let run = self.posed.run;
        let h = StepSize::try_from(run.h.exact() / Rational::from_integer(parts.into())).expect("h is not 0");
        let run = Run { h: &h, steps: run.steps.saturating_mul(parts.into()), ..run };
        let vectors = Some((self.vectors, self.every));
        let posed = Posed { run, vectors, energies: Some(Energies::Windows), summarised: true, ..self.posed };
        posed.arithmetic.compute(Following { posed, vectors: self.vectors, observer })
    }
}

/// The run in any number type.
struct Following<'a, 'o> {
    posed: Posed<'a>,
    vectors: Vectors,
    observer: &'o mut dyn Observer,
}

impl Computation for Following<'_, '_> {
    type Output = Result<ChaosRecord, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let Following { posed, vectors, observer } = self;
        let followed = N::follow(&posed, context, &mut [], observer)?;
        let run = Run { steps: followed.n.unsigned_abs(), ..posed.run };
        let Followed { is_stopped: false, summary: Some(summary), vectors: Some(mut tangents), .. } = followed else {
            return Err(interrupted(run, run.steps));
        };
        Ok(ChaosRecord::of((run, posed.arithmetic, vectors), tangents.end(), summary))
    }
}
