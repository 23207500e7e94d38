//! Systems on which every scheme is checked, as one type: problem and masses are chosen at run time.

use shadowstep::problems::{HenonHeiles, Kepler, Pendulum, Scattering};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::potential::HessianProduct;
use shadowstep::{DiagonalMasses, FullMasses, Kinetic, Motion, Number, Potential, Real, UnitMasses};

use crate::{numbers, rational};

/// A problem of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Problem {
    /// U = −1/|q|
    Kepler,
    /// U = ½(x² + y²) + x²y − y³/3
    HenonHeiles,
    /// U = −cos q
    Pendulum,
    /// U = exp(−|q|²)
    Scattering,
}

impl Problem {
    /// All of them.
    pub const ALL: [Problem; 4] = [Problem::Kepler, Problem::HenonHeiles, Problem::Pendulum, Problem::Scattering];

    /// A start with nothing special about it: q, p.
    pub fn start(self) -> [&'static [&'static str]; 2] {
        match self {
            Problem::Kepler => [&["0.4", "0.1"], &["-0.2", "1.9"]],
            Problem::HenonHeiles => [&["0.1", "-0.3"], &["0.2", "0.1"]],
            Problem::Pendulum => [&["0.7"], &["1.1"]],
            Problem::Scattering => [&["-0.9", "0.3"], &["1.3", "0.1"]],
        }
    }

    fn potential<N: Number + 'static>(self) -> &'static dyn Potential<N> {
        match self {
            Problem::Kepler => &Kepler,
            Problem::HenonHeiles => &HenonHeiles,
            Problem::Pendulum => &Pendulum,
            Problem::Scattering => &Scattering,
        }
    }
}

impl<N: Number + 'static> Potential<N> for Problem {
    fn dimension(&self) -> usize {
        self.potential::<N>().dimension()
    }
    fn scratch(&self) -> usize {
        self.potential::<N>().scratch()
    }
    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        self.potential().energy(q, energy, scratch);
    }
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        self.potential().gradient(q, gradient, scratch);
    }
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.potential().gradient_and_rate(q, gradient, rate, scratch);
    }
    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        self.potential().hessian()
    }
}

/// Masses of any kind.
#[derive(Clone, Debug)]
pub enum Masses<N> {
    /// M = 1
    Unit,
    /// M = diag(m)
    Diagonal(DiagonalMasses<N>),
    /// a full M⁻¹
    Full(FullMasses<N>),
}

impl<N: Real> Masses<N> {
    /// One of each kind, all different from each other, for this dimension.
    pub fn all(dimension: usize, context: &N::Context) -> [Masses<N>; 3] {
        let diagonal: Vec<_> = [rational("4/3"), rational("0.7")][..dimension].to_vec();
        let full = [[rational("1.1"), rational("-1/4")], [rational("-1/4"), rational("2/3")]];
        let full: Vec<_> = full[..dimension].iter().map(|row| row[..dimension].to_vec()).collect();
        [
            Masses::Unit,
            Masses::Diagonal(DiagonalMasses::new(&diagonal, context).expect("positive")),
            Masses::Full(FullMasses::from_inverse(&full, context).expect("symmetric and positive")),
        ]
    }
}

impl<N: Number> Masses<N> {
    fn kinetic(&self) -> &dyn Kinetic<N, Class = Quadratic> {
        match self {
            Masses::Unit => &UnitMasses,
            Masses::Diagonal(masses) => masses,
            Masses::Full(masses) => masses,
        }
    }
}

impl<N: Number> Kinetic<N> for Masses<N> {
    type Class = Quadratic;
    fn dimension(&self) -> Option<usize> {
        self.kinetic().dimension()
    }
    fn scratch(&self) -> usize {
        self.kinetic().scratch()
    }
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        self.kinetic().drift(weight, p, q, scratch);
    }
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]) {
        self.kinetic().drift_augmented(weight, p, q, beta, scratch);
    }
    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        self.kinetic().energy(p, energy, scratch);
    }
}

/// A system in which everything is chosen at run time.
pub type AnyMotion<N> = Motion<N, Vec<N>, Problem, Masses<N>>;

/// A problem at its start.
pub fn system<N: Number + 'static>(problem: Problem, masses: Masses<N>, context: &N::Context) -> AnyMotion<N> {
    let [q, p] = problem.start();
    Motion::new(problem, masses, numbers(q, context), numbers(p, context)).expect("the dimensions agree")
}

/// All problems with all masses.
pub fn systems<N: Real + 'static>(context: &N::Context) -> Vec<AnyMotion<N>> {
    let of = |problem: Problem| {
        let dimension = problem.start()[0].len();
        Masses::all(dimension, context).map(|masses| system(problem, masses, context))
    };
    Problem::ALL.into_iter().flat_map(of).collect()
}
