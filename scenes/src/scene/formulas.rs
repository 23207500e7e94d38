//! H as a sum of parts by their formulas.

use shadowstep::many_parts::{SystemOfParts, parts};
use shadowstep::number::Rounded;
use shadowstep::{MotionError, Rational};

use crate::boxed::Boxed;
use crate::scene::system::{System, borrowed};

impl System {
    /// The system of these parts at a state.
    ///
    /// # Errors
    /// A state of another dimension.
    pub(crate) fn in_formulas<N: Rounded + 'static>(
        &self,
        formulas: &[String],
        (q, p): (&[N], &[N]),
        context: &N::Context,
    ) -> Result<Boxed<N>, MotionError> {
        let (coordinates, momenta) = (borrowed(&self.coordinates), borrowed(&self.momenta));
        if q.len() != coordinates.len() {
            return Err(MotionError::Potential { coordinates: q.len(), dimension: coordinates.len() });
        }
        let exact = self.parameters.iter().map(|(name, exact)| (name.as_str(), exact.value.clone()));
        let exact: Vec<(&str, Rational)> = exact.collect();
        let parts = parts(&borrowed(formulas), (&coordinates, &momenta), &exact, context);
        let system = SystemOfParts::new(parts.expect("the formulas were read with the scene"), q, p)?;
        Ok(Boxed::ManyParts(Box::new(system)))
    }
}
