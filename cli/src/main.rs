//! The program `shadowstep`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(shadowstep_cli::main(std::env::args_os(), None))
}
