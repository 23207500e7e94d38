//! Transformed time: steps that become short in close encounters, and stay symplectic.
//!
//! H = T(p) + U(q) is extended by the time t as a coordinate, with the momentum p_t = −H(0). For a function f that
//! grows, H′ = f(T + p_t) − f(−U) has two parts with explicit flows. Along a solution H′ = 0, and q, p and t are those
//! of H in the *fictitious time* s with dt/ds = f′(T + p_t) = f′(−U) (Preto & Tremaine, Astron. J. 118 (1999) 2532;
//! Mikkola & Tanikawa, Celest. Mech. Dyn. Astron. 74 (1999) 287). With f = ln the leapfrog that begins with a drift
//! keeps every Kepler orbit on its ellipse.
//!
//! | part | flow for a weight w | increment of β |
//! | --- | --- | --- |
//! | f(T + p_t), drift | q += w f′ T_p, t += w f′, with f′ at T + p_t, which stays | w (f′ (pᵀT_p + p_t) − 2f) |
//! | −f(−U), kick | p −= w f′ U_q, with f′ at −U, which stays | w (f′ qᵀU_q + 2f) |
//!
//! ```
//! use shadowstep::systems::transformed_time::{TimeTransformation, TransformedKinetic, TransformedPotential};
//! use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, tables};
//!
//! let time = TimeTransformation::Logarithmic;
//! // q, t and p, p_t of an orbit with e = 0.999 at its pericentre; H = −1/2
//! let (q, p) = ([0.001, 0.0, 0.0], [0.0, 1999.0_f64.sqrt(), 0.5]);
//! let potential = TransformedPotential::new(time, Kepler);
//! let mut motion = Motion::new(potential, TransformedKinetic::new(time, UnitMasses), q, p)?;
//! let source = tables::shipped_source("stormer-verlet").unwrap();
//! let verlet = tables::read(&source, &|_, _| None, Some(tables::First::Drift))?.for_every_kinetic()?;
//! let stepper = Stepper::new(verlet, "1/20")?;
//! for _ in 0..1000 {
//!     stepper.step(&mut motion);
//!     let (q, p) = (motion.q(), motion.p());
//!     let energy = (p[0] * p[0] + p[1] * p[1]) / 2.0 - 1.0 / q[0].hypot(q[1]);
//!     assert!((energy + 0.5).abs() < 1e-9); // without the transformation the orbit is lost in the first period
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod function;

pub use function::{ExponentError, TimeTransformation};

use crate::number::Number;
use crate::systems::explicit_time::{split, split_mut};
use crate::systems::kinetic::{General, Kinetic};
use crate::systems::potential::Potential;
use function::Place;

/// −f(−U) of a potential U, in q and t: the last coordinate is t. Where −U is not positive the gradient is not finite.
#[derive(Clone, Debug)]
pub struct TransformedPotential<P> {
    time: TimeTransformation,
    potential: P,
}

impl<P> TransformedPotential<P> {
    /// The part of H′ of this potential.
    pub fn new(time: TimeTransformation, potential: P) -> Self {
        TransformedPotential { time, potential }
    }

    /// x ← −U(q) and its f′
    fn argument<N: Number>(&self, q: &[N], place: &mut Place<'_, N>, inner: &mut [N])
    where
        P: Potential<N>,
    {
        self.potential.energy(q, place.x, inner);
        place.x.negate();
        place.refuse_negative();
        self.time.derivative(place);
    }
}

impl<N: Number, P: Potential<N>> Potential<N> for TransformedPotential<P> {
    fn dimension(&self) -> usize {
        self.potential.dimension() + 1
    }

    fn scratch(&self) -> usize {
        Place::<N>::SCRATCH + self.potential.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.potential.prepare(Place::prepare(scratch, context), context);
    }

    fn update(&mut self, q: &[N]) {
        self.potential.update(split(q).1);
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        let (mut place, inner) = Place::of(scratch);
        self.argument(split(q).1, &mut place, inner);
        self.time.value(place.x, place.derivative, energy);
        energy.negate();
    }

    /// gradient ← f′(−U) U_q
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        let (mut place, inner) = Place::of(scratch);
        let (q, (of_time, gradient)) = (split(q).1, split_mut(gradient));
        self.argument(q, &mut place, inner);
        self.potential.gradient(q, gradient, inner);
        gradient.iter_mut().for_each(|u| u.multiply(place.derivative));
        of_time.assign_zero();
    }

    /// rate ← f′ qᵀU_q + 2f
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        let (mut place, inner) = Place::of(scratch);
        let (q, (of_time, gradient)) = (split(q).1, split_mut(gradient));
        self.argument(q, &mut place, inner);
        self.potential.gradient_and_rate(q, gradient, rate, inner);
        gradient.iter_mut().for_each(|u| u.multiply(place.derivative));
        of_time.assign_zero();
        // qᵀU_q = (qᵀU_q − 2U) + 2U; summed from q and U_q it would lose digits in a close encounter
        rate.subtract(place.x);
        rate.subtract(place.x);
        rate.multiply(place.derivative);
        self.time.value(place.x, place.derivative, place.spare);
        place.spare.multiply_integer(2);
        rate.add(place.spare);
    }
}

/// f(T + p_t) of a kinetic energy T, in p and p_t: the last momentum is p_t. Where T + p_t is not positive the drift is
/// not finite.
#[derive(Clone, Debug)]
pub struct TransformedKinetic<K> {
    time: TimeTransformation,
    kinetic: K,
}

impl<K> TransformedKinetic<K> {
    /// The part of H′ of this kinetic energy.
    pub fn new(time: TimeTransformation, kinetic: K) -> Self {
        TransformedKinetic { time, kinetic }
    }

    /// x ← T + p_t and its f′, then the weight of the flow of T, which is w f′.
    fn argument<N: Number>(&self, p: &[N], place: &mut Place<'_, N>, inner: &mut [N])
    where
        K: Kinetic<N>,
    {
        let (of_time, p) = split(p);
        self.kinetic.energy(p, place.x, inner);
        place.x.add(of_time);
        place.refuse_negative();
        self.time.derivative(place);
    }
}

impl<N: Number, K: Kinetic<N>> Kinetic<N> for TransformedKinetic<K> {
    type Class = General;

    fn dimension(&self) -> Option<usize> {
        self.kinetic.dimension().map(|dimension| dimension + 1)
    }

    fn scratch(&self) -> usize {
        Place::<N>::SCRATCH + self.kinetic.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.kinetic.prepare(Place::prepare(scratch, context), context);
    }

    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        let (mut place, inner) = Place::of(scratch);
        self.argument(p, &mut place, inner);
        place.spare.assign_product(weight, place.derivative);
        let (t, q) = split_mut(q);
        self.kinetic.drift(place.spare, split(p).1, q, inner);
        t.add(place.spare);
    }

    /// The drift, and β ← β + w (f′ (pᵀT_p − 2T) + f′ (2T + p_t) − 2f)
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]) {
        let (mut place, inner) = Place::of(scratch);
        self.argument(p, &mut place, inner);
        place.spare.assign_product(weight, place.derivative);
        let ((t, q), (of_time, p)) = (split_mut(q), split(p));
        self.kinetic.drift_augmented(place.spare, p, q, beta, inner);
        t.add(place.spare);
        self.time.value(place.x, place.derivative, place.value);
        // 2T + p_t = 2x − p_t
        place.x.multiply_integer(2);
        place.x.subtract(of_time);
        beta.add_product(place.spare, place.x);
        place.value.multiply_integer(2);
        beta.subtract_product(weight, place.value);
    }

    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        let (mut place, inner) = Place::of(scratch);
        self.argument(p, &mut place, inner);
        self.time.value(place.x, place.derivative, energy);
    }

    /// x f′(x) at x = T + p_t, by which f changes when x changes by its own size; f itself may be 0 or negative.
    fn exchanged_energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        let (mut place, inner) = Place::of(scratch);
        self.argument(p, &mut place, inner);
        energy.assign_product(place.x, place.derivative);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Limbs;
    use crate::systems::potential_check::check_potential;
    use crate::systems::problems::Kepler;
    use crate::{DiagonalMasses, Rational, exact};

    fn times() -> [TimeTransformation; 3] {
        let power = |text: &str| TimeTransformation::power(&exact(text).unwrap()).unwrap();
        [TimeTransformation::Logarithmic, power("-1/2"), power("1/3")]
    }

    /// The derivatives of a function of some numbers, by central differences of 60 digits.
    fn slope(at: &[Limbs<7>], i: usize, mut function: impl FnMut(&[Limbs<7>]) -> Limbs<7>) -> Limbs<7> {
        let small = Limbs::from_rational(&exact("1e-40").unwrap(), &());
        let mut moved = at.to_vec();
        moved[i].add(&small);
        let mut difference = function(&moved);
        moved[i].subtract(&small);
        moved[i].subtract(&small);
        difference.subtract(&function(&moved));
        difference.divide(&small);
        difference.divide_integer(2);
        difference
    }

    fn numbers(texts: [&str; 3]) -> Vec<Limbs<7>> {
        texts.map(|text| Limbs::from_rational(&exact(text).unwrap(), &())).to_vec()
    }

    fn close(a: &Limbs<7>, b: &Limbs<7>) {
        use crate::number::Real;
        let mut difference = *a;
        difference.subtract(b);
        assert!(difference.log10_abs() < -70.0, "{a:?} {b:?}");
    }

    #[test]
    fn gradient_and_rate_belong_to_the_energy() {
        for time in times() {
            let mut potential = TransformedPotential::new(time, Kepler);
            let check = check_potential(&mut potential, &[numbers(["0.3", "-0.2", "17"])]).unwrap();
            assert!(check.agrees(), "{check}");
        }
    }

    #[test]
    fn a_drift_and_its_rate_belong_to_the_energy() {
        for time in times() {
            let masses: Vec<Rational> = ["2", "3"].iter().map(|mass| exact(mass).unwrap()).collect();
            let kinetic = TransformedKinetic::new(time, DiagonalMasses::<Limbs<7>>::new(&masses, &()).unwrap());
            let p = numbers(["0.3", "-1.2", "0.4"]);
            let zero = numbers(["0", "0", "0"]);
            let mut scratch = zero.clone();
            scratch.resize(kinetic.scratch(), zero[0]);
            kinetic.prepare(&mut scratch, &());
            let mut energy = |p: &[Limbs<7>]| {
                let mut energy = p[0];
                kinetic.energy(p, &mut energy, &mut scratch);
                energy
            };
            let slopes: Vec<_> = (0..3).map(|i| slope(&p, i, &mut energy)).collect();
            let mut expected = energy(&p);
            expected.multiply_integer(-2);
            p.iter().zip(&slopes).for_each(|(p, t)| expected.add_product(p, t));
            let weight = Limbs::from_rational(&exact("3/4").unwrap(), &());
            let (mut q, mut plain, mut beta) = (zero.clone(), zero.clone(), zero[0]);
            kinetic.drift(&weight, &p, &mut plain, &mut scratch);
            kinetic.drift_augmented(&weight, &p, &mut q, &mut beta, &mut scratch);
            assert_eq!(q, plain);
            for (q, slope) in q.iter_mut().zip(&slopes) {
                q.divide(&weight);
                close(q, slope);
            }
            beta.divide(&weight);
            close(&beta, &expected);
        }
    }

    #[test]
    fn energies_of_the_wrong_sign_are_not_finite() {
        for time in times() {
            let spring = TransformedPotential::new(time, Spring);
            let free = TransformedKinetic::new(time, crate::UnitMasses);
            let mut scratch = vec![0.0; 10];
            spring.prepare(&mut scratch, &());
            let (mut gradient, mut energy) = ([0.0; 2], 0.0);
            spring.gradient(&[0.5, 0.0], &mut gradient, &mut scratch);
            spring.energy(&[0.5, 0.0], &mut energy, &mut scratch);
            assert!(!gradient[0].is_finite() && !energy.is_finite(), "{time:?}");
            Kinetic::<f64>::prepare(&free, &mut scratch, &());
            let mut q = [0.0; 2];
            free.drift(&1.0, &[0.5, -0.2], &mut q, &mut scratch);
            assert!(!q[0].is_finite() && !q[1].is_finite(), "{time:?}");
        }
    }

    /// U = q²/2, which is not negative.
    struct Spring;

    impl<N: Number> Potential<N> for Spring {
        fn dimension(&self) -> usize {
            1
        }
        fn energy(&self, q: &[N], energy: &mut N, _: &mut [N]) {
            energy.assign_square(&q[0]);
            energy.divide_integer(2);
        }
        fn gradient(&self, q: &[N], gradient: &mut [N], _: &mut [N]) {
            gradient[0].assign(&q[0]);
        }
    }
}
