//! The keys of a scene: a row for each, from which all else is made.

mod output;
mod system;

use crate::document::schema::{CONDITION, Kind, NONZERO, NUMBER, PATH, Section};
use crate::rows;
use crate::run::arithmetic::MOST_DIGITS;
use crate::run::steps::MOST_STEPS;

pub(crate) use output::OUTPUT;
pub use system::PROBLEM;
pub(crate) use system::{BODY, INITIAL, TIME};

/// The sections that describe a system.
pub(crate) const OF_SYSTEM: [&Section; 4] = [&PROBLEM, &BODY, &INITIAL, &TIME];
/// The sections of a scene, in the order of the explanation.
pub const SECTIONS: [&Section; 7] = [&PROBLEM, &BODY, &INITIAL, &TIME, &RUN, &OUTPUT, &ENSEMBLE];

pub(crate) const RUN: Section = Section::new(
    "[run]",
    "The scheme, its steps, and the number type.",
    rows! {
        scheme: Kind::Text("scheme") => "\"yoshida4\"",
            "A shipped scheme, or the file of a table; its path is relative to the scene's folder. `shadowstep \
                schemes` lists the shipped schemes.";
        gradient_kicks: Kind::Word(&["exact", "displaced"]) => "\"displaced\"",
            "How gradient kicks are made: \"exact\", from second derivatives, or \"displaced\", by a force at \
             displaced positions, which is not exactly symplectic.",
            else "\"exact\"";
        first: Kind::Word(&["kick", "drift"]) => "\"drift\"",
            "What a step begins with: \"kick\" or \"drift\".",
            else "that of the table";
        step: NONZERO => "\"1/20\"",
            "The step size h, nonzero; negative to go back in time. With [time] it is a step of s.";
        until: NUMBER => "100",
            "The time at which the run ends. If it is not a multiple of h, the run ends at the last multiple before \
             it. With [time] it is a physical time, and the run ends there by a last step of the exact remainder: a \
             row more, which is always written.",
            else "none; `steps` are given instead";
        end: CONDITION => "\"x^2 + y^2 > 100\"",
            "A condition that ends the run at the first state after t = 0 that meets it: one comparison of formulas \
             in the coordinates, momenta and parameters, t and the energy E. `until` or `steps` is the end if it is \
             not met.",
            else "none; the run ends with `until` or `steps`";
        steps: Kind::Whole(1, MOST_STEPS) => "2000",
            "The number of steps, in place of `until`.",
            else "none; `until` is given instead", excludes ["until"];
        digits: Kind::Any(&[Kind::Whole(1, MOST_DIGITS as u64), Kind::Word(&["double", "compensated", "double-double"])]) => "120",
            "The decimal digits of all numbers, or \"double\" for double precision, or \"compensated\" for double \
             precision in which positions and momenta are sums with remainders: less round-off in long runs, for up \
             to half more time; or \"double-double\" for sums of two doubles, about 32 digits, for 4 to 9 times the \
             time of double precision.",
            else "\"double\"";
        mpfr: Kind::Truth => "true",
            "MPFR's numbers, also for up to 307 digits, for which numbers of some limbs of 64 bits take less time. \
                Requires a number of `digits`.",
            else "false";
    },
)
.one_of("until|steps");

pub(crate) const ENSEMBLE: Section = Section::new(
    "[ensemble]",
    "Makes many trajectories of the scene, which differ in initial values and parameters. `shadowstep run` computes \
     them in vectors of the processor and on all cores, and writes a row for each: its state at the end, the largest \
     |H - H(0)|/|H(0)|, and max - min of the modified energy, if [output] has `modified_energy`.",
    rows! {
        columns: Kind::Names(&Kind::List(&NUMBER)) => "{ x0 = [1, 1.1, \"3/2\"] }",
            "Names, each with a list of one number for each trajectory. All numbers and formulas of [problem] and \
                [initial] can contain the names.",
            else "none; a `file` is given instead";
        file: PATH => "\"starts.csv\"",
            "A file of CSV in place of `columns`: a line of names, then a line of numbers for each trajectory. Its \
             path is relative to the scene's folder.",
            else "none; `columns` are given instead", excludes ["columns"];
    },
)
.one_of("columns|file");

/// The heading of the section that has a key of this name: `[run]`.
pub fn section_with(name: &str) -> Option<&'static str> {
    let all = SECTIONS.into_iter().flat_map(|section| [section].into_iter().chain(section.tables()));
    all.filter(|section| section.find(name).is_some()).map(|section| section.heading).next()
}
