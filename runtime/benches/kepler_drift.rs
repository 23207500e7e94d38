//! What a Kepler drift costs, for orbits of planets and others, in several number types.

mod timing;

use std::f64::consts::TAU;
use std::hint::black_box;

use shadowstep::Number;
use shadowstep::number::{DoubleDouble, Fused, Lanes, Limbs};
use shadowstep::systems::kepler_drift::KeplerDrift;

use timing::{Contestant, compare};

/// Drifts along an orbit of eccentricity e, inclined, in steps of a part of its period.
fn drifts<N: Number + 'static>(
    name: &'static str,
    (e, parts): (f64, f64),
    context: &N::Context,
    number: impl Fn(f64) -> N,
) -> Contestant<'static> {
    let speed = ((1.0 + e) / (1.0 - e)).sqrt();
    let mut q = [1.0 - e, 0.0, 0.0].map(&number);
    let mut v = [0.0, 0.8 * speed, 0.6 * speed].map(&number);
    let (mu, t) = (number(1.0), number(TAU / parts));
    let mut kepler = KeplerDrift::new(context);
    let run = move |repetitions| {
        for _ in 0..repetitions {
            kepler.advance(&mu, &t, &mut q, &mut v);
        }
        black_box(&q);
    };
    (name, Box::new(run))
}

fn main() {
    let double = |name, orbit| drifts(name, orbit, &(), |x: f64| x);
    compare(
        "A drift in `f64`",
        vec![
            double("e = 0.05, 1/20 of the period", (0.05, 20.0)),
            double("e = 0.05, 1/100", (0.05, 100.0)),
            double("e = 0.2, 1/20", (0.2, 20.0)),
            double("e = 0.6, 1/100", (0.6, 100.0)),
            double("e = 0.9, 1/20", (0.9, 20.0)),
            double("e = 0.99, 1/20", (0.99, 20.0)),
            double("e = 0.05, 1/2.1", (0.05, 2.1)),
            double("e = 0.05, 3.3 periods", (0.05, 1.0 / 3.3)),
        ],
        20_000,
    );
    let planet = (0.05, 20.0);
    compare(
        "A drift of a planet (e = 0.05, 1/20 of the period); of lanes, all of them together",
        vec![
            drifts("`f64`", planet, &(), |x: f64| x),
            drifts("`Fused`", planet, &(), Fused),
            drifts("`Lanes<4>`", planet, &(), Lanes::<4>::all),
            drifts("`Lanes<8>`", planet, &(), Lanes::<8>::all),
            drifts("`Lanes<16>`", planet, &(), Lanes::<16>::all),
            drifts("`DoubleDouble`", planet, &(), DoubleDouble::from),
            drifts("`Limbs<2>`", planet, &(), Limbs::<2>::from),
            drifts("`Limbs<7>`", planet, &(), Limbs::<7>::from),
        ],
        1000,
    );
}
