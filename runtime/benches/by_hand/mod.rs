//! Gradients as a careful person writes them, for f64 and again for MPFR's numbers.

use rug::{Assign, Float};
use shadowstep::Potential;

pub(crate) const BODIES: usize = 6;

/// By hand, for one type of numbers.
pub(crate) struct ByHand<P>(pub(crate) P);

pub(crate) struct KeplerOrbit;
pub(crate) struct HenonHeilesStar;
pub(crate) struct PendulumBob;
pub(crate) struct Planets<N> {
    pub(crate) g: N,
    pub(crate) m: Vec<N>,
}

/// The methods of a potential by hand; the energy is not timed.
macro_rules! by_hand {
    ($potential:ty, $number:ty, $dimension:expr, $scratch:expr, |$this:ident, $q:ident, $g:ident, $t:ident| $gradient:block) => {
        impl Potential<$number> for ByHand<$potential> {
            fn dimension(&self) -> usize {
                $dimension
            }
            fn scratch(&self) -> usize {
                $scratch
            }
            fn energy(&self, _: &[$number], _: &mut $number, _: &mut [$number]) {}
            #[inline]
            #[allow(unused_variables)]
            fn gradient(&self, $q: &[$number], $g: &mut [$number], $t: &mut [$number]) {
                let $this = &self.0;
                $gradient
            }
        }
    };
}

by_hand!(KeplerOrbit, f64, 2, 0, |this, q, g, t| {
    let inverse = 1.0 / (q[0] * q[0] + q[1] * q[1]).sqrt();
    let cube = inverse * inverse * inverse;
    g.copy_from_slice(&[cube * q[0], cube * q[1]]);
});
by_hand!(HenonHeilesStar, f64, 2, 0, |this, q, g, t| {
    g.copy_from_slice(&[q[0] + 2.0 * q[0] * q[1], q[1] + q[0] * q[0] - q[1] * q[1]]);
});
by_hand!(PendulumBob, f64, 1, 0, |this, q, g, t| {
    g[0] = q[0].sin();
});
by_hand!(Planets<f64>, f64, 3 * BODIES, 0, |this, q, g, t| {
    g.fill(0.0);
    for i in 0..BODIES {
        for j in i + 1..BODIES {
            let d = [q[3 * j] - q[3 * i], q[3 * j + 1] - q[3 * i + 1], q[3 * j + 2] - q[3 * i + 2]];
            let inverse = 1.0 / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
            let factor = this.g * this.m[i] * this.m[j] * inverse * inverse * inverse;
            for axis in 0..3 {
                let force = factor * d[axis];
                g[3 * i + axis] -= force;
                g[3 * j + axis] += force;
            }
        }
    }
});

by_hand!(KeplerOrbit, Float, 2, 2, |this, q, g, t| {
    let [square, inverse] = t else { unreachable!("as much as asked for") };
    square.assign(q[0].square_ref());
    *square += &q[1] * &q[1];
    inverse.assign(square.recip_sqrt_ref());
    square.assign(inverse.square_ref());
    *square *= &*inverse;
    g[0].assign(&*square * &q[0]);
    g[1].assign(&*square * &q[1]);
});
by_hand!(HenonHeilesStar, Float, 2, 0, |this, q, g, t| {
    g[0].assign(&q[0] * &q[1]);
    g[0] <<= 1u32;
    g[0] += &q[0];
    g[1].assign(q[0].square_ref());
    g[1] -= &q[1] * &q[1];
    g[1] += &q[1];
});
by_hand!(PendulumBob, Float, 1, 0, |this, q, g, t| {
    g[0].assign(q[0].sin_ref());
});
by_hand!(Planets<Float>, Float, 3 * BODIES, 5, |this, q, g, t| {
    for g in g.iter_mut() {
        g.assign(0);
    }
    let [dx, dy, dz, square, inverse] = t else { unreachable!("as much as asked for") };
    for i in 0..BODIES {
        for j in i + 1..BODIES {
            dx.assign(&q[3 * j] - &q[3 * i]);
            dy.assign(&q[3 * j + 1] - &q[3 * i + 1]);
            dz.assign(&q[3 * j + 2] - &q[3 * i + 2]);
            square.assign(dx.square_ref());
            *square += &*dy * &*dy;
            *square += &*dz * &*dz;
            inverse.assign(square.recip_sqrt_ref());
            square.assign(inverse.square_ref());
            *square *= &*inverse;
            inverse.assign(&this.m[i] * &this.m[j]);
            *square *= &*inverse;
            *square *= &this.g;
            for (axis, d) in [&mut *dx, &mut *dy, &mut *dz].into_iter().enumerate() {
                *d *= &*square;
                g[3 * i + axis] -= &*d;
                g[3 * j + axis] += &*d;
            }
        }
    }
});
