//! `shadowstep advise`: a scheme and a step size for a tolerance, with the evidence.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use shadowstep::number::{Limbs, Number, Real};
use shadowstep_scenes::Error;
use shadowstep_scenes::readable::wrapped;
use shadowstep_schemes::symbolic::decimal::significant;
use shadowstep_studies::work_precision::advise::{Advice, AdviceRequest, Choice, Unfinished, Verified};
use shadowstep_studies::work_precision::no_advice::over;
use shadowstep_studies::work_precision::of::Of;
use shadowstep_studies::work_precision::size::Size;
use shadowstep_studies::work_precision::study::Cost;

use crate::colour::{heading, on_stdout};
use crate::headings::{OUTPUT, SCHEMES};
use crate::output::Output;
use crate::posed::{PosedArguments, PosedProblem};
use crate::quantity;
use crate::report::Status;
use crate::terminal::{Folder, NOT_SAVED, SAVED, Terminal};
use crate::work_precision::{schemes, seconds};

const EXAMPLES: &str = "\
Examples:
  shadowstep advise kepler --until 100 --tolerance 1e-8
  shadowstep advise mine.toml --tolerance 1e-10 --of energy --cost time
  shadowstep advise outer-solar-system --until 200000 --tolerance 1e-6 \\
      --schemes +mine.toml";

const MORE: &str = "\
All schemes are run over a part of the time that --seconds allows, and their errors are extrapolated to all of it by \
their growth. The best choice is then verified by a run over all of the time. Its error is printed beside the \
prediction: to a tenth, or as `at most`.

The error of positions is the difference to the exact flow, or to runs of a \
scheme of order 10 whose own error is known from half the step.

The exit code is 1 if no scheme meets the tolerance.";

/// A scheme and a step size for a tolerance, verified by a run.
///
/// They are predicted from shorter runs of many schemes.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{MORE}"))]
pub(crate) struct Arguments {
    #[command(flatten)]
    posed: PosedArguments,
    /// The largest error, such as 1e-8
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true, help_heading = TOLERANCE)]
    tolerance: String,
    /// Which error
    #[arg(long, value_name = "WHICH", default_value = "position", help_heading = TOLERANCE)]
    of: Which,
    /// What is to be small
    #[arg(long, value_name = "WHAT", default_value = "forces", help_heading = TOLERANCE)]
    cost: What,
    /// The schemes to choose from, as in work-precision [default: a dozen]
    ///
    /// Beside a dominant part, such as Kepler orbits, the default includes schemes for A + εB and kernels with
    /// correctors.
    #[arg(long, value_name = "NAME|FILE,…", value_delimiter = ',', help_heading = SCHEMES)]
    schemes: Vec<String>,
    /// The time of the search on all cores
    ///
    /// The runs that verify the choice take additional time.
    #[arg(long, value_name = "SECONDS", default_value = "30", value_parser = seconds, help_heading = SCHEMES)]
    seconds: f64,
    /// Keeps the results in a folder, for another tolerance
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    out: Option<PathBuf>,
}

/// What the choice has to meet.
const TOLERANCE: &str = "Tolerance and cost";

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Which {
    /// |q - q_exact| at the end, in the units of the problem
    Position,
    /// The largest |H(t) - H(0)|, as a part of |H(0)| unless that is 0
    Energy,
    /// The same for a permanent change of the modified energy
    Permanent,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    /// Evaluations of the gradient, Hessian–vector products of gradient kicks, and flows of a dominant part such as
    /// Kepler orbits, each counted as one
    Forces,
    /// Seconds on this machine
    Time,
}

/// Asks for advice and writes it.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let tolerance = quantity::number("--tolerance", &arguments.tolerance)?;
    let tolerance = Size::power_of_ten(tolerance_log10(&tolerance, &arguments.tolerance)?);
    let posed = PosedProblem::read(&arguments.posed)?;
    let schemes = schemes(&arguments.schemes, &posed)?;
    let folder = Folder::of(arguments.out.as_deref())?;
    let of = match arguments.of {
        Which::Position => Of::Position,
        Which::Energy => Of::Energy,
        Which::Permanent => Of::Permanent,
    };
    let cost = match arguments.cost {
        What::Forces => Cost::Evaluations,
        What::Time => Cost::Seconds,
    };
    let mut terminal = Terminal::listen(arguments.out.as_ref().map_or(NOT_SAVED, |_| SAVED));
    let request = AdviceRequest {
        problem: posed.problem(),
        schemes: &schemes,
        of,
        tolerance,
        cost,
        seconds: arguments.seconds,
        folder: folder.path().to_owned(),
    };
    let advice = request.run(&mut terminal)?;
    Output::stdout().text(readable(&posed, &request, &advice))?;
    Ok(match advice {
        Advice::Found { .. } => terminal.status,
        Advice::OutOfReach { .. } => terminal.status.max(Status::NegativeAnswer),
    })
}

fn tolerance_log10(tolerance: &shadowstep::Rational, text: &str) -> Result<f64, Error> {
    let value = Limbs::<2>::from_rational(tolerance, &());
    if !value.is_finite() || value.is_below_zero() || value.log10_abs() == f64::NEG_INFINITY {
        return Err(Error::usage(
            format!("--tolerance {text}: the tolerance must be positive"),
            "write --tolerance 1e-8",
        ));
    }
    Ok(value.log10_abs())
}

fn readable(posed: &PosedProblem, request: &AdviceRequest<'_>, advice: &Advice<'_>) -> String {
    let mut text = wrapped(&posed.title(), "");
    text += &wrapped(&format!("tolerance {}: {}", request.tolerance, request.of.name()), "");
    match advice {
        Advice::OutOfReach { overflow, unfinished, .. } => {
            text += &wrapped(&advice.reason(request).expect("there is none"), "");
            if !overflow {
                text += &not_finished(unfinished, request.seconds);
            }
        }
        Advice::Found { choices, verified, part, unfinished } => {
            let best = &choices[0];
            let of_time = if request.problem.length.is_some() { " of s" } else { "" };
            let name = format!("{}, step {}{of_time}", best.scheme.name, best.step_text());
            text += &format!("{}\n", heading(&name, on_stdout()));
            text += &evidence(best, request, *verified, *part);
            for other in &choices[1..] {
                let Choice { scheme, error, .. } = other;
                let (work, seconds) = (other.work(request.problem.system).described(), other.seconds());
                let line = format!(
                    "or {}, step {}: predicted {error}, {work}, {seconds:.2e} s",
                    scheme.name,
                    other.step_text()
                );
                text += &wrapped(&line, "    ");
            }
            text += &not_finished(unfinished, request.seconds);
        }
    }
    text
}

/// What the search had too little time for.
fn not_finished(unfinished: &Unfinished<'_>, seconds: f64) -> String {
    let Unfinished { untried, extrapolated } = unfinished;
    let line = |what: &str, names: &[&str]| match names {
        [] => String::new(),
        names => {
            let line =
                format!("{what} in the time for each scheme, of --seconds {seconds} for all: {}", names.join(", "));
            wrapped(&line, "")
        }
    };
    line("no result", untried)
        + &line("less certain, extrapolated from larger errors, as no run reached the tolerance", extrapolated)
}

fn evidence(best: &Choice<'_>, request: &AdviceRequest<'_>, verified: Verified, part: f64) -> String {
    let verified = match verified {
        Verified::Error(error) => error.to_string(),
        Verified::AtMost(bound) | Verified::Unresolved(bound) => format!("at most {bound}"),
    };
    let mut lines = vec![
        ("predicted", format!("{}, from runs {}", best.error, over(part))),
        ("verified", format!("{verified}, by a run over all of the time")),
        ("cost", format!("{}, {:.2e} s", best.work(request.problem.system).described(), best.seconds())),
    ];
    if let Some(stable) = best.stable_step {
        let part = best.size() / stable;
        lines.push((
            "stability",
            format!("{} of the stability limit of the fastest oscillation at the start", significant(part, 2)),
        ));
    }
    lines.push(("modified energy", conserved(best)));
    let line = |(name, text): (&str, String)| format!("  {name:<18}{}", wrapped(&text, &" ".repeat(20)).trim_start());
    lines.into_iter().map(line).collect()
}

/// Up to which step the modified energy is conserved, and from which on it is lost, as far as runs were made.
fn conserved(best: &Choice<'_>) -> String {
    let size = |h: f64| format!("{h:.2e}, {} times this one", significant(h / best.size(), 2));
    let bounded = best.conserved_up_to.map_or("bounded in none of the runs".to_owned(), |largest| {
        format!("bounded in runs with steps up to {}", size(largest))
    });
    let lost =
        best.lost_from.map_or("lost in none".to_owned(), |least| format!("lost from steps of {} on", size(least)));
    let is_between = best.conserved_up_to.is_none_or(|largest| largest < best.size())
        && best.lost_from.is_none_or(|least| best.size() < least);
    format!("{bounded}; {lost}{}", if is_between { "; not decided with this one" } else { "" })
}
