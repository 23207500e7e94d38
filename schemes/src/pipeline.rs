//! The text of a table → a proved scheme with the plan of its step.

use std::sync::OnceLock;

use crate::document::{Fault, Faults, Source};
use crate::exact;
use crate::library::Library;
use crate::map_kind::First;
use crate::plan::StepPlan;
use crate::proof::{Finding, Order, Proof, findings, prove};
use crate::scheme::ExactScheme;
use crate::shipped;
use crate::table::Table;
use crate::wording::worded;

/// A scheme and what was proved of it.
#[derive(Clone, Debug)]
pub struct Proved {
    /// The scheme.
    pub scheme: ExactScheme,
    /// What is true of it.
    pub proof: Proof,
    /// The plan of its step.
    pub plan: StepPlan,
    /// Claims below what is proved, with their places.
    pub notes: Vec<Fault>,
}

impl Proved {
    /// The order proved for the kinetic energies that the table is meant for.
    pub fn order(&self) -> &Order {
        self.proof.for_kinetic(self.scheme.table.kinetic)
    }

    /// Whether the order claimed holds for every T(p), whatever kinetic energies the table is meant for. With gradient kicks it does not:
    /// they contain M⁻¹.
    pub fn holds_for_every_kinetic(&self) -> bool {
        self.order_for_every_kinetic().is_some_and(|order| order.order >= self.scheme.table.order.value)
    }

    /// The order for every T(p); `None` with gradient kicks, which there are for quadratic T only.
    pub fn order_for_every_kinetic(&self) -> Option<&Order> {
        (!self.scheme.has_gradient_kicks()).then_some(&self.proof.general)
    }
}

/// Reads a table and proves what it claims.
///
/// # Errors
/// All faults of the text, of the cells and of the claims; claims are judged once the cells have values.
pub fn read(source: &Source, library: Library<'_>) -> Result<Proved, Faults> {
    read_first(source, library, None)
}

/// Like [`read`], with the roles of kick and drift exchanged where `first` asks for it. This is the whole way from the
/// text to the plan.
///
/// # Errors
/// As [`read`]; also where the order claimed does not survive the exchange.
pub fn read_first(source: &Source, library: Library<'_>, first: Option<First>) -> Result<Proved, Faults> {
    // text → cells with their places → exact weights
    let (scheme, mut faults) = exact::scheme(source, library);
    let Some(mut scheme) = scheme else { return Err(Faults::of(faults).expect("what is not a scheme has a fault")) };
    if let Some(first) = first.filter(|first| *first != scheme.first()) {
        if scheme.has_gradient_kicks() {
            let Table { source, name, .. } = &scheme.table;
            let fault = source
                .fault(&name.at, "the roles of kick and drift cannot be exchanged in a scheme with gradient kicks");
            faults.push(fault.hint("a drift has no counterpart of them: leave `first` out"));
            return Err(Faults::of(faults).expect("there is a fault"));
        }
        scheme = scheme.starting_with(first);
    }
    // weights → order conditions → what is true → the claims that differ from it
    let proof = prove(&scheme);
    let (refused, modest): (Vec<_>, Vec<_>) = findings(&scheme, &proof).into_iter().partition(Finding::is_refused);
    let sentences = |findings: &[Finding<'_>]| findings.iter().map(|f| worded(f, &scheme, &proof)).collect::<Vec<_>>();
    let notes = sentences(&modest);
    faults.extend(sentences(&refused));
    match Faults::of(faults) {
        Some(faults) => Err(faults),
        None => Ok(Proved { plan: StepPlan::of(&scheme), scheme, proof, notes }),
    }
}

/// A shipped table with what was proved of it, by the names that [`crate::shipped`] knows. Each is proved once.
///
/// # Panics
/// If the table's claims do not hold, which the tests of this crate exclude.
pub fn shipped_proved(name: &str) -> Option<&'static Proved> {
    static PROVED: [OnceLock<Proved>; shipped::COUNT] = [const { OnceLock::new() }; shipped::COUNT];
    let index = shipped::index(name)?;
    Some(PROVED[index].get_or_init(|| {
        let proved = read(&shipped::source(index), &|base, _| shipped::shipped(base));
        proved.unwrap_or_else(|faults| panic!("a shipped table:\n{faults}"))
    }))
}
