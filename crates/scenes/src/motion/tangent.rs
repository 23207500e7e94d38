//! Tangent vectors along a run.

use num_traits::ToPrimitive;
use shadowstep::number::{AnyLimbs, CorrectlyRounded, DoubleDouble, Dual, LimbCount, Precision};
use shadowstep::tangent::{Growth, Tangents, with_derivatives};
use shadowstep::{Integrator as _, MotionError, Number, Rational, Real, Remainders};

use crate::run::arithmetic::{Arithmetic, Digits, Numbers};
use crate::run::saved_state::{SavedState, SavedVector};
use crate::run::snapshots::Snapshot;
use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::{PotentialEnergy, SceneNumber, System};
use crate::texts::error::Error;

/// A trajectory with tangent vectors.
pub trait TangentRun {
    /// One step.
    fn step(&mut self);

    /// The growth of all vectors up to the present state, at t.
    fn observe(&mut self, t: f64);

    /// [`Tangents::separate`]
    fn separate(&mut self);

    /// The physical time of the present state, where time is transformed.
    fn time(&self) -> Option<f64>;

    /// How vectors grew, in their order; of vectors that are made orthonormal the fastest first:
    /// [`Tangents::spectrum`].
    fn growths(&self) -> Vec<&Growth>;

    /// [`Tangents::sali`] of two vectors and more that evolve freely.
    fn sali(&self) -> Option<f64>;

    /// [`Tangents::gali`] of all vectors, if they evolve freely and there are three or more.
    fn gali(&self) -> Option<f64>;
}

/// A trajectory with tangent vectors that checkpoints have.
trait ResumableRun: TangentRun {
    /// The vectors at the state n, if they evolve freely; `None` if a number has an exponent that cannot be read.
    fn saved(&self, n: i64) -> Option<Vec<SavedVector>>;

    /// Goes on from such vectors; whether they can be read.
    fn restore(&mut self, saved: &[SavedVector]) -> bool;
}

/// The number of steps after which free vectors are separated, however rarely they are measured: they grow by less than
/// 10⁶ meanwhile at most step sizes.
const SEPARATED_EVERY: u64 = 4;

/// The number of vectors of which rows have indicators.
pub(crate) const VECTORS_OF_ROWS: usize = 2;

/// Tangent vectors that follow a run from t = 0, measured from time to time.
pub struct FollowingVectors {
    run: Box<dyn ResumableRun>,
    h: f64,
    every: u64,
    /// The number of steps so far.
    steps: u64,
}

impl FollowingVectors {
    /// One step.
    pub fn step(&mut self) {
        self.run.step();
        self.steps += 1;
        if self.steps.is_multiple_of(self.every) {
            self.observe();
        } else if self.steps.is_multiple_of(SEPARATED_EVERY) {
            self.run.separate();
        }
    }

    /// Makes the steps up to the state n.
    pub(crate) fn reach(&mut self, n: i64) {
        while self.steps < n.unsigned_abs() {
            self.step();
        }
    }

    /// The vectors at the present state, for a checkpoint.
    pub(crate) fn saved(&self) -> Option<Vec<SavedVector>> {
        self.run.saved(i64::try_from(self.steps).unwrap_or(i64::MAX))
    }

    /// Goes on from the vectors of a checkpoint; whether they can be read.
    pub(crate) fn restore(&mut self, n: i64, saved: &[SavedVector]) -> bool {
        self.steps = n.unsigned_abs();
        self.run.restore(saved)
    }

    /// The vectors at the last state.
    pub fn end(&mut self) -> &dyn TangentRun {
        if !self.steps.is_multiple_of(self.every) {
            self.observe();
        }
        &*self.run
    }

    fn observe(&mut self) {
        let t = self.run.time().unwrap_or(self.h * self.steps as f64);
        self.run.observe(t);
    }
}

impl FollowingVectors {
    /// Vectors beside the steps of a system from t = 0, measured every `every` steps.
    ///
    /// # Errors
    /// A potential that the caller computes, whose second derivatives are not known; more digits than numbers of limbs
    /// have; more vectors than a state has components; a start where the flows have no derivatives.
    pub fn new(
        arithmetic: Arithmetic,
        system: &System,
        steps: Steps<'_>,
        (vectors, every): (Vectors, u64),
    ) -> Result<Self, Error> {
        refuse(system, vectors)?;
        let run = match arithmetic.limbs_of_derivatives()? {
            None => tangents::<f64>(system, steps, vectors, &()),
            Some(limbs) => tangents::<AnyLimbs>(system, steps, vectors, &limbs),
        }?;
        let h = steps.h.exact().to_f64().expect("every rational has a nearest f64");
        Ok(FollowingVectors { run, h, every: every.max(1), steps: 0 })
    }
}

/// Refuses forces whose derivatives are not known.
pub(crate) fn needs_second_derivatives(system: &System) -> Result<(), Error> {
    match &system.potential {
        PotentialEnergy::Own(own) => Err(Error::usage(
            format!("tangent vectors need second derivatives, which {} has not", own.name()),
            "give the potential as a formula",
        )),
        _ => Ok(()),
    }
}

fn refuse(system: &System, vectors: Vectors) -> Result<(), Error> {
    needs_second_derivatives(system)?;
    let (Vectors::Free(count) | Vectors::Orthonormal(count)) = vectors;
    let most = 2 * system.dimension();
    match count {
        0 => Err(Error::usage("there are no tangent vectors", "ask for one at least")),
        _ if count > most => Err(Error::usage(
            format!("{count} tangent vectors are linearly dependent, as a state has {most} components"),
            format!("ask for {most} or fewer"),
        )),
        _ => Ok(()),
    }
}

/// Which vectors there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vectors {
    /// This number of vectors, which evolve freely.
    Free(usize),
    /// This number of vectors, which are made orthonormal at each observation.
    Orthonormal(usize),
}

impl Arithmetic {
    /// The limbs of dual numbers with which runs are followed; `None` in double precision.
    ///
    /// States have the bits of a run, in double precision and in numbers of limbs; runs in other numbers are followed
    /// in numbers of at least as many limbs.
    ///
    /// # Errors
    /// More digits than numbers of limbs have.
    pub(crate) fn limbs_of_derivatives(self) -> Result<Option<LimbCount>, Error> {
        let bits = match self.numbers() {
            Numbers::Double => return Ok(None),
            Numbers::DoubleDouble => DoubleDouble::precision(&()).in_bits(),
            Numbers::Digits(_, Digits::Limbs(count)) => return Ok(Some(count)),
            #[cfg(feature = "mpfr")]
            Numbers::Digits(_, Digits::Mpfr(precision)) => precision.in_bits(),
        };
        LimbCount::of_bits(bits).map(Some).ok_or_else(|| {
            let most = Precision::of_limbs(LimbCount::MOST.get()).in_digits();
            let message = format!("derivatives have at most {most} digits, and the run has {}", self.digits());
            Error::usage(message, "write fewer digits in [run]")
        })
    }
}

/// The system at its first state with vectors, each beside states of its own. Their directions are always the same
/// ones, and none of them is special.
fn tangents<N: CorrectlyRounded + 'static>(
    system: &System,
    steps: Steps<'_>,
    vectors: Vectors,
    context: &N::Context,
) -> Result<Box<dyn ResumableRun>, Error>
where
    Dual<N>: SceneNumber<Context = N::Context>,
{
    let (Vectors::Free(count) | Vectors::Orthonormal(count)) = vectors;
    let integrators = (0..count).map(|k| with_vector(system, steps, k, context));
    let integrators = integrators.collect::<Result<Vec<_>, _>>()?;
    let tangents = match vectors {
        Vectors::Free(_) => Tangents::new(integrators),
        Vectors::Orthonormal(_) => Tangents::orthonormal(integrators),
    };
    let tangents = tangents.map_err(|error| Error::run(error.to_string(), "choose another initial state"))?;
    Ok(Box::new(InNumbers { tangents, transformed: system.transformed_time().is_some() }))
}

/// The system at its first state with the vector k.
fn with_vector<N: CorrectlyRounded + 'static>(
    system: &System,
    steps: Steps<'_>,
    k: usize,
    context: &N::Context,
) -> Result<SceneIntegrator<Dual<N>>, MotionError>
where
    Dual<N>: SceneNumber<Context = N::Context>,
{
    let (mut q, mut p) = system.start::<Dual<N>>(context);
    let [of_q, of_p] = scales(system);
    point(&mut q, k, (0, &of_q), context);
    point(&mut p, k, (q.len(), &of_p), context);
    system.integrator(steps, (q, p), context)
}

/// The components of the vector k along these coordinates, the first of which has the number `first`, with these
/// scales.
fn point<N: CorrectlyRounded>(
    coordinates: &mut [Dual<N>],
    k: usize,
    (first, scales): (usize, &[f64]),
    context: &N::Context,
) {
    let components = components(&coordinates.iter().map(Real::to_f64).collect::<Vec<_>>(), k, (first, scales));
    for (x, component) in coordinates.iter_mut().zip(components) {
        let exact = Rational::from_float(component).expect("the size is finite");
        x.derivatives = [N::from_rational(&exact, context)];
    }
}

/// Components of the size of the largest coordinate, in units of their scales: fractional parts of multiples of
/// irrational numbers, minus ½.
pub(crate) fn components(coordinates: &[f64], k: usize, (first, scales): (usize, &[f64])) -> Vec<f64> {
    let in_scales =
        coordinates.iter().zip(scales).filter(|(_, scale)| **scale > 0.0).map(|(x, scale)| (x / scale).abs());
    let largest = in_scales.fold(0.0, f64::max);
    let size = if largest > 0.0 && largest.is_finite() { largest } else { 1.0 };
    let component = |(i, scale): (usize, &f64)| {
        let turns = (i + 1) as f64 * 2_f64.sqrt() + (k + 1) as f64 * ((i + 2) as f64).sqrt().fract() * 3_f64.sqrt();
        size * scale * (turns.fract() - 0.5)
    };
    (first..).zip(scales).map(component).collect()
}

/// The scales of positions, and of momenta: masses, so that the first vectors displace velocities alike.
pub(crate) fn scales(system: &System) -> [Vec<f64>; 2] {
    let mut masses: Vec<f64> =
        system.exact_masses().iter().map(|mass| <f64 as Number>::from_rational(mass, &()).abs()).collect();
    masses.resize(system.dimension(), 1.0);
    let mut scales = [vec![1.0; masses.len()], masses];
    if system.explicit_time {
        // the displaced trajectory is one at the same time
        scales.iter_mut().for_each(|scales| scales[system.q.len() - 1] = 0.0);
    }
    scales
}

struct InNumbers<N: CorrectlyRounded> {
    tangents: Tangents<SceneIntegrator<Dual<N>>>,
    transformed: bool,
}

impl<N: CorrectlyRounded> TangentRun for InNumbers<N> {
    fn step(&mut self) {
        self.tangents.step();
    }

    fn observe(&mut self, t: f64) {
        self.tangents.observe(t);
    }

    fn separate(&mut self) {
        self.tangents.separate();
    }

    fn time(&self) -> Option<f64> {
        let state = self.tangents.integrators()[0].state();
        state.q().last().filter(|_| self.transformed).map(Real::to_f64)
    }

    fn growths(&self) -> Vec<&Growth> {
        match self.tangents.are_free() {
            true => (0..self.tangents.count()).map(|vector| self.tangents.growth(vector, 0)).collect(),
            false => self.tangents.spectrum(0),
        }
    }

    fn sali(&self) -> Option<f64> {
        (self.tangents.are_free() && self.tangents.count() >= 2).then(|| self.tangents.sali(0))
    }

    fn gali(&self) -> Option<f64> {
        let count = self.tangents.count();
        (self.tangents.are_free() && count >= 3).then(|| self.tangents.gali(count, 0))
    }
}

impl<N: CorrectlyRounded> ResumableRun for InNumbers<N> {
    fn saved(&self, n: i64) -> Option<Vec<SavedVector>> {
        let exponents = self.tangents.exponents()?;
        let combinations = self.tangents.combinations();
        // a vector that depends on those before it has a logarithm of −∞
        let text = |x: &f64| x.is_finite().then(|| x.to_text());
        let saved = |(i, integrator): (usize, &SceneIntegrator<Dual<N>>)| {
            let (state, remainders) = (integrator.state(), integrator.state().remainders());
            let part = |part: fn(&Dual<N>) -> &N| {
                let of = |numbers: &[Dual<N>]| numbers.iter().map(part).cloned().collect::<Vec<_>>();
                let remainders = Remainders { q: of(&remainders.q), p: of(&remainders.p) };
                SavedState::of(&Snapshot { n, q: of(state.q()), p: of(state.p()), remainders })
            };
            Some(SavedVector {
                state: part(|x| &x.value)?,
                derivatives: part(|x| &x.derivatives[0])?,
                exponent: exponents[i],
                growth: self.tangents.growth(i, 0).parts().map(|part| part.to_text()).to_vec(),
                combination: combinations[i].iter().map(text).collect::<Option<_>>()?,
            })
        };
        self.tangents.integrators().iter().enumerate().map(saved).collect()
    }

    fn restore(&mut self, saved: &[SavedVector]) -> bool {
        let growths: Option<Vec<Growth>> = saved.iter().map(SavedVector::growth).collect();
        let Some(combinations) = saved.iter().map(SavedVector::combination).collect::<Option<Vec<_>>>() else {
            return false;
        };
        let mut integrators = self.tangents.integrators_mut().iter_mut().zip(saved);
        let Some(growths) = growths.filter(|_| integrators.all(|(own, saved)| set_state(own, saved).is_some())) else {
            return false;
        };
        self.tangents.resume(growths, saved.iter().map(|saved| saved.exponent).collect(), &combinations)
    }
}

/// The state ← one of a checkpoint, with its vector.
fn set_state<N: CorrectlyRounded>(integrator: &mut SceneIntegrator<Dual<N>>, saved: &SavedVector) -> Option<()> {
    let context = integrator.state().context();
    let ((q, p), remainders) = saved.state.numbers::<N>(&context)?;
    let ((of_q, of_p), of_remainders) = saved.derivatives.numbers::<N>(&context)?;
    let dual = |numbers: &[N], derivatives: &[N]| with_derivatives(numbers, [derivatives]);
    let state = integrator.system().state_mut();
    state.set(&dual(&q, &of_q), &dual(&p, &of_p));
    let (q, p) = (dual(&remainders.q, &of_remainders.q), dual(&remainders.p, &of_remainders.p));
    state.set_remainders(&Remainders { q, p });
    Some(())
}

#[cfg(test)]
mod tests {
    //! Protects the derivatives of all kinds of systems: beside differences of nearby trajectories with 57 digits, and
    //! in double precision beside those.

    use shadowstep::number::Number;
    use shadowstep::tables::Source;
    use shadowstep::tangent::vector;
    use shadowstep::{Carried, Integrator as _};

    use super::*;
    use crate::Scene;
    use crate::document::shipped::{SHIPPED_SCENES, scene_text};
    use crate::run::start::Begin;

    const STEPS: usize = 3;

    /// Numbers of 57 digits.
    fn long() -> LimbCount {
        LimbCount::of_bits(192).unwrap()
    }

    /// The state after some steps from the first one, moved by `distance` along the first vector.
    fn moved(scene: &Scene, distance: &str) -> Vec<AnyLimbs> {
        let context = &long();
        let (mut q, mut p) = scene.system.start::<Dual<AnyLimbs>>(context);
        let [of_q, of_p] = scales(&scene.system);
        point(&mut q, 0, (0, &of_q), context);
        point(&mut p, 0, (q.len(), &of_p), context);
        let distance = AnyLimbs::from_rational(&shadowstep::exact(distance).unwrap(), context);
        let plain = |x: &Dual<AnyLimbs>| {
            let mut moved = x.value;
            moved.add_product(&x.derivatives[0], &distance);
            moved
        };
        let state = (q.iter().map(plain).collect(), p.iter().map(plain).collect());
        let mut integrator = scene.system.integrator(scene.steps_from(Begin::InitialState), state, context).unwrap();
        (0..STEPS).for_each(|_| integrator.step(Carried::Nothing));
        integrator.state().q().iter().chain(integrator.state().p()).copied().collect()
    }

    fn after<N: CorrectlyRounded>(scene: &Scene, context: &N::Context) -> SceneIntegrator<Dual<N>>
    where
        Dual<N>: SceneNumber<Context = N::Context>,
    {
        let mut found = with_vector(&scene.system, scene.steps_from(Begin::InitialState), 0, context).unwrap();
        (0..STEPS).for_each(|_| found.step(Carried::Nothing));
        found
    }

    fn check(name: &str, text: String) {
        let scene =
            Scene::read(Source { path: name.to_owned(), text }).unwrap_or_else(|error| panic!("{name}: {error}"));
        let exact = vector(after::<AnyLimbs>(&scene, &long()).state(), 0);
        // central differences of 10⁻¹⁹: an error of the size 10⁻³⁸ in 57 digits
        let (plus, minus) = (moved(&scene, "1e-19"), moved(&scene, "-1e-19"));
        let size = exact.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        for (i, derivative) in exact.iter().enumerate() {
            let mut difference = plus[i];
            difference.subtract(&minus[i]);
            difference.multiply(&AnyLimbs::from_rational(&shadowstep::exact("5e18").unwrap(), &long()));
            difference.subtract(derivative);
            let error = difference.to_f64().abs() / size;
            assert!(
                error < 1e-27,
                "{name}, component {i}: {} is wrong by {error:.1e} of the largest",
                derivative.to_f64()
            );
        }
        let double = after::<f64>(&scene, &());
        let plain = {
            let (start, steps) = (scene.system.start::<f64>(&()), scene.steps_from(Begin::InitialState));
            let mut plain = scene.system.integrator(steps, start, &()).unwrap();
            (0..STEPS).for_each(|_| plain.step(Carried::Nothing));
            plain
        };
        let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let values = |x: &[Dual<f64>]| x.iter().map(|x| x.value.to_bits()).collect::<Vec<_>>();
        assert_eq!(values(double.state().q()), bits(plain.state().q()), "{name}");
        assert_eq!(values(double.state().p()), bits(plain.state().p()), "{name}");
        for (i, (short, exact)) in vector(double.state(), 0).iter().zip(&exact).enumerate() {
            let error = (short - exact.to_f64()).abs() / size;
            assert!(error < 1e-9, "{name}, component {i}: {short} and {}", exact.to_f64());
        }
    }

    #[test]
    fn derivatives_of_other_systems() {
        let run =
            "[run]\nscheme = \"SCHEME\"\nstep = \"1/10\"\nsteps = 10\ndigits = \"double\"\n[output]\nenergy = true\n";
        let initial = "[initial]\nq = [\"2/5\", \"1/10\"]\np = [\"1/7\", 1]\n";
        let formula = "[problem]\ncoordinates = [\"x\", \"y\"]\npotential = \"x^2/2 + 2*y^2 + sin(x)*exp(-y)*x^4\"\n";
        for (name, problem, scheme) in [
            ("linear parts", format!("{formula}parts = \"linear\"\n{initial}"), "yoshida4"),
            ("gradient kicks", format!("{formula}{initial}"), "chin-4a"),
            ("displaced forces", format!("{formula}{initial}"), "chin-4a\"\ngradient_kicks = \"displaced"),
            ("kinetic", format!("{formula}kinetic = \"sqrt(1 + px^2 + py^2)\"\n{initial}"), "yoshida4"),
            (
                "a cutoff in a box",
                "[problem]\npair = \"1/r2^6 - 1/r2^3\"\nbodies = 5\ndimensions = 3\nbox = 8\ncutoff = { at = 3, from \
                    = 2, derivatives = 3 }\n\
                 [initial]\nq = [[0,0,0],[1,\"1/3\",0],[\"5/2\",0,1],[0,7,\"15/2\"],[3,3,3]]\np = \
                 [[0,0,0],[1,0,0],[0,0,1],[0,0,0],[0,1,0]]\n"
                    .to_owned(),
                "yoshida4",
            ),
            ("springs", "[problem]\nname = \"fput-alpha\"\n".to_owned(), "blanes-moan-srkn6b"),
            (
                "the power of time",
                "[problem]\nname = \"kepler\"\n[time]\ntransform = \"power\"\nexponent \
                = \"-1/2\"\n"
                    .to_owned(),
                "yoshida4",
            ),
        ] {
            check(name, format!("{problem}{}", run.replace("SCHEME", scheme)));
        }
    }

    #[test]
    fn derivatives_of_shipped_scenes() {
        let all = SHIPPED_SCENES.iter().flat_map(|(_, scenes)| *scenes);
        for shipped in all.filter(|shipped| shipped.name != "argon-liquid") {
            check(shipped.name, shipped.text.to_owned());
        }
        check("kepler", scene_text("kepler").unwrap());
    }
}
