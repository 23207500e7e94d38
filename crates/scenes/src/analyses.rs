//! What is computed of runs and of schemes, as records.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`chaos`] | whether a trajectory is chaotic, by tangent vectors |
//! | [`derivatives`] | derivatives of a run by the initial state, the step size and numbers of the scene, forwards and backwards |
//! | [`drift`] | the drift of the modified energy of a run, and that on the exact flow |
//! | [`estimates`] | the modified energies along such a run |
//! | [`ensemble`] | many trajectories of a family of scenes |
//! | [`sampling`] | schemes for Hamiltonian Monte Carlo on a Gaussian target |
//! | [`scheme_record`] | everything that is known about a scheme |

pub mod chaos;
pub mod derivatives;
pub mod drift;
pub mod ensemble;
pub mod estimates;
pub mod sampling;
pub mod scheme_record;
