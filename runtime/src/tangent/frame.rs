//! Free vectors as combinations of vectors that stay far from parallel.

/// The vectors v_1, …, v_k of a trajectory as V = Q M: the columns of Q are orthonormal, M is upper triangular.
///
/// Free vectors turn to the direction that grows fastest, until round-off hides what distinguishes them. So v_1 alone
/// is carried along freely, the others are columns of Q: as a step takes Q to Q′ R, M becomes R M. The logarithms of
/// M_jj are the sums of those of R_jj, which have no floor.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    columns: Vec<Column>,
}

/// M_1j, …, M_jj.
#[derive(Clone, Debug)]
struct Column {
    /// log M_jj
    diagonal: f64,
    /// log |v_j|
    length: f64,
    /// The column divided by its length.
    direction: Vec<f64>,
}

impl Frame {
    /// Of vectors that are the columns of Q.
    pub(super) fn new(count: usize) -> Self {
        let column = |j: usize| {
            let mut direction = vec![0.0; j + 1];
            direction[j] = 1.0;
            Column { diagonal: 0.0, length: 0.0, direction }
        };
        Frame { columns: (0..count).map(column).collect() }
    }

    /// M ← R M: the logarithms of R_jj, and of each column what is above it.
    pub(super) fn advance(&mut self, diagonal: &[f64], above: &[Vec<f64>]) {
        for (j, column) in self.columns.iter_mut().enumerate() {
            for a in 0..=j {
                let rest: f64 = (a + 1..=j).map(|b| above[b][a] * column.direction[b]).sum();
                column.direction[a] = diagonal[a].exp() * column.direction[a] + rest;
            }
            let norm = column.direction.iter().map(|x| x * x).sum::<f64>().sqrt();
            column.direction.iter_mut().for_each(|x| *x /= norm);
            column.length += norm.ln();
            column.diagonal += diagonal[j];
        }
    }

    /// log |v_j|
    pub(super) fn length(&self, j: usize) -> f64 {
        self.columns[j].length
    }

    /// log |v_1| is known by v_1 itself.
    pub(super) fn set_first_length(&mut self, length: f64) {
        (self.columns[0].length, self.columns[0].diagonal) = (length, length);
    }

    /// The distance of v_j from the space of those before it, divided by its length.
    fn sine(&self, j: usize) -> f64 {
        (self.columns[j].diagonal - self.columns[j].length).exp().min(1.0)
    }

    /// The volume of the parallelepiped of the first k unit vectors.
    pub(super) fn volume(&self, k: usize) -> f64 {
        let logarithm = |column: &Column| column.diagonal - column.length;
        self.columns[1..k].iter().map(logarithm).sum::<f64>().exp().min(1.0)
    }

    /// The smaller of |e₁ + e₂| and |e₁ − e₂|: with e₂ = ±(cos φ, sin φ), 2 sin(φ/2) without a difference of nearly
    /// equal numbers.
    pub(super) fn smaller_distance(&self) -> f64 {
        let (sine, cosine) = (self.sine(1), self.columns[1].direction[0].abs());
        let along = sine / (1.0 + cosine);
        sine * (1.0 + along * along).sqrt()
    }

    /// Numbers that [`of_parts`](Frame::of_parts) takes, of each vector.
    pub(super) fn parts(&self, j: usize) -> Vec<f64> {
        let Column { diagonal, length, direction } = &self.columns[j];
        [*diagonal, *length].into_iter().chain(direction.iter().copied()).collect()
    }

    /// The frame with these parts of its vectors; `None` if they are not as many as vectors have.
    pub(super) fn of_parts(parts: &[&[f64]]) -> Option<Self> {
        let column = |(j, part): (usize, &&[f64])| match part {
            [diagonal, length, direction @ ..] if direction.len() == j + 1 => {
                Some(Column { diagonal: *diagonal, length: *length, direction: direction.to_vec() })
            }
            _ => None,
        };
        Some(Frame { columns: parts.iter().enumerate().map(column).collect::<Option<_>>()? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the cat map's matrix (2, 1; 1, 1) with the exponent λ = log((3 + √5)/2), after n steps: sin φ = |v₁ ∧
    /// v₂|/(|v₁| |v₂|) for v₁ = Mⁿ(1, 0), v₂ = Mⁿ(0, 1), whose components are Fibonacci's numbers.
    #[test]
    fn angles_have_no_floor() {
        let mut frame = Frame::new(2);
        let (mut first, mut second) = ([1.0_f64, 0.0], [0.0_f64, 1.0]);
        for n in 1..=300_u32 {
            let step = |[x, y]: [f64; 2]| [2.0 * x + y, x + y];
            let before = first[0].hypot(first[1]);
            (first, second) = (step(first), step(second));
            let norm = first[0].hypot(first[1]);
            let e = first.map(|x| x / norm);
            let above = e[0] * second[0] + e[1] * second[1];
            second = [second[0] - above * e[0], second[1] - above * e[1]];
            let rest = second[0].hypot(second[1]);
            second = second.map(|x| x / rest);
            frame.advance(&[(norm / before).ln(), rest.ln()], &[vec![], vec![above]]);
            // |v₁| |v₂| = √((F²₂ₙ₊₁ + F²₂ₙ)(F²₂ₙ + F²₂ₙ₋₁)) of Fₘ = φᵐ/√5, up to φ⁻ᵐ
            let golden = f64::midpoint(1.0, 5_f64.sqrt());
            let log = f64::from(4 * n) * golden.ln() + ((golden.powi(2) + 1.0) * (1.0 + golden.powi(-2))).ln() / 2.0
                - 5_f64.ln();
            if n > 20 {
                let expected = (-log).exp();
                let (volume, sali) = (frame.volume(2), frame.smaller_distance());
                assert!((volume / expected - 1.0).abs() < 1e-11, "{n} {volume} {expected}");
                assert!((sali / expected - 1.0).abs() < 1e-11, "{n} {sali} {expected}");
            }
        }
    }

    #[test]
    fn distances_of_unit_vectors() {
        for angle in [1e-30_f64, 1e-9, 0.1, 1.0, 1.5] {
            let mut frame = Frame::new(2);
            frame.advance(&[0.0, angle.sin().ln()], &[vec![], vec![-angle.cos()]]);
            assert!((frame.smaller_distance() / (2.0 * (angle / 2.0).sin()) - 1.0).abs() < 1e-13, "{angle}");
            assert!((frame.volume(2) / angle.sin() - 1.0).abs() < 1e-13, "{angle}");
        }
    }
}
