//! Whether the forces are smooth along the windows, and if not, which derivative of the potential jumps.
//!
//! Where U is smooth and the steps resolve the motion, the last term E_k − E_{k−1} falls like h^(2k−2) with the step.
//! Where the m-th derivative of U jumps it is of the size of h^m, whatever k. So last terms are computed from the
//! states of a window, and from every second one of them, as if the step were 2h.

use super::arithmetic::{integer, quotient, root};
use crate::number::Real;
use crate::number::saved::{Fields, Saved};
use crate::shadow::bilinear::{Bilinear, BilinearEstimator};
use crate::shadow::estimator::{BuildEstimator, Estimator, EstimatorError};
use crate::steps::step_size::StepSize;
use crate::systems::increments::{Increments, OwnedIncrements};

/// The largest k; windows of 17 states and more have it.
const LARGEST_K: usize = 8;
/// The smallest k, for windows of 13 states: the last term falls like h^10.
const LEAST_K: usize = 6;
/// Higher harmonics of a motion that turns by more than this angle a step are not resolved by steps of 2h.
const ANGLE_LIMIT: f64 = 0.35;
/// Last terms are round-off up to this many times what that makes in the energy in a step.
const ROUND_OFF_FACTOR: i32 = 1000;
/// Forces are smooth if the last terms at 2h are more than this many times those at h.
const LARGEST_RATIO: f64 = 16.0;
/// Where the m-th derivative jumps, log₂ of that ratio is m − 1.5 to m + 1: measured on oscillators, for m = 1 to 4,
/// orders 2 to 6 and k = 6 to 12. It is less where the jumps change H̄ itself by more.
const LOGARITHM: [f64; 2] = [-1.5, 1.0];
/// Windows that a statement needs.
const LEAST_WINDOWS: u64 = 16;

/// Forces that are not smooth: while the motion turns little in a step, the last terms of modified energies from every
/// second state of the windows are not much larger than those from all states.
///
/// The lowest derivative of U that jumps is in a range of orders; U itself is its derivative of order 0. Where that is
/// m, a crossing changes the energy by a part of the size of h^m, so that a scheme of an order above m gains nothing by
/// it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rough {
    /// The smallest possible order m.
    pub least: u32,
    /// The largest one.
    pub most: u32,
}

/// Last terms at two spacings over all windows.
#[derive(Clone, Debug)]
pub(super) struct Roughness<N> {
    /// `None` for windows that are too short.
    spacings: Option<Spacings<N>>,
    windows: u64,
    /// Σ of mean squares of last terms at h and at 2h.
    squares: [N; 2],
    /// Σ of squares of the energy that a step rounds.
    kicks: N,
}

impl<N: Real> Roughness<N> {
    pub(super) fn new(
        states: usize,
        h: &StepSize,
        dimension: usize,
        context: &N::Context,
    ) -> Result<Self, EstimatorError> {
        let k = ((states - 1) / 2).min(LARGEST_K);
        let spacings = (k >= LEAST_K).then(|| Spacings::new(k, h, dimension, context)).transpose()?;
        let zero = || N::zero(context);
        Ok(Roughness { spacings, windows: 0, squares: [zero(), zero()], kicks: zero() })
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Roughness { spacings, windows, squares, kicks } = self;
        if let Some(Spacings { fine, coarse, k: _, count, sum, unknown: _ }) = spacings {
            fine.fields(to);
            coarse.fields(to);
            to.place(count, usize::MAX);
            sum.fields(to);
        }
        to.count(windows);
        to.numbers(squares);
        to.number(kicks);
    }

    /// Whether it takes states: windows are long enough.
    #[inline]
    pub(super) fn takes(&self) -> bool {
        self.spacings.is_some()
    }

    /// Takes a state of a window; what the step to it added is not known of the first one.
    pub(super) fn push(&mut self, q: &[N], p: &[N], added: Option<Increments<'_, N>>) {
        if let Some(spacings) = &mut self.spacings {
            spacings.push(q, p, added);
        }
    }

    /// Begins a new window, after states that were not taken.
    pub(super) fn restart(&mut self) {
        if let Some(spacings) = &mut self.spacings {
            spacings.count = 0;
        }
    }

    /// Whether the window that ends has last terms.
    #[inline]
    pub(super) fn is_complete(&self) -> bool {
        self.spacings.as_ref().is_some_and(Spacings::is_complete)
    }

    /// The last terms of a window in which the motion turns by `angle` a step, and a step rounds the energy by
    /// √`square_kick`.
    pub(super) fn end(&mut self, angle: Option<f64>, square_kick: &N) {
        let Some(spacings) = &mut self.spacings else { return };
        spacings.count = 0;
        if angle.is_none_or(|angle| angle > ANGLE_LIMIT) {
            return;
        }
        self.windows += 1;
        self.kicks.add(square_kick);
        for (sum, terms) in self.squares.iter_mut().zip([&mut spacings.fine, &mut spacings.coarse]) {
            sum.add(terms.mean_square());
        }
    }

    /// The root mean square of the last terms at h.
    pub(super) fn last_term(&self) -> N {
        root(&quotient(&self.squares[0], &integer(self.windows.max(1), &self.kicks.context())))
    }

    /// The forces, where they are not smooth.
    pub(super) fn found(&self) -> Option<Rough> {
        let mut rounding = self.kicks.clone();
        rounding.multiply_integer(ROUND_OFF_FACTOR * ROUND_OFF_FACTOR);
        let [fine, coarse] = &self.squares;
        let ratio = quotient(coarse, fine).to_f64().sqrt();
        let is_rough = self.windows >= LEAST_WINDOWS && *fine > rounding && ratio <= LARGEST_RATIO;
        let [below, above] = LOGARITHM.map(|offset| ratio.log2() - offset);
        is_rough.then(|| Rough { least: above.ceil().max(0.0) as u32, most: below.floor().max(0.0) as u32 })
    }
}

/// The last terms of a window.
#[derive(Clone, Debug)]
struct Spacings<N> {
    fine: LastTerms<N>,
    coarse: LastTerms<N>,
    k: usize,
    /// States of this window so far.
    count: usize,
    /// What two steps added.
    sum: OwnedIncrements<N>,
    /// In place of an unknown increment of β.
    unknown: N,
}

impl<N: Real> Spacings<N> {
    fn new(k: usize, h: &StepSize, dimension: usize, context: &N::Context) -> Result<Self, EstimatorError> {
        Ok(Spacings {
            fine: LastTerms::new(k, h, dimension, context)?,
            coarse: LastTerms::new(k, &h.doubled(), dimension, context)?,
            k,
            count: 0,
            sum: OwnedIncrements::zero(dimension, context),
            unknown: N::zero(context),
        })
    }

    fn is_complete(&self) -> bool {
        self.count > 2 * self.k
    }

    /// Takes one of the first 2k + 1 states of a window; others have no effect.
    fn push(&mut self, q: &[N], p: &[N], added: Option<Increments<'_, N>>) {
        let added = added.filter(|_| self.count > 0);
        if added.is_none() {
            self.count = 0;
            self.fine.begin();
            self.coarse.begin();
        }
        if self.is_complete() {
            return;
        }
        let unknown = Increments::of_beta(&self.unknown);
        self.fine.push(q, p, added.unwrap_or(unknown));
        match added {
            None => self.coarse.push(q, p, unknown),
            Some(added) if self.count % 2 == 1 => self.sum.assign(added),
            Some(added) => {
                self.sum.add(added);
                self.coarse.push(q, p, self.sum.view());
            }
        }
        self.count += 1;
    }
}

/// The terms E_k − ½(E_{k−1} + E_{k−1} one state before) of a window.
#[derive(Clone, Debug)]
struct LastTerms<N> {
    k: usize,
    higher: BilinearEstimator<N>,
    lower: BilinearEstimator<N>,
    /// States so far.
    count: usize,
    before: N,
    term: N,
    squares: N,
}

impl<N: Real> LastTerms<N> {
    fn new(k: usize, h: &StepSize, dimension: usize, context: &N::Context) -> Result<Self, EstimatorError> {
        let build = |k: usize| Bilinear::new(u32::try_from(k).expect("at most 8")).build(h, dimension, context);
        let zero = || N::zero(context);
        let [before, term, squares] = [zero(), zero(), zero()];
        Ok(LastTerms { k, higher: build(k)?, lower: build(k - 1)?, count: 0, before, term, squares })
    }

    fn fields(&mut self, to: &mut dyn Fields<N>) {
        let LastTerms { k: _, higher, lower, count, before, term: _, squares } = self;
        higher.fields(to);
        lower.fields(to);
        to.place(count, usize::MAX);
        to.number(before);
        to.number(squares);
    }

    fn begin(&mut self) {
        self.count = 0;
        self.squares.assign_zero();
    }

    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) {
        self.count += 1;
        let higher = self.higher.push_for_value(q, p, increments);
        let lower = self.lower.push_for_value(q, p, increments);
        let Some(lower) = lower else { return };
        if let Some(higher) = higher.filter(|_| self.count > self.k) {
            self.term.assign_sum(&self.before, lower.value);
            self.term.divide_integer(-2);
            self.term.add(higher.value);
            self.squares.add_product(&self.term, &self.term);
        }
        self.before.assign(lower.value);
    }

    fn mean_square(&mut self) -> &N {
        self.squares.divide_integer(i32::try_from(self.count - self.k).expect("a window has few states"));
        &self.squares
    }
}

#[cfg(test)]
mod tests {
    use crate::shadow::{Bilinear, Rough, ShadowEnergy};
    use crate::systems::potential::from_fn;
    use crate::{Motion, Stepper, UnitMasses, steps::tables::shipped};

    /// An oscillator of frequency 1 with the energy c q^m in addition for q > 0.
    fn watch(m: i32, c: f64, scheme: &str, h: f64, k: u32) -> Option<Rough> {
        watch_every(30, m, c, scheme, h, k)
    }

    fn watch_every(every: u64, m: i32, c: f64, scheme: &str, h: f64, k: u32) -> Option<Rough> {
        let potential = from_fn(1, move |q, gradient| {
            let x = q[0].max(0.0);
            gradient[0] = q[0] + if x > 0.0 { c * f64::from(m) * x.powi(m - 1) } else { 0.0 };
            q[0] * q[0] / 2.0 + c * x.powi(m)
        });
        let mut motion = Motion::new(potential, UnitMasses, [1.0], [0.0]).unwrap();
        let stepper = Stepper::new(shipped(scheme).unwrap(), h).unwrap();
        let mut monitor = ShadowEnergy::new(stepper, &mut motion, &Bilinear::with_error(k)).unwrap().every(every);
        for _ in 0..10_000 {
            monitor.step(&mut motion).unwrap();
        }
        monitor.report().rough
    }

    #[test]
    fn the_derivative_that_jumps_is_found() {
        for scheme in ["stormer-verlet", "blanes-moan-srkn11b"] {
            for (h, k) in [(0.1, 8), (0.2, 6)] {
                for m in 1..=3 {
                    let found = watch(m, 0.1, scheme, h, k);
                    let holds = found.is_some_and(|Rough { least, most }| (least..=most).contains(&(m as u32)));
                    assert!(holds, "m = {m}, {scheme}, h = {h}, k = {k}: {found:?}");
                }
            }
        }
    }

    #[test]
    fn smooth_forces_are_not_rough() {
        for (h, k) in [(0.1, 8), (0.2, 6), (0.3, 8)] {
            assert_eq!(watch(1, 0.0, "stormer-verlet", h, k), None);
        }
    }

    /// Where windows overlap one of them begins at each state or two, and the checks still need states that follow each
    /// other.
    #[test]
    fn windows_that_overlap_are_checked_as_others() {
        for every in [1, 2, 5, 16] {
            assert_eq!(watch_every(every, 1, 0.0, "stormer-verlet", 0.1, 8), None, "a window in {every} steps");
            let found = watch_every(every, 2, 0.1, "stormer-verlet", 0.1, 8);
            let holds = found.is_some_and(|Rough { least, most }| (least..=most).contains(&2));
            assert!(holds, "a window in {every} steps: {found:?}");
        }
    }
}
