//! Protects the errors that estimators report, on the exact flow of Kepler's problem: the energy is −1/2, so every
//! error is known.

use rug::Float;
use shadowstep::Real;
use shadowstep::number::CorrectlyRounded;
use shadowstep::shadow::{Bilinear, BuildEstimator, Central, SelectionRule, StoppingRule};
use shadowstep_tests::exact_orbit::{Found, over_an_orbit};
use shadowstep_tests::precision;

/// The median, the 95th hundredth and the largest of ratios.
fn quantiles(ratios: impl Iterator<Item = f64>) -> [f64; 3] {
    let mut ratios: Vec<f64> = ratios.collect();
    ratios.sort_by(f64::total_cmp);
    [0.5, 0.95, 1.0].map(|part| ratios[((ratios.len() - 1) as f64 * part) as usize])
}

/// Circles to close encounters, coarse steps to fine ones that meet the pericentre in several phases.
fn orbits() -> impl Iterator<Item = (&'static str, &'static str)> {
    let steps = ["1/10", "3/31", "2/21", "1/20", "1/40"];
    ["0", "3/10", "6/10", "9/10"].into_iter().flat_map(move |e| steps.map(|h| (e, h)))
}

/// True error/estimate over all orbits, and for comparison true error/last term: how both are spread is printed.
fn ratios<N: CorrectlyRounded, M: BuildEstimator<N>>(
    name: &str,
    settings: &M,
    context: &N::Context,
    check: impl Fn(&Found<N>),
) -> [f64; 3] {
    let found: Vec<Found<N>> = orbits().flat_map(|orbit| over_an_orbit(orbit, settings, context)).collect();
    found.iter().for_each(check);
    let [median, most, worst] = quantiles(found.iter().map(|found| found.off / found.estimate.to_f64()));
    let old = quantiles(found.iter().map(|found| found.off / found.last_term.expect("it is known")));
    println!(
        "{name}: {median:.0e}, {most:.2}, {worst:.2}; of the last term {:.0e}, {:.0e}, {:.0e}",
        old[0], old[1], old[2]
    );
    old
}

/// Errors are at most a tenth more than estimated; where they are round-off, which may be alike at some states one
/// after the other, four times as much.
fn assert_reliable<N: Real>(name: &str, digits: u32, found: &Found<N>) {
    let is_round_off = found.off < 10_f64.powi(2 - digits as i32);
    let allowed = if is_round_off { 4.0 } else { 1.1 };
    let (error, estimate) = (found.off, found.estimate.to_f64());
    assert!(error < allowed * estimate, "{name}: an error of {error:e} is estimated as {estimate:e}");
}

#[test]
fn the_error_of_central_differences_is_hardly_more_than_estimated() {
    const DIGITS: u32 = 160;
    let fixed = [2, 5, 10, 20, 40].map(|m| (format!("m = {m}"), Central::fixed_with_error(m)));
    let best = [SelectionRule::Least, SelectionRule::Robust]
        .map(|rule| (format!("the best m <= 100, {rule:?}"), Central::best_with_error(100, StoppingRule::Full, rule)));
    for (name, settings) in fixed.iter().chain(&best) {
        let check = |found: &Found<Float>| assert_reliable(name, DIGITS, found);
        let [.., worst] = ratios::<Float, _>(name, settings, &precision(DIGITS), check);
        // by the last term alone
        assert!(name == "m = 2" || worst > 1e3, "{name}: {worst:e}");
    }
}

#[test]
fn the_error_of_bilinear_estimates_is_hardly_more_than_estimated() {
    const DIGITS: u32 = 160;
    for k in [2, 3, 4, 8, 16, 32] {
        let name = format!("k = {k}");
        let check = |found: &Found<Float>| assert_reliable(&name, DIGITS, found);
        ratios::<Float, _>(&name, &Bilinear::with_error(k), &precision(DIGITS), check);
    }
}

/// In double precision nearly all errors are round-off, and values may agree in all their digits.
#[test]
fn so_is_round_off() {
    fn check<M: BuildEstimator<f64>>(name: &str, settings: &M) {
        ratios(&format!("{name}, double precision"), settings, &(), |found| assert_reliable(name, 16, found));
    }
    check("m = 20", &Central::fixed_with_error(20));
    check("the best m <= 40", &Central::best_with_error(40, StoppingRule::Full, SelectionRule::Least));
    check("k = 16", &Bilinear::with_error(16));
}

/// The largest error of an orbit is never more by the robust rule than by the paper's.
#[test]
fn the_robust_rule_is_no_worse() {
    let mut gains = Vec::new();
    for orbit in orbits().filter(|(e, _)| *e != "0") {
        let [least, robust] = [SelectionRule::Least, SelectionRule::Robust].map(|rule| {
            let settings = Central::best_with_error(100, StoppingRule::Full, rule);
            let found = over_an_orbit::<Float>(orbit, &settings, &precision(100));
            found.iter().map(|found| found.off).fold(0.0, f64::max)
        });
        println!("{orbit:?}: {least:.1e} by the least term, {robust:.1e} by the robust rule");
        assert!(robust <= least, "{orbit:?}: {robust:e} > {least:e}");
        gains.push((least / robust).log10());
    }
    let mean = gains.iter().sum::<f64>() / gains.len() as f64;
    println!(
        "a factor of {:.2} in the mean, {:.1} at most",
        10_f64.powf(mean),
        10_f64.powf(gains.iter().copied().fold(0.0, f64::max))
    );
    assert!(mean > 0.1, "{mean}");
}
