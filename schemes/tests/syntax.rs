//! Text to tree: grouping, literals, ranges, messages and limits.

use proptest::prelude::*;
use shadowstep_schemes::symbolic::{Expression, ExpressionKind, Operation, Rational, parse};

/// The tree with every pair of parentheses written.
fn grouped(expression: &Expression) -> String {
    match &expression.kind {
        ExpressionKind::Number(value) => value.to_string(),
        ExpressionKind::Name(name) => name.clone(),
        ExpressionKind::Negate(inner) => format!("(-{})", grouped(inner)),
        ExpressionKind::Binary(operation, left, right) => {
            let symbol = match operation {
                Operation::Add => '+',
                Operation::Subtract => '-',
                Operation::Multiply => '*',
                Operation::Divide => '/',
                Operation::Power => '^',
            };
            format!("({}{symbol}{})", grouped(left), grouped(right))
        }
        ExpressionKind::Call { function, arguments } => {
            let arguments: Vec<String> = arguments.iter().map(grouped).collect();
            format!("{function}[{}]", arguments.join(","))
        }
    }
}

#[test]
fn operators_group_as_in_mathematics() {
    let table = [
        ("1+2*3", "(1+(2*3))"),
        ("1-2-3+4", "(((1-2)-3)+4)"),
        ("8/4/2*3", "(((8/4)/2)*3)"),
        ("2^3^2", "(2^(3^2))"),
        ("-2^2", "(-(2^2))"),
        ("2^-1", "(2^(-1))"),
        ("2^-(1/3)", "(2^(-(1/3)))"),
        ("2^-x^2*3", "((2^(-(x^2)))*3)"),
        ("--x", "(-(-x))"),
        ("+x - +y", "(x-y)"),
        ("2*-x", "(2*(-x))"),
        ("-x*y", "((-x)*y)"),
        ("(1+2)*3", "((1+2)*3)"),
        ("f(x)^2", "(f[x]^2)"),
        ("f(a, g(b + 1), -c)", "f[a,g[(b+1)],(-c)]"),
        ("f()", "f[]"),
        (" \t1\n+ 2 ", "(1+2)"),
        ("e1 + _a_2 + E", "((e1+_a_2)+E)"),
    ];
    for (text, expected) in table {
        assert_eq!(grouped(&parse(text).unwrap()), expected, "{text}");
    }
}

#[test]
fn literals_are_exact() {
    let table = [
        ("0", "0"),
        ("007", "7"),
        ("1_000_000", "1000000"),
        ("0.1", "1/10"),
        (".5", "1/2"),
        ("3.", "3"),
        ("1e-3", "1/1000"),
        ("2.5E+7", "25000000"),
        ("1_2.3_4e1_0", "123400000000"),
        ("0.1e1", "1"),
        ("0e5", "0"),
    ];
    for (text, expected) in table {
        let expected: Rational = expected.parse().unwrap();
        assert_eq!(parse(text).unwrap().kind, ExpressionKind::Number(expected), "{text}");
    }
}

#[test]
fn every_part_knows_its_bytes() {
    let text = " (a + 1) * cbrt( -2.5 )";
    let product = parse(text).unwrap();
    assert_eq!(&text[product.range.clone()], "(a + 1) * cbrt( -2.5 )");
    let ExpressionKind::Binary(Operation::Multiply, sum, call) = product.kind else { panic!("not a product") };
    assert_eq!(&text[sum.range.clone()], "(a + 1)");
    let ExpressionKind::Binary(Operation::Add, a, one) = sum.kind else { panic!("not a sum") };
    assert_eq!([&text[a.range], &text[one.range]], ["a", "1"]);
    assert_eq!(&text[call.range.clone()], "cbrt( -2.5 )");
    let ExpressionKind::Call { arguments, .. } = call.kind else { panic!("not a call") };
    assert_eq!(&text[arguments[0].range.clone()], "-2.5");
    let ExpressionKind::Negate(number) = &arguments[0].kind else { panic!("not negated") };
    assert_eq!(&text[number.range.clone()], "2.5");
}

#[test]
fn errors_say_what_was_found_and_what_is_right() {
    let table = [
        ("", 0..0, "the formula is empty: write a number or a formula"),
        ("  ", 0..0, "the formula is empty: write a number or a formula"),
        ("2 * ", 3..3, "unexpected end: a number, a name or `(` should follow `*`"),
        ("(", 1..1, "unexpected end: a number, a name or `(` should follow `(`"),
        ("-", 1..1, "unexpected end: a number, a name or `(` should follow `-`"),
        ("2 * / 3", 4..5, "unexpected `/`: a number, a name or `(` should follow `*`"),
        ("()", 1..2, "unexpected `)`: a number, a name or `(` should follow `(`"),
        ("f(1,)", 4..5, "unexpected `)`: a number, a name or `(` should follow `,`"),
        ("* 2", 0..1, "unexpected `*`: a formula begins with a number, a name, a sign or `(`"),
        ("1 + 3 x", 4..7, "an operator is missing between `3` and `x`"),
        ("(1)(2)", 2..4, "an operator is missing between `)` and `(`"),
        ("(1 2)", 1..4, "an operator is missing between `1` and `2`"),
        ("2e", 0..2, "an operator is missing between `2` and `e`"),
        ("1__0", 0..4, "an operator is missing between `1` and `__0`"),
        ("2 ** 3", 2..4, "`**` is not an operator; write `^` for a power"),
        ("2 × 3", 2..4, "unknown character `×`; write `*`"),
        ("√2", 0..3, "unknown character `√`; write `sqrt(x)`"),
        ("1 − 2", 2..5, "unknown character `−`; write `-`"),
        ("[1]", 0..1, "unknown character `[`; write `(`"),
        ("1 # 2", 2..3, "unknown character `#`"),
        ("1\u{0}", 1..2, "unknown character `\\0`"),
        ("1 + .", 4..5, "a `.` without digits"),
        ("1)", 1..2, "`)` has no `(`"),
        (")", 0..1, "unexpected `)`: a formula begins with a number, a name, a sign or `(`"),
        ("2*(1+(3)", 2..3, "unexpected end: this `(` has no `)`"),
        ("f(1", 1..2, "unexpected end: this `(` has no `)`"),
        ("0,5", 1..2, "`,` is only allowed between the arguments of a function; the decimal point is `.`"),
        ("1e10001", 0..7, "the exponent of this number is out of range: -10000 to 10000 is allowed"),
        ("1e-99999999999999999999", 0..23, "the exponent of this number is out of range: -10000 to 10000 is allowed"),
    ];
    for (text, range, message) in table {
        let error = parse(text).expect_err(text);
        assert_eq!((error.message.as_str(), error.range), (message, range), "{text}");
    }
}

#[test]
fn depth_and_length_are_limited() {
    let nested = |depth| format!("{}1{}", "(".repeat(depth), ")".repeat(depth));
    let signs = |depth| format!("{}1", "-".repeat(depth));
    let towers = |depth| format!("{}1", "1^".repeat(depth));
    let sums = |depth| format!("{}1", "1+".repeat(depth));
    let calls = |depth| format!("{}1{}", "f(".repeat(depth), ")".repeat(depth));
    let forms: [&dyn Fn(usize) -> String; 5] = [&nested, &signs, &towers, &sums, &calls];
    for form in forms {
        assert!(parse(&form(199)).is_ok(), "{}", form(3));
        for depth in [201, 3000] {
            let error = parse(&form(depth)).expect_err(&form(3));
            let message = "nested more than 200 levels deep: group a long chain of operators by parentheses";
            assert_eq!(error.message, message);
        }
    }
    // Groups of a chain make it lower.
    let group = format!("({})", sums(99));
    assert!(parse(&vec![group; 40].join("+")).is_ok());

    assert!(parse(&"1".repeat(10_000)).is_ok());
    let error = parse(&"1".repeat(10_001)).unwrap_err();
    assert_eq!(error.message, "a formula of 10001 bytes is too long: at most 10000 are allowed");
}

fn ranges_nest(expression: &Expression) -> bool {
    let inside = |part: &Expression| {
        expression.range.start <= part.range.start && part.range.end <= expression.range.end && ranges_nest(part)
    };
    match &expression.kind {
        ExpressionKind::Number(_) | ExpressionKind::Name(_) => !expression.range.is_empty(),
        ExpressionKind::Negate(inner) => inside(inner),
        ExpressionKind::Binary(_, left, right) => left.range.end <= right.range.start && inside(left) && inside(right),
        ExpressionKind::Call { arguments, .. } => arguments.iter().all(inside),
    }
}

proptest! {
    #[test]
    fn any_text_gives_a_tree_or_an_error_within_the_text(text in "([a-c0-9.,_e^*/()+ -]|[×√é²\\PC]){0,30}") {
        match parse(&text) {
            Ok(tree) => prop_assert!(ranges_nest(&tree)),
            Err(error) => prop_assert!(text.get(error.range).is_some()),
        }
    }

    #[test]
    fn grouping_is_kept_when_it_is_written_out(text in "([a-c1-9][-+*/^]){0,12}[a-c1-9]") {
        let tree = grouped(&parse(&text).unwrap());
        prop_assert_eq!(grouped(&parse(&tree).unwrap()), tree);
    }
}
