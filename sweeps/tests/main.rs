//! The tests of sweeps, as one program.

mod examples;
mod tables;
mod together;
