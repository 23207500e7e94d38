//! Step sizes that are easy to write: 1/20, 1/250, 0.45, 2, 45.

use shadowstep::Rational;

/// The digits of convenient numbers: neighbours differ by an eighth at most.
const DIGITS: [i64; 22] =
    [100, 110, 120, 125, 140, 150, 160, 180, 200, 220, 240, 250, 280, 300, 320, 360, 400, 450, 500, 600, 700, 800];
/// A step of which the time is a multiple is preferred to one that is larger by this factor at most.
const PREFERENCE: f64 = 1.09;

/// The largest convenient step size that is not larger than h: a number of up to three digits, or 1 divided by a whole one. One of which
/// the time is a multiple is preferred, if it is about as large.
///
/// # Panics
/// If h is not positive and finite.
pub(crate) fn convenient_step(h: f64, time: &Rational) -> Rational {
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
    let (largest, step) = all.first().expect("there are smaller ones").clone();
    let near = all.into_iter().take_while(|(size, _)| size * PREFERENCE >= largest);
    near.map(|(_, step)| step).find(|step| (time / step).is_integer()).unwrap_or(step)
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
    use shadowstep::{Number, exact};

    #[test]
    fn convenient_steps_divide_the_time_or_are_short() {
        for (h, time, expected) in [(0.0526, "100", "1/20"), (0.72, "100", "7/10"), (47.0, "20000", "45")] {
            assert_eq!(convenient_step(h, &exact(time).unwrap()), exact(expected).unwrap(), "{h}");
        }
    }

    #[test]
    fn convenient_steps_are_a_little_smaller() {
        for i in -300..300 {
            let h = 10_f64.powf(f64::from(i) / 37.0);
            let step = <f64 as Number>::from_rational(&convenient_step(h, &Rational::from_integer(100.into())), &());
            assert!(step <= h * (1.0 + 1e-9) && step > 0.8 * h, "{h}: {step}");
        }
    }
}
