//! What canonical coordinates of planetary systems have in common.

use crate::number::Number;

use super::bodies::Bodies;
use super::orbits::Orbits;

/// Canonical coordinates in which a planetary system is a sum of Kepler orbits and interactions.
///
/// Q₀ is the centre of mass and P₀ the total momentum; Q_i and P_i, i ≥ 1, are those of the planets. All is linear in
/// the inertial positions and momenta.
pub trait PlanetaryCoordinates<N: Number, const D: usize> {
    /// [`Quadratic`](crate::systems::kinetic::Quadratic) where the kick depends on Q only, else
    /// [`General`](crate::systems::kinetic::General).
    type Class;

    /// Whether the kick depends on Q only, so that `[B,[A,B]]` has a flow of its own, gradient kicks, and B may have
    /// other potentials.
    const HAS_GRADIENT_KICKS: bool;

    /// The coordinates for bodies of these masses.
    fn new(bodies: &Bodies, context: &N::Context) -> Self;

    /// The Kepler orbits of A.
    fn orbits(&self) -> &Orbits<N>;

    /// canonical ← the coordinates of inertial positions, body after body.
    fn assign_positions(&mut self, inertial: &[N], canonical: &mut [N]);

    /// canonical ← the coordinates of inertial momenta. A gradient by inertial positions becomes one by Q in the same
    /// way, as the coordinates are canonical.
    fn assign_momenta(&mut self, inertial: &[N], canonical: &mut [N]);

    /// inertial ← the positions with these coordinates.
    fn assign_inertial_positions(&mut self, canonical: &[N], inertial: &mut [N]);

    /// inertial ← the momenta with these coordinates.
    fn assign_inertial_momenta(&mut self, canonical: &[N], inertial: &mut [N]);

    /// canonical ← the coordinates of an inertial state; each is positions and momenta.
    fn assign_from_inertial(&mut self, (q, p): (&[N], &[N]), (own_q, own_p): (&mut [N], &mut [N])) {
        self.assign_positions(q, own_q);
        self.assign_momenta(p, own_p);
    }

    /// inertial ← the state with these coordinates.
    fn assign_inertial(&mut self, (own_q, own_p): (&[N], &[N]), (q, p): (&mut [N], &mut [N])) {
        self.assign_inertial_positions(own_q, q);
        self.assign_inertial_momenta(own_p, p);
    }

    /// gradient ← ∂B/∂Q and, if asked for, rate ← QᵀB_Q − 2B = −3B, of the attraction in B.
    fn gradient_and_rate(&mut self, q: &[N], gradient: &mut [N], rate: Option<&mut N>);

    /// product ← B_QQ v, of the attraction in B.
    fn hessian_product(&mut self, q: &[N], v: &[N], product: &mut [N]);

    /// The velocity with which the part of B that depends on P moves all planets; there is none by default.
    fn jump(&mut self, p: &[N]) -> Option<&[N; D]> {
        let _ = p;
        None
    }

    /// energy ← B without other potentials
    fn assign_interaction_energy(&mut self, canonical: (&[N], &[N]), energy: &mut N);
}
