//! How good a proved splitting scheme is, and more digits for weights as papers print them.
//!
//! | module | what it computes |
//! | --- | --- |
//! | `analysis` | [`Analysis`]: everything below for one scheme, and the sizes of its weights |
//! | [`error`](mod@error), [`bracket`], `logarithm` | the leading error: the terms of lowest order in the logarithm of a step |
//! | [`modified`] | the whole logarithm up to a power of h: the modified Hamiltonian as a series in brackets |
//! | [`trace`] | the trace of a step of the harmonic oscillator, and the leading error of its phase |
//! | [`oscillator`] | matrix, trace and phase of a step of the harmonic oscillator at a given hω, in f64 |
//! | [`sampling`] | what schemes for Hamiltonian Monte Carlo minimise: the largest expected error of the energy |
//! | `closed_gaps` | conditions for weights whose step has no instability where it turns by a multiple of π |
//! | [`gaussian`] | Gaussian targets, and how often a proposal of Hamiltonian Monte Carlo is accepted |
//! | [`proposals`] | the proposals of a scheme: error, acceptance, cost, and the steps for which it is least |
//! | `period` | the part that a step repeats: it is stable where the step is |
//! | `powers` | double roots of the trace ∓ 2 that the repetitions within a step explain |
//! | [`stability`], `roots`, `squarefree` | where the harmonic oscillator is stable: roots of integer polynomials |
//! | [`resonance`] | where multiple time steps are in resonance with a fast oscillation |
//! | `prime` | residues modulo a prime, for `bracket`, `squarefree` and `powers` |
//! | `better` | [`best_for_every_kinetic`]: the shipped scheme to use for a T(p) that is not quadratic |
//! | [`sources`], `known` | source code → the schemes in it; which shipped scheme a scheme is, by its weights |
//! | [`certificate`] | the proof of an order, for other programs to check |
//! | [`search`] | what a scheme shall be → tables that meet the order conditions and make an error or another measure least |
//! | [`polish`](mod@polish) | a table of printed decimals → one whose order conditions hold to more digits |
//!
//! Compiling a user's crate does not need any of this: the macros and the runtime depend on `shadowstep-schemes` only.

mod analysis;
mod better;
pub mod bracket;
pub mod certificate;
mod closed_gaps;
pub mod error;
mod floats;
pub mod gaussian;
mod known;
mod logarithm;
pub mod modified;
pub mod oscillator;
mod period;
pub mod polish;
mod powers;
mod prime;
pub mod proposals;
pub mod resonance;
mod roots;
pub mod sampling;
pub mod search;
pub mod sources;
mod squarefree;
pub mod stability;
pub mod trace;

pub use analysis::{Analysis, Sizes};
pub use better::best_for_every_kinetic;
pub use known::{Known, Likeness};
