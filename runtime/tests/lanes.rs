//! Trajectories in lanes have the bits that they have alone, in all instructions of this processor.

use std::array::from_fn;
use std::slice::from_mut;

use shadowstep::number::Lanes;
use shadowstep::number::instructions::Instructions;
use shadowstep::problems::{HenonHeiles, Kepler, PROBLEMS, Problem};
use shadowstep::shadow::{BuildEstimator, Estimate, Estimator, FixedBilinear, FixedCentral};
use shadowstep::tables::{self, TableScheme};
use shadowstep::{Motion, Number, Potential, Stepper, System, UnitMasses, potential, splitting_scheme};

#[splitting_scheme("yoshida4.toml")]
pub struct Yoshida4;

#[splitting_scheme("blanes-moan-srkn6b.toml")]
pub struct BlanesMoan;

/// The coordinates of a lane: the first one's, a little changed.
fn disturbed(x: f64, index: usize, lane: usize) -> f64 {
    x * (1.0 + 1e-3 * lane as f64) + 1e-4 * (lane * (index + 1)) as f64
}

fn in_lanes<const W: usize>(x: &[f64]) -> Vec<Lanes<W>> {
    x.iter().enumerate().map(|(i, x)| Lanes(from_fn(|lane| disturbed(*x, i, lane)))).collect()
}

fn in_lane(x: &[f64], lane: usize) -> Vec<f64> {
    x.iter().enumerate().map(|(i, x)| disturbed(*x, i, lane)).collect()
}

/// All numbers of a state and of its increments, and its energy.
fn numbers<M: System<Number: Clone>>(system: &mut M) -> Vec<M::Number> {
    let energy = system.energy();
    let (increments, remainders) = (system.state().increments(), system.state().remainders());
    let parts = [system.state().q(), system.state().p(), increments.q, increments.p, &remainders.q, &remainders.p];
    parts.into_iter().flatten().cloned().chain([increments.beta.clone(), energy]).collect()
}

fn bits<const W: usize>(all: &[Lanes<W>], lane: usize) -> Vec<u64> {
    all.iter().map(|x| x.0[lane].to_bits()).collect()
}

/// Runs of a system in lanes and of the same system alone, of which `motion` makes the states, to be compared.
fn compare<const W: usize, A, B>(
    what: &str,
    in_lanes: impl Fn() -> A,
    alone: impl Fn(usize) -> B,
    run: impl Fn(&mut A),
    run_alone: impl Fn(&mut B),
) where
    A: System<Number = Lanes<W>>,
    B: System<Number = f64>,
{
    for instructions in Instructions::available() {
        let mut system = in_lanes();
        instructions.only(|| run(&mut system));
        let found = numbers(&mut system);
        for lane in 0..W {
            let mut one = alone(lane);
            run_alone(&mut one);
            let expected: Vec<u64> = numbers(&mut one).iter().map(|x| x.to_bits()).collect();
            assert_eq!(bits(&found, lane), expected, "{what}, {instructions:?}, lane {lane} of {W}");
        }
    }
}

/// A shipped scheme on a shipped problem, all that there is chosen at run time.
fn compare_shipped<const W: usize>(problem: Problem, scheme: &str) {
    let setup = problem.setup(&[], 20).unwrap();
    let table: TableScheme = tables::shipped(scheme).unwrap();
    let h = problem.description().step;
    let start = setup.motion::<f64>(&()).unwrap();
    let (stepper, one) = (Stepper::new(table.clone(), h).unwrap(), Stepper::new(table, h).unwrap());
    compare::<W, _, _>(
        &format!("{scheme}, {}", problem.name()),
        || {
            let mut system = setup.motion::<Lanes<W>>(&()).unwrap();
            system.state_mut().set(&in_lanes(start.q()), &in_lanes(start.p()));
            system
        },
        |lane| {
            let mut system = setup.motion::<f64>(&()).unwrap();
            system.state_mut().set(&in_lane(start.q(), lane), &in_lane(start.p(), lane));
            system
        },
        |system| {
            stepper.steps(from_mut(system), 3);
            stepper.step_each_augmented(from_mut(system));
            stepper.step_back(system);
        },
        |system| {
            (0..3).for_each(|_| one.step(system));
            one.step_augmented(system);
            one.step_back(system);
        },
    );
}

/// Problems without elementary functions.
fn is_algebraic(problem: &Problem) -> bool {
    !["pendulum", "scattering", "toda"].contains(&problem.name())
}

#[test]
fn every_shipped_scheme_has_the_bits_of_f64() {
    for scheme in tables::shipped_names() {
        compare_shipped::<4>(Problem::Kepler, scheme);
    }
}

#[test]
fn every_shipped_problem_has_the_bits_of_f64() {
    for problem in PROBLEMS.iter().copied().filter(is_algebraic) {
        compare_shipped::<4>(problem, "yoshida4");
        compare_shipped::<8>(problem, "stormer-verlet");
        compare_shipped::<16>(problem, "stormer-verlet");
    }
}

/// The states of W lanes after five steps of a problem.
fn after_five_steps<N: Number<Context = ()> + 'static>(problem: Problem, start: impl Fn(&[f64]) -> Vec<N>) -> Vec<N> {
    let setup = problem.setup(&[], 20).unwrap();
    let stepper = Stepper::new(tables::shipped("yoshida4").unwrap(), problem.description().step).unwrap();
    let values = setup.motion::<f64>(&()).unwrap();
    let mut system = setup.motion::<N>(&()).unwrap();
    system.state_mut().set(&start(values.q()), &start(values.p()));
    stepper.steps(from_mut(&mut system), 5);
    system.q().iter().chain(system.p()).cloned().collect()
}

/// exp, log, sin and cos are functions of lanes, not the platform's: the bits do not depend on the lanes and the
/// instructions, and are close to the bits in f64.
#[test]
fn problems_with_elementary_functions() {
    for problem in PROBLEMS.iter().copied().filter(|problem| !is_algebraic(problem)) {
        let expected = after_five_steps(problem, in_lanes::<16>);
        for instructions in Instructions::available() {
            let four = instructions.only(|| after_five_steps(problem, in_lanes::<4>));
            let eight = instructions.only(|| after_five_steps(problem, in_lanes::<8>));
            assert!((0..4).all(|lane| bits(&four, lane) == bits(&expected, lane)), "{}", problem.name());
            assert!((0..8).all(|lane| bits(&eight, lane) == bits(&expected, lane)), "{}", problem.name());
        }
        for lane in 0..16 {
            let alone = after_five_steps(problem, |x| in_lane(x, lane));
            // a last place or two of each of some hundred operations
            assert!(
                expected.iter().zip(&alone).all(|(x, alone)| (x.0[lane] - alone).abs() < 1e-13),
                "{}",
                problem.name()
            );
        }
    }
}

const START: [[f64; 2]; 2] = [[0.3, 0.2], [0.1, 1.2]];

fn generated<const W: usize, P: Potential<Lanes<W>> + Potential<f64> + Copy>(potential: P, compensated: bool) {
    let of = |part: usize| START[part];
    macro_rules! compare_with {
        ($scheme:expr) => {
            let (stepper, one) = (Stepper::new($scheme, "1/20").unwrap(), Stepper::new($scheme, "1/20").unwrap());
            compare::<W, _, _>(
                std::any::type_name::<P>(),
                || {
                    let [q, p] = [0, 1].map(|part| <[_; 2]>::try_from(in_lanes::<W>(&of(part))).unwrap());
                    Motion::new(potential, UnitMasses, q, p).unwrap().compensated_if(compensated)
                },
                |lane| {
                    let [q, p] = [0, 1].map(|part| <[_; 2]>::try_from(in_lane(&of(part), lane)).unwrap());
                    Motion::new(potential, UnitMasses, q, p).unwrap().compensated_if(compensated)
                },
                |system| {
                    (0..5).for_each(|_| stepper.step(system));
                    stepper.steps(std::slice::from_mut(system), 5);
                    stepper.step_augmented(system);
                },
                |system| {
                    (0..10).for_each(|_| one.step(system));
                    one.step_augmented(system);
                },
            );
        };
    }
    compare_with!(Yoshida4);
    compare_with!(BlanesMoan);
}

#[test]
fn generated_steps_have_the_bits_of_f64() {
    for compensated in [false, true] {
        generated::<4, _>(Kepler, compensated);
        generated::<8, _>(Kepler, compensated);
        generated::<16, _>(Kepler, compensated);
        generated::<8, _>(HenonHeiles, compensated);
    }
}

/// Every number of the estimates of a lane.
fn estimates<N>(settings: &impl BuildEstimator<N>, q: [N; 2], p: [N; 2]) -> Vec<[N; 3]>
where
    Kepler: Potential<N>,
    N: Number<Context = ()>,
{
    let stepper = Stepper::new(Yoshida4, "1/20").unwrap();
    let mut estimator = settings.build(stepper.step_size(), 2, &()).unwrap();
    let mut motion = Motion::new(Kepler, UnitMasses, q, p).unwrap();
    let mut found = Vec::new();
    for _ in 0..40 {
        stepper.step_augmented(&mut motion);
        if let Some(Estimate { value, last_term, error, .. }) =
            estimator.push(motion.q(), motion.p(), motion.increments())
        {
            found.push([value, last_term.unwrap_or(value), error.unwrap_or(value)].map(N::clone));
        }
    }
    assert!(found.len() > 10);
    found
}

fn compare_estimates<F: BuildEstimator<f64> + BuildEstimator<Lanes<8>>>(settings: &F) {
    let [q, p] = [0, 1].map(|part| <[_; 2]>::try_from(in_lanes::<8>(&START[part])).unwrap());
    let found = estimates(settings, q, p);
    for lane in 0..8 {
        let [q, p] = [0, 1].map(|part| <[_; 2]>::try_from(in_lane(&START[part], lane)).unwrap());
        let expected = estimates(settings, q, p);
        assert!(found.iter().map(|x| x.map(|x| x.0[lane].to_bits())).eq(expected.iter().map(|x| x.map(f64::to_bits))));
    }
}

#[test]
fn estimators_of_a_fixed_order_have_the_bits_of_f64() {
    for k in [1, 2, 5, 8] {
        compare_estimates(&FixedBilinear::new(k));
        compare_estimates(&FixedBilinear::with_error(k));
        compare_estimates(&FixedCentral::new(k));
        compare_estimates(&FixedCentral::with_error(k));
    }
}

potential! { pub struct Well { depth } U(x) = -depth / (1 + x^2) }

/// Parameters are numbers in lanes as coordinates are.
#[test]
fn a_parameter_may_differ_from_lane_to_lane() {
    let depth: [f64; 4] = [1.0, 2.0, 3.0, 5.0];
    let stepper = Stepper::new(Yoshida4, "1/10").unwrap();
    let alone = depth.map(|depth| {
        let one = Stepper::new(Yoshida4, "1/10").unwrap();
        let mut motion = Motion::new(Well { depth }, UnitMasses, [0.5], [0.1]).unwrap();
        (0..20).for_each(|_| one.step(&mut motion));
        motion.q()[0]
    });
    let mut motion =
        Motion::new(Well { depth: Lanes(depth) }, UnitMasses, [Lanes::all(0.5)], [Lanes::all(0.1)]).unwrap();
    stepper.steps(std::slice::from_mut(&mut motion), 20);
    assert_eq!(motion.q()[0].0.map(f64::to_bits), alone.map(f64::to_bits));
}

/// One lane at a collision, whose force is not finite, beside others.
#[test]
fn a_lane_that_is_not_finite_leaves_the_others() {
    let stepper = Stepper::new(Yoshida4, "1/10").unwrap();
    let mut with = Motion::new(
        Kepler,
        UnitMasses,
        [Lanes([0.4, 0.0, 1e200, 0.5]), Lanes::all(0.0)],
        [Lanes::all(0.0), Lanes::all(1.5)],
    )
    .unwrap();
    let without = [0.4, 0.5].map(|x| {
        let one = Stepper::new(Yoshida4, "1/10").unwrap();
        let mut motion = Motion::new(Kepler, UnitMasses, [x, 0.0], [0.0, 1.5]).unwrap();
        (0..10).for_each(|_| one.step(&mut motion));
        motion.energy()
    });
    stepper.steps(std::slice::from_mut(&mut with), 10);
    let energy = with.energy();
    assert!(!with.is_finite() && !energy.is_finite());
    assert_eq!([energy.0[0], energy.0[3]], without);
    assert!(energy.0[1].is_nan());
    assert!(energy.0[2].is_nan(), "r² overflows there");
}
