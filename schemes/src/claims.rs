//! What a table may claim of its scheme.

use std::fmt::{self, Display, Formatter};

use crate::document::Placed;
use crate::map_kind::MapKind;

/// The highest order that can be claimed and proved.
pub const HIGHEST_ORDER: u32 = 10;

/// The highest order that can be claimed and proved for a power of ε: the words with few B's are few.
pub(crate) const HIGHEST_NEAR_INTEGRABLE_ORDER: u32 = 12;

/// The same for the terms of ε alone, where higher powers have an order of their own: of each length there is one word
/// with one B.
pub(crate) const HIGHEST_LINEAR_ORDER: u32 = 20;

/// The kinetic energies for which a scheme is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kinetic {
    /// Every T(p).
    Any,
    /// T = ½ pᵀM⁻¹p only (Runge–Kutta–Nyström schemes).
    Quadratic,
}

impl Display for Kinetic {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(if *self == Kinetic::Any { "every T(p)" } else { "quadratic T" })
    }
}

/// The orders claimed for H = A + εB.
#[derive(Clone, Debug, PartialEq)]
pub struct NearIntegrable {
    /// For the terms of ε, ε², …, the last one for all higher powers too; they do not increase.
    pub orders: Vec<Placed<u32>>,
    /// The map that moves by A.
    pub dominant: MapKind,
}
