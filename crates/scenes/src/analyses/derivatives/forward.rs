//! Forwards: a tangent vector for each variable.

use shadowstep::number::{AnyLimbs, Dual};
use shadowstep::steps::integrator::at_output;
use shadowstep::steps::together::{Together, follow};
use shadowstep::{Carried, Integrator as _};

use super::{Array, Base, Begun, Differentiation, output};
use crate::run::start::SceneIntegrator;
use crate::scene::SceneNumber;
use crate::scene::split::ShownCoordinates;
use crate::texts::error::Error;
use crate::watch::observer::{Observer, report};

/// The states of a run with their derivatives.
#[derive(Clone, Debug)]
pub struct Derivatives {
    /// The numbers of the states.
    pub n: Vec<u64>,
    /// q and then p, one state after the other.
    pub states: Array,
    /// By each variable: the derivatives of these, in the same form.
    pub by: Vec<Array>,
}

impl Differentiation<'_> {
    /// Makes the run with a tangent vector for each variable.
    ///
    /// # Errors
    /// A state or a derivative that is not finite; forces of the caller, which have no second derivatives; a parameter
    /// by which derivatives are not known; more digits than numbers of limbs have; an observer that stops.
    pub fn forward(&self, observer: &mut dyn Observer) -> Result<Derivatives, Error> {
        let bases = self.bases()?;
        match self.arithmetic.limbs_of_derivatives()? {
            None => self.forward_in::<f64>(bases, observer, &()),
            Some(limbs) => self.forward_in::<AnyLimbs>(bases, observer, &limbs),
        }
    }

    fn forward_in<N: SceneNumber>(
        &self,
        bases: Vec<Base>,
        observer: &mut dyn Observer,
        context: &N::Context,
    ) -> Result<Derivatives, Error>
    where
        Dual<N>: SceneNumber<Context = N::Context>,
    {
        let variables = self.by.iter().zip(bases);
        let all: Result<Vec<_>, _> = variables.map(|by| self.begin::<N>(Some(by), context)).collect();
        let mut all = all?;
        if all.is_empty() {
            all.push(self.begin(None, context)?);
        }
        let mut side_by_side = SideBySide::new(self, all, context)?;
        let (mut states, mut by) = (Vec::new(), vec![Vec::new(); side_by_side.all.len()]);
        let mut rows = Vec::new();
        follow(&mut side_by_side, self.run.steps, |n, side_by_side| {
            let shown = side_by_side.shown_values();
            for (k, (begun, derivatives)) in side_by_side.all.iter_mut().zip(&mut by).enumerate() {
                let output = begun.output();
                self.check_finite(n, &output)?;
                derivatives.extend(output.iter().map(|x| x.derivatives[0].clone()));
                // the states are the same beside each vector
                states.extend(output.into_iter().filter(|_| k == 0 && shown.is_empty()).map(|x| x.value));
            }
            states.extend(shown);
            rows.push(n);
            report(observer, self.run, n)?;
            Ok::<_, Error>((self.row_after(n), Carried::Nothing))
        })?;
        let array = |numbers: &Vec<N>| Array::of(numbers, self.arithmetic);
        let by = by.iter().take(self.by.len()).map(array).collect();
        Ok(Derivatives { n: rows, states: array(&states), by })
    }
}

/// The states with each vector; beside those whose constants are differentiated at a value nearby the plain ones, which
/// are those of the run.
struct SideBySide<N: SceneNumber> {
    all: Vec<Begun<N>>,
    plain: Option<(SceneIntegrator<N>, Option<ShownCoordinates<N>>)>,
}

impl<N: SceneNumber> SideBySide<N>
where
    Dual<N>: SceneNumber<Context = N::Context>,
{
    fn new(request: &Differentiation<'_>, mut all: Vec<Begun<N>>, context: &N::Context) -> Result<Self, Error> {
        let system = request.system;
        let plain = match all.iter().any(|begun| begun.base == Base::Nearby) {
            true => {
                let integrator =
                    system.integrator::<N>(request.steps(request.run.h), system.start(context), context)?;
                Some((integrator, system.shown(context)))
            }
            false => None,
        };
        let nearby = all.iter_mut().filter(|begun| begun.base == Base::Nearby);
        nearby.zip(plain.iter().cycle()).for_each(|(begun, (plain, _))| begun.set_values(&**plain));
        Ok(SideBySide { all, plain })
    }

    /// q and then p of the plain states as they are shown, if there are any.
    fn shown_values(&mut self) -> Vec<N> {
        let Some((plain, shown)) = &mut self.plain else { return Vec::new() };
        at_output(&mut **plain, |integrator| output(integrator, shown))
    }
}

impl<N: SceneNumber> Together for SideBySide<N>
where
    Dual<N>: SceneNumber<Context = N::Context>,
{
    fn advance(&mut self, count: u64, _: Carried) {
        let (nearby, own): (Vec<_>, Vec<_>) = self.all.iter_mut().partition(|begun| begun.base == Base::Nearby);
        own.into_iter().for_each(|begun| begun.integrator.steps(count));
        let Some((plain, _)) = &mut self.plain else { return };
        let mut nearby = nearby;
        for _ in 0..count {
            plain.step(Carried::Nothing);
            for begun in &mut nearby {
                begun.integrator.step(Carried::Nothing);
                begun.set_values(&**plain);
            }
        }
    }
}
