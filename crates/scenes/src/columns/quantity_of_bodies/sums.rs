//! Sums over all bodies: the kinetic energy and the virial.

use shadowstep::{Kinetic, Number};

use crate::document::quantity::Compute;
use crate::scene::{ClassifiedKinetic, PotentialEnergy, SceneNumber, System};
use crate::texts::refusal::{Refusal, refuse};

/// Refuses a system that is not T(p) + U(q).
pub(super) fn check(name: &str, system: &System) -> Result<(), Refusal> {
    match system.potential {
        PotentialEnergy::OfParts => refuse(
            format!("`{name}` is of systems T(p) + U(q), and H is not given so"),
            "write a formula in its coordinates and momenta",
        ),
        _ => Ok(()),
    }
}

/// T(p)
pub(super) fn kinetic<N: Number + 'static>(system: &System, context: &N::Context) -> Compute<N> {
    let coordinates = system.coordinates_of_columns();
    match system.kinetic_without_time(context) {
        ClassifiedKinetic::Quadratic(kinetic) => energy_of(kinetic, coordinates, context),
        ClassifiedKinetic::General(kinetic) => energy_of(kinetic, coordinates, context),
    }
}

fn energy_of<N: Number + 'static>(
    kinetic: impl Kinetic<N> + 'static,
    coordinates: usize,
    context: &N::Context,
) -> Compute<N> {
    let zero = N::zero(context);
    let mut scratch = vec![zero.clone(); kinetic.scratch()];
    kinetic.prepare(&mut scratch, context);
    Box::new(move |_, p| {
        let mut energy = zero.clone();
        kinetic.energy(&p[..coordinates], &mut energy, &mut scratch);
        energy
    })
}

/// −qᵀU_q of bodies with mass; slow forces are added.
pub(super) fn virial<N: SceneNumber>(system: &System, context: &N::Context) -> Compute<N> {
    let slow = system.parts.slow_forces().map(|slow| slow.potential());
    let mut sums: Vec<_> =
        [Some(&system.potential), slow].into_iter().flatten().map(|of| N::virial(system, of, context)).collect();
    let zero = N::zero(context);
    Box::new(move |q, _| {
        let mut virial = zero.clone();
        sums.iter_mut().for_each(|sum| virial.add(&sum(q)));
        virial
    })
}

#[cfg(test)]
mod tests {
    use crate::watch::observer::testing::{read, rows};

    /// The greatest size of a formula over the rows of a run.
    fn greatest(problem: &str, run: &str, formula: &str) -> f64 {
        let text = format!(
            "{problem}\n[run]\nstep = \"1/100\"\nsteps = 30\n{run}\n[output]\nvalues = {{ zero = \"{formula}\" }}\n"
        );
        let rows = rows(&read(&text));
        assert!(rows.len() > 2, "{text}");
        rows[1..].iter().map(|row| row.last().unwrap().parse::<f64>().unwrap().abs()).fold(0.0, f64::max)
    }

    const YOSHIDA: &str = "scheme = \"yoshida4\"";
    const BODIES: &str = "[problem]\nparameters = { g = 1 }\nPARTS\n[[body]]\nmass = 1\n[[body]]\nmass = 0.01\nq = \
        [1, 0, 0]\nv = [0, 1, 0.1]\n\
                          [[body]]\nmass = 0\nq = [0, 2, 0]\nv = [-0.7, 0, 0]\n";

    /// A potential of degree k has qᵀU_q = kU.
    #[test]
    fn virials_are_those_of_homogeneous_potentials() {
        let gravity = "kinetic + virial - E";
        let box_of = |cutoff: &str| {
            format!(
                "[problem]\npair = \"1/r2^6\"\ndimensions = 2\nbodies = 9\ncutoff = {cutoff}\nbox = 3.6\nmasses \
                    = \"2\"\n[initial]\n\
                 q = [[0, 0], [1.2, 0.1], [2.3, -0.1], [0.1, 1.2], [1.1, 1.1], [2.5, 1.2], [0, 2.4], [1.2, 2.3], \
                 [2.4, 2.5]]\nv = [[1, 0], [0, 0], [0, 0], [0, 0], [-1, 0], [0, 0], [0, 0], [0, 0], [0, 0]]"
            )
        };
        for (problem, run, formula) in [
            ("problem.name = \"kepler\"".to_owned(), YOSHIDA.to_owned(), gravity),
            ("problem.name = \"kepler\"".to_owned(), format!("{YOSHIDA}\ndigits = 30"), gravity),
            ("problem.name = \"kepler\"\ntime.transform = \"logarithmic\"".to_owned(), YOSHIDA.to_owned(), gravity),
            (BODIES.replace("PARTS", ""), YOSHIDA.to_owned(), gravity),
            (BODIES.replace("PARTS", "parts = \"wisdom-holman\""), "scheme = \"saba4\"".to_owned(), gravity),
            (
                "[problem]\npotential = \"x^4/3\"\nslow = \"x^4/7\"\ncoordinates = [\"x\"]\n[initial]\nq = [1]\np = \
                    [0]"
                .to_owned(),
                "scheme = \"r-respa-4\"".to_owned(),
                "virial + 4*(E - kinetic)",
            ),
            (
                "[problem]\npotential = \"x^4/(3 + t)\"\ncoordinates = [\"x\"]\n[initial]\nq = [1]\np = \
                    [0.2]"
                    .to_owned(),
                YOSHIDA.to_owned(),
                "virial + 4*x^4/(3 + t) + kinetic - px^2/2",
            ),
            (box_of("1.7"), YOSHIDA.to_owned(), "virial - 12*(E - kinetic)"),
        ] {
            let found = greatest(&problem, &run, formula);
            // differences of numbers of the size of 1
            assert!(found < 3e-14, "{problem}, {run}: {found:e}");
        }
    }
}
