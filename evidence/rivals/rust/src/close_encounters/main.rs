//! Shadowstep in logarithmic time on close encounters: the error of the end state against CPU time.
//!
//! `close_encounters` prints a line `PROBLEM SCHEME STEP FORCES SECONDS ERROR` for each run;
//! `close_encounters reference PROBLEM` the positions at the end, from 77 digits.

use std::time::Duration;

use cpu_time::ThreadTime;
use num_traits::ToPrimitive as _;
use shadowstep::number::{Limbs, Number, Real};
use shadowstep::problems::{Kepler, problem};
use shadowstep::steps::step_to_time;
use shadowstep::systems::transformed_time::{TimeTransformation, TransformedKinetic, TransformedPotential};
use shadowstep::{
    Coordinates, DiagonalMasses, Kinetic, Motion, Potential, Rational, Scheme, Stepper, System, ValidFor, exact,
    systems::kinetic::General, systems::pairs::Pairs, potential,
};

potential! {
    /// Newton's gravity, G = 1.
    pub struct Gravity;
    pair U(r2; m_i, m_j) = -m_i * m_j / sqrt(r2)
}

macro_rules! schemes {
    ($($Name:ident: $table:literal,)+) => {
        $(
            #[shadowstep::splitting_scheme($table, first = "drift")]
            #[derive(Clone)]
            struct $Name;
        )+

        fn sweep(case: &impl Case) {
            $(case.sweep(stringify!($Name), $Name);)+
        }
    };
}

schemes! {
    Verlet: "stormer-verlet.toml",
    Suzuki4: "suzuki4.toml",
    BlanesMoanS6: "blanes-moan-s6.toml",
    BlanesMoanS10: "blanes-moan-s10.toml",
    SofroniouSpaletta6: "sofroniou-spaletta6-13.toml",
    SofroniouSpaletta8: "sofroniou-spaletta8-21.toml",
    SofroniouSpaletta10: "sofroniou-spaletta10-35.toml",
}

/// The shortest time that is measured: shorter runs are repeated.
const SHORTEST: Duration = Duration::from_millis(30);

/// How often each time is measured; the least counts.
const ROUNDS: u32 = 3;

/// A problem with its end.
struct Encounter {
    name: &'static str,
    setup: (&'static str, Vec<(String, String)>),
    until: &'static str,
    /// The first step in s.
    first: &'static str,
    halvings: u32,
}

fn encounters() -> Vec<Encounter> {
    let kepler = |name, e: &str| Encounter {
        name,
        setup: ("kepler", vec![("eccentricity".to_owned(), e.to_owned())]),
        until: "65",
        first: "1",
        halvings: 10,
    };
    vec![
        kepler("kepler-0.99", "0.99"),
        kepler("kepler-0.999", "0.999"),
        Encounter { name: "pythagorean", setup: ("pythagorean", Vec::new()), until: "70", first: "1", halvings: 10 },
    ]
}

/// A problem in one kind of numbers.
trait Case {
    fn sweep<S: Scheme + Clone + ValidFor<General>>(&self, name: &str, scheme: S);
}

struct EncounterCase<'a, F> {
    encounter: &'a Encounter,
    reference: Vec<f64>,
    system: F,
}

impl<F, M> Case for EncounterCase<'_, F>
where
    F: Fn() -> M,
    M: System<Number = f64, Class = General> + Clone,
{
    fn sweep<S: Scheme + Clone + ValidFor<General>>(&self, name: &str, scheme: S) {
        let until = exact(self.encounter.until).expect("a time").to_f64().expect("it is finite");
        let stages = scheme.summary().evaluations;
        let mut h = exact(self.encounter.first).expect("a step");
        h *= Rational::from_integer(i64::try_from(stages).expect("few").into()) / Rational::from_integer(8.into());
        for _ in 0..self.encounter.halvings {
            let stepper = Stepper::new(scheme.clone(), h.clone()).expect("it is nonzero");
            let (seconds, end, forces) = time(&self.system, &stepper, &until);
            let error = self.reference.iter().zip(end.state().q()).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            println!("{} {name} {h} {forces} {seconds:.3e} {error:.2e}", self.encounter.name);
            h /= Rational::from_integer(2.into());
            if seconds > 2.0 {
                break;
            }
        }
    }
}

/// The least time of a run in several rounds, its last state, and its forces.
fn time<S, M>(system: &impl Fn() -> M, stepper: &Stepper<S, f64>, until: &f64) -> (f64, M, u64)
where
    S: Scheme + Clone + ValidFor<General>,
    M: System<Number = f64, Class = General> + Clone,
{
    let mut least = f64::INFINITY;
    let mut end = system();
    for _ in 0..ROUNDS {
        let (start, mut runs) = (ThreadTime::now(), 0);
        while runs == 0 || start.elapsed() < SHORTEST {
            end = run(stepper, system(), until);
            runs += 1;
        }
        least = least.min(start.elapsed().as_secs_f64() / f64::from(runs));
    }
    let forces = end.state().evaluations();
    (least, end, forces)
}

/// Steps until the next one would pass `until`, and the last one to it.
fn run<S, M>(stepper: &Stepper<S, M::Number>, mut system: M, until: &M::Number) -> M
where
    S: Scheme + Clone + ValidFor<General>,
    M: System<Number: Real, Class = General>,
{
    let (mut q, mut p) = (system.state().q().to_vec(), system.state().p().to_vec());
    loop {
        stepper.step(&mut system);
        // not finite counts as passed
        if system.state().q().last().is_none_or(|t| t.partial_cmp(until) != Some(std::cmp::Ordering::Less)) {
            break;
        }
        q.iter_mut().zip(system.state().q()).for_each(|(own, q)| own.assign(q));
        p.iter_mut().zip(system.state().p()).for_each(|(own, p)| own.assign(p));
    }
    system.state_mut().set(&q, &p);
    let mut integrator = stepper.with(system);
    step_to_time(&mut integrator, until);
    integrator.into_system()
}

/// q, t and p, p_t at the start, and the masses.
fn start<N: Real>(encounter: &Encounter) -> (Vec<N>, Vec<N>, Vec<Rational>)
where
    N: Number<Context = ()> + 'static,
{
    let (name, parameters) = &encounter.setup;
    let setup = problem(name).expect("it is shipped").setup(parameters, 100).expect("its parameters are valid");
    let numbers = |values: &[(String, shadowstep_schemes::symbolic::Exact)]| -> Vec<N> {
        values.iter().map(|(_, exact)| N::from_rational(&exact.value, &())).collect()
    };
    let (mut q, mut p) = (numbers(setup.values.positions()), numbers(setup.values.momenta()));
    let one = || vec![exact("1").expect("a number"); q.len()];
    let masses = setup.values.masses().map_or_else(one, |m| m.iter().map(|m| m.value.clone()).collect());
    let mut momentum = setup.motion::<N>(&()).expect("its masses are valid").energy();
    momentum.negate();
    q.push(N::zero(&()));
    p.push(momentum);
    (q, p, masses)
}

const TIME: TimeTransformation = TimeTransformation::Logarithmic;

fn motion<N: Number, V: Coordinates<N>, P: Potential<N>, K: Kinetic<N>>(
    (q, p): (V, V),
    (potential, kinetic): (P, K),
) -> Motion<N, V, TransformedPotential<P>, TransformedKinetic<K>> {
    let (potential, kinetic) = (TransformedPotential::new(TIME, potential), TransformedKinetic::new(TIME, kinetic));
    Motion::new(potential, kinetic, q, p).expect("the dimensions agree")
}

fn gravity<N: Number<Context = ()>>(masses: &[Rational]) -> (Pairs<Gravity<N>, 2>, DiagonalMasses<N>) {
    let m: Vec<N> = masses.iter().step_by(2).map(|m| N::from_rational(m, &())).collect();
    let pairs = Pairs::<_, 2>::all(m.len(), Gravity { m }).expect("the pairs fit");
    (pairs, DiagonalMasses::new(masses, &()).expect("they are positive"))
}

/// The positions at the end, from a run of order 10 with 77 digits.
fn reference(encounter: &Encounter, h: &str) -> Vec<Limbs<4>> {
    let (q, p, masses) = start::<Limbs<4>>(encounter);
    let stepper = Stepper::new(SofroniouSpaletta10, h).expect("it is nonzero");
    let until = Limbs::from_rational(&exact(encounter.until).expect("a time"), &());
    if q.len() == 3 {
        return run(&stepper, motion((q, p), (Kepler, shadowstep::UnitMasses)), &until).q().to_vec();
    }
    run(&stepper, motion((q, p), gravity::<Limbs<4>>(&masses)), &until).q().to_vec()
}

fn array<const D: usize>(numbers: &[f64]) -> [f64; D] {
    numbers.try_into().expect("the dimension of the problem")
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    for encounter in encounters() {
        if words.len() > 1 && words[1] != encounter.name {
            continue;
        }
        if words.first().is_some_and(|word| word == "reference") {
            let step = words.get(2).map_or("1/128", String::as_str);
            let texts: Vec<String> =
                reference(&encounter, step).iter().map(|x| format!("{:.25}", x.to_text())).collect();
            println!("{} {}", encounter.name, texts.join(" "));
            continue;
        }
        let (q, p, masses) = start::<f64>(&encounter);
        let reference: Vec<f64> =
            reference(&encounter, "1/128").iter().take(q.len() - 1).map(Real::to_f64).collect();
        if q.len() == 3 {
            let system = motion((array::<3>(&q), array::<3>(&p)), (Kepler, shadowstep::UnitMasses));
            sweep(&EncounterCase { encounter: &encounter, reference, system: || system.clone() });
        } else {
            let system = motion((array::<7>(&q), array::<7>(&p)), gravity::<f64>(&masses));
            sweep(&EncounterCase { encounter: &encounter, reference, system: || system.clone() });
        }
    }
}
