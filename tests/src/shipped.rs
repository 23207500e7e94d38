//! Every shipped table, as the attribute compiles it and as it is read at run time.

use shadowstep::tables::{self, TableScheme};
use shadowstep::{Rational, Scheme, Summary, splitting_scheme};
use shadowstep_schemes::First;

use crate::Bits;
use crate::steps::Steps;

/// Does something with every shipped scheme.
pub trait Visitor {
    /// Takes the generated scheme of one table. `first` is what the attribute was given.
    fn visit<S: Scheme>(&mut self, name: &str, first: Option<First>, scheme: &'static S);
}

include!(concat!(env!("OUT_DIR"), "/shipped.rs"));

/// A shipped scheme in both forms.
pub struct Shipped<N: 'static> {
    /// Name, and whether the roles of kick and drift are exchanged.
    pub name: String,
    /// What the generated code says of itself.
    pub summary: Summary<'static>,
    /// What the attribute wrote.
    pub generated: Steps<'static, N>,
    /// The same table read at run time.
    pub twin: TableScheme,
}

/// All shipped schemes with steps of size h. The order of `first = "drift"` ones was proved again.
pub fn all<N: Bits>(h: &Rational, context: &N::Context) -> Vec<Shipped<N>> {
    struct Collect<'a, N: Bits> {
        found: Vec<Shipped<N>>,
        h: &'a Rational,
        context: &'a N::Context,
    }
    impl<N: Bits> Visitor for Collect<'_, N> {
        fn visit<S: Scheme>(&mut self, name: &str, first: Option<First>, scheme: &'static S) {
            self.found.push(Shipped {
                name: format!("{name} (first: {first:?})"),
                summary: scheme.summary(),
                generated: Steps::of(scheme, self.h, self.context),
                twin: twin(name, first),
            });
        }
    }
    let mut collect = Collect { found: Vec::new(), h, context };
    for_each(&mut collect);
    collect.found
}

/// A shipped table, read at run time.
pub fn twin(name: &str, first: Option<First>) -> TableScheme {
    let Some(first) = first else { return tables::shipped(name).expect("it is listed") };
    let source = shadowstep_schemes::shipped(name).expect("it is listed");
    tables::read(&source, &|base, _| shadowstep_schemes::shipped(base), Some(first)).expect("it was compiled")
}
