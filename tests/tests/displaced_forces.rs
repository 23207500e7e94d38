//! Protects gradient kicks by displaced forces: the formula, the rate of β, steps there and back, what is not
//! symplectic, and refusals.

use rug::Float;
use shadowstep::number::{Limbs, Number, Real};
use shadowstep::problems::{HenonHeiles, Pendulum};
use shadowstep::shadow::Bilinear;
use shadowstep::shadow::run::energy_drift;
use shadowstep::steps::DisplacementError;
use shadowstep::systems::potential::from_fn;
use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, PlanetaryCoordinates, WisdomHolman};
use shadowstep::tables::{self, Source, TableScheme};
use shadowstep::{
    Carried, DiagonalMasses, Motion, Stepper, System, UnitMasses, ValidFor, systems::linear_part::LinearPart,
};
use shadowstep_tests::steps::Steps;
use shadowstep_tests::{
    Bits, coordinates, log10_distance, log10_largest_distance, numbers, precision, rational, same_bits, stepper,
};

const DIGITS: u32 = 60;

fn planets<N: Number>(context: &N::Context) -> WisdomHolman<N, Jacobi<N, 2>, 2> {
    let bodies = Bodies::new(rational("4*pi^2"), ["1", "1/1000", "1/3000"].map(rational).to_vec()).expect("bodies");
    let q = numbers(&["0", "0", "4.94", "0", "-10.03", "0"], context);
    let p = numbers(&["0", "0", "0", "0.0029", "0", "-0.0006"], context);
    WisdomHolman::new(&bodies, (&q, &p), context).expect("a state of three bodies")
}

fn henon_heiles<N: Number>(context: &N::Context) -> Motion<N, [N; 2], HenonHeiles, DiagonalMasses<N>> {
    let masses = DiagonalMasses::new(&["3", "1/2"].map(rational), context).expect("they are positive");
    let [q, p] = [["0.1", "-0.3"], ["0.2", "0.15"]].map(|texts| numbers(&texts, context));
    let pair = |v: Vec<N>| <[N; 2]>::try_from(v).expect("two numbers");
    Motion::new(HenonHeiles, masses, pair(q), pair(p)).expect("the dimensions agree")
}

/// Hénon–Heiles with a part of its oscillators in the drifts.
fn oscillators(context: &<Float as Number>::Context) -> LinearPart<Float, HenonHeiles> {
    let stiffness = [["2", "1/5"], ["1/5", "1/3"]].map(|row| row.map(rational).to_vec());
    let (q, p) = (numbers(&["0.1", "0.2"], context), numbers(&["0.3", "-0.1"], context));
    LinearPart::new(HenonHeiles, &["3", "1/2"].map(rational), &stiffness, &q, &p).expect("the dimensions agree")
}

/// The formula for Chin's 4A with h = 1/3, whose kick in the middle has a = 2/3 and c = 1/72: p −= h a B_q(q′), q′ =
/// q − δ M⁻¹B_q(q), δ = 2h²c/a; and β += h a (qᵀB_q − 2B) at q′.
fn is_the_formula(mut system: impl System<Number = Float>, inverse_masses: &[Float]) {
    let number = |text: &str| Float::from_rational(&rational(text), &precision(DIGITS));
    let (kick, gradient_kick, delta) = (number("2/9"), number("2*(1/3)^3/72"), number("2*(1/3)^2*(1/72)/(2/3)"));
    let (q, p) = (system.state().q().to_vec(), system.state().p().to_vec());
    let zeros = vec![number("0"); q.len()];
    let mut kick_at = |q: &[Float]| {
        system.state_mut().set(q, &zeros);
        system.clear_increments();
        system.kick(&kick, Carried::Increments);
        (system.state().p().to_vec(), system.state().increments().beta.clone())
    };
    let v = kick_at(&q).0.into_iter().zip(inverse_masses).map(|(p, inverse)| -p / &kick * inverse);
    let displaced: Vec<_> = q.iter().zip(v).map(|(q, v)| q.clone() - v * &delta).collect();
    let (to_p, to_beta) = kick_at(&displaced);
    let expected: Vec<_> = p.iter().zip(to_p).map(|(p, to_p)| p.clone() + to_p).collect();

    for kick_first in [true, false] {
        system.state_mut().set(&q, &p);
        system.clear_increments();
        if kick_first {
            system.kick(&kick, Carried::Increments);
        }
        system.gradient_kick(&gradient_kick, Carried::Increments);
        if !kick_first {
            system.kick(&kick, Carried::Increments);
        }
        let off = log10_largest_distance(system.state().p(), &expected);
        assert!(off < 4.0 - f64::from(DIGITS), "p: 10^{off}");
        let off = log10_distance(system.state().increments().beta, &to_beta);
        assert!(off < 4.0 - f64::from(DIGITS), "β: 10^{off}");
    }
}

#[test]
fn a_kick_with_a_gradient_kick_is_a_kick_by_a_displaced_force() {
    let context = precision(DIGITS);
    let displacements = stepper::<Float>("chin-4a", "1/3", &context).displacements().expect("it has them");
    let inverse = numbers::<Float>(&["1/3", "2"], &context);
    is_the_formula(henon_heiles(&context).displaced(displacements.clone()), &inverse);
    is_the_formula(oscillators(&context).displaced(displacements.clone()), &inverse);
    let planets = planets::<Float>(&context);
    let orbits = planets.coordinates().orbits();
    let masses = std::iter::once(&orbits.total_mass).chain(orbits.planets.iter().map(|orbit| &orbit.mass));
    let inverse: Vec<_> = masses.flat_map(|mass| vec![mass.clone().recip(); 2]).collect();
    is_the_formula(planets.displaced(displacements), &inverse);
}

/// A step differs from one with second derivatives by h⁵.
#[test]
fn displaced_forces_differ_at_order_five() {
    let context = precision(DIGITS);
    let difference = |k: u32| {
        let stepper = stepper::<Float>("omelyan-4mn5f2gv", &format!("1/{}", 1_u64 << k), &context);
        let mut exact = henon_heiles(&context);
        let mut displaced = exact.clone().displaced(stepper.displacements().expect("it has them"));
        stepper.step(&mut exact);
        stepper.step(&mut displaced);
        log10_largest_distance(&[exact.q(), exact.p()].concat(), &[displaced.q(), displaced.p()].concat())
    };
    let order = (difference(10) - difference(11)) / std::f64::consts::LOG10_2;
    assert!((order - 5.0).abs() < 0.01, "{order}");
}

/// One by one, and many in a loop.
fn steps_are_steps<M: System<Number: Bits>>(
    system: impl Fn(&Stepper<TableScheme, M::Number>) -> M,
    context: &<M::Number as Number>::Context,
) where
    TableScheme: ValidFor<M::Class>,
{
    for name in ["chin-4c", "omelyan-4mn5f2gv", "omelyan-6mn5f5gp"] {
        let stepper = stepper::<M::Number>(name, "1/3", context);
        Steps::of(stepper.scheme().clone(), stepper.h(), context).check(name, || system(&stepper), 10, 3.0);
        let (mut one_by_one, mut together) = (system(&stepper), [system(&stepper)]);
        (0..10).for_each(|_| stepper.step(&mut one_by_one));
        stepper.steps(&mut together, 10);
        assert!(same_bits(&coordinates(&one_by_one), &coordinates(&together[0])), "{name}");
    }
}

#[test]
fn steps_are_steps_in_both_kinds_of_numbers() {
    fn of<N: Bits>(context: &N::Context) {
        steps_are_steps(
            |s: &Stepper<_, N>| henon_heiles(context).displaced(s.displacements().expect("it has them")),
            context,
        );
        steps_are_steps(
            |s: &Stepper<_, N>| planets(context).displaced(s.displacements().expect("it has them")),
            context,
        );
    }
    of::<f64>(&());
    of::<Float>(&precision(DIGITS));
}

/// log₁₀ of the largest entry of JᵀΩJ − Ω, J the derivative of a step by central differences.
fn symplectic_defect<M>(stepper: &Stepper<TableScheme, Float>, system: &M) -> f64
where
    M: System<Number = Float> + Clone,
    TableScheme: ValidFor<M::Class>,
{
    let dimension = system.state().q().len();
    let start = [system.state().q(), system.state().p()].concat();
    let shift: Float = Float::with_val(start[0].prec(), 1) >> 70;
    let columns: Vec<Vec<Float>> = (0..2 * dimension)
        .map(|column| {
            let [ahead, behind] = [1, -1].map(|sign| {
                let (mut moved, mut system) = (start.clone(), system.clone());
                moved[column] += shift.clone() * sign;
                system.state_mut().set(&moved[..dimension], &moved[dimension..]);
                stepper.step(&mut system);
                [system.state().q(), system.state().p()].concat()
            });
            ahead.into_iter().zip(behind).map(|(a, b)| (a - b) / &shift / 2).collect()
        })
        .collect();
    let mut largest = f64::NEG_INFINITY;
    for (i, a) in columns.iter().enumerate() {
        for (j, b) in columns.iter().enumerate().skip(i + 1) {
            let mut product = Float::with_val(shift.prec(), -i32::from(j == i + dimension));
            for axis in 0..dimension {
                product += a[axis].clone() * &b[axis + dimension] - a[axis + dimension].clone() * &b[axis];
            }
            largest = largest.max(product.log10_abs());
        }
    }
    largest
}

/// A force that depends on q alone is a gradient with one degree of freedom; with more, the displaced one has a curl.
#[test]
fn displaced_forces_are_symplectic_with_one_degree_of_freedom_only() {
    let context = precision(DIGITS);
    let stepper = stepper::<Float>("chin-4a", "1/4", &context);
    let displacements = stepper.displacements().expect("it has them");
    let [q, p] = ["0.3", "1.5"].map(|text| numbers::<Float>(&[text], &context));
    let pendulum = Motion::new(Pendulum, UnitMasses, q, p).expect("one dimension");
    let exact = symplectic_defect(&stepper, &henon_heiles(&context));
    let displaced = symplectic_defect(&stepper, &henon_heiles(&context).displaced(displacements.clone()));
    let one = symplectic_defect(&stepper, &pendulum.displaced(displacements));
    println!("second derivatives 10^{exact:.1}, displaced 10^{displaced:.1}, of a pendulum 10^{one:.1}");
    // differences of 2^−70 have an error of 10^−42, and a round-off of 10^−39
    assert!(exact < -36.0 && one < -36.0 && displaced > -9.0, "10^{exact}, 10^{displaced}, 10^{one}");
}

/// β belongs to a potential whose gradient differs from the force by δ², which limits the modified energy: to ε³h⁴ for
/// planets.
#[test]
fn the_modified_energy_is_known_to_the_square_of_the_displacement() {
    let drift = |h: &str, steps: u64, displaced: bool| {
        let stepper: Stepper<_, Limbs<4>> = stepper("chin-4a", h, &());
        let motion = henon_heiles::<Limbs<4>>(&());
        let motion = if displaced { motion.displaced(stepper.displacements().expect("it has them")) } else { motion };
        energy_drift(stepper.with(motion), steps, &Bilinear::new(12)).expect("it is finite").drift.to_f64()
    };
    let [coarse, fine] = [("1/4", 80), ("1/8", 160)].map(|(h, steps)| drift(h, steps, true));
    println!("displaced: {coarse:e}, {fine:e}; second derivatives: {:e}", drift("1/8", 160, false));
    assert!((coarse / fine).log2() > 3.5 && fine < 1e-7, "{coarse:e}, {fine:e}");
    assert!(drift("1/8", 160, false) < 1e-3 * fine);
}

/// A potential without second derivatives suffices.
#[test]
fn a_force_is_enough() {
    let spring = from_fn(1, |q, gradient| {
        gradient[0] = q[0].sin();
        -q[0].cos()
    });
    let stepper: Stepper<_, f64> = stepper("chin-4a", "1/20", &());
    let motion = Motion::new(spring, UnitMasses, [0.0], [1.5]).expect("one dimension");
    assert!(!motion.has_gradient_kicks());
    let mut motion = motion.displaced(stepper.displacements().expect("it has them"));
    assert!(motion.has_gradient_kicks());
    let start = motion.energy();
    (0..1000).for_each(|_| stepper.step(&mut motion));
    assert!((motion.energy() - start).abs() < 1e-7);
    // two kicks a step after the first, and a force at displaced positions
    assert_eq!((motion.evaluations(), motion.hessian_products()), (3001, 0));
}

fn table(stages: &str, order: u32) -> Stepper<TableScheme, f64> {
    let text = format!("name = \"mine\"\norder = {order}\nkinetic = \"quadratic\"\n[stages]\n{stages}\n");
    let source = Source { path: "mine.toml".to_owned(), text };
    let scheme = tables::read(&source, &|_, _| None, None).unwrap_or_else(|faults| panic!("{faults}"));
    Stepper::new(scheme, "1/20").expect("it is not 0")
}

#[test]
fn what_cannot_be_displaced_is_refused() {
    let alone = "kick = [\"1/2\", 0, \"1/2\"]\ngradient_kick = [0, \"1/24\", 0]\ndrift = [\"1/2\", \"1/2\", 0]";
    let unlike = "kick = [\"1/3\", \"2/3\"]\ngradient_kick = [\"1/72\", \"1/72\"]\ndrift = [\"1/2\", \"1/2\"]";
    let scheme = || "mine".to_owned();
    assert_eq!(table(alone, 2).displacements().unwrap_err(), DisplacementError::NoKick { scheme: scheme() });
    assert_eq!(table(unlike, 1).displacements().unwrap_err(), DisplacementError::Ambiguous { scheme: scheme() });
    let none: Stepper<_, f64> = stepper("yoshida4", "1/20", &());
    let error = none.displacements().unwrap_err();
    assert_eq!(error.to_string(), "yoshida4 has no gradient kicks that displaced forces could replace");
}
