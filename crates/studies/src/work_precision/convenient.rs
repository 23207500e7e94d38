//! Step sizes that are easy to write: 1/20, 1/250, 0.45, 2, 45.

use num_traits::{One, Signed, ToPrimitive};
use shadowstep::{Number, Rational};

/// The digits of convenient numbers: neighbours differ by an eighth at most.
const DIGITS: [i64; 22] =
    [100, 110, 120, 125, 140, 150, 160, 180, 200, 220, 240, 250, 280, 300, 320, 360, 400, 450, 500, 600, 700, 800];
/// A convenient step is preferred to one that is larger by this factor at most.
const PREFERENCE: f64 = 1.09;

/// The largest step size of at most h of which the time is a multiple: a convenient one, which is a number of up to
/// three digits or 1 divided by a whole one, where such a one is about as large; else the time divided by the fewest
/// steps. Without a time, the largest convenient one.
///
/// # Panics
/// If h is not positive and finite.
pub(crate) fn convenient_step(h: f64, time: Option<&Rational>) -> Rational {
    assert!(h > 0.0 && h.is_finite(), "a step size is positive");
    // a last place off is the same step
    let most = h * (1.0 + 1e-12);
    let decimals = around(h).filter(|&number| value(number) <= most).map(|number| (value(number), scaled(number)));
    let whole = |&(digits, zeros): &(i64, i32)| match zeros {
        0.. => true,
        -2 | -1 => digits % 10_i64.pow(zeros.unsigned_abs()) == 0,
        _ => false,
    };
    let fractions = around(1.0 / h).filter(whole).filter(|&number| value(number) * most >= 1.0);
    let fractions = fractions.map(|number| (1.0 / value(number), scaled(number).recip()));
    let mut all: Vec<(f64, Rational)> = decimals.chain(fractions).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let largest = all.first().map_or(h, |(size, _)| *size);
    let near = all.into_iter().take_while(|(size, _)| size * PREFERENCE >= largest);
    let mut near = near.map(|(_, step)| step);
    let found = near.find(|step| time.is_none_or(|time| (time / step).is_integer()));
    found.unwrap_or_else(|| time.map_or_else(Rational::one, |time| equal_part(time, most)))
}

/// |time| divided by the fewest parts that are not larger than this.
fn equal_part(time: &Rational, most: f64) -> Rational {
    let parts = (<f64 as Number>::from_rational(time, &()).abs() / most).ceil().max(1.0);
    time.abs() / Rational::from_integer(parts.to_u64().unwrap_or(u64::MAX).into())
}

/// Convenient numbers from a tenth to ten times x and beyond, in their order: digits and a power of ten.
fn around(x: f64) -> impl Iterator<Item = (i64, i32)> {
    let decade = x.log10().floor() as i32;
    // the digits have three places
    (decade - 3..=decade - 1).flat_map(|zeros| DIGITS.into_iter().map(move |digits| (digits, zeros)))
}

fn value((digits, zeros): (i64, i32)) -> f64 {
    digits as f64 * 10_f64.powi(zeros)
}

fn scaled((digits, zeros): (i64, i32)) -> Rational {
    let power = |zeros: i32| num_traits::pow(Rational::from_integer(10.into()), zeros.unsigned_abs() as usize);
    let number = Rational::from_integer(digits.into());
    if zeros >= 0 { number * power(zeros) } else { number / power(zeros) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::exact;

    #[test]
    fn steps_divide_the_time_and_are_convenient_where_that_costs_little() {
        let cases =
            [(0.0526, "100", "1/20"), (0.72, "100", "100/139"), (52.0, "20000", "50"), (47.0, "20000", "10000/213")];
        for (h, time, expected) in cases {
            assert_eq!(convenient_step(h, Some(&exact(time).unwrap())), exact(expected).unwrap(), "{h}");
        }
    }

    #[test]
    fn steps_are_a_little_smaller_and_end_at_the_time() {
        let time = exact("-100").unwrap();
        for i in -300..60 {
            let h = 10_f64.powf(f64::from(i) / 37.0);
            let exact = convenient_step(h, Some(&time));
            let step = <f64 as Number>::from_rational(&exact, &());
            assert!((&time / &exact).is_integer(), "{h}: {exact}");
            // about 100/h parts: one more of three makes a quarter
            assert!(step <= h * (1.0 + 1e-9) && step > 0.74 * h, "{h}: {step}");
        }
    }
}
