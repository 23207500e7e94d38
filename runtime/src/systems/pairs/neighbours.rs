//! Lists of the bodies that may be within the cutoff of each other: Verlet's, made by cells.
//!
//! A list has all pairs up to the cutoff and a skin. It is made again as soon as a body has moved by half of the skin,
//! so that no pair can be missed. What is computed from it does not depend on when it was made: partners are sorted,
//! and those beyond the cutoff do not count.

use super::pair::BLOCK;
use crate::number::{Number, instructions, scaled};

/// The skin as a part of the cutoff.
const SKIN: f64 = 0.15;

/// Cells a little wider than the lists reach, for the rounding of positions in them.
const WIDER: f64 = 1.0 + 1e-9;

/// Rounding of coordinates to `f64`, and of their differences, as parts of the largest.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The partners of each body, those with smaller numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbours {
    /// The sum of cutoff and skin, without the rounding of coordinates.
    reach: f64,
    skin: f64,
    /// The positions of which the list is, lane after lane; empty before the first.
    listed_at: Vec<f64>,
    /// Where the partners of each body begin, and where those of the last one end.
    starts: Vec<usize>,
    partners: Vec<u32>,
}

/// The nearest integer, ties to even, in operations of every processor; of |x| < 2⁵¹.
#[inline(always)]
pub(super) fn nearest_integer(x: f64) -> f64 {
    const SHIFT: f64 = 6_755_399_441_055_744.0; // 1.5·2⁵²
    x + SHIFT - SHIFT
}

/// Every coordinate as an `f64`, lane after lane.
fn positions<N: Number>(q: &[N]) -> impl Iterator<Item = f64> {
    (0..N::LANES).flat_map(move |lane| {
        q.iter().map(
            #[inline(always)]
            move |x| {
                let (m, n) = x.lane(lane);
                scaled(m, n)
            },
        )
    })
}

impl Neighbours {
    pub(super) fn new(cutoff: f64) -> Self {
        let skin = SKIN * cutoff;
        Neighbours { reach: cutoff + skin, skin, ..Neighbours::default() }
    }

    /// The positions of which the list is.
    #[cfg(test)]
    pub(super) fn listed_at(&self) -> &[f64] {
        &self.listed_at
    }

    /// The partners of a body, in ascending order.
    #[inline(always)]
    pub(super) fn of(&self, body: usize) -> &[u32] {
        &self.partners[self.starts[body]..self.starts[body + 1]]
    }

    /// Makes the list for these positions, in a box with these sides or in open space, unless that which is there still
    /// has all pairs.
    pub(super) fn update<N: Number, const D: usize>(&mut self, q: &[N], sides: Option<&[f64; D]>) {
        if self.is_current::<N, D>(q) {
            return;
        }
        self.listed_at.clear();
        self.listed_at.extend(positions(q));
        let largest = self.listed_at.iter().fold(0.0_f64, |largest, x| x.abs().max(largest));
        let reach = self.reach + largest * ROUNDING;
        self.starts.clear();
        self.partners.clear();
        self.starts.push(0);
        let bodies = q.len() / D;
        let (positions, _) = self.listed_at.as_chunks::<D>();
        match Grid::of(positions, reach, sides).filter(|_| N::LANES == 1) {
            Some(grid) => {
                let cells = Cells::of(positions, grid);
                for body in 0..bodies {
                    let first = self.partners.len();
                    instructions::widest(
                        #[inline(always)]
                        || cells.add_partners(body, reach, &mut self.partners),
                    );
                    self.partners[first..].sort_unstable();
                    self.starts.push(self.partners.len());
                }
            }
            None => {
                for body in 0..bodies {
                    let is_near = |other: &usize| {
                        let lanes = positions.chunks_exact(bodies);
                        lanes.into_iter().any(|q| distance_squared(&q[body], &q[*other], sides) <= reach * reach)
                    };
                    self.partners.extend((0..body).filter(is_near).map(|other| other as u32));
                    self.starts.push(self.partners.len());
                }
            }
        }
    }

    /// Whether no body has moved by half of the skin.
    fn is_current<N: Number, const D: usize>(&self, q: &[N]) -> bool {
        if self.listed_at.len() != q.len() * N::LANES {
            return false;
        }
        let least = self.skin / 2.0 * (1.0 - 1e-9);
        let limit = least * least;
        let mut moved = positions(q).zip(&self.listed_at);
        for _ in 0..self.listed_at.len() / D {
            let mut squared = 0.0;
            for _ in 0..D {
                let (x, before) = moved.next().expect("all coordinates have their place");
                squared += (x - before) * (x - before);
            }
            // as one does whose position is not a number
            if squared.is_nan() || squared > limit {
                return false;
            }
        }
        true
    }
}

/// The square of the distance of two bodies, or of the nearest images of them.
fn distance_squared<const D: usize>(a: &[f64; D], b: &[f64; D], sides: Option<&[f64; D]>) -> f64 {
    let mut squared = 0.0;
    for axis in 0..D {
        let mut difference = a[axis] - b[axis];
        if let Some(sides) = sides {
            difference -= nearest_integer(difference / sides[axis]) * sides[axis];
        }
        squared += difference * difference;
    }
    squared
}

/// Cells of equal size, at least as wide as the lists reach: partners are in neighbouring ones.
struct Grid<const D: usize> {
    counts: [usize; D],
    widths: [f64; D],
    /// The least coordinates in open space.
    origin: [f64; D],
    sides: Option<[f64; D]>,
}

impl<const D: usize> Grid<D> {
    /// None if all cells can have partners, or if positions are not finite.
    fn of(positions: &[[f64; D]], reach: f64, sides: Option<&[f64; D]>) -> Option<Self> {
        if !positions.iter().flatten().all(|x| x.is_finite()) {
            return None;
        }
        let ends = |axis: usize| {
            let along = positions.iter().map(move |position| position[axis]);
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, largest], x| [x.min(least), x.max(largest)])
        };
        let ends: [[f64; 2]; D] =
            std::array::from_fn(|axis| sides.map_or_else(|| ends(axis), |sides| [0.0, sides[axis]]));
        // not many more cells than bodies, where these are far apart
        let most = (8.0 * positions.len() as f64).powf(1.0 / D as f64).ceil();
        let counts =
            ends.map(|[least, largest]| ((largest - least) / (reach * WIDER)).floor().clamp(1.0, most) as usize);
        // in a box, no cell is a neighbour twice
        let is_of_use = match sides {
            Some(_) => counts.iter().all(|&count| count > 2),
            None => counts.iter().any(|&count| count > 1),
        };
        if !is_of_use {
            return None;
        }
        let widths = std::array::from_fn(|axis| (ends[axis][1] - ends[axis][0]) / counts[axis] as f64);
        Some(Grid { counts, widths, origin: ends.map(|[least, _]| least), sides: sides.copied() })
    }

    /// The number of a cell.
    fn index(&self, cell: &[usize; D]) -> usize {
        cell.iter().zip(&self.counts).fold(0, |index, (cell, count)| index * count + cell)
    }

    /// The cell of a body, and its position, in the box.
    fn place(&self, position: &[f64; D]) -> Place<D> {
        let position: [f64; D] = std::array::from_fn(|axis| match self.sides {
            Some(sides) => position[axis] - (position[axis] / sides[axis]).floor() * sides[axis],
            None => position[axis] - self.origin[axis],
        });
        let cell =
            std::array::from_fn(|axis| ((position[axis] / self.widths[axis]) as usize).min(self.counts[axis] - 1));
        Place { cell, position }
    }
}

/// Where a body is.
#[derive(Clone, Copy)]
struct Place<const D: usize> {
    cell: [usize; D],
    position: [f64; D],
}

/// Bodies by the cells of a grid: those of a row along the last axis one after the other.
struct Cells<const D: usize> {
    grid: Grid<D>,
    places: Vec<Place<D>>,
    /// Positions by axes, in the order of cells, with room for a block more.
    sorted: [Vec<f64>; D],
    bodies: Vec<u32>,
    /// Where the bodies of each cell begin, and where those of the last one end.
    starts: Vec<usize>,
}

impl<const D: usize> Cells<D> {
    fn of(positions: &[[f64; D]], grid: Grid<D>) -> Self {
        let places: Vec<_> = positions.iter().map(|position| grid.place(position)).collect();
        let mut starts = vec![0; grid.counts.iter().product::<usize>() + 1];
        places.iter().for_each(|place| starts[grid.index(&place.cell) + 1] += 1);
        (1..starts.len()).for_each(|cell| starts[cell] += starts[cell - 1]);
        let mut next = starts.clone();
        let mut sorted: [Vec<f64>; D] = std::array::from_fn(|_| vec![0.0; positions.len() + BLOCK]);
        let mut bodies = vec![0; positions.len() + BLOCK];
        for (body, place) in places.iter().enumerate() {
            let at = &mut next[grid.index(&place.cell)];
            bodies[*at] = body as u32;
            (0..D).for_each(|axis| sorted[axis][*at] = place.position[axis]);
            *at += 1;
        }
        Cells { grid, places, sorted, bodies, starts }
    }

    /// Adds the partners of a body, those with smaller numbers, in any order.
    #[inline(always)]
    fn add_partners(&self, body: usize, reach: f64, partners: &mut Vec<u32>) {
        let Place { cell, position } = self.places[body];
        // the offsets along all axes but the last as the digits of a number
        for offsets in 0..3_usize.pow(D as u32 - 1) {
            let (mut row, mut seen_from, mut rest) = (cell, position, offsets);
            let is_there = (0..D - 1).all(|axis| {
                let neighbour = self.neighbour(axis, cell[axis] + rest % 3);
                rest /= 3;
                neighbour.is_some_and(|(index, shift)| {
                    row[axis] = index;
                    seen_from[axis] -= shift;
                    true
                })
            });
            if !is_there {
                continue;
            }
            let last = D - 1;
            let along = (0..3).filter_map(|offset| self.neighbour(last, cell[last] + offset));
            // neighbouring cells of a row that are in one image are one stretch of bodies
            let mut stretch: Option<(std::ops::Range<usize>, f64)> = None;
            for (index, shift) in along {
                row[last] = index;
                let at = self.grid.index(&row);
                let bodies = self.starts[at]..self.starts[at + 1];
                match &mut stretch {
                    Some((range, own)) if *own == shift && range.end == bodies.start => range.end = bodies.end,
                    other => {
                        if let Some((range, shift)) = other.replace((bodies, shift)) {
                            self.add_near(range, (body, &seen_from, shift), reach, partners);
                        }
                    }
                }
            }
            if let Some((range, shift)) = stretch {
                self.add_near(range, (body, &seen_from, shift), reach, partners);
            }
        }
    }

    /// The cell before the one with this number along an axis, and how far the image of the box is in which it is.
    fn neighbour(&self, axis: usize, next: usize) -> Option<(usize, f64)> {
        let count = self.grid.counts[axis];
        match self.grid.sides {
            _ if (1..=count).contains(&next) => Some((next - 1, 0.0)),
            None => None,
            Some(sides) if next == 0 => Some((count - 1, -sides[axis])),
            Some(sides) => Some((0, sides[axis])),
        }
    }

    /// Adds those of a stretch of bodies, in an image of the box along the last axis, that are near and have smaller
    /// numbers.
    #[inline(always)]
    fn add_near(
        &self,
        range: std::ops::Range<usize>,
        (body, seen_from, shift): (usize, &[f64; D], f64),
        reach: f64,
        partners: &mut Vec<u32>,
    ) {
        let mut seen_from = *seen_from;
        seen_from[D - 1] -= shift;
        let before = partners.len();
        partners.resize(before + range.len(), 0);
        let (room, mut count) = (&mut partners[before..], 0);
        let mut first = range.start;
        while first < range.end {
            // whole blocks, of which the last may have bodies beyond the stretch
            let sorted: [&[f64; BLOCK]; D] = std::array::from_fn(|axis| block(&self.sorted[axis], first));
            let bodies = block(&self.bodies, first);
            let mut squared = [0.0; BLOCK];
            for axis in 0..D {
                for l in 0..BLOCK {
                    squared[l] += (sorted[axis][l] - seen_from[axis]).powi(2);
                }
            }
            for l in 0..BLOCK.min(range.end - first) {
                room[count] = bodies[l];
                count += usize::from(squared[l] <= reach * reach && (bodies[l] as usize) < body);
            }
            first += BLOCK;
        }
        partners.truncate(before + count);
    }
}

#[inline(always)]
fn block<T>(of: &[T], first: usize) -> &[T; BLOCK] {
    of[first..].first_chunk().expect("there is room for a block beyond the last")
}
