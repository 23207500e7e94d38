//! Rotated, translated and moving frames, other units, masses over twelve orders.

use serde::{Deserialize, Serialize};
use shadowstep::Scheme;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::start::Begin;
use shadowstep_scenes::{Error, KineticEnergy};
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::integrator::{start_in, step_size, steps_of};
use crate::suite::{Examined, Suite};
use crate::systems::{known_values, of_formula, rational};

/// The case.
pub(super) struct Frames;

/// Two bodies of masses 1 and 1/m on a line of sight, in some frame.
#[derive(Clone, Serialize)]
pub(super) struct Trial {
    scheme: String,
    frame: Frame,
    steps: u64,
}

/// How the two bodies are described.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) enum Frame {
    /// As they are.
    Plain,
    /// Turned by the angle of (3, 4, 5), exactly.
    Rotated,
    /// Moved by this distance in both directions.
    Translated(f64),
    /// Moving with this velocity in both directions.
    Moving(f64),
    /// Lengths in units of this; masses and times so that G = 1.
    Units(f64),
    /// The second body's mass is this.
    Mass(f64),
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
const STEPS_A_UNIT: i64 = 100;
/// That at the pericentre, 1/0.4².
const LARGEST_FORCE: f64 = 6.25;
/// The energy error of another frame may differ by this factor.
const SAME: f64 = 1.01;
const SCHEMES: [&str; 3] = ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b"];
const FRAMES: [Frame; 13] = [
    Frame::Plain,
    Frame::Rotated,
    Frame::Translated(1.0),
    Frame::Translated(1e2),
    Frame::Translated(1e4),
    Frame::Translated(1e6),
    Frame::Translated(1e8),
    Frame::Moving(10.0),
    Frame::Units(1e12),
    Frame::Units(1e-12),
    Frame::Mass(1e-6),
    Frame::Mass(1e-12),
    Frame::Mass(1e6),
];

impl Case for Frames {
    const NAME: &'static str = "frames";
    const TITLE: &'static str = "Rotated, translated and moving frames, units, masses";
    const THEORY: &'static str = "A splitting scheme commutes with rotations, translations, motions of the frame and \
        changes of units, so that the error of H is the same in all frames, up to round-off. That of a coordinate of \
        size L is εL a step: from an offset of 1e8 positions keep eight digits of sixteen. Of two bodies the relative \
        motion depends on the total mass only.";
    const REVISION: u32 = 3;

    type Trial = Trial;
    type Measured = Measured;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let steps = suite.full_or_quick(100_000, 10_000);
        let of = |scheme: &&Examined| FRAMES.map(|frame| Trial { scheme: scheme.identity.clone(), frame, steps });
        suite.schemes_or(&SCHEMES).iter().flat_map(of).collect()
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        trial.steps as f64 * suite.scheme(&trial.scheme).scheme.summary().evaluations as f64 * 300e-9
    }

    fn measure(suite: &Suite, trial: &Trial, arithmetic: Arithmetic, _: Continues<'_>) -> Result<Measured, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let (mass, length) = (trial.frame.mass(), trial.frame.length());
        // a = 1, G = 1: the period is 2π/√(m₁ + m₂)
        let total = 1.0 + mass;
        let time = (length * length * length / total).sqrt();
        let h = scheme.scheme.summary().evaluations as f64 / STEPS_A_UNIT as f64 * time;
        let (q, p) = trial.frame.start(length, total);
        let state = (q.map(rational).to_vec(), p.map(rational).to_vec());
        let mut system = of_formula(FORMULA, &[("m", rational(mass))], &["x1", "y1", "x2", "y2"], state);
        system.problem.kinetic = KineticEnergy::Masses(Some(known_values([1.0, 1.0, mass, mass].map(rational))));
        let mut run = start_in(arithmetic, &system, steps_of(scheme, &step_size(h), Begin::Step));
        // of an ellipse with a = 1
        let internal = mass / (2.0 * length);
        let mut energy_error = 0.0_f64;
        for _ in 0..trial.steps {
            run.step();
            energy_error = energy_error.max((run.energy_change() / internal).abs());
        }
        let difference = |i: usize| run.separation(i + 2, i) / length;
        let relative = trial.frame.turned_back([difference(0), difference(1)]);
        Ok(Measured { energy_error, relative })
    }

    fn judge(suite: &Suite, measured: &[(Trial, Measured)]) -> Finding {
        let (mut finding, mut curves) = (Finding::default(), Vec::new());
        for all in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let Some((_, plain)) = all.iter().find(|(trial, _)| trial.frame == Frame::Plain) else { continue };
            let evaluations = suite.scheme(&all[0].0.scheme).scheme.summary().evaluations as f64;
            let (mut parts, mut verdicts) = (Vec::new(), Vec::new());
            for (trial, one) in all.iter().filter(|(trial, _)| trial.frame != Frame::Plain) {
                let ratio = one.energy_error / plain.energy_error;
                parts.push(format!("{} {:.0e}", trial.frame.described(), one.distance(plain)));
                // where coordinates of size L lose digits, H does as well
                let roundings = trial.steps as f64 * evaluations;
                let lost = trial.frame.round_off(roundings, roundings / STEPS_A_UNIT as f64) / plain.energy_error;
                verdicts.push(Verdict::from((ratio - 1.0).abs() <= SAME - 1.0 + lost));
            }
            let found = format!(
                "error of H {:.1e} in all frames; distance of the end from that of the plain frame: {}",
                plain.energy_error,
                parts.join(", ")
            );
            let name = &suite.scheme(&all[0].0.scheme).name;
            finding.check(name, found, Verdict::of_all(verdicts));
            let point = |(trial, one): &(Trial, Measured)| match trial.frame {
                Frame::Translated(distance) => Some((distance.log10(), one.distance(plain).log10())),
                _ => None,
            };
            curves.push(Curve::marked(name.clone(), all.iter().filter_map(point).collect(), curves.len()));
        }
        let (x, y) =
            (Axis::log10("distance of the origin"), Axis::log10("distance of the end from that at the origin"));
        finding.chart(Chart::new("What a distant origin costs", x, y, curves), "The orbit has the size 1.");
        finding
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
    fn mass(self) -> f64 {
        match self {
            Frame::Mass(mass) => mass,
            _ => 1.0,
        }
    }

    fn length(self) -> f64 {
        match self {
            Frame::Units(length) => length,
            _ => 1.0,
        }
    }

    /// The part of H that a number of roundings of coordinates changes over this time, by Brouwer's law with the
    /// largest force.
    fn round_off(self, roundings: f64, duration: f64) -> f64 {
        let size = match self {
            Frame::Translated(distance) => distance,
            Frame::Moving(velocity) => velocity * duration,
            _ => 1.0,
        };
        roundings.sqrt() * f64::EPSILON * size * LARGEST_FORCE
    }

    /// Positions and momenta at the pericentre, with the centre of mass at rest.
    fn start(self, length: f64, total: f64) -> ([f64; 4], [f64; 4]) {
        let mass = self.mass();
        // of the relative motion with e = 0.6
        let distance = 0.4 * length;
        let speed = (total / length).sqrt() * 2.0;
        let (one, other) = (-distance * mass / total, distance / total);
        let momentum = speed * mass / total;
        let (cos, sin) = if self == Frame::Rotated { (0.6, 0.8) } else { (1.0, 0.0) };
        let moved = if let Frame::Translated(distance) = self { distance } else { 0.0 };
        let q = [one * cos + moved, one * sin + moved, other * cos + moved, other * sin + moved];
        let v = if let Frame::Moving(velocity) = self { velocity } else { 0.0 };
        (q, [momentum * sin + v, v - momentum * cos, mass * v - momentum * sin, mass * v + momentum * cos])
    }

    fn turned_back(self, [x, y]: [f64; 2]) -> [f64; 2] {
        if self == Frame::Rotated { [0.6 * x + 0.8 * y, 0.6 * y - 0.8 * x] } else { [x, y] }
    }

    fn described(self) -> String {
        match self {
            Frame::Plain => "plain".to_owned(),
            Frame::Rotated => "rotated".to_owned(),
            Frame::Translated(distance) => format!("moved by {distance:.0e}"),
            Frame::Moving(velocity) => format!("moving by {velocity:.0e}"),
            Frame::Units(length) => format!("lengths × {length:.0e}"),
            Frame::Mass(mass) => format!("masses 1 and {mass:.0e}"),
        }
    }
}
