//! Means beside a long drift, and frequencies beside Laplace and Lagrange's.

use super::*;
use crate::exact;
use crate::systems::increments::Carried;
use crate::systems::system::System as _;
use crate::systems::wisdom_holman::Bodies;

/// Two planets of this part of a central mass of 1 with G = 1, at the pericentres of orbits of 1 and `outer` with these
/// eccentricities, the second pericentre opposite.
fn planets(mass: &str, outer: f64, e: [f64; 2]) -> WisdomHolman<f64, Jacobi<f64, 2>, 2> {
    let masses = ["1", mass, mass].map(|mass| exact(mass).unwrap());
    let bodies = Bodies::new(exact("1").unwrap(), masses.to_vec()).unwrap();
    let zeros = [0.0; 6];
    let mut planets = WisdomHolman::<f64, Jacobi<f64, 2>, 2>::new(&bodies, (&zeros, &zeros), &()).unwrap();
    let orbits = planets.coordinates().orbits().planets.clone();
    let (mut q, mut p) = (zeros, zeros);
    for (i, (orbit, (a, sign))) in (1..).zip(orbits.iter().zip([(1.0, 1.0), (outer, -1.0)])) {
        let e = e[i - 1];
        q[2 * i] = sign * a * (1.0 - e);
        p[2 * i + 1] = sign * orbit.mass * (orbit.parameter / a * (1.0 + e) / (1.0 - e)).sqrt();
    }
    let (mut inertial_q, mut inertial_p) = (zeros, zeros);
    let mut coordinates = planets.coordinates().clone();
    coordinates.assign_inertial((&q, &p), (&mut inertial_q, &mut inertial_p));
    planets.set_inertial(&inertial_q, &inertial_p);
    planets
}

/// The flow of A with incommensurable periods reaches all pairs of places equally often.
#[test]
fn means_are_those_along_kepler_orbits() {
    let mut planets = planets("1/1000", 1.8, [0.1, 0.2]);
    let mut means = Means::of(&planets).unwrap();
    let expected = means.at([0.1, -0.2]);
    let mut sums = [0.0; 2];
    const STEPS: usize = 100_000;
    for _ in 0..STEPS {
        planets.drift(&1.0, Carried::Nothing);
        means.q.copy_from_slice(planets.at.state.q());
        let energies = means.energies();
        sums = [sums[0] + energies[0], sums[1] + energies[1]];
    }
    for (sum, expected) in sums.iter().zip(expected) {
        let mean = sum / STEPS as f64;
        // sums of sinusoids do not grow with the time
        assert!((mean / expected - 1.0).abs() < 5e-4, "{mean:e} is not {expected:e}");
    }
}

/// Laplace's coefficient b_{3/2}^{(j)}(α).
fn laplace(j: f64, alpha: f64) -> f64 {
    let angles = (0..400).map(|n| std::f64::consts::TAU * f64::from(n) / 400.0);
    let value = |psi: f64| (j * psi).cos() / (1.0 - 2.0 * alpha * psi.cos() + alpha * alpha).powf(1.5);
    angles.map(value).sum::<f64>() / 200.0
}

/// Murray & Dermott, (7.9)–(7.12) and (7.28).
#[test]
fn frequencies_are_those_of_laplace_and_lagrange() {
    let (mass, alpha) = (1e-5, 1.0 / 1.8);
    let found = predicted_frequencies(&planets("1/100000", 1.8, [0.0, 0.0]), 0.0).unwrap();
    let [inner, outer] = [(1.0, alpha), (1.8f64.powf(-1.5), 1.0)].map(|(n, ratio)| n * mass / 4.0 * alpha * ratio);
    let [diagonal, other] = [1.0, 2.0].map(|j| laplace(j, alpha));
    let (sum, product) = ((inner + outer) * diagonal, inner * outer * (diagonal * diagonal - other * other));
    let root = (sum * sum / 4.0 - product).sqrt();
    let mut expected = [sum / 2.0 - root, sum / 2.0 + root];
    if found[0].omega > found[1].omega {
        expected.reverse();
    }
    for (found, expected) in found.iter().zip(expected) {
        // first order in the masses, and squares of the small e
        assert!((found.omega / expected - 1.0).abs() < 1e-4, "{found:?} is not {expected:e}");
        assert_eq!(found.change, 0.0);
    }
}

/// Far from the other planet B_Q of the inner one is the tide, and the mean of its square 5/2 m²a²(1 + 3e²/2)/a_2⁶
/// times m′.
#[test]
fn the_change_is_that_of_the_tide_squared() {
    let (mass, outer, factor) = (1e-3, 40.0_f64, 0.1);
    let [inner, _] = predicted_frequencies(&planets("1/1000", outer, [0.0, 0.0]), factor).unwrap();
    let expected = -7.5 * mass * mass * outer.powi(-6) * factor;
    // the next terms of the tide are some 20 times 1/40²
    assert!((inner.change / expected - 1.0).abs() < 0.02, "{inner:?} is not {expected:e}");
    // the tide of a ring: 3/4 n m (a/a_2)³
    assert!((inner.omega / (0.75 * mass * outer.powi(-3)) - 1.0).abs() < 0.02, "{inner:?}");
}
