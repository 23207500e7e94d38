//! The error of H over a run.

use shadowstep::Real;
use shadowstep::number::saved::Fields;

use super::lasting_change::LastingChanges;

/// H(t) − H(0), the largest and the last one.
#[derive(Clone, Debug)]
pub(super) struct EnergyError<N> {
    pub(super) initial: N,
    pub(super) largest: N,
    pub(super) at: i64,
    pub(super) last: N,
    /// The n of the last one.
    last_n: i64,
    /// At how many states H was computed.
    pub(super) states: u64,
    size: N,
    pub(super) lasting: LastingChanges,
}

impl<N: Real> EnergyError<N> {
    pub(super) fn new(initial: N) -> Self {
        let zero = N::zero(&initial.context());
        EnergyError {
            initial,
            largest: zero.clone(),
            at: 0,
            last: zero.clone(),
            last_n: 0,
            states: 1,
            size: zero,
            lasting: LastingChanges::default(),
        }
    }

    /// Takes H of the state n, which may come after those of later states; that of the last state may come again.
    pub(super) fn include(&mut self, n: i64, energy: &N) {
        if n == self.last_n {
            return;
        }
        self.states += 1;
        self.size.assign_difference(energy, &self.initial);
        if n > self.last_n {
            self.last.assign(&self.size);
            self.last_n = n;
        }
        self.lasting.include(n, self.size.to_f64());
        self.size.make_absolute();
        if self.size > self.largest || !self.size.is_finite() {
            self.largest.assign(&self.size);
            self.at = n;
        }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let EnergyError { initial, largest, at, last, last_n, states, size: _, lasting } = self;
        [initial, largest, last].into_iter().for_each(|energy| to.number(energy));
        [at, last_n].into_iter().for_each(|n| to.whole(n));
        to.count(states);
        lasting.fields(to);
    }

    /// A difference as a part of |H(0)|; `None` if that is 0.
    pub(super) fn relative(&self, difference: &N) -> Option<N> {
        let mut size = self.initial.clone();
        size.make_absolute();
        let mut part = difference.clone();
        part.make_absolute();
        let nonzero = size.log10_abs() > f64::NEG_INFINITY;
        nonzero.then(|| {
            part.divide(&size);
            part
        })
    }
}
