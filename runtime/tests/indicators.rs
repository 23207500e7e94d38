//! Protects SALI and GALI: beside closed forms, and in double precision beside more digits.

use shadowstep::number::{AnyLimbs, DoubleDouble, Dual, Lanes, LimbCount, Number};
use shadowstep::prelude::*;
use shadowstep::problems::HenonHeiles;
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::tangent::Tangents;
use shadowstep::{exact, potential};

fn stepper<N: Number>(scheme: &str, h: &str, context: &N::Context) -> Stepper<TableScheme, N> {
    Stepper::with_context(shipped(scheme).unwrap(), StepSize::try_from(h).unwrap(), context).unwrap()
}

potential! { pub struct Hill; U(x) = -x^2/2 }

/// SALI and GALI of the vectors (1, 0) and (0, 1) after n steps of Störmer–Verlet with h = 1/10 on a hill, M = (1 +
/// h²/2, b; c, 1 + h²/2) with bc = sinh²λ: the angle between v₁ = (cosh nλ, √(c/b) sinh nλ) and v₂ = (√(b/c) sinh nλ,
/// cosh nλ) has the sine 1/(|v₁| |v₂|), as M has the determinant 1.
fn assert_no_floor<N: Number>(context: &N::Context, every: u32) {
    let one = || [N::from_rational(&exact("1").unwrap(), context)];
    let zero = || N::zero(context);
    let motion = Motion::new(
        Hill,
        UnitMasses,
        [Dual::new(zero(), [one()[0].clone(), zero()])],
        [Dual::new(zero(), [zero(), one()[0].clone()])],
    );
    let stepper = stepper("stormer-verlet", "1/10", context);
    let mut tangents = Tangents::new(vec![stepper.with(motion.unwrap())]).unwrap();
    let h: f64 = 0.1;
    let (lambda, ratio) = ((1.0 + h * h / 2.0).acosh(), 1.0 + h * h / 4.0);
    for n in 1..=3000_u32 {
        tangents.step();
        if !n.is_multiple_of(every) {
            continue;
        }
        tangents.observe(h * f64::from(n));
        let (cosh, sinh) = ((f64::from(n) * lambda).cosh(), (f64::from(n) * lambda).sinh());
        let lengths = [ratio, 1.0 / ratio].map(|of_sinh| (cosh * cosh + of_sinh * sinh * sinh).sqrt());
        let sine = 1.0 / lengths[0] / lengths[1];
        let sali = sine * (2.0 / (1.0 + (1.0 - sine * sine).max(0.0).sqrt())).sqrt();
        for lane in 0..N::LANES {
            assert!((tangents.gali(2, lane) / sine - 1.0).abs() < 1e-10, "{n}: {} {sine}", tangents.gali(2, lane));
            let found = tangents.sali(lane);
            // the closed form of SALI loses half the digits where vectors are orthogonal
            assert!(
                (found / sali - 1.0).abs() < 1e-7 || n > 20 && (found / sali - 1.0).abs() < 1e-10,
                "{n}: {found} {sali}"
            );
            let grown = tangents.growth(1, lane).logarithm();
            assert!((grown - lengths[1].ln()).abs() < 1e-10 || (grown - lengths[0].ln()).abs() < 1e-10);
        }
    }
    assert!(tangents.sali(0) < 1e-255 && tangents.sali(0) > 0.0);
}

#[test]
fn angles_between_vectors_have_no_floor() {
    for every in [1, 7] {
        assert_no_floor::<f64>(&(), every);
        assert_no_floor::<DoubleDouble>(&(), every);
        assert_no_floor::<AnyLimbs>(&LimbCount::of_bits(400).unwrap(), every);
        assert_no_floor::<Lanes<4>>(&(), every);
    }
}

/// Beside each other: in double precision along the first part of a chaotic orbit, on which its states are still those
/// with 120 digits.
#[test]
fn angles_in_double_precision_are_those_with_more_digits() {
    fn angles<N: Number>(context: &N::Context) -> [f64; 3] {
        let number = |text: &str| N::from_rational(&exact(text).unwrap(), context);
        let unit = |i: usize| std::array::from_fn::<N, 4, _>(|k| number(if i == k { "1" } else { "0" }));
        let q = [("0", 0), ("-1/4", 1)].map(|(x, i)| Dual::new(number(x), unit(i)));
        let p = [("42081/100000", 2), ("0", 3)].map(|(x, i)| Dual::new(number(x), unit(i)));
        let stepper = stepper("blanes-moan-srkn6b", "1/5", context);
        let motion = Motion::new(HenonHeiles, UnitMasses, q, p).unwrap();
        let mut tangents = Tangents::new(vec![stepper.with(motion)]).unwrap();
        for n in 1..=1900_u32 {
            tangents.step();
            tangents.observe(0.2 * f64::from(n));
        }
        [tangents.sali(0), tangents.gali(3, 0), tangents.gali(4, 0)]
    }
    let (double, long) = (angles::<f64>(&()), angles::<AnyLimbs>(&LimbCount::of_bits(400).unwrap()));
    assert!(long[0] < 1e-8 && long[2] < 1e-41, "{long:?}");
    for (double, long) in double.iter().zip(long) {
        assert!((double / long - 1.0).abs() < 1e-2, "{double} {long}");
    }
}
