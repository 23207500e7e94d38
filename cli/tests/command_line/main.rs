//! The command line, used as a person or a script uses it.
#![cfg_attr(
    not(feature = "mpfr"),
    allow(dead_code, unused_imports, reason = "some tests need more digits than limbs have")
)]

mod chaos;
mod checkpoints;
mod complete_files;
#[cfg(feature = "mpfr")]
mod digits;
mod drift;
mod emit;
mod figures;
mod help;
#[cfg(unix)]
mod links;
mod lost_energy;
mod messages;
mod modified;
mod output_files;
mod outside;
mod planets;
mod plot;
mod polish;
mod problems;
mod processed;
mod program;
mod program_itself;
mod prove;
mod sampling;
mod scene_kinetic;
mod scene_pairs;
mod scenes;
mod schemes;
mod search;
#[cfg(unix)]
mod signals;
mod stability;
mod sweeps;
mod trace;
mod work_precision;
mod writers;
