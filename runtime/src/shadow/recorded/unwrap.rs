//! Positions without jumps from one image of a periodic box to another.

use super::error::RecordedError;

/// A move by more than this part of a box vector between two states is not decided: it may be one by the rest, to the
/// other side.
const DECIDED: f64 = 0.25;

/// Follows particles in a periodic box, whose logged positions are images in the box.
///
/// Each particle goes to the nearest image of its next position: of a move s in box vectors it takes s − round(s) from
/// state to state. That is the right image if no particle moves by half of a box vector in a step; a move by more than
/// a quarter is refused, with its place.
///
/// β is the integral of qᵀU_q − 2U, which jumps where a coordinate is wrapped. The box stays the same: with a barostat
/// there is no modified energy of this kind.
///
/// ```
/// use shadowstep::shadow::recorded::Unwrapping;
///
/// let mut unwrapping = Unwrapping::new([[10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 10.0]])?;
/// assert_eq!(unwrapping.next(&[9.5, 1.0, 0.5])?, [9.5, 1.0, 0.5]);
/// assert_eq!(unwrapping.next(&[0.5, 1.0, 9.5])?, [10.5, 1.0, -0.5]);
/// assert!(unwrapping.next(&[4.5, 1.0, 9.5]).is_err());
/// # Ok::<(), shadowstep::shadow::recorded::RecordedError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Unwrapping {
    vectors: [[f64; 3]; 3],
    inverse: [[f64; 3]; 3],
    /// Which of the box vectors are periodic.
    periodic: [bool; 3],
    n: i64,
    /// Whether the next state is the first, or does not follow the newest.
    is_first: bool,
    q: Vec<f64>,
}

impl Unwrapping {
    /// A box with these vectors, the rows of the matrix, periodic along all of them.
    ///
    /// # Errors
    /// Vectors that span no volume.
    pub fn new(vectors: [[f64; 3]; 3]) -> Result<Self, RecordedError> {
        let inverse = inverse(&vectors).ok_or(RecordedError::Box { vectors })?;
        Ok(Unwrapping { vectors, inverse, periodic: [true; 3], n: -1, is_first: true, q: Vec::new() })
    }

    /// Periodic along some of the vectors only.
    #[must_use]
    pub fn along(self, periodic: [bool; 3]) -> Self {
        Unwrapping { periodic, ..self }
    }

    /// The next state does not follow the newest: it stays as it is.
    pub fn begin(&mut self) {
        self.is_first = true;
    }

    /// The unwrapped positions of the next state; the first one stays as it is.
    ///
    /// # Errors
    /// A particle that moved by more than a quarter of a box vector; other numbers of coordinates than before.
    pub fn next(&mut self, q: &[f64]) -> Result<&[f64], RecordedError> {
        self.n += 1;
        if std::mem::take(&mut self.is_first) {
            if !q.len().is_multiple_of(3) {
                return Err(RecordedError::NotInSpace { dimension: q.len() });
            }
            self.q = q.to_vec();
        }
        let (n, dimension) = (self.n, self.q.len());
        if q.len() != dimension {
            return Err(RecordedError::Dimension { name: "q", n, found: q.len(), dimension });
        }
        let Unwrapping { vectors, inverse, periodic, q: own, .. } = self;
        let particles = own.as_chunks_mut::<3>().0.iter_mut().zip(q.as_chunks::<3>().0);
        for (particle, (own, q)) in particles.enumerate() {
            let step: [f64; 3] = std::array::from_fn(|i| q[i] - own[i]);
            let mut next = *q;
            for vector in (0..3).filter(|&vector| periodic[vector]) {
                let turns: f64 = (0..3).map(|i| step[i] * inverse[i][vector]).sum();
                let images = turns.round();
                let turns = (turns - images).abs();
                if turns > DECIDED {
                    return Err(RecordedError::Undecided { n, particle, vector, turns });
                }
                next.iter_mut().zip(&vectors[vector]).for_each(|(next, vector)| *next -= images * vector);
            }
            *own = next;
        }
        Ok(&self.q)
    }
}

/// `None` for a matrix without one.
fn inverse(a: &[[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let minor = |i: usize, j: usize| {
        let [i1, i2, j1, j2] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
        a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]
    };
    let determinant: f64 = (0..3).map(|j| a[0][j] * minor(0, j)).sum();
    let inverse: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| minor(j, i) / determinant));
    inverse.iter().flatten().all(|x| x.is_finite()).then_some(inverse)
}
