//! Protects derivatives by numbers of the text, of each kind of split and scheme: forwards beside differences of runs
//! at nearby values, with 60 digits; backwards beside those forwards.

use shadowstep::tables::Source;
use shadowstep::{Rational, StepSize};

use super::forward::Derivatives;
use super::*;
use crate::document::library;
use crate::motion::propagator::for_system;
use crate::scene::System;

const STEPS: u64 = 25;
const EVERY: u64 = 10;

fn system(text: &str, arithmetic: Arithmetic) -> System {
    let source = Source { path: "test".to_owned(), text: text.to_owned() };
    System::read(&source, arithmetic).unwrap_or_else(|error| panic!("{text}: {error}")).0
}

fn step(text: &str) -> StepSize {
    StepSize::try_from(text).unwrap()
}

/// Runs of a problem with the number θ in its text or in its step size.
struct Case {
    text: String,
    scheme: &'static str,
    h: &'static str,
    theta: &'static str,
}

fn case(text: impl Into<String>, scheme: &'static str, h: &'static str, theta: &'static str) -> Case {
    Case { text: text.into(), scheme, h, theta }
}

impl Case {
    fn at(&self, theta: &str) -> (String, StepSize) {
        (self.text.replace('θ', theta), step(&self.h.replace('θ', theta)))
    }

    fn with<R>(&self, arithmetic: Arithmetic, use_it: impl FnOnce(Differentiation<'_>) -> R) -> R {
        let precise = precise(arithmetic).unwrap();
        let (text, h) = self.at(self.theta);
        let nearby = [1, 2].map(|times| {
            let (text, h) = self.at(&format!("({}) + {times}e-{}", self.theta, digits_of_distance(arithmetic)));
            (Box::new(system(&text, precise)), h)
        });
        let posed = system(&text, arithmetic);
        let scheme = for_system(library::scheme(self.scheme).unwrap(), &posed).unwrap();
        let parameter = Parameter { name: "θ".to_owned(), nearby };
        let by = [Variable::Position(0), Variable::Momentum(posed.p.len() - 1), Variable::Parameter(parameter)];
        let run = Run { propagator: &scheme.name, h: &h, steps: STEPS, order: None, windows: Run::WINDOWS };
        use_it(Differentiation {
            system: &posed,
            precise: &system(&text, precise),
            scheme: &scheme.scheme,
            run,
            arithmetic,
            displaced: false,
            every: EVERY,
            by: &by,
        })
    }

    fn forward(&self, arithmetic: Arithmetic) -> Derivatives {
        self.with(arithmetic, |request| {
            request.forward(&mut ()).unwrap_or_else(|error| panic!("{}: {error}", self.text))
        })
    }

    /// The derivative by θ beside the difference of two runs.
    fn check_forward(&self) {
        let arithmetic = Arithmetic::with_digits(60).unwrap();
        let exact = |array: &Array| -> Vec<Rational> {
            let Array::Texts(texts) = array else { panic!("60 digits are texts") };
            texts.iter().map(|text| shadowstep::exact(text).unwrap()).collect()
        };
        let states = |theta: &str| {
            let (text, h) = self.at(theta);
            let posed = system(&text, arithmetic);
            let scheme = for_system(library::scheme(self.scheme).unwrap(), &posed).unwrap();
            let run = Run { propagator: &scheme.name, h: &h, steps: STEPS, order: None, windows: Run::WINDOWS };
            let (precise, scheme, displaced) = (&posed, &scheme.scheme, false);
            let request =
                Differentiation { system: &posed, precise, scheme, run, arithmetic, displaced, every: EVERY, by: &[] };
            exact(&request.forward(&mut ()).unwrap().states)
        };
        let (plus, minus) =
            (states(&format!("({}) + 1e-20", self.theta)), states(&format!("({}) - 1e-20", self.theta)));
        let factor = shadowstep::exact("5e19").unwrap();
        let expected: Vec<f64> = plus.iter().zip(&minus).map(|(a, b)| nearest(&((a - b) * &factor))).collect();
        let found: Vec<f64> = exact(&self.forward(arithmetic).by[2]).iter().map(nearest).collect();
        let size = expected.iter().copied().map(f64::abs).fold(0.0, f64::max);
        assert!(size > 0.0, "{}", self.text);
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-14 * size, "{}, {}: {found} {expected}", self.text, self.scheme);
        }
    }

    /// Of the function Σ c_i x_i of all states, in double precision.
    fn check_backward(&self) {
        let forward = self.forward(Arithmetic::DOUBLE);
        let doubles = |array: &Array| match array {
            Array::Doubles(numbers) => numbers.clone(),
            Array::Texts(_) => panic!("double precision has no texts"),
        };
        let count = doubles(&forward.states).len();
        let covectors: Vec<f64> = (0..count).map(|i| ((i + 1) as f64 * 2_f64.sqrt()).fract() - 0.5).collect();
        let found = self.with(Arithmetic::DOUBLE, |request| request.backward(&covectors, &mut ()).unwrap());
        assert!(found.reversal_error < 1e-11, "{}: {}", self.text, found.reversal_error);
        for (by, found) in forward.by.iter().zip(doubles(&found.by)) {
            let products: Vec<f64> = doubles(by).iter().zip(&covectors).map(|(a, b)| a * b).collect();
            let (expected, size) = (products.iter().sum::<f64>(), products.iter().map(|x| x.abs()).sum::<f64>());
            assert!((found - expected).abs() < 1e-11 * size, "{}, {}: {found} {expected}", self.text, self.scheme);
        }
    }

    /// With the derivative by θ alone, too.
    fn check_states(&self) {
        let alone = self.with(Arithmetic::DOUBLE, |request| {
            let by = &request.by[2..];
            Differentiation { by, ..request }
                .forward(&mut ())
                .unwrap_or_else(|error| panic!("{} {}: {error}", self.text, self.theta))
                .states
        });
        let plain = self.with(Arithmetic::DOUBLE, |request| {
            Differentiation { by: &[], ..request }.forward(&mut ()).unwrap().states
        });
        assert_eq!(alone, plain, "{}", self.text);
    }

    fn check(&self) {
        self.check_states();
        self.check_forward();
        self.check_backward();
    }
}

fn nearest(x: &Rational) -> f64 {
    shadowstep::Number::from_rational(x, &())
}

const OSCILLATOR: &str = "[problem]\npotential = \"k*x^2/2 + x^4/4 + x^2*y^2 + y^2\"\ncoordinates = \
    [\"x\", \"y\"]\nparameters = { k = \"θ\" }\n\
                          [initial]\nq = [1, \"1/3\"]\np = [0, \"1/7\"]\n";
const MASSES: &str = "[problem]\npotential = \"x^2/2 + x^4/4 + x^2*y^2 + y^2\"\ncoordinates = [\"x\", \"y\"]\nmasses \
    = [\"θ\", 3]\n\
                      [initial]\nq = [1, \"1/3\"]\np = [0, \"1/7\"]\n";
const BODIES: &str = "[problem]\npair = \"-m_i*m_j/sqrt(r2)\"\ndimensions = 2\nbodies = { m = [1, \"θ\", \"1/500\"] }\n\
                      [initial]\nq = [[0, 0], [1, 0], [0, 2]]\nv = [[0, 0], [0, 1], [\"-0.7\", 0]]\n";
const PLANETS: &str = "[problem]\nparts = \"wisdom-holman\"\nparameters = { g = 1 }\n[[body]]\nname = \"sun\"\nmass = \
    1\nq = [0, 0, 0]\nv = [0, 0, 0]\n\
                       [[body]]\nname = \"a\"\nmass = \"θ\"\nq = [1, 0, 0]\nv = [0, 1, \"1/10\"]\n\
                       [[body]]\nname = \"b\"\nmass = \"1/2000\"\nq = [0, 2, 0]\nv = [\"-0.7\", 0, 0]\n";

/// Of formulas, of shipped problems, of bodies and of the energies beside their attraction, of other splits; masses, and
/// those that are one; the step size.
#[test]
fn by_numbers_of_all_kinds() {
    for scheme in ["stormer-verlet", "blanes-moan-srkn6b", "chin-4a", "takahashi-imada"] {
        case(OSCILLATOR, scheme, "1/10", "2").check();
    }
    for scheme in ["yoshida4", "chin-4a", "takahashi-imada"] {
        case(OSCILLATOR.replace('θ', "2"), scheme, "θ", "1/10").check();
        case(MASSES, scheme, "1/10", "1").check();
    }
    let kepler = "[problem]\nname = \"kepler\"\nparameters = { eccentricity = \"θ\" }\n";
    let transformed = format!("{kepler}[time]\ntransform = \"power\"\nexponent = \"-1/2\"\n");
    let formulas = "[problem]\ncoordinates = [\"x\", \"y\"]\nparts = [\"px^2/2 + py^2/2 + x^2/2\", \"k*x^2*y - y^3/3 \
        + y^2/2\"]\nparameters = { k = \"θ\" }\n\
                    [initial]\nq = [\"1/5\", \"1/3\"]\np = [0, \"1/7\"]\n";
    let energies = "parameters = { g = 1, s = \"θ\" }\ncentral = \"m*s/r^3*(3*z^2/r^2 - 1)\"\nexternal = \"m*s*z^2*x\"";
    let beside = PLANETS.replace('θ', "1/300").replace("parameters = { g = 1 }", energies);
    for case in [
        case(MASSES, "yoshida4", "1/10", "3/2"),
        case(MASSES.replace("3]", "1]"), "blanes-moan-srkn6b", "1/10", "1"),
        case(kepler, "yoshida4", "1/20", "1/3"),
        case(transformed, "yoshida4", "1/20", "1/3"),
        case(formulas, "yoshida4", "1/20", "6/5"),
        case(BODIES, "yoshida4", "1/20", "1/300"),
        case(BODIES, "yoshida4", "1/20", "1"),
        case(PLANETS, "aba1064", "1/5", "1/300"),
        case(PLANETS, "aba1064", "1/50", "1"),
        case(PLANETS.replace('θ', "1/300"), "aba1064", "θ", "1/5"),
        case(&*beside, "aba1064", "1/5", "1/50"),
        case(&*beside, "chin-4a", "1/5", "1/50"),
        case(beside.replace("wisdom-holman", "kinetic-potential"), "yoshida4", "1/20", "1/50"),
    ] {
        case.check();
    }
}

/// Their flows are matrices, computed in more digits than the numbers have.
#[test]
fn by_what_a_matrix_depends_on() {
    let initial = "[initial]\nq = [\"1/5\", \"1/3\"]\np = [\"1/9\", \"1/7\"]\n";
    let quadratic = format!(
        "[problem]\ncoordinates = [\"x\", \"y\"]\nparts = [\"px^2/2 + py^2/2 + k*x^2/2 + x*py - k^2*y*px + \
            y^2\", \"x^4/4 + k*sin(x)*y^2\"]\nparameters = {{ k = \"θ\" }}\n{initial}"
    );
    let linear = format!(
        "[problem]\ncoordinates = [\"x\", \"y\"]\npotential = \"k*x^2 + x*y + 2*y^2 + k*x^2*y - y^3/3\"\nmasses = \
            [1, \"m\"]\nparameters = {{ k = 5, m = 2 }}\nparts = \"linear\"\n{initial}"
    );
    for scheme in ["stormer-verlet", "yoshida4"] {
        case(quadratic.clone(), scheme, "1/10", "6/5").check();
        // nilpotent at 0
        let nilpotent = quadratic
            .replace("k*x^2/2 + x*py - k^2*y*px + y^2", "k*x^2/2 + x*py")
            .replace("py^2/2 + ", "")
            .replace("k*sin", "sin");
        case(nilpotent, scheme, "1/100", "0").check();
        case(quadratic.replace('θ', "6/5"), scheme, "θ", "1/10").check();
        case(linear.replace("k = 5", "k = \"θ\""), scheme, "1/4", "5").check();
        case(linear.replace("m = 2", "m = \"θ\""), scheme, "1/4", "2").check();
        case(linear.clone(), scheme, "θ", "1/4").check();
    }
}

/// At these values formulas have fewer constants than beside them.
#[test]
fn derivatives_follow_the_symbol_whatever_its_value() {
    let of_parts = |parts: &str| {
        format!(
            "[problem]\ncoordinates = [\"x\", \"y\"]\nparts = [{parts}]\nparameters = {{ k = \"θ\" }}\n[initial]\nq = \
                [\"4/5\", \"1/3\"]\np = [\"1/9\", \"1/7\"]\n"
        )
    };
    let texts = [
        of_parts(r#""px^2/2 + py^2/2", "k*x^2/2 + x^4/4 + k^2*x*y^2/1000", "y^2/2""#),
        of_parts(r#""px^2/2 + py^2/2 + k*(x*py - y*px) + k*y^2/20", "k*x^4/400 - cos(k*y/10)""#),
        of_parts(r#""k*(x^2 + px^2)^2/100 + (y*py)^2*k/10", "k*x^4/4 + y^2/2", "py^2*y^2*k/100""#),
        of_parts(r#""-k*px^2*x^3/500 + py^2/2", "k*x^2/2 + y^2/2", "px^2/2""#),
        of_parts(r#""px^2/2 + py^2/2", "k*x^2/2 + k*x*cos(k*t) + y^2/2""#),
        of_parts(r#""px^2/2 + py^2/2", "k*x^2/2 + y^4/4""#)
            .replace("parts = [\"px^2/2 + py^2/2\", ", "vector_potential = [\"-k*y/2\", \"k*x/2\"]\npotential = ")
            .replace("4/4\"]", "4/4\""),
    ];
    for (i, theta) in ["1", "2", "3", "1/2", "1/3", "1/10", "-1", "100", "0", "7/5"].into_iter().enumerate() {
        for (j, text) in texts.iter().enumerate() {
            let case = case(text.clone(), "yoshida4", "1/100", theta);
            case.check_forward();
            // each text and each value at times
            if (i + j) % 4 == 0 {
                case.check_states();
                case.check_backward();
            }
        }
    }
    let kepler = of_parts(r#""px^2/2 + py^2/2 - k/sqrt(x^2 + y^2)", "k*x^2/2 + (y*px - x*py)""#);
    let arenstorf =
        of_parts(r#""px^2/2 + py^2/2 + y*px - x*py", "-(1 - k)/sqrt((x + k)^2 + y^2) - k/sqrt((x - 1 + k)^2 + y^2)""#);
    for theta in ["1", "2", "1/3", "1/80"] {
        for text in [&kepler, &arenstorf] {
            case(text.clone(), "yoshida4", "1/100", theta).check();
        }
    }
}

/// Where nothing depends on the number, all derivatives are 0.
#[test]
fn a_number_without_effect_has_derivatives_of_zero() {
    let text = OSCILLATOR.replace("k*x^2/2", "k*c*x^2/2").replace("k = ", "c = 0, k = ");
    let case = case(text, "yoshida4", "1/20", "3");
    let Array::Doubles(found) = &case.forward(Arithmetic::DOUBLE).by[2] else {
        panic!("double precision has no texts")
    };
    assert!(found.iter().all(|x| *x == 0.0), "{found:?}");
}

#[test]
fn too_many_digits_are_refused() {
    let long = |digits| precise(Arithmetic::with_digits(digits).unwrap());
    let refused = long(139).unwrap_err().to_string();
    assert!(long(138).is_ok() && refused.contains("use 138 digits"), "{refused}");
}
