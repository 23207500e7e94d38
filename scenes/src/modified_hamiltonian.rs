//! The modified Hamiltonian of a scheme's step as a formula in q and p.
//!
//! H = T(p) + U(q), or a sum of formulas, is a graph of formulas, in which the brackets of the [series](shadowstep_analysis::modified) are derivatives.

use std::collections::HashMap;

use num_traits::One;
use shadowstep::systems::pairs::{Ends, Pair, Separation};
use shadowstep::tables::Proved;
use shadowstep::{Rational, StepSize};
use shadowstep_analysis::bracket::Letter;
use shadowstep_analysis::modified::ModifiedHamiltonian;
use shadowstep_schemes::Kinetic;
use shadowstep_symbolic::decimal::round_significant;
use shadowstep_symbolic::{Exact, Graph, Node, Notation, parse};

use crate::expression::Derived;
use crate::refusal::Refusal;
use crate::scene::{GRAVITY, InitialValueProblem, KineticEnergy, PairEnergy, Parts, PotentialEnergy, System};

/// Longer formulas are refused: they are no longer read, and take long.
const LONGEST: u64 = 200_000;

/// The digits of the matrix of a linear part, of which some more are computed: what is exact is so again.
const STIFFNESS_DIGITS: u32 = 110;

/// H of a system as formulas of its parts, from which the modified Hamiltonian of a scheme's step is derived.
pub struct SymbolicHamiltonian {
    graph: Graph,
    /// U and T, or the parts that are formulas.
    parts: Vec<Node>,
    has_many_parts: bool,
    /// Of T.
    kinetic: Kinetic,
    /// Those of q, then those of p.
    coordinates: Vec<String>,
    parameters: Vec<String>,
}

/// A summand hⁿ H_(n+1) of the modified Hamiltonian.
#[derive(Clone, Copy, Debug)]
pub struct SymbolicTerm {
    /// n
    pub power: u32,
    /// H_(n+1)
    pub formula: Node,
}

impl SymbolicHamiltonian {
    /// H of a system.
    ///
    /// # Errors
    /// A system that is not T(p) + U(q) or a sum of parts by formulas.
    pub fn of(system: &System) -> Result<Self, Refusal> {
        let mut coordinates = system.coordinates.clone();
        coordinates.extend(system.momenta.iter().cloned());
        let mut symbolic = SymbolicHamiltonian {
            graph: Graph::new(),
            parts: Vec::new(),
            has_many_parts: false,
            kinetic: Kinetic::Any,
            coordinates,
            parameters: system.parameters.iter().map(|(name, _)| name.clone()).collect(),
        };
        match &system.parts {
            Parts::KineticAndPotential(_) => {
                let kinetic = symbolic.kinetic(&system.problem);
                let potential = symbolic.potential(&system.problem, kinetic)?;
                symbolic.parts = vec![potential, kinetic];
                if !system.has_general_kinetic() {
                    symbolic.kinetic = Kinetic::Quadratic;
                }
            }
            Parts::Formulas(formulas) => {
                symbolic.parts = formulas.0.iter().map(|formula| symbolic.formula(formula.text())).collect();
                symbolic.has_many_parts = true;
            }
            Parts::Linear(linear) => {
                let kinetic = symbolic.kinetic(&system.problem);
                let potential = symbolic.potential(&system.problem, kinetic)?;
                let form = symbolic.quadratic_form(linear.stiffness());
                let rest = symbolic.graph.sum(&[(potential, Rational::one()), (form, -Rational::one())]);
                // brackets that are 0 by their degree in p are so for T + f(q), too
                (symbolic.parts, symbolic.kinetic) =
                    (vec![rest, symbolic.graph.plus(kinetic, form)], Kinetic::Quadratic);
            }
            Parts::WisdomHolman(_) | Parts::TransformedTime(_) | Parts::SlowForces(_) => {
                let (section, key) = system.parts.key();
                return Err(Refusal::new(
                    "the modified Hamiltonian is a formula for T(p) + U(q) and for parts that are formulas only",
                    format!("remove `{key}` from [{section}], or write `modified_energy` for its values"),
                ));
            }
        }
        Ok(symbolic)
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

    fn potential(&mut self, problem: &InitialValueProblem, kinetic: Node) -> Result<Node, Refusal> {
        let no_formula = |what: &str| {
            let help = "write `potential` as a formula, or `modified_energy` for its values";
            Err(Refusal::new(format!("the modified Hamiltonian is derived from formulas, and {what}"), help))
        };
        match &problem.potential {
            PotentialEnergy::Formula(formula) => Ok(self.formula(formula.text())),
            PotentialEnergy::Shipped(setup) if setup.bodies().is_some() => {
                let (bodies, dimensions) = setup.bodies().expect("it is a system of bodies");
                let exact = |mass: &Rational| Exact { value: mass.clone(), rounded: false };
                let masses: Vec<_> = bodies.masses().iter().map(exact).collect();
                let ends = ends_of_pairs(bodies.count(), None);
                let gravity = (GRAVITY, Separation::SquaredDistance);
                Ok(self.sum_of_pairs(gravity, &[("m", &masses)], &ends, dimensions))
            }
            PotentialEnergy::Shipped(setup) => {
                let description = setup.problem.description();
                let whole = parse(description.hamiltonian)
                    .ok()
                    .and_then(|h| self.graph.build(&h, &self.coordinates, &self.parameters).ok());
                match whole {
                    Some(whole) => Ok(self.graph.sum(&[(whole, Rational::one()), (kinetic, -Rational::one())])),
                    None => no_formula(&format!("{} has none in its coordinates", description.name)),
                }
            }
            PotentialEnergy::Pairs(pairs) if pairs.cutoff.is_some() => no_formula("pairs with a cutoff have none"),
            PotentialEnergy::Pairs(pairs) if !pairs.of_bodies.is_empty() => {
                no_formula("`central` and `external` are none in its coordinates")
            }
            PotentialEnergy::Pairs(pairs) => Ok(self.pairs(pairs)),
            PotentialEnergy::Own(_) => no_formula("a function has none"),
            PotentialEnergy::OfParts => unreachable!("H is the sum of its parts"),
        }
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

    /// The sum over pairs.
    fn pairs(&mut self, pairs: &PairEnergy) -> Node {
        let properties: Vec<_> = pairs.properties.iter().map(|(name, values)| (name.as_str(), &values[..])).collect();
        let separation = pairs.formula.meaning().separation();
        let ends = ends_of_pairs(pairs.bodies, pairs.ends);
        self.sum_of_pairs((pairs.formula.text(), separation), &properties, &ends, pairs.dimensions)
    }

    /// The sum over pairs of bodies with these properties, which are numbers in it.
    fn sum_of_pairs(
        &mut self,
        (formula, separation): (&str, Separation),
        properties: &[(&str, &[Exact])],
        ends: &[[Option<usize>; 2]],
        dimensions: usize,
    ) -> Node {
        const READ: &str = "the formula was read with the scene";
        let of = |body: char| properties.iter().map(move |(name, _)| format!("{name}_{body}"));
        let names: Vec<String> = of('i').chain(of('j')).collect();
        let expression = parse(formula).expect(READ);
        let of_pair = self.graph.build_pair(&expression, separation.name(), &names, &self.parameters).expect(READ);
        let mut terms = Vec::new();
        for ends in ends {
            let mut by = HashMap::from([(self.graph.coordinate(0), self.separation(dimensions, separation, *ends))]);
            let values = ends.iter().flat_map(|body| properties.iter().map(move |(_, of)| Some(&of[(*body)?])));
            for (property, value) in values.enumerate() {
                let value = value.expect("walls have no properties").value.clone();
                by.insert(self.graph.property(property), self.graph.number(value));
            }
            terms.extend(self.graph.replaced(&[of_pair], by).into_iter().map(|pair| (pair, Rational::one())));
        }
        self.graph.sum(&terms)
    }

    /// q_j − q_i or |q_j − q_i|²; where there is no body there is a wall at 0.
    fn separation(&mut self, dimensions: usize, separation: Separation, [i, j]: [Option<usize>; 2]) -> Node {
        let mut difference = |axis: usize| {
            let mut place = |body: Option<usize>, sign: Rational| {
                body.map(|body| (self.graph.coordinate(body * dimensions + axis), sign))
            };
            let terms = [place(j, Rational::one()), place(i, -Rational::one())];
            self.graph.sum(&terms.into_iter().flatten().collect::<Vec<_>>())
        };
        if separation == Separation::Difference {
            return difference(0);
        }
        let squares: Vec<_> = (0..dimensions).map(difference).collect();
        let two = Rational::from_integer(2.into());
        let squares: Vec<_> = squares.into_iter().map(|x| (self.graph.power(x, &two), Rational::one())).collect();
        self.graph.sum(&squares)
    }

    /// The terms of the modified Hamiltonian of a scheme's step that are not 0, up to h^grade; of a processed scheme that of the processed step.
    ///
    /// # Errors
    /// A scheme that is not for these parts; formulas that are too long.
    pub fn modified(&mut self, scheme: &Proved, grade: u32) -> Result<Vec<SymbolicTerm>, Refusal> {
        let terms = match self.has_many_parts {
            false => self.terms(&ModifiedHamiltonian::of(scheme, self.kinetic, grade)),
            true => {
                let series = ModifiedHamiltonian::of_parts(scheme, self.parts.len(), grade);
                self.terms(&series.map_err(|not| Refusal::new(not.to_string(), "use a scheme such as yoshida4"))?)
            }
        };
        let size: u64 = terms.iter().map(|term| self.graph.written_size(term.formula)).fold(0, u64::saturating_add);
        if size > LONGEST {
            return Err(Refusal::new(
                format!("the formula has {size} symbols, more than {LONGEST}"),
                "ask for a lower grade",
            ));
        }
        Ok(terms)
    }

    fn terms<L: Letter>(&mut self, series: &ModifiedHamiltonian<L>) -> Vec<SymbolicTerm> {
        let mut known = HashMap::new();
        let mut found = Vec::new();
        for (power, terms) in (1..).zip(&series.terms) {
            let terms: Vec<_> =
                terms.iter().map(|(bracket, c)| (self.bracket(bracket.letters(), &mut known), c.clone())).collect();
            let sum = self.graph.sum(&terms);
            let formula = self.shorter(sum);
            if self.graph.as_number(formula).is_none_or(|value| value.numer() != &0.into()) {
                found.push(SymbolicTerm { power, formula });
            }
        }
        found
    }

    /// [x_1,[x_2,[…,x_n]]], with those within it that are known.
    fn bracket<L: Letter>(&mut self, letters: &[L], known: &mut HashMap<Vec<L>, Node>) -> Node {
        let [first, rest @ ..] = letters else { unreachable!("a bracket has letters") };
        if rest.is_empty() {
            return self.parts[first.number()];
        }
        if let Some(node) = known.get(letters) {
            return *node;
        }
        let inner = self.bracket(rest, known);
        let node = self.graph.bracket(self.parts[first.number()], inner, self.coordinates.len() / 2);
        let node = self.shorter(node);
        known.insert(letters.to_vec(), node);
        node
    }

    /// E + Σ hⁿ H_(n+1) up to h^grade, where E is H.
    pub(crate) fn up_to(&self, terms: &[SymbolicTerm], grade: u32, h: &StepSize) -> Derived {
        let mut graph = self.graph.clone();
        // after q and p stand t and E
        let energy = graph.coordinate(self.coordinates.len() + 1);
        let of_grade = terms.iter().filter(|term| term.power <= grade);
        let terms = of_grade.map(|term| (term.formula, h.exact().pow(term.power as i32)));
        let terms: Vec<_> = terms.chain([(energy, Rational::one())]).collect();
        let node = graph.sum(&terms);
        Derived { graph, node }
    }

    /// The formula multiplied out, where it is shorter then: products of sums cancel or are few.
    fn shorter(&mut self, formula: Node) -> Node {
        if self.graph.written_size(formula) > LONGEST {
            return formula;
        }
        let expanded = self.graph.multiplied_out(formula);
        if self.graph.written_size(expanded) <= self.graph.written_size(formula) { expanded } else { formula }
    }

    /// A formula as text; numbers that are no short fractions have this number of significant digits.
    pub fn text(&self, formula: Node, notation: Notation, digits: usize) -> String {
        self.graph.text(formula, notation, (&self.coordinates, &self.parameters), digits)
    }

    /// H
    pub fn hamiltonian(&mut self) -> Node {
        let parts: Vec<_> = self.parts.iter().map(|part| (*part, Rational::one())).collect();
        self.graph.sum(&parts)
    }

    /// The names of coordinates and momenta, and of the parameters in some formulas.
    pub fn names_in(&self, formulas: &[Node]) -> Vec<&str> {
        let parameters = self.graph.parameters(formulas).into_iter().map(|index| &self.parameters[index]);
        self.coordinates.iter().chain(parameters).map(String::as_str).collect()
    }
}

/// The bodies of the pairs that interact; `None` is a wall.
fn ends_of_pairs(bodies: usize, ends: Option<Ends>) -> Vec<[Option<usize>; 2]> {
    let last = bodies - 1;
    let mut pairs: Vec<[Option<usize>; 2]> = match ends {
        None => (0..=last).flat_map(|i| (i + 1..=last).map(move |j| [Some(i), Some(j)])).collect(),
        Some(_) => (0..last).map(|i| [Some(i), Some(i + 1)]).collect(),
    };
    match ends {
        Some(Ends::Fixed) => pairs.extend([[None, Some(0)], [Some(last), None]]),
        Some(Ends::Periodic) => pairs.push([Some(last), Some(0)]),
        Some(Ends::Free) | None => {}
    }
    pairs
}

#[cfg(test)]
mod tests {
    use crate::Scene;
    use crate::observer::KeptSummary;
    use num_traits::ToPrimitive;
    use shadowstep::tables::{Faults, Source};
    use shadowstep_symbolic::exact;

    fn read(problem: &str, run: &str, output: &str) -> Result<Scene, Faults> {
        let text = format!("{problem}\n[run]\n{run}\n[output]\n{output}");
        Scene::read(Source { path: "test.toml".to_owned(), text })
    }

    /// The differences of the series up to the grades from the modified energy E_20 at t = 1/2.
    fn differences(problem: &str, scheme: &str, h: u32, grades: &[u32]) -> Vec<f64> {
        let run = format!("scheme = \"{scheme}\"\nstep = \"1/{h}\"\nsteps = {}\ndigits = 60", h / 2 + 10);
        let output = format!(
            "modified_energy = {{ estimator = \"bilinear\", order = 20 }}\nmodified_hamiltonian = {grades:?}\nsummary = false"
        );
        let scene = read(problem, &run, &output).unwrap_or_else(|faults| panic!("{problem}: {faults}"));
        let mut rows = Vec::new();
        scene.run_into(&mut rows, &mut KeptSummary::default()).unwrap();
        let text = String::from_utf8(rows).unwrap();
        let lines: Vec<Vec<&str>> =
            text.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').collect()).collect();
        let column = |name: &str| lines[0].iter().position(|found| *found == name).unwrap();
        let energy = column("modified_energy");
        let of = |grade: &u32| {
            let own = column(&format!("modified_hamiltonian_{grade}"));
            let row = lines[1..].iter().find(|row| row[1] == "0.5").expect("t = 1/2 is among the states");
            let [a, b] = [row[energy], row[own]].map(|text| exact(text).unwrap());
            (a - b).to_f64().unwrap().abs()
        };
        grades.iter().map(of).collect()
    }

    /// The modified energy less the series falls like the first power of h that is left out: the estimator knows nothing of brackets.
    #[test]
    fn the_series_is_the_modified_energy() {
        let pendulum = "problem.name = \"pendulum\"";
        let henon_heiles = "problem.name = \"henon-heiles\"";
        let oscillator = "problem.name = \"harmonic-oscillator\"\nproblem.parameters = { omega = \"3/2\" }";
        let kepler = "problem.name = \"kepler\"\nproblem.parameters = { eccentricity = \"1/5\" }";
        let general = "[problem]\ncoordinates = [\"x\"]\nmomenta = [\"p\"]\npotential = \"x^4/4 - cos(x)\"\nkinetic = \"p^2/2 + p^4/20\"\n[initial]\nq = [\"1/2\"]\np = [\"1/3\"]";
        let driven = "[problem]\ncoordinates = [\"x\"]\npotential = \"x^4/4 - x*cos(t)/5\"\n[initial]\nq = [\"1/2\"]\np = [\"1/3\"]";
        let parts = "[problem]\ncoordinates = [\"x\", \"y\"]\nparts = [\"(px^2 + x^2)/2\", \"py^2/2 + x*py/5\", \"x^2*y + y^2/2 - y^3/3\"]\n[initial]\nq = [\"1/5\", \"1/7\"]\np = [\"1/10\", \"1/3\"]";
        let chain = "[problem]\npair = \"d^2/2 + d^4/4\"\nneighbours = \"fixed\"\nbodies = 3\n[initial]\nq = [0, \"1/5\", 0]\np = [\"1/2\", 0, \"1/3\"]";
        let bodies = "[problem]\npair = \"-m_i*m_j/sqrt(r2 + 1/10)\"\nbodies = { m = [1, 2, \"1/2\"] }\nmasses = [1, 2, \"1/2\"]\ndimensions = 2\n[initial]\nq = [[0, 0], [1, 0], [0, 1]]\np = [[0, \"-1/2\"], [0, 1], [\"1/5\", 0]]";
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

    #[test]
    fn what_has_no_formula_is_refused_with_the_reason() {
        let fault = |problem: &str, run: &str| {
            let run = format!("{run}\nstep = \"1/10\"\nsteps = 10\ndigits = \"double\"");
            let Faults(faults) = read(problem, &run, "modified_hamiltonian = 4").map(drop).unwrap_err();
            (faults[0].line, faults[0].column, faults[0].message.clone())
        };
        let verlet = "scheme = \"stormer-verlet\"";
        let kepler = "problem.name = \"kepler\"";
        for (problem, run, line, message) in [
            (
                "problem.name = \"kepler\"\ntime.transform = \"logarithmic\"",
                verlet,
                9,
                "the modified Hamiltonian is a formula for T(p) + U(q) and for parts that are formulas only",
            ),
            (
                "problem.name = \"fput-stiff\"",
                verlet,
                8,
                "the modified Hamiltonian is derived from formulas, and fput-stiff has none in its coordinates",
            ),
            (
                kepler,
                "scheme = \"chin-4a\"\ngradient_kicks = \"displaced\"",
                9,
                "displaced forces have another modified Hamiltonian",
            ),
        ] {
            assert_eq!(fault(problem, run), (line, 24, message.to_owned()), "{problem}");
        }
    }
}
