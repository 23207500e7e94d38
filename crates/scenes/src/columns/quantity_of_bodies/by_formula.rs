//! Quantities that are formulas in the coordinates and momenta of bodies.

use crate::document::quantity::{ANGULAR_MOMENTUM, DISTANCE};
use crate::scene::bodies::{AXES, Bodies};
use crate::scene::{PairEnergy, System};
use crate::texts::refusal::{Refusal, refuse};

/// The formula of a quantity.
pub(super) fn of(name: &str, arguments: &[String], (system, bodies): (&System, &Bodies)) -> Result<String, Refusal> {
    match (name, arguments) {
        (DISTANCE, [one, other]) => {
            refuse_box(system)?;
            distance(system, bodies, [bodies.number(one)?, bodies.number(other)?])
        }
        (DISTANCE, _) => refuse("a distance is one of two bodies", "write distance(earth, moon)"),
        (ANGULAR_MOMENTUM, []) if bodies.dimensions == 2 => Ok(component(system, bodies, [0, 1])),
        (ANGULAR_MOMENTUM, []) if bodies.dimensions == 3 => {
            let squares = [[1, 2], [2, 0], [0, 1]].map(|axes| format!("({})^2", component(system, bodies, axes)));
            Ok(format!("sqrt({})", squares.join(" + ")))
        }
        (ANGULAR_MOMENTUM, [axis]) if bodies.dimensions == 3 && AXES.contains(&&**axis) => {
            let number = AXES.iter().position(|own| own == axis).expect("it is one of them");
            Ok(component(system, bodies, [(number + 1) % 3, (number + 2) % 3]))
        }
        (ANGULAR_MOMENTUM, _) if bodies.dimensions == 3 => {
            refuse("an axis of the angular momentum is x, y or z", "write angular_momentum or angular_momentum(z)")
        }
        _ => {
            refuse("the angular momentum in a plane has no axis, and on a line there is none", "write angular_momentum")
        }
    }
}

fn refuse_box(system: &System) -> Result<(), Refusal> {
    match system.potential.pairs().is_some_and(PairEnergy::is_in_box) {
        true => refuse("bodies in a periodic box have many distances", "write a formula in the coordinates"),
        false => Ok(()),
    }
}

fn distance(system: &System, bodies: &Bodies, of: [usize; 2]) -> Result<String, Refusal> {
    let [one, other] = of.map(|body| &system.coordinates[bodies.coordinates(body)]);
    let squares = one.iter().zip(other).map(|(a, b)| format!("({a} - {b})^2"));
    Ok(format!("sqrt({})", squares.collect::<Vec<_>>().join(" + ")))
}

/// Σ (q_a p_b − q_b p_a) of two axes over the bodies; those of mass 0 have none.
fn component(system: &System, bodies: &Bodies, [a, b]: [usize; 2]) -> String {
    let of_body = |body: usize| {
        let (q, p) = (&system.coordinates[bodies.coordinates(body)], &system.momenta[bodies.coordinates(body)]);
        format!("{}*{} - {}*{}", q[a], p[b], q[b], p[a])
    };
    (0..bodies.names.len() - system.particles()).map(of_body).collect::<Vec<_>>().join(" + ")
}

#[cfg(test)]
mod tests {
    use crate::watch::observer::testing::{read, rows};

    /// The values of a formula at each of ten steps.
    fn values(problem: &str, formula: &str) -> Vec<f64> {
        let scene = read(&format!(
            "{problem}\n[run]\nscheme = \"yoshida4\"\nstep = \"1/100\"\nsteps = 10\n[output]\nvalues = {{ v = \"{formula}\" }}\n"
        ));
        rows(&scene)[1..].iter().map(|row| row.last().unwrap().parse().unwrap()).collect()
    }

    const SPACE: &str = "[problem]\nparameters = { g = 1 }\n[[body]]\nname = \"sun\"\nmass = 2\nq = [0, 0, 0]\nv = \
        [0, 0, 0]\n\
                         [[body]]\nname = \"earth\"\nmass = 3\nq = [1, 0, 2]\nv = [0, 1, 5]\n\
                         [[body]]\nname = \"comet\"\nmass = 0\nq = [4, 0, 1]\nv = [1, 1, 0]";

    /// m q × v at the start, conserved, without the body of mass 0; and the steps conserve it.
    #[test]
    fn the_angular_momentum_is_that_of_bodies_with_mass() {
        for (axis, expected) in [("(x)", -6.0), ("(y)", -15.0), ("(z)", 3.0), ("", 270_f64.sqrt())] {
            let found = values(SPACE, &format!("angular_momentum{axis}"));
            assert!(found.len() == 11 && found.iter().all(|own| (own - expected).abs() < 1e-13), "{axis}: {found:?}");
        }
        let plane = "[problem]\npair = \"-m_i*m_j/sqrt(r2)\"\ndimensions = 2\nbodies = { m = [1, 2] }\nmasses = \"m\"\n\
                     [initial]\nq = [0, 0, 3, 1]\np = [0, 0, 1, 1]";
        assert!(values(plane, "angular_momentum").iter().all(|own| (own - 2.0).abs() < 1e-14));
    }

    #[test]
    fn a_distance_is_that_of_two_bodies() {
        assert_eq!(values(SPACE, "distance(sun, comet)")[0], 17_f64.sqrt());
    }
}
