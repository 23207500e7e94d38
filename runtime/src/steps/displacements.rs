//! How far the gradient kicks of a scheme displace positions.

use thiserror::Error;

use crate::Rational;
use crate::number::Real;
use crate::steps::scheme::Scheme;
use crate::systems::displaced::Displacements;
use crate::systems::maps::MapKind;

/// A scheme whose gradient kicks no displaced forces can replace.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum DisplacementError {
    /// There is no gradient kick.
    #[error("{scheme} has no gradient kicks that displaced forces could replace")]
    NoGradientKicks {
        /// The scheme's name.
        scheme: String,
    },
    /// A gradient kick stands alone.
    #[error("{scheme} has a gradient kick without a kick at the same q, whose force could be displaced")]
    NoKick {
        /// The scheme's name.
        scheme: String,
    },
    /// The weight of a gradient kick does not tell which kick it belongs to.
    #[error(
        "{scheme} has gradient kicks of equal weight with kicks of different weights: forces cannot be displaced for both"
    )]
    Ambiguous {
        /// The scheme's name.
        scheme: String,
    },
}

shadowstep_schemes::debug_as_text!(DisplacementError);

/// The displacements of a scheme with the step size h; `weights` are the numbers 2h³c.
pub(crate) fn displacements<N: Real>(
    scheme: &impl Scheme,
    h: &Rational,
    weights: &[N],
) -> Result<Displacements<N>, DisplacementError> {
    let name = || scheme.summary().name.to_owned();
    let exact = scheme.exact_weights();
    let mut found: Vec<Option<Rational>> = vec![None; weights.len()];
    for stage in scheme.sequence().maps.split(|(kind, _)| *kind == MapKind::Drift) {
        let Some((_, gradient)) = stage.iter().find(|(kind, _)| *kind == MapKind::GradientKick) else { continue };
        let kick = stage.iter().find(|(kind, _)| *kind == MapKind::Kick);
        let (_, kick) = kick.ok_or_else(|| DisplacementError::NoKick { scheme: name() })?;
        let ratio = &exact.gradient_kicks[*gradient] / &exact.kicks[*kick];
        match &found[*gradient] {
            Some(known) if *known != ratio => return Err(DisplacementError::Ambiguous { scheme: name() }),
            _ => found[*gradient] = Some(ratio),
        }
    }
    let twice_square = h * h * Rational::from_integer(2.into());
    let displacement = |(weight, ratio): (&N, Rational)| {
        (weight.clone(), N::from_rational(&(ratio * &twice_square), &weight.context()))
    };
    let known: Vec<_> = weights.iter().zip(found.into_iter().flatten()).map(displacement).collect();
    match known.is_empty() {
        true => Err(DisplacementError::NoGradientKicks { scheme: name() }),
        false => Ok(Displacements::of(known)),
    }
}
