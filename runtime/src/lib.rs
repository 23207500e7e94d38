//! Splitting schemes with proved orders, and the modified ("shadow") energy along the trajectories they make, in any
//! precision.
//!
//! A scheme is a table of exact numbers. The attribute [`splitting_scheme`] proves what the table claims while your
//! crate compiles, and writes the steps; a claim that does not hold is a compile error.
//!
//! ```
//! use shadowstep::{exact, splitting_scheme, problems::Kepler, Motion, Scheme, UnitMasses};
//!
//! #[splitting_scheme("yoshida4.toml")]
//! pub struct Yoshida4;
//!
//! let h = Yoshida4.weights(&exact("1/20").unwrap(), &());
//! let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]);
//! for _ in 0..1000 {
//!     Yoshida4.step(&h, &mut motion);
//! }
//! assert!((motion.energy() + 0.5).abs() < 1e-3);
//! assert_eq!(motion.evaluations(), 3001); // three a step, and one to begin
//! ```
//!
//! The numbers may be `f64` or, with the feature `mpfr` (on by default), `rug::Float` at any precision. The energy
//! oscillates; the *modified* energy, which the scheme conserves almost exactly, does not:
//!
#![cfg_attr(feature = "mpfr", doc = "```")]
#![cfg_attr(not(feature = "mpfr"), doc = "```ignore")]
//! use shadowstep::{problems::Kepler, run::energy_drift, shadow::Central, tables, Motion, UnitMasses};
//! use shadowstep::number::{Float, Number, Precision};
//!
//! let digits = Precision::digits(120).unwrap();
//! let number = |text| Float::from_rational(&shadowstep::exact(text).unwrap(), &digits);
//! let motion = Motion::new(Kepler, UnitMasses, vec![number("0.4"), number("0")], vec![number("0"), number("2")]);
//!
//! let verlet = tables::shipped("stormer-verlet").unwrap();
//! let h = shadowstep::exact("1/40").unwrap();
//! let found = energy_drift(&verlet, motion, &h, 400, &Central::fixed(20), |_| {}).unwrap();
//! assert!(found.drift.to_f64() < 1e-9); // the energy itself changes by 1e-3
//! ```
//!
//! H = T(p) + U(q), and both may be formulas, of which the derivatives are found while your crate compiles. A T that is
//! not quadratic is moved by schemes whose order holds for every T(p); with another one this does not compile:
//!
//! ```
//! use shadowstep::{exact, kinetic, potential, run::energy_drift, shadow::Central, splitting_scheme, Motion};
//!
//! #[splitting_scheme("yoshida4.toml")]
//! pub struct Yoshida4;
//!
//! kinetic! { pub struct Relativistic; T(p) = sqrt(1 + p^2) }
//! potential! { pub struct Spring; U(q) = q^2/2 }
//!
//! let motion = Motion::new(Spring, Relativistic, [1.0], [0.0]);
//! let found = energy_drift(&Yoshida4, motion, &exact("1/10").unwrap(), 400, &Central::fixed(8), |_| {}).unwrap();
//! assert!(found.drift < 1e-8); // the energy itself changes by 8e-7
//! ```
//!
//! | file | what it is |
//! | --- | --- |
//! | [`number`] | numbers that compute in place: `f64`, MPFR, and one that counts |
//! | [`potential`](mod@potential), [`formula`], [`kinetic`](mod@kinetic), [`problems`] | H = T(p) + U(q) |
//! | [`motion`] | a state q, p, β and the maps that move it: kicks and drifts |
//! | [`scheme`], [`tables`] | steps, written out by the compiler or read from a table at run time |
//! | [`weights`] | the exact central-difference weights D_m |
//! | [`shadow`] | estimators of the modified energy, and [a monitor](shadow::ShadowEnergy) for loops of your own |
//! | [`run`] | trajectories with the states that an estimator needs on both sides, and the energy drift |
//! | `exact_flow` | states of the exact flow of a few problems, to see an estimator's own error (feature `mpfr`) |

// generated code speaks of `::shadowstep`, in this crate too
extern crate self as shadowstep;

#[cfg(feature = "mpfr")]
pub mod exact_flow;
pub mod formula;
mod interpreter;
pub mod kinetic;
pub mod motion;
pub mod number;
pub mod pairs;
pub mod potential;
pub mod problems;
pub mod run;
pub mod scheme;
pub mod shadow;
pub mod tables;
pub mod weights;

pub use kinetic::{DiagonalMasses, FullMasses, Kinetic, UnitMasses};
pub use motion::{Coordinates, Increments, Maps, Motion};
pub use number::Number;
pub use potential::Potential;
pub use scheme::{Moves, Scheme, Summary, Weights};
pub use shadowstep_macros::{kinetic, potential, splitting_scheme};
pub use shadowstep_symbolic::{Rational, exact};
