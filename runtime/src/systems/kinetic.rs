//! Kinetic energies T(p): the quadratic ones of masses (1, one per coordinate, a full M⁻¹), and any other.
//!
//! [`crate::kinetic!`] makes one from its formula, [`crate::systems::formula::FormulaKinetic`] from a text at run time.

mod particles;

pub use particles::WithParticles;

use std::cmp::Ordering;

use thiserror::Error;

use crate::Rational;
use crate::number::partial_sums::add_sum;
use crate::number::{Lanes, Number, Real, epsilon};
use crate::systems::coordinates::{for_each_three, for_each_two};
use num_traits::Signed;
use shadowstep_schemes::symbolic::decimal::{to_significant, to_text};

/// The class of T = ½pᵀM⁻¹p + bᵀp + c, at most quadratic in p. Every scheme has its order for these
/// ([`crate::ValidFor`]): each bracket with U takes a degree, so that \[U,\[U,\[U,T\]\]\] = 0, and the force of
/// gradient kicks has M⁻¹ only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quadratic {}

/// The class of every T(p). Runge–Kutta–Nyström schemes lose their order here, and are refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum General {}

/// A kinetic energy T(p), for one kind of numbers or, written once, for all.
///
/// Like a potential it declares how many numbers of scratch space it needs, and gets them with every call.
///
/// ```
/// use shadowstep::systems::kinetic::{General, Kinetic};
/// use shadowstep::Number;
///
/// /// T = p⁴/4
/// struct Quartic;
///
/// impl<N: Number> Kinetic<N> for Quartic {
///     type Class = General;
///     fn dimension(&self) -> Option<usize> { Some(1) }
///     fn scratch(&self) -> usize { 1 }
///     fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
///         scratch[0].assign_square(&p[0]);
///         scratch[0].multiply(&p[0]);
///         q[0].add_product(weight, &scratch[0]); // T_p = p³
///     }
///     fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]) {
///         self.drift(weight, p, q, scratch);
///         self.energy(p, &mut scratch[0], &mut []);
///         scratch[0].multiply_integer(2);
///         beta.add_product(weight, &scratch[0]); // p T_p − 2T = 2T, as T has degree 4
///     }
///     fn energy(&self, p: &[N], energy: &mut N, _: &mut [N]) {
///         energy.assign_square(&p[0]);
///         energy.multiply(&p[0]);
///         energy.multiply(&p[0]);
///         energy.divide_integer(4);
///     }
/// }
/// ```
pub trait Kinetic<N: Number> {
    /// [`Quadratic`], if T is at most quadratic in p, else [`General`].
    type Class;

    /// The dimension, if it is fixed.
    fn dimension(&self) -> Option<usize> {
        None
    }

    /// The number of scratch numbers that every call needs.
    fn scratch(&self) -> usize {
        0
    }

    /// Prepares the scratch space: values that do not depend on p. Called once, before all other calls.
    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let _ = (scratch, context);
    }

    /// q ← q + weight·T_p(p)
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]);

    /// The drift, with the same bits of q, and β ← β + weight·(pᵀT_p − 2T).
    ///
    /// A term of T that is homogeneous of degree k adds (k − 2) times itself; for quadratic T this is the drift alone.
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]);

    /// energy ← T(p)
    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]);

    /// energy, which is T(p), ← an energy of the size of those exchanged in the motion, with which the monitor compares
    /// the error of H. By default it is T itself.
    fn exchanged_energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        let _ = (p, energy, scratch);
    }

    /// M⁻¹ of T = ½pᵀM⁻¹p, if it is diagonal and known; by default it is not.
    fn inverse_masses(&self) -> Option<InverseMasses<'_, N>> {
        None
    }

    /// Whether T of the class [`Quadratic`] has terms bᵀp, so that T_p(0) = b is not 0: gradient kicks subtract it. By
    /// default it has none.
    fn has_linear_terms(&self) -> bool {
        false
    }

    /// How many coordinates of a state of this dimension have an energy, the first ones: by default all. Those after
    /// them are of particles of mass 0.
    fn massive_coordinates(&self, dimension: usize) -> usize {
        dimension
    }
}

/// A diagonal M⁻¹.
#[derive(Debug)]
pub enum InverseMasses<'a, N> {
    /// All masses are 1.
    Ones,
    /// 1/m_i of each coordinate.
    Of(&'a [N]),
}

// derived, they would need copies of N
impl<N> Clone for InverseMasses<'_, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N> Copy for InverseMasses<'_, N> {}

impl<N: Number> InverseMasses<'_, N> {
    /// q ← q + weight·M⁻¹p; `velocity` is scratch space.
    #[inline(always)]
    pub(crate) fn drift(&self, weight: &N, p: &[N], q: &mut [N], velocity: &mut N) {
        match self {
            InverseMasses::Ones => for_each_two(
                q,
                p,
                #[inline(always)]
                |q, p| q.add_product(weight, p),
            ),
            InverseMasses::Of(inverse) => {
                let mut velocity = velocity.register();
                for_each_three(q, p, inverse, |q, p, inverse| {
                    velocity.assign_product(inverse, p);
                    q.add_product(weight, &velocity);
                });
            }
        }
    }
}

impl<N: Number> Kinetic<N> for InverseMasses<'_, N> {
    type Class = Quadratic;

    fn dimension(&self) -> Option<usize> {
        match self {
            InverseMasses::Ones => None,
            InverseMasses::Of(inverse) => Some(inverse.len()),
        }
    }

    fn scratch(&self) -> usize {
        1
    }

    #[inline(always)]
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        InverseMasses::drift(self, weight, p, q, &mut scratch[0]);
    }

    #[inline(always)]
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], _: &mut N, scratch: &mut [N]) {
        InverseMasses::drift(self, weight, p, q, &mut scratch[0]);
    }

    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        match self {
            InverseMasses::Ones => UnitMasses.energy(p, energy, scratch),
            InverseMasses::Of(inverse) => {
                let velocity = &mut scratch[0];
                energy.assign_zero();
                add_sum(energy, [p, inverse], |[p, inverse], energy| {
                    let mut velocity = velocity.register();
                    velocity.assign_product(inverse, p);
                    energy.add_product(&velocity, p);
                });
                energy.divide_integer(2);
            }
        }
    }

    fn inverse_masses(&self) -> Option<InverseMasses<'_, N>> {
        Some(*self)
    }
}

impl<N: Number, K: Kinetic<N> + ?Sized> Kinetic<N> for Box<K> {
    type Class = K::Class;
    fn dimension(&self) -> Option<usize> {
        (**self).dimension()
    }
    fn scratch(&self) -> usize {
        (**self).scratch()
    }
    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        (**self).prepare(scratch, context);
    }
    #[inline(always)]
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        // lanes here: so the drift is compiled for the vector instructions of the loop that it is in
        match if N::LANES > 1 { (**self).inverse_masses() } else { None } {
            Some(inverse_masses) => inverse_masses.drift(weight, p, q, &mut weight.clone()),
            None => (**self).drift(weight, p, q, scratch),
        }
    }
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]) {
        (**self).drift_augmented(weight, p, q, beta, scratch);
    }
    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        (**self).energy(p, energy, scratch);
    }
    fn exchanged_energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        (**self).exchanged_energy(p, energy, scratch);
    }
    fn inverse_masses(&self) -> Option<InverseMasses<'_, N>> {
        (**self).inverse_masses()
    }

    fn has_linear_terms(&self) -> bool {
        (**self).has_linear_terms()
    }

    fn massive_coordinates(&self, dimension: usize) -> usize {
        (**self).massive_coordinates(dimension)
    }
}

/// M = 1: no multiplication by masses at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct UnitMasses;

impl<N: Number> Kinetic<N> for UnitMasses {
    type Class = Quadratic;

    #[inline(always)]
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], _: &mut [N]) {
        for_each_two(
            q,
            p,
            #[inline(always)]
            |q, p| q.add_product(weight, p),
        );
    }

    #[inline(always)]
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], _: &mut N, scratch: &mut [N]) {
        self.drift(weight, p, q, scratch);
    }

    #[inline]
    fn energy(&self, p: &[N], energy: &mut N, _: &mut [N]) {
        energy.assign_zero();
        add_sum(energy, [p], |[p], energy| energy.add_product(p, p));
        energy.divide_integer(2);
    }

    fn inverse_masses(&self) -> Option<InverseMasses<'_, N>> {
        Some(InverseMasses::Ones)
    }
}

/// M = diag(m_1, …, m_d).
#[derive(Clone, Debug)]
pub struct DiagonalMasses<N> {
    /// 1/m_i
    inverse: Vec<N>,
}

impl<N: Number> DiagonalMasses<N> {
    /// Masses of the coordinates; each 1/m_i is rounded once.
    ///
    /// # Errors
    /// A mass that is not positive, or whose 1/m overflows or underflows: 1e-400 in `f64`.
    pub fn new(masses: &[Rational], context: &N::Context) -> Result<Self, MassError> {
        let inverse = |(index, mass): (usize, &Rational)| {
            if !mass.is_positive() {
                return Err(MassError::NotPositive { index, mass: to_text(mass) });
            }
            in_range(N::from_rational(&mass.recip(), context))
                .ok_or_else(|| MassError::OutOfRange { index, mass: to_significant(mass, 6) })
        };
        Ok(DiagonalMasses { inverse: masses.iter().enumerate().map(inverse).collect::<Result<_, _>>()? })
    }
}

impl<N: Real> DiagonalMasses<N> {
    /// Masses of the coordinates as numbers, such as `f64`; each 1/m_i is rounded once.
    ///
    /// ```
    /// use shadowstep::DiagonalMasses;
    ///
    /// let masses = DiagonalMasses::from_numbers(&[1.0, 1.0, 39.95])?;
    /// assert!(DiagonalMasses::from_numbers(&[1.0, -1.0]).is_err());
    /// # Ok::<(), shadowstep::systems::kinetic::MassError>(())
    /// ```
    ///
    /// # Errors
    /// A mass that is not a positive finite number, or whose 1/m overflows.
    pub fn from_numbers(masses: &[N]) -> Result<Self, MassError> {
        let inverse = |(index, mass): (usize, &N)| {
            let zero = N::zero(&mass.context());
            if !(mass.is_finite() && *mass > zero) {
                return Err(MassError::NotPositive { index, mass: mass.to_text() });
            }
            let mut inverse = zero;
            inverse.assign_quotient(&N::from_rational(&Rational::from_integer(1.into()), &mass.context()), mass);
            in_range(inverse).ok_or_else(|| MassError::OutOfRange { index, mass: mass.to_text() })
        };
        Ok(DiagonalMasses { inverse: masses.iter().enumerate().map(inverse).collect::<Result<_, _>>()? })
    }
}

impl<const W: usize> DiagonalMasses<Lanes<W>> {
    /// Masses that differ in the trajectories of an [ensemble](crate::shadow::ensemble): the masses of one in each
    /// lane, with the bits that they have alone.
    ///
    /// ```
    /// use shadowstep::{DiagonalMasses, Motion, Stepper, shadow::ensemble::Ensemble, problems::HenonHeiles, tables::shipped};
    ///
    /// let masses: Vec<_> = (1..=20).map(|t| DiagonalMasses::from_numbers(&[1.0, f64::from(t)])).collect::<Result<_, _>>()?;
    /// let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/20")?;
    /// let ensemble = Ensemble { trajectories: 20, steps: 100, ..Ensemble::default() };
    /// let outcomes = ensemble.run::<8, _, _, _>(&stepper, |block| {
    ///     let masses = DiagonalMasses::of_each(&block.each(|t| &masses[t]))?;
    ///     let [zero, part] = [0.0, 0.1].map(|x| block.lanes(|_| x));
    ///     Motion::new(HenonHeiles, masses, [zero, part], [part, zero])
    /// })?;
    /// assert!(outcomes[0].q != outcomes[19].q && outcomes.iter().all(|outcome| outcome.energy_error.unwrap() < 1e-6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Masses of different numbers of coordinates.
    pub fn of_each(each: &[&DiagonalMasses<f64>; W]) -> Result<Self, MassError> {
        let dimension = each.first().map_or(0, |first| first.inverse.len());
        check_same_dimension(dimension, each.iter().map(|masses| masses.inverse.len()))?;
        let lanes = |i: usize| Lanes(std::array::from_fn(|lane| each[lane].inverse[i]));
        Ok(DiagonalMasses { inverse: (0..dimension).map(lanes).collect() })
    }
}

impl<N: Number> DiagonalMasses<N> {
    /// The same masses in other numbers, to which these convert.
    pub fn into_numbers<M: Number + From<N>>(self) -> DiagonalMasses<M> {
        DiagonalMasses { inverse: self.inverse.into_iter().map(M::from).collect() }
    }
}

/// Refuses lanes of different dimensions.
fn check_same_dimension(first: usize, mut each: impl Iterator<Item = usize>) -> Result<(), MassError> {
    match each.find(|other| *other != first) {
        Some(other) => Err(MassError::Dimensions { first, other }),
        None => Ok(()),
    }
}

/// The rounding of a positive number, if it has neither overflowed nor underflowed.
fn in_range<N: Number>(number: N) -> Option<N> {
    let mut quotient = N::zero(&number.context());
    quotient.divide(&number); // 0/x is finite unless x is 0
    (number.is_finite() && quotient.is_finite()).then_some(number)
}

impl<N: Number> Kinetic<N> for DiagonalMasses<N> {
    type Class = Quadratic;

    fn dimension(&self) -> Option<usize> {
        Some(self.inverse.len())
    }

    fn scratch(&self) -> usize {
        1
    }

    #[inline(always)]
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        InverseMasses::Of(&self.inverse).drift(weight, p, q, &mut scratch[0]);
    }

    #[inline(always)]
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], _: &mut N, scratch: &mut [N]) {
        self.drift(weight, p, q, scratch);
    }

    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        InverseMasses::Of(&self.inverse).energy(p, energy, scratch);
    }

    fn inverse_masses(&self) -> Option<InverseMasses<'_, N>> {
        Some(InverseMasses::Of(&self.inverse))
    }
}

/// A full M⁻¹, symmetric and positive definite.
///
/// ```
/// use shadowstep::{FullMasses, Rational};
///
/// let rows = |entries: [[i64; 2]; 2]| entries.map(|row| row.map(|entry| Rational::from_integer(entry.into())).to_vec());
/// assert!(FullMasses::<f64>::from_inverse(&rows([[2, 1], [1, 2]]), &()).is_ok());
/// let error = FullMasses::<f64>::from_inverse(&rows([[1, 2], [2, 1]]), &()).unwrap_err();
/// assert_eq!(error.to_string(), "the inverse mass matrix is not positive definite: the pivot of row 1 is -3.0");
/// ```
#[derive(Clone, Debug)]
pub struct FullMasses<N> {
    /// M⁻¹, row by row
    inverse: Vec<Vec<N>>,
}

impl<N: Real> FullMasses<N> {
    /// The rows of M⁻¹, each entry rounded once.
    ///
    /// # Errors
    /// A matrix that is not square or not symmetric, has a diagonal entry that is not positive or overflows or
    /// underflows, or is not positive definite. The last is decided by the pivots of Gauss's elimination: in row i of d
    /// one must be larger than d ε times the diagonal entry, ε the last place of 1, as a smaller one may be round-off.
    pub fn from_inverse(rows: &[Vec<Rational>], context: &N::Context) -> Result<Self, MassError> {
        for (i, row) in rows.iter().enumerate() {
            if row.len() != rows.len() {
                return Err(MassError::NotSquare { row: i, entries: row.len(), rows: rows.len() });
            }
            if let Some(j) = (0..i).find(|&j| row[j] != rows[j][i]) {
                return Err(MassError::NotSymmetric { row: i, column: j });
            }
            if !row[i].is_positive() {
                return Err(MassError::NotPositive { index: i, mass: to_text(&row[i]) });
            }
            if in_range(N::from_rational(&row[i], context)).is_none() {
                return Err(MassError::OutOfRange { index: i, mass: to_significant(&row[i].recip(), 6) });
            }
        }
        let number = |r: &Rational| N::from_rational(r, context);
        let inverse: Vec<Vec<N>> = rows.iter().map(|row| row.iter().map(number).collect()).collect();
        check_positive_definite(&inverse, context)?;
        Ok(FullMasses { inverse })
    }
}

impl<const W: usize> FullMasses<Lanes<W>> {
    /// Matrices that differ in the trajectories: the matrix of one in each lane, with the bits that it has alone.
    ///
    /// # Errors
    /// Matrices of different dimensions.
    pub fn of_each(each: &[&FullMasses<f64>; W]) -> Result<Self, MassError> {
        let dimension = each.first().map_or(0, |first| first.inverse.len());
        check_same_dimension(dimension, each.iter().map(|masses| masses.inverse.len()))?;
        let lanes = |i: usize, j: usize| Lanes(std::array::from_fn(|lane| each[lane].inverse[i][j]));
        let row = |i: usize| (0..dimension).map(|j| lanes(i, j)).collect();
        Ok(FullMasses { inverse: (0..dimension).map(row).collect() })
    }
}

/// Refuses a symmetric matrix with a pivot that is not positive, beyond round-off.
fn check_positive_definite<N: Real>(rows: &[Vec<N>], context: &N::Context) -> Result<(), MassError> {
    let mut rest = rows.to_vec();
    let [mut bound, mut factor] = [N::zero(context), N::zero(context)];
    let mut round_off = epsilon::<N>(context);
    round_off.multiply_integer(i32::try_from(rows.len()).unwrap_or(i32::MAX));
    for i in 0..rows.len() {
        let (above, below) = rest.split_at_mut(i + 1);
        let pivots = &above[i][i..];
        bound.assign_product(&round_off, &rows[i][i]);
        // NaN has no order
        if pivots[0].partial_cmp(&bound) != Some(Ordering::Greater) {
            return Err(MassError::NotPositiveDefinite { row: i, pivot: pivots[0].to_text() });
        }
        for row in below {
            factor.assign_quotient(&row[i], &pivots[0]);
            row[i..].iter_mut().zip(pivots).for_each(|(entry, pivot)| entry.subtract_product(&factor, pivot));
        }
    }
    Ok(())
}

impl<N: Number> Kinetic<N> for FullMasses<N> {
    type Class = Quadratic;

    fn dimension(&self) -> Option<usize> {
        Some(self.inverse.len())
    }

    fn scratch(&self) -> usize {
        1
    }

    #[inline(always)]
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        let velocity = &mut scratch[0];
        for (q, row) in q.iter_mut().zip(&self.inverse) {
            dot(row, p, velocity);
            q.add_product(weight, velocity);
        }
    }

    #[inline(always)]
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], _: &mut N, scratch: &mut [N]) {
        self.drift(weight, p, q, scratch);
    }

    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        let velocity = &mut scratch[0];
        energy.assign_zero();
        for (p_i, row) in p.iter().zip(&self.inverse) {
            dot(row, p, velocity);
            energy.add_product(velocity, p_i);
        }
        energy.divide_integer(2);
    }
}

#[inline(always)]
fn dot<N: Number>(a: &[N], b: &[N], product: &mut N) {
    product.assign_zero();
    for (a, b) in a.iter().zip(b) {
        product.add_product(a, b);
    }
}

/// Masses that are not valid.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum MassError {
    /// A mass (or a diagonal entry of M⁻¹) is 0 or negative.
    #[error("mass {index} is {mass}; masses must be positive and finite")]
    NotPositive {
        /// Which, from 0.
        index: usize,
        /// Its value.
        mass: String,
    },
    /// A mass so small or large that it or its inverse is infinite or 0 in the number type.
    #[error("mass {index} is {mass}: the mass or its inverse overflows or underflows in this number type")]
    OutOfRange {
        /// Which, from 0.
        index: usize,
        /// Its value.
        mass: String,
    },
    /// M⁻¹ is not positive definite.
    #[error("the inverse mass matrix is not positive definite: the pivot of row {row} is {pivot}")]
    NotPositiveDefinite {
        /// The first row whose pivot in Gauss's elimination is not positive, from 0.
        row: usize,
        /// The pivot.
        pivot: String,
    },
    /// A row of M⁻¹ is too short or too long.
    #[error("row {row} of the inverse mass matrix has {entries} entries, but there are {rows} rows")]
    NotSquare {
        /// Which row, from 0.
        row: usize,
        /// How many entries it has.
        entries: usize,
        /// How many rows there are.
        rows: usize,
    },
    /// M⁻¹ is not symmetric.
    #[error("the inverse mass matrix is not symmetric: entries ({row}, {column}) and ({column}, {row}) differ")]
    NotSymmetric {
        /// Row of one entry, from 0.
        row: usize,
        /// Column of it.
        column: usize,
    },
    /// The masses of several trajectories are of different numbers of coordinates.
    #[error("the masses of one trajectory are for {first} coordinates, those of another for {other}")]
    Dimensions {
        /// The coordinates of the first trajectory.
        first: usize,
        /// The coordinates of another.
        other: usize,
    },
}

shadowstep_schemes::debug_as_text!(MassError);
