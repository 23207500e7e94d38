//! Hamiltonians H(q, p, t) that depend on time: t is a coordinate, and p_t its momentum.
//!
//! H + p_t does not depend on the time of its own flow, along which t grows by what time passes. So whatever splits H +
//! p_t has the kicks of U(q, t) at the times that its order needs (J. M. Sanz-Serna and M. P. Calvo, *Numerical
//! Hamiltonian Problems*, Chapman & Hall 1994, Section 10.1). T + p_t is at most quadratic in the momenta where T is:
//! Runge–Kutta–Nyström schemes keep their order. The steps conserve a modified function of H + p_t, which is what the
//! estimators give; p_t is minus the work that the explicit time does.

use crate::number::Number;
use crate::systems::kinetic::Kinetic;

/// T(p) + p_t: the last coordinate is t, the last momentum p_t.
///
/// ```
/// use shadowstep::{Motion, UnitMasses};
/// use shadowstep::systems::explicit_time::WithTime;
/// use shadowstep::systems::formula::FormulaPotential;
///
/// // a pendulum that is driven: q, t and p, p_t
/// let potential = FormulaPotential::new("-cos(q) - q*sin(2*t)/3", &["q", "t"], &[])?;
/// let motion = Motion::new(potential, WithTime(UnitMasses), [0.1, 0.0], [0.0, 0.0])?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct WithTime<K>(pub K);

/// The last number of a state, t or p_t, and those before it.
pub(crate) fn split<N>(state: &[N]) -> (&N, &[N]) {
    state.split_last().expect("a system has a coordinate")
}

/// The last number of a state, and those before it, to be changed.
pub(crate) fn split_mut<N>(state: &mut [N]) -> (&mut N, &mut [N]) {
    state.split_last_mut().expect("a system has a coordinate")
}

impl<N: Number, K: Kinetic<N>> Kinetic<N> for WithTime<K> {
    type Class = K::Class;

    fn dimension(&self) -> Option<usize> {
        self.0.dimension().map(|dimension| dimension + 1)
    }

    fn scratch(&self) -> usize {
        self.0.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.0.prepare(scratch, context);
    }

    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        let (t, q) = split_mut(q);
        self.0.drift(weight, split(p).1, q, scratch);
        t.add(weight);
    }

    /// p_t has degree 1: β ← β − w p_t besides what T adds.
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]) {
        let ((t, q), (of_time, p)) = (split_mut(q), split(p));
        self.0.drift_augmented(weight, p, q, beta, scratch);
        t.add(weight);
        beta.subtract_product(weight, of_time);
    }

    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        let (of_time, p) = split(p);
        self.0.energy(p, energy, scratch);
        energy.add(of_time);
    }

    /// That of T: p_t is no energy of the motion.
    fn exchanged_energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        let p = split(p).1;
        self.0.energy(p, energy, scratch);
        self.0.exchanged_energy(p, energy, scratch);
    }

    fn has_linear_terms(&self) -> bool {
        true
    }
}
