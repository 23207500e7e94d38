//! Properties end with the body.

shadowstep::potential! {
    struct Gravity { g }
    pair U(r2; m, m_j) = -g*m*m_j/sqrt(r2)
}

fn main() {}
