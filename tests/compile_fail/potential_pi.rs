//! A constant is no parameter.

shadowstep::potential! {
    struct Circle { pi }
    U(x) = pi*x^2
}

fn main() {}
