//! The units of a program, in texts.

use shadowstep_schemes::symbolic::decimal::significant;

/// The units of a program: those of the numbers that it gives, and the unit in which times are printed.
///
/// ```
/// use shadowstep::shadow::recorded::Units;
///
/// // ASE has eV, Å and Å √(u/eV), which is 10.18 fs
/// let units = Units { energy: "eV".into(), time: Some(("fs".into(), 10.180_505)) };
/// # let _ = units;
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Units {
    /// Of energies; empty for none.
    pub energy: String,
    /// In which times are printed, and how many of it a unit of the program's time has.
    pub time: Option<(String, f64)>,
}

impl Units {
    /// A space and the unit, after a number.
    pub(super) fn energy(&self) -> String {
        if self.energy.is_empty() { String::new() } else { format!(" {}", self.energy) }
    }

    /// A time.
    pub(super) fn time(&self, time: f64) -> String {
        match &self.time {
            None => format!("{} of time", significant(time, 5)),
            Some((unit, of_unit)) => format!("{} {unit}", significant(time * of_unit, 5)),
        }
    }
}
