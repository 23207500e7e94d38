//! Schemes read from a table at run time: the twin of the attribute, with the same bits.

use std::marker::PhantomData;
use std::sync::Arc;

pub use shadowstep_schemes::shipped as shipped_source;
pub use shadowstep_schemes::{Analysis, Fault, Faults, Proved, Source, analysis, polish, shipped_names};
use shadowstep_schemes::{First, Kinetic, MapKind, Plan};
use thiserror::Error;

use crate::Rational;
use crate::kinetic::{General, Quadratic};
use crate::number::Number;
use crate::scheme::{Scheme, StepWeights, Summary, ValidFor};
use crate::system::System;

/// A proved scheme with the plan of its step. A clone shares them.
///
/// It is valid for systems with quadratic T; a `TableScheme<General>`, which [`TableScheme::for_every_kinetic`] makes, for
/// all.
#[derive(Debug)]
pub struct TableScheme<Class = Quadratic> {
    compiled: Arc<Compiled>,
    class: PhantomData<fn() -> Class>,
}

#[derive(Debug)]
struct Compiled {
    proved: Proved,
    plan: Plan,
}

impl<Class> Clone for TableScheme<Class> {
    fn clone(&self) -> Self {
        TableScheme { compiled: Arc::clone(&self.compiled), class: PhantomData }
    }
}

/// A scheme whose claimed order holds for quadratic T only, requested for a general T(p).
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "{name} has order {order_quadratic} for quadratic T only, for a general T(p) order {order}; use a scheme such as \
     {better}, which has order {better_order} for every T(p)"
)]
pub struct QuadraticOnly {
    /// The scheme's name.
    pub name: String,
    /// The order proved for every T(p), less than the table claims.
    pub order: u32,
    /// The order proved for quadratic T.
    pub order_quadratic: u32,
    /// A shipped scheme for every T(p), of least effective error among those whose order is nearest to the one claimed.
    pub better: String,
    /// Its order.
    pub better_order: u32,
}

/// A shipped scheme by its name or an alias, such as `yoshida4`, `PEFRL`, `BM4`; `None` if there is none.
pub fn shipped(name: &str) -> Option<TableScheme> {
    shadowstep_schemes::shipped_proved(name).cloned().map(TableScheme::of)
}

/// Reads and proves a table; `library` finds the base tables of compositions, `first` exchanges the roles of kick and
/// drift.
///
/// ```
/// use shadowstep::Scheme;
/// use shadowstep::tables::{Source, read, shipped_source};
///
/// let text = r#"
/// name = "mine"
/// order = 4
/// kinetic = "any"
/// reference = "an exercise"
///
/// [constants]
/// g = "1/(2 - 2^(1/3))"
///
/// [composition]
/// base = "stormer-verlet"
/// gamma = ["g", "1 - 2*g", "g"]
/// "#;
/// let source = Source { path: "mine.toml".to_owned(), text: text.to_owned() };
/// let mine = read(&source, &|base, _| shipped_source(base), None).unwrap();
/// assert_eq!(mine.summary().order, 4);
/// ```
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
    Ok(TableScheme::of(proved))
}

impl TableScheme {
    fn of(proved: Proved) -> TableScheme {
        TableScheme { compiled: Arc::new(Compiled { plan: proved.plan(), proved }), class: PhantomData }
    }

    /// The scheme for systems with any T(p).
    ///
    /// ```
    /// use shadowstep::{Motion, Stepper, tables::shipped};
    /// use shadowstep::formula::{FormulaKinetic, FormulaPotential};
    ///
    /// let relativistic = FormulaKinetic::new("sqrt(1 + p^2)", &["p"], &[]).unwrap();
    /// let spring = FormulaPotential::new("q^2/2", &["q"], &[]).unwrap();
    /// let mut motion = Motion::new(spring, relativistic, [1.0], [0.0])?;
    ///
    /// let verlet = shipped("stormer-verlet").unwrap().for_every_kinetic()?;
    /// Stepper::new(verlet, "1/10")?.step(&mut motion);
    /// assert!((motion.energy() - 1.5).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The order that the table claims is proved for quadratic T only.
    pub fn for_every_kinetic(self) -> Result<TableScheme<General>, QuadraticOnly> {
        if self.proved().holds_for_every_kinetic() {
            return Ok(TableScheme { compiled: self.compiled, class: PhantomData });
        }
        Err(QuadraticOnly::of(self.proved()))
    }
}

impl QuadraticOnly {
    fn of(proved: &Proved) -> Self {
        let better = better(proved.scheme.table.order.value);
        QuadraticOnly {
            name: proved.scheme.table.name.value.clone(),
            order: proved.proof.general.order,
            order_quadratic: proved.proof.quadratic.order,
            better_order: better.summary().order,
            better: better.proved().scheme.table.name.value.clone(),
        }
    }
}

/// The shipped scheme of least effective error that is meant for every T(p) and has this order, or the nearest higher one, or else the
/// highest that there is. Only those of one order are proved.
fn better(order: u32) -> TableScheme {
    let claim = |name: &'static str| {
        let table = shadowstep_schemes::parse::table(&shadowstep_schemes::shipped(name)?).0?;
        (table.kinetic == Kinetic::Any).then_some((table.order.value, name))
    };
    let claims: Vec<_> = shipped_names().into_iter().filter_map(claim).collect();
    let orders = || claims.iter().map(|(order, _)| *order);
    let nearest = orders().filter(|higher| *higher >= order).min().or_else(|| orders().max());
    let candidates = claims.iter().filter(|(order, _)| Some(*order) == nearest);
    let schemes = candidates.filter_map(|(_, name)| shipped(name));
    let error = |scheme: &TableScheme| scheme.analysis().effective_error(Kinetic::Any);
    let best = schemes.map(|scheme| (error(&scheme), scheme)).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, scheme)| scheme).expect("there are shipped schemes for every T(p)")
}

impl ValidFor<General> for TableScheme<General> {}

impl<Class> TableScheme<Class> {
    /// The exact scheme with its proof.
    pub fn proved(&self) -> &Proved {
        &self.compiled.proved
    }

    /// How good the scheme is: leading errors, stability, phase error.
    ///
    /// ```
    /// use shadowstep::tables::shipped;
    ///
    /// let verlet = shipped("leapfrog").unwrap().analysis();
    /// assert_eq!(verlet.stability.limit, "2"); // a step of the harmonic oscillator is stable up to hω = 2
    /// ```
    pub fn analysis(&self) -> Analysis {
        Analysis::of(self.proved())
    }

    /// The plan of its step.
    pub fn plan(&self) -> &Plan {
        &self.compiled.plan
    }

    fn run<'a, M: System>(
        &self,
        weights: &[M::Number],
        maps: impl Iterator<Item = &'a (MapKind, usize)>,
        augmented: bool,
        system: &mut M,
    ) {
        let (kicks, drifts) = weights.split_at(self.plan().kicks.len());
        for &(kind, index) in maps {
            match (kind, augmented) {
                (MapKind::Kick, false) => system.kick(&kicks[index]),
                (MapKind::Kick, true) => system.kick_augmented(&kicks[index]),
                (MapKind::Drift, false) => system.drift(&drifts[index]),
                (MapKind::Drift, true) => system.drift_augmented(&drifts[index]),
            }
        }
    }
}

impl<Class> Scheme for TableScheme<Class> {
    type Array<N: Number> = Vec<N>;

    fn summary(&self) -> Summary<'_> {
        let Compiled { proved, plan } = &*self.compiled;
        Summary {
            name: &proved.scheme.table.name.value,
            order: proved.proof.general.order,
            order_quadratic: proved.proof.quadratic.order,
            symmetric: proved.proof.symmetric,
            evaluations: plan.evaluations,
        }
    }

    fn weights<N: Number>(&self, scaled: impl FnMut(&Rational) -> N) -> Vec<N> {
        self.plan().kicks.iter().chain(&self.plan().drifts).map(scaled).collect()
    }

    fn step<M: System>(&self, weights: &StepWeights<Vec<M::Number>>, system: &mut M)
    where
        Self: ValidFor<M::Class>,
    {
        self.run(weights.forward(), self.plan().maps.iter(), false, system);
    }

    fn step_augmented<M: System>(&self, weights: &StepWeights<Vec<M::Number>>, system: &mut M)
    where
        Self: ValidFor<M::Class>,
    {
        system.clear_increments();
        self.run(weights.forward(), self.plan().maps.iter(), true, system);
    }

    fn step_back<M: System>(&self, weights: &StepWeights<Vec<M::Number>>, system: &mut M)
    where
        Self: ValidFor<M::Class>,
    {
        self.run(weights.back(), self.plan().maps.iter().rev(), false, system);
    }

    fn step_back_augmented<M: System>(&self, weights: &StepWeights<Vec<M::Number>>, system: &mut M)
    where
        Self: ValidFor<M::Class>,
    {
        system.clear_increments();
        self.run(weights.back(), self.plan().maps.iter().rev(), true, system);
    }
}
