//! Newton's gravity.

use shadowstep_macros::potential;

potential! {
    /// Newton's gravity among bodies of masses m.
    pub struct Gravity { g }
    pair U(r2; m_i, m_j) = -g * m_i * m_j / sqrt(r2)
}
