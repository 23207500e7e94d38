//! Runs that are computed together: they differ in the numbers of their systems only, and each is a lane.
//!
//! What is kept of a run has the bytes that it has alone. A run whose state or energy is found to be infinite or NaN is
//! left to be made alone, which gives the message.

use std::sync::atomic::{AtomicBool, Ordering};

use shadowstep::number::{Dual, Lanes, Number, Real};
use shadowstep::steps::together;
use shadowstep::tangent::Tangents;
use shadowstep::{Carried, Scheme as _, System};
use shadowstep_scenes::Scene;
use shadowstep_scenes::evaluator::{Evaluator, Test};
use shadowstep_scenes::expression::Expression;
use shadowstep_scenes::lanes::{self, LANES, SystemInLanes};
use shadowstep_scenes::start::{Begin, SceneIntegrator};
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::sweeps::keep::{Keep, Kept};
use crate::sweeps::record::Values;
use crate::sweeps::values::{Ended, Need, finite};

/// The most steps of runs that are computed together: all of them are lost where a call is stopped.
const MOST_STEPS: u64 = 1_000_000;

/// This number of steps is made at once where only the last state is of interest.
const STEPS_AT_ONCE: u64 = 50;

type OfLanes<T> = [Option<T>; LANES];

type TangentsInLanes = Tangents<SceneIntegrator<Dual<Lanes<LANES>>>>;

/// Whether runs of which this is kept can be computed together: the monitor and estimates follow a run alone.
pub(crate) fn allows(keep: &Keep) -> bool {
    !(keep.rows || [Need::Summary, Need::Estimates].into_iter().any(|need| keep.needs(need)))
}

/// Whether a run can be computed together with others like it.
///
/// exp, log, sin, … of lanes are not those of the platform, which a run has alone; nor have lanes the maps of processed
/// schemes and displaced forces.
pub(crate) fn suits(scene: &Scene, keep: &Keep) -> bool {
    sums(scene).is_some()
        && scene.scheme.scheme.processor().is_empty()
        && !scene.displaced
        && scene.steps().is_some_and(|steps| steps <= MOST_STEPS)
        && !(scene.system.has_functions() || keep.expressions().any(Expression::has_functions))
}

/// Whether two runs can be computed together, as far as their numbers and steps are concerned.
pub(crate) fn are_alike(a: &Scene, b: &Scene) -> bool {
    let steps = |scene: &Scene| (sums(scene), scene.steps(), scene.scheme.scheme.sequence().maps.to_vec());
    steps(a) == steps(b) && a.h == b.h && a.scheme.name == b.scheme.name
}

/// Whether sums of doubles are compensated; `None` for other numbers.
fn sums(scene: &Scene) -> Option<bool> {
    (!scene.arithmetic.is_longer_than_double()).then(|| scene.arithmetic.is_compensated())
}

/// What is kept of each run, which are at most [`LANES`]; `None` of those that have to be made alone.
pub(crate) fn measure(scenes: &[&Scene], keep: &Keep, stops: &AtomicBool) -> Vec<Option<Values>> {
    // lanes without a run have the last one
    let of_lanes: [&Scene; LANES] = std::array::from_fn(|lane| scenes[lane.min(scenes.len() - 1)]);
    let (systems, steps) = (of_lanes.map(|scene| &scene.system), scenes[0].steps_from(Begin::InitialState));
    let none = vec![None; scenes.len()];
    let Some(together) = SystemInLanes::of(&systems) else { return none };
    let tangents = match keep.vectors() {
        0 => None,
        vectors => match lanes::tangents(&systems, steps, vectors) {
            Some(Ok(tangents)) => Some(tangents),
            _ => return none,
        },
    };
    let mut integrator = together.integrator(steps);
    let mut following = LanesFollower::begin(&of_lanes, keep, tangents, integrator.system().energy());
    let at_once = if following.follows_all() { 1 } else { STEPS_AT_ONCE };
    let followed = together::follow(&mut *integrator, scenes[0].most_steps(), |n, integrator| {
        following.include(n, integrator.system());
        let goes_on = following.active.contains(&true) && !stops.load(Ordering::Relaxed);
        if goes_on { Ok((n + at_once, Carried::Nothing)) } else { Err(()) }
    });
    if followed.is_err() && stops.load(Ordering::Relaxed) {
        return none;
    }
    following.values.into_iter().take(scenes.len()).collect()
}

/// What is kept, as far as the states have come.
struct LanesFollower<'a> {
    scene: &'a Scene,
    keep: &'a Keep,
    h: f64,
    /// H − H(0), where it is kept.
    energies: Option<Energies>,
    tangents: Option<TangentsInLanes>,
    /// The times of conditions are the n of the first states that meet them.
    formulas: Vec<Kept<Lanes<LANES>, OfLanes<u64>, OfLanes<f64>>>,
    /// Whether a run is followed: it has not ended, and all that was seen of it is finite.
    active: [bool; LANES],
    values: [Option<Values>; LANES],
}

/// The errors of H.
struct Energies {
    initial: Lanes<LANES>,
    largest: Lanes<LANES>,
    last: Lanes<LANES>,
}

impl<'a> LanesFollower<'a> {
    /// At the initial states, with their H.
    fn begin(
        scenes: &[&'a Scene; LANES],
        keep: &'a Keep,
        tangents: Option<TangentsInLanes>,
        initial: Lanes<LANES>,
    ) -> Self {
        let systems = scenes.map(|scene| &scene.system);
        let formulas = keep.begin(|test| Test::of_each(test, &systems), |value| Evaluator::of_each(value, &systems));
        let zero = Lanes::all(0.0);
        LanesFollower {
            scene: scenes[0],
            keep,
            h: f64::from_rational(scenes[0].h.exact(), &()),
            energies: keep.needs(Need::Energies).then_some(Energies { initial, largest: zero, last: zero }),
            tangents,
            formulas,
            active: initial.0.map(f64::is_finite),
            values: [const { None }; LANES],
        }
    }

    /// Whether more than the last state is of interest.
    fn follows_all(&self) -> bool {
        self.energies.is_some() || self.tangents.is_some() || self.keep.follows_all()
    }

    /// Takes the state n.
    fn include<M: System<Number = Lanes<LANES>> + ?Sized>(&mut self, n: u64, system: &mut M) {
        // a position that is not finite stays so
        for q in system.state().q() {
            self.active.iter_mut().zip(&q.0).for_each(|(active, q)| *active &= q.is_finite());
        }
        if let Some(energies) = self.energies.as_mut().filter(|_| n > 0) {
            energies.include(&system.energy(), &mut self.active);
        }
        if let Some(tangents) = self.tangents.as_mut().filter(|_| n > 0) {
            tangents.step();
            tangents.observe(self.h * n as f64);
        }
        let mut ends = [n == self.scene.most_steps(); LANES];
        let run = self.scene.as_run();
        for kept in &mut self.formulas {
            match kept {
                Kept::FirstTime(test, stops, met) => {
                    let is_met = test.is_met_by_each(system, || run.time(n.cast_signed()));
                    for lane in (0..LANES).filter(|lane| is_met[*lane]) {
                        met[lane].get_or_insert(n);
                        ends[lane] |= *stops;
                    }
                }
                Kept::Value(evaluator, Some(extremum), found) => {
                    let values = evaluator.value(system, || run.time(n.cast_signed()));
                    for lane in (0..LANES).filter(|lane| self.active[*lane]) {
                        let value = values.0[lane];
                        if extremum.is_beyond(&value, found[lane].as_ref()) {
                            found[lane] = Some(value);
                        }
                    }
                }
                Kept::Value(_, None, _) => {}
            }
        }
        let ended = std::array::from_fn(|lane| ends[lane] && self.active[lane]);
        if ended.contains(&true) {
            self.end(n, &ended, system);
        }
    }

    /// Some runs end at the state n.
    fn end<M: System<Number = Lanes<LANES>> + ?Sized>(&mut self, n: u64, ended: &[bool; LANES], system: &mut M) {
        let run = self.scene.as_run();
        let energy = system.energy();
        for kept in &mut self.formulas {
            if let Kept::Value(evaluator, None, found) = kept {
                *found = evaluator.value(system, || run.time(n.cast_signed())).0.map(Some);
            }
        }
        for lane in (0..LANES).filter(|lane| ended[*lane]) {
            self.active[lane] = false;
            let of_lane = |x: &Lanes<LANES>| x.0[lane];
            let state: Vec<f64> = system.state().q().iter().chain(system.state().p()).map(of_lane).collect();
            if !(energy.0[lane].is_finite() && state.iter().all(|x| x.is_finite())) {
                continue;
            }
            let ended = self.ended(lane, n, system.state().evaluations());
            let values = self.keep.values.iter().map(|value| (value.of)(&ended));
            let formulas = self.formulas.iter().map(|kept| match kept {
                Kept::FirstTime(.., met) => met[lane].map(|n| to_text(&run.time(n.cast_signed()))),
                Kept::Value(.., found) => found[lane].as_ref().and_then(finite),
            });
            let state = state.iter().filter(|_| self.keep.state).map(finite);
            self.values[lane] = Some(values.chain(formulas).chain(state).collect());
        }
    }

    /// What is known of the run of a lane at the state n.
    fn ended(&self, lane: usize, n: u64, evaluations: u64) -> Ended<'_> {
        Ended {
            steps: n,
            evaluations,
            energy: self.energies.as_ref().map(|energies| energies.texts(lane)).unwrap_or_default(),
            growth: self.tangents.as_ref().map(|tangents| tangents.growth(0, lane)),
            sali: self.tangents.as_ref().filter(|_| self.keep.vectors() > 1).map(|tangents| tangents.sali(lane)),
            ..Ended::default()
        }
    }
}

impl Energies {
    /// Takes H of a state; a run in which it is not finite is not followed further.
    fn include(&mut self, energy: &Lanes<LANES>, active: &mut [bool; LANES]) {
        let Energies { initial, largest, last } = self;
        last.assign_difference(energy, initial);
        for ((active, largest), last) in active.iter_mut().zip(&mut largest.0).zip(&last.0) {
            let size = last.abs();
            *active &= size.is_finite();
            *largest = if size > *largest { size } else { *largest };
        }
    }

    /// The largest error of a run, the same as a part of H(0), and the last one.
    fn texts(&self, lane: usize) -> [Option<String>; 3] {
        let [size, largest, last] = [self.initial.0[lane].abs(), self.largest.0[lane], self.last.0[lane]];
        [Some(largest.to_text()), (size > 0.0).then(|| (largest / size).to_text()), Some(last.to_text())]
    }
}

#[cfg(test)]
mod tests {
    use shadowstep::tables::Source;

    use super::*;
    use crate::sweeps::plan::SweepPlan;
    use crate::sweeps::record::measured;

    const HENON_HEILES: &str = "problem = { potential = \"(x^2 + y^2)/2 + x^2*y - y^3/3\", coordinates = \
        [\"x\", \"y\"] }\n\
         initial = { q = [0, \"y0\"], p = [\"1/2\", \"v0\"] }\n\
         run = { scheme = \"yoshida4\", step = \"1/10\", steps = 300, digits = \"double\" }\n\
         [axes]\ny0 = \"0 … 6/5 in 6 values\"\nv0 = \"-1/2 … 1/2 in 5 values\"\n";

    fn plan(text: &str) -> SweepPlan {
        SweepPlan::of(&Source { path: "sweep.toml".to_owned(), text: text.to_owned() })
            .unwrap_or_else(|error| panic!("{error}"))
    }

    /// How many runs of a sweep, all of which suit, are computed together; each has what it has alone.
    fn together(text: &str) -> usize {
        let (plan, stops) = (plan(text), AtomicBool::new(false));
        let scenes: Vec<Scene> = (0..plan.axes().runs()).map(|run| plan.scene(run).unwrap()).collect();
        assert!(allows(&plan.keep));
        let mut count = 0;
        for group in scenes.chunks(LANES) {
            assert!(suits(&group[0], &plan.keep) && group.iter().all(|scene| are_alike(&group[0], scene)), "{text}");
            for (scene, found) in group.iter().zip(measure(&group.iter().collect::<Vec<_>>(), &plan.keep, &stops)) {
                let alone = measured(0, scene, &plan.keep, &stops).unwrap();
                assert_eq!(found.is_some(), alone.failure.is_none(), "{text}\n{alone:?}");
                if let Some(found) = found {
                    assert_eq!(found, alone.values, "{text}");
                    count += 1;
                }
            }
        }
        count
    }

    #[test]
    fn runs_together_have_the_bytes_of_runs_alone() {
        // of 30, some leave the well until H overflows
        let ends = together(&format!("{HENON_HEILES}[keep]\nstate = true\nat_end = {{ E1 = \"E*t + y0\" }}\n"));
        assert!((5..30).contains(&ends), "{ends}");
        let energies = "values = \
            [\"steps\", \"energy_error\", \"relative_energy_error\", \"last_energy_error\", \"force_evaluations\"]";
        assert_eq!(together(&format!("{HENON_HEILES}[keep]\n{energies}\n")), ends);
        let escape =
            "first_time = { escape = \"x^2 + y^2 > 9\", turn = \"px < 0\", late = \"t > 10\" }\nstop = [\"escape\"]";
        let extremes = "min = { low = \"x\" }\nmax = { high = \"y - E\", r = \"x^2 + y^2\" }";
        assert_eq!(together(&format!("{HENON_HEILES}[keep]\n{energies}\n{escape}\n{extremes}\nstate = true\n")), 30);
    }

    /// Of those that stay in the well, regular and chaotic ones.
    #[test]
    fn indicators_of_chaos_are_those_of_runs_alone() {
        let values = "values = [\"motion\", \"lyapunov\", \"lyapunov_error\", \"megno\", \"sali\", \"energy_error\"]";
        let ends = together(&format!("{HENON_HEILES}[keep]\n{values}\n"));
        assert!((5..30).contains(&ends), "{ends}");
        assert_eq!(together(&format!("{HENON_HEILES}[keep]\nvalues = [\"megno\"]\n")), ends);
    }

    #[test]
    fn masses_parameters_and_bodies_differ() {
        let run = "run = { scheme = \"ruth3\", step = \"1/20\", steps = 50, digits = \"compensated\" }\n";
        let keep = "[axes]\na = \"1/3 … 2 in 7 values\"\n[keep]\nstate = true\nvalues = \
            [\"energy_error\", \"sali\", \"megno\"]\nat_end = { x = \"a*t\" }\n";
        for problem in [
            "problem = { name = \"harmonic-oscillator\", parameters.omega = \"a\" }\n",
            "problem = { name = \"kepler\", parameters.eccentricity = \"a/3\" }\n",
            "problem = { name = \"figure-eight\", parameters.m_2 = \"a\" }\n",
            "problem = { potential = \"u^2*v^2/a\", coordinates = [\"u\", \"v\"], masses = [1, \"a\"] }\ninitial = { \
                q = [1, \"a\"], p = [0, 1] }\n",
            "problem = { potential = \"u^2/2\", coordinates = [\"u\"], kinetic = \"sqrt(1 + pu^2*a)\" }\ninitial = { \
                q = [\"a\"], p = [0] }\n",
            "problem = { pair = \"-m_i*m_j*a/sqrt(r2)\", dimensions = 2, bodies = { m = [1, \"a\"] }, masses = \"m\" }\n\
             initial = { q = [0, 0, \"a\", 1], v = [0, 0, 0, \"a\"] }\n",
        ] {
            let keep = keep.replace("x = ", "end = ");
            assert_eq!(together(&format!("{problem}{run}{keep}")), 7, "{problem}");
        }
    }

    #[test]
    fn quantities_of_bodies_are_those_of_runs_alone() {
        let text = "problem = { name = \"figure-eight\", parameters.m_2 = \"a\" }\n\
            run = { scheme = \"ruth3\", step = \"1/20\", steps = 50, digits = \"double\" }\n[axes]\na = \"1/3 … 2 in \
            7 values\"\n[keep]\n\
            at_end = { angle = \"M(2) + pericentre(3, jacobi)\" }\nmin = { d = \"distance(1, 2)\" }\nmax = { e \
            = \"e(3, barycentre)\" }\n";
        assert_eq!(together(text), 7);
    }

    #[test]
    fn other_runs_are_made_alone() {
        let suits_of = |text: &str| {
            let plan = plan(text);
            allows(&plan.keep) && suits(&plan.scene(0).unwrap(), &plan.keep)
        };
        let keep = "[keep]\nstate = true\n";
        assert!(suits_of(&format!("{HENON_HEILES}{keep}")));
        for (from, to) in [
            ("state = true", "values = [\"verdict\"]"),
            ("state = true", "at_end = { a = \"exp(x)\" }"),
            ("state = true", "first_time = { a = \"sin(x) > 0\" }"),
            ("\"double\"", "30"),
            ("y^3/3", "exp(y)"),
            ("steps = 300", "steps = 2000000"),
        ] {
            let text = format!("{HENON_HEILES}{keep}").replace(from, to);
            assert!(!suits_of(&text), "{text}");
        }
        let scene = |text: &str| plan(text).scene(0).unwrap();
        let text = format!("{HENON_HEILES}{keep}");
        for (from, to) in [("1/10", "1/11"), ("yoshida4", "ruth3"), ("= 300", "= 301"), ("double", "compensated")] {
            assert!(!are_alike(&scene(&text), &scene(&text.replace(from, to))), "{to}");
        }
        let other = scene(&text.replace("y^3/3", "y^3/4"));
        let (first, stops) = (scene(&text), AtomicBool::new(false));
        assert_eq!(measure(&[&first, &other], &plan(&text).keep, &stops), [None, None]);
    }
}
