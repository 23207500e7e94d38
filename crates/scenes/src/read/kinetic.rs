//! T(p): by masses, or by a formula in the momenta.

use std::slice::from_ref;

use num_traits::{One, Signed};
use shadowstep_symbolic::Exact;
use shadowstep_symbolic::decimal::to_significant;

use super::given::Given;
use super::numbers::Numbers;
use super::reader::Reader;
use crate::arithmetic::{ANY_SIZE, Arithmetic};
use crate::scene::{Formula, KineticEnergy};

/// T(p): by its formula, where that is given, or else by these masses.
pub(super) fn kinetic(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    momenta: &[String],
    parameters: &[(String, Exact)],
    masses: Option<Vec<Exact>>,
) -> Option<KineticEnergy> {
    if given.place("kinetic").is_none() {
        return Some(KineticEnergy::Masses(masses));
    }
    given.state.refuse_velocities(reader, "T is given by `kinetic`");
    let text = given.kinetic.as_ref()?;
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
    let mut last_fault = None;
    for (index, value) in values.iter().enumerate() {
        let positive = value.value.is_positive();
        if positive && reader.arithmetic.mass_out_of_range(from_ref(value)).is_none() {
            continue;
        }
        // all masses of a formula have one place
        let at = numbers.place(index);
        if last_fault.replace(at) != Some(at) {
            let (message, help) = match positive {
                false => {
                    let mass = reader.arithmetic.text(value);
                    (format!("a mass of {mass} is not positive"), "masses must be positive")
                }
                true => (out_of_range(value, reader.arithmetic), ANY_SIZE),
            };
            reader.toml.fault(at, message, help);
        }
    }
    (last_fault.is_none() && values.iter().any(|mass| !mass.value.is_one())).then_some(values)
}

/// The message for a mass that a number type does not hold, or whose inverse it does not.
pub(super) fn out_of_range(mass: &Exact, arithmetic: Arithmetic) -> String {
    let mass = to_significant(&mass.value, 6);
    format!("a mass of {mass} or its inverse overflows or underflows in {}", arithmetic.described())
}
