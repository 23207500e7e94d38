//! A comparison of two values with an uncertainty.

use crate::number::Real;

/// The result of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Agreement {
    /// The difference is within the uncertainty, and that is small.
    Agrees,
    /// The uncertainty is too large, or the difference is a few times that.
    Undecided,
    /// The difference is more than a hundred times the uncertainty.
    Differs,
}

/// A comparison at a state.
#[derive(Clone, Debug)]
pub struct Comparison<N> {
    /// Its result.
    pub agreement: Agreement,
    /// The number of the state, from 0.
    pub state: usize,
    /// The coordinate, from 0; `None` where all were compared at once.
    pub coordinate: Option<usize>,
    /// What the potential gives.
    pub found: N,
    /// What it should be.
    pub expected: N,
    /// How well that is known.
    pub uncertainty: N,
}

/// A difference of up to this many times its uncertainty agrees.
const AGREES: i32 = 10;
/// A difference of more than this many times its uncertainty differs.
const DIFFERS: i32 = 100;
/// A comparison is undecided if its uncertainty is more than one part in this many of the sizes of its terms.
const LARGEST_UNCERTAINTY: i32 = 1000;

impl<N: Real> Comparison<N> {
    /// `size` is the sum of the absolute values of all terms.
    pub(super) fn new(
        state: usize,
        coordinate: Option<usize>,
        (found, expected): (N, N),
        uncertainty: N,
        size: &N,
    ) -> Self {
        let mut off = found.clone();
        off.subtract(&expected);
        off.make_absolute();
        let times = |number: &N, factor: i32| {
            let mut product = number.clone();
            product.multiply_integer(factor);
            product
        };
        let is_known = times(&uncertainty, LARGEST_UNCERTAINTY) <= *size || uncertainty == N::zero(&size.context());
        let agreement = match () {
            // false for NaN
            () if off > times(&uncertainty, DIFFERS) => Agreement::Differs,
            () if is_known && off <= times(&uncertainty, AGREES) => Agreement::Agrees,
            () => Agreement::Undecided,
        };
        Comparison { agreement, state, coordinate, found, expected, uncertainty }
    }

    pub(super) fn keep_worse(&mut self, other: Self) {
        if other.agreement > self.agreement {
            *self = other;
        }
    }
    /// What was compared `of`, in words.
    pub(super) fn sentence(&self, of: &str) -> String {
        let Comparison { agreement, state, coordinate, found, expected, uncertainty } = self;
        let [found_short, expected_short] = [found, expected].map(|x| format!("{:.6e}", x.to_f64()));
        let known = format!("{expected_short} ± {:.1e}", uncertainty.to_f64());
        let place = match coordinate {
            Some(coordinate) => format!("in coordinate {coordinate} of state {state}"),
            None => format!("at state {state}"),
        };
        let verb = match agreement {
            Agreement::Agrees => return format!("agrees with {of} to {:.1e} {place}", uncertainty.to_f64()),
            Agreement::Undecided => "can not be decided:",
            Agreement::Differs => "differs:",
        };
        let mut ratio = found.clone();
        ratio.divide(expected);
        let percent = 100.0 * (ratio.to_f64() - 1.0);
        let size = if percent.is_finite() { format!(", {percent:+.2e} %") } else { String::new() };
        format!("{verb} {place} it is {found_short}, and {of} is {known}{size}")
    }
}

/// sum ← sum + |a b|
pub(super) fn add_absolute_product<N: Real>(sum: &mut N, a: &N, b: &N) {
    let mut product = a.clone();
    product.multiply(b);
    product.make_absolute();
    sum.add(&product);
}
