//! A mass belongs to all bodies, or to each.

shadowstep::potential! {
    struct Gravity { m }
    pair U(r2; m_i, m_j) = -m_i*m_j/sqrt(r2)
}

fn main() {}
