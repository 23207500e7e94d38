//! The text of a table → a proved scheme with the plan of its step.

use std::sync::OnceLock;

use crate::document::{Fault, Faults, Source};
use crate::exact;
use crate::library::Library;
use crate::map_kind::First;
use crate::plan::StepPlan;
use crate::proof::{Finding, Order, Proof, findings, prove};
use crate::scheme::{ExactScheme, Held};
use crate::shipped;
use crate::symbolic::MOST_EVALUATED_DIGITS;
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
    /// Claims below what is proved, and decimals that rounding does not explain, with their places.
    pub notes: Vec<Fault>,
    /// Whether the conditions are as close to what is needed as the printed digits of the table are.
    pub has_its_digits: bool,
}

impl Proved {
    /// The order proved for the kinetic energies that the table is meant for; with an inner scheme, for slow forces,
    /// fast forces and T.
    pub fn order(&self) -> &Order {
        self.proof.nested.as_ref().unwrap_or_else(|| self.proof.for_kinetic(self.scheme.table.kinetic))
    }

    /// Whether the order claimed holds for every T(p), whatever kinetic energies the table is meant for. With gradient
    /// kicks it does not: they contain M⁻¹.
    pub fn holds_for_every_kinetic(&self) -> bool {
        self.order_for_every_kinetic().is_some_and(|order| order.order >= self.scheme.table.order.value)
    }

    /// Whether there are irrational weights, all by closed forms, that are rounded to fewer digits than these:
    /// [`to_digits`](Proved::to_digits) gives more.
    pub fn lacks_digits(&self, digits: u32) -> bool {
        let is_closed = |scheme: &ExactScheme| scheme.table.digits.is_none();
        let all_closed = self.scheme.all().into_iter().all(is_closed);
        all_closed && matches!(self.scheme.held, Held::Digits(held) if held < digits)
    }

    /// The same scheme with irrational weights rounded to this number of digits, up to `MOST_EVALUATED_DIGITS`, and
    /// proved again.
    ///
    /// ```
    /// use shadowstep_schemes::{scheme::Held, shipped_proved};
    ///
    /// let proved = shipped_proved("yoshida4").unwrap().to_digits(400).unwrap();
    /// assert_eq!((proved.scheme.held, proved.order().order), (Held::Digits(400), 4));
    /// assert!(proved.order().digits.unwrap() > 390);
    /// ```
    ///
    /// # Errors
    /// Closed forms that take too long to be computed to these digits.
    pub fn to_digits(&self, digits: u32) -> Result<Proved, Faults> {
        let digits = digits.min(MOST_EVALUATED_DIGITS);
        let library = |name: &str, from: &Source| {
            let scheme = self.scheme.all().into_iter().find(|scheme| scheme.table.source == *from)?;
            Some(scheme.component(name)?.table.source.clone())
        };
        let first = Some(self.scheme.first());
        let proved = read_to_digits(&self.scheme.table.source, &library, first, digits)?;
        match self.proof.many_parts {
            Some(_) => Ok(proved.for_many_parts().expect("it was proved with fewer digits")),
            None => Ok(proved),
        }
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
    read_to_digits(source, library, first, exact::DIGITS)
}

fn read_to_digits(source: &Source, library: Library<'_>, first: Option<First>, digits: u32) -> Result<Proved, Faults> {
    // text → cells with their places → exact weights
    let (scheme, mut faults) = exact::scheme_to_digits(source, library, digits);
    let Some(mut scheme) = scheme else { return Err(Faults::of(faults).expect("what is not a scheme has a fault")) };
    if let Some(first) = first.filter(|first| *first != scheme.first()) {
        let without = match () {
            () if scheme.has_gradient_kicks() => Some(("gradient kicks", "a drift has no counterpart of them")),
            () if scheme.inner.is_some() => Some(("an inner scheme", "it is made for the drifts")),
            () => None,
        };
        if let Some((what, why)) = without {
            let Table { source, name, .. } = &scheme.table;
            let message = format!("the roles of kick and drift cannot be exchanged in a scheme with {what}");
            faults.push(source.fault(&name.at, message).hint(format!("{why}: leave `first` out")));
            return Err(Faults::of(faults).expect("there is a fault"));
        }
        scheme = scheme.starting_with(first);
    }
    // weights → order conditions → what is true → the claims that differ from it
    let proof = prove(&scheme);
    let (refused, modest): (Vec<_>, Vec<_>) = findings(&scheme, &proof).into_iter().partition(Finding::is_refused);
    let sentences = |findings: &[Finding<'_>]| findings.iter().map(|f| worded(f, &scheme, &proof)).collect::<Vec<_>>();
    let notes = sentences(&modest);
    let has_its_digits = !modest.iter().any(|finding| matches!(finding, Finding::Unexplained { .. }));
    faults.extend(sentences(&refused));
    match Faults::of(faults) {
        Some(faults) => Err(faults),
        None => Ok(Proved { plan: StepPlan::of(&scheme), scheme, proof, notes, has_its_digits }),
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Tables without `digits` have weights that are fractions or closed forms.
    #[test]
    fn closed_forms_have_any_number_of_digits() {
        let mut count = 0;
        for name in shipped::shipped_names() {
            let proved = shipped_proved(name).unwrap();
            assert_eq!(proved.lacks_digits(400), proved.lacks_digits(u32::MAX), "{name}");
            if !proved.lacks_digits(400) {
                continue;
            }
            count += 1;
            let many = proved.to_digits(400).unwrap_or_else(|faults| panic!("{name}: {faults}"));
            assert_eq!((many.scheme.held, many.order().order), (Held::Digits(400), proved.order().order), "{name}");
            // about as many digits are lost in the conditions as with 300
            let [few, many] = [proved, &many].map(|proved| proved.order().digits.unwrap());
            assert!(many > few + 90 && many > 390, "{name}: {few}, {many}");
        }
        assert!(count > 15, "{count}");
    }
}
