//! Trajectories with the states that an estimator needs on both sides, and the energy drift.
//!
//! | module | what it is |
//! | --- | --- |
//! | `state` | a state, and the trait of all that gives states in the order of time |
//! | `trajectory` | the states that a stepper makes |
//! | `shadow_run` | states with their modified energies |
//! | `drift` | max − min of the modified energy over a run |
//! | `permanent`, `intervals` | its change between states with small errors |
//! | `error` | why a run stops |

mod drift;
mod error;
mod intervals;
mod permanent;
mod shadow_run;
mod state;
mod trajectory;

pub use drift::{DriftRecorder, EnergyDrift, energy_drift};
pub use error::{NotFinite, Quantity, RunError};
pub(crate) use error::{check_energy, check_value};
pub use permanent::{Finding, PermanentChange};
pub use shadow_run::ShadowRun;
pub(crate) use state::last;
pub use state::{States, TrajectoryState};
pub use trajectory::Trajectory;
