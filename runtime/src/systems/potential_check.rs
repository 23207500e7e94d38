//! Whether the gradient and the rate of a potential belong to its energy, and its Hessian–vector product to both.

mod checked;
mod comparison;
mod derivative;
mod hessian;

pub use self::comparison::{Agreement, Comparison};
pub use self::hessian::HessianCheck;

use std::fmt;

use self::checked::Checked;
use self::comparison::add_absolute_product;
use self::derivative::{Derivative, directional_derivative};
use crate::number::Real;
use crate::systems::motion::MotionError;
use crate::systems::potential::Potential;

/// Compares the gradient and the rate of a potential with its energy at states of your choice.
///
/// - The gradient U_q with the derivatives of the energy, by differences that are extrapolated to 0 and have an
///   estimated error: along three directions in which all coordinates change; where one differs, a coordinate is found
///   by bisection.
/// - The gradient that comes with the rate with the gradient alone.
/// - The rate with qᵀU_q − 2U.
/// - Where there is a Hessian–vector product U_qq v, it and its rate with the derivatives of the gradient and of the
///   rate along v, in two directions.
///
/// A comparison costs some 120 evaluations of the energy at a state, whatever the dimension, and 80 log₂ d more to find
/// a coordinate. States in which forces act, and no symmetry makes them vanish, test most. Where forces are not smooth,
/// as at a cutoff, the differences have large errors and the comparison is undecided.
///
/// ```
/// use shadowstep::systems::potential::from_fn;
/// use shadowstep::systems::potential_check::{Agreement, check_potential};
///
/// // a force that is 1 % too large in the second coordinate
/// let mut wrong = from_fn(2, |q, gradient| {
///     gradient[0] = q[0] * q[0];
///     gradient[1] = 1.01 * q[1];
///     q[0].powi(3) / 3.0 + q[1] * q[1] / 2.0
/// });
/// let check = check_potential(&mut wrong, &[[0.3, -1.0], [0.7, 2.0]])?;
/// assert_eq!(check.gradient.agreement, Agreement::Differs);
/// assert_eq!(check.gradient.coordinate, Some(1));
/// println!("{check}");
/// # Ok::<(), shadowstep::MotionError>(())
/// ```
///
/// # Errors
/// A state whose dimension differs from the potential's, or no state.
pub fn check_potential<N, P, Q>(potential: &mut P, states: &[Q]) -> Result<PotentialCheck<N>, MotionError>
where
    N: Real,
    P: Potential<N> + ?Sized,
    Q: AsRef<[N]>,
{
    let dimension = potential.dimension();
    let lengths = || states.iter().map(|q| q.as_ref().len());
    if let Some(coordinates) = lengths().find(|&coordinates| coordinates != dimension) {
        return Err(MotionError::Potential { coordinates, dimension });
    }
    let mut all = states.iter().enumerate().map(|(state, q)| Checked::new(potential, q.as_ref(), state).check());
    let mut worst = all.next().filter(|_| dimension > 0).ok_or(MotionError::NoCoordinates)?;
    for check in all {
        worst.gradient.keep_worse(check.gradient);
        worst.gradient_with_rate.keep_worse(check.gradient_with_rate);
        worst.rate.keep_worse(check.rate);
        if let (Some(worst), Some(check)) = (&mut worst.hessian, check.hessian) {
            worst.keep_worse(check);
        }
    }
    Ok(worst)
}

/// What [`check_potential`] found: of each comparison the state where it is worst.
#[derive(Clone, Debug)]
pub struct PotentialCheck<N> {
    /// The gradient and the derivatives of the energy.
    pub gradient: Comparison<N>,
    /// The gradient that comes with the rate, and the gradient alone.
    pub gradient_with_rate: Comparison<N>,
    /// The rate and qᵀU_q − 2U.
    pub rate: Comparison<N>,
    /// The Hessian–vector product, where the potential has one.
    pub hessian: Option<HessianCheck<N>>,
}

impl<N: Real> PotentialCheck<N> {
    /// Whether everything agrees.
    pub fn agrees(&self) -> bool {
        let all = [&self.gradient, &self.gradient_with_rate, &self.rate];
        let of_hessian = self.hessian.iter().flat_map(HessianCheck::all);
        all.into_iter().chain(of_hessian).all(|comparison| comparison.agreement == Agreement::Agrees)
    }
}

impl<N: Real, P: Potential<N> + ?Sized> Checked<'_, N, P> {
    fn check(&mut self) -> PotentialCheck<N> {
        let zero = N::zero(&self.q[0].context());
        let (mut gradient, mut with_rate) = (vec![zero.clone(); self.q.len()], vec![zero.clone(); self.q.len()]);
        let (mut rate, mut energy) = (zero.clone(), zero);
        self.potential.update(self.q);
        self.potential.energy(self.q, &mut energy, &mut self.scratch);
        self.potential.gradient(self.q, &mut gradient, &mut self.scratch);
        self.potential.gradient_and_rate(self.q, &mut with_rate, &mut rate, &mut self.scratch);
        PotentialCheck {
            gradient: self.check_gradient(&gradient),
            gradient_with_rate: self.check_alike(&with_rate, &gradient),
            rate: self.check_rate(rate, &energy, &gradient),
            hessian: self.check_hessian(),
        }
    }

    fn check_rate(&self, rate: N, energy: &N, gradient: &[N]) -> Comparison<N> {
        let mut expected = energy.clone();
        expected.multiply_integer(-2);
        let mut size = expected.clone();
        size.make_absolute();
        for (q, gradient) in self.q.iter().zip(gradient) {
            expected.add_product(q, gradient);
            add_absolute_product(&mut size, q, gradient);
        }
        let uncertainty = self.rounding(&size, self.q.len());
        Comparison::new(self.state, None, (rate, expected), uncertainty, &size)
    }

    fn check_gradient(&mut self, gradient: &[N]) -> Comparison<N> {
        let mut worst: Option<Comparison<N>> = None;
        for seed in 1..=3 {
            let direction = self.direction(seed);
            let along = self.compare(&direction, gradient);
            if along.agreement == Agreement::Differs {
                return self.find_coordinate(direction, gradient);
            }
            match &mut worst {
                Some(worst) => worst.keep_worse(along),
                None => worst = Some(along),
            }
        }
        worst.expect("there are three directions")
    }

    /// A half of the direction in which the gradient differs more, and again.
    fn find_coordinate(&mut self, mut direction: Vec<N>, gradient: &[N]) -> Comparison<N> {
        let mut range = 0..direction.len();
        loop {
            if range.len() == 1 {
                return Comparison {
                    coordinate: Some(range.start),
                    ..self.compare_coordinate(&direction, range.start, gradient)
                };
            }
            let middle = range.start + range.len() / 2;
            let halves = [range.start..middle, middle..range.end].map(|half| {
                let mut part = direction.clone();
                part.iter_mut().enumerate().filter(|(i, _)| !half.contains(i)).for_each(|(_, x)| x.assign_zero());
                let compared = self.compare(&part, gradient);
                let mut off = compared.found;
                off.subtract(&compared.expected);
                (half, part, off.log10_abs())
            });
            let [first, second] = halves;
            (range, direction) = if second.2 > first.2 { (second.0, second.1) } else { (first.0, first.1) };
        }
    }

    /// U_q in one coordinate, in which the direction is not 0.
    fn compare_coordinate(&mut self, direction: &[N], coordinate: usize, gradient: &[N]) -> Comparison<N> {
        let mut compared = self.compare(direction, gradient);
        for value in [&mut compared.found, &mut compared.expected, &mut compared.uncertainty] {
            value.divide(&direction[coordinate]);
        }
        compared.uncertainty.make_absolute();
        compared
    }

    /// vᵀU_q and the derivative of U along v.
    fn compare(&mut self, direction: &[N], gradient: &[N]) -> Comparison<N> {
        let q = self.q;
        let Checked { potential, scratch, .. } = self;
        let Derivative { value, error } = directional_derivative(
            &mut |q, energy| {
                potential.update(q);
                potential.energy(q, energy, scratch);
            },
            q,
            direction,
        );
        let mut found = N::zero(&value.context());
        let mut size = found.clone();
        for (v, gradient) in direction.iter().zip(gradient) {
            found.add_product(v, gradient);
            add_absolute_product(&mut size, v, gradient);
        }
        let mut uncertainty = self.rounding(&size, q.len());
        uncertainty.add(&error);
        Comparison::new(self.state, None, (found, value), uncertainty, &size)
    }
}

impl<N: Real> fmt::Display for PotentialCheck<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let PotentialCheck { gradient, gradient_with_rate, rate, hessian } = self;
        writeln!(f, "the gradient {}", gradient.sentence("the derivative of the energy"))?;
        writeln!(f, "the gradient beside the rate {}", gradient_with_rate.sentence("the gradient alone"))?;
        write!(f, "the rate {}", rate.sentence("qᵀU_q − 2U"))?;
        let Some(HessianCheck { product, product_with_rate, rate }) = hessian else { return Ok(()) };
        let product = product.sentence("the derivative of the gradient");
        writeln!(f, "\nthe Hessian–vector product {product}")?;
        writeln!(f, "the product beside its rate {}", product_with_rate.sentence("the product alone"))?;
        write!(f, "its rate {}", rate.sentence("the derivative of the rate"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::systems::potential::{HessianProduct, from_fn};
    use crate::systems::problems::{HenonHeiles, Kepler};

    fn check<P: Potential<f64>>(mut potential: P, q: &[f64]) -> PotentialCheck<f64> {
        check_potential(&mut potential, &[q]).unwrap()
    }

    #[test]
    fn right_potentials_agree() {
        for q in [[0.4, 0.1], [1e-3, 2e-3], [50.0, -120.0]] {
            assert!(check(Kepler, &q).agrees(), "{}", check(Kepler, &q));
        }
        assert!(check(HenonHeiles, &[0.1, -0.3]).agrees());
        // no force acts at the minimum, so that nothing is compared
        assert_eq!(check(HenonHeiles, &[0.0, 0.0]).gradient.agreement, Agreement::Undecided);
    }

    #[cfg(feature = "mpfr")]
    #[test]
    fn right_potentials_agree_in_many_digits() {
        use crate::number::{Float, Precision};
        let precision = Precision::digits(60).unwrap();
        let q = [0.4, 0.1].map(|q| Float::with_val(precision.in_bits(), q));
        let check = check_potential(&mut Kepler, &[q]).unwrap();
        assert!(check.agrees() && check.gradient.uncertainty.log10_abs() < -25.0, "{check}");
    }

    /// U = Σ q⁴/4, where the force on one coordinate is wrong by a part.
    fn one_wrong(coordinate: usize, part: f64) -> impl Potential<f64> {
        from_fn(30, move |q, gradient| {
            gradient.iter_mut().zip(q).for_each(|(gradient, q)| *gradient = q.powi(3));
            gradient[coordinate] *= 1.0 + part;
            q.iter().map(|q| q.powi(4) / 4.0).sum()
        })
    }

    #[test]
    fn the_coordinate_of_a_wrong_gradient_is_found_with_its_size() {
        let q: Vec<f64> = (0..30).map(|i| 1.0 + (f64::from(i)).sin() / 2.0).collect();
        for coordinate in [0, 7, 17, 29] {
            for part in [0.01, -1e-6] {
                let Comparison { agreement, coordinate: found, found: value, expected, .. } =
                    check(one_wrong(coordinate, part), &q).gradient;
                assert_eq!((agreement, found), (Agreement::Differs, Some(coordinate)));
                assert!((value / expected - 1.0 - part).abs() < 1e-3 * part.abs(), "{value} {expected}");
            }
            assert!(check(one_wrong(coordinate, 0.0), &q).agrees());
        }
    }

    #[test]
    fn the_state_where_it_is_worst_is_reported() {
        let mut potential = from_fn(1, |q, gradient| {
            gradient[0] = if q[0] > 1.0 { 2.0 * q[0] } else { q[0] };
            q[0] * q[0] / 2.0
        });
        let check = check_potential(&mut potential, &[[0.5], [3.0], [0.7]]).unwrap();
        assert_eq!((check.gradient.agreement, check.gradient.state), (Agreement::Differs, 1));
        let text = check.to_string();
        assert!(text.contains("differs: in coordinate 0 of state 1") && text.contains("+1.00e2 %"), "{text}");
    }

    #[test]
    fn dimensions_and_no_states_are_errors() {
        assert!(check_potential(&mut Kepler, &[[1.0, 0.0, 0.0]]).is_err());
        assert!(check_potential::<f64, _, [f64; 2]>(&mut Kepler, &[]).is_err());
    }

    /// A rate from images: the pair's part is computed from the nearest image, not from the coordinates.
    #[test]
    fn a_virial_of_images_is_not_the_rate() {
        #[derive(Clone, Copy)]
        struct Ring {
            virial: bool,
        }
        impl Ring {
            /// U = d⁴/4 of the distance by the nearest image in a box of side 2.
            fn distance(q: &[f64]) -> f64 {
                let d = q[1] - q[0];
                d - 2.0 * (d / 2.0).round()
            }
        }
        impl Potential<f64> for Ring {
            fn dimension(&self) -> usize {
                2
            }
            fn energy(&self, q: &[f64], energy: &mut f64, _: &mut [f64]) {
                *energy = Ring::distance(q).powi(4) / 4.0;
            }
            fn gradient(&self, q: &[f64], gradient: &mut [f64], _: &mut [f64]) {
                let slope = Ring::distance(q).powi(3);
                gradient.copy_from_slice(&[-slope, slope]);
            }
            fn gradient_and_rate(&self, q: &[f64], gradient: &mut [f64], rate: &mut f64, scratch: &mut [f64]) {
                self.gradient(q, gradient, scratch);
                let d = if self.virial { Ring::distance(q) } else { q[1] - q[0] };
                *rate = d * Ring::distance(q).powi(3) - Ring::distance(q).powi(4) / 2.0;
            }
        }
        let near = [0.1, 0.6];
        let images = [0.1, 1.7];
        assert!(check(Ring { virial: true }, &near).agrees() && check(Ring { virial: false }, &images).agrees());
        let wrong = check(Ring { virial: true }, &images);
        assert_eq!([wrong.gradient.agreement, wrong.rate.agreement], [Agreement::Agrees, Agreement::Differs]);
    }

    /// U = x³y, with factors of its Hessian–vector product and of the rate.
    struct Wrong {
        product: f64,
        rate: f64,
    }

    impl Potential<f64> for Wrong {
        fn dimension(&self) -> usize {
            2
        }
        fn energy(&self, q: &[f64], energy: &mut f64, _: &mut [f64]) {
            *energy = q[0].powi(3) * q[1];
        }
        fn gradient(&self, q: &[f64], gradient: &mut [f64], _: &mut [f64]) {
            gradient.copy_from_slice(&[3.0 * q[0].powi(2) * q[1], q[0].powi(3)]);
        }
        fn hessian(&self) -> Option<&dyn HessianProduct<f64>> {
            Some(self)
        }
    }

    impl HessianProduct<f64> for Wrong {
        fn hessian_product(&self, q: &[f64], v: &[f64], product: &mut [f64], _: &mut [f64]) {
            let mixed = 3.0 * q[0] * q[0];
            product[0] = 6.0 * q[0] * q[1] * v[0] + self.product * mixed * v[1];
            product[1] = mixed * v[0];
        }
        fn hessian_product_and_rate(&self, q: &[f64], v: &[f64], product: &mut [f64], rate: &mut f64, _: &mut [f64]) {
            self.hessian_product(q, v, product, &mut []);
            *rate = self.rate * 2.0 * (3.0 * q[0] * q[0] * q[1] * v[0] + q[0].powi(3) * v[1]);
        }
    }

    fn agreements(product: f64, rate: f64) -> [Agreement; 2] {
        let check = check_potential(&mut Wrong { product, rate }, &[[0.7, -1.1]]).unwrap();
        let hessian = check.hessian.unwrap();
        [hessian.product.agreement, hessian.rate.agreement]
    }

    #[test]
    fn a_wrong_product_or_rate_is_found() {
        use Agreement::{Agrees, Differs};
        assert_eq!(agreements(1.0, 1.0), [Agrees, Agrees]);
        // an entry that is wrong on one side of the diagonal only
        assert_eq!(agreements(1.001, 1.0), [Differs, Agrees]);
        assert_eq!(agreements(1.0, 1.001), [Agrees, Differs]);
        let check = check_potential(&mut Wrong { product: 2.0, rate: 1.0 }, &[[0.7, -1.1]]).unwrap();
        assert!(!check.agrees() && check.to_string().contains("the Hessian–vector product differs"), "{check}");
    }

    #[test]
    fn derived_products_agree_and_others_are_not_compared() {
        let kepler = check_potential(&mut Kepler, &[[0.4, 0.1]]).unwrap();
        assert!(kepler.agrees() && kepler.hessian.is_some(), "{kepler}");
        assert!(check_potential(&mut HenonHeiles, &[[0.1, -0.3]]).unwrap().agrees());
        let mut spring = from_fn(1, |q, gradient| {
            gradient[0] = q[0];
            q[0] * q[0] / 2.0
        });
        assert!(check_potential(&mut spring, &[[0.4]]).unwrap().hessian.is_none());
    }
}
