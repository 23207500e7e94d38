//! The integrations that are measured: generated steps of a generated potential.

use shadowstep::number::{Float, Fused, Lanes, Number, Real, Precision};
use shadowstep::systems::pairs::{Ends, Pairs};
use shadowstep::problems::{CubicSpring, Gravity, HenonHeiles, Kepler, LennardJones};
use shadowstep::steps::step_to_time;
use shadowstep::systems::transformed_time::{TimeTransformation, TransformedKinetic, TransformedPotential};
use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, WisdomHolman};
use shadowstep::{
    DiagonalMasses, Integrator as _, Kinetic, Motion, Potential, Rational, Scheme, Stepper, System, UnitMasses,
    ValidFor, exact,
    systems::kinetic::{General, Quadratic},
};

use crate::initial::Initial;
use crate::problems::exact_text;
use crate::protocol::{Answer, Request};
use crate::schemes::{WithGeneralScheme, WithScheme, with_drift_first, with_scheme};

/// Does what a request asks for. `kepler-120` is Kepler's problem at 120 digits; `fused/SCHEME` computes with fused
/// products, and `fused-compensated/SCHEME` with compensated sums as well; `lanes/SCHEME` with many trajectories at
/// once; `wisdom-holman/SCHEME` with the Kepler orbits of the planets and their interactions as parts;
/// `logarithmic/SCHEME` in logarithmic time, `logarithmic-compensated/SCHEME` with fused products and compensated sums
/// as well.
pub fn answer(request: &Request) -> Answer {
    let name = request.problem.strip_suffix("-120").unwrap_or(&request.problem);
    let initial = Initial::of(name);
    let (numbers, scheme) = request.method.split_once('/').unwrap_or(("f64", &request.method));
    let asked = Asked { request, initial: &initial, scheme };
    match (request.problem.as_str(), numbers) {
        ("argon", "f64") => asked.argon(),
        ("kepler-120", "f64") => asked.at_120_digits(),
        (problem, "f64") => asked.small::<f64>(problem, |x| x, false),
        (problem, "fused") => asked.small(problem, Fused, false),
        (problem, "fused-compensated") => asked.small(problem, Fused, true),
        (problem, "lanes") => asked.ensemble(problem),
        ("outer-solar-system", "wisdom-holman") => asked.planets(),
        ("kepler", "logarithmic") => asked.logarithmic::<f64>(|x| x, false),
        ("kepler", "logarithmic-compensated") => asked.logarithmic(Fused, true),
        (_, other) => panic!("no numbers {other}"),
    }
}

/// A request, and what it is about.
struct Asked<'a> {
    request: &'a Request,
    initial: &'a Initial,
    scheme: &'a str,
}

impl Asked<'_> {
    /// A problem whose coordinates are arrays.
    fn small<N: Real<Context = ()>>(&self, problem: &str, number: fn(f64) -> N, compensated: bool) -> Answer {
        let numbers = |values: &[f64]| -> Vec<N> { values.iter().copied().map(number).collect() };
        let Initial { parameters, masses, .. } = self.initial;
        match problem {
            "kepler" => self.arrays::<2, _, _, _>(Kepler, UnitMasses, number, compensated),
            "henon-heiles" => self.arrays::<2, _, _, _>(HenonHeiles, UnitMasses, number, compensated),
            "outer-solar-system" => {
                let m = numbers(masses).into_iter().step_by(3).collect();
                let pairs = Pairs::<_, 3>::all(6, Gravity { g: number(parameters[0]), m }).expect("six bodies");
                let masses = DiagonalMasses::from_numbers(&numbers(masses)).expect("positive masses");
                self.arrays::<18, _, _, _>(pairs, masses, number, compensated)
            }
            "fput-alpha" => {
                let spring = CubicSpring { alpha: number(parameters[0]) };
                let chain = Pairs::<_, 1>::neighbours(32, spring, Ends::Fixed).expect("a chain");
                self.arrays::<32, _, _, _>(chain, UnitMasses, number, compensated)
            }
            other => panic!("no problem {other}"),
        }
    }

    fn arrays<const D: usize, N, P, K>(
        &self,
        potential: P,
        kinetic: K,
        number: fn(f64) -> N,
        compensated: bool,
    ) -> Answer
    where
        N: Real<Context = ()>,
        P: Potential<N>,
        K: Kinetic<N, Class = Quadratic>,
    {
        let array = |numbers: &[f64]| -> [N; D] { std::array::from_fn(|i| number(numbers[i])) };
        let (q, p) = (array(&self.initial.q), array(&self.initial.p));
        let motion = Motion::new(potential, kinetic, q, p).expect("the dimensions agree");
        if compensated { self.run(motion.compensated()) } else { self.run(motion) }
    }

    /// Trajectories in lanes, all alike; the time is for one of them.
    fn ensemble(&self, problem: &str) -> Answer {
        let Initial { parameters, masses, .. } = self.initial;
        match problem {
            "kepler" => self.lanes::<2, _, _>(Kepler, UnitMasses),
            "henon-heiles" => self.lanes::<2, _, _>(HenonHeiles, UnitMasses),
            "outer-solar-system" => {
                let m = masses.iter().step_by(3).map(|m| Lanes::all(*m)).collect();
                let gravity = Gravity { g: Lanes::all(parameters[0]), m };
                let exact = |mass: &f64| Rational::from_float(*mass).expect("a finite mass");
                let masses: Vec<_> = masses.iter().map(exact).collect();
                let masses = DiagonalMasses::new(&masses, &()).expect("positive masses");
                self.lanes::<18, _, _>(Pairs::<_, 3>::all(6, gravity).expect("six bodies"), masses)
            }
            other => panic!("no ensemble of {other}"),
        }
    }

    fn lanes<const D: usize, P, K>(&self, potential: P, kinetic: K) -> Answer
    where
        P: Potential<Lanes<WIDTH>> + Clone,
        K: Kinetic<Lanes<WIDTH>, Class = Quadratic> + Clone,
    {
        let array = |numbers: &[f64]| -> [Lanes<WIDTH>; D] { std::array::from_fn(|i| Lanes::all(numbers[i])) };
        let motion = Motion::new(potential, kinetic, array(&self.initial.q), array(&self.initial.p));
        let systems = vec![motion.expect("the dimensions agree"); SYSTEMS];
        with_scheme(self.scheme, RunAll { request: self.request, systems })
    }

    /// In Jacobi coordinates; the answer is in inertial ones.
    fn planets(&self) -> Answer {
        let Initial { parameters, masses, q, p } = self.initial;
        let exact = |x: &f64| Rational::from_float(*x).expect("a finite number");
        let bodies = Bodies::new(exact(&parameters[0]), masses.iter().step_by(3).map(exact).collect());
        let system = Planets::new(&bodies.expect("six bodies"), (q, p), &()).expect("a state of six bodies");
        with_scheme(self.scheme, RunPlanets { request: self.request, system })
    }

    /// Kepler's problem in logarithmic time; the answers are at physical times.
    fn logarithmic<N: Real<Context = ()>>(&self, number: fn(f64) -> N, compensated: bool) -> Answer {
        let Initial { q, p, .. } = self.initial;
        let time = TimeTransformation::Logarithmic;
        let energy = (p[0] * p[0] + p[1] * p[1]) / 2.0 - 1.0 / q[0].hypot(q[1]);
        let (potential, kinetic) = (TransformedPotential::new(time, Kepler), TransformedKinetic::new(time, UnitMasses));
        let (q, p) = ([q[0], q[1], 0.0].map(number), [p[0], p[1], -energy].map(number));
        let motion = Motion::new(potential, kinetic, q, p).expect("the dimensions agree");
        let request = self.request;
        if compensated {
            with_drift_first(self.scheme, RunLogarithmic { request, number, system: motion.compensated() })
        } else {
            with_drift_first(self.scheme, RunLogarithmic { request, number, system: motion })
        }
    }

    fn argon(&self) -> Answer {
        let Initial { parameters, masses, q, p } = self.initial;
        let pair = LennardJones { epsilon: parameters[0], sigma: parameters[1] };
        let pairs = Pairs::<_, 3>::all(q.len() / 3, pair).expect("atoms");
        let masses = DiagonalMasses::from_numbers(masses).expect("positive masses");
        self.run(Motion::new(pairs, masses, q.clone(), p.clone()).expect("the dimensions agree"))
    }

    fn at_120_digits(&self) -> Answer {
        let digits = Precision::digits(120).expect("120 digits are allowed");
        let number = |value: &f64| Float::from_rational(&exact(&exact_text(*value)).expect("a number"), &digits);
        let array = |numbers: &[f64]| [number(&numbers[0]), number(&numbers[1])];
        let (q, p) = (array(&self.initial.q), array(&self.initial.p));
        self.run(Motion::new(Kepler, UnitMasses, q, p).expect("the dimensions agree"))
    }

    fn run<M: System<Class = Quadratic, Number: Real>>(&self, system: M) -> Answer {
        with_scheme(self.scheme, Run { request: self.request, system })
    }
}

/// Lanes of a system, and systems that take turns.
const WIDTH: usize = 16;
const SYSTEMS: usize = 4;

struct RunAll<'a, M> {
    request: &'a Request,
    systems: Vec<M>,
}

impl<M: System<Class = Quadratic, Number = Lanes<WIDTH>>> WithScheme for RunAll<'_, M> {
    type Result = Answer;

    fn with<S: Scheme + ValidFor<Quadratic>>(self, scheme: S) -> Answer {
        let RunAll { request, mut systems } = self;
        let h = step_size(request.until, request.steps());
        let stepper = Stepper::with_context(scheme, h, &()).expect("a step size");
        let mut answer = Answer::default();
        for _ in 0..request.samples {
            answer.time(|| stepper.steps(&mut systems, request.steps() / request.samples));
            answer.state(systems[0].state().q().iter().chain(systems[0].state().p()).map(|x| x.0[0]));
        }
        answer.divide_time((WIDTH * SYSTEMS) as u32);
        answer
    }
}

struct Run<'a, M> {
    request: &'a Request,
    system: M,
}

impl<M: System<Class = Quadratic, Number: Real>> WithScheme for Run<'_, M> {
    type Result = Answer;

    fn with<S: Scheme + ValidFor<Quadratic>>(self, scheme: S) -> Answer {
        let Run { request, mut system } = self;
        let h = step_size(request.until, request.steps());
        let stepper = Stepper::with_context(scheme, h, &system.state().context()).expect("a step size");
        let mut answer = Answer::default();
        for _ in 0..request.samples {
            answer.time(|| stepper.steps(std::slice::from_mut(&mut system), request.steps() / request.samples));
            answer.state(system.state().q().iter().chain(system.state().p()).map(Real::to_f64));
        }
        answer
    }
}

type Planets = WisdomHolman<f64, Jacobi<f64, 3>, 3>;

struct RunPlanets<'a> {
    request: &'a Request,
    system: Planets,
}

impl WithScheme for RunPlanets<'_> {
    type Result = Answer;

    fn with<S: Scheme + ValidFor<Quadratic>>(self, scheme: S) -> Answer {
        let RunPlanets { request, mut system } = self;
        let stepper = Stepper::new(scheme, step_size(request.until, request.steps())).expect("a step size");
        let mut answer = Answer::default();
        for _ in 0..request.samples {
            answer.time(|| stepper.merged_steps(std::slice::from_mut(&mut system), request.steps() / request.samples));
            let (q, p) = system.inertial();
            answer.state(q.into_iter().chain(p));
        }
        answer
    }
}

/// Steps of s whose mean is a step of the physical time, as the semi-major axis is 1; a sample is one step of the exact
/// remainder away from them.
struct RunLogarithmic<'a, N, M> {
    request: &'a Request,
    number: fn(f64) -> N,
    system: M,
}

impl<N: Real<Context = ()>, M: System<Number = N, Class = General> + Clone> WithGeneralScheme
    for RunLogarithmic<'_, N, M>
{
    type Result = Answer;

    fn with<S: Scheme + ValidFor<General> + Clone>(self, scheme: S) -> Answer {
        let RunLogarithmic { request, number, mut system } = self;
        let stepper =
            Stepper::with_context(scheme, step_size(request.until, request.steps()), &()).expect("a step size");
        let mut answer = Answer::default();
        for sample in 1..=request.samples {
            let until = number(request.until * sample as f64 / request.samples as f64);
            let at_sample = answer.time(|| {
                while system.state().q()[2] < until {
                    stepper.step(&mut system);
                }
                stepper.step_back(&mut system);
                let mut at_sample = stepper.with(system.clone());
                step_to_time(&mut at_sample, &until);
                at_sample
            });
            let state = at_sample.state();
            answer.state(state.q()[..2].iter().chain(&state.p()[..2]).map(Real::to_f64));
        }
        answer
    }
}

/// The exact quotient, which is rounded with the weights only.
pub fn step_size(until: f64, steps: u64) -> Rational {
    Rational::from_float(until).expect("a finite time") / Rational::from_integer(steps.into())
}
