//! Second and fourth differences of the momenta, summed over the windows.

use super::consistency::square_rounding;
use super::fastest::Fastest;
use super::state_view::{STATES_KEPT, StateView};
use super::turning::{Sums, Turning, assign_second_difference, turning};
use crate::number::Real;
use crate::number::partial_sums::PartialSums;
use crate::number::saved::Fields;

/// A fourth difference of p is off by less than this number of last places of p: rms by √(20 s) · 0.2123, s the stages
/// of a step.
const LAST_PLACES: f64 = 10.0;

/// Over the windows, and in the newest.
#[derive(Clone, Debug)]
pub(super) struct TurningSums<N> {
    sums: Sums<N>,
    pub(super) window: Sums<N>,
    /// Σ (p δ²p)²
    weighted: N,
    /// (10⁶ ε)²
    rounding: N,
    /// Intermediate results.
    four: PartialSums<N, 4>,
    x: N,
    y: N,
}

impl<N: Real> TurningSums<N> {
    pub(super) fn new(context: &N::Context) -> Self {
        let zero = || N::zero(context);
        TurningSums {
            sums: Sums::zero(context),
            window: Sums::zero(context),
            weighted: zero(),
            rounding: square_rounding(context),
            four: PartialSums::new(context),
            x: zero(),
            y: zero(),
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, [s2, s3, s4]: &[StateView<'_, N>; STATES_KEPT], fastest: &mut Fastest<N>) {
        let TurningSums { window, four, x, y, .. } = self;
        let [squares, products, fourths, weighted] = four.of(
            [&*s2.second, &*s3.second, &*s4.second, &*s2.p],
            |[before, second, after, p], [squares, products, fourths, weighted]| {
                let (mut x, mut y) = (x.register(), y.register());
                assign_second_difference(&mut *y, before, second, after);
                squares.add_product(second, second);
                products.add_product(second, &y);
                fourths.add_product(&y, &y);
                x.assign_product(second, p);
                weighted.add_product(&x, &x);
            },
        );
        fastest.add([&*s2.second, &*s3.second, &*s4.second], &*s2.p);
        self.weighted.add(&weighted);
        window.squares.assign(&squares);
        window.products.assign(&products);
        window.fourths.assign(&fourths);
        self.sums.squares.add(&squares);
        self.sums.products.add(&products);
        self.sums.fourths.add(&fourths);
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        self.sums.fields(to);
        self.window.fields(to);
        to.number(&mut self.weighted);
    }

    /// `None` where the windows are too short, or nothing moves.
    pub(super) fn found(&self) -> Option<Turning> {
        let mut quotient = self.x.clone();
        let turning = turning(&self.sums, &mut quotient)?;
        // Σ δ²p δ⁴p is off by √Σ (δ²p r)² where each δ⁴p is off by r
        quotient.assign_quotient(&self.weighted, &self.sums.squares);
        quotient.multiply(&self.rounding);
        quotient.divide(&self.sums.squares);
        Some(Turning { round_off: LAST_PLACES / 1e6 * quotient.to_f64().sqrt(), ..turning })
    }
}
