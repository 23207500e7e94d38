//! The command line, used as a person or a script uses it.

mod drift;
mod problems;
mod program;
mod schemes;
mod trace;
mod wrong_usage;
