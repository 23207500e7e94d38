//! Light bodies that come close to planets: whether the steps resolve what turns their orbits, as the energy does not
//! show it.

use serde::Serialize;
use shadowstep::number::instructions;
use shadowstep::number::saved::{Fields, list};
use shadowstep::systems::wisdom_holman::Shells;
use shadowstep::{Number, Rational};
use shadowstep_schemes::symbolic::decimal::significant;

use super::places::{Each, Place, Places, STATES, at, difference, dot, least_of, roots, squares};
use crate::scene::{GRAVITY, Parts, PotentialEnergy, System};

/// The closest approach of a light planet, or of a particle of mass 0, to a heavier planet.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LightBody {
    /// The state after the step in which it was.
    pub n: i64,
    /// The names or numbers of the planet and the light body.
    pub bodies: [String; 2],
    /// The distance in Hill radii of the planet, (m/3m_0)^(1/3) r.
    pub hill_radii: f64,
    /// How many steps, or substeps, there are in the local time scale, the smaller of d/v and √(d³/Gm), with the
    /// distance d from the planet and the relative speed v: the least number within one Hill radius.
    pub steps: f64,
    /// Whether that is enough, or the body stayed beyond one Hill radius.
    pub resolved: bool,
}

/// A planet of less than this part of the heaviest one is light.
const LIGHT: f64 = 1e-2;

/// Beyond this many Hill radii of a planet what the steps miss of its attraction is little.
const CLOSE: f64 = 1.0;

/// The steps in the local time scale that resolve an approach. Of 21 particles that passed Jupiter within a Hill
/// radius, by steps of 1e-4 to 0.1 years of `stormer-verlet`, the velocities afterwards were off by at most 8e-4 of
/// themselves with more than 7 steps, 4e-3 with 2 to 4, 0.05 with 1 to 2, and by all of them with fewer.
const LEAST_STEPS: f64 = 10.0;

/// Follows light bodies from state to state.
pub(super) struct LightBodies {
    names: Vec<String>,
    /// The mass of each body that has one, and (m/3m_0)^(1/3).
    masses: Vec<f64>,
    parts: Vec<f64>,
    /// 1/(3 G m_0), and |h|.
    scale: f64,
    h: f64,
    /// In which planets attract in drifts, and the substeps of a step in the first one.
    shells: Option<(Shells, u32)>,
    /// The light bodies, by their numbers.
    light: Vec<usize>,
    /// The planets that are heavier than one of them.
    attracting: Vec<usize>,
    /// All bodies at the state before the next ones; none before the first state.
    before: Vec<Place>,
    /// The distances of the attracting planets from the central body.
    radii: Vec<Each>,
    /// How far each body goes in the step to each of the states.
    ways: Vec<Each>,
    /// Distances of each light body count that are below this, in Hill radii.
    limits: Vec<f64>,
    /// Whether each of the attracting planets may have a light body so near that its distance counts, in that step.
    near: Vec<[bool; STATES]>,
    found: Vec<Closest>,
}

/// The least square of a distance in Hill radii, its n and planet, and the least number of steps.
#[derive(Clone, Copy)]
struct Closest {
    square: f64,
    n: i64,
    planet: usize,
    steps: f64,
}

impl Closest {
    const NOTHING: Closest = Closest { square: f64::INFINITY, n: 0, planet: 0, steps: f64::INFINITY };
}

impl LightBodies {
    /// Of bodies about a central one, in steps of h; `None` where none of them is light.
    pub(super) fn of(system: &System, h: f64) -> Option<LightBodies> {
        let number = |value: &Rational| <f64 as Number>::from_rational(value, &());
        let (particles, planets) =
            (system.particles(), system.parts.planets().map(|of_all| of_all.without_particles()));
        let (g, masses, dimensions) = match (&planets, &system.potential) {
            (Some(planets), _) => (planets.bodies.g().clone(), planets.bodies.masses().to_vec(), planets.dimensions),
            (None, PotentialEnergy::Pairs(pairs))
                if pairs.formula.text() == GRAVITY && matches!(system.parts, Parts::KineticAndPotential(_)) =>
            {
                let (_, g) = system.parameters.iter().find(|(name, _)| name == "g")?;
                let (_, masses) = pairs.properties.iter().find(|(name, _)| name == "m")?;
                let masses = masses.iter().take(pairs.bodies - particles).map(|mass| mass.value.clone());
                (g.value.clone(), masses.collect(), pairs.dimensions)
            }
            _ => return None,
        };
        let masses: Vec<f64> = masses.iter().map(number).collect();
        let heaviest = masses.get(1..)?.iter().copied().fold(0.0, f64::max);
        let light: Vec<usize> = (1..masses.len())
            .filter(|body| masses[*body] < LIGHT * heaviest)
            .chain(masses.len()..masses.len() + particles)
            .collect();
        // without a body in the centre there are no Hill radii
        if light.is_empty() || heaviest >= LEAST_CENTRAL * masses[0] {
            return None;
        }
        let attracts =
            |planet: &usize| light.iter().any(|body| masses.get(*body).is_none_or(|mass| *mass < masses[*planet]));
        let attracting: Vec<usize> = (1..masses.len()).filter(attracts).collect();
        let names = system.coordinates.iter().step_by(dimensions);
        let encounters = planets.as_ref().and_then(|planets| planets.encounters.as_ref());
        let shells = encounters.map(|near| (near.shells.clone(), near.substeps));
        Some(LightBodies {
            names: names.map(|name| name.trim_start_matches('x').trim_start_matches('_').to_owned()).collect(),
            scale: 1.0 / (3.0 * number(&g) * masses[0]),
            parts: masses.iter().map(|mass| (mass / (3.0 * masses[0])).cbrt()).collect(),
            h: h.abs(),
            shells,
            before: Vec::new(),
            ways: vec![Each::all(0.0); masses.len() + particles],
            radii: vec![Each::all(0.0); attracting.len()],
            limits: vec![CLOSE; light.len()],
            near: vec![[false; STATES]; attracting.len()],
            attracting,
            found: vec![Closest::NOTHING; light.len()],
            light,
            masses,
        })
    }

    /// Takes the next states: finds the least distances in the steps to them, in which bodies move straight.
    pub(super) fn include(&mut self, places: &Places) {
        let bodies = &places.relative;
        self.find_near(bodies);
        let is_first = self.before.len() != bodies.len();
        for (state, n) in places.states().skip(usize::from(is_first)) {
            for place in 0..self.attracting.len() {
                if self.near[place][state] {
                    self.approach(n, place, (bodies, state));
                }
            }
        }
        if let Some((last, _)) = places.states().next_back() {
            self.before.clear();
            self.before.extend(bodies.iter().map(|body| at(body, last)));
        }
    }

    /// Finds planets that may have a light body so near that its distance counts, without a root of the distance or a
    /// division: most have none. After a step the distance is at most the least one in it and the ways of both.
    fn find_near(&mut self, bodies: &[[Each; 3]]) {
        let LightBodies { parts, light, attracting, before, radii, ways, limits, near, found, .. } = self;
        instructions::widest(
            #[inline(always)]
            || {
                for (place, way) in ways.iter_mut().enumerate() {
                    *way = roots(&squares_of_ways(before.get(place), &bodies[place]));
                }
                for (limit, found) in limits.iter_mut().zip(&*found) {
                    *limit = found.square.sqrt().max(CLOSE);
                }
                for ((planet, radii), near) in attracting.iter().zip(radii).zip(near) {
                    *radii = roots(&squares(&bodies[*planet], &bodies[0]));
                    let mut excess = [f64::INFINITY; STATES];
                    for (body, limit) in light.iter().zip(&*limits) {
                        let squares = squares(&bodies[*body], &bodies[*planet]);
                        for (state, excess) in excess.iter_mut().enumerate() {
                            let ways = ways[*body].0[state] + ways[*planet].0[state];
                            let most = farthest(ways, limit * parts[*planet] * radii.0[state]);
                            *excess = least_of(squares.0[state] - most * most, *excess);
                        }
                    }
                    *near = excess.map(|excess| excess < 0.0);
                }
            },
        );
    }

    /// The least distances from the planet at a place of `attracting`, in the step to a state, whose number is n.
    fn approach(&mut self, n: i64, place: usize, (bodies, state): (&[[Each; 3]], usize)) {
        let LightBodies {
            masses, parts, scale, h, shells, light, attracting, before, radii, ways, limits, found, ..
        } = self;
        let before = |body: usize| if state == 0 { before[body] } else { at(&bodies[body], state - 1) };
        let planet = attracting[place];
        let radius = radii[place].0[state];
        let hill = parts[planet] * radius;
        for ((body, limit), found) in light.iter().zip(limits).zip(found) {
            let b = difference(&at(&bodies[*body], state), &at(&bodies[planet], state));
            let most = farthest(ways[*body].0[state] + ways[planet].0[state], *limit * hill);
            let is_heavier = *body < masses.len() && masses[*body] >= masses[planet];
            if is_heavier || dot(&b, &b) >= most * most {
                continue;
            }
            let a = difference(&before(*body), &before(planet));
            let moved = difference(&b, &a);
            let square = dot(&moved, &moved);
            let part = if square > 0.0 { (-dot(&a, &moved) / square).clamp(0.0, 1.0) } else { 1.0 };
            let nearest: Place = std::array::from_fn(|axis| a[axis] + part * moved[axis]);
            let distance = dot(&nearest, &nearest);
            let square_in_radii = distance / (hill * hill);
            let is_close = square_in_radii < CLOSE * CLOSE;
            let is_closest = square_in_radii < found.square;
            if !is_close && !is_closest {
                continue;
            }
            let distance = distance.sqrt();
            // √(R³/Gm) of the Hill radius R
            let time = (radius.powi(3) * *scale).sqrt();
            let free_fall = square_in_radii.powf(0.75) * time / *h;
            let steps = (distance / square.sqrt()).min(free_fall) * substeps(shells.as_ref(), distance);
            let was_close = found.square < CLOSE * CLOSE;
            found.steps = if is_close && was_close { found.steps.min(steps) } else { steps };
            if is_closest {
                *found = Closest { square: square_in_radii, n, planet, steps: found.steps };
            }
        }
    }

    /// What the states so far have shown, of each light body that was near any planet.
    pub(super) fn found(&self) -> Vec<LightBody> {
        let one = |(body, Closest { square, n, planet, steps }): (&usize, &Closest)| LightBody {
            n: *n,
            bodies: [*planet, *body].map(|body| self.names[body].clone()),
            hill_radii: square.sqrt(),
            steps: *steps,
            resolved: *square >= CLOSE * CLOSE || *steps >= LEAST_STEPS,
        };
        // numbers of states that are about to be infinite have no time scale
        let is_known = |(_, found): &(&usize, &Closest)| found.square.is_finite() && found.steps.is_finite();
        self.light.iter().zip(&self.found).filter(is_known).map(one).collect()
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        let bodies = self.masses.len();
        list(to, &mut self.before, &[0.0; 3], |to, place| place.iter_mut().for_each(|x| to.double(x)));
        for Closest { square, n, planet, steps } in &mut self.found {
            to.double(square);
            to.whole(n);
            to.place(planet, bodies);
            to.double(steps);
        }
    }
}

/// How far a light body is from a planet after a step, at most, if its distance in the step, in which both go these
/// ways, counts, which it does up to `limit`.
#[inline(always)]
fn farthest(ways: f64, limit: f64) -> f64 {
    // of round-off
    const ALMOST: f64 = 1.0 + 1e-12;
    ALMOST * (ways + limit)
}

/// The squares of the ways of a body in the steps to some states, of which `before` is the place before the first one.
#[inline(always)]
fn squares_of_ways(before: Option<&Place>, [x, y, z]: &[Each; 3]) -> Each {
    let mut squares = Each::all(0.0);
    if let Some(before) = before {
        let [a, b, c] = [x.0[0] - before[0], y.0[0] - before[1], z.0[0] - before[2]];
        squares.0[0] = a * a + b * b + c * c;
    }
    for state in 1..STATES {
        let [a, b, c] = [x, y, z].map(|x| x.0[state] - x.0[state - 1]);
        squares.0[state] = a * a + b * b + c * c;
    }
    squares
}

/// The central body has ten times the mass of others.
const LEAST_CENTRAL: f64 = 0.1;

/// How many substeps a step has at a distance from a planet.
fn substeps(shells: Option<&(Shells, u32)>, distance: f64) -> f64 {
    let divided = |(shells, substeps): &(Shells, u32)| Some(f64::from(*substeps) * shells.division_at(distance)?);
    shells.and_then(divided).unwrap_or(1.0)
}

/// How many light bodies a text has.
const SHOWN: usize = 6;

/// The light bodies in words, those that are not resolved first, with the times of states in words.
pub fn text(bodies: &[LightBody], time: impl Fn(i64) -> String) -> Option<String> {
    let mut sorted: Vec<&LightBody> = bodies.iter().collect();
    sorted.sort_by(|a, b| a.resolved.cmp(&b.resolved).then(a.hill_radii.total_cmp(&b.hill_radii)));
    let one = |LightBody { n, bodies: [planet, body], hill_radii, steps, resolved }: &&LightBody| {
        let (radii, steps) = (significant(*hill_radii, 3), significant(*steps, 2));
        let word = if *resolved { "resolved" } else { "not resolved" };
        format!(
            "{body} {word}: {radii} Hill radii from {planet} at {}, {steps} steps in the local time scale",
            time(*n)
        )
    };
    let shown = sorted.iter().take(SHOWN).map(one).collect::<Vec<_>>().join("; ");
    let others = sorted.iter().skip(SHOWN);
    let [all, lost] = [others.clone().count(), others.filter(|body| !body.resolved).count()];
    let others = match (all, lost) {
        (0, _) => String::new(),
        (all, 0) => format!("; {all} others resolved"),
        (all, lost) => format!("; {all} others, of which {lost} are not resolved"),
    };
    (!bodies.is_empty()).then(|| shown + &others)
}

/// Why the verdict cannot be that all is well, if a light body is not resolved.
pub fn not_resolved(bodies: &[LightBody], time: impl Fn(i64) -> String) -> Option<String> {
    let lost: Vec<&LightBody> = bodies.iter().filter(|body| !body.resolved).collect();
    let one = |LightBody { n, bodies: [planet, body], steps, .. }: &&LightBody| {
        format!("{body} near {planet} at {} ({})", time(*n), significant(*steps, 2))
    };
    let shown = lost.iter().take(SHOWN).map(one).collect::<Vec<_>>().join(", ");
    let others = lost.len().saturating_sub(SHOWN);
    let others = if others > 0 { format!(" and {others} others") } else { String::new() };
    (!lost.is_empty()).then(|| {
        format!(
            "fewer than {LEAST_STEPS} steps in the local time scale of a light body, whose orbit is wrong afterwards \
             and has no part in the energy: {shown}{others}; use a smaller step size, or parts = \
             \"wisdom-holman-heliocentric\" with encounters = {{ within = … }} of some 3 Hill radii"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::observer::testing;
    use crate::watch::summary::Summary;
    use shadowstep::number::Lanes;

    /// A planet is left out only where no light body on straight ways comes below the limit in the step.
    #[test]
    fn no_approach_is_missed() {
        let mut seed = 5_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let (mut kept, mut left_out) = (0, 0);
        for _ in 0..3_000 {
            let mut place = |size: f64| std::array::from_fn::<f64, 3, _>(|_| size * random());
            // the central body, a planet, and light bodies
            let before: Vec<Place> = (0..7).map(|_| place(1.0)).collect();
            let mut ways = vec![before.clone()];
            for _ in 0..STATES {
                let next = |from: &Place| difference(from, &place(0.25));
                ways.push(ways[ways.len() - 1].iter().map(next).collect());
            }
            let bodies: Vec<[Each; 3]> = (0..7)
                .map(|body| std::array::from_fn(|axis| Lanes(std::array::from_fn(|state| ways[state + 1][body][axis]))))
                .collect();
            let part = 0.1 + random().abs() / 5.0;
            let found = Closest { square: 1.0 + 4.0 * random().abs(), ..Closest::NOTHING };
            let mut light = LightBodies {
                names: Vec::new(),
                masses: vec![1.0; 2],
                parts: vec![part; 2],
                scale: 1.0,
                h: 1.0,
                shells: None,
                light: (2..7).collect(),
                attracting: vec![1],
                before,
                ways: vec![Each::all(0.0); 7],
                radii: vec![Each::all(0.0)],
                limits: vec![CLOSE; 5],
                near: vec![[false; STATES]],
                found: vec![found; 5],
            };
            light.find_near(&bodies);
            let distance = |a: Place| dot(&a, &a).sqrt();
            for state in 0..STATES {
                let hill = part * distance(difference(&ways[state + 1][1], &ways[state + 1][0]));
                let counts = (2..7).any(|body| {
                    let [a, b] = [state, state + 1].map(|state| difference(&ways[state][body], &ways[state][1]));
                    let parts = (0..=100).map(|part| f64::from(part) / 100.0);
                    let least = parts
                        .map(|part| distance(std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis]))))
                        .fold(f64::INFINITY, f64::min);
                    least < hill * found.square.sqrt()
                });
                assert!(light.near[0][state] || !counts);
                kept += usize::from(counts);
                left_out += usize::from(!light.near[0][state]);
            }
        }
        assert!(kept > 500 && left_out > 5000, "{kept} {left_out}");
    }

    /// A comet that passes Jupiter at 0.023 Hill radii at t = 1.5375 years, with its semi-major axis after 5 years.
    fn comet(problem: &str, mass: &str, run: &str) -> (Summary, f64) {
        let text = format!(
            "[problem]\n{problem}\nunits = {{ length = \"AU\", time = \"year\", mass = \"solar\" }}\n[[body]]\nname \
                = \"sun\"\nmass = 1\n\
             [[body]]\nname = \"jupiter\"\nmass = \"1/1047.35\"\nq = [5.2, 0]\nv = [0, 2.756674112]\n\
             [[body]]\nname = \"comet\"\nmass = {mass}\nq = [3.4, -1]\nv = [1.88, 3.25]\n\
             [run]\n{run}\nuntil = 5\ndigits = \"double\"\n[output]\nvalues = {{ a = \"a(comet)\", every = 20 }}"
        );
        let scene = testing::read(&text);
        let last = testing::rows(&scene).pop().unwrap();
        (testing::summary(&scene), last.last().unwrap().parse().unwrap())
    }

    /// By IAS15 of REBOUND 5.2.2 with the same bodies and G; by 10⁵ steps of `saba4` 26.49986.
    const RIGHT: f64 = 26.499787;

    /// The energy is that of the Sun and Jupiter, whose error is bounded, whatever happens to the comet.
    #[test]
    fn a_light_body_that_is_not_resolved_is_named() {
        let inertial = ("parts = \"kinetic-potential\"", "scheme = \"yoshida4\"\nstep = \"1/20\"");
        for (mass, (problem, run)) in [
            ("0", ("parts = \"wisdom-holman\"", "scheme = \"saba4\"\nstep = \"1/20\"")),
            ("1e-14", ("parts = \"wisdom-holman\"", "scheme = \"saba4\"\nstep = \"1/20\"")),
            ("0", ("parts = \"wisdom-holman-heliocentric\"", "scheme = \"stormer-verlet\"\nstep = \"1/20\"")),
            ("0", inertial),
            ("1e-14", inertial),
        ] {
            let (found, a) = comet(problem, mass, run);
            let [comet] = &found.light[..] else { panic!("{found}") };
            assert!((a / RIGHT - 1.0).abs() > 0.01 && !comet.resolved && !found.is_bounded(), "{a}, {found}");
            assert!(comet.hill_radii < 0.1 && comet.steps < 1.0, "{comet:?}");
            assert!(found.reason().contains("comet near jupiter at t = 1."), "{found}");
            let text = found.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(text.contains("close encounters none of all bodies together"), "{text}");
        }
    }

    /// With encounters, and with steps that are short enough without them.
    #[test]
    fn a_light_body_that_is_resolved_is_so_with_its_orbit() {
        let shells = "parts = \"wisdom-holman-heliocentric\"\nencounters = { within = 1, substeps = 16 }";
        let verlet = "scheme = \"stormer-verlet\"\nstep = \"1/80\"";
        for (mass, problem, run) in [
            ("0", shells, verlet),
            ("1e-14", shells, verlet),
            ("0", "parts = \"wisdom-holman\"", "scheme = \"saba4\"\nstep = \"1/10000\""),
        ] {
            let (found, a) = comet(problem, mass, run);
            assert!(found.light[0].resolved, "{found}");
            assert!((a / RIGHT - 1.0).abs() < 1e-4, "{a}, {found}");
            assert!(mass != "0" || found.is_bounded(), "{found}");
        }
    }
}
