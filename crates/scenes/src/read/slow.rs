//! `slow`: the slow part of U beside the fast one, for multiple time steps.

use super::given::Given;
use super::parts::{self, Split};
use super::reader::Reader;
use crate::scene::split::SlowForces;
use crate::scene::{InitialValueProblem, Parts, PotentialEnergy, System};

/// The system of a problem, in three parts if it has slow forces.
pub(super) fn system(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    (problem, slow): (InitialValueProblem, Option<PotentialEnergy>),
    split: Split,
) -> Option<System> {
    let Some(slow) = slow else { return parts::split(reader, given, problem, split, None) };
    Some(System { problem, parts: Parts::SlowForces(SlowForces::new(slow)) })
}

#[cfg(test)]
mod tests {
    use crate::run::start::Begin;
    use crate::scene::Scene;
    use shadowstep::tables::{Faults, Source};
    use shadowstep::{Carried, Integrator as _};

    const POTENTIAL: &str = "potential = \"50*(x - y)^2\"\ncoordinates = [\"x\", \"y\"]";
    const PAIR: &str = "pair = \"50*(r2 - 1)^2\"\nbodies = { c = [1, 2, 3] }\ndimensions = 1\nneighbours = \"free\"";

    fn read(problem: &str, initial: &str, scheme: &str) -> Result<Scene, Faults> {
        let text = format!(
            "[problem]\n{problem}\n[initial]\n{initial}\n[run]\nscheme = \"{scheme}\"\nstep = \"1/50\"\nsteps = \
                9\n[output]\nenergy = true"
        );
        Scene::read(Source { path: "test.toml".to_owned(), text })
    }

    /// q and p after the run, β, and H there.
    fn end(problem: &str, initial: &str, scheme: &str) -> Vec<f64> {
        let scene = read(problem, initial, scheme).unwrap_or_else(|faults| panic!("{faults}"));
        let steps = scene.steps_from(Begin::InitialState);
        let mut integrator = scene.system.integrator::<f64>(steps, scene.system.start(&()), &()).unwrap();
        (0..9).for_each(|_| integrator.step(Carried::Increments));
        let (q, p) = (integrator.state().q().to_vec(), integrator.state().p().to_vec());
        let energy = scene.system.energy::<f64>(&())(&q, &p);
        let beta = *integrator.state().increments().beta;
        [q, p, vec![beta, energy]].concat()
    }

    /// Some hundred roundings of numbers of size 1.
    fn assert_near(a: &[f64], b: &[f64]) {
        let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(a.len() == b.len() && off < 1e-12, "{a:?}, {b:?}");
    }

    #[test]
    fn slow_forces_are_the_first_of_three_parts() {
        let start = "q = [1, 0]\np = [0, \"1/2\"]";
        let slow = format!("{POTENTIAL}\nslow = \"cos(x) + x*y\"\nmasses = [1, 2]");
        let parts = "parts = [\"cos(x) + x*y\", \"50*(x - y)^2\", \"px^2/2 + py^2/4\"]\ncoordinates = [\"x\", \"y\"]";
        for scheme in ["r-respa-4", "nested-s6", "yoshida4"] {
            assert_near(&end(&slow, start, scheme), &end(parts, start, scheme));
        }
        let relativistic = format!("{POTENTIAL}\nslow = \"cos(x + t)\"\nkinetic = \"sqrt(1 + px^2) + py^4\"");
        let parts =
            "parts = [\"cos(x + t)\", \"50*(x - y)^2\", \"sqrt(1 + px^2) + py^4 + pt\"]\ncoordinates = [\"x\", \"y\"]";
        assert_near(&end(&relativistic, start, "r-respa-4"), &end(&parts.replace(" + pt", ""), start, "r-respa-4"));
    }

    #[test]
    fn slow_forces_of_pairs_are_of_all_pairs() {
        let start = "q = [0, \"9/10\", 2]\np = [0, \"1/2\", 0]";
        let slow = format!("{PAIR}\nslow = \"c_i*c_j/(1 + r2)\"");
        let fast = "50*((q1 - q2)^2 - 1)^2 + 50*((q2 - q3)^2 - 1)^2";
        let sum = "2/(1 + (q1 - q2)^2) + 3/(1 + (q1 - q3)^2) + 6/(1 + (q2 - q3)^2)";
        let parts = |slow: &str| {
            format!(
                "parts = [\"{slow}\", \"{fast}\", \"(p1^2 + p2^2 + p3^2)/2\"]\ncoordinates = \
                    [\"q1\", \"q2\", \"q3\"]\nmomenta = [\"p1\", \"p2\", \"p3\"]"
            )
        };
        assert_near(&end(&slow, start, "r-respa-8"), &end(&parts(sum), start, "r-respa-8"));
        let field = format!("{PAIR}\nslow = \"q1^2 + cos(q3)\"");
        assert_near(&end(&field, start, "r-respa-8"), &end(&parts("q1^2 + cos(q3)"), start, "r-respa-8"));
    }

    /// 50 (x − y)² oscillates with ω² = 200: a step of 1/4 has hω = 3.54.
    #[test]
    fn a_step_in_resonance_has_a_note() {
        let note = |step: &str| {
            let problem = format!("{POTENTIAL}\nslow = \"cos(x)\"");
            let scene = read(&problem, "q = [1, 0]\np = [0, 1]", "r-respa-8").unwrap();
            crate::motion::stability::resonant(&scene.system, &scene.scheme, &shadowstep::exact(step).unwrap())
        };
        assert_eq!(note("1/5"), None);
        let sentence = note("1/4").unwrap().to_string();
        assert!(sentence.contains("h omega = 3.5355: from 3.1060 on"), "{sentence}");
    }
}
