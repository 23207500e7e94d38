//! Orbital elements → position and velocity relative to the centre of attraction.

use std::collections::BTreeMap;

use num_traits::{One, Signed, Zero};
use shadowstep::number::{AnyLimbs, LimbCount};
use shadowstep::systems::formula::FormulaValue;
use shadowstep::{Number, Rational, Real};
use shadowstep_schemes::symbolic::decimal::{from_text, round_significant, to_significant};
use shadowstep_schemes::symbolic::{Budget, Error, Exact, evaluate_within, parse};

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

/// An ellipse: the equation for E by Newton's method, and position and velocity in the plane of the orbit, x to the
/// pericentre.
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
            () if self.a.is_zero() => {
                Some(("the semi-major axis is 0".to_owned(), "give its length, positive of an ellipse"))
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
        self.state_by(mu, digits, &mut Formulas { known: BTreeMap::new(), digits, budget: Budget::default() })
    }

    /// The same by formulas that are computed in some way.
    ///
    /// # Errors
    /// Theirs.
    pub(super) fn state_by<C: Compute>(
        &self,
        mu: &Rational,
        digits: u32,
        formulas: &mut C,
    ) -> Result<[Vector; 2], C::Error> {
        let ellipse = self.e < Rational::one();
        let turns = |degrees: &Rational| degrees / Rational::from_integer(360.into());
        for (name, radians, degrees) in [
            ("i", "2*pi*i", &self.i),
            ("O", "2*pi*O", &self.node),
            ("w", "2*pi*w", &self.pericentre),
            ("M", "2*pi*M", &self.anomaly),
        ] {
            // whole turns change no sine; of a hyperbola the mean anomaly is not an angle
            let whole = if name == "M" && !ellipse { 0.0 } else { f64::from_rational(&turns(degrees), &()).round() };
            formulas.set(name, &(turns(degrees) - exact_value(whole)));
            formulas.assign(name, radians)?;
        }
        [("a", &self.a), ("e", &self.e), ("mu", mu)].into_iter().for_each(|(name, value)| formulas.set(name, value));
        let [equation, x, y, u, v] = if ellipse { ELLIPSE } else { HYPERBOLA };
        solve(equation, ellipse, digits, formulas)?;
        let mut in_space = |x, y| {
            // E is not changed
            formulas.assign("x", x)?;
            formulas.assign("y", y)?;
            let [x, y, z] = IN_SPACE.map(|formula| formulas.value(formula));
            Ok::<Vector, C::Error>([x?, y?, z?])
        };
        Ok([in_space(x, y)?, in_space(u, v)?])
    }
}

/// E by Newton's method from a solution in double precision: each step doubles the digits.
fn solve<C: Compute>(equation: &'static str, ellipse: bool, wanted: u32, formulas: &mut C) -> Result<(), C::Error> {
    let nearby = nearby(formulas.double("e"), formulas.double("M"), ellipse);
    formulas.set("E", &exact_value(nearby));
    // of E = 0 the terms of the equation cancel
    let mut digits = if nearby == 0.0 { wanted } else { 7 };
    while digits < wanted {
        formulas.assign("E", equation)?;
        digits *= 2;
    }
    Ok(())
}

/// Computes formulas of values with names.
pub(super) trait Compute {
    /// Why one has no value.
    type Error;

    /// Gives a name a value.
    fn set(&mut self, name: &'static str, value: &Rational);

    /// Gives a name the value of a formula.
    fn assign(&mut self, name: &'static str, formula: &'static str) -> Result<(), Self::Error>;

    /// The value of a formula.
    fn value(&mut self, formula: &'static str) -> Result<Rational, Self::Error>;

    /// The value of a name in double precision.
    fn double(&self, name: &str) -> f64;
}

/// Evaluates formulas to some digits.
struct Formulas {
    known: BTreeMap<String, Exact>,
    digits: u32,
    budget: Budget,
}

impl Compute for Formulas {
    type Error = Error;

    fn set(&mut self, name: &'static str, value: &Rational) {
        self.known.insert(name.to_owned(), Exact { value: value.clone(), rounded: true });
    }

    fn assign(&mut self, name: &'static str, formula: &'static str) -> Result<(), Error> {
        let value = self.value(formula)?;
        self.set(name, &value);
        Ok(())
    }

    fn value(&mut self, formula: &'static str) -> Result<Rational, Error> {
        Ok(evaluate_within(&parse(formula)?, &self.known, self.digits, &self.budget)?.value)
    }

    fn double(&self, name: &str) -> f64 {
        f64::from_rational(&self.known[name].value, &())
    }
}

/// The fewest digits of a computation in limbs, and how many it has beyond those of its results.
const LEAST_DIGITS: u32 = 60;
const DIGITS_BEYOND: u32 = 55;

/// The names in the formulas.
const NAMES: [&str; 10] = ["i", "O", "w", "M", "a", "e", "mu", "E", "x", "y"];

/// What is smaller than round-off by fewer decades is round-off, too, in units that are not extreme, such as the sine
/// of two right angles.
const ROUND_OFF: f64 = 25.6;

/// Computes formulas in numbers of limbs, in a small part of the time: for very many orbits. The results have the
/// digits of [`Formulas`] but the last ones, as these round what is in between.
pub(super) struct InLimbs {
    digits: u32,
    count: LimbCount,
    values: [AnyLimbs; NAMES.len()],
    formulas: BTreeMap<&'static str, FormulaValue<AnyLimbs>>,
}

impl InLimbs {
    /// To this number of digits, if numbers of limbs have enough.
    pub(super) fn with_digits(digits: u32) -> Option<Self> {
        let bits = f64::from(digits.max(LEAST_DIGITS) + DIGITS_BEYOND) * std::f64::consts::LOG2_10;
        let count = LimbCount::of_bits(bits.ceil() as u32)?;
        let values = std::array::from_fn(|_| Number::zero(&count));
        Some(InLimbs { digits, count, values, formulas: BTreeMap::new() })
    }

    fn at(&mut self, formula: &'static str) -> &AnyLimbs {
        let InLimbs { count, values, formulas, .. } = self;
        let known = formulas
            .entry(formula)
            .or_insert_with(|| FormulaValue::new(formula, &NAMES, &[], count).expect("it is a formula in these names"));
        known.at(values)
    }

    fn place(name: &str) -> usize {
        NAMES.iter().position(|known| *known == name).expect("it is one of the names")
    }
}

/// Without a value is what is not finite.
impl Compute for InLimbs {
    type Error = ();

    fn set(&mut self, name: &'static str, value: &Rational) {
        self.values[InLimbs::place(name)] = AnyLimbs::from_rational(value, &self.count);
    }

    fn assign(&mut self, name: &'static str, formula: &'static str) -> Result<(), ()> {
        self.values[InLimbs::place(name)] = *self.at(formula);
        Ok(())
    }

    fn value(&mut self, formula: &'static str) -> Result<Rational, ()> {
        let value = *self.at(formula);
        match value.log10_abs() {
            small if small < ROUND_OFF - f64::from(self.count.bits()) * std::f64::consts::LOG10_2 => {
                Ok(Rational::zero())
            }
            _ => Ok(round_significant(&from_text(&value.to_text()).map_err(drop)?, self.digits)),
        }
    }

    fn double(&self, name: &str) -> f64 {
        self.values[InLimbs::place(name)].to_f64()
    }
}

/// The double itself.
fn exact_value(x: f64) -> Rational {
    from_text(&x.to_text()).expect("a finite number reads back")
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

    /// Orbits of long numbers are computed in limbs, too, and are those of exact formulas.
    #[test]
    fn limbs_have_the_digits_of_long_numbers() {
        let mu = exact("2").unwrap();
        let found = elements(["2", "0.3", "20", "10", "20", "77"]);
        for digits in [60, 80, 120, 250] {
            let exact = found.state(&mu, digits).unwrap();
            let in_limbs = found.state_by(&mu, digits, &mut InLimbs::with_digits(digits).unwrap()).unwrap();
            let least = Rational::from_integer(10.into()).pow(4 - digits as i32);
            let pairs = exact.iter().flatten().zip(in_limbs.iter().flatten());
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < least), "{digits}: {exact:?} {in_limbs:?}");
        }
        assert!(InLimbs::with_digits(400).is_none());
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
            // but for what the other rounds in between
            let in_limbs = found.state_by(&mu, 50, &mut InLimbs::with_digits(50).unwrap()).unwrap();
            for (one, other) in in_limbs.iter().flatten().zip(q.iter().chain(&v)) {
                assert!(f64::from_rational(&(one - other), &()).abs() < 1e-46, "{texts:?}: {one} {other}");
            }
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
