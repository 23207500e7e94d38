//! Backwards: the gradient of a function of all states, in memory that does not grow with the steps.

use shadowstep::number::{AnyLimbs, Dual};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::steps::together::follow;
use shadowstep::tangent::{Adjoint, Covector, vector};
use shadowstep::{Carried, Integrator as _, Rational, Real};

use super::{Array, Base, Begun, Differentiation, Variable};
use crate::run::start::SceneIntegrator;
use crate::scene::SceneNumber;
use crate::scene::split::ShownCoordinates;
use crate::texts::error::Error;
use crate::watch::observer::{Observer, report};

/// The gradient of a function of the states of a run.
#[derive(Clone, Debug)]
pub struct Gradient {
    /// The derivative by each variable.
    pub by: Array,
    /// How far the steps back end from the initial state: the largest error of a coordinate as a part of the largest
    /// coordinate at the start or at the end, or the same of momenta.
    pub reversal_error: f64,
}

impl Differentiation<'_> {
    /// The gradient of a function L by the variables. The covectors are ∂L/∂q and then ∂L/∂p of each state, one state
    /// after the other.
    ///
    /// The run is made once more forwards, and then backwards: see [`Adjoint`].
    ///
    /// # Errors
    /// As [`forward`](Differentiation::forward); numbers of covectors that do not fit, or are not finite.
    pub fn backward(&self, covectors: &[f64], observer: &mut dyn Observer) -> Result<Gradient, Error> {
        let bases = self.bases()?;
        if self.system.particles() > 0 {
            let message =
                "derivatives backwards are those of Hamiltonian systems, and bodies of mass 0 do not act on the others";
            return Err(Error::usage(message, "use derivatives forwards, or remove the bodies of mass 0"));
        }
        let expected = self.rows().len() * 2 * self.system.q.len();
        if covectors.len() != expected {
            let message = format!("there are {} derivatives of the function, not {expected}", covectors.len());
            return Err(Error::usage(message, "give them by q and by p of each state"));
        }
        let covectors = covectors.iter().map(|x| Rational::from_float(*x)).collect::<Option<Vec<_>>>();
        let covectors = covectors
            .ok_or_else(|| Error::usage("a derivative of the function is not finite", "give finite derivatives"))?;
        match self.arithmetic.limbs_of_derivatives()? {
            None => self.backward_in::<f64>(bases, &covectors, observer, &()),
            Some(limbs) => self.backward_in::<AnyLimbs>(bases, &covectors, observer, &limbs),
        }
    }

    fn backward_in<N: SceneNumber>(
        &self,
        bases: Vec<Base>,
        covectors: &[Rational],
        observer: &mut dyn Observer,
        context: &N::Context,
    ) -> Result<Gradient, Error>
    where
        Dual<N>: SceneNumber<Context = N::Context>,
    {
        let rows = self.rows();
        let steps = self.steps(self.run.h);
        let mut plain = self.system.integrator::<N>(steps, self.system.start(context), context)?;
        let start = values(&*plain);
        let mut n = self.run.steps;
        follow(&mut *plain, n, |n, _| {
            report(observer, self.run, n)?;
            Ok::<_, Error>((self.row_after(n), Carried::Nothing))
        })?;
        let mut begun = self.begin::<N>(None, context)?;
        begun.set_values(&*plain);
        self.check_finite(n, &begun.output())?;
        let end = values(&*plain);
        let mut backwards = Backwards::new(self, bases, begun, context)?;
        let width = covectors.len() / rows.len();
        for (row, covector) in rows.iter().zip(covectors.chunks(width)).rev() {
            for _ in *row..n {
                backwards.adjoint.step_back();
            }
            n = *row;
            report(observer, self.run, n)?;
            let covector: Vec<N> = covector.iter().map(|x| N::from_rational(x, context)).collect();
            backwards.add(&covector);
        }
        let by = backwards.by_variables();
        if let Some(by) = by.iter().find(|by| !by.is_finite()) {
            return Err(self.run.not_finite(&format!("a component of the gradient is {}: it", by.to_text())));
        }
        let reversal_error = largest_error(&start, &end, &values(&**backwards.adjoint.integrator()));
        Ok(Gradient { by: Array::of(&by, self.arithmetic), reversal_error })
    }
}

/// The covector at the present state, and what the variables have of the states that came before.
struct Backwards<N: SceneNumber> {
    adjoint: Adjoint<SceneIntegrator<Dual<N>>>,
    shown: Option<ShownCoordinates<Dual<N>>>,
    variables: Vec<AlongVariable<N>>,
}

struct AlongVariable<N: SceneNumber> {
    /// The derivative of the initial state, in the coordinates of the steps.
    of_start: Vec<N>,
    is_parameter: bool,
    shown: Option<ShownCoordinates<Dual<N>>>,
    /// By the coordinates that are shown.
    sum: N,
}

impl<N: SceneNumber> Backwards<N>
where
    Dual<N>: SceneNumber<Context = N::Context>,
{
    /// At the end of the run.
    fn new(
        request: &Differentiation<'_>,
        bases: Vec<Base>,
        end: Begun<N>,
        context: &N::Context,
    ) -> Result<Self, Error> {
        let Begun { integrator, shown, .. } = end;
        let mut adjoint = Adjoint::new(integrator);
        let mut variables = Vec::new();
        for (variable, base) in request.by.iter().zip(bases) {
            let Begun { integrator, shown, .. } = request.begin::<N>(Some((variable, base)), context)?;
            let of_start = vector(integrator.state(), 0);
            let is_parameter = matches!(variable, Variable::Parameter(_));
            if is_parameter {
                adjoint.add_parameter(integrator);
            }
            variables.push(AlongVariable { of_start, is_parameter, shown, sum: N::zero(context) });
        }
        Ok(Backwards { adjoint, shown, variables })
    }

    /// Adds the derivatives of the function by the present state.
    fn add(&mut self, covector: &[N]) {
        let Some(shown) = &mut self.shown else {
            let (of_q, of_p) = covector.split_at(covector.len() / 2);
            return self.adjoint.add(&(of_q.to_vec(), of_p.to_vec()));
        };
        let state = at_output(&mut **self.adjoint.integrator(), |at| [at.state().q(), at.state().p()].concat());
        let mut state: Vec<_> = state.into_iter().map(|x| Dual::constant(x.value)).collect();
        for variable in self.variables.iter_mut().filter(|variable| variable.is_parameter) {
            if let Some(shown) = &mut variable.shown {
                variable.sum.add(&along(shown, &state, covector));
            }
        }
        // the transposed conversion, by its columns
        let mut columns = Vec::with_capacity(state.len());
        for i in 0..state.len() {
            let one = N::from_rational(&num_traits::One::one(), &state[i].value.context());
            let zero = std::mem::replace(&mut state[i].derivatives[0], one);
            columns.push(along(shown, &state, covector));
            state[i].derivatives[0] = zero;
        }
        let of_p = columns.split_off(columns.len() / 2);
        self.adjoint.add(&(columns, of_p));
    }

    /// The derivatives by the variables, at the initial state.
    fn by_variables(&self) -> Vec<N> {
        let (of_q, of_p): Covector<N> = self.adjoint.covector();
        let by_parameters = self.adjoint.by_parameters();
        let mut by_parameters = by_parameters.iter();
        let by = |variable: &AlongVariable<N>| {
            let mut sum = variable.sum.clone();
            of_q.iter().chain(&of_p).zip(&variable.of_start).for_each(|(own, along)| sum.add_product(own, along));
            if variable.is_parameter {
                sum.add(by_parameters.next().expect("each parameter was added"));
            }
            sum
        };
        self.variables.iter().map(by).collect()
    }
}

/// The derivative of the function along the vector of a state.
fn along<N: SceneNumber>(shown: &mut ShownCoordinates<Dual<N>>, state: &[Dual<N>], covector: &[N]) -> N {
    let (q, p) = state.split_at(state.len() / 2);
    let (q, p) = shown.of_state(q, p);
    let mut sum = N::zero(&covector[0].context());
    q.iter().chain(p).zip(covector).for_each(|(x, covector)| sum.add_product(&x.derivatives[0], covector));
    sum
}

/// q and p.
fn values<N: Real>(integrator: &VectorIntegrator<'_, N>) -> [Vec<f64>; 2] {
    let values = |x: &[N]| x.iter().map(Real::to_f64).collect();
    [values(integrator.state().q()), values(integrator.state().p())]
}

/// Of q and of p: the largest difference as a part of the largest number at the start or at the end.
fn largest_error(start: &[Vec<f64>; 2], end: &[Vec<f64>; 2], back: &[Vec<f64>; 2]) -> f64 {
    let largest = |numbers: &mut dyn Iterator<Item = f64>| numbers.map(f64::abs).fold(0.0, f64::max);
    let of = |half: usize| {
        let size = largest(&mut start[half].iter().chain(&end[half]).copied());
        let error = largest(&mut start[half].iter().zip(&back[half]).map(|(a, b)| a - b));
        if error == 0.0 { 0.0 } else { error / size }
    };
    of(0).max(of(1))
}
