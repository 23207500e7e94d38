//! Schemes read from a table at run time: the twin of the attribute, with the same bits.

use std::marker::PhantomData;
use std::sync::Arc;

pub use shadowstep_schemes::shipped as shipped_source;
pub use shadowstep_schemes::{Fault, Faults, First, NotForManyParts, Proved, Source, shipped_names};
use shadowstep_schemes::{MapKind, StepPlan};
use thiserror::Error;

use crate::Rational;
use crate::number::Number;
use crate::steps::scheme::{Scheme, SchemeProperties, ValidFor};
use crate::steps::weights::Weights;
use crate::systems::kinetic::{General, Quadratic};
use crate::systems::many_parts::ManyParts;
use crate::systems::maps::{Flows, PartOrder, Sequence};

/// A proved scheme with the plan of its step. A clone shares them.
///
/// It is valid for systems with quadratic T; a `TableScheme<General>`, which [`TableScheme::for_every_kinetic`] makes,
/// for all.
#[derive(Debug)]
pub struct TableScheme<Class = Quadratic> {
    proved: Arc<Proved>,
    class: PhantomData<fn() -> Class>,
}

impl<Class> Clone for TableScheme<Class> {
    fn clone(&self) -> Self {
        TableScheme { proved: Arc::clone(&self.proved), class: PhantomData }
    }
}

/// A scheme whose claimed order holds for quadratic T only, requested for a general T(p).
#[derive(Clone, PartialEq, Eq, Error)]
#[error("{name} has {}", match order {
    0 => "gradient kicks, which are for quadratic T only".to_owned(),
    order => format!("order {order_quadratic} for quadratic T only, for a general T(p) order {order}"),
})]
pub struct QuadraticOnly {
    /// The scheme's name.
    pub name: String,
    /// The order proved for every T(p), less than the table claims; 0 of a scheme with gradient kicks.
    pub order: u32,
    /// The order proved for quadratic T.
    pub order_quadratic: u32,
}

shadowstep_schemes::debug_as_text!(QuadraticOnly);

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
    Ok(TableScheme::of(shadowstep_schemes::read_first(source, library, first)?))
}

impl TableScheme {
    fn of(proved: Proved) -> TableScheme {
        TableScheme { proved: Arc::new(proved), class: PhantomData }
    }

    /// The scheme for systems with any T(p).
    ///
    /// ```
    /// use shadowstep::{Motion, Stepper, tables::shipped};
    /// use shadowstep::systems::formula::{FormulaKinetic, FormulaPotential};
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
            return Ok(TableScheme { proved: self.proved, class: PhantomData });
        }
        Err(QuadraticOnly::of(self.proved()))
    }
}

impl QuadraticOnly {
    fn of(proved: &Proved) -> Self {
        QuadraticOnly {
            name: proved.scheme.table.name.value.clone(),
            order: proved.order_for_every_kinetic().map_or(0, |order| order.order),
            order_quadratic: proved.proof.quadratic.order,
        }
    }
}

impl ValidFor<Quadratic> for TableScheme<Quadratic> {}

impl ValidFor<Quadratic> for TableScheme<General> {}

impl ValidFor<General> for TableScheme<General> {}

impl ValidFor<ManyParts> for TableScheme<ManyParts> {}

/// The class of a scheme where that of the system is known at run time only: its steps are made after one of the
/// conversions of [`TableScheme`], which check it.
#[derive(Clone, Copy, Debug)]
pub enum AtRunTime {}

impl TableScheme<AtRunTime> {
    /// The scheme for systems with quadratic T; `None` if its steps are those of three parts and more.
    pub fn for_quadratic(self) -> Option<TableScheme> {
        let has_two_parts = self.proved.proof.many_parts.is_none();
        has_two_parts.then_some(TableScheme { proved: self.proved, class: PhantomData })
    }
}

impl<Class> TableScheme<Class> {
    /// The scheme for systems of [three parts and more](crate::systems::many_parts). The words on three letters are
    /// looked at with each call, which for order 10 takes a moment.
    ///
    /// # Errors
    /// A scheme with gradient kicks, with a processor, or whose order is for quadratic T only.
    pub fn for_many_parts(self) -> Result<TableScheme<ManyParts>, NotForManyParts> {
        Ok(TableScheme { proved: Arc::new(self.proved().for_many_parts()?), class: PhantomData })
    }

    /// The scheme for code in which the class of the system is known at run time only.
    pub fn at_run_time(self) -> TableScheme<AtRunTime> {
        TableScheme { proved: self.proved, class: PhantomData }
    }

    /// The same scheme for numbers of this many digits: irrational weights that are closed forms have 300, and are
    /// rounded to these, up to 5000, and proved again.
    ///
    /// ```
    /// use shadowstep::tables::shipped;
    ///
    /// let at_300_digits = shipped("yoshida4").unwrap();
    /// let at_400_digits = at_300_digits.clone().to_digits(400)?;
    /// assert_ne!(at_300_digits.plan().kicks, at_400_digits.plan().kicks);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Closed forms that take too long to be computed to these digits.
    pub fn to_digits(self, digits: u32) -> Result<Self, Faults> {
        if !self.proved.lacks_digits(digits) {
            return Ok(self);
        }
        Ok(TableScheme { proved: Arc::new(self.proved.to_digits(digits)?), class: PhantomData })
    }

    /// The exact scheme with its proof.
    pub fn proved(&self) -> &Proved {
        &self.proved
    }

    /// The plan of its step.
    pub fn plan(&self) -> &StepPlan {
        &self.proved.plan
    }
}

impl<Class> Scheme for TableScheme<Class> {
    type Weights<N: Number> = Weights<Vec<N>>;

    fn summary(&self) -> SchemeProperties<'_> {
        let Proved { scheme, proof, plan, .. } = &*self.proved;
        let order = self.proved.order_for_every_kinetic().map_or(0, |order| order.order);
        SchemeProperties {
            name: &scheme.table.name.value,
            order,
            order_quadratic: if proof.many_parts.is_some() { order } else { proof.quadratic.order },
            symmetric: proof.symmetric,
            evaluations: plan.evaluations,
        }
    }

    fn exact_weights(&self) -> Weights<Vec<Rational>> {
        let StepPlan { kicks, drifts, middle_weights, gradient_kicks, .. } = self.plan().clone();
        Weights { kicks, drifts, middle_parts: middle_weights, gradient_kicks }
    }

    fn sequence(&self) -> Sequence<'_> {
        Sequence { maps: &self.plan().maps, middle_parts: &self.plan().middle }
    }

    fn processor(&self) -> Vec<(MapKind, Rational)> {
        let maps = self.proved.scheme.processor.iter().flat_map(|processor| &processor.post);
        maps.map(|map| (map.kind, map.weight.clone())).collect()
    }

    fn forward<F: Flows>(&self, weights: &Weights<Vec<F::Number>>, flows: &mut F) {
        apply(self.plan().maps.iter(), self.plan().middle.iter(), weights.view(), flows);
    }

    fn back<F: Flows>(&self, weights: &Weights<Vec<F::Number>>, flows: &mut F) {
        apply(self.plan().maps.iter().rev(), self.plan().middle.iter().rev(), weights.view(), flows);
    }
}

/// Applies maps one after the other, with the middle parts between them.
#[inline(always)]
fn apply<'a, F: Flows>(
    maps: impl Iterator<Item = &'a (MapKind, usize)>,
    mut middle: impl Iterator<Item = &'a usize>,
    weights: Weights<&[F::Number]>,
    flows: &mut F,
) {
    for &(kind, place) in maps {
        match kind {
            MapKind::Kick => flows.kick(&weights.kicks[place]),
            MapKind::Drift => flows.drift(&weights.drifts[place]),
            MapKind::GradientKick => flows.gradient_kick(&weights.gradient_kicks[place]),
        }
        if let Some(&place) = middle.next() {
            flows.middle_parts(&weights.middle_parts[place], PartOrder::after(kind));
        }
    }
}
