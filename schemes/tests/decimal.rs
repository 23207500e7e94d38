//! Rationals as text and back, and rounding.

use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use proptest::prelude::*;
use shadowstep_schemes::symbolic::decimal::{from_text, round_significant, significant, to_significant, to_text};
use shadowstep_schemes::symbolic::{Rational, exact};

fn ratio(text: &str) -> Rational {
    text.parse().unwrap()
}

fn power_of_ten(exponent: u32) -> BigInt {
    BigInt::from(10).pow(exponent)
}

#[test]
fn the_text_is_the_form_easiest_to_read() {
    let table = [
        ("0", "0"),
        ("-3", "-3"),
        ("7/24", "7/24"),
        ("-1/10000", "-1/10000"),
        ("1/3", "1/3"),
        ("1/100000", "0.00001"),
        ("-215/1000000", "-0.000215"),
        ("1234567/100000", "12.34567"),
        ("-1/16384", "-0.00006103515625"),
        ("1/10007", "1/10007"),
        ("7/30000", "7/30000"),
    ];
    for (value, expected) in table {
        assert_eq!(to_text(&ratio(value)), expected);
    }
}

#[test]
fn four_hundred_places_are_the_most() {
    let places = |count| Rational::new(1.into(), power_of_ten(count));
    assert_eq!(to_text(&places(400)), format!("0.{}1", "0".repeat(399)));
    assert_eq!(to_text(&places(401)), format!("1/1{}", "0".repeat(401)));
}

#[test]
fn denominators_of_twos_and_fives_are_decimals() {
    // 5^27 is the largest power in 64 bits
    for (twos, fives, others) in [(14, 0, 1), (0, 27, 1), (0, 28, 1), (3, 54, 1), (70, 60, 1), (0, 27, 3), (64, 81, 7)]
    {
        let denominator = (BigInt::from(5).pow(fives) << twos) * others;
        let value = Rational::new(11.into(), denominator);
        let text = to_text(&value);
        assert_eq!(text.contains('.'), others == 1, "{text}");
        assert_eq!(from_text(&text).unwrap(), value, "{text}");
    }
}

#[test]
fn only_numbers_are_read() {
    for (text, expected) in [("+5", "5"), ("-7/24", "-7/24"), ("-0.25", "-1/4"), ("1e-3", "1/1000"), (".5/2.5", "1/5")]
    {
        assert_eq!(from_text(text).unwrap(), ratio(expected), "{text}");
    }
    let wrong = ["", "-", "--1", "1/", "/2", "1/0", "1/-2", "1/2/3", "x", "1 ", "2*3", "e5", ".", "1e10001", "½"];
    // the least and the largest i64, and one beyond
    let exponents = ["1e-9223372036854775808", "1e9223372036854775807", "1e-9223372036854775809"];
    for text in wrong.into_iter().chain(exponents) {
        let error = from_text(text).expect_err(text);
        let reason = "is not a number: write an integer, a decimal such as -0.25 or a fraction such as 7/24";
        assert_eq!(error.to_string(), format!("`{text}` {reason}"));
    }
}

#[test]
fn significant_digits_for_messages() {
    let table = [
        ("0", 3, "0"),
        ("593812/1000000", 6, "0.593812"),
        ("1/3", 4, "0.3333"),
        ("2/3", 4, "0.6667"),
        ("-2/3", 1, "-0.7"),
        ("1/2", 6, "0.5"),
        ("1/10000", 3, "0.0001"),
        ("9999/100000000", 4, "9.999e-5"),
        ("99999/1000000000", 4, "0.0001"),
        ("-63/100000000000000000", 2, "-6.3e-16"),
        ("123456789", 3, "123000000"),
        ("999999999", 20, "999999999"),
        ("999999999", 3, "1e9"),
        ("1000000000", 3, "1e9"),
        ("25", 1, "20"),
        ("35", 1, "40"),
        ("-25", 1, "-20"),
        ("12345/100", 4, "123.4"),
        ("12355/100", 4, "123.6"),
        ("7", 0, "7"),
    ];
    for (value, digits, expected) in table {
        assert_eq!(to_significant(&ratio(value), digits), expected, "{value} to {digits}");
    }
}

fn rational() -> impl Strategy<Value = Rational> {
    let denominators = prop_oneof![
        1u64..20_000,
        any::<u64>().prop_map(|n| n.max(1)),
        (0u32..30, 0u32..13).prop_map(|(twos, fives)| 2u64.pow(twos) * 5u64.pow(fives)),
    ];
    (any::<i128>(), 0u32..128, denominators).prop_map(|(n, shift, d)| Rational::new((n >> shift).into(), d.into()))
}

proptest! {
    #[test]
    fn what_was_written_is_read_back(value in rational()) {
        let text = to_text(&value);
        prop_assert_eq!(&from_text(&text).unwrap(), &value);
        prop_assert_eq!(&exact(&text).unwrap(), &value);
    }

    #[test]
    fn rounding_gives_the_nearest_decimal(value in rational(), digits in 1u32..40) {
        let rounded = round_significant(&value, digits);
        if value.is_zero() {
            prop_assert!(rounded.is_zero());
            return Ok(());
        }
        // The unit of the last digit, found by trial: 10^(digits-1) <= |value| / unit < 10^digits.
        let mut unit = Rational::new(power_of_ten(40), power_of_ten(80 + digits));
        while value.abs() / &unit >= power_of_ten(digits).into() {
            unit *= BigInt::from(10);
        }
        let error = (&rounded - &value).abs() / &unit;
        let half = Rational::new(1.into(), 2.into());
        let count = &rounded / &unit;
        prop_assert!(count.is_integer());
        prop_assert!(error <= half);
        prop_assert!(error < half || !count.to_integer().bit(0), "a tie goes to the even digit");
        prop_assert_eq!(ratio_of(&to_significant(&value, digits as usize)), rounded);
    }
}

#[test]
fn numbers_of_any_size_have_their_digits() {
    let texts = [2.1, -0.0123456, 1.2345e-7, 123_456.7, 9.99996e5, f64::NAN].map(|value| significant(value, 4));
    assert_eq!(texts, ["2.100", "-0.01235", "1.235e-7", "123457", "1.000e6", "NaN"]);
    assert_eq!([0.0, 5e-324].map(|value| significant(value, 2)), ["0.0", "4.9e-324"]);
}

fn ratio_of(text: &str) -> Rational {
    from_text(text).unwrap()
}
