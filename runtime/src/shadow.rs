//! Estimators of the modified energy H̄ at a state of a trajectory.
//!
//! The states (p, q, β) of a trajectory lie on the flow of the modified Hamiltonian H̄ and of its homogeneous extension,
//! for which β' = q̄ᵀH̄_q + p̄ᵀH̄_p − 2H̄. So H̄ = ½(−q̄ᵀp̄' + p̄ᵀq̄' − β') (Moan & Niesen, eq. skModEn), and the
//! derivatives can be had from neighbouring states.
//!
//! # Double precision
//!
//! An estimate divides differences of states by h, and with them the round-off ε|q| of every state: an error of ε|q||p|/h. An
//! `f64` has no digits to spare for that. So the differences are sums of what the steps added ([`Increments`]), which is known to
//! ε h|p|, and the error is of size ε. Störmer–Verlet on Kepler, e = 0.6, the largest max − min of the estimates near an apocentre:
//!
//! | | differences of | E_4 | E_8 | E_16 | D_10 | D_20 | best m ≤ 20 |
//! | --- | --- | --- | --- | --- | --- | --- | --- |
//! | h = 1/20, 10⁶ steps, ± 10 steps from the last hundred | states | 2.9e-15 | 2.6e-15 | 2.4e-15 | 4.4e-15 | 4.8e-15 | 2.5e-15 |
//! | | increments | 1.1e-15 | 8.3e-16 | 1.2e-15 | 1.1e-15 | 1.2e-15 | 7.2e-16 |
//! | h = 1/1000, 12 000 steps, ± 785 steps from two | states | | 1.2e-13 | | 1.9e-13 | | 1.2e-13 (m ≤ 10) |
//! | | increments | | 2.3e-15 | | 2.4e-15 | | 1.9e-15 (m ≤ 10) |
//!
//! The modified energy of the states is another matter: the round-off of the steps moves it, in these 10⁶ steps by 3e-13. Exact
//! products and sums in place of rounded ones were tried as well; they lessen the scatter by a quarter at most.

mod bilinear;
mod central;
mod differences;
mod window;

pub use bilinear::{Bilinear, BilinearEstimator};
pub use central::{Central, CentralEstimator};
pub use differences::Stop;

use crate::Rational;
use crate::motion::Increments;
use crate::number::Number;

/// A way to estimate the modified energy, from which a run makes the estimator that fits it.
pub trait Method<N: Number> {
    /// The estimator.
    type Estimator: Estimator<N>;

    /// An estimator for steps of size h ≠ 0 and states of `dimension` coordinates.
    fn estimator(&self, h: &Rational, dimension: usize, context: &N::Context) -> Self::Estimator;
}

/// Turns the states of a trajectory into modified energies.
///
/// States come in the order of time, each with what the step that led to it added to q, p and β. Once `states` of them have
/// come, every one completes an estimate: of the middle of the newest `states`, which is a state if they are odd in number,
/// and else half a step after one.
pub trait Estimator<N: Number> {
    /// How many states an estimate needs: at least 2.
    fn states(&self) -> usize;

    /// Takes the next state; gives the estimate that it completes.
    ///
    /// All states come with increments of q and p, or none of them does; the latter are subtracted from one another.
    fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) -> Option<Estimate<'_, N>>;
}

/// The modified energy at a state.
#[derive(Clone, Copy, Debug)]
pub struct Estimate<'a, N> {
    /// The modified energy.
    pub value: &'a N,
    /// Size of the last term, |T_{m,m} − T_{m−1,m−1}|, where it was asked for and m ≥ 2: an estimate of the error, no
    /// bound. Near a close encounter the error can be larger by many orders of magnitude.
    pub error: Option<&'a N>,
    /// The m of D_m, the k of the bilinear estimator.
    pub order: u32,
    /// Positions of the state in the middle, or just before it.
    pub q: &'a [N],
    /// Momenta of that state.
    pub p: &'a [N],
}
