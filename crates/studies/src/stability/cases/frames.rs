//! Rotated, translated and moving frames, other units, masses over twelve orders.

use shadowstep_scenes::KineticEnergy;

use crate::stability::prelude::*;

/// The case.
pub(super) struct Frames;

/// How the two bodies of masses 1 and m are described.
#[derive(Clone, Copy)]
struct Frame {
    rotated: bool,
    moved: f64,
    velocity: f64,
    length: f64,
    mass: f64,
}

/// What a run has shown.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Measured {
    /// The largest |H − H(0)| as a part of the energy of the relative motion.
    energy_error: f64,
    /// The relative position at the end, turned, moved and scaled back.
    relative: [f64; 2],
}

/// The eccentricity of the orbit is 0.6, with steps of a fortieth of a unit of time for each evaluation.
const STEPS_A_UNIT: f64 = 100.0;
/// That at the pericentre, 1/0.4².
const LARGEST_FORCE: f64 = 6.25;
/// The energy error of another frame may differ by this factor.
const SAME: f64 = 1.01;

impl Case for Frames {
    type Measured = Measured;

    fn measure(trial: &Trial<'_>, _: Continues<'_>) -> Result<Measured, Error> {
        let frame = Frame::of(trial);
        let Frame { mass, length, .. } = frame;
        // a = 1, G = 1: the period is 2π/√(m₁ + m₂)
        let total = 1.0 + mass;
        let time = (length * length * length / total).sqrt();
        let h = step_size(trial.evaluations() as f64 / STEPS_A_UNIT * time);
        let (q, p) = frame.start(total);
        let state = (q.map(rational).to_vec(), p.map(rational).to_vec());
        let mut system = of_formula(FORMULA, &[("m", rational(mass))], &["x1", "y1", "x2", "y2"], state);
        system.problem.kinetic = KineticEnergy::Masses(Some(known_values([1.0, 1.0, mass, mass].map(rational))));
        let mut run = trial.start(&system, &h);
        // of an ellipse with a = 1
        let internal = mass / (2.0 * length);
        let mut energy_error = 0.0_f64;
        for _ in 0..trial.steps() {
            run.step();
            energy_error = energy_error.max((run.energy_change() / internal).abs());
        }
        let difference = |i: usize| run.separation(i + 2, i) / length;
        Ok(Measured { energy_error, relative: frame.turned_back([difference(0), difference(1)]) })
    }

    fn judge(all: &[&Done<'_, Measured>]) -> Vec<Row> {
        let named = |one: &Done<'_, Measured>| one.trial.get::<Option<String>>("named");
        let Some(Done { trial, found: plain }) = all.iter().find(|one| named(one).is_none()) else {
            return Vec::new();
        };
        let others: Vec<_> = all.iter().filter_map(|one| Some((named(one)?, one))).collect();
        let found = format!(
            "error of H {:.1e} in all frames; distance of the end from that of the plain frame: {}",
            plain.energy_error,
            joined(&others, ", ", |(named, one)| format!("{named} {:.0e}", one.found.distance(plain)))
        );
        // where coordinates of size L lose digits, H does as well
        let roundings = trial.steps() as f64 * trial.evaluations() as f64;
        let verdict = |(_, one): &(String, &&Done<'_, Measured>)| {
            let lost = Frame::of(&one.trial).round_off(roundings, roundings / STEPS_A_UNIT) / plain.energy_error;
            Verdict::from((one.found.energy_error / plain.energy_error - 1.0).abs() <= SAME - 1.0 + lost)
        };
        let moved = all.iter().filter_map(|one| Some((one.trial.get::<Option<f64>>("moved")?.log10(), one)));
        let points = moved.map(|(moved, one)| (moved, one.found.distance(plain).log10()));
        vec![Row::of(trial, found, Verdict::of_all(others.iter().map(verdict))).with(points)]
    }
}

impl Measured {
    /// The distance of the ends.
    fn distance(&self, other: &Measured) -> f64 {
        (self.relative[0] - other.relative[0]).hypot(self.relative[1] - other.relative[1])
    }
}

const FORMULA: &str = "-m/sqrt((x1 - x2)^2 + (y1 - y2)^2)";

impl Frame {
    fn of(trial: &Trial<'_>) -> Frame {
        let value = |name: &str, other: f64| trial.get::<Option<f64>>(name).unwrap_or(other);
        let rotated = trial.get::<Option<bool>>("rotated").unwrap_or(false);
        let [moved, velocity] = ["moved", "velocity"].map(|name| value(name, 0.0));
        Frame { rotated, moved, velocity, length: value("length", 1.0), mass: value("mass", 1.0) }
    }

    /// The part of H that a number of roundings of coordinates changes over this time, by Brouwer's law with the
    /// largest force.
    fn round_off(self, roundings: f64, duration: f64) -> f64 {
        let moved = self.moved + self.velocity * duration;
        let size = if moved > 0.0 { moved } else { 1.0 };
        roundings.sqrt() * f64::EPSILON * size * LARGEST_FORCE
    }

    /// Positions and momenta at the pericentre, with the centre of mass at rest.
    fn start(self, total: f64) -> ([f64; 4], [f64; 4]) {
        let Frame { moved, velocity: v, length, mass, .. } = self;
        // of the relative motion with e = 0.6
        let distance = 0.4 * length;
        let speed = (total / length).sqrt() * 2.0;
        let (one, other) = (-distance * mass / total, distance / total);
        let momentum = speed * mass / total;
        let (cos, sin) = if self.rotated { (0.6, 0.8) } else { (1.0, 0.0) };
        let q = [one * cos + moved, one * sin + moved, other * cos + moved, other * sin + moved];
        (q, [momentum * sin + v, v - momentum * cos, mass * v - momentum * sin, mass * v + momentum * cos])
    }

    fn turned_back(self, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.rotated { [0.6 * x + 0.8 * y, 0.6 * y - 0.8 * x] } else { [x, y] }
    }
}
