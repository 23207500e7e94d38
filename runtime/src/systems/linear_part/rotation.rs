//! The exact flow of A = ½pᵀM⁻¹p + ½qᵀKq over the times of a step's drifts.
//!
//! With W = M⁻¹K, C = cos(t√W) and S = sin(t√W)/√W, both series in W, the flow is q ← C q + S M⁻¹p, p ← Cᵀ p − K S q.
//! Increments need C − 1, which is computed without cancellation: by its series for a small t, and then by doubling t.

use shadowstep_schemes::symbolic::decimal::from_text;

use crate::Rational;
use crate::number::{AnyLimbs, CorrectlyRounded, LimbCount, Number};
use crate::systems::matrix::{Form, MOST_KEPT, Matrix, Powers, add_to_diagonal, precision, product, round, scale};

/// The flows over the times that have occurred: a scheme has a few.
#[derive(Clone, Debug)]
pub(super) struct Rotations<N> {
    masses: Vec<Rational>,
    stiffness: Matrix<Rational>,
    /// Of W = M⁻¹K, once there was a flow.
    powers: Option<Powers>,
    /// A itself, for derivatives.
    form: Option<Form<N>>,
    known: Vec<(N, Flow<N>)>,
    to_q: Vec<N>,
    to_p: Vec<N>,
}

/// The flow over a time t.
#[derive(Clone, Debug)]
struct Flow<N> {
    /// C − 1
    versine: Matrix<N>,
    /// S M⁻¹
    of_p: Matrix<N>,
    /// −K S
    of_q: Matrix<N>,
}

impl<N: CorrectlyRounded> Rotations<N> {
    pub(super) fn new(masses: &[Rational], stiffness: &[Vec<Rational>], context: &N::Context) -> Self {
        let zeros = || vec![N::zero(context); masses.len()];
        Rotations {
            masses: masses.to_vec(),
            stiffness: stiffness.to_vec(),
            powers: None,
            form: (N::DERIVATIVES > 0).then(|| Form::new(form(masses, stiffness), context)),
            known: Vec::new(),
            to_q: zeros(),
            to_p: zeros(),
        }
    }

    /// What the flow over a time adds to q and p.
    pub(super) fn increments(&mut self, time: &N, q: &[N], p: &[N]) -> (&[N], &[N]) {
        let known = self.known.iter().position(|(known, _)| known == time);
        let index = known.unwrap_or_else(|| {
            if self.known.len() == MOST_KEPT {
                self.known.clear();
            }
            let mut flow = Flow::new((&self.masses, &self.stiffness), &mut self.powers, time);
            self.form.iter().for_each(|form| flow.add_derivatives(form, time));
            self.known.push((time.clone(), flow));
            self.known.len() - 1
        });
        let Flow { versine, of_p, of_q } = &self.known[index].1;
        for (i, to_q) in self.to_q.iter_mut().enumerate() {
            to_q.assign_zero();
            versine[i].iter().zip(q).for_each(|(c, q)| to_q.add_product(c, q));
            of_p[i].iter().zip(p).for_each(|(s, p)| to_q.add_product(s, p));
        }
        for (i, to_p) in self.to_p.iter_mut().enumerate() {
            to_p.assign_zero();
            // the transpose of C − 1
            versine.iter().zip(p).for_each(|(row, p)| to_p.add_product(&row[i], p));
            of_q[i].iter().zip(q).for_each(|(s, q)| to_p.add_product(s, q));
        }
        (&self.to_q, &self.to_p)
    }
}

impl<N: CorrectlyRounded> Flow<N> {
    /// The flow, computed in more digits and rounded once.
    fn new((masses, stiffness): (&[Rational], &Matrix<Rational>), powers: &mut Option<Powers>, time: &N) -> Self {
        let count = precision::<N>(&time.context()).expect("it was checked with the system");
        let number = |value: &Rational| AnyLimbs::from_rational(value, &count);
        // the decimal reads back to the same number, thus differs by less than its rounding
        let Ok(exact) = from_text(&time.to_text()) else { return Flow::of_no_time(time, masses.len()) };
        let zero = N::zero(&time.context());
        let time = &number(&exact);
        let of_row = |(row, mass): (&Vec<Rational>, &Rational)| row.iter().map(|k| number(&(k / mass))).collect();
        let frequencies = || Powers::new(stiffness.iter().zip(masses).map(of_row).collect(), count);
        let powers = powers.get_or_insert_with(frequencies);
        let doublings = doublings(powers.norm(), time);
        let mut small = *time;
        (0..doublings).for_each(|_| small.divide_integer(2));
        let (mut versine, mut sine) = series(powers, &small, count);
        for _ in 0..doublings {
            // cos 2x − 1 = 2 (cos x − 1)(cos x + 1), sin 2x = 2 sin x cos x
            let [mut cosine, mut plus_two] = [versine.clone(), versine.clone()];
            add_to_diagonal(&mut cosine, 1, count);
            add_to_diagonal(&mut plus_two, 2, count);
            versine = product(&versine, &plus_two, count);
            sine = product(&sine, &cosine, count);
            [&mut versine, &mut sine].into_iter().for_each(|matrix| scale(matrix, 2));
        }
        let stiffness: Matrix<AnyLimbs> = stiffness.iter().map(|row| row.iter().map(number).collect()).collect();
        let mut of_q = product(&stiffness, &sine, count);
        scale(&mut of_q, -1);
        for row in &mut sine {
            row.iter_mut().zip(masses).for_each(|(s, mass)| s.divide(&number(mass)));
        }
        let rounded = |matrix: &Matrix<AnyLimbs>| round(matrix, &zero);
        Flow { versine: rounded(&versine), of_p: rounded(&sine), of_q: rounded(&of_q) }
    }

    /// Sets the derivatives, of dual numbers.
    fn add_derivatives(&mut self, form: &Form<N>, time: &N) {
        let count = precision::<N>(&time.context()).expect("it was checked with the system");
        let dimension = self.versine.len();
        for (k, derivative) in form.derivatives_of_flow(time, count) {
            let (of_rows_q, of_rows_p) = derivative.split_at(dimension);
            let parts = [
                (&mut self.versine, of_rows_q, 0),
                (&mut self.of_p, of_rows_q, dimension),
                (&mut self.of_q, of_rows_p, 0),
            ];
            for (own, rows, first) in parts {
                let pairs = own.iter_mut().zip(rows).flat_map(|(own, row)| own.iter_mut().zip(&row[first..]));
                pairs.for_each(|(x, derivative)| x.assign_rounded_derivative(k, derivative));
            }
        }
    }

    /// Of a time that is infinite or NaN: so are all coordinates after it.
    fn of_no_time(time: &N, dimension: usize) -> Self {
        let matrix = vec![vec![time.clone(); dimension]; dimension];
        Flow { versine: matrix.clone(), of_p: matrix.clone(), of_q: matrix }
    }
}

/// The matrix of A: K, and 1/m along the diagonal.
fn form(masses: &[Rational], stiffness: &[Vec<Rational>]) -> Matrix<Rational> {
    let zeros = vec![num_traits::zero(); masses.len()];
    let of_q = stiffness.iter().map(|row| [&row[..], &zeros[..]].concat());
    let of_p = masses.iter().enumerate().map(|(i, mass)| {
        let mut row = [&zeros[..], &zeros[..]].concat();
        row[masses.len() + i] = mass.recip();
        row
    });
    of_q.chain(of_p).collect()
}

/// How often t is halved, so that t²|W| is below 1/16.
#[inline]
fn doublings(norm: f64, time: &AnyLimbs) -> u32 {
    let size = time.to_f64().abs() * norm.sqrt();
    if size.is_finite() { (size.max(0.25) * 4.0).log2().ceil() as u32 } else { 0 }
}

/// C − 1 = Σ (−t²W)ᵏ/(2k)! and S = t Σ (−t²W)ᵏ/(2k + 1)!
#[inline]
fn series(powers: &mut Powers, time: &AnyLimbs, count: LimbCount) -> (Matrix<AnyLimbs>, Matrix<AnyLimbs>) {
    let mut squared = *time;
    squared.multiply(time);
    squared.negate();
    let [versine, mut sine] = [-1, 1].map(|of_sine| {
        powers.series(|k, coefficient| {
            coefficient.multiply(&squared);
            coefficient.divide_integer(2 * k * (2 * k + of_sine));
        })
    });
    powers.end_of_time();
    add_to_diagonal(&mut sine, 1, count);
    sine.iter_mut().flatten().for_each(|s| s.multiply(time));
    (versine, sine)
}
