//! The headings under which help shows the arguments that commands share.
//!
//! A heading holds for all arguments after it, also behind a flattened struct: whatever follows one has a heading of
//! its own.

pub(crate) const PROBLEM: &str = "Problem";
pub(crate) const SCHEMES: &str = "Schemes and steps";
pub(crate) const NUMBERS: &str = "Numbers";
pub(crate) const ESTIMATOR: &str = "Estimator of the modified energy";
pub(crate) const CHARTS: &str = "Charts";
pub(crate) const OUTPUT: &str = "Output";
