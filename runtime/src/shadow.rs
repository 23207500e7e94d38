//! Estimators of the modified energy H̄ at a state of a trajectory.
//!
//! The states (p, q, β) of a trajectory lie on the flow of the modified Hamiltonian H̄ and of its homogeneous extension,
//! for which β' = q̄ᵀH̄_q + p̄ᵀH̄_p − 2H̄. So H̄ = ½(−q̄ᵀp̄' + p̄ᵀq̄' − β') (Moan & Niesen, eq. skModEn), and the
//! derivatives can be had from neighbouring states.

mod bilinear;
mod central;
mod differences;
mod window;

pub use bilinear::{Bilinear, BilinearEstimator};
pub use central::{Central, CentralEstimator};
pub use differences::Stop;

use crate::Rational;
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
/// States come in the order of time, each with what the step that led to it added to β. Once `states` of them have
/// come, every one completes an estimate: of the middle of the newest `states`, which is a state if they are odd in number,
/// and else half a step after one.
pub trait Estimator<N: Number> {
    /// How many states an estimate needs: at least 2.
    fn states(&self) -> usize;

    /// Takes the next state; gives the estimate that it completes.
    fn push(&mut self, q: &[N], p: &[N], beta: &N) -> Option<Estimate<'_, N>>;
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
