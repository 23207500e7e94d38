//! Forwards: a tangent vector for each variable.

use shadowstep::Integrator as _;
use shadowstep::number::Dual;

use super::{Array, Differentiation};
use crate::computation::RunNumber;
use crate::error::Error;
use crate::observer::{Observer, report};
use crate::scene::SceneNumber;
use crate::tangent::WithDerivatives;

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
    /// A state or a derivative that is not finite; forces of the caller, which have no second derivatives; a parameter by which derivatives are not
    /// known; more digits than numbers of limbs have; an observer that stops.
    pub fn forward(&self, observer: &mut dyn Observer) -> Result<Derivatives, Error> {
        self.refuse()?;
        self.arithmetic.compute_with_derivatives(Forward { request: self, observer })?
    }
}

struct Forward<'a, 'o> {
    request: &'a Differentiation<'a>,
    observer: &'o mut dyn Observer,
}

impl WithDerivatives for Forward<'_, '_> {
    type Output = Result<Derivatives, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output
    where
        Dual<N>: SceneNumber<Context = N::Context>,
    {
        let Forward { request, observer } = self;
        let mut all =
            request.by.iter().map(|by| request.begin::<N>(Some(by), context)).collect::<Result<Vec<_>, _>>()?;
        if all.is_empty() {
            all.push(request.begin(None, context)?);
        }
        let (mut states, mut by) = (Vec::new(), vec![Vec::new(); all.len()]);
        let rows = request.rows();
        let mut n = 0;
        for row in &rows {
            for (k, (begun, derivatives)) in all.iter_mut().zip(&mut by).enumerate() {
                begun.integrator.steps(row - n);
                let output = begun.output();
                request.check_finite(*row, &output)?;
                derivatives.extend(output.iter().map(|x| x.derivatives[0].clone()));
                // the states are the same beside each vector
                states.extend(output.into_iter().filter(|_| k == 0).map(|x| x.value));
            }
            n = *row;
            report(observer, request.run, n)?;
        }
        let array = |numbers: &Vec<N>| Array::of(numbers, request.arithmetic);
        let by = by.iter().take(request.by.len()).map(array).collect();
        Ok(Derivatives { n: rows, states: array(&states), by })
    }
}
