//! Splitting schemes with proved orders, and the modified ("shadow") energy along the trajectories they make, in any
//! precision.
//!
//! A scheme is a table of exact numbers. The attribute [`splitting_scheme`] proves what the table claims while your
//! crate compiles, and writes the steps; a claim that does not hold is a compile error.
//!
//! ```
//! use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, splitting_scheme};
//!
//! #[splitting_scheme("yoshida4.toml")]
//! pub struct Yoshida4;
//!
//! let stepper = Stepper::new(Yoshida4, "1/20")?;
//! let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?;
//! for _ in 0..1000 {
//!     stepper.step(&mut motion);
//! }
//! assert!((motion.energy() + 0.5).abs() < 1e-3);
//! assert_eq!(motion.evaluations(), 3001); // three a step, and one to begin
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The numbers may be `f64`, [`number::Limbs`] of 38 to 307 digits or, with the feature `mpfr`, `rug::Float` at any
//! precision. The energy oscillates; the *modified* energy, which the scheme conserves almost exactly, does not:
//!
//! ```
//! use shadowstep::{Motion, Real, Stepper, UnitMasses, problems::Kepler, shadow::Central, shadow::run::energy_drift, splitting_scheme};
//!
//! #[splitting_scheme("stormer-verlet.toml")]
//! pub struct StormerVerlet;
//!
//! let motion = Motion::exact(Kepler, UnitMasses, ["2/5", "0"], ["0", "2"], 120)?; // 120 digits
//! let verlet = Stepper::with_context(StormerVerlet, "1/40", &motion.context())?;
//! let found = energy_drift(verlet.with(motion), 400, &Central::fixed(20))?;
//! assert!(found.drift.to_f64() < 1e-9); // the energy itself changes by 1e-3
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! H = T(p) + U(q), and both may be formulas, of which the derivatives are found while your crate compiles. A T that is
//! not quadratic needs a scheme whose order holds for every T(p); with another one this does not compile:
//!
//! ```
//! use shadowstep::{Motion, Stepper, kinetic, potential, shadow::run::energy_drift, shadow::Central, splitting_scheme};
//!
//! #[splitting_scheme("yoshida4.toml")]
//! pub struct Yoshida4;
//!
//! kinetic! { pub struct Relativistic; T(p) = sqrt(1 + p^2) }
//! potential! { pub struct Spring; U(q) = q^2/2 }
//!
//! let motion = Motion::new(Spring, Relativistic, [1.0], [0.0])?;
//! let found = energy_drift(Stepper::new(Yoshida4, "1/10")?.with(motion), 400, &Central::fixed(8))?;
//! assert!(found.drift < 1e-8); // the energy itself changes by 8e-7
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Features
//!
//! | feature | what it adds |
//! | --- | --- |
//! | `tables` | schemes read from tables while the program runs, and the shipped ones by name: `tables` |
//! | `formulas` | energies and parts read as formulas at run time: `systems::formula`, `systems::many_parts::parts` |
//! | `mpfr` | MPFR's numbers of any precision |
//! | `serde` | settings of estimators in JSON and similar formats |
//!
//! None is on by default, and the macros need none.
//!
//! # Rooms
//!
//! The library is six rooms; each uses only what stands before it:
//!
//! | room | what it is |
//! | --- | --- |
//! | [`number`] | numbers that compute in place: `f64`, several of them in lanes, double-double, limbs, MPFR |
//! | [`systems`] | Hamiltonian systems, their states, and the exact flows of their parts |
//! | [`steps`] | schemes, steppers, integrators |
//! | [`tangent`] | tangent maps: indicators of chaos, derivatives of states |
//! | [`shadow`] | estimators of the modified energy, the [monitor](shadow::ShadowEnergy), trajectories and [energy drifts](shadow::run) |
//! | the root | what most programs need; with its traits in the [`prelude`] |

// links to what a feature adds are resolved in documentation with that feature, as docs.rs has it
#![cfg_attr(not(all(feature = "tables", feature = "formulas")), allow(rustdoc::broken_intra_doc_links))]

// generated code refers to `::shadowstep`, in this crate too
extern crate self as shadowstep;

pub mod number;
pub mod prelude;
pub mod shadow;
pub mod steps;
pub mod systems;
pub mod tangent;

#[doc(inline)]
pub use number::{Number, Real};
#[doc(inline)]
pub use shadowstep_macros::{kinetic, potential, splitting_scheme};
#[doc(inline)]
pub use shadowstep_schemes::symbolic::{Rational, exact};
#[cfg(feature = "tables")]
#[doc(inline)]
pub use steps::tables;
#[doc(inline)]
pub use steps::{
    integrator::Integrator,
    scheme::{Scheme, SchemeProperties, ValidFor},
    step_size::{StepSize, StepSizeError},
    stepper::Stepper,
};
#[doc(inline)]
pub use systems::{
    coordinates::Coordinates,
    increments::{Carried, Increments, OwnedIncrements},
    kinetic::{DiagonalMasses, FullMasses, Kinetic, UnitMasses},
    motion::{Motion, MotionError},
    potential::Potential,
    potential_check::check_potential,
    problems,
    state::{State, VectorState},
    summation::Remainders,
    system::System,
};
