//! `shadowstep emit`: a scheme as code for other ecosystems.

use clap::Args;
use clap::builder::PossibleValuesParser;
use shadowstep_scenes::{Error, library};
use shadowstep_studies::emit::{Target, emit};

use crate::output::{Output, OutputArguments};
use crate::report::{self, Status};

const EXAMPLES: &str = "\
Examples:
  shadowstep emit yoshida4 --to c --output yoshida4.h
  shadowstep emit mine.toml --to python > mine.py";

const MORE: &str = "\
Each file has its own self-test, and states how to run it. docs/emit.md has an example of each.";

/// Writes the proved step of a scheme as code of other ecosystems.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{MORE}"))]
pub(crate) struct Arguments {
    /// A shipped scheme, such as yoshida4, or the file of a table
    scheme: String,
    /// What it is written for
    ///
    /// The targets are a module for NumPy or JAX, a header of C, a module of Julia or Fortran, a CustomIntegrator of
    /// OpenMM, an integrator of BlackJAX or mici, a table for SUNDIALS or PETSc, and a table to print.
    #[arg(long, value_name = "TARGET", value_parser = PossibleValuesParser::new(Target::ALL.iter().map(|target| target.name())))]
    to: String,
    #[command(flatten)]
    output: OutputArguments,
}

/// Proves the scheme and writes it.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let named = library::scheme(&arguments.scheme)?;
    let target: Target = arguments.to.parse().expect("only names of targets are accepted");
    let code = emit(&named.quadratic(), target)
        .map_err(|refusal| Error::usage(format!("{} {}", refusal.scheme, refusal.reason), refusal.hint))?;
    named.note().iter().for_each(report::note);
    Output::of(&arguments.output)?.text(code)?;
    Ok(Status::Success)
}
