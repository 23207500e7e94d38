//! A part of H with its flow, and the state that it moves.

use crate::number::Number;
use crate::systems::increments::Carried;
use crate::systems::state::VectorState;
use crate::systems::summation::Half;

/// A part A of H = H_1 + … + H_n whose flow is known.
pub trait Part<N: Number> {
    /// energy ← energy + A at a state.
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N);

    /// The exact flow over a time, and its part of the increments: β grows by ∫(qᵀA_q + pᵀA_p − 2A) dt. The state has
    /// the same bits with them and without.
    ///
    /// `continues` says that the state is the one that the last flow of this part has made, or another with the same q
    /// if it [is a potential](Part::is_potential): what stays along the flow is then known.
    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, continues: bool);

    /// Whether it is a function of q only, of this number of coordinates: what it evaluates then stays along the flows
    /// of other potentials.
    fn is_potential(&self, _coordinates: usize) -> bool {
        false
    }
}

/// A state that a flow changes, with its increments in an augmented step.
pub struct FlowState<'a, N> {
    state: &'a mut VectorState<N>,
    carried: Carried,
}

impl<'a, N: Number> FlowState<'a, N> {
    /// The state, with what its flow carries along.
    pub fn new(state: &'a mut VectorState<N>, carried: Carried) -> Self {
        FlowState { state, carried }
    }

    /// Positions.
    pub fn q(&self) -> &[N] {
        self.state.q()
    }

    /// Momenta.
    pub fn p(&self) -> &[N] {
        self.state.p()
    }

    /// A variable by its index: those of q come first.
    pub fn variable(&self, index: usize) -> &N {
        let count = self.q().len();
        if index < count { &self.q()[index] } else { &self.p()[index - count] }
    }

    /// Whether β is needed.
    pub fn is_augmented(&self) -> bool {
        self.carried.has_increments()
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
        self.state.add_to_beta(self.carried, a, b);
    }

    fn change(&mut self, index: usize, add: impl Fn(&mut N)) {
        let count = self.q().len();
        let (half, index) = if index < count { (Half::Positions, index) } else { (Half::Momenta, index - count) };
        self.state.change(half, index, self.carried, add);
    }
}
