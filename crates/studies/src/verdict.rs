//! Whether results agree with a statement.

use std::fmt;

/// The result of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The results agree with the statement, with all of their uncertainty.
    Agrees,
    /// They contradict it, with all of their uncertainty.
    Differs,
    /// Their uncertainty, or what was computed, allows both: why, and what would decide it, in a sentence.
    NotDecided(&'static str),
}

/// Of values that a quick report does not compute.
const PART: &str = "Only some of the values are computed; without `--quick` all are.";

/// Of an interval with values on both sides of a limit.
pub(crate) const INTERVAL: &str = "The 95 % interval allows both; more step sizes would narrow it.";

/// Of nothing.
const NOTHING: &str = "There is no value to compare; more step sizes, as without `--quick`, may give some.";

impl Verdict {
    /// What several verdicts are together: one difference is one, and what is not decided leaves the whole so.
    pub fn of_all(all: impl IntoIterator<Item = Verdict>) -> Verdict {
        let all: Vec<_> = all.into_iter().collect();
        match () {
            () if all.contains(&Verdict::Differs) => Verdict::Differs,
            () if all.is_empty() => Verdict::NotDecided(NOTHING),
            // the first reason stands for all
            () => all.into_iter().find(|verdict| verdict.reason().is_some()).unwrap_or(Verdict::Agrees),
        }
    }

    /// Why it is not decided, and what would decide it.
    pub fn reason(self) -> Option<&'static str> {
        if let Verdict::NotDecided(reason) = self { Some(reason) } else { None }
    }

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Differs => "differs",
            Verdict::NotDecided(_) => "not decided",
        }
    }
}

/// For what is computed without uncertainty.
impl From<bool> for Verdict {
    fn from(holds: bool) -> Self {
        if holds { Verdict::Agrees } else { Verdict::Differs }
    }
}

/// Which of the values that a statement is about were computed: all of the grid of a full report, or some of them.
///
/// What some of the values cannot decide is not decided, so that no verdict on a coarse grid contradicts the one on the
/// whole grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Coverage {
    /// All of them.
    All,
    /// Some of them.
    Some,
}

impl Coverage {
    /// A statement about every value: one value contradicts it, and only all of them confirm it.
    pub(crate) fn every(self, holds: bool) -> Verdict {
        self.unless_partial(holds, Verdict::Agrees)
    }

    /// A statement that there is a value: one confirms it, and only all of them contradict it.
    pub(crate) fn any(self, holds: bool) -> Verdict {
        self.unless_partial(holds, Verdict::Differs)
    }

    /// A statement that some of the values decide neither way.
    pub(crate) fn only_all(self, verdict: impl Into<Verdict>) -> Verdict {
        if self == Coverage::All { verdict.into() } else { Verdict::NotDecided(PART) }
    }

    /// The verdict, which is not decided if it is the one that needs all values.
    fn unless_partial(self, holds: bool, needs_all: Verdict) -> Verdict {
        let verdict = Verdict::from(holds);
        if verdict == needs_all { self.only_all(verdict) } else { verdict }
    }
}

/// How many verdicts there are of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Those that agree.
    pub agree: usize,
    /// Those that differ.
    pub differ: usize,
    /// Those that are not decided.
    pub not_decided: usize,
}

impl Counts {
    /// Counts these verdicts.
    pub fn of(all: impl IntoIterator<Item = Verdict>) -> Counts {
        let mut counts = Counts::default();
        for verdict in all {
            match verdict {
                Verdict::Agrees => counts.agree += 1,
                Verdict::Differs => counts.differ += 1,
                Verdict::NotDecided(_) => counts.not_decided += 1,
            }
        }
        counts
    }

    /// How many there are in all.
    pub(crate) fn all(&self) -> usize {
        self.agree + self.differ + self.not_decided
    }
}

impl fmt::Display for Counts {
    /// `9 agree, 1 differs, 0 not decided`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verb = |count: usize, one: &'static str, many: &'static str| if count == 1 { one } else { many };
        let Counts { agree, differ, not_decided } = *self;
        let (agrees, differs) = (verb(agree, "agrees", "agree"), verb(differ, "differs", "differ"));
        write!(f, "{agree} {agrees}, {differ} {differs}, {not_decided} not decided")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For every set of four values and each part of it.
    #[test]
    fn a_part_of_the_values_never_contradicts_all_of_them() {
        let holds = |set: u32, part: u32| (0..4).filter(move |n| part >> n & 1 == 1).map(move |n| set >> n & 1 == 1);
        let [mut decided, whole] = [0, 0b1111];
        for (set, part) in (0..16).flat_map(|set| (0..16).map(move |part| (set, part))) {
            let every = |coverage: Coverage, of: u32| coverage.every(holds(set, of).all(|holds| holds));
            let any = |coverage: Coverage, of: u32| coverage.any(holds(set, of).any(|holds| holds));
            for (some, all) in [
                (every(Coverage::Some, part), every(Coverage::All, whole)),
                (any(Coverage::Some, part), any(Coverage::All, whole)),
            ] {
                assert!(all.reason().is_none() && (some == all || some.reason() == Some(PART)), "{set} {part}");
                decided += u32::from(some == all);
            }
        }
        assert!(decided > 0, "a part can decide");
        assert_eq!(Coverage::Some.only_all(false), Verdict::NotDecided(PART));
    }

    #[test]
    fn one_difference_is_one_and_nothing_decides_nothing() {
        use Verdict::{Agrees, Differs, NotDecided};
        let open = NotDecided("a reason");
        assert_eq!(Verdict::of_all([Agrees, open, Differs]), Differs);
        assert_eq!(Verdict::of_all([Agrees, open, NotDecided(PART)]), open);
        assert_eq!(Verdict::of_all([Agrees, Agrees]), Agrees);
        assert_eq!(Verdict::of_all([]), NotDecided(NOTHING));
        assert_eq!(Counts::of([Agrees, open, Agrees]).to_string(), "2 agree, 0 differ, 1 not decided");
        assert_eq!(Counts::of([Agrees, Differs]).to_string(), "1 agrees, 1 differs, 0 not decided");
    }
}
