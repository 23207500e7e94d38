//! The tests of the library, as one program. `allocations.rs` is another one, as it has an allocator of its own.

mod ensemble;
#[cfg(feature = "mpfr")]
mod fixed_point;
mod indicators;
mod kepler_drift;
mod lanes;
#[cfg(feature = "mpfr")]
mod limbs;
mod steps;
