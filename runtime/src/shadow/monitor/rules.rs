//! The tables of rules: of the windows of a monitor, and of a whole run.

use super::evidence::Evidence;
use super::thresholds::SMALL_ERROR;
use super::verdict::{Criterion, Missing, Verdict};
use super::whole_run::{OfRun, is_large};
use crate::shadow::rules::{KINETIC_LIMIT, Rule};

const ENERGY_ERROR: Verdict = Verdict::TooLarge(Criterion::EnergyError);
const LOST: Verdict = Verdict::TooLarge(Criterion::Lost);
const TOO_SHORT: Verdict = Verdict::Undecided(Missing::Windows);
const UNRESOLVED: Verdict = Verdict::Undecided(Missing::Resolution);

const WHY_LOST: &str = "{lost} at the start, and no longer does: the steps do not resolve it, however little of the \
    energy it has";

/// The verdict on windows is that of the first row whose condition holds.
pub(super) const OF_WINDOWS: [Rule<Evidence, Verdict>; 22] = [
    Rule(|e| (!e.finite).then_some(Verdict::TooLarge(Criterion::NotFinite)), "{not finite}: the steps diverge"),
    Rule(
        |e| e.has_few_windows().then_some(TOO_SHORT),
        "a verdict needs {least windows} windows, and there are {windows}",
    ),
    Rule(
        |e| e.mismatches.then_some(Verdict::Inconsistent),
        "in {mismatches} of {windows} windows the states differ from the increments of the steps: plain steps were \
         made where needs_increments() is true, or q or p were changed between the steps",
    ),
    Rule(
        |e| e.wrong_rate.then_some(Verdict::Inconsistent),
        "in {wrong rates} windows the rate is not qᵀU_q − 2U: compare them (in Rust with check_potential). A virial by \
         nearest images is not qᵀU_q",
    ),
    Rule(
        |e| (e.moves_as_no_scheme_does() || e.is_far_from_the_energy()).then_some(Verdict::Inconsistent),
        "the states do not belong to the increments, or the rate is not qᵀU_q − 2U (compare them, in Rust with \
         check_potential): H − H̄ is {method} rms, and H̄ moved by {move}, too much beside an energy error of \
         {energy error}",
    ),
    // an energy error of 0 has no parts; 0 of 0 is at rest, or from one turning point to the next
    Rule(|e| (e.is_still() && e.lost).then_some(LOST), WHY_LOST),
    Rule(|e| e.is_still().then_some(Verdict::Bounded), "{bounded}"),
    Rule(|e| e.of_kinetic.is_nan().then_some(ENERGY_ERROR), "{too large}"),
    // where the energy grows without limit, its round-off does
    Rule(|e| (e.is_round_off() && e.lost && e.of_kinetic >= KINETIC_LIMIT).then_some(ENERGY_ERROR), "{too large}"),
    Rule(|e| (e.is_round_off() && e.lost).then_some(LOST), WHY_LOST),
    Rule(
        |e| e.is_round_off().then_some(Verdict::RoundOff),
        "{moved}, and round-off makes {round-off}: for this energy a larger step size is sufficient{resolved}, or more \
         digits are needed",
    ),
    Rule(
        Evidence::resonance,
        "{moved}, and the fastest motion turns once in {turn} steps, near {resonance} turns a step: use another step \
         size",
    ),
    Rule(|e| (e.of_kinetic >= KINETIC_LIMIT).then_some(ENERGY_ERROR), "{too large}"),
    Rule(
        |e| e.drifts().then_some(Verdict::Drifts),
        "{moved}, linearly in time: by {change} in all, where round-off makes {expected}. The scheme conserves it, so \
         the cause is a force that is not −U_q, a state that is changed between the steps, or a resonance; compare \
         gradient, energy and rate (in Rust with check_potential)",
    ),
    Rule(
        |e| (e.excludes_a_change() && e.follows_the_energy()).then_some(Verdict::NotTheGradient),
        "the modified energy changes from state to state as the energy does, which no scheme does: the forces are not \
         its gradient, or something else acts; compare gradient, energy and rate (in Rust with check_potential)",
    ),
    // however little of the energy a coordinate has
    Rule(|e| (e.excludes_a_change() && e.lost).then_some(LOST), WHY_LOST),
    Rule(|e| e.excludes_a_change().then_some(Verdict::Bounded), "{bounded}"),
    Rule(
        |e| e.rough.then_some(Verdict::NotSmooth),
        "{size}, most of it from forces that are not smooth; in {steps} steps {permanent}",
    ),
    Rule(
        |e| (e.grows() && e.of_kinetic < SMALL_ERROR).then_some(Verdict::NotConserved),
        "{size}, and {moved}, permanently, where round-off makes {round-off}: the error grows with the length of the \
         run. A smaller step resolves encounters better; forces that are not smooth, or something other than the \
         scheme, have such effects, too",
    ),
    // a wrapped angle or a changed momentum changes H̄, too
    Rule(
        |e| e.grows().then_some(Verdict::TooLarge(Criterion::Moved)),
        "{moved}, permanently, where round-off makes {round-off}: no modified energy is conserved. Forces that are not \
         smooth, or something other than the scheme that changed the state, have such effects, too",
    ),
    Rule(
        |e| e.permanent_move().and(Some(UNRESOLVED)),
        "{size}, of which in {steps} steps {permanent change} were a permanent change; {turns}and the cause may be the \
         step size, forces that are not smooth, or something other than the scheme that changed the state: a longer \
         run, and windows of 17 states or more, would tell",
    ),
    Rule(
        |_| Some(UNRESOLVED),
        "{size}, but {known}, and {bound} is excluded: a run {length} times as long may tell, or a smaller \
         step{estimator}",
    ),
];

/// Where H of all states changes the verdict on the windows: the first row whose condition holds.
pub(super) const OF_RUN: [Rule<OfRun, Verdict>; 5] = [
    Rule(
        |e| (e.found == TOO_SHORT && is_large(e.run.largest)).then_some(ENERGY_ERROR),
        "the energy error is {largest of all} of the mean kinetic energy",
    ),
    Rule(
        |e| (e.is_well() && !e.run.transformed && is_large(e.run.last)).then_some(ENERGY_ERROR),
        "at the end the energy error is {last of all} of the mean kinetic energy before",
    ),
    Rule(|e| (e.is_well() && is_large(e.of_kinetic)).then_some(ENERGY_ERROR), "{too large}"),
    // what windows show is little of the error: they miss a pericentre
    Rule(|e| e.is_no_round_off().then_some(Verdict::Bounded), "{bounded}"),
    Rule(
        |e| e.hardly_changes().then_some(UNRESOLVED),
        "the energy error is {range of all} of T, of which in {steps} steps {permanent of all} % were a permanent \
         change: a longer run may tell",
    ),
];

#[cfg(test)]
mod tests {
    use super::super::change::Change;
    use super::super::report::Report;
    use super::super::trend::Trend;
    use super::super::turning::Turning;
    use super::super::verdict::Advice;
    use super::*;
    use crate::shadow::{Bilinear, ShadowEnergy};
    use crate::steps::tables::shipped;
    use crate::systems::problems::Kepler;
    use crate::{Motion, Stepper, UnitMasses};

    const BOUNDED: Evidence = Evidence {
        moved: 1e-9,
        resolution: 1e-9,
        excluded: 4e-9,
        worst_error: 1e-9,
        energy_change: None,
        modified_change: None,
        kick: 1e-14,
        round_off: 1e-12,
        offset: 0.0,
        error_rms: 1e-9,
        distance: 1.0,
        last_term: 1.0,
        of_kinetic: 0.1,
        action: 1.0,
        turning: None,
        turns: 100.0,
        fastest_angle: None,
        lost: false,
        trend: Some(Trend::RandomWalk),
        straight: false,
        rough: false,
        has_errors: true,
        moves: true,
        mismatches: false,
        wrong_rate: false,
        finite: true,
        windows: Verdict::LEAST_WINDOWS,
    };

    impl Evidence {
        fn verdict(&self) -> Verdict {
            Rule::first(&OF_WINDOWS, self).expect("the last row always holds").0
        }
    }

    const MOVES: Verdict = Verdict::TooLarge(Criterion::Moved);

    fn turning(steps: f64, irregular: f64) -> Option<Turning> {
        Some(Turning { angle: std::f64::consts::TAU / steps, irregular, round_off: 0.0 })
    }

    #[test]
    fn each_threshold_decides() {
        let moved = |moved| Evidence { moved, excluded: moved + 3e-9, ..BOUNDED }.verdict();
        assert_eq!(BOUNDED.verdict(), Verdict::Bounded);
        assert_eq!(Evidence { windows: 15, ..BOUNDED }.verdict(), Verdict::Undecided(Missing::Windows));
        assert_eq!(
            [0.24, 0.26, 0.49, 0.5, 1.6].map(moved),
            [Verdict::Bounded, UNRESOLVED, UNRESOLVED, MOVES, UNRESOLVED]
        );
        assert_eq!(Evidence { of_kinetic: 0.4, ..BOUNDED }.verdict(), Verdict::TooLarge(Criterion::EnergyError));
        let small = Evidence { moved: 0.5, excluded: 0.5, of_kinetic: 0.04, ..BOUNDED };
        assert_eq!(small.verdict(), Verdict::NotConserved);
        let moves = Evidence { moved: 0.6, excluded: 0.6, ..BOUNDED };
        let others = [
            Evidence { worst_error: 0.3, ..moves },
            Evidence { has_errors: false, ..moves },
            Evidence { trend: Some(Trend::Steady), ..moves },
        ];
        assert_eq!(others.map(|other| other.verdict()), [UNRESOLVED; 3]);
        assert_eq!(Evidence { rough: true, ..moves }.verdict(), Verdict::NotSmooth);
        assert_eq!(Evidence { turning: turning(20.0, 0.0), ..moves }.verdict(), UNRESOLVED, "not by the step size");
        assert_eq!(
            Evidence {
                distance: 0.05,
                last_term: 1e-3,
                error_rms: 0.1,
                rough: true,
                turning: turning(20.0, 0.0),
                ..BOUNDED
            }
            .verdict(),
            Verdict::NotTheGradient
        );
    }

    /// What no estimate resolves the means of H may exclude, whichever estimator there is.
    #[test]
    fn the_means_of_the_energy_decide_what_estimates_do_not() {
        let blind = Evidence { moved: 0.0, resolution: 500.0, excluded: 1900.0, worst_error: 500.0, ..BOUNDED };
        let by = |value, error| Evidence { energy_change: Some(Change { value, error, of_ends: 0.0 }), ..blind };
        assert_eq!([by(0.02, 0.05).verdict(), by(0.02, 0.09).verdict()], [Verdict::Bounded, UNRESOLVED]);
        assert_eq!(by(0.02, 0.05).bound(), Some(0.02 + 3.0 * 0.05));
        let advice = Evidence { turning: turning(20.0, 0.0), ..by(0.0, 0.1) }.advice(8);
        // 1.2 (0.3/0.25)² is 1.7; sin²(π/10) = 1/10.5, and ln(500 · 20)/ln 10.5 is 3.9
        assert_eq!(advice, Advice { length: 2, order: Some(12) });
        assert_eq!(Evidence { turning: turning(3.9, 0.0), ..by(0.0, 0.1) }.advice(8).order, None);
    }

    #[test]
    fn a_move_that_round_off_explains_is_round_off() {
        let of = |moved, round_off| Evidence { moved, excluded: moved + 3e-9, round_off, ..BOUNDED }.verdict();
        assert_eq!(of(0.6, 0.1), Verdict::RoundOff);
        assert_eq!(of(0.2, 0.1), Verdict::Bounded, "the energy error is the method's, mostly");
        assert_eq!(of(0.6, 0.05), MOVES);
        // a short run: estimates are off by several kicks, while few have moved the energy
        let short = Evidence { worst_error: 0.6, kick: 0.1, round_off: 0.3, ..BOUNDED };
        assert_eq!(short.verdict(), Verdict::RoundOff);
        let lost = |of_kinetic| Evidence { lost: true, of_kinetic, ..short }.verdict();
        assert_eq!(lost(0.39), Verdict::TooLarge(Criterion::Lost));
        assert_eq!(lost(0.4), Verdict::TooLarge(Criterion::EnergyError), "the energy grows, and its round-off with it");
    }

    #[test]
    fn a_resonance_is_a_move_and_a_regular_turn() {
        let of = |moved, turning| Evidence { moved, excluded: moved + 3e-9, turning, ..BOUNDED }.verdict();
        assert_eq!(of(0.3, turning(4.05, 0.0)), Verdict::NearResonance { turns: 1, steps: 4 });
        assert_eq!(of(0.3, turning(2.52, 0.0)), Verdict::NearResonance { turns: 2, steps: 5 });
        assert_eq!(of(1e-9, turning(4.05, 0.0)), Verdict::Bounded);
        assert_eq!(of(0.6, turning(4.05, 0.3)), MOVES);
        assert_eq!(of(0.6, turning(4.5, 0.0)), MOVES);
    }

    #[test]
    fn what_the_scheme_cannot_have_done() {
        assert_eq!(
            Evidence { finite: false, windows: 3, ..BOUNDED }.verdict(),
            Verdict::TooLarge(Criterion::NotFinite)
        );
        assert_eq!(Evidence { mismatches: true, ..BOUNDED }.verdict(), Verdict::Inconsistent);
        assert_eq!(Evidence { moved: 1001.0, turning: turning(20.0, 0.0), ..BOUNDED }.verdict(), Verdict::Inconsistent);
        // of a circle in 20 steps θ²T/12 is some 0.8 of this energy error
        let off = |offset| Evidence { offset, of_kinetic: 1e-2, turning: turning(20.0, 0.0), ..BOUNDED };
        assert_eq!([off(1.6).verdict(), off(1.7).verdict()], [BOUNDED.verdict(), Verdict::Inconsistent]);
        assert_eq!(Evidence { turns: 0.9, ..off(1.7) }.verdict(), BOUNDED.verdict(), "H has not come back yet");
        // round-off of p may have made θ² smaller by as much as it is
        let unsure = off(1.7).turning.map(|turning| Turning { round_off: turning.angle.powi(2), ..turning });
        let unsure = |offset| Evidence { turning: unsure, ..off(offset) };
        assert_eq!([unsure(3.2).verdict(), unsure(3.4).verdict()], [BOUNDED.verdict(), Verdict::Inconsistent]);
        // H − H̄ of forces that are not smooth; θ²T/6 is 16 of an energy error of 1e-3
        let rough = |distance, of_kinetic| Evidence { rough: true, distance, error_rms: 1.0, of_kinetic, ..off(0.0) };
        assert_eq!(
            [rough(2.9, 1e-2).verdict(), rough(3.1, 1e-2).verdict()],
            [BOUNDED.verdict(), Verdict::Inconsistent]
        );
        assert_eq!(
            [rough(16.0, 1e-3).verdict(), rough(17.0, 1e-3).verdict()],
            [BOUNDED.verdict(), Verdict::Inconsistent]
        );
        assert_eq!(Evidence { turns: 0.9, ..rough(17.0, 1e-3) }.verdict(), BOUNDED.verdict());
        assert_eq!(Evidence { resolution: 0.6, excluded: 1.8, ..off(1.7) }.verdict(), UNRESOLVED);
        assert_eq!(
            Evidence { action: 0.3, ..off(1.7) }.verdict(),
            BOUNDED.verdict(),
            "more than a third of a turn a step"
        );
        let drift = |moved| Evidence { moved, straight: true, ..BOUNDED }.verdict();
        assert_eq!([drift(1e-4), drift(1e-2), drift(0.2)], [Verdict::Bounded, Verdict::Drifts, Verdict::Drifts]);
    }

    #[test]
    fn no_energy_error_at_all_is_bounded() {
        let infinite = f64::INFINITY;
        let free = Evidence { moved: infinite, kick: infinite, round_off: infinite, of_kinetic: 0.0, ..BOUNDED };
        assert_eq!(free.verdict(), Verdict::Bounded);
        // at rest: 0 of 0
        let nothing = f64::NAN;
        let rest = Evidence {
            moved: nothing,
            kick: nothing,
            round_off: nothing,
            of_kinetic: nothing,
            moves: false,
            ..BOUNDED
        };
        assert_eq!(rest.verdict(), Verdict::Bounded);
        assert_eq!(Evidence { moves: true, ..rest }.verdict(), Verdict::TooLarge(Criterion::EnergyError));
    }

    #[test]
    fn every_name_in_a_sentence_stands_for_something() {
        let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), 0.1).unwrap();
        let mut motion = Motion::new(Kepler, UnitMasses, [1.0, 0.0], [0.0, 1.0]).unwrap();
        let report = ShadowEnergy::new(stepper, &mut motion, &Bilinear::new(8)).unwrap().report();
        for sentence in OF_WINDOWS.map(|rule| rule.1).into_iter().chain(OF_RUN.map(|rule| rule.1)) {
            let reason = Report { sentence, ..report.clone() }.reason();
            assert!(!reason.contains(['{', '}']), "{reason}");
        }
    }
}
