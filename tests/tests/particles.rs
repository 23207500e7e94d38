//! Protects particles of mass 0: they move as bodies of a mass that moves nothing, change no bit of the bodies, and
//! have no part in energies.
//!
//! Yardsticks: the same bodies alone; bodies of 1e-40 of the central mass, which move the others by that; and a
//! leapfrog in a loop.

use shadowstep::number::{DoubleDouble, Limbs, Number, Real};
use shadowstep::shadow::run::ShadowRun;
use shadowstep::shadow::{Bilinear, Central, StoppingRule};
use shadowstep::systems::formula::{FormulaOfBodies, RelativeTo};
use shadowstep::systems::kinetic::{Quadratic, WithParticles};
use shadowstep::systems::pairs::{Gravity, PairsAndParticles};
use shadowstep::systems::wisdom_holman::{
    Bodies, BodiesError, DemocraticHeliocentric, Encounters, Jacobi, PlanetaryCoordinates, Shells, WisdomHolman,
};
use shadowstep::tables::{self, TableScheme};
use shadowstep::{Carried, DiagonalMasses, Motion, Potential, Rational, Scheme, Stepper, System, ValidFor};
use shadowstep_tests::{log10_distance, log10_largest_distance, rational};

/// 121 digits.
type Long = Limbs<7>;

/// The Sun, Jupiter and Saturn in astronomical units and years, in three dimensions: mass, position and velocity.
const BODIES: [(&str, [&str; 3], [&str; 3]); 3] = [
    ("1", ["0", "0", "0"], ["0", "0", "0"]),
    ("1/1047.35", ["4.94", "0.1", "0.02"], ["-0.05", "2.8967", "0.01"]),
    ("1/3498", ["-10.03", "0.3", "-0.1"], ["0.02", "-1.934", "0.03"]),
];
const G: &str = "39.47";

/// A particle on an orbit of its own.
fn particle(k: usize) -> ([String; 3], [String; 3]) {
    let x = 2.1 + 0.13 * k as f64;
    let v = (39.47 / x).sqrt() * (1.0 - 0.01 * k as f64);
    let [angle, tilt] = [1.3 * k as f64, 0.05 * k as f64];
    let (q, v) = ([x * angle.cos(), x * angle.sin(), tilt], [-v * angle.sin(), v * angle.cos(), tilt]);
    (q.map(|x| format!("{x:.6}")), v.map(|x| format!("{x:.6}")))
}

/// Masses, and inertial positions and momenta, of the bodies and some particles; those of mass 0 have velocities for
/// momenta.
fn state<N: Number>(particles: usize, mass: &str, context: &N::Context) -> (Vec<Rational>, [Vec<N>; 2]) {
    let own = |texts: &[&str; 3]| texts.map(rational);
    let mut all: Vec<_> = BODIES.iter().map(|(mass, q, v)| (rational(mass), own(q), own(v))).collect();
    for k in 0..particles {
        let (q, v) = particle(k);
        all.push((rational(mass), q.map(|x| rational(&x)), v.map(|x| rational(&x))));
    }
    let number = |x: &Rational| N::from_rational(x, context);
    let zero = rational("0");
    let momentum = |(mass, v): (&Rational, &Rational)| if *mass == zero { v.clone() } else { mass * v };
    let q = all.iter().flat_map(|(_, q, _)| q.iter().map(number)).collect();
    let p = all.iter().flat_map(|(mass, _, v)| v.iter().map(|v| number(&momentum((mass, v))))).collect();
    (all.into_iter().map(|(mass, ..)| mass).collect(), [q, p])
}

fn planets<N: Number, C: PlanetaryCoordinates<N, 3>>(
    particles: usize,
    mass: &str,
    context: &N::Context,
) -> WisdomHolman<N, C, 3> {
    let (masses, [q, p]) = state::<N>(particles, mass, context);
    WisdomHolman::new(&Bodies::new(rational(G), masses).unwrap(), (&q, &p), context).unwrap()
}

/// The same in the parts T and U.
fn motion<N: Number>(particles: usize, context: &N::Context) -> impl System<Number = N, Class = Quadratic> + Clone {
    let (masses, [q, p]) = state::<N>(particles, "0", context);
    let (g, number) = (N::from_rational(&rational(G), context), |x: &Rational| N::from_rational(x, context));
    let massive = masses[..3].iter().map(number).collect();
    let gravity = PairsAndParticles::<_, 3>::new(massive, particles, |m| Gravity { g, m }, context).unwrap();
    let of_coordinates: Vec<_> =
        (0..q.len()).map(|c| if c < 9 { masses[c / 3].clone() } else { rational("1") }).collect();
    let kinetic = WithParticles::new(DiagonalMasses::new(&of_coordinates, context).unwrap(), 9);
    Motion::new(gravity, kinetic, q, p).unwrap()
}

/// By texts, which read back to the same bits.
fn same_bits<N: Real>(a: &[N], b: &[N]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_text() == b.to_text())
}

fn quadratic(name: &str) -> TableScheme {
    tables::shipped(name).unwrap()
}

/// Steps of the bodies alone, with one particle and with eleven: bits of the bodies, of β and H, and of the particles.
fn bodies_have_the_bits_that_they_have_alone<M: System<Number: Real>, K>(
    scheme: TableScheme<K>,
    system: impl Fn(usize) -> M,
    context: &<M::Number as Number>::Context,
) where
    TableScheme<K>: Scheme + ValidFor<M::Class>,
{
    let name = scheme.summary().name.to_owned();
    let stepper = Stepper::with_context(scheme, "1/5", context).unwrap();
    let mut systems = [0, 1, 11].map(system);
    for carried in [Carried::Nothing, Carried::Increments].repeat(5) {
        for system in &mut systems {
            match carried {
                Carried::Nothing => stepper.step(system),
                _ => stepper.step_augmented(system),
            }
        }
        let beta = systems.each_ref().map(|system| system.state().increments().beta.clone());
        let energy = systems.each_mut().map(|system| system.energy());
        for k in [1, 2] {
            let [alone, with] = [&systems[0], &systems[k]];
            assert_eq!((alone.massive_coordinates(), with.massive_coordinates()), (9, 9));
            for (alone, with) in [(alone.state().q(), with.state().q()), (alone.state().p(), with.state().p())] {
                assert!(same_bits(alone, &with[..9]), "{name} with {k}");
            }
            assert!(same_bits(&beta[..1], &beta[k..=k]) && same_bits(&energy[..1], &energy[k..=k]), "{name}");
        }
        // nor do particles move each other
        assert!(same_bits(&systems[1].state().q()[9..], &systems[2].state().q()[9..12]), "{name}");
    }
}

fn in_numbers<N: Real>(context: &N::Context) {
    for name in ["stormer-verlet", "saba4", "chin-4a", "wisdom-kernel-17"] {
        let jacobi = |particles| planets::<N, Jacobi<N, 3>>(particles, "0", context);
        bodies_have_the_bits_that_they_have_alone(quadratic(name), jacobi, context);
        bodies_have_the_bits_that_they_have_alone(
            quadratic(name),
            |particles| motion::<N>(particles, context),
            context,
        );
    }
    let heliocentric = |particles| planets::<N, DemocraticHeliocentric<N, 3>>(particles, "0", context);
    let scheme = quadratic("saba4").for_every_kinetic().unwrap();
    bodies_have_the_bits_that_they_have_alone(scheme, heliocentric, context);
}

#[test]
fn the_bodies_have_the_bits_that_they_have_alone() {
    in_numbers::<f64>(&());
    in_numbers::<DoubleDouble>(&());
    in_numbers::<Long>(&());
}

/// Inertial positions and velocities after some steps of a scheme.
fn end<C, K>(scheme: TableScheme<K>, mass: &str) -> Vec<Long>
where
    C: PlanetaryCoordinates<Long, 3>,
    TableScheme<K>: Scheme + ValidFor<C::Class>,
{
    after_steps(planets::<Long, C>(3, mass, &()), scheme, mass)
}

fn after_steps<C, K, P: Potential<Long>>(
    mut system: WisdomHolman<Long, C, 3, P>,
    scheme: TableScheme<K>,
    mass: &str,
) -> Vec<Long>
where
    C: PlanetaryCoordinates<Long, 3>,
    TableScheme<K>: Scheme + ValidFor<C::Class>,
{
    let stepper = Stepper::with_context(scheme, "1/5", &()).unwrap();
    (0..50).for_each(|_| stepper.step(&mut system));
    let (q, mut p) = system.inertial();
    for (k, p) in p.iter_mut().enumerate() {
        let mass = BODIES.get(k / 3).map_or(mass, |(mass, ..)| mass);
        if mass != "0" {
            p.divide(&Long::from_rational(&rational(mass), &()));
        }
    }
    [q, p].concat()
}

/// Bodies of 1e-40 move the others, and each other, by some 1e-40 of their distances and velocities, which are below
/// 100.
#[test]
fn particles_move_as_bodies_of_a_mass_that_moves_nothing() {
    let mut all = Vec::new();
    for name in ["stormer-verlet", "saba4", "chin-4a", "wisdom-kernel-17"] {
        let [none, small] = ["0", "1e-40"].map(|mass| end::<Jacobi<_, 3>, _>(quadratic(name), mass));
        all.push((name, log10_largest_distance(&none, &small)));
    }
    let [none, small] = ["0", "1e-40"]
        .map(|mass| end::<DemocraticHeliocentric<_, 3>, _>(quadratic("saba4").for_every_kinetic().unwrap(), mass));
    all.push(("heliocentric", log10_largest_distance(&none, &small)));
    println!("{all:?}");
    assert!(all.iter().all(|(_, distance)| (-43.0..-36.0).contains(distance)), "{all:?}");
}

/// An oblate central body and a tide, which are not small, with second derivatives in gradient kicks.
#[test]
fn energies_of_each_body_are_those_of_a_mass_that_moves_nothing() {
    let energies =
        [("g*m0*m/(50*r^3)*(3*z^2/r^2 - 1)", RelativeTo::FirstBody), ("m*(x^2 + 2*y*z)/100", RelativeTo::Origin)];
    for (formula, relative_to) in energies {
        let [none, small] = ["0", "1e-40"].map(|mass| {
            let system = planets::<Long, Jacobi<_, 3>>(3, mass, &());
            let (masses, particles) = if mass == "0" { ("1", 3) } else { (mass, 0) };
            let masses = BODIES.iter().map(|(mass, ..)| *mass).chain([masses; 3]);
            let masses: Vec<_> = masses.map(|mass| Long::from_rational(&rational(mass), &())).collect();
            let g = [("g", Long::from_rational(&rational(G), &()))];
            let energy = FormulaOfBodies::new(formula, relative_to, 3, &masses, &g).unwrap().with_particles(particles);
            after_steps(system.beside(Some(energy)).unwrap(), quadratic("chin-4a"), mass)
        });
        let distance = log10_largest_distance(&none, &small);
        assert!((-43.0..-36.0).contains(&distance), "{formula}: {distance}");
    }
}

/// Kicks, gradient kicks and drifts of T + U beside those in a loop over bodies of 1e-40.
#[test]
fn gradient_kicks_are_those_of_bodies_of_a_mass_that_moves_nothing() {
    let (masses, [q, p]) = state::<Long>(3, "1e-40", &());
    let of_coordinates: Vec<_> = masses.iter().flat_map(|mass| [(); 3].map(|()| mass.clone())).collect();
    let number = |x: &Rational| Long::from_rational(x, &());
    let gravity = Gravity { g: number(&rational(G)), m: masses.iter().map(number).collect() };
    let pairs = shadowstep::systems::pairs::Pairs::<_, 3>::all(6, gravity).unwrap();
    let mut small = Motion::new(pairs, DiagonalMasses::new(&of_coordinates, &()).unwrap(), q, p).unwrap();
    let mut none = motion::<Long>(3, &());
    let stepper = Stepper::with_context(quadratic("chin-4a"), "1/50", &()).unwrap();
    for _ in 0..20 {
        stepper.step(&mut small);
        stepper.step(&mut none);
    }
    let distance = log10_largest_distance(none.state().q(), small.q());
    assert!((-43.0..-36.0).contains(&distance), "{distance}");
}

/// q and p of the leapfrog in double precision, one particle at a time, with forces of the bodies alone on all.
#[test]
fn particles_move_as_in_a_loop() {
    const H: f64 = 0.01;
    let (masses, [mut q, p]) = state::<f64>(2, "0", &());
    let masses: Vec<f64> = masses.iter().map(|mass| f64::from_rational(mass, &())).collect();
    let mass = |k: usize| if k < 3 { masses[k] } else { 1.0 };
    let mut v: Vec<f64> = p.iter().enumerate().map(|(c, p)| p / mass(c / 3)).collect();
    let mut system = motion::<f64>(2, &());
    let stepper = Stepper::new(quadratic("stormer-verlet"), "1/100").unwrap();
    for _ in 0..1000 {
        stepper.step(&mut system);
        for half in [true, false] {
            for k in 0..5 {
                for j in (0..3).filter(|j| *j != k) {
                    let d = [0, 1, 2].map(|axis| q[3 * j + axis] - q[3 * k + axis]);
                    let r = d.iter().map(|d| d * d).sum::<f64>().sqrt();
                    (0..3).for_each(|axis| v[3 * k + axis] += H / 2.0 * 39.47 * masses[j] * d[axis] / r.powi(3));
                }
            }
            if half {
                q.iter_mut().zip(&v).for_each(|(q, v)| *q += H * v);
            }
        }
    }
    let distance = log10_largest_distance(&q, system.state().q());
    assert!(distance < -11.0, "{distance}");
}

/// The modified energies along a run, by each kind of estimator.
fn modified_energies<N: Real, M: System<Number = N>>(system: M, context: &N::Context) -> Vec<N>
where
    TableScheme: ValidFor<M::Class>,
{
    let stepper = Stepper::with_context(quadratic("stormer-verlet"), "1/5", context).unwrap();
    let mut all = Vec::new();
    let mut integrator = stepper.with(system);
    let mut run = ShadowRun::new(&mut integrator, 20, &Bilinear::with_error(8)).unwrap();
    while let Some((_, estimate)) = run.advance().unwrap() {
        all.extend([estimate.value.clone(), estimate.error.unwrap().clone()]);
    }
    let mut run = ShadowRun::new(&mut integrator, 20, &Central::best(6, StoppingRule::Full)).unwrap();
    while let Some((_, estimate)) = run.advance().unwrap() {
        all.push(estimate.value.clone());
    }
    all
}

#[test]
fn the_modified_energy_is_that_of_the_bodies() {
    fn check<N: Real>(context: &N::Context) {
        let jacobi = |particles| planets::<N, Jacobi<N, 3>>(particles, "0", context);
        let [alone, with] = [0, 9].map(|particles| modified_energies(jacobi(particles), context));
        assert!(same_bits(&alone, &with) && alone.len() == 63);
        let [alone, with] = [0, 9].map(|particles| modified_energies(motion::<N>(particles, context), context));
        assert!(same_bits(&alone, &with));
        assert!(log10_distance(&alone[0], &alone[40]) < -6.0);
    }
    check::<f64>(&());
    check::<Long>(&());
}

#[test]
fn particles_come_last() {
    let bodies = |masses: &[&str]| Bodies::new(rational("1"), masses.iter().map(|mass| rational(mass)).collect());
    assert_eq!(bodies(&["1", "0", "0"]), Err(BodiesError::Count { found: 1 }));
    assert_eq!(bodies(&["0", "1", "1"]), Err(BodiesError::Mass { body: 0, found: "0".to_owned() }));
    assert_eq!(bodies(&["1", "0", "1"]), Err(BodiesError::Mass { body: 1, found: "0".to_owned() }));
    let with = bodies(&["1", "1/2", "0", "0"]).unwrap();
    assert_eq!((with.count(), with.particles(), with.masses().len()), (4, 2, 2));
}

/// The planets with shells; particle 0 begins at this place beside Jupiter, with a velocity that is faster by this.
fn close<N: Number>(
    particles: usize,
    mass: &str,
    beside: Option<[[&str; 3]; 2]>,
    within: &str,
    context: &N::Context,
) -> Encounters<N, 3> {
    let (masses, [mut q, mut p]) = state::<N>(particles, mass, context);
    if let Some([place, faster]) = beside {
        let of_particle = if mass == "0" { rational("1") } else { rational(mass) };
        for axis in 0..3 {
            let [x, v] = [(BODIES[1].1, place), (BODIES[1].2, faster)]
                .map(|(jupiter, more)| rational(jupiter[axis]) + rational(more[axis]));
            q[9 + axis] = N::from_rational(&x, context);
            p[9 + axis] = N::from_rational(&(v * &of_particle), context);
        }
    }
    let (bodies, shells) = (Bodies::new(rational(G), masses).unwrap(), Shells::within(rational(within)).unwrap());
    Encounters::new(&bodies, (&q, &p), &shells, &rational("1/40"), context).unwrap()
}

/// A particle that passes Jupiter at 0.05 of its Hill radius, of 0.347.
const PASSES: [[&str; 3]; 2] = [["0.31", "0.012", "0"], ["-1.2", "0", "0.01"]];

/// Within 3 AU of Jupiter eleven particles are, some of them beyond the first shell.
#[test]
fn bodies_have_their_bits_where_particles_come_close() {
    fn check<N: Real>(context: &N::Context) {
        for compensated in [false, true] {
            let scheme = quadratic("saba4").for_every_kinetic().unwrap();
            let system = |particles: usize| {
                let system = close::<N>(particles, "0", (particles > 0).then_some(PASSES), "3", context);
                if compensated { system.compensated() } else { system }
            };
            bodies_have_the_bits_that_they_have_alone(scheme, system, context);
        }
    }
    check::<f64>(&());
    check::<DoubleDouble>(&());
}

/// A particle in the shells of Jupiter is a body of 1e-40 of the Sun there; and Jupiter's attraction turns it.
#[test]
fn particles_that_come_close_are_bodies_of_a_small_mass() {
    let stepper = Stepper::new(quadratic("stormer-verlet").for_every_kinetic().unwrap(), "1/10").unwrap();
    let mut systems = ["0", "1e-40"].map(|mass| close::<Long>(2, mass, Some(PASSES), "1", &()));
    let mut closest = f64::INFINITY;
    for n in 0..10 {
        for system in &mut systems {
            match n % 2 {
                0 => stepper.step_augmented(system),
                _ => stepper.step(system),
            }
        }
        let [particles, bodies] = systems.each_mut().map(|system| system.inertial());
        let difference = |a: &Long, b: &Long| {
            let mut difference = *a;
            difference.subtract(b);
            difference.to_f64()
        };
        let off = |a: &[Long], b: &[Long]| a.iter().zip(b).map(|(a, b)| difference(a, b).abs()).fold(0.0, f64::max);
        assert!(off(&particles.0, &bodies.0) < 1e-33, "{n}: {:e}", off(&particles.0, &bodies.0));
        let velocities = bodies.1[9..].iter().map(|p| {
            let mut v = *p;
            v.divide(&Long::from_rational(&rational("1e-40"), &()));
            v
        });
        let velocities: Vec<_> = velocities.collect();
        assert!(off(&particles.1[9..], &velocities) < 1e-32, "{n}");
        let distance = (0..3).map(|i| difference(&particles.0[9 + i], &particles.0[3 + i]).powi(2)).sum::<f64>().sqrt();
        closest = closest.min(distance);
    }
    assert!(closest < 0.17, "{closest}");
}
