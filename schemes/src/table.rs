//! The cells of a table and its claims, with their places in the text.
//!
#![doc = include_str!("../tables/README.md")]

use crate::claims::{Kinetic, NearIntegrable};
use crate::document::{Fault, Placed, Source};

/// The most stages a table may have, compositions written out.
pub(crate) const MOST_STAGES: usize = 2000;

/// A cell: the text of an exact expression.
pub type Cell = Placed<String>;

/// A table as written, before any cell is evaluated.
#[derive(Clone, Debug)]
pub struct Table {
    /// The text it was read from.
    pub source: Source,
    /// Short name, kebab-case.
    pub name: Placed<String>,
    /// A line for people.
    pub title: Option<String>,
    /// Other names of the scheme, as people write them.
    pub aliases: Vec<Placed<String>>,
    /// The order claimed for the kinetic energy `kinetic`.
    pub order: Placed<u32>,
    /// The kinetic energies the scheme is meant for.
    pub kinetic: Kinetic,
    /// The orders claimed for H = A + εB.
    pub near_integrable: Option<NearIntegrable>,
    /// Whether the scheme is claimed to be a palindrome.
    pub symmetric: Option<Placed<bool>>,
    /// How many digits of the cells are right, where they were rounded.
    pub digits: Option<Placed<u32>>,
    /// Who published it where; `None` for an unpublished table.
    pub reference: Option<String>,
    /// Digital object identifier, without the resolver.
    pub doi: Option<String>,
    /// Named constants in the order of the text.
    pub constants: Vec<(Placed<String>, Cell)>,
    /// The constants that are free parameters of a family, exactly as published; all others follow from them.
    pub free: Vec<Placed<String>>,
    /// The weights; `None` where they cannot be read.
    pub weights: Option<Weights>,
    /// The processor of a processed scheme, whose kernel are the weights.
    pub processor: Option<Processor>,
    /// The inner scheme of multiple time steps, whose outer scheme are the weights.
    pub inner: Option<Inner>,
}

impl Table {
    /// The fault of more than [`MOST_STAGES`].
    pub(crate) fn too_long(&self, stages: usize) -> Fault {
        let message = format!("{stages} stages are too many");
        self.source.fault(&self.name.at, message).hint(format!("at most {MOST_STAGES} are allowed"))
    }
}

/// What an inner scheme is, as written.
#[derive(Clone, Debug)]
pub struct Inner {
    /// Name or file of its table.
    pub base: Placed<String>,
    /// Its steps for each drift of the outer scheme.
    pub substeps: u32,
}

/// The processor of a table: its post-map χ⁻¹, and what is claimed of the processed step χ⁻¹ ∘ kernel ∘ χ.
#[derive(Clone, Debug)]
pub struct Processor {
    /// The effective order claimed for the kinetic energy of the table.
    pub order: Placed<u32>,
    /// The effective orders claimed for H = A + εB.
    pub near_integrable: Option<NearIntegrable>,
    /// The weights of the post-map; a composition is of the base of the kernel. `None` where they cannot be read.
    pub post: Option<Weights>,
}

/// The weights as written.
#[derive(Clone, Debug)]
pub enum Weights {
    /// a_s, c_s and b_s of the stages s = 1..S.
    Stages {
        /// Kicks a_s.
        kick: Placed<Vec<Cell>>,
        /// Gradient kicks c_s.
        gradient_kick: Option<Placed<Vec<Cell>>>,
        /// Drifts b_s.
        drift: Placed<Vec<Cell>>,
    },
    /// A base scheme with the steps γ_1 h, γ_2 h, ….
    Composition {
        /// Name or file of the base scheme's table.
        base: Placed<String>,
        /// The γ's.
        gamma: Placed<Vec<Cell>>,
    },
}
