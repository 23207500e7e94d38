//! Gradients of several systems that have one program.

/// How many systems there are: of 16 lanes, 64 trajectories, whose registers fit into the nearest cache.
pub(crate) const SYSTEMS: usize = 4;

/// A gradient that an interpreter evaluates, for several systems that differ in the values of parameters: each
/// instruction for all systems before the next one. So it is decoded once, and need not wait for the results of the one
/// before.
pub trait GradientProgram<N> {
    /// Where the instructions are: the same for the same program only.
    fn address(&self) -> *const ();

    /// Evaluates U_q of each system, by coordinates, as `q` is, in the registers from the index on that is returned.
    /// The registers are the systems' scratch spaces, prepared, side by side.
    fn gradients(&self, q: &[[N; SYSTEMS]], registers: &mut [[N; SYSTEMS]]) -> usize;
}
