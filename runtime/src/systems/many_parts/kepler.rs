//! Kepler's problem |p|²/(2m) − κ/|q| as a part: β grows by 3κ ∫dt/r.

use super::part::{FlowState, Part};
use crate::Rational;
use crate::number::Number;
use crate::systems::kepler_drift::KeplerDrift;

/// Of one body and a centre at 0.
pub(super) struct Kepler<N: Number> {
    freedoms: Vec<usize>,
    drift: KeplerDrift<N>,
    mass: N,
    attraction: N,
    /// κ/m and 3κ
    mu: N,
    rate: N,
    q: Vec<N>,
    v: Vec<N>,
    dq: Vec<N>,
    dv: Vec<N>,
}

impl<N: Number> Kepler<N> {
    pub(super) fn new(freedoms: Vec<usize>, mass: &Rational, attraction: &Rational, context: &N::Context) -> Self {
        let number = |value: &Rational| N::from_rational(value, context);
        let zeros = || vec![N::zero(context); freedoms.len()];
        Kepler {
            drift: KeplerDrift::new(context),
            mass: number(mass),
            attraction: number(attraction),
            mu: number(&(attraction / mass)),
            rate: number(&(attraction * Rational::from_integer(3.into()))),
            q: zeros(),
            v: zeros(),
            dq: zeros(),
            dv: zeros(),
            freedoms,
        }
    }
}

impl<N: Number> Part<N> for Kepler<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        let Kepler { freedoms, mass, attraction, q: of_place, v: of_motion, .. } = self;
        let ([square, ..], [other, ..]) = (&mut of_place[..], &mut of_motion[..]) else { return };
        square.assign_zero();
        freedoms.iter().for_each(|i| square.add_product(&p[*i], &p[*i]));
        square.divide(mass);
        square.divide_integer(2);
        energy.add(square);
        square.assign_zero();
        freedoms.iter().for_each(|i| square.add_product(&q[*i], &q[*i]));
        other.assign_sqrt(square);
        square.assign_quotient(attraction, other);
        energy.subtract(square);
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, _: bool) {
        let Kepler { freedoms, drift, mass, mu, rate, q, v, dq, dv, .. } = self;
        for (k, &i) in freedoms.iter().enumerate() {
            q[k].assign(&state.q()[i]);
            v[k].assign_quotient(&state.p()[i], mass);
            dq[k].assign_zero();
            dv[k].assign_zero();
        }
        let s = drift.advance_augmented(mu, time, q, v, dq, dv);
        state.add_to_beta(rate, s);
        let count = state.q().len();
        for (k, &i) in freedoms.iter().enumerate() {
            state.add(i, &dq[k]);
            state.add_product(i + count, mass, &dv[k]);
        }
    }
}
