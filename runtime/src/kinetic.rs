//! Kinetic energies T(p): the quadratic ones of masses (1, one per coordinate, a full M⁻¹), and any other.
//!
//! [`crate::kinetic!`] makes one from its formula, [`crate::formula::FormulaKinetic`] from a text at run time.

use thiserror::Error;

use crate::Rational;
use crate::number::Number;
use num_traits::{Signed, Zero};

/// The class of T = ½pᵀM⁻¹p. Every scheme has its order for these ([`crate::ValidFor`]).
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
/// use shadowstep::kinetic::{General, Kinetic};
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
    /// [`Quadratic`], if T is a quadratic form in p, else [`General`].
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
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        (**self).drift(weight, p, q, scratch);
    }
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]) {
        (**self).drift_augmented(weight, p, q, beta, scratch);
    }
    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        (**self).energy(p, energy, scratch);
    }
}

/// M = 1: no multiplication by masses at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct UnitMasses;

impl<N: Number> Kinetic<N> for UnitMasses {
    type Class = Quadratic;

    #[inline]
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], _: &mut [N]) {
        for (q, p) in q.iter_mut().zip(p) {
            q.add_product(weight, p);
        }
    }

    #[inline]
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], _: &mut N, scratch: &mut [N]) {
        self.drift(weight, p, q, scratch);
    }

    fn energy(&self, p: &[N], energy: &mut N, _: &mut [N]) {
        energy.assign_zero();
        for p in p {
            energy.add_product(p, p);
        }
        energy.divide_integer(2);
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
    /// A mass that is not positive.
    pub fn new(masses: &[Rational], context: &N::Context) -> Result<Self, MassError> {
        if let Some(index) = masses.iter().position(|m| !m.is_positive()) {
            return Err(MassError::NotPositive { index, mass: shadowstep_symbolic::decimal::to_text(&masses[index]) });
        }
        Ok(DiagonalMasses { inverse: masses.iter().map(|m| N::from_rational(&m.recip(), context)).collect() })
    }

    /// Masses of the coordinates as numbers, such as `f64`; each 1/m_i is rounded once.
    ///
    /// ```
    /// use shadowstep::DiagonalMasses;
    ///
    /// let masses = DiagonalMasses::from_numbers(&[1.0, 1.0, 39.95])?;
    /// assert!(DiagonalMasses::from_numbers(&[1.0, -1.0]).is_err());
    /// # Ok::<(), shadowstep::kinetic::MassError>(())
    /// ```
    ///
    /// # Errors
    /// A mass that is not a positive finite number.
    pub fn from_numbers(masses: &[N]) -> Result<Self, MassError> {
        let inverse = |(index, mass): (usize, &N)| {
            let zero = N::zero(&mass.context());
            if !(mass.is_finite() && *mass > zero) {
                return Err(MassError::NotPositive { index, mass: mass.to_text() });
            }
            let mut inverse = zero;
            inverse.assign_quotient(&N::from_rational(&Rational::from_integer(1.into()), &mass.context()), mass);
            Ok(inverse)
        };
        Ok(DiagonalMasses { inverse: masses.iter().enumerate().map(inverse).collect::<Result<_, _>>()? })
    }
}

impl<N: Number> Kinetic<N> for DiagonalMasses<N> {
    type Class = Quadratic;

    fn dimension(&self) -> Option<usize> {
        Some(self.inverse.len())
    }

    fn scratch(&self) -> usize {
        1
    }

    #[inline]
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        let velocity = &mut scratch[0];
        for ((q, p), inverse) in q.iter_mut().zip(p).zip(&self.inverse) {
            velocity.assign_product(inverse, p);
            q.add_product(weight, velocity);
        }
    }

    #[inline]
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], _: &mut N, scratch: &mut [N]) {
        self.drift(weight, p, q, scratch);
    }

    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        let velocity = &mut scratch[0];
        energy.assign_zero();
        for (p, inverse) in p.iter().zip(&self.inverse) {
            velocity.assign_product(inverse, p);
            energy.add_product(velocity, p);
        }
        energy.divide_integer(2);
    }
}

/// A full symmetric M⁻¹.
#[derive(Clone, Debug)]
pub struct FullMasses<N> {
    /// M⁻¹, row by row
    inverse: Vec<Vec<N>>,
}

impl<N: Number> FullMasses<N> {
    /// The rows of M⁻¹, each entry rounded once.
    ///
    /// # Errors
    /// A matrix that is not square or not symmetric or has a diagonal entry that is not positive.
    pub fn from_inverse(rows: &[Vec<Rational>], context: &N::Context) -> Result<Self, MassError> {
        for (i, row) in rows.iter().enumerate() {
            if row.len() != rows.len() {
                return Err(MassError::NotSquare { row: i, entries: row.len(), rows: rows.len() });
            }
            if let Some(j) = (0..i).find(|&j| row[j] != rows[j][i]) {
                return Err(MassError::NotSymmetric { row: i, column: j });
            }
            if !row[i].is_positive() || row[i].is_zero() {
                return Err(MassError::NotPositive { index: i, mass: shadowstep_symbolic::decimal::to_text(&row[i]) });
            }
        }
        let number = |r: &Rational| N::from_rational(r, context);
        Ok(FullMasses { inverse: rows.iter().map(|row| row.iter().map(number).collect()).collect() })
    }
}

impl<N: Number> Kinetic<N> for FullMasses<N> {
    type Class = Quadratic;

    fn dimension(&self) -> Option<usize> {
        Some(self.inverse.len())
    }

    fn scratch(&self) -> usize {
        1
    }

    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        let velocity = &mut scratch[0];
        for (q, row) in q.iter_mut().zip(&self.inverse) {
            dot(row, p, velocity);
            q.add_product(weight, velocity);
        }
    }

    #[inline]
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

fn dot<N: Number>(a: &[N], b: &[N], product: &mut N) {
    product.assign_zero();
    for (a, b) in a.iter().zip(b) {
        product.add_product(a, b);
    }
}

/// Masses that are not valid.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MassError {
    /// A mass (or a diagonal entry of M⁻¹) is 0 or negative.
    #[error("mass {index} is {mass}; masses must be positive and finite")]
    NotPositive {
        /// Which, from 0.
        index: usize,
        /// Its value.
        mass: String,
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
}
