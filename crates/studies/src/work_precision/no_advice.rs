//! Why there is no advice, in a sentence.

use crate::work_precision::advise::{Advice, AdviceRequest, Choice, Unfinished};
use crate::work_precision::of::Of;

impl Advice<'_> {
    /// Why no scheme is advised; `None` where one is.
    pub fn reason(&self, request: &AdviceRequest<'_>) -> Option<String> {
        let Advice::OutOfReach { least, overflow, part, reference, resolved, in_time, missed, unverified, unfinished } =
            self
        else {
            return None;
        };
        let runs = over(*part);
        let limit = match in_time {
            true => format!("in {}", request.problem.arithmetic.described()),
            false => format!("in a search of {} s", request.seconds),
        };
        let is_position = request.of == Of::Position;
        if let Some((choice, resolved)) = unverified.as_deref() {
            let Choice { scheme, error, .. } = choice;
            return Some(format!(
                "No advice is verified: {}, step {}, is expected to have the error {error} from runs {runs}; over all \
                 of the time errors are known above {resolved} alone, as there was too little time for a better \
                 reference. Use more seconds, or a shorter time.",
                scheme.name,
                choice.step_text()
            ));
        }
        Some(match least {
            _ if *missed > 0 => format!(
                "No advice: runs over all of the time, {missed} of them, were expected to meet the tolerance from \
                    runs {runs}, and missed it. Use more seconds.{}",
                if is_position {
                    ""
                } else {
                    " Errors are parts of |H(0)|: if H(0) is nearly 0, add a constant to the potential."
                }
            ),
            _ if *overflow => format!(
                "No advice {limit}: a state, its energy or its error overflows in every run {runs}, as with steps \
                    that are too large, or numbers that are."
            ),
            Some((error, name)) if is_position && *resolved > request.tolerance => format!(
                "No advice: errors are known above {resolved} alone {runs}, as there was too little time for a better \
                 reference; the smallest one was {error}, of {name}. Use more seconds, a shorter time, or more digits."
            ),
            Some((error, name)) => {
                let more =
                    if *in_time { "more digits" } else { "more seconds, or more digits where round-off is the limit" };
                format!(
                    "No scheme meets the tolerance {limit}: the smallest error was {error}, of {name}, {runs}. Use {more}."
                )
            }
            None if *unfinished != Unfinished::default() => format!("No advice: no error is known {limit}, {runs}."),
            None if is_position && !reference.is_finite() => format!(
                "No advice: there are no positions to compare with {limit}, {runs}. Use a shorter time, or more seconds."
            ),
            None if is_position => format!(
                "No advice: the positions of the reference change by {reference} with its step {runs}, as they do \
                 where the motion is chaotic. Ask for the error of the energy, or for a shorter time."
            ),
            None => format!("No advice: no error is known {runs}."),
        })
    }
}

/// `over all of the time`, `over 1/8 of the time`
pub fn over(part: f64) -> String {
    match part {
        1.0 => "over all of the time".to_owned(),
        part => format!("over 1/{} of the time", (1.0 / part).round()),
    }
}
