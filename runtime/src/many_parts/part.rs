//! A part of H with its flow, and the state that it moves.

use crate::number::Number;
use crate::system::OwnedIncrements;

/// A part A of H = H_1 + … + H_n whose flow is known.
pub trait Part<N: Number> {
    /// energy ← energy + A at a state.
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N);

    /// The exact flow over a time, and its part of the increments: β grows by ∫(qᵀA_q + pᵀA_p − 2A) dt. The state has the same bits with them and without.
    ///
    /// `continues` says that the state is the one that the last flow of this part has made: what stays along the flow is then known.
    fn flow(&mut self, time: &N, state: &mut Moving<'_, N>, continues: bool);
}

/// A state that a flow changes, with its increments in an augmented step.
pub struct Moving<'a, N> {
    q: &'a mut [N],
    p: &'a mut [N],
    increments: Option<&'a mut OwnedIncrements<N>>,
}

impl<'a, N: Number> Moving<'a, N> {
    /// Of q and p; with the increments in an augmented step.
    pub fn new(q: &'a mut [N], p: &'a mut [N], increments: Option<&'a mut OwnedIncrements<N>>) -> Self {
        Moving { q, p, increments }
    }

    /// Positions.
    pub fn q(&self) -> &[N] {
        self.q
    }

    /// Momenta.
    pub fn p(&self) -> &[N] {
        self.p
    }

    /// A variable by its index: those of q come first.
    pub fn variable(&self, index: usize) -> &N {
        let count = self.q.len();
        if index < count { &self.q[index] } else { &self.p[index - count] }
    }

    /// Whether β is needed.
    pub fn is_augmented(&self) -> bool {
        self.increments.is_some()
    }

    /// x ← x + by, of a variable by its index.
    pub fn add(&mut self, index: usize, by: &N) {
        self.change(index, |x| x.add(by));
    }

    /// x ← x + ab
    pub fn add_product(&mut self, index: usize, a: &N, b: &N) {
        self.change(index, |x| x.add_product(a, b));
    }

    /// x ← x − ab
    pub fn subtract_product(&mut self, index: usize, a: &N, b: &N) {
        self.change(index, |x| x.subtract_product(a, b));
    }

    /// β ← β + ab, in an augmented step.
    pub fn add_to_beta(&mut self, a: &N, b: &N) {
        if let Some(increments) = &mut self.increments {
            increments.beta.add_product(a, b);
        }
    }

    /// The same of a variable and of its increment.
    fn change(&mut self, index: usize, change: impl Fn(&mut N)) {
        let count = self.q.len();
        let (of_q, index) = if index < count { (true, index) } else { (false, index - count) };
        change(if of_q { &mut self.q[index] } else { &mut self.p[index] });
        if let Some(increments) = &mut self.increments {
            let vector = if of_q { &mut increments.q } else { &mut increments.p };
            // some number types keep none
            vector.get_mut(index).into_iter().for_each(change);
        }
    }
}
