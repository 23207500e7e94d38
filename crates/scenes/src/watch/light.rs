//! Light bodies that come close to planets: whether the steps resolve what turns their orbits, as the energy does not
//! show it.

use serde::Serialize;
use shadowstep::number::saved::{Fields, list};
use shadowstep::systems::wisdom_holman::Shells;
use shadowstep::{Number, Rational};
use shadowstep_schemes::symbolic::decimal::significant;

use super::places::Places;
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

type Place = [f64; 3];

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
    /// All bodies after the last step, and before it.
    now: Vec<Place>,
    before: Vec<Place>,
    found: Vec<Closest>,
    near: Near,
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
        let names = system.coordinates.iter().step_by(dimensions);
        let encounters = planets.as_ref().and_then(|planets| planets.encounters.as_ref());
        let shells = encounters.map(|near| (near.shells.clone(), near.substeps));
        Some(LightBodies {
            names: names.map(|name| name.trim_start_matches('x').trim_start_matches('_').to_owned()).collect(),
            scale: 1.0 / (3.0 * number(&g) * masses[0]),
            parts: masses.iter().map(|mass| (mass / (3.0 * masses[0])).cbrt()).collect(),
            h: h.abs(),
            shells,
            attracting: (1..masses.len())
                .filter(|planet| light.iter().any(|body| masses.get(*body).is_none_or(|mass| *mass < masses[*planet])))
                .collect(),
            found: vec![Closest::NOTHING; light.len()],
            near: Near::new(light.len()),
            light,
            masses,
            now: Vec::new(),
            before: Vec::new(),
        })
    }

    /// Takes the state n after the last one.
    pub(super) fn include(&mut self, n: i64, places: &Places) {
        let LightBodies { now, before, .. } = self;
        std::mem::swap(now, before);
        now.clear();
        for (bodies, origin) in [(places.inertial(), places.origin()), (places.particles(), [0.0; 3])] {
            match places.dimensions {
                3 => extend::<3>(now, bodies, origin),
                2 => extend::<2>(now, bodies, origin),
                _ => extend::<1>(now, bodies, origin),
            }
        }
        if self.before.len() == self.now.len() {
            self.find_approaches(n);
        }
    }

    /// The least distances in the last step, in which bodies move straight.
    fn find_approaches(&mut self, n: i64) {
        self.near.take(&self.light, [&self.before, &self.now], &self.found);
        for place in 0..self.attracting.len() {
            let planet = self.attracting[place];
            let radius = length(difference(&self.now[planet], &self.now[0]));
            let hill = self.parts[planet] * radius;
            let way = length(difference(&self.now[planet], &self.before[planet]));
            if self.near.find(&self.now[planet], way, hill) {
                // √(R³/Gm) of the Hill radius R
                let time = (radius.powi(3) * self.scale).sqrt();
                self.approach(n, planet, (hill, time));
            }
        }
    }

    /// The least distances from a planet, of its Hill radius.
    fn approach(&mut self, n: i64, planet: usize, (hill, time): (f64, f64)) {
        let LightBodies { masses, h, shells, light, now, before, found, near, .. } = self;
        for ((body, found), is_near) in light.iter().zip(found).zip(&near.found) {
            if !is_near || *body < masses.len() && masses[*body] >= masses[planet] {
                continue;
            }
            let [a, b] = [&*before, &*now].map(|places| difference(&places[*body], &places[planet]));
            let moved = difference(&b, &a);
            let square = dot(&moved, &moved);
            let part = if square > 0.0 { (-dot(&a, &moved) / square).clamp(0.0, 1.0) } else { 1.0 };
            let nearest: Place = std::array::from_fn(|axis| a[axis] + part * moved[axis]);
            let distance = dot(&nearest, &nearest);
            let radii = distance / (hill * hill);
            let is_close = radii < CLOSE * CLOSE;
            let is_closest = radii < found.square;
            if !is_close && !is_closest {
                continue;
            }
            let distance = distance.sqrt();
            let free_fall = radii.powf(0.75) * time / *h;
            let steps = (distance / square.sqrt()).min(free_fall) * substeps(shells.as_ref(), distance);
            let was_close = found.square < CLOSE * CLOSE;
            found.steps = if is_close && was_close { found.steps.min(steps) } else { steps };
            if is_closest {
                *found = Closest { square: radii, n, planet, steps: found.steps };
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
        list(to, &mut self.now, &[0.0; 3], |to, place| place.iter_mut().for_each(|x| to.double(x)));
        for Closest { square, n, planet, steps } in &mut self.found {
            to.double(square);
            to.whole(n);
            to.place(planet, bodies);
            to.double(steps);
        }
    }
}

/// Appends places relative to an origin.
fn extend<const D: usize>(places: &mut Vec<Place>, bodies: &[f64], origin: Place) {
    places.extend(bodies.as_chunks::<D>().0.iter().map(|body| {
        let mut place = [0.0; 3];
        (0..D).for_each(|axis| place[axis] = body[axis] - origin[axis]);
        place
    }));
}

/// Light bodies computed at once.
const BLOCK: usize = 4;

/// Finds planets that may have a light body so near that its distance counts, without a root or a division: most have
/// none.
struct Near {
    /// Of light bodies by axis, with more so that there are whole blocks.
    places: [Vec<f64>; 3],
    /// Their ways in the last step.
    ways: Vec<f64>,
    /// Distances count that are below this, in Hill radii.
    limits: Vec<f64>,
    /// Whether they may be so near to a planet.
    found: Vec<bool>,
}

impl Near {
    fn new(light: usize) -> Self {
        let zeros = || vec![0.0; light.next_multiple_of(BLOCK)];
        Near {
            places: std::array::from_fn(|_| zeros()),
            ways: zeros(),
            limits: zeros(),
            found: vec![false; light.next_multiple_of(BLOCK)],
        }
    }

    fn take(&mut self, light: &[usize], [before, now]: [&[Place]; 2], found: &[Closest]) {
        for (own, (body, found)) in light.iter().zip(found).enumerate() {
            self.places.iter_mut().zip(now[*body]).for_each(|(axis, x)| axis[own] = x);
            self.ways[own] = length(difference(&now[*body], &before[*body]));
            self.limits[own] = found.square.sqrt().max(CLOSE);
        }
    }

    /// Finds those that may be near a planet, if there is one: after a step the distance is at most the least one in it
    /// and the ways of both.
    fn find(&mut self, [own_x, own_y, own_z]: &Place, way: f64, hill_radius: f64) -> bool {
        // of round-off
        const ALMOST: f64 = 1.0 + 1e-12;
        let [x, y, z] = self.places.each_ref().map(|axis| axis.as_chunks::<BLOCK>().0);
        let (ways, limits) = (self.ways.as_chunks::<BLOCK>().0, self.limits.as_chunks::<BLOCK>().0);
        let (found, mut any) = (self.found.as_chunks_mut::<BLOCK>().0, false);
        for block in 0..x.len() {
            for i in 0..BLOCK {
                let (a, b, c) = (x[block][i] - own_x, y[block][i] - own_y, z[block][i] - own_z);
                let most = ALMOST * (ways[block][i] + way + limits[block][i] * hill_radius);
                found[block][i] = a * a + b * b + c * c < most * most;
                any |= found[block][i];
            }
        }
        any
    }
}

/// The central body has ten times the mass of others.
const LEAST_CENTRAL: f64 = 0.1;

/// How many substeps a step has at a distance from a planet.
fn substeps(shells: Option<&(Shells, u32)>, distance: f64) -> f64 {
    let divided = |(shells, substeps): &(Shells, u32)| Some(f64::from(*substeps) * shells.division_at(distance)?);
    shells.and_then(divided).unwrap_or(1.0)
}

fn difference(a: &Place, b: &Place) -> Place {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: &Place, b: &Place) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn length(a: Place) -> f64 {
    dot(&a, &a).sqrt()
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
    use crate::Scene;
    use crate::watch::observer::KeptSummary;
    use crate::watch::summary::Summary;
    use shadowstep::tables::Source;

    /// A planet is left out only where no light body on straight ways comes below the limit in the step.
    #[test]
    fn no_approach_is_missed() {
        let mut seed = 5_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let (mut kept, mut left_out) = (0, 0);
        for _ in 0..20_000 {
            let mut place = || std::array::from_fn::<f64, 3, _>(|_| random());
            let before: Vec<Place> = (0..6).map(|_| place()).collect();
            let now: Vec<Place> = before
                .iter()
                .map(|own| {
                    let way = place();
                    std::array::from_fn(|axis| own[axis] + way[axis] / 4.0)
                })
                .collect();
            let hill = 0.05 + random().abs() / 10.0;
            let found = Closest { square: 1.0 + 4.0 * random().abs(), ..Closest::NOTHING };
            let mut near = Near::new(5);
            near.take(&[1, 2, 3, 4, 5], [&before, &now], &[found; 5]);
            let is_near = near.find(&now[0], length(difference(&now[0], &before[0])), hill);
            let counts = (1..6).any(|body| {
                let [a, b] = [&before, &now].map(|places| difference(&places[body], &places[0]));
                let parts = (0..=100).map(|part| f64::from(part) / 100.0);
                let least = parts
                    .map(|part| length(std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis]))))
                    .fold(f64::INFINITY, f64::min);
                least < hill * found.square.sqrt()
            });
            assert!(is_near || !counts);
            kept += usize::from(counts);
            left_out += usize::from(!is_near);
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
        let (mut rows, mut keep) = (Vec::new(), KeptSummary::default());
        let scene = Scene::read(Source { path: "test.toml".to_owned(), text }).unwrap();
        scene.run_into(&mut rows, &mut keep).unwrap();
        let rows = String::from_utf8(rows).unwrap();
        (keep.0.unwrap(), rows.trim_end().rsplit(',').next().unwrap().parse().unwrap())
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
