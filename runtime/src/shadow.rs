//! Estimators of the modified energy H̄ at a state of a trajectory.
//!
//! The states $(p, q, \beta)$ of a trajectory lie on the flow of the modified Hamiltonian $\bar H$ and of its
//! homogeneous extension, for which $\beta' = \bar q^{\mathsf T} \bar H_q + \bar p^{\mathsf T} \bar H_p - 2\bar H$. So
//!
//! $$\bar H = \tfrac12 \left( -\bar q^{\mathsf T} \bar p' + \bar p^{\mathsf T} \bar q' - \beta' \right)$$
//!
//! (Moan & Niesen, eq. 3), and the derivatives are computed from neighbouring states. [`weights`] has the formulas, and
//! their proofs.
//!
//! # Double precision
//!
//! An estimate divides differences of states by h, and with them the round-off ε|q| of every state: an error of
//! ε|q||p|/h. An `f64` has too few digits for that. So the differences are sums of what the steps added
//! ([`Increments`](crate::Increments)), which is known to ε h|p|, and the error is of size ε. Störmer–Verlet on Kepler,
//! e = 0.6, the largest max − min of the estimates near an apocentre:
//!
//! | | differences of | E_4 | E_8 | E_16 | D_10 | D_20 | best m ≤ 20 |
//! | --- | --- | --- | --- | --- | --- | --- | --- |
//! | h = 1/20, 10⁶ steps, ± 10 steps from the last hundred | states | 2.9e-15 | 2.6e-15 | 2.4e-15 | 4.4e-15 | 4.8e-15 | 2.5e-15 |
//! | | increments | 1.1e-15 | 8.3e-16 | 1.2e-15 | 1.1e-15 | 1.2e-15 | 7.2e-16 |
//! | h = 1/1000, 12 000 steps, ± 785 steps from two | states | | 1.2e-13 | | 1.9e-13 | | 1.2e-13 (m ≤ 10) |
//! | | increments | | 2.3e-15 | | 2.4e-15 | | 1.9e-15 (m ≤ 10) |
//!
//! The modified energy of the states is another matter: the round-off of the steps moves it, in these 10⁶ steps by
//! 3e-13. Exact products and sums in place of rounded ones were tried as well; they lessen the scatter by a quarter at
//! most.
//!
//! # Errors
//!
//! The last term of a series, |T_{m,m} − T_{m−1,m−1}| or |E_k − E_{k−1}|, is not an estimate of its error: near a close
//! encounter the differences alias, and a term may be small by chance. Combined with the values at a few states on
//! either side, it becomes one: the largest of their range max − min, of their last terms, and of the last place of the
//! value. The true error divided by this estimate, and for comparison by the last term alone, on the exact flow of
//! Kepler's problem, where the modified energy is −1/2 (orbits of eccentricity 0, 0.3, 0.6 and 0.9, h = 1/10, 3/31,
//! 2/21, 1/20 and 1/40, 160 digits, all states of an orbit):
//!
//! | | m = 5 | m = 10 | m = 20 | m = 40 | best m ≤ 100, least | robust | k = 4 | k = 8 | k = 16 | k = 32 |
//! | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
//! | median | 0.005 | 0.007 | 0.009 | 0.01 | 0.01 | 0.008 | 0.002 | 0.002 | 0.0009 | 0.0002 |
//! | 95 in 100 | 0.06 | 0.13 | 0.24 | 0.37 | 0.56 | 0.54 | 0.01 | 0.02 | 0.04 | 0.22 |
//! | largest | 0.71 | 0.65 | 0.65 | 0.62 | 1.75 | 1.75 | 1.00 | 1.00 | 1.00 | 1.00 |
//! | last term, largest | 1e3 | 2e3 | 8e3 | 3e4 | 5e7 | 5e6 | 4e2 | 6e1 | 8e3 | 2e4 |
//!
//! 1.75 is round-off, which may be alike at some states one after the other; in double precision 3.5 was met, and 6.5
//! for k = 128 with 40 digits. So an estimate is not a bound, but of the right size; where errors change fast it is too
//! large.
//!
//! None is reliable with few states a period: with 6 (h = 1, e = 0 to 0.99) errors were up to 4.6 times as large as
//! estimated, with 3 (h = 2) up to 35 times, and a motion with fewer than 2 looks like a slower one.

mod best_bilinear;
mod bilinear;
mod central;
mod difference_table;
mod differences;
pub mod ensemble;
mod error_estimate;
mod estimator;
pub mod exact_flow;
mod expected_round_off;
mod family;
mod fixed;
mod form;
mod lagged;
mod monitor;
mod options;
#[cfg(feature = "serde")]
mod record;
pub mod recorded;
mod rules;
pub mod run;
mod settings;
pub mod weights;
mod window;

pub use bilinear::{Bilinear, BilinearEstimator, FixedBilinear, FixedBilinearEstimator};
pub use central::{Central, CentralEstimator, FixedCentral, FixedCentralEstimator};
pub use differences::{SelectionRule, StoppingRule};
pub use estimator::{BuildEstimator, Estimate, Estimator, EstimatorError};
pub(crate) use expected_round_off::ExpectedRoundOff;
pub use monitor::{Advice, Criterion, Missing, Monitor, Report, Rough, Sample, ShadowEnergy, Trend, Verdict, WholeRun};
pub use options::{AccuracyError, EstimatorOptions, HIGHEST_ORDER, OptionConflict, UnknownWord, check_accuracy};
pub use rules::KINETIC_LIMIT;
pub use settings::EstimatorSettings;
