//! The modified energy of trajectories that other programs have computed.
//!
//! A program that integrates by velocity Verlet follows a modified Hamiltonian as a [`Stepper`](crate::Stepper) does,
//! and what it logs is enough to estimate its value H̄: q and p at equal distances h in time, U, and the forces.
//! `docs/recorded-trajectories.md` lists which integrators of which programs these are.
//!
//! [`Recorded`] estimates along a log of velocity Verlet, [`Repeated`] along states of any scheme, and [`Observer`]
//! state by state, with a [diagnosis](Diagnosis) of what moves the energy.
//!
//! | module | what it is |
//! | --- | --- |
//! | `log` | the states of a log, and what is known of U there |
//! | `half_steps` | momenta of leapfrog at the times of the positions |
//! | `unwrap` | positions without jumps between the images of a periodic box |
//! | `steps` | what steps added to q, p and β |
//! | `misfit` | by how much logged states differ from that |
//! | `source` | the states of a log as a source for estimators |
//! | `repeated` | states of any scheme, with the steps between them made again |
//! | `window` | how many states that follow each other an observer needs |
//! | `observer`, `value` | follows a trajectory, state by state: the modified energy at each |
//! | `roughness` | whether the forces and U are smooth along it |
//! | `work` | what differences of the states from the steps do to the energy |
//! | `changes` | how the modified energy changes from state to state |
//! | `diagnosis` | the numbers that show what moves the energy |
//! | `thresholds`, `judge`, `rules` | from these numbers to what moves the energy |
//! | `cause`, `text`, `units` | what moves the energy, as text, in the units of a program |
//! | `error` | what a log cannot be used for |

mod cause;
mod changes;
mod diagnosis;
mod error;
mod half_steps;
mod judge;
mod log;
mod misfit;
mod observer;
mod repeated;
mod roughness;
mod rules;
mod source;
mod steps;
mod text;
mod thresholds;
mod units;
mod unwrap;
mod value;
mod window;
mod work;

pub use cause::Cause;
pub use changes::Jump;
pub use diagnosis::Diagnosis;
pub use error::RecordedError;
pub use half_steps::{integer_momenta, integer_momenta_with_gradients};
pub use log::{Derivatives, Log, Logged, MadeStep};
pub use misfit::{Differences, Largest};
pub use observer::Observer;
pub use repeated::Repeated;
pub use roughness::Smoothness;
pub use source::Recorded;
pub use units::Units;
pub use unwrap::Unwrapping;
pub use value::Value;
pub use window::Window;
