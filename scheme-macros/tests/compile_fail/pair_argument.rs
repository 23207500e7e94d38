//! The formula of a pair is in r2 or in d.

shadowstep::potential! {
    struct Gravity;
    pair U(r) = -1/r
}

fn main() {}
