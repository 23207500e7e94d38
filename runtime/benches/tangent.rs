//! What tangent vectors cost in `f64`: a step with one, and with four at once, beside a plain step; by `yoshida4` where
//! no scheme is named.

mod timing;

use std::hint::black_box;

use num_traits::One as _;
use shadowstep::number::{Dual, Number};
use shadowstep::problems::{HenonHeiles, Kepler, LennardJones};
use shadowstep::systems::pairs::{Gravity, PairPotential, Pairs};
use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, WisdomHolman};
use shadowstep::tables::shipped;
use shadowstep::{
    Motion, Potential, Rational, Stepper, System, UnitMasses, ValidFor, exact, potential, tables::TableScheme,
};

use timing::{Contestant, compare};

/// What most systems are advanced by: the scheme and the step size.
const YOSHIDA_4: (&str, &str) = ("yoshida4", "1/100");

/// Of one drift and one kick, as WHFast's: `evidence/rivals/tangent.py` makes the same steps.
const LEAPFROG: (&str, &str) = ("stormer-verlet", "3/10");

/// A number with its vectors, of fixed components.
trait Carrying: Number<Context = ()> + 'static {
    fn number(x: f64, index: usize) -> Self;
}

impl Carrying for f64 {
    fn number(x: f64, _: usize) -> Self {
        x
    }
}

impl<const K: usize> Carrying for Dual<f64, K> {
    fn number(x: f64, index: usize) -> Self {
        Dual::new(x, std::array::from_fn(|k| ((7 * index + 3 * k + 1) as f64).sin()))
    }
}

fn state<N: Carrying>(numbers: &[f64], first: usize) -> Vec<N> {
    (first..).zip(numbers).map(|(index, x)| N::number(*x, index)).collect()
}

fn steps<M>(name: &'static str, (scheme, h): (&str, &str), mut system: M) -> Contestant<'static>
where
    M: System + 'static,
    M::Number: Carrying,
    TableScheme: ValidFor<M::Class>,
{
    let stepper = Stepper::with_context(shipped(scheme).expect("it is shipped"), h, &());
    let stepper: Stepper<TableScheme, M::Number> = stepper.expect("a step size");
    let run = move |repetitions: u32| {
        for _ in 0..repetitions {
            stepper.step(black_box(&mut system));
        }
    };
    (name, Box::new(run))
}

fn motion<N: Carrying>(
    name: &'static str,
    potential: impl Potential<N> + 'static,
    q: &[f64],
    p: &[f64],
) -> Contestant<'static> {
    let (q, p) = (state(q, 0), state(p, q.len()));
    steps(name, YOSHIDA_4, Motion::new(potential, UnitMasses, q, p).expect("the dimensions agree"))
}

potential! {
    /// Gravity with a softening length.
    struct Softened { g, s }
    pair U(r2; m_i, m_j) = -g * m_i * m_j / sqrt(r2 + s^2)
}

fn constant<N: Carrying>(x: f64) -> N {
    N::from_rational(&Rational::from_float(x).expect("finite"), &())
}

/// All pairs of bodies, at rest in places without an order.
fn pairs<N: Carrying>(name: &'static str, bodies: usize, pair: impl PairPotential<N> + 'static) -> Contestant<'static> {
    let place = |i: usize| ((i * i * 31 + 7 * i) % 1009) as f64 / 100.0;
    let q: Vec<f64> = (0..3 * bodies).map(place).collect();
    motion(name, Pairs::<_, 3>::all(bodies, pair).expect("the pairs fit"), &q, &vec![0.0; 3 * bodies])
}

fn gravity<N: Carrying>(name: &'static str, bodies: usize) -> Contestant<'static> {
    pairs(name, bodies, Gravity { g: constant::<N>(1e-6), m: vec![constant(1.0); bodies] })
}

fn softened<N: Carrying>(name: &'static str, bodies: usize) -> Contestant<'static> {
    pairs(name, bodies, Softened { g: constant::<N>(1e-6), s: constant(0.1), m: vec![constant(1.0); bodies] })
}

/// So weak and small that bodies stay where they are.
fn lennard_jones<N: Carrying>(name: &'static str, bodies: usize) -> Contestant<'static> {
    pairs(name, bodies, LennardJones { epsilon: constant::<N>(1e-6), sigma: constant(0.1) })
}

/// Planets of 10⁻⁵ of the star on nearly circular orbits.
fn planets<N: Carrying>(name: &'static str, count: usize, scheme: (&str, &str)) -> Contestant<'static> {
    let masses = std::iter::once(Rational::one()).chain((0..count).map(|_| exact("1/100000").expect("a number")));
    let bodies = Bodies::new(Rational::one(), masses.collect()).expect("positive masses");
    let (mut q, mut p) = (vec![0.0; 3], vec![0.0; 3]);
    for i in 0..count {
        let (r, (sin, cos)) = (1.6_f64.powi(i as i32), (2.4 * i as f64).sin_cos());
        let momentum = 1.03e-5 / r.sqrt();
        q.extend([r * cos, r * sin, 0.01 * r]);
        p.extend([-momentum * sin, momentum * cos, 0.0]);
    }
    let system = WisdomHolman::<N, Jacobi<N, 3>, 3>::new(&bodies, (&state(&q, 0), &state(&p, q.len())), &());
    steps(name, scheme, system.expect("a state of these bodies"))
}

/// The plain step, and those with vectors, of a system that a macro writes in each number type.
macro_rules! compared {
    ($title:expr, $repetitions:expr, $contestant:ident($($argument:expr),*)) => {
        compare(
            $title,
            vec![
                $contestant::<f64>("plain", $($argument),*),
                $contestant::<Dual<f64>>("1 vector", $($argument),*),
                $contestant::<Dual<f64, 4>>("4 vectors", $($argument),*),
            ],
            $repetitions,
        );
    };
}

fn main() {
    compared!("Kepler", 20_000, motion(Kepler, &[0.4, 0.0], &[0.0, 2.0]));
    compared!("Hénon and Heiles", 20_000, motion(HenonHeiles, &[0.1, 0.2], &[0.1, 0.0]));
    compared!("6 bodies in space", 5_000, gravity(6));
    compared!("100 bodies in space", 50, gravity(100));
    compared!("100 bodies in space, softened", 50, softened(100));
    compared!("100 bodies in space, Lennard-Jones", 50, lennard_jones(100));
    compared!("2 planets on Kepler orbits", 1_000, planets(2, YOSHIDA_4));
    compared!("8 planets on Kepler orbits", 300, planets(8, YOSHIDA_4));
    compared!("2 planets, `stormer-verlet`, h = 3/10", 3_000, planets(2, LEAPFROG));
    compared!("8 planets, `stormer-verlet`, h = 3/10", 1_000, planets(8, LEAPFROG));
}
