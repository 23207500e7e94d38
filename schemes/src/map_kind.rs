//! The kinds of maps: kicks, drifts and force-gradient kicks.

use std::fmt;

/// Which map a step begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum First {
    /// p −= h a_1 U_q(q) comes first.
    Kick,
    /// q += h b_1 M⁻¹p comes first.
    Drift,
}

/// A kick, a drift or a force-gradient kick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MapKind {
    /// p −= h w U_q(q)
    Kick,
    /// q += h w M⁻¹p
    Drift,
    /// p += h³ w ∇(U_qᵀM⁻¹U_q) = 2h³ w U_qq M⁻¹U_q, for quadratic T only.
    ///
    /// It is `exp(h³ w [K,[D,K]])` of the Lie derivatives K of the kick and D of the drift, in a product in which the
    /// map that acts first stands first. It commutes with kicks, and is not a letter of words: its exponent is a sum of
    /// them.
    GradientKick,
}

impl MapKind {
    /// The other one of kick and drift; a gradient kick remains one.
    pub fn other(self) -> MapKind {
        match self {
            MapKind::Kick => MapKind::Drift,
            MapKind::Drift => MapKind::Kick,
            MapKind::GradientKick => MapKind::GradientKick,
        }
    }

    /// The power of h that its weight is multiplied by.
    pub fn power(self) -> u32 {
        match self {
            MapKind::Kick | MapKind::Drift => 1,
            MapKind::GradientKick => 3,
        }
    }
}

/// As tables write it.
impl fmt::Display for First {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if *self == First::Kick { "kick" } else { "drift" })
    }
}

impl fmt::Display for MapKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            MapKind::Kick => "kick",
            MapKind::Drift => "drift",
            MapKind::GradientKick => "gradient kick",
        })
    }
}
