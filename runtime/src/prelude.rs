//! What most programs need: `use shadowstep::prelude::*;`
//!
//! ```
//! use shadowstep::prelude::*;
//! use shadowstep::problems::Kepler;
//!
//! #[splitting_scheme("yoshida4.toml")]
//! pub struct Yoshida4;
//!
//! let motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?;
//! let found = energy_drift(Stepper::new(Yoshida4, "1/40")?.with(motion), 1000, &Bilinear::new(8))?;
//! assert!(found.drift < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use crate::number::{Number, Real};
pub use crate::shadow::run::{Trajectory, energy_drift};
pub use crate::shadow::{Bilinear, Central, ShadowEnergy, Verdict};
pub use crate::steps::integrator::Integrator;
pub use crate::steps::scheme::{Scheme, ValidFor};
pub use crate::steps::step_size::StepSize;
pub use crate::steps::stepper::Stepper;
#[cfg(feature = "tables")]
pub use crate::steps::tables::shipped;
pub use crate::systems::kinetic::{DiagonalMasses, FullMasses, UnitMasses};
pub use crate::systems::motion::Motion;
pub use crate::systems::potential::Potential;
pub use crate::systems::system::System;
pub use crate::{Rational, exact, kinetic, potential, splitting_scheme};
