//! The coordinate that turns fastest, each by itself, however little of the energy it has.

use super::turning::{STATES, Sums, Turning, assign_second_difference, turning};
use crate::number::instructions;
use crate::number::saved::Fields;
use crate::number::{Real, epsilon};

/// This number of coordinates of a long state is computed at once.
const LANES: usize = 8;

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
    /// For each coordinate Σ (δ²p)², then for each Σ δ²p δ⁴p, and for each Σ (δ⁴p)².
    sums: Vec<N>,
    /// 1000 ε
    rounding: N,
    x: N,
    y: N,
    z: N,
}

impl<N: Real> Fastest<N> {
    pub(super) fn new(dimension: usize, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let mut rounding: N = epsilon(context);
        rounding.multiply_integer(ROUNDING);
        Fastest {
            start: std::array::from_fn(|_| vec![zero(); dimension]),
            begun: 0,
            sums: vec![zero(); 3 * dimension],
            rounding,
            x: zero(),
            y: zero(),
            z: zero(),
        }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Fastest { start, begun, sums, .. } = self;
        start.iter_mut().for_each(|p| to.numbers(p));
        to.place(begun, STATES + 1);
        to.numbers(sums);
    }

    /// The number of coordinates.
    pub(super) fn dimension(&self) -> usize {
        self.sums.len() / 3
    }

    /// Whether p of the state n is of the beginning.
    pub(super) fn begins(&self, n: u64) -> bool {
        usize::try_from(n).is_ok_and(|n| n < self.start.len())
    }

    /// Takes p of the state n: a body that is lost in the first steps turns only there.
    #[inline]
    pub(super) fn begin(&mut self, n: u64, p: &[N]) {
        let Some(own) = usize::try_from(n).ok().and_then(|n| self.start.get_mut(n)) else { return };
        own.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        self.begun += 1;
    }

    /// Takes second differences of p at successive states, and p at the middle one.
    #[inline(always)]
    pub(super) fn add(&mut self, [before, second, after]: [&[N]; 3], p: &[N]) {
        let dimension = p.len();
        let (before, second, after) = (&before[..dimension], &second[..dimension], &after[..dimension]);
        if dimension >= LANES {
            self.add_lanes([before, second, after, p]);
        }
        let Fastest { sums, rounding, x, y, z, .. } = self;
        let (squares, others) = sums.split_at_mut(dimension);
        let (products, fourths) = others.split_at_mut(dimension);
        let fourths = &mut fourths[..dimension];
        for i in dimension - dimension % LANES..dimension {
            if turns(&second[i], (&p[i], rounding), [x, z]) {
                assign_second_difference(y, &before[i], &second[i], &after[i]);
                add_products([&mut squares[i], &mut products[i], &mut fourths[i]], &second[i], y);
            }
        }
    }

    /// The coordinates of a long state in groups.
    fn add_lanes(&mut self, vectors: [&[N]; 4]) {
        instructions::widest_if_long(
            N::IN_VECTORS,
            vectors[0].len(),
            #[inline(always)]
            || self.add_lanes_here(vectors),
        );
    }

    #[inline(always)]
    fn add_lanes_here(&mut self, [before, second, after, p]: [&[N]; 4]) {
        let Fastest { sums, rounding, x, y, z, .. } = self;
        let (squares, others) = sums.split_at_mut(p.len());
        let (products, fourths) = others.split_at_mut(p.len());
        let in_groups = |vector| -> &[[N; LANES]] { <[N]>::as_chunks(vector).0 };
        let (before, second, after, p) = (in_groups(before), in_groups(second), in_groups(after), in_groups(p));
        let sums = squares.as_chunks_mut::<LANES>().0.iter_mut();
        let sums = sums.zip(products.as_chunks_mut::<LANES>().0).zip(fourths.as_chunks_mut::<LANES>().0);
        for (((squares, products), fourths), (((before, second), after), p)) in
            sums.zip(before.iter().zip(second).zip(after).zip(p))
        {
            let mut of_group = [squares.clone(), products.clone(), fourths.clone()];
            let [of_squares, of_products, of_fourths] = &mut of_group;
            for l in 0..LANES {
                let turns = turns(&second[l], (&p[l], rounding), [x, z]);
                let (mut x, mut y) = (x.register(), y.register());
                x.assign(&second[l]);
                assign_second_difference(&mut *y, &before[l], &second[l], &after[l]);
                // zeros are added in place of a branch, so that the compiler makes vectors of coordinates
                if !turns {
                    x.assign_zero();
                    y.assign_zero();
                }
                add_products([&mut of_squares[l], &mut of_products[l], &mut of_fourths[l]], &x, &y);
            }
            [*squares, *products, *fourths] = of_group;
        }
    }

    /// The sums of a coordinate.
    fn sums(&self, i: usize) -> Sums<N> {
        let of = |place: usize| self.sums[place * self.dimension() + i].clone();
        Sums { squares: of(0), products: of(1), fourths: of(2) }
    }

    /// A coordinate that turned fast in the first five states, and turns at most a third as fast, or not at all, in the
    /// windows since; counted from 0, with the angle by which it turned.
    pub(super) fn lost(&self) -> Option<(usize, f64)> {
        if self.begun < STATES {
            return None;
        }
        let still = |i: usize| turning(&self.sums(i), &mut self.x.clone()).map_or(0.0, |turning| turning.angle);
        let angles = (0..self.dimension()).filter_map(|i| Some((i, self.angle_at_start(i)?)));
        angles
            .filter(|(i, angle)| *angle >= FAST && still(*i) <= angle / 3.0)
            .reduce(|fastest, other| if other.1 > fastest.1 { other } else { fastest })
    }

    /// The angle by which a coordinate turned in the first five states, π where it turned by more than half a turn a
    /// step; `None` where the second difference in the middle is small beside its neighbours or is round-off, so that
    /// it decides nothing.
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

    /// The second differences of p at the first states, from the n-th on.
    fn second_differences(&self, n: usize) -> Vec<N> {
        let mut differences = self.start[n].clone();
        for (i, own) in differences.iter_mut().enumerate() {
            assign_second_difference(own, &self.start[n][i], &self.start[n + 1][i], &self.start[n + 2][i]);
        }
        differences
    }

    /// The coordinate that turns by the largest angle, counted from 0; `None` where none turns.
    pub(super) fn found(&self) -> Option<(usize, Turning)> {
        let (mut all, mut quotient) = (self.clone(), self.x.clone());
        if self.begun == STATES {
            let [before, second, after] = [0, 1, 2].map(|n| self.second_differences(n));
            all.add([&before, &second, &after], &self.start[2]);
        }
        // the momentum of a centre of mass at rest is the round-off of the others
        let mut round_off = N::zero(&self.x.context());
        for squares in &all.sums[..all.dimension()] {
            if *squares > round_off {
                round_off.assign(squares);
            }
        }
        round_off.multiply(&self.rounding);
        round_off.multiply(&self.rounding);
        let moving = (0..all.dimension()).filter(|i| all.sums[*i] > round_off).collect::<Vec<_>>();
        let regular = moving.into_iter().filter_map(|i| Some((i, turning(&all.sums(i), &mut quotient)?)));
        regular
            .filter(|(_, turning)| turning.irregular <= LARGEST_IRREGULARITY)
            .reduce(|fastest, other| if other.1.angle > fastest.1.angle { other } else { fastest })
    }
}

/// Whether δ²p is more than round-off.
#[inline(always)]
fn turns<N: Real>(second: &N, (p, rounding): (&N, &N), [x, z]: [&mut N; 2]) -> bool {
    let (mut x, mut z) = (x.register(), z.register());
    x.assign(second);
    x.make_absolute();
    z.assign_product(p, rounding);
    z.make_absolute();
    *x > *z
}

/// Adds the products of δ²p and δ⁴p of a coordinate.
#[inline(always)]
fn add_products<N: Real>([squares, products, fourths]: [&mut N; 3], second: &N, fourth: &N) {
    squares.add_product(second, second);
    products.add_product(second, fourth);
    fourths.add_product(fourth, fourth);
}
