//! The coordinate that turns fastest, each by itself, however little of the energy it has.

use super::recent::{STATES, Sums, Turning, assign_differences, assign_second_difference, turning};
use crate::number::{Ordered, epsilon};

/// A second difference of fewer last places of p than this is round-off.
const ROUNDING: i32 = 1000;
/// A coordinate that is more irregular than this is not taken for one that turns.
const LARGEST_IRREGULARITY: f64 = 0.5;

/// A coordinate that turns by this angle a step or more, once in 6 steps, is hardly resolved.
const FAST: f64 = 1.0;

/// How each coordinate turns: in the first states of a run, and in the newest ones of each window.
#[derive(Clone, Debug)]
pub(super) struct Fastest<N> {
    /// p of the first states, as far as they have come.
    start: [Vec<N>; STATES],
    begun: usize,
    coordinates: Vec<Sums<N>>,
    /// 1000 ε
    rounding: N,
    round_off: N,
    x: N,
    y: N,
    z: N,
}

impl<N: Ordered> Fastest<N> {
    pub(super) fn new(dimension: usize, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let mut rounding: N = epsilon(context);
        rounding.multiply_integer(ROUNDING);
        Fastest {
            start: std::array::from_fn(|_| vec![zero(); dimension]),
            begun: 0,
            coordinates: vec![Sums::zero(context); dimension],
            rounding,
            round_off: zero(),
            x: zero(),
            y: zero(),
            z: zero(),
        }
    }

    /// The number of coordinates.
    pub(super) fn dimension(&self) -> usize {
        self.coordinates.len()
    }

    /// Takes p of the state n: a body that is lost in the first steps turns only there.
    #[inline]
    pub(super) fn begin(&mut self, n: u64, p: &[N]) {
        let Some(own) = usize::try_from(n).ok().and_then(|n| self.start.get_mut(n)) else { return };
        own.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        self.begun += 1;
    }

    /// Takes p of successive states.
    pub(super) fn add(&mut self, [p0, p1, p2, p3, p4]: &[Vec<N>; STATES]) {
        let Fastest { coordinates, rounding, round_off, x, y, z, .. } = self;
        for (i, sums) in coordinates.iter_mut().enumerate() {
            assign_differences([x, y], z, [&p0[i], &p1[i], &p2[i], &p3[i], &p4[i]]);
            round_off.assign_product(&p2[i], rounding);
            round_off.make_absolute();
            z.assign(x);
            z.make_absolute();
            if *z > *round_off {
                sums.add(x, y);
            }
        }
    }

    /// A coordinate that turned fast in the first five states, and turns at most a third as fast, or not at all, in the windows since; counted from
    /// 0, with the angle by which it turned.
    pub(super) fn lost(&self) -> Option<(usize, f64)> {
        if self.begun < STATES {
            return None;
        }
        let still = |i: usize| turning(&self.coordinates[i], &mut self.x.clone()).map_or(0.0, |turning| turning.angle);
        let angles = (0..self.dimension()).filter_map(|i| Some((i, self.angle_at_start(i)?)));
        angles
            .filter(|(i, angle)| *angle >= FAST && still(*i) <= angle / 3.0)
            .reduce(|fastest, other| if other.1 > fastest.1 { other } else { fastest })
    }

    /// The angle by which a coordinate turned in the first five states, π where it turned by more than half a turn a step; `None` where
    /// the second difference in the middle is small beside its neighbours or is round-off, so that it says nothing.
    fn angle_at_start(&self, i: usize) -> Option<f64> {
        let p = |n: usize| &self.start[n][i];
        let [mut before, mut middle, mut after] = [(); 3].map(|()| self.x.clone());
        for (n, difference) in [&mut before, &mut middle, &mut after].into_iter().enumerate() {
            assign_second_difference(difference, p(n), p(n + 1), p(n + 2));
        }
        let mut round_off = self.rounding.clone();
        round_off.multiply(p(2));
        // the differences have the digits of N; of their quotients a few are enough
        let [before, middle, after, round_off] = [before, middle, after, round_off].map(|x| x.to_f64());
        let says = middle.abs() > round_off.abs() && 2.0 * middle.abs() >= before.abs().max(after.abs());
        says.then(|| ((before + after) / (2.0 * middle)).clamp(-1.0, 1.0).acos())
    }

    /// The coordinate that turns by the largest angle, counted from 0; `None` where none turns.
    pub(super) fn found(&self) -> Option<(usize, Turning)> {
        let (mut all, mut quotient) = (self.clone(), self.x.clone());
        if self.begun == STATES {
            all.add(&self.start);
        }
        let turnings = all.coordinates.iter().map(|sums| turning(sums, &mut quotient)).enumerate();
        let regular = turnings.filter_map(|(i, turning)| Some((i, turning?)));
        regular
            .filter(|(_, turning)| turning.irregular <= LARGEST_IRREGULARITY)
            .reduce(|fastest, other| if other.1.angle > fastest.1.angle { other } else { fastest })
    }
}
