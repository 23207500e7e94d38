//! Units of length, time and mass, from which the gravitational constant follows.

use shadowstep::{Rational, exact};

use super::horizons::LengthAndTime;
use crate::schema::Table;

/// Metres: the astronomical unit is exact (IAU 2012, resolution B2).
const LENGTHS: [(&str, &str); 3] = [("AU", "149597870700"), ("km", "1000"), ("m", "1")];

/// Seconds; a year is one of 365.25 days.
const TIMES: [(&str, &str); 3] = [("day", "86400"), ("year", "31557600"), ("s", "1")];

/// G times the mass in m³/s²: nominal values (IAU 2015, resolution B3), and G of CODATA 2018 for a kilogram.
const MASSES: [(&str, &str); 4] =
    [("solar", "1.3271244e20"), ("earth", "3.986004e14"), ("jupiter", "1.2668653e17"), ("kg", "6.67430e-11")];

/// The gravitational constant in the units of the table, and these.
pub(super) fn constant(units: &Table<'_, '_>) -> Option<(Rational, LengthAndTime)> {
    let (length, time) = (units.word("length", &LENGTHS), units.word("time", &TIMES));
    let mass = units.word("mass", &MASSES);
    let number = |text: &str| exact(text).expect("units are exact numbers");
    let (length, time) = (number(length?), number(time?));
    let constant = number(mass?) * &time * &time / (&length * &length * &length);
    Some((constant, LengthAndTime { length, time }))
}
