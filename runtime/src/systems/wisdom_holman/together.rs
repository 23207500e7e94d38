//! The Kepler drifts of several planets at once, each in a lane, with the bits that it has alone.

use crate::Rational;
use crate::number::{LaneAccess, Number};
use crate::systems::kepler_drift::KeplerDrift;

/// Fewer planets than these are as fast one after the other, in all vector instructions.
const FEWEST: usize = 3;

/// The planets in groups, and what their drifts add; the last ones may be too few for a group.
#[derive(Clone, Debug)]
pub(super) struct Together<N: Number, const D: usize> {
    kepler: KeplerDrift<N::InLanes>,
    groups: Vec<Group<N>>,
    /// 1 in all lanes.
    one: N::InLanes,
    /// What a drift adds to positions, planet after planet.
    pub(super) to_q: Vec<N>,
    /// The same of momenta.
    pub(super) to_p: Vec<N>,
    /// The universal anomaly of each planet.
    pub(super) anomalies: Vec<N>,
}

/// The masses m and gravity parameters μ of planets in lanes.
#[derive(Clone, Debug)]
struct Group<N: Number> {
    planets: usize,
    mass: N::InLanes,
    parameter: N::InLanes,
}

impl<N: Number> Group<N> {
    /// A lane without a planet has a body at rest that nothing attracts, which needs no long computation.
    fn of(planets: &[[&N; 2]], access: &LaneAccess<N, N::InLanes>, one: &N::InLanes) -> Self {
        let (mut mass, mut parameter) = (one.clone(), N::InLanes::zero(&one.context()));
        for (lane, [m, mu]) in planets.iter().enumerate() {
            (access.set)(&mut mass, lane, m);
            (access.set)(&mut parameter, lane, mu);
        }
        Group { planets: planets.len(), mass, parameter }
    }
}

impl<N: Number, const D: usize> Together<N, D> {
    /// For planets with these m and μ, if numbers are computed in lanes, and there are enough planets.
    pub(super) fn new(planets: &[[&N; 2]], context: &N::Context) -> Option<Box<Self>> {
        let access = N::LANE_ACCESS?;
        let one = N::InLanes::from_rational(&Rational::from_integer(1.into()), context);
        let groups = planets.chunks(N::InLanes::LANES).filter(|group| group.len() >= FEWEST);
        let groups: Vec<_> = groups.map(|group| Group::of(group, &access, &one)).collect();
        let count = groups.iter().map(|group| group.planets).sum();
        let zeros = |length| vec![N::zero(context); length];
        let (kepler, to_q, to_p) = (KeplerDrift::new(context), zeros(count * D), zeros(count * D));
        (count > 0).then(|| Box::new(Together { kepler, groups, one, to_q, to_p, anomalies: zeros(count) }))
    }

    /// What the drift adds to positions and momenta of the planets, and their universal anomalies.
    pub(super) fn find_increments(&mut self, time: &N, (q, p): (&[N], &[N])) {
        let Together { kepler, groups, one, to_q, to_p, anomalies } = self;
        let Some(LaneAccess { set, number }) = N::LANE_ACCESS else { return };
        let context = time.context();
        let zeros = || -> [N::InLanes; D] { std::array::from_fn(|_| N::InLanes::zero(&context)) };
        let mut times = N::InLanes::zero(&context);
        (0..N::InLanes::LANES).for_each(|lane| set(&mut times, lane, time));
        let mut first = 0;
        for group in groups {
            let planets = first..first + group.planets;
            let coordinates = planets.start * D..planets.end * D;
            // not at the centre, where there is no planet
            let (mut place, mut velocity) = (std::array::from_fn::<_, D, _>(|_| one.clone()), zeros());
            to_lanes(&q[coordinates.clone()], &mut place);
            to_lanes(&p[coordinates.clone()], &mut velocity);
            velocity.iter_mut().for_each(|v| v.divide(&group.mass));
            let (mut of_q, mut of_v) = (zeros(), zeros());
            let s = kepler.advance_augmented(&group.parameter, &times, &mut place, &mut velocity, &mut of_q, &mut of_v);
            for (lane, anomaly) in anomalies[planets].iter_mut().enumerate() {
                *anomaly = number(s, lane);
            }
            of_v.iter_mut().for_each(|v| v.multiply(&group.mass));
            from_lanes(&of_q, &mut to_q[coordinates.clone()]);
            from_lanes(&of_v, &mut to_p[coordinates]);
            first += group.planets;
        }
    }
}

/// The coordinates of planets, one planet after the other, to a lane for each.
#[inline(always)]
fn to_lanes<N: Number, const D: usize>(planets: &[N], coordinates: &mut [N::InLanes; D]) {
    let Some(LaneAccess { set, .. }) = N::LANE_ACCESS else { return };
    for (lane, planet) in planets.as_chunks::<D>().0.iter().enumerate() {
        coordinates.iter_mut().zip(planet).for_each(|(lanes, x)| set(lanes, lane, x));
    }
}

/// The same back.
#[inline(always)]
fn from_lanes<N: Number, const D: usize>(coordinates: &[N::InLanes; D], planets: &mut [N]) {
    let Some(LaneAccess { number, .. }) = N::LANE_ACCESS else { return };
    for (lane, planet) in planets.as_chunks_mut::<D>().0.iter_mut().enumerate() {
        planet.iter_mut().zip(coordinates).for_each(|(x, lanes)| *x = number(lanes, lane));
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Bodies, DemocraticHeliocentric, Jacobi, PlanetaryCoordinates, WisdomHolman};
    use crate::number::instructions::Instructions;
    use crate::number::{Dual, Fused, Number};
    use crate::systems::increments::Carried;
    use crate::systems::system::System;
    use crate::{Rational, exact};
    use rand_pcg::Pcg64Mcg;
    use rand_pcg::rand_core::{Rng, SeedableRng};
    use std::array::from_fn;

    fn number(random: &mut Pcg64Mcg, low: f64, high: f64) -> f64 {
        low + (high - low) * (random.next_u64() >> 11) as f64 * 2_f64.powi(-53)
    }

    /// q and v of a planet at a distance of 0.7 to 50, with 0.2 to 1.9 times the velocity of a circle: an ellipse, or
    /// from √2 on a hyperbola.
    fn planet<const D: usize>(random: &mut Pcg64Mcg) -> [[f64; D]; 2] {
        let r = number(random, 0.7_f64.ln(), 50_f64.ln()).exp();
        [r, number(random, 0.2, 1.9) / r.sqrt()].map(|size| {
            let point: [f64; D] = from_fn(|_| number(random, -1.0, 1.0));
            let norm = point.iter().map(|x| x * x).sum::<f64>().sqrt();
            point.map(|x| x * size / norm)
        })
    }

    /// A star and planets of 10⁻⁸ of its mass, of which the second begins near the star, and the fourth near the third.
    fn system<C: PlanetaryCoordinates<N, D>, N: Number<Context = ()>, const D: usize>(
        planets: usize,
        number: impl Fn(f64) -> N,
    ) -> WisdomHolman<N, C, D> {
        let mut random = Pcg64Mcg::seed_from_u64(planets as u64);
        let mut states = vec![[[0.0; D]; 2]];
        states.extend((0..planets).map(|_| planet(&mut random)));
        if let Some([q, v]) = states.get_mut(2) {
            (*q, *v) = (q.map(|x| 1e-3 * x), v.map(|x| 30.0 * x));
        }
        if planets > 3 {
            states[4] = states[3];
            states[4][0][0] += 1e-5;
        }
        let mass = |body: usize| if body == 0 { 1.0 } else { 1e-8 * body as f64 };
        let masses = (0..=planets).map(|body| Rational::from_float(mass(body)).unwrap()).collect();
        let bodies = Bodies::new(exact("1").unwrap(), masses).unwrap();
        let q: Vec<_> = states.iter().flat_map(|[q, _]| q.map(&number)).collect();
        let p: Vec<_> =
            states.iter().enumerate().flat_map(|(body, [_, v])| v.map(|v| number(mass(body) * v))).collect();
        WisdomHolman::new(&bodies, (&q, &p), &()).unwrap()
    }

    /// The bits of a state with its remainders, and of what the last augmented step added.
    fn bits<C: PlanetaryCoordinates<f64, D>, const D: usize>(system: &WisdomHolman<f64, C, D>) -> [Vec<u64>; 2] {
        let (state, remainders) = (system.state(), system.state().remainders());
        let increments = state.increments();
        let beta = std::slice::from_ref(increments.beta);
        [[state.q(), state.p(), &remainders.q, &remainders.p], [increments.q, increments.p, beta, &[]]]
            .map(|lists| lists.into_iter().flatten().map(|x| x.to_bits()).collect())
    }

    /// A drift, a kick and a drift: a step, or a step back.
    fn step<N: Number + From<f64>>(system: &mut impl System<Number = N>, h: f64, carried: Carried) {
        system.clear_increments();
        system.drift(&N::from(0.5 * h), carried);
        system.kick(&N::from(h), carried);
        system.drift(&N::from(0.5 * h), carried);
    }

    /// Plain and augmented steps of planets together beside those of planets one by one.
    fn check<C: PlanetaryCoordinates<f64, D> + Clone, const D: usize>(together: &WisdomHolman<f64, C, D>, h: f64) {
        let mut systems: [_; 4] = from_fn(|_| together.clone());
        systems[2].orbits.together = None;
        systems[3].orbits.together = None;
        for count in 0..10 {
            let kinds = [Carried::Nothing, Carried::Increments, Carried::Nothing, Carried::Increments];
            systems.iter_mut().zip(kinds).for_each(|(system, carried)| step(system, h, carried));
            let [plain, augmented, plain_alone, augmented_alone] = systems.each_ref().map(bits);
            assert!(systems[0].state().is_finite());
            assert_eq!(plain, plain_alone, "step {count} of {h}");
            assert_eq!(augmented, augmented_alone, "augmented step {count} of {h}");
            assert_eq!(plain[0], augmented[0], "plain and augmented step {count} of {h}");
        }
    }

    #[test]
    fn planets_together_have_the_bits_of_planets_one_by_one() {
        for planets in [1, 2, 3, 5, 8, 9, 11, 17] {
            let jacobi = system::<Jacobi<_, 3>, _, 3>(planets, |x| x);
            let flat = system::<Jacobi<_, 2>, _, 2>(planets, |x| x).compensated();
            let heliocentric = system::<DemocraticHeliocentric<_, 3>, _, 3>(planets, |x| x).compensated();
            for (instructions, h) in
                Instructions::available().flat_map(|i| [0.01, 0.3, 7.0, -0.01, -7.0].map(|h| (i, h)))
            {
                instructions.only(|| {
                    check(&jacobi, h);
                    check(&flat, h);
                    check(&heliocentric, h);
                });
            }
        }
    }

    /// Values beside those of plain numbers, and derivatives beside those of planets one by one.
    #[test]
    fn dual_planets_together_have_the_bits_of_planets_one_by_one() {
        for planets in [3, 8, 11] {
            for h in [0.01, 0.3, 7.0, -0.3] {
                let mut plain = system::<Jacobi<_, 3>, _, 3>(planets, |x| x);
                let mut together = system::<Jacobi<_, 3>, _, 3>(planets, |x| Dual::new(x, [x.cos(), (7.0 * x).sin()]));
                let mut one_by_one = together.clone();
                one_by_one.orbits.together = None;
                assert!(together.orbits.together.is_some());
                for count in 0..10 {
                    step(&mut plain, h, Carried::Nothing);
                    step(&mut together, h, Carried::Nothing);
                    step(&mut one_by_one, h, Carried::Nothing);
                    let [found, expected] =
                        [&together, &one_by_one].map(|system| [system.state().q(), system.state().p()].concat());
                    let plain = [plain.state().q(), plain.state().p()].concat();
                    for (c, (found, expected)) in found.iter().zip(&expected).enumerate() {
                        assert_eq!(found.value, plain[c], "coordinate {c} after {count} steps of {h}");
                        assert_eq!(
                            found.derivatives, expected.derivatives,
                            "coordinate {c} after {count} steps of {h}"
                        );
                    }
                }
            }
        }
    }

    /// A planet at the star itself has no orbit: the numbers of the others do not depend on it.
    #[test]
    fn a_collision_stays_in_its_lane() {
        let mut together = system::<Jacobi<_, 3>, _, 3>(5, |x| x);
        together.state_mut().q_mut()[9..12].fill(0.0);
        let mut one_by_one = together.clone();
        one_by_one.orbits.together = None;
        for system in [&mut together, &mut one_by_one] {
            system.drift(&0.3, Carried::Increments);
        }
        assert!(together.state().q()[9..12].iter().all(|x| x.is_nan()));
        let (found, expected) = (bits(&together), bits(&one_by_one));
        for (index, (found, expected)) in found.iter().flatten().zip(expected.iter().flatten()).enumerate() {
            assert!(found == expected || [*found, *expected].iter().all(|x| f64::from_bits(*x).is_nan()), "{index}");
        }
    }

    #[test]
    fn few_planets_and_other_numbers_are_computed_one_by_one() {
        let count = |planets| {
            let system = system::<Jacobi<_, 3>, _, 3>(planets, |x| x);
            system.orbits.together.map_or(0, |together| together.anomalies.len())
        };
        assert_eq!([1, 2, 3, 8, 9, 10, 11, 17].map(count), [0, 0, 3, 8, 8, 8, 11, 16]);
        assert!(system::<Jacobi<_, 3>, _, 3>(8, Fused).orbits.together.is_none());
    }
}
