//! The tests of sweeps, as one program.

mod examples;
mod pictures;
mod tables;
mod together;
