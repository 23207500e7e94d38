//! A solution that owes nothing to any table: extrapolation of the leapfrog rule, with T_p and U_q as plain functions.

use rug::Float;

/// q before p.
pub type State = Vec<Float>;

/// A function of q or of p with a component for each.
pub type Field<'a> = &'a dyn Fn(&[Float]) -> Vec<Float>;

/// H = T(p) + U(q) by its derivatives.
#[derive(Clone, Copy)]
pub struct Separable<'a> {
    /// T_p
    pub velocity: Field<'a>,
    /// U_q
    pub gradient: Field<'a>,
}

impl Separable<'_> {
    /// The flow over a time h: the error of the leapfrog rule has even powers of the step only, of which
    /// `columns` columns leave about h^(2 columns + 1).
    pub fn flow(self, start: &[Float], h: &Float, columns: u32) -> State {
        let mut row: Vec<State> = Vec::new();
        for k in 1..=columns {
            let mut next = vec![self.leapfrog(start, h, k)];
            for j in 1..k {
                // Aitken–Neville in (h/k)²: T + (T − T_above)/((k/(k−j))² − 1)
                let (coarse, fine) = (&row[j as usize - 1], &next[j as usize - 1]);
                let ratio = Float::with_val(coarse[0].prec(), k) / (k - j);
                let weight = ratio.square() - 1;
                next.push(coarse.iter().zip(fine).map(|(c, f)| f.clone() + (f.clone() - c) / &weight).collect());
            }
            row = next;
        }
        row.pop().expect("there is a column")
    }

    /// k leapfrog steps over a time h.
    fn leapfrog(self, start: &[Float], h: &Float, k: u32) -> State {
        let step = h.clone() / k;
        let half = step.clone() / 2;
        let mut state = start.to_vec();
        let (q, p) = state.split_at_mut(start.len() / 2);
        for _ in 0..k {
            subtract(p, &half, (self.gradient)(q));
            subtract(q, &(-step.clone()), (self.velocity)(p));
            subtract(p, &half, (self.gradient)(q));
        }
        state
    }
}

/// x ← x − weight·f
fn subtract(x: &mut [Float], weight: &Float, f: Vec<Float>) {
    for (x, f) in x.iter_mut().zip(f) {
        *x -= f * weight;
    }
}
