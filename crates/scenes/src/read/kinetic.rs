//! T(p): by masses, or by a formula in the momenta.

use std::ops::Range;
use std::slice::from_ref;

use num_traits::{One, Signed};
use shadowstep_schemes::symbolic::Exact;
use shadowstep_schemes::symbolic::decimal::to_significant;

use super::given::Given;
use super::numbers::Numbers;
use super::reader::Reader;
use crate::run::arithmetic::{ANY_SIZE, Arithmetic};
use crate::scene::{Formula, KineticEnergy};

/// T(p): by its formula, where that is given, or else by these masses.
pub(super) fn kinetic(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    momenta: &[String],
    parameters: &[(String, Exact)],
    masses: Option<Vec<Exact>>,
) -> Option<KineticEnergy> {
    let Some(text) = &given.problem.text("kinetic") else { return Some(KineticEnergy::Masses(masses)) };
    given.state.refuse_velocities(reader, "T is given by `kinetic`");
    match Formula::kinetic(&text.value, momenta, parameters) {
        Ok(formula) => {
            reader.refuse_numbers(text, &formula.meaning().numbers());
            Some(KineticEnergy::Formula(formula))
        }
        Err(error) => {
            let known = momenta.iter().take(3).map(String::as_str).collect::<Vec<_>>().join(", ");
            let more = if momenta.len() > 3 { ", …" } else { "" };
            let renamed = if given.place("pair").is_none() { "; `momenta` gives them other names" } else { "" };
            let help = format!("T is a smooth formula in the momenta {known}{more} and the parameters{renamed}");
            reader.toml.wrong(&text.place(&error.range()), error.to_string(), help)
        }
    }
}

/// The masses, unless all are 1; masses of 1 in place of faulty ones, with which the rest is read.
pub(super) fn masses(reader: &mut Reader<'_>, numbers: &Numbers, values: Vec<Exact>) -> Option<Vec<Exact>> {
    // all masses of a formula have one place
    let mut wrong = None;
    for (index, value) in values.iter().enumerate() {
        let at = numbers.place(index);
        if wrong != Some(at) && check_mass(reader, value, at).is_none() {
            wrong = Some(at);
        }
    }
    (wrong.is_none() && values.iter().any(|mass| !mass.value.is_one())).then_some(values)
}

/// Refuses a mass that is not positive, or not in the range of the number type.
pub(super) fn check_mass(reader: &mut Reader<'_>, mass: &Exact, at: &Range<usize>) -> Option<()> {
    if !mass.value.is_positive() {
        let message = format!("a mass of {} is not positive", reader.arithmetic.text(mass));
        return reader.toml.wrong(at, message, "masses must be positive");
    }
    match reader.arithmetic.mass_out_of_range(from_ref(mass)) {
        Some(mass) => reader.toml.wrong(at, out_of_range(mass, reader.arithmetic), ANY_SIZE),
        None => Some(()),
    }
}

/// The message for a mass that a number type does not hold, or whose inverse it does not.
pub(super) fn out_of_range(mass: &Exact, arithmetic: Arithmetic) -> String {
    let mass = to_significant(&mass.value, 6);
    format!("a mass of {mass} or its inverse overflows or underflows in {}", arithmetic.described())
}
