//! The value of an expression: exact where it can be, rounded once where it cannot.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use proptest::prelude::*;
use shadowstep_schemes::symbolic::decimal::{round_significant, to_text};
use shadowstep_schemes::symbolic::{Exact, Rational, evaluate, exact, parse};

fn ratio(text: &str) -> Rational {
    text.parse().unwrap()
}

fn value(text: &str, names: &BTreeMap<String, Exact>, digits: u32) -> Exact {
    evaluate(&parse(text).unwrap(), names, digits).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn without_names(text: &str, digits: u32) -> Exact {
    value(text, &BTreeMap::new(), digits)
}

/// `g0 = -7/24` exactly, `g1 = 1.414` as a rounded number.
fn names() -> BTreeMap<String, Exact> {
    let exact = |value, rounded| Exact { value: ratio(value), rounded };
    BTreeMap::from([("g0".into(), exact("-7/24", false)), ("g1".into(), exact("1414/1000", true))])
}

// ---- exact values ----

#[test]
fn rational_formulas_are_exact() {
    let table = [
        ("0.1 + 0.2", "3/10"),
        ("-2^2", "-4"),
        ("2^-2", "1/4"),
        ("(2/3)^-3", "27/8"),
        ("2^0", "1"),
        ("0^3", "0"),
        ("1^1000000000", "1"),
        ("g0*24 + 1", "-6"),
    ];
    for (text, expected) in table {
        assert_eq!(value(text, &names(), 5), Exact { value: ratio(expected), rounded: false }, "{text}");
    }
}

#[test]
fn roots_of_perfect_powers_are_exact() {
    let table = [
        ("sqrt(0)", "0"),
        ("(-8)^(2/6)", "-2"),
        ("(-8)^(2/3)", "4"),
        ("(-8)^(-1/3)", "-1/2"),
        ("(4/9)^1.5", "8/27"),
        ("16^0.25", "2"),
        ("2^sqrt(9)", "8"),
        ("0^(1/3)", "0"),
    ];
    for (text, expected) in table {
        assert_eq!(without_names(text, 5), Exact { value: ratio(expected), rounded: false }, "{text}");
    }
}

/// Text of a random formula and its value, computed alongside; no division by zero.
fn formula() -> impl Strategy<Value = (String, Rational)> {
    let leaf = (0i64..2000, 1i64..50).prop_map(|(n, d)| {
        let value = Rational::new(n.into(), d.into());
        (format!("({})", to_text(&value)), value)
    });
    leaf.prop_recursive(5, 40, 2, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone(), 0..4).prop_map(|((a, x), (b, y), operation)| {
                match operation {
                    0 => (format!("({a} + {b})"), x + y),
                    1 => (format!("({a}-{b})"), x - y),
                    2 => (format!("({a} * {b})"), x * y),
                    _ if y.is_zero() => (a, x),
                    _ => (format!("({a}/{b})"), x / y),
                }
            }),
            (inner.clone(), 1..4).prop_map(|((a, x), n)| (format!("({a})^{n}"), x.pow(n))),
            inner.prop_map(|(a, x)| (format!("(-{a})"), -x)),
        ]
    })
}

proptest! {
    #[test]
    fn rational_formulas_agree_with_direct_arithmetic((text, expected) in formula()) {
        prop_assume!(text.len() < 10_000);
        let found = without_names(&text, 1);
        prop_assert_eq!(found, Exact { value: expected, rounded: false });
    }

    #[test]
    fn powers_of_rationals_have_exact_roots(n in -500i64..500, d in 1i64..500, q in 1i32..9) {
        prop_assume!(n >= 0 || q % 2 == 1);
        let root = Rational::new(n.into(), d.into());
        let text = format!("({})^(1/{q})", root.pow(q));
        prop_assert_eq!(without_names(&text, 1), Exact { value: root, rounded: false });
    }
}

// ---- rounded values ----

/// x^(p/q) to `digits` digits, by one integer root far beyond them.
fn root_by_integers(x: &Rational, p: u32, q: u32, digits: u32) -> Rational {
    let places = digits + 60;
    let scale = BigInt::from(10).pow(places * q);
    let power = x.numer().pow(p) * scale / x.denom().pow(p);
    let root = power.nth_root(q);
    // Cut off sixty digits beyond, which distinguishes the two neighbours.
    round_significant(&Rational::new(root, BigInt::from(10).pow(places)), digits)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn roots_are_correctly_rounded(n in 1u32..5000, d in 1u32..5000, p in 1u32..6, q in 2u32..8, digits in 1u32..120) {
        let x = Rational::new(n.into(), d.into());
        let found = without_names(&format!("({x})^({p}/{q})"), digits);
        if found.rounded {
            prop_assert_eq!(&found.value, &root_by_integers(&x, p, q, digits));
            // |r^q / x^p - 1| is q times the relative error, which is at most 5 units after the last digit.
            let ratio = found.value.pow(q as i32) / x.pow(p as i32) - Rational::from_integer(1.into());
            let bound = Rational::new((q * 8).into(), BigInt::from(10).pow(digits));
            prop_assert!(digits < 3 || ratio.abs() < bound);
        } else {
            prop_assert_eq!(found.value.pow(q as i32), x.pow(p as i32));
        }
    }

    #[test]
    fn the_whole_formula_is_rounded_once(a in -99i64..99, b in -99i64..99, c in 1i64..99, d in 2u32..99) {
        // (a + b sqrt(d)) / c^2, in integers: b sqrt(d) is the root of b^2 d.
        prop_assume!(b != 0 && BigInt::from(d).sqrt().pow(2) != d.into());
        let scale = BigInt::from(10).pow(90);
        let root = (BigInt::from(b * b) * d * &scale * &scale).sqrt() * b.signum();
        let expected = Rational::new(&scale * a + root, scale * c * c);
        let text = format!("({a} + {b}*sqrt({d}))/{c}/{c}");
        prop_assert_eq!(without_names(&text, 30), Exact { value: round_significant(&expected, 30), rounded: true });
    }
}

#[test]
fn known_constants() {
    let triple_jump = without_names("1/(2 - 2^(1/3))", 300);
    let text = to_text(&triple_jump.value);
    assert!(text.starts_with("1.3512071919596576340476878089714608269219993762171448283287"));
    // The digits go on with 33469977: rounded up, the last two of the 300 are zeros.
    assert!(text.ends_with("0506140488893347"));
    assert_eq!(text.len(), 299);
    // Another way to write it: the conjugate, (4 + 2*2^(1/3) + 4^(1/3)) / 6.
    assert_eq!(without_names("(4 + 2*cbrt(2) + cbrt(4))/6", 300), triple_jump);
    assert_eq!(exact("1/(2 - 2^(1/3))").unwrap(), triple_jump.value);
}

#[test]
fn irrational_parts_that_cancel_leave_the_rational_value() {
    let table = [
        ("(2^(1/2))^2", "2"),
        ("2^(1/2)*2^(1/2)", "2"),
        ("sqrt(2)*sqrt(3)/sqrt(6)", "1"),
        ("(1 + sqrt(2))*(1 - sqrt(2))", "-1"),
        ("sqrt(2)^-4", "1/4"),
        ("sqrt(2)^0", "1"),
        ("sqrt(3 + 2*sqrt(2)) - sqrt(2)", "1"),
        // Zero, at any distance from a plain difference.
        ("sqrt(2) - sqrt(2)", "0"),
        ("0*sqrt(2)", "0"),
        ("sqrt(2)*sqrt(3) - sqrt(6)", "0"),
        ("sqrt(sqrt(2)*sqrt(3) - sqrt(6))", "0"),
        ("(sqrt(2)*sqrt(3) - sqrt(6))^100", "0"),
        ("(sqrt(2)*sqrt(3) - sqrt(6))^1000000000", "0"),
        ("cbrt(sqrt(2)*sqrt(3) - sqrt(6))*0", "0"),
        // A tie between two decimals goes to the even one.
        ("sqrt(2)^2 * 1.00005", "2.0001"),
        ("sqrt(2)^2 * 1.000005", "2"),
        ("sqrt(2)^2 * 1.000015", "2"),
        ("sqrt(2)^2 * 1.000025", "2"),
        ("sqrt(2)^2 * 1.000075", "2.0002"),
        ("sqrt(2)^2 * 1.000125", "2.0002"),
    ];
    for (text, expected) in table {
        let expected = Exact { value: exact(expected).unwrap(), rounded: true };
        assert_eq!(without_names(text, 5), expected, "{text}");
    }
}

#[test]
fn cancellation_is_met_with_more_digits() {
    // sqrt(10^100 + 1) - 10^50 = 5e-51 - 1.25e-151 + ...
    let found = without_names("sqrt(10^100 + 1) - 10^50", 30);
    assert_eq!(to_text(&(found.value * BigInt::from(10).pow(51))), "5");
    assert_eq!(without_names("1/(sqrt(10^100 + 1) - 10^50)", 8).value, exact("2e50").unwrap());
    // Whether a root is real may show only then.
    assert_eq!(without_names("sqrt(sqrt(10^100 + 1) - 10^50) * 1e25", 8).value, ratio("70710678/100000000"));
    let negative = parse("sqrt(10^50 - sqrt(10^100 + 1))").unwrap();
    let error = evaluate(&negative, &BTreeMap::new(), 30).unwrap_err();
    assert!(error.to_string().starts_with("even root of the negative number -5e-51"), "{error}");
    // It counts even where the root itself would be too small to matter.
    let hidden = parse("1 + 1e-60*sqrt(10^50 - sqrt(10^100 + 1))").unwrap();
    assert!(evaluate(&hidden, &BTreeMap::new(), 8).is_err());
}

#[test]
fn rounding_is_remembered_through_names() {
    let table = [
        ("g0 + 1", "17/24", false),
        ("1 - 2*g1", "-457/250", true),
        ("-g1/g0", "606/125", true),
        ("g1^2", "499849/250000", true),
        ("g1 - g1", "0", true),
    ];
    for (text, expected, rounded) in table {
        assert_eq!(value(text, &names(), 2), Exact { value: ratio(expected), rounded }, "{text}");
    }
    // A new root makes the whole formula rounded.
    assert_eq!(value("sqrt(2) + g0", &names(), 3), Exact { value: ratio("112/100"), rounded: true });
}

#[test]
fn the_deepest_trees_can_be_computed() {
    // x = sqrt(1 + x) leads to the golden ratio.
    let nested = format!("{}1{}", "sqrt(1+".repeat(99), ")".repeat(99));
    assert_eq!(to_text(&without_names(&nested, 40).value), "1.61803398874989484820458683436563811772");
    let chain = format!("{}0", "sqrt(2) + ".repeat(198));
    assert_eq!(without_names(&chain, 20), without_names("198*sqrt(2)", 20));
}

#[test]
fn any_number_of_digits_is_accepted() {
    assert_eq!(without_names("sqrt(2)", 0).value, ratio("1"));
    assert_eq!(without_names("sqrt(2)", 5000), without_names("sqrt(2)", u32::MAX));
}

// ---- faults ----

#[test]
fn faults_have_a_message_and_a_place() {
    let size = "a number is too long: it has more than about 30000 digits";
    let inexact =
        "an exponent must be an exact rational, not an irrational or rounded number; write exp(y*log(x)) for x^y";
    let table = [
        ("1 + g", 4..5, "unknown name `g`; did you mean `g0`? known names: g0, g1"),
        ("gamma", 0..5, "unknown name `gamma`; known names: g0, g1"),
        ("sqrt(1, 2)", 0..10, "`sqrt` takes one argument, not 2"),
        ("cbrt()", 0..6, "`cbrt` takes one argument, not 0"),
        ("1/(2 - 2)", 2..9, "division by zero"),
        ("2/(sqrt(2)^2 - 2)", 2..17, "division by zero"),
        ("0^-2", 0..1, "division by zero"),
        ("0^(-1/2)", 0..1, "division by zero"),
        ("(sqrt(2)^2 - 2)^-1", 0..15, "division by zero"),
        ("(1-1)^0", 0..7, "0^0 is undefined"),
        ("(sqrt(2)^2 - 2)^0", 0..17, "0^0 is undefined"),
        ("1 + sqrt(-2)", 9..11, "even root of the negative number -2: it has no real value"),
        ("(-4)^0.5", 0..4, "even root of the negative number -4: it has no real value"),
        ("sqrt(1 - sqrt(4.1))", 5..18, "even root of the negative number -1.02484567313: it has no real value"),
        ("2^sqrt(2)", 2..9, inexact),
        ("2^g1", 2..4, inexact),
        ("2^(1/101)", 0..9, "a root of order 101 is too high: at most 100 is allowed"),
        ("2^(1/10^20)", 0..11, "a root of order 100000000000000000000 is too high: at most 100 is allowed"),
        ("1 + 2^200_000", 4..13, size),
        ("2^(10^20)", 0..9, size),
        ("0.5^200_000", 0..11, size),
        ("10^10000*10^10000*10^10000*10^10000", 0..35, size),
        ("sqrt(2)^200_000", 0..15, size),
        ("sqrt(2)^-200_000", 0..16, size),
        ("sqrt(2)^(10^9)", 0..14, size),
        ("sqrt(10^9000 + 1) - 10^4500", 0..27, "the value cannot be computed to 5 digits: its terms almost cancel"),
    ];
    for (text, range, message) in table {
        let error = evaluate(&parse(text).unwrap(), &names(), 5).expect_err(text);
        assert_eq!((error.to_string().as_str(), error.range), (message, range), "{text}");
    }
}

#[test]
fn without_names_the_hint_says_so() {
    let error = exact("1 + x").unwrap_err();
    assert_eq!(error.to_string(), "unknown name `x`; the only known name is `pi`");
    assert_eq!(error.range(), 4..5);
    let error = exact("1 + ").unwrap_err();
    assert_eq!(error.to_string(), "unexpected end: a number, a name or `(` should follow `+`");
    assert_eq!(error.range(), 3..3);
}

proptest! {
    #[test]
    fn any_formula_gives_a_value_or_a_fault(
        powers in "((sqrt|cbrt)\\()?([0-4][-+*/^]){0,8}[0-4]\\)?",
        calls in "((exp|log|sin|cos|tan|sinh|cosh|tanh|atan|asin|acos)\\(-?(pi|[0-4])[-+*/]){0,6}(pi|[0-4])",
    ) {
        for text in [powers, format!("{calls}{}", ")".repeat(calls.matches('(').count()))] {
            if let Ok(tree) = parse(&text)
                && let Err(error) = evaluate(&tree, &BTreeMap::new(), 5)
            {
                prop_assert!(text.get(error.range).is_some_and(|part| !part.is_empty()), "{}", text);
            }
        }
    }
}
