//! The largest relative errors against the bounds that the documentation states.

use rug::Float;

use super::super::DoubleDouble;
use super::super::arithmetic::two_sum;
use super::cases::{BITS, Cases, big};
use crate::number::Number;

/// u² = 2⁻¹⁰⁶
const INVERSE_U_SQUARED: f64 = (1_u128 << 106) as f64;

/// An operation, its bound in u², and the largest error found.
struct Record {
    name: &'static str,
    bound: f64,
    found: f64,
    at: Vec<DoubleDouble>,
}

#[derive(Default)]
struct Records(Vec<Record>);

impl Records {
    /// |found − exact| in u² |scale|
    fn note_with_scale(
        &mut self,
        (name, bound): (&'static str, f64),
        found: DoubleDouble,
        exact: &Float,
        scale: &Float,
        at: &[DoubleDouble],
    ) {
        let (high, low) = found.parts();
        assert_eq!(two_sum(high, low), (high, low), "{name} {at:?}: parts overlap");
        let error = Float::with_val(BITS, big(found) - exact).abs();
        let relative =
            if error.is_zero() { 0.0 } else { Float::with_val(60, error / scale).to_f64() * INVERSE_U_SQUARED };
        match self.0.iter_mut().find(|record| record.name == name) {
            Some(record) if relative <= record.found => {}
            Some(record) => (record.found, record.at) = (relative, at.to_vec()),
            None => self.0.push(Record { name, bound, found: relative, at: at.to_vec() }),
        }
    }

    fn note(&mut self, operation: (&'static str, f64), found: DoubleDouble, exact: &Float, at: &[DoubleDouble]) {
        self.note_with_scale(operation, found, exact, &Float::with_val(BITS, exact.abs_ref()), at);
    }

    fn hold(&self) {
        for Record { name, bound, found, at } in &self.0 {
            println!("{name:>14}: {found:6.3} of {bound} u²  {at:?}");
            assert!(found <= bound && *found > 0.0, "{name}: {found} u², the bound is {bound} u², at {at:?}");
        }
    }
}

fn value(change: impl FnOnce(&mut DoubleDouble)) -> DoubleDouble {
    let mut x = DoubleDouble::zero(&());
    change(&mut x);
    x
}

fn note_arithmetic(records: &mut Records, cases: &mut Cases) {
    let a = cases.number(-20, 20);
    let x = big(a);
    let b = cases.partner(&x);
    let y = big(b);
    let sums = [("+", a + b, Float::with_val(BITS, &x + &y)), ("-", a - b, Float::with_val(BITS, &x - &y))];
    for (name, found, exact) in sums {
        records.note((name, 3.0), found, &exact, &[a, b]);
    }
    records.note(("*", 5.0), a * b, &Float::with_val(BITS, &x * &y), &[a, b]);
    records.note(("square", 5.0), a.square(), &Float::with_val(BITS, x.square_ref()), &[a]);
    records.note(("/", 15.0), a / b, &Float::with_val(BITS, &x / &y), &[a, b]);
    let (factor, n) = (cases.machine(-20, 20), 1 + cases.below(i32::MAX as u64) as i32);
    records.note(("times f64", 3.0), a.times(factor), &Float::with_val(BITS, &x * factor), &[a, factor.into()]);
    records.note(("over f64", 3.0), a.over(factor), &Float::with_val(BITS, &x / factor), &[a, factor.into()]);
    let [mut product, mut quotient] = [a; 2];
    product.multiply_integer(n);
    quotient.divide_integer(n);
    records.note(("n a", 3.0), product, &Float::with_val(BITS, &x * n), &[a, f64::from(n).into()]);
    records.note(("a / n", 3.0), quotient, &Float::with_val(BITS, &x / n), &[a, f64::from(n).into()]);
    let a = a.absolute();
    let root = value(|x| x.assign_reciprocal_sqrt(&a));
    records.note(("sqrt", 3.125), a.sqrt(), &Float::with_val(BITS, big(a).sqrt_ref()), &[a]);
    records.note(("1/sqrt", 18.2), root, &Float::with_val(BITS, big(a).recip_sqrt_ref()), &[a]);
}

/// x + a b and x − a b in u² (|result| + 2|x| + 9|a b|)
fn note_sums_of_products(records: &mut Records, cases: &mut Cases) {
    let (a, b) = (cases.number(-20, 20), cases.number(-20, 20));
    let product = Float::with_val(BITS, big(a) * big(b));
    let x = cases.partner(&product);
    for (name, found, sign) in [("x + a b", x.plus_product(a, b), 1), ("x - a b", x.minus_product(a, b), -1)] {
        let exact: Float = big(x) + Float::with_val(BITS, &product * sign);
        let scale = Float::with_val(BITS, exact.abs_ref()) + 2 * big(x).abs() + 9 * product.clone().abs();
        records.note_with_scale((name, 1.0), found, &exact, &scale, &[x, a, b]);
    }
}

fn note_functions(records: &mut Records, cases: &mut Cases) {
    let exponent = [cases.number(-60, 0), cases.number(0, 9), cases.number(-3, 9)][cases.below(3) as usize];
    let exponent = if exponent.absolute().parts().0 < 600.0 { exponent } else { exponent.scaled(1.0 / 64.0) };
    let next_to_1 = DoubleDouble::new(1.0, cases.machine(-100, -1)).absolute();
    let positive = [cases.positive(-900, 900), next_to_1, cases.positive(-1, 1), cases.positive(-8, 8)];
    let positive = positive[cases.below(4) as usize];
    let angles = [
        cases.number(-60, 0),
        cases.number(-3, 6),
        cases.number(0, 16),
        cases.number(16, 900),
        cases.near_quarter_turns(),
    ];
    let angle = angles[cases.below(5) as usize];
    let below_1 = DoubleDouble::new(1.0, -cases.machine(-100, -1).abs());
    let sine = [cases.number(-60, 0), cases.number(-4, 0), below_1, -below_1][cases.below(4) as usize];
    let any = [cases.number(-60, 0), cases.number(-6, 8), cases.number(-900, 900)][cases.below(3) as usize];
    type Function = (&'static str, f64, DoubleDouble, fn(&mut DoubleDouble, &DoubleDouble), fn(Float) -> Float);
    let functions: [Function; 15] = [
        ("exp", 4.0, exponent, |x, a| x.assign_exp(a), Float::exp),
        ("log", 14.0, positive, |x, a| x.assign_log(a), Float::ln),
        ("sinh", 12.0, exponent, |x, a| x.assign_sinh(a), Float::sinh),
        ("cosh", 15.0, exponent, |x, a| x.assign_cosh(a), Float::cosh),
        ("tanh", 29.0, exponent, |x, a| x.assign_tanh(a), Float::tanh),
        ("sin", 22.0, angle, |x, a| x.assign_sin(a), Float::sin),
        ("cos", 22.0, angle, |x, a| x.assign_cos(a), Float::cos),
        ("tan", 42.0, angle, |x, a| x.assign_tan(a), Float::tan),
        ("atan", 38.0, any, |x, a| x.assign_atan(a), Float::atan),
        ("asin", 25.0, sine, |x, a| x.assign_asin(a), Float::asin),
        ("acos", 30.0, sine, |x, a| x.assign_acos(a), Float::acos),
        ("root of 3", 12.0, any, |x, a| x.assign_root(a, 3), |x| x.root(3)),
        ("root of 7", 12.0, any, |x, a| x.assign_root(a, 7), |x| x.root(7)),
        ("root of 10", 12.0, positive, |x, a| x.assign_root(a, 10), |x| x.root(10)),
        ("root of 2000", 12.0, positive, |x, a| x.assign_root(a, 2000), |x| x.root(2000)),
    ];
    for (name, bound, a, own, exact) in functions {
        records.note((name, bound), value(|x| own(x, &a)), &exact(big(a)), &[a]);
    }
}

fn check(cases: u64, seed: u64) {
    let (mut records, mut source) = (Records::default(), Cases::new(seed));
    for case in 0..cases {
        note_arithmetic(&mut records, &mut source);
        note_sums_of_products(&mut records, &mut source);
        if case % 8 == 0 {
            note_functions(&mut records, &mut source);
        }
    }
    records.hold();
}

#[test]
fn errors_are_within_their_bounds() {
    check(4000, 1);
}

/// `cargo test --release --features mpfr -p shadowstep --lib double_double -- --ignored --nocapture`
#[test]
#[ignore = "takes minutes"]
fn errors_are_within_their_bounds_in_ten_million_cases() {
    check(10_000_000, 2);
}
