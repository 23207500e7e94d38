//! Numbers of limbs, and MPFR's.

use crate::program::{objects, quietly, text};
use shadowstep::number::{Limbs, Real};

/// The run has 40 steps, and estimates divide by h = 1/20: both lose digits to round-off, two at most.
#[test]
fn limbs_and_mpfr_agree_to_the_digits_of_the_run() {
    for digits in [16, 38, 39, 60, 120, 200, 300] {
        let words = format!("drift kepler --scheme yoshida4 --step 1/20 --until 2 --order 8 --json --digits {digits}");
        let [limbs, mpfr] = [words.clone(), format!("{words} --mpfr")].map(|words| objects(&quietly(&words)).remove(0));
        for field in ["first", "last", "minimum", "maximum"] {
            let [limbs, mpfr] = [&limbs, &mpfr].map(|record| text(record, field));
            let [one, other] = [limbs, mpfr].map(|text| text.parse::<Limbs<17>>().unwrap());
            let off = (&(&one - &other) / &other).log10_abs();
            assert!(off < 2.0 - f64::from(digits), "{digits} digits: {limbs} {mpfr}");
        }
        assert_ne!(text(&limbs, "drift"), text(&mpfr, "drift"), "they are different numbers");
    }
}
