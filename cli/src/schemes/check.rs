//! `shadowstep schemes check`: the proof of what tables claim.

use std::io::Write;

use clap::Args;
use shadowstep::tables::{self, Proved};
use shadowstep_analysis::Likeness;

use crate::output::Output;
use crate::report::{self, Status};
use crate::schemes::from;
use shadowstep_scenes::Error;
use shadowstep_scenes::library::{self, NamedScheme};

const EXAMPLES: &str = "\
Examples:
  shadowstep schemes check mine.toml
  shadowstep schemes check --from integrators.py src/*.c";

/// Proves what tables claim, or finds the schemes in source code.
///
/// The exit code is 1 if one has faults, or decimals that rounding does not explain.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The tables
    #[arg(required_unless_present = "from", value_name = "FILE")]
    files: Vec<String>,
    /// Reads the lists of weights in source code
    ///
    /// Of each list in C, C++, Fortran, Python, Julia, Rust or JSON: which scheme it is, its order, and what is wrong
    /// with it.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "files")]
    from: Vec<String>,
}

/// Goes through all tables; the worst answer counts.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    if !arguments.from.is_empty() {
        return from::execute(&arguments.from);
    }
    let mut output = Output::stdout();
    let mut status = Status::Success;
    for path in &arguments.files {
        let source = match library::source(path) {
            Ok(source) => source,
            Err(error) => {
                status = status.max(report::error(&error.into()));
                continue;
            }
        };
        match tables::read(&source, &library::beside_or_shipped, None) {
            Ok(scheme) => {
                write!(output, "{}", verdict(path, scheme.proved()))?;
                if !scheme.proved().has_its_digits {
                    status = status.max(Status::NegativeAnswer);
                }
                NamedScheme { name: path.clone(), scheme: scheme.at_run_time() }.note().iter().for_each(report::note);
            }
            Err(faults) => {
                writeln!(output, "{faults}")?;
                status = status.max(Status::NegativeAnswer);
            }
        }
    }
    output.finish()?;
    Ok(status)
}

fn verdict(path: &str, proved: &Proved) -> String {
    let order = proved.order();
    let class = match proved.scheme.inner {
        Some(_) => "slow forces, fast forces and T".to_owned(),
        None => proved.scheme.table.kinetic.to_string(),
    };
    let symmetric = if proved.proof.symmetric { ", symmetric" } else { "" };
    let refused = if proved.has_its_digits { "" } else { "; its printed digits are not all those of such a scheme" };
    let effective = proved.proof.effective.as_ref().map_or(String::new(), |effective| {
        let order = effective.for_kinetic(proved.scheme.table.kinetic);
        let near = proved.orders().and_in_epsilon();
        format!("effective order {} for {class}{near}, {}; of the kernel ", order.order, order.held())
    });
    // with an inner scheme, the maps are those of the outer one
    let likeness = Likeness::of(&proved.scheme.maps())
        .filter(|known| proved.scheme.inner.is_none() && known.known.name != proved.scheme.table.name.value);
    // of symmetric schemes the text does not say which map comes first
    let other =
        |known: &Likeness| if known.exchanged && proved.proof.symmetric { ", with the other map first" } else { "" };
    let known = likeness.map_or_else(String::new, |known| format!("; is {}{}", known.text(), other(&known)));
    let mut text = format!(
        "{path}: proved: {effective}order {} for {class}{}, {}{symmetric}{refused}{known}\n",
        order.order,
        proved.orders_of_steps().and_in_epsilon(),
        order.held()
    );
    for note in &proved.notes {
        text += &format!("note: {note}\n");
    }
    text
}
