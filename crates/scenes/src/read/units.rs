//! Units of length, time and mass, from which the gravitational constant follows.

use shadowstep::{Rational, exact};

use crate::document::schema::Table;

/// Metres: the astronomical unit is exact (IAU 2012, resolution B2).
const LENGTHS: [(&str, &str); 3] = [("AU", "149597870700"), ("km", "1000"), ("m", "1")];

/// Seconds; a year is one of 365.25 days.
const TIMES: [(&str, &str); 3] = [("day", "86400"), ("year", "31557600"), ("s", "1")];

/// G times the mass in m³/s²: nominal values (IAU 2015, resolution B3), and G of CODATA 2018 for a kilogram.
const MASSES: [(&str, &str); 4] =
    [("solar", "1.3271244e20"), ("earth", "3.986004e14"), ("jupiter", "1.2668653e17"), ("kg", "6.67430e-11")];

/// The units of a system in metres and seconds.
#[derive(Clone, Debug)]
pub(super) struct LengthAndTime {
    pub(super) length: Rational,
    pub(super) time: Rational,
}

impl LengthAndTime {
    /// The units with these names.
    pub(super) fn named(length: &str, time: &str) -> Option<Self> {
        Some(LengthAndTime { length: unit(length, &LENGTHS)?, time: unit(time, &TIMES)? })
    }
}

/// The gravitational constant in the units of the table, and these.
pub(super) fn constant(units: &Table<'_, '_>) -> Option<(Rational, LengthAndTime)> {
    let of_system = LengthAndTime::named(units.str("length")?, units.str("time")?)?;
    let LengthAndTime { length, time } = &of_system;
    let constant = unit(units.str("mass")?, &MASSES)? * time * time / (length * length * length);
    Some((constant, of_system))
}

fn unit(name: &str, units: &[(&str, &str)]) -> Option<Rational> {
    let (_, value) = units.iter().find(|(own, _)| *own == name)?;
    Some(exact(value).expect("units are exact numbers"))
}
