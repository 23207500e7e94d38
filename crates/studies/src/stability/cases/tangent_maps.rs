//! Tangent maps: areas that stay, and exponents that are known.

use shadowstep::tangent::{Exponent, Growth, Regularity};
use shadowstep::{Stepper, exact};
use shadowstep_scenes::tangent::{FollowingVectors, Vectors};

use crate::stability::area::{Areas, BLOCK, Change, Star};
use crate::stability::prelude::*;

/// The case.
pub(super) struct TangentMaps;

/// What theory says of the vectors of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
enum Kind {
    /// A map, whose exponents are known but for an error.
    Map { exponent: f64, within: f64 },
    /// Vectors grow like a power of t, which is half of the mean of MEGNO.
    Regular { megno: f64 },
    /// Exponents are the same for all schemes.
    Chaotic,
}

/// What was measured.
#[derive(Serialize, Deserialize)]
pub(super) enum Measured {
    Areas(Areas),
    Vectors(Grown),
}

/// How vectors grew.
#[derive(Serialize, Deserialize)]
pub(super) struct Grown {
    /// The exponents of as many vectors as are orthonormal, the largest first, or of one that is free: with their
    /// errors.
    exponents: Vec<[f64; 2]>,
    mean_megno: f64,
    regular: bool,
    time: f64,
}

impl Case for TangentMaps {
    type Measured = Measured;

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Measured, Error> {
        let (step, steps) = (exact(&trial.get::<String>("step")).expect("it is exact"), trial.steps());
        let h = step_size(step * Rational::from_integer(trial.evaluations().into()));
        if !has_vectors(trial) {
            let stepper = Stepper::new(trial.scheme().quadratic(), h).expect("it is positive");
            let block = |star: &mut Star| stepper.steps(std::slice::from_mut(star), BLOCK);
            return Ok(Measured::Areas(Areas::along(block, &trial.get::<Vec<u64>>("steps"), continues)));
        }
        let system = followed(trial);
        let vectors = match trial.get("kind") {
            Kind::Regular { .. } => Vectors::Free(1),
            Kind::Map { .. } | Kind::Chaotic => Vectors::Orthonormal(2 * system.coordinates.len()),
        };
        let stepping = steps_of(trial.scheme(), &h, Begin::Step);
        let mut run = FollowingVectors::new(trial.arithmetic, &system, stepping, (vectors, 1))?;
        for n in 1..=steps {
            run.step();
            if n.is_multiple_of(4096) && !continues(n as f64 / steps as f64) {
                break;
            }
        }
        Ok(Measured::Vectors(Grown::of(&run.end().growths())))
    }

    fn judge(all: &[&Done<'_, Measured>]) -> Vec<Row> {
        let sea = mean_exponent(all);
        let row = |Done { trial, found }: &&Done<'_, Measured>| match found {
            Measured::Vectors(grown) => {
                let (found, verdict) = trial.get::<Kind>("kind").judge(grown, trial.steps(), sea);
                Row::of(trial, format!("{}: {found}", trial.get::<String>("name")), verdict)
            }
            Measured::Areas(areas) => {
                let (found, verdict) = judge_areas(areas, trial.steps(), trial.evaluations());
                let steps = trial.get::<Vec<f64>>("steps");
                let points = steps.iter().zip(&areas.of_one_pair).filter(|(_, change)| change.area != 0.0);
                Row::of(trial, found, verdict).with(points.map(|(n, change)| (n.log10(), change.area.abs().log10())))
            }
        };
        all.iter().map(row).collect()
    }
}

/// Areas are followed along an orbit of their own.
fn has_vectors(trial: &Trial<'_>) -> bool {
    trial.get::<String>("followed") != "areas"
}

/// The system of vectors.
fn followed(trial: &Trial<'_>) -> System {
    match trial.get::<Option<String>>("formula") {
        Some(formula) => of_formula(&formula, &[], &["q"], (vec![rational(0.0)], vec![rational(0.0)])),
        None => {
            let set = trial.get::<Option<Vec<(String, String)>>>("set").unwrap_or_default();
            let set: Vec<_> = set.iter().map(|(name, value)| (name.as_str(), value.clone())).collect();
            shipped(&trial.get::<String>("problem"), &set)
        }
    }
}

impl Grown {
    fn of(growths: &[&Growth]) -> Grown {
        let exponent = |growth: &&Growth| {
            let Exponent { value, error } = growth.exponent().expect("there are enough observations");
            [value, error].map(finite)
        };
        Grown {
            exponents: growths.iter().map(exponent).collect(),
            mean_megno: finite(growths[0].mean_megno().expect("there are observations")),
            regular: growths[0].regularity() == Regularity::Regular,
            time: growths[0].time(),
        }
    }

    /// |λ₁ − expected| is at most this error, of which the scatter over the run is a part.
    fn is(&self, expected: f64, besides: f64) -> bool {
        let [value, error] = self.exponents[0];
        (value - expected).abs() <= 2.0 * error + besides
    }

    /// The largest sum of a pair, and whether all of them are 0 within the errors.
    fn pairs(&self) -> (f64, bool) {
        let pairs = self.exponents.iter().zip(self.exponents.iter().rev());
        let sums = pairs.map(|(a, b)| ((a[0] + b[0]).abs(), a[1] + b[1]));
        // round-off of sums of logarithms
        let within =
            |(largest, all): (f64, bool), (sum, error): (f64, f64)| (sum.max(largest), all && sum <= error + 1e-12);
        sums.fold((0.0, true), within)
    }
}

/// Of vectors that overflow, or of a state that does, the largest number.
fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { f64::MAX }
}

fn judge_areas(areas: &Areas, steps: u64, evaluations: u64) -> (String, Verdict) {
    let bound = |change: &Change| f64::EPSILON * change.size * (evaluations as f64).sqrt();
    let part = |change: &Change| change.area.abs() / bound(change);
    let last = areas.of_one_pair.last().map_or(f64::NAN, |change| change.area.abs());
    let one = areas.of_one_pair.iter().map(part).fold(0.0, f64::max);
    let many = part(&areas.of_many_pairs);
    let (steps, mean) = (steps as f64, areas.of_many_pairs.area.abs() / steps as f64);
    let found = format!(
        "{steps:.0e} steps, vectors of length {:.0e}: the area 1 changes by {last:.0e}, {one:.2} of the bound at \
         most; pairs of 100 steps: by {mean:.0e} a step in the mean, {many:.2} of the bound",
        areas.length,
    );
    (found, Verdict::from(one <= 1.0 && many <= 1.0))
}

/// The mean of the exponents of the chaotic sea.
fn mean_exponent(all: &[&Done<'_, Measured>]) -> f64 {
    let exponents = all.iter().filter_map(|one| match &one.found {
        Measured::Vectors(grown) if one.trial.get::<Kind>("kind") == Kind::Chaotic => Some(grown.exponents[0][0]),
        _ => None,
    });
    let exponents: Vec<f64> = exponents.collect();
    exponents.iter().sum::<f64>() / exponents.len() as f64
}

impl Kind {
    /// Beside the mean exponent of all schemes.
    fn judge(self, grown: &Grown, steps: u64, mean: f64) -> (String, Verdict) {
        let ([value, error], (sum, paired)) = (grown.exponents[0], grown.pairs());
        // not −0
        let rounded = |x: f64, unit: f64| (x / unit).round() * unit + 0.0;
        let found = format!("exponent {:.6} ± {error:.0e}", rounded(value, 1e-6));
        match self {
            Kind::Map { exponent, within } => {
                let found =
                    format!("{found} where {exponent:.6} is expected, sum of the pair {sum:.0e}, {steps} steps");
                (found, Verdict::from(grown.is(exponent, within) && paired))
            }
            Kind::Chaotic => {
                let found =
                    format!("{found}, mean of all schemes {mean:.4}; sums of pairs {sum:.0e} at most, {steps} steps");
                (found, Verdict::from(!grown.regular && (value - mean).abs() <= mean / 4.0 && paired))
            }
            Kind::Regular { megno } => {
                // over the last three quarters
                let expected = megno / 2.0 * (4.0 / 3.0 * 4_f64.ln() / grown.time);
                let found = format!(
                    "{found} where {expected:.6} is expected, mean MEGNO {:.4}, {steps} steps",
                    rounded(grown.mean_megno, 1e-4)
                );
                let near = (grown.mean_megno - megno).abs() <= 0.1;
                (found, Verdict::from(grown.regular && grown.is(expected, 0.0) && near))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects verdicts: what is not as theory predicts differs.

    use super::*;

    fn grown(exponents: &[f64], mean_megno: f64, regular: bool) -> Grown {
        Grown { exponents: exponents.iter().map(|value| [*value, 1e-4]).collect(), mean_megno, regular, time: 1e4 }
    }

    #[test]
    fn other_exponents_differ() {
        let cat = ((3.0 + 5_f64.sqrt()) / 2.0).ln();
        let cat_map = Kind::Map { exponent: cat, within: 1e-12 };
        let standard_map = Kind::Map { exponent: 50_f64.ln() / 10.0, within: 2e-4 };
        let [oscillator, pendulum] = [0.0, 2.0].map(|megno| Kind::Regular { megno });
        for (kind, exponents, mean_megno, regular, expected) in [
            (cat_map, &[cat, -cat][..], 500.0, false, Verdict::Agrees),
            (cat_map, &[cat + 1e-3, -cat - 1e-3], 500.0, false, Verdict::Differs),
            (cat_map, &[cat, -cat + 1e-3], 500.0, false, Verdict::Differs),
            (standard_map, &[0.3912, -0.3912], 500.0, false, Verdict::Agrees),
            (standard_map, &[0.392, -0.392], 500.0, false, Verdict::Differs),
            (pendulum, &[1.85e-4], 2.0, true, Verdict::Agrees),
            (pendulum, &[6e-4], 2.0, true, Verdict::Differs),
            (pendulum, &[1.85e-4], 2.2, true, Verdict::Differs),
            (pendulum, &[1.85e-4], 2.0, false, Verdict::Differs),
            (oscillator, &[0.0], 2.0, true, Verdict::Differs),
            (Kind::Chaotic, &[0.043, 0.0, 0.0, -0.043], 200.0, false, Verdict::Agrees),
            (Kind::Chaotic, &[0.03, 0.0, 0.0, -0.03], 200.0, false, Verdict::Differs),
            (Kind::Chaotic, &[0.043, 1e-3, 0.0, -0.043], 200.0, false, Verdict::Differs),
            (Kind::Chaotic, &[f64::MAX, 0.0, 0.0, 0.0], f64::MAX, false, Verdict::Differs),
        ] {
            let found = kind.judge(&grown(exponents, mean_megno, regular), 1000, 0.045).1;
            assert_eq!(found, expected, "{kind:?}: {exponents:?}, {mean_megno}, {regular}");
        }
    }

    #[test]
    fn areas_that_change_by_more_than_round_off_differ() {
        let change = |area: f64| Change { area, size: 1e6 };
        let verdict = |one: f64, many: f64| {
            let areas = Areas { of_one_pair: vec![change(one)], of_many_pairs: change(many), length: 1e3 };
            judge_areas(&areas, 1_000_000, 4).1
        };
        // 2e6 ε = 4.4e-10
        assert_eq!(verdict(4e-10, -4e-10), Verdict::Agrees);
        assert_eq!(verdict(5e-10, 0.0), Verdict::Differs);
        assert_eq!(verdict(0.0, -5e-10), Verdict::Differs);
        assert_eq!(verdict(f64::MAX, 0.0), Verdict::Differs);
    }
}
