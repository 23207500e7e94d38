//! The integrations that are measured: generated steps of a generated potential.

use shadowstep::number::{Float, Number, Ordered, Precision};
use shadowstep::pairs::{Ends, Pairs};
use shadowstep::problems::{CubicSpring, Gravity, HenonHeiles, Kepler, LennardJones};
use shadowstep::{
    DiagonalMasses, Kinetic, Motion, Potential, Rational, Scheme, Stepper, UnitMasses, exact, kinetic::Quadratic,
};

use crate::initial::Initial;
use crate::problems::exact_text;
use crate::protocol::{Answer, Request};
use crate::schemes::{WithScheme, with_scheme};

/// Does what a request asks for. `kepler-120` is Kepler's problem at 120 digits.
pub fn answer(request: &Request) -> Answer {
    let name = request.problem.strip_suffix("-120").unwrap_or(&request.problem);
    let initial = Initial::of(name);
    let masses = || DiagonalMasses::from_numbers(&initial.masses).expect("positive masses");
    match request.problem.as_str() {
        "kepler" => small::<2, _, _>(request, &initial, Kepler, UnitMasses),
        "henon-heiles" => small::<2, _, _>(request, &initial, HenonHeiles, UnitMasses),
        "outer-solar-system" => {
            let m = initial.masses.iter().step_by(3).copied().collect();
            let pairs = Pairs::<_, 3>::all(6, Gravity { g: initial.parameters[0], m }).expect("six bodies");
            small::<18, _, _>(request, &initial, pairs, masses())
        }
        "fput-alpha" => {
            let spring = CubicSpring { alpha: initial.parameters[0] };
            let chain = Pairs::<_, 1>::neighbours(32, spring, Ends::Fixed).expect("a chain");
            small::<32, _, _>(request, &initial, chain, UnitMasses)
        }
        "argon" => {
            let pair = LennardJones { epsilon: initial.parameters[0], sigma: initial.parameters[1] };
            let pairs = Pairs::<_, 3>::all(initial.q.len() / 3, pair).expect("atoms");
            let motion = Motion::new(pairs, masses(), initial.q.clone(), initial.p.clone());
            run(request, motion.expect("the dimensions agree"))
        }
        "kepler-120" => at_120_digits(request, &initial),
        other => panic!("no problem {other}"),
    }
}

fn small<const D: usize, P, K>(request: &Request, initial: &Initial, potential: P, kinetic: K) -> Answer
where
    P: Potential<f64>,
    K: Kinetic<f64, Class = Quadratic>,
{
    let array = |numbers: &Vec<f64>| <[f64; D]>::try_from(numbers.as_slice()).expect("the dimension");
    run(request, Motion::new(potential, kinetic, array(&initial.q), array(&initial.p)).expect("the dimensions agree"))
}

fn at_120_digits(request: &Request, initial: &Initial) -> Answer {
    let digits = Precision::digits(120).expect("120 digits are allowed");
    let number = |value: &f64| Float::from_rational(&exact(&exact_text(*value)).expect("a number"), &digits);
    let array = |numbers: &[f64]| [number(&numbers[0]), number(&numbers[1])];
    run(request, Motion::new(Kepler, UnitMasses, array(&initial.q), array(&initial.p)).expect("the dimensions agree"))
}

struct Run<'a, N, V, P, K> {
    request: &'a Request,
    motion: Motion<N, V, P, K>,
}

fn run<N, V, P, K>(request: &Request, motion: Motion<N, V, P, K>) -> Answer
where
    N: Ordered,
    V: AsRef<[N]> + AsMut<[N]> + Clone,
    P: Potential<N>,
    K: Kinetic<N, Class = Quadratic>,
{
    with_scheme(&request.method, Run { request, motion })
}

impl<N, V, P, K> WithScheme for Run<'_, N, V, P, K>
where
    N: Ordered,
    V: AsRef<[N]> + AsMut<[N]> + Clone,
    P: Potential<N>,
    K: Kinetic<N, Class = Quadratic>,
{
    type Result = Answer;

    fn with<S: Scheme>(self, scheme: S) -> Answer {
        let Run { request, mut motion } = self;
        let h = step_size(request.until, request.steps());
        let stepper = Stepper::with_context(scheme, h, &motion.context()).expect("a step size");
        let mut answer = Answer::default();
        for _ in 0..request.samples {
            answer.time(|| (0..request.steps() / request.samples).for_each(|_| stepper.step(&mut motion)));
            answer.state(motion.q().iter().chain(motion.p()).map(Ordered::to_f64));
        }
        answer
    }
}

/// The exact quotient, which is rounded with the weights only.
pub fn step_size(until: f64, steps: u64) -> Rational {
    Rational::from_float(until).expect("a finite time") / Rational::from_integer(steps.into())
}
