//! Decimal text beside MPFR's.

use super::mpfr::{Random, float, same};
use rug::{Assign, Float};
use shadowstep_limbs::{Limbs, ParseError};

fn number<const L: usize>(random: &mut Random) -> Limbs<L> {
    loop {
        let x = random.number::<L>();
        if x.exponent().is_some() {
            return x;
        }
    }
}

fn check<const L: usize>(random: &mut Random) {
    let x = number::<L>(random);
    let value = float(&x);
    let count = 1 + random.below(2 * u64::from(Limbs::<L>::DIGITS)) as u32;
    let (_, digits, point) = value.to_sign_string_exp(10, Some((count as usize).max(2)));
    assert_eq!(x.to_digits(count.max(2)), Some((digits, point.unwrap().into())), "{x:?} to {count} digits");
    let text = format!("{x:.count$}", count = count as usize);
    let mut read = Float::new(64 * L as u32);
    read.assign(Float::parse(&text).unwrap());
    same(&text, &text.parse::<Limbs<L>>().unwrap(), &read, &[&x]);
    same("text", &x.to_text().parse::<Limbs<L>>().unwrap(), &value, &[&x]);
}

#[test]
fn digits_and_reading_are_those_of_mpfr() {
    let random = &mut Random(2);
    for _ in 0..1500 {
        check::<2>(random);
        check::<3>(random);
        check::<7>(random);
    }
    check::<16>(random);
}

#[test]
fn ties_go_to_even() {
    // 2^128 + 1 and 2^128 + 3 are in the middle between two numbers of 128 bits, by decimal exponents of both signs
    for (text, even) in [
        ("340282366920938463463374607431768211457", "340282366920938463463374607431768211456.0"),
        ("340282366920938463463374607431768211459", "340282366920938463463374607431768211460.0"),
        ("34028236692093846346337460743176821145700000e-5", "340282366920938463463374607431768211456.0"),
    ] {
        let read: Limbs<2> = text.parse().unwrap();
        assert_eq!(read, even.parse().unwrap(), "{text}");
    }
    let [mut half, quarter] = [1, 3].map(|n| Limbs::<2>::from(n).over_integer(4));
    half = half.times_integer(2);
    assert_eq!(quarter.to_digits(1), Some(("8".to_owned(), 0))); // 0.75
    assert_eq!((&half + &Limbs::from(2)).to_digits(1), Some(("2".to_owned(), 1))); // 2.5
}

#[test]
fn text_is_the_shortest() {
    for text in
        ["0.1", "-1.25e-30", "2.0", "1e300", "123456789.5", "1e-300000000", "0.001", "NaN", "inf", "-inf", "-0.0"]
    {
        assert_eq!(text.parse::<Limbs<5>>().unwrap().to_text(), text);
    }
    // below a power of two the numbers are closer: what is nearest may not read back, and the next one does
    let random = &mut Random(3);
    for _ in 0..300 {
        let exponent = 100 + random.below(1000) as i32;
        let x = Limbs::<2>::ONE.times_power_of_two(if random.below(2) == 0 { exponent } else { -exponent });
        let text = x.to_text();
        assert_eq!(text.parse::<Limbs<2>>().unwrap(), x);
        let digits = |text: &str| text.split('e').next().unwrap().bytes().filter(u8::is_ascii_digit).count();
        let count = digits(&text);
        // one digit less, rounded down or up, is another number
        let (shorter, point) = x.to_digits(count as u32 - 1).unwrap();
        for change in [-1, 0, 1] {
            let candidate = format!(
                "{}e{}",
                rug::Integer::from_str_radix(&shorter, 10).unwrap() + change,
                point - count as i64 + 1
            );
            assert!(candidate.parse::<Limbs<2>>().unwrap() != x, "{candidate} is shorter than {text}");
        }
    }
}

#[test]
fn exponents_out_of_range() {
    for (text, expected) in [
        ("1e400000000", "inf"),
        ("-1e99999999999999999999", "-inf"),
        ("1e-400000000", "0.0"),
        ("-3e-99999999999999999999", "-0.0"),
        ("0e99999999999999999999", "0.0"),
    ] {
        assert_eq!(text.parse::<Limbs<4>>().unwrap().to_text(), expected);
    }
}

#[test]
fn what_is_not_a_number() {
    for text in ["", "-", "1e", "e5", ".", "1.2.3", "0x10", "1e5.0", "1e+-5", "--1", "nan", " 1", "1_000"] {
        assert_eq!(
            text.parse::<Limbs<2>>().map_err(|error| error.to_string()),
            Err(ParseError.to_string()),
            "{text:?}"
        );
    }
}
