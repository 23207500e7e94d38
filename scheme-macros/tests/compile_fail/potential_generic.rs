//! The type of numbers is added to the struct.

shadowstep::potential! {
    struct Spring<N> { k }
    U(x) = k*x^2/2
}

fn main() {}
