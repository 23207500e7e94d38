//! The functions and π in [`evaluate`]: correctly rounded, exact where possible, rejected where they have no value.

use std::collections::BTreeMap;

use num_traits::Signed;
use proptest::prelude::*;
use rug::Float;
use shadowstep_schemes::symbolic::decimal::{from_text, round_significant};
use shadowstep_schemes::symbolic::{
    Budget, Exact, Function, Rational, SemanticError, evaluate, evaluate_within, parse,
};

fn evaluated(text: &str, digits: u32) -> Result<Exact, SemanticError> {
    evaluate(&parse(text).unwrap(), &BTreeMap::new(), digits)
}

fn value(text: &str, digits: u32) -> Rational {
    evaluated(text, digits).unwrap_or_else(|error| panic!("{text}: {error}")).value
}

fn ten_to_minus(places: u32) -> Rational {
    from_text(&format!("1e-{places}")).unwrap()
}

// ---- values ----

/// Computed by mpmath 1.3.0 with 160 digits, rounded to 60. (Functions of a number are below, beside those of MPFR.)
const KNOWN: [(&str, &str); 9] = [
    ("pi", "3.14159265358979323846264338327950288419716939937510582097494"),
    ("log(1e-300)", "-690.775527898213705205397436405309262280330446588631892809998"),
    ("pi^2/6", "1.64493406684822643647241516664602518921894990120679843773556"),
    ("exp(pi)", "23.1406926327792690057290863679485473802661062426002119934450"),
    ("exp(pi*sqrt(163)) - 262537412640768744", "-7.49927402801814311120646143662663009137292462589621789352090e-13"),
    ("log(2)/log(3)", "0.630929753571457437099527114342760854299585640131880427870655"),
    ("sin(355/113*1000)", "0.000266764185898459765269173093363951200075386778486714102607893"),
    ("cos(1e22)", "0.523214785395138945497594473384709492140919972439387953527211"),
    ("sin(exp(100))", "0.142198123658238637772450306478685256334737609563878023658927"),
];

#[test]
fn known_values() {
    for (text, expected) in KNOWN {
        let expected = Exact { value: from_text(expected).unwrap(), rounded: true };
        assert_eq!(evaluated(text, 60).unwrap(), expected, "{text}");
    }
}

#[test]
fn fewer_digits_are_those_of_more_digits_rounded() {
    for (text, _) in KNOWN {
        let long = value(text, 700);
        for digits in [1, 2, 17, 53, 320] {
            assert_eq!(value(text, digits), round_significant(&long, digits), "{text} to {digits} digits");
        }
    }
}

/// The function as MPFR computes it, with far more digits than are asked for here.
fn by_mpfr(function: Function, x: &Rational) -> Option<Rational> {
    let argument: rug::Rational = x.to_string().parse().unwrap();
    let x = Float::with_val(3000, argument);
    let value = match function {
        Function::Exp => x.exp(),
        Function::Log => x.ln(),
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        Function::Tanh => x.tanh(),
        Function::Atan => x.atan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
    };
    Some(value.to_rational()?.to_string().parse().unwrap())
}

/// Numbers of many sizes, as text: n/d · 2^e.
fn argument() -> impl Strategy<Value = Rational> {
    (-5000i64..5000, 1i64..5000, -60i32..20).prop_map(|(n, d, e)| {
        let two = Rational::from_integer(2.into());
        Rational::new(n.into(), d.into()) * two.pow(e)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn every_function_is_correctly_rounded(index in 0..Function::ALL.len(), x in argument(), digits in 1u32..400) {
        let function = Function::ALL[index];
        let grows = matches!(function, Function::Exp | Function::Sinh | Function::Cosh);
        // MPFR's result would have more digits than anybody can wait for.
        let x = if grows { x / Rational::from_integer((1 << 20).into()) } else { x };
        let found = evaluated(&format!("{function}({x})"), digits);
        match by_mpfr(function, &x) {
            None => prop_assert!(found.is_err(), "{function} has no value here"),
            Some(expected) => prop_assert_eq!(found.unwrap().value, round_significant(&expected, digits)),
        }
    }
}

#[test]
fn rational_values_are_exact() {
    for (texts, expected) in [
        ("log(1), log(exp(0)), sin(0), tan(0), sinh(0), tanh(0), atan(0), asin(0), acos(1)", 0),
        ("exp(0), exp(1 - 1), cos(0), cosh(0)", 1),
    ] {
        let expected = Exact { value: Rational::from_integer(expected.into()), rounded: false };
        for text in texts.split(", ") {
            assert_eq!(evaluated(text, 5).unwrap(), expected, "{text}");
        }
    }
    // of a rounded number the value is one that was rounded
    let names = BTreeMap::from([("x".to_string(), Exact { value: Rational::from_integer(0.into()), rounded: true })]);
    let found = evaluate(&parse("cos(x)").unwrap(), &names, 5).unwrap();
    assert_eq!(found, Exact { value: Rational::from_integer(1.into()), rounded: true });
}

// ---- identities ----

#[test]
fn inverse_functions_give_back_the_argument() {
    let anywhere = ["log(exp(_))", "log(cosh(_) + sinh(_))", "tan(atan(_))"];
    let positive = ["exp(log(_))", "exp(log(_)/3)^3"];
    let small = ["sin(asin(_))", "cos(acos(_))", "asin(sin(_))", "atan(tan(_))"];
    for x in ["1/7", "2", "-3/5", "1e-9", "-1e-30", "17/3", "200", "1 - 1e-30"] {
        let exact = value(x, 1);
        let mut texts = anywhere.to_vec();
        if exact.is_positive() {
            texts.extend(positive);
        }
        if exact.abs() < Rational::from_integer(1.into()) {
            texts.extend(small);
        }
        for text in texts {
            for digits in [1, 16, 50, 320] {
                let text = text.replace('_', &format!("({x})"));
                assert_eq!(value(&text, digits), round_significant(&exact, digits), "{text}");
            }
        }
    }
}

#[test]
fn pi_is_that_of_mpfr() {
    let pi = Float::with_val(4000, rug::float::Constant::Pi).to_rational().unwrap();
    let pi: Rational = pi.to_string().parse().unwrap();
    for digits in [1, 2, 30, 101, 1000] {
        assert_eq!(value("pi", digits), round_significant(&pi, digits), "{digits} digits");
    }
}

// ---- limits ----

#[test]
fn tiny_arguments_and_results_keep_their_digits() {
    let table = [
        ("sin(1e-1000)", "1e-1000"),
        ("tan(-1e-1000)", "-1e-1000"),
        ("sinh(1e-1000)", "1e-1000"),
        ("tanh(1e-1000)", "1e-1000"),
        ("atan(1e-1000)", "1e-1000"),
        ("asin(1e-1000)", "1e-1000"),
        ("log(1 + 1e-1000)", "1e-1000"),
        ("cos(1e-1000)", "1"),
        ("exp(-1e-1000)", "1"),
        ("acos(1 - 2e-1000)", "2e-500"),
        // x³/6 is the first term that differs
        ("(1e-20 - sin(1e-20))*6", "1e-60"),
        ("(sinh(1e-20) - 1e-20)*6", "1e-60"),
        ("(1 - cos(1e-20))*2", "1e-40"),
        ("(exp(1e-20) - 1 - 1e-20)*2", "1e-40"),
        ("(1e-20 - log(1 + 1e-20))*2", "9.9999999999999999999e-41"),
        // 22 digits of pi: its sine is what it lacks, 3.8462643383279502884e-22
        ("sin(3.141592653589793238462)", "6.4338327950288419717e-22"),
        ("cos(3.141592653589793238462/2)*2", "6.4338327950288419717e-22"),
        ("-2/tan(3.141592653589793238462/2)", "-6.4338327950288419717e-22"),
    ];
    for (text, expected) in table {
        assert_eq!(value(text, 20), from_text(expected).unwrap(), "{text}");
    }
}

#[test]
fn an_exact_argument_next_to_a_zero_is_not_zero() {
    // The name holds pi to 300 digits, and its sine is the error of that, whatever the digits asked for.
    let pi = value("pi", 300);
    let error = value("pi", 400) - &pi;
    let names = BTreeMap::from([("x".to_string(), Exact { value: pi, rounded: true })]);
    let found = evaluate(&parse("sin(x)").unwrap(), &names, 5).unwrap().value;
    assert_eq!(found, round_significant(&error, 5));
    assert!(found.abs() < ten_to_minus(299));
}

#[test]
fn huge_arguments() {
    let table = [
        ("tanh(1000)", "1"),
        ("tanh(-10^9)", "-1"),
        ("tanh(10^400*sqrt(2))", "1"),
        ("1 - tanh(30)", "1.7513021525e-26"),
        ("2*atan(10^400*sqrt(2)) - pi + sqrt(2)/10^400", "0"),
        ("2*atan(10^400)", "3.1415926536"),
        ("log(10^20000)/log(10)", "20000"),
        ("log(10^-20000)/log(10)", "-20000"),
        ("log(exp(69000))", "69000"),
        ("log(exp(-69000))", "-69000"),
        ("sin(10^5000)^2 + cos(10^5000)^2", "1"),
        ("sin(10^30*pi + 1/2)/sin(1/2)", "1"),
        ("sin(exp(200))/cos(exp(200))/tan(exp(200))", "1"),
    ];
    for (text, expected) in table {
        assert_eq!(value(text, 11), from_text(expected).unwrap(), "{text}");
    }
    // MPFR, with bits enough to reduce the argument
    let x = Float::with_val(4000, Float::i_pow_u(10, 1000));
    let sin: Rational = x.sin().to_rational().unwrap().to_string().parse().unwrap();
    assert_eq!(value("sin(10^1000)", 50), round_significant(&sin, 50));
}

// ---- where more digits are needed ----

#[test]
fn what_cannot_be_distinguished_from_zero_counts_as_zero() {
    let zero = Exact { value: Rational::from_integer(0.into()), rounded: true };
    for text in [
        "sin(pi)",
        "sin(-1000*pi)",
        "cos(pi/2)",
        "tan(pi)",
        "log(2) + log(3) - log(6)",
        "exp(log(5)) - 5",
        "16*atan(1/5) - 4*atan(1/239) - pi",
        "sqrt(sin(pi))",
        "asin(cos(pi/2))",
        "cosh(1)^2 - sinh(1)^2 - 1",
        "acos(sin(pi/2))",
        "0*exp(1)",
    ] {
        for digits in [1, 30] {
            assert_eq!(evaluated(text, digits).unwrap(), zero, "{text}");
        }
    }
    assert_eq!(value("exp(sin(pi))", 30), Rational::from_integer(1.into()));
}

/// The start values of chains: zeros and small values take no more digits than others, which a budget counts.
#[test]
fn multiples_of_pi_take_one_attempt() {
    let one = Budget::new(100 * (2 * 467) * (2 * 467) + 20 * 467 * 467);
    evaluate_within(&parse("sin(pi/9)").unwrap(), &BTreeMap::new(), 120, &one).unwrap();
    for text in [
        "sin(9*pi)",
        "sin(90000*pi/9)",
        "cos(7*pi/2)",
        "tan(10^40*pi)",
        "sin(pi/10^40)",
        "cos(pi/2 - pi/10^30)",
        "sin(2*pi*3/4 - pi/2)",
        "cos(-pi)",
        "tan(5*pi/4)",
    ] {
        let one = Budget::new(100 * (2 * 467) * (2 * 467) + 20 * 467 * 467);
        assert!(evaluate_within(&parse(text).unwrap(), &BTreeMap::new(), 120, &one).is_ok(), "{text}");
    }
    // and they are right
    for (multiple, text) in [
        ("sin(12345*pi/9)", "-sqrt(3)/2"),
        ("cos(10^30*pi + pi/3)", "1/2"),
        ("tan(-7*pi/4)", "1"),
        (
            "sin(pi/10^40)",
            "sin(3.141592653589793238462643383279502884197169399375105820974944592307816406286208998628e-40)",
        ),
        (
            "cos(pi/2 - pi/10^30)*10^30",
            "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899863",
        ),
        (
            "tan(pi/2 + pi/10^30)/10^30",
            "-0.318309886183790671537767526745028724068919291480912897495334688117793595268453070180",
        ),
    ] {
        assert_eq!(value(multiple, 50), round_significant(&value(text, 70), 50), "{multiple}");
    }
}

#[test]
fn what_cannot_be_distinguished_from_a_boundary_counts_as_the_boundary() {
    let table = [
        ("asin(sin(pi/2))", "pi/2"),
        ("asin(-sin(pi/2))", "-pi/2"),
        ("asin(1 + sin(pi))", "pi/2"),
        ("acos(cos(pi))", "pi"),
        ("acos(exp(log(3))/3)", "0"),
        ("acos(-sqrt(2)*sqrt(2)/2)", "pi"),
    ];
    for (text, expected) in table {
        assert_eq!(value(text, 30), value(expected, 30), "{text}");
    }
}

#[test]
fn more_digits_distinguish_near_numbers() {
    // inside, and the distance is known
    assert_eq!(value("acos(1 - 1e-60*sin(1)^2/sin(1)^2)", 5), value("sqrt(2)*1e-30", 5));
    assert_eq!(value("exp(log(1e-70 + sin(pi)))", 10), ten_to_minus(70));
    // an argument of 10^39 times a difference that is 0
    assert_eq!(value("exp(1e40*(sqrt(2)*sqrt(3) - sqrt(6)))", 5), Rational::from_integer(1.into()));
    assert_eq!(value("cos(1e40*(sqrt(2)*sqrt(3) - sqrt(6)))", 5), Rational::from_integer(1.into()));
    // outside
    let error = evaluated("asin(1 + 1e-60*exp(1)/exp(1))", 10).unwrap_err();
    assert_eq!(error.to_string(), "asin(1 + 1e-60) has no real value: the argument must be from -1 to 1");
}

// ---- names ----

#[test]
fn pi_may_be_the_name_of_something_else() {
    let three = Exact { value: Rational::from_integer(3.into()), rounded: false };
    let names = BTreeMap::from([("pi".to_string(), three)]);
    let found = evaluate(&parse("2*pi").unwrap(), &names, 30).unwrap();
    assert_eq!(found, Exact { value: Rational::from_integer(6.into()), rounded: false });
}

// ---- faults ----

#[test]
fn faults_have_a_message_and_a_place() {
    let known = "known functions: sqrt, cbrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan, asin, acos";
    let positive = "the argument must be positive";
    let within = "the argument must be from -1 to 1";
    let size = "a number is too long: it has more than about 30000 digits";
    let vague = "is not known to within 1: it is too large, or its terms almost cancel";
    let table = [
        ("log(0)", 4..5, format!("log(0) has no real value: {positive}")),
        ("1 + log(1/3 - 2)", 8..15, format!("log(-1.66666666667) has no real value: {positive}")),
        ("log(sin(4))", 4..10, format!("log(-0.756802495308) has no real value: {positive}")),
        ("log(sin(pi))", 4..11, format!("log(0) has no real value: {positive}")),
        ("asin(3/2)", 5..8, format!("asin(1.5) has no real value: {within}")),
        ("acos(-2)", 5..7, format!("acos(-2) has no real value: {within}")),
        ("acos(-1 - 1e-40)", 5..15, format!("acos(-1 - 1e-40) has no real value: {within}")),
        ("asin(cosh(1))", 5..12, format!("asin(1.54308063482) has no real value: {within}")),
        (
            "2*tan(pi/2)",
            6..10,
            "tan(1.57079632679) has no real value: the argument cannot be distinguished from an odd multiple of pi/2"
                .into(),
        ),
        ("1/sin(pi)", 2..9, "division by zero".into()),
        ("exp(10^6)", 0..9, size.into()),
        ("1 + exp(-10^6)", 4..14, size.into()),
        ("cosh(-10^6)", 0..11, size.into()),
        ("sinh(10^6)", 0..10, size.into()),
        ("exp(exp(exp(exp(1))))", 0..21, size.into()),
        ("exp(sqrt(2)*10^400)", 0..19, size.into()),
        ("sin(exp(60000))", 4..14, format!("the argument of sin {vague}")),
        ("tan(10^9000*pi)", 4..14, format!("the argument of tan {vague}")),
        (
            "2^pi",
            2..4,
            "an exponent must be an exact rational, not an irrational or rounded number; write exp(y*log(x)) for x^y"
                .into(),
        ),
        ("sinn(1)", 0..7, format!("unknown function `sinn`; did you mean `sin`? {known}")),
        ("2*arcsin(1)", 2..11, format!("unknown function `arcsin`; did you mean `asin`? {known}")),
        ("Log(2)", 0..6, format!("unknown function `Log`; did you mean `log`? {known}")),
        ("min(1)", 0..6, format!("unknown function `min`; {known}")),
        ("abs(-1)", 0..7, format!("unknown function `abs`; {known}")),
        ("1 + atan(1, 2)", 4..14, "`atan` takes one argument, not 2".into()),
        ("exp()", 0..5, "`exp` takes one argument, not 0".into()),
        ("2*Pi", 2..4, "unknown name `Pi`; did you mean `pi`? the only known name is `pi`".into()),
        ("pi(2)", 0..5, format!("unknown function `pi`; {known}")),
    ];
    for (text, range, message) in table {
        let error = evaluated(text, 5).expect_err(text);
        assert_eq!((error.to_string(), error.range), (message, range), "{text}");
    }
}
