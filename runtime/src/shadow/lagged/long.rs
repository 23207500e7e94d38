//! The products of a long state with what the newest steps added: sums over coordinates in vectors of the processor.

use crate::number::Number;
use crate::number::instructions;
use crate::number::saved::Fields;

/// Coordinates are added up in this number of sums that do not wait for one another, on all machines.
const LANES: usize = 8;
/// This number of lags take turns.
const AT_ONCE: usize = 4;

/// Some of what a step added to q and p. Each is a line of a processor's cache, which vectors of `f64` then do not
/// cross.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Group<N> {
    q: [N; LANES],
    p: [N; LANES],
}

/// What the newest steps added, each in turn.
#[derive(Clone, Debug)]
pub(super) struct LongRows<N> {
    lags: usize,
    /// The groups of a step.
    groups: usize,
    /// The groups of all steps; the last group of a step is filled up with zeros.
    rows: Vec<Group<N>>,
    beta: Vec<N>,
    /// Partial sums, side by side in memory: the compiler makes vectors of them.
    sums: [[N; LANES]; AT_ONCE],
}

impl<N: Number> LongRows<N> {
    pub(super) fn new(lags: usize, dimension: usize, context: &N::Context) -> Self {
        let zeros = || std::array::from_fn(|_| N::zero(context));
        let groups = dimension.div_ceil(LANES);
        LongRows {
            lags,
            groups,
            rows: vec![Group { q: zeros(), p: zeros() }; groups * lags],
            beta: vec![N::zero(context); lags],
            sums: std::array::from_fn(|_| zeros()),
        }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        for Group { q, p } in &mut self.rows {
            to.numbers(q);
            to.numbers(p);
        }
        to.numbers(&mut self.beta);
    }

    /// Keeps what a step added.
    pub(super) fn keep(&mut self, place: usize, [q, p]: [&[N]; 2], beta: &N) {
        self.beta[place].assign(beta);
        let row = &mut self.rows[self.groups * place..][..self.groups];
        let ((q, q_rest), (p, p_rest)) = (q.as_chunks::<LANES>(), p.as_chunks::<LANES>());
        for (own, (q, p)) in row.iter_mut().zip(q.iter().zip(p)) {
            own.q.clone_from(q);
            own.p.clone_from(p);
        }
        if let Some(last) = row.get_mut(q.len()) {
            last.q.iter_mut().zip(q_rest).for_each(|(own, q)| own.assign(q));
            last.p.iter_mut().zip(p_rest).for_each(|(own, p)| own.assign(p));
        }
    }

    /// The products of a state with all steps, the oldest first; 0 for groups of steps before the newest `known` ones.
    #[inline(never)]
    pub(super) fn products<const K: usize>(&mut self, newest: usize, [q, p]: [&[N]; 2], known: usize) -> [N; K] {
        let mut products = std::array::from_fn(|_| N::zero(&q[0].context()));
        instructions::widest_if_long(
            N::IN_VECTORS,
            K * q.len(),
            #[inline(always)]
            || {
                let groups = products.as_chunks_mut::<AT_ONCE>().0.iter_mut().enumerate();
                for (group, products) in groups.skip(K.saturating_sub(known) / AT_ONCE) {
                    self.add_lags(newest + 1 + group * AT_ONCE, [q, p], products);
                }
            },
        );
        products
    }

    /// The products with the steps at `first`, `first` + 1, …
    #[inline(always)]
    fn add_lags(&mut self, first: usize, [q, p]: [&[N]; 2], products: &mut [N; AT_ONCE]) {
        let ((q, q_rest), (p, p_rest)) = (q.as_chunks::<LANES>(), p.as_chunks::<LANES>());
        let count = q.len();
        let places: [usize; AT_ONCE] = std::array::from_fn(|i| (first + i) % self.lags);
        let rows = places.map(|place| &self.rows[self.groups * place..][..self.groups]);
        let [row_0, row_1, row_2, row_3] = rows.map(|row| &row[..count]);
        let zero = || N::zero(&products[0].context());
        let mut sums: [[N; LANES]; AT_ONCE] = std::array::from_fn(|_| std::array::from_fn(|_| zero()));
        for c in 0..count {
            // one by one: so the compiler keeps the sums in registers
            add(&mut sums[0], &row_0[c], [&q[c], &p[c]]);
            add(&mut sums[1], &row_1[c], [&q[c], &p[c]]);
            add(&mut sums[2], &row_2[c], [&q[c], &p[c]]);
            add(&mut sums[3], &row_3[c], [&q[c], &p[c]]);
        }
        self.sums = sums;
        for i in 0..AT_ONCE {
            let product = &mut products[i];
            product.assign(&self.beta[places[i]]);
            for (l, (q, p)) in q_rest.iter().zip(p_rest).enumerate() {
                product.add_product(q, &rows[i][count].p[l]);
                product.subtract_product(p, &rows[i][count].q[l]);
            }
            self.sums[i].iter().for_each(|sum| product.add(sum));
        }
    }
}

/// Adds q·δp − p·δq.
#[inline(always)]
fn add<N: Number>(sums: &mut [N; LANES], added: &Group<N>, [q, p]: [&[N; LANES]; 2]) {
    for l in 0..LANES {
        sums[l].add_product(&q[l], &added.p[l]);
        sums[l].subtract_product(&p[l], &added.q[l]);
    }
}
