//! How a system moves by a scheme.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`propagator`] | what advances a state: a scheme, or the exact flow |
//! | [`tangent`] | tangent vectors beside it, with indicators of chaos |
//! | [`lanes`] | several systems as one system of lanes |
//! | `frequency`, [`stability`] | the fastest oscillation at the start, and the stability limit of the scheme |
//! | [`modified_hamiltonian`] | the Hamiltonian whose flow the steps follow, as a series of formulas |

pub(crate) mod frequency;
pub mod lanes;
pub mod modified_hamiltonian;
pub mod propagator;
pub mod stability;
pub mod tangent;
