//! What holds the coordinates of a state.

use std::hint::black_box;

use crate::number::Number;

/// Holds the coordinates of a state: an array `[N; D]`, or a `Vec<N>` or `Box<[N]>` where the dimension is known at run
/// time only.
pub trait Coordinates<N>: AsRef<[N]> + AsMut<[N]> + Clone {}

impl<N, V: AsRef<[N]> + AsMut<[N]> + Clone> Coordinates<N> for V {}

/// `visit` for each coordinate and its partner: a loop of its own, as that over a `zip` of the standard library calls
/// functions that are not inlined into other codegen units.
#[inline(always)]
pub(crate) fn for_each_two<N: Number>(own: &mut [N], other: &[N], mut visit: impl FnMut(&mut N, &N)) {
    let length = own.len().min(other.len());
    let (own, other) = (&mut own[..length], &other[..length]);
    let mut done = 0;
    if are_many::<N>(length) {
        let (own, other) = (own.as_chunks_mut::<2>().0, other.as_chunks::<2>().0);
        for i in 0..own.len() {
            let (own, other) = (&mut own[black_box(i)], &other[i]);
            // no loop, of which the compiler would make such vectors as well
            visit(&mut own[0], &other[0]);
            visit(&mut own[1], &other[1]);
        }
        done = 2 * own.len();
    }
    for i in done..length {
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

/// Lanes of four coordinates and more: where the compiler sees the index of a loop over them, it makes vectors of one
/// lane of several coordinates, which are gathered from their places.
#[inline(always)]
fn are_many<N: Number>(length: usize) -> bool {
    N::LANES > 1 && length >= 4
}

/// An index of a loop over this number of coordinates, which the compiler does not see where they [are many](are_many).
#[inline(always)]
pub(crate) fn index<N: Number>(i: usize, length: usize) -> usize {
    if are_many::<N>(length) { black_box(i) } else { i }
}

/// The first of the initial values q1, q2, …, p1, p2, … that is infinite or NaN. One of several numbers in lanes may be
/// so: the other trajectories go on without it.
pub(crate) fn first_not_finite<N: Number>(q: &[N], p: &[N]) -> Option<String> {
    let not_finite = |x: &N| N::LANES == 1 && !x.is_finite();
    let first = |name: &str, values: &[N]| Some(format!("{name}{}", values.iter().position(not_finite)? + 1));
    first("q", q).or_else(|| first("p", p))
}
