//! N is taken.

shadowstep::potential! {
    struct N { k }
    U(x) = k*x^2/2
}

fn main() {}
