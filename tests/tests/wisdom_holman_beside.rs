//! Protects potentials beside the attraction of planets: formulas of bodies, their exact flow with the attraction, and
//! what is conserved.
//!
//! Yardsticks: the same H as one formula in inertial coordinates, whose flow is extrapolated from leapfrog steps; the
//! closed solution of a Kepler orbit with a 1/r² potential; the first-order theory of the nodes of satellites about an
//! oblate body.

use rug::Float;
use shadowstep::number::{Limbs, Number, Real};
use shadowstep::systems::formula::{FormulaOfBodies, FormulaPair, FormulaPotential, RelativeTo};
use shadowstep::systems::pairs::{Pairs, Separation};
use shadowstep::systems::potential::Sum;
use shadowstep::systems::wisdom_holman::{Bodies, BodiesError, DemocraticHeliocentric, Jacobi, WisdomHolman};
use shadowstep::{Potential, Stepper, System};
use shadowstep_tests::orders::Measured;
use shadowstep_tests::reference::Separable;
use shadowstep_tests::shipped::twin;
use shadowstep_tests::steps::Steps;
use shadowstep_tests::{
    Bits, log10_distance, log10_largest_distance, number, numbers, potential_values, precision, rational, stepper,
    variations,
};

const DIGITS: u32 = 60;

/// Relativity about the first body, and a tide with a gradient along x; both strong.
const CENTRAL: &str = "-3*(g*m0)^2*m/(c^2*r^2) + m*s/r^3*(3*y^2/r^2 - 1)";
const EXTERNAL: &str = "m*(k*x^2/2 - y^3/40)";
const PARAMETERS: [(&str, &str); 4] = [("g", "1"), ("c", "7"), ("s", "1/100"), ("k", "1/10")];

type Beside<N> = Sum<FormulaOfBodies<N>, FormulaOfBodies<N>>;

fn formula<N: Number>(
    (text, relative_to): (&str, RelativeTo),
    dimensions: usize,
    masses: &[&str],
    parameters: &[(&str, &str)],
    context: &N::Context,
) -> FormulaOfBodies<N> {
    let number = |text: &str| N::from_rational(&rational(text), context);
    let values: Vec<_> = parameters.iter().map(|(name, value)| (*name, number(value))).collect();
    FormulaOfBodies::new(text, relative_to, dimensions, &numbers(masses, context), &values).expect("it is a formula")
}

fn bodies(masses: &[&str]) -> Bodies {
    Bodies::new(rational("1"), masses.iter().map(|mass| rational(mass)).collect()).expect("they are bodies")
}

// ---------------------------------------------------------------------------------------------------------------
// Three heavy bodies in the plane

const MASSES: [&str; 3] = ["1", "3/10", "1/8"];
const POSITIONS: [&str; 6] = ["0.01", "0.02", "1.1", "0.1", "-0.3", "1.7"];
const MOMENTA: [&str; 6] = ["0.001", "0.003", "-0.03", "0.27", "-0.09375", "-0.0125"];

fn beside<N: Number>(context: &N::Context) -> Beside<N> {
    let of = |formula: (&str, RelativeTo)| self::formula(formula, 2, &MASSES, &PARAMETERS, context);
    Sum(of((CENTRAL, RelativeTo::FirstBody)), of((EXTERNAL, RelativeTo::Origin)))
}

fn three<N: Number>(context: &N::Context) -> WisdomHolman<N, Jacobi<N, 2>, 2, Beside<N>> {
    let state = (&numbers::<N>(&POSITIONS, context)[..], &numbers::<N>(&MOMENTA, context)[..]);
    let planets = WisdomHolman::new(&bodies(&MASSES), state, context).expect("a state of three bodies");
    planets.beside(Some(beside(context))).expect("a potential of three bodies")
}

/// U of the same as one formula of all coordinates.
fn in_one_formula<N: Number>(context: &N::Context) -> FormulaPotential<N> {
    let mut terms: Vec<String> = [(0, 1), (0, 2), (1, 2)]
        .map(|(i, j)| format!("-g*({})*({})/sqrt((x{i} - x{j})^2 + (y{i} - y{j})^2)", MASSES[i], MASSES[j]))
        .into();
    for (body, mass) in (0..).zip(MASSES) {
        terms.push(format!("({mass})*(k*x{body}^2/2 - y{body}^3/40)"));
    }
    for (body, mass) in (1..).zip(&MASSES[1..]) {
        let squared = format!("((x{body} - x0)^2 + (y{body} - y0)^2)");
        terms.push(format!("-3*g^2*({mass})/(c^2*{squared})"));
        terms.push(format!("({mass})*s/{squared}^(3/2)*(3*(y{body} - y0)^2/{squared} - 1)"));
    }
    let number = |text: &str| N::from_rational(&rational(text), context);
    let parameters = PARAMETERS.map(|(name, value)| (name, number(value)));
    let coordinates = ["x0", "y0", "x1", "y1", "x2", "y2"];
    FormulaPotential::new(&terms.join(" + "), &coordinates, &parameters).expect("it is a formula")
}

/// The values of a potential at the start.
fn at_start(potential: &impl Potential<Float>) -> Vec<Float> {
    potential_values(potential, &numbers(&POSITIONS, &precision(DIGITS)))
}

#[test]
fn the_potential_is_the_one_of_a_formula_of_all_coordinates() {
    let context = precision(DIGITS);
    let masses = ("m", numbers::<Float>(&MASSES, &context));
    let pair = FormulaPair::new("-m_i*m_j/sqrt(r2)", Separation::SquaredDistance, &[masses], &[]);
    let pairs = Pairs::<_, 2>::all(3, pair.expect("it is a formula")).expect("three bodies");
    let (sum, one) = (at_start(&Sum(pairs, beside(&context))), at_start(&in_one_formula(&context)));
    let off = log10_largest_distance(&sum, &one);
    assert!(off < 2.0 - f64::from(DIGITS), "10^{off}");

    let momenta = numbers::<Float>(&MOMENTA, &context);
    let kinetic = velocities(&momenta).into_iter().zip(momenta).map(|(v, p)| v * p / 2);
    let energy = kinetic.fold(one[0].clone(), |sum, term| sum + term);
    let off = log10_distance(&System::energy(&mut three::<Float>(&context)), &energy);
    assert!(off < 2.0 - f64::from(DIGITS), "10^{off}");
}

fn velocities(p: &[Float]) -> Vec<Float> {
    let mass = |axis: usize| number(MASSES[axis / 2], DIGITS);
    p.iter().enumerate().map(|(axis, p)| p.clone() / mass(axis)).collect()
}

/// Of all schemes for quadratic T, with gradient kicks too, by the errors of steps of 2^−k and 2^−(k − 1).
#[test]
fn the_orders_are_those_proved() {
    let context = precision(DIGITS);
    let start = [numbers::<Float>(&POSITIONS, &context), numbers(&MOMENTA, &context)].concat();
    let potential = in_one_formula::<Float>(&context);
    let gradient = |q: &[Float]| {
        let mut scratch = vec![Float::new(context.in_bits()); potential.scratch()];
        potential.prepare(&mut scratch, &context);
        let mut gradient = q.to_vec();
        potential.gradient(q, &mut gradient, &mut scratch);
        gradient
    };
    let separable = Separable { velocity: &velocities, gradient: &gradient };
    let inertial = |system: &mut WisdomHolman<Float, Jacobi<Float, 2>, 2, Beside<Float>>| {
        let (q, p) = system.inertial();
        [q, p].concat()
    };
    let flow = |h: &Float| separable.flow(&start, h, 12);
    let system = || three::<Float>(&context);
    Measured { start: &system, coordinates: inertial, flow: &flow, digits: DIGITS, halvings: 7 }.check_all(0.1);
}

#[test]
fn steps_are_steps_in_both_kinds_of_numbers() {
    fn check<N: Bits>(context: &N::Context) {
        let steps = Steps::of(twin("chin-4a", None), &rational("1/16"), context);
        steps.check("chin-4a", || three::<N>(context), 20, 3.0);
    }
    check::<f64>(&());
    check::<Float>(&precision(DIGITS));
}

/// With a wrong rate of β it would not converge.
#[test]
fn the_modified_energy_is_conserved() {
    for scheme in ["stormer-verlet", "abah864", "chin-4a"] {
        let stepper: Stepper<_, Limbs<4>> = stepper(scheme, "1/64", &());
        let [energy, k8, k24] = variations::of_energies(&stepper, || three::<Limbs<4>>(&()), 100, [8, 24]);
        println!("{scheme}: H varies by {energy:e}, E_8 by {k8:e}, E_24 by {k24:e}");
        assert!(k8 < energy * 1e-3 && k24 < k8 * 1e-3, "{energy:e}, {k8:e}, {k24:e}");
    }
}

#[test]
fn potentials_that_do_not_fit_are_refused() {
    let (q, p) = (numbers::<f64>(&POSITIONS, &()), numbers::<f64>(&MOMENTA, &()));
    let heliocentric = WisdomHolman::<_, DemocraticHeliocentric<_, 2>, 2>::new(&bodies(&MASSES), (&q, &p), &());
    let beside = heliocentric.and_then(|planets| planets.beside(Some(beside(&()))));
    assert_eq!(beside.map(drop), Err(BodiesError::NoFlow));
    let two = WisdomHolman::<_, Jacobi<_, 2>, 2>::new(&bodies(&MASSES[..2]), (&q[..4], &p[..4]), &());
    let beside = two.and_then(|planets| planets.beside(Some(self::beside(&()))));
    assert_eq!(beside.map(drop), Err(BodiesError::Potential { found: 6, bodies: 2, dimensions: 2 }));
}

// ---------------------------------------------------------------------------------------------------------------
// A planet with a 1/r² potential: its orbit in closed form

/// H = P²/2m′ − κ/r − C/r² has the radial motion of a Kepler orbit with L² − 2m′C in place of L², and turns L/√(L² −
/// 2m′C) times as far. So after the period of a Kepler orbit of this energy, T = 2π√(m′a³/κ) with a = κ/2|E|, the state
/// is turned by 2π/√(1 − 2m′C/L²).
#[test]
fn the_pericentre_turns_as_in_the_closed_solution() {
    // m′ = 1/11, κ = 1/10, C = 3m/c² = 3/1000, from the pericentre at 7/10 with the velocity 8/5
    const PERIOD: &str = "2*pi*sqrt((1/20/(1/7 + 3/490 - 64/550))^3/(11/10))";
    const TURN: &str = "2*pi/sqrt(1 - 66/1000/(112/100)^2)";
    const REVOLUTIONS: u64 = 2;
    type N = Limbs<4>;
    let masses = ["1", "1/10"];
    let relativity = ("-3*(g*m0)^2*m/(c^2*r^2)", RelativeTo::FirstBody);
    let potential = || formula::<N>(relativity, 2, &masses, &[("g", "1"), ("c", "10")], &());
    let [q, p] =
        [["0", "0", "7/10", "0"], ["0", "-8/55", "0", "8/55"]].map(|numbers| self::numbers::<N>(&numbers, &()));
    let turn = format!("{REVOLUTIONS}*{TURN}");
    let expected = ["cos", "sin"].map(|of| N::from_rational(&rational(&format!("7/10*{of}({turn})")), &()));
    let error = |scheme: &str, steps: u64| {
        let planets = WisdomHolman::<_, Jacobi<_, 2>, 2>::new(&bodies(&masses), (&q, &p), &()).expect("two bodies");
        let mut planets = planets.beside(Some(potential())).expect("a potential of two bodies");
        let stepper: Stepper<_, N> = stepper(scheme, &format!("{PERIOD}/{steps}"), &());
        (0..steps * REVOLUTIONS).for_each(|_| stepper.step(&mut planets));
        log10_largest_distance(&planets.state().q()[2..], &expected)
    };
    for (scheme, order) in [("stormer-verlet", 2.0), ("abah864", 4.0), ("chin-4a", 4.0), ("blanes-moan-srkn11b", 6.0)] {
        let [coarse, fine] = [200, 400].map(|steps| error(scheme, steps));
        println!("{scheme}: 10^{coarse:.2}, 10^{fine:.2}");
        let measured = (coarse - fine) / std::f64::consts::LOG10_2;
        assert!((measured - order).abs() < 0.1, "{scheme}: {measured}, {order} proved");
    }
    // 10 times more: that many digits of the turn are right
    assert!(error("blanes-moan-srkn11b", 2000) < -13.0);
}

// ---------------------------------------------------------------------------------------------------------------
// A satellite of an oblate planet

const OBLATE: &str = "g*m0*m*j2*radius^2/(2*r^3)*(3*z^2/r^2 - 1)";

/// The mean rate of the node as a part of that of the first-order theory, −3/2 n J2 (R/p)² cos i, less 1, and the
/// largest change of J_z as a part of it; and of J_x.
fn satellite<N: Real>(j2: &str, context: &N::Context) -> [f64; 3] {
    const STEPS: u64 = 8000;
    let masses = ["1", "1/1000000"];
    let oblate =
        formula::<N>((OBLATE, RelativeTo::FirstBody), 3, &masses, &[("g", "1"), ("radius", "1"), ("j2", j2)], context);
    // from the pericentre of a = 2, e = 0.1, i = 60 degrees
    let q = numbers::<N>(&["0", "0", "0", "9/5", "0", "0"], context);
    let speed = "sqrt((1 + 1/1000000)*11/18)/1000001";
    let momenta = [
        "0",
        &format!("-{speed}/2"),
        &format!("-{speed}*sqrt(3)/2"),
        "0",
        &format!("{speed}/2"),
        &format!("{speed}*sqrt(3)/2"),
    ];
    let p = numbers::<N>(&momenta, context);
    let planets = WisdomHolman::<_, Jacobi<_, 3>, 3>::new(&bodies(&masses), (&q, &p), context).expect("two bodies");
    let mut planets = planets.beside(Some(oblate)).expect("a potential of two bodies");
    // 40 steps of a revolution
    let stepper: Stepper<_, N> = stepper("abah864", "2*pi*sqrt(8)/40", context);
    let momentum = |planets: &mut WisdomHolman<N, Jacobi<N, 3>, 3, FormulaOfBodies<N>>| {
        let (q, p) = planets.inertial();
        [(1, 2), (2, 0), (0, 1)].map(|(a, b)| {
            let mut sum = N::zero(context);
            for body in [0, 3] {
                sum.add_product(&q[body + a], &p[body + b]);
                sum.subtract_product(&q[body + b], &p[body + a]);
            }
            sum
        })
    };
    let start = momentum(&mut planets);
    let (mut changes, mut sums) = ([0.0_f64; 3], [0.0; 2]);
    for n in 1..=STEPS {
        stepper.step(&mut planets);
        let now = momentum(&mut planets);
        let [x, y, _] = now.each_ref().map(Real::to_f64);
        // the slope of the node's longitude by least squares
        let weight = n as f64 - (STEPS + 1) as f64 / 2.0;
        sums[0] += weight * x.atan2(-y);
        sums[1] += weight * weight;
        for (axis, mut now) in now.into_iter().enumerate() {
            now.subtract(&start[axis]);
            changes[axis] = changes[axis].max(now.to_f64().abs() / start[2].to_f64());
        }
    }
    // (R/p)² = 1/1.98², cos i = 1/2
    let first_order = -1.5 * std::f64::consts::PI * f64::from_rational(&rational(j2), &()) / 1.98_f64.powi(2);
    [sums[0] / sums[1] * 40.0 / first_order - 1.0, changes[2], changes[0]]
}

#[test]
fn the_node_of_a_satellite_turns_as_in_theory() {
    let [[coarse, z, x], [fine, ..]] = ["1/1000", "1/2000"].map(|j2| satellite::<f64>(j2, &()));
    println!("the node: {coarse:e} and {fine:e} off; J_z changes by {z:e}, J_x by {x:e}");
    // what the theory leaves out is of the order of J2
    assert!(coarse.abs() < 2e-3 && (coarse / fine - 2.0).abs() < 0.1, "{coarse:e}, {fine:e}");
    assert!(z < 1e-13 && x > 0.1, "{z:e}, {x:e}");
    let [_, z, _] = satellite::<Limbs<3>>("1/1000", &());
    println!("with 57 digits J_z changes by {z:e}");
    assert!(z < 1e-53, "{z:e}");
}
