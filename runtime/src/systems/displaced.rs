//! Gradient kicks by a force at displaced positions, in place of second derivatives.

use crate::number::{Number, Real};

/// How far the gradient kicks of a stepper displace the positions at which the force is evaluated once more.
///
/// A kick of weight a with a gradient kick of weight c becomes
///
/// p −= h a U_q(q′), q′ = q − δ M⁻¹U_q(q), δ = 2h²c/a,
///
/// which agrees with the exact one, p −= h a (U_q − δ U_qq M⁻¹U_q), but for h a δ². It takes a force in place of a
/// Hessian–vector product, and **is not exactly symplectic**: U_q(q′) as a function of q has a curl of order δ², but
/// for one degree of freedom. So the modified energy drifts.
///
/// In the run of steps, the gradient kick adds h a (U_q(q) − U_q(q′)) to the kick. To β the two add h a times the rate
/// qᵀU_q − 2U at q′: the rate of the potential W = U(q′) + (δ/2) U_q(q)ᵀM⁻¹U_q(q′), with U_q(q′) in the place of W_q,
/// from which it differs by order δ².
///
/// [`Stepper::displacements`](crate::Stepper::displacements) computes them; a system takes them where it is made, as
/// [`Motion::displaced`](crate::Motion::displaced).
///
/// Sources: Wisdom, Holman & Touma, Fields Inst. Commun. 10 (1996) 217; Yin & Mawhinney, arXiv:1111.5059; Rein, Tamayo
/// & Brown, Mon. Not. R. Astron. Soc. 489 (2019) 4632, whose "lazy implementer's kernel" it is.
#[derive(Clone, Debug)]
pub struct Displacements<N> {
    /// Weights 2h³c and δ.
    known: Vec<(N, N)>,
    is_equal: fn(&N, &N) -> bool,
}

impl<N: Real> Displacements<N> {
    /// Of weights 2h³c with δ of each.
    pub(crate) fn of(known: Vec<(N, N)>) -> Self {
        Displacements { known, is_equal: |a, b| a == b }
    }
}

impl<N: Number> Displacements<N> {
    /// The place of a gradient kick's weight, or of its negative for a step back, and δ.
    ///
    /// # Panics
    /// If the stepper with these displacements has no such weight.
    pub(crate) fn of_weight(&self, weight: &N) -> (usize, &N) {
        let mut negative = weight.clone();
        negative.negate();
        let is = |(known, _): &(N, N)| (self.is_equal)(known, weight) || (self.is_equal)(known, &negative);
        let place = self.known.iter().position(is);
        let place = place.expect(
            "the displacements of gradient kicks belong to another stepper: make the system with those of this one",
        );
        (place, &self.known[place].1)
    }
}
