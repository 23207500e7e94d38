//! Numbers of limbs, and MPFR's.

use crate::program::{objects, quietly, text};
use crate::scenes::{folder, summarised};
use serde_json::Value;
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

/// The verdict of a run at 1000 digits is that at 300 digits, with the same numbers; its estimates have 327 digits.
#[test]
fn a_verdict_at_many_digits_is_that_at_fewer() {
    let summary = |digits: u32| {
        let scene = format!(
            "[problem]\nname = \"kepler\"\n[run]\nscheme = \"stormer-verlet\"\nstep = \"1/20\"\nsteps = 600\ndigits = \
                {digits}\n\
             [output]\nenergy = {{ every = 600 }}\nformat = \"jsonl\"\n"
        );
        let said: Value = serde_json::from_str(&summarised(folder(&scene).path(), "").err).unwrap();
        said["summary"].clone()
    };
    let [few, many] = [300, 1000].map(summary);
    assert_eq!((&few["verdict"], &few["reason"]), (&many["verdict"], &many["reason"]));
    // H − H̄ is near 1e-3; with the states it is known to 1e-297 here, some more digits than are compared
    let [few, many] = [&few, &many].map(|summary| text(&summary["modified_energy"], "method")[..290].to_owned());
    assert_eq!(few, many);
}
