//! What holds the coordinates of a state.

use std::hint::black_box;

use crate::number::Number;

/// Holds the coordinates of a state: an array `[N; D]`, or a `Vec<N>` or `Box<[N]>` where the dimension is known at run
/// time only.
pub trait Coordinates<N>: AsRef<[N]> + AsMut<[N]> + Clone {}

impl<N, V: AsRef<[N]> + AsMut<[N]> + Clone> Coordinates<N> for V {}

/// `visit` for each coordinate and its partner: a loop of its own, as that over a `zip` of the standard library calls functions that are not inlined
/// into other codegen units.
#[inline(always)]
pub(crate) fn for_each_two<N: Number>(own: &mut [N], other: &[N], mut visit: impl FnMut(&mut N, &N)) {
    let length = own.len().min(other.len());
    let (own, other) = (&mut own[..length], &other[..length]);
    for i in 0..length {
        let i = index::<N>(i, length);
        visit(&mut own[i], &other[i]);
    }
}

/// The same with two partners.
#[inline(always)]
pub(crate) fn for_each_three<N: Number>(own: &mut [N], a: &[N], b: &[N], mut visit: impl FnMut(&mut N, &N, &N)) {
    let length = own.len().min(a.len()).min(b.len());
    let (own, a, b) = (&mut own[..length], &a[..length], &b[..length]);
    for i in 0..length {
        let i = index::<N>(i, length);
        visit(&mut own[i], &a[i], &b[i]);
    }
}

/// An index of a loop over this number of coordinates. The compiler does not see it where they are many and in lanes: it would make vectors of one lane of
/// several coordinates, which are gathered from their places.
#[inline(always)]
pub(crate) fn index<N: Number>(i: usize, length: usize) -> usize {
    const MANY: usize = 4;
    if N::LANES > 1 && length >= MANY { black_box(i) } else { i }
}

/// The first of the initial values q1, q2, …, p1, p2, … that is infinite or NaN. One of several numbers in lanes may be so: the other trajectories go
/// on without it.
pub(crate) fn first_not_finite<N: Number>(q: &[N], p: &[N]) -> Option<String> {
    let not_finite = |x: &N| N::LANES == 1 && !x.is_finite();
    let first = |name: &str, values: &[N]| Some(format!("{name}{}", values.iter().position(not_finite)? + 1));
    first("q", q).or_else(|| first("p", p))
}
