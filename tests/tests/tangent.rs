//! Protects tangent maps: symplectic for every shipped scheme, limits of differences at 70 digits, undone by the step
//! back, beside q and p that have the bits they have alone; indicators beside closed forms.

use shadowstep::number::{Dual, Lanes, Limbs, Number, Real, with_parameter};
use shadowstep::problems::HenonHeiles;
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::tables::shipped;
use shadowstep::tangent::{self, Regularity, Tangents, gradient, vector, with_derivatives};
use shadowstep::{
    Integrator as _, Motion, Rational, Scheme, StepSize, Stepper, System, UnitMasses, ValidFor, exact, potential,
};
use shadowstep_schemes::First;
use shadowstep_tests::shipped::{Visitor, for_each_kind_of_step, twins};
use shadowstep_tests::{numbers, stepper};

const START: [[&str; 2]; 2] = [["1/10", "-1/5"], ["3/10", "1/20"]];

/// The unit vectors of a phase space of n = 2.
fn unit_vectors<N: Number>(context: &N::Context) -> [Vec<N>; 4] {
    std::array::from_fn(|k| numbers(&std::array::from_fn::<_, 4, _>(|i| if i == k { "1" } else { "0" }), context))
}

/// A start with the unit vectors.
fn with_unit_vectors<N: Number>(context: &N::Context) -> [[Dual<N, 4>; 2]; 2] {
    let unit = unit_vectors::<N>(context);
    [0, 1].map(|half| {
        let start: Vec<N> = numbers(&START[half], context);
        let of_half = std::array::from_fn(|k| &unit[k][2 * half..2 * half + 2]);
        with_derivatives(&start, of_half).try_into().unwrap()
    })
}

type Star<N> = Motion<N, [N; 2], HenonHeiles, UnitMasses>;

fn star<N: Number>([q, p]: [[N; 2]; 2]) -> Star<N> {
    Motion::new(HenonHeiles, UnitMasses, q, p).unwrap()
}

/// The largest entry of MᵀJM − J, of the columns of M.
fn symplectic_error(columns: &[Vec<f64>; 4]) -> f64 {
    let form = |a: &[f64], b: &[f64]| a[0] * b[2] + a[1] * b[3] - a[2] * b[0] - a[3] * b[1];
    let mut largest = 0.0_f64;
    for i in 0..4 {
        for j in 0..4 {
            let expected = [0.0, 1.0, -1.0][usize::from(j == i + 2) + 2 * usize::from(i == j + 2)];
            largest = largest.max((form(&columns[i], &columns[j]) - expected).abs());
        }
    }
    largest
}

fn columns(star: &Star<Dual<f64, 4>>) -> [Vec<f64>; 4] {
    std::array::from_fn(|k| vector(star.state(), k))
}

fn assert_symplectic_and_undone<S: Scheme + ValidFor<Quadratic> + Clone>(name: &str, scheme: &S) {
    let stepper = Stepper::new(scheme.clone(), "1/20").unwrap();
    let mut carried = star(with_unit_vectors::<f64>(&()));
    let start: [[f64; 2]; 2] = START.map(|half| numbers(&half, &()).try_into().unwrap());
    let plain_stepper = Stepper::new(scheme.clone(), "1/20").unwrap();
    let mut plain = star(start);
    for _ in 0..100 {
        stepper.step(&mut carried);
        plain_stepper.step(&mut plain);
    }
    let values = |numbers: &[Dual<f64, 4>]| numbers.iter().map(|x| x.value.to_bits()).collect::<Vec<_>>();
    let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(values(carried.q()), bits(plain.q()), "{name}");
    assert_eq!(values(carried.p()), bits(plain.p()), "{name}");
    // round-off of 100 steps of up to some 30 stages, of entries up to 10
    let error = symplectic_error(&columns(&carried));
    assert!(error < 1e-12, "{name}: {error}");
    for _ in 0..100 {
        stepper.step_back(&mut carried);
    }
    for (column, unit) in columns(&carried).iter().zip(unit_vectors::<f64>(&())) {
        column.iter().zip(&unit).for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{name}: {a}"));
    }
}

/// Central differences of 10⁻²⁵ in 77 digits: an error of the size 10⁻⁵⁰.
fn assert_limit_of_differences<S: Scheme + ValidFor<Quadratic> + Clone>(name: &str, scheme: &S) {
    type Long = Limbs<4>;
    let direction: Vec<Long> = numbers(&["3/5", "-1/3", "1/7", "2/3"], &());
    let stepper = Stepper::new(scheme.clone(), "1/20").unwrap();
    let [q, p] = START.map(|half| numbers::<Long>(&half, &()));
    let dual = |x: &[Long], of: &[Long]| with_derivatives(x, [of]).try_into().unwrap();
    let mut carried: Star<Dual<Long>> = star([dual(&q, &direction[..2]), dual(&p, &direction[2..])]);
    Stepper::new(scheme.clone(), "1/20").unwrap().steps(std::slice::from_mut(&mut carried), 3);
    let moved = |distance: &str| {
        let distance = &numbers::<Long>(&[distance], &())[0];
        let mut state = [q.clone(), p.clone()].concat();
        state.iter_mut().zip(&direction).for_each(|(x, direction)| x.add_product(distance, direction));
        let mut moved: Star<Long> = star([[state[0], state[1]], [state[2], state[3]]]);
        (0..3).for_each(|_| stepper.step(&mut moved));
        [moved.q(), moved.p()].concat()
    };
    let (plus, minus) = (moved("1e-25"), moved("-1e-25"));
    for ((plus, minus), derivative) in plus.iter().zip(&minus).zip(vector(carried.state(), 0)) {
        let mut difference = *plus;
        difference.subtract(minus);
        difference.multiply(&numbers::<Long>(&["5e24"], &())[0]);
        difference.subtract(&derivative);
        assert!(difference.log10_abs() < -47.0, "{name}: 1e{}", difference.log10_abs());
    }
}

struct TangentMaps;

impl Visitor for TangentMaps {
    fn visit<S: Scheme + ValidFor<Quadratic> + Copy>(&mut self, name: &str, _: Option<First>, scheme: &'static S) {
        assert_symplectic_and_undone(name, scheme);
        assert_limit_of_differences(name, scheme);
        assert_adjoint(name, scheme);
    }
}

#[test]
fn tangent_maps_of_all_schemes_are_symplectic_and_undone() {
    let schemes: Vec<_> = twins().collect();
    assert!(schemes.len() > 90, "{}", schemes.len());
    schemes.iter().for_each(|(name, scheme)| assert_symplectic_and_undone(name, scheme));
}

#[test]
fn derivatives_are_limits_of_differences() {
    twins().for_each(|(name, scheme)| assert_limit_of_differences(&name, &scheme));
}

#[test]
fn tangent_maps_of_generated_steps_are_those_of_tables() {
    for_each_kind_of_step(&mut TangentMaps);
}

/// Lanes, and compensated sums.
#[test]
fn lanes_and_compensated_sums_have_the_same_derivatives() {
    let one = stepper("blanes-moan-srkn6b", "1/20", &());
    let [q, p] = with_unit_vectors::<f64>(&());
    let wide = |x: [Dual<f64, 4>; 2]| x.map(|x| Dual::new(Lanes::<4>::all(x.value), x.derivatives.map(Lanes::all)));
    let mut plain = star([q, p]);
    let mut lanes = star([wide(q), wide(p)]);
    let mut compensated = star([q, p]).compensated();
    let lanes_stepper = stepper("blanes-moan-srkn6b", "1/20", &());
    for _ in 0..200 {
        one.step(&mut plain);
        one.step(&mut compensated);
        lanes_stepper.step(&mut lanes);
    }
    for k in 0..4 {
        let [plain, compensated] = [vector(plain.state(), k), vector(compensated.state(), k)];
        let wide: Vec<_> = plain.iter().map(|x| Lanes::<4>::all(*x)).collect();
        assert_eq!(wide, vector(lanes.state(), k));
        plain.iter().zip(&compensated).for_each(|(a, b)| assert!((a - b).abs() < 1e-12));
    }
}

/// λᵀMδ by steps back with λ, and by steps with δ.
fn assert_adjoint<S: Scheme + ValidFor<Quadratic> + Clone>(name: &str, scheme: &S) {
    let stepper = Stepper::new(scheme.clone(), "1/20").unwrap();
    let [q, p] = START.map(|half| numbers::<f64>(&half, &()));
    let dual = |x: &[f64], of: &[f64]| with_derivatives(x, [of]).try_into().unwrap();
    let (of_q, of_p) = ([0.3, -0.7], [0.2, 0.5]);
    let mut carried: Star<Dual<f64>> = star([dual(&q, &of_q), dual(&p, &of_p)]);
    (0..50).for_each(|_| stepper.step(&mut carried));
    stepper.postprocess(&mut carried);
    let forward = vector(carried.state(), 0);
    let values = |numbers: &[Dual<f64>]| numbers.iter().map(|x| x.value).collect::<Vec<_>>();
    let covector = |q: &[f64], p: &[f64]| (vec![q[0], q[1] * p[1]], vec![p[0].cos(), 1.0]);
    let (by_q, by_p) = covector(&values(carried.q()), &values(carried.p()));
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let expected = product(&by_q, &forward[..2]) + product(&by_p, &forward[2..]);
    let zero: Star<Dual<f64>> = star([dual(&q, &[0.0; 2]), dual(&p, &[0.0; 2])]);
    let (by_q, by_p) = gradient(&mut stepper.with(zero), 50, covector);
    let found = product(&by_q, &of_q) + product(&by_p, &of_p);
    assert!((found - expected).abs() < 1e-12, "{name}: {found} and {expected}");
}

#[test]
fn gradients_backwards_are_those_of_vectors_forwards() {
    twins().for_each(|(name, scheme)| assert_adjoint(&name, &scheme));
}

/// L = λ·(q, p) at the end of a chaotic orbit: its derivatives along a vector and by h, forwards and backwards, and
/// whether the steps back end at the initial state.
fn along_and_back<M>(sums: impl Fn(Star<Dual<f64>>) -> M, steps: u64) -> ([f64; 2], [f64; 2], bool)
where
    M: System<Number = Dual<f64>, Class = Quadratic>,
{
    let (along, covector) = ([0.3, -0.7, 0.2, 0.5], (vec![1.0, 0.5], vec![-0.3, 0.2]));
    let orbit = |of: [f64; 4]| {
        let dual = |x: [f64; 2], of: &[f64]| with_derivatives(&x, [of]).try_into().unwrap();
        sums(star([dual([0.0, -0.25], &of[..2]), dual([0.42081, 0.0], &of[2..])]))
    };
    let with_h =
        |h: &Rational| Stepper::new(shipped("yoshida4").unwrap(), StepSize::try_from(h.clone()).unwrap()).unwrap();
    let (h, near) = (exact("1/5").unwrap(), exact("1/5 + 1e-30").unwrap());
    let by_h = with_parameter(&exact("1e-30").unwrap(), |at| with_h([&h, &h, &near][at])).unwrap();
    let product = |vector: &[f64]| covector.0.iter().chain(&covector.1).zip(vector).map(|(a, b)| a * b).sum::<f64>();
    let forwards = [(with_h(&h), along), (by_h, [0.0; 4])].map(|(stepper, vector)| {
        let mut integrator = stepper.into_integrator(orbit(vector));
        integrator.steps(steps);
        integrator
    });
    let found_forwards = [0, 1].map(|i| product(&vector(forwards[i].state(), 0)));
    let [end, end_by_h] = forwards;
    let mut adjoint = tangent::Adjoint::new(end);
    adjoint.add_parameter(end_by_h);
    adjoint.add(&covector);
    (0..steps).for_each(|_| adjoint.step_back());
    let (of_q, of_p) = adjoint.covector();
    let found: f64 = of_q.iter().chain(&of_p).zip(along).map(|(a, b)| a * b).sum();
    let values = |x: &[Dual<f64>]| x.iter().map(|x| x.value.to_bits()).collect::<Vec<_>>();
    let (begun, integrator) = (orbit([0.0; 4]), adjoint.integrator());
    let state = integrator.state();
    let returned = (values(state.q()), values(state.p())) == (values(begun.state().q()), values(begun.state().p()));
    (found_forwards, [found, adjoint.by_parameters()[0]], returned)
}

/// An error grows by 10¹⁷ on the way: with plain sums the steps back are those of another orbit.
#[test]
fn gradients_in_fixed_point_are_those_of_the_steps_on_chaotic_orbits() {
    let (forwards, backwards, returned) =
        along_and_back(|star| star.fixed_point(&[2.0; 2], &[2.0; 2]).unwrap(), 10_000);
    assert!(returned);
    for (forwards, backwards) in forwards.iter().zip(backwards) {
        assert!(forwards.abs() > 1e17 && (backwards / forwards - 1.0).abs() < 1e-9, "{forwards} {backwards}");
    }
    let (forwards, backwards, returned) = along_and_back(|star| star, 10_000);
    assert!(!returned && (backwards[0] / forwards[0] - 1.0).abs() > 1e-3, "{forwards:?} {backwards:?}");
}

// ---------------------------------------------------------------------------------------------------------------
// Indicators

potential! { pub struct Saddle; U(x, y) = -x^2/2 + y^2/2 }

/// Of U = −x²/2 + y²/2 one exponent of the exact flow is 1, another −1, and two are 0; a step of Störmer–Verlet has
/// eigenvalues e^±λh with cosh λh = 1 + h²/2.
#[test]
fn exponents_of_a_saddle_are_those_of_its_steps() {
    let h: f64 = 0.1;
    let exact = (1.0 + h * h / 2.0).acosh() / h;
    let start = || {
        let [q, p] = with_unit_vectors::<f64>(&());
        Motion::new(Saddle, UnitMasses, q.map(|x| Dual { value: 0.0, ..x }), p.map(|x| Dual { value: 0.0, ..x }))
            .unwrap()
    };
    let verlet = stepper("stormer-verlet", "1/10", &());
    let mut spectrum = Tangents::orthonormal(vec![verlet.with(start())]).unwrap();
    let mut tangents = Tangents::new(vec![verlet.with(start())]).unwrap();
    for n in 1..=20_000 {
        spectrum.step();
        spectrum.observe(h * f64::from(n));
        tangents.step();
        tangents.observe(h * f64::from(n));
    }
    let found: Vec<_> = spectrum.spectrum(0).into_iter().map(|growth| growth.exponent().unwrap()).collect();
    for (found, expected) in found.iter().zip([exact, 0.0, 0.0, -exact]) {
        assert!((found.value - expected).abs() < 1e-3 && found.error < 2e-3, "{found:?} {expected}");
    }
    // over the whole run the vector turns to the direction that grows first: log(cos) of it is lost
    let growth = tangents.growth(0, 0);
    assert!((growth.exponent().unwrap().value - exact).abs() < 1e-12);
    assert!((growth.megno() / growth.time() - exact).abs() < 1e-3);
    assert_eq!(growth.regularity(), Regularity::Chaotic);
    // it grew by e^2000, and was rescaled
    assert!(vector(tangents.integrators()[0].state(), 0).iter().all(|x| x.abs() < 1e40));
    // the first two vectors stay in planes of their own
    assert!((tangents.sali(0) - 2_f64.sqrt()).abs() < 1e-12 && tangents.gali(4, 0) < 1e-12);
}

/// Orbits of Hénon and Heiles's system at E = 1/8: with y = 0.1, p_y = 0 regular, with y = −0.25, p_y = 0 chaotic.
#[test]
fn regular_and_chaotic_orbits_are_told_apart() {
    let follow = |y: f64, steps: u32| {
        let energy_of_x = 0.125 - (y * y / 2.0 - y * y * y / 3.0);
        let (q, p) = ([0.0, y], [(2.0 * energy_of_x).sqrt(), 0.0]);
        let dual = |x: [f64; 2], of: [[f64; 2]; 2]| with_derivatives(&x, [&of[0], &of[1]]);
        let motion = Motion::new(
            HenonHeiles,
            UnitMasses,
            dual(q, [[0.3, 0.7], [1.0, 0.0]]), // the second is along the torus, as the orbit is symmetric: it does not grow
            dual(p, [[-0.6, 0.2], [0.0, 0.5]]),
        );
        let stepper = stepper("blanes-moan-srkn6b", "1/5", &());
        let mut tangents = Tangents::new(vec![stepper.with(motion.unwrap())]).unwrap();
        for n in 1..=steps {
            tangents.step();
            tangents.observe(0.2 * f64::from(n));
        }
        let growth = tangents.growth(0, 0).clone();
        (growth.regularity(), growth.mean_megno().unwrap(), growth.exponent().unwrap(), tangents.sali(0))
    };
    let (regular, megno, exponent, sali) = follow(0.1, 50_000);
    assert_eq!(regular, Regularity::Regular, "{megno} {exponent:?}");
    assert!((megno - 2.0).abs() < 0.1 && exponent.value < 2e-3 && sali > 1e-3, "{megno} {exponent:?} {sali}");
    let (chaotic, megno, exponent, sali) = follow(-0.25, 50_000);
    assert_eq!(chaotic, Regularity::Chaotic, "{megno} {exponent:?}");
    // over a million units of time it is 0.040 ± 0.005
    assert!((exponent.value - 0.05).abs() < 0.02 && sali < 1e-12, "{megno} {exponent:?} {sali}");
    assert_eq!(follow(-0.25, 500).0, Regularity::Undecided);
}

#[test]
fn no_direction_is_an_error() {
    let zero = [[0.0; 2].map(Dual::<f64>::constant), [0.1, 0.2].map(Dual::constant)];
    let verlet = stepper("stormer-verlet", "1/10", &());
    let refused = Tangents::new(vec![verlet.with(star(zero))]).err().unwrap();
    assert_eq!(refused.to_string(), "the tangent vector 0 is 0 or not finite");
    let parallel = [0, 1].map(|_| verlet.with(star([[Dual::new(0.1, [1.0]); 2]; 2]))).into();
    let refused = Tangents::orthonormal(parallel).err().unwrap();
    assert_eq!(refused.to_string(), "the tangent vector 1 is 0 or not finite");
    let none = Tangents::<
        shadowstep::steps::integrator::WithStepper<'_, shadowstep::tables::TableScheme, Star<Dual<f64>>>,
    >::new(vec![]);
    assert_eq!(none.err().unwrap().to_string(), "there are no tangent vectors");
}
