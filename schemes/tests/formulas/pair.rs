//! Pairs of bodies: slope and rate of u(r²), u(d) against the derivatives of the same formula in coordinates.

use num_traits::Zero;
use shadowstep_schemes::symbolic::{
    Graph, Operations, PotentialPrograms, Rational, Separation, Summand, is_symmetric, parse,
};

use super::support::{Point, names, of_node, of_program};

fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn pair(text: &str, separation: Separation, properties: &str, parameters: &str) -> PotentialPrograms {
    let mut graph = Graph::new();
    let tree = parse(text).unwrap();
    let energy = graph.build_pair(&tree, separation.name(), &names(properties), &names(parameters)).unwrap();
    graph.pair(energy, separation)
}

/// Pairs, without roots, so that rationals suffice; in coordinates `d` is x − X, r² is (x − X)² + (y − Y)².
const PAIRS: [(&str, Separation); 8] = [
    ("-a*m_i*m_j/r2", Separation::SquaredDistance),
    ("4*a*(b^12/r2^6 - b^6/r2^3)*(m_i + m_j)", Separation::SquaredDistance),
    ("m_i*r2*m_j/2 + b*r2^2/(1 + r2)", Separation::SquaredDistance),
    ("d^2/2 + a*d^3/3 + b*d^4/4", Separation::Difference),
    ("m_i/(1 + d^2) - m_j*d + a", Separation::Difference),
    ("r2", Separation::SquaredDistance),
    ("m_i*m_j*(r2 + a^2)^3", Separation::SquaredDistance),
    ("-m_i*m_j/(d + a^2)", Separation::Difference),
];

#[test]
fn slope_and_summand_are_those_of_the_formula_in_coordinates() {
    let (near, far) = ([ratio(1, 3), ratio(-2, 5)], [ratio(7, 4), ratio(5, 6)]);
    let parameters = vec![Some(ratio(3, 7)), Some(ratio(-5, 2))];
    let properties = vec![Some(ratio(2, 9)), Some(ratio(11, 3))];
    let mut energies = 0;
    for (text, separation) in PAIRS {
        let difference = [&far[0] - &near[0], &far[1] - &near[1]];
        let (written, at) = match separation {
            Separation::Difference => ("(x - X)", difference[0].clone()),
            Separation::SquaredDistance => {
                ("((x - X)^2 + (y - Y)^2)", &difference[0] * &difference[0] + &difference[1] * &difference[1])
            }
        };
        let programs = pair(text, separation, "m_i m_j", "a b");
        let point = Point {
            coordinates: vec![Some(at.clone())],
            parameters: parameters.clone(),
            properties: properties.clone(),
        };
        let outputs = of_program(&programs.gradient_and_rate, &point);
        let [Some(slope), Some(summand)] = &outputs[..] else { panic!("two outputs") };
        assert_eq!(of_program(&programs.gradient, &point), [Some(slope.clone())], "{text}");
        let rate = match programs.summand {
            Summand::Rate => summand.clone(),
            Summand::Energy => {
                energies += 1;
                slope * at - summand - summand
            }
        };

        // these letters are in no other name
        let text = text.replace(separation.name(), written);
        let mut graph = Graph::new();
        let tree = parse(&text).unwrap();
        let energy = graph.build(&tree, &names("x y X Y"), &names("a b m_i m_j")).unwrap();
        let slopes: Vec<_> = (0..4).map(|i| graph.derivative(energy, i)).collect();
        let radial = graph.rate(energy);
        let point = Point {
            coordinates: far.iter().chain(&near).cloned().map(Some).collect(),
            parameters: parameters.iter().chain(&properties).cloned().collect(),
            properties: vec![],
        };
        let value = |node| of_node(&graph, node, &point);
        assert_eq!(value(radial), Some(rate), "{text}");
        for axis in 0..2 {
            let expected = match separation {
                Separation::SquaredDistance => slope * &difference[axis],
                Separation::Difference if axis == 0 => slope.clone(),
                Separation::Difference => Rational::zero(),
            };
            assert_eq!(value(slopes[axis]), Some(expected.clone()), "{text}");
            assert_eq!(value(slopes[axis + 2]), Some(-expected), "{text}");
        }
    }
    assert_eq!(energies, 2, "both kinds of summands are among the pairs");
}

#[test]
fn exchanged_bodies_have_the_same_energy_or_not() {
    let symmetric =
        |text: &str, separation| is_symmetric(&parse(text).unwrap(), separation, &names("m_i m_j e_i"), &names("a"));
    for (text, expected) in [
        ("-a*m_i*m_j/sqrt(r2)", true),
        ("exp(-r2/(m_i + m_j)^2)", true),
        ("r2", true),
        ("-a*m_i*m_i/sqrt(r2)", false),
        ("(m_i - m_j)*r2", false),
        ("e_i*r2", false),
    ] {
        assert_eq!(symmetric(text, Separation::SquaredDistance), Some(expected), "{text}");
    }
    assert_eq!(symmetric("d^2", Separation::Difference), None);
}

#[test]
fn pairs_cost_what_they_cost_by_hand() {
    let cost =
        |additions, multiplications, roots| Operations { additions, multiplications, roots, ..Operations::default() };
    // 1/√r², square, cube, m m G; with the rate m m G/√r² three times
    let gravity = pair("-G*m_i*m_j/sqrt(r2)", Separation::SquaredDistance, "m_i m_j", "G");
    assert_eq!(gravity.gradient.cost(), cost(0, 5, 1), "{}", gravity.gradient);
    assert_eq!(gravity.gradient_and_rate.cost(), cost(0, 6, 1), "{}", gravity.gradient_and_rate);
    // with the energy −m m/√(r² + a²), whose product the slope has, too, in place of a rate of three more operations
    let softened = pair("-m_i*m_j/sqrt(r2 + a^2)", Separation::SquaredDistance, "m_i m_j", "a");
    assert_eq!(softened.gradient_and_rate.cost(), cost(1, 4, 1), "{}", softened.gradient_and_rate);
    assert_eq!([gravity.summand, softened.summand], [Summand::Rate, Summand::Energy]);
    // a pair of springs adds nothing to β
    let spring = pair("k*d^2/2", Separation::Difference, "", "k");
    assert_eq!(spring.gradient_and_rate.cost(), cost(0, 1, 0), "{}", spring.gradient_and_rate);
}
