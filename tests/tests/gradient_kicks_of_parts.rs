//! Protects gradient kicks of systems with flows of their own: their force and rate of β, steps there and back, the
//! modified energy.

use rug::Float;
use shadowstep::number::{CorrectlyRounded, Limbs, Number, Real};
use shadowstep::problems::HenonHeiles;
use shadowstep::systems::formula::{FormulaOfBodies, RelativeTo};
use shadowstep::systems::linear_part::LinearPart;
use shadowstep::systems::potential::Sum;
use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, PlanetaryCoordinates, WisdomHolman};
use shadowstep::{Carried, Rational, Stepper, System};
use shadowstep_tests::shipped::twin;
use shadowstep_tests::steps::Steps;
use shadowstep_tests::{
    Bits, log10_distance, log10_largest_distance, numbers, precision, rational, stepper, variations,
};

const DIGITS: u32 = 90;

/// Three planets in space, so that pairs of planets, of planets with the central body and with centres of mass are
/// there.
fn planets<N: Number>(context: &N::Context) -> WisdomHolman<N, Jacobi<N, 3>, 3> {
    let masses = ["1", "1/1000", "1/3000", "1/500"].map(rational);
    let bodies = Bodies::new(rational("4*pi^2"), masses.to_vec()).expect("they are bodies");
    let q = ["0", "0", "0", "5.2", "0.1", "-0.2", "-9.4", "1.1", "0.3", "3", "17", "-0.5"];
    let v = ["0", "0", "0", "0.1", "2.7", "0", "-0.3", "-1.9", "0.1", "-1.5", "0.2", "0.05"];
    let momentum = |(axis, v): (usize, &&str)| N::from_rational(&(rational(v) * &masses[axis / 3]), context);
    let p: Vec<N> = v.iter().enumerate().map(momentum).collect();
    WisdomHolman::new(&bodies, (&numbers(&q, context), &p), context).expect("a state of four bodies")
}

/// The same with an oblate first body, and a tide.
fn with_more<N: Number>(
    context: &N::Context,
) -> WisdomHolman<N, Jacobi<N, 3>, 3, Sum<FormulaOfBodies<N>, FormulaOfBodies<N>>> {
    let masses = numbers::<N>(&["1", "1/1000", "1/3000", "1/500"], context);
    let parameters = [("s", N::from_rational(&rational("20"), context))];
    let of = |formula: &str, relative_to| {
        FormulaOfBodies::new(formula, relative_to, 3, &masses, &parameters).expect("it is a formula")
    };
    let oblate = of("m*s/r^3*(3*z^2/r^2 - 1) - m*s/r^2", RelativeTo::FirstBody);
    let tide = of("m*(x^2/1000 - y^3/s^4 + z^2/30)", RelativeTo::Origin);
    planets(context).beside(Some(Sum(oblate, tide))).expect("a potential of four bodies")
}

/// Hénon–Heiles with coupled oscillators of different masses, whose stiffness is not all of U_qq at 0.
fn oscillators<N: CorrectlyRounded>(context: &N::Context) -> LinearPart<N, HenonHeiles> {
    let stiffness = [["2", "1/5"], ["1/5", "1/3"]].map(|row| row.map(rational).to_vec());
    let (q, p) = (numbers(&["0.1", "0.2"], context), numbers(&["0.3", "-0.1"], context));
    LinearPart::new(HenonHeiles, &["3", "1/2"].map(rational), &stiffness, &q, &p).expect("the dimensions agree")
}

/// B_q and the rate qᵀB_q − 2B at q, from a kick of weight 1.
fn gradient_and_rate(system: &mut impl System<Number = Float>, q: &[Float]) -> (Vec<Float>, Float) {
    let (zeros, one) = (vec![Float::new(q[0].prec()); q.len()], Float::with_val(q[0].prec(), 1));
    system.state_mut().set(q, &zeros);
    system.clear_increments();
    system.kick(&one, Carried::Increments);
    (system.state().p().iter().map(|p| -p.clone()).collect(), system.state().increments().beta.clone())
}

/// The gradient kick is the flow of W = −½B_qᵀM⁻¹B_q, and its rate is the derivative of a kick's in the direction
/// −M⁻¹B_q, by central differences.
fn is_the_derivative_of_kicks(mut system: impl System<Number = Float>, inverse_masses: &[Float]) {
    let q = system.state().q().to_vec();
    let bits = q[0].prec();
    let shift: Float = Float::with_val(bits, 1) >> 100;
    let (gradient, _) = gradient_and_rate(&mut system, &q);
    let v: Vec<_> = gradient.iter().zip(inverse_masses).map(|(g, inverse)| g.clone() * inverse).collect();
    let weight: Float = Float::with_val(bits, 3) / 7;

    let mut w_at = |q: &[Float]| {
        let (gradient, _) = gradient_and_rate(&mut system, q);
        let term = |(g, inverse): (Float, &Float)| g.square() * inverse;
        -gradient.into_iter().zip(inverse_masses).map(term).fold(Float::new(bits), |sum, term| sum + term) / 2
    };
    let expected: Vec<_> = (0..q.len())
        .map(|axis| {
            let [ahead, behind] = [1, -1].map(|sign| {
                let mut moved = q.clone();
                moved[axis] += shift.clone() * sign;
                w_at(&moved)
            });
            -weight.clone() * (ahead - behind) / &shift / 2
        })
        .collect();
    let mut rate_at = |sign: i32| {
        let moved: Vec<_> = q.iter().zip(&v).map(|(q, v)| q.clone() + v.clone() * &shift * sign).collect();
        gradient_and_rate(&mut system, &moved).1
    };
    let expected_rate = -weight.clone() * (rate_at(1) - rate_at(-1)) / &shift / 2;

    let zeros = vec![Float::new(bits); q.len()];
    assert!(system.has_gradient_kicks());
    system.state_mut().set(&q, &zeros);
    system.clear_increments();
    system.gradient_kick(&weight, Carried::Increments);
    let size = expected.iter().map(Real::log10_abs).fold(f64::NEG_INFINITY, f64::max);
    let off = log10_largest_distance(system.state().p(), &expected);
    assert!(off < size - 50.0, "force: 10^{off} of 10^{size}");
    let off = log10_distance(system.state().increments().beta, &expected_rate);
    let size = expected_rate.log10_abs();
    assert!(off < size - 50.0, "β: 10^{off} of 10^{size}");
}

#[test]
fn gradient_kicks_are_the_derivatives_of_kicks() {
    let context = precision(DIGITS);
    let planets = planets::<Float>(&context);
    let orbits = planets.coordinates().orbits();
    let masses = std::iter::once(&orbits.total_mass).chain(orbits.planets.iter().map(|orbit| &orbit.mass));
    let inverse: Vec<_> = masses.flat_map(|mass| vec![mass.clone().recip(); 3]).collect();
    is_the_derivative_of_kicks(planets, &inverse);
    is_the_derivative_of_kicks(with_more::<Float>(&context), &inverse);
    is_the_derivative_of_kicks(oscillators::<Float>(&context), &numbers(&["1/3", "2"], &context));
}

#[test]
fn steps_are_steps_in_both_kinds_of_numbers() {
    fn check<N: Bits + CorrectlyRounded>(context: &N::Context) {
        let steps = Steps::of(twin("omelyan-4mn5f2gv", None), &rational("1/3"), context);
        // positions of size 10, whose phases round-off changes; and numbers below 1
        steps.check("planets", || planets::<N>(context), 20, 3.5);
        steps.check("planets and more", || with_more::<N>(context), 20, 3.5);
        steps.check("oscillators", || oscillators::<N>(context), 20, 2.0);
    }
    check::<f64>(&());
    check::<Float>(&precision(DIGITS));
}

/// max − min of H, and of E_8 and E_16, over 100 steps of Chin's 4A.
fn variations<M>(start: impl Fn() -> M, h: &str) -> [f64; 3]
where
    M: System<Number = Limbs<4>>,
    shadowstep::tables::TableScheme: shadowstep::ValidFor<M::Class>,
{
    let stepper: Stepper<_, Limbs<4>> = stepper("chin-4a", h, &());
    variations::of_energies(&stepper, start, 100, [8, 16])
}

/// With a wrong rate of β it would not converge.
#[test]
fn the_modified_energy_converges() {
    for [energy, k8, k16] in [
        variations(|| planets::<Limbs<4>>(&()), "1/8"),
        variations(|| with_more::<Limbs<4>>(&()), "1/8"),
        variations(|| oscillators::<Limbs<4>>(&()), "1/4"),
    ] {
        println!("H varies by {energy:e}, E_8 by {k8:e}, E_16 by {k16:e}");
        assert!(k8 < energy * 1e-3 && k16 < k8 * 1e-3, "{energy:e}, {k8:e}, {k16:e}");
    }
}

/// Without gradient kicks there is a clear message, not a kick that is missing.
#[test]
fn heliocentric_coordinates_have_none() {
    let bodies = Bodies::new(rational("1"), vec![Rational::from_integer(1.into()); 2]).expect("they are bodies");
    let state = (&[0.0, 0.0, 1.0, 0.0][..], &[0.0, 0.0, 0.0, 1.0][..]);
    let system = WisdomHolman::<f64, shadowstep::systems::wisdom_holman::DemocraticHeliocentric<f64, 2>, 2>::new(
        &bodies,
        state,
        &(),
    );
    assert!(!system.expect("a state of two bodies").has_gradient_kicks());
}
