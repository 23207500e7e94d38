//! The least change that solves linear equations, in the sense that its largest entry is as small as can be.

/// Rows shorter than this multiple of the longest one depend on the others.
const DEPENDENT: f64 = 1e-10;

/// What remains of a change that one entry accounts for, relative to it.
const LINEAR: f64 = 1e-3;

/// Iterations after which the size of the least change counts as undecided.
const MOST_STEPS: usize = 300;

/// The solutions δ of A δ = b, where A may have more rows than rank; they are the solutions of Q δ = y with orthonormal
/// rows.
pub(crate) struct LeastChange {
    q: Vec<Vec<f64>>,
    y: Vec<f64>,
    /// How far the equations contradict each other, at most.
    contradiction: f64,
}

impl LeastChange {
    /// Gram–Schmidt with pivoting on the rows.
    pub(crate) fn of(rows: &[Vec<f64>], b: &[f64]) -> LeastChange {
        let mut rest: Vec<(Vec<f64>, f64)> = rows.iter().cloned().zip(b.iter().copied()).collect();
        let mut change = LeastChange { q: Vec::new(), y: Vec::new(), contradiction: 0.0 };
        let mut longest = 0.0_f64;
        while let Some(place) = (0..rest.len()).max_by(|&i, &j| square(&rest[i].0).total_cmp(&square(&rest[j].0))) {
            let length = square(&rest[place].0).sqrt();
            longest = longest.max(length);
            if length <= DEPENDENT * longest {
                break;
            }
            let (row, b) = rest.swap_remove(place);
            let (unit, value): (Vec<f64>, f64) = (row.iter().map(|x| x / length).collect(), b / length);
            for (row, b) in &mut rest {
                let along = dot(row, &unit);
                row.iter_mut().zip(&unit).for_each(|(x, unit)| *x -= along * unit);
                *b -= along * value;
            }
            change.q.push(unit);
            change.y.push(value);
        }
        change.contradiction = rest.iter().map(|(_, b)| b.abs()).fold(0.0, f64::max);
        change
    }

    /// Whether every solution surely has an entry larger than a limit.
    ///
    /// For every λ, |λᵀy| = |(Qᵀλ)ᵀδ| ≤ Σ|(Qᵀλ)_j| max|δ_j|. Lawson's iteration of weighted least squares finds the λ
    /// with the best bound and the δ with the least maximum (C. L. Lawson, thesis, UCLA, 1961).
    pub(crate) fn exceeds(&self, limit: f64) -> bool {
        if self.contradiction > limit {
            return true;
        }
        let count = self.q.first().map_or(0, Vec::len);
        let mut freedom = vec![1.0; count];
        for _ in 0..MOST_STEPS {
            let lambda = solve(self.gram(&freedom), self.y.clone());
            let along = self.transposed(&lambda);
            let change: Vec<_> = along.iter().zip(&freedom).map(|(x, freedom)| x * freedom).collect();
            let largest = change.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            if largest <= limit {
                return false;
            }
            if dot(&lambda, &self.y).abs() > limit * along.iter().map(|x| x.abs()).sum::<f64>() {
                return true;
            }
            freedom.iter_mut().zip(&change).for_each(|(freedom, x)| *freedom /= (x.abs() / largest).max(1e-3));
            let most = freedom.iter().fold(0.0_f64, |most, x| most.max(*x));
            freedom.iter_mut().for_each(|x| *x = (*x / most).max(1e-12));
        }
        false
    }

    /// The entries one of which suffices: with it free, the others solve the equations and stay within a limit.
    ///
    /// Each with its value in the solution in which the others have the least squares. The entry that was changed is
    /// among them, as far as the equations are linear; where there are several, nothing here decides between them.
    pub(crate) fn sufficient(&self, limit: f64) -> Vec<(usize, f64)> {
        let change = self.transposed(&self.y);
        let suffices = |j: usize| {
            let leverage = self.q.iter().map(|row| row[j] * row[j]).sum::<f64>();
            if leverage <= DEPENDENT {
                return None;
            }
            let alone = change[j] / leverage;
            // the equations themselves are linear to first order only
            let limit = limit.max(LINEAR * alone.abs());
            let rest = square(&self.y) - change[j] * alone;
            // the least squares are the cheaper test, and never the stricter one
            let is_near = self.contradiction <= limit && rest <= limit * limit * change.len() as f64;
            (is_near && !self.without(j).exceeds(limit)).then_some((j, alone))
        };
        (0..change.len()).filter_map(suffices).collect()
    }

    /// The largest entry of the solution of least squares.
    pub(crate) fn farthest(&self) -> Option<(usize, f64)> {
        let change = self.transposed(&self.y);
        change.into_iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    /// The equations for the other entries where entry j may have any value.
    fn without(&self, j: usize) -> LeastChange {
        let column: Vec<_> = self.q.iter().map(|row| row[j]).collect();
        let length = square(&column);
        let (along_y, along) = (dot(&column, &self.y), self.transposed(&column));
        let rest = |(row, c): (&Vec<f64>, &f64)| -> Vec<f64> {
            let mut rest: Vec<_> = row.iter().zip(&along).map(|(x, along)| x - c * along / length).collect();
            rest[j] = 0.0;
            rest
        };
        let rows: Vec<_> = self.q.iter().zip(&column).map(rest).collect();
        let y: Vec<_> = self.y.iter().zip(&column).map(|(y, c)| y - c * along_y / length).collect();
        LeastChange { contradiction: self.contradiction, ..LeastChange::of(&rows, &y) }
    }

    /// What is left to change after entry j has been moved by this much.
    #[cfg(test)]
    pub(crate) fn after(&self, j: usize, by: f64) -> LeastChange {
        let y = self.q.iter().zip(&self.y).map(|(row, y)| y - row[j] * by).collect();
        LeastChange { q: self.q.clone(), y, contradiction: self.contradiction }
    }

    /// Q D Qᵀ
    fn gram(&self, freedom: &[f64]) -> Vec<Vec<f64>> {
        let entry = |a: &[f64], b: &[f64]| a.iter().zip(b).zip(freedom).map(|((a, b), freedom)| a * b * freedom).sum();
        self.q.iter().map(|a| self.q.iter().map(|b| entry(a, b)).collect()).collect()
    }

    /// Qᵀλ
    fn transposed(&self, lambda: &[f64]) -> Vec<f64> {
        let count = self.q.first().map_or(0, Vec::len);
        (0..count).map(|j| self.q.iter().zip(lambda).map(|(row, lambda)| row[j] * lambda).sum()).collect()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn square(a: &[f64]) -> f64 {
    dot(a, a)
}

/// Solves a positive definite system by Gauss's elimination.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    for column in 0..right.len() {
        let (above, below) = matrix.split_at_mut(column + 1);
        let pivot = &above[column];
        for (i, row) in below.iter_mut().enumerate() {
            let factor = row[column] / pivot[column];
            row[column..].iter_mut().zip(&pivot[column..]).for_each(|(x, pivot)| *x -= factor * pivot);
            right[column + 1 + i] -= factor * right[column];
        }
    }
    for column in (0..right.len()).rev() {
        let known = dot(&matrix[column][column + 1..], &right[column + 1..]);
        right[column] = (right[column] - known) / matrix[column][column];
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(rows: &[&[f64]], b: &[f64]) -> LeastChange {
        LeastChange::of(&rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>(), b)
    }

    #[test]
    fn the_least_maximum_is_found_to_any_limit() {
        // x + 2y = 6: x = y = 2
        let line = change(&[&[1.0, 2.0]], &[6.0]);
        assert!(line.exceeds(1.999) && !line.exceeds(2.001));
        // x + y + z = 3, x − z = 3: x = 3/2 = −z at least, y = 3 with it; the balance is x = 2, y = 2, z = −1
        let two = change(&[&[1.0, 1.0, 1.0], &[1.0, 0.0, -1.0]], &[3.0, 3.0]);
        assert!(two.exceeds(1.999) && !two.exceeds(2.001));
        // rows that repeat others change nothing, unless they contradict them
        let again = change(&[&[1.0, 2.0], &[2.0, 4.0]], &[6.0, 12.0]);
        assert!(again.exceeds(1.999) && !again.exceeds(2.001));
        assert!(change(&[&[1.0, 2.0], &[2.0, 4.0]], &[6.0, 0.0]).exceeds(5.0));
    }

    #[test]
    fn one_entry_suffices() {
        // three equations in four unknowns, met by (0, 0, 900, 0) and a rounding
        let rows: [&[f64]; 3] = [&[1.0, 1.0, 1.0, 1.0], &[0.2, -0.7, 0.4, 1.5], &[0.3, 0.5, -0.9, 0.1]];
        let b = rows.map(|row| 900.0 * row[2] + 0.3 * row[0] - 0.4 * row[3]);
        let [(blamed, by)] = change(&rows, &b).sufficient(1.0)[..] else { panic!("not one") };
        assert!(blamed == 2 && (by - 900.0).abs() < 1.0, "{blamed} by {by}");
        // two entries are off
        let b = rows.map(|row| 900.0 * row[2] + 700.0 * row[0]);
        assert!(change(&rows, &b).sufficient(1.0).is_empty());
    }

    #[test]
    fn entries_that_explain_the_same_are_all_sufficient() {
        // the first two columns differ by little, and the third makes up for it
        let rows: [&[f64]; 2] = [&[1.0, 1.0, 0.2], &[0.5, 0.5001, -0.4]];
        let found = change(&rows, &rows.map(|row| 900.0 * row[0])).sufficient(1.0);
        assert_eq!(found.iter().map(|(j, _)| *j).collect::<Vec<_>>(), [0, 1], "{found:?}");
        // what the third would have to make up for is beyond the limit
        let rows: [&[f64]; 2] = [&[1.0, 1.0, 0.2], &[0.5, 0.6, -0.4]];
        let found = change(&rows, &rows.map(|row| 900.0 * row[0])).sufficient(1.0);
        assert_eq!(found.iter().map(|(j, _)| *j).collect::<Vec<_>>(), [0], "{found:?}");
    }
}
