//! What estimators give on the exact flow of Kepler's problem, whose energy is −1/2: every error is known.

use std::f64::consts::TAU;

use shadowstep::Number;
use shadowstep::number::CorrectlyRounded;
use shadowstep::problems::problem;
use shadowstep::shadow::BuildEstimator;
use shadowstep::shadow::exact_flow::ExactFlow;
use shadowstep::shadow::run::ShadowRun;

use crate::{rational, step_size};

/// An estimate with its true error.
pub struct Found<N> {
    /// The modified energy.
    pub value: N,
    /// How far it is from −1/2.
    pub off: f64,
    /// The error that is reported.
    pub estimate: N,
    /// The last term, where it is known.
    pub last_term: Option<f64>,
    /// The number of terms or of states.
    pub order: u32,
}

/// The number of steps of size h in an orbit.
pub fn steps_of_an_orbit(h: &str) -> u64 {
    (TAU / f64::from_rational(&rational(h), &())) as u64
}

/// The estimates over an orbit of eccentricity e with steps of size h, from a pericentre on.
///
/// # Panics
/// If the estimator has no errors.
pub fn over_an_orbit<N: CorrectlyRounded>(
    (e, h): (&str, &str),
    settings: &impl BuildEstimator<N>,
    context: &N::Context,
) -> Vec<Found<N>> {
    let set = [("eccentricity".to_owned(), e.to_owned())];
    let setup = problem("kepler").expect("it is shipped").setup(&set, 200).expect("an ellipse");
    let (steps, h) = (steps_of_an_orbit(h), step_size(h));
    let run = ShadowRun::<ExactFlow<N>, _>::of_exact_flow(&setup, &h, steps, settings, context);
    let mut run = run.expect("the settings are valid");
    let (mut all, half) = (Vec::new(), N::from_rational(&rational("1/2"), context));
    while let Some((_, found)) = run.advance().expect("all states are finite") {
        let mut off = found.value.clone();
        off.add(&half);
        all.push(Found {
            value: found.value.clone(),
            off: off.to_f64().abs(),
            estimate: found.error.expect("an estimator with errors").clone(),
            last_term: found.last_term.map(|term| term.to_f64()),
            order: found.order,
        });
    }
    all
}
