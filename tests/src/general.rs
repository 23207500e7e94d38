//! Systems with kinetic energies that are not quadratic, as one type: the problem is chosen at run time.

use rug::Float;
use shadowstep::problems::HenonHeiles;
use shadowstep::systems::kinetic::General;
use shadowstep::{Kinetic, Motion, Number, Potential, kinetic, potential};

use crate::{numbers, rational};

kinetic! {
    /// Mass 1, speed of light c.
    pub struct Relativistic { c }
    T(p) = sqrt(c^4 + c^2*p^2)
}

potential! {
    pub struct Spring;
    U(q) = q^2/2
}

kinetic! {
    /// Lotka and Volterra's u' = u (v − 2), v' = v (1 − u) with p = log u, q = log v (Hairer, Lubich & Wanner,
    /// Geometric Numerical Integration, section I.1.1).
    pub struct Predators;
    T(p) = p - exp(p)
}

potential! {
    pub struct Prey;
    U(q) = 2*q - exp(q)
}

kinetic! {
    pub struct Quartic;
    T(p) = p^4/4 + p^2/2
}

potential! {
    pub struct DoubleWell;
    U(q) = q^4/4 - q^2/2
}

kinetic! {
    pub struct Coupled;
    T(px, py) = sqrt(1 + px^2 + py^2) + px*py^2/3
}

/// A problem with a T(p) that is not quadratic.
#[derive(Clone, Copy, Debug)]
pub enum Problem {
    /// T = √(1 + p²), U = q²/2
    RelativisticOscillator,
    /// T = p − exp(p), U = 2q − exp(q)
    LotkaVolterra,
    /// Both T and U of degree 4.
    Quartic,
    /// T = √(1 + |p|²) + p_x p_y²/3, U of Hénon and Heiles.
    Plane,
}

/// A system whose parts are chosen at run time.
pub type AnyMotion<N, C = General> = Motion<N, Vec<N>, Box<dyn Potential<N>>, Box<dyn Kinetic<N, Class = C>>>;

impl Problem {
    /// All of them.
    pub const ALL: [Problem; 4] =
        [Problem::RelativisticOscillator, Problem::LotkaVolterra, Problem::Quartic, Problem::Plane];

    /// T
    pub fn kinetic<N: Number + 'static>(self, context: &N::Context) -> Box<dyn Kinetic<N, Class = General>> {
        match self {
            Problem::RelativisticOscillator => Box::new(Relativistic { c: N::from_rational(&rational("1"), context) }),
            Problem::LotkaVolterra => Box::new(Predators),
            Problem::Quartic => Box::new(Quartic),
            Problem::Plane => Box::new(Coupled),
        }
    }

    /// U
    pub fn potential<N: Number + 'static>(self) -> Box<dyn Potential<N>> {
        match self {
            Problem::RelativisticOscillator => Box::new(Spring),
            Problem::LotkaVolterra => Box::new(Prey),
            Problem::Quartic => Box::new(DoubleWell),
            Problem::Plane => Box::new(HenonHeiles),
        }
    }

    /// q and p.
    pub fn start(self) -> [&'static [&'static str]; 2] {
        match self {
            Problem::RelativisticOscillator => [&["0.3"], &["1.1"]],
            Problem::LotkaVolterra => [&["1.2"], &["-0.7"]],
            Problem::Quartic => [&["0.9"], &["0.7"]],
            Problem::Plane => [&["0.1", "-0.3"], &["0.2", "0.1"]],
        }
    }

    /// The problem at its start.
    pub fn system<N: Number + 'static>(self, context: &N::Context) -> AnyMotion<N> {
        let [q, p] = self.start();
        Motion::new(self.potential(), self.kinetic(context), numbers(q, context), numbers(p, context))
            .expect("the dimensions agree")
    }

    /// T_p, written once more, in plain formulas.
    pub fn velocity(self, p: &[Float]) -> Vec<Float> {
        let x = || p[0].clone();
        match self {
            Problem::RelativisticOscillator => vec![x() / (x().square() + 1_u32).sqrt()],
            Problem::LotkaVolterra => vec![1 - x().exp()],
            Problem::Quartic => vec![x().square() * x() + x()],
            Problem::Plane => {
                let y = || p[1].clone();
                let root = (x().square() + y().square() + 1_u32).sqrt();
                vec![x() / root.clone() + y().square() / 3, y() / root + x() * y() * 2 / 3]
            }
        }
    }

    /// U_q, in the same form.
    pub fn gradient(self, q: &[Float]) -> Vec<Float> {
        let x = || q[0].clone();
        match self {
            Problem::RelativisticOscillator => vec![x()],
            Problem::LotkaVolterra => vec![2 - x().exp()],
            Problem::Quartic => vec![x().square() * x() - x()],
            Problem::Plane => {
                let y = || q[1].clone();
                vec![x() + x() * y() * 2, y() + x().square() - y().square()]
            }
        }
    }
}
