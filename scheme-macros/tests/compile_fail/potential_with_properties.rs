//! Properties of bodies are for pairs.

shadowstep::potential! {
    struct Trap;
    U(x, y; m_i) = m_i*(x^2 + y^2)/2
}

fn main() {}
