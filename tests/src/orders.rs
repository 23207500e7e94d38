//! The orders that steps show, beside those that are proved.

use std::collections::{BTreeMap, BTreeSet};

use rug::Float;
use rug::ops::Pow;
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{Number, Rational, Real, System};
use shadowstep_schemes::{Map, MapKind};

use crate::reference::Separable;
use crate::shipped::{Shipped, all};
use crate::{log10_largest_distance, precision, rational};

/// What steps of 2^−k and of 2^(1−k) of a scheme show.
#[derive(Debug)]
pub struct Order {
    /// The scheme.
    pub name: String,
    /// Whether its table claims near-integrable orders.
    pub near_integrable: bool,
    /// The steps are 2^−k and 2^(1−k).
    pub k: u32,
    /// The order that is proved.
    pub proved: f64,
    /// The order that the two steps show.
    pub measured: f64,
}

impl Order {
    /// How far the order measured is from the one proved.
    pub fn off(&self) -> f64 {
        (self.measured - self.proved).abs()
    }
}

/// One step from a start is compared with the flow of the system, which owes nothing to any table. Its error is
/// C h^{p+1} (1 + c h + …), so halving h shows p + 1 up to about c h/ln 2.
pub struct Measured<'a, M: System> {
    /// The system at its start.
    pub start: &'a dyn Fn() -> M,
    /// q and p as the flow has them.
    pub coordinates: fn(&mut M) -> Vec<M::Number>,
    /// The flow from that start over a time.
    pub flow: &'a dyn Fn(&Float) -> Vec<Float>,
    /// Digits of the computation.
    pub digits: u32,
    /// The smallest step is 2 to the minus this.
    pub halvings: u32,
}

impl<C: 'static, M: System<Number = Float, Class = C>> Measured<'_, M> {
    /// The orders of all schemes of a list, such as [`all`].
    pub fn orders(
        &self,
        schemes: impl Fn(&Rational, &<Float as Number>::Context) -> Vec<Shipped<Float, C>>,
        proved: impl Fn(&Shipped<Float, C>) -> u32,
    ) -> Vec<Order> {
        let context = precision(self.digits);
        let order = |scheme: Shipped<Float, C>| {
            let proved = proved(&scheme);
            let near_integrable = scheme.twin.proved().scheme.table.near_integrable.is_some();
            let k = scheme.halvings(proved, self.digits).min(self.halvings);
            Order { name: scheme.name, near_integrable, k, proved: f64::from(proved), measured: 0.0 }
        };
        let mut orders: Vec<_> = schemes(&rational("1"), &context).into_iter().map(order).collect();
        assert!(!orders.is_empty(), "no scheme is measured");
        let needed: BTreeSet<u32> = orders.iter().flat_map(|order| [order.k - 1, order.k]).collect();
        let errors = needed.into_iter().map(|k| {
            let h = rational(&format!("1/{}", 1_u64 << k));
            let exact = (self.flow)(&Float::from_rational(&h, &context));
            let error = |scheme: Shipped<Float, C>| {
                let mut system = (self.start)();
                scheme.generated.step(&mut system);
                log10_largest_distance(&(self.coordinates)(&mut system), &exact) / std::f64::consts::LOG10_2
            };
            (k, schemes(&h, &context).into_iter().map(error).collect::<Vec<_>>())
        });
        let errors: BTreeMap<u32, Vec<f64>> = errors.collect();
        for (index, order) in orders.iter_mut().enumerate() {
            order.measured = errors[&(order.k - 1)][index] - errors[&order.k][index] - 1.0;
            println!("{order:?}");
        }
        orders
    }
}

impl<M: System<Number = Float, Class = Quadratic>> Measured<'_, M> {
    /// The orders of all shipped schemes are those proved for quadratic T, but for `tolerance`.
    ///
    /// # Panics
    /// If one is not.
    pub fn check_all(&self, tolerance: f64) {
        for order in self.orders(all, |scheme| scheme.summary.order_quadratic) {
            assert!(order.off() < tolerance, "{order:?}");
        }
    }
}

/// log₂ of the largest error of one step of size 2^−k of these maps, for H = p²/2 + εU(q), U = −cos q, with ε =
/// `epsilon` times `times`; with a sum over more than one of the `(factor, times)`, of the errors' sum: differences in
/// ε, of which higher powers are left.
pub fn near_integrable_error(maps: &[Map], k: u32, epsilon: &str, sum: &[(i32, i32)]) -> f64 {
    // for ε³h⁵ with ε = 1e-40
    let context = precision(220);
    let bits = context.in_bits();
    let (h, start) = (Float::with_val(bits, 1) >> k, [0.7, 1.1].map(|x| Float::with_val(bits, x)));
    let error = |times: i32| {
        let epsilon = Float::with_val(bits, Float::parse(epsilon).expect("a number")) * times;
        let [mut q, mut p] = start.clone();
        for map in maps {
            let weight =
                Float::from_rational(&map.weight, &context) * Float::with_val(bits, (&h).pow(map.kind.power()));
            match map.kind {
                MapKind::Kick => p -= q.clone().sin() * weight * &epsilon,
                MapKind::Drift => q += weight * &p,
                // 2 U″U′
                MapKind::GradientKick => p += Float::with_val(bits, &q * 2).sin() * weight * &epsilon * &epsilon,
            }
        }
        let system = Separable { velocity: &|p| p.to_vec(), gradient: &|q| vec![q[0].clone().sin() * &epsilon] };
        let exact = system.flow(&start, &h, 20);
        [q - &exact[0], p - &exact[1]]
    };
    let mut total = [Float::new(bits), Float::new(bits)];
    for &(factor, times) in sum {
        total.iter_mut().zip(error(times)).for_each(|(total, error)| *total += error * factor);
    }
    total.iter().map(Real::log10_abs).fold(f64::NEG_INFINITY, f64::max) / std::f64::consts::LOG10_2
}
