//! Whether results agree with a statement.

use std::fmt;

/// The result of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// The results agree with the statement, with all of their uncertainty.
    Agrees,
    /// They contradict it, with all of their uncertainty.
    Differs,
    /// Their uncertainty, or what was computed, allows both.
    NotDecided,
}

impl Verdict {
    /// What several verdicts are together: one difference is one, and what is not decided leaves the whole so.
    pub(crate) fn of_all(all: impl IntoIterator<Item = Verdict>) -> Verdict {
        let all: Vec<_> = all.into_iter().collect();
        match () {
            () if all.contains(&Verdict::Differs) => Verdict::Differs,
            () if all.is_empty() || all.contains(&Verdict::NotDecided) => Verdict::NotDecided,
            () => Verdict::Agrees,
        }
    }

    /// The word for it.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Differs => "differs",
            Verdict::NotDecided => "not decided",
        }
    }
}

/// For what is computed without uncertainty.
impl From<bool> for Verdict {
    fn from(holds: bool) -> Self {
        if holds { Verdict::Agrees } else { Verdict::Differs }
    }
}

/// How many verdicts there are of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) agree: usize,
    pub(crate) differ: usize,
    pub(crate) not_decided: usize,
}

impl Counts {
    pub(crate) fn of(all: impl IntoIterator<Item = Verdict>) -> Counts {
        let mut counts = Counts::default();
        for verdict in all {
            match verdict {
                Verdict::Agrees => counts.agree += 1,
                Verdict::Differs => counts.differ += 1,
                Verdict::NotDecided => counts.not_decided += 1,
            }
        }
        counts
    }

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

    #[test]
    fn one_difference_is_one_and_nothing_decides_nothing() {
        use Verdict::{Agrees, Differs, NotDecided};
        assert_eq!(Verdict::of_all([Agrees, NotDecided, Differs]), Differs);
        assert_eq!(Verdict::of_all([Agrees, NotDecided]), NotDecided);
        assert_eq!(Verdict::of_all([Agrees, Agrees]), Agrees);
        assert_eq!(Verdict::of_all([]), NotDecided);
        assert_eq!(Counts::of([Agrees, NotDecided, Agrees]).to_string(), "2 agree, 0 differ, 1 not decided");
        assert_eq!(Counts::of([Agrees, Differs]).to_string(), "1 agrees, 1 differs, 0 not decided");
    }
}
