//! What a step of one trajectory costs in an ensemble, as ratios to the loop over `f64`: thread CPU time, all
//! contestants in turn.
//!
//! `cargo bench -p shadowstep --bench ensembles`, with `-- --parts` for the first table only.
//!
//! Before anything is measured, the bits of all trajectories are compared with those that each has alone.

mod timing;

use std::hint::black_box;

use shadowstep::number::Lanes;
use shadowstep::number::instructions::Instructions;
use shadowstep::problems::{HenonHeiles, Kepler, Pendulum};
use shadowstep::systems::formula::FormulaPotential;
use shadowstep::systems::kinetic::{Kinetic, Quadratic};
use shadowstep::systems::potential::Vectorised;
use shadowstep::{
    DiagonalMasses, FullMasses, Motion, Number, Potential, Scheme, Stepper, UnitMasses, ValidFor, splitting_scheme,
};

use timing::{Contestant, compare};

#[splitting_scheme("stormer-verlet.toml")]
#[derive(Clone, Copy)]
struct StormerVerlet;

#[splitting_scheme("yoshida4.toml")]
#[derive(Clone, Copy)]
struct Yoshida4;

/// Trajectories of an ensemble: 8 systems of 8 lanes, which fit into the nearest cache.
const TRAJECTORIES: usize = 64;
/// Steps at once.
const STEPS: u64 = 100;

/// A potential in numbers of any kind.
trait In: Copy {
    type Numbers<N: Number>: Potential<N>;
    fn numbers<N: Number>(self) -> Self::Numbers<N>;
}

macro_rules! in_any_numbers {
    ($($potential:ident)*) => {$(
        impl In for $potential {
            type Numbers<N: Number> = $potential;
            fn numbers<N: Number>(self) -> $potential {
                self
            }
        }
    )*};
}

in_any_numbers! { Kepler HenonHeiles Pendulum Chain }

/// Bodies on a ring with springs U = d²/2 + d⁴/4 between neighbours.
#[derive(Clone, Copy)]
struct Chain;

const BODIES: usize = 32;

impl<N: Number> Potential<N> for Chain {
    fn dimension(&self) -> usize {
        BODIES
    }

    fn scratch(&self) -> usize {
        2
    }

    #[inline(always)]
    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        energy.assign_zero();
        for i in 0..BODIES {
            let [d, square] = scratch else { return };
            d.assign_difference(&q[(i + 1) % BODIES], &q[i]);
            square.assign_square(d);
            d.assign_square(square);
            d.divide_integer(2);
            square.add(d);
            square.divide_integer(2);
            energy.add(square);
        }
    }

    #[inline(always)]
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        gradient.iter_mut().for_each(N::assign_zero);
        for i in 0..BODIES {
            let [d, slope] = scratch else { return };
            let next = (i + 1) % BODIES;
            d.assign_difference(&q[next], &q[i]);
            slope.assign_square(d);
            slope.multiply(d);
            slope.add(d);
            gradient[i].subtract(slope);
            gradient[next].add(slope);
        }
    }
}

/// A formula in x and y that is read at run time.
#[derive(Clone, Copy)]
struct AtRunTime(&'static str);

impl In for AtRunTime {
    type Numbers<N: Number> = FormulaPotential<N>;
    fn numbers<N: Number>(self) -> FormulaPotential<N> {
        FormulaPotential::new(self.0, &["x", "y"], &[]).expect("a formula")
    }
}

/// A system at a start, whose coordinates are in turn these two.
struct Start<P> {
    title: &'static str,
    potential: P,
    q: [f64; 2],
    p: [f64; 2],
}

/// The state of a trajectory, a little different from the others.
fn state<const D: usize>(start: [f64; 2], trajectory: usize) -> [f64; D] {
    std::array::from_fn(|i| start[i % 2] * (1.0 + 1e-3 * trajectory as f64))
}

type Alone<P, const D: usize> = Motion<f64, [f64; D], <P as In>::Numbers<f64>, UnitMasses>;
type InLanes<P, const D: usize, const W: usize> =
    Motion<Lanes<W>, [Lanes<W>; D], <P as In>::Numbers<Lanes<W>>, UnitMasses>;

fn alone<P: In, const D: usize>(start: &Start<P>) -> Vec<Alone<P, D>> {
    let motion = |t| Motion::new(start.potential.numbers(), UnitMasses, state(start.q, t), state(start.p, t));
    (0..TRAJECTORIES).map(|t| motion(t).expect("the dimensions agree")).collect()
}

fn together<P, const D: usize, const W: usize>(start: &Start<P>) -> Vec<InLanes<P, D, W>>
where
    P: In,
{
    let lanes = |part: [f64; 2], first: usize| {
        std::array::from_fn(|i| Lanes(std::array::from_fn(|lane| state::<D>(part, first + lane)[i])))
    };
    let motion =
        |first| Motion::new(start.potential.numbers(), UnitMasses, lanes(start.q, first), lanes(start.p, first));
    (0..TRAJECTORIES).step_by(W).map(|first| motion(first).expect("the dimensions agree")).collect()
}

fn check_bits<S, P, const D: usize, const W: usize>(scheme: S, start: &Start<P>)
where
    S: Scheme + ValidFor<Quadratic> + Copy,
    P: In,
{
    let stepper = Stepper::new(scheme, "1/100").expect("h is not 0");
    let mut alone = alone::<P, D>(start);
    alone.iter_mut().for_each(|motion| (0..STEPS).for_each(|_| stepper.step(motion)));
    let stepper = Stepper::new(scheme, "1/100").expect("h is not 0");
    for instructions in Instructions::available() {
        let mut together = together::<P, D, W>(start);
        instructions.only(|| stepper.steps(&mut together, STEPS));
        for (t, alone) in alone.iter().enumerate() {
            let found = together[t / W].q().iter().chain(together[t / W].p()).map(|x| x.0[t % W].to_bits());
            assert!(found.eq(alone.q().iter().chain(alone.p()).map(|x| x.to_bits())), "{instructions:?}, {t}");
        }
    }
}

/// A repetition is `STEPS` steps of all trajectories.
fn in_lanes<'a, S, P, const D: usize, const W: usize>(
    name: &'static str,
    scheme: S,
    start: &Start<P>,
    instructions: Instructions,
    merged: bool,
) -> Contestant<'a>
where
    S: Scheme + ValidFor<Quadratic> + Copy + 'a,
    P: In + 'a,
{
    let stepper = Stepper::new(scheme, "1/100").expect("h is not 0");
    let mut motions = together::<P, D, W>(start);
    let run = move |repetitions: u32| {
        instructions.only(|| {
            (0..repetitions).for_each(|_| match merged {
                true => stepper.merged_steps(&mut motions, STEPS),
                false => stepper.steps(&mut motions, STEPS),
            });
        });
        black_box(&motions);
    };
    (name, Box::new(run))
}

fn one_by_one<'a, S, P, const D: usize>(scheme: S, start: &Start<P>) -> Contestant<'a>
where
    S: Scheme + ValidFor<Quadratic> + Copy + 'a,
    P: In + 'a,
{
    let stepper = Stepper::new(scheme, "1/100").expect("h is not 0");
    let mut motions = alone::<P, D>(start);
    let run = move |repetitions: u32| {
        for motion in &mut motions {
            (0..u64::from(repetitions) * STEPS).for_each(|_| stepper.step(motion));
        }
        black_box(&motions);
    };
    ("`f64`, one trajectory after the other", Box::new(run))
}

fn in_turn<'a, S, P, const D: usize>(scheme: S, start: &Start<P>) -> Contestant<'a>
where
    S: Scheme + ValidFor<Quadratic> + Copy + 'a,
    P: In + 'a,
{
    let stepper = Stepper::new(scheme, "1/100").expect("h is not 0");
    let mut motions = alone::<P, D>(start);
    let run = move |repetitions: u32| {
        for _ in 0..u64::from(repetitions) * STEPS {
            motions.iter_mut().for_each(|motion| stepper.step(motion));
        }
        black_box(&motions);
    };
    ("`f64`, a step of each in turn", Box::new(run))
}

fn measure<S, P, const D: usize>(name: &str, scheme: S, start: &Start<P>)
where
    S: Scheme + ValidFor<Quadratic> + Copy,
    P: In + 'static,
{
    let mut contestants = vec![one_by_one::<S, P, D>(scheme, start), in_turn::<S, P, D>(scheme, start)];
    for instructions in Instructions::available() {
        let names = match instructions {
            Instructions::Plain => ["4 lanes, plain", "8 lanes, plain", "8 lanes, plain, merged", "16 lanes, plain"],
            Instructions::Avx2 => ["4 lanes, AVX2", "8 lanes, AVX2", "8 lanes, AVX2, merged", "16 lanes, AVX2"],
            Instructions::Avx512 => {
                ["4 lanes, AVX-512", "8 lanes, AVX-512", "8 lanes, AVX-512, merged", "16 lanes, AVX-512"]
            }
        };
        contestants.push(in_lanes::<S, P, D, 4>(names[0], scheme, start, instructions, false));
        contestants.push(in_lanes::<S, P, D, 8>(names[1], scheme, start, instructions, false));
        contestants.push(in_lanes::<S, P, D, 8>(names[2], scheme, start, instructions, true));
        contestants.push(in_lanes::<S, P, D, 16>(names[3], scheme, start, instructions, false));
    }
    let title = format!("{name} on {}, {STEPS} steps of {TRAJECTORIES} trajectories", start.title);
    compare(&title, contestants, 100);
}

/// A system of 8 lanes with any potential and masses.
type OfParts<P, K> = Motion<Lanes<8>, [Lanes<8>; 2], P, K>;

/// What a loop does with the systems, `STEPS` times.
type Loop<P, K> = fn(&Stepper<Yoshida4, Lanes<8>>, &mut [OfParts<P, K>]);

/// Kepler's problem in 8 lanes with another potential, masses or loop, in the widest instructions.
fn kepler_of<'a, P, K>(name: &'static str, potential: fn() -> P, masses: fn() -> K, steps: Loop<P, K>) -> Contestant<'a>
where
    P: Potential<Lanes<8>> + 'a,
    K: Kinetic<Lanes<8>, Class = Quadratic> + 'a,
{
    let stepper = Stepper::new(Yoshida4, "1/100").expect("h is not 0");
    let lanes = |x: f64, first: usize| Lanes(std::array::from_fn(|lane| x * (1.0 + 1e-3 * (first + lane) as f64)));
    let motion = |t| {
        let (q, p) = ([lanes(0.4, t), lanes(0.0, t)], [lanes(0.0, t), lanes(2.0, t)]);
        Motion::new(potential(), masses(), q, p).expect("the dimensions agree")
    };
    let mut motions: Vec<_> = (0..TRAJECTORIES).step_by(8).map(motion).collect();
    let run = move |repetitions: u32| {
        (0..repetitions).for_each(|_| steps(&stepper, &mut motions));
        black_box(&motions);
    };
    (name, Box::new(run))
}

/// Potentials behind a `dyn`, masses that differ, augmented steps.
fn measure_parts() {
    type DynPotential = Box<dyn Potential<Lanes<8>>>;
    fn plain<P: Potential<Lanes<8>>, K: Kinetic<Lanes<8>, Class = Quadratic>>(
        stepper: &Stepper<Yoshida4, Lanes<8>>,
        motions: &mut [OfParts<P, K>],
    ) {
        stepper.steps(motions, STEPS);
    }
    fn diagonal() -> DiagonalMasses<Lanes<8>> {
        let each: [_; 8] = std::array::from_fn(|t| DiagonalMasses::from_numbers(&[1.0, 1.0 + 0.1 * t as f64]).unwrap());
        DiagonalMasses::of_each(&each.each_ref()).unwrap()
    }
    fn full() -> FullMasses<Lanes<8>> {
        let rows = [["1", "1/5"], ["1/5", "1"]].map(|row| row.map(|text| shadowstep::exact(text).unwrap()).to_vec());
        let each: [_; 8] = std::array::from_fn(|_| FullMasses::from_inverse(&rows, &()).unwrap());
        FullMasses::of_each(&each.each_ref()).unwrap()
    }
    let boxed: fn() -> DynPotential = || Box::new(Kepler);
    let widest: fn() -> DynPotential = || Box::new(Vectorised(Kepler));
    let kepler: fn() -> Kepler = || Kepler;
    let contestants = vec![
        kepler_of("the potential's type is known", kepler, || UnitMasses, plain),
        kepler_of("behind a `dyn`", boxed, || UnitMasses, plain),
        kepler_of("behind a `dyn`, `Vectorised`", widest, || UnitMasses, plain),
        kepler_of("a mass for each coordinate and trajectory", kepler, diagonal, plain),
        kepler_of("a matrix for each trajectory", kepler, full, plain),
        kepler_of(
            "augmented steps, one by one",
            kepler,
            || UnitMasses,
            |stepper, motions| {
                (0..STEPS).for_each(|_| motions.iter_mut().for_each(|motion| stepper.step_augmented(motion)));
            },
        ),
        kepler_of(
            "augmented steps in the widest instructions",
            kepler,
            || UnitMasses,
            |stepper, motions| {
                (0..STEPS).for_each(|_| stepper.step_each_augmented(motions));
            },
        ),
        kepler_of(
            "the same behind a `dyn`, `Vectorised`",
            widest,
            || UnitMasses,
            |stepper, motions| {
                (0..STEPS).for_each(|_| stepper.step_each_augmented(motions));
            },
        ),
    ];
    compare(&format!("Yoshida 4 on Kepler in 8 lanes, {STEPS} steps of {TRAJECTORIES} trajectories"), contestants, 100);
}

fn main() {
    measure_parts();
    if std::env::args().any(|argument| argument == "--parts") {
        return;
    }
    let kepler = Start { title: "Kepler", potential: Kepler, q: [0.4, 0.0], p: [0.0, 2.0] };
    let henon_heiles = Start { title: "Hénon–Heiles", potential: HenonHeiles, q: [0.0, 0.1], p: [0.3, 0.0] };
    let pendulum = Start { title: "the pendulum", potential: Pendulum, q: [0.5, 0.0], p: [1.0, 0.0] };
    check_bits::<_, _, 2, 8>(Yoshida4, &kepler);
    check_bits::<_, _, 2, 16>(StormerVerlet, &kepler);
    check_bits::<_, _, 2, 4>(StormerVerlet, &henon_heiles);
    check_bits::<_, _, 2, 8>(Yoshida4, &henon_heiles);
    measure::<_, _, 2>("Störmer–Verlet", StormerVerlet, &kepler);
    measure::<_, _, 2>("Yoshida 4", Yoshida4, &kepler);
    measure::<_, _, 2>("Störmer–Verlet", StormerVerlet, &henon_heiles);
    measure::<_, _, 2>("Yoshida 4", Yoshida4, &henon_heiles);
    measure::<_, _, 1>("Störmer–Verlet", StormerVerlet, &pendulum);
    let chain = Start { title: "a chain of 32 bodies", potential: Chain, q: [0.0, 0.1], p: [0.3, 0.0] };
    check_bits::<_, _, BODIES, 16>(Yoshida4, &chain);
    measure::<_, _, BODIES>("Yoshida 4", Yoshida4, &chain);
    let formula = AtRunTime("(x^2 + y^2)/2 + x^2*y - y^3/3");
    let at_run_time =
        Start {
            title: "Hénon–Heiles, a formula read at run time", potential: formula, q: [0.0, 0.1], p: [0.3, 0.0]
        };
    measure::<_, _, 2>("Störmer–Verlet", StormerVerlet, &at_run_time);
}
