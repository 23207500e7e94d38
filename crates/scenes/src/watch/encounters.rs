//! Close encounters: times at which the force is large for a short part of the run.
//!
//! |Δp|, what a step adds to the momenta, is the mean force of the step times h. A *passage* is the interval around a peak of |Δp| in
//! which it is at least half of the peak. It is a close encounter if the time since the passage before it is at least
//! four times as long as it lasts: of an ellipse with an eccentricity of 0.5 or more each pericentre is one, of an
//! oscillation nothing is.

use shadowstep::Real;
use shadowstep::number::saved::{Fields, list, optional};

/// A passage is a close encounter if the interval before it is this many times as long.
const APART: i64 = 4;
/// The edges of a passage are known to this factor of |Δp|².
const RESOLUTION: f64 = 1.05 * 1.05;
/// Half of |Δp|, squared, as a part of |Δp|².
const HALF_SQUARED: f64 = 0.25;
/// |Δp| must be this many units in the last place of p, so that it is not round-off.
const LEAST_DIGITS: f64 = 1e3;
/// How many of the closest encounters are kept.
pub(super) const KEPT: usize = 8;

/// A close encounter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Encounter {
    /// The state at the end of the step with the largest force.
    pub n: i64,
    /// How many steps it lasts: those whose force is at least half of the largest.
    pub steps: i64,
}

/// Finds the close encounters of a run.
#[derive(Clone, Debug)]
pub(super) struct Encounters<N> {
    /// The momenta before the step.
    p: Vec<N>,
    difference: N,
    square: N,
    passages: Passages,
}

/// Finds them from the sizes |Δp|²: no root is taken at each step.
#[derive(Clone, Debug, Default)]
struct Passages {
    /// Sizes since the smallest one after the last passage, as far as they grow: n and |Δp|².
    rising: Vec<(i64, f64)>,
    peak: (i64, f64),
    floor: f64,
    /// The last step of the last passage.
    end: Option<i64>,
    /// The run begins with a passage, and how long the interval before it is is unknown.
    first: Option<(Encounter, i64)>,
    closest: Vec<Encounter>,
    count: u64,
}

impl<N: Real> Encounters<N> {
    /// From the momenta of the first state.
    pub(super) fn new(p: &[N]) -> Self {
        let zero = N::zero(&p[0].context());
        Encounters { p: p.to_vec(), difference: zero.clone(), square: zero, passages: Passages::default() }
    }

    /// Takes the momenta of the state n.
    #[inline]
    pub(super) fn include(&mut self, n: i64, p: &[N]) {
        let Encounters { p: last, difference, square, passages } = self;
        square.assign_zero();
        let mut largest = 0.0_f64;
        for (last, p) in last.iter_mut().zip(p) {
            difference.assign_difference(p, last);
            square.add_product(difference, difference);
            let size = p.to_f64().abs();
            largest = if size > largest { size } else { largest };
            last.assign(p);
        }
        let size = square.to_f64();
        // numbers with more digits than f64 have less round-off than this
        let round_off = LEAST_DIGITS * f64::EPSILON * largest;
        if size > round_off * round_off {
            passages.include(n, size);
        }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        to.numbers(&mut self.p);
        self.passages.fields(to);
    }

    /// How many there are, and the closest ones.
    pub(super) fn found(mut self, last: i64) -> (u64, Vec<Encounter>) {
        self.passages.finish(last);
        (self.passages.count, self.passages.closest)
    }
}

impl Encounter {
    fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        [&mut self.n, &mut self.steps].into_iter().for_each(|count| to.whole(count));
    }
}

impl Passages {
    fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        let none = Encounter { n: 0, steps: 0 };
        let size = |to: &mut dyn Fields<N>, (n, size): &mut (i64, f64)| {
            to.whole(n);
            to.double(size);
        };
        let Passages { rising, peak, floor, end, first, closest, count } = self;
        list(to, rising, &(0, 0.0), size);
        size(to, peak);
        to.double(floor);
        optional(to, end, &0, |to, end| to.whole(end));
        optional(to, first, &(none, 0), |to, (encounter, end)| {
            encounter.fields(to);
            to.whole(end);
        });
        list(to, closest, &none, |to, encounter| encounter.fields(to));
        to.count(count);
    }

    #[inline]
    fn include(&mut self, n: i64, size: f64) {
        let begins = self.rising.is_empty();
        if begins || size > self.peak.1 {
            self.peak = (n, size);
            if begins {
                self.floor = size;
            }
            if self.rising.last().is_none_or(|(_, last)| size > RESOLUTION * last) {
                self.rising.push((n, size));
            }
        } else if size < HALF_SQUARED * self.peak.1 && (self.end.is_none() || HALF_SQUARED * self.peak.1 >= self.floor)
        {
            self.end_passage(n - 1);
            self.rise_from(n, size);
        } else if size < self.floor && self.end.is_some() {
            self.rise_from(n, size);
        }
    }

    #[inline]
    fn rise_from(&mut self, n: i64, size: f64) {
        self.rising.clear();
        self.rising.push((n, size));
        (self.peak, self.floor) = ((n, size), size);
    }

    /// The passage around the peak ends with the step `last`.
    #[inline(never)]
    fn end_passage(&mut self, last: i64) {
        let (n, peak) = self.peak;
        let begin = self.rising.iter().find(|(_, size)| *size >= HALF_SQUARED * peak).map_or(n, |(begin, _)| *begin);
        // of a run that begins at a peak, the other half of the passage is before the run
        let halves = if self.end.is_none() && n == begin { 2 } else { 1 };
        let encounter = Encounter { n, steps: halves * (last - begin + 1) };
        self.decide_first(begin);
        match self.end.replace(last) {
            Some(end) if begin - end >= APART * encounter.steps => self.keep(encounter),
            Some(_) => {}
            // the run may begin within it
            None if begin >= APART * encounter.steps => self.keep(encounter),
            None => self.first = Some((encounter, last)),
        }
    }

    /// The first passage is an encounter if the next one, which begins here, is far from it.
    fn decide_first(&mut self, next: i64) {
        if let Some((encounter, end)) = self.first.take()
            && next - end >= APART * encounter.steps
        {
            self.keep(encounter);
        }
    }

    fn finish(&mut self, last: i64) {
        self.decide_first(last);
    }

    fn keep(&mut self, encounter: Encounter) {
        self.count += 1;
        let place = self.closest.partition_point(|other| other.steps <= encounter.steps);
        self.closest.insert(place, encounter);
        self.closest.truncate(KEPT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encounters(size: impl Fn(f64) -> f64, steps: i64) -> (u64, Vec<Encounter>) {
        let mut passages = Passages::default();
        (1..=steps).for_each(|n| passages.include(n, size(n as f64).powi(2)));
        passages.finish(steps);
        (passages.count, passages.closest)
    }

    #[test]
    fn a_peak_is_an_encounter_where_it_is_apart_from_others() {
        // 1 + 9/(1 + x²) is half of 10 for |x| ≤ √(5/4)·10 = 11.2 with x = (n − 500)/10
        let lorentz = |n: f64| 1.0 + 9.0 / (1.0 + ((n - 500.0) / 10.0).powi(2));
        assert_eq!(encounters(lorentz, 1000), (1, vec![Encounter { n: 500, steps: 23 }]));
        // one in every 200 steps, and one in every 100 steps, which are not apart
        let (count, closest) = encounters(|n| lorentz(400.0 + n % 200.0), 2000);
        assert_eq!((count, closest.len()), (10, KEPT));
        assert_eq!(encounters(|n| lorentz(450.0 + n % 100.0), 1000).0, 0);
    }

    #[test]
    fn an_oscillation_has_none() {
        assert_eq!(encounters(|n| (n / 20.0).cos().abs() + 1e-9, 10_000).0, 0);
        assert_eq!(encounters(|_| 1.0, 1000).0, 0);
    }

    #[test]
    fn a_run_may_begin_within_one() {
        let pericentre = |n: f64| 1.0 / (1.0 + n * n / 25.0) + 1e-3;
        assert_eq!(encounters(pericentre, 1000), (1, vec![Encounter { n: 1, steps: 10 }]));
        assert_eq!(encounters(pericentre, 12).0, 0, "a part of something longer");
    }
}
