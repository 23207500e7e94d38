//! Numbers of limbs, and MPFR's.

#[cfg(not(feature = "mpfr"))]
use crate::program::shadowstep;
#[cfg(feature = "mpfr")]
use crate::program::{objects, quietly, text};
#[cfg(feature = "mpfr")]
use shadowstep::number::{Limbs, Real};

/// The run has 40 steps, and estimates divide by h = 1/20: both lose digits to round-off, two at most.
#[test]
#[cfg(feature = "mpfr")]
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

#[test]
#[cfg(not(feature = "mpfr"))]
fn more_digits_than_limbs_have_need_mpfr() {
    let words = "drift kepler --scheme stormer-verlet --step 1/20 --until 2 --order 8";
    for (more, digits) in [("--digits 308", 308), ("--digits 20 --mpfr", 20)] {
        let result = shadowstep(&format!("{words} {more}"));
        assert_eq!(result.code, 2, "{more}");
        let message = format!("error: {digits} digits need MPFR, which this program was built without");
        assert!(result.err.starts_with(&message), "{}", result.err);
    }
    assert_eq!(shadowstep(&format!("{words} --digits 307 --no-summary")).code, 0);
}
