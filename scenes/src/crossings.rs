//! Where a run crosses a surface of section, g(q, p) = 0: a step of a part of h from the state before, at whose end g is 0.

use shadowstep::Real;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::steps::step_to_zero;

use crate::computation::RunNumber;
use crate::evaluator::Evaluator;
use crate::run::Run;
use crate::scene::{Direction, Surface, System};
use crate::snapshots::Snapshot;

/// Why displaced forces have no crossings.
pub(crate) const NEEDS_PARTS_OF_STEPS: &str =
    "displaced forces belong to whole steps, and a section needs parts of a step";

/// Finds the crossings of a run, whose states it takes one after the other.
pub(crate) struct Crossings<N: RunNumber> {
    value: Evaluator<N>,
    direction: Direction,
    /// The state before, and g there.
    before: Option<(N, Snapshot<N>)>,
}

impl<N: RunNumber> Crossings<N> {
    /// Of a surface that was checked for the system.
    pub(crate) fn new(Surface { expression, direction }: &Surface, system: &System, context: &N::Context) -> Self {
        let value = Evaluator::of_run(expression, system, context).expect("it was checked for the system");
        Crossings { value, direction: *direction, before: None }
    }

    /// Takes the state n, the next one, at which the integrator is. If g has a zero between it and the state before, `take` sees the integrator at the
    /// crossing and the part of a step from the state before; the integrator is then at its state again, to the last bit.
    pub(crate) fn state<T>(
        &mut self,
        n: i64,
        integrator: &mut VectorIntegrator<'_, N>,
        take: impl FnOnce(&mut VectorIntegrator<'_, N>, &N) -> T,
    ) -> Option<T> {
        let now = self.value_at(integrator);
        let state = Snapshot::of(n, integrator.state());
        let before = self.before.take().filter(|(value, _)| self.direction.is_of(value, &now));
        let found = before.and_then(|(value, before)| {
            before.restore(integrator);
            let part = step_to_zero(integrator, |integrator| self.value_at(integrator));
            let taken = part
                .filter(|_| is_zero(&self.value_at(integrator), [&value, &now]))
                .map(|part| take(integrator, &part));
            // only here: a state that is set has its gradient evaluated again
            state.restore(integrator);
            taken
        });
        self.before = Some((now, state));
        found
    }

    fn value_at(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> N {
        let no_time = || unreachable!("g does not depend on t, unless t is a coordinate");
        at_output(integrator, |integrator| self.value.value(integrator.system(), no_time).clone())
    }
}

/// Whether a value is 0 beside those at both ends of the step. Where the sign changes at a pole or at the turn of an angle, the least value that is
/// found is that of an end, or has its size; where there is a zero, it is the round-off of the formula, as that of an end may be.
fn is_zero<N: Real>(value: &N, ends: [&N; 2]) -> bool {
    // in decades
    const SMALL: f64 = 3.0;
    const ROUND_OFF: f64 = 9.0;
    let [before, now] = ends.map(Real::log10_abs);
    let (least, largest, value) = (before.min(now), before.max(now), value.log10_abs());
    value < least - SMALL || (least < largest - ROUND_OFF && value < largest - SMALL)
}

impl Run<'_> {
    /// The time of a crossing, a part of a step after the state n.
    pub(crate) fn time_of_crossing<N: RunNumber>(&self, n: i64, part: &N, context: &N::Context) -> N {
        let mut time = N::from_rational(self.h.exact(), context);
        time.multiply(part);
        time.add(&self.time_in(n, context));
        time
    }
}

impl Direction {
    /// The directions by their names.
    pub const NAMES: [(&'static str, Direction); 3] =
        [("up", Direction::Up), ("down", Direction::Down), ("both", Direction::Both)];

    /// Whether g goes through 0 in this direction between two states.
    fn is_of<N: Real>(self, before: &N, now: &N) -> bool {
        let zero = N::zero(&now.context());
        let (up, down) = (*before < zero && *now >= zero, *before > zero && *now <= zero);
        match self {
            Direction::Up => up,
            Direction::Down => down,
            Direction::Both => up || down,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use shadowstep::tables::{Faults, Source};

    fn read(step: &str, trajectory: &str, more: &str) -> Result<Scene, Faults> {
        let text = format!(
            "problem.name = \"henon-heiles\"\n[run]\nscheme = \"blanes-moan-srkn11b\"\nstep = \"{step}\"\nuntil = 60\ndigits = 40\n[output]\n\
             trajectory = {trajectory}\n{more}"
        );
        Scene::read(Source { path: "test.toml".to_owned(), text })
    }

    /// The rows, each as its cells.
    fn rows(scene: &Scene) -> Vec<Vec<String>> {
        let mut rows = Vec::new();
        scene.run_into(&mut rows, &mut ()).unwrap();
        let text = String::from_utf8(rows).unwrap();
        let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
        rows.map(|line| line.split(',').map(str::to_owned).collect()).collect()
    }

    fn number(text: &str) -> f64 {
        text.parse().unwrap()
    }

    /// Differences of halved steps fall as the order of the scheme says: the crossing is a point of the trajectory with the error of a step.
    #[test]
    fn crossings_have_the_order_of_the_scheme() {
        let of_step = |step: &str| rows(&read(step, "{ section = \"x\" }", "").unwrap());
        let found = ["1/10", "1/20", "1/40"].map(of_step);
        assert_eq!(found.each_ref().map(Vec::len), [9, 9, 9]);
        let last = found.each_ref().map(|rows| &rows[8]);
        for row in last {
            assert!(number(&row[2]).abs() < 1e-40, "{row:?}");
            assert!(number(&row[4]) > 0.0);
        }
        let difference = |a: &Vec<String>, b: &Vec<String>| {
            let [a, b] = [a, b].map(|row| shadowstep_symbolic::decimal::from_text(&row[3]).unwrap());
            number(&shadowstep_symbolic::decimal::to_significant(&(a - b), 12)).abs()
        };
        let slope = (difference(last[0], last[1]) / difference(last[1], last[2])).log2();
        assert!((slope - 6.0).abs() < 0.1, "{slope}");
    }

    /// A pole and the turn of an angle change the sign, and are no zeros.
    #[test]
    fn a_jump_is_no_crossing() {
        // an orbit on which x and y are not 0 in one step
        let start = "[initial]\nq = [\"1/10\", \"1/5\"]\np = [\"3/10\", \"-1/10\"]\n";
        let count = |section: &str| {
            rows(&read("1/10", &format!("{{ section = \"{section}\", direction = \"both\" }}"), start).unwrap()).len()
        };
        assert!(count("x") > 10 && count("y") > 10);
        assert_eq!(count("y/x"), count("y"));
        assert_eq!(count("atan(y/x)"), count("y"));
        // 1/y has no zero
        assert_eq!(count("1/y"), 0);
    }

    /// Up and down are both together, x = 0 at the start being no crossing, and the run itself goes on as without a section.
    #[test]
    fn a_section_changes_nothing_else() {
        let count = |direction: &str| {
            rows(&read("1/10", &format!("{{ section = \"x\", direction = \"{direction}\" }}"), "").unwrap()).len()
        };
        assert_eq!((count("up"), count("down"), count("both")), (9, 10, 19));
        let energies = |trajectory: &str| {
            let rows = rows(&read("1/10", trajectory, "energy = { every = 100 }").unwrap());
            let is_of_step = |row: &Vec<String>| (number(&row[1]) * 10.0 - number(&row[0])).abs() < 1e-9;
            assert!(
                rows.iter().all(|row| !row[2].is_empty())
                    && rows.is_sorted_by_key(|row| (number(&row[1]) * 1e9) as i64)
            );
            rows.into_iter().filter(is_of_step).map(|row| row[2].clone()).collect::<Vec<_>>()
        };
        assert_eq!(energies("{ section = \"x\", direction = \"both\" }"), energies("{ every = 1000 }"));
    }

    /// Only a crossing costs forces.
    #[test]
    fn a_surface_that_is_not_crossed_costs_no_forces() {
        let evaluations = |trajectory: &str| {
            let scene = read("1/10", trajectory, "summary = false").unwrap();
            scene.run_into(&mut Vec::new(), &mut ()).unwrap()
        };
        assert_eq!(evaluations("{ section = \"x - 100\" }"), evaluations("true"));
    }

    /// cos t = 0 of the coordinate t.
    #[test]
    fn a_section_may_be_one_of_explicit_time() {
        for time in ["", "[time]\ntransform = \"logarithmic\"\n"] {
            let text = format!(
                "[problem]\npotential = \"-(1 + sin(t)/10)/sqrt(x^2 + 1)\"\ncoordinates = [\"x\"]\n[initial]\nq = [1]\np = [0]\n{time}[run]\n\
                 scheme = \"blanes-moan-s6\"\nstep = \"1/10\"\nuntil = 20\ndigits = 30\n[output]\ntrajectory = {{ section = \"cos(t)\" }}"
            );
            let rows = rows(&Scene::read(Source { path: "test.toml".to_owned(), text }).unwrap());
            // cos grows through 0 at 3π/2, 7π/2 and 11π/2
            for (row, quarters) in rows.iter().zip([3.0, 7.0, 11.0]) {
                assert!((number(&row[1]) - quarters * std::f64::consts::FRAC_PI_2).abs() < 1e-14, "{row:?}");
            }
            assert_eq!(rows.len(), 3);
        }
    }

    #[test]
    fn faults_have_their_places() {
        let fault = |trajectory: &str, more: &str| {
            let Err(Faults(faults)) = read("1/10", trajectory, more) else { panic!("{trajectory} is read") };
            format!("{}:{}: {}", faults[0].line, faults[0].column, faults[0].message)
        };
        assert_eq!(fault("{ section = \"z\" }", ""), "8:27: unknown name `z`; known names: x, y, px, py, t, E");
        // what stands for a quantity is not shown
        let unknown = "8:27: unknown name `kinetik`; known names: x, y, px, py, t, E";
        assert_eq!(fault("{ section = \"kinetik - virial\" }", ""), unknown);
        assert_eq!(
            fault("{ section = \"t\" }", ""),
            "8:26: a section is a function of q and p, and t is no coordinate here"
        );
        assert_eq!(fault("{ section = \"x\", every = 2 }", ""), "8:26: every and section are both given");
        assert_eq!(fault("{ direction = \"up\" }", ""), "8:28: a direction requires a section");
        assert_eq!(
            fault("{ section = \"x\" }", "modified_energy = true"),
            "9:19: rows of a section have no modified energy"
        );
        assert_eq!(
            fault("{ section = \"x\" }", "file = \"x.csv\"\nplot = { file = \"x.svg\", of = [\"orbit=x:y\"] }"),
            "10:32: the chart `orbit=x:y` is a curve, and the crossings of a section are points"
        );
    }
}
