//! Every shipped table, as the attribute compiles it and as it is read at run time.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use shadowstep::steps::scheme::Sequence;
use shadowstep::systems::kinetic::{General, Quadratic};
use shadowstep::tables::{self, TableScheme};
use shadowstep::{Number, Rational, Scheme, SchemeProperties, ValidFor, splitting_scheme};
use shadowstep_schemes::First;
use shadowstep_schemes::scheme::Held;

use crate::steps::Steps;

/// Does something with every shipped scheme that is valid for a class of kinetic energies.
pub trait Visitor<C = Quadratic> {
    /// Takes the generated scheme of one table. `first` is what the attribute was given.
    fn visit<S: Scheme + ValidFor<C> + Copy + 'static>(&mut self, name: &str, first: Option<First>, scheme: &'static S);
}

include!(concat!(env!("OUT_DIR"), "/shipped.rs"));

/// A shipped scheme in both forms.
pub struct Shipped<N: 'static, C: 'static = Quadratic> {
    /// Name, and whether the roles of kick and drift are exchanged.
    pub name: String,
    /// What the generated code states of itself.
    pub summary: SchemeProperties<'static>,
    /// The maps of a step, as it lists them.
    pub sequence: Sequence<'static>,
    /// What the attribute wrote.
    pub generated: Steps<N, C>,
    /// The same table read at run time.
    pub twin: TableScheme<C>,
}

impl<N, C> Shipped<N, C> {
    /// The k for which a step of 2^−k shows an order best in a computation with this number of digits: as small a step
    /// as the digits of the table allow. A table with D digits moves at order 3 or so by 10^−D, which must stay far
    /// below the error C h^{p+1}.
    pub fn halvings(&self, order: u32, computed: u32) -> u32 {
        match self.twin.proved().scheme.held {
            Held::Digits(digits) if order > 2 && digits < computed => {
                (f64::from(digits.saturating_sub(5)) / std::f64::consts::LOG10_2 / f64::from(order - 2)) as u32
            }
            _ => u32::MAX,
        }
        .clamp(1, 10)
    }
}

struct Collect<'a, N: Number + 'static, C: 'static> {
    found: Vec<Shipped<N, C>>,
    h: &'a Rational,
    context: &'a N::Context,
    twin: fn(&str, Option<First>) -> TableScheme<C>,
}

impl<N: Number + 'static, C: 'static> Visitor<C> for Collect<'_, N, C> {
    fn visit<S: Scheme + ValidFor<C> + Copy + 'static>(
        &mut self,
        name: &str,
        first: Option<First>,
        scheme: &'static S,
    ) {
        self.found.push(Shipped {
            name: format!("{name} (first: {first:?})"),
            summary: scheme.summary(),
            sequence: scheme.sequence(),
            generated: Steps::of(*scheme, self.h, self.context),
            twin: (self.twin)(name, first),
        });
    }
}

/// All shipped schemes with steps of size h. The order of `first = "drift"` ones was proved again.
pub fn all<N: Number + 'static>(h: &Rational, context: &N::Context) -> Vec<Shipped<N>> {
    let mut collect = Collect { found: Vec::new(), h, context, twin };
    for_each(&mut collect);
    collect.found
}

/// Those whose order holds for every T(p), as schemes that are valid for any.
pub fn all_for_every_kinetic<N: Number + 'static>(h: &Rational, context: &N::Context) -> Vec<Shipped<N, General>> {
    let twin = |name: &str, first| twin(name, first).for_every_kinetic().expect("it is listed");
    let mut collect = Collect { found: Vec::new(), h, context, twin };
    for_each_for_every_kinetic(&mut collect);
    collect.found
}

/// All shipped schemes, read at run time. What the generated code does is compared with them.
pub fn twins() -> impl Iterator<Item = (String, TableScheme)> {
    NAMES.iter().map(|&(name, first)| (format!("{name} (first: {first:?})"), twin(name, first)))
}

/// A shipped table, read at run time; proved once for all tests of a program.
pub fn twin(name: &str, first: Option<First>) -> TableScheme {
    static PROVED: Mutex<BTreeMap<(String, bool), TableScheme>> = Mutex::new(BTreeMap::new());
    let mut proved = PROVED.lock().unwrap_or_else(PoisonError::into_inner);
    proved.entry((name.to_owned(), first.is_some())).or_insert_with(|| read_twin(name, first)).clone()
}

fn read_twin(name: &str, first: Option<First>) -> TableScheme {
    let source = shadowstep_schemes::shipped(name).expect("it is listed");
    tables::read(&source, &|base, _| shadowstep_schemes::shipped(base), first).expect("it was compiled")
}
