//! The formula must state whose mass it means.

shadowstep::potential! {
    struct Gravity;
    pair U(r2; m_i, m_j) = -m*m_j/sqrt(r2)
}

fn main() {}
