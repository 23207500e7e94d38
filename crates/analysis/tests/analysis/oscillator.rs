//! Trace, stability and phase of the harmonic oscillator, against multiplied matrices and scans.

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};
use shadowstep_analysis::Analysis;
use shadowstep_analysis::stability::{MOST_MAPS, Stability};
use shadowstep_analysis::trace::Trace;
use shadowstep_schemes::symbolic::decimal::from_text;
use shadowstep_schemes::{MapKind, Proved, Rational, Source, read, shipped, to_text};

use crate::{SHIPPED, analysis, scheme, with_weights};

/// The maps with weights in f64.
fn maps(proved: &Proved) -> Vec<(MapKind, f64)> {
    proved.scheme.maps().iter().map(|map| (map.kind, map.weight.to_f64().unwrap())).collect()
}

/// The trace of the matrix of a step, multiplied out in f64, and a bound of its error.
fn trace(maps: &[(MapKind, f64)], x: f64) -> (f64, f64) {
    let mut columns = [[1.0, 0.0], [0.0, 1.0]];
    let mut largest = 1.0_f64;
    for (kind, weight) in maps {
        for [q, p] in &mut columns {
            match kind {
                MapKind::Kick => *p -= weight * x * *q,
                MapKind::Drift => *q += weight * *p,
                MapKind::GradientKick => *p += 2.0 * weight * x * x * *q,
            }
            largest = largest.max(q.abs()).max(p.abs());
        }
    }
    // what a map rounds is carried on by the others, none of which makes it more than a few hundred times larger
    (columns[0][0] + columns[1][1], 1e-12 * largest)
}

/// The same with 500 bits behind the point.
fn precise_trace(proved: &Proved, x: &Rational) -> Rational {
    let unit = BigInt::from(1) << 500_u32;
    let fixed = |value: &Rational| value.numer() * &unit / value.denom();
    let x = fixed(x);
    let mut columns = [[unit.clone(), BigInt::zero()], [BigInt::zero(), unit.clone()]];
    for map in proved.scheme.maps() {
        let weight = fixed(&map.weight);
        for [q, p] in &mut columns {
            match map.kind {
                MapKind::Kick => *p -= (((&weight * &x) >> 500_u32) * &*q) >> 500_u32,
                MapKind::Drift => *q += (&weight * &*p) >> 500_u32,
                MapKind::GradientKick => *p += (((&weight * &x * 2) >> 500_u32) * ((&x * &*q) >> 500_u32)) >> 500_u32,
            }
        }
    }
    Rational::new(&columns[0][0] + &columns[1][1], unit)
}

/// |tr| − 2 at an hω.
fn instability(proved: &Proved, at: &Rational) -> Rational {
    precise_trace(proved, &(at * at)).abs() - Rational::from_integer(2.into())
}

/// Asserts that the trace passes ±2 within 1e-28 of a limit or end of a gap.
fn assert_passes(proved: &Proved, at: &str, becomes_unstable: bool) {
    let (at, little) = (from_text(at).unwrap(), Rational::new(1.into(), 10_i64.pow(14).into()).pow(2));
    let (before, after) = (instability(proved, &(&at - &little)), instability(proved, &(&at + &little)));
    assert_eq!((before.is_positive(), after.is_positive()), (!becomes_unstable, becomes_unstable), "at {at}");
}

/// Two steps of Störmer and Verlet's scheme of half the size, the kicks changed by `change`.
fn twice_verlet(change: &str) -> Proved {
    let claims = "order = 1\nkinetic = \"any\"";
    let outer = format!("\"1/4 + {change}\"");
    with_weights(claims, &format!("{outer}, \"1/2 - 2*({change})\", {outer}"), "\"1/2\", \"1/2\", 0")
}

#[test]
fn the_trace_polynomial_is_the_trace_of_the_matrices() {
    for (name, proved, _) in SHIPPED.iter() {
        let polynomial = Trace::of(&proved.scheme.maps());
        assert_eq!(to_text(&polynomial.coefficient(0)), "2");
        assert_eq!(polynomial.coefficient(polynomial.degree() + 1), Rational::zero());
        for x in [0.01_f64, 0.3, 1.0, 2.5, 7.0] {
            let powers = (0..=polynomial.degree()).map(|k| (k, x.powi(k as i32)));
            let value: f64 = powers.map(|(k, power)| polynomial.unreduced_coefficient(k).to_f64() * power).sum();
            let (expected, error) = trace(&maps(proved), x);
            assert!((value - expected).abs() < error, "{name}: {value}, {expected}");
        }
    }
}

#[test]
fn unreduced_coefficients_are_the_same_numbers() {
    let trace = Trace::of(&scheme("yoshida4").scheme.maps());
    for k in 0..=trace.degree() {
        assert_eq!(trace.unreduced_coefficient(k).reduced(), trace.coefficient(k));
    }
}

fn stability(name: &str) -> &'static Stability {
    analysis(name).stability.as_ref().unwrap()
}

#[test]
fn limits_that_are_known_in_closed_form() {
    assert_eq!(stability("stormer-verlet").limit, "2");
    assert!(stability("stormer-verlet").gaps.is_empty());
    assert_eq!(stability("symplectic-euler").limit, "2");
    // kicks 1/6, 2/3, 1/6: tr = 2 − x + x²/12 − … passes ±2 at x = 6 and x = 12
    let simpson =
        Analysis::of(&with_weights("order = 2\nkinetic = \"any\"", "\"1/6\", \"2/3\", \"1/6\"", "\"1/2\", \"1/2\", 0"));
    let simpson = simpson.stability.unwrap();
    let gap = &simpson.gaps[0];
    assert_eq!(simpson.limit, "2.44948974278317809819728407471");
    assert_eq!(
        (gap.from.as_str(), gap.to.as_deref()),
        (simpson.limit.as_str(), Some("3.46410161513775458705489268301"))
    );
    assert!((gap.width - (12_f64.sqrt() - 6_f64.sqrt())).abs() < 1e-14, "the rounding of f64");
}

#[test]
fn a_trace_that_touches_makes_no_gap() {
    // tr = t² − 2 with t = 2 − x/4 touches −2 at x = 8, and passes 2 at x = 16
    let stability = Analysis::of(&twice_verlet("0")).stability.unwrap();
    assert_eq!((stability.limit.as_str(), stability.gaps.len()), ("4", 0));
}

#[test]
fn thin_gaps_are_found() {
    for change in ["1/10^6", "1/10^12", "1/10^40"] {
        let proved = twice_verlet(change);
        let stability = Analysis::of(&proved).stability.unwrap();
        let gap = &stability.gaps[0];
        assert_eq!(stability.gaps.len(), 1, "{change}");
        assert_eq!(stability.limit, gap.from);
        // at its end one of the entries off the diagonal of the step's matrix vanishes: 1 − (1/2 − 2c) x/4
        let c = from_text(&change.replace("10^", "1e").replace("1/1e", "1e-")).unwrap().to_f64().unwrap();
        let closed = (8.0 / (1.0 - 4.0 * c)).sqrt();
        assert!(
            (gap.to.as_deref().unwrap().parse::<f64>().unwrap() - closed).abs() < 1e-14 * closed,
            "{change}: {gap:?}"
        );
        assert!(gap.width > c && gap.width < 100.0 * c, "{change}: {gap:?}");
    }
}

#[test]
fn limits_and_gaps_are_where_the_trace_passes_two() {
    for (name, proved, Analysis { stability, evaluations, .. }) in SHIPPED.iter() {
        let stability = stability.as_ref().unwrap();
        for gap in &stability.gaps {
            assert_passes(proved, &gap.from, true);
            gap.to.iter().for_each(|to| assert_passes(proved, to, false));
        }
        for pair in stability.gaps.windows(2) {
            assert_ne!(pair[0].to.as_ref(), Some(&pair[1].from), "{name}: something is between them");
        }
        assert_passes(proved, &stability.limit, true);
        let maps = maps(proved);
        let end = |text: &str| text.parse::<f64>().unwrap();
        let gaps: Vec<_> =
            stability.gaps.iter().map(|gap| (end(&gap.from), gap.to.as_deref().map_or(f64::INFINITY, end))).collect();
        for i in 1..5_000 {
            let at = 2.0 * *evaluations as f64 * f64::from(i) / 5_000.0;
            let unstable = gaps.iter().any(|(from, to)| (from..to).contains(&&at));
            let (trace, error) = trace(&maps, at * at);
            // near ±2 f64 does not decide
            assert!((trace.abs() - 2.0).abs() < error || (trace.abs() > 2.0) == unstable, "{name} at {at}: {trace}");
        }
    }
}

#[test]
fn phases_are_off_as_the_leading_term_says() {
    let verlet = analysis("stormer-verlet").phase;
    assert_eq!((verlet.coefficient, verlet.power), (1.0 / 24.0, 2));
    for (name, proved, Analysis { phase, .. }) in SHIPPED.iter() {
        let (phase, x) = (*phase, Rational::new(1.into(), 10_000.into()));
        // φ from cos φ = tr/2 at hω = 1/100: with sin((φ − hω)/2) sin((φ + hω)/2) = (cos hω − cos φ)/2 and all digits
        let cosine = |k: u32| {
            let factorial = (1..=2 * u64::from(k)).map(|i| Rational::from_integer(i.into())).product::<Rational>();
            Rational::from_integer(if k.is_multiple_of(2) { 1.into() } else { (-1).into() }) * x.pow(k as i32)
                / factorial
        };
        let two = Rational::from_integer(2.into());
        let difference = (0..20).map(cosine).sum::<Rational>() - precise_trace(proved, &x) / two;
        let off = difference.to_f64().unwrap() / 0.01_f64.sin() / 0.01;
        let predicted = phase.coefficient * 0.01_f64.powi(phase.power as i32);
        assert!((off - predicted).abs() < 0.05 * predicted.abs(), "{name}: {off} found, {predicted} predicted");
    }
}

#[test]
fn phases_beyond_the_digits_of_the_weights_are_none() {
    // u = (1 + √(7/6))/2, with which tr has the x² of the cosine
    let (kick, drift) = ("\"1.04006172486732\", \"1 - 1.04006172486732\"", "2, -1");
    let claims = "order = 1\nkinetic = \"any\"";
    let rounded = Analysis::of(&with_weights(&format!("{claims}\ndigits = 15"), kick, drift)).phase;
    assert_eq!(rounded.power, 4);
    let taken_at_their_word = Analysis::of(&with_weights(claims, kick, drift)).phase;
    assert_eq!(taken_at_their_word.power, 2);
    assert!(taken_at_their_word.coefficient.abs() < 1e-14);
}

/// γ_1 h, γ_2 h, … steps of a shipped scheme.
fn composition(base: &str, order: u32, gamma: &[&str]) -> Proved {
    let text = format!(
        "name = \"mine\"\nreference = \"a test\"\norder = {order}\nkinetic = \"any\"\n\
         [composition]\nbase = \"{base}\"\ngamma = {gamma:?}\n"
    );
    let source = Source { path: "mine.toml".to_owned(), text };
    read(&source, &|name, _| shipped(name)).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The trace of n equal steps passes ±2 where the trace of one step does; elsewhere it touches ±2, at double roots.
#[test]
fn equal_steps_are_stable_where_one_of_them_is() {
    for (base, order, steps) in [("blanes-moan-s6", 4, 4), ("suzuki-umeno8", 8, 2), ("hairer10-33", 10, 40)] {
        let one = format!("1/{steps}");
        let stability = Analysis::of(&composition(base, order, &vec![one.as_str(); steps])).stability.unwrap();
        let times = Rational::from_integer(steps.into());
        let limit = from_text(&self::stability(base).limit).unwrap() * times;
        let found = from_text(&stability.limit).unwrap();
        assert!((found - &limit).abs() < limit / num_traits::pow(BigInt::from(10), 28), "{base}: {}", stability.limit);
    }
}

/// Far beyond the limit the trace of a composition passes from −2 to 2 within fewer digits than are computed first.
#[test]
fn steep_passages_are_parted() {
    let proved = composition("hairer10-33", 10, &["1/4", "1/2", "1/4"]);
    let stability = Analysis::of(&proved).stability.unwrap();
    assert_passes(&proved, &stability.limit, true);
    assert_eq!(stability.gaps.len(), 15);
}

#[test]
fn steps_of_very_many_maps_are_not_analysed() {
    let mut gamma = vec!["1/301"; 299];
    gamma.push("2/301");
    let proved = composition("stormer-verlet", 2, &gamma);
    assert!(proved.scheme.maps().len() > MOST_MAPS);
    assert_eq!(Analysis::of(&proved).stability, None);
}
