//! Orbital elements → position and velocity relative to the centre of attraction.

use std::collections::BTreeMap;

use num_traits::{One, Signed};
use shadowstep::{Number, Rational, Real};
use shadowstep_symbolic::decimal::to_significant;
use shadowstep_symbolic::{Budget, Error, Exact, evaluate_within, parse};

/// The elements of an orbit, exact; angles are in degrees.
#[derive(Clone, Debug)]
pub(super) struct Elements {
    /// The semi-major axis; negative of a hyperbola.
    pub(super) a: Rational,
    /// The eccentricity.
    pub(super) e: Rational,
    /// The inclination.
    pub(super) i: Rational,
    /// Ω, the longitude of the ascending node.
    pub(super) node: Rational,
    /// ω, the argument of the pericentre.
    pub(super) pericentre: Rational,
    /// M, the mean anomaly.
    pub(super) anomaly: Rational,
}

/// A position or velocity.
pub(super) type Vector = [Rational; 3];

/// An ellipse: the equation for E by Newton's method, and position and velocity in the plane of the orbit, x to the pericentre.
const ELLIPSE: [&str; 5] = [
    "E - (E - e*sin(E) - M)/(1 - e*cos(E))",
    "a*(cos(E) - e)",
    "a*sqrt(1 - e^2)*sin(E)",
    "-sqrt(mu/a)*sin(E)/(1 - e*cos(E))",
    "sqrt(mu/a)*sqrt(1 - e^2)*cos(E)/(1 - e*cos(E))",
];

/// The same for a hyperbola.
const HYPERBOLA: [&str; 5] = [
    "E - (e*sinh(E) - E - M)/(e*cosh(E) - 1)",
    "a*(cosh(E) - e)",
    "-a*sqrt(e^2 - 1)*sinh(E)",
    "-sqrt(-mu/a)*sinh(E)/(e*cosh(E) - 1)",
    "sqrt(-mu/a)*sqrt(e^2 - 1)*cosh(E)/(e*cosh(E) - 1)",
];

/// From the plane of the orbit to space: the turns by ω, i and Ω.
const IN_SPACE: [&str; 3] = [
    "x*(cos(O)*cos(w) - sin(O)*sin(w)*cos(i)) - y*(cos(O)*sin(w) + sin(O)*cos(w)*cos(i))",
    "x*(sin(O)*cos(w) + cos(O)*sin(w)*cos(i)) + y*(cos(O)*cos(w)*cos(i) - sin(O)*sin(w))",
    "x*sin(w)*sin(i) + y*cos(w)*sin(i)",
];

impl Elements {
    /// Why these are the elements of no orbit, and what would be right.
    pub(super) fn fault(&self) -> Option<(String, &'static str)> {
        let (e, one) = (to_significant(&self.e, 6), Rational::one());
        match () {
            () if self.e.is_negative() => Some((format!("the eccentricity {e} is negative"), "it must be 0 or more")),
            () if self.e == one => {
                Some(("a parabola has no semi-major axis".to_owned(), "give q and v of this body instead"))
            }
            () if self.e < one && !self.a.is_positive() => Some((
                "the semi-major axis of an ellipse must be positive".to_owned(),
                "change the sign of a, or give an e above 1",
            )),
            () if self.e > one && !self.a.is_negative() => Some((
                format!("with e = {e} the orbit is a hyperbola, whose a is negative"),
                "change the sign of a, or give an e below 1",
            )),
            () => None,
        }
    }

    /// Position and velocity for a gravitational parameter μ, to this number of digits.
    ///
    /// # Errors
    /// A computation that takes too long.
    pub(super) fn state(&self, mu: &Rational, digits: u32) -> Result<[Vector; 2], Error> {
        let ellipse = self.e < Rational::one();
        let mut formulas = Formulas { known: BTreeMap::new(), digits, budget: Budget::default() };
        let turns = |degrees: &Rational| degrees / Rational::from_integer(360.into());
        for (name, degrees) in [("i", &self.i), ("O", &self.node), ("w", &self.pericentre), ("M", &self.anomaly)] {
            // whole turns change no sine; of a hyperbola the mean anomaly is not an angle
            let whole = if name == "M" && !ellipse { 0.0 } else { f64::from_rational(&turns(degrees), &()).round() };
            formulas.set(name, turns(degrees) - exact_value(whole));
            let angle = formulas.value(&format!("2*pi*{name}"))?;
            formulas.set(name, angle);
        }
        [("a", &self.a), ("e", &self.e), ("mu", mu)]
            .into_iter()
            .for_each(|(name, value)| formulas.set(name, value.clone()));
        let [equation, in_plane @ ..] = if ellipse { ELLIPSE } else { HYPERBOLA };
        formulas.solve(equation, ellipse)?;
        let mut values = in_plane.map(|formula| formulas.value(formula)).into_iter();
        let mut in_space = || {
            for name in ["x", "y"] {
                let value = values.next().expect("two each, of position and velocity")?;
                formulas.set(name, value);
            }
            let [x, y, z] = IN_SPACE.map(|formula| formulas.value(formula));
            Ok::<Vector, Error>([x?, y?, z?])
        };
        Ok([in_space()?, in_space()?])
    }
}

/// Evaluates formulas to some digits.
struct Formulas {
    known: BTreeMap<String, Exact>,
    digits: u32,
    budget: Budget,
}

impl Formulas {
    fn set(&mut self, name: &str, value: Rational) {
        self.known.insert(name.to_owned(), Exact { value, rounded: true });
    }

    fn value(&self, formula: &str) -> Result<Rational, Error> {
        Ok(evaluate_within(&parse(formula)?, &self.known, self.digits, &self.budget)?.value)
    }

    /// E by Newton's method from a solution in double precision: each step doubles the digits.
    fn solve(&mut self, equation: &str, ellipse: bool) -> Result<(), Error> {
        let number = |name: &str| f64::from_rational(&self.known[name].value, &());
        let nearby = nearby(number("e"), number("M"), ellipse);
        self.set("E", exact_value(nearby));
        // of E = 0 the terms of the equation cancel
        let mut digits = if nearby == 0.0 { self.digits } else { 7 };
        while digits < self.digits {
            let better = self.value(equation)?;
            self.set("E", better);
            digits *= 2;
        }
        Ok(())
    }
}

/// The double itself.
fn exact_value(x: f64) -> Rational {
    shadowstep_symbolic::decimal::from_text(&x.to_text()).expect("a finite number reads back")
}

/// E by bisection: E − e sin E and e sinh E − E grow with E.
fn nearby(e: f64, mean: f64, ellipse: bool) -> f64 {
    let excess = |x: f64| if ellipse { x - e * x.sin() - mean } else { e * x.sinh() - x - mean };
    let mut reach = 1.0;
    while excess(reach) < 0.0 || excess(-reach) > 0.0 {
        reach *= 2.0;
    }
    let (mut low, mut high) = (-reach, reach);
    loop {
        let middle = low + (high - low) / 2.0;
        // no double is between the bounds, or it is the root
        if middle == low || middle == high || excess(middle) == 0.0 {
            return middle;
        }
        if excess(middle) > 0.0 { high = middle } else { low = middle }
    }
}

#[cfg(test)]
mod tests {
    use shadowstep::exact;

    use super::*;

    fn elements(texts: [&str; 6]) -> Elements {
        let [a, e, i, node, pericentre, anomaly] = texts.map(|text| exact(text).unwrap());
        Elements { a, e, i, node, pericentre, anomaly }
    }

    /// Of what the elements are constants: the energy, the eccentricity vector and the angular momentum.
    #[test]
    fn the_orbit_has_these_elements() {
        let mu = exact("2").unwrap();
        for (texts, e) in [
            (["5.2", "0.05", "10", "100", "30", "200"], 0.05),
            (["1", "0.999", "170", "0", "359", "-1/1000"], 0.999),
            (["-3", "1.5", "90", "45", "10", "700"], 1.5),
            (["2", "0", "0", "0", "0", "90"], 0.0),
            (["2", "0.3", "20", "0", "0", "0"], 0.3),
            (["2", "0.3", "20", "0", "0", "1e-40"], 0.3),
            (["2", "0.3", "20", "10", "20", "180"], 0.3),
        ] {
            let found = elements(texts);
            let [q, v] = found.state(&mu, 50).unwrap();
            let number = |x: &Rational| f64::from_rational(x, &());
            let ([q, v], mu) = ([q, v].map(|vector| vector.map(|x| number(&x))), 2.0);
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let r = dot(q, q).sqrt();
            let a = number(&found.a);
            assert!((dot(v, v) / 2.0 - mu / r + mu / (2.0 * a)).abs() < 1e-13 * mu / r, "{texts:?}");
            let l = [q[1] * v[2] - q[2] * v[1], q[2] * v[0] - q[0] * v[2], q[0] * v[1] - q[1] * v[0]];
            assert!((dot(l, l) - mu * a * (1.0 - e * e)).abs() < 1e-13 * mu * r, "{texts:?}");
            let inclination = (l[2] / dot(l, l).sqrt()).acos().to_degrees();
            assert!((inclination - number(&found.i)).abs() < 1e-5, "{texts:?}: {inclination}");
        }
    }
}
