//! The table of rules: what moves the energy of a recorded trajectory.

use super::cause::Cause;
use super::diagnosis::Diagnosis;
use super::thresholds::LEAST_ESTIMATES;
use crate::shadow::rules::Rule;

/// The cause is that of the first row whose condition holds.
const RULES: [Rule<Diagnosis, Cause>; 16] = [
    Rule(
        |d| (d.estimates < LEAST_ESTIMATES).then_some(Cause::Undecided),
        "not decided: there are {estimates} estimates, and {least estimates} are needed: log more states",
    ),
    Rule(|d| d.is_of_other_steps().then_some(Cause::OtherSteps), "{other steps}"),
    Rule(
        |d| d.is_too_large_a_step().then_some(Cause::TimeStep),
        "the time step is too large: H − H̄, the method's part of the energy error, ranges over {method}, {method in T} \
         of T",
    ),
    // H̄ did not move beyond its errors
    Rule(
        |d| (d.is_conserved() && !d.may_cancel()).then_some(Cause::Nothing),
        "the modified energy is conserved: it is known to {known}, and {moved}",
    ),
    Rule(
        |d| (d.is_at_rest() && d.is_of_rounding()).then_some(Cause::Digits),
        "the modified energy is known to {known} only, as the states are stored with few digits: q to {digits} of itself",
    ),
    Rule(|d| d.may_cancel().then_some(Cause::Undecided), "{undecided}"),
    Rule(
        |d| d.noise_of_energy().map(|size| Cause::NoisyEnergy { size }),
        "the modified energy is known to {known} only, as the logged U has errors of {short size} rms that are \
         independent from state to state; the states do not show that anything moves the energy",
    ),
    // the steps, then U, then the forces
    Rule(|d| d.is_moved_by_other_steps().then_some(Cause::OtherSteps), "{other steps}"),
    Rule(|d| d.forces().is_none().then_some(Cause::Undecided), "{undecided}"),
    Rule(
        |d| d.size_of_jumps().map(|size| Cause::Jumps { size }),
        "{moved}: it jumps {places}, by {size} rms. A list of neighbours that is renewed too late does that, or a state \
         that is changed",
    ),
    Rule(
        |d| d.is_not_the_gradient().then_some(Cause::NotTheGradient),
        "{moved}: the forces are smooth, and are not −U_q of the logged U",
    ),
    Rule(
        |d| d.is_energy_not_smooth().then_some(Cause::EnergyNotSmooth { size: d.in_a_step }),
        "{moved}: U jumps all the time, by {size} rms in a step, as where a potential is truncated",
    ),
    Rule(
        |d| d.noise_of_forces().map(|size| Cause::Noise { size }),
        "{moved}: the forces have errors that are independent from step to step, of {size} rms in each component, \
         {part of forces} of the forces",
    ),
    Rule(|d| d.has_kinks().then_some(Cause::ForcesNotSmooth), "{moved}: the forces are not smooth, as at a cutoff"),
    Rule(
        |d| d.is_of_large_steps().then_some(Cause::TimeStep),
        "{moved}: the forces are smooth, and the time step is too large for them",
    ),
    Rule(|_| Some(Cause::Undecided), "{undecided}"),
];

/// Why nothing is decided: the first row whose condition holds.
const WHY_UNDECIDED: [Rule<Diagnosis, ()>; 7] = [
    Rule(|d| d.excess.is_none().then_some(()), "not decided: no forces are logged"),
    Rule(
        |d| d.may_cancel().then_some(()),
        "not decided: {moved}, to and fro, or with steps that do not resolve the motion; estimates are means over nine \
         states, in which what U jumps by, or forces that are not −U_q, may cancel; steps of half the size tell whether \
         anything does",
    ),
    Rule(
        |d| d.has_large_jumps().then_some(()),
        "not decided: {moved}, it jumps {places}, by as much as the kinetic energy; look at these states: steps that are \
         too large there do that, or a state that is changed",
    ),
    Rule(
        |d| d.excess.is_some_and(|excess| excess > 1.0).then_some(()),
        "not decided: {moved}, by more than errors of the forces explain: U jumps, or the forces are not −U_q; steps of \
         half the size tell these apart",
    ),
    Rule(
        |d| d.is_independent().then_some(()),
        "not decided: {moved}, independently from step to step: the forces have errors, or are not smooth, or the steps \
         are too large; steps of half the size tell these apart",
    ),
    Rule(
        |d| (!d.is_resolved()).then_some(()),
        "not decided: {moved}, with steps that do not resolve the motion: that moves it, or hides what does; steps of \
         half the size tell these apart",
    ),
    Rule(
        |_| Some(()),
        "not decided: {moved}, and the estimates have errors of {known}; more states, or steps of half the size, may \
         decide it",
    ),
];

impl Diagnosis {
    /// The cause of the first rule whose condition holds, and its sentence.
    pub(super) fn decision(&self) -> (Cause, &'static str) {
        Rule::first(&RULES, self).expect("the last row always holds")
    }

    pub(super) fn why_undecided(&self) -> &'static str {
        Rule::first(&WHY_UNDECIDED, self).map_or("", |((), sentence)| sentence)
    }

    /// The same with its cause.
    pub(super) fn judged(self) -> Diagnosis {
        Diagnosis { cause: self.decision().0, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::super::observer::Observer;
    use super::{RULES, WHY_UNDECIDED};
    use crate::StepSize;
    use crate::shadow::rules::filled;

    #[test]
    fn every_name_in_a_sentence_stands_for_something() {
        let found = Observer::new(&StepSize::try_from(0.1).unwrap(), &[1.0]).unwrap().diagnosis();
        for sentence in RULES.map(|rule| rule.1).into_iter().chain(WHY_UNDECIDED.map(|rule| rule.1)) {
            let reason = filled(sentence, |name| found.named(name));
            assert!(!reason.contains(['{', '}']), "{reason}");
        }
    }
}
