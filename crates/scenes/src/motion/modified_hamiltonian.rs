//! The modified Hamiltonian of a scheme's step as a formula in q and p.
//!
//! H = T(p) + U(q), or a sum of formulas, is a graph of formulas, in which the brackets of the
//! [series](shadowstep_analysis::modified) are derivatives.

mod planets;
mod potential;
pub mod record;

use std::collections::HashMap;

use num_traits::One;
use shadowstep::systems::transformed_time::TimeTransformation;
use shadowstep::tables::Proved;
use shadowstep::{Rational, StepSize};
use shadowstep_analysis::bracket::Letter;
use shadowstep_analysis::modified::ModifiedHamiltonian;
use shadowstep_schemes::Kinetic;
use shadowstep_schemes::symbolic::decimal::round_significant;
use shadowstep_schemes::symbolic::{Function, Graph, Node, Notation, parse};

use crate::document::expression::{Derived, TIME};
use crate::scene::split::Planets;
use crate::scene::{InitialValueProblem, KineticEnergy, Parts, System};
use crate::texts::refusal::Refusal;

/// The name of the momentum of t in transformed time.
const MOMENTUM_OF_TIME: &str = "pt";

/// Longer formulas are not multiplied out.
const LONGEST_EXPANDED: u64 = 20_000;

/// More distinct parts of formulas take too long, and fewer of numbers with more bits than this.
const MOST_NODES: usize = 100_000;
const SHORT_NUMBER: u64 = 500;

/// More brackets of one order take too long: their number grows as the power of that of the parts.
const MOST_BRACKETS: usize = 3000;

/// Longer formulas are not written.
const LONGEST: u64 = 200_000;

/// The digits of the matrix of a linear part, of which some more are computed: what is exact is so again.
const STIFFNESS_DIGITS: u32 = 110;

/// H of a system as formulas of its parts, from which the modified Hamiltonian of a scheme's step is derived.
pub(crate) struct SymbolicHamiltonian {
    graph: Graph,
    /// U and T, or the parts that are formulas.
    parts: Vec<Node>,
    has_many_parts: bool,
    has_transformed_time: bool,
    most_nodes: usize,
    /// Of T.
    kinetic: Kinetic,
    /// Those of q, then those of p.
    coordinates: Vec<String>,
    parameters: Vec<String>,
}

/// A summand hⁿ H_(n+1) of the modified Hamiltonian.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SymbolicTerm {
    /// n
    pub(crate) power: u32,
    /// H_(n+1)
    pub(crate) formula: Node,
}

impl SymbolicHamiltonian {
    /// H of a system.
    ///
    /// # Errors
    /// A system whose parts have no formulas in q and p.
    pub(crate) fn of(system: &System) -> Result<Self, Refusal> {
        if system.particles() > 0 {
            return Err(Refusal::new(
                "the modified Hamiltonian is derived from formulas, and H does not contain bodies of mass 0",
                "remove the bodies of mass 0, or write `modified_energy` for its values",
            ));
        }
        let mut coordinates = system.coordinates.clone();
        coordinates.extend(system.momenta.iter().cloned());
        let mut symbolic = SymbolicHamiltonian {
            graph: Graph::new(),
            parts: Vec::new(),
            has_many_parts: false,
            has_transformed_time: false,
            most_nodes: MOST_NODES,
            kinetic: Kinetic::Any,
            coordinates,
            parameters: system.parameters.iter().map(|(name, _)| name.clone()).collect(),
        };
        let problem = &system.problem;
        match &system.parts {
            Parts::KineticAndPotential(_) => {
                symbolic.parts = symbolic.potential_and_kinetic(problem)?.to_vec();
                if !system.has_general_kinetic() {
                    symbolic.kinetic = Kinetic::Quadratic;
                }
            }
            Parts::Linear(linear) => {
                let [potential, kinetic] = symbolic.potential_and_kinetic(problem)?;
                let form = symbolic.quadratic_form(linear.stiffness());
                symbolic.parts = vec![symbolic.minus(potential, form), symbolic.graph.plus(kinetic, form)];
                // brackets that are 0 by their degree in p are so for T + f(q), too
                symbolic.kinetic = Kinetic::Quadratic;
            }
            Parts::WisdomHolman(planets) => {
                symbolic.parts = symbolic.perturbation_and_orbits(planets, problem)?.to_vec();
                if !system.has_general_kinetic() {
                    symbolic.kinetic = Kinetic::Quadratic;
                }
            }
            Parts::TransformedTime(_) => {
                let [potential, kinetic] = symbolic.potential_and_kinetic(problem)?;
                symbolic.transform(system, potential, kinetic);
            }
            Parts::SlowForces(slow) => {
                let [potential, kinetic] = symbolic.potential_and_kinetic(problem)?;
                let slow = symbolic.potential(problem, slow.potential(), kinetic)?;
                (symbolic.parts, symbolic.has_many_parts) = (vec![slow, potential, kinetic], true);
            }
            Parts::Formulas(formulas) => {
                symbolic.parts = formulas.0.iter().map(|formula| symbolic.formula(formula.text())).collect();
                symbolic.has_many_parts = true;
            }
        }
        Ok(symbolic)
    }

    /// U and T
    fn potential_and_kinetic(&mut self, problem: &InitialValueProblem) -> Result<[Node; 2], Refusal> {
        let kinetic = self.kinetic(problem);
        Ok([self.potential(problem, &problem.potential, kinetic)?, kinetic])
    }

    /// The interactions of planets, and their Kepler orbits.
    fn perturbation_and_orbits(
        &mut self,
        planets: &Planets,
        problem: &InitialValueProblem,
    ) -> Result<[Node; 2], Refusal> {
        let orbits = self.orbits(planets)?;
        let [potential, kinetic] = self.potential_and_kinetic(problem)?;
        let rest = self.minus(kinetic, orbits.kinetic);
        let rest = self.graph.multiplied_out(rest);
        let attraction = self.minus(potential, orbits.potential);
        Ok([self.graph.plus(attraction, rest), self.graph.plus(orbits.kinetic, orbits.potential)])
    }

    fn minus(&mut self, one: Node, other: Node) -> Node {
        self.graph.sum(&[(one, Rational::one()), (other, -Rational::one())])
    }

    /// The parts −f(−U) and f(T + p_t) of transformed time, whose coordinates t and p_t stand after q and p.
    fn transform(&mut self, system: &System, potential: Node, kinetic: Node) {
        let freedoms = system.q.len();
        // p moves one place on
        let moved = (freedoms..2 * freedoms).map(|i| (self.graph.coordinate(i), self.graph.coordinate(i + 1)));
        let moved: HashMap<_, _> = moved.collect();
        let kinetic = self.graph.replaced(&[kinetic], moved)[0];
        let momentum = self.graph.coordinate(2 * freedoms + 1);
        let (argument, attraction) =
            (self.graph.plus(kinetic, momentum), self.graph.scaled(potential, &-Rational::one()));
        let time = system.transformed_time().expect("time is transformed");
        let [of_kinetic, of_potential] = [argument, attraction].map(|x| match time {
            TimeTransformation::Logarithmic => self.graph.call(Function::Log, x),
            TimeTransformation::Power(exponent) => {
                let exponent = exponent.value();
                let power = self.graph.power(x, &exponent);
                self.graph.scaled(power, &exponent.recip())
            }
        });
        self.parts = vec![self.graph.scaled(of_potential, &-Rational::one()), of_kinetic];
        self.coordinates.insert(freedoms, TIME.to_owned());
        self.coordinates.push(MOMENTUM_OF_TIME.to_owned());
        self.has_transformed_time = true;
    }

    /// The formula of a text of the scene, which was read with it.
    fn formula(&mut self, text: &str) -> Node {
        const READ: &str = "the formula was read with the scene";
        self.graph.build(&parse(text).expect(READ), &self.coordinates, &self.parameters).expect(READ)
    }

    /// T, or T + p_t
    fn kinetic(&mut self, problem: &InitialValueProblem) -> Node {
        let freedoms = problem.coordinates.len();
        let mut kinetic = match &problem.kinetic {
            KineticEnergy::Formula(formula) => self.formula(formula.text()),
            KineticEnergy::Masses(_) => {
                let masses = problem.exact_masses().into_iter().enumerate();
                let square = |(i, mass): (usize, Rational)| {
                    let momentum = self.graph.coordinate(freedoms + i);
                    let square = self.graph.power(momentum, &Rational::from_integer(2.into()));
                    (square, (mass * Rational::from_integer(2.into())).recip())
                };
                let squares: Vec<_> = masses.map(square).collect();
                self.graph.sum(&squares)
            }
        };
        if problem.explicit_time {
            let of_time = self.graph.coordinate(2 * freedoms - 1);
            kinetic = self.graph.plus(kinetic, of_time);
        }
        kinetic
    }

    /// ½qᵀKq
    fn quadratic_form(&mut self, stiffness: &[Vec<Rational>]) -> Node {
        let entries =
            stiffness.iter().enumerate().flat_map(|(i, row)| (0..).zip(row).map(move |(j, entry)| (i, j, entry)));
        let half = Rational::new(1.into(), 2.into());
        let term = |(i, j, entry): (usize, usize, &Rational)| {
            let [x, y] = [i, j].map(|index| self.graph.coordinate(index));
            (self.graph.times(x, y), round_significant(entry, STIFFNESS_DIGITS) * &half)
        };
        let terms: Vec<_> = entries.map(term).collect();
        self.graph.sum(&terms)
    }

    /// The terms of the modified Hamiltonian of a scheme's step that are not 0, up to h^grade; of a processed scheme
    /// that of the processed step.
    ///
    /// # Errors
    /// A scheme that is not for these parts; too many parts of formulas.
    pub(crate) fn modified(&mut self, scheme: &Proved, grade: u32) -> Result<Vec<SymbolicTerm>, Refusal> {
        let numbers = self.parts.iter().flat_map(|part| self.graph.numbers(*part));
        let bits = numbers.map(|number| number.numer().bits() + number.denom().bits()).max().unwrap_or(0);
        // irrational ones have all digits of the run
        self.most_nodes = MOST_NODES / usize::try_from((bits / SHORT_NUMBER).max(1)).unwrap_or(MOST_NODES);
        match self.has_many_parts {
            false => self.terms(&ModifiedHamiltonian::of(scheme, self.kinetic, grade)),
            true => {
                self.refuse_many_brackets(grade)?;
                let series = ModifiedHamiltonian::of_parts(scheme, self.parts.len(), grade);
                self.terms(&series.map_err(|not| Refusal::new(not.to_string(), "use a scheme such as yoshida4"))?)
            }
        }
    }

    fn refuse_many_brackets(&self, grade: u32) -> Result<(), Refusal> {
        // of n letters and k parts there are about kⁿ/n
        let brackets = |grade: u32| self.parts.len().saturating_pow(grade + 1) / (grade as usize + 1);
        match (1..=grade).find(|grade| brackets(*grade) > MOST_BRACKETS) {
            Some(grade) => Err(Refusal::new(
                format!("H_{} of {} parts has more than {MOST_BRACKETS} brackets", grade + 1, self.parts.len()),
                format!("ask for powers of h below {grade}"),
            )),
            None => Ok(()),
        }
    }

    fn terms<L: Letter>(&mut self, series: &ModifiedHamiltonian<L>) -> Result<Vec<SymbolicTerm>, Refusal> {
        let mut known = HashMap::new();
        let mut found = Vec::new();
        for (power, terms) in (1..).zip(&series.terms) {
            let mut sum = Vec::new();
            for (bracket, c) in terms {
                let found = self.bracket(bracket.letters(), &mut known).ok_or_else(|| {
                    let message = format!("H_{} of this system has more than {} parts", power + 1, self.most_nodes);
                    Refusal::new(message, format!("ask for powers of h below {power}"))
                });
                sum.push((found?, c.clone()));
            }
            let sum = self.graph.sum(&sum);
            let formula = self.shorter(sum);
            if self.graph.as_number(formula).is_none_or(|value| value.numer() != &0.into()) {
                found.push(SymbolicTerm { power, formula });
            }
        }
        Ok(found)
    }

    /// [x_1,[x_2,[…,x_n]]], with those within it that are known; `None` where formulas have too many parts.
    fn bracket<L: Letter>(&mut self, letters: &[L], known: &mut HashMap<Vec<L>, Node>) -> Option<Node> {
        let [first, rest @ ..] = letters else { unreachable!("a bracket has letters") };
        if rest.is_empty() {
            return Some(self.parts[first.number()]);
        }
        if let Some(node) = known.get(letters) {
            return Some(*node);
        }
        let inner = self.bracket(rest, known)?;
        let node = self.graph.bracket(self.parts[first.number()], inner, self.coordinates.len() / 2);
        let node = self.shorter(node);
        known.insert(letters.to_vec(), node);
        (self.graph.size() <= self.most_nodes).then_some(node)
    }

    /// H + Σ hⁿ H_(n+1) up to h^grade as a formula in q, p, t, H, and p_t in transformed time, where it is that of H' =
    /// f(T + p_t) − f(−U).
    pub(crate) fn up_to(&self, terms: &[SymbolicTerm], grade: u32, h: &StepSize) -> Derived {
        let mut graph = self.graph.clone();
        let freedoms = self.coordinates.len() / 2;
        let energy = match self.has_transformed_time {
            // after q and p stand t and H
            false => vec![graph.coordinate(2 * freedoms + 1)],
            true => self.parts.clone(),
        };
        let of_grade = terms.iter().filter(|term| term.power <= grade);
        let terms = of_grade.map(|term| (term.formula, h.exact().pow(term.power as i32)));
        let terms: Vec<_> = terms.chain(energy.into_iter().map(|part| (part, Rational::one()))).collect();
        let mut node = graph.sum(&terms);
        if self.has_transformed_time {
            // q, t, p, p_t → q, p, t, H, p_t
            let places = (freedoms - 1..2 * freedoms)
                .zip([2 * freedoms - 2].into_iter().chain(freedoms - 1..2 * freedoms - 2).chain([2 * freedoms]));
            let moved: HashMap<_, _> =
                places.map(|(from, to)| (graph.coordinate(from), graph.coordinate(to))).collect();
            node = graph.replaced(&[node], moved)[0];
        }
        Derived { graph, node, has_momentum_of_time: self.has_transformed_time }
    }

    /// The formula multiplied out, where it is shorter then: products of sums cancel or are few.
    fn shorter(&mut self, formula: Node) -> Node {
        if self.graph.written_size(formula) > LONGEST_EXPANDED {
            return formula;
        }
        let expanded = self.graph.multiplied_out_within(formula, self.most_nodes);
        if self.graph.written_size(expanded) <= self.graph.written_size(formula) { expanded } else { formula }
    }

    /// A formula as text with these names of coordinates and parameters; numbers that are no short fractions have this
    /// number of significant digits.
    ///
    /// # Errors
    /// A formula that is too long.
    pub(crate) fn text(
        &self,
        formula: Node,
        notation: Notation,
        names: (&[String], &[String]),
        digits: usize,
    ) -> Result<String, Refusal> {
        let size = self.graph.written_size(formula);
        if size > LONGEST {
            let message = format!("the formula has {size} symbols, more than {LONGEST}");
            return Err(Refusal::new(message, "ask for a lower grade"));
        }
        Ok(self.graph.text(formula, notation, names, digits))
    }

    /// H
    pub(crate) fn hamiltonian(&mut self) -> Node {
        let parts: Vec<_> = self.parts.iter().map(|part| (*part, Rational::one())).collect();
        self.graph.sum(&parts)
    }

    /// The names of coordinates and momenta, and of all parameters.
    ///
    /// # Errors
    /// A name that both t or its momentum and something of the problem have.
    pub(crate) fn names(&self) -> Result<Vec<String>, Refusal> {
        let names = [&self.coordinates[..], &self.parameters].concat();
        let is_twice = |name: &&str| names.iter().filter(|own| own == name).count() > 1;
        match [TIME, MOMENTUM_OF_TIME].into_iter().find(is_twice) {
            Some(name) => {
                let message = format!("`{name}` is of transformed time, and of the problem");
                Err(Refusal::new(message, format!("give the coordinate, momentum or parameter `{name}` another name")))
            }
            None => Ok(names),
        }
    }

    /// The places of coordinates and momenta, and of the parameters in some formulas, among all names.
    pub(crate) fn places_in(&self, formulas: &[Node]) -> Vec<usize> {
        let count = self.coordinates.len();
        (0..count).chain(self.graph.parameters(formulas).into_iter().map(|index| count + index)).collect()
    }

    /// Coordinates with momenta: how many.
    pub(crate) fn dimension(&self) -> usize {
        self.coordinates.len()
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::observer::testing::{read, rows};
    use num_traits::ToPrimitive;
    use shadowstep_schemes::symbolic::exact;

    /// The differences of the series up to the grades from the modified energy E_20 at the state in the middle of 1/h
    /// and 20 steps.
    fn differences(problem: &str, scheme: &str, h: u32, grades: &[u32]) -> Vec<f64> {
        let run = format!("scheme = \"{scheme}\"\nstep = \"1/{h}\"\nsteps = {}\ndigits = 60", h / 2 + 10);
        let output = format!(
            "modified_energy = {{ estimator = \"bilinear\", order = 20 }}\nmodified_hamiltonian = {grades:?}\nsummary = false"
        );
        let lines = rows(&read(&format!("{problem}\n[run]\n{run}\n[output]\n{output}")));
        let column = |name: &str| lines[0].iter().position(|found| *found == name).unwrap();
        let energy = column("modified_energy");
        let of = |grade: &u32| {
            let own = column(&format!("modified_hamiltonian_{grade}"));
            let row = &lines[1 + h as usize / 2];
            let [a, b] = [&row[energy], &row[own]].map(|text| exact(text).unwrap());
            (a - b).to_f64().unwrap().abs()
        };
        grades.iter().map(of).collect()
    }

    /// The modified energy less the series falls like the first power of h that is left out: the estimator knows
    /// nothing of brackets.
    #[test]
    fn the_series_is_the_modified_energy() {
        let pendulum = "problem.name = \"pendulum\"";
        let henon_heiles = "problem.name = \"henon-heiles\"";
        let oscillator = "problem.name = \"harmonic-oscillator\"\nproblem.parameters = { omega = \"3/2\" }";
        let kepler = "problem.name = \"kepler\"\nproblem.parameters = { eccentricity = \"1/5\" }";
        let general = "[problem]\ncoordinates = [\"x\"]\nmomenta = [\"p\"]\npotential = \"x^4/4 - cos(x)\"\nkinetic \
            = \"p^2/2 + p^4/20\"\n[initial]\nq = [\"1/2\"]\np = [\"1/3\"]";
        let driven = "[problem]\ncoordinates = [\"x\"]\npotential = \"x^4/4 - x*cos(t)/5\"\n[initial]\nq = \
            [\"1/2\"]\np = [\"1/3\"]";
        let parts = "[problem]\ncoordinates = [\"x\", \"y\"]\nparts = [\"(px^2 + x^2)/2\", \"py^2/2 + \
            x*py/5\", \"x^2*y + y^2/2 - y^3/3\"]\n[initial]\nq = [\"1/5\", \"1/7\"]\np = [\"1/10\", \"1/3\"]";
        let chain = "[problem]\npair = \"d^2/2 + d^4/4\"\nneighbours = \"fixed\"\nbodies = 3\n[initial]\nq = \
            [0, \"1/5\", 0]\np = [\"1/2\", 0, \"1/3\"]";
        let bodies = "[problem]\npair = \"-m_i*m_j/sqrt(r2 + 1/10)\"\nbodies = { m = [1, 2, \"1/2\"] }\nmasses = [1, \
            2, \"1/2\"]\ndimensions = 2\n[initial]\nq = [[0, 0], [1, 0], [0, 1]]\np = [[0, \"-1/2\"], [0, 1], \
            [\"1/5\", 0]]";
        let time = "[problem]\ncoordinates = [\"x\", \"y\"]\npotential = \"-1/sqrt(x^2 + y^2)\"\n[initial]\nq = [1, \
            0]\np = [0, 1]\n[time]\ntransform = \"power\"\nexponent = \"-1/2\"";
        let slow = "[problem]\ncoordinates = [\"x\"]\npotential = \"2*x^2\"\nslow = \"x^4/4\"\n[initial]\nq = \
            [\"1/2\"]\np = [\"1/3\"]";
        let planets = |parts: &str, beside: &str| {
            let body = |mass: &str, state: &str| format!("[[body]]\nmass = \"{mass}\"\n{state}\n");
            let bodies = [
                body("1", "q = [0, 0]\nv = [0, 0]"),
                body("1/10", "q = [1, 0]\nv = [0, 1]"),
                body("1/20", "q = [0, 2]\nv = [\"-7/10\", 0]"),
            ];
            format!("[problem]\nparts = \"{parts}\"\nparameters = {{ g = 1 }}\n{beside}\n{}", bodies.concat())
        };
        for (problem, scheme, grades, powers) in [
            (pendulum, "stormer-verlet", &[2, 4, 6, 8][..], &[4, 6, 8, 10][..]),
            (pendulum, "yoshida4", &[4, 6], &[6, 8]),
            (henon_heiles, "symplectic-euler", &[1, 2, 3, 4, 5], &[2, 3, 4, 5, 6]),
            (henon_heiles, "blanes-moan-srkn6b", &[4, 6], &[6, 8]),
            (oscillator, "ruth3", &[3, 4, 5], &[4, 5, 6]),
            (kepler, "stormer-verlet", &[2, 4], &[4, 6]),
            (pendulum, "takahashi-imada", &[2, 4], &[4, 6]),
            (henon_heiles, "chin-4a", &[4], &[6]),
            (general, "stormer-verlet", &[2, 4], &[4, 6]),
            (driven, "stormer-verlet", &[2, 4], &[4, 6]),
            (parts, "stormer-verlet", &[2, 4], &[4, 6]),
            ("problem.name = \"henon-heiles\"\nproblem.parts = \"linear\"", "aba864", &[4, 6], &[6, 8]),
            (time, "stormer-verlet", &[2, 4], &[4, 6]),
            (&format!("{kepler}\ntime.transform = \"logarithmic\""), "stormer-verlet", &[2], &[4]),
            (&planets("wisdom-holman", ""), "stormer-verlet", &[2], &[4]),
            (&planets("wisdom-holman-heliocentric", ""), "stormer-verlet", &[2], &[4]),
            (
                &planets("wisdom-holman", "central = \"-m/(50*r^2)\"\nexternal = \"m*x^2/9\""),
                "stormer-verlet",
                &[2],
                &[4],
            ),
            (slow, "r-respa-4", &[2], &[4]),
            (chain, "stormer-verlet", &[2, 4], &[4, 6]),
            (bodies, "stormer-verlet", &[2], &[4]),
        ] {
            let [coarse, fine] = [80, 160].map(|h| differences(problem, scheme, h, grades));
            for ((grade, power), (coarse, fine)) in grades.iter().zip(powers).zip(coarse.iter().zip(&fine)) {
                let measured = (coarse / fine).log2();
                // the next powers of h are an eighth of the difference at most
                assert!(
                    (measured - f64::from(*power)).abs() < 0.2,
                    "{scheme} up to h^{grade}: falls like h^{measured:.2}, not h^{power}, on {problem}"
                );
            }
        }
    }
}
