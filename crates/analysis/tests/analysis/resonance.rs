//! Resonances of multiple time steps, beside the impulse method with the exact inner flow and beside steps that are
//! made.

use shadowstep_analysis::oscillator::Oscillator;
use shadowstep_analysis::resonance::{of_oscillator, resonances};
use shadowstep_schemes::{Proved, Rational, Source, read, shipped, shipped_proved};

fn rational(n: i64, d: i64) -> Rational {
    Rational::new(n.into(), d.into())
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// The impulse method with this number of substeps.
fn impulse(substeps: u32) -> Proved {
    let text = shipped("r-respa-8").unwrap().text.replace("substeps = 8", &format!("substeps = {substeps}"));
    read(&Source { path: "mine.toml".to_owned(), text }, &|base, _| shipped(base)).unwrap()
}

/// With the exact flow tr = 2 cos θ − rθ sin θ, θ = hΩ, so that the first gap is from π − 2 atan(rθ/2) to π.
#[test]
fn many_substeps_have_the_gaps_of_the_exact_inner_flow() {
    let proved = impulse(100);
    for (ratio, r) in [(rational(1, 100), 0.01), (rational(1, 10), 0.1)] {
        let gaps = resonances(&proved, &ratio).unwrap().gaps;
        let fast = |h_omega: &str| number(h_omega) / f64::sqrt(1.0 + r);
        let (from, to) = (fast(&gaps[0].from), fast(gaps[0].to.as_ref().unwrap()));
        let pi = std::f64::consts::PI;
        println!("r = {r}: hΩ from {from} to {to}");
        // the frequency of Verlet's substeps is higher by a part of (hΩ/100)²/24
        assert!((to - pi).abs() < 2e-4, "{to}");
        let begins = pi - 2.0 * (r * from / 2.0).atan();
        assert!((from - begins).abs() < 2e-4, "{from}, {begins}");
    }
}

/// Steps are made with slow and fast kicks one by one, in double precision.
#[test]
fn an_oscillation_within_a_gap_grows_and_beside_it_does_not() {
    for name in ["r-respa-4", "r-respa-8", "nested-s6"] {
        let proved = shipped_proved(name).unwrap();
        let gaps = resonances(proved, &rational(1, 10)).unwrap().gaps;
        let first = &gaps[0];
        let (from, width) = (number(&first.from), first.width);
        println!("{name}: hω from {from}, {width} wide");
        let (maps, fast) = proved.scheme.inner.as_ref().unwrap().step(&proved.scheme.maps());
        let weight = |weight: &Rational| num_traits::ToPrimitive::to_f64(weight).unwrap();
        let grown = |h_omega: f64| {
            // Ω² = 1/(1 + r) of ω = 1
            let (h, stiff, soft) = (h_omega, 1.0 / 1.1, 0.1 / 1.1);
            let (mut q, mut p, mut largest) = (1.0_f64, 0.0_f64, 0.0_f64);
            for _ in 0..3000 {
                for (i, map) in maps.iter().enumerate() {
                    match map.kind {
                        shadowstep_schemes::MapKind::Drift => q += h * weight(&map.weight) * p,
                        _ => p -= h * weight(&map.weight) * soft * q,
                    }
                    p -= fast.get(i).map_or(0.0, |c| h * weight(c) * stiff * q);
                }
                largest = largest.max(q.abs());
            }
            largest
        };
        assert!(grown(from + width / 2.0) > 1e6, "{name}");
        assert!(grown(from - width / 2.0) < 1e2, "{name}");
        // the same from the trace of the merged kicks
        let trace = |h_omega| Oscillator::of(&of_oscillator(proved, &rational(1, 10)).unwrap(), weight).trace(h_omega);
        assert!(trace(from + width / 2.0).abs() > 2.0 && trace(from - width / 2.0).abs() < 2.0, "{name}");
    }
}

#[test]
fn a_scheme_of_two_parts_has_none() {
    assert_eq!(resonances(shipped_proved("yoshida4").unwrap(), &rational(1, 10)), None);
}
