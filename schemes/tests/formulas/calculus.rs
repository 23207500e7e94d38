//! Simplification, derivatives, rates and programs of random formulas, against values computed in other ways.

use std::collections::HashMap;

use super::random::Random;
use super::support::{DIGITS, Point, Real, names, of_node, of_program, of_tree};
use rug::Float;
use rug::ops::Pow;
use shadowstep_schemes::symbolic::{Expression, Graph, Node, Rational, parse};

/// A random formula, and where it is to be computed: x, y, a, b.
struct Case {
    text: String,
    tree: Expression,
    at: [Rational; 4],
}

const NAMES: [&str; 4] = ["x", "y", "a", "b"];

fn cases(count: u64, seed: u64) -> impl Iterator<Item = Case> {
    let mut random = Random(seed);
    (0..count).filter_map(move |index| {
        let text = random.formula(2 + (index % 4) as u32);
        let at = [(); 4].map(|()| random.number());
        Some(Case { tree: parse(&text).ok()?, text, at })
    })
}

impl Case {
    /// `None` where a part of the formula that is a number has no value.
    fn build(&self) -> Option<(Graph, Node)> {
        let mut graph = Graph::new();
        let node = graph.build(&self.tree, &names("x y"), &names("a b")).ok()?;
        Some((graph, node))
    }

    fn values<R: Real>(&self) -> [R; 4] {
        self.at.each_ref().map(R::rational)
    }

    fn point<R: Real>(&self) -> Point<R> {
        let [x, y, a, b] = self.values();
        Point { coordinates: vec![x, y], parameters: vec![a, b], properties: vec![] }
    }

    /// The value of the formula as it is written.
    fn direct<R: Real>(&self, values: [R; 4]) -> R {
        of_tree(&self.tree, &NAMES.map(String::from).into_iter().zip(values).collect::<HashMap<_, _>>())
    }

    /// The direct value, if it is finite and of a size that leaves digits to compare.
    fn moderate(&self) -> Option<Float> {
        Some(self.direct(self.values())).filter(|value: &Float| value.is_finite() && *value.as_abs() < 1e30)
    }
}

/// 10^−digits
fn tiny(digits: u32) -> Float {
    Float::with_val(1000, 10).pow(-(digits as i32))
}

fn assert_near(found: &Float, expected: &Float, digits: u32, what: &str) {
    let scale = expected.clone().abs().max(&Float::with_val(1000, 1));
    let error = Float::with_val(1000, found - expected).abs() / scale;
    assert!(error < tiny(digits), "{what}: {} instead of {}", found.to_f64(), expected.to_f64());
}

/// The derivative at 0 by the central difference of order 8.
fn slope(function: impl Fn(&Float) -> Float) -> Float {
    let h = tiny(25);
    let weights = [(4, 5), (-1, 5), (4, 105), (-1, 280)];
    let mut sum = Float::new(1000);
    for (index, (numerator, denominator)) in weights.into_iter().enumerate() {
        let step = Float::with_val(1000, &h * (index as u32 + 1));
        let difference = function(&step) - function(&-step);
        sum += difference * numerator / denominator;
    }
    sum / h
}

#[test]
fn simplification_keeps_values() {
    let mut compared = 0;
    for case in cases(1500, 2) {
        let (Some((graph, node)), Some(expected)) = (case.build(), case.moderate()) else { continue };
        assert_near(&of_node(&graph, node, &case.point()), &expected, DIGITS, &case.text);
        compared += 1;
    }
    assert!(compared > 700, "{compared}");
}

#[test]
fn derivatives_are_the_limits_of_difference_quotients() {
    let mut compared = 0;
    for case in cases(700, 3) {
        let (Some((mut graph, node)), Some(_)) = (case.build(), case.moderate()) else { continue };
        for coordinate in 0..2 {
            let expected = slope(|step| {
                let mut values: [Float; 4] = case.values();
                values[coordinate] += step;
                case.direct(values)
            });
            // Beyond this size, the ninth derivative may be too large for the difference.
            if expected.is_finite() && *expected.as_abs() < 1e4 {
                let derivative = graph.derivative(node, coordinate);
                assert_near(&of_node(&graph, derivative, &case.point()), &expected, DIGITS, &case.text);
                compared += 1;
            }
        }
    }
    assert!(compared > 600, "{compared}");
}

#[test]
fn rates_are_the_slopes_along_the_ray() {
    let mut compared = 0;
    for case in cases(700, 4) {
        let (Some((mut graph, node)), Some(value)) = (case.build(), case.moderate()) else { continue };
        let radial = slope(|step| {
            let [x, y, a, b]: [Float; 4] = case.values();
            let stretch = Float::with_val(1000, step + 1u32);
            case.direct([x * &stretch, y * &stretch, a, b])
        });
        if radial.is_finite() && *radial.as_abs() < 1e4 {
            let expected = radial - value * 2u32;
            let rate = graph.rate(node);
            assert_near(&of_node(&graph, rate, &case.point()), &expected, DIGITS, &case.text);
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn programs_compute_the_values_of_their_nodes() {
    let mut compared = 0;
    for case in cases(500, 5) {
        let (Some((mut graph, node)), Some(_)) = (case.build(), case.moderate()) else { continue };
        let outputs = [graph.derivative(node, 0), graph.derivative(node, 1), graph.rate(node), node];
        let program = graph.program(&outputs);
        let expected: Vec<Float> = outputs.iter().map(|output| of_node(&graph, *output, &case.point())).collect();
        if expected.iter().all(|value| value.is_finite() && *value.as_abs() < 1e30) {
            let what = format!("{}\n{program}", case.text);
            for (found, expected) in of_program(&program, &case.point()).iter().zip(&expected) {
                assert_near(found, expected, DIGITS, &what);
            }
            // Doubles follow the same instructions; most formulas lose few of their 16 digits.
            let doubles: Vec<f64> = of_program(&program, &case.point());
            let near = |(found, expected): (&f64, &Float)| {
                (found - expected.to_f64()).abs() < 1e-6 * expected.to_f64().abs().max(1.0)
            };
            compared += usize::from(doubles.iter().zip(&expected).all(near));
        }
    }
    assert!(compared > 200, "{compared}");
}

/// Whether the last output is asked for or not, the others have the same bits.
#[test]
fn the_other_outputs_do_not_see_the_last_one() {
    let mut compared = 0;
    for case in cases(300, 7) {
        let Some((mut graph, node)) = case.build() else { continue };
        let outputs = [graph.derivative(node, 0), graph.derivative(node, 1), graph.rate(node)];
        let program = graph.program(&outputs);
        let shorter = program.without_last_output();
        let [all, fewer]: [Vec<Float>; 2] = [&program, &shorter].map(|program| of_program(program, &case.point()));
        assert_eq!((all.len(), fewer.len()), (3, 2));
        for (one, other) in all.iter().zip(&fewer) {
            assert!(one.as_ord() == other.as_ord(), "{}\n{program}\n{shorter}", case.text);
        }
        compared += usize::from(shorter.instructions.len() < program.instructions.len());
    }
    assert!(compared > 100, "{compared}");
}
