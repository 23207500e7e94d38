//! The derivative of a function along a direction, by differences that are extrapolated to 0.

use crate::number::{Real, epsilon};

/// A derivative and its estimated error.
pub(super) struct Derivative<N> {
    pub(super) value: N,
    pub(super) error: N,
}

/// How often the distance is halved.
const HALVINGS: usize = 20;
/// The columns of the table; each raises the order by 2.
const COLUMNS: usize = 8;

/// d/dt U(q + t v) at t = 0, by Ridders' method (Adv. Eng. Softw. 4 (1982) 75): central differences at t = 1, 1/2, 1/4,
/// …, extrapolated by Richardson's scheme. The value with the smallest error is taken: its change from its neighbours
/// in the table, and what the rounding of the energies makes.
///
/// Distances at which U is not finite are left out; where no two are left, value and error are NaN.
pub(super) fn directional_derivative<N: Real>(
    energy: &mut impl FnMut(&[N], &mut N),
    q: &[N],
    direction: &[N],
) -> Derivative<N> {
    let context = q[0].context();
    let zero = || N::zero(&context);
    let mut step = direction.to_vec();
    let (mut place, mut below) = (q.to_vec(), zero());
    let (mut best, mut row) = (None::<Derivative<N>>, Vec::<N>::new());
    let epsilon = epsilon(&context);
    for halves in 0..HALVINGS {
        let mut slope = zero();
        for (sign, value) in [(1, &mut slope), (-1, &mut below)] {
            for ((place, q), step) in place.iter_mut().zip(q).zip(&step) {
                if sign > 0 { place.assign_sum(q, step) } else { place.assign_difference(q, step) }
            }
            energy(&place, value);
        }
        let mut rounding = slope.clone();
        rounding.make_absolute();
        rounding.multiply(&epsilon);
        slope.subtract(&below);
        slope.divide_integer(2);
        // divided by t = 2^(−halves)
        for number in [&mut slope, &mut rounding] {
            (0..halves).for_each(|_| number.multiply_integer(2));
        }
        step.iter_mut().for_each(|step| step.divide_integer(2));
        if !slope.is_finite() {
            row.clear();
            continue;
        }
        row = extrapolate(&row, slope, &rounding, &mut best);
    }
    best.unwrap_or_else(|| {
        let mut nan = zero();
        nan.divide(&zero());
        Derivative { value: nan.clone(), error: nan }
    })
}

/// The next row of the table: from T(t/2) and T(t), of order j, follows T(t/2) + (T(t/2) − T(t))/(4^j − 1).
fn extrapolate<N: Real>(above: &[N], slope: N, rounding: &N, best: &mut Option<Derivative<N>>) -> Vec<N> {
    let mut row = vec![slope];
    for (j, above) in above.iter().take(COLUMNS - 1).enumerate() {
        let left = &row[j];
        let mut value = left.clone();
        value.subtract(above);
        value.divide_integer(4_i32.pow(j as u32 + 1) - 1);
        value.add(left);
        let mut error = value.clone();
        error.subtract(left);
        error.make_absolute();
        let mut other = value.clone();
        other.subtract(above);
        other.make_absolute();
        if other > error {
            error = other;
        }
        error.add(rounding);
        if best.as_ref().is_none_or(|best| error < best.error) && error.is_finite() {
            *best = Some(Derivative { value: value.clone(), error });
        }
        row.push(value);
    }
    row
}
