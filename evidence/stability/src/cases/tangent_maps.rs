//! Tangent maps: areas that stay, and exponents that are known.

use serde::{Deserialize, Serialize};
use shadowstep::tangent::{Exponent, Growth, Regularity};
use shadowstep::{Rational, Scheme, Stepper};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::start::Begin;
use shadowstep_scenes::tangent::{FollowingVectors, Vectors};
use shadowstep_scenes::{Error, System};
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::area::{Areas, BLOCK, Change, Star};
use crate::case::{Case, MOST_CURVES};
use crate::integrator::{step_size, steps_of};
use crate::suite::{Examined, OF_ORDERS_2_TO_8, Suite};
use crate::systems::{of_formula, shipped};

/// The case.
pub(super) struct TangentMaps;

/// A scheme and what it follows.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    followed: Followed,
    /// Numbers of steps, the largest one last.
    steps: Vec<u64>,
}

/// What a trial follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Followed {
    /// Areas of pairs of vectors along a regular orbit of Hénon and Heiles' potential, in double precision.
    Areas,
    /// U = −q²/2 with h = 1: (q, p) ← ((2, 1), (1, 1)) (q, p), or a map that is conjugate to it.
    CatMap,
    /// The pendulum with h² = K = 100.
    StandardMap,
    /// A harmonic oscillator.
    Oscillator,
    /// A Kepler orbit.
    Kepler,
    /// A pendulum that swings.
    Pendulum,
    /// An orbit within the chaotic sea of Hénon and Heiles' potential at the energy 1/8.
    ChaoticSea,
}

use Followed::{CatMap, ChaoticSea, Kepler, Oscillator, Pendulum, StandardMap};

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

/// Schemes whose steps for T + U are the standard map, or a map that is conjugate to it.
const MAPS: [&str; 2] = ["symplectic-euler", "stormer-verlet"];

/// K of the standard map. log(K/2) is the mean of log|K cos q|, to which its exponent tends for large K: with an error
/// of order 1/K².
const K: f64 = 100.0;

impl Followed {
    fn system(self) -> System {
        let with = |name: &str, set: &[(&str, &str)]| {
            let set: Vec<_> = set.iter().map(|(name, value)| (*name, (*value).to_owned())).collect();
            shipped(name, &set)
        };
        match self {
            CatMap => {
                let zero = || vec![Rational::from_integer(0.into())];
                of_formula("-q^2/2", &[], &["q"], (zero(), zero()))
            }
            StandardMap | Pendulum => with("pendulum", &[]),
            Oscillator => with("harmonic-oscillator", &[]),
            Kepler => with("kepler", &[]),
            ChaoticSea | Followed::Areas => with("henon-heiles", &[("y", "-1/4"), ("px", "sqrt(1/4 - 1/16 - 1/96)")]),
        }
    }

    /// The step size of a scheme.
    fn step(self, evaluations: usize) -> Rational {
        let parts = match self {
            CatMap => return Rational::from_integer(1.into()),
            StandardMap => return Rational::from_integer((K.sqrt() as i64).into()),
            Kepler => 200,
            Followed::Areas | Oscillator | Pendulum | ChaoticSea => 40,
        };
        Rational::new(evaluations.into(), parts.into())
    }

    fn vectors(self, system: &System) -> Vectors {
        match self {
            CatMap | StandardMap | ChaoticSea => Vectors::Orthonormal(2 * system.coordinates.len()),
            _ => Vectors::Free(1),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Followed::Areas => "areas",
            CatMap => "cat map",
            StandardMap => "standard map, K = 100",
            Oscillator => "oscillator",
            Kepler => "Kepler",
            Pendulum => "pendulum",
            ChaoticSea => "Hénon–Heiles, E = 1/8",
        }
    }
}

impl Trial {
    fn longest(&self) -> u64 {
        *self.steps.last().expect("there are some")
    }
}

impl Case for TangentMaps {
    const NAME: &'static str = "tangent-maps";
    const TITLE: &'static str = "Tangent maps and Lyapunov exponents";
    const THEORY: &'static str = "The derivative M of a step is symplectic: the area δq₁·δp₂ − δp₁·δq₂ of two tangent \
        vectors stays. Round-off in double precision adds at most ε √(evaluations Σ (|δ₁| |δ₂|)²) to it, with the sum \
        over all steps, which along a regular orbit grows like n^{5/2}; pairs that are replaced after 100 steps stay \
        short, and the sum of their changes shows the least deviation in the mean. Arnold's cat map is a step of U = \
        −q²/2, with the exponents ±log((3 + √5)/2). A step of the pendulum is the standard map with K = h²; for large \
        K its exponents are ±log(K/2). Where motion is regular vectors grow like t, so that the exponent over the \
        last three quarters of T is (4/3) log 4/T, and MEGNO tends to 2; both are 0 for a harmonic oscillator. \
        Exponents of a chaotic orbit are pairs ±λ and ±0, the same for all schemes.";
    const REVISION: u32 = 1;

    type Trial = Trial;
    type Measured = Measured;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let trial = |examined: &Examined, followed, steps| Trial { scheme: examined.identity.clone(), followed, steps };
        let decades: Vec<u64> = (2..=suite.full_or_quick(7, 4)).map(|decade| 10_u64.pow(decade)).collect();
        let areas = suite.schemes_or_all().into_iter().map(|scheme| trial(scheme, Followed::Areas, decades.clone()));
        let maps =
            suite.schemes_or(&MAPS).into_iter().filter(|scheme| MAPS.contains(&scheme.name())).flat_map(|scheme| {
                let steps = suite.full_or_quick(1_000_000, 20_000);
                [trial(scheme, CatMap, vec![1000]), trial(scheme, StandardMap, vec![steps])]
            });
        let orbits = suite.schemes_or(&OF_ORDERS_2_TO_8).into_iter().flat_map(|scheme| {
            let evaluations = scheme.scheme.scheme.summary().evaluations as u64;
            let regular = [Oscillator, Kepler, Pendulum]
                .map(|followed| trial(scheme, followed, vec![suite.full_or_quick(200_000, 20_000)]));
            // t = 10⁵ or 10⁴
            let sea = trial(scheme, ChaoticSea, vec![40 * suite.full_or_quick(100_000, 10_000) / evaluations]);
            regular.into_iter().chain([sea])
        });
        areas.chain(maps).chain(orbits).collect()
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        trial.longest() as f64 * suite.scheme(&trial.scheme).scheme.summary().evaluations as f64 * 50e-9
    }

    fn measure(
        suite: &Suite,
        trial: &Trial,
        arithmetic: Arithmetic,
        continues: Continues<'_>,
    ) -> Result<Measured, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let h = step_size(trial.followed.step(scheme.scheme.summary().evaluations));
        if trial.followed == Followed::Areas {
            let stepper = Stepper::new(scheme.quadratic(), h).expect("it is positive");
            let block = |star: &mut Star| stepper.steps(std::slice::from_mut(star), BLOCK);
            return Ok(Measured::Areas(Areas::along(block, &trial.steps, continues)));
        }
        let system = trial.followed.system();
        let vectors = trial.followed.vectors(&system);
        let mut run = FollowingVectors::new(arithmetic, &system, steps_of(scheme, &h, Begin::Step), (vectors, 1))?;
        let steps = trial.longest();
        for n in 1..=steps {
            run.step();
            if n.is_multiple_of(4096) && !continues(n as f64 / steps as f64) {
                break;
            }
        }
        Ok(Measured::Vectors(Grown::of(&run.end().growths())))
    }

    fn judge(suite: &Suite, measured: &[(Trial, Measured)]) -> Finding {
        let mut finding = Finding::default();
        let sea = mean_exponent(measured);
        for (trial, measured) in measured {
            let named = suite.scheme(&trial.scheme);
            let (found, verdict) = match measured {
                Measured::Areas(areas) => judge_areas(areas, trial.longest(), named.scheme.summary().evaluations),
                Measured::Vectors(grown) => trial.followed.judge(grown, trial.longest(), sea),
            };
            finding.check(&named.name, found, verdict);
        }
        let areas = measured.iter().filter_map(|(trial, measured)| match measured {
            Measured::Areas(areas) => Some((trial, areas)),
            Measured::Vectors(_) => None,
        });
        let curve = |(i, (trial, areas)): (usize, (&Trial, &Areas))| {
            let points = trial.steps.iter().zip(&areas.of_one_pair).filter(|(_, change)| change.area != 0.0);
            let points = points.map(|(n, change)| ((*n as f64).log10(), change.area.abs().log10())).collect();
            Curve::marked(suite.scheme(&trial.scheme).name.clone(), points, i)
        };
        let (x, y) = (Axis::log10("steps"), Axis::log10("change of the area, at first 1"));
        let curves = areas.take(MOST_CURVES).enumerate().map(curve).collect();
        finding.chart(
            Chart::new("The area of a pair of tangent vectors", x, y, curves),
            "Along a regular orbit of Hénon and Heiles' potential, where both vectors grow like n.",
        );
        finding
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

fn judge_areas(areas: &Areas, steps: u64, evaluations: usize) -> (String, Verdict) {
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
fn mean_exponent(measured: &[(Trial, Measured)]) -> f64 {
    let exponents = measured.iter().filter_map(|(trial, measured)| match measured {
        Measured::Vectors(grown) if trial.followed == ChaoticSea => Some(grown.exponents[0][0]),
        _ => None,
    });
    let exponents: Vec<f64> = exponents.collect();
    exponents.iter().sum::<f64>() / exponents.len() as f64
}

impl Followed {
    fn judge(self, grown: &Grown, steps: u64, sea: f64) -> (String, Verdict) {
        let ([value, error], (sum, paired)) = (grown.exponents[0], grown.pairs());
        // not −0
        let rounded = |x: f64, unit: f64| (x / unit).round() * unit + 0.0;
        let exponent = format!("{}: exponent {:.6} ± {error:.0e}", self.name(), rounded(value, 1e-6));
        let regular = |expected: f64, megno: f64| {
            let mean = rounded(grown.mean_megno, 1e-4);
            let found = format!("{exponent} where {expected:.6} is expected, mean MEGNO {mean:.4}, {steps} steps");
            (found, Verdict::from(grown.regular && grown.is(expected, 0.0) && (grown.mean_megno - megno).abs() <= 0.1))
        };
        match self {
            CatMap | StandardMap => {
                let (expected, besides) = match self {
                    CatMap => (((3.0 + 5_f64.sqrt()) / 2.0).ln(), 1e-12),
                    _ => ((K / 2.0).ln(), 2.0 / (K * K)),
                };
                let expected = expected / if self == CatMap { 1.0 } else { K.sqrt() };
                let found =
                    format!("{exponent} where {expected:.6} is expected, sum of the pair {sum:.0e}, {steps} steps");
                (found, Verdict::from(grown.is(expected, besides) && paired))
            }
            ChaoticSea => {
                let found =
                    format!("{exponent}, mean of all schemes {sea:.4}; sums of pairs {sum:.0e} at most, {steps} steps");
                (found, Verdict::from(!grown.regular && (value - sea).abs() <= sea / 4.0 && paired))
            }
            Oscillator => regular(0.0, 0.0),
            _ => regular(4.0 / 3.0 * 4_f64.ln() / grown.time, 2.0),
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
        let verdict = |followed: Followed, grown: Grown| followed.judge(&grown, 1000, 0.045).1;
        let cat = ((3.0 + 5_f64.sqrt()) / 2.0).ln();
        for (followed, exponents, mean_megno, regular, expected) in [
            (CatMap, &[cat, -cat][..], 500.0, false, Verdict::Agrees),
            (CatMap, &[cat + 1e-3, -cat - 1e-3], 500.0, false, Verdict::Differs),
            (CatMap, &[cat, -cat + 1e-3], 500.0, false, Verdict::Differs),
            (StandardMap, &[0.3912, -0.3912], 500.0, false, Verdict::Agrees),
            (StandardMap, &[0.392, -0.392], 500.0, false, Verdict::Differs),
            (Pendulum, &[1.85e-4], 2.0, true, Verdict::Agrees),
            (Pendulum, &[6e-4], 2.0, true, Verdict::Differs),
            (Pendulum, &[1.85e-4], 2.2, true, Verdict::Differs),
            (Pendulum, &[1.85e-4], 2.0, false, Verdict::Differs),
            (Oscillator, &[0.0], 2.0, true, Verdict::Differs),
            (ChaoticSea, &[0.043, 0.0, 0.0, -0.043], 200.0, false, Verdict::Agrees),
            (ChaoticSea, &[0.03, 0.0, 0.0, -0.03], 200.0, false, Verdict::Differs),
            (ChaoticSea, &[0.043, 1e-3, 0.0, -0.043], 200.0, false, Verdict::Differs),
            (ChaoticSea, &[f64::MAX, 0.0, 0.0, 0.0], f64::MAX, false, Verdict::Differs),
        ] {
            let found = verdict(followed, grown(exponents, mean_megno, regular));
            assert_eq!(found, expected, "{followed:?}: {exponents:?}, {mean_megno}, {regular}");
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
