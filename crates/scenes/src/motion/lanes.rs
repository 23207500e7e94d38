//! Several systems of one form, whose numbers differ → one system of lanes.

use shadowstep::number::{Dual, Lanes, Number};
use shadowstep::problems::Setup;
use shadowstep::systems::kinetic::{General, Quadratic};
use shadowstep::systems::summation::Compensated;
use shadowstep::tangent::{TangentError, Tangents};
use shadowstep::{DiagonalMasses, Kinetic, Motion, Potential, UnitMasses};
use shadowstep_schemes::symbolic::{Exact, parse};

use crate::motion::tangent::{components, scales};
use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::{ClassifiedKinetic, EnergyOfBodies, KineticEnergy, PairEnergy, PotentialEnergy, System};

/// Trajectories that are computed together.
pub const LANES: usize = 16;

/// Numbers in lanes, or made of such.
pub trait OfLanes: Number<Context = ()> + From<Lanes<LANES>> + 'static {}

impl OfLanes for Lanes<LANES> {}

impl OfLanes for Dual<Lanes<LANES>> {}

/// The systems of [`LANES`] trajectories as one, at their initial states.
pub struct SystemInLanes<N = Lanes<LANES>> {
    potential: Box<dyn Potential<N>>,
    kinetic: ClassifiedKinetic<N>,
    q: Vec<N>,
    p: Vec<N>,
}

/// A system of lanes.
pub(crate) type MotionInLanes<N, C> =
    Motion<N, Vec<N>, Box<dyn Potential<N>>, Box<dyn Kinetic<N, Class = C>>, Option<Compensated<N, Vec<N>>>>;

const READ: &str = "the system was read with the scene";
const QUADRATIC: &str = "T is of the class of the first system";

impl SystemInLanes {
    /// `None` if the systems differ in more than numbers, or cannot be in lanes.
    pub fn of(systems: &[&System; LANES]) -> Option<Self> {
        SystemInLanes::in_numbers(systems)
    }

    /// The same system at other initial states, q and p of each.
    pub(crate) fn at_states(self, states: &[(Vec<Exact>, Vec<Exact>)]) -> Self {
        SystemInLanes { q: in_lanes(|lane| &states[lane].0), p: in_lanes(|lane| &states[lane].1), ..self }
    }

    /// The system with a stepper that is valid for it.
    ///
    /// # Panics
    /// If the step size is 0 or the scheme is not valid for T(p), which reading a scene excludes.
    #[inline(never)]
    pub fn integrator(self, steps: Steps<'_>) -> SceneIntegrator<Lanes<LANES>> {
        self.with_stepper(steps)
    }
}

/// The trajectories with tangent vectors, whose directions are those that each trajectory has alone; `None` as of
/// [`SystemInLanes::of`].
///
/// # Errors
/// A vector that has no direction.
#[inline(never)]
pub fn tangents(
    systems: &[&System; LANES],
    steps: Steps<'_>,
    vectors: usize,
) -> Option<Result<Tangents<SceneIntegrator<Dual<Lanes<LANES>>>>, TangentError>> {
    let with_vector = |k: usize| {
        let mut system = SystemInLanes::<Dual<Lanes<LANES>>>::in_numbers(systems)?;
        let scales = systems.map(scales);
        for (i, half) in [&mut system.q, &mut system.p].into_iter().enumerate() {
            let of_lane = |lane: usize| half.iter().map(|x| x.value.0[lane]).collect::<Vec<_>>();
            let place = |lane: usize| (i * systems[0].q.len(), &scales[lane][i][..]);
            let of_lanes: [_; LANES] = std::array::from_fn(|lane| components(&of_lane(lane), k, place(lane)));
            for (i, x) in half.iter_mut().enumerate() {
                x.derivatives = [Lanes(std::array::from_fn(|lane| of_lanes[lane][i]))];
            }
        }
        Some(system.with_stepper(steps))
    };
    let integrators: Option<Vec<_>> = (0..vectors).map(with_vector).collect();
    integrators.map(Tangents::new)
}

impl<N: OfLanes> SystemInLanes<N> {
    fn in_numbers(systems: &[&System; LANES]) -> Option<Self> {
        if !systems.iter().all(|system| system.has_lanes()) {
            return None;
        }
        systems.iter().all(|system| have_one_form(systems[0], system)).then(|| SystemInLanes {
            potential: potential(systems),
            kinetic: if systems[0].explicit_time { kinetic(systems).with_time() } else { kinetic(systems) },
            q: in_lanes(|lane| &systems[lane].q),
            p: in_lanes(|lane| &systems[lane].p),
        })
    }

    fn with_stepper(self, steps: Steps<'_>) -> SceneIntegrator<N> {
        if matches!(self.kinetic, ClassifiedKinetic::Quadratic(_)) {
            return steps.integrator(steps.quadratic(), self.quadratic(steps.compensated), &());
        }
        steps.integrator(steps.for_every_kinetic(), self.general(steps.compensated), &())
    }

    pub(crate) fn quadratic(self, compensated: bool) -> MotionInLanes<N, Quadratic> {
        let ClassifiedKinetic::Quadratic(kinetic) = self.kinetic else { unreachable!("{QUADRATIC}") };
        Motion::new(self.potential, kinetic, self.q, self.p).expect(READ).compensated_if(compensated)
    }

    pub(crate) fn general(self, compensated: bool) -> MotionInLanes<N, General> {
        let ClassifiedKinetic::General(kinetic) = self.kinetic else { unreachable!("{QUADRATIC}") };
        Motion::new(self.potential, kinetic, self.q, self.p).expect(READ).compensated_if(compensated)
    }
}

impl System {
    /// The parameters in lanes, with their names: those of one of the systems in each.
    ///
    /// # Panics
    /// If a system has other parameters than the first.
    pub(crate) fn parameters_of_each<'a>(systems: &[&'a System; LANES]) -> Vec<(&'a str, Lanes<LANES>)> {
        let names = systems[0].parameters.iter().enumerate();
        names.map(|(i, (name, _))| (name.as_str(), lanes_of(|lane| &systems[lane].parameters[i].1))).collect()
    }
}

impl System {
    /// Whether several trajectories can be computed in lanes: T(p) and U(q), and no cutoff, as bodies have other
    /// neighbours in each trajectory.
    pub(crate) fn has_lanes(&self) -> bool {
        let has_cutoff = matches!(&self.potential, PotentialEnergy::Pairs(pairs) if pairs.cutoff.is_some());
        self.parts.is_kinetic_and_potential() && !has_cutoff
    }

    /// Whether T or U, as formulas of q and p, have functions such as exp and sin; true where they are not given as
    /// such.
    pub fn has_functions(&self) -> bool {
        let kinetic = match &self.kinetic {
            KineticEnergy::Masses(_) => false,
            KineticEnergy::Formula(formula) => formula_has_functions(formula.text()),
        };
        let slow = self.parts.slow_forces().is_some_and(|slow| formula_has_functions(slow.text()));
        let potential = match &self.potential {
            PotentialEnergy::Shipped(setup) => setup.problem.has_functions(),
            PotentialEnergy::Formula(formula) => formula_has_functions(formula.text()),
            PotentialEnergy::Pairs(pairs) => {
                let of_bodies = pairs.of_bodies.iter().map(EnergyOfBodies::text);
                of_bodies.chain([pairs.formula.text()]).any(formula_has_functions)
            }
            PotentialEnergy::Own(_) | PotentialEnergy::OfParts => true,
        };
        kinetic || potential || slow
    }
}

fn formula_has_functions(text: &str) -> bool {
    parse(text).map_or(true, |formula| formula.has_functions())
}

/// Whether two systems differ in numbers only.
fn have_one_form(a: &System, b: &System) -> bool {
    let names = |system: &System| system.parameters.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    let kinetic = match (&a.kinetic, &b.kinetic) {
        (KineticEnergy::Masses(_), KineticEnergy::Masses(_)) => true,
        (KineticEnergy::Formula(a), KineticEnergy::Formula(b)) => a.text() == b.text(),
        _ => false,
    };
    let potential = match (&a.potential, &b.potential) {
        (PotentialEnergy::Shipped(a), PotentialEnergy::Shipped(b)) => a.problem == b.problem,
        (PotentialEnergy::Formula(a), PotentialEnergy::Formula(b)) => a.text() == b.text(),
        (PotentialEnergy::Pairs(a), PotentialEnergy::Pairs(b)) => pairs_have_one_form(a, b),
        _ => false,
    };
    kinetic && potential && names(a) == names(b) && a.coordinates == b.coordinates && a.momenta == b.momenta
}

fn pairs_have_one_form(a: &PairEnergy, b: &PairEnergy) -> bool {
    let names = |pairs: &PairEnergy| pairs.properties.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    let form = |pairs: &PairEnergy| (pairs.dimensions, pairs.bodies, pairs.particles, pairs.ends);
    let of_bodies = |pairs: &PairEnergy| {
        pairs.of_bodies.iter().map(|energy| (energy.key(), energy.text().to_owned())).collect::<Vec<_>>()
    };
    a.formula.text() == b.formula.text() && form(a) == form(b) && names(a) == names(b) && of_bodies(a) == of_bodies(b)
}

/// An exact number of each system, rounded once.
fn lanes_of<'a>(exact: impl Fn(usize) -> &'a Exact) -> Lanes<LANES> {
    Lanes(std::array::from_fn(|lane| f64::from_rational(&exact(lane).value, &())))
}

/// The same for a list of each system.
pub(crate) fn in_lanes<'a, N: OfLanes>(list: impl Fn(usize) -> &'a [Exact]) -> Vec<N> {
    (0..list(0).len()).map(|i| lanes_of(|lane| &list(lane)[i]).into()).collect()
}

/// The parameters of the formulas.
fn parameters<N: OfLanes>(systems: &[&System; LANES]) -> Vec<N> {
    System::parameters_of_each(systems).into_iter().map(|(_, value)| value.into()).collect()
}

fn potential<N: OfLanes>(systems: &[&System; LANES]) -> Box<dyn Potential<N>> {
    match &systems[0].potential {
        PotentialEnergy::Shipped(_) => Setup::potential_of_each(&systems.map(|system| match &system.potential {
            PotentialEnergy::Shipped(setup) => setup,
            _ => unreachable!("the systems have one form"),
        })),
        PotentialEnergy::Formula(formula) => Box::new(formula.meaning().in_numbers(parameters(systems))),
        PotentialEnergy::Pairs(pairs) => of_pairs(systems, pairs),
        PotentialEnergy::Own(_) | PotentialEnergy::OfParts => unreachable!("the systems have one form"),
    }
}

fn of_pairs<N: OfLanes>(systems: &[&System; LANES], first: &PairEnergy) -> Box<dyn Potential<N>> {
    let property = |lane: usize, k: usize| match &systems[lane].potential {
        PotentialEnergy::Pairs(pairs) => pairs.properties[k].1.as_slice(),
        _ => unreachable!("the systems have one form"),
    };
    let properties = first.properties.iter().enumerate();
    let properties = properties.map(|(k, _)| in_lanes(|lane| property(lane, k))).collect();
    first.with_values(properties, parameters(systems))
}

fn kinetic<N: OfLanes>(systems: &[&System; LANES]) -> ClassifiedKinetic<N> {
    let KineticEnergy::Formula(formula) = &systems[0].kinetic else {
        return of_masses(systems);
    };
    match formula.meaning().in_numbers(parameters(systems)).into_quadratic() {
        Ok(quadratic) => ClassifiedKinetic::Quadratic(Box::new(quadratic)),
        Err(general) => ClassifiedKinetic::General(Box::new(general)),
    }
}

fn of_masses<N: OfLanes>(systems: &[&System; LANES]) -> ClassifiedKinetic<N> {
    if systems.iter().all(|system| matches!(system.kinetic, KineticEnergy::Masses(None))) {
        return systems[0].of_masses(UnitMasses);
    }
    let each = systems.map(|system| DiagonalMasses::new(&system.exact_masses(), &()).expect(READ));
    systems[0].of_masses(DiagonalMasses::of_each(&each.each_ref()).expect(READ).into_numbers::<N>())
}
