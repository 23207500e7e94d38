//! The tests of numbers of limbs, as one program.

mod arithmetic;
mod decimal;
mod fixed;
mod functions;
mod mpfr;
