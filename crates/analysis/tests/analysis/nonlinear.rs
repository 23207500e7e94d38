//! Error coefficients against the error of one step of a nonlinear problem, in exact arithmetic.
//!
//! The functions of (q, p) are polynomials, on which K acts as −U'(q) ∂/∂p and D as T'(p) ∂/∂q. A step takes q to
//! exp(h a_1 K) exp(h b_1 D) … q, so its error is h^{p+1} times the brackets applied to q, with their coefficients.

use std::collections::BTreeMap;

use num_traits::{ToPrimitive, Zero};
use shadowstep_analysis::Analysis;
use shadowstep_analysis::error::LeadingError;
use shadowstep_schemes::symbolic::decimal::round_significant;
use shadowstep_schemes::{Kinetic, MapKind, Proved, Rational};

use crate::{scheme, with_weights};

/// Coefficients by the powers of q and p.
type Polynomial = BTreeMap<(u32, u32), Rational>;

fn rational(n: i64, d: i64) -> Rational {
    Rational::new(n.into(), d.into())
}

fn polynomial(terms: &[((u32, u32), Rational)]) -> Polynomial {
    terms.iter().cloned().collect()
}

struct Problem {
    /// −U'(q)
    force: Polynomial,
    /// T'(p)
    velocity: Polynomial,
}

impl Problem {
    /// U = q²/2 − q³/3 + q⁴/2, T = p²/2, with p³/3 + p⁴/4 added if T is to be general.
    fn new(kinetic: Kinetic) -> Problem {
        let one = rational(1, 1);
        let mut velocity = polynomial(&[((0, 1), one.clone())]);
        if kinetic == Kinetic::Any {
            velocity.extend([((0, 2), one.clone()), ((0, 3), one.clone())]);
        }
        Problem { force: polynomial(&[((1, 0), -&one), ((2, 0), one), ((3, 0), rational(-2, 1))]), velocity }
    }

    /// K or D of a function.
    fn derivative(&self, kind: MapKind, function: &Polynomial) -> Polynomial {
        let mut result = Polynomial::new();
        let factor = if kind == MapKind::Kick { &self.force } else { &self.velocity };
        for (&(i, j), c) in function {
            let (power, i, j) =
                if kind == MapKind::Kick { (j, i, j.wrapping_sub(1)) } else { (i, i.wrapping_sub(1), j) };
            for (&(k, l), d) in factor.iter().filter(|_| power > 0) {
                *result.entry((i + k, j + l)).or_insert_with(Rational::zero) += c * d * rational(power.into(), 1);
            }
        }
        result
    }

    /// [x_1,[x_2,…]] of a function.
    fn bracket(&self, letters: &[MapKind], function: &Polynomial) -> Polynomial {
        let [first, rest @ ..] = letters else { return function.clone() };
        if rest.is_empty() {
            return self.derivative(*first, function);
        }
        let mut result = self.derivative(*first, &self.bracket(rest, function));
        for (powers, c) in self.bracket(rest, &self.derivative(*first, function)) {
            *result.entry(powers).or_insert_with(Rational::zero) -= c;
        }
        result
    }

    /// Where a step of size h goes, to 120 digits.
    fn step(&self, proved: &Proved, h: &Rational, [mut q, mut p]: [Rational; 2]) -> Rational {
        for map in proved.scheme.maps() {
            match map.kind {
                MapKind::Kick => p += h * &map.weight * value(&self.force, &q, &p),
                MapKind::Drift => q += h * &map.weight * value(&self.velocity, &q, &p),
                // 2 f f′ for T = p²/2
                MapKind::GradientKick => {
                    let product = self.slope(&q) * value(&self.force, &q, &p);
                    p -= h.pow(3) * &map.weight * product * rational(2, 1);
                }
            }
            (q, p) = (round_significant(&q, 120), round_significant(&p, 120));
        }
        q
    }

    /// f′(q) of the force f.
    fn slope(&self, q: &Rational) -> Rational {
        self.force
            .iter()
            .filter(|((i, _), _)| *i > 0)
            .map(|(&(i, _), c)| c * q.pow(i as i32 - 1) * rational(i.into(), 1))
            .sum()
    }

    /// Where the flow goes, by Taylor's series up to h^terms.
    fn flow(&self, terms: u32, h: &Rational, [q, p]: &[Rational; 2]) -> Rational {
        let mut function = polynomial(&[((1, 0), rational(1, 1))]);
        let (mut sum, mut power) = (q.clone(), rational(1, 1));
        for n in 1..=terms {
            let mut next = self.derivative(MapKind::Kick, &function);
            for (powers, c) in self.derivative(MapKind::Drift, &function) {
                *next.entry(powers).or_insert_with(Rational::zero) += c;
            }
            function = next;
            power *= h * rational(1, n.into());
            sum += &power * value(&function, q, p);
        }
        sum
    }

    /// Asserts that the error of one step begins as the coefficients say.
    fn assert_error(&self, proved: &Proved, error: &LeadingError) {
        let (start, h) = ([rational(1, 5), rational(2, 5)], rational(1, 1_000_000));
        let measured = self.step(proved, &h, start.clone()) - self.flow(error.power + 2, &h, &start);
        let measured = (measured / h.pow(error.power as i32)).to_f64().unwrap();
        let position = polynomial(&[((1, 0), rational(1, 1))]);
        let at_start =
            |letters: &[MapKind]| value(&self.bracket(letters, &position), &start[0], &start[1]).to_f64().unwrap();
        let predicted: f64 = error.terms.iter().map(|(bracket, c)| c * at_start(bracket.letters())).sum();
        // the next term is smaller by a factor of h and of some derivatives
        assert!((measured - predicted).abs() < 1e-3 * predicted.abs(), "{measured} measured, {predicted} predicted");
        assert!(predicted.abs() > 1e-9, "there is something to measure");
    }
}

fn value(function: &Polynomial, q: &Rational, p: &Rational) -> Rational {
    function.iter().map(|(&(i, j), c)| c * q.pow(i as i32) * p.pow(j as i32)).sum()
}

/// Calvo and Sanz-Serna's Nyström scheme of order 4 (SIAM J. Sci. Comput. 14 (1993) 936), which has order 3 for every
/// T(p); two of its weights are as printed, the others polished.
const KICKS: [&str; 5] = [
    "0.0617588581356303503904662698867752110134321954230271201436328",
    "0.338978026553640751948144945229695589040418554575854000795592",
    "0.61479130717558",
    "-0.140548014659377570274492516239686505238431242860085320392138",
    "0.125019822794526467935881301123215705184580492861204199452913",
];
const DRIFTS: [&str; 5] = [
    "0.205177661542290850964537639678452365158700324226224623277971",
    "0.40302128160421",
    "-0.120920876338909074733124125653202532587096022541527649939635",
    "0.512721933192408223768586485974750167428395698315303026661663",
    "0",
];

fn nystrom() -> Proved {
    with_weights("order = 4\nkinetic = \"quadratic\"\ndigits = 58", &KICKS.join(", "), &DRIFTS.join(", "))
}

#[test]
fn one_step_of_a_general_problem_is_off_by_the_leading_error() {
    let problem = Problem::new(Kinetic::Any);
    let shipped = ["symplectic-euler", "stormer-verlet", "ruth3", "yoshida4"].map(scheme);
    for proved in shipped.into_iter().chain([&nystrom()]) {
        problem.assert_error(proved, &Analysis::of(proved).general);
    }
}

#[test]
fn one_step_with_quadratic_kinetic_energy_is_off_by_what_does_not_vanish() {
    let problem = Problem::new(Kinetic::Quadratic);
    for proved in ["stormer-verlet", "ruth3", "suzuki4"].map(scheme).into_iter().chain([&nystrom()]) {
        problem.assert_error(proved, &Analysis::of(proved).quadratic);
    }
}
