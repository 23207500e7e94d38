//! Everything that is known about a scheme: a list of facts, each with its key and its value.

use sha2::{Digest, Sha256};
use shadowstep::Rational;
use shadowstep_analysis::Sizes;
use shadowstep_analysis::error::LeadingError;
use shadowstep_analysis::resonance::{REPORTED, resonances};
use shadowstep_analysis::sampling::SamplingError;
use shadowstep_analysis::stability::{MOST_MAPS, Stability};
use shadowstep_analysis::trace::{PhaseError, Trace};
use shadowstep_schemes::proof::Order;
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{Kinetic, Map, MapKind, Orders, Proved, to_significant, to_text};

use crate::texts::object::{Json, Object};

/// Digits of numbers that come from rounded weights, which else are hundreds of digits long.
const SHOWN_DIGITS: usize = 30;

/// A scheme with what its facts are computed from.
pub struct SchemeFacts<'a> {
    /// What is proved of it.
    pub proved: &'a Proved,
    /// Where its steps are stable; `None` for steps of very many maps.
    pub stability: Option<Stability>,
    errors: [LeadingError; 2],
    processed: Option<[LeadingError; 2]>,
}

/// How accurate the steps of a scheme are, or the processed ones: orders and leading errors.
pub struct Accuracy<'a> {
    /// The orders.
    pub orders: Orders<'a>,
    /// The leading errors for every T(p) and for quadratic T.
    pub errors: &'a [LeadingError; 2],
    proved: &'a Proved,
}

/// A fact about orders: its key, and its value.
type OfOrders = (&'static str, fn(&Accuracy<'_>) -> Json);

/// A fact about a scheme: its key, and its value.
type OfScheme = (&'static str, fn(&SchemeFacts<'_>) -> Json);

/// Those of a processed scheme are the effective ones, and beside them those of its kernel, whose steps are made.
const OF_ORDERS: [OfOrders; 11] = [
    // for every T(p), as the two after it; null with gradient kicks, which there are for quadratic T only
    ("order", |a| a.orders.general.map(|order| order.order).into()),
    ("order_digits", |a| a.orders.general.and_then(|order| order.digits).into()),
    ("fails", |a| a.orders.general.and_then(|order| failed(order, a.proved)).into()),
    ("order_quadratic", |a| a.orders.quadratic.order.into()),
    ("order_quadratic_digits", |a| a.orders.quadratic.digits.into()),
    ("fails_quadratic", |a| failed(a.orders.quadratic, a.proved).into()),
    ("near_integrable", |a| a.orders.near_integrable.iter().map(|order| order.order).collect::<Vec<_>>().into()),
    ("effective_error", |a| a.effective_error(Kinetic::Any).into()),
    ("effective_error_quadratic", |a| a.effective_error(Kinetic::Quadratic).into()),
    ("leading_error", |a| leading_error(&a.errors[0]).into()),
    ("leading_error_quadratic", |a| leading_error(&a.errors[1]).into()),
];

/// Exact numbers are texts, with every digit of the weights. The first three, the names, come before the orders.
const OF_SCHEME: [OfScheme; 31] = [
    ("name", |s| s.table().name.value.as_str().into()),
    ("aliases", |s| s.aliases().into()),
    ("title", |s| s.table().title.clone().into()),
    // the map that moves by A of A + εB
    ("dominant", |s| s.table().near_integrable.as_ref().map(|claim| claim.dominant.to_string()).into()),
    ("free", |s| s.table().free.iter().map(|name| name.value.as_str()).collect::<Vec<_>>().into()),
    ("digits", |s| s.proved.scheme.held.digits().into()),
    ("evaluations", |s| s.proved.plan.evaluations.into()),
    // one for each gradient kick
    ("hessian_products", |s| s.proved.plan.hessian_products.into()),
    // products beside the forces, and as many additions; and how many a step carrying β adds
    ("products_per_dimension", |s| s.proved.plan.cost().products_per_dimension.into()),
    ("products_for_beta", |s| s.proved.plan.cost().products_for_beta.into()),
    // rows of the table of weights, those with a 0 included
    ("stages", |s| s.proved.scheme.stages.kick.len().into()),
    ("symmetric", |s| s.proved.proof.symmetric.into()),
    ("first", |s| s.proved.scheme.first().to_string().into()),
    ("kinetic", |s| if s.table().kinetic == Kinetic::Any { "any" } else { "quadratic" }.into()),
    // null, like the gaps and the trace, for steps of very many maps
    ("stability_limit", |s| s.stability.as_ref().map(|stability| stability.limit.as_str()).into()),
    ("unstable_gaps", |s| s.stability.as_ref().map(gaps).into()),
    ("phase_error", |s| phase_error(s.phase_error()).into()),
    // the largest expected error of the energy over 0 < hω < evaluations; null where it is not known, or not bounded
    ("sampling_error", |s| s.sampling_error().and_then(|error| error.largest).into()),
    ("trace", |s| trace(s.proved).into()),
    ("kick_sizes", |s| sizes(s.proved, MapKind::Kick).into()),
    ("drift_sizes", |s| sizes(s.proved, MapKind::Drift).into()),
    ("kick", |s| fractions(&s.proved.scheme.stages.kick).into()),
    // empty where there are none
    ("gradient_kick", |s| fractions(&s.proved.scheme.stages.gradient_kick).into()),
    ("drift", |s| fractions(&s.proved.scheme.stages.drift).into()),
    ("maps", |s| maps(&s.proved.scheme.maps()).into()),
    ("reference", |s| s.table().reference.clone().into()),
    ("doi", |s| s.table().doi.clone().into()),
    ("table_hash", |s| s.table_hash().into()),
    ("notes", |s| s.proved.notes.iter().map(ToString::to_string).collect::<Vec<_>>().into()),
    // null for a scheme that is not processed
    ("processor", |s| processor(s.proved).into()),
    // null for a scheme without an inner one; the other values are of the outer scheme for two parts
    ("inner", |s| inner(s.proved).into()),
];

impl<'a> SchemeFacts<'a> {
    /// Computes what most facts need.
    pub fn of(proved: &'a Proved) -> Self {
        let (errors, processed) = (LeadingError::of(proved), LeadingError::processed(proved));
        SchemeFacts { proved, stability: Stability::of_scheme(proved), errors, processed }
    }

    /// All facts; they take some milliseconds.
    pub fn record(&self) -> Object {
        let mut facts: Vec<_> = OF_SCHEME.iter().map(|(key, value)| (*key, value(self))).collect();
        facts.splice(3..3, self.accuracy().record().0);
        facts.push(("kernel", self.kernel().map(|kernel| kernel.record()).into()));
        Object(facts)
    }

    /// The facts with these keys, in this order, of those that are not of its orders.
    pub fn some(&self, keys: &[&str]) -> Vec<(&'static str, Json)> {
        let fact = |key: &&str| OF_SCHEME.iter().find(|fact| fact.0 == *key);
        keys.iter().filter_map(fact).map(|(key, value)| (*key, value(self))).collect()
    }

    /// The table.
    pub fn table(&self) -> &'a Table {
        &self.proved.scheme.table
    }

    /// Other names under which the scheme is known.
    pub fn aliases(&self) -> Vec<&'a str> {
        self.table().aliases.iter().map(|alias| alias.value.as_str()).collect()
    }

    /// How accurate it is; of a processed scheme after processing, without the cost of outputs.
    pub fn accuracy(&self) -> Accuracy<'_> {
        let (orders, errors) = (self.proved.orders(), self.processed.as_ref().unwrap_or(&self.errors));
        Accuracy { orders, errors, proved: self.proved }
    }

    /// How accurate the steps of a processed scheme are.
    pub fn kernel(&self) -> Option<Accuracy<'_>> {
        let kernel = Accuracy { orders: self.proved.orders_of_steps(), errors: &self.errors, proved: self.proved };
        self.processed.as_ref().map(|_| kernel)
    }

    /// The stability limit as a number.
    pub fn limit(&self) -> Option<f64> {
        self.stability.as_ref()?.limit.parse().ok()
    }

    /// By the forces of a step, Hessian–vector products counted as such.
    pub fn limit_per_force(&self) -> Option<f64> {
        Some(self.limit()? / self.proved.plan.degree() as f64)
    }

    /// The error of the phase of the harmonic oscillator.
    pub fn phase_error(&self) -> PhaseError {
        let Proved { scheme, proof, .. } = self.proved;
        PhaseError::of(&scheme.maps(), scheme.held, proof.quadratic.order)
    }

    /// The largest expected error of the energy of the harmonic oscillator; `None` where it is not known.
    pub fn sampling_error(&self) -> Option<SamplingError> {
        SamplingError::of(self.proved, self.stability.as_ref())
    }

    fn table_hash(&self) -> String {
        Sha256::digest(&self.table().source.text).iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl Accuracy<'_> {
    fn record(&self) -> Object {
        Object(OF_ORDERS.map(|(key, value)| (key, value(self))).into())
    }

    /// The facts with these keys, in this order.
    pub fn some(&self, keys: &[&str]) -> Vec<(&'static str, Json)> {
        let fact = |key: &&str| OF_ORDERS.iter().find(|fact| fact.0 == *key);
        keys.iter().filter_map(fact).map(|(key, value)| (*key, value(self))).collect()
    }

    /// The effective error for a class of kinetic energies: see [`LeadingError::effective`].
    pub fn effective_error(&self, kinetic: Kinetic) -> f64 {
        let [general, quadratic] = self.errors;
        let error = if kinetic == Kinetic::Any { general } else { quadratic };
        error.effective(self.proved.plan.degree())
    }
}

/// The leading error of log(step).
fn leading_error(error: &LeadingError) -> Object {
    let terms = error.terms.iter();
    let terms =
        terms.map(|(bracket, c)| Object(vec![("bracket", bracket.to_string().into()), ("coefficient", (*c).into())]));
    let terms = terms.collect::<Vec<_>>();
    Object(vec![("power", error.power.into()), ("norm", error.norm().into()), ("terms", terms.into())])
}

fn phase_error(PhaseError { coefficient, power }: PhaseError) -> Object {
    Object(vec![("coefficient", coefficient.into()), ("power", power.into())])
}

/// The first condition of the order that fails; its value is known to some digits only where weights are rounded.
fn failed(order: &Order, proved: &Proved) -> Option<Object> {
    let text = |value: &Rational| match proved.scheme.held {
        Held::Digits(_) if to_text(value).len() > SHOWN_DIGITS => to_significant(value, SHOWN_DIGITS),
        _ => to_text(value),
    };
    let (condition, found) = order.failed.as_ref()?;
    Some(Object(vec![
        ("condition", condition.functional.to_string().into()),
        ("order", condition.order.into()),
        ("found", text(found).into()),
        ("needed", text(&condition.needed).into()),
    ]))
}

/// The end of a gap is null beyond 2·(evaluations).
fn gaps(stability: &Stability) -> Vec<Object> {
    let ends = stability.gaps.iter().map(|gap| (gap.from.as_str(), gap.to.as_deref(), gap.width));
    ends.map(|(from, to, width)| Object(vec![("from", from.into()), ("to", to.into()), ("width", width.into())]))
        .collect()
}

fn sizes(proved: &Proved, kind: MapKind) -> Object {
    let Sizes { sum_of_sizes, smallest, largest } = Sizes::of(&proved.scheme.maps(), kind);
    let sizes = [("sum_of_sizes", sum_of_sizes), ("smallest", smallest), ("largest", largest)];
    Object(sizes.map(|(key, size)| (key, to_text(&size).into())).into())
}

fn fractions(weights: &[Rational]) -> Vec<String> {
    weights.iter().map(Rational::to_string).collect()
}

fn maps(maps: &[Map]) -> Vec<Object> {
    let object =
        |Map { kind, weight }: &Map| Object(vec![("map", kind.to_string().into()), ("weight", to_text(weight).into())]);
    maps.iter().map(object).collect()
}

/// The coefficients of the trace polynomial: exact where the weights are.
fn trace(proved: &Proved) -> Option<Vec<String>> {
    let maps = proved.scheme.maps();
    let trace = (maps.len() <= MOST_MAPS).then(|| Trace::of(&maps))?;
    let text = |k| match proved.scheme.held {
        Held::Exactly => to_text(&trace.coefficient(k)),
        Held::Digits(_) => to_significant(&trace.unreduced_coefficient(k), SHOWN_DIGITS),
    };
    Some((0..=trace.degree()).map(text).collect())
}

/// The post-map of a processed scheme, and the evaluations of the forces for an output, and for the pre-map.
fn processor(proved: &Proved) -> Option<Object> {
    let processor = proved.scheme.processor.as_ref()?;
    Some(Object(vec![("evaluations", processor.evaluations().into()), ("post", maps(&processor.post).into())]))
}

/// The inner scheme of multiple time steps, and what is proved of the step of slow forces, fast forces and T.
fn inner(proved: &Proved) -> Option<Object> {
    let inner = proved.scheme.inner.as_ref()?;
    let (maps, _) = inner.step(&proved.scheme.maps());
    // where an oscillation is unstable whose slow forces have a part of the stiffness of the fast ones
    let of_ratio = |parts: i64| {
        let ratio = Rational::new(1.into(), parts.into());
        let gaps = gaps(&resonances(proved, &ratio)?);
        Some(Object(vec![("ratio", to_text(&ratio).into()), ("gaps", gaps.into())]))
    };
    // evaluations of the fast forces, where these depend on q only
    let fast_evaluations = maps.iter().filter(|map| map.kind == MapKind::Drift).count();
    Some(Object(vec![
        ("base", inner.scheme.table.name.value.as_str().into()),
        ("substeps", inner.substeps.into()),
        ("order", proved.order().order.into()),
        ("fast_evaluations", fast_evaluations.into()),
        ("resonances", REPORTED.into_iter().filter_map(of_ratio).collect::<Vec<_>>().into()),
    ]))
}
