//! Close encounters in logarithmic time: Kepler orbits up to e = 1 − 10⁻⁸, of which the steps are known in closed form.

use std::f64::consts::TAU;
use std::path::Path;

use shadowstep::number::CorrectlyRounded;
use shadowstep::shadow::Verdict as MonitorVerdict;
use shadowstep::systems::transformed_time::TimeTransformation;
use shadowstep::tables::{First, TableScheme};
use shadowstep_scenes::Parts;
use shadowstep_scenes::library::scheme_from;
use shadowstep_schemes::MapKind;

use crate::stability::prelude::*;
use crate::stability::watched::MONITOR_ORDER;

/// The case.
pub(super) struct TransformedTime;

/// The largest deviations from the closed form, in units of the round-off that is expected of N leapfrogs.
#[derive(Serialize, Deserialize)]
pub(super) struct Orbit {
    steps: u64,
    /// |H′| beside ε√N.
    energy: f64,
    /// |L/L(0) − 1| beside ε√N/L.
    angular_momentum: f64,
    /// The distance from the predicted point of the ellipse, and the error of the predicted time, beside ε N^{3/2}.
    position: f64,
    time: f64,
    /// By how much a period in the physical time differs from 2π, as a part of it.
    period: f64,
    /// Whether the monitor calls the step too large.
    too_large: bool,
    verdict: String,
}

/// The round-off of a leapfrog may be this multiple of ε: steps of schemes of high order are long, and some of their
/// leapfrogs longer still.
const MOST: f64 = 100.0;
/// A step of so much for each force evaluation.
const STEP: f64 = 0.05;
impl Case for TransformedTime {
    type Measured = Orbit;

    fn complete(scheme: &Examined, values: Values) -> Option<Values> {
        gammas(&scheme.scheme.quadratic()).map(|_| values)
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Orbit, Error> {
        let gammas = &gammas(&trial.scheme().quadratic()).expect("others are left out");
        let h = &step_size(rational(STEP) * Rational::from_integer(gammas.len().into()));
        let scheme = &drift_first(trial.scheme())?;
        let (k, periods) = (trial.get("k"), trial.get("periods"));
        Ok(trial.arithmetic.compute(Follow { scheme, h, gammas, k, periods, continues }))
    }

    fn judge(all: &[&Done<'_, Orbit>]) -> Vec<Row> {
        let most = |of: fn(&Orbit) -> f64| largest(all.iter().map(|one| of(&one.found)));
        let [energy, momentum] = [most(|orbit| orbit.energy), most(|orbit| orbit.angular_momentum)];
        let [position, time] = [most(|orbit| orbit.position), most(|orbit| orbit.time)];
        let Done { trial, found: first } = all[0];
        let found = format!(
            "8 orbits of {} steps: H′ at most {energy:.1} ε√N, L {momentum:.1} ε√N/L; off the closed form by \
             {position:.1e} ε N^(3/2) in place, {time:.1e} ε N^(3/2) in time; a period is off by {:.1e} of it; the \
             monitor: {}",
            first.steps,
            first.period,
            verdicts(all)
        );
        let small = [energy, momentum, position, time].into_iter().all(|of| of <= MOST);
        let points = all.iter().map(|one| (-one.trial.get::<f64>("k"), one.found.angular_momentum.log10()));
        vec![Row::of(trial, found, small && !all.iter().any(|one| one.found.too_large)).with(points)]
    }
}

/// What the monitor reported of how many orbits.
fn verdicts(all: &[&Done<'_, Orbit>]) -> String {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for Done { found, .. } in all {
        match counts.iter_mut().find(|(verdict, _)| *verdict == found.verdict) {
            Some((_, count)) => *count += 1,
            None => counts.push((&found.verdict, 1)),
        }
    }
    joined(&counts, ", ", |(verdict, count)| format!("{verdict} ({count})"))
}

/// The scheme that begins with a drift.
fn drift_first(named: &NamedScheme) -> Result<NamedScheme, Error> {
    let named = scheme_from(&named.name, Path::new(""), Some(First::Drift))?;
    match named.quadratic().for_every_kinetic() {
        Ok(_) => Ok(named),
        Err(error) => Err(Error::usage(error.to_string(), "use a composition of the leapfrog")),
    }
}

/// Kepler's problem in logarithmic time.
fn system() -> System {
    let mut system = shipped("kepler", &[]);
    let parts = shadowstep_scenes::TransformedTime::of(TimeTransformation::Logarithmic, &system, true);
    system.parts = Parts::TransformedTime(parts.expect("U is negative"));
    system
}

/// The γ_i of a composition of leapfrogs, which are the kicks of a step that begins with a drift; `None` of another
/// scheme.
fn gammas(scheme: &TableScheme) -> Option<Vec<Rational>> {
    let proved = scheme.proved();
    let exact = &proved.scheme;
    if exact.processor.is_some() || exact.has_gradient_kicks() || !proved.holds_for_every_kinetic() {
        return None;
    }
    let maps = exact.clone().starting_with(First::Drift).maps();
    let of = |kind: MapKind| -> Vec<Rational> {
        maps.iter().filter(|map| map.kind == kind).map(|map| map.weight.clone()).collect()
    };
    let (kicks, drifts) = (of(MapKind::Kick), of(MapKind::Drift));
    let zero = Rational::from_integer(0.into());
    let two = Rational::from_integer(2.into());
    let neighbours = |i: usize| kicks.get(i).unwrap_or(&zero) + i.checked_sub(1).map_or(&zero, |i| &kicks[i]);
    let is_composition =
        drifts.len() == kicks.len() + 1 && drifts.iter().enumerate().all(|(i, drift)| &two * drift == neighbours(i));
    is_composition.then_some(kicks)
}

/// Follows an orbit beside its closed form.
#[derive(Clone, Copy)]
struct Follow<'a> {
    scheme: &'a NamedScheme,
    h: &'a StepSize,
    gammas: &'a [Rational],
    k: u32,
    periods: u32,
    continues: Continues<'a>,
}

impl Computation for Follow<'_> {
    type Output = Orbit;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Orbit {
        let Follow { scheme, h, gammas, k, periods, continues } = self;
        let mut ellipse = Ellipse::<N>::new(h.exact(), gammas, k, context);
        let (q, p) = ellipse.pericentre();
        let integrator = system().integrator(steps_of(scheme, h, Begin::Step), (q.to_vec(), p.to_vec()), context);
        let integrator = &mut *integrator.expect("three coordinates");
        let h = <f64 as Number>::from_rational(h.exact(), &());
        let steps = (f64::from(periods) * TAU / h) as u64;
        let mut monitor = N::monitor(integrator, MONITOR_ORDER, (steps / 256).max(1)).expect("it is finite");
        let unit = 2_f64.powi(-(<N as CorrectlyRounded>::precision(context).in_bits() as i32));
        let mut worst = [0.0_f64; 4];
        for n in 1..=steps {
            integrator.step(monitor.carried());
            let finite = N::observe(&mut monitor, integrator).is_ok();
            let found = ellipse.deviations(n, integrator.state().q(), integrator.state().p());
            let leapfrogs = n as f64 * gammas.len() as f64;
            let (wander, phase) = (unit * leapfrogs.sqrt(), unit * leapfrogs.powf(1.5));
            let allowed = [wander, wander / ellipse.angular_momentum.to_f64(), phase, phase];
            for (worst, (found, allowed)) in worst.iter_mut().zip(found.into_iter().zip(allowed)) {
                // what is not a number is the worst; JSON has no infinity
                *worst = if found.is_nan() { f64::MAX } else { worst.max(found / allowed).min(f64::MAX) };
            }
            if !finite || (n % 1024 == 0 && !continues(n as f64 / steps as f64)) {
                break;
            }
        }
        let verdict = N::report(&monitor).verdict;
        let [energy, angular_momentum, position, time] = worst;
        let period = h / ellipse.turn.to_f64() - 1.0;
        let too_large = matches!(verdict, MonitorVerdict::TooLarge(_) | MonitorVerdict::NearResonance { .. });
        Orbit { steps, energy, angular_momentum, position, time, period, too_large, verdict: verdict.to_string() }
    }
}

/// The closed form of the steps on an orbit with a = 1 that begins at its pericentre.
struct Ellipse<N> {
    h: N,
    /// 2 Σ arctan(γ_i h/2), by which a step turns the eccentric anomaly.
    turn: N,
    eccentricity: N,
    /// 1 − e
    gap: N,
    /// √(1 − e²)
    angular_momentum: N,
}

impl<N: CorrectlyRounded> Ellipse<N> {
    fn new(h: &Rational, gammas: &[Rational], k: u32, context: &N::Context) -> Self {
        let number = |value: &Rational| N::from_rational(value, context);
        let one = Rational::from_integer(1.into());
        let gap = Rational::new(1.into(), 10_i64.pow(k).into());
        let mut turn = N::zero(context);
        for gamma in gammas {
            let half = number(&(gamma * h / Rational::from_integer(2.into())));
            let mut angle = half.clone();
            angle.assign_atan(&half);
            turn.add(&angle);
        }
        turn.multiply_integer(2);
        let square = number(&(&gap * (&one + &one - &gap)));
        let mut angular_momentum = square.clone();
        angular_momentum.assign_sqrt(&square);
        Ellipse { h: number(h), turn, eccentricity: number(&(&one - &gap)), gap: number(&gap), angular_momentum }
    }

    /// x, y, t and p_x, p_y, p_t.
    fn pericentre(&self) -> ([N; 3], [N; 3]) {
        let zero = N::zero(&self.gap.context());
        let mut py = self.angular_momentum.clone();
        py.divide(&self.gap);
        let half = N::from_rational(&Rational::new(1.into(), 2.into()), &self.gap.context());
        ([self.gap.clone(), zero.clone(), zero.clone()], [zero, py, half])
    }

    /// |H′|, |L/L(0) − 1|, the distance from the predicted place, and the error of the time, after n steps.
    fn deviations(&mut self, n: u64, q: &[N], p: &[N]) -> [f64; 4] {
        let context = self.gap.context();
        let n = N::from_rational(&Rational::from_integer(n.into()), &context);
        let one = N::from_rational(&Rational::from_integer(1.into()), &context);
        let zero = N::zero(&context);
        // (T + p_t) r − 1, which is H′ in first order
        let (mut square, mut r, mut energy) = (zero.clone(), zero.clone(), zero.clone());
        q[..2].iter().for_each(|x| square.add_product(x, x));
        r.assign_sqrt(&square);
        p[..2].iter().for_each(|p| energy.add_product(p, p));
        energy.divide_integer(2);
        energy.add(&p[2]);
        energy.multiply(&r);
        energy.subtract(&one);
        let mut momentum = zero.clone();
        momentum.add_product(&q[0], &p[1]);
        momentum.subtract_product(&q[1], &p[0]);
        momentum.divide(&self.angular_momentum);
        momentum.subtract(&one);
        let (mut angle, mut sin, mut cos) = (zero.clone(), zero.clone(), zero.clone());
        angle.assign_product(&n, &self.turn);
        N::assign_sin_cos(&mut sin, &mut cos, &angle);
        let (mut x, mut y, mut t) = (cos, zero.clone(), zero);
        x.subtract(&self.eccentricity);
        x.subtract(&q[0]);
        y.add_product(&self.angular_momentum, &sin);
        y.subtract(&q[1]);
        t.add_product(&n, &self.h);
        t.subtract_product(&self.eccentricity, &sin);
        t.subtract(&q[2]);
        [energy.to_f64().abs(), momentum.to_f64().abs(), x.to_f64().hypot(y.to_f64()), t.to_f64().abs()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim;
    use shadowstep_scenes::arithmetic::Arithmetic;
    use shadowstep_scenes::library::scheme;

    #[test]
    fn compositions_of_the_leapfrog_are_recognised() {
        let count = |name: &str| gammas(&scheme(name).unwrap().quadratic()).map(|gammas| gammas.len());
        assert_eq!((count("stormer-verlet"), count("sofroniou-spaletta8-21")), (Some(1), Some(21)));
        assert_eq!(
            (count("blanes-moan-s6"), count("ruth3"), count("bcm6-11"), count("chin-4a")),
            (None, None, None, None)
        );
    }

    #[test]
    fn the_steps_are_those_of_the_closed_form() {
        let suite = Suite::new(vec![scheme("yoshida4").unwrap()], Arithmetic::DOUBLE, true);
        let table = claim::read::<Table>(include_str!("transformed_time.toml"));
        let trial = TransformedTime::trials(&suite, &table).pop().unwrap();
        let orbit = TransformedTime::measure(&trial, &|_| true).unwrap();
        assert!(!orbit.too_large && orbit.position < MOST && orbit.time < MOST, "{} {}", orbit.position, orbit.time);
        // another turn is seen
        let scheme = &drift_first(trial.scheme()).unwrap();
        let gammas = &gammas(&self::scheme("suzuki4").unwrap().quadratic()).unwrap();
        let follow = Follow { scheme, h: &step_size("3/20"), gammas, k: 8, periods: 10, continues: &|_| true };
        let wrong = Arithmetic::DOUBLE.compute(follow);
        assert!(wrong.position > 1e6, "{}", wrong.position);
    }
}
