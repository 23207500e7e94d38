//! A constant is not a parameter.

shadowstep::potential! {
    struct Circle { pi }
    U(x) = pi*x^2
}

fn main() {}
