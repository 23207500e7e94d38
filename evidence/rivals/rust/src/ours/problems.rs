//! Parameters, masses and initial states, all rounded to doubles, so that every contestant starts with the same bits.

use num_traits::ToPrimitive as _;
use shadowstep::Rational;
use shadowstep::problems::{Setup, problem};

use crate::argon;
use crate::initial::Initial;

impl Initial {
    /// A shipped problem with its default values, or the 500 argon atoms.
    pub fn of(name: &str) -> Initial {
        if name == "argon" {
            return argon::initial();
        }
        let Setup { values, .. } = setup(name);
        let (q, p): (Vec<f64>, Vec<f64>) = (values.q(&()), values.p(&()));
        let count = values.named().len() - 2 * q.len();
        let is_parameter = |name: &str| !name.starts_with("m_") && name != "eccentricity";
        let parameters = values.named()[..count].iter().filter(|(name, _)| is_parameter(name));
        let masses = values.masses().map(|masses| masses.iter().map(|mass| double(&mass.value)).collect());
        Initial {
            parameters: parameters.map(|(_, exact)| double(&exact.value)).collect(),
            masses: masses.unwrap_or_else(|| vec![1.0; q.len()]),
            q,
            p,
        }
    }
}

/// A shipped problem with its default values, each rounded to a double.
pub fn setup(name: &str) -> Setup {
    let problem = problem(name).expect("a shipped problem");
    let exact = problem.setup(&[], 40).expect("the defaults are valid");
    let rounded = exact.values.named().iter().map(|(name, exact)| (name.clone(), exact_text(double(&exact.value))));
    problem.setup(&rounded.collect::<Vec<_>>(), 40).expect("the rounded defaults are valid")
}

fn double(exact: &Rational) -> f64 {
    exact.to_f64().expect("a finite value")
}

/// The exact value of a double as a fraction.
pub fn exact_text(number: f64) -> String {
    Rational::from_float(number).expect("a finite value").to_string()
}
