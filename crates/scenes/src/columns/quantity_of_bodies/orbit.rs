//! The osculating Kepler orbit of a body: position and velocity relative to a centre → elements.
//!
//! With h = r × v, e = (v × h)/μ − r/|r|, 1/a = 2/r − v²/μ: a direction of the ascending node n = (−h_y, h_x, 0)/|…|,
//! or (1, 0, 0) where the orbit is in the plane of the reference, m = h × n/|h|, so that Ω = ∠(h_x, −h_y), ω = ∠(e·m,
//! e·n), and M from E − e sin E or e sinh E − E. This is the inverse of `read/elements.rs`; C. D. Murray & S. F.
//! Dermott, *Solar System Dynamics*, section 2.8.

use std::mem::swap;

use shadowstep::{Rational, Real};

use crate::document::quantity::Element;

/// A position and a velocity relative to the centre.
pub(super) struct Orbit<N> {
    pub(super) position: [N; 3],
    pub(super) velocity: [N; 3],
    /// μ
    pub(super) parameter: N,
}

impl<N: Real> Orbit<N> {
    /// An element; angles in degrees, from 0 to 360, but the mean anomaly of a hyperbola. Not finite where there is
    /// none, as the anomaly of a parabola.
    pub(super) fn element(&self, element: Element) -> N {
        let momentum = cross(&self.position, &self.velocity);
        match element {
            Element::SemiMajorAxis => self.semi_major_axis(),
            Element::Eccentricity => norm(&self.eccentricity(&momentum)),
            Element::Inclination => {
                let [x, y, z] = &momentum;
                degrees(&angle(&norm(&[x.clone(), y.clone(), self.zero()]), z))
            }
            Element::Node => positive(degrees(&self.node(&momentum))),
            Element::Pericentre => positive(degrees(&self.pericentre(&momentum))),
            Element::MeanAnomaly => self.mean_anomaly_in_degrees(&momentum),
            Element::MeanLongitude => {
                let mut sum = degrees(&self.node(&momentum));
                sum.add(&degrees(&self.pericentre(&momentum)));
                sum.add(&self.mean_anomaly_in_degrees(&momentum));
                positive(sum)
            }
        }
    }

    fn zero(&self) -> N {
        N::zero(&self.parameter.context())
    }

    fn one(&self) -> N {
        number(1, &self.parameter)
    }

    /// 1/(2/r − v²/μ)
    fn semi_major_axis(&self) -> N {
        let mut inverse = quotient(&number(2, &self.parameter), &norm(&self.position));
        inverse.subtract(&quotient(&dot(&self.velocity, &self.velocity), &self.parameter));
        quotient(&self.one(), &inverse)
    }

    /// (v × h)/μ − r/|r|
    fn eccentricity(&self, momentum: &[N; 3]) -> [N; 3] {
        let distance = norm(&self.position);
        let mut vector = cross(&self.velocity, momentum);
        for (component, position) in vector.iter_mut().zip(&self.position) {
            component.divide(&self.parameter);
            component.subtract(&quotient(position, &distance));
        }
        vector
    }

    fn node(&self, [x, y, _]: &[N; 3]) -> N {
        let mut minus = y.clone();
        minus.negate();
        angle(x, &minus)
    }

    fn pericentre(&self, momentum: &[N; 3]) -> N {
        let eccentricity = self.eccentricity(momentum);
        let (mut sin, mut cos) = (self.zero(), self.zero());
        N::assign_sin_cos(&mut sin, &mut cos, &self.node(momentum));
        let node = [cos, sin, self.zero()];
        let length = norm(momentum);
        let across = cross(&momentum.each_ref().map(|component| quotient(component, &length)), &node);
        angle(&dot(&eccentricity, &across), &dot(&eccentricity, &node))
    }

    fn mean_anomaly_in_degrees(&self, momentum: &[N; 3]) -> N {
        let a = self.semi_major_axis();
        match a > self.zero() {
            true => positive(degrees(&self.mean_anomaly(&a, momentum))),
            false => degrees(&self.mean_anomaly(&a, momentum)),
        }
    }

    /// From e cos E = 1 − r/a and e sin E = r·v/√(μa), or the same with cosh, sinh and −a.
    fn mean_anomaly(&self, a: &N, momentum: &[N; 3]) -> N {
        let mut size = a.clone();
        size.make_absolute();
        size.multiply(&self.parameter);
        let mut root = self.zero();
        root.assign_sqrt(&size);
        let sin = quotient(&dot(&self.position, &self.velocity), &root);
        if *a > self.zero() {
            let mut cos = self.one();
            cos.subtract(&quotient(&norm(&self.position), a));
            let mut mean = angle(&sin, &cos);
            mean.subtract(&sin);
            return mean;
        }
        // F = ar sinh(x) = sgn(x) ln(|x| + √(x² + 1))
        let mut x = quotient(&sin, &norm(&self.eccentricity(momentum)));
        let is_negative = x < self.zero();
        x.make_absolute();
        let mut square = self.one();
        square.add_product(&x, &x);
        root.assign_sqrt(&square);
        x.add(&root);
        let mut mean = sin;
        root.assign_log(&x);
        if is_negative {
            root.negate();
        }
        mean.subtract(&root);
        mean
    }
}

fn number<N: Real>(value: i64, like: &N) -> N {
    N::from_rational(&Rational::from_integer(value.into()), &like.context())
}

fn quotient<N: Real>(a: &N, b: &N) -> N {
    let mut quotient = a.clone();
    quotient.divide(b);
    quotient
}

fn dot<N: Real>(a: &[N; 3], b: &[N; 3]) -> N {
    let mut sum = N::zero(&a[0].context());
    a.iter().zip(b).for_each(|(a, b)| sum.add_product(a, b));
    sum
}

fn norm<N: Real>(a: &[N; 3]) -> N {
    let mut norm = a[0].clone();
    norm.assign_sqrt(&dot(a, a));
    norm
}

fn cross<N: Real>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let mut component = N::zero(&a[0].context());
        component.add_product(&a[i], &b[j]);
        component.subtract_product(&a[j], &b[i]);
        component
    })
}

/// The angle of a direction (x, y) from the x axis, from −π to π; 0 without a direction.
fn angle<N: Real>(y: &N, x: &N) -> N {
    let zero = N::zero(&x.context());
    let (mut y, mut x) = (y.clone(), x.clone());
    let (is_below, is_left) = (y < zero, x < zero);
    y.make_absolute();
    x.make_absolute();
    let is_steep = y > x;
    if is_steep {
        swap(&mut x, &mut y);
    }
    let mut angle = zero.clone();
    if x > zero {
        angle.assign_atan(&quotient(&y, &x));
    }
    // of the first octant → of the first quadrant → of the upper half
    let mut eighth = zero;
    eighth.assign_atan(&number(1, &x));
    if is_steep {
        angle.negate();
        eighth.multiply_integer(2);
        angle.add(&eighth);
        eighth.divide_integer(2);
    }
    if is_left {
        angle.negate();
        eighth.multiply_integer(4);
        angle.add(&eighth);
    }
    if is_below {
        angle.negate();
    }
    angle
}

/// 45 x/arctan 1
fn degrees<N: Real>(radians: &N) -> N {
    let mut eighth = radians.clone();
    eighth.assign_atan(&number(1, radians));
    let mut degrees = radians.clone();
    degrees.multiply_integer(45);
    degrees.divide(&eighth);
    degrees
}

/// An angle between −360 and 720 degrees with a turn more or less, so that it is from 0 to 360.
fn positive<N: Real>(mut degrees: N) -> N {
    let turn = number(360, &degrees);
    if degrees < N::zero(&degrees.context()) {
        degrees.add(&turn);
    }
    if degrees >= turn {
        degrees.subtract(&turn);
    }
    degrees
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions in all octants and on the axes, beside the function of the machine.
    #[test]
    fn angles_are_those_of_all_directions() {
        let values = [-3.0, -1.0, -1e-9, 0.0, 1e-9, 1.0, 2.5];
        for (y, x) in values.into_iter().flat_map(|y| values.map(|x| (y, x))) {
            let (found, expected) = (angle::<f64>(&y, &x), y.atan2(x));
            // 4 roundings of numbers up to π
            assert!((found - expected).abs() <= 1e-15, "{y}, {x}: {found} for {expected}");
        }
    }
}
