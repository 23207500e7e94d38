//! Schemes read from a table at run time: the twin of the attribute, with the same bits.

pub use shadowstep_schemes::{Fault, Faults, Proved, Source, shipped_names};
use shadowstep_schemes::{First, MapKind, Plan};

use crate::Rational;
use crate::motion::Maps;
use crate::number::Number;
use crate::scheme::{Scheme, Summary, Weights};

/// A proved scheme with the plan of its step.
#[derive(Clone, Debug)]
pub struct TableScheme {
    proved: Proved,
    plan: Plan,
}

/// A shipped scheme by its name, such as `yoshida4`; `None` if there is none.
pub fn shipped(name: &str) -> Option<TableScheme> {
    let source = shadowstep_schemes::shipped(name)?;
    let library = |base: &str, _: &Source| shadowstep_schemes::shipped(base);
    Some(read(&source, &library, None).expect("shipped tables are proved by the tests"))
}

/// Reads and proves a table; `library` finds the base tables of compositions, `first` exchanges the roles of kick and
/// drift.
///
/// # Errors
/// All faults of the table.
pub fn read(
    source: &Source,
    library: &dyn Fn(&str, &Source) -> Option<Source>,
    first: Option<First>,
) -> Result<TableScheme, Faults> {
    let proved = match first {
        Some(first) => shadowstep_schemes::read_first(source, library, first)?,
        None => shadowstep_schemes::read(source, library)?,
    };
    Ok(TableScheme { plan: proved.plan(), proved })
}

impl TableScheme {
    /// Everything that is known about the scheme.
    pub fn proved(&self) -> &Proved {
        &self.proved
    }

    /// The plan of its step.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    fn run<'a, N: Number, M: Maps<N>>(
        &self,
        weights: &[N],
        maps: impl Iterator<Item = &'a (MapKind, usize)>,
        augmented: bool,
        motion: &mut M,
    ) {
        let expected = self.plan.kicks.len() + self.plan.drifts.len();
        assert_eq!(weights.len(), expected, "these are weights of another scheme");
        let (kicks, drifts) = weights.split_at(self.plan.kicks.len());
        for &(kind, index) in maps {
            match (kind, augmented) {
                (MapKind::Kick, false) => motion.kick(&kicks[index]),
                (MapKind::Kick, true) => motion.kick_augmented(&kicks[index]),
                (MapKind::Drift, _) => motion.drift(&drifts[index]),
            }
        }
    }
}

impl Scheme for TableScheme {
    type Array<N: Number> = Vec<N>;

    fn summary(&self) -> Summary<'_> {
        Summary {
            name: &self.proved.scheme.table.name.value,
            order: self.proved.proof.general.order,
            order_quadratic: self.proved.proof.quadratic.order,
            symmetric: self.proved.proof.symmetric,
            evaluations: self.plan.evaluations,
        }
    }

    fn weights<N: Number>(&self, h: &Rational, context: &N::Context) -> Weights<Vec<N>> {
        Weights::of(self.plan.kicks.iter().chain(&self.plan.drifts), h, context)
    }

    fn step<N: Number, M: Maps<N>>(&self, weights: &Weights<Vec<N>>, motion: &mut M) {
        self.run(&weights.forward, self.plan.maps.iter(), false, motion);
    }

    fn step_augmented<N: Number, M: Maps<N>>(&self, weights: &Weights<Vec<N>>, motion: &mut M) {
        motion.restart_beta();
        self.run(&weights.forward, self.plan.maps.iter(), true, motion);
    }

    fn step_back<N: Number, M: Maps<N>>(&self, weights: &Weights<Vec<N>>, motion: &mut M) {
        self.run(&weights.back, self.plan.maps.iter().rev(), false, motion);
    }

    fn step_back_augmented<N: Number, M: Maps<N>>(&self, weights: &Weights<Vec<N>>, motion: &mut M) {
        motion.restart_beta();
        self.run(&weights.back, self.plan.maps.iter().rev(), true, motion);
    }
}
