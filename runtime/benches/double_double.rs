//! What a step costs in double-double beside `f64`, and beside MPFR with the same number of bits.

mod timing;

use std::hint::black_box;

use shadowstep::number::{DoubleDouble, Float, Precision};
use shadowstep::problems::{HenonHeiles, Kepler};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{
    Motion, Number, Potential, Scheme, Stepper, UnitMasses, ValidFor, exact, potential, splitting_scheme,
};

use timing::{Contestant, compare};

potential! {
    /// A force that is a sine.
    struct Pendulum;
    U(q) = -cos(q)
}

#[splitting_scheme("stormer-verlet.toml")]
#[derive(Clone, Copy)]
struct StormerVerlet;

#[splitting_scheme("yoshida4.toml")]
#[derive(Clone, Copy)]
struct Yoshida4;

/// Initial q and p.
type Start<const D: usize> = ([&'static str; D], [&'static str; D]);

fn steps<N: Number + 'static, const D: usize>(
    name: &'static str,
    scheme: impl Scheme + ValidFor<Quadratic> + 'static,
    potential: impl Potential<N> + 'static,
    (q, p): Start<D>,
    context: &N::Context,
) -> Contestant<'static> {
    let numbers = |texts: [&str; D]| texts.map(|text| N::from_rational(&exact(text).expect("a number"), context));
    let mut motion = Motion::new(potential, UnitMasses, numbers(q), numbers(p)).expect("the dimensions agree");
    let stepper = Stepper::with_context(scheme, "1/100", context).expect("h is not 0");
    let run = move |repetitions| {
        for _ in 0..repetitions {
            stepper.step(&mut motion);
        }
        black_box(motion.q());
    };
    (name, Box::new(run))
}

fn number_types<P, const D: usize>(
    title: &str,
    scheme: impl Scheme + ValidFor<Quadratic> + Copy + 'static,
    potential: fn() -> P,
    start: Start<D>,
) where
    P: Potential<f64> + Potential<DoubleDouble> + Potential<Float> + 'static,
{
    let bits = Precision::bits(106).expect("MPFR has them");
    let contestants = vec![
        steps::<f64, D>("f64", scheme, potential(), start, &()),
        steps::<DoubleDouble, D>("double-double", scheme, potential(), start, &()),
        steps::<Float, D>("MPFR, 106 bits", scheme, potential(), start, &bits),
    ];
    compare(title, contestants, 100_000);
}

fn main() {
    let kepler = (["0.4", "0"], ["0", "2"]);
    let henon_heiles = (["0", "0"], ["0.1", "0"]);
    number_types("Kepler, Störmer–Verlet", StormerVerlet, || Kepler, kepler);
    number_types("Kepler, Yoshida 4", Yoshida4, || Kepler, kepler);
    number_types("Hénon–Heiles, Störmer–Verlet", StormerVerlet, || HenonHeiles, henon_heiles);
    number_types("Hénon–Heiles, Yoshida 4", Yoshida4, || HenonHeiles, henon_heiles);
    number_types("Pendulum, Störmer–Verlet", StormerVerlet, || Pendulum, (["0"], ["1.9"]));
}
