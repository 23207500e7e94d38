//! Formulas as nodes: equal formulas are one node, invalid ones are rejected with their place, sizes stay moderate.

use super::support::{names, program};
use shadowstep_schemes::symbolic::{Graph, Node, Place, Rational, parse};

fn build(graph: &mut Graph, text: &str) -> Node {
    let tree = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    graph.build(&tree, &names("x y z"), &names("a m_1 omega")).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn error(text: &str) -> (String, std::ops::Range<usize>) {
    let error = Graph::new().build(&parse(text).unwrap(), &names("x y z"), &names("a m_1 omega")).expect_err(text);
    (error.to_string(), error.range)
}

fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

#[test]
fn equal_formulas_are_one_node() {
    let table = [
        ("x + y", "y + x"),
        ("x - x", "0"),
        ("0*exp(x)", "0"),
        ("x*1 + 0", "x"),
        ("x^0", "1"),
        ("x + x + y", "y + 2*x"),
        ("x*x*x", "x^3"),
        ("x/x", "1"),
        ("x/y", "x*y^-1"),
        ("1/(1/x)", "x"),
        ("2*(x + y)", "2*x + 2*y"),
        ("-(x - y)", "y - x"),
        ("(x - y)^2", "(y - x)^2"),
        ("(x - y)^3", "-(y - x)^3"),
        ("(2*x + 2*y)^2", "4*(x + y)^2"),
        ("(-x - y)^(1/3)", "-cbrt(x + y)"),
        ("sqrt(4*x^2 + 4*y^2)", "2*sqrt(x^2 + y^2)"),
        ("(x*y)^2", "x^2*y^2"),
        ("cbrt(x*y)", "cbrt(x)*cbrt(y)"),
        ("(x^(1/3))^3", "x"),
        ("cbrt(x^3)", "x"),
        ("sqrt(x)^2", "x"),
        ("sqrt(x^3)", "x^1.5"),
        ("x*sqrt(x)", "x^(3/2)"),
        ("sqrt(x*y)*sqrt(x*y)", "x*y"),
        ("sqrt(2*x + 2)*sqrt(2*x + 2)", "2*x + 2"),
        ("sqrt(4)", "2"),
        ("(-8)^(2/3)", "4"),
        ("sqrt(2)*sqrt(2)", "2"),
        ("2^1.5", "2*sqrt(2)"),
        ("1/sqrt(2)", "sqrt(2)/2"),
        ("0.1 + 0.2", "3/10"),
        ("2^10", "1024"),
        ("sin(-x)", "-sin(x)"),
        ("sin(y - x)", "-sin(x - y)"),
        ("cos(y - x)", "cos(x - y)"),
        ("tan(-2*x)", "-tan(2*x)"),
        ("sinh(-x)*tanh(-x)", "tanh(x)*sinh(x)"),
        ("atan(-x) + asin(-x)", "-(asin(x) + atan(x))"),
        ("cosh(-x)", "cosh(x)"),
        ("exp(0) + cos(0) + cosh(0)", "3"),
        ("sin(0) + log(1) + acos(1) + atan(0)", "0"),
        ("sin(x - x)", "0"),
        ("-1/sqrt(x^2 + y^2)", "-(x*x + y*y)^(-0.5)"),
    ];
    for (one, other) in table {
        let mut graph = Graph::new();
        assert_eq!(build(&mut graph, one), build(&mut graph, other), "{one} is {other}");
    }
}

#[test]
fn different_formulas_are_different_nodes() {
    let table = [
        // |x|, and not for all signs
        ("sqrt(x^2)", "x"),
        ("(x^4)^(1/2)", "x^2 + 0*y"),
        ("(x^(2/3))^(1/2)", "cbrt(x)"),
        ("sqrt(x*y)", "sqrt(x)*sqrt(y)"),
        ("sqrt(-x)", "sqrt(x)"),
        ("exp(-x)", "exp(x)"),
        ("acos(-x)", "acos(x)"),
        ("exp(log(x))", "x"),
        // not multiplied out
        ("(x + y)^2", "x^2 + 2*x*y + y^2"),
        ("x*(x + y)", "x^2 + x*y"),
        ("a", "x"),
    ];
    for (one, other) in table {
        let mut graph = Graph::new();
        assert_ne!(build(&mut graph, one), build(&mut graph, other), "{one} is not {other}");
    }
}

#[test]
fn derivatives_by_hand() {
    let table = [
        ("a", "0"),
        ("x^3*y", "3*x^2*y"),
        ("exp(-(x^2 + y^2))", "-2*x*exp(-(x^2 + y^2))"),
        ("log(x)", "1/x"),
        ("tan(x)", "1 + tan(x)^2"),
        ("tanh(2*x)", "2*(1 - tanh(2*x)^2)"),
        ("atan(x)", "1/(1 + x^2)"),
        ("acos(x)", "-1/sqrt(1 - x^2)"),
        ("cosh(x)*sinh(y)", "sinh(x)*sinh(y)"),
        ("sqrt(y)", "0"),
    ];
    for (text, expected) in table {
        let mut graph = Graph::new();
        let node = build(&mut graph, text);
        assert_eq!(graph.derivative(node, 0), build(&mut graph, expected), "{text}");
    }
}

#[test]
fn a_derivative_that_is_not_defined_anywhere_is_allowed() {
    let mut graph = Graph::new();
    let node = build(&mut graph, "asin(sqrt(x^2)/x)");
    let derivative = graph.derivative(node, 0);
    let point = super::support::Point { coordinates: vec![0.5, 1.0, 1.0], parameters: vec![], properties: vec![] };
    assert!(!super::support::of_node(&graph, derivative, &point).is_finite());
    let program = graph.program(&[derivative]);
    assert!(!super::support::of_program(&program, &point)[0].is_finite(), "{program}");
}

#[test]
fn homogeneous_terms_give_multiples_of_themselves() {
    let table = [
        ("x^2 + a*x*y + sqrt(x^4 + y^4)", "0"),
        ("-1/sqrt(x^2 + y^2)", "3/sqrt(x^2 + y^2)"),
        ("(x^2 + y^2)/2 + x^2*y - y^3/3", "x^2*y - y^3/3"),
        ("x^4/4 + 5", "x^4/2 - 10"),
        ("y^2*sin(x/y)", "0"),
        ("a*x", "-a*x"),
        ("-cos(x)", "x*sin(x) + 2*cos(x)"),
        ("exp(-x^2 - y^2)", "2*exp(-x^2 - y^2)*(-x^2 - y^2) - 2*exp(-x^2 - y^2)"),
        ("log(x)", "1 - 2*log(x)"),
    ];
    for (text, expected) in table {
        let mut graph = Graph::new();
        let node = build(&mut graph, text);
        assert_eq!(graph.rate(node), build(&mut graph, expected), "{text}");
    }
}

#[test]
fn degrees() {
    let table = [
        ("x^2*y", Some(ratio(3, 1))),
        ("7*a", Some(ratio(0, 1))),
        ("cbrt(x*y)", Some(ratio(2, 3))),
        ("(x^2 + y^2)^(-3/2)*x", Some(ratio(-2, 1))),
        ("exp(x/y)", Some(ratio(0, 1))),
        ("exp(x/y) + 1", Some(ratio(0, 1))),
        ("x + 1", None),
        ("x + y^2", None),
        ("sin(x)", None),
        ("x*sin(x)", None),
    ];
    for (text, expected) in table {
        let mut graph = Graph::new();
        let node = build(&mut graph, text);
        assert_eq!(graph.degree(node), expected, "{text}");
    }
}

#[test]
fn faults_have_a_message_and_a_place() {
    let smooth =
        "is not smooth: the formula is differentiated, and the modified energy exists only for smooth functions";
    let exponent = "an exponent must be a rational number; write exp(y*log(x)) for x^y";
    let table = [
        ("x + w", 4..5, "unknown name `w`; known names: x, y, z, a, m_1, omega".to_string()),
        ("2*omga", 2..6, "unknown name `omga`; did you mean `omega`? known names: x, y, z, a, m_1, omega".into()),
        ("Pi^2", 0..2, "unknown name `Pi`; did you mean `pi`? known names: x, y, z, a, m_1, omega".into()),
        ("1 + abs(x)", 4..10, format!("`abs` {smooth}")),
        ("min(x, y)", 0..9, format!("`min` {smooth}")),
        ("-floor(x)", 1..9, format!("`floor` {smooth}")),
        (
            "x*cosinus(y)",
            2..12,
            "unknown function `cosinus`; known functions: sqrt, cbrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan, \
             asin, acos"
                .into(),
        ),
        (
            "sqr(x)",
            0..6,
            "unknown function `sqr`; did you mean `sqrt`? known functions: sqrt, cbrt, exp, log, sin, cos, tan, sinh, \
             cosh, tanh, atan, asin, acos"
                .into(),
        ),
        (
            "ln(x)",
            0..5,
            "unknown function `ln`; did you mean `log`? known functions: sqrt, cbrt, exp, log, sin, cos, tan, sinh, cosh, \
             tanh, atan, asin, acos"
                .into(),
        ),
        ("sin(x, y)", 0..9, "`sin` takes one argument, not 2".into()),
        ("x + sqrt()", 4..10, "`sqrt` takes one argument, not 0".into()),
        ("2^x", 2..3, exponent.into()),
        ("2^pi", 2..4, exponent.into()),
        ("x^a", 2..3, exponent.into()),
        ("x^sqrt(2)", 2..9, exponent.into()),
        ("x^20000", 2..7, "the exponent 20000 is out of range: numerators up to 10000 and roots up to order 100 are \
            allowed".into()),
        ("x^(1/101)", 2..9, "the exponent 1/101 is out of range: numerators up to 10000 and roots up to order 100 are \
            allowed".into()),
        (
            "y + (x^1000)^1000",
            4..17,
            "the exponent 1000000 is out of range: numerators up to 10000 and roots up to order 100 are allowed".into(),
        ),
        ("x/(a - a)", 2..9, "division by zero".into()),
        ("x + (2-2)^-1", 4..9, "division by zero".into()),
        ("(x-x)^0", 0..5, "0^0 is undefined".into()),
        ("x*sqrt(1-3)", 7..10, "even root of the negative number -2: it has no real value".into()),
        ("log(2 - 2)", 0..10, "log(0) has no real value: the argument must be positive".into()),
        ("x + asin(3/2)", 4..13, "asin(3/2) has no real value: the argument must be from -1 to 1".into()),
        ("acos(-2)", 0..8, "acos(-2) has no real value: the argument must be from -1 to 1".into()),
        ("x*10^10000*10^10000*10^10000*10^10000", 0..37, "a number is too long: it has more than about 30000 \
            digits".into()),
        ("x + (10^9000)^9", 4..15, "a number is too long: it has more than about 30000 digits".into()),
    ];
    for (text, range, message) in table {
        assert_eq!(error(text), (message, range), "{text}");
    }
    let error = Graph::new().build(&parse("x").unwrap(), &[], &[]).unwrap_err();
    assert_eq!(error.to_string(), "unknown name `x`; the only known name is `pi`");
}

#[test]
fn repeated_squares_of_sums_stay_small() {
    // s ← (s + x)², thirty times: as a tree it has 2^30 leaves.
    let mut graph = Graph::new();
    let (x, y) = (graph.coordinate(0), graph.coordinate(1));
    let mut node = graph.plus(x, y);
    for _ in 0..30 {
        let sum = graph.plus(node, x);
        node = graph.power(sum, &ratio(2, 1));
    }
    let outputs = [graph.derivative(node, 0), graph.derivative(node, 1), graph.rate(node)];
    assert!(graph.size() < 2000, "{}", graph.size());
    let program = graph.program(&outputs);
    assert!(program.instructions.len() < 1000, "{}", program.instructions.len());
}

#[test]
fn deep_formulas_need_no_stack() {
    let mut graph = Graph::new();
    let mut node = graph.coordinate(0);
    let one = graph.number(ratio(1, 1));
    for _ in 0..30_000 {
        let sum = graph.plus(node, one);
        node = graph.power(sum, &ratio(-1, 1));
    }
    assert_eq!(graph.degree(node), None);
    assert_eq!(graph.derivative(node, 1), build(&mut graph, "0"));
    assert_eq!(graph.program(&[node]).cost().divisions, 30_000);
}

#[test]
fn long_products_are_rejected_and_shorter_ones_stay_small() {
    let product = |count: usize| {
        let factors: Vec<String> = (1..=count).map(|index| format!("sin({index}*x)")).collect();
        factors.join("*")
    };
    let (message, range) = error(&product(65));
    assert_eq!(message, "a product of 65 different factors is too long: at most 64 are allowed");
    assert_eq!(range, 0..product(65).len());

    let mut graph = Graph::new();
    let node = build(&mut graph, &product(64));
    let derivative = graph.derivative(node, 0);
    assert!(graph.size() < 600, "{}", graph.size());
    assert!(graph.program(&[derivative]).instructions.len() < 64 * 64);
}

#[test]
fn hostile_texts_end_soon() {
    let nested = |open: &str, close: &str, times: usize| format!("{}x{}", open.repeat(times), close.repeat(times));
    let coprime: Vec<String> = (1..150).map(|n| format!("1/({}^700)", 2 * n + 1)).collect();
    let texts = [
        nested("sin(x+", ")", 95),
        nested("(1+", "^2)", 95),
        nested("sqrt(x*x+", ")", 90),
        nested("1/(x+", ")", 60),
        nested("asin(", "^(1/97))", 90),
        format!("x*({})", vec!["x^(1/97)*y^(1/89)"; 90].join("+")),
        vec!["sin(x*y)"; 190].join("+"),
        coprime.join("+"),
    ];
    for text in texts {
        let mut graph = Graph::new();
        let tree = parse(&text).unwrap();
        // Rejected or not, it must not take long.
        if let Ok(node) = graph.build(&tree, &names("x y"), &[]) {
            let outputs = [graph.derivative(node, 0), graph.derivative(node, 1), graph.rate(node)];
            let program = graph.program(&outputs);
            assert_eq!(program.outputs, 3);
        }
        assert!(graph.size() < 20_000, "{}", graph.size());
    }
}

#[test]
fn places_of_a_program() {
    // Constants are prepared; the coordinate itself and zero are copied; equal outputs are computed once.
    let mut graph = Graph::new();
    let potential = build(&mut graph, "x^2/2 + exp(a)*(y^2 + z^2)*2/3");
    let gradient = [0, 1, 2].map(|index| graph.derivative(potential, index));
    let program = graph.program(&[gradient[0], gradient[1], gradient[1], gradient[2]]);
    assert_eq!(
        program.to_string(),
        "c0.assign_exp(p0)\n\
         c1.from_rational(4/3)\n\
         c0.multiply(c1)\n\
         out1.assign_product(c0, q1)\n\
         out3.assign_product(c0, q2)\n\
         out0.assign(q0)\n\
         out2.assign(out1)\n"
    );
    assert_eq!((program.constants, program.kept, program.scratch, program.outputs), (2, 1, 0, 4));
    assert_eq!(program.instructions[0].targets(), [Place::Output(1)]);
    assert_eq!(program.instructions[0].operands(), [Place::Constant(0), Place::Coordinate(1)]);
}

#[test]
fn pi_is_prepared_once() {
    let text = program("-cos(pi*x)/pi", "x", "", false).to_string();
    assert_eq!(
        text,
        "c1.from_rational(1)\n\
         c0.assign_atan(c1)\n\
         c0.multiply_integer(4)\n\
         s0.assign_product(c0, q0)\n\
         out0.assign_sin(s0)\n"
    );
}

#[test]
fn pi_is_a_number_like_others_unless_it_is_a_name() {
    let mut graph = Graph::new();
    let pi = build(&mut graph, "pi");
    assert_eq!(pi, graph.pi());
    assert_eq!(pi, build(&mut graph, "4*atan(1)"));
    assert_eq!(build(&mut graph, "pi*x/pi"), build(&mut graph, "x"));
    assert_eq!(graph.degree(pi), Some(ratio(0, 1)));
    let (names, expression) = (["pi".to_string()], parse("2*pi").unwrap());
    let coordinate = graph.coordinate(0);
    let parameter = graph.parameter(0);
    assert_eq!(graph.build(&expression, &names, &[]).unwrap(), graph.plus(coordinate, coordinate));
    assert_eq!(graph.build(&expression, &[], &names).unwrap(), graph.plus(parameter, parameter));
}

#[test]
fn roots_and_their_reciprocals_share_one_root() {
    let mut graph = Graph::new();
    let outputs = ["sqrt(x*x + y*y)", "1/sqrt(x*x + y*y)", "(x*x + y*y)^-2.5", "1/(x*x + y*y)"];
    let outputs = outputs.map(|text| build(&mut graph, text));
    let cost = graph.program(&outputs).cost();
    assert_eq!((cost.roots, cost.divisions), (1, 0));
}

#[test]
fn shared_denominators_are_divided_by_once() {
    let mut graph = Graph::new();
    let outputs = ["x/((y + 1)*(z + 1))", "y/((y + 1)*(z + 1))", "z/((y + 1)*(z + 1))"];
    let outputs = outputs.map(|text| build(&mut graph, text));
    assert_eq!(graph.program(&outputs).cost().divisions, 1);
    let single = build(&mut graph, "x/(y*z)");
    assert_eq!(graph.program(&[single]).cost().to_string(), "1 multiplication, 1 division");
}

#[test]
fn sums_share_parts_of_either_sign() {
    let texts = ["exp(x + y)", "sqrt(x + y + a)", "sin(x - y + z)", "cos(y - x + 2)", "exp(-x - y + z)", "exp(x - y)"];
    let mut graph = Graph::new();
    let outputs = texts.map(|text| build(&mut graph, text));
    let program = graph.program(&outputs);
    // x + y and x − y, and one more for each of the other four.
    assert_eq!(program.cost().additions, 6, "{program}");
    let point = super::support::Point {
        coordinates: vec![0.3, 0.45, 1.7],
        parameters: vec![0.2, 0.0, 0.0],
        properties: vec![],
    };
    let found = super::support::of_program(&program, &point);
    for (output, found) in outputs.into_iter().zip(found) {
        let expected = super::support::of_node(&graph, output, &point);
        assert!((found - expected).abs() < 1e-14, "{found} instead of {expected}\n{program}");
    }
}

#[test]
fn powers_take_few_multiplications() {
    let table = [
        ("x^15", "6 multiplications"),
        ("x^(5/3)", "2 multiplications, 1 root"),
        ("x^-2.5", "3 multiplications, 1 root"),
        ("(x*y)^8", "4 multiplications"),
        ("x^-3", "2 multiplications, 1 division"),
        ("x^1.5", "1 multiplication, 1 root"),
    ];
    for (text, cost) in table {
        let mut graph = Graph::new();
        let node = build(&mut graph, text);
        assert_eq!(graph.program(&[node]).cost().to_string(), cost, "{text}");
    }
}
