//! Protects Wisdom–Holman systems: coordinates that are canonical, orders that are those proved for H = A + εB, and the
//! modified energy.
//!
//! Yardsticks: the same bodies with H = T(p) + U(q) in inertial coordinates, whose flow is extrapolated from leapfrog
//! steps; and the energies of both.

use rug::Float;
use shadowstep::number::{Limbs, Number, Precision, Real};
use shadowstep::shadow::Bilinear;
use shadowstep::systems::kinetic::General;
use shadowstep::systems::wisdom_holman::{Bodies, DemocraticHeliocentric, Jacobi, PlanetaryCoordinates, WisdomHolman};
use shadowstep::tables::{self, TableScheme};
use shadowstep::{Rational, Scheme, Stepper, System, ValidFor};
use shadowstep_schemes::{First, Proved, shipped_names, shipped_proved};
use shadowstep_tests::orders::Measured;
use shadowstep_tests::reference::Separable;
use shadowstep_tests::shipped::all_for_every_kinetic;
use shadowstep_tests::steps::Steps;
use shadowstep_tests::{
    Bits, log10_distance, log10_largest_distance, numbers, precision, rational, same_bits, variations, watched,
};

/// Digits of the computation.
const DIGITS: u32 = 60;

/// A central body and two heavy planets in the plane, G = 1: masses, positions and velocities.
/// Light planets would show ε times a high order where a scheme is for H = A + εB.
const MASSES: [&str; 3] = ["1", "3/10", "1/8"];
const POSITIONS: [&str; 6] = ["0.01", "0.02", "1.1", "0.1", "-0.3", "1.7"];
const VELOCITIES: [&str; 6] = ["0.001", "0.003", "-0.1", "0.9", "-0.75", "-0.1"];

fn bodies(perturbation: &Rational) -> Bodies {
    let masses = (0..3).map(|body| match body {
        0 => rational(MASSES[0]),
        planet => rational(MASSES[planet]) * perturbation,
    });
    Bodies::new(rational("1"), masses.collect()).expect("they are bodies")
}

/// Inertial positions and momenta.
fn start<N: Number>(bodies: &Bodies, context: &N::Context) -> (Vec<N>, Vec<N>) {
    let q = POSITIONS.map(|q| N::from_rational(&rational(q), context));
    let momentum = |(axis, v): (usize, &&str)| N::from_rational(&(rational(v) * &bodies.masses()[axis / 2]), context);
    (q.to_vec(), VELOCITIES.iter().enumerate().map(momentum).collect())
}

fn system<N: Number, C: PlanetaryCoordinates<N, 2>>(bodies: &Bodies, context: &N::Context) -> WisdomHolman<N, C, 2> {
    let (q, p) = start(bodies, context);
    WisdomHolman::new(bodies, (&q, &p), context).expect("a state of three bodies")
}

fn plain<N: Number, C: PlanetaryCoordinates<N, 2>>(context: &N::Context) -> WisdomHolman<N, C, 2> {
    system(&bodies(&rational("1")), context)
}

/// U of the bodies in inertial coordinates, and U_q.
fn gravity(q: &[Float]) -> (Float, Vec<Float>) {
    let zero = Float::new(q[0].prec());
    let masses =
        MASSES.map(|mass| Float::from_rational(&rational(mass), &Precision::bits(q[0].prec()).expect("it is one")));
    let (mut energy, mut gradient) = (zero.clone(), vec![zero; 6]);
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let d = [0, 1].map(|axis| q[2 * j + axis].clone() - &q[2 * i + axis]);
        let r2 = d[0].clone().square() + d[1].clone().square();
        let r = r2.clone().sqrt();
        let product = masses[i].clone() * &masses[j];
        energy -= product.clone() / &r;
        for (axis, d) in d.into_iter().enumerate() {
            let force = d * &product / &r2 / &r;
            gradient[2 * j + axis] += &force;
            gradient[2 * i + axis] -= force;
        }
    }
    (energy, gradient)
}

fn velocities(p: &[Float]) -> Vec<Float> {
    let mass = |axis: usize| {
        Float::from_rational(&rational(MASSES[axis / 2]), &Precision::bits(p[0].prec()).expect("it is one"))
    };
    p.iter().enumerate().map(|(axis, p)| p.clone() / mass(axis)).collect()
}

fn is_canonical<C: PlanetaryCoordinates<Float, 2>>() {
    let context = precision(DIGITS);
    let mut coordinates = C::new(&bodies(&rational("1")), &context);
    // linear: of states u and v, Σ (q_u p_v − q_v p_u) is the same in both coordinates, and back is the same state
    let state = |seed: i32| -> (Vec<Float>, Vec<Float>) {
        let number = |k: i32| Float::with_val(context.in_bits(), seed * k * k + 3 * k + 1) / 7;
        ((1..=6).map(number).collect(), (7..=12).map(number).collect())
    };
    let product = |(q, p): &(Vec<Float>, Vec<Float>), (other_q, other_p): &(Vec<Float>, Vec<Float>)| {
        let mut sum = Float::new(context.in_bits());
        for i in 0..6 {
            sum += q[i].clone() * &other_p[i] - other_q[i].clone() * &p[i];
        }
        sum
    };
    let canonical = [state(2), state(5)].map(|(q, p)| {
        let (mut own_q, mut own_p) = (q.clone(), p.clone());
        coordinates.assign_from_inertial((&q, &p), (&mut own_q, &mut own_p));
        let (mut back_q, mut back_p) = (q.clone(), p.clone());
        coordinates.assign_inertial((&own_q, &own_p), (&mut back_q, &mut back_p));
        // sums of some 10 terms of size 100 at most
        let far = log10_largest_distance(&[q, p].concat(), &[back_q, back_p].concat());
        assert!(far < 5.0 - f64::from(DIGITS), "10^{far}");
        (own_q, own_p)
    });
    let far = log10_distance(&product(&canonical[0], &canonical[1]), &product(&state(2), &state(5)));
    assert!(far < 7.0 - f64::from(DIGITS), "10^{far}");
}

#[test]
fn the_coordinates_are_canonical() {
    is_canonical::<Jacobi<Float, 2>>();
    is_canonical::<DemocraticHeliocentric<Float, 2>>();
}

#[test]
fn the_energy_is_that_of_inertial_coordinates() {
    let context = precision(DIGITS);
    let bodies = bodies(&rational("1"));
    let (q, p) = start::<Float>(&bodies, &context);
    let kinetic = p.iter().zip(velocities(&p)).fold(Float::new(context.in_bits()), |sum, (p, v)| sum + v * p);
    let energy = gravity(&q).0 + kinetic / 2;
    let jacobi = System::energy(&mut plain::<Float, Jacobi<_, 2>>(&context));
    let heliocentric = System::energy(&mut plain::<Float, DemocraticHeliocentric<_, 2>>(&context));
    for found in [jacobi, heliocentric] {
        assert!(log10_distance(&found, &energy) < 2.0 - f64::from(DIGITS), "{found} and {energy}");
    }
}

/// q and p in inertial coordinates.
fn inertial<C: PlanetaryCoordinates<Float, 2>>(system: &mut WisdomHolman<Float, C, 2>) -> Vec<Float> {
    let (q, p) = system.inertial();
    [q, p].concat()
}

#[test]
fn the_orders_are_those_proved() {
    let context = precision(DIGITS);
    let (q, p) = start::<Float>(&bodies(&rational("1")), &context);
    let separable = Separable { velocity: &velocities, gradient: &|q| gravity(q).1 };
    let flow = |h: &Float| separable.flow(&[q.clone(), p.clone()].concat(), h, 12);
    let start = || plain::<Float, Jacobi<_, 2>>(&context);
    Measured { start: &start, coordinates: inertial, flow: &flow, digits: DIGITS, halvings: 7 }.check_all(0.1);
    let start = || plain::<Float, DemocraticHeliocentric<_, 2>>(&context);
    let general = Measured { start: &start, coordinates: inertial, flow: &flow, digits: DIGITS, halvings: 7 };
    for order in general.orders(all_for_every_kinetic, |scheme| scheme.summary.order) {
        assert!(order.off() < 0.1, "{order:?}");
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Near-integrable schemes: the error is ε h^{p+1} + ε² h^{q+1} + …, ε the ratio of the masses

/// 221 digits, for ε³h⁵ with ε = 1e-40.
type Fine = Limbs<12>;

/// A scheme for every H = A + B.
fn scheme(name: &str) -> TableScheme<General> {
    quadratic(name).for_every_kinetic().expect("it is for every H = A + B")
}

/// A scheme for parts of which one is quadratic in p, but for a function of q.
fn quadratic(name: &str) -> TableScheme {
    tables::shipped(name).expect("it is listed")
}

/// q and v of the planets after a time 2^−k, in `steps` steps of a scheme, with planets of 1e-40 times `times` of the
/// central mass.
fn end<C, K>(scheme: TableScheme<K>, k: u32, steps: u64, times: i64) -> Vec<Fine>
where
    C: PlanetaryCoordinates<Fine, 2>,
    TableScheme<K>: Scheme + ValidFor<C::Class>,
{
    let bodies = bodies(&(rational("1e-40") * Rational::from_integer(times.into())));
    let mut system = system::<Fine, C>(&bodies, &());
    let h = rational(&format!("1/{}", steps << k));
    let stepper = Stepper::with_context(scheme, &h, &()).expect("it is nonzero");
    (0..steps).for_each(|_| stepper.step(&mut system));
    let (q, p) = system.inertial();
    let velocity = |(axis, mut p): (usize, Fine)| {
        p.divide(&Fine::from_rational(&bodies.masses()[axis / 2], &()));
        p
    };
    q.into_iter().skip(2).chain(p.into_iter().enumerate().skip(2).map(velocity)).collect()
}

/// log₂ of the terms of ε, ε², ε³ of a step's error, by differences in ε: what is left of higher powers is 1e-40 of
/// them.
///
/// `exact` has the ends of the flow for each factor of ε.
fn terms<C, K>(scheme: &TableScheme<K>, k: u32, exact: &impl Fn(i64) -> Vec<Fine>) -> [f64; 3]
where
    C: PlanetaryCoordinates<Fine, 2>,
    TableScheme<K>: Scheme + Clone + ValidFor<C::Class>,
{
    let differences: [&[(i32, i64)]; 3] = [&[(1, 1)], &[(2, 1), (-1, 2)], &[(3, 1), (-3, 2), (1, 3)]];
    differences.map(|difference| {
        let mut sum = vec![Fine::zero(&()); 8];
        for (factor, times) in difference {
            for ((sum, mut error), exact) in
                sum.iter_mut().zip(end::<C, K>(scheme.clone(), k, 1, *times)).zip(exact(*times))
            {
                error.subtract(&exact);
                error.multiply_integer(*factor);
                sum.add(&error);
            }
        }
        sum.iter().map(Real::log10_abs).fold(f64::NEG_INFINITY, f64::max) / std::f64::consts::LOG10_2
    })
}

/// The flow is approximated by 32 steps of order (10, 6, 4) of the same system: its error is 32^−4 of the largest error
/// measured here, or less.
fn orders_in_epsilon<C, K>(names: &[&str], scheme: fn(&str) -> TableScheme<K>)
where
    C: PlanetaryCoordinates<Fine, 2>,
    TableScheme<K>: Scheme + Clone + ValidFor<C::Class>,
{
    let [coarse, fine] = [4, 5].map(|k| {
        let ends: Vec<_> = (1..=3).map(|times| end::<C, K>(scheme("aba1064"), k, 32, times)).collect();
        let exact = |times: i64| ends[times as usize - 1].clone();
        names.iter().map(|name| terms::<C, K>(&scheme(name), k, &exact)).collect::<Vec<_>>()
    });
    for (name, (coarse, fine)) in names.iter().zip(coarse.iter().zip(&fine)) {
        let proved = shipped_proved(name).expect("it is listed");
        let claim = proved.scheme.table.near_integrable.as_ref().expect("it has one");
        for (i, (coarse, fine)) in coarse.iter().zip(fine).enumerate() {
            let order = coarse - fine - 1.0;
            let proved = f64::from(claim.orders.get(i).or(claim.orders.last()).expect("there are orders").value);
            println!("{name} ε^{}: {order:.3}, proved {proved}", i + 1);
            // c h/ln 2 with c of size 1, h = 1/32; of higher powers of ε the order may be higher than is proved
            let off = if i < claim.orders.len() { (order - proved).abs() } else { proved - order };
            assert!(off < 0.2, "{name}, ε^{}: {order} measured, {proved} proved", i + 1);
        }
    }
}

#[test]
fn the_orders_in_epsilon_are_those_proved() {
    let is_near_integrable = |name: &&str| {
        let proved = shipped_proved(name).expect("it is listed");
        proved.scheme.table.near_integrable.is_some()
    };
    let names: Vec<_> = shipped_names().into_iter().filter(is_near_integrable).collect();
    assert!(names.len() > 10);
    orders_in_epsilon::<Jacobi<_, 2>, _>(&names, quadratic);
    let for_every_part: Vec<_> =
        names.into_iter().filter(|name| shipped_proved(name).is_some_and(Proved::holds_for_every_kinetic)).collect();
    assert!(for_every_part.len() > 10);
    orders_in_epsilon::<DemocraticHeliocentric<_, 2>, _>(&for_every_part, scheme);
}

// ---------------------------------------------------------------------------------------------------------------
// The modified energy of the Sun, Jupiter and Saturn, in astronomical units, years and solar masses

/// Thirty digits more than `f64` has.
type Reference = Limbs<3>;

/// The planets at their pericentre and apocentre, e about 0.05; G = 4π².
fn giants<N: Number, C: PlanetaryCoordinates<N, 2>>(context: &N::Context) -> WisdomHolman<N, C, 2> {
    let masses = ["1", "1/1047.35", "1/3498"].map(rational);
    let momenta = ["0", "0", "0", "2.8967/1047.35", "0", "-1.934/3498"];
    let bodies = Bodies::new(rational("4*pi^2"), masses.to_vec()).expect("they are bodies");
    let q = numbers(&["0", "0", "4.94", "0", "-10.03", "0"], context);
    let p = numbers(&momenta, context);
    WisdomHolman::new(&bodies, (&q, &p), context).expect("a state of three bodies")
}

/// max − min of H and of E_8 and E_24 over 100 years.
fn variations<C>(h: &str, steps: u64) -> [f64; 3]
where
    C: PlanetaryCoordinates<Limbs<4>, 2> + Clone,
    TableScheme<General>: ValidFor<C::Class>,
{
    let drift_first = shadowstep_tests::shipped::twin("stormer-verlet", Some(First::Drift));
    let stepper =
        Stepper::<_, Limbs<4>>::new(drift_first.for_every_kinetic().expect("it is"), h).expect("it is nonzero");
    variations::of_energies(&stepper, || giants::<Limbs<4>, C>(&()), steps, [8, 24])
}

#[test]
fn the_modified_energy_is_conserved() {
    let jacobi = [("1/4", 400), ("1/2", 200), ("1", 100)].map(|(h, steps)| variations::<Jacobi<_, 2>>(h, steps));
    let heliocentric = variations::<DemocraticHeliocentric<_, 2>>("1/4", 400);
    println!("{jacobi:?} {heliocentric:?}");
    // H varies by ε h², E_k by far less: measured 2.2e-9, 4.2e-17, 6.3e-22; 9.0e-9, 5.8e-13, 2.3e-14; 3.9e-8, 1.1e-9,
    // 4.8e-10
    let bounds = [[1e-16, 2e-21], [1e-12, 5e-14], [3e-9, 1e-9]];
    for ([energy, k8, k24], [bound8, bound24]) in jacobi.into_iter().zip(bounds).chain([(heliocentric, bounds[0])]) {
        assert!(energy > 2e-9 && k8 < bound8 && k24 < bound24, "H {energy:e}, E_8 {k8:e}, E_24 {k24:e}");
    }
}

fn steps_are_steps<N: Bits, C>(context: &N::Context)
where
    C: PlanetaryCoordinates<N, 2>,
    TableScheme<General>: ValidFor<C::Class>,
{
    let steps = Steps::of(scheme("abah864"), &rational("1/3"), context);
    // positions of size 10, and sums of some twenty terms in each of twenty steps there and back
    steps.check("abah864", || giants::<N, C>(context), 20, 3.5);
}

#[test]
fn steps_are_steps_in_both_kinds_of_numbers() {
    steps_are_steps::<f64, Jacobi<_, 2>>(&());
    steps_are_steps::<f64, DemocraticHeliocentric<_, 2>>(&());
    steps_are_steps::<Float, Jacobi<_, 2>>(&precision(DIGITS));
    steps_are_steps::<Float, DemocraticHeliocentric<_, 2>>(&precision(DIGITS));
}

#[test]
fn the_monitor_judges_a_step_size() {
    let verdict = |h: &str, steps: u64| {
        let stepper = Stepper::new(scheme("saba2"), h).expect("it is nonzero");
        let mut system = giants::<f64, Jacobi<_, 2>>(&());
        watched(stepper, &mut system, &Bilinear::with_error(8), 1, steps).verdict
    };
    assert!(verdict("1/4", 4000).is_bounded());
    assert!(!verdict("5", 2000).is_bounded());
}

#[test]
fn compensated_sums_lose_less() {
    let stepper = Stepper::new(scheme("saba4"), "1/16").expect("it is nonzero");
    let exact = Stepper::<_, Reference>::new(scheme("saba4"), "1/16").expect("it is nonzero");
    let (mut plain, mut reference) = (giants::<f64, Jacobi<_, 2>>(&()), giants::<Reference, Jacobi<_, 2>>(&()));
    let mut compensated = giants::<f64, Jacobi<_, 2>>(&()).compensated();
    let mut sums = [0.0; 2];
    for _ in 0..20 {
        for _ in 0..500 {
            stepper.step(&mut plain);
            stepper.step(&mut compensated);
            exact.step(&mut reference);
        }
        // of the energy: a difference in phase grows with what is lost at the beginning
        let energy = System::energy(&mut reference).to_f64();
        for (sum, system) in sums.iter_mut().zip([&mut plain, &mut compensated]) {
            *sum += (System::energy(system) / energy - 1.0).powi(2);
        }
    }
    let [plain, compensated] = sums.map(|sum| (sum / 20.0).sqrt());
    println!("relative errors of H by round-off, rms: plain {plain:e}, compensated {compensated:e}");
    assert!(compensated < plain / 2.0, "{compensated:e}, {plain:e}");
}

/// A last body of 1e-40 of the central mass moves among the others and changes no bit of them.
#[test]
fn bodies_of_tiny_masses_are_test_particles() {
    let tiny = rational("1e-40");
    let ends = [2, 3].map(|count| {
        let masses = ["1", "1/1047.35"].map(rational).into_iter().chain([tiny.clone()]).take(count).collect();
        let bodies = Bodies::new(rational("4*pi^2"), masses).expect("they are bodies");
        let q = [0.0, 0.0, 4.94, 0.0, -3.2, 0.1];
        let p = [0.0, 0.0, 0.0, 2.8967 / 1047.35, 0.0, -3.5e-40];
        let mut system = WisdomHolman::<f64, Jacobi<f64, 2>, 2>::new(&bodies, (&q[..2 * count], &p[..2 * count]), &());
        let system = system.as_mut().expect("a state of these bodies");
        let stepper = Stepper::new(scheme("saba4"), "1/16").expect("it is nonzero");
        (0..1000).for_each(|_| stepper.step(system));
        let (q, p) = system.inertial();
        (q, p, System::energy(system))
    });
    let [(q, p, energy), (with_q, with_p, with_energy)] = &ends;
    assert!(same_bits(q, &with_q[..4]) && same_bits(p, &with_p[..4]) && energy == with_energy);
    assert!((2.5..4.5).contains(&with_q[4].hypot(with_q[5])), "{with_q:?}");
}
