//! What a step of planets costs in `f64`: Kepler orbits, which three planets and more drift on together, and their
//! interactions, also with relativity's potential.

mod timing;

use std::hint::black_box;

use num_traits::One as _;
use shadowstep::systems::formula::{FormulaOfBodies, RelativeTo};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, WisdomHolman};
use shadowstep::tables::{read, shipped, shipped_source};
use shadowstep::{Rational, Stepper, System, exact};

use timing::{Contestant, compare};

/// Planets of 10⁻⁵ of the star on nearly circular orbits, each 1.6 times as large as the one before, the first of
/// radius 1.
fn planets(count: usize) -> WisdomHolman<f64, Jacobi<f64, 3>, 3> {
    let masses = std::iter::once(Rational::one()).chain((0..count).map(|_| exact("1/100000").expect("a number")));
    let bodies = Bodies::new(Rational::one(), masses.collect()).expect("positive masses");
    let (mut q, mut p) = (vec![0.0; 3], vec![0.0; 3]);
    for i in 0..count {
        let (r, (sin, cos)) = (1.6_f64.powi(i as i32), (2.4 * i as f64).sin_cos());
        let momentum = 1.03e-5 / r.sqrt();
        q.extend([r * cos, r * sin, 0.01 * r]);
        p.extend([-momentum * sin, momentum * cos, 0.0]);
    }
    WisdomHolman::new(&bodies, (&q, &p), &()).expect("a state of these bodies")
}

fn with_relativity(count: usize) -> WisdomHolman<f64, Jacobi<f64, 3>, 3, FormulaOfBodies<f64>> {
    let masses: Vec<_> = std::iter::once(1.0).chain((0..count).map(|_| 1e-5)).collect();
    let parameters = [("g", 1.0), ("c", 6000.0)];
    let potential = FormulaOfBodies::new("-3*(g*m0)^2*m/(c^2*r^2)", RelativeTo::FirstBody, 3, &masses, &parameters);
    planets(count).beside(Some(potential.expect("a formula"))).expect("a potential of these bodies")
}

/// Merged steps of 1/22 of the shortest period.
fn steps<M: System<Number = f64, Class = Quadratic> + 'static>(
    name: &'static str,
    scheme: &str,
    system: M,
) -> Contestant<'static> {
    let scheme = match scheme {
        "drift-kick-drift" => {
            let source = shipped_source("stormer-verlet").expect("it is shipped");
            read(&source, &|base, _| shipped_source(base), Some(shadowstep::tables::First::Drift))
                .expect("it is proved")
        }
        _ => shipped(scheme).expect("it is shipped"),
    };
    let stepper = Stepper::new(scheme, "2/7").expect("a step size");
    let mut systems = [system];
    let run = move |repetitions: u32| {
        stepper.merged_steps(&mut systems, u64::from(repetitions));
        black_box(systems[0].state().q());
    };
    (name, Box::new(run))
}

fn main() {
    for (scheme, repetitions) in [("drift-kick-drift", 2000), ("saba4", 500), ("aba1064", 250)] {
        let contestants = [("1 planet", 1), ("2", 2), ("3", 3), ("4", 4), ("8", 8), ("9", 9), ("16", 16)];
        compare(
            &format!("A Wisdom–Holman step, `{scheme}`, merged"),
            contestants.map(|(name, count)| steps(name, scheme, planets(count))).into(),
            repetitions,
        );
    }
    let scheme = "drift-kick-drift";
    let contestants = [steps("8 planets", scheme, planets(8)), steps("with relativity", scheme, with_relativity(8))];
    compare(&format!("A Wisdom–Holman step, `{scheme}`, merged"), contestants.into(), 2000);
}
