//! What the user should know about a scene or a run that is not an error.

use std::fmt;
use std::path::PathBuf;

use shadowstep::Rational;
use shadowstep_schemes::counted;
use shadowstep_schemes::symbolic::decimal::{from_text, to_significant};

use crate::run::steps::nearly_equal;
use crate::texts::readable::shortened;

/// Something the user should know; it is not an error.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// The time is not a multiple of the step: the run ends before it.
    EndsEarly {
        /// The time asked for.
        until: Rational,
        /// The step size h.
        h: Rational,
        /// How many steps are made.
        steps: u64,
    },
    /// A condition ends the run, or is not met.
    Ends {
        /// The condition.
        condition: String,
        /// How many steps are made.
        steps: u64,
        /// Whether it is met then.
        is_met: bool,
    },
    /// The scheme's order holds to fewer digits than the run has.
    OrderHoldsTo {
        /// The scheme's name.
        scheme: String,
        /// Its order.
        order: u32,
        /// The digits to which that order holds.
        digits: u32,
    },
    /// A table in a file has the name of a shipped scheme with other weights.
    NameOfShipped {
        /// The file.
        path: String,
        /// The name.
        scheme: String,
    },
    /// A near-integrable scheme is used for three parts or more.
    NearIntegrable {
        /// The scheme's name.
        scheme: String,
        /// Its order there.
        order: u32,
    },
    /// Steps of this size are beyond the stability limit of the scheme.
    Unstable {
        /// The scheme's name.
        scheme: String,
        /// The least hω at which it is unstable; `None` for a scheme too long for its computation.
        limit: Option<String>,
        /// hω for the fastest oscillation.
        h_omega: String,
        /// Its ω.
        omega: String,
        /// Whether U is a quadratic form; else ω is that of the system linearised at its initial state.
        quadratic: bool,
    },
    /// A planet has few kicks in a revolution.
    FewKicks {
        /// The planet with the shortest period.
        planet: String,
        /// The steps of a revolution.
        steps: String,
        /// The kicks of a step.
        kicks: usize,
        /// How many kicks a revolution should have.
        least: f64,
    },
    /// A step with multiple time steps is so long that fast oscillations may be in resonance with the slow kicks.
    Resonant {
        /// The scheme's name.
        scheme: String,
        /// hω of the fastest oscillation of fast forces and T.
        h_omega: String,
        /// Its ω.
        omega: String,
        /// The least hω of a resonance, with slow forces of a hundredth of the stiffness.
        from: String,
    },
    /// Bodies have a property that looks like a mass, and T has masses of 1.
    MassesAreOne {
        /// The property's name.
        property: String,
    },
    /// The energy of a pair changes when its bodies are exchanged.
    AsymmetricPair {
        /// Its formula.
        formula: String,
    },
    /// The energy of pairs jumps at their cutoff.
    AbruptCutoff,
    /// A table of Horizons is of an orbit with forces besides gravity.
    ForcesLeftOut {
        /// The body.
        target: String,
        /// The constants of the forces.
        forces: String,
    },
    /// The run is resumed from a checkpoint.
    Resumed {
        /// The last n with a row in the file.
        n: i64,
        /// The number of steps of the whole run, where it is known before.
        steps: Option<u64>,
    },
    /// The run goes on from the last state of the same scene with an earlier end.
    Prolonged {
        /// The n of that state.
        n: i64,
        /// The number of steps of the whole run, where it is known before.
        steps: Option<u64>,
    },
    /// A run is resumed of which a part was made without a summary.
    SummaryOfPart {
        /// The n of the last state without one.
        n: i64,
    },
    /// There is a checkpoint without a partial file: the run begins at t = 0.
    CheckpointWithoutRows {
        /// The checkpoint.
        checkpoint: PathBuf,
    },
    /// A number of the state cannot be saved.
    NoCheckpoint {
        /// The n of the state.
        n: i64,
    },
    /// A run failed, and its rows stay in a partial file.
    RowsKept {
        /// The partial file.
        partial: PathBuf,
    },
}

impl Note {
    /// Where a run ends that does not end at `until`; `None` if it does.
    pub fn of_end(h: &Rational, steps: u64, until: &Rational) -> Option<Note> {
        (!nearly_equal(&end(h, steps), until)).then(|| Note::EndsEarly { until: until.clone(), h: h.clone(), steps })
    }
}

/// t = n h after n = `steps` steps.
fn end(h: &Rational, steps: u64) -> Rational {
    h * Rational::from_integer(steps.into())
}

/// Of how many steps.
fn of_all(steps: Option<u64>) -> String {
    steps.map_or_else(String::new, |steps| format!(" of {steps}"))
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Note::EndsEarly { until, h, steps } => {
                // all digits of a double: 30 of 0.3333333333333333 do not end at 10
                let end = to_significant(&end(h, *steps), 16);
                let (until, h) = (shortened(until, 20), shortened(h, 20));
                write!(f, "{until} is not a multiple of {h}: the run ends at n = {steps}, t = {end}")
            }
            Note::Ends { condition, steps, is_met: true } => write!(f, "{condition} ends the run at n = {steps}"),
            Note::Ends { condition, steps, is_met: false } => write!(f, "{condition} is not met up to n = {steps}"),
            Note::OrderHoldsTo { .. }
            | Note::NameOfShipped { .. }
            | Note::NearIntegrable { .. }
            | Note::Unstable { .. }
            | Note::FewKicks { .. }
            | Note::Resonant { .. } => f.write_str(&self.of_scheme()),
            Note::MassesAreOne { property } => {
                write!(f, "all masses of T are 1; `masses = \"{property}\"` uses the property {property}")
            }
            Note::AsymmetricPair { formula } => {
                write!(f, "{formula} changes if bodies are exchanged; body i is the one with the smaller number")
            }
            Note::AbruptCutoff => f.write_str(
                "the energy of a pair jumps at the cutoff, so that no scheme conserves it; `cutoff = { at = \"5/2\", \
                 from = 2, derivatives = 3 }` ends it smoothly",
            ),
            Note::ForcesLeftOut { target, forces } => {
                write!(f, "the orbit of {target} has non-gravitational forces ({forces}), which are not in H")
            }
            Note::Resumed { n, steps } => write!(f, "resumed at n = {n}{}", of_all(*steps)),
            Note::Prolonged { n, steps } => {
                let all = of_all(*steps);
                write!(f, "the file is that of an earlier end: the run goes on from its last state, n = {n}{all}")
            }
            Note::CheckpointWithoutRows { checkpoint } => {
                write!(f, "{} has no partial file: the run begins again", checkpoint.display())
            }
            Note::SummaryOfPart { n } => {
                write!(f, "the summary and its verdict are of the steps after n = {n} only: ")?;
                f.write_str("those before were made without a summary")
            }
            Note::NoCheckpoint { n } => {
                write!(f, "no checkpoint at n = {n}: a number is below 1e-10000 or above 1e10000")
            }
            Note::RowsKept { partial } => {
                write!(f, "the rows up to there stay in {} until the next run", partial.display())
            }
        }
    }
}

impl Note {
    /// A note of a scheme, or of its steps.
    fn of_scheme(&self) -> String {
        match self {
            Note::OrderHoldsTo { scheme, order, digits } => {
                let digits = counted(*digits, "digit");
                format!("{scheme} has order {order} to {digits} only; errors below that have a lower order")
            }
            Note::NameOfShipped { path, scheme } => {
                format!("the table in {path} is named {scheme} like a shipped scheme, and has other weights")
            }
            Note::NearIntegrable { scheme, order } => {
                format!("the near-integrable orders of {scheme} are for two parts; for more it has order {order} in h")
            }
            Note::Unstable { scheme, limit, h_omega, omega, quadratic } => {
                let digits = |limit: &String| from_text(limit).map(|limit| format!("{} ", to_significant(&limit, 6)));
                let limit = limit.as_ref().and_then(|limit| digits(limit).ok()).unwrap_or_default();
                let (place, effect) = match quadratic {
                    true => ("", "the steps diverge"),
                    false => ("linearised at the start, ", "the steps may diverge"),
                };
                format!(
                    "{place}the fastest oscillation has omega = {omega}, and h omega = {h_omega} is beyond the \
                     stability limit {limit}of {scheme}: {effect}"
                )
            }
            Note::Resonant { scheme, h_omega, omega, from } => format!(
                "the fastest oscillation of fast forces and T has omega = {omega} at the start, and h omega = \
                 {h_omega}: from {from} on, in intervals of h omega, oscillations are in resonance with the slow \
                 kicks of {scheme}"
            ),
            Note::FewKicks { planet, steps, kicks, least } => {
                let kicks = if *kicks == 1 { "1 kick".to_owned() } else { format!("{kicks} kicks") };
                format!(
                    "{planet} has {steps} steps of {kicks} in a revolution: with fewer than {least} kicks the step \
                     size may be in resonance with the orbit"
                )
            }
            other => other.to_string(),
        }
    }
}
