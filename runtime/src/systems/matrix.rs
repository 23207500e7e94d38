//! Matrices of exact flows: computed in more digits than a run has, and rounded once.
//!
//! Functions are `inline`: a program without such flows compiles no numbers of limbs.

use shadowstep_schemes::symbolic::decimal::from_text;

use crate::Rational;
use crate::number::{AnyLimbs, CorrectlyRounded, LimbCount, Number, Real};

/// A matrix, row by row.
pub(crate) type Matrix<N> = Vec<Vec<N>>;

/// At most this number of flows is kept; for a caller with more times the oldest are computed again.
pub(crate) const MOST_KEPT: usize = 256;

/// With terms that fall by 16 and more, fewer make the digits of 17 limbs.
pub(crate) const MOST_TERMS: i32 = 300;

/// The flow of a quadratic form is computed for numbers of at most this number of digits.
pub const QUADRATIC_FLOW_DIGITS: u32 = 288;

/// Bits beyond the bits of the run: doubling t k times may lose 2k of them.
const GUARD_BITS: u32 = 128;

/// The numbers in which flows are computed; `None` if the run has more digits than they.
pub(crate) fn precision<N: CorrectlyRounded>(context: &N::Context) -> Option<LimbCount> {
    LimbCount::of_bits(N::precision(context).in_bits() + GUARD_BITS)
}

/// The matrix in the numbers of a run.
pub(crate) fn round<N: CorrectlyRounded>(matrix: &Matrix<AnyLimbs>, zero: &N) -> Matrix<N> {
    let rounded = |value: &AnyLimbs| {
        let mut number = zero.clone();
        number.assign_rounded(value);
        number
    };
    matrix.iter().map(|row| row.iter().map(rounded).collect()).collect()
}

/// a b
#[inline]
pub(crate) fn product(a: &Matrix<AnyLimbs>, b: &Matrix<AnyLimbs>, count: LimbCount) -> Matrix<AnyLimbs> {
    let entry = |row: &[AnyLimbs], column: usize| {
        let mut sum = AnyLimbs::zero(count);
        row.iter().zip(b).for_each(|(a, b)| sum.add_product(a, &b[column]));
        sum
    };
    a.iter().map(|row| (0..b.len()).map(|column| entry(row, column)).collect()).collect()
}

/// a ← a + b
#[inline]
pub(crate) fn add(a: &mut Matrix<AnyLimbs>, b: &Matrix<AnyLimbs>) {
    a.iter_mut().flatten().zip(b.iter().flatten()).for_each(|(a, b)| a.add(b));
}

/// a ← a n
#[inline]
pub(crate) fn scale(a: &mut Matrix<AnyLimbs>, by: i32) {
    a.iter_mut().flatten().for_each(|x| x.multiply_integer(by));
}

/// a ← a + n
#[inline]
pub(crate) fn add_to_diagonal(a: &mut Matrix<AnyLimbs>, number: u32, count: LimbCount) {
    let by = AnyLimbs::from_rational(&Rational::from_integer(number.into()), &count);
    a.iter_mut().enumerate().for_each(|(i, row)| row[i].add(&by));
}

/// e^A − 1: its series for A/2ⁿ, and then by doubling, E ← E² + 2E, which has no cancellation.
fn exponential(mut argument: Matrix<AnyLimbs>, count: LimbCount) -> Matrix<AnyLimbs> {
    let norm = norm(&argument);
    let halvings = if norm.is_finite() { (norm * 16.0).max(1.0).log2().ceil() as u32 } else { 0 };
    for _ in 0..halvings {
        argument.iter_mut().flatten().for_each(|x| x.divide_integer(2));
    }
    let mut sum = argument.clone();
    let mut term = argument.clone();
    for k in 2..MOST_TERMS {
        // a term is less than 1/16 of the one before
        term = product(&term, &argument, count);
        term.iter_mut().flatten().for_each(|x| x.divide_integer(k));
        add(&mut sum, &term);
        let largest = term.iter().flatten().map(AnyLimbs::log10_abs).fold(f64::NEG_INFINITY, f64::max);
        if largest < -f64::from(count.bits()) * std::f64::consts::LOG10_2 {
            break;
        }
    }
    double(&mut sum, halvings, count);
    sum
}

/// E ← E² + 2E, some times.
fn double(e: &mut Matrix<AnyLimbs>, times: u32, count: LimbCount) {
    for _ in 0..times {
        let square = product(e, e, count);
        scale(e, 2);
        add(e, &square);
    }
}

/// The powers of larger matrices would need much memory, and are computed again for each time.
const LARGEST_KEPT: usize = 32;

/// The powers A, A², … that series Σ c_k Aᵏ have needed so far: with them a series has no products of matrices.
#[derive(Clone, Debug)]
pub(crate) struct Powers {
    powers: Vec<Matrix<AnyLimbs>>,
    /// A norm of A.
    norm: f64,
    count: LimbCount,
}

impl Powers {
    pub(crate) fn new(matrix: Matrix<AnyLimbs>, count: LimbCount) -> Self {
        Powers { norm: norm(&matrix), powers: vec![matrix], count }
    }

    /// A norm of A.
    pub(crate) fn norm(&self) -> f64 {
        self.norm
    }

    /// Σ c_k Aᵏ over k = 1, 2, … as long as terms have digits; `next` makes c_k of the coefficient before, and c_0
    /// is 1.
    pub(crate) fn series(&mut self, mut next: impl FnMut(i32, &mut AnyLimbs)) -> Matrix<AnyLimbs> {
        let Powers { powers, norm, count, .. } = self;
        let zero = AnyLimbs::zero(*count);
        let mut sum = vec![vec![zero; powers[0].len()]; powers[0].len()];
        let mut coefficient = AnyLimbs::from_rational(&Rational::from_integer(1.into()), count);
        for k in 1..MOST_TERMS {
            next(k, &mut coefficient);
            if powers.len() < k as usize {
                powers.push(product(&powers[0], &powers[k as usize - 2], *count));
            }
            let entries = sum.iter_mut().flatten().zip(powers[k as usize - 1].iter().flatten());
            entries.for_each(|(sum, power)| sum.add_product(&coefficient, power));
            let size = coefficient.log10_abs() + f64::from(k) * norm.log10();
            if size < -f64::from(count.bits()) * std::f64::consts::LOG10_2 {
                break;
            }
        }
        sum
    }

    /// Ends the series over a time: powers of large matrices are not kept for the next.
    pub(crate) fn end_of_time(&mut self) {
        if self.powers[0].len() > LARGEST_KEPT {
            self.powers.truncate(1);
        }
    }
}

/// The largest sum of the sizes of a row.
fn norm(matrix: &Matrix<AnyLimbs>) -> f64 {
    matrix.iter().map(|row| row.iter().map(|x| x.to_f64().abs()).sum::<f64>()).fold(0.0, f64::max)
}

/// A quadratic form ½xᵀSx in x = (q, p): S exactly, and in numbers, which have the derivatives of S.
#[derive(Clone, Debug)]
pub(crate) struct Form<N> {
    exact: Matrix<Rational>,
    pub(crate) rounded: Matrix<N>,
    /// Of JS, once there was a flow.
    #[cfg(feature = "formulas")]
    powers: Option<Powers>,
}

impl<N: CorrectlyRounded> Form<N> {
    pub(crate) fn new(exact: Matrix<Rational>, context: &N::Context) -> Self {
        let number = |value: &Rational| N::from_rational(value, context);
        let rounded = exact.iter().map(|row| row.iter().map(number).collect()).collect();
        Form {
            exact,
            rounded,
            #[cfg(feature = "formulas")]
            powers: None,
        }
    }

    /// e^{tJS} − 1: the series for t/2ⁿ, and then by doubling, E ← E² + 2E, which has no cancellation.
    #[cfg(feature = "formulas")]
    pub(crate) fn flow(&mut self, time: &Rational, count: LimbCount) -> Matrix<AnyLimbs> {
        let Form { exact, powers, .. } = self;
        let number = |s: &Rational| AnyLimbs::from_rational(s, &count);
        let powers = powers.get_or_insert_with(|| Powers::new(hamiltonian(exact, number), count));
        let mut time = number(time);
        let size = time.to_f64().abs() * powers.norm();
        let halvings = if size.is_finite() { (size * 2.0).max(1.0).log2().ceil() as u32 } else { 0 };
        (0..halvings).for_each(|_| time.divide_integer(2));
        let mut sum = powers.series(|k, coefficient| {
            coefficient.multiply(&time);
            coefficient.divide_integer(k);
        });
        powers.end_of_time();
        double(&mut sum, halvings, count);
        sum
    }

    /// tJS: the rows of p, and then those of q with the other sign.
    fn argument(&self, time: &Rational, count: LimbCount) -> Matrix<AnyLimbs> {
        hamiltonian(&self.exact, |s| AnyLimbs::from_rational(&(s * time), &count))
    }

    /// The derivatives of e^{tJS} along the directions k in which t or S has one. The derivative of e^A along Ȧ is the
    /// upper right part of the exponential of (A, Ȧ; 0, A).
    ///
    /// C. Van Loan, *Computing integrals involving the matrix exponential*, IEEE Trans. Automat. Contr. 23 (1978) 395.
    pub(crate) fn derivatives_of_flow(&self, time: &N, count: LimbCount) -> Vec<(usize, Matrix<AnyLimbs>)> {
        let along = |k| Some((k, self.derivative_of_flow(k, time, count)?));
        (0..N::DERIVATIVES).filter_map(along).collect()
    }

    fn derivative_of_flow(&self, k: usize, time: &N, count: LimbCount) -> Option<Matrix<AnyLimbs>> {
        let exact = |text: String| from_text(&text).ok();
        let (t, of_t) = (exact(time.to_text())?, exact(time.derivative_text(k))?);
        let entry = |s: &Rational, rounded: &N| Some(s * &of_t + exact(rounded.derivative_text(k))? * &t);
        let rows = self.exact.iter().zip(&self.rounded);
        let row =
            |(exact, rounded): (&Vec<Rational>, &Vec<N>)| exact.iter().zip(rounded).map(|(s, r)| entry(s, r)).collect();
        let form: Matrix<Rational> = rows.map(row).collect::<Option<_>>()?;
        if form.iter().flatten().all(num_traits::Zero::is_zero) {
            return None;
        }
        let along = hamiltonian(&form, |s| AnyLimbs::from_rational(s, &count));
        let argument = self.argument(&t, count);
        let zeros = vec![AnyLimbs::zero(count); argument.len()];
        let upper = argument.iter().zip(&along).map(|(a, along)| [&a[..], &along[..]].concat());
        let lower = argument.iter().map(|a| [&zeros[..], &a[..]].concat());
        let mut both = exponential(upper.chain(lower).collect(), count);
        both.truncate(argument.len());
        Some(both.into_iter().map(|mut row| row.split_off(argument.len())).collect())
    }
}

/// JS, each entry of S as a number.
fn hamiltonian(form: &Matrix<Rational>, number: impl Fn(&Rational) -> AnyLimbs) -> Matrix<AnyLimbs> {
    let (of_q, of_p) = form.split_at(form.len() / 2);
    let rising = of_p.iter().map(|row| row.iter().map(&number).collect());
    rising.chain(of_q.iter().map(|row| row.iter().map(|s| number(&-s)).collect())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Precision;

    #[test]
    fn most_digits_are_those_of_the_longest_limbs() {
        let fits = |digits| LimbCount::of_bits(Precision::digits(digits).unwrap().in_bits() + GUARD_BITS).is_some();
        assert!(fits(QUADRATIC_FLOW_DIGITS) && !fits(QUADRATIC_FLOW_DIGITS + 1));
    }

    /// Two degrees of freedom in a magnetic field: flows over many times cost few products of matrices, and are those
    /// of one exponential each.
    #[test]
    fn flows_over_many_times_share_the_powers() {
        let exact =
            [["9/16", "0", "0", "-3/4"], ["0", "9/32", "3/8", "0"], ["0", "3/8", "1/2", "0"], ["-3/4", "0", "0", "1"]];
        let exact = exact.map(|row| row.map(|s| crate::exact(s).unwrap()).to_vec()).to_vec();
        let mut form = Form::<f64>::new(exact, &());
        let count = precision::<f64>(&()).unwrap();
        for i in -50..150 {
            let time = Rational::new(i.into(), 37.into());
            let found = round(&form.flow(&time, count), &0.0);
            assert_eq!(found, round(&exponential(form.argument(&time, count), count), &0.0), "{time}");
        }
        // each is a product
        let kept = form.powers.unwrap().powers.len();
        assert!((20..60).contains(&kept), "{kept}");
    }
}
